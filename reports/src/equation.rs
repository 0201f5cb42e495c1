//! Equations: LaTeX to MathML, which browsers set themselves.

use maud::{Markup, PreEscaped, html};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

/// An equation in display style; the LaTeX text itself where it does not parse.
pub(crate) fn display(latex: &str) -> Markup {
    match mathml(latex) {
        Some(mathml) => html! { div.equation { (PreEscaped(mathml)) } },
        None => html! { pre.equation { (latex) } },
    }
}

fn mathml(latex: &str) -> Option<String> {
    let storage = Storage::new();
    let events = Parser::new(latex, &storage).collect::<Result<Vec<_>, _>>().ok()?;
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    let mut text = String::new();
    let events = events.into_iter().map(Ok::<_, std::fmt::Error>);
    push_mathml(&mut text, events, config).ok()?;
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::display;

    #[test]
    fn equations_become_mathml_or_stay_readable() {
        let equation = display(r"m \ddot{\delta} + c \dot\delta + k \delta = 0, \quad e = e^{-\pi\zeta/\sqrt{1-\zeta^2}}");
        let text = equation.into_string();
        assert!(text.contains("<math") && text.contains("<msqrt>") && !text.contains("merror"), "{text}");
        let broken = display(r"\frac{a}{<b>").into_string();
        assert!(broken.contains("<pre") && broken.contains("&lt;b&gt;"), "{broken}");
    }
}
