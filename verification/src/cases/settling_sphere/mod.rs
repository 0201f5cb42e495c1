//! Spheres that move freely: terminal velocity, transient, added mass, momentum, the same flow in two frames, and a fall in a tank.

mod claims;
mod fall;
mod page;
mod tank;

use std::collections::BTreeMap;

use reports::row::{Reference, ReferenceKind};

use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::Claim;
use crate::exact::periodic_array::{Lattice, friction_factor};
use crate::exact::richardson::extrapolate;
use crate::exact::tank::{self as measured, experiment};
use crate::variant::Variant as _;
use fall::{Error, Fall, Found, Frames, Point};
use tank::{Settled, Tank};

/// The case.
pub struct SettlingSphere;

const TERMINAL: &str = "terminal velocity / Stokes' velocity";
const RIPPLE: &str = "ripple of the velocity on its way over cells / terminal velocity, root mean square";
const ASIDE: &str = "velocity across and of turning / terminal velocity, largest";
const SLIP: &str = "residual of conditions and balance / Stokes' velocity, root mean square";
const TRANSIENT: &str = "velocity on the way / that of fine steps";
const STARTED: &str = "velocity after the first step / Stokes' velocity";
const FALLBACK: &str = "largest fall of the speed in a step / terminal velocity";
const REST: &str = "velocity of a neutral sphere at rest / Stokes' velocity, largest";
const FRAMES: &str = "drag of a sphere that moves / of one held in the stream";

const FASTEST: &str = "largest velocity in the tank";
const NO_GRID: &str = "largest velocity in the tank, extrapolated over grids";
const GRID_SHARE: &str = "share of the finest grid in the largest velocity";
const STEP_SHARE: &str = "share of the step in the largest velocity";
const WALL_SHARE: &str = "what walls half as far again would add to the largest velocity";

/// Cells a diameter of the tank, coarse to fine: 30, 40 and 60 across.
const TANK_CELLS: [f64; 3] = [4.5, 6.0, 9.0];
/// Spacings that the sphere falls in a step, at its velocity without bounds.
const COURANT: f64 = 0.2;

/// Solid fraction of the array: an eighth.
const FRACTION: f64 = 0.125;
/// Solid fraction of the array in which spheres of all densities start.
const START_FRACTION: f64 = 0.02;
/// Steps a time of their first step: a layer of a third of the radius.
const START_STEPS: f64 = 9.0;
/// Slip at which the iteration of a step stops, in Stokes' velocities.
const LEFT: f64 = 1e-5;
/// Density ratios of the sweep.
const RATIOS: [f64; 12] = [0.01, 0.1, 0.4, 0.5, 0.6, 0.99, 1.0, 1.01, 1.2, 2.0, 10.0, 1000.0];
/// Steps a time that stand for none.
const FINE_STEPS: f64 = 160.0;

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Variant {
    /// Falls until its velocity stays.
    Terminal,
    /// On its way, with longer and shorter steps.
    Transient,
    /// Light and heavy ones: start and way.
    Ratios,
    /// Held in a stream and moved through still fluid.
    Frames,
    /// In a closed tank on coarser grids, an experiment by its name.
    Tank(&'static str),
    /// The same on the finest grid and without the share of the grid, and the shares of grid, step and walls.
    TankShares(&'static str),
}

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        let mut all = vec![Variant::Terminal, Variant::Transient, Variant::Ratios, Variant::Frames];
        all.extend(["E1", "E4"].map(Variant::Tank));
        all.extend(["E1", "E4"].map(Variant::TankShares));
        all
    }

    fn label(&self) -> String {
        match self {
            Variant::Terminal => "twice as dense as the fluid, simple cubic array, an eighth solid".into(),
            Variant::Transient => "twice as dense as the fluid, steps on the way".into(),
            Variant::Ratios => "from a hundredth to a thousand times as dense as the fluid".into(),
            Variant::Frames => "held in a stream and moved through fluid at rest, Reynolds number 20".into(),
            Variant::Tank(name) => format!("ten Cate's tank, case {name}"),
            Variant::TankShares(name) => format!("ten Cate's tank, case {name}, finest grid and shares of the error"),
        }
    }

    fn knob_name(&self) -> &'static str {
        match self {
            Variant::Transient => "steps_a_viscous_time",
            Variant::Ratios => "density_ratio",
            _ => "cells_a_diameter",
        }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let of = |quick: &[f64], longer: &[f64]| if tier == Tier::Quick { quick.to_vec() } else { longer.to_vec() };
        match self {
            Variant::Terminal => of(&[6.0, 8.0, 12.0], &[6.0, 8.0, 12.0, 16.0, 24.0]),
            Variant::Transient => vec![10.0, 20.0, 40.0],
            Variant::Ratios => of(&[0.01, 0.99, 1.0, 1.01, 1000.0], &RATIOS),
            Variant::Frames => of(&[6.0], &[6.0, 8.0, 12.0, 16.0]),
            Variant::Tank(_) => of(&[], &TANK_CELLS[..2]),
            Variant::TankShares(_) => of(&[], &TANK_CELLS[2..]),
        }
    }
}

impl Variant {
    fn fall() -> Fall {
        Fall { fraction: FRACTION, cells: 8.0, density_ratio: 2.0, speed: 0.5, steps_a_time: 20.0, slip: LEFT }
    }

    fn measure(&self, knob: f64) -> Result<Measurement, Error> {
        match self {
            Variant::Terminal => terminal(knob),
            Variant::Transient => transient(knob),
            Variant::Ratios => ratios(knob),
            Variant::Frames => frames(knob),
            Variant::Tank(name) => in_tank(name, knob),
            Variant::TankShares(name) => tank_shares(name),
        }
    }
}

/// Terminal velocity of the array in Stokes' velocities, with its reference: one over the friction factor.
fn exact_terminal() -> Result<(f64, Reference), Error> {
    let friction = friction_factor(Lattice::SimpleCubic, FRACTION).ok_or("no such solid fraction in the table")?;
    let value = 1.0 / friction.value;
    let uncertainty = friction.uncertainty * value * value;
    let source = "friction factor by fundamental solutions with periodic Stokeslets (reference-data/zick_homsy)";
    Ok((value, Reference { kind: ReferenceKind::Computed, uncertainty, source: source.into() }))
}

fn terminal(cells: f64) -> Result<Measurement, Error> {
    let (exact, reference) = exact_terminal()?;
    let found = Fall { cells, ..Variant::fall() }.run(4.0)?;
    // By then what is left of the start is below a thousandth.
    let late: Vec<&Point> = found.points.iter().filter(|point| point.time > 2.5).collect();
    let mean = late.iter().map(|point| point.speed).sum::<f64>() / late.len() as f64;
    let square = late.iter().map(|point| (point.speed - mean).powi(2)).sum::<f64>() / late.len() as f64;
    let aside = found.points.iter().map(|point| point.aside).fold(0.0, f64::max);
    let quantities = vec![
        Quantity::relative(TERMINAL, mean, exact, reference),
        Quantity::nothing(RIPPLE, vec![square.sqrt() / exact], 1e-9, LEFT / exact),
        Quantity::nothing(ASIDE, vec![aside / exact], 1e-9, LEFT / exact),
        Quantity::nothing(SLIP, vec![found.slip], 1e-12, LEFT),
    ];
    let rows = found.points.iter().map(|point| vec![point.time, point.speed, exact]).collect();
    let curve = Curve { file: format!("fall_{cells}.csv"), columns: vec!["time", "speed", "terminal"], rows };
    Ok(Measurement { quantities, work: work(&[&found]), runs: 1, curves: vec![curve] })
}

/// So slow that the sphere stays where it is: steps alone differ.
fn transient(steps_a_time: f64) -> Result<Measurement, Error> {
    let slow = Fall { cells: 6.0, speed: 1e-3, slip: 1e-7, ..Variant::fall() };
    let run = |steps_a_time: f64| Fall { steps_a_time, ..slow }.run(0.4);
    let (found, fine) = (run(steps_a_time)?, run(FINE_STEPS)?);
    let last = |found: &Found| found.points.last().map_or(f64::NAN, |point| point.speed);
    let reference =
        Reference { kind: ReferenceKind::OwnFine, uncertainty: 1e-6, source: "own steps, four times finer than the finest".into() };
    let quantities = vec![Quantity::relative(TRANSIENT, last(&found) / last(&fine), 1.0, reference)];
    Ok(Measurement { quantities, work: work(&[&found, &fine]), runs: 1, curves: Vec::new() })
}

/// Velocity after a first step from rest in Stokes' velocities: Stokes' unsteady drag at the rate of one over the step, $1 + a / \delta + a^2 / (9 \delta^2)$ with
/// $\delta^2 = \nu \Delta t$, of which the last term is the added mass. Images in a cubic array are felt through pressure alone where layers are thin: the dipole of a
/// sphere is stronger by the fluid that must come back past it (Zuber 1964).
fn exact_start(density_ratio: f64) -> f64 {
    let dipole = 1.0 / (1.0 - START_FRACTION);
    let drag = 1.0 + START_STEPS.sqrt() * dipole * dipole + START_STEPS / 9.0 * (3.0 * dipole - 2.0);
    1.0 / (drag + 2.0 / 9.0 * START_STEPS * density_ratio)
}

fn ratios(density_ratio: f64) -> Result<Measurement, Error> {
    let with = Fall { density_ratio, ..Variant::fall() };
    let (exact, _) = exact_terminal()?;
    if density_ratio == 1.0 {
        let found = with.run(1.0)?;
        let fastest = found.points.iter().map(|point| point.speed.abs().max(point.aside)).fold(0.0, f64::max);
        return Ok(Measurement {
            quantities: vec![Quantity::nothing(REST, vec![fastest], f64::EPSILON, 0.0)],
            work: work(&[&found]),
            runs: 1,
            curves: Vec::new(),
        });
    }
    let expected = exact_start(density_ratio);
    let first = Fall { fraction: START_FRACTION, cells: 12.0, speed: 1.0, steps_a_time: START_STEPS, slip: 1e-5 * expected, ..with };
    let start = first.run(1.0 / START_STEPS)?;
    let way = with.run(1.0)?;
    let speed = start.points.first().map_or(f64::NAN, |point| point.speed);
    let falls = way.points.windows(2).map(|two| two[0].speed - two[1].speed).fold(0.0, f64::max);
    let source = "Stokes' unsteady drag, images through pressure; what is left of them is of the order of the solid fraction times the drag without inertia";
    let reference = Reference { kind: ReferenceKind::Exact, uncertainty: START_FRACTION * expected * expected, source: source.into() };
    let quantities = vec![
        Quantity::relative(STARTED, speed, expected, reference),
        Quantity::nothing(FALLBACK, vec![falls / exact], 1e-9, LEFT / exact),
        Quantity::nothing(SLIP, vec![way.slip], 1e-12, LEFT),
    ];
    Ok(Measurement { quantities, work: work(&[&start, &way]), runs: 1, curves: Vec::new() })
}

fn frames(cells: f64) -> Result<Measurement, Error> {
    let ([held, moved], flows) = Frames { reynolds: 20.0, edge: 2.0, cells }.drags()?;
    let reference =
        Reference { kind: ReferenceKind::OwnFine, uncertainty: 1e-4, source: "the same flow in the frame of the sphere".into() };
    let quantities = vec![Quantity::relative(FRAMES, moved / held, 1.0, reference)];
    Ok(Measurement { quantities, work: BTreeMap::from([("flows".to_string(), flows as u64)]), runs: 1, curves: Vec::new() })
}

/// A tank on a grid of so many cells a diameter.
fn tank(name: &str, cells: f64) -> Result<Tank, Error> {
    let experiment = experiment(name).ok_or("no such experiment in the table")?;
    Ok(Tank { experiment, across: (cells * tank::TANK[0] / experiment.diameter).round() as usize, courant: COURANT, wider: 1.0 })
}

/// File of a fall in a tank.
fn curve_file(name: &str, cells: f64) -> String {
    format!("tank_{name}_{cells}.csv")
}

/// A largest velocity in m/s against the one measured.
fn against_experiment(quantity: &'static str, tank: &Tank, fastest: f64) -> Quantity {
    let expected = tank.experiment.fastest;
    let source = "ten Cate et al. (2002) (reference-data/tencate_settling)";
    let reference = Reference { kind: ReferenceKind::Experiment, uncertainty: measured::UNCERTAINTY * expected, source: source.into() };
    Quantity { unit: "m/s", ..Quantity::relative(quantity, fastest, expected, reference) }
}

/// What is told of every fall in the tank, and its curve.
fn seen_in_tank(name: &str, cells: f64, tank: &Tank, settled: &Settled) -> (Vec<Quantity>, Curve) {
    let quantities = vec![
        against_experiment(FASTEST, tank, settled.fastest),
        Quantity::nothing(ASIDE, vec![settled.aside / settled.fastest], 1e-9, tank::SLIP),
        Quantity::nothing(SLIP, vec![settled.slip / tank.experiment.unbounded], 1e-12, tank::SLIP),
    ];
    let rows = settled.points.iter().map(|point| point.to_vec()).collect();
    (quantities, Curve { file: curve_file(name, cells), columns: vec!["time", "height", "speed"], rows })
}

fn in_tank(name: &str, cells: f64) -> Result<Measurement, Error> {
    let tank = tank(name, cells)?;
    let settled = tank.run()?;
    let (quantities, curve) = seen_in_tank(name, cells, &tank, &settled);
    Ok(Measurement { quantities, work: work_in_tank(&[settled]), runs: 1, curves: vec![curve] })
}

/// Grids are extrapolated; half the step and wider walls are looked at on the coarsest grid, where they cost less.
fn tank_shares(name: &str) -> Result<Measurement, Error> {
    let tanks = TANK_CELLS.iter().map(|cells| tank(name, *cells)).collect::<Result<Vec<Tank>, Error>>()?;
    let (coarse, fine) = (tanks[0], tanks[2]);
    let mut runs = tanks.iter().map(Tank::run).collect::<Result<Vec<Settled>, Error>>()?;
    let points: Vec<[f64; 2]> = TANK_CELLS.iter().zip(&runs).map(|(cells, run)| [1.0 / cells, run.fastest]).collect();
    let grids = extrapolate(&points).ok_or("too few runs")?;
    runs.push(Tank { courant: 0.5 * COURANT, ..coarse }.run()?);
    runs.push(Tank { wider: 1.5, ..coarse }.run()?);
    let [of_coarse, _, of_fine, of_half_step, of_wider] = [0, 1, 2, 3, 4].map(|run| runs[run].fastest);
    let (mut quantities, curve) = seen_in_tank(name, TANK_CELLS[2], &fine, &runs[2]);
    quantities.extend([
        against_experiment(NO_GRID, &fine, grids.value),
        Quantity::nothing(GRID_SHARE, vec![of_fine / grids.value - 1.0], f64::EPSILON, 0.0),
        Quantity::nothing(STEP_SHARE, vec![of_coarse / of_half_step - 1.0], f64::EPSILON, 0.0),
        Quantity::nothing(WALL_SHARE, vec![of_wider / of_coarse - 1.0], f64::EPSILON, 0.0),
    ]);
    Ok(Measurement { quantities, work: work_in_tank(&runs), runs: runs.len() as u64, curves: vec![curve] })
}

fn work_in_tank(settled: &[Settled]) -> BTreeMap<String, u64> {
    let sum = |count: fn(&Settled) -> usize| settled.iter().map(count).sum::<usize>() as u64;
    BTreeMap::from([
        ("steps".to_string(), sum(|settled| settled.points.len())),
        ("flows".to_string(), sum(|settled| settled.flows)),
        ("cells".to_string(), sum(|settled| settled.grid_cells)),
    ])
}

fn work(found: &[&Found]) -> BTreeMap<String, u64> {
    let sum = |count: fn(&Found) -> usize| found.iter().map(|found| count(found)).sum::<usize>() as u64;
    BTreeMap::from([
        ("steps".to_string(), sum(|found| found.points.len())),
        ("flows".to_string(), sum(|found| found.flows)),
        ("cells".to_string(), sum(|found| found.grid_cells)),
    ])
}

impl Case for SettlingSphere {
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
