//! The exact free turn of an axisymmetric body: precession about the angular momentum and spin about its own axis.

use super::RotationIntegrator;
use crate::{Orientation, Vector};

/// Exact for bodies two of whose principal moments are equal.
pub struct Precession;

impl RotationIntegrator for Precession {
    fn turn(&self, orientation: &mut Orientation, angular_momentum: &mut Vector, inertia: &Vector, step: f64) {
        let axis = symmetry_axis(inertia);
        let transverse = inertia[(axis + 1) % 3];
        let momentum_along_axis = (orientation.inverse() * *angular_momentum)[axis];
        let precession = Orientation::from_scaled_axis(*angular_momentum * (step / transverse));
        let mut spin = Vector::zeros();
        spin[axis] = step * momentum_along_axis * (1.0 / inertia[axis] - 1.0 / transverse);
        *orientation = precession * *orientation * Orientation::from_scaled_axis(spin);
        orientation.renormalize_fast();
    }

    fn name(&self) -> &'static str {
        "exact precession and spin of axisymmetric bodies"
    }
}

/// The body axis whose two companions have equal moments.
fn symmetry_axis(inertia: &Vector) -> usize {
    (0..3).find(|axis| inertia[(axis + 1) % 3] == inertia[(axis + 2) % 3]).unwrap_or(2)
}
