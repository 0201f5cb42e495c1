//! Errors of scenes with the line they speak of.

use solver::SceneError;

/// The error and, if it has a line, that line of the text with its key underlined.
pub fn with_source_line(error: &SceneError, text: &str) -> String {
    let line = error.line.and_then(|number| Some((number, text.lines().nth(number.checked_sub(1)?)?)));
    let Some((number, line)) = line else { return error.to_string() };
    let (margin, mark) = (" ".repeat(number.to_string().len()), underline(line, &error.key));
    format!("{error}\n {margin} |\n {number} | {line}\n {margin} | {mark}")
}

/// Carets under the last part of the key if it is in the line, else under all of it.
fn underline(line: &str, key: &str) -> String {
    let name = key.rsplit('.').next().and_then(|part| part.split('[').next()).unwrap_or_default();
    let place = if name.is_empty() { None } else { line.find(name) };
    let indent = line.len() - line.trim_start().len();
    let (start, end) = place.map_or((indent, line.trim_end().len()), |start| (start, start + name.len()));
    let count = |part: Option<&str>| part.map_or(0, |part| part.chars().count());
    // Tabs stay tabs, so that carets stand below what they mark.
    let blank: String = line.get(..start).unwrap_or_default().chars().map(|sign| if sign == '\t' { '\t' } else { ' ' }).collect();
    blank + &"^".repeat(count(line.get(start..end)).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use solver::scene::SceneErrorKind;

    #[test]
    fn the_key_is_underlined_in_its_line() {
        let mut error = SceneError::new(SceneErrorKind::Value, "body[1].mass", "-1 is not above 0");
        (error.line, error.file) = (Some(2), Some("a.toml".into()));
        let shown = with_source_line(&error, "[[body]]\n  mass = -1.0\n");
        assert_eq!(shown, "a.toml:2: `body[1].mass`: -1 is not above 0\n   |\n 2 |   mass = -1.0\n   |   ^^^^");
    }

    #[test]
    fn a_line_without_the_key_is_underlined_whole_and_no_line_is_no_harm() {
        let mut error = SceneError::new(SceneErrorKind::Value, "body[1].mass", "missing");
        error.line = Some(1);
        assert!(with_source_line(&error, "[[body]]").ends_with("| ^^^^^^^^"));
        error.line = Some(9);
        assert_eq!(with_source_line(&error, ""), "line 9: `body[1].mass`: missing");
    }
}
