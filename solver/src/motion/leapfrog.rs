//! Leapfrog for the centre of mass, and for the spin of isotropic bodies (R eq. 3.13).
//!
//! $v(t + \Delta t/2) = v(t - \Delta t/2) + a(t)\,\Delta t$, then $x(t + \Delta t) = x(t) + v(t + \Delta t/2)\,\Delta t$. The first kick of
//! a run is half as long, because initial velocities belong to the time of the initial positions.

use pulp::Arch;

use crate::bodies::{Motion, State};
use crate::{Bodies, Vector, parallel};

/// Length of the kick in s: half a step if velocities still live at the time of the positions.
#[inline]
pub fn kick_length(step: f64, synchronous: bool) -> f64 {
    if synchronous { 0.5 * step } else { step }
}

/// Bodies that are worth a thread of their own.
const BODIES_OF_A_PART: usize = 1000;

/// Moves all centres of mass by one step under the forces on them and gravity; returns the square of the largest speed in m^2/s^2.
pub fn move_centres(bodies: &mut Bodies, gravity: Option<Vector>, step: f64, synchronous: bool) -> f64 {
    let kick = kick_length(step, synchronous);
    let State { motion, force, .. } = &mut bodies.state;
    let length = parallel::length_of_part(motion.len(), BODIES_OF_A_PART);
    let parts = motion.chunks_mut(length).zip(force.chunks(length));
    largest_of_parts(
        parts.collect(),
        #[inline(always)]
        |(motion, force)| {
            let moved = motion.iter_mut().zip(*force).map(|(body, force)| body.move_centre(force, gravity, step, kick));
            moved.fold(0.0, f64::max)
        },
    )
}

/// The same with the spins of all bodies, which are isotropic: one pass over memory instead of two.
pub fn move_centres_and_spins(bodies: &mut Bodies, gravity: Option<Vector>, step: f64, synchronous: bool) -> f64 {
    let kick = kick_length(step, synchronous);
    let State { motion, force, torque, .. } = &mut bodies.state;
    let length = parallel::length_of_part(motion.len(), BODIES_OF_A_PART);
    let parts = motion.chunks_mut(length).zip(force.chunks(length)).zip(torque.chunks(length));
    largest_of_parts(
        parts.collect(),
        #[inline(always)]
        |((motion, force), torque)| {
            let moved = motion.iter_mut().zip(*force).zip(*torque).map(|((body, force), torque)| {
                body.kick_spin(torque, kick);
                body.move_centre(force, gravity, step, kick)
            });
            moved.fold(0.0, f64::max)
        },
    )
}

/// The largest of what a function returns for each part.
fn largest_of_parts<Part: Send>(mut parts: Vec<Part>, function: impl Fn(&mut Part) -> f64 + Sync + Send) -> f64 {
    // Compiled for each kind of registers: see `contact/sphere_lanes.rs`.
    let moved = |_, part: &mut Part| {
        Arch::new().dispatch(
            #[inline(always)]
            || function(part),
        )
    };
    parallel::map(&mut parts, moved).into_iter().fold(0.0, f64::max)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Convex, Sphere};
    use crate::test_bodies::at_rest;

    /// More bodies than one thread gets, the fastest among the last: every one moves by its own force, however many threads there are.
    #[cfg(feature = "threads")]
    #[test]
    fn all_bodies_move_on_any_number_of_threads() {
        let count = 2 * BODIES_OF_A_PART + 7;
        let moved = |threads: usize| {
            let body = |id| crate::bodies::BodySpecification { id: id as u32, ..at_rest(Convex::Sphere(Sphere { radius: 1.0 }), 2.0) };
            let mut bodies = Bodies::new((0..count).map(body).collect());
            for (index, force) in bodies.state.force.iter_mut().enumerate() {
                *force = Vector::x() * index as f64;
            }
            let torque = bodies.state.force.clone();
            bodies.state.torque = torque;
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
            let largest = pool.install(|| move_centres_and_spins(&mut bodies, None, 0.1, false));
            let largest_without_spins = pool.install(|| move_centres(&mut bodies, None, 0.1, false));
            (bodies.state.motion, largest, largest_without_spins)
        };
        let (alone, largest, _) = moved(1);
        assert!((largest.sqrt() - 0.1 * (count - 1) as f64 / 2.0).abs() < 1e-9);
        assert!(alone.iter().enumerate().all(|(index, body)| (body.velocity.x - 0.1 * index as f64).abs() < 1e-9));
        for threads in [2, 3] {
            assert_eq!(moved(threads), moved(1));
        }
    }
}
