//! TOML text to [`Scene`], with every error led back to a key and a line.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::{Scene, SceneError, SceneErrorKind};

impl Scene {
    /// Reads a scene from TOML text and checks it; `file` names the text in errors.
    ///
    /// # Errors
    ///
    /// A [`SceneError`] with file, line and key if the text is not a scene, or the scene is not one that can exist.
    pub fn from_toml(text: &str, file: &str) -> Result<Scene, SceneError> {
        let with_place = |mut error: SceneError| {
            error.file = Some(file.to_string());
            error.line = error.line.or_else(|| line_of_key(text, &error.key));
            error
        };
        let scene: Scene = toml::from_str(text).map_err(|error| with_place(format_error(text, &error)))?;
        scene.validate().map_err(with_place)?;
        Ok(scene)
    }

    /// Adds to an error found later (when building) the file and line that the text gives it.
    pub fn locate(text: &str, file: &str, mut error: SceneError) -> SceneError {
        error.file = Some(file.to_string());
        error.line = line_of_key(text, &error.key);
        error
    }
}

fn format_error(text: &str, error: &toml::de::Error) -> SceneError {
    let mut message = error.message().trim().to_string();
    if let Some(suggestion) = suggestion(&message) {
        message.push_str(&format!("; did you mean `{suggestion}`?"));
    }
    let mut scene_error = SceneError::new(SceneErrorKind::Format, "", message);
    if let Some(span) = error.span() {
        scene_error.line = Some(line_at(text, span.start));
        if let Ok(table) = DeTable::parse(text) {
            scene_error.key = key_at(table.get_ref(), span.start).unwrap_or_default();
        }
    }
    scene_error
}

/// The allowed name nearest to the refused one in a message of the form "unknown field `a`, expected one of `b`, `c`".
fn suggestion(message: &str) -> Option<String> {
    if !message.starts_with("unknown") {
        return None;
    }
    let mut names = message.split('`').skip(1).step_by(2);
    let refused = names.next()?;
    nearest(refused, names)
}

/// The candidate that is most like a misspelt name, if any is much like it.
pub(super) fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    candidates
        .map(|candidate| (strsim::jaro_winkler(name, candidate), candidate))
        .filter(|(likeness, _)| *likeness > 0.8)
        .max_by(|left, right| left.0.total_cmp(&right.0))
        .map(|(_, candidate)| candidate.to_string())
}

fn line_at(text: &str, offset: usize) -> usize {
    1 + text.bytes().take(offset).filter(|byte| *byte == b'\n').count()
}

/// Path of the innermost key whose name or value stands at a byte offset.
fn key_at(table: &DeTable<'_>, offset: usize) -> Option<String> {
    for (key, value) in table {
        let name = key.get_ref();
        if let Some(inner) = key_in_value(value.get_ref(), offset) {
            return Some(format!("{name}{inner}"));
        }
        if contains(&key.span(), offset) || contains(&value.span(), offset) {
            return Some(name.to_string());
        }
    }
    None
}

fn key_in_value(value: &DeValue<'_>, offset: usize) -> Option<String> {
    match value {
        DeValue::Table(table) => key_at(table, offset).map(|inner| format!(".{inner}")),
        DeValue::Array(items) => items.iter().enumerate().find_map(|(index, item)| {
            let inner = key_in_value(item.get_ref(), offset);
            let here = contains(&item.span(), offset).then(String::new);
            inner.or(here).map(|inner| format!("[{index}]{inner}"))
        }),
        _ => None,
    }
}

fn contains(span: &Range<usize>, offset: usize) -> bool {
    span.contains(&offset)
}

/// Line of a key path as `body[3].mass`; where the last parts are absent from the file, the line of the nearest part that is there.
fn line_of_key(text: &str, path: &str) -> Option<usize> {
    let document = DeTable::parse(text).ok()?;
    let mut span = None;
    let mut table = document.get_ref();
    for part in path.split('.') {
        let (name, index) = match part.split_once('[') {
            Some((name, rest)) => (name, rest.trim_end_matches(']').parse::<usize>().ok()),
            None => (part, None),
        };
        let Some((key, value)) = table.iter().find(|(key, _)| key.get_ref() == name) else { break };
        span = Some(key.span());
        let mut value = value;
        if let (Some(index), DeValue::Array(items)) = (index, value.get_ref()) {
            let Some(item) = items.get(index) else { break };
            span = Some(item.span());
            value = item;
        }
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            _ => break,
        }
    }
    span.map(|span| line_at(text, span.start))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
[scene]
name = \"drop\"
end_time = 1.0

[[material]]
name = \"glass\"
density = 2500.0

[[shape]]
name = \"ball\"
geometry = { sphere = { radius = 0.003 } }

[[body]]
shape = \"ball\"
material = \"glass\"
position = [0.0, 0.0, 1.0]

[[body]]
shape = \"ball\"
material = \"glass\"
position = [0.0, 0.0, 2.0]
mass = 1.0

[numerics]
step = 1e-5
";

    fn error_of(text: &str) -> SceneError {
        Scene::from_toml(text, "drop.toml").expect_err("this text must be refused")
    }

    #[test]
    fn a_good_text_is_a_scene() {
        let scene = Scene::from_toml(TEXT, "drop.toml").expect("a good scene");
        assert_eq!(scene.bodies.len(), 2);
        assert_eq!(scene.numerics.step, crate::scene::Step::Seconds(1e-5));
    }

    #[test]
    fn an_unknown_key_is_named_with_its_line_and_a_suggestion() {
        let error = error_of(&TEXT.replace("density", "densty"));
        assert_eq!((error.kind, error.line, error.key.as_str()), (SceneErrorKind::Format, Some(7), "material[0].densty"));
        assert!(error.message.contains("did you mean `density`"), "{error}");
    }

    #[test]
    fn a_wrong_value_is_named_with_its_line() {
        let error = error_of(&TEXT.replace("mass = 1.0", "mass = -1.0"));
        assert_eq!((error.kind, error.line, error.key.as_str()), (SceneErrorKind::Value, Some(22), "body[1].mass"));
        let error = error_of(&TEXT.replace("radius = 0.003", "radius = nan"));
        assert_eq!((error.line, error.key.as_str()), (Some(11), "shape[0].geometry.sphere.radius"));
    }

    #[test]
    fn a_step_of_the_wrong_type_says_what_is_expected() {
        let error = error_of(&TEXT.replace("step = 1e-5", "step = \"fast\""));
        assert_eq!(error.line, Some(25));
        assert!(error.message.contains("a time step in seconds, or \"advise\""), "{error}");
    }
}
