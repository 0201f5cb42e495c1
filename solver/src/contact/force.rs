//! The force at one contact point, from the laws between its materials: the same for every kind of shapes.

use super::law::normal::{NormalContact, NormalForce, NormalMemory};
use super::law::{NormalLaw, StepKind, TangentialContact, TangentialLaw};
use super::sharing::Share;
use super::stage::Laws;
use crate::Vector;
use crate::boundary::PlacedWall;

/// Relative motion of the two material points at a contact, and what they weigh.
#[derive(Debug, Clone, Copy)]
pub(super) struct RelativeMotion {
    /// Of the first less the second, mean over the last step, in m/s.
    pub(super) velocity: Vector,
    /// Predicted for the time of the force, in m/s^2.
    pub(super) acceleration: Vector,
    /// One over the effective mass along the normal, in 1/kg.
    pub(super) inverse_normal_mass: f64,
    /// One over the effective mass along the contact plane, mean of its directions, in 1/kg.
    pub(super) inverse_tangential_mass: f64,
    /// Mean angular velocity of both bodies about the normal over the last step, in rad/s.
    pub(super) twist_rate: f64,
}

impl RelativeMotion {
    /// Angle in rad by which both bodies have turned about the normal over the part of the last step in which they touched.
    #[inline(always)]
    pub(super) fn twist(&self, kind: &StepKind, touched_before: f64) -> f64 {
        if kind.synchronous { 0.0 } else { self.twist_rate * kind.step * touched_before }
    }

    /// The motion against a wall that moves itself, at a contact point, if it is so far against a wall at rest.
    #[inline]
    pub(super) fn against(self, wall: &PlacedWall<'_>, (point, normal): (&Vector, &Vector), kind: &StepKind) -> RelativeMotion {
        let (velocity, acceleration) = wall.motion_since(point, kind.age_of_velocities());
        RelativeMotion {
            velocity: self.velocity - velocity,
            acceleration: self.acceleration - acceleration,
            twist_rate: self.twist_rate + 0.5 * wall.spin(kind.age_of_velocities()).dot(normal),
            ..self
        }
    }
}

/// One contact point during one step.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointContact {
    pub(super) normal: Vector,
    /// In m.
    pub(super) overlap: f64,
    pub(super) motion: RelativeMotion,
    /// How the slip velocity changes with the overlap while it grows, in 1/s: lever arms shrink and the plane turns.
    pub(super) slip_by_overlap: Vector,
    /// How fast it has changed besides over the last step because lever arms and the plane did, in m/s^2.
    pub(super) slip_growth: Vector,
    /// One over the reduced mass of the partners, in 1/kg.
    pub(super) inverse_reduced_mass: f64,
    /// One over the mass that the normal dashpot is calibrated for, in 1/kg.
    pub(super) inverse_damped_mass: f64,
    /// Radius in m of the sphere that would meet a flat wall as the partners do; not a number where they have none.
    pub(super) curvature_radius: f64,
    /// The part of the laws that this point carries.
    pub(super) share: Share,
    /// Whether it did not touch at the last step.
    pub(super) is_new: bool,
}

/// Mean force on the first partner over the time a kick stands for, in N, and its normal part.
#[inline(always)]
pub(super) fn force_on_first<Tangential: TangentialLaw, Normal: NormalLaw, Rolling>(
    laws: &Laws<Tangential, Normal, Rolling>,
    point: &PointContact,
    kind: &StepKind,
    memory: &mut NormalMemory,
    history: &mut Tangential::History,
) -> (Vector, NormalForce) {
    let contact = point.along_normal();
    let normal_force = laws.normal.mean_force(&contact, kind, memory);
    let along_normal = point.normal * -normal_force.mean;
    if !Tangential::NEEDS_ROTATION {
        return (along_normal, normal_force);
    }
    let force = laws.tangential.mean_force(&point.in_plane(&contact, &normal_force, kind), kind, history);
    (along_normal + force, normal_force)
}

/// The force of a contact that is neither new nor has ended.
#[derive(Debug, Clone, Copy)]
pub(super) struct InsideForce {
    /// On the first partner, in N.
    pub(super) force: Vector,
    /// Its normal part in N.
    pub(super) normal: f64,
    /// Whether the contact goes on until the next kick: if it does not, this is not the force.
    pub(super) lasts: bool,
    /// Whether the law in the contact plane has no other branch to take: if it has, this is not the force.
    pub(super) holds: bool,
}

/// The force of a contact that is neither new nor has ended: without branches, or, if it may slide, with those of the law in the contact plane.
#[inline(always)]
pub(super) fn force_inside<const MAY_SLIDE: bool, Tangential: TangentialLaw, Normal: NormalLaw, Rolling>(
    laws: &Laws<Tangential, Normal, Rolling>,
    point: &PointContact,
    kind: &StepKind,
    last_normal_force: f64,
    history: &mut Tangential::History,
) -> InsideForce {
    let contact = point.along_normal();
    let (normal_force, lasts) = laws.normal.force_inside(&contact, kind, last_normal_force);
    let (normal, along_normal) = (normal_force.mean, point.normal * -normal_force.mean);
    if !Tangential::NEEDS_ROTATION {
        return InsideForce { force: along_normal, normal, lasts, holds: true };
    }
    let in_plane = point.in_plane(&contact, &normal_force, kind);
    let (force, holds) = if MAY_SLIDE {
        (laws.tangential.mean_force(&in_plane, kind, history), true)
    } else {
        laws.tangential.force_inside(&in_plane, kind, history)
    };
    InsideForce { force: along_normal + force, normal, lasts, holds }
}

impl PointContact {
    #[inline(always)]
    fn along_normal(&self) -> NormalContact {
        NormalContact {
            overlap: self.overlap,
            is_new: self.is_new,
            approach_rate: self.motion.velocity.dot(&self.normal),
            approach_acceleration: self.motion.acceleration.dot(&self.normal),
            inverse_effective_mass: self.motion.inverse_normal_mass,
            inverse_damped_mass: self.inverse_damped_mass,
            curvature_radius: self.curvature_radius,
            share: self.share,
        }
    }

    #[inline(always)]
    fn in_plane(&self, along_normal: &NormalContact, normal_force: &NormalForce, kind: &StepKind) -> TangentialContact {
        let PointContact { normal, motion, share, .. } = self;
        let velocity = motion.velocity - normal * along_normal.approach_rate;
        // Arms and plane are those of now; the displacement was made with those of half a step ago.
        let since_middle = 0.5 * kind.step * normal_force.touched_before;
        let growth = self.slip_growth + self.slip_by_overlap * along_normal.approach_rate;
        let displacement = (velocity - growth * since_middle) * kind.step;
        let twist = motion.twist(kind, normal_force.touched_before);
        TangentialContact {
            normal: *normal,
            velocity,
            // Half of the turn about the normal is still to come.
            displacement: displacement + normal.cross(&displacement) * (0.5 * twist),
            twist,
            acceleration: motion.acceleration - normal * along_normal.approach_acceleration,
            normal_force: normal_force.mean,
            elastic_force: normal_force.elastic,
            overlap: self.overlap,
            curvature_radius: self.curvature_radius,
            inverse_effective_mass: motion.inverse_tangential_mass,
            reduced_mass: 1.0 / self.inverse_reduced_mass,
            share: share.stiffness,
            touched_before: normal_force.touched_before,
            touched: normal_force.touched,
            stretch_ahead: normal_force.stretch_ahead,
        }
    }
}
