//! One run: filled, settled, opened, spread, at rest; and what is measured of it.

use std::collections::BTreeMap;

use solver::Simulation;
use solver::scene::Settled;

use super::heap::Heap;
use super::setting::{Column, DIAMETER, GRAVITY, LONGEST};
use crate::case::Failure;

/// Solid fraction in R's control volume below which the heap ends.
const LEAST_FRACTION: f64 = 0.1;
/// Looks in a time scale of the fall.
const LOOKS: u32 = 10;
/// The heap rests when few of its grains are faster than this part of the root of gravity times diameter: those that roll on far from it are not waited for.
const SLOW: f64 = 0.1;
const FEW: f64 = 0.1;
/// The gate opens when the root mean square speed of the column has stayed below this part of the root of gravity times height, so that what moves has less than
/// a thousandth of the energy of the fall, for so many time scales of the fall: a column that is thrown up and falls back is slow for a moment too.
const SETTLED_SPEED: f64 = 0.03;
const SETTLED_FOR: f64 = 0.5;
/// A grain of the column moves if it is faster than this part of the root of gravity times height.
const SLOW_IN_COLUMN: f64 = 0.05;

/// The heap at one time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Look {
    /// In s since the gate opened.
    pub(super) time: f64,
    /// End of the heap in m.
    pub(super) reach: f64,
    /// Profile of the heap: heights in m.
    pub(super) profile: Vec<f64>,
}

/// What one run gives.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Collapse {
    /// Height of the column in m when the gate opens.
    pub(super) height: f64,
    /// Its solid fraction.
    pub(super) solid_fraction: f64,
    /// Part of the grains that still moved when the gate opened.
    pub(super) unsettled: f64,
    /// From the opening to the end.
    pub(super) looks: Vec<Look>,
    /// Part of the grains that still moved at the end.
    pub(super) moving: f64,
    /// The heap at the end.
    pub(super) heap: Heap,
    pub(super) work: BTreeMap<String, u64>,
}

/// Length in m of a stretch of profiles: a quarter of the column.
pub(super) fn stretch(column: &Column) -> f64 {
    0.25 * column.length * DIAMETER
}

fn part_moving(heap: &Heap) -> f64 {
    heap.part_faster_than(SLOW * (GRAVITY * DIAMETER).sqrt())
}

impl Column {
    fn tick(&self) -> f64 {
        self.time_scale() / f64::from(LOOKS)
    }

    /// Fills the column, and gives it as soon as it has settled behind a gate that opens in the next step, with the time of that opening in s.
    fn filled(&self, random_seed: u64) -> Result<(Simulation, f64), Failure> {
        let latest = self.latest_opening();
        let mut filling = self.scene(latest + self.tick(), random_seed);
        filling.scene.settled = Some(Settled { speed: SETTLED_SPEED * self.speed_scale(), hold: SETTLED_FOR * self.time_scale() });
        let mut filling = filling.build()?;
        filling.run_until(latest)?;
        let opening = filling.time() + filling.time_step();
        Ok((Simulation::resume(&self.scene(opening, random_seed), &filling.checkpoint()?)?, opening))
    }

    fn part_unsettled(&self, heap: &Heap) -> f64 {
        heap.part_faster_than(SLOW_IN_COLUMN * self.speed_scale())
    }

    /// Fills, opens, and looks until the heap rests.
    pub(super) fn collapse(&self, random_seed: u64) -> Result<Collapse, Failure> {
        let (mut simulation, opening) = self.filled(random_seed)?;
        let width = self.width * DIAMETER;
        let column = Heap::of(&simulation.now(), width);
        let height = column.height_of_even_column();
        let solid_fraction = column.volume() / (self.length * DIAMETER * width * height);
        let look = |heap: &Heap, time: f64| Look {
            time,
            reach: heap.reach(DIAMETER, LEAST_FRACTION),
            profile: heap.profile(stretch(self), solid_fraction),
        };
        let mut looks = vec![look(&column, 0.0)];
        let mut heap = column.clone();
        for count in 1..=LONGEST * LOOKS {
            let time = f64::from(count) * self.tick();
            simulation.run_until(opening + time)?;
            heap = Heap::of(&simulation.now(), width);
            looks.push(look(&heap, time));
            if count > LOOKS && part_moving(&heap) < FEW {
                break;
            }
        }
        let work = simulation.ledger().total_work();
        Ok(Collapse { height, solid_fraction, unsettled: self.part_unsettled(&column), looks, moving: part_moving(&heap), heap, work })
    }
}

impl Collapse {
    /// Height over length when the gate opens.
    pub(super) fn aspect_ratio(&self, column: &Column) -> f64 {
        self.height / (column.length * DIAMETER)
    }

    /// How much farther the heap reaches at the end than at the start, over the length of the column.
    pub(super) fn run_out(&self, column: &Column) -> f64 {
        let length = column.length * DIAMETER;
        self.looks.last().map_or(f64::NAN, |last| last.reach / length) - 1.0
    }

    /// Height of the heap at the back wall over the length of the column.
    pub(super) fn final_height(&self, column: &Column) -> f64 {
        self.looks.last().map_or(f64::NAN, |last| last.profile[0]) / (column.length * DIAMETER)
    }

    /// Time of the last look at which the front is more than a diameter from its end, over the time scale of the fall.
    pub(super) fn time_of_rest(&self, column: &Column) -> f64 {
        let end = self.looks.last().map_or(f64::NAN, |last| last.reach);
        let away = self.looks.iter().rfind(|look| (look.reach - end).abs() > DIAMETER);
        away.map_or(0.0, |look| look.time) / column.time_scale()
    }

    /// Volume in the last profile over that of all grains.
    pub(super) fn volume_of_profile(&self, column: &Column) -> f64 {
        let area: f64 = self.looks.last().map_or(f64::NAN, |last| last.profile.iter().sum::<f64>()) * stretch(column);
        area * column.width * DIAMETER * self.solid_fraction / self.heap.volume()
    }
}
