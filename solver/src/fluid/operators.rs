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
    use super::*;
    use crate::Vector;
    use crate::fluid::periodic::PeriodicBox;

    fn wavy(grid: &Grid) -> FaceField {
        let extent = grid.extent();
        FaceField::from_fn(grid, |component, place| {
            let phase = (0..3).map(|direction| (direction + component + 1) as f64 * place[direction] / extent[direction]).sum::<f64>();
            (std::f64::consts::TAU * phase).sin() + (3.0 * phase).cos() * 0.1
        })
    }

    fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
        values.into_iter().fold(0.0, |largest, value| largest.max(value.abs()))
    }

    /// Odd, even and unequal numbers of cells.
    const CELLS: [[usize; 3]; 4] = [[8, 6, 10], [7, 9, 5], [16, 4, 11], [12, 12, 12]];

    #[test]
    fn pressure_inverts_the_laplacian() {
        for cells in CELLS {
            let grid = Grid::new(cells, 0.1, Vector::zeros()).unwrap();
            let mut right = wavy(&grid).component[0].clone();
            let mean = right.iter().sum::<f64>() / right.len() as f64;
            right.iter_mut().for_each(|value| *value -= mean);
            let mut solution = right.clone();
            PeriodicBox::new(grid).solve_poisson(&mut solution);
            let error = laplacian(&grid, &solution).iter().zip(&right).map(|(got, wanted)| got - wanted).collect::<Vec<_>>();
            assert!(largest(error.iter().copied()) < 1e-13 * largest(right.iter().copied()) * 10.0, "{cells:?}");
        }
    }

    #[test]
    fn creeping_flow_has_no_divergence_and_balances_forces() {
        for (cells, inertia) in CELLS.iter().zip([0.0, 0.0, 3.0, 1e3]) {
            let grid = Grid::new(*cells, 0.1, Vector::new(0.3, -0.2, 0.0)).unwrap();
            let (viscosity, mean) = (0.7, Vector::new(0.2, -0.1, 0.05));
            let force = wavy(&grid);
            let mut velocity = force.clone();
            PeriodicBox::new(grid).solve_stokes(&mut velocity, viscosity, inertia, mean);
            let size = largest(velocity.component.iter().flatten().copied());
            assert!((velocity.mean() - mean).norm() < 1e-14);
            assert!(largest(divergence(&grid, &velocity)) < 1e-13 * size / grid.spacing());
            // What is left of the momentum balance is a gradient: its own projection on fields without divergence is nothing.
            let mut left = FaceField {
                component: std::array::from_fn(|direction| {
                    let (values, force) = (&velocity.component[direction], &force.component[direction]);
                    let viscous = laplacian(&grid, values);
                    (0..grid.len()).map(|index| force[index] - inertia * values[index] + viscosity * viscous[index]).collect()
                }),
            };
            PeriodicBox::new(grid).solve_stokes(&mut left, 0.0, 1.0, Vector::zeros());
            assert!(largest(left.component.iter().flatten().copied()) < 1e-13 * largest(force.component.iter().flatten().copied()) * 10.0);
        }
    }

    #[test]
    fn gradient_is_minus_the_adjoint_of_divergence() {
        let grid = Grid::new([6, 5, 7], 0.5, Vector::zeros()).unwrap();
        let velocity = wavy(&grid);
        let pressure = wavy(&grid).component[2].clone();
        let slopes = gradient(&grid, &pressure);
        let with_gradient: f64 =
            (0..3).map(|a| slopes.component[a].iter().zip(&velocity.component[a]).map(|(x, y)| x * y).sum::<f64>()).sum();
        let with_divergence: f64 = divergence(&grid, &velocity).iter().zip(&pressure).map(|(x, y)| x * y).sum();
        assert!((with_gradient + with_divergence).abs() < 1e-12 * with_gradient.abs().max(1.0));
    }
}
