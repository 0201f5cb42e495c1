//! One pass over the pairs of a stage of spheres, in blocks: which of them touch, then their forces, several at once, then the rest.
//!
//! Most contacts began before the last step and last beyond the next: their closed forms have no branch, so that one loop over arrays evaluates them in the
//! lanes of wide registers, whichever the processor has. What begins, ends, is concentric or at a wall goes one by one, through the very same functions: the results are the same to
//! the bit. Memory is kept of touching pairs alone.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::lanes::{BLOCK, Lanes, Meetings, Outcome, ROOM, WIDTH, forces_in_lanes, meet_in_lanes};
use super::law::{NormalLaw, RollingLaw, TangentialLaw};
use super::pairs::Partner;
use super::sphere_pair::Sizes;
use super::spheres::{MemoryOf, SphereForces};
use super::stage::Work;
use super::sweep::{PairForce, Rows, Sums};
use crate::{Bodies, Vector};

/// Fewer pairs are not worth the room.
const FEW_PAIRS: usize = 16;

/// Adds the forces of those pairs that touch, in their order.
pub(super) fn evaluate<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw>(
    forces: &SphereForces<'_, Tangential, Normal, Rolling>,
    bodies: &Bodies,
    rows: &mut Rows<'_, MemoryOf<Tangential, Rolling>>,
    sums: &mut Sums<'_>,
) -> Work {
    let count = rows.candidates.len();
    let sweep = Sweep { forces, bodies, rows, sums, work: Work { pair_tests: count as u64, ..Work::default() } };
    if Normal::KNOWS_INSIDE && !Rolling::NEEDS_ROTATION && count >= FEW_PAIRS { Arch::new().dispatch(sweep) } else { sweep.one_by_one() }
}

/// A pass at work.
struct Sweep<'a, 'b, 'c, Tangential: TangentialLaw, Normal, Rolling: RollingLaw> {
    forces: &'a SphereForces<'a, Tangential, Normal, Rolling>,
    bodies: &'a Bodies,
    rows: &'a mut Rows<'b, MemoryOf<Tangential, Rolling>>,
    sums: &'a mut Sums<'c>,
    work: Work,
}

/// The touching pairs of a block.
struct Touching {
    count: usize,
    /// Which pairs of the block they are.
    pair: [u8; BLOCK],
    /// Whether it did not touch at the last step.
    is_new: [bool; BLOCK],
    /// Whether the end of the contact is behind it although it still overlaps.
    has_ended: [bool; BLOCK],
    /// The lane that knows its force; or one of the two below.
    lane: [u8; BLOCK],
}

/// Not sorted into a lane yet.
const PENDING: u8 = u8::MAX;
/// Evaluated alone.
const ALONE: u8 = u8::MAX - 1;

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> WithSimd for Sweep<'_, '_, '_, Tangential, Normal, Rolling> {
    type Output = Work;

    /// Nothing here names a kind of register: what is inlined here is compiled for each.
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _simd: S) -> Work {
        let (kind, alike) = (self.forces.kind, self.forces.alike);
        let mut touching = Touching::new();
        let mut between = [Vector::zeros(); BLOCK];
        let mut lanes = Lanes::<Tangential::History>::new();
        // Arrays of their own, so that the compiler sees that they do not overlap.
        let (mut force, mut moment) = ([Vector::zeros(); ROOM], [Vector::zeros(); ROOM]);
        let (mut normal, mut overlap, mut inverse_distance) = ([Vector::zeros(); ROOM], [0.0; ROOM], [0.0; ROOM]);
        let (mut normal_force, mut lasts, mut holds) = ([0.0; ROOM], [0.0; ROOM], [0.0; ROOM]);
        let mut history: [Tangential::History; ROOM] = [Default::default(); ROOM];
        for block in self.blocks() {
            self.find(&block, &mut touching, |touch, relative| between[touch] = relative);
            touching.lane[..touching.count].fill(PENDING);
            lanes.count = 0;
            let mut meetings = Meetings { normal: &mut normal, overlap: &mut overlap, inverse_distance: &mut inverse_distance };
            let mut outcome = Outcome {
                force: &mut force,
                moment: &mut moment,
                normal_force: &mut normal_force,
                history: &mut history,
                lasts: &mut lasts,
                holds: &mut holds,
            };
            while let Some((laws, first)) = self.gather(&block, &mut touching, &between, &mut lanes) {
                let laws = &self.forces.laws[laws];
                meet_in_lanes(&lanes, first, &mut meetings);
                match alike {
                    Some(sizes) => forces_in_lanes(laws, kind, &lanes, &meetings, first, |_| sizes, &mut outcome),
                    None => forces_in_lanes(laws, kind, &lanes, &meetings, first, |lane| lanes.sizes[lane], &mut outcome),
                }
            }
            self.finish(&block, &touching, |lane, memory| {
                if outcome.lasts[lane] == 0.0 {
                    return None;
                }
                memory.normal.force = outcome.normal_force[lane];
                memory.tangential = outcome.history[lane];
                if !Tangential::NEEDS_ROTATION {
                    return Some(PairForce { force: outcome.force[lane], ..PairForce::default() });
                }
                let arms = alike.unwrap_or(lanes.sizes[lane]).arms(meetings.overlap[lane]);
                Some(PairForce::at_arms(outcome.force[lane], outcome.moment[lane], arms))
            });
        }
        self.work
    }
}

/// Pairs of a pass that are evaluated together; the memory of those that touch begins at their start.
type Block = Range<usize>;

impl<Tangential: TangentialLaw, Normal: NormalLaw, Rolling: RollingLaw> Sweep<'_, '_, '_, Tangential, Normal, Rolling> {
    fn blocks(&self) -> impl Iterator<Item = Block> + use<Tangential, Normal, Rolling> {
        let count = self.rows.candidates.len();
        (0..count).step_by(BLOCK).map(move |start| start..count.min(start + BLOCK))
    }

    /// Without lanes.
    fn one_by_one(mut self) -> Work {
        let mut touching = Touching::new();
        for block in self.blocks() {
            self.find(&block, &mut touching, |_, _| {});
            self.finish(&block, &touching, |_, _| None);
        }
        self.work
    }

    /// Finds the pairs that touch and brings the memory of the block in line with them. Tells `note` from where to where the centres of the next touching pair
    /// lie, and may take that back.
    #[inline(always)]
    fn find(&mut self, block: &Block, touching: &mut Touching, mut note: impl FnMut(usize, Vector)) {
        let (motion, memory) = (self.bodies.state.motion.as_slice(), &self.rows.memory[block.clone()]);
        let (mut count, mut is_as_before) = (0, true);
        for (pair, candidate) in self.rows.candidates[block.clone()].iter().enumerate() {
            let first = &motion[candidate.first()];
            let touches = match candidate.second() {
                Partner::Body(second) => {
                    let second = &motion[second];
                    let relative = second.position + self.forces.shifts.shift(candidate.image) - first.position;
                    let reach = first.radius + second.radius;
                    note(count, relative);
                    relative.norm_squared() < reach * reach
                }
                Partner::Wall(wall) => self.forces.walls[wall].touch_sphere(&first.position, first.radius).is_some(),
            };
            // Counted without a branch: nothing can tell beforehand which pairs touch.
            touching.pair[count] = pair as u8;
            // Read here, where nothing waits for it: what is remembered comes from far.
            touching.has_ended[count] = memory[count].normal.ended;
            count += usize::from(touches);
            is_as_before &= touches == candidate.is_remembered;
        }
        touching.count = count;
        touching.is_new.fill(false);
        if !is_as_before {
            self.remember(block, touching);
        }
    }

    /// Gives the memory of the block to the pairs that touch now.
    #[cold]
    fn remember(&mut self, block: &Block, touching: &mut Touching) {
        let (candidates, memory) = (&mut self.rows.candidates[block.clone()], &mut self.rows.memory[block.clone()]);
        let mut touches = [false; BLOCK];
        touching.pair[..touching.count].iter().for_each(|pair| touches[usize::from(*pair)] = true);
        // Those that have parted are dropped from the front on, then the others make room for the new ones from the end on.
        let (mut known, mut kept) = (0, 0);
        for (_, touches) in candidates.iter().zip(touches).filter(|(candidate, _)| candidate.is_remembered) {
            if touches {
                memory.swap(kept, known);
            }
            kept += usize::from(touches);
            known += 1;
        }
        let mut place = touching.count;
        for (candidate, touches) in candidates.iter_mut().zip(touches).rev() {
            if touches {
                place -= 1;
                touching.is_new[place] = !candidate.is_remembered;
                if candidate.is_remembered {
                    kept -= 1;
                    memory.swap(place, kept);
                } else {
                    memory[place] = Default::default();
                }
                touching.has_ended[place] = memory[place].normal.ended;
            }
            candidate.is_remembered = touches;
        }
    }

    /// Takes the pending pairs of one law into lanes; returns the law and the first of them. `None` if no pair is pending or all lanes are taken.
    #[inline(always)]
    fn gather(
        &self,
        block: &Block,
        touching: &mut Touching,
        between: &[Vector; BLOCK],
        lanes: &mut Lanes<Tangential::History>,
    ) -> Option<(usize, usize)> {
        let motion = self.bodies.state.motion.as_slice();
        let (candidates, memory) = (&self.rows.candidates[block.clone()], &self.rows.memory[block.clone()]);
        let first_lane = lanes.count.next_multiple_of(WIDTH);
        let (mut laws, mut lane) = (None, first_lane);
        for touch in 0..touching.count.min(BLOCK) {
            if touching.lane[touch] != PENDING || lane == ROOM {
                continue;
            }
            let candidate = &candidates[usize::from(touching.pair[touch])];
            if *laws.get_or_insert(candidate.laws()) != candidate.laws() {
                continue;
            }
            touching.lane[touch] = ALONE;
            let (relative, memory) = (between[touch], &memory[touch]);
            let Some(second) = candidate.second_body() else { continue };
            if touching.is_new[touch] || touching.has_ended[touch] || relative == Vector::zeros() {
                continue;
            }
            let (first, second) = (&motion[candidate.first()], &motion[second]);
            lanes.relative[lane] = relative;
            lanes.reach[lane] = first.radius + second.radius;
            lanes.velocity[lane] = first.velocity - second.velocity;
            lanes.acceleration[lane] = first.acceleration - second.acceleration;
            if Tangential::NEEDS_ROTATION {
                lanes.spin[lane] = first.angular_velocity;
                lanes.other_spin[lane] = second.angular_velocity;
                lanes.spin_rate[lane] = first.angular_acceleration;
                lanes.other_spin_rate[lane] = second.angular_acceleration;
                lanes.history[lane] = memory.tangential;
            }
            if self.forces.alike.is_none() {
                lanes.sizes[lane] = Sizes::of(first, Some(second));
            }
            lanes.last_normal_force[lane] = memory.normal.force;
            touching.lane[touch] = lane as u8;
            lane += 1;
        }
        lanes.count = lane;
        laws.map(|laws| (laws, first_lane))
    }

    /// Gives the forces of a block away in order: those that `from_lane` knows, and the others one by one.
    #[inline(always)]
    fn finish(
        &mut self,
        block: &Block,
        touching: &Touching,
        from_lane: impl Fn(usize, &mut MemoryOf<Tangential, Rolling>) -> Option<PairForce>,
    ) {
        let (candidates, memory) = (&self.rows.candidates[block.clone()], &mut self.rows.memory[block.clone()]);
        for touch in 0..touching.count.min(BLOCK) {
            let (candidate, memory) = (&candidates[usize::from(touching.pair[touch])], &mut memory[touch]);
            let lane = usize::from(touching.lane[touch]);
            let known = if lane < ROOM { from_lane(lane, memory) } else { None };
            let force = match known {
                Some(force) => force,
                None => {
                    let Some((force, is_deep)) = self.forces.force(self.bodies, candidate, memory, touching.is_new[touch]) else {
                        continue;
                    };
                    self.work.deep += u64::from(is_deep);
                    force
                }
            };
            self.sums.add(candidate, &force);
        }
        self.work.contacts += touching.count as u64;
    }
}

impl Touching {
    fn new() -> Touching {
        Touching { count: 0, pair: [0; BLOCK], is_new: [false; BLOCK], has_ended: [false; BLOCK], lane: [ALONE; BLOCK] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::Plane;
    use crate::contact::law::{EndOfContact, Frictionless, LinearHistory, LinearSpringDashpot, NoRolling, StepKind, ViscousCoulomb};
    use crate::contact::pairs::Candidate;
    use crate::contact::stage::Laws;
    use crate::domain::{Image, Shifts};
    use crate::shape::{Convex, Sphere};
    use crate::test_bodies::at_rest;

    const SIDE: usize = 5;
    const STEPS: usize = 8;

    /// Numbers between -1 and 1 in place of chance.
    fn number(seed: usize) -> f64 {
        ((seed * 2_654_435_761) % 10_007) as f64 / 5003.5 - 1.0
    }

    fn vector(seed: usize) -> Vector {
        Vector::new(number(3 * seed), number(3 * seed + 1), number(3 * seed + 2))
    }

    /// A heap of balls on a floor that overlap, part, approach and spin; all alike, or of two sizes.
    fn heap(are_alike: bool) -> Bodies {
        let ball = |index: usize| {
            let radius = if are_alike || index.is_multiple_of(3) { 1.0 } else { 0.95 };
            let place = [index % SIDE, index / SIDE % SIDE, index / SIDE / SIDE].map(|count| 0.97 + 1.96 * count as f64);
            let mut body = at_rest(Convex::Sphere(Sphere { radius }), radius.powi(3));
            (body.id, body.position) = (index as u32, Vector::from(place) + 0.03 * vector(index));
            (body.velocity, body.angular_velocity) = (vector(index + 1000), vector(index + 2000));
            body
        };
        Bodies::new((0..SIDE * SIDE * SIDE).map(ball).collect())
    }

    /// Neighbours by two laws in turn, then the floor.
    fn candidates(bodies: &Bodies) -> Vec<Candidate> {
        let mut candidates = Vec::new();
        for row in 0..bodies.len() {
            let is_near = |other: &usize| (bodies.position(*other) - bodies.position(row)).norm() < 2.3;
            candidates
                .extend((row + 1..bodies.len()).filter(is_near).map(|other| Candidate::of_bodies(row, other, other % 2, Image::SAME)));
            if bodies.position(row).z < 1.1 {
                candidates.push(Candidate::at_wall(row, 0, 1));
            }
        }
        candidates
    }

    /// Steps a heap with and without lanes, and compares every bit; returns contacts, and how many of them were new.
    fn compare<Tangential: TangentialLaw>(tangential: Tangential, end: EndOfContact, are_alike: bool) -> (u64, usize)
    where
        Tangential::History: PartialEq + std::fmt::Debug,
    {
        let laws = [0.4, 0.9].map(|restitution| Laws {
            normal: LinearSpringDashpot::new(500.0, restitution, end),
            tangential: tangential.clone(),
            rolling: NoRolling,
        });
        let mut bodies = heap(are_alike);
        let mut candidates = candidates(&bodies);
        let mut memory: Vec<MemoryOf<Tangential, NoRolling>> = vec![Default::default(); candidates.len()];
        let alike = are_alike.then(|| Sizes::of(&bodies.state.motion[0], Some(&bodies.state.motion[0])));
        let (walls, shifts) = ([Plane { point: Vector::zeros(), normal: Vector::z() }], Shifts::of(None));
        let (mut contacts, mut new) = (0, 0);
        for step in 0..STEPS {
            let kind = StepKind { step: 4e-3, synchronous: step == 0, lagged_damping: false, resolved_edges: true };
            let forces = SphereForces { laws: &laws, walls: &walls, shifts: &shifts, alike, kind: &kind };
            let run = |way: usize| {
                let (mut candidates, mut memory, nothing) = (candidates.clone(), memory.clone(), vec![Vector::zeros(); bodies.len()]);
                let (mut force, mut torque) = (nothing.clone(), nothing);
                let mut rows = Rows { candidates: &mut candidates, memory: &mut memory };
                let mut sums = Sums { start: 0, turns: Tangential::NEEDS_ROTATION, force: &mut force, torque: &mut torque };
                let sweep = Sweep { forces: &forces, bodies: &bodies, rows: &mut rows, sums: &mut sums, work: Work::default() };
                let work = match way {
                    0 => sweep.one_by_one(),
                    1 => sweep.with_simd(pulp::Scalar),
                    _ => Arch::new().dispatch(sweep),
                };
                (candidates, memory, [force, torque], work)
            };
            let oracle = run(0);
            for way in [1, 2] {
                assert_eq!(run(way), oracle, "step {step}, way {way}");
            }
            new += oracle.0.iter().zip(&candidates).filter(|(now, before)| now.is_remembered && !before.is_remembered).count();
            contacts += oracle.3.contacts;
            (candidates, memory) = (oracle.0, oracle.1);
            for (index, body) in bodies.state.motion.iter_mut().enumerate() {
                body.acceleration = 30.0 * vector(index + 100 * step);
                body.angular_acceleration = 30.0 * vector(index + 100 * step + 50);
                body.velocity += body.acceleration * kind.step;
                body.position += body.velocity * kind.step;
            }
        }
        (contacts, new)
    }

    #[test]
    fn lanes_give_the_same_bits_as_one_contact_after_the_other() {
        let history = LinearHistory { friction: 0.3, stiffness: 200.0, damping_ratio: 0.2 };
        let viscous = ViscousCoulomb { friction: 0.3, damping_rate: 5.0 };
        for are_alike in [true, false] {
            for end in [EndOfContact::ZeroOverlap, EndOfContact::NoAttraction] {
                let (contacts, new) = compare(history, end, are_alike);
                assert!(contacts > 500 && new > 50 && (new as u64) < contacts / 3, "{contacts} contacts, {new} new");
                compare(viscous, end, are_alike);
                compare(Frictionless, end, are_alike);
            }
        }
    }
}
