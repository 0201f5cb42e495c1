//! One contact law over all its candidate pairs: detect, evaluate, add to the bodies.
//!
//! Candidates are in the order of their ids, bodies before boundaries, and forces are added in that order: for each body the sum then
//! runs over its partners by increasing id, whatever the order of bodies in the scene.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{sphere_plane, sphere_sphere};
use super::law::linear_spring_dashpot::{NormalContact, NormalMemory};
use super::law::{LinearSpringDashpot, StepKind, TangentialContact, TangentialLaw};
use crate::boundary::Plane;
use crate::{Bodies, Vector};

/// A contact law at work, whatever its type. What a [`Simulation`](crate::Simulation) holds.
pub trait ContactStage: Send + Sync {
    /// Detects all contacts and adds their forces and torques to the bodies.
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind);
    /// What the springs hold at the current positions.
    fn observe(&self, bodies: &Bodies) -> Observation;
    /// Name of the tangential law.
    fn name(&self) -> &'static str;
    /// Whether the tangential law turns bodies.
    fn needs_rotation(&self) -> bool;
    /// The pairs of the stage.
    fn candidates(&self) -> &[Candidate];
    /// Time scales of a candidate pair, from the laws between them.
    fn time_scales(&self, bodies: &Bodies, candidate: &Candidate, lagged_damping: bool) -> TimeScales;
    /// Overlap of a candidate pair in m, if it touches.
    fn overlap(&self, bodies: &Bodies, candidate: &Candidate) -> Option<f64>;
    /// Work done since the start.
    fn work(&self) -> Work;
    /// Contact memory and counters, for a checkpoint.
    fn save(&self, bodies: &Bodies) -> Result<serde_json::Value, serde_json::Error>;
    /// Takes back what [`ContactStage::save`] gave.
    fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<(), serde_json::Error>;
}

/// Work counts of a contact stage.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Pairs tested for overlap.
    pub pair_tests: u64,
    /// Contacts whose force was evaluated.
    pub contacts: u64,
    /// Contacts of concentric bodies, whose normal is arbitrary.
    pub concentric: u64,
}

/// What can be seen of the contacts of a stage at one time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Observation {
    /// Touching contacts.
    pub contacts: u64,
    /// Largest overlap in m.
    pub largest_overlap: f64,
    /// Energy stored in normal and tangential springs in J.
    pub elastic_energy: f64,
}

/// Time scales of an isolated contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeScales {
    /// Half period in s of the stiffer of normal and tangential spring, undamped.
    pub half_period: f64,
    /// Time in s of the stronger of normal and tangential dashpot: the step must resolve it where a body has several contacts.
    pub damping_time: f64,
    /// Largest stable step in s of an isolated contact.
    pub largest_step: f64,
}

/// A pair of materials and the laws between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Laws<Tangential> {
    /// Normal law.
    pub normal: LinearSpringDashpot,
    /// Tangential law.
    pub tangential: Tangential,
}

/// A body and what it may touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// Storage index of the first body.
    pub first: usize,
    /// The other side.
    pub second: Partner,
    /// Index of the laws between them.
    pub laws: usize,
}

/// The second side of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Partner {
    /// A body, by storage index.
    Body(usize),
    /// A wall, by index.
    Wall(usize),
}

/// What is remembered of a candidate pair.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Memory<History> {
    touching: bool,
    normal: NormalMemory,
    tangential: History,
}

/// A contact law over its candidate pairs.
pub struct Contacts<Tangential: TangentialLaw> {
    laws: Vec<Laws<Tangential>>,
    walls: Vec<Plane>,
    candidates: Vec<Candidate>,
    memory: Vec<Memory<Tangential::History>>,
    work: Work,
}

impl<Tangential: TangentialLaw> Contacts<Tangential> {
    /// A stage; candidates must be in the order of ids, bodies before walls.
    pub fn new(laws: Vec<Laws<Tangential>>, walls: Vec<Plane>, candidates: Vec<Candidate>) -> Contacts<Tangential> {
        let memory = vec![Memory::default(); candidates.len()];
        Contacts { laws, walls, candidates, memory, work: Work::default() }
    }
}

#[inline]
fn detect(bodies: &Bodies, walls: &[Plane], candidate: &Candidate) -> Option<Touch> {
    let position = &bodies.motion.position[candidate.first];
    let first = bodies.shape(candidate.first).as_sphere()?;
    match candidate.second {
        Partner::Body(second) => {
            let other = bodies.shape(second).as_sphere()?;
            sphere_sphere(bodies.motion.position[second] - position, first.radius, other.radius)
        }
        Partner::Wall(wall) => sphere_plane(position, first.radius, &walls[wall]),
    }
}

impl<Tangential: TangentialLaw> ContactStage for Contacts<Tangential> {
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        self.work.pair_tests += self.candidates.len() as u64;
        for (candidate, memory) in self.candidates.iter().zip(&mut self.memory) {
            let Some(touch) = detect(bodies, &self.walls, candidate) else {
                if memory.touching {
                    *memory = Memory::default();
                }
                continue;
            };
            self.work.contacts += 1;
            self.work.concentric += u64::from(touch.is_concentric);
            let force = force_on_first(&self.laws[candidate.laws], bodies, candidate, &touch, kind, memory);
            memory.touching = true;
            add_to_bodies::<Tangential>(bodies, candidate, &touch, force);
        }
    }

    fn observe(&self, bodies: &Bodies) -> Observation {
        let mut seen = Observation::default();
        for (candidate, memory) in self.candidates.iter().zip(&self.memory) {
            let Some(touch) = detect(bodies, &self.walls, candidate) else { continue };
            if memory.normal.ended {
                continue;
            }
            let laws = &self.laws[candidate.laws];
            seen.contacts += 1;
            seen.largest_overlap = seen.largest_overlap.max(touch.overlap);
            seen.elastic_energy += laws.normal.stored_energy(touch.overlap) + laws.tangential.stored_energy(&memory.tangential);
        }
        seen
    }

    fn name(&self) -> &'static str {
        Tangential::NAME
    }

    fn needs_rotation(&self) -> bool {
        Tangential::NEEDS_ROTATION
    }

    fn candidates(&self) -> &[Candidate] {
        &self.candidates
    }

    fn time_scales(&self, bodies: &Bodies, candidate: &Candidate, lagged_damping: bool) -> TimeScales {
        let laws = &self.laws[candidate.laws];
        let point = |index: usize| {
            let arm = Vector::x() * bodies.shape(index).bounding_radius();
            material_point::<Tangential>(bodies, index, &arm)
        };
        let first = point(candidate.first);
        let (mut inverse_reduced, mut inverse_tangential) = (first.inverse_mass, first.inverse_tangential_mass);
        if let Partner::Body(second) = candidate.second {
            let second = point(second);
            inverse_reduced += second.inverse_mass;
            inverse_tangential += second.inverse_tangential_mass;
        }
        let (reduced, tangential) = (1.0 / inverse_reduced, 1.0 / inverse_tangential);
        TimeScales {
            half_period: laws.normal.half_period(reduced).min(laws.tangential.half_period(tangential)),
            damping_time: laws.normal.damping_time(reduced).min(laws.tangential.damping_time(tangential, reduced)),
            largest_step: (laws.normal.largest_step(reduced, lagged_damping)).min(laws.tangential.largest_step(
                tangential,
                reduced,
                lagged_damping,
            )),
        }
    }

    fn overlap(&self, bodies: &Bodies, candidate: &Candidate) -> Option<f64> {
        detect(bodies, &self.walls, candidate).map(|touch| touch.overlap)
    }

    fn work(&self) -> Work {
        self.work
    }

    fn save(&self, bodies: &Bodies) -> Result<serde_json::Value, serde_json::Error> {
        let touching = self.candidates.iter().zip(&self.memory).filter(|(_, memory)| memory.touching);
        let remembered: Vec<_> = touching.map(|(candidate, memory)| (key_of(bodies, candidate), memory)).collect();
        serde_json::to_value((remembered, &self.work))
    }

    fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<(), serde_json::Error> {
        let (remembered, work): (Vec<Remembered<Tangential::History>>, Work) = serde_json::from_value(saved)?;
        self.memory.fill(Memory::default());
        self.work = work;
        for (key, memory) in remembered {
            let Ok(place) = self.candidates.binary_search_by_key(&key, |candidate| key_of(bodies, candidate)) else {
                return Err(serde::de::Error::custom(format!("the checkpoint remembers a contact that cannot be: {key:?}")));
            };
            self.memory[place] = memory;
        }
        Ok(())
    }
}

/// Name of a contact that outlives any reordering: whether the partner is a wall, id of the first body, id or index of the partner.
type ContactKey = (bool, u32, u32);

/// A contact and what is remembered of it.
type Remembered<History> = (ContactKey, Memory<History>);

fn key_of(bodies: &Bodies, candidate: &Candidate) -> ContactKey {
    let first = bodies.id(candidate.first);
    match candidate.second {
        Partner::Body(second) => (false, first, bodies.id(second)),
        Partner::Wall(wall) => (true, first, wall as u32),
    }
}

/// Relative motion of the two material points at a contact.
struct RelativeMotion {
    velocity: Vector,
    acceleration: Vector,
    inverse_reduced_mass: f64,
    /// Inverse effective mass along the contact plane, in 1/kg.
    inverse_tangential_mass: f64,
}

impl RelativeMotion {
    fn new<Tangential: TangentialLaw>(bodies: &Bodies, candidate: &Candidate, touch: &Touch) -> RelativeMotion {
        let first = material_point::<Tangential>(bodies, candidate.first, &touch.arm_of_first);
        match candidate.second {
            Partner::Body(second) => {
                let second = material_point::<Tangential>(bodies, second, &touch.arm_of_second);
                RelativeMotion {
                    velocity: first.velocity - second.velocity,
                    acceleration: first.acceleration - second.acceleration,
                    inverse_reduced_mass: first.inverse_mass + second.inverse_mass,
                    inverse_tangential_mass: first.inverse_tangential_mass + second.inverse_tangential_mass,
                }
            }
            Partner::Wall(_) => RelativeMotion {
                velocity: first.velocity,
                acceleration: first.acceleration,
                inverse_reduced_mass: first.inverse_mass,
                inverse_tangential_mass: first.inverse_tangential_mass,
            },
        }
    }
}

/// Motion of a body's material point and the inverse masses it shows to a contact.
struct MaterialPoint {
    velocity: Vector,
    acceleration: Vector,
    inverse_mass: f64,
    inverse_tangential_mass: f64,
}

fn material_point<Tangential: TangentialLaw>(bodies: &Bodies, index: usize, arm: &Vector) -> MaterialPoint {
    let motion = &bodies.motion;
    let inverse_mass = bodies.inverse_mass(index);
    let mut point = MaterialPoint {
        velocity: motion.velocity[index],
        acceleration: motion.acceleration[index],
        inverse_mass,
        inverse_tangential_mass: inverse_mass,
    };
    if Tangential::NEEDS_ROTATION {
        point.velocity += motion.angular_velocity[index].cross(arm);
        point.acceleration += motion.angular_acceleration[index].cross(arm);
        point.inverse_tangential_mass += arm.norm_squared() / bodies.inertia(index).x;
    }
    point
}

fn force_on_first<Tangential: TangentialLaw>(
    laws: &Laws<Tangential>,
    bodies: &Bodies,
    candidate: &Candidate,
    touch: &Touch,
    kind: &StepKind,
    memory: &mut Memory<Tangential::History>,
) -> Vector {
    let motion = RelativeMotion::new::<Tangential>(bodies, candidate, touch);
    let normal = &touch.normal;
    let approach_rate = motion.velocity.dot(normal);
    let approach_acceleration = motion.acceleration.dot(normal);
    let contact = NormalContact {
        overlap: touch.overlap,
        is_new: !memory.touching,
        approach_rate,
        approach_acceleration,
        inverse_effective_mass: motion.inverse_reduced_mass,
    };
    let normal_force = laws.normal.mean_force(&contact, kind, &mut memory.normal);
    let mut force = normal * -normal_force.mean;
    if Tangential::NEEDS_ROTATION {
        let contact = TangentialContact {
            normal: *normal,
            velocity: motion.velocity - normal * approach_rate,
            acceleration: motion.acceleration - normal * approach_acceleration,
            normal_force: normal_force.mean,
            elastic_force: normal_force.elastic,
            effective_mass: 1.0 / motion.inverse_tangential_mass,
            reduced_mass: 1.0 / motion.inverse_reduced_mass,
            touched_before: normal_force.touched_before,
            touched: normal_force.touched,
        };
        force += laws.tangential.mean_force(&contact, kind, &mut memory.tangential);
    }
    force
}

fn add_to_bodies<Tangential: TangentialLaw>(bodies: &mut Bodies, candidate: &Candidate, touch: &Touch, force: Vector) {
    let motion = &mut bodies.motion;
    motion.force[candidate.first] += force;
    if Tangential::NEEDS_ROTATION {
        motion.torque[candidate.first] += touch.arm_of_first.cross(&force);
    }
    if let Partner::Body(second) = candidate.second {
        motion.force[second] -= force;
        if Tangential::NEEDS_ROTATION {
            motion.torque[second] -= touch.arm_of_second.cross(&force);
        }
    }
}
