//! Leapfrog for the centre of mass, and for the spin of isotropic bodies (R eq. 3.13).
//!
//! $v(t + \Delta t/2) = v(t - \Delta t/2) + a(t)\,\Delta t$, then $x(t + \Delta t) = x(t) + v(t + \Delta t/2)\,\Delta t$. The first kick of
//! a run is half as long, because initial velocities belong to the time of the initial positions.

use crate::{Bodies, Vector};

/// Length of the kick in s: half a step if velocities still live at the time of the positions.
#[inline]
pub fn kick_length(step: f64, synchronous: bool) -> f64 {
    if synchronous { 0.5 * step } else { step }
}

/// Moves all centres of mass by one step under the forces on them and gravity; returns the square of the largest speed in m^2/s^2.
pub fn move_centres(bodies: &mut Bodies, gravity: Option<Vector>, step: f64, synchronous: bool) -> f64 {
    let kick = kick_length(step, synchronous);
    let mut largest = 0.0_f64;
    for (body, force) in bodies.state.motion.iter_mut().zip(&bodies.state.force) {
        let mut acceleration = force * body.inverse_mass;
        if let Some(gravity) = gravity {
            acceleration += gravity;
        }
        body.velocity += acceleration * kick;
        body.position += body.velocity * step;
        body.acceleration = acceleration;
        largest = largest.max(body.velocity.norm_squared());
    }
    largest
}
