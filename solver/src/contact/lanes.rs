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

/// The forces of all lanes from a given one on: first in whole registers, where what lies beyond the last lane is of no meaning, then those one by one that
/// take another branch of their law.
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
        force_in_lane::<false, _, _, _>(laws, kind, lanes, meetings, lane, &sizes(lane), outcome);
    }
    if Tangential::NEEDS_ROTATION {
        for lane in first..lanes.count {
            if outcome.lasts[lane] != 0.0 && outcome.holds[lane] == 0.0 {
                force_in_lane::<true, _, _, _>(laws, kind, lanes, meetings, lane, &sizes(lane), outcome);
            }
        }
    }
}

#[inline(always)]
fn force_in_lane<const MAY_SLIDE: bool, Tangential: TangentialLaw, Normal: NormalLaw, Rolling>(
    laws: &Laws<Tangential, Normal, Rolling>,
    kind: &StepKind,
    lanes: &Lanes<Tangential::History>,
    meetings: &Meetings<'_>,
    lane: usize,
    sizes: &Sizes,
    outcome: &mut Outcome<'_, Tangential::History>,
) {
    let turns = Tangential::NEEDS_ROTATION;
    let (normal, inverse_distance) = (meetings.normal[lane], meetings.inverse_distance[lane]);
    let meeting = Meeting { normal, overlap: meetings.overlap[lane], inverse_distance };
    let motion = SphereMotion {
        velocity: lanes.velocity[lane],
        acceleration: lanes.acceleration[lane],
        spin: [lanes.spin[lane], lanes.other_spin[lane]],
        spin_rate: [lanes.spin_rate[lane], lanes.other_spin_rate[lane]],
    };
    let point = contact_point(&meeting, &motion, sizes, turns);
    let mut history = lanes.history[lane];
    let inside = force_inside::<MAY_SLIDE, _, _, _>(laws, &point, kind, lanes.last_normal_force[lane], &mut history);
    outcome.force[lane] = inside.force;
    outcome.normal_force[lane] = inside.normal;
    outcome.lasts[lane] = if inside.lasts { 1.0 } else { 0.0 };
    if turns {
        outcome.holds[lane] = if inside.holds { 1.0 } else { 0.0 };
        outcome.moment[lane] = normal.cross(&inside.force);
        outcome.history[lane] = history;
    }
}
