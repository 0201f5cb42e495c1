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

/// Moves all centres of mass by one step under the forces on them and gravity.
pub fn move_centres(bodies: &mut Bodies, gravity: Option<Vector>, step: f64, synchronous: bool) {
    let kick = kick_length(step, synchronous);
    let (inverse_masses, motion) = bodies.inverse_masses_and_motion();
    let forces = motion.force.iter().zip(inverse_masses);
    let state = motion.position.iter_mut().zip(&mut motion.velocity).zip(&mut motion.acceleration);
    for (((position, velocity), last_acceleration), (force, inverse_mass)) in state.zip(forces) {
        let mut acceleration = force * *inverse_mass;
        if let Some(gravity) = gravity {
            acceleration += gravity;
        }
        *velocity += acceleration * kick;
        *position += *velocity * step;
        *last_acceleration = acceleration;
    }
}
