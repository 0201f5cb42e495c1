//! Bodies of any shape, convex or glued: several contact points between the same two bodies.
//!
//! For every candidate pair the parts of both bodies are looked at, each contact point gets its share of the law, and what a point must remember is
//! found again by its place on the first body, because points come, go and change their order.

use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

use super::detect::{OneSided, Points, VertexSurface};
use super::detector::{Detector, KnownOfBodies, PointTouch, Standing, Touches};
use super::force::{PointContact, force_on_first};
use super::law::normal::NormalMemory;
use super::law::{ContactScale, LinearSpringDashpot, NormalLaw, StepKind, TangentialLaw};
use super::pair_rows::PairRows;
use super::pairs::{Candidate, Partner};
use super::rigid_motion::{RigidMotion, RigidMotions, relative_motion, rotation_of, slip_growth};
use super::sharing::{DampedMass, Sharing};
use super::stage::{ContactStage, Laws, Observation, TimeScales, Work};
use super::sweep::{PairForce, PairLaw, Rows, Sums};
use super::travel::Travel;
use crate::boundary::{MovingWall, placed};
use crate::distance::RoundedCore;
use crate::domain::Shifts;
use crate::relocation::Relocation;
use crate::{Bodies, Orientation, Vector};

/// How contacts of shaped bodies are resolved, the same for all of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// How contact points share the law.
    pub sharing: Sharing,
    /// Which mass the dashpot is calibrated for.
    pub damped_mass: DampedMass,
    /// How many contact points are looked at.
    pub points: Points,
    /// What to make of a contact that the vertices of one body see and those of the other do not.
    pub one_sided: OneSided,
}

/// A part of a body as detection sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct DetectedPart {
    /// Against other bodies.
    pub against_bodies: RoundedCore,
    /// Against walls.
    pub against_walls: RoundedCore,
    /// Its vertices, where they tell contacts with bodies that have some too, and with walls.
    pub vertices: Option<std::sync::Arc<VertexSurface>>,
    /// Centre in the frame of the body, in m.
    pub position: Vector,
    /// From the frame of the part to the frame of the body.
    pub orientation: Orientation,
    /// The same, if both frames differ.
    pub rotation: Option<Matrix3<f64>>,
    /// Radius in m of a ball about the centre that holds the part.
    pub bounding_radius: f64,
}

/// What a contact point remembers.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct PointMemory<History> {
    parts: [u32; 2],
    /// On the first body, in its own frame, in m.
    place: Vector,
    /// In the world frame.
    contact_normal: Vector,
    /// The share of the law at the last look.
    share: f64,
    normal: NormalMemory,
    tangential: History,
}

/// What is remembered of a candidate pair: little, because most pairs are apart, and whether they are is asked at every step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Memory<History> {
    /// Travel of both bodies in m before which they cannot touch. What is forgotten of it costs a look and changes nothing.
    #[serde(skip)]
    due: f64,
    near: Option<Box<NearMemory<History>>>,
}

impl<History> Default for Memory<History> {
    fn default() -> Memory<History> {
        Memory { due: 0.0, near: None }
    }
}

/// What is remembered of a pair that is near.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct NearMemory<History> {
    points: Vec<PointMemory<History>>,
    standing: Standing,
}

impl<History> NearMemory<History> {
    fn is_used(&self) -> bool {
        !self.points.is_empty() || self.standing.is_used()
    }
}

/// A contact law over candidate pairs of shaped bodies.
pub struct ShapedContacts<Tangential: TangentialLaw> {
    laws: Vec<Laws<Tangential>>,
    surroundings: Surroundings,
    rows: PairRows<Memory<Tangential::History>>,
    /// Bodies of the candidates, by storage index.
    members: Vec<u32>,
    travel: Travel,
    motions: RigidMotions,
    work: Work,
    /// Of the positions, in s.
    time: f64,
}

/// What detection needs beside the bodies, the same for a whole run.
pub struct Surroundings {
    /// Walls.
    pub walls: std::sync::Arc<[MovingWall]>,
    /// Of the periodic box.
    pub shifts: Shifts,
    /// Parts of each shape, by its index.
    pub parts: Vec<std::sync::Arc<[DetectedPart]>>,
    /// How contacts are resolved.
    pub resolution: Resolution,
}

/// A point is the same as one of the last step if it lies within this part of the smaller part's size of it.
const SAME_PLACE: f64 = 0.2;

impl<Tangential: TangentialLaw> ShapedContacts<Tangential> {
    /// A stage for bodies of any shape.
    pub fn new(laws: Vec<Laws<Tangential>>, surroundings: Surroundings) -> ShapedContacts<Tangential> {
        let (travel, motions, work) = (Travel::default(), RigidMotions::default(), Work::default());
        ShapedContacts { laws, surroundings, rows: PairRows::new(1), members: Vec::new(), travel, motions, work, time: 0.0 }
    }

    /// Whoever looks at all contacts now, as closely as he asks for.
    fn detector<'a>(&'a self, bodies: &'a Bodies, points: Points) -> Detector<'a> {
        Detector { bodies, surroundings: &self.surroundings, walls: placed(&self.surroundings.walls, self.time), points, known: None }
    }
}

/// What all contact points of a candidate pair share.
struct Resultant {
    inverse_reduced_mass: f64,
    inverse_damped_mass: f64,
    total_overlap: f64,
}

impl Resultant {
    fn new(first: &RigidMotion, second: Option<&RigidMotion>, touches: &[PointTouch], resolution: &Resolution) -> Resultant {
        let inverse_reduced_mass = first.inverse_mass + second.map_or(0.0, |second| second.inverse_mass);
        let total_overlap = touches.iter().map(|point| point.touch.overlap).sum();
        let mut inverse_damped_mass = inverse_reduced_mass;
        if resolution.damped_mass == DampedMass::Effective {
            let (mut normal, mut moment_of_first, mut moment_of_second) = (Vector::zeros(), Vector::zeros(), Vector::zeros());
            for PointTouch { touch, .. } in touches {
                let weight = resolution.sharing.weight(touch.overlap, total_overlap, touches.len());
                normal += touch.normal * weight;
                moment_of_first += touch.arm_of_first.cross(&touch.normal) * weight;
                moment_of_second += touch.arm_of_second.cross(&touch.normal) * weight;
            }
            inverse_damped_mass = inverse_reduced_mass * normal.norm_squared()
                + first.inverse_mass_of_moment(&moment_of_first)
                + second.map_or(0.0, |second| second.inverse_mass_of_moment(&moment_of_second));
        }
        Resultant { inverse_reduced_mass, inverse_damped_mass, total_overlap }
    }
}

/// Takes what the same point remembered at the last step out of the old points.
fn remembered<History: Clone + Default>(
    old: &mut Vec<PointMemory<History>>,
    parts: [u32; 2],
    place: Vector,
    within: f64,
) -> Option<PointMemory<History>> {
    let distance = |point: &PointMemory<History>| if point.parts == parts { (point.place - place).norm_squared() } else { f64::INFINITY };
    let nearest = (0..old.len()).min_by(|left, right| distance(&old[*left]).total_cmp(&distance(&old[*right])))?;
    (distance(&old[nearest]) <= within * within).then(|| old.remove(nearest))
}

/// The laws of a stage during one step.
struct ShapedForces<'a, Tangential> {
    laws: &'a [Laws<Tangential>],
    surroundings: &'a Surroundings,
    known: KnownOfBodies<'a>,
    time: f64,
    kind: &'a StepKind,
}

/// Room for what is found at a pair, used again from pair to pair.
struct Room<History> {
    touches: Touches,
    /// Points that the pair remembered.
    old: Vec<PointMemory<History>>,
}

impl<Tangential: TangentialLaw> PairLaw for ShapedForces<'_, Tangential> {
    type Memory = Memory<Tangential::History>;
    const TURNS: bool = true;

    fn evaluate(&self, bodies: &Bodies, rows: &mut Rows<'_, Self::Memory>, sums: &mut Sums<'_>) -> Work {
        let mut work = Work::default();
        let (surroundings, walls) = (self.surroundings, placed(&self.surroundings.walls, self.time));
        let detector = Detector { bodies, surroundings, walls, points: surroundings.resolution.points, known: Some(self.known) };
        let mut room = Room { touches: Touches::default(), old: Vec::new() };
        for (candidate, memory) in rows.candidates.iter_mut().zip(rows.memory.iter_mut()) {
            if detector.are_apart(candidate, memory.due) {
                continue;
            }
            let near = memory.near.get_or_insert_default();
            let force;
            (force, memory.due) = self.force(&detector, candidate, near, &mut room, &mut work);
            candidate.is_remembered = near.is_used();
            if !candidate.is_remembered {
                memory.near = None;
            }
            if let Some(force) = force {
                sums.add(candidate, &force);
            }
        }
        work
    }
}

impl<Tangential: TangentialLaw> ShapedForces<'_, Tangential> {
    /// The force of a pair if it touches, and the travel of both bodies in m before which it cannot do so, or not again.
    fn force(
        &self,
        detector: &Detector<'_>,
        candidate: &Candidate,
        near: &mut NearMemory<Tangential::History>,
        room: &mut Room<Tangential::History>,
        work: &mut Work,
    ) -> (Option<PairForce>, f64) {
        let (bodies, resolution) = (detector.bodies, &self.surroundings.resolution);
        room.touches.points.clear();
        let due = detector.look(candidate, &mut near.standing, &mut room.touches, work);
        let touches = &room.touches.points;
        if touches.is_empty() {
            near.points.clear();
            return (None, due);
        }
        let first = self.known.motions.of(candidate.first());
        let second = candidate.second_body().map(|second| self.known.motions.of(second));
        let wall = match candidate.second() {
            Partner::Wall(wall) => detector.walls[wall].as_ref(),
            Partner::Body(_) => None,
        };
        let resultant = Resultant::new(first, second, touches, resolution);
        room.old.clear();
        room.old.append(&mut near.points);
        let mut pair = PairForce::default();
        for PointTouch { touch, parts } in touches {
            let place = first.rotation.tr_mul(&touch.arm_of_first);
            let part_size = |body: usize, part: u32| detector.parts(body)[part as usize].bounding_radius;
            let own_size = part_size(candidate.first(), parts[0]);
            let size = candidate.second_body().map_or(own_size, |second| own_size.min(part_size(second, parts[1])));
            let known = remembered(&mut room.old, *parts, place, SAME_PLACE * size);
            let is_new = known.is_none();
            let share = resolution.sharing.share(touch.overlap, resultant.total_overlap, touches.len(), second.is_none());
            let motion = relative_motion(first, second, touch);
            let at_wall =
                |wall| motion.against(wall, (&(bodies.position(candidate.first()) + touch.arm_of_first), &touch.normal), self.kind);
            let motion = wall.map_or(motion, at_wall);
            let since = |known: &PointMemory<_>| {
                let (then, turn) = (first.rotation * known.place, touch.normal - known.contact_normal);
                slip_growth(first, second, touch, &then, &turn, self.kind, motion.velocity.dot(&touch.normal))
            };
            let contact = PointContact {
                normal: touch.normal,
                overlap: touch.overlap,
                motion,
                slip_by_overlap: Vector::zeros(),
                slip_growth: known.as_ref().filter(|_| Tangential::NEEDS_ROTATION).map_or_else(Vector::zeros, since),
                inverse_reduced_mass: resultant.inverse_reduced_mass,
                inverse_damped_mass: resultant.inverse_damped_mass,
                curvature_radius: f64::NAN,
                share,
                is_new,
            };
            let laws = &self.laws[candidate.laws()];
            let (parts, share) = (*parts, share.stiffness);
            let mut point = PointMemory { parts, place, contact_normal: touch.normal, share, ..known.unwrap_or_default() };
            let (force, _) = force_on_first(laws, &contact, self.kind, &mut point.normal, &mut point.tangential);
            near.points.push(point);
            work.contacts += 1;
            work.deep += u64::from(touch.is_deep);
            pair.force += force;
            pair.torque_on_first += touch.arm_of_first.cross(&force);
            pair.torque_on_second -= touch.arm_of_second.cross(&force);
        }
        (Some(pair), due)
    }
}

impl<Tangential: TangentialLaw> ContactStage for ShapedContacts<Tangential> {
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        self.travel.note(bodies, &self.members);
        self.motions.note(bodies, &self.members);
        let known = KnownOfBodies { travel: &self.travel, motions: &self.motions };
        let forces = ShapedForces { laws: &self.laws, surroundings: &self.surroundings, known, time: self.time, kind };
        let work = self.rows.add_forces(&forces, bodies);
        self.work = self.work.plus(&work);
    }

    fn set_candidates(&mut self, bodies: &Bodies, candidates: Vec<Candidate>, moved: Option<&Relocation>) {
        moved.into_iter().for_each(|moved| self.travel.follow(bodies, moved));
        self.members = candidates.iter().flat_map(Candidate::bodies).map(|index| index as u32).collect();
        self.members.sort_unstable();
        self.members.dedup();
        self.rows.set_candidates(bodies, candidates, moved);
    }

    fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    fn observe(&self, bodies: &Bodies) -> Observation {
        let mut seen = Observation::default();
        let resolution = &self.surroundings.resolution;
        let detector = self.detector(bodies, resolution.points);
        let mut found = Touches::default();
        for (candidate, memory) in self.rows.pairs() {
            found.points.clear();
            let mut near = memory.and_then(|memory| memory.near.as_deref()).cloned().unwrap_or_default();
            detector.look(candidate, &mut near.standing, &mut found, &mut Work::default());
            let touches = &found.points;
            let total = touches.iter().map(|point| point.touch.overlap).sum();
            let laws = &self.laws[candidate.laws()];
            for PointTouch { touch, parts } in touches {
                let place = rotation_of(bodies, candidate.first()).tr_mul(&touch.arm_of_first);
                let known = remembered(&mut near.points, *parts, place, f64::INFINITY).unwrap_or_default();
                if known.normal.ended {
                    continue;
                }
                let at_wall = candidate.second_body().is_none();
                let share = resolution.sharing.share(touch.overlap, total, touches.len(), at_wall);
                seen.contacts += 1;
                seen.largest_overlap = seen.largest_overlap.max(touch.overlap);
                seen.elastic_energy += laws.normal.energy_of_share(touch.overlap, &share);
                seen.elastic_energy += laws.tangential.stored_energy(&known.tangential, share.stiffness);
            }
        }
        seen
    }

    fn name(&self) -> String {
        format!("{}; shaped bodies; {}", LinearSpringDashpot::NAME, Tangential::NAME)
    }

    fn needs_rotation(&self) -> bool {
        true
    }

    fn needs_orientation(&self) -> bool {
        true
    }

    fn candidates(&self) -> &[Candidate] {
        self.rows.candidates()
    }

    fn time_scales(&self, bodies: &Bodies, candidate: &Candidate, lagged_damping: bool) -> TimeScales {
        let laws = &self.laws[candidate.laws()];
        let softest = |index: usize| {
            let arm = bodies.shape(index).bounding_radius();
            bodies.inverse_mass(index) + arm * arm / bodies.inertia(index).min()
        };
        let (mut inverse_mass, mut inverse_reduced) = (softest(candidate.first()), bodies.inverse_mass(candidate.first()));
        if let Some(second) = candidate.second_body() {
            inverse_mass += softest(second);
            inverse_reduced += bodies.inverse_mass(second);
        }
        let parts = candidate.bodies().map(|index| self.surroundings.parts[bodies.shape_index(index)].len()).max();
        let points = CORNERS_OF_A_FACE * parts.unwrap_or(1);
        let (effective, reduced) = (1.0 / inverse_mass, 1.0 / inverse_reduced);
        // A contact of several points is stiffer, which is the same as a lighter body.
        let lightest = effective / self.surroundings.resolution.sharing.largest_stiffness(points);
        let scale = ContactScale {
            effective_mass: effective,
            reduced_mass: reduced,
            curvature_radius: f64::NAN,
            overlap: f64::NAN,
            lagged_damping,
        };
        let of_points = ContactScale { effective_mass: lightest, ..scale };
        let (normal, normal_of_points) = (laws.normal.time_scales(&scale), laws.normal.time_scales(&of_points));
        let (tangential, tangential_of_points) = (laws.tangential.time_scales(&scale), laws.tangential.time_scales(&of_points));
        TimeScales {
            contact_duration: normal_of_points.contact_duration,
            half_period: normal_of_points.half_period.min(tangential_of_points.half_period),
            damping_time: normal_of_points.damping_time.min(tangential.damping_time),
            largest_step: normal.largest_step.min(tangential.largest_step),
            wave_time: f64::INFINITY,
        }
    }

    fn overlap(&mut self, bodies: &Bodies, candidate: &Candidate) -> Option<f64> {
        let mut found = Touches::default();
        self.detector(bodies, Points::Deepest).look(candidate, &mut Standing::default(), &mut found, &mut Work::default());
        // Faces that are to lie on each other overlap or not by rounding.
        let rounding = 1e-12 * bodies.shape(candidate.first()).bounding_radius();
        found.points.iter().map(|point| point.touch.overlap).filter(|overlap| *overlap > rounding).reduce(f64::max)
    }

    fn work(&self) -> Work {
        self.work
    }

    fn save(&self, bodies: &Bodies) -> Result<serde_json::Value, serde_json::Error> {
        serde_json::to_value((self.rows.save(bodies, self.work)?, &self.travel))
    }

    fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<(), serde_json::Error> {
        let (memory, travel): (serde_json::Value, Travel) = serde_json::from_value(saved)?;
        if !travel.is_of(bodies.len()) {
            return Err(serde::de::Error::custom("the checkpoint does not say of all bodies how far they have moved"));
        }
        self.work = self.rows.restore(bodies, memory)?;
        self.travel = travel;
        Ok(())
    }
}

/// Contact points of a face that lies flat, for the stiffness of contacts that are not shared.
const CORNERS_OF_A_FACE: usize = 4;
