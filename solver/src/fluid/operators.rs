//! Differences of second order on the staggered grid of a box that repeats (R section 7.3.1).

use super::grid::{FaceField, Grid};

/// Divergence of a velocity in 1/s, cell by cell.
pub fn divergence(grid: &Grid, velocity: &FaceField) -> Vec<f64> {
    let of_cell = |index: usize| {
        let cell = grid.cell(index);
        let out = |direction: usize| {
            let values = &velocity.component[direction];
            values[grid.neighbour(cell, direction, 1)] - values[index]
        };
        (0..3).map(out).sum::<f64>() / grid.spacing()
    };
    (0..grid.len()).map(of_cell).collect()
}

/// Gradient of a pressure in Pa/m, on faces.
pub fn gradient(grid: &Grid, pressure: &[f64]) -> FaceField {
    let of_face = |direction: usize, index: usize| {
        let before = grid.neighbour(grid.cell(index), direction, -1);
        (pressure[index] - pressure[before]) / grid.spacing()
    };
    FaceField { component: std::array::from_fn(|direction| (0..grid.len()).map(|index| of_face(direction, index)).collect()) }
}

/// Laplacian of one field, be it of pressures or of one component of a velocity.
pub fn laplacian(grid: &Grid, field: &[f64]) -> Vec<f64> {
    let square = grid.spacing() * grid.spacing();
    let at = |index: usize| {
        let cell = grid.cell(index);
        let along = |direction| field[grid.neighbour(cell, direction, 1)] - 2.0 * field[index] + field[grid.neighbour(cell, direction, -1)];
        (0..3).map(along).sum::<f64>() / square
    };
    (0..grid.len()).map(at).collect()
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
