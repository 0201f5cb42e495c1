//! Differences of second order on the staggered grid of a box that repeats (R section 7.3.1).

use super::grid::{FaceField, Grid};

/// A row of cells along the first direction: places in a field of its first cell and of the first cells of the rows next to it.
struct Row {
    start: usize,
    /// The last and the next row along the second and the third direction.
    beside: [[usize; 2]; 2],
}

/// All rows of a box that repeats, in the order of fields. Differences go row by row: to find a neighbour from the number of a cell alone takes divisions.
fn rows(grid: &Grid) -> impl Iterator<Item = Row> + '_ {
    let [_, second, third] = grid.cells();
    (0..third).flat_map(move |k| (0..second).map(move |j| [0, j, k])).map(|cell| {
        let beside = |direction| [-1, 1].map(|step| grid.neighbour(cell, direction, step));
        Row { start: grid.index(cell), beside: [beside(1), beside(2)] }
    })
}

/// The last and the next place in a row that repeats.
#[inline]
fn around(place: usize, length: usize) -> [usize; 2] {
    [if place == 0 { length - 1 } else { place - 1 }, if place + 1 == length { 0 } else { place + 1 }]
}

/// Divergence of a velocity in 1/s, cell by cell.
pub fn divergence(grid: &Grid, velocity: &FaceField) -> Vec<f64> {
    let length = grid.cells()[0];
    let mut result = Vec::with_capacity(grid.len());
    for Row { start, beside: [[_, second], [_, third]] } in rows(grid) {
        let [u, v, w] = velocity.component.each_ref().map(|values| &values[start..][..length]);
        let (v_next, w_next) = (&velocity.component[1][second..][..length], &velocity.component[2][third..][..length]);
        let of_cell = |i: usize| (u[around(i, length)[1]] - u[i] + v_next[i] - v[i] + w_next[i] - w[i]) / grid.spacing();
        result.extend((0..length).map(of_cell));
    }
    result
}

/// Gradient of a pressure in Pa/m, on faces.
pub fn gradient(grid: &Grid, pressure: &[f64]) -> FaceField {
    let length = grid.cells()[0];
    let mut component: [Vec<f64>; 3] = std::array::from_fn(|_| Vec::with_capacity(grid.len()));
    for Row { start, beside: [[second, _], [third, _]] } in rows(grid) {
        let [here, below, behind] = [start, second, third].map(|start| &pressure[start..][..length]);
        component[0].extend((0..length).map(|i| (here[i] - here[around(i, length)[0]]) / grid.spacing()));
        component[1].extend((0..length).map(|i| (here[i] - below[i]) / grid.spacing()));
        component[2].extend((0..length).map(|i| (here[i] - behind[i]) / grid.spacing()));
    }
    FaceField { component }
}

/// Laplacian of one field, be it of pressures or of one component of a velocity.
pub fn laplacian(grid: &Grid, field: &[f64]) -> Vec<f64> {
    let (length, square) = (grid.cells()[0], grid.spacing() * grid.spacing());
    let mut result = Vec::with_capacity(grid.len());
    for Row { start, beside: [second, third] } in rows(grid) {
        let of_row = |start: usize| &field[start..][..length];
        let (here, [below, above], [behind, ahead]) = (of_row(start), second.map(of_row), third.map(of_row));
        let at = |i: usize| {
            let [last, next] = around(i, length);
            (here[last] + here[next] + below[i] + above[i] + behind[i] + ahead[i] - 6.0 * here[i]) / square
        };
        result.extend((0..length).map(at));
    }
    result
}

/// Sums side by side: one alone waits for each addition.
const SUMS: usize = 8;

/// Inner product of two fields, value by value.
pub(crate) fn dot(one: &[f64], other: &[f64]) -> f64 {
    let (ones, rest) = one.as_chunks::<SUMS>();
    let (others, other_rest) = other.as_chunks::<SUMS>();
    let mut sums = [0.0; SUMS];
    for (one, other) in ones.iter().zip(others) {
        for (sum, (one, other)) in sums.iter_mut().zip(one.iter().zip(other)) {
            *sum += one * other;
        }
    }
    sums.iter().sum::<f64>() + rest.iter().zip(other_rest).map(|(one, other)| one * other).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::Vector;
    use crate::fluid::grid::cell_field;

    /// A wave with its slope and Laplacian, of other wave numbers in each direction, on boxes of unequal numbers of cells.
    const WAVE: [f64; 3] = [1.0, -2.0, 1.0];

    const AMPLITUDE: [f64; 3] = [1.0, -0.6, 0.4];

    fn phase(place: &Vector) -> f64 {
        TAU * (WAVE[0] * place.x + WAVE[1] * place.y / 1.25 + WAVE[2] * place.z / 0.75) + 0.3
    }

    fn wave_vector() -> Vector {
        Vector::new(WAVE[0], WAVE[1] / 1.25, WAVE[2] / 0.75) * TAU
    }

    fn grid(refinement: usize) -> Grid {
        Grid::new([4, 5, 3].map(|cells| 4 * cells * refinement), 0.0625 / refinement as f64, Vector::new(0.2, -0.1, 0.4))
            .expect("enough cells")
    }

    fn largest_difference(got: &[f64], wanted: &[f64]) -> f64 {
        assert_eq!(got.len(), wanted.len());
        got.iter().zip(wanted).map(|(got, wanted)| (got - wanted).abs()).fold(0.0, f64::max)
    }

    /// Largest errors of divergence, gradient and Laplacian of waves.
    fn errors(grid: &Grid) -> [f64; 3] {
        let k = wave_vector();
        let velocity = FaceField::from_fn(grid, |component, place| AMPLITUDE[component] * phase(&place).sin());
        let divergence_wanted = cell_field(grid, |place| k.dot(&Vector::from(AMPLITUDE)) * phase(&place).cos());
        let pressure = cell_field(grid, |place| phase(&place).sin());
        let slopes_wanted = FaceField::from_fn(grid, |component, place| k[component] * phase(&place).cos());
        let slopes = gradient(grid, &pressure);
        let of_gradient = (0..3).map(|a| largest_difference(&slopes.component[a], &slopes_wanted.component[a])).fold(0.0, f64::max);
        let bent_wanted: Vec<f64> = velocity.component[1].iter().map(|value| -k.norm_squared() * value).collect();
        [
            largest_difference(&divergence(grid, &velocity), &divergence_wanted) / k.norm(),
            of_gradient / k.norm(),
            largest_difference(&laplacian(grid, &velocity.component[1]), &bent_wanted) / k.norm_squared(),
        ]
    }

    #[test]
    fn differences_of_waves_are_of_second_order() {
        let (coarse, fine) = (errors(&grid(1)), errors(&grid(2)));
        for (coarse, fine) in coarse.iter().zip(fine) {
            let order = (coarse / fine).log2();
            // The next term of the error is smaller by the square of the phase of a cell, here below 0.8.
            assert!((order - 2.0).abs() < 0.1 && fine < 0.15, "{order} {fine}");
        }
    }

    #[test]
    fn a_wave_is_bent_by_the_symbol_of_its_differences() {
        let grid = grid(1);
        let field = cell_field(&grid, |place| phase(&place).cos());
        let along = |k: f64| (2.0 * (0.5 * k * grid.spacing()).sin() / grid.spacing()).powi(2);
        let symbol: f64 = wave_vector().iter().map(|k| along(*k)).sum();
        let wanted: Vec<f64> = field.iter().map(|value| -symbol * value).collect();
        assert!(largest_difference(&laplacian(&grid, &field), &wanted) < 1e-13 * symbol);
    }

    #[test]
    fn gradient_is_minus_the_adjoint_of_divergence() {
        let grid = grid(1);
        let velocity = FaceField::from_fn(&grid, |component, place| (phase(&place) * (component as f64 + 0.7)).sin());
        let pressure = cell_field(&grid, |place| (1.7 * phase(&place)).cos());
        let slopes = gradient(&grid, &pressure);
        let inner = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(one, other)| one * other).sum::<f64>();
        let with_gradient: f64 = (0..3).map(|a| inner(&slopes.component[a], &velocity.component[a])).sum();
        let with_divergence = inner(&divergence(&grid, &velocity), &pressure);
        assert!((with_gradient + with_divergence).abs() < 1e-12 * with_gradient.abs().max(1.0));
    }
}
