//! Classical Runge-Kutta of fourth order for the quaternion of a free body: a reference, not symplectic.

use nalgebra::Quaternion;

use super::RotationIntegrator;
use crate::bodies::angular_velocity;
use crate::{Orientation, Vector};

/// Classical Runge-Kutta of fourth order; angular momentum is kept exactly, energy is not.
pub struct RungeKutta4;

impl RotationIntegrator for RungeKutta4 {
    fn turn(&self, orientation: &mut Orientation, angular_momentum: &mut Vector, inertia: &Vector, step: f64) {
        // q' = (0, omega) q / 2 with omega in the world frame.
        let rate = |quaternion: Quaternion<f64>| {
            let spin = angular_velocity(&Orientation::new_normalize(quaternion), angular_momentum, inertia);
            Quaternion::from_imag(spin) * quaternion * 0.5
        };
        let start = *orientation.quaternion();
        let first = rate(start);
        let second = rate(start + first * (0.5 * step));
        let third = rate(start + second * (0.5 * step));
        let fourth = rate(start + third * step);
        let next = start + (first + second * 2.0 + third * 2.0 + fourth) * (step / 6.0);
        *orientation = Orientation::new_normalize(next);
    }

    fn name(&self) -> &'static str {
        "classical Runge-Kutta, fourth order"
    }
}
