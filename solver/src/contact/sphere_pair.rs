//! What the contact of two spheres follows from, of one pair or of many at once: closed forms without a branch.
//!
//! Something flat that nothing turns counts as a sphere without spin, mass and moment of inertia that are infinite.

use super::force::{PointContact, RelativeMotion};
use super::law::StepKind;
use super::law::normal::NormalForce;
use super::law::rolling::RollingContact;
use super::sharing::Share;
use crate::Vector;
use crate::bodies::Motion;

/// What does not change from step to step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Sizes {
    /// In m; of no meaning for something flat.
    pub(super) radius: [f64; 2],
    /// The sum of both, in 1/kg.
    pub(super) inverse_mass: f64,
    /// In 1/(kg m^2).
    pub(super) inverse_inertia: [f64; 2],
    /// Radius in m of the sphere that would meet a flat wall as the partners meet each other.
    pub(super) curvature_radius: f64,
}

/// Where two spheres touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    pub(super) normal: Vector,
    /// In m.
    pub(super) overlap: f64,
    /// One over the distance of the centres in 1/m: zero for something flat, whose normal does not turn.
    pub(super) inverse_distance: f64,
}

/// How two spheres move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SphereMotion {
    /// Of the first less the second, in m/s.
    pub(super) velocity: Vector,
    /// In m/s^2.
    pub(super) acceleration: Vector,
    /// In rad/s.
    pub(super) spin: [Vector; 2],
    /// In rad/s^2.
    pub(super) spin_rate: [Vector; 2],
}

impl Sizes {
    /// Of a sphere and another one or something flat.
    #[inline(always)]
    pub(super) fn of(first: &Motion, second: Option<&Motion>) -> Sizes {
        let Some(second) = second else {
            return Sizes {
                radius: [first.radius, 0.0],
                inverse_mass: first.inverse_mass,
                inverse_inertia: [first.inverse_inertia, 0.0],
                curvature_radius: first.radius,
            };
        };
        Sizes {
            radius: [first.radius, second.radius],
            inverse_mass: first.inverse_mass + second.inverse_mass,
            inverse_inertia: [first.inverse_inertia, second.inverse_inertia],
            curvature_radius: first.radius * second.radius / (first.radius + second.radius),
        }
    }

    /// Lengths in m of the arms from the centres to the contact point.
    #[inline(always)]
    pub(super) fn arms(&self, overlap: f64) -> [f64; 2] {
        self.radius.map(|radius| radius - 0.5 * overlap)
    }
}

impl SphereMotion {
    /// Of a sphere and another one or something at rest.
    #[inline(always)]
    pub(super) fn of(first: &Motion, second: Option<&Motion>) -> SphereMotion {
        let at_rest = Motion::default();
        let second = second.unwrap_or(&at_rest);
        SphereMotion {
            velocity: first.velocity - second.velocity,
            acceleration: first.acceleration - second.acceleration,
            spin: [first.angular_velocity, second.angular_velocity],
            spin_rate: [first.angular_acceleration, second.angular_acceleration],
        }
    }
}

/// The contact point of two spheres, seen as one that began before the last step. `turns` tells whether anything turns them, and is a constant of the stage.
///
/// Head-on forces do not turn spheres: along the normal they weigh their mass. Arms lie along the normal, so that of the spins only
/// $(\omega_1 r_1 + \omega_2 r_2) \times n$ counts. While the overlap grows both arms shrink by half of it, and the line of two centres turns against
/// their relative velocity.
#[inline(always)]
pub(super) fn contact_point(meeting: &Meeting, motion: &SphereMotion, sizes: &Sizes, turns: bool) -> PointContact {
    let Meeting { normal, overlap, inverse_distance } = *meeting;
    let mut at_point = RelativeMotion {
        velocity: motion.velocity,
        acceleration: motion.acceleration,
        inverse_normal_mass: sizes.inverse_mass,
        inverse_tangential_mass: sizes.inverse_mass,
        twist_rate: 0.0,
    };
    let (mut slip_by_overlap, mut slip_growth) = (Vector::zeros(), Vector::zeros());
    if turns {
        let [arm, other_arm] = sizes.arms(overlap);
        let [inverse_inertia, other_inverse_inertia] = sizes.inverse_inertia;
        let rolling = motion.spin[0] * arm + motion.spin[1] * other_arm;
        at_point.velocity += rolling.cross(&normal);
        at_point.acceleration += (motion.spin_rate[0] * arm + motion.spin_rate[1] * other_arm).cross(&normal);
        at_point.inverse_tangential_mass += arm * arm * inverse_inertia + other_arm * other_arm * other_inverse_inertia;
        let across = (motion.velocity - normal * motion.velocity.dot(&normal)) * inverse_distance;
        let mean_spin = (motion.spin[0] + motion.spin[1]) * 0.5;
        at_point.twist_rate = mean_spin.dot(&normal);
        slip_by_overlap = across + normal.cross(&mean_spin);
        slip_growth = across.cross(&normal) * rolling.dot(&normal);
    }
    PointContact {
        normal,
        overlap,
        motion: at_point,
        slip_by_overlap,
        slip_growth,
        inverse_reduced_mass: sizes.inverse_mass,
        inverse_damped_mass: sizes.inverse_mass,
        curvature_radius: sizes.curvature_radius,
        share: Share::WHOLE,
        is_new: false,
    }
}

/// Relative spin of the partners in the contact plane, and what it meets.
pub(super) fn rolling_contact(
    motion: &SphereMotion,
    sizes: &Sizes,
    point: &PointContact,
    normal_force: &NormalForce,
    kind: &StepKind,
) -> RollingContact {
    let in_plane = |vector: Vector| vector - point.normal * vector.dot(&point.normal);
    RollingContact {
        normal: point.normal,
        spin: in_plane(motion.spin[0] - motion.spin[1]),
        spin_rate: in_plane(motion.spin_rate[0] - motion.spin_rate[1]),
        normal_force: normal_force.mean,
        rolling_radius: point.curvature_radius,
        inertia: 1.0 / (sizes.inverse_inertia[0] + sizes.inverse_inertia[1]),
        touched_before: normal_force.touched_before,
        twist: point.motion.twist(kind, normal_force.touched_before),
    }
}
