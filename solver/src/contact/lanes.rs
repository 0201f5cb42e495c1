//! Contacts of spheres side by side: arrays of what their forces follow from, and loops over them that a compiler evaluates in the lanes of wide registers.

use super::force::force_inside;
use super::law::{NormalLaw, StepKind, TangentialLaw};
use super::sphere_pair::{Meeting, Sizes, SphereMotion, contact_point};
use super::stage::Laws;
use crate::Vector;

/// Pairs that are evaluated together: few enough for the nearest cache.
pub(super) const BLOCK: usize = 128;

/// Lanes of the widest registers, in numbers.
pub(super) const WIDTH: usize = 8;

/// Lanes of a block: those of a second and further laws begin at whole registers.
pub(super) const ROOM: usize = BLOCK + 4 * WIDTH;

/// What the forces of the pairs in lanes follow from.
pub(super) struct Lanes<History> {
    pub(super) count: usize,
    /// From the first centre to the second, in m.
    pub(super) relative: [Vector; ROOM],
    /// Sum of the radii in m.
    pub(super) reach: [f64; ROOM],
    pub(super) velocity: [Vector; ROOM],
    pub(super) acceleration: [Vector; ROOM],
    pub(super) spin: [Vector; ROOM],
    pub(super) other_spin: [Vector; ROOM],
    pub(super) spin_rate: [Vector; ROOM],
    pub(super) other_spin_rate: [Vector; ROOM],
    pub(super) sizes: [Sizes; ROOM],
    pub(super) last_normal_force: [f64; ROOM],
    pub(super) history: [History; ROOM],
}

/// Where the pairs in lanes touch: see [`Meeting`].
pub(super) struct Meetings<'a> {
    pub(super) normal: &'a mut [Vector; ROOM],
    pub(super) overlap: &'a mut [f64; ROOM],
    pub(super) inverse_distance: &'a mut [f64; ROOM],
}

/// Forces of the pairs in lanes, with the memory that they leave.
pub(super) struct Outcome<'a, History> {
    pub(super) force: &'a mut [Vector; ROOM],
    /// Of the force at an arm of one metre, in N.
    pub(super) moment: &'a mut [Vector; ROOM],
    pub(super) normal_force: &'a mut [f64; ROOM],
    pub(super) history: &'a mut [History; ROOM],
    /// One if the contact lasts, so that the rest holds, else zero.
    pub(super) lasts: &'a mut [f64; ROOM],
    /// One if the law in the contact plane has taken its right branch, else zero.
    pub(super) holds: &'a mut [f64; ROOM],
}

impl<History: Copy + Default> Lanes<History> {
    #[inline(always)]
    pub(super) fn new() -> Lanes<History> {
        let vectors = [Vector::zeros(); ROOM];
        Lanes {
            count: 0,
            relative: vectors,
            reach: [0.0; ROOM],
            velocity: vectors,
            acceleration: vectors,
            spin: vectors,
            other_spin: vectors,
            spin_rate: vectors,
            other_spin_rate: vectors,
            sizes: [Sizes::default(); ROOM],
            last_normal_force: [0.0; ROOM],
            history: [History::default(); ROOM],
        }
    }
}

impl<History> Lanes<History> {
    #[inline(always)]
    fn motion(&self, lane: usize) -> SphereMotion {
        SphereMotion {
            velocity: self.velocity[lane],
            acceleration: self.acceleration[lane],
            spin: [self.spin[lane], self.other_spin[lane]],
            spin_rate: [self.spin_rate[lane], self.other_spin_rate[lane]],
        }
    }
}

/// Where the pairs of all lanes from a given one on touch. A loop of its own, because roots and quotients take long and nothing else waits for them here.
#[inline(always)]
pub(super) fn meet_in_lanes<History>(lanes: &Lanes<History>, first: usize, meetings: &mut Meetings<'_>) {
    for lane in first..lanes.count.next_multiple_of(WIDTH).min(ROOM) {
        let relative = lanes.relative[lane];
        let distance = relative.norm_squared().sqrt();
        let inverse_distance = 1.0 / distance.max(f64::MIN_POSITIVE);
        meetings.normal[lane] = relative * inverse_distance;
        meetings.overlap[lane] = (lanes.reach[lane] - distance).max(f64::MIN_POSITIVE);
        meetings.inverse_distance[lane] = inverse_distance;
    }
}

/// The forces of all lanes from a given one on: first in whole registers, where what lies beyond the last lane is of no meaning, then again those that take
/// another branch of their law.
#[inline(always)]
pub(super) fn forces_in_lanes<Tangential: TangentialLaw, Normal: NormalLaw, Rolling>(
    laws: &Laws<Tangential, Normal, Rolling>,
    kind: &StepKind,
    lanes: &Lanes<Tangential::History>,
    meetings: &Meetings<'_>,
    first: usize,
    sizes: impl Fn(usize) -> Sizes,
    outcome: &mut Outcome<'_, Tangential::History>,
) {
    for lane in first..lanes.count.next_multiple_of(WIDTH).min(ROOM) {
        let (meeting, motion) = (meetings.at(lane), lanes.motion(lane));
        let mut history = lanes.history[lane];
        let point = contact_point(&meeting, &motion, &sizes(lane), Tangential::NEEDS_ROTATION);
        let inside = force_inside::<false, _, _, _>(laws, &point, kind, lanes.last_normal_force[lane], &mut history);
        outcome.force[lane] = inside.force;
        outcome.normal_force[lane] = inside.normal;
        outcome.lasts[lane] = if inside.lasts { 1.0 } else { 0.0 };
        if Tangential::NEEDS_ROTATION {
            outcome.holds[lane] = if inside.holds { 1.0 } else { 0.0 };
            outcome.moment[lane] = meeting.normal.cross(&inside.force);
            outcome.history[lane] = history;
        }
    }
    if Tangential::NEEDS_ROTATION {
        let mut others = [0_u8; ROOM + 1];
        let mut count = 0;
        for lane in first..lanes.count {
            others[count] = lane as u8;
            count += usize::from(outcome.lasts[lane] != 0.0 && outcome.holds[lane] == 0.0);
        }
        for others in others[..count].chunks(WIDTH) {
            other_forces(laws, kind, lanes, meetings, others, &sizes, outcome);
        }
    }
}

/// The forces of a register of lanes, by all branches of their law.
#[inline(always)]
fn other_forces<Tangential: TangentialLaw, Normal: NormalLaw, Rolling>(
    laws: &Laws<Tangential, Normal, Rolling>,
    kind: &StepKind,
    lanes: &Lanes<Tangential::History>,
    meetings: &Meetings<'_>,
    others: &[u8],
    sizes: &impl Fn(usize) -> Sizes,
    outcome: &mut Outcome<'_, Tangential::History>,
) {
    // Arrays of their own, so that the compiler sees that they do not overlap.
    let zero = [Vector::zeros(); WIDTH];
    let (mut normal, mut overlap, mut inverse_distance) = (zero, [0.0; WIDTH], [0.0; WIDTH]);
    let (mut velocity, mut acceleration) = (zero, zero);
    let (mut spin, mut other_spin, mut spin_rate, mut other_spin_rate) = (zero, zero, zero, zero);
    let (mut last_normal_force, mut sizes_of) = ([0.0; WIDTH], [Sizes::default(); WIDTH]);
    let mut history: [Tangential::History; WIDTH] = [Default::default(); WIDTH];
    let (mut force, mut moment) = (zero, zero);
    for (place, &lane) in others.iter().enumerate().take(WIDTH) {
        let lane = usize::from(lane);
        (normal[place], overlap[place]) = (meetings.normal[lane], meetings.overlap[lane]);
        inverse_distance[place] = meetings.inverse_distance[lane];
        (velocity[place], acceleration[place]) = (lanes.velocity[lane], lanes.acceleration[lane]);
        (spin[place], other_spin[place]) = (lanes.spin[lane], lanes.other_spin[lane]);
        (spin_rate[place], other_spin_rate[place]) = (lanes.spin_rate[lane], lanes.other_spin_rate[lane]);
        (last_normal_force[place], history[place]) = (lanes.last_normal_force[lane], lanes.history[lane]);
        sizes_of[place] = sizes(lane);
    }
    for place in 0..WIDTH {
        let meeting = Meeting { normal: normal[place], overlap: overlap[place], inverse_distance: inverse_distance[place] };
        let motion = SphereMotion {
            velocity: velocity[place],
            acceleration: acceleration[place],
            spin: [spin[place], other_spin[place]],
            spin_rate: [spin_rate[place], other_spin_rate[place]],
        };
        let point = contact_point(&meeting, &motion, &sizes_of[place], true);
        let mut own_history = history[place];
        let inside = force_inside::<true, _, _, _>(laws, &point, kind, last_normal_force[place], &mut own_history);
        (force[place], history[place]) = (inside.force, own_history);
        moment[place] = meeting.normal.cross(&inside.force);
    }
    for (place, &lane) in others.iter().enumerate().take(WIDTH) {
        let lane = usize::from(lane);
        (outcome.force[lane], outcome.moment[lane], outcome.history[lane]) = (force[place], moment[place], history[place]);
    }
}

impl Meetings<'_> {
    #[inline(always)]
    fn at(&self, lane: usize) -> Meeting {
        Meeting { normal: self.normal[lane], overlap: self.overlap[lane], inverse_distance: self.inverse_distance[lane] }
    }
}
