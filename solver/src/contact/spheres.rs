//! Spheres that touch spheres and flat walls: closed forms, one contact point, no orientation.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{sphere_plane, sphere_sphere};
use super::force::{PointContact, RelativeMotion, force_on_first};
use super::law::linear_spring_dashpot::NormalMemory;
use super::law::{StepKind, TangentialLaw};
use super::sharing::Share;
use super::stage::{Candidate, ContactStage, Laws, Observation, Partner, TimeScales, Work, restore_memory, save_memory};
use crate::boundary::Plane;
use crate::{Bodies, Vector};

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
            let motion = relative_motion::<Tangential>(bodies, candidate, &touch);
            let point = PointContact {
                normal: touch.normal,
                overlap: touch.overlap,
                motion,
                inverse_reduced_mass: motion.inverse_normal_mass,
                inverse_damped_mass: motion.inverse_normal_mass,
                share: Share::WHOLE,
                is_new: !memory.touching,
            };
            let force = force_on_first(&self.laws[candidate.laws], &point, kind, &mut memory.normal, &mut memory.tangential);
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
        let (mut inverse_reduced, mut inverse_tangential) = (first.inverse_normal_mass, first.inverse_tangential_mass);
        if let Partner::Body(second) = candidate.second {
            let second = point(second);
            inverse_reduced += second.inverse_normal_mass;
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
        save_memory(bodies, &self.candidates, &self.memory, |memory| memory.touching, self.work)
    }

    fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<(), serde_json::Error> {
        self.work = restore_memory(bodies, &self.candidates, &mut self.memory, saved)?;
        Ok(())
    }
}

/// Relative motion at the contact point. Head-on forces do not turn spheres: along the normal they weigh their mass.
#[inline]
fn relative_motion<Tangential: TangentialLaw>(bodies: &Bodies, candidate: &Candidate, touch: &Touch) -> RelativeMotion {
    let first = material_point::<Tangential>(bodies, candidate.first, &touch.arm_of_first);
    let Partner::Body(second) = candidate.second else { return first };
    let second = material_point::<Tangential>(bodies, second, &touch.arm_of_second);
    RelativeMotion {
        velocity: first.velocity - second.velocity,
        acceleration: first.acceleration - second.acceleration,
        inverse_normal_mass: first.inverse_normal_mass + second.inverse_normal_mass,
        inverse_tangential_mass: first.inverse_tangential_mass + second.inverse_tangential_mass,
    }
}

/// Motion of a body's material point and the inverse masses it shows to a contact.
#[inline]
fn material_point<Tangential: TangentialLaw>(bodies: &Bodies, index: usize, arm: &Vector) -> RelativeMotion {
    let motion = &bodies.motion;
    let inverse_mass = bodies.inverse_mass(index);
    let mut point = RelativeMotion {
        velocity: motion.velocity[index],
        acceleration: motion.acceleration[index],
        inverse_normal_mass: inverse_mass,
        inverse_tangential_mass: inverse_mass,
    };
    if Tangential::NEEDS_ROTATION {
        point.velocity += motion.angular_velocity[index].cross(arm);
        point.acceleration += motion.angular_acceleration[index].cross(arm);
        point.inverse_tangential_mass += arm.norm_squared() / bodies.inertia(index).x;
    }
    point
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
