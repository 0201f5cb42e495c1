//! Spheres that touch spheres and flat walls: closed forms, one contact point, no orientation.

use serde::{Deserialize, Serialize};

use super::Touch;
use super::detect::{sphere_plane, sphere_sphere};
use super::force::force_on_first;
use super::lanes::BLOCK;
use super::law::normal::NormalMemory;
use super::law::{ContactScale, LinearSpringDashpot, NoRolling, NormalLaw, RollingLaw, StepKind, TangentialLaw};
use super::pair_rows::PairRows;
use super::pairs::{Candidate, Partner};
use super::sphere_lanes::evaluate;
use super::sphere_pair::{Meeting, Sizes, SphereMotion, contact_point, rolling_contact};
use super::stage::{ContactStage, Laws, Observation, TimeScales, Work};
use super::sweep::{PairForce, PairLaw, Rows, Sums};
use crate::Bodies;
use crate::bodies::Motion;
use crate::boundary::Plane;
use crate::domain::Shifts;
use crate::relocation::Relocation;

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
    /// Touching pairs alone are remembered.
    rows: PairRows<MemoryOf<Tangential, Rolling>>,
    /// Those of every two bodies, if all are alike.
    alike: Option<Sizes>,
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
        SphereContacts { laws, walls, shifts, rows: PairRows::new(BLOCK), alike: None, work: Work::default() }
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
pub(super) struct SphereForces<'a, Tangential, Normal, Rolling> {
    pub(super) laws: &'a [Laws<Tangential, Normal, Rolling>],
    pub(super) walls: &'a [Plane],
    pub(super) shifts: &'a Shifts,
    pub(super) alike: Option<Sizes>,
    pub(super) kind: &'a StepKind,
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> PairLaw for SphereForces<'_, Tangential, Normal, Rolling> {
    type Memory = MemoryOf<Tangential, Rolling>;
    const TURNS: bool = Tangential::NEEDS_ROTATION || Rolling::NEEDS_ROTATION;

    fn evaluate(&self, bodies: &Bodies, rows: &mut Rows<'_, Self::Memory>, sums: &mut Sums<'_>) -> Work {
        evaluate(self, bodies, rows, sums)
    }
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> SphereForces<'_, Tangential, Normal, Rolling> {
    /// The force of one pair that touches, and whether it is deep. Out of line, so that steps without such a touch do not pay for its many registers.
    #[inline(never)]
    pub(super) fn force(
        &self,
        bodies: &Bodies,
        candidate: &Candidate,
        memory: &mut MemoryOf<Tangential, Rolling>,
        is_new: bool,
    ) -> Option<(PairForce, bool)> {
        let turns = <Self as PairLaw>::TURNS;
        let touch = detect(bodies, self.walls, self.shifts, candidate)?;
        let (first, second) = (&bodies.state.motion[candidate.first()], second_motion(bodies, candidate));
        let inverse_distance = second.map_or(0.0, |second| {
            let relative = second.position + self.shifts.shift(candidate.image) - first.position;
            1.0 / relative.norm_squared().sqrt().max(f64::MIN_POSITIVE)
        });
        let meeting = Meeting { normal: touch.normal, overlap: touch.overlap, inverse_distance };
        let (motion, sizes) = (SphereMotion::of(first, second), Sizes::of(first, second));
        let mut point = contact_point(&meeting, &motion, &sizes, turns);
        point.is_new = is_new;
        let laws = &self.laws[candidate.laws()];
        let (force, normal_force) = force_on_first(laws, &point, self.kind, &mut memory.normal, &mut memory.tangential);
        let mut pair = if turns {
            PairForce::at_arms(force, touch.normal.cross(&force), sizes.arms(touch.overlap))
        } else {
            PairForce { force, ..PairForce::default() }
        };
        if Rolling::NEEDS_ROTATION {
            let contact = rolling_contact(&motion, &sizes, &point, &normal_force, self.kind);
            let torque = laws.rolling.mean_torque(&contact, self.kind, &mut memory.rolling);
            pair.torque_on_first += torque;
            pair.torque_on_second -= torque;
        }
        Some((pair, touch.is_deep))
    }
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> ContactStage for SphereContacts<Tangential, Normal, Rolling> {
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        let forces = SphereForces { laws: &self.laws, walls: &self.walls, shifts: &self.shifts, alike: self.alike, kind };
        let work = self.rows.add_forces(&forces, bodies);
        self.work = self.work.plus(&work);
    }

    fn set_candidates(&mut self, bodies: &Bodies, candidates: Vec<Candidate>, moved: Option<&Relocation>) {
        self.rows.set_candidates(bodies, candidates, moved);
        let mut sizes = bodies.state.motion.iter().map(|body| Sizes::of(body, Some(body)));
        self.alike = sizes.next().filter(|first| sizes.all(|other| other == *first));
    }

    fn observe(&self, bodies: &Bodies) -> Observation {
        let mut seen = Observation::default();
        for (candidate, memory) in self.rows.pairs() {
            let Some(touch) = detect(bodies, &self.walls, &self.shifts, candidate) else { continue };
            let memory = memory.cloned().unwrap_or_default();
            if memory.normal.ended {
                continue;
            }
            let laws = &self.laws[candidate.laws()];
            let curvature_radius = Sizes::of(&bodies.state.motion[candidate.first()], second_motion(bodies, candidate)).curvature_radius;
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
        self.rows.candidates()
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
        let curvature_radius = Sizes::of(first, second).curvature_radius;
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
        self.rows.save(bodies, self.work)
    }

    fn restore(&mut self, bodies: &Bodies, saved: serde_json::Value) -> Result<(), serde_json::Error> {
        self.work = self.rows.restore(bodies, saved)?;
        Ok(())
    }
}
