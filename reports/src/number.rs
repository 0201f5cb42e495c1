//! Numbers as text: one way of writing each kind, so that a number looks the same wherever it stands.

use maud::{Markup, html};

/// A number split into the parts pages and plots typeset: `1.6` and the power `-5`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Digits {
    pub(crate) mantissa: String,
    pub(crate) exponent: Option<i32>,
}

/// Splits `value` at `digits` significant digits; plain notation between 0.001 and 100 000.
pub(crate) fn digits(value: f64, digits: usize) -> Digits {
    let plain = |mantissa: String| Digits { mantissa: mantissa.replace('-', "\u{2212}"), exponent: None };
    if !value.is_finite() || value == 0.0 {
        return plain(value.to_string());
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return plain(scientific) };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-3..5).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        plain(format!("{value:.decimals$}"))
    } else {
        Digits { mantissa: mantissa.replace('-', "\u{2212}"), exponent: Some(exponent) }
    }
}

/// A number for a page: `1.6 x 10^-5` with a real superscript, two significant digits.
pub(crate) fn short(value: f64) -> Markup {
    typeset(&digits(value, 2))
}

/// A measured value for a page, with six significant digits and no trailing zeros.
pub(crate) fn value(value: f64) -> Markup {
    let mut parts = digits(value, 6);
    if parts.mantissa.contains('.') {
        parts.mantissa = parts.mantissa.trim_end_matches('0').trim_end_matches('.').to_string();
    }
    typeset(&parts)
}

fn typeset(parts: &Digits) -> Markup {
    html! {
        span.number {
            (parts.mantissa)
            @if let Some(exponent) = parts.exponent { "\u{2009}×\u{2009}10" sup { (superscript(exponent)) } }
        }
    }
}

/// An exponent with a true minus sign.
pub(crate) fn superscript(exponent: i32) -> String {
    exponent.to_string().replace('-', "\u{2212}")
}

/// A number for a terminal or an alternative text: `1.6e-5`, two significant digits.
pub(crate) fn terminal(value: f64) -> String {
    let parts = digits(value, 2);
    match parts.exponent {
        Some(exponent) => format!("{}e{exponent}", parts.mantissa),
        None => parts.mantissa,
    }
    .replace('\u{2212}', "-")
}

/// A knob value as it was set: no rounding, no trailing zeros.
pub(crate) fn knob(value: f64) -> String {
    if value != 0.0 && !(1e-4..1e7).contains(&value.abs()) { format!("{value:e}") } else { value.to_string() }
}

/// Seconds in the unit that keeps the number short: `0.84 ms`.
pub(crate) fn seconds(seconds: f64) -> String {
    let (scale, unit) = match seconds.abs() {
        0.0 => (1.0, "s"),
        s if s < 0.999_5e-6 => (1e9, "ns"),
        s if s < 0.999_5e-3 => (1e6, "µs"),
        s if s < 0.999_5 => (1e3, "ms"),
        s if s < 119.5 => (1.0, "s"),
        s if s < 7170.0 => (1.0 / 60.0, "min"),
        _ => (1.0 / 3600.0, "h"),
    };
    let scaled = seconds * scale;
    let text = if scaled.abs() >= 99.5 { format!("{scaled:.0}") } else { digits(scaled, 2).mantissa };
    format!("{text}\u{a0}{unit}")
}

/// A file size.
pub(crate) fn bytes(count: usize) -> String {
    match count {
        0..=999 => format!("{count} B"),
        1_000..=999_999 => format!("{:.1} kB", count as f64 / 1e3),
        _ => format!("{:.1} MB", count as f64 / 1e6),
    }
}

/// A whole number with thin spaces between groups of three.
pub(crate) fn grouped(count: u64) -> String {
    let plain = count.to_string();
    let mut text = String::new();
    for (index, digit) in plain.chars().enumerate() {
        if index > 0 && (plain.len() - index).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// A ratio such as an error over its bound: two digits, or plain `1` and above without false precision.
pub(crate) fn ratio(ratio: f64) -> String {
    if ratio.is_finite() && ratio.abs() >= 9.95 && ratio.abs() < 1e6 { format!("{ratio:.0}") } else { terminal(ratio) }
}

/// An observed order: two decimals, and no sign of nothing.
pub(crate) fn order(order: f64) -> String {
    let text = format!("{order:.2}");
    if text == "-0.00" { "0.00".into() } else { text.replace('-', "\u{2212}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_one_way() {
        assert_eq!(terminal(1.6e-5), "1.6e-5");
        assert_eq!(terminal(0.0123), "0.012");
        assert_eq!(terminal(-2.5e7), "-2.5e7");
        assert_eq!(short(3.1e-6).into_string(), "<span class=\"number\">3.1\u{2009}×\u{2009}10<sup>−6</sup></span>");
        assert_eq!(value(0.85).into_string(), "<span class=\"number\">0.85</span>");
        assert_eq!(value(f64::NAN).into_string(), "<span class=\"number\">NaN</span>");
    }

    #[test]
    fn seconds_choose_their_unit() {
        for (given, expected) in
            [(8.4e-4, "840 µs"), (0.0021, "2.1 ms"), (0.9999, "1.0 s"), (37.0, "37 s"), (600.0, "10 min"), (0.0, "0 s")]
        {
            assert_eq!(seconds(given).replace('\u{a0}', " "), expected);
        }
    }

    #[test]
    fn counts_sizes_and_knobs() {
        assert_eq!((order(-0.001), order(-1.9), order(2.041)), ("0.00".into(), "\u{2212}1.90".into(), "2.04".into()));
        assert_eq!(grouped(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(bytes(1_532), "1.5 kB");
        assert_eq!((knob(50.0), knob(0.02), knob(1e-9)), ("50".into(), "0.02".into(), "1e-9".into()));
    }
}
