//! Exact inverses of the difference operators of a box that repeats: pressure, and velocity and pressure of creeping flow, by Fourier transform.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use super::grid::{FaceField, Grid};
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
