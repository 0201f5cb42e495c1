//! What is asked of the velocity, and the forces that may bring it about.

use crate::fluid::grid::FaceField;

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

    /// An approximate inverse of $J S^{-1} E$ for unit viscosity, cheap.
    fn precondition(&self, residual: &[f64]) -> Vec<f64>;

    /// Takes from forces or conditions the part that no flow can feel.
    fn project(&self, values: &mut [f64]);
}
