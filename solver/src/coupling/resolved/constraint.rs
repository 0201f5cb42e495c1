//! What is asked of the velocity, and the forces that may bring it about.

use serde::{Deserialize, Serialize};

use crate::Vector;
use crate::fluid::grid::{FaceField, Grid};

/// A rigid motion imposed on a flow: forces act on some values of the velocity, conditions are asked of others.
///
/// There are as many forces as conditions. With $E$ spreading the forces and $J$ taking the velocity where it is asked for, the steady problem is
/// $J S^{-1} E \lambda = u_{rigid} - J u_{mean}$, where $S^{-1}$ is the exact inverse of the flow without bodies.
pub trait Constraint: Send + Sync {
    /// Number of forces, and of conditions.
    fn len(&self) -> usize;

    /// Whether there is nothing to impose.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// $E$: adds force densities in N/m^3 where they act.
    fn spread(&self, forces: &[f64], onto: &mut FaceField);

    /// $J$: the velocity in m/s as the conditions see it.
    fn sample(&self, velocity: &FaceField) -> Vec<f64>;

    /// What the conditions ask for, in m/s.
    fn wanted(&self) -> &[f64];

    /// What the forces do to each of so many bodies.
    fn loads(&self, forces: &[f64], bodies: usize) -> Vec<Load>;

    /// Whether forces are spread with the weights of the conditions, so that $J S^{-1} E$ is symmetric and conjugate gradients solve it.
    fn is_symmetric(&self) -> bool;

    /// An approximate inverse of $J S^{-1} E$ for unit viscosity, cheap.
    fn precondition(&self, residual: &[f64]) -> Vec<f64>;

    /// Takes from forces or conditions the part that no flow can feel.
    fn project(&self, values: &mut [f64]);
}

/// What the fluid does to a body: the opposite of the forces that hold the fluid to its motion.
///
/// A body at rest in a steady flow feels no more than this; one that accelerates also what the fluid that fills it takes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// In N.
    pub force: Vector,
    /// About the centre, in N m.
    pub torque: Vector,
}

/// Sums force densities in N/m^3, each on a component at an arm in m from the centre of its body.
pub(super) fn sum_loads(grid: &Grid, bodies: usize, acting: impl Iterator<Item = (u32, usize, Vector)>, forces: &[f64]) -> Vec<Load> {
    let volume = grid.spacing().powi(3);
    let mut loads = vec![Load::default(); bodies];
    for ((body, component, arm), density) in acting.zip(forces) {
        let mut force = Vector::zeros();
        force[component] = -density * volume;
        let load = &mut loads[body as usize];
        load.force += force;
        load.torque += arm.cross(&force);
    }
    loads
}
