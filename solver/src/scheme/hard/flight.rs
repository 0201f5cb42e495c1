//! Free flight of a rigid body between two collisions, for as long as it lasts: no step, no error but rounding.
//!
//! The centre of mass falls in gravity, the angular momentum stays, the body turns by the free turn of its class: not at all where its
//! orientation does not matter, about a fixed axis if it is isotropic, by precession and spin if it is axisymmetric. Only bodies of three different
//! moments have no turn in elementary functions: they turn in short steps of the fourth-order splitting, whose error in energy is of the order of
//! $10^{-11}$ of the energy of rotation and does not grow with time.

use crate::bodies::angular_velocity;
use crate::contact::impulse::{CollidingBody, CollisionPoint};
use crate::motion::rotation::{Precession, RotationIntegrator, SplittingFourthOrder};
use crate::{Bodies, Orientation, Vector};

/// How a body turns while it is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    /// Nothing depends on its orientation.
    LeftOut,
    Isotropic,
    Axisymmetric,
    General,
}

/// Angle in rad by which a body of three different moments turns in one step of its integrator.
const ANGLE_OF_STEP: f64 = 0.005;
/// Angle in rad of one flight that can be followed in steps.
const LARGEST_ANGLE: f64 = 500.0;

/// The state of a free body at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    /// Time in s of all the rest.
    pub time: f64,
    /// Centre of mass in m.
    pub position: Vector,
    /// In m/s.
    pub velocity: Vector,
    /// From body to world.
    pub orientation: Orientation,
    /// About the centre of mass, world frame, in kg m^2/s.
    pub angular_momentum: Vector,
    /// Of gravity, in m/s^2.
    acceleration: Vector,
    /// Principal moments in kg m^2.
    inertia: Vector,
    inverse_mass: f64,
    turn: Turn,
}

impl Flight {
    /// A body at time zero. `turns` tells whether its orientation matters if it is isotropic.
    pub fn of(bodies: &Bodies, index: usize, gravity: Option<Vector>, turns: bool) -> Flight {
        let inertia = bodies.inertia(index);
        let is_axisymmetric = inertia.x == inertia.y || inertia.y == inertia.z || inertia.z == inertia.x;
        let turn = match (bodies.is_isotropic(index), is_axisymmetric) {
            (true, _) if turns => Turn::Isotropic,
            (true, _) => Turn::LeftOut,
            (false, true) => Turn::Axisymmetric,
            (false, false) => Turn::General,
        };
        Flight {
            time: 0.0,
            position: bodies.position(index),
            velocity: bodies.half_step_velocity(index),
            orientation: bodies.orientation(index),
            angular_momentum: bodies.half_step_angular_momentum(index),
            acceleration: gravity.unwrap_or_default(),
            inertia,
            inverse_mass: bodies.inverse_mass(index),
            turn,
        }
    }

    /// Writes the state back to the bodies.
    pub fn store(&self, bodies: &mut Bodies, index: usize) {
        let (spin, is_isotropic) = (self.spin(), bodies.is_isotropic(index));
        let motion = &mut bodies.state.motion[index];
        motion.position = self.position;
        motion.velocity = self.velocity;
        motion.acceleration = self.acceleration;
        if is_isotropic {
            motion.angular_velocity = spin;
        } else {
            bodies.state.angular_momentum[index] = self.angular_momentum;
        }
        bodies.state.orientation[index] = self.orientation;
    }

    /// The state at a later time in s.
    pub fn at(mut self, time: f64) -> Flight {
        let duration = time - self.time;
        (self.position, self.velocity) = self.centre_at(time);
        self.time = time;
        match self.turn {
            Turn::LeftOut => {}
            Turn::Isotropic => {
                self.orientation = Orientation::from_scaled_axis(self.spin() * duration) * self.orientation;
                self.orientation.renormalize_fast();
            }
            Turn::Axisymmetric => Precession.turn(&mut self.orientation, &mut self.angular_momentum, &self.inertia, duration),
            Turn::General => self.turn_in_steps(duration),
        }
        self
    }

    /// The angle in rad by which the body may turn in a time in s, if that is too far to be followed.
    pub fn too_far_a_turn(&self, duration: f64) -> Option<f64> {
        let angle = self.largest_spin() * duration;
        let is_followed = self.turn != Turn::General || angle <= LARGEST_ANGLE;
        (!is_followed).then_some(angle)
    }

    fn turn_in_steps(&mut self, duration: f64) {
        let angle = self.largest_spin() * duration.abs();
        let steps = (angle / ANGLE_OF_STEP).ceil().clamp(1.0, 2.0 * LARGEST_ANGLE / ANGLE_OF_STEP);
        for _ in 0..steps as u64 {
            SplittingFourthOrder.turn(&mut self.orientation, &mut self.angular_momentum, &self.inertia, duration / steps);
        }
    }

    /// Angular velocity in rad/s, world frame.
    pub fn spin(&self) -> Vector {
        angular_velocity(&self.orientation, &self.angular_momentum, &self.inertia)
    }

    /// Bound in rad/s on the angular velocity for as long as the body is free: it is constant but for bodies of three different moments.
    pub fn largest_spin(&self) -> f64 {
        let spin = self.spin();
        match self.turn {
            Turn::General => (spin.dot(&self.angular_momentum) / self.inertia.min()).sqrt(),
            _ => spin.norm(),
        }
    }

    /// Centre of mass in m and its velocity in m/s at a later time.
    pub fn centre_at(&self, time: f64) -> (Vector, Vector) {
        let duration = time - self.time;
        let position = self.position + (self.velocity + self.acceleration * (0.5 * duration)) * duration;
        (position, self.velocity + self.acceleration * duration)
    }

    /// Velocity in m/s of the material point at the end of an arm.
    pub fn velocity_at(&self, arm: &Vector) -> Vector {
        self.velocity + self.spin().cross(arm)
    }

    /// Of gravity, in m/s^2.
    pub fn acceleration(&self) -> Vector {
        self.acceleration
    }

    /// The body as a collision sees it.
    pub fn colliding(&self) -> CollidingBody {
        let rotation = self.orientation.to_rotation_matrix();
        let inverse_moments = nalgebra::Matrix3::from_diagonal(&self.inertia.map(|moment| 1.0 / moment));
        CollidingBody {
            velocity: self.velocity,
            spin: self.spin(),
            inverse_mass: self.inverse_mass,
            inverse_inertia: rotation.matrix() * inverse_moments * rotation.matrix().transpose(),
        }
    }

    /// Takes an impulse in N s at the end of an arm in m.
    pub fn take(&mut self, impulse: &Vector, arm: &Vector) {
        self.velocity += impulse * self.inverse_mass;
        self.angular_momentum += arm.cross(impulse);
    }
}

/// Rate in m/s at which two bodies, or a body and a wall, approach at a point.
pub fn approach_rate(first: &Flight, second: Option<&Flight>, point: &CollisionPoint) -> f64 {
    let of_second = second.map_or_else(Vector::zeros, |second| second.velocity_at(&point.arm_of_second));
    (first.velocity_at(&point.arm_of_first) - of_second).dot(&point.normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::BodySpecification;
    use crate::shape::{Convex, Cuboid, Cylinder};
    use crate::test_bodies;

    fn thrown(convex: Convex) -> Flight {
        let bodies = Bodies::new(vec![BodySpecification {
            position: Vector::new(1.0, 2.0, 3.0),
            velocity: Vector::new(0.5, 0.0, 4.0),
            orientation: Orientation::from_euler_angles(0.4, -0.3, 1.2),
            angular_velocity: Vector::new(3.0, -2.0, 1.0),
            ..test_bodies::at_rest(convex, 2.0)
        }]);
        Flight::of(&bodies, 0, Some(Vector::new(0.0, 0.0, -10.0)), true)
    }

    fn shapes() -> [Convex; 3] {
        let cuboid = |x, y, z| Convex::Cuboid(Cuboid { lengths: Vector::new(x, y, z) });
        [cuboid(1.0, 1.0, 1.0), Convex::Cylinder(Cylinder { radius: 0.5, length: 2.0 }), cuboid(1.0, 1.5, 2.5)]
    }

    /// Closed form of the fall; energy and momentum of the turn over some four hundred revolutions.
    #[test]
    fn a_flight_falls_by_the_parabola_and_keeps_energy_of_rotation_and_momentum() {
        for (convex, rounding) in shapes().into_iter().zip([1e-14, 1e-14, 2e-11]) {
            let start = thrown(convex);
            let energy = |flight: &Flight| flight.spin().dot(&flight.angular_momentum);
            let mut flight = start;
            for leap in 1..=1000 {
                flight = flight.at(0.7 * f64::from(leap));
            }
            assert!((flight.position - Vector::new(351.0, 2.0, 3.0 + 4.0 * 700.0 - 5.0 * 490_000.0)).norm() < 1e-6);
            assert_eq!(flight.angular_momentum, start.angular_momentum);
            assert!((energy(&flight) / energy(&start) - 1.0).abs() < 32.0 * rounding, "{}", energy(&flight) / energy(&start) - 1.0);
            assert!(flight.spin().norm() <= start.largest_spin() * (1.0 + 1e-12));
        }
    }

    /// Two flights of half the time are one of the whole: what the search for collisions relies on.
    #[test]
    fn where_a_flight_is_cut_does_not_show() {
        for convex in shapes() {
            let start = thrown(convex);
            let (whole, halves) = (start.at(1.3), start.at(0.4).at(1.3));
            assert!(whole.orientation.angle_to(&halves.orientation) < 1e-10);
            assert!((whole.position - halves.position).norm() < 1e-14);
        }
    }
}
