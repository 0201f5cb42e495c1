//! Bodies of the fluid's own density: at rest, and turning in shear between walls as Jeffery's spheroids.

mod claims;
mod page;
mod shear;

use std::collections::BTreeMap;

use reports::row::{Reference, ReferenceKind};

use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::Claim;
use crate::exact::jeffery;
use crate::exact::richardson::extrapolate;
use crate::variant::Variant as _;
use shear::{Error, Shear, Turned};

/// The case.
pub struct NeutralBody;

const PERIOD: &str = "period / that without bounds";
const ANGLE: &str = "angle of the axis less that without bounds, largest";
const RATE: &str = "rate of turning / half the shear rate";
const GRID: &str = "rate of turning / that on a fine grid";
const ASIDE: &str = "velocities that symmetry forbids / shear rate times largest semi-axis, largest";
const SLIP: &str = "residual of conditions and balance / shear rate times largest semi-axis, root mean square";
const REST: &str = "velocity at rest, largest";
const UNBOUNDED: &str = "period / that without bounds, in no box and on no grid";
const UNCERTAINTY: &str = "uncertainty of the extrapolation";
const MISSED: &str = "distance from the exact period / uncertainty of the extrapolation";
const GRID_SHARE: &str = "share of the finest grid in the period in the smallest box";
const BOX_SHARE: &str = "share of the widest box in the period";

/// Gap between the walls, and distance of images, in largest diameters, of the sweeps over grids.
const GAP: f64 = 2.0;
/// Gaps of the sweeps over boxes.
const GAPS: [f64; 3] = [2.0, 3.0, 4.0];
/// Cells a smallest diameter of the sweeps over boxes, and grids that are extrapolated to none.
const GRIDS: [f64; 3] = [6.0, 8.0, 12.0];
/// Cells a diameter of the grid that stands for none.
const FINE: f64 = 16.0;
/// Length of a step in inverse shear rates.
const STEP: f64 = 0.1;
/// Places of the centre between values of the grid, in spacings from the middle of the box: few cells a diameter see a body by where it lies. The first one
/// favours nothing, the second all planes of symmetry.
const PLACES: [[f64; 3]; 4] = [[0.22, 0.13, 0.37], [0.0, 0.0, 0.0], [0.45, 0.31, 0.12], [0.11, 0.42, 0.25]];

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Variant {
    /// At rest in fluid at rest.
    Rest,
    /// A sphere that turns steadily, on finer grids.
    Sphere,
    /// The same in wider boxes.
    SphereBoxes,
    /// A quarter of an orbit of a spheroid of an aspect ratio, on finer grids.
    Orbit(f64),
    /// The same in wider boxes.
    OrbitBoxes(f64),
    /// Extrapolated over boxes and grids.
    Limit(f64),
}

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        let mut all = vec![Variant::Rest, Variant::Sphere, Variant::SphereBoxes];
        for aspect in [2.0, 0.5] {
            all.extend([Variant::Orbit(aspect), Variant::OrbitBoxes(aspect)]);
        }
        all.extend([1.0, 2.0, 0.5].map(Variant::Limit));
        all
    }

    fn label(&self) -> String {
        match self {
            Variant::Rest => "spheroid of aspect ratio 2 at rest between walls at rest, with weight".into(),
            Variant::Sphere => format!("sphere in shear, walls {GAP} diameters apart"),
            Variant::SphereBoxes => format!("sphere in shear, {} cells a diameter, wider boxes", GRIDS[1]),
            Variant::Orbit(aspect) => format!("spheroid of aspect ratio {aspect} in shear, walls {GAP} largest diameters apart"),
            Variant::OrbitBoxes(aspect) => {
                format!("spheroid of aspect ratio {aspect} in shear, {} cells a diameter, wider boxes", GRIDS[0])
            }
            Variant::Limit(aspect) => format!("aspect ratio {aspect}, extrapolated over boxes and grids"),
        }
    }

    fn knob_name(&self) -> &'static str {
        match self {
            Variant::SphereBoxes | Variant::OrbitBoxes(_) => "gap_in_largest_diameters",
            _ => "cells_a_smallest_diameter",
        }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let of = |quick: &[f64], longer: &[f64]| if tier == Tier::Quick { quick.to_vec() } else { longer.to_vec() };
        match self {
            Variant::Rest => vec![6.0],
            Variant::Sphere => vec![6.0, 8.0, 12.0],
            Variant::SphereBoxes => of(&GAPS[..2], &GAPS),
            Variant::Orbit(aspect) => of(if *aspect > 1.0 { &GRIDS[..1] } else { &[] }, &GRIDS),
            Variant::OrbitBoxes(_) => of(&[], &GAPS),
            Variant::Limit(_) => of(&[], &GRIDS[2..]),
        }
    }
}

fn shear(aspect: f64, gap: f64, cells: f64) -> Shear {
    Shear { aspect, gap, apart: [gap; 2], cells, step: STEP, place: PLACES[0] }
}

/// A turn, and its period over Jeffery's.
fn turn(shear: Shear) -> Result<(Turned, f64), Error> {
    let Shear { aspect, .. } = shear;
    // A sphere turns evenly: two steps are enough to see that it does.
    let turned = shear.run((aspect == 1.0).then_some(2.0 * STEP))?;
    let quarter = if aspect == 1.0 { Some(0.5 * std::f64::consts::PI / turned.first_rate) } else { turned.quarter() };
    let quarter = quarter.ok_or("fewer than three steps in a quarter of an orbit")?;
    Ok((turned, 4.0 * quarter / jeffery::period(aspect)))
}

fn exact() -> Reference {
    Reference { kind: ReferenceKind::Exact, uncertainty: 1e-12, source: "Jeffery (1922): creeping flow without bounds".into() }
}

impl Variant {
    fn measure(&self, knob: f64) -> Result<Measurement, Error> {
        match *self {
            Variant::Rest => {
                let fastest = shear(2.0, GAP, knob).at_rest(5)?;
                let quantities = vec![Quantity::nothing(REST, vec![fastest], f64::EPSILON, 0.0)];
                Ok(Measurement { quantities, runs: 1, ..Measurement::default() })
            }
            Variant::Sphere => sphere(knob),
            Variant::SphereBoxes => {
                let (turned, _) = turn(shear(1.0, knob, GRIDS[1]))?;
                Ok(measurement(vec![rate(std::slice::from_ref(&turned))], &[turned], None))
            }
            Variant::Orbit(aspect) => orbit(aspect, GAP, knob),
            Variant::OrbitBoxes(aspect) => orbit(aspect, knob, GRIDS[0]),
            Variant::Limit(aspect) => limit(aspect),
        }
    }
}

fn rate(turned: &[Turned]) -> Quantity {
    let samples = turned.iter().map(|turned| turned.first_rate / 0.5).collect();
    Quantity { samples, ..Quantity::relative(RATE, 1.0, 1.0, exact()) }
}

/// A sphere at some places of the grid, against a fine grid in the same box.
fn sphere(cells: f64) -> Result<Measurement, Error> {
    let at = |place: [f64; 3]| turn(Shear { place, ..shear(1.0, GAP, cells) }).map(|(turned, _)| turned);
    let turned = PLACES.into_iter().map(at).collect::<Result<Vec<Turned>, Error>>()?;
    let (fine, _) = turn(shear(1.0, GAP, FINE))?;
    let source = "own grid of 16 cells a diameter, same box";
    let reference = Reference { kind: ReferenceKind::OwnFine, uncertainty: 1e-3, source: source.into() };
    let samples = turned.iter().map(|turned| turned.first_rate / fine.first_rate).collect();
    let on_grid = Quantity { samples, ..Quantity::relative(GRID, 1.0, 1.0, reference) };
    let quantities = vec![on_grid, rate(&turned)];
    Ok(measurement(quantities, &turned, None))
}

fn orbit(aspect: f64, gap: f64, cells: f64) -> Result<Measurement, Error> {
    let (turned, period) = turn(shear(aspect, gap, cells))?;
    let apart = turned.points.iter().map(|[time, angle]| (angle - jeffery::angle(aspect, *time)).abs()).fold(0.0, f64::max);
    let angle = Quantity { unit: "rad", ..Quantity::nothing(ANGLE, vec![apart], 1e-12, 0.0) };
    let first = vec![Quantity::relative(PERIOD, period, 1.0, exact()), angle];
    let rows = turned.points.iter().map(|[time, angle]| vec![*time, *angle, jeffery::angle(aspect, *time)]).collect();
    let curve = Curve {
        file: format!("orbit_{aspect}_{gap}_{cells}.csv"),
        columns: vec!["shear_rate_times_time", "angle", "angle_without_bounds"],
        rows,
    };
    Ok(measurement(first, &[turned], Some(curve)))
}

/// Runs in a box on a grid, and the mean of their periods over Jeffery's. A spheroid sees itself in all directions while it turns; a sphere always sees the
/// same, which depends on its place on the grid, so it has some.
fn mean_period(aspect: f64, gap: f64, cells: f64) -> Result<(Vec<Turned>, f64), Error> {
    let places = if aspect == 1.0 { &PLACES[..] } else { &PLACES[..1] };
    let runs = places.iter().map(|place| turn(Shear { place: *place, ..shear(aspect, gap, cells) })).collect::<Result<Vec<_>, Error>>()?;
    let mean = runs.iter().map(|(_, period)| period).sum::<f64>() / runs.len() as f64;
    Ok((runs.into_iter().map(|(turned, _)| turned).collect(), mean))
}

/// Boxes are extrapolated on one grid, grids in the smallest box: both errors are small there, and their product smaller. Orbits in wide boxes are costly, so
/// that grid is the coarsest; two steps of a sphere are not, and it is the finest.
fn limit(aspect: f64) -> Result<Measurement, Error> {
    let shared = if aspect == 1.0 { GRIDS.len() - 1 } else { 0 };
    let grids = GRIDS.iter().map(|cells| mean_period(aspect, GAP, *cells)).collect::<Result<Vec<_>, Error>>()?;
    let wider = GAPS[1..].iter().map(|gap| mean_period(aspect, *gap, GRIDS[shared])).collect::<Result<Vec<_>, Error>>()?;
    let sequence = |scales: &[f64], periods: &[f64]| {
        let points: Vec<[f64; 2]> = scales.iter().zip(periods).map(|(scale, period)| [1.0 / scale, *period]).collect();
        extrapolate(&points).ok_or("too few runs")
    };
    let on_grids: Vec<f64> = grids.iter().map(|(_, period)| *period).collect();
    let in_boxes: Vec<f64> = std::iter::once(on_grids[shared]).chain(wider.iter().map(|(_, period)| *period)).collect();
    let (of_boxes, of_grids) = (sequence(&GAPS, &in_boxes)?, sequence(&GRIDS, &on_grids)?);
    let value = of_grids.value + of_boxes.value - on_grids[shared];
    let uncertainty = of_grids.uncertainty + of_boxes.uncertainty;
    let (finest, widest) = (on_grids[GRIDS.len() - 1], in_boxes[GAPS.len() - 1]);
    let quantities = vec![
        Quantity::relative(UNBOUNDED, value, 1.0, exact()),
        Quantity::nothing(UNCERTAINTY, vec![uncertainty], f64::EPSILON, 0.0),
        Quantity::nothing(MISSED, vec![(value - 1.0).abs() / uncertainty], f64::EPSILON, 0.0),
        Quantity::nothing(GRID_SHARE, vec![finest / of_grids.value - 1.0], f64::EPSILON, 0.0),
        Quantity::nothing(BOX_SHARE, vec![widest / of_boxes.value - 1.0], f64::EPSILON, 0.0),
    ];
    let runs: Vec<Turned> = wider.into_iter().chain(grids).flat_map(|(turned, _)| turned).collect();
    Ok(Measurement { quantities, work: work(&runs), runs: runs.len() as u64, curves: Vec::new() })
}

fn measurement(mut quantities: Vec<Quantity>, turned: &[Turned], curve: Option<Curve>) -> Measurement {
    let largest = |of: fn(&Turned) -> f64| turned.iter().map(of).fold(0.0, f64::max);
    quantities.push(Quantity::nothing(ASIDE, vec![largest(|turned| turned.aside)], 1e-9, shear::SLIP));
    quantities.push(Quantity::nothing(SLIP, vec![largest(|turned| turned.slip)], 1e-12, shear::SLIP));
    Measurement { quantities, work: work(turned), runs: 1, curves: curve.into_iter().collect() }
}

fn work(turned: &[Turned]) -> BTreeMap<String, u64> {
    let sum = |count: fn(&Turned) -> usize| turned.iter().map(count).sum::<usize>() as u64;
    BTreeMap::from([
        ("steps".to_string(), sum(|turned| turned.points.len())),
        ("flows".to_string(), sum(|turned| turned.flows)),
        ("cells".to_string(), sum(|turned| turned.grid_cells)),
    ])
}

impl Case for NeutralBody {
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
