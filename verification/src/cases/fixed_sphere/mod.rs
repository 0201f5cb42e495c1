//! Drag of a sphere held in a stream at finite Reynolds number, with the shares of grid and box in its error.

mod claims;
mod page;
mod sphere;

use std::collections::BTreeMap;

use reports::row::{Reference, ReferenceKind};

use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::Claim;
use crate::exact::periodic_array::{Lattice, friction_factor};
use crate::exact::richardson::extrapolate;
use crate::exact::sphere_drag::{SphereDrag, tabulated};
use crate::variant::Variant as _;
use sphere::{Error, Found, Problem, Surroundings};

/// The case.
pub struct FixedSphere;

const DRAG: &str = "drag coefficient";
const FRICTION: &str = "friction factor";
const DIVERGENCE: &str = "largest divergence x spacing / speed";
const SLIP: &str = "residual of the conditions / speed, root mean square";
const FULL_SLIP: &str = "slip at the surface / speed, root mean square";
const UNBOUNDED: &str = "drag coefficient in no box and on no grid";
const GRID_SHARE: &str = "share of the grid in the drag of the smallest box";
const BOX_SHARE: &str = "share of the box in the drag of the widest box";
const UNCERTAINTY: &str = "uncertainty of the extrapolation";
const MISSED: &str = "distance from the table / uncertainty of both";

/// The slice picture, beside the rows.
const SLICE: &str = "slice.csv";

/// Solid fraction of the array: an eighth.
const FRACTION: f64 = 0.125;
/// Widths of boxes that are extrapolated to none, in diameters.
const WIDTHS: [f64; 3] = [4.0, 6.0, 9.0];
/// Cells a diameter of the boxes, and of the sequence of grids in the smallest of them; shares of the knob.
const GRIDS: [f64; 3] = [0.5, 0.75, 1.0];

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Variant {
    /// A stream in one box.
    Stream { reynolds: f64, across: f64 },
    /// Extrapolated over boxes and grids.
    Limit { reynolds: f64 },
    /// A simple cubic array in creeping flow, marched to its steady state.
    Array,
}

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        let stream = |reynolds, across| Variant::Stream { reynolds, across };
        let mut all = vec![Variant::Array];
        all.extend(WIDTHS.map(|across| stream(20.0, across)));
        all.extend([1.0, 5.0, 10.0, 40.0, 100.0, 150.0].map(|reynolds| stream(reynolds, 6.0)));
        all.push(Variant::Limit { reynolds: 20.0 });
        all
    }

    fn label(&self) -> String {
        match self {
            Variant::Stream { reynolds, across } => format!("Reynolds number {reynolds}, box {across} diameters across"),
            Variant::Limit { reynolds } => format!("Reynolds number {reynolds}, extrapolated over boxes and grids"),
            Variant::Array => "simple cubic array, an eighth solid, creeping flow marched in time".into(),
        }
    }

    fn knob_name(&self) -> &'static str {
        "cells_a_diameter"
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let of = |quick: &[f64], longer: &[f64]| if tier == Tier::Quick { quick.to_vec() } else { longer.to_vec() };
        match self {
            Variant::Array => of(&[6.0, 8.0, 12.0], &[6.0, 8.0, 12.0, 16.0]),
            Variant::Stream { reynolds: 20.0, across: 4.0 } => of(&[5.0, 6.0, 8.0], &[5.0, 6.0, 8.0, 12.0, 16.0]),
            Variant::Stream { reynolds: 20.0, across: 6.0 } => of(&[6.0], &[6.0, 8.0, 12.0]),
            // The boundary layer is thinner than a tenth of a diameter.
            Variant::Stream { reynolds: 100.0.., .. } => of(&[], &[12.0, 16.0]),
            Variant::Stream { .. } => of(&[], &[8.0]),
            Variant::Limit { .. } => of(&[], &[16.0]),
        }
    }
}

impl Variant {
    /// What the drag coefficient should be in a stream without bounds, and where that comes from.
    fn drag(reynolds: f64) -> Result<(SphereDrag, Reference), Error> {
        let drag = tabulated(reynolds).ok_or("no such Reynolds number in the table")?;
        let source = "stream function and vorticity to 67 radii (reference-data/sphere_drag_fixed)";
        Ok((drag, Reference { kind: ReferenceKind::Computed, uncertainty: drag.uncertainty, source: source.into() }))
    }

    fn measure(&self, knob: f64) -> Result<Measurement, Error> {
        match *self {
            Variant::Stream { reynolds, across } => {
                let found = Problem { reynolds, surroundings: Surroundings::Stream { across }, cells: knob }.solve()?;
                let (drag, reference) = Variant::drag(reynolds)?;
                let quantities = vec![Quantity::relative(DRAG, found.drag_coefficient, drag.coefficient, reference)];
                let is_seen = self.label() == page::seen().label() && knob == page::SEEN_CELLS;
                Ok(measurement(quantities, &[found], is_seen))
            }
            Variant::Array => {
                let edge = 1.0 / Lattice::SimpleCubic.diameter(FRACTION);
                let found = Problem { reynolds: 1.0, surroundings: Surroundings::CreepingArray { edge }, cells: knob }.solve()?;
                let exact = friction_factor(Lattice::SimpleCubic, FRACTION).ok_or("no such solid fraction in the table")?;
                let source = "fundamental solutions with periodic Stokeslets (reference-data/zick_homsy)";
                let reference = Reference { kind: ReferenceKind::Computed, uncertainty: exact.uncertainty, source: source.into() };
                Ok(measurement(vec![Quantity::relative(FRICTION, found.friction, exact.value, reference)], &[found], false))
            }
            Variant::Limit { reynolds } => limit(reynolds, knob),
        }
    }
}

/// Boxes are extrapolated on the coarsest grid, grids in the smallest box: both errors are small there, and their product smaller.
fn limit(reynolds: f64, finest: f64) -> Result<Measurement, Error> {
    let coarse = finest * GRIDS[0];
    let run = |across: f64, cells: f64| Problem { reynolds, surroundings: Surroundings::Stream { across }, cells }.solve();
    let boxes = WIDTHS.iter().map(|across| run(*across, coarse)).collect::<Result<Vec<Found>, Error>>()?;
    let grids = GRIDS[1..].iter().map(|share| run(WIDTHS[0], finest * share)).collect::<Result<Vec<Found>, Error>>()?;
    let sequence = |scales: &[f64], found: &[&Found]| {
        let points: Vec<[f64; 2]> = scales.iter().zip(found).map(|(scale, found)| [1.0 / scale, found.drag_coefficient]).collect();
        extrapolate(&points).ok_or("too few runs")
    };
    let of_boxes = sequence(&WIDTHS, &boxes.iter().collect::<Vec<_>>())?;
    let of_grids = sequence(&GRIDS.map(|share| finest * share), &[&boxes[0], &grids[0], &grids[1]])?;
    let in_box = boxes[0].drag_coefficient;
    let value = of_grids.value + of_boxes.value - in_box;
    let uncertainty = of_grids.uncertainty + of_boxes.uncertainty;
    let (drag, reference) = Variant::drag(reynolds)?;
    let widest = boxes.last().map_or(f64::NAN, |found| found.drag_coefficient);
    let quantities = vec![
        Quantity::relative(UNBOUNDED, value, drag.coefficient, reference),
        Quantity::nothing(UNCERTAINTY, vec![uncertainty / value], f64::EPSILON, 0.0),
        Quantity::nothing(MISSED, vec![(value - drag.coefficient).abs() / (uncertainty + drag.uncertainty)], f64::EPSILON, 0.0),
        Quantity::nothing(GRID_SHARE, vec![grids[1].drag_coefficient / of_grids.value - 1.0], f64::EPSILON, 0.0),
        Quantity::nothing(BOX_SHARE, vec![widest / of_boxes.value - 1.0], f64::EPSILON, 0.0),
    ];
    let runs: Vec<Found> = boxes.into_iter().chain(grids).collect();
    Ok(Measurement { quantities, work: work(&runs), runs: runs.len() as u64, curves: Vec::new() })
}

fn measurement(mut quantities: Vec<Quantity>, found: &[Found], is_seen: bool) -> Measurement {
    let one = &found[0];
    quantities.extend([
        Quantity::nothing(DIVERGENCE, vec![one.divergence], 1e-14, 0.0),
        Quantity::nothing(SLIP, vec![one.slip], 1e-14, sphere::SLIP),
        Quantity::nothing(FULL_SLIP, vec![one.full_slip], 1e-9, sphere::SLIP),
    ]);
    let slice = || Curve {
        file: SLICE.into(),
        columns: vec!["time", "across", "height", "speed"],
        rows: one.slice.iter().map(|seen| seen.to_vec()).collect(),
    };
    Measurement { quantities, work: work(found), runs: found.len() as u64, curves: is_seen.then(slice).into_iter().collect() }
}

fn work(found: &[Found]) -> BTreeMap<String, u64> {
    let sum = |count: fn(&Found) -> usize| found.iter().map(count).sum::<usize>() as u64;
    BTreeMap::from([
        ("steps".to_string(), sum(|found| found.steps)),
        ("flows".to_string(), sum(|found| found.flows)),
        ("cells".to_string(), sum(|found| found.grid_cells)),
    ])
}

impl Case for FixedSphere {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        Variant::of(setup)?.measure(knob).map_err(|error| Failure::NothingMeasured(error.to_string()))
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        claims::all(tier)
    }

    fn description(&self) -> Description {
        page::description()
    }
}
