//! Rotation as S does it: angular velocity by explicit Euler in the world frame, then one turn about its direction (S eq. 2.8-2.15).
//!
//! Errata: S eq. 3.49 sets $I \dot\omega$ equal to the torque; in the world frame the inertia turns with the body and
//! $I \dot\omega + \omega \times I \omega = T$. Without the gyroscopic term the length of the angular momentum changes by 42 % in the example of the errata list.
//! S eq. 2.14 prints a matrix that is not orthogonal; the quaternion itself is used here.

use super::RotationIntegrator;
use crate::bodies::angular_velocity;
use crate::{Orientation, Vector};

/// With the gyroscopic term: first order, neither momentum nor energy are kept.
pub struct ExplicitEuler;

/// Without it, as printed: does not converge for bodies that are not isotropic.
pub struct ExplicitEulerAsPrinted;

impl RotationIntegrator for ExplicitEuler {
    fn turn(&self, orientation: &mut Orientation, angular_momentum: &mut Vector, inertia: &Vector, step: f64) {
        let spin = angular_velocity(orientation, angular_momentum, inertia);
        // The rate of the angular velocity of a free body is the inverse inertia times minus the gyroscopic torque.
        let rate = angular_velocity(orientation, &-spin.cross(angular_momentum), inertia);
        turn_and_set(orientation, angular_momentum, inertia, spin, spin + rate * step, step);
    }

    fn name(&self) -> &'static str {
        "explicit Euler of S"
    }
}

impl RotationIntegrator for ExplicitEulerAsPrinted {
    fn turn(&self, orientation: &mut Orientation, angular_momentum: &mut Vector, inertia: &Vector, step: f64) {
        let spin = angular_velocity(orientation, angular_momentum, inertia);
        turn_and_set(orientation, angular_momentum, inertia, spin, spin, step);
    }

    fn name(&self) -> &'static str {
        "explicit Euler of S as printed, without gyroscopic term"
    }
}

fn turn_and_set(orientation: &mut Orientation, momentum: &mut Vector, inertia: &Vector, spin: Vector, next: Vector, step: f64) {
    *orientation = Orientation::from_scaled_axis(spin * step) * *orientation;
    *momentum = *orientation * (orientation.inverse() * next).component_mul(inertia);
}
