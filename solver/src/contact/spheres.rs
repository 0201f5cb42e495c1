//! Spheres that touch spheres and flat walls: closed forms, one contact point, no orientation.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{sphere_plane, sphere_sphere};
use super::force::{PointContact, RelativeMotion, force_on_first};
use super::law::normal::NormalMemory;
use super::law::rolling::RollingContact;
use super::law::{ContactScale, LinearSpringDashpot, NoRolling, NormalLaw, RollingLaw, StepKind, TangentialLaw};
use super::sharing::Share;
use super::stage::{Candidate, ContactStage, Laws, Observation, Partner, TimeScales, Work, restore_memory, save_memory};
use crate::boundary::Plane;
use crate::{Bodies, Vector};

/// What is remembered of a candidate pair.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Memory<History, Rolled> {
    touching: bool,
    normal: NormalMemory,
    tangential: History,
    rolling: Rolled,
}

/// What a candidate pair of given laws remembers.
type MemoryOf<Tangential, Rolling> = Memory<<Tangential as TangentialLaw>::History, <Rolling as RollingLaw>::History>;

/// A contact law over its candidate pairs.
pub struct SphereContacts<Tangential: TangentialLaw, Normal = LinearSpringDashpot, Rolling: RollingLaw = NoRolling> {
    laws: Vec<Laws<Tangential, Normal, Rolling>>,
    walls: Vec<Plane>,
    /// Radii in m by storage index of the bodies; not a number for those that are no spheres.
    radii: Vec<f64>,
    candidates: Vec<Candidate>,
    memory: Vec<MemoryOf<Tangential, Rolling>>,
    work: Work,
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> SphereContacts<Tangential, Normal, Rolling> {
    /// Whether anything turns the spheres.
    const NEEDS_ROTATION: bool = Tangential::NEEDS_ROTATION || Rolling::NEEDS_ROTATION;

    /// A stage; candidates must be pairs of spheres or a sphere and a wall, in the order of ids, bodies before walls.
    pub fn new(
        bodies: &Bodies,
        laws: Vec<Laws<Tangential, Normal, Rolling>>,
        walls: Vec<Plane>,
        candidates: Vec<Candidate>,
    ) -> SphereContacts<Tangential, Normal, Rolling> {
        let memory = vec![Memory::default(); candidates.len()];
        let radius = |index: usize| bodies.shape(index).as_sphere().map_or(f64::NAN, |sphere| sphere.radius);
        let radii = (0..bodies.len()).map(radius).collect();
        SphereContacts { laws, walls, radii, candidates, memory, work: Work::default() }
    }
}

/// Radius in m of the sphere that would meet a flat wall as the partners meet each other.
#[inline]
fn curvature_radius(radii: &[f64], candidate: &Candidate) -> f64 {
    let radius = radii[candidate.first];
    match candidate.second {
        Partner::Body(second) => radius * radii[second] / (radius + radii[second]),
        Partner::Wall(_) => radius,
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

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> ContactStage for SphereContacts<Tangential, Normal, Rolling> {
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
            let motion = relative_motion(bodies, candidate, &touch, Self::NEEDS_ROTATION);
            let point = PointContact {
                normal: touch.normal,
                overlap: touch.overlap,
                motion,
                slip_by_overlap: if Tangential::NEEDS_ROTATION { slip_by_overlap(bodies, candidate, &touch) } else { Vector::zeros() },
                inverse_reduced_mass: motion.inverse_normal_mass,
                inverse_damped_mass: motion.inverse_normal_mass,
                curvature_radius: curvature_radius(&self.radii, candidate),
                share: Share::WHOLE,
                is_new: !memory.touching,
            };
            let laws = &self.laws[candidate.laws];
            let (force, normal_force) = force_on_first(laws, &point, kind, &mut memory.normal, &mut memory.tangential);
            memory.touching = true;
            if Rolling::NEEDS_ROTATION {
                let contact = rolling_contact(bodies, candidate, &point, normal_force.mean, normal_force.touched_before);
                let torque = laws.rolling.mean_torque(&contact, kind, &mut memory.rolling);
                bodies.motion.torque[candidate.first] += torque;
                if let Partner::Body(second) = candidate.second {
                    bodies.motion.torque[second] -= torque;
                }
            }
            add_to_bodies(bodies, candidate, &touch, force, Self::NEEDS_ROTATION);
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
            seen.elastic_energy += laws.normal.stored_energy(touch.overlap, curvature_radius(&self.radii, candidate))
                + laws.tangential.stored_energy(&memory.tangential, 1.0)
                + laws.rolling.stored_energy(&memory.rolling);
        }
        seen
    }

    fn name(&self) -> String {
        let rolling = if Rolling::NEEDS_ROTATION { format!("; {}", Rolling::NAME) } else { String::new() };
        format!("{}; spheres; {}{rolling}", Normal::NAME, Tangential::NAME)
    }

    fn needs_rotation(&self) -> bool {
        Self::NEEDS_ROTATION
    }

    fn needs_orientation(&self) -> bool {
        false
    }

    fn candidates(&self) -> &[Candidate] {
        &self.candidates
    }

    fn time_scales(&self, bodies: &Bodies, candidate: &Candidate, lagged_damping: bool) -> TimeScales {
        let laws = &self.laws[candidate.laws];
        let point = |index: usize| material_point(bodies, index, &(Vector::x() * self.radii[index]), Self::NEEDS_ROTATION);
        let wave_time = |index: usize| laws.normal.wave_time(self.radii[index], bodies.mass(index) / bodies.shape(index).volume());
        let first = point(candidate.first);
        let (mut inverse_reduced, mut inverse_tangential) = (first.inverse_normal_mass, first.inverse_tangential_mass);
        let (mut inverse_inertia, mut wave) = (1.0 / bodies.inertia(candidate.first).x, wave_time(candidate.first));
        if let Partner::Body(index) = candidate.second {
            let second = point(index);
            inverse_reduced += second.inverse_normal_mass;
            inverse_tangential += second.inverse_tangential_mass;
            inverse_inertia += 1.0 / bodies.inertia(index).x;
            wave = wave.min(wave_time(index));
        }
        let curvature_radius = curvature_radius(&self.radii, candidate);
        let reduced_mass = 1.0 / inverse_reduced;
        let overlap = laws.normal.expected_overlap(reduced_mass, curvature_radius);
        let along_normal = ContactScale { effective_mass: reduced_mass, reduced_mass, curvature_radius, overlap, lagged_damping };
        let along_plane = ContactScale { effective_mass: 1.0 / inverse_tangential, ..along_normal };
        let normal = TimeScales { wave_time: wave, ..laws.normal.time_scales(&along_normal) };
        normal.shortest(laws.tangential.time_scales(&along_plane)).shortest(laws.rolling.time_scales(1.0 / inverse_inertia, lagged_damping))
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
fn relative_motion(bodies: &Bodies, candidate: &Candidate, touch: &Touch, turns: bool) -> RelativeMotion {
    let first = material_point(bodies, candidate.first, &touch.arm_of_first, turns);
    let Partner::Body(second) = candidate.second else { return first };
    let second = material_point(bodies, second, &touch.arm_of_second, turns);
    RelativeMotion {
        velocity: first.velocity - second.velocity,
        acceleration: first.acceleration - second.acceleration,
        inverse_normal_mass: first.inverse_normal_mass + second.inverse_normal_mass,
        inverse_tangential_mass: first.inverse_tangential_mass + second.inverse_tangential_mass,
    }
}

/// Motion of a body's material point and the inverse masses it shows to a contact; `turns` is a constant of the stage.
#[inline]
fn material_point(bodies: &Bodies, index: usize, arm: &Vector, turns: bool) -> RelativeMotion {
    let motion = &bodies.motion;
    let inverse_mass = bodies.inverse_mass(index);
    let mut point = RelativeMotion {
        velocity: motion.velocity[index],
        acceleration: motion.acceleration[index],
        inverse_normal_mass: inverse_mass,
        inverse_tangential_mass: inverse_mass,
    };
    if turns {
        point.velocity += motion.angular_velocity[index].cross(arm);
        point.acceleration += motion.angular_acceleration[index].cross(arm);
        point.inverse_tangential_mass += arm.norm_squared() / bodies.inertia(index).x;
    }
    point
}

/// How the slip velocity changes with the overlap while it grows, in 1/s: both lever arms shrink by half of it, and the line of two centres turns
/// against their relative velocity.
#[inline]
fn slip_by_overlap(bodies: &Bodies, candidate: &Candidate, touch: &Touch) -> Vector {
    let motion = &bodies.motion;
    let spin = motion.angular_velocity[candidate.first];
    let Partner::Body(second) = candidate.second else { return spin.cross(&touch.normal) * -0.5 };
    let velocity = motion.velocity[candidate.first] - motion.velocity[second];
    let across = velocity - touch.normal * velocity.dot(&touch.normal);
    let distance = touch.arm_of_first.norm() + touch.arm_of_second.norm();
    (spin + motion.angular_velocity[second]).cross(&touch.normal) * -0.5 + across / distance.max(f64::MIN_POSITIVE)
}

/// Relative spin of the partners in the contact plane, and what it meets.
fn rolling_contact(bodies: &Bodies, candidate: &Candidate, point: &PointContact, normal_force: f64, touched_before: f64) -> RollingContact {
    let motion = &bodies.motion;
    let first = candidate.first;
    let (mut spin, mut spin_rate) = (motion.angular_velocity[first], motion.angular_acceleration[first]);
    let mut inverse_inertia = 1.0 / bodies.inertia(first).x;
    if let Partner::Body(second) = candidate.second {
        spin -= motion.angular_velocity[second];
        spin_rate -= motion.angular_acceleration[second];
        inverse_inertia += 1.0 / bodies.inertia(second).x;
    }
    let in_plane = |vector: Vector| vector - point.normal * vector.dot(&point.normal);
    RollingContact {
        normal: point.normal,
        spin: in_plane(spin),
        spin_rate: in_plane(spin_rate),
        normal_force,
        rolling_radius: point.curvature_radius,
        inertia: 1.0 / inverse_inertia,
        touched_before,
    }
}

#[inline]
fn add_to_bodies(bodies: &mut Bodies, candidate: &Candidate, touch: &Touch, force: Vector, turns: bool) {
    let motion = &mut bodies.motion;
    motion.force[candidate.first] += force;
    if turns {
        motion.torque[candidate.first] += touch.arm_of_first.cross(&force);
    }
    if let Partner::Body(second) = candidate.second {
        motion.force[second] -= force;
        if turns {
            motion.torque[second] -= touch.arm_of_second.cross(&force);
        }
    }
}
