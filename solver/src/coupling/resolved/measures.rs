//! What is read off a flow past bodies: void fraction, pressure and velocity layer by layer (R eq. 7.29 to 7.31), and tortuosity (R eq. 7.32).
//!
//! R's mean void fraction counts what lies in the domain of the particles, which is the solid, and its mean pressure is a sum of pressures over a sum of volumes
//! (errata): here the fluid counts, and pressures are weighted by the volumes of fluid that they stand for.

#[cfg(test)]
mod tests;

use super::immersed::{ImmersedBody, ImmersionError};
use crate::Vector;
use crate::fluid::grid::{FaceField, Grid};
use crate::fluid::operators::divergence;
use crate::fluid::periodic::PeriodicBox;

/// Which part of each cell is fluid.
#[derive(Debug, Clone, PartialEq)]
pub struct FluidShare {
    grid: Grid,
    /// $\delta$ of R eq. 7.30 as a part of the volume of each cell.
    share: Vec<f64>,
    /// The share of cells whose middles lie in the fluid; nothing elsewhere, where pressure and velocity are those of no fluid.
    weight: Vec<f64>,
}

impl FluidShare {
    /// The share of the fluid among some bodies. A cell that a surface cuts counts by the distance of its middle, as if the surface were flat there and square
    /// to an edge: what is left falls with the square of the spacing.
    ///
    /// # Errors
    ///
    /// [`ImmersionError`] if a body is nowhere or too large for the box.
    pub fn new(grid: &Grid, bodies: &[ImmersedBody]) -> Result<FluidShare, ImmersionError> {
        let extent = grid.extent();
        let (mut share, mut is_fluid) = (vec![1.0_f64; grid.len()], vec![true; grid.len()]);
        for (number, body) in bodies.iter().enumerate() {
            body.check(number, &extent)?;
            for (index, place) in body.values_near(grid, None) {
                let distance = body.nearest(&place, &extent).1.distance / grid.spacing();
                share[index] -= (0.5 - distance).clamp(0.0, 1.0);
                is_fluid[index] &= distance > 0.0;
            }
        }
        share.iter_mut().for_each(|share| *share = share.max(0.0));
        let weight = share.iter().zip(is_fluid).map(|(share, is_fluid)| if is_fluid { *share } else { 0.0 }).collect();
        Ok(FluidShare { grid: *grid, share, weight })
    }

    /// The share of each cell, from nothing to one.
    pub fn shares(&self) -> &[f64] {
        &self.share
    }

    /// Void fraction of the whole box.
    pub fn void_fraction(&self) -> f64 {
        self.share.iter().sum::<f64>() / self.share.len() as f64
    }

    /// Void fraction of each layer of cells across a direction (R eq. 7.29).
    pub fn void_fraction_by_layers(&self, direction: usize) -> Vec<f64> {
        let (sums, cells) = (self.sums_by_layers(direction, |index| self.share[index]), self.cells_of_a_layer(direction));
        sums.into_iter().map(|sum| sum / cells).collect()
    }

    /// Mean over the fluid of each layer of cells across a direction of values in the middles of cells, such as pressures (R eq. 7.31). Not a number for a layer
    /// without fluid.
    pub fn mean_by_layers(&self, values: &[f64], direction: usize) -> Vec<f64> {
        let sums = self.sums_by_layers(direction, |index| self.weight[index] * values[index]);
        sums.into_iter().zip(self.sums_by_layers(direction, |index| self.weight[index])).map(|(sum, weight)| sum / weight).collect()
    }

    /// Mean velocity in m/s of each layer of cells across a direction, as if it filled the whole layer: that of the fluid times the void fraction.
    pub fn superficial_velocity_by_layers(&self, velocity: &FaceField, direction: usize) -> Vec<Vector> {
        let cells = self.cells_of_a_layer(direction);
        let along = [0, 1, 2].map(|component| {
            self.sums_by_layers(direction, |index| self.weight[index] * in_the_middle(&self.grid, velocity, index, component))
        });
        (0..self.grid.cells()[direction]).map(|layer| Vector::from_fn(|component, _| along[component][layer] / cells)).collect()
    }

    /// Tortuosity $\langle |v| \rangle / \langle v_z \rangle$ (R eq. 7.32) of the fluid in some layers across the direction of the flow: how much longer paths are
    /// than the layers are thick.
    pub fn tortuosity(&self, velocity: &FaceField, direction: usize, layers: std::ops::Range<usize>) -> f64 {
        let (mut speed, mut along) = (0.0, 0.0);
        for (index, weight) in self.weight.iter().enumerate() {
            if *weight > 0.0 && layers.contains(&self.grid.cell(index)[direction]) {
                let value = cell_velocity(&self.grid, velocity, index);
                speed += weight * value.norm();
                along += weight * value[direction];
            }
        }
        speed / along
    }

    fn cells_of_a_layer(&self, direction: usize) -> f64 {
        (self.grid.len() / self.grid.cells()[direction]) as f64
    }

    fn sums_by_layers(&self, direction: usize, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.grid.cells()[direction]];
        // Weights of nothing go with values of no fluid, which may be of any size.
        for index in (0..self.grid.len()).filter(|index| self.share[*index] > 0.0) {
            sums[self.grid.cell(index)[direction]] += value(index);
        }
        sums
    }
}

/// Velocity in m/s in the middle of a cell, from its six faces.
pub fn cell_velocity(grid: &Grid, velocity: &FaceField, index: usize) -> Vector {
    Vector::from_fn(|component, _| in_the_middle(grid, velocity, index, component))
}

fn in_the_middle(grid: &Grid, velocity: &FaceField, index: usize, component: usize) -> f64 {
    let values = &velocity.component[component];
    0.5 * (values[index] + values[grid.neighbour(grid.cell(index), component, 1)])
}

/// Pressure in Pa in the middles of cells from all force densities in N/m^3 on the fluid but friction: those of the constraint, of inertia, of a fringe.
///
/// In a flow without divergence friction has none either, so $\nabla^2 p = \nabla \cdot f$. The mean of the forces is borne by a mean pressure gradient: in a
/// direction with such a mean the pressure does not repeat, but falls or rises from the lower side of the box on. Its mean without that part is zero.
pub fn pressure(flow: &PeriodicBox, force: &FaceField) -> Vec<f64> {
    let (grid, gradient) = (flow.grid(), force.mean());
    let mut pressure = divergence(grid, force);
    flow.solve_poisson(&mut pressure);
    for (index, pressure) in pressure.iter_mut().enumerate() {
        let place = grid.position(None, grid.cell(index).map(|number| number as isize)) - grid.lower();
        *pressure += gradient.dot(&place);
    }
    pressure
}
