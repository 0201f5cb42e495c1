//! Names of rows as words: one way of saying each, on pages and on axes.

/// A quantity's name as words.
pub(crate) fn words(name: &str) -> String {
    with_powers(&name.replace('_', " "))
}

/// "error of" a quantity, or its name alone where that says so already.
pub(crate) fn error_of(quantity: &str) -> String {
    let words = words(quantity);
    if words.starts_with("error ") { words } else { format!("error of {words}") }
}

/// Squares and cubes as they are printed.
pub(crate) fn with_powers(text: &str) -> String {
    text.replace("^2", "²").replace("^3", "³")
}

#[cfg(test)]
mod tests {
    use super::{error_of, words};

    #[test]
    fn quantities_read_as_words() {
        assert_eq!(error_of("rebound_velocity"), "error of rebound velocity");
        assert_eq!(error_of("error of the normal"), "error of the normal");
        assert_eq!(words("area in m^2"), "area in m²");
    }
}
