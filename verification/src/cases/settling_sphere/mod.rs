//! Spheres that move freely: terminal velocity, transient, added mass, momentum, and the same flow in two frames.

mod claims;
mod fall;
mod page;

use std::collections::BTreeMap;

use reports::row::{Reference, ReferenceKind};
use solver::Scene;

use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::Claim;
use crate::exact::periodic_array::friction_factor;
use crate::variant::Variant as _;
use fall::{Error, Fall, Found, Frames, Point};

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
}

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        vec![Variant::Terminal, Variant::Transient, Variant::Ratios, Variant::Frames]
    }

    fn label(&self) -> String {
        match self {
            Variant::Terminal => "twice as dense as the fluid, simple cubic array, an eighth solid".into(),
            Variant::Transient => "twice as dense as the fluid, steps on the way".into(),
            Variant::Ratios => "from a hundredth to a thousand times as dense as the fluid".into(),
            Variant::Frames => "held in a stream and moved through fluid at rest, Reynolds number 20".into(),
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
        }
    }
}

/// Terminal velocity of the array in Stokes' velocities, with its reference: one over the friction factor.
fn exact_terminal() -> Result<(f64, Reference), Error> {
    let friction = friction_factor(FRACTION).ok_or("no such solid fraction in the table")?;
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

    fn scene(&self, _setup: &Setup, _knob: f64) -> Option<Scene> {
        None
    }

    fn description(&self) -> Description {
        page::description()
    }
}
