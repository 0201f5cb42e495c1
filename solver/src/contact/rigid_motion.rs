//! Motion of rigid bodies of any inertia at their contact points, and the masses they show there.

use nalgebra::Matrix3;

use super::Touch;
use super::force::RelativeMotion;
use super::law::StepKind;
use crate::{Bodies, Vector};

/// A body as its contacts see it during one step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RigidMotion {
    /// From the frame of the body to the world.
    pub(super) rotation: Matrix3<f64>,
    velocity: Vector,
    acceleration: Vector,
    spin: Vector,
    spin_rate: Vector,
    /// How fast the spin changes without any torque, because the body turns against its momentum, in rad/s^2.
    free_spin_rate: Vector,
    /// One over the mass, in 1/kg.
    pub(super) inverse_mass: f64,
    /// World frame, in 1/(kg m^2).
    inverse_inertia: Matrix3<f64>,
}

impl RigidMotion {
    /// The motion of a body.
    pub(super) fn of(bodies: &Bodies, index: usize) -> RigidMotion {
        let motion = &bodies.state.motion[index];
        let rotation = rotation_of(bodies, index);
        let (inverse_inertia, spin, free_spin_rate) = if bodies.is_isotropic(index) {
            (Matrix3::from_diagonal_element(motion.inverse_inertia), motion.angular_velocity, Vector::zeros())
        } else {
            let inverse_moments = bodies.inertia(index).map(|moment| 1.0 / moment);
            let inverse_inertia = rotation * Matrix3::from_diagonal(&inverse_moments) * rotation.transpose();
            // Momentum half a step ago, inertia now: the turn of the body in between is in the spin already.
            let momentum = bodies.state.angular_momentum[index];
            let spin = inverse_inertia * momentum;
            (inverse_inertia, spin, inverse_inertia * momentum.cross(&spin))
        };
        RigidMotion {
            rotation,
            velocity: motion.velocity,
            acceleration: motion.acceleration,
            spin,
            spin_rate: motion.angular_acceleration,
            free_spin_rate,
            inverse_mass: motion.inverse_mass,
            inverse_inertia,
        }
    }

    /// What a moment arm adds to the inverse effective mass: $a I^{-1} a$ with $a = r \times n$, in 1/kg.
    pub(super) fn inverse_mass_of_moment(&self, moment_arm: &Vector) -> f64 {
        moment_arm.dot(&(self.inverse_inertia * moment_arm))
    }

    fn point(&self, arm: &Vector, normal: &Vector) -> RelativeMotion {
        let about_normal = self.inverse_mass_of_moment(&arm.cross(normal));
        // Sum over three directions at right angles of (r x e) I^-1 (r x e).
        let about_all = arm.norm_squared() * self.inverse_inertia.trace() - self.inverse_mass_of_moment(arm);
        RelativeMotion {
            velocity: self.velocity + self.spin.cross(arm),
            acceleration: self.acceleration + self.spin_rate.cross(arm),
            inverse_normal_mass: self.inverse_mass + about_normal,
            inverse_tangential_mass: self.inverse_mass + 0.5 * (about_all - about_normal),
            twist_rate: 0.5 * self.spin.dot(normal),
        }
    }
}

/// How fast the slip velocity at a contact point has changed over a step because the point, the plane and the bodies have turned, in m/s^2; forces do not
/// count. `place` is where the point was seen on the first body at the start of the step, in the world frame as the body lies now, and `turn` the change of
/// the normal since.
pub(super) fn slip_growth(
    first: &RigidMotion,
    second: Option<&RigidMotion>,
    touch: &Touch,
    place: &Vector,
    turn: &Vector,
    kind: &StepKind,
    approach_rate: f64,
) -> Vector {
    let arm_rate = (touch.arm_of_first - place) / kind.step + first.spin.cross(place);
    let mut growth = first.spin.cross(&arm_rate) + first.free_spin_rate.cross(&touch.arm_of_first);
    if let Some(second) = second {
        let arm_rate = arm_rate + first.velocity - second.velocity;
        growth -= second.spin.cross(&arm_rate) + second.free_spin_rate.cross(&touch.arm_of_second);
    }
    growth -= turn * (approach_rate / kind.step);
    growth - touch.normal * growth.dot(&touch.normal)
}

/// From the frame of a body to the world.
pub(super) fn rotation_of(bodies: &Bodies, index: usize) -> Matrix3<f64> {
    *bodies.orientation(index).to_rotation_matrix().matrix()
}

/// The bodies of a stage during one step, by storage index.
#[derive(Debug, Default)]
pub(super) struct RigidMotions(Vec<RigidMotion>);

impl RigidMotions {
    /// Takes note of how some bodies move now.
    pub(super) fn note(&mut self, bodies: &Bodies, members: &[u32]) {
        self.0.resize(bodies.len(), RigidMotion::default());
        for &index in members {
            self.0[index as usize] = RigidMotion::of(bodies, index as usize);
        }
    }

    /// Of a body that was noted.
    #[inline]
    pub(super) fn of(&self, index: usize) -> &RigidMotion {
        &self.0[index]
    }
}

/// Relative motion at a contact point of two bodies, or of a body and a wall at rest.
pub(super) fn relative_motion(first: &RigidMotion, second: Option<&RigidMotion>, touch: &Touch) -> RelativeMotion {
    let one = first.point(&touch.arm_of_first, &touch.normal);
    let Some(second) = second else { return one };
    let other = second.point(&touch.arm_of_second, &touch.normal);
    RelativeMotion {
        velocity: one.velocity - other.velocity,
        acceleration: one.acceleration - other.acceleration,
        inverse_normal_mass: one.inverse_normal_mass + other.inverse_normal_mass,
        inverse_tangential_mass: one.inverse_tangential_mass + other.inverse_tangential_mass,
        twist_rate: one.twist_rate + other.twist_rate,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Orientation;
    use crate::bodies::BodySpecification;
    use crate::shape::{Convex, Cuboid};
    use crate::test_bodies;

    /// Independent: an impulse at the point changes the velocity of the point by the inverse effective mass along it, found from the laws of Newton
    /// and Euler in the frame of the body.
    #[test]
    fn effective_masses_are_what_an_impulse_meets() {
        let turn = Orientation::from_euler_angles(0.4, -0.3, 1.2);
        let body = test_bodies::at_rest(Convex::Cuboid(Cuboid { lengths: Vector::new(1.0, 2.0, 3.0) }), 2.0);
        let inertia = body.inertia;
        let bodies = Bodies::new(vec![BodySpecification { orientation: turn, ..body }]);
        let (arm, normal) = (Vector::new(0.3, -0.7, 0.9), Vector::new(2.0, 3.0, 6.0) / 7.0);
        let velocity_after = |impulse: &Vector| {
            let momentum_in_body = turn.inverse() * arm.cross(impulse);
            let spin = turn * momentum_in_body.component_div(&inertia);
            impulse / 2.0 + spin.cross(&arm)
        };
        let touch = Touch { overlap: 0.1, normal, arm_of_first: arm, arm_of_second: Vector::zeros(), is_deep: false };
        let motion = relative_motion(&RigidMotion::of(&bodies, 0), None, &touch);
        let along = velocity_after(&normal).dot(&normal);
        assert!((motion.inverse_normal_mass / along - 1.0).abs() < 32.0 * f64::EPSILON);
        let one = normal.cross(&Vector::x()).normalize();
        let other = normal.cross(&one);
        let mean = 0.5 * (velocity_after(&one).dot(&one) + velocity_after(&other).dot(&other));
        assert!((motion.inverse_tangential_mass / mean - 1.0).abs() < 32.0 * f64::EPSILON);
    }
}
