//! Ordinary differential equations of a few unknowns to rounding error, by extrapolation, and roots of functions of one.

use std::array::from_fn;

/// The unknowns: of an impact without friction, displacement since the first touch, velocity, turn since then, rate of the tilt.
pub type State<const UNKNOWNS: usize = 4> = [f64; UNKNOWNS];

/// Root between `low`, where a function is not positive, and `high`, where it is: secants, with the lasting end weighed down (Illinois).
pub fn root(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut below, mut above) = (function(low), function(high));
    let width = 2.0 * f64::EPSILON * high;
    let mut last_was_above = None;
    while high - low > width {
        let secant = (low * above - high * below) / (above - below);
        let middle = if secant > low && secant < high { secant } else { 0.5 * (low + high) };
        let value = function(middle);
        let is_above = value > 0.0;
        let lasts = last_was_above == Some(is_above);
        match (value == 0.0, is_above) {
            (true, _) => return middle,
            (_, true) => (low, below, high, above) = (low, if lasts { 0.5 * below } else { below }, middle, value),
            (_, false) => (low, below, high, above) = (middle, value, high, if lasts { 0.5 * above } else { above }),
        }
        last_was_above = Some(is_above);
    }
    high
}

/// Columns of the extrapolation: order 20.
pub const COLUMNS: usize = 10;

/// A step by extrapolation.
pub struct Step<const UNKNOWNS: usize = 4> {
    /// State at its end.
    pub end: State<UNKNOWNS>,
    /// Columns it took.
    pub columns: usize,
    /// Whether two columns agree.
    pub converged: bool,
}

/// The derivative is given the distance from the start of the step and the state. Gragg, Bulirsch and Stoer: modified midpoint rules of 2, 4, 6, ... parts, extrapolated to none until two columns agree within `unit`.
pub fn extrapolate<const UNKNOWNS: usize>(
    derivative: impl Fn(f64, &State<UNKNOWNS>) -> State<UNKNOWNS>,
    start: &State<UNKNOWNS>,
    slope: &State<UNKNOWNS>,
    length: f64,
    unit: &State<UNKNOWNS>,
) -> Step<UNKNOWNS> {
    let mut row = [[0.0; UNKNOWNS]; COLUMNS];
    let (mut columns, mut converged) = (0, false);
    while columns < COLUMNS && !converged {
        let mut entry = midpoint_rule(&derivative, start, slope, length, 2 * (columns + 1));
        for (earlier, kept) in row.iter_mut().enumerate().take(columns) {
            let ratio = (columns + 1) as f64 / (columns - earlier) as f64;
            let refined = from_fn(|part| entry[part] + (entry[part] - kept[part]) / (ratio * ratio - 1.0));
            *kept = entry;
            entry = refined;
        }
        row[columns] = entry;
        converged = columns >= 3 && (0..UNKNOWNS).all(|part| (entry[part] - row[columns - 1][part]).abs() <= unit[part]);
        columns += 1;
    }
    Step { end: from_fn(|part| start[part] + row[columns - 1][part]), columns, converged }
}

/// Change of the state over a length in an even number of parts.
fn midpoint_rule<const UNKNOWNS: usize>(
    derivative: impl Fn(f64, &State<UNKNOWNS>) -> State<UNKNOWNS>,
    start: &State<UNKNOWNS>,
    slope: &State<UNKNOWNS>,
    length: f64,
    parts: usize,
) -> State<UNKNOWNS> {
    let part = length / parts as f64;
    let (mut before, mut change) = ([0.0; UNKNOWNS], slope.map(|rate| part * rate));
    for index in 1..parts {
        let rate = derivative(part * index as f64, &from_fn(|unknown| start[unknown] + change[unknown]));
        (before, change) = (change, from_fn(|unknown| before[unknown] + 2.0 * part * rate[unknown]));
    }
    change
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oscillator_and_a_root_are_found_to_rounding() {
        let derivative = |_: f64, state: &State| [state[1], -state[0], state[3], -4.0 * state[2]];
        let start = [1.0, 0.0, 0.0, 2.0];
        let step = extrapolate(derivative, &start, &derivative(0.0, &start), 0.7, &[1e-15; 4]);
        let exact = [0.7_f64.cos(), -0.7_f64.sin(), 1.4_f64.sin(), 2.0 * 1.4_f64.cos()];
        for (found, exact) in step.end.iter().zip(exact) {
            // Differences of columns carry the rounding of each, magnified a few hundred times by the order of 20.
            assert!((found - exact).abs() < 512.0 * f64::EPSILON, "{found} {exact}");
        }
        assert!((root(|x| x * x - 2.0, 1.0, 2.0) - 2.0_f64.sqrt()).abs() < 4.0 * f64::EPSILON);
    }
}
