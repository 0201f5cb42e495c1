//! Exact inverses of the difference operators of a box that repeats: pressure, and velocity and pressure of creeping flow, by Fourier transform.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use super::grid::{FaceField, Grid};
use super::sheet::Response;
use super::spectrum::{Mode, Spectrum};
use crate::Vector;

/// Inverse operators of a box that repeats in all directions.
///
/// On a face or cell the modes of wave number $\theta$ have the divergence $D = (e^{i \theta} - 1) / h$ and the gradient $G = -\bar D$ (differences to the next
/// and to the last neighbour), and the Laplacian $D \cdot G$. So every operator is inverted mode by mode without any error but rounding.
#[derive(Debug, Clone)]
pub struct PeriodicBox {
    grid: Grid,
    spectrum: Spectrum,
    /// Divergence of each mode along each direction in 1/m.
    divergence: [Vec<Mode>; 3],
    /// Minus the second difference of each mode along each direction in 1/m^2.
    square: [Vec<f64>; 3],
}

impl PeriodicBox {
    /// The inverses of a grid.
    pub fn new(grid: Grid) -> PeriodicBox {
        let divergence = |direction: usize| {
            let cells = grid.cells()[direction];
            let mode = |number| (Complex::from_polar(1.0, 2.0 * PI * number as f64 / cells as f64) - 1.0) / grid.spacing();
            (0..cells).map(mode).collect::<Vec<Mode>>()
        };
        let divergence = std::array::from_fn(divergence);
        let square = divergence.each_ref().map(|modes: &Vec<Mode>| modes.iter().map(|mode| mode.norm_sqr()).collect());
        PeriodicBox { grid, spectrum: Spectrum::new(grid.cells()), divergence, square }
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Replaces the right side of $\nabla^2 p = r$ by the solution of mean zero; the mean of the right side, which has none, is left out.
    pub fn solve_poisson(&self, field: &mut [f64]) {
        let [first, second, third] = &self.square;
        let share = 1.0 / self.grid.len() as f64;
        self.spectrum.apply([field], |line, [modes]| {
            let across = first[line.first] + second[line.second];
            for (mode, square) in modes.iter_mut().zip(third) {
                let square = across + square;
                *mode *= if square > 0.0 { -share / square } else { 0.0 };
            }
        });
    }

    /// Replaces the right side of $\alpha u - \mu \nabla^2 u = r$ by the solution; `inertia` $\alpha$ is positive.
    pub fn solve_helmholtz(&self, field: &mut [f64], viscosity: f64, inertia: f64) {
        let [first, second, third] = &self.square;
        let share = 1.0 / self.grid.len() as f64;
        self.spectrum.apply([field], |line, [modes]| {
            let across = first[line.first] + second[line.second];
            modes.iter_mut().zip(third).for_each(|(mode, square)| *mode *= share / (inertia + viscosity * (across + square)));
        });
    }

    /// Replaces the force density in N/m^3 in $\alpha u - \mu \nabla^2 u + \nabla p = f$, $\nabla \cdot u = 0$ by the velocity in m/s.
    ///
    /// `viscosity` $\mu$ is in Pa s, `inertia` $\alpha$ in kg/(m^3 s): the density over a time step, or zero for creeping flow. The mean velocity is the one that
    /// is given, whatever the mean force: a mean pressure gradient takes that up.
    pub fn solve_stokes(&self, field: &mut FaceField, viscosity: f64, inertia: f64, mean: Vector) {
        let share = 1.0 / self.grid.len() as f64;
        let [first, second, third] = &self.divergence;
        let [first_square, second_square, third_square] = &self.square;
        let [x, y, z] = &mut field.component;
        self.spectrum.apply([x, y, z], |line, [x, y, z]| {
            let (along_first, along_second) = (first[line.first], second[line.second]);
            let across = first_square[line.first] + second_square[line.second];
            for (place, (along_third, square)) in third.iter().zip(third_square).enumerate() {
                let square = across + square;
                if square > 0.0 {
                    // Minus the pressure: the part of the force that the gradient takes up.
                    let pressure = (x[place] * along_first + y[place] * along_second + z[place] * along_third) / square;
                    let scale = share / (inertia + viscosity * square);
                    x[place] = (x[place] - along_first.conj() * pressure) * scale;
                    y[place] = (y[place] - along_second.conj() * pressure) * scale;
                    z[place] = (z[place] - along_third.conj() * pressure) * scale;
                } else {
                    [x[place], y[place], z[place]] = [mean.x, mean.y, mean.z].map(Mode::from);
                }
            }
        });
    }
}

impl PeriodicBox {
    /// What [`PeriodicBox::solve_stokes`] makes of a mode of given wave numbers: velocities, row by row, of unit force densities.
    pub(super) fn symbol(&self, wave: [usize; 3], response: &Response) -> [[Mode; 3]; 3] {
        let along: [Mode; 3] = std::array::from_fn(|direction| self.divergence[direction][wave[direction]]);
        let square: f64 = (0..3).map(|direction| self.square[direction][wave[direction]]).sum();
        let entry = |row: usize, column: usize| {
            let identity = if row == column { 1.0 } else { 0.0 };
            if square > 0.0 {
                (identity - along[row].conj() * along[column] / square) / (response.inertia + response.viscosity * square)
            } else {
                Mode::from(identity * response.mean_mobility)
            }
        };
        std::array::from_fn(|row| std::array::from_fn(|column| entry(row, column)))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::fluid::operators::{divergence, gradient, laplacian};

    /// Waves of every kind: nothing that the transforms could favour.
    fn wavy(grid: &Grid) -> FaceField {
        let extent = grid.extent();
        FaceField::from_fn(grid, |component, place| {
            let phase = (0..3).map(|direction| (direction + component + 1) as f64 * place[direction] / extent[direction]).sum::<f64>();
            (TAU * phase).sin() + (3.0 * phase).cos() * 0.1
        })
    }

    fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
        values.into_iter().fold(0.0, |largest, value| largest.max(value.abs()))
    }

    /// Odd, even and unequal numbers of cells.
    const CELLS: [[usize; 3]; 4] = [[8, 6, 10], [7, 9, 5], [16, 4, 11], [12, 12, 12]];
    /// Rounding of a transform there and back, of a condition number of a hundred, on fields of order one.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn pressure_inverts_the_laplacian() {
        for cells in CELLS {
            let grid = Grid::new(cells, 0.1, Vector::zeros()).expect("enough cells");
            let mut right = wavy(&grid).component[0].clone();
            let mean = right.iter().sum::<f64>() / right.len() as f64;
            let mut solution = right.clone();
            PeriodicBox::new(grid).solve_poisson(&mut solution);
            right.iter_mut().for_each(|value| *value -= mean);
            let left: Vec<f64> = laplacian(&grid, &solution).iter().zip(&right).map(|(got, wanted)| got - wanted).collect();
            assert!(largest(&left) < ROUNDING, "{cells:?}");
            assert!(solution.iter().sum::<f64>().abs() < ROUNDING);
        }
    }

    #[test]
    fn helmholtz_inverts_viscosity_and_inertia() {
        for cells in CELLS {
            let grid = Grid::new(cells, 0.1, Vector::zeros()).expect("enough cells");
            let right = wavy(&grid).component[1].clone();
            let mut solution = right.clone();
            PeriodicBox::new(grid).solve_helmholtz(&mut solution, 0.7, 3.0);
            let bent = laplacian(&grid, &solution);
            let left: Vec<f64> = (0..grid.len()).map(|index| 3.0 * solution[index] - 0.7 * bent[index] - right[index]).collect();
            assert!(largest(&left) < ROUNDING, "{cells:?}");
        }
    }

    #[test]
    fn creeping_flow_has_no_divergence_and_balances_forces() {
        for (cells, inertia) in CELLS.iter().zip([0.0, 0.0, 3.0, 1e3]) {
            let grid = Grid::new(*cells, 0.1, Vector::new(0.3, -0.2, 0.0)).expect("enough cells");
            let (viscosity, mean) = (0.7, Vector::new(0.2, -0.1, 0.05));
            let force = wavy(&grid);
            let mut velocity = force.clone();
            PeriodicBox::new(grid).solve_stokes(&mut velocity, viscosity, inertia, mean);
            assert!((velocity.mean() - mean).norm() < 1e-14);
            assert!(largest(&divergence(&grid, &velocity)) < ROUNDING);
            // What is left of the momentum balance is a gradient and a constant: its own projection on fields without divergence is nothing.
            let left_of = |direction: usize| {
                let (values, force) = (&velocity.component[direction], &force.component[direction]);
                let bent = laplacian(&grid, values);
                (0..grid.len()).map(|index| force[index] - inertia * values[index] + viscosity * bent[index]).collect()
            };
            let mut left = FaceField { component: std::array::from_fn(left_of) };
            PeriodicBox::new(grid).solve_stokes(&mut left, 0.0, 1.0, Vector::zeros());
            assert!(largest(left.component.iter().flatten()) < ROUNDING);
        }
    }

    /// All equations of momentum and continuity written out as one matrix and solved by elimination.
    #[test]
    fn a_dense_matrix_gives_the_same_flow() {
        let grid = Grid::new([4, 5, 4], 0.25, Vector::zeros()).expect("enough cells");
        let (viscosity, inertia, mean) = (0.6, 0.8, Vector::new(0.3, 0.0, -0.2));
        let cells = grid.len();
        // Unknowns: three components, the pressure, and three mean pressure gradients. The mean of the pressure is set to nothing.
        let unknowns = 4 * cells + 3;
        let apply = |vector: &[f64]| {
            let velocity = FaceField { component: std::array::from_fn(|a| vector[a * cells..][..cells].to_vec()) };
            let pressure = &vector[3 * cells..4 * cells];
            let slopes = gradient(&grid, pressure);
            let mut rows = Vec::with_capacity(unknowns);
            for a in 0..3 {
                let bent = laplacian(&grid, &velocity.component[a]);
                rows.extend((0..cells).map(|index| {
                    inertia * velocity.component[a][index] - viscosity * bent[index] + slopes.component[a][index] + vector[4 * cells + a]
                }));
            }
            let level = pressure.iter().sum::<f64>();
            rows.extend(divergence(&grid, &velocity).into_iter().map(|outflow| outflow + level));
            rows.extend(velocity.mean().iter());
            rows
        };
        let unit = |place: usize| (0..unknowns).map(|other| f64::from(u8::from(other == place))).collect::<Vec<f64>>();
        let columns: Vec<nalgebra::DVector<f64>> = (0..unknowns).map(|place| nalgebra::DVector::from_vec(apply(&unit(place)))).collect();
        let force = wavy(&grid);
        let right = force.component.iter().flatten().copied().chain(vec![0.0; cells]).chain(mean.iter().copied());
        let right = nalgebra::DVector::from_iterator(unknowns, right);
        let dense = nalgebra::DMatrix::from_columns(&columns).lu().solve(&right).expect("a matrix with an inverse");
        let mut velocity = force.clone();
        PeriodicBox::new(grid).solve_stokes(&mut velocity, viscosity, inertia, mean);
        let worst = velocity.component.iter().flatten().zip(dense.iter()).map(|(got, wanted)| (got - wanted).abs()).fold(0.0, f64::max);
        assert!(worst < ROUNDING, "{worst}");
    }

    /// Vortices between whom a force of known form holds the balance: $u = (\sin x \cos y, -\cos x \sin y)$, $f = 2 \mu u + \nabla p$ in units of the wave number.
    #[test]
    fn vortices_are_approached_with_second_order() {
        let error = |cells: usize| {
            let spacing = TAU / cells as f64;
            let grid = Grid::new([cells, cells, 4], spacing, Vector::zeros()).expect("enough cells");
            let exact = |component: usize, place: &Vector| match component {
                0 => place.x.sin() * place.y.cos(),
                1 => -place.x.cos() * place.y.sin(),
                _ => 0.0,
            };
            let slope = |component: usize, place: &Vector| match component {
                0 => 3.0 * (3.0 * place.x).cos(),
                _ => 0.0,
            };
            let mut velocity =
                FaceField::from_fn(&grid, |component, place| 2.0 * 1.3 * exact(component, &place) + slope(component, &place));
            PeriodicBox::new(grid).solve_stokes(&mut velocity, 1.3, 0.0, Vector::zeros());
            let wanted = FaceField::from_fn(&grid, |component, place| exact(component, &place));
            let values = velocity.component.iter().flatten().zip(wanted.component.iter().flatten());
            values.map(|(got, wanted)| (got - wanted).abs()).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(12), error(24));
        let order = (coarse / fine).log2();
        // One cell turns the phase by 0.52: the symbol is off by a twelfth of its square.
        assert!((coarse / (0.52_f64.powi(2) / 12.0) - 1.0).abs() < 0.1, "{coarse}");
        assert!((order - 2.0).abs() < 0.05, "{order}");
    }

    #[cfg(feature = "threads")]
    #[test]
    fn flows_are_bitwise_the_same_on_any_number_of_threads() {
        let grid = Grid::new([18, 15, 20], 0.1, Vector::zeros()).expect("enough cells");
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
            pool.install(|| {
                let mut velocity = wavy(&grid);
                PeriodicBox::new(grid).solve_stokes(&mut velocity, 0.7, 0.0, Vector::x());
                velocity.component.map(|values| values.into_iter().map(f64::to_bits).collect::<Vec<u64>>())
            })
        };
        let alone = run(1);
        assert!(run(2) == alone && run(3) == alone && run(7) == alone);
    }
}
