//! Bodies of any shape, convex or glued: several contact points between the same two bodies.
//!
//! For every candidate pair the parts of both bodies are looked at, each contact point gets its share of the law, and what a point must remember is
//! found again by its place on the first body, because points come, go and change their order.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{
    OneSided, PlacedCore, PlacedSurface, Points, VertexSurface, core_pair, core_plane, core_vessel, vertex_pair, vertex_plane,
};
use super::force::{PointContact, force_on_first};
use super::law::normal::NormalMemory;
use super::law::{ContactScale, LinearSpringDashpot, NormalLaw, StepKind, TangentialLaw};
use super::pairs::{Candidate, Partner, carry_over, restore_memory, save_memory};
use super::rigid_motion::{RigidMotion, relative_motion};
use super::sharing::{DampedMass, Sharing};
use super::stage::{ContactStage, Laws, Observation, TimeScales, Work};
use super::sweep::{Forces, Found, PairForce, PairLaw, Pairs, Parts, Rows, add_pair_forces, parts_wanted};
use crate::boundary::{MovingWall, PlacedWall, placed};
use crate::distance::{Guess, Pose, RoundedCore};
use crate::domain::{Image, Shifts};
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
    /// Radius in m of a ball about the centre that holds the part.
    pub bounding_radius: f64,
}

/// What a contact point remembers.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct PointMemory<History> {
    parts: [u32; 2],
    /// On the first body, in its own frame, in m.
    place: Vector,
    /// The share of the law at the last look.
    share: f64,
    normal: NormalMemory,
    tangential: History,
}

/// What is remembered of a candidate pair.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Memory<History> {
    points: Vec<PointMemory<History>>,
    /// What the last look at each two parts left for the next; empty while the bodies are far apart.
    guesses: Vec<Option<Guess>>,
}

impl<History> Memory<History> {
    fn is_used(&self) -> bool {
        !(self.points.is_empty() && self.guesses.is_empty())
    }
}

/// A contact point and the parts it lies between.
#[derive(Debug, Clone, Copy)]
struct PointTouch {
    touch: Touch,
    parts: [u32; 2],
}

/// A contact law over candidate pairs of shaped bodies.
pub struct ShapedContacts<Tangential: TangentialLaw> {
    laws: Vec<Laws<Tangential>>,
    surroundings: Surroundings,
    candidates: Vec<Candidate>,
    parts: Parts,
    memory: Vec<Memory<Tangential::History>>,
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
        let (candidates, parts, memory, work) = (Vec::new(), Parts::default(), Vec::new(), Work::default());
        ShapedContacts { laws, surroundings, candidates, parts, memory, work, time: 0.0 }
    }

    /// Whoever looks at contacts now, as closely as he asks for.
    fn detector<'a>(&'a self, bodies: &'a Bodies, points: Points) -> Detector<'a> {
        Detector { bodies, surroundings: &self.surroundings, walls: placed(&self.surroundings.walls, self.time), points }
    }
}

/// Looks at all parts of a candidate pair.
struct Detector<'a> {
    bodies: &'a Bodies,
    surroundings: &'a Surroundings,
    /// Where they are now.
    walls: Vec<Option<PlacedWall<'a>>>,
    points: Points,
}

impl Detector<'_> {
    fn parts(&self, index: usize) -> &[DetectedPart] {
        &self.surroundings.parts[self.bodies.shape_index(index)]
    }

    fn placed<'b>(&self, index: usize, shift: &Vector, part: &DetectedPart, rounded: &'b RoundedCore) -> PlacedCore<'b> {
        let centre_of_body = self.bodies.position(index) + shift;
        let orientation = self.bodies.orientation(index);
        let rotation = *(orientation * part.orientation).to_rotation_matrix().matrix();
        let pose = Pose { position: centre_of_body + orientation * part.position, rotation };
        PlacedCore { rounded, pose, centre_of_body }
    }

    /// All contact points of a candidate pair, in the order of their parts.
    fn look(&self, candidate: &Candidate, guesses: &mut Vec<Option<Guess>>, work: &mut Work) -> Vec<PointTouch> {
        match candidate.second() {
            Partner::Wall(wall) => self.walls[wall].as_ref().map_or_else(Vec::new, |wall| self.look_at_wall(candidate.first(), wall, work)),
            Partner::Body(second) => self.look_at_bodies(candidate.first(), second, candidate.image, guesses, work),
        }
    }

    fn look_at_wall(&self, index: usize, wall: &PlacedWall<'_>, work: &mut Work) -> Vec<PointTouch> {
        let mut found = Vec::new();
        if wall.distance(&self.bodies.position(index)) >= self.bodies.shape(index).bounding_radius() {
            return found;
        }
        let (plane, vessel) = (wall.as_plane(), wall.as_vessel());
        let mut touches = Vec::new();
        for (place, part) in self.parts(index).iter().enumerate() {
            let core = self.placed(index, &Vector::zeros(), part, &part.against_walls);
            work.pair_tests += 1;
            match (&plane, &part.vertices, &vessel) {
                (Some(plane), Some(surface), _) => vertex_plane(&on_surface(&core, surface), plane, &mut touches),
                (Some(plane), None, _) => core_plane(&core, plane, self.points, &mut touches),
                (None, _, Some(vessel)) => core_vessel(&core, vessel, self.points, &mut touches),
                (None, _, None) => {
                    let core = PlacedCore { rounded: &part.against_bodies, ..core };
                    self.look_at_pieces(&core, part.bounding_radius, wall, &mut touches, work);
                }
            }
            found.extend(touches.drain(..).map(|touch| PointTouch { touch, parts: [place as u32, 0] }));
        }
        found
    }

    /// Of a wall of convex pieces, which have edges and corners as bodies do.
    fn look_at_pieces(&self, core: &PlacedCore<'_>, reach: f64, wall: &PlacedWall<'_>, touches: &mut Vec<Touch>, work: &mut Work) {
        wall.each_piece_within(&core.pose.position, reach, |piece| {
            let piece = PlacedCore { rounded: &piece.rounded, pose: piece.pose, centre_of_body: piece.pose.position };
            work.corners += u64::from(core_pair(core, &piece, None, self.points, touches).corners);
        });
    }

    fn look_at_bodies(
        &self,
        first: usize,
        second: usize,
        image: Image,
        guesses: &mut Vec<Option<Guess>>,
        work: &mut Work,
    ) -> Vec<PointTouch> {
        let mut found = Vec::new();
        let shift = self.surroundings.shifts.shift(image);
        let between = self.bodies.position(second) + shift - self.bodies.position(first);
        let reach = self.bodies.shape(first).bounding_radius() + self.bodies.shape(second).bounding_radius();
        if between.norm_squared() >= reach * reach {
            guesses.clear();
            return found;
        }
        let (parts_of_first, parts_of_second) = (self.parts(first), self.parts(second));
        guesses.resize(parts_of_first.len() * parts_of_second.len(), None);
        let others: Vec<_> = parts_of_second.iter().map(|part| self.placed(second, shift, part, &part.against_bodies)).collect();
        let mut touches = Vec::new();
        for (place, part) in parts_of_first.iter().enumerate() {
            let one = self.placed(first, &Vector::zeros(), part, &part.against_bodies);
            for (other_place, (other, other_part)) in others.iter().zip(parts_of_second.iter()).enumerate() {
                let guess = &mut guesses[place * parts_of_second.len() + other_place];
                let reach = part.bounding_radius + other_part.bounding_radius;
                if (other.pose.position - one.pose.position).norm_squared() >= reach * reach {
                    *guess = None;
                    continue;
                }
                work.pair_tests += 1;
                let look = match (&part.vertices, &other_part.vertices) {
                    (Some(own), Some(others)) => vertex_pair(
                        &on_surface(&one, own),
                        &on_surface(other, others),
                        guess.map(|guess| guess.direction),
                        self.surroundings.resolution.one_sided,
                        &mut touches,
                    ),
                    _ => core_pair(&one, other, *guess, self.points, &mut touches),
                };
                *guess = Some(look.guess);
                work.corners += u64::from(look.corners);
                found.extend(touches.drain(..).map(|touch| PointTouch { touch, parts: [place as u32, other_place as u32] }));
            }
        }
        found
    }
}

/// A part seen as a surface of vertices.
fn on_surface<'a>(core: &PlacedCore<'_>, surface: &'a VertexSurface) -> PlacedSurface<'a> {
    PlacedSurface { surface, pose: core.pose, centre_of_body: core.centre_of_body }
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
    time: f64,
    kind: &'a StepKind,
}

impl<Tangential: TangentialLaw> PairLaw for ShapedForces<'_, Tangential> {
    type Memory = Memory<Tangential::History>;
    const TURNS: bool = true;

    fn evaluate(&self, bodies: &Bodies, rows: &mut Rows<'_, Self::Memory>, pairs: &Pairs<'_>, found: &mut Forces<'_, '_>) -> Work {
        let mut work = Work::default();
        let (surroundings, walls) = (self.surroundings, placed(&self.surroundings.walls, self.time));
        let detector = Detector { bodies, surroundings, walls, points: surroundings.resolution.points };
        for &place in pairs.places {
            let (candidate, memory) = (&mut rows.candidates[place as usize], &mut rows.memory[place as usize]);
            let force = self.force(&detector, candidate, memory, &mut work);
            candidate.is_remembered = memory.is_used();
            if let Some(force) = force {
                found.push(&Found { place, candidate: *candidate, force });
            }
        }
        work
    }
}

impl<Tangential: TangentialLaw> ShapedForces<'_, Tangential> {
    fn force(
        &self,
        detector: &Detector<'_>,
        candidate: &Candidate,
        memory: &mut Memory<Tangential::History>,
        work: &mut Work,
    ) -> Option<PairForce> {
        let (bodies, resolution) = (detector.bodies, &self.surroundings.resolution);
        let touches = detector.look(candidate, &mut memory.guesses, work);
        if touches.is_empty() {
            memory.points.clear();
            return None;
        }
        let first = RigidMotion::of(bodies, candidate.first());
        let second = candidate.second_body().map(|second| RigidMotion::of(bodies, second));
        let wall = match candidate.second() {
            Partner::Wall(wall) => detector.walls[wall].as_ref(),
            Partner::Body(_) => None,
        };
        let resultant = Resultant::new(&first, second.as_ref(), &touches, resolution);
        let mut old = std::mem::take(&mut memory.points);
        let to_first = bodies.orientation(candidate.first()).inverse();
        let mut pair = PairForce::default();
        for PointTouch { touch, parts } in &touches {
            let place = to_first * touch.arm_of_first;
            let part_size = |body: usize, part: u32| detector.parts(body)[part as usize].bounding_radius;
            let own_size = part_size(candidate.first(), parts[0]);
            let size = candidate.second_body().map_or(own_size, |second| own_size.min(part_size(second, parts[1])));
            let known = remembered(&mut old, *parts, place, SAME_PLACE * size);
            let is_new = known.is_none();
            let share = resolution.sharing.share(touch.overlap, resultant.total_overlap, touches.len(), second.is_none());
            let mut point = known.unwrap_or_default();
            (point.parts, point.place, point.share) = (*parts, place, share.stiffness);
            let motion = relative_motion(&first, second.as_ref(), touch);
            let at_wall = |wall| motion.against(wall, &(bodies.position(candidate.first()) + touch.arm_of_first), self.kind);
            let contact = PointContact {
                normal: touch.normal,
                overlap: touch.overlap,
                motion: wall.map_or(motion, at_wall),
                slip_by_overlap: Vector::zeros(),
                inverse_reduced_mass: resultant.inverse_reduced_mass,
                inverse_damped_mass: resultant.inverse_damped_mass,
                curvature_radius: f64::NAN,
                share,
                is_new,
            };
            let laws = &self.laws[candidate.laws()];
            let (force, _) = force_on_first(laws, &contact, self.kind, &mut point.normal, &mut point.tangential);
            memory.points.push(point);
            work.contacts += 1;
            work.deep += u64::from(touch.is_deep);
            pair.force += force;
            pair.torque_on_first += touch.arm_of_first.cross(&force);
            pair.torque_on_second -= touch.arm_of_second.cross(&force);
        }
        Some(pair)
    }
}

impl<Tangential: TangentialLaw> ContactStage for ShapedContacts<Tangential> {
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        let forces = ShapedForces { laws: &self.laws, surroundings: &self.surroundings, time: self.time, kind };
        let rows = Rows { candidates: &mut self.candidates, memory: &mut self.memory };
        let work = add_pair_forces(&forces, bodies, rows, &self.parts);
        self.work = self.work.plus(&work);
    }

    fn set_candidates(&mut self, bodies: &Bodies, mut candidates: Vec<Candidate>, moved: Option<&Relocation>) {
        self.memory = carry_over(&self.candidates, std::mem::take(&mut self.memory), &mut candidates, moved);
        self.parts = Parts::new(&candidates, bodies.len(), parts_wanted(&candidates));
        self.candidates = candidates;
    }

    fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    fn observe(&self, bodies: &Bodies) -> Observation {
        let mut seen = Observation::default();
        let resolution = &self.surroundings.resolution;
        let detector = self.detector(bodies, resolution.points);
        for (candidate, memory) in self.candidates.iter().zip(&self.memory) {
            let touches = detector.look(candidate, &mut memory.guesses.clone(), &mut Work::default());
            let total = touches.iter().map(|point| point.touch.overlap).sum();
            let laws = &self.laws[candidate.laws()];
            let mut old = memory.points.clone();
            for PointTouch { touch, parts } in &touches {
                let place = bodies.orientation(candidate.first()).inverse() * touch.arm_of_first;
                let known = remembered(&mut old, *parts, place, f64::INFINITY).unwrap_or_default();
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
        &self.candidates
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
        let touches = self.detector(bodies, Points::Deepest).look(candidate, &mut Vec::new(), &mut Work::default());
        // Faces that are to lie on each other overlap or not by rounding.
        let rounding = 1e-12 * bodies.shape(candidate.first()).bounding_radius();
        touches.iter().map(|point| point.touch.overlap).filter(|overlap| *overlap > rounding).reduce(f64::max)
    }

    fn work(&self) -> Work {
        self.work
    }

    fn save(&self, bodies: &Bodies) -> Result<serde_json::Value, serde_json::Error> {
        save_memory(bodies, &self.candidates, &self.memory, self.work)
    }

    fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<(), serde_json::Error> {
        self.work = restore_memory(bodies, &mut self.candidates, &mut self.memory, saved)?;
        Ok(())
    }
}

/// Contact points of a face that lies flat, for the stiffness of contacts that are not shared.
const CORNERS_OF_A_FACE: usize = 4;
