//! Spheres that touch spheres and flat walls: closed forms, one contact point, no orientation.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{sphere_plane, sphere_sphere};
use super::law::linear_spring_dashpot::{NormalContact, NormalMemory};
use super::law::{StepKind, TangentialContact, TangentialLaw};
use super::sharing::Share;
use super::stage::{Candidate, ContactKey, ContactStage, Laws, Observation, Partner, TimeScales, Work, key_of};
use crate::boundary::Plane;
use crate::{Bodies, Vector};

/// A contact and what is remembered of it.
type Remembered<History> = (ContactKey, Memory<History>);

/// What is remembered of a candidate pair.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Memory<History> {
    touching: bool,
    normal: NormalMemory,
    tangential: History,
}

/// A contact law over its candidate pairs.
pub struct SphereContacts<Tangential: TangentialLaw> {
    laws: Vec<Laws<Tangential>>,
    walls: Vec<Plane>,
    /// Radii in m by storage index of the bodies; not a number for those that are no spheres.
    radii: Vec<f64>,
    candidates: Vec<Candidate>,
    memory: Vec<Memory<Tangential::History>>,
    work: Work,
}

impl<Tangential: TangentialLaw> SphereContacts<Tangential> {
    /// A stage; candidates must be pairs of spheres or a sphere and a wall, in the order of ids, bodies before walls.
    pub fn new(bodies: &Bodies, laws: Vec<Laws<Tangential>>, walls: Vec<Plane>, candidates: Vec<Candidate>) -> SphereContacts<Tangential> {
        let memory = vec![Memory::default(); candidates.len()];
        let radius = |index: usize| bodies.shape(index).as_sphere().map_or(f64::NAN, |sphere| sphere.radius);
        let radii = (0..bodies.len()).map(radius).collect();
        SphereContacts { laws, walls, radii, candidates, memory, work: Work::default() }
    }
}

#[inline]
fn detect(bodies: &Bodies, radii: &[f64], walls: &[Plane], candidate: &Candidate) -> Option<Touch> {
    let (position, radius) = (&bodies.motion.position[candidate.first], radii[candidate.first]);
    match candidate.second {
        Partner::Body(second) => sphere_sphere(bodies.motion.position[second] - position, radius, radii[second]),
        Partner::Wall(wall) => sphere_plane(position, radius, &walls[wall]),
    }
}

impl<Tangential: TangentialLaw> ContactStage for SphereContacts<Tangential> {
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        self.work.pair_tests += self.candidates.len() as u64;
        for (candidate, memory) in self.candidates.iter().zip(&mut self.memory) {
            let Some(touch) = detect(bodies, &self.radii, &self.walls, candidate) else {
                if memory.touching {
                    *memory = Memory::default();
                }
                continue;
            };
            self.work.contacts += 1;
            self.work.deep += u64::from(touch.is_deep);
            let force = force_on_first(&self.laws[candidate.laws], bodies, candidate, &touch, kind, memory);
            memory.touching = true;
            add_to_bodies::<Tangential>(bodies, candidate, &touch, force);
        }
    }

    fn observe(&self, bodies: &Bodies) -> Observation {
        let mut seen = Observation::default();
        for (candidate, memory) in self.candidates.iter().zip(&self.memory) {
            let Some(touch) = detect(bodies, &self.radii, &self.walls, candidate) else { continue };
            if memory.normal.ended {
                continue;
            }
            let laws = &self.laws[candidate.laws];
            seen.contacts += 1;
            seen.largest_overlap = seen.largest_overlap.max(touch.overlap);
            seen.elastic_energy +=
                laws.normal.stored_energy(touch.overlap, &Share::WHOLE) + laws.tangential.stored_energy(&memory.tangential, 1.0);
        }
        seen
    }

    fn name(&self) -> String {
        format!("spheres; {}", Tangential::NAME)
    }

    fn needs_rotation(&self) -> bool {
        Tangential::NEEDS_ROTATION
    }

    fn needs_orientation(&self) -> bool {
        false
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

    fn overlap(&mut self, bodies: &Bodies, candidate: &Candidate) -> Option<f64> {
        detect(bodies, &self.radii, &self.walls, candidate).map(|touch| touch.overlap)
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
        inverse_damped_mass: motion.inverse_reduced_mass,
        share: Share::WHOLE,
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
            share: 1.0,
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
