//! Spheres at walls that move, are curved, finite or made of faces: several contact points at the same wall, each with a memory of its own.
//!
//! The laws are those of [`super::spheres`], in the frame of the wall: of the motion of the ball that of the material point of the wall is taken away. A
//! contact point is found again by its normal, which turns little in a step. The wall counts as flat where a law asks for the radius of curvature: that of
//! the ball. So do planes at rest, which have a stage without any of this.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::force::force_on_first;
use super::law::{LinearSpringDashpot, NoRolling, NormalLaw, RollingLaw, StepKind, TangentialLaw};
use super::pair_rows::PairRows;
use super::pairs::{Candidate, Partner};
use super::sphere_pair::{Meeting, Sizes, SphereMotion, contact_point, rolling_contact};
use super::spheres::{MemoryOf, SphereContacts};
use super::stage::{ContactStage, Laws, Observation, TimeScales, Work};
use super::sweep::{PairForce, PairLaw, Rows, Sums};
use crate::boundary::{MovingWall, PlacedWall, SphereTouch, placed};
use crate::relocation::Relocation;
use crate::{Bodies, Vector};

/// What a contact point remembers.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct PointMemory<Remembered> {
    /// Unit normal to the wall at the last step.
    normal: Vector,
    laws: Remembered,
}

/// What is remembered of a ball at a wall.
type PointsOf<Tangential, Rolling> = Vec<PointMemory<MemoryOf<Tangential, Rolling>>>;

/// A contact point is another one if its normal has turned by more than 60 degrees in a step: this is the cosine.
const SAME_NORMAL: f64 = 0.5;

/// A contact law over spheres and walls of any kind.
pub struct SphereWalls<Tangential: TangentialLaw, Normal = LinearSpringDashpot, Rolling: RollingLaw = NoRolling> {
    laws: Vec<Laws<Tangential, Normal, Rolling>>,
    walls: Arc<[MovingWall]>,
    /// Of the positions, in s.
    time: f64,
    rows: PairRows<PointsOf<Tangential, Rolling>>,
    work: Work,
    /// The same laws at planes, without a candidate: time scales do not depend on the kind of wall.
    at_planes: SphereContacts<Tangential, Normal, Rolling>,
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> SphereWalls<Tangential, Normal, Rolling> {
    /// A stage for spheres at walls; `at_planes` has the same laws.
    pub fn new(
        laws: Vec<Laws<Tangential, Normal, Rolling>>,
        walls: Arc<[MovingWall]>,
        at_planes: SphereContacts<Tangential, Normal, Rolling>,
    ) -> SphereWalls<Tangential, Normal, Rolling> {
        SphereWalls { laws, walls, time: 0.0, rows: PairRows::new(1), work: Work::default(), at_planes }
    }
}

/// Lists the contact points of a candidate.
fn detect<'a, 'b>(
    bodies: &Bodies,
    walls: &'b [Option<PlacedWall<'a>>],
    candidate: &Candidate,
    touches: &mut Vec<SphereTouch>,
) -> Option<&'b PlacedWall<'a>> {
    touches.clear();
    let Partner::Wall(wall) = candidate.second() else { return None };
    let ball = &bodies.state.motion[candidate.first()];
    let wall = walls[wall].as_ref()?;
    wall.touch_sphere(&ball.position, ball.radius, touches);
    Some(wall)
}

/// Takes for every contact point what it remembers out of the old points: those first whose normals have turned least.
fn remembered<Remembered>(old: &mut Vec<PointMemory<Remembered>>, touches: &[SphereTouch]) -> Vec<Option<Remembered>> {
    let mut found: Vec<Option<Remembered>> = touches.iter().map(|_| None).collect();
    loop {
        let free = || (0..touches.len()).filter(|touch| found[*touch].is_none());
        let likeness = |(touch, known): (usize, usize)| (touches[touch].normal.dot(&old[known].normal), touch, known);
        let pairs = free().flat_map(|touch| (0..old.len()).map(move |known| (touch, known))).map(likeness);
        let Some((cosine, touch, known)) = pairs.reduce(|best, next| if next.0 > best.0 { next } else { best }) else { return found };
        if cosine < SAME_NORMAL {
            return found;
        }
        found[touch] = Some(old.remove(known).laws);
    }
}

/// The laws of a stage during one step.
struct WallForces<'a, Tangential, Normal, Rolling> {
    laws: &'a [Laws<Tangential, Normal, Rolling>],
    walls: Vec<Option<PlacedWall<'a>>>,
    kind: &'a StepKind,
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> PairLaw for WallForces<'_, Tangential, Normal, Rolling> {
    type Memory = PointsOf<Tangential, Rolling>;
    const TURNS: bool = Tangential::NEEDS_ROTATION || Rolling::NEEDS_ROTATION;

    fn evaluate(&self, bodies: &Bodies, rows: &mut Rows<'_, Self::Memory>, sums: &mut Sums<'_>) -> Work {
        let mut work = Work { pair_tests: rows.candidates.len() as u64, ..Work::default() };
        let mut touches = Vec::new();
        for (candidate, memory) in rows.candidates.iter_mut().zip(rows.memory.iter_mut()) {
            let wall = detect(bodies, &self.walls, candidate, &mut touches);
            candidate.is_remembered = !touches.is_empty();
            let Some(wall) = wall.filter(|_| !touches.is_empty()) else {
                memory.clear();
                continue;
            };
            let known = remembered(memory, &touches);
            memory.clear();
            let mut force = PairForce::default();
            for (touch, known) in touches.iter().zip(known) {
                let is_new = known.is_none();
                let mut laws = known.unwrap_or_default();
                self.add_force(bodies, candidate, (wall, touch), (&mut laws, is_new), &mut force);
                memory.push(PointMemory { normal: touch.normal, laws });
                work.contacts += 1;
                work.deep += u64::from(touch.is_deep);
            }
            sums.add(candidate, &force);
        }
        work
    }
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> WallForces<'_, Tangential, Normal, Rolling> {
    /// Adds the force of one contact point, whose memory may be new.
    fn add_force(
        &self,
        bodies: &Bodies,
        candidate: &Candidate,
        (wall, touch): (&PlacedWall<'_>, &SphereTouch),
        (memory, is_new): (&mut MemoryOf<Tangential, Rolling>, bool),
        pair: &mut PairForce,
    ) {
        let ball = &bodies.state.motion[candidate.first()];
        let meeting = Meeting { normal: touch.normal, overlap: touch.overlap, inverse_distance: 0.0 };
        let (mut motion, sizes) = (SphereMotion::of(ball, None), Sizes::of(ball, None));
        let mut point = contact_point(&meeting, &motion, &sizes, <Self as PairLaw>::TURNS);
        point.motion = point.motion.against(wall, (&(ball.position + touch.arm), &touch.normal), self.kind);
        point.is_new = is_new;
        let laws = &self.laws[candidate.laws()];
        let (force, normal_force) = force_on_first(laws, &point, self.kind, &mut memory.normal, &mut memory.tangential);
        pair.force += force;
        if <Self as PairLaw>::TURNS {
            pair.torque_on_first += touch.normal.cross(&force) * (ball.radius - 0.5 * touch.overlap);
        }
        if Rolling::NEEDS_ROTATION {
            // A partner that nothing turns, but that may turn by itself.
            motion.spin[1] = wall.spin(self.kind.age_of_velocities());
            let contact = rolling_contact(&motion, &sizes, &point, &normal_force, self.kind);
            pair.torque_on_first += laws.rolling.mean_torque(&contact, self.kind, &mut memory.rolling);
        }
    }
}

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> ContactStage for SphereWalls<Tangential, Normal, Rolling> {
    fn add_forces(&mut self, bodies: &mut Bodies, kind: &StepKind) {
        let forces = WallForces { laws: &self.laws, walls: placed(&self.walls, self.time), kind };
        let work = self.rows.add_forces(&forces, bodies);
        self.work = self.work.plus(&work);
    }

    fn set_candidates(&mut self, bodies: &Bodies, candidates: Vec<Candidate>, moved: Option<&Relocation>) {
        self.rows.set_candidates(bodies, candidates, moved);
    }

    fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    fn observe(&self, bodies: &Bodies) -> Observation {
        let mut seen = Observation::default();
        let walls = placed(&self.walls, self.time);
        let mut touches = Vec::new();
        for (candidate, memory) in self.rows.pairs() {
            detect(bodies, &walls, candidate, &mut touches);
            let known = remembered(&mut memory.cloned().unwrap_or_default(), &touches);
            let laws = &self.laws[candidate.laws()];
            let curvature_radius = bodies.state.motion[candidate.first()].radius;
            for (touch, memory) in touches.iter().zip(known) {
                let memory = memory.unwrap_or_default();
                if memory.normal.ended {
                    continue;
                }
                seen.contacts += 1;
                seen.largest_overlap = seen.largest_overlap.max(touch.overlap);
                seen.elastic_energy += laws.normal.stored_energy(touch.overlap, curvature_radius)
                    + laws.tangential.stored_energy(&memory.tangential, 1.0)
                    + laws.rolling.stored_energy(&memory.rolling);
            }
        }
        seen
    }

    fn name(&self) -> String {
        format!("{} at walls that move, are curved or finite", self.at_planes.name())
    }

    fn needs_rotation(&self) -> bool {
        self.at_planes.needs_rotation()
    }

    fn needs_orientation(&self) -> bool {
        false
    }

    fn candidates(&self) -> &[Candidate] {
        self.rows.candidates()
    }

    fn time_scales(&self, bodies: &Bodies, candidate: &Candidate, lagged_damping: bool) -> TimeScales {
        self.at_planes.time_scales(bodies, candidate, lagged_damping)
    }

    fn overlap(&mut self, bodies: &Bodies, candidate: &Candidate) -> Option<f64> {
        let mut touches = Vec::new();
        detect(bodies, &placed(&self.walls, self.time), candidate, &mut touches);
        touches.iter().map(|touch| touch.overlap).reduce(f64::max)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn touch(normal: Vector) -> SphereTouch {
        SphereTouch { overlap: 0.1, normal, arm: normal * 0.9, is_deep: false }
    }

    /// In a groove the deeper wall comes first, whichever it is; a wall that was not there before takes nobody's memory.
    #[test]
    fn points_are_found_again_by_their_normals() {
        let at = |degrees: f64| Vector::new(degrees.to_radians().sin(), 0.0, -degrees.to_radians().cos());
        let old = || vec![PointMemory { normal: at(20.0), laws: 'a' }, PointMemory { normal: at(-20.0), laws: 'b' }];
        assert_eq!(remembered(&mut old(), &[touch(at(-19.0)), touch(at(22.0))]), [Some('b'), Some('a')]);
        // The new wall at 50 degrees is deepest, and 30 degrees from what the other remembers.
        let mut known = old();
        assert_eq!(remembered(&mut known, &[touch(at(50.0)), touch(at(21.0))]), [None, Some('a')]);
        assert_eq!(remembered(&mut old()[..1].to_vec(), &[touch(at(81.0))]), [None]);
        assert_eq!(remembered(&mut old()[..1].to_vec(), &[touch(at(79.0))]), [Some('a')]);
    }
}
