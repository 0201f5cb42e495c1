//! Spheres that touch spheres and flat walls: closed forms, one contact point, no orientation.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{sphere_plane, sphere_sphere};
use super::force::{PointContact, RelativeMotion, force_on_first};
use super::law::normal::NormalMemory;
use super::law::rolling::RollingContact;
use super::law::{ContactScale, LinearSpringDashpot, NoRolling, NormalLaw, RollingLaw, StepKind, TangentialLaw};
use super::pairs::{Candidate, Partner, carry_over, restore_memory, save_memory};
use super::sharing::Share;
use super::stage::{ContactStage, Laws, Observation, TimeScales, Work};
use super::sweep::{Found, PairForce, PairLaw, Parts, Rows, add_pair_forces, parts_wanted};
use crate::bodies::Motion;
use crate::boundary::Plane;
use crate::domain::Shifts;
use crate::relocation::Relocation;
use crate::{Bodies, Vector};

/// What is remembered of a touching pair.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Memory<History, Rolled> {
    pub(super) normal: NormalMemory,
    pub(super) tangential: History,
    pub(super) rolling: Rolled,
}

/// What a touching pair of given laws remembers.
pub(super) type MemoryOf<Tangential, Rolling> = Memory<<Tangential as TangentialLaw>::History, <Rolling as RollingLaw>::History>;

/// A contact law over its candidate pairs.
pub struct SphereContacts<Tangential: TangentialLaw, Normal = LinearSpringDashpot, Rolling: RollingLaw = NoRolling> {
    laws: Vec<Laws<Tangential, Normal, Rolling>>,
    walls: Vec<Plane>,
    shifts: Shifts,
    candidates: Vec<Candidate>,
    parts: Parts,
    /// Room for a few pairs.
    block: Vec<Found>,
    memory: Vec<MemoryOf<Tangential, Rolling>>,
    work: Work,
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> SphereContacts<Tangential, Normal, Rolling> {
    /// Whether anything turns the spheres.
    const NEEDS_ROTATION: bool = Tangential::NEEDS_ROTATION || Rolling::NEEDS_ROTATION;

    /// A stage for spheres, in a box of given shifts.
    pub fn new(
        laws: Vec<Laws<Tangential, Normal, Rolling>>,
        walls: Vec<Plane>,
        shifts: Shifts,
    ) -> SphereContacts<Tangential, Normal, Rolling> {
        SphereContacts {
            laws,
            walls,
            shifts,
            candidates: Vec::new(),
            parts: Parts::default(),
            block: Vec::new(),
            memory: Vec::new(),
            work: Work::default(),
        }
    }
}

/// Radius in m of the sphere that would meet a flat wall as the partners meet each other.
#[inline(always)]
pub(super) fn curvature_radius(radius: f64, radius_of_second: Option<f64>) -> f64 {
    match radius_of_second {
        Some(other) => radius * other / (radius + other),
        None => radius,
    }
}

/// The second body of a pair, if it is one.
#[inline(always)]
fn second_motion<'a>(bodies: &'a Bodies, candidate: &Candidate) -> Option<&'a Motion> {
    candidate.second_body().map(|second| &bodies.state.motion[second])
}

#[inline(always)]
fn detect(bodies: &Bodies, walls: &[Plane], shifts: &Shifts, candidate: &Candidate) -> Option<Touch> {
    let first = &bodies.state.motion[candidate.first()];
    match candidate.second() {
        Partner::Body(second) => {
            let second = &bodies.state.motion[second];
            sphere_sphere(second.position + shifts.shift(candidate.image) - first.position, first.radius, second.radius)
        }
        Partner::Wall(wall) => sphere_plane(&first.position, first.radius, &walls[wall]),
    }
}

/// The laws of a stage during one step.
struct SphereForces<'a, Tangential, Normal, Rolling> {
    laws: &'a [Laws<Tangential, Normal, Rolling>],
    walls: &'a [Plane],
    shifts: &'a Shifts,
    kind: &'a StepKind,
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> PairLaw for SphereForces<'_, Tangential, Normal, Rolling> {
    type Memory = MemoryOf<Tangential, Rolling>;
    const TURNS: bool = Self::TURNS;

    fn evaluate(&self, bodies: &Bodies, rows: &mut Rows<'_, Self::Memory>, places: &[u32], found: &mut Vec<Found>) -> Work {
        let mut work = Work { pair_tests: places.len() as u64, ..Work::default() };
        for &place in places {
            let (candidate, memory) = (&mut rows.candidates[place as usize], &mut rows.memory[place as usize]);
            let Some(touch) = detect(bodies, self.walls, self.shifts, candidate) else {
                candidate.is_remembered = false;
                continue;
            };
            if !candidate.is_remembered {
                *memory = Self::Memory::default();
            }
            let force = self.force(bodies, candidate, &touch, memory);
            candidate.is_remembered = true;
            work.contacts += 1;
            work.deep += u64::from(touch.is_deep);
            found.push(Found { place, candidate: *candidate, force });
        }
        work
    }
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> SphereForces<'_, Tangential, Normal, Rolling> {
    const TURNS: bool = Tangential::NEEDS_ROTATION || Rolling::NEEDS_ROTATION;

    /// Out of line, so that steps without a touch do not pay for its many registers.
    #[inline(never)]
    fn force(&self, bodies: &Bodies, candidate: &Candidate, touch: &Touch, memory: &mut MemoryOf<Tangential, Rolling>) -> PairForce {
        let (first, second) = (&bodies.state.motion[candidate.first()], second_motion(bodies, candidate));
        let SphereMotion { at_point: motion, slip_by_overlap } = match Self::TURNS {
            true => sphere_motion::<true>(first, second, touch),
            false => sphere_motion::<false>(first, second, touch),
        };
        let point = PointContact {
            normal: touch.normal,
            overlap: touch.overlap,
            motion,
            slip_by_overlap,
            inverse_reduced_mass: motion.inverse_normal_mass,
            inverse_damped_mass: motion.inverse_normal_mass,
            curvature_radius: curvature_radius(first.radius, second.map(|second| second.radius)),
            share: Share::WHOLE,
            is_new: !candidate.is_remembered,
        };
        let laws = &self.laws[candidate.laws()];
        let (force, normal_force) = force_on_first(laws, &point, self.kind, &mut memory.normal, &mut memory.tangential);
        let mut pair = PairForce { force, ..PairForce::default() };
        if Self::TURNS {
            let (arm, other_arm) = arms(first, second, touch);
            let moment = touch.normal.cross(&force);
            pair.torque_on_first = moment * arm;
            pair.torque_on_second = moment * other_arm;
        }
        if Rolling::NEEDS_ROTATION {
            let contact = rolling_contact(first, second, &point, normal_force.mean, normal_force.touched_before);
            let torque = laws.rolling.mean_torque(&contact, self.kind, &mut memory.rolling);
            pair.torque_on_first += torque;
            pair.torque_on_second -= torque;
        }
        pair
    }
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> ContactStage for SphereContacts<Tangential, Normal, Rolling> {
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        let forces = SphereForces { laws: &self.laws, walls: &self.walls, shifts: &self.shifts, kind };
        let rows = Rows { candidates: &mut self.candidates, memory: &mut self.memory };
        let work = add_pair_forces(&forces, bodies, rows, &self.parts, &mut self.block);
        self.work = self.work.plus(&work);
    }

    fn set_candidates(&mut self, bodies: &Bodies, mut candidates: Vec<Candidate>, moved: Option<&Relocation>) {
        self.memory = carry_over(&self.candidates, std::mem::take(&mut self.memory), &mut candidates, moved);
        self.parts = Parts::new(&candidates, bodies.len(), parts_wanted(&candidates));
        self.candidates = candidates;
    }

    fn observe(&self, bodies: &Bodies) -> Observation {
        let mut seen = Observation::default();
        for (candidate, memory) in self.candidates.iter().zip(&self.memory) {
            let Some(touch) = detect(bodies, &self.walls, &self.shifts, candidate) else { continue };
            let memory = if candidate.is_remembered { memory.clone() } else { Memory::default() };
            if memory.normal.ended {
                continue;
            }
            let laws = &self.laws[candidate.laws()];
            let radius_of_second = second_motion(bodies, candidate).map(|second| second.radius);
            let curvature_radius = curvature_radius(bodies.state.motion[candidate.first()].radius, radius_of_second);
            seen.contacts += 1;
            seen.largest_overlap = seen.largest_overlap.max(touch.overlap);
            seen.elastic_energy += laws.normal.stored_energy(touch.overlap, curvature_radius)
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
        let laws = &self.laws[candidate.laws()];
        let (first, second) = (&bodies.state.motion[candidate.first()], second_motion(bodies, candidate));
        let wave_time =
            |index: usize| laws.normal.wave_time(bodies.state.motion[index].radius, bodies.mass(index) / bodies.shape(index).volume());
        let inverse_mass_of_turn =
            |body: &Motion| if Self::NEEDS_ROTATION { body.radius * body.radius * body.inverse_inertia } else { 0.0 };
        let (mut inverse_reduced, mut inverse_turn) = (first.inverse_mass, inverse_mass_of_turn(first));
        let (mut inverse_inertia, mut wave) = (first.inverse_inertia, wave_time(candidate.first()));
        if let (Some(second), Some(index)) = (second, candidate.second_body()) {
            inverse_reduced += second.inverse_mass;
            inverse_turn += inverse_mass_of_turn(second);
            inverse_inertia += second.inverse_inertia;
            wave = wave.min(wave_time(index));
        }
        let curvature_radius = curvature_radius(first.radius, second.map(|second| second.radius));
        let reduced_mass = 1.0 / inverse_reduced;
        let overlap = laws.normal.expected_overlap(reduced_mass, curvature_radius);
        let along_normal = ContactScale { effective_mass: reduced_mass, reduced_mass, curvature_radius, overlap, lagged_damping };
        let along_plane = ContactScale { effective_mass: 1.0 / (inverse_reduced + inverse_turn), ..along_normal };
        let normal = TimeScales { wave_time: wave, ..laws.normal.time_scales(&along_normal) };
        normal.shortest(laws.tangential.time_scales(&along_plane)).shortest(laws.rolling.time_scales(1.0 / inverse_inertia, lagged_damping))
    }

    fn overlap(&mut self, bodies: &Bodies, candidate: &Candidate) -> Option<f64> {
        detect(bodies, &self.walls, &self.shifts, candidate).map(|touch| touch.overlap)
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

/// Relative motion at the contact point of two spheres, or of a sphere and a wall.
pub(super) struct SphereMotion {
    pub(super) at_point: RelativeMotion,
    /// How the slip velocity changes with the overlap while it grows, in 1/s: both lever arms shrink by half of it, and the line of two centres turns
    /// against their relative velocity.
    pub(super) slip_by_overlap: Vector,
}

/// Lengths in m of the arms from the centres to the contact point.
#[inline(always)]
fn arms(first: &Motion, second: Option<&Motion>, touch: &Touch) -> (f64, f64) {
    let arm = |body: &Motion| body.radius - 0.5 * touch.overlap;
    (arm(first), second.map_or(0.0, arm))
}

/// Head-on forces do not turn spheres: along the normal they weigh their mass. Arms lie along the normal, so that of the spins only
/// $(\omega_1 r_1 + \omega_2 r_2) \times n$ counts. `TURNS` is a constant of the stage.
#[inline(always)]
pub(super) fn sphere_motion<const TURNS: bool>(first: &Motion, second: Option<&Motion>, touch: &Touch) -> SphereMotion {
    let mut motion = RelativeMotion {
        velocity: first.velocity,
        acceleration: first.acceleration,
        inverse_normal_mass: first.inverse_mass,
        inverse_tangential_mass: first.inverse_mass,
    };
    if let Some(second) = second {
        motion.velocity -= second.velocity;
        motion.acceleration -= second.acceleration;
        motion.inverse_normal_mass += second.inverse_mass;
    }
    if !TURNS {
        return SphereMotion { at_point: motion, slip_by_overlap: Vector::zeros() };
    }
    let (arm, other_arm) = arms(first, second, touch);
    let (mut carried, mut carried_rate) = (first.angular_velocity * arm, first.angular_acceleration * arm);
    let mut spin = first.angular_velocity;
    motion.inverse_tangential_mass = motion.inverse_normal_mass + arm * arm * first.inverse_inertia;
    let mut across = Vector::zeros();
    if let Some(second) = second {
        across = (motion.velocity - touch.normal * motion.velocity.dot(&touch.normal)) * (1.0 / (arm + other_arm).max(f64::MIN_POSITIVE));
        carried += second.angular_velocity * other_arm;
        carried_rate += second.angular_acceleration * other_arm;
        spin += second.angular_velocity;
        motion.inverse_tangential_mass += other_arm * other_arm * second.inverse_inertia;
    }
    motion.velocity += carried.cross(&touch.normal);
    motion.acceleration += carried_rate.cross(&touch.normal);
    SphereMotion { at_point: motion, slip_by_overlap: across + touch.normal.cross(&spin) * 0.5 }
}

/// Relative spin of the partners in the contact plane, and what it meets.
pub(super) fn rolling_contact(
    first: &Motion,
    second: Option<&Motion>,
    point: &PointContact,
    normal_force: f64,
    touched_before: f64,
) -> RollingContact {
    let (mut spin, mut spin_rate) = (first.angular_velocity, first.angular_acceleration);
    let mut inverse_inertia = first.inverse_inertia;
    if let Some(second) = second {
        spin -= second.angular_velocity;
        spin_rate -= second.angular_acceleration;
        inverse_inertia += second.inverse_inertia;
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
