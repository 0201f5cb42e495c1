//! Roots by bisection: slow, and right to the last bit.

/// Root of a function that is positive at `high` and, but for rounding, not at `low`, to the last bit.
pub(super) fn bisect(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if function(middle) > 0.0 { high = middle } else { low = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::bisect;

    #[test]
    fn the_root_of_two_is_found_to_the_last_bit_from_above() {
        let root = bisect(|number| number * number - 2.0, 0.0, 2.0);
        assert!(root * root > 2.0 && root.next_down() * root.next_down() <= 2.0, "{root}");
    }
}
