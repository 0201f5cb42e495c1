//! Flow through a small packed bed of trilobes (R section 7.4.3): pressure drop, its convergence on grids, and what goes on layer by layer.

mod bed;
mod claims;
mod fine;
mod flows;
mod page;

use std::collections::BTreeMap;

use reports::row::{ErrorKind, Reference, ReferenceKind};

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::Claim;
use crate::exact::ergun;
use crate::exact::richardson::extrapolate;
use crate::variant::Variant as _;
use bed::Trilobe;
use flows::{Error, Found, Problem, Regime};

/// The case.
pub struct SmallPackedBed;

const DROP: &str = "pressure drop / (viscosity x velocity / diameter)";
const EXTRAPOLATED: &str = "pressure drop on no grid / (viscosity x velocity / diameter)";
const UNCERTAINTY: &str = "uncertainty of the extrapolation";
const LONGER: &str = "pressure drop in a longer box / that in R's, less one";
const EXCESS: &str = "pressure drop / that of creeping flow on the same grid, less one";
const VISCOUS: &str = "viscous constant of Ergun's form";
const INERTIAL: &str = "inertial constant of Ergun's form";
const TORTUOSITY: &str = "tortuosity between the cuts";
const IMBALANCE: &str = "pressure drop less drag and momentum, over the drop";
const SOLID: &str = "volume of the solids / that of forty trilobes";
const LEAK: &str = "flow missing in a layer / flow";
const DIVERGENCE: &str = "largest divergence x spacing / velocity";
const RESIDUAL: &str = "residual of the conditions";

/// Reynolds number of the flow with inertia (R).
const REYNOLDS: f64 = 16.0;
/// Cells a diameter of the runs whose layers and slices are shown.
const SEEN: f64 = 8.0;
/// The sequence of grids of a limit, as shares of the finest.
const SEQUENCE: [f64; 4] = [0.5, 0.625, 0.75, 1.0];

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Variant {
    /// Flow on one grid.
    Flow(Regime),
    /// The limit of a sequence of grids, creeping.
    Limit,
    /// Creeping flow in R's box and in a longer one.
    Longer,
}

const INERTIA: Regime = Regime::Reynolds(REYNOLDS);

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        let creeping = Regime::Creeping;
        vec![Variant::Flow(creeping), Variant::Flow(INERTIA), Variant::Limit, Variant::Longer]
    }

    fn label(&self) -> String {
        let name = |regime: &Regime| match regime {
            Regime::Creeping => "creeping flow".to_string(),
            Regime::Reynolds(reynolds) => format!("Reynolds number {reynolds}"),
        };
        match self {
            Variant::Flow(regime) => name(regime),
            Variant::Limit => "creeping flow, extrapolated".into(),
            Variant::Longer => "creeping flow, boxes of two lengths".into(),
        }
    }

    fn knob_name(&self) -> &'static str {
        "cells_a_diameter"
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let of = |quick: &[f64], longer: &[f64]| if tier == Tier::Quick { quick.to_vec() } else { longer.to_vec() };
        match self {
            Variant::Flow(Regime::Creeping) => of(&[8.0], &[8.0, 10.0, 12.0, 16.0, 20.0]),
            Variant::Flow(_) => of(&[], &[8.0, 10.0, 12.0, 16.0]),
            Variant::Limit => of(&[], &[16.0]),
            Variant::Longer => of(&[], &[8.0]),
        }
    }
}

impl Variant {
    fn measure(&self, knob: f64) -> Result<Measurement, Error> {
        let cells = knob.round() as usize;
        match *self {
            Variant::Flow(regime) => self.flow(Problem { regime, cells }, knob),
            Variant::Limit => limit(cells),
            Variant::Longer => {
                let of = |regime| Problem { regime, cells }.creeping();
                let (short, long) = (of(Regime::Creeping)?, of(INERTIA)?);
                let quantities = vec![Quantity::nothing(LONGER, vec![long.drop / short.drop - 1.0], flows::TOLERANCE, 0.0)];
                Ok(Measurement { quantities, work: work(&[short, long]), runs: 2, curves: Vec::new() })
            }
        }
    }

    fn flow(&self, problem: Problem, knob: f64) -> Result<Measurement, Error> {
        let (creeping, found) = problem.solve()?;
        let solved = found.as_ref().unwrap_or(&creeping);
        let bed = Trilobe::new()?.bed(solved.void_fraction);
        let viscous = bed.viscous_constant(creeping.gradient, 1.0, 1.0);
        let constant = if found.is_some() {
            band(INERTIAL, bed.inertial_constant(solved.gradient, viscous, [1.0, REYNOLDS, 1.0]), ergun::inertial_band())
        } else {
            band(VISCOUS, viscous, ergun::viscous_band())
        };
        let mut quantities = vec![
            constant,
            Quantity::nothing(IMBALANCE, vec![solved.imbalance], 1e-12, 0.0),
            Quantity::relative(SOLID, solved.solid_volume, 1.0, exact("areas of circles and triangles")),
            Quantity::nothing(LEAK, vec![solved.leak], 1e-9, 0.0),
            Quantity::nothing(DIVERGENCE, vec![solved.divergence], 1e-14, 0.0),
            Quantity::nothing(RESIDUAL, vec![solved.residual], 1e-14, 0.0),
        ];
        if found.is_none() {
            quantities.push(own_fine(DROP, solved.drop, fine::DROP));
            quantities.push(own_fine(TORTUOSITY, solved.tortuosity, fine::TORTUOSITY));
        } else {
            quantities.push(Quantity::nothing(EXCESS, vec![solved.drop / creeping.drop - 1.0], f64::EPSILON, 0.0));
        }
        let curves = if knob == SEEN { page::curves(problem.regime, solved) } else { Vec::new() };
        let work = work(&found.into_iter().chain([creeping]).collect::<Vec<_>>());
        Ok(Measurement { quantities, work, runs: 1, curves })
    }
}

/// Pressure drop of creeping flow on no grid.
fn limit(finest: usize) -> Result<Measurement, Error> {
    let on_grid = |share: &f64| Problem { regime: Regime::Creeping, cells: (finest as f64 * share).round() as usize }.creeping();
    let found = SEQUENCE.iter().map(on_grid).collect::<Result<Vec<Found>, Error>>()?;
    let sequence: Vec<[f64; 2]> =
        SEQUENCE.iter().zip(&found).map(|(share, found)| [1.0 / (finest as f64 * share).round(), found.drop]).collect();
    let limit = extrapolate(&sequence).ok_or("too few grids")?;
    let quantities = vec![
        own_fine(EXTRAPOLATED, limit.value, fine::DROP),
        Quantity::nothing(UNCERTAINTY, vec![limit.uncertainty / limit.value], 1e-9, 0.0),
    ];
    Ok(Measurement { quantities, work: work(&found), runs: found.len() as u64, curves: Vec::new() })
}

fn exact(source: &str) -> Reference {
    Reference { kind: ReferenceKind::Exact, uncertainty: 1e-12, source: source.into() }
}

fn own_fine(name: &'static str, value: f64, [expected, uncertainty]: [f64; 2]) -> Quantity {
    let source = "own grids of 8 to 16 cells a diameter, extrapolated with orders from 1 to 2".into();
    Quantity::relative(name, value, expected, Reference { kind: ReferenceKind::OwnFine, uncertainty, source })
}

/// A constant held against the middle of the band of all authors; half the band is its uncertainty.
fn band(name: &'static str, value: f64, [least, most]: [f64; 2]) -> Quantity {
    let (expected, uncertainty) = (0.5 * (least + most), 0.5 * (most - least));
    let source = format!("correlations of Ergun's form, {least} to {most} (reference-data/ergun_constants)");
    let reference = Reference { kind: ReferenceKind::Correlation, uncertainty, source };
    Quantity { name, unit: "1", samples: vec![value], expected, reference, error_kind: ErrorKind::Absolute, floor: uncertainty }
}

fn work(found: &[Found]) -> BTreeMap<String, u64> {
    let sum = |count: fn(&Found) -> usize| found.iter().map(count).sum::<usize>() as u64;
    BTreeMap::from([
        ("iterations".to_string(), sum(|found| found.iterations)),
        ("flows".to_string(), sum(|found| found.flows)),
        ("cells".to_string(), sum(|found| found.grid_cells)),
        ("conditions by parabolas".to_string(), sum(|found| found.continued.quadratic)),
        ("conditions by straight lines".to_string(), sum(|found| found.continued.linear)),
        ("conditions asked of ghosts themselves".to_string(), sum(|found| found.continued.direct)),
        ("pockets".to_string(), sum(|found| found.pockets)),
    ])
}

impl Case for SmallPackedBed {
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
