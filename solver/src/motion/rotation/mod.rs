//! How bodies turn.
//!
//! Between two kicks a body is free: it turns with constant angular momentum. A rotation integrator is an approximation of that
//! free turn over one step; torques change the angular momentum in the kicks. Bodies fall in three classes, resolved when a scene is built:
//! isotropic ones (spheres, cubes) keep their spin and need an orientation only if somebody looks; axisymmetric ones turn exactly
//! by precession and spin; all others use the integrator of the scene.

mod explicit_euler;
mod precession;
mod runge_kutta;
mod splitting;

pub use explicit_euler::{ExplicitEuler, ExplicitEulerAsPrinted};
pub use precession::Precession;
pub use runge_kutta::RungeKutta4;
pub use splitting::{Splitting, SplittingFourthOrder};

use super::leapfrog::kick_length;
use crate::bodies::angular_velocity;
use crate::{Bodies, Orientation, Vector};

/// A free turn over one step.
pub trait RotationIntegrator: Send + Sync {
    /// Advances orientation (body to world) and angular momentum (world frame) of a free body of given principal inertia.
    fn turn(&self, orientation: &mut Orientation, angular_momentum: &mut Vector, inertia: &Vector, step: f64);
    /// Name for the ledger.
    fn name(&self) -> &'static str;
}

/// Turns bodies of one class.
pub trait RotationStage: Send + Sync {
    /// Kicks and turns by one step.
    fn turn(&mut self, bodies: &mut Bodies, step: f64, synchronous: bool);
    /// Name for the ledger.
    fn name(&self) -> String;
    /// Turns made since the start.
    fn turns(&self) -> u64;
    /// Sets the number of turns, when a run resumes.
    fn set_turns(&mut self, turns: u64);
    /// Whether it does nothing but kick the spins of all bodies, and so may be done together with their centres.
    fn kicks_all_spins(&self, _bodies: &Bodies) -> bool {
        false
    }
    /// Finds its bodies again after they have been stored in another order.
    fn find_members(&mut self, bodies: &Bodies);
}

/// Bodies that turn in the same way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turning {
    /// All three moments of inertia are equal.
    Isotropic,
    /// Two are.
    Axisymmetric,
    /// No two are.
    General,
    /// At most two are: without the shortcut for axisymmetric bodies.
    NotIsotropic,
}

impl Turning {
    /// Storage indices of all such bodies.
    pub fn members(self, bodies: &Bodies) -> Vec<u32> {
        (0..bodies.len()).filter(|index| self.holds(&bodies.inertia(*index))).map(|index| index as u32).collect()
    }

    fn holds(self, inertia: &Vector) -> bool {
        let is_isotropic = inertia.x == inertia.y && inertia.y == inertia.z;
        let is_axisymmetric = !is_isotropic && (inertia.x == inertia.y || inertia.y == inertia.z || inertia.z == inertia.x);
        match self {
            Turning::Isotropic => is_isotropic,
            Turning::Axisymmetric => is_axisymmetric,
            Turning::General => !is_isotropic && !is_axisymmetric,
            Turning::NotIsotropic => !is_isotropic,
        }
    }
}

/// Spin of isotropic bodies, and their orientation if somebody looks.
pub struct IsotropicSpin {
    members: Vec<u32>,
    with_orientation: bool,
    turns: u64,
}

impl IsotropicSpin {
    /// A stage for all isotropic bodies.
    pub fn new(bodies: &Bodies, with_orientation: bool) -> IsotropicSpin {
        IsotropicSpin { members: Turning::Isotropic.members(bodies), with_orientation, turns: 0 }
    }
}

impl RotationStage for IsotropicSpin {
    fn turn(&mut self, bodies: &mut Bodies, step: f64, synchronous: bool) {
        let kick = kick_length(step, synchronous);
        for &index in &self.members {
            let state = &mut bodies.state;
            let index = index as usize;
            let body = &mut state.motion[index];
            body.kick_spin(&state.torque[index], kick);
            if self.with_orientation {
                let turn = Orientation::from_scaled_axis(body.angular_velocity * step);
                state.orientation[index] = turn * state.orientation[index];
                state.orientation[index].renormalize_fast();
            }
        }
        self.turns += self.members.len() as u64;
    }

    fn name(&self) -> String {
        let orientation = if self.with_orientation { "with orientation" } else { "no orientation: nothing asks for it" };
        format!("spin of isotropic bodies, {orientation}")
    }

    fn turns(&self) -> u64 {
        self.turns
    }

    fn kicks_all_spins(&self, bodies: &Bodies) -> bool {
        !self.with_orientation && self.members.len() == bodies.len()
    }

    fn set_turns(&mut self, turns: u64) {
        self.turns = turns;
    }

    fn find_members(&mut self, bodies: &Bodies) {
        self.members = Turning::Isotropic.members(bodies);
    }
}

/// Rotation of bodies by an integrator.
pub struct FreeTurns<Integrator> {
    turning: Turning,
    members: Vec<u32>,
    integrator: Integrator,
    turns: u64,
}

impl<Integrator: RotationIntegrator> FreeTurns<Integrator> {
    /// A stage for all bodies that turn in a way.
    pub fn new(bodies: &Bodies, turning: Turning, integrator: Integrator) -> FreeTurns<Integrator> {
        FreeTurns { turning, members: turning.members(bodies), integrator, turns: 0 }
    }
}

impl<Integrator: RotationIntegrator> RotationStage for FreeTurns<Integrator> {
    fn turn(&mut self, bodies: &mut Bodies, step: f64, synchronous: bool) {
        let kick = kick_length(step, synchronous);
        for &index in &self.members {
            let index = index as usize;
            let inertia = bodies.inertia(index);
            let state = &mut bodies.state;
            state.angular_momentum[index] += state.torque[index] * kick;
            state.motion[index].angular_acceleration = angular_velocity(&state.orientation[index], &state.torque[index], &inertia);
            self.integrator.turn(&mut state.orientation[index], &mut state.angular_momentum[index], &inertia, step);
        }
        self.turns += self.members.len() as u64;
    }

    fn name(&self) -> String {
        self.integrator.name().to_string()
    }

    fn turns(&self) -> u64 {
        self.turns
    }

    fn set_turns(&mut self, turns: u64) {
        self.turns = turns;
    }

    fn find_members(&mut self, bodies: &Bodies) {
        self.members = self.turning.members(bodies);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotational_energy(orientation: &Orientation, momentum: &Vector, inertia: &Vector) -> f64 {
        0.5 * angular_velocity(orientation, momentum, inertia).dot(momentum)
    }

    /// Orientation after a time by a step a thousand times finer: independent of closed forms, enough to see orders.
    fn error_after(integrator: &dyn RotationIntegrator, steps: usize) -> f64 {
        let inertia = Vector::new(1.0, 2.0, 2.5);
        let run = |integrator: &dyn RotationIntegrator, steps: usize| {
            let mut orientation = Orientation::identity();
            let mut momentum = Vector::new(0.6, -0.4, 2.0);
            for _ in 0..steps {
                integrator.turn(&mut orientation, &mut momentum, &inertia, 4.0 / steps as f64);
            }
            orientation
        };
        run(integrator, steps).angle_to(&run(&RungeKutta4, 4000))
    }

    fn observed_order(integrator: &dyn RotationIntegrator) -> f64 {
        (error_after(integrator, 40) / error_after(integrator, 80)).log2()
    }

    #[test]
    fn integrators_have_their_orders() {
        for (integrator, order) in
            [(&ExplicitEuler as &dyn RotationIntegrator, 1.0), (&Splitting, 2.0), (&SplittingFourthOrder, 4.0), (&RungeKutta4, 4.0)]
        {
            let observed = observed_order(integrator);
            assert!((observed - order).abs() < 0.25, "{}: {observed}", integrator.name());
        }
        assert!(observed_order(&ExplicitEulerAsPrinted).abs() < 0.1, "without the gyroscopic term nothing converges");
    }

    #[test]
    fn splitting_keeps_angular_momentum_exactly_and_energy_bounded() {
        let inertia = Vector::new(1.0, 2.0, 2.5);
        let (mut orientation, start) = (Orientation::identity(), Vector::new(0.6, -0.4, 2.0));
        let mut momentum = start;
        let energy = rotational_energy(&orientation, &momentum, &inertia);
        let mut worst: f64 = 0.0;
        for _ in 0..10_000 {
            Splitting.turn(&mut orientation, &mut momentum, &inertia, 0.1);
            worst = worst.max((rotational_energy(&orientation, &momentum, &inertia) / energy - 1.0).abs());
        }
        assert_eq!(momentum, start);
        // Shadow energy differs by O((spin x step)^2) = O(0.01).
        assert!(worst < 0.01, "{worst}");
    }

    #[test]
    fn precession_is_exact_for_every_axis_of_symmetry() {
        for inertia in [Vector::new(1.0, 1.0, 0.4), Vector::new(0.4, 1.0, 1.0), Vector::new(1.0, 0.4, 1.0)] {
            let (mut exact, mut reference) = (Orientation::from_euler_angles(0.1, 0.2, 0.3), Orientation::from_euler_angles(0.1, 0.2, 0.3));
            let mut momentum = Vector::new(0.6, -0.4, 2.0);
            Precession.turn(&mut exact, &mut momentum, &inertia, 3.0);
            for _ in 0..3000 {
                RungeKutta4.turn(&mut reference, &mut momentum, &inertia, 1e-3);
            }
            // Fourth order at a step of 1e-3 and a spin of about 5: (5e-3)^4 over 3000 steps / 120 is about 1e-11.
            assert!(exact.angle_to(&reference) < 1e-10, "{inertia:?}: {}", exact.angle_to(&reference));
        }
    }
}
