//! Bodies of any shape, convex or glued: several contact points between the same two bodies.
//!
//! For every candidate pair the parts of both bodies are looked at, each contact point gets its share of the law, and what a point must remember is
//! found again by its place on the first body, because points come, go and change their order.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{OneSided, PlacedCore, PlacedSurface, Points, VertexSurface, core_pair, core_plane, vertex_pair, vertex_plane};
use super::force::{PointContact, force_on_first};
use super::law::normal::NormalMemory;
use super::law::{ContactScale, LinearSpringDashpot, NormalLaw, StepKind, TangentialLaw};
use super::rigid_motion::{RigidMotion, relative_motion};
use super::sharing::{DampedMass, Sharing};
use super::stage::{Candidate, ContactStage, Laws, Observation, Partner, TimeScales, Work, restore_memory, save_memory};
use crate::boundary::Plane;
use crate::distance::{Guess, Pose, RoundedCore};
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

/// A contact point and the parts it lies between.
#[derive(Debug, Clone, Copy)]
struct PointTouch {
    touch: Touch,
    parts: [u32; 2],
}

/// A contact law over candidate pairs of shaped bodies.
pub struct ShapedContacts<Tangential: TangentialLaw> {
    laws: Vec<Laws<Tangential>>,
    walls: Vec<Plane>,
    /// Parts of each body, by storage index.
    parts: Vec<std::sync::Arc<[DetectedPart]>>,
    resolution: Resolution,
    candidates: Vec<Candidate>,
    memory: Vec<Memory<Tangential::History>>,
    work: Work,
}

/// A point is the same as one of the last step if it lies within this part of the smaller part's size of it.
const SAME_PLACE: f64 = 0.2;

impl<Tangential: TangentialLaw> ShapedContacts<Tangential> {
    /// A stage; candidates must be in the order of ids, bodies before walls.
    pub fn new(
        laws: Vec<Laws<Tangential>>,
        walls: Vec<Plane>,
        parts: Vec<std::sync::Arc<[DetectedPart]>>,
        resolution: Resolution,
        candidates: Vec<Candidate>,
    ) -> ShapedContacts<Tangential> {
        let memory = vec![Memory::default(); candidates.len()];
        ShapedContacts { laws, walls, parts, resolution, candidates, memory, work: Work::default() }
    }
}

/// Looks at all parts of a candidate pair.
struct Detector<'a> {
    bodies: &'a Bodies,
    walls: &'a [Plane],
    parts: &'a [std::sync::Arc<[DetectedPart]>],
    points: Points,
    one_sided: OneSided,
}

impl Detector<'_> {
    fn placed<'b>(&self, index: usize, part: &DetectedPart, rounded: &'b RoundedCore) -> PlacedCore<'b> {
        let centre_of_body = self.bodies.position(index);
        let orientation = self.bodies.motion.orientation[index];
        let rotation = *(orientation * part.orientation).to_rotation_matrix().matrix();
        let pose = Pose { position: centre_of_body + orientation * part.position, rotation };
        PlacedCore { rounded, pose, centre_of_body }
    }

    /// All contact points of a candidate pair, in the order of their parts.
    fn look(&self, candidate: &Candidate, guesses: &mut Vec<Option<Guess>>, work: &mut Work) -> Vec<PointTouch> {
        match candidate.second {
            Partner::Wall(wall) => self.look_at_wall(candidate.first, &self.walls[wall], work),
            Partner::Body(second) => self.look_at_bodies(candidate.first, second, guesses, work),
        }
    }

    fn look_at_wall(&self, index: usize, wall: &Plane, work: &mut Work) -> Vec<PointTouch> {
        let mut found = Vec::new();
        if wall.height(&self.bodies.position(index)) >= self.bodies.shape(index).bounding_radius() {
            return found;
        }
        let mut touches = Vec::new();
        for (place, part) in self.parts[index].iter().enumerate() {
            work.pair_tests += 1;
            let core = self.placed(index, part, &part.against_walls);
            match &part.vertices {
                Some(surface) => vertex_plane(&on_surface(&core, surface), wall, &mut touches),
                None => core_plane(&core, wall, self.points, &mut touches),
            }
            found.extend(touches.drain(..).map(|touch| PointTouch { touch, parts: [place as u32, 0] }));
        }
        found
    }

    fn look_at_bodies(&self, first: usize, second: usize, guesses: &mut Vec<Option<Guess>>, work: &mut Work) -> Vec<PointTouch> {
        let mut found = Vec::new();
        let between = self.bodies.position(second) - self.bodies.position(first);
        let reach = self.bodies.shape(first).bounding_radius() + self.bodies.shape(second).bounding_radius();
        if between.norm_squared() >= reach * reach {
            guesses.clear();
            return found;
        }
        let (parts_of_first, parts_of_second) = (&self.parts[first], &self.parts[second]);
        guesses.resize(parts_of_first.len() * parts_of_second.len(), None);
        let others: Vec<_> = parts_of_second.iter().map(|part| self.placed(second, part, &part.against_bodies)).collect();
        let mut touches = Vec::new();
        for (place, part) in parts_of_first.iter().enumerate() {
            let one = self.placed(first, part, &part.against_bodies);
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
                        self.one_sided,
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

impl<Tangential: TangentialLaw> ShapedContacts<Tangential> {
    fn add_forces_of(&mut self, index: usize, bodies: &mut Bodies, kind: &StepKind) {
        let (candidate, memory) = (self.candidates[index], &mut self.memory[index]);
        let detector = Detector {
            bodies,
            walls: &self.walls,
            parts: &self.parts,
            points: self.resolution.points,
            one_sided: self.resolution.one_sided,
        };
        let touches = detector.look(&candidate, &mut memory.guesses, &mut self.work);
        if touches.is_empty() {
            memory.points.clear();
            return;
        }
        let first = RigidMotion::of(bodies, candidate.first);
        let second = match candidate.second {
            Partner::Body(second) => Some(RigidMotion::of(bodies, second)),
            Partner::Wall(_) => None,
        };
        let resultant = Resultant::new(&first, second.as_ref(), &touches, &self.resolution);
        let mut old = std::mem::take(&mut memory.points);
        let to_first = bodies.motion.orientation[candidate.first].inverse();
        for PointTouch { touch, parts } in &touches {
            let place = to_first * touch.arm_of_first;
            let part_size = |body: usize, part: u32| self.parts[body][part as usize].bounding_radius;
            let size = match candidate.second {
                Partner::Body(second) => part_size(candidate.first, parts[0]).min(part_size(second, parts[1])),
                Partner::Wall(_) => part_size(candidate.first, parts[0]),
            };
            let known = remembered(&mut old, *parts, place, SAME_PLACE * size);
            let is_new = known.is_none();
            let share = self.resolution.sharing.share(touch.overlap, resultant.total_overlap, touches.len(), second.is_none());
            let mut point = known.unwrap_or_default();
            (point.parts, point.place, point.share) = (*parts, place, share.stiffness);
            let laws = &self.laws[candidate.laws];
            let contact = PointContact {
                normal: touch.normal,
                overlap: touch.overlap,
                motion: relative_motion(&first, second.as_ref(), touch),
                slip_by_overlap: Vector::zeros(),
                inverse_reduced_mass: resultant.inverse_reduced_mass,
                inverse_damped_mass: resultant.inverse_damped_mass,
                curvature_radius: f64::NAN,
                share,
                is_new,
            };
            let (force, _) = force_on_first(laws, &contact, kind, &mut point.normal, &mut point.tangential);
            memory.points.push(point);
            self.work.contacts += 1;
            self.work.deep += u64::from(touch.is_deep);
            add_to_bodies(bodies, &candidate, touch, force);
        }
    }
}

fn add_to_bodies(bodies: &mut Bodies, candidate: &Candidate, touch: &Touch, force: Vector) {
    let motion = &mut bodies.motion;
    motion.force[candidate.first] += force;
    motion.torque[candidate.first] += touch.arm_of_first.cross(&force);
    if let Partner::Body(second) = candidate.second {
        motion.force[second] -= force;
        motion.torque[second] -= touch.arm_of_second.cross(&force);
    }
}

impl<Tangential: TangentialLaw> ContactStage for ShapedContacts<Tangential> {
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        for index in 0..self.candidates.len() {
            self.add_forces_of(index, bodies, kind);
        }
    }

    fn observe(&self, bodies: &Bodies) -> Observation {
        let mut seen = Observation::default();
        let detector = Detector {
            bodies,
            walls: &self.walls,
            parts: &self.parts,
            points: self.resolution.points,
            one_sided: self.resolution.one_sided,
        };
        for (candidate, memory) in self.candidates.iter().zip(&self.memory) {
            let touches = detector.look(candidate, &mut memory.guesses.clone(), &mut Work::default());
            let total = touches.iter().map(|point| point.touch.overlap).sum();
            let laws = &self.laws[candidate.laws];
            let mut old = memory.points.clone();
            for PointTouch { touch, parts } in &touches {
                let place = bodies.motion.orientation[candidate.first].inverse() * touch.arm_of_first;
                let known = remembered(&mut old, *parts, place, f64::INFINITY).unwrap_or_default();
                if known.normal.ended {
                    continue;
                }
                let at_wall = matches!(candidate.second, Partner::Wall(_));
                let share = self.resolution.sharing.share(touch.overlap, total, touches.len(), at_wall);
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
        let laws = &self.laws[candidate.laws];
        let softest = |index: usize| {
            let arm = bodies.shape(index).bounding_radius();
            bodies.inverse_mass(index) + arm * arm / bodies.inertia(index).min()
        };
        let (mut inverse_mass, mut inverse_reduced) = (softest(candidate.first), bodies.inverse_mass(candidate.first));
        if let Partner::Body(second) = candidate.second {
            inverse_mass += softest(second);
            inverse_reduced += bodies.inverse_mass(second);
        }
        let points = CORNERS_OF_A_FACE * self.parts[candidate.first].len();
        let (effective, reduced) = (1.0 / inverse_mass, 1.0 / inverse_reduced);
        // A contact of several points is stiffer, which is the same as a lighter body.
        let lightest = effective / self.resolution.sharing.largest_stiffness(points);
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
        let detector =
            Detector { bodies, walls: &self.walls, parts: &self.parts, points: Points::Deepest, one_sided: self.resolution.one_sided };
        let touches = detector.look(candidate, &mut Vec::new(), &mut Work::default());
        // Faces that are to lie on each other overlap or not by rounding.
        let rounding = 1e-12 * bodies.shape(candidate.first).bounding_radius();
        touches.iter().map(|point| point.touch.overlap).filter(|overlap| *overlap > rounding).reduce(f64::max)
    }

    fn work(&self) -> Work {
        self.work
    }

    fn save(&self, bodies: &Bodies) -> Result<serde_json::Value, serde_json::Error> {
        save_memory(bodies, &self.candidates, &self.memory, |memory| !(memory.points.is_empty() && memory.guesses.is_empty()), self.work)
    }

    fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<(), serde_json::Error> {
        self.work = restore_memory(bodies, &self.candidates, &mut self.memory, saved)?;
        Ok(())
    }
}

/// Contact points of a face that lies flat, for the stiffness of contacts that are not shared.
const CORNERS_OF_A_FACE: usize = 4;
