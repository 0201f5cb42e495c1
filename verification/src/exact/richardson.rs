//! Extrapolation of a sequence of grids to none, with the order that the sequence shows (R eq. 7.14, after Richardson 1911) and an uncertainty.

/// What a sequence of grids tends to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extrapolated {
    /// The limit.
    pub value: f64,
    /// The order with which it is approached.
    pub order: f64,
    /// Roache's bound for the limit: 1.25 times what the extrapolation adds to the finest value.
    pub uncertainty: f64,
}

/// Orders that are believed; a sequence that shows another one is taken to be of the nearest of these.
const ORDERS: [f64; 2] = [1.0, 4.0];

/// Parts of the range of orders that are looked at first.
const LOOKS: usize = 60;

/// Fits $K(h) = K_0 + C h^p$ to values at spacings, coarse to fine, by least squares relative to the size of the term; at least three are needed.
pub fn extrapolate(sequence: &[[f64; 2]]) -> Option<Extrapolated> {
    let [_, finest] = *sequence.last().filter(|_| sequence.len() >= 3)?;
    let misfit = |order: f64| fit(sequence, order).1;
    // The best of an even row, then golden section about it.
    let step = (ORDERS[1] - ORDERS[0]) / LOOKS as f64;
    let row = (0..=LOOKS).map(|look| ORDERS[0] + step * look as f64);
    let best = row.min_by(|one, other| misfit(*one).total_cmp(&misfit(*other)))?;
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = ((best - step).max(ORDERS[0]), (best + step).min(ORDERS[1]));
    while high - low > 1e-6 {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if misfit(left) < misfit(right) { high = right } else { low = left }
    }
    let order = 0.5 * (low + high);
    let value = fit(sequence, order).0;
    Some(Extrapolated { value, order, uncertainty: 1.25 * (value - finest).abs() })
}

/// Limit and sum of squares of a fit of a given order.
fn fit(sequence: &[[f64; 2]], order: f64) -> (f64, f64) {
    // Errors of a value are taken to be of the size of its own term, so finer grids weigh more.
    // Over the weight of the finest, so that misfits of different orders can be compared.
    let finest = sequence.last().map_or(1.0, |[spacing, _]| *spacing);
    let terms = sequence.iter().map(|[spacing, value]| (spacing.powf(order), *value, (finest / spacing).powf(2.0 * order)));
    let mut sums = [0.0; 5];
    for (term, value, weight) in terms.clone() {
        for (sum, part) in sums.iter_mut().zip([weight, weight * term, weight * term * term, weight * value, weight * term * value]) {
            *sum += part;
        }
    }
    let [ones, firsts, squares, values, products] = sums;
    let determinant = ones * squares - firsts * firsts;
    let limit = (squares * values - firsts * products) / determinant;
    let slope = (ones * products - firsts * values) / determinant;
    (limit, terms.map(|(term, value, weight)| weight * (value - limit - slope * term).powi(2)).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_found_with_their_limit() {
        for order in [1.0, 1.3, 2.0, 2.7, 4.0] {
            let sequence = [0.1, 0.07, 0.05, 0.035].map(|spacing: f64| [spacing, 3.0 - 2.0 * spacing.powf(order)]);
            let found = extrapolate(&sequence).unwrap();
            assert!((found.value - 3.0).abs() < 1e-5, "{found:?}");
            assert!((found.order - order).abs() < 1e-4, "{found:?}");
            assert!((found.uncertainty - 2.5 * 0.035_f64.powf(order)).abs() < 1e-5);
        }
    }

    #[test]
    fn two_grids_are_not_enough() {
        assert_eq!(extrapolate(&[[0.1, 1.0], [0.05, 1.1]]), None);
    }
}
