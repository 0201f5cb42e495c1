//! The impulse of two hard bodies that collide at a point (S sections 3.1 and A.1).
//!
//! # Along the normal
//!
//! Newton's restitution holds at the contact point (S eq. 3.14): the material points part at $e$ times the rate at which they approached,
//! $j_n = (1 + e)\,u_n / (n \cdot W n)$. $W$ is the velocity that an impulse of one gives to the relative motion of the two points,
//! $W = \sum_i (1/m_i - \hat r_i I_i^{-1} \hat r_i)$ with the matrices $\hat r_i$ of the cross products with the arms. S eq. 3.24 prints its normal part with a bracket missing (the dot product belongs to the
//! sum of both turning terms), and eq. 3.9-3.11 with the torque as $F \times r$ (errata). S eq. 3.15, the restitution as root of the ratio of kinetic energies, holds for central
//! impacts in the frame of the centre of mass only.
//!
//! # Along the contact plane
//!
//! Friction may take the slip away, and no more (errata of S eq. 3.32-3.33: without that limit a slip of 0.10 becomes one of -6.55; and the printed signs
//! push the slip on). Where the contact point is not in line with the centres, an impulse along the plane also changes the normal velocity, so
//! that the friction impulse here has a normal part, by which the restitution stays what it is: $n \cdot W J_t = 0$. For such an impulse the energy splits,
//!
//! $$\Delta E = -\tfrac12 (1 - e^2)\, u_n^2/(n \cdot W n) + k \cdot c + \tfrac12\, k \cdot A k,$$
//!
//! with $k$ its part along the plane, $A$ the Schur complement of $n \cdot W n$ in $W$, and $c$ the slip after a plastic normal impulse. The first term is
//! never positive. The impulse that would stop the slip exactly, $k = -A^{-1} c_e$ with the slip $c_e$ after the normal impulse, is taken if it lies in the cone of the static
//! coefficient. Otherwise it is scaled back to the cone of the dynamic one. In either case it is scaled back to $s \le -2\, k \cdot c/(k \cdot A k)$, where the
//! last two terms vanish: **no collision creates energy**, whatever the masses, arms and coefficients. Newton's restitution with Coulomb's friction and
//! without that last limit does so in eccentric collisions (Kane's paradox). The split is that of A. Chatterjee and A. Ruina, A new algebraic rigid-body collision law
//! based on impulse space considerations, J. Appl. Mech. 65 (1998) 939, whose law has the slip vanish at the end of compression; here it vanishes at the
//! end of the collision, wherever that costs no energy. For balls both are the same and the last limit never acts.

use nalgebra::{Matrix2, Matrix3, Vector2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Vector;
use crate::distance::basis;

/// A rigid body as a collision sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollidingBody {
    /// Velocity of the centre of mass in m/s.
    pub velocity: Vector,
    /// Angular velocity in rad/s, world frame.
    pub spin: Vector,
    /// One over the mass, in 1/kg.
    pub inverse_mass: f64,
    /// Inverse of the inertia about the centre of mass, world frame, in 1/(kg m^2).
    pub inverse_inertia: Matrix3<f64>,
}

/// Where two bodies, or a body and a wall at rest, collide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollisionPoint {
    /// Unit normal from the first partner to the second.
    pub normal: Vector,
    /// From the centre of mass of the first partner, in m.
    pub arm_of_first: Vector,
    /// From the centre of mass of the second partner, in m; of no meaning for a wall.
    pub arm_of_second: Vector,
}

/// How friction is limited.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FrictionClamp {
    /// By the impulse that stops the slip, and by the energy: the slip ends, it never turns round.
    #[default]
    Stick,
    /// Not at all: always the dynamic coefficient times the normal impulse, as S section 3.1.2 implements it. The slip may turn round
    /// and grow, and energy be created.
    None,
    /// Not at all, and with the signs of S eq. 3.33, A.7 and A.8 as printed: friction pushes the slip on. Creates energy always.
    NoneSignAsPrinted,
}

/// Coulomb's law for impulses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionImpulse {
    /// Coefficient while the points slip, zero or above.
    pub dynamic_friction: f64,
    /// Coefficient up to which they stick, not below the other.
    pub static_friction: f64,
    /// How friction is limited.
    pub clamp: FrictionClamp,
}

/// What happens when two materials collide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpulseLaw {
    /// Newton's coefficient of restitution at the contact point, in [0, 1].
    pub restitution: f64,
    /// Friction; `None` for smooth bodies.
    pub friction: Option<FrictionImpulse>,
}

impl CollidingBody {
    /// Velocity of the material point at the end of an arm, in m/s.
    pub fn velocity_at(&self, arm: &Vector) -> Vector {
        self.velocity + self.spin.cross(arm)
    }

    /// Takes an impulse in N s at the end of an arm.
    pub fn take(&mut self, impulse: &Vector, arm: &Vector) {
        self.velocity += impulse * self.inverse_mass;
        self.spin += self.inverse_inertia * arm.cross(impulse);
    }

    /// Velocity of the point at the end of an arm per impulse there, in 1/kg.
    fn response(&self, arm: &Vector) -> Matrix3<f64> {
        let cross = arm.cross_matrix();
        Matrix3::from_diagonal_element(self.inverse_mass) - cross * self.inverse_inertia * cross
    }
}

impl CollisionPoint {
    /// Velocity in m/s of the material point of the first less that of the second.
    pub fn relative_velocity(&self, first: &CollidingBody, second: Option<&CollidingBody>) -> Vector {
        let of_second = second.map_or_else(Vector::zeros, |second| second.velocity_at(&self.arm_of_second));
        first.velocity_at(&self.arm_of_first) - of_second
    }
}

/// Relative velocity at a contact and how impulses change it.
struct Contact {
    normal: Vector,
    velocity: Vector,
    /// In m/s, above zero.
    approach_rate: f64,
    /// In 1/kg.
    response: Matrix3<f64>,
}

impl ImpulseLaw {
    /// Impulse in N s on the first partner; the second takes the opposite. `None` if the partners do not approach.
    pub fn impulse_on_first(&self, first: &CollidingBody, second: Option<&CollidingBody>, point: &CollisionPoint) -> Option<Vector> {
        let velocity = point.relative_velocity(first, second);
        let normal = point.normal;
        let approach_rate = velocity.dot(&normal);
        if approach_rate.is_nan() || approach_rate <= 0.0 {
            return None;
        }
        let response_of_second = second.map_or_else(Matrix3::zeros, |second| second.response(&point.arm_of_second));
        let contact = Contact { normal, velocity, approach_rate, response: first.response(&point.arm_of_first) + response_of_second };
        let push = (1.0 + self.restitution) * approach_rate / normal.dot(&(contact.response * normal));
        let friction = self.friction.map_or_else(Vector::zeros, |friction| friction.impulse_on_first(&contact, push));
        Some(friction - normal * push)
    }
}

impl FrictionImpulse {
    /// Impulse that friction adds to a normal impulse `push`, both in N s.
    fn impulse_on_first(&self, contact: &Contact, push: f64) -> Vector {
        let dynamic = |sign: f64| {
            let slip = contact.velocity - contact.normal * contact.approach_rate;
            slip.try_normalize(0.0).map_or_else(Vector::zeros, |direction| direction * (sign * self.dynamic_friction * push))
        };
        match self.clamp {
            FrictionClamp::Stick => self.clamped(contact, push),
            FrictionClamp::None => dynamic(-1.0),
            FrictionClamp::NoneSignAsPrinted => dynamic(1.0),
        }
    }

    fn clamped(&self, contact: &Contact, push: f64) -> Vector {
        let Contact { normal, response, .. } = contact;
        let plane = basis(normal);
        let along_normal = normal.dot(&(response * normal));
        let coupling: Vector2<f64> = plane.tr_mul(&(response * normal));
        // Response along the plane of impulses that leave the normal velocity alone.
        let reduced: Matrix2<f64> = plane.tr_mul(&(response * plane)) - coupling * coupling.transpose() / along_normal;
        let slip: Vector2<f64> = plane.tr_mul(&contact.velocity);
        let slip_after_push = slip - coupling * push;
        let slip_after_plastic_push = slip - coupling * (contact.approach_rate / along_normal);
        let Some(stopping) = reduced.try_inverse().map(|inverse| -(inverse * slip_after_push)) else { return Vector::zeros() };
        let normal_part = -coupling.dot(&stopping) / along_normal;
        let size = stopping.norm();
        let sticks = size <= self.static_friction * (push - normal_part);
        let by_cone = if sticks { 1.0 } else { self.dynamic_friction * push / (size + self.dynamic_friction * normal_part) };
        let gain = stopping.dot(&slip_after_plastic_push);
        let by_energy = if gain < 0.0 { -2.0 * gain / stopping.dot(&(reduced * stopping)) } else { 0.0 };
        let part = by_cone.min(by_energy).min(1.0);
        if part > 0.0 { (plane * stopping + normal * normal_part) * part } else { Vector::zeros() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A solid ball of one kilogram and one metre.
    fn ball(velocity: [f64; 3]) -> CollidingBody {
        CollidingBody {
            velocity: velocity.into(),
            spin: Vector::zeros(),
            inverse_mass: 1.0,
            inverse_inertia: Matrix3::from_diagonal_element(1.0 / 0.4),
        }
    }

    const HEAD_ON: CollisionPoint = CollisionPoint {
        normal: Vector::new(1.0, 0.0, 0.0),
        arm_of_first: Vector::new(1.0, 0.0, 0.0),
        arm_of_second: Vector::new(-1.0, 0.0, 0.0),
    };

    fn law(restitution: f64, friction: f64, clamp: FrictionClamp) -> ImpulseLaw {
        let friction = FrictionImpulse { dynamic_friction: friction, static_friction: friction, clamp };
        ImpulseLaw { restitution, friction: Some(friction) }
    }

    /// Slip and kinetic energy after two balls of the errata have met at 2 m/s, each slipping by half of `slip`.
    fn after(law: &ImpulseLaw, slip: f64) -> (f64, f64) {
        let (mut first, mut second) = (ball([1.0, 0.5 * slip, 0.0]), ball([-1.0, -0.5 * slip, 0.0]));
        let impulse = law.impulse_on_first(&first, Some(&second), &HEAD_ON).unwrap();
        first.take(&impulse, &HEAD_ON.arm_of_first);
        second.take(&-impulse, &HEAD_ON.arm_of_second);
        let energy = |ball: &CollidingBody| 0.5 * ball.velocity.norm_squared() + 0.2 * ball.spin.norm_squared();
        (HEAD_ON.relative_velocity(&first, Some(&second)).y, energy(&first) + energy(&second))
    }

    /// The numbers of the errata: by hand, j = mu (1 + e), slip changes by 7 j, energy is the sum of squares.
    #[test]
    fn friction_as_printed_creates_the_energy_of_the_errata() {
        let near = |(slip, energy): (f64, f64), expected: (f64, f64)| {
            assert!((slip - expected.0).abs() < 1e-14 && (energy - expected.1).abs() < 1e-14, "{slip} {energy}");
        };
        near(after(&law(0.9, 0.2, FrictionClamp::NoneSignAsPrinted), 1.6), (1.6 + 7.0 * 0.38, 0.81 + 1.18 * 1.18 + 0.361));
        near(after(&law(0.9, 0.2, FrictionClamp::Stick), 1.6), (0.0, 0.81 + 5.0 / 7.0 * 0.64));
        near(after(&law(0.9, 0.2, FrictionClamp::None), 1.6), (1.6 - 7.0 * 0.38, 0.81 + 0.42 * 0.42 + 0.361));
        near(after(&law(0.9, 0.5, FrictionClamp::None), 0.1), (0.1 - 7.0 * 0.95, 0.81 + 0.9 * 0.9 + 0.4 * 2.375 * 2.375));
        near(after(&law(0.9, 0.5, FrictionClamp::Stick), 0.1), (0.0, 0.81 + 5.0 / 7.0 * 0.0025));
        // Below the cone it slips on.
        near(after(&law(0.9, 0.02, FrictionClamp::Stick), 1.6), (1.6 - 7.0 * 0.038, 0.81 + (0.8_f64 - 0.038).powi(2) + 0.00361));
    }

    /// The static coefficient decides whether, the dynamic one how much.
    #[test]
    fn between_the_coefficients_a_contact_sticks_and_above_both_it_slips_by_the_dynamic_one() {
        // Stopping needs slip/7 in units of the mass; the normal impulse is 1.9.
        let coefficients = |slip: f64| {
            let friction = FrictionImpulse { dynamic_friction: 0.1, static_friction: 0.3, clamp: FrictionClamp::Stick };
            after(&ImpulseLaw { restitution: 0.9, friction: Some(friction) }, slip).0
        };
        assert!(coefficients(7.0 * 0.29 * 1.9).abs() < 1e-14);
        assert!((coefficients(7.0 * 0.31 * 1.9) - 7.0 * 0.21 * 1.9).abs() < 1e-14);
    }

    #[test]
    fn partners_that_part_take_no_impulse_and_a_wall_sends_a_ball_back() {
        let smooth = ImpulseLaw { restitution: 0.7, friction: None };
        assert_eq!(smooth.impulse_on_first(&ball([-1.0, 0.0, 0.0]), None, &HEAD_ON), None);
        assert_eq!(smooth.impulse_on_first(&ball([0.0; 3]), None, &HEAD_ON), None);
        assert_eq!(smooth.impulse_on_first(&ball([f64::NAN, 0.0, 0.0]), None, &HEAD_ON), None);
        let impulse = smooth.impulse_on_first(&ball([2.0, 1.0, 0.0]), None, &HEAD_ON).unwrap();
        assert!((impulse + Vector::x() * 3.4).norm() < 1e-15);
    }

    /// R eq. 3.37: a cylinder or rod that lands on its end. A thin rod of mass 1 and length 2 at 45 degrees: a = 1/m + r^2 cos^2/I = 1 + 0.5/(1/3) = 2.5.
    #[test]
    fn an_off_centre_impact_turns_the_body() {
        let rod = CollidingBody { inverse_inertia: Matrix3::from_diagonal_element(3.0), ..ball([0.0, 0.0, -1.0]) };
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let point = CollisionPoint { normal: -Vector::z(), arm_of_first: Vector::new(half, 0.0, -half), arm_of_second: Vector::zeros() };
        let impulse = ImpulseLaw { restitution: 0.5, friction: None }.impulse_on_first(&rod, None, &point).unwrap();
        assert!((impulse - Vector::z() * (1.5 / 2.5)).norm() < 1e-15, "{impulse}");
    }
}
