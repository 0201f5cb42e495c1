//! Leapfrog for the centre of mass, and for the spin of isotropic bodies (R eq. 3.13).
//!
//! $v(t + \Delta t/2) = v(t - \Delta t/2) + a(t)\,\Delta t$, then $x(t + \Delta t) = x(t) + v(t + \Delta t/2)\,\Delta t$. The first kick of
//! a run is half as long, because initial velocities belong to the time of the initial positions.

use crate::bodies::{Motion, State};
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
        largest = largest.max(body.move_centre(force, gravity, step, kick));
    }
    largest
}

/// The same with the spins of all bodies, which are isotropic: one pass over memory instead of two.
pub fn move_centres_and_spins(bodies: &mut Bodies, gravity: Option<Vector>, step: f64, synchronous: bool) -> f64 {
    let kick = kick_length(step, synchronous);
    let mut largest = 0.0_f64;
    let State { motion, force, torque, .. } = &mut bodies.state;
    for ((body, force), torque) in motion.iter_mut().zip(&*force).zip(&*torque) {
        largest = largest.max(body.move_centre(force, gravity, step, kick));
        body.kick_spin(torque, kick);
    }
    largest
}

impl Motion {
    /// Kicks and moves the centre; returns the square of the speed.
    #[inline(always)]
    fn move_centre(&mut self, force: &Vector, gravity: Option<Vector>, step: f64, kick: f64) -> f64 {
        let mut acceleration = force * self.inverse_mass;
        if let Some(gravity) = gravity {
            acceleration += gravity;
        }
        self.velocity += acceleration * kick;
        self.position += self.velocity * step;
        self.acceleration = acceleration;
        self.velocity.norm_squared()
    }

    /// Kicks the spin of an isotropic body.
    #[inline(always)]
    pub(super) fn kick_spin(&mut self, torque: &Vector, kick: f64) {
        let acceleration = torque * self.inverse_inertia;
        self.angular_velocity += acceleration * kick;
        self.angular_acceleration = acceleration;
    }
}
