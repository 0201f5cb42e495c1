//! Creeping flow through arrays of spheres (R section 7.4, after Zick and Homsy 1982): friction factor, its order and its cost, of every way to hold a body.

mod methods;
mod page;

use std::collections::BTreeMap;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::Scene;

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::cases::pair_distance::poses::Random;
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::periodic_array::friction_factor;
use crate::exact::richardson::extrapolate;
use crate::variant::Variant as _;
use methods::{Found, Method, Problem};

/// The case.
pub struct ZickHomsy;

const FRICTION: &str = "friction factor";
const EXTRAPOLATED: &str = "friction factor on no grid";
const UNCERTAINTY: &str = "uncertainty of the extrapolation";
const DIVERGENCE: &str = "largest divergence x spacing / mean velocity";
const RESIDUAL: &str = "residual of the conditions";
const FULL_RESIDUAL: &str = "slip at the surface / mean velocity, root mean square";

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variant {
    method: Method,
    fraction: f64,
}

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        let sharp = FRACTIONS.map(|fraction| Variant { method: Method::Sharp, fraction });
        let rivals = Method::RIVALS.map(|method| Variant { method, fraction: 0.125 });
        let extrapolated = [0.125, 0.216, 0.343].map(|fraction| Variant { method: Method::Extrapolated, fraction });
        sharp.into_iter().chain(rivals).chain(extrapolated).collect()
    }

    fn label(&self) -> String {
        format!("{}, solid fraction {}", self.method.name(), self.fraction)
    }

    fn knob_name(&self) -> &'static str {
        if self.method.is_marched() { "diffusion_times_a_step" } else { "cells_a_diameter" }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let is_quick = tier == Tier::Quick;
        match self.method {
            Method::Sharp if self.fraction < 0.1 && is_quick => Vec::new(),
            // Spheres that fill little of their cell cost many cells.
            Method::Sharp if self.fraction < 0.01 => vec![8.0, 10.0, 14.0],
            Method::Sharp if self.fraction < 0.1 => vec![10.0, 14.0, 20.0, 28.0],
            Method::Sharp if is_quick && self.fraction == 0.216 => vec![10.0, 14.0, 20.0, 28.0, 40.0],
            Method::Sharp if is_quick => vec![10.0, 14.0, 20.0, 28.0],
            Method::Sharp => vec![10.0, 14.0, 20.0, 28.0, 40.0, 56.0],
            Method::Extrapolated if is_quick => Vec::new(),
            Method::Extrapolated => vec![40.0],
            Method::Marched { .. } if is_quick => vec![100.0],
            Method::Marched { .. } => vec![100.0, 300.0, 1000.0, 3000.0],
            _ if is_quick => vec![8.0, 10.0, 14.0],
            _ => vec![8.0, 10.0, 14.0, 20.0, 28.0, 40.0],
        }
    }
}

/// Solid fractions of the table, the last one of spheres that touch.
const FRACTIONS: [f64; 8] = [0.001, 0.027, 0.064, 0.125, 0.216, 0.343, 0.45, TOUCHING];
const TOUCHING: f64 = 0.523_598_8;

/// Cells a diameter of runs that are marched.
const MARCHED_CELLS: f64 = 10.0;

/// Random places of the sphere between grid points: as many as cost no more than one fine grid.
fn places(cells: f64) -> usize {
    if cells <= 14.0 { 3 } else { 1 }
}

impl Case for ZickHomsy {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let variant = Variant::of(setup)?;
        let reference =
            friction_factor(variant.fraction).ok_or_else(|| Failure::NothingMeasured("no reference at this fraction".into()))?;
        let mut random = Random::new(random_seed);
        let mut place = || [(); 3].map(|()| random.number() - 0.5);
        let quantity = |name, samples, expected, uncertainty, error_kind, floor| Quantity {
            name,
            unit: "1",
            samples,
            expected,
            reference: Reference { kind: ReferenceKind::Computed, uncertainty, source: SOURCE.into() },
            error_kind,
            floor,
        };
        let friction = |name, samples| {
            let relative = reference.uncertainty / reference.value;
            quantity(name, samples, reference.value, reference.uncertainty, ErrorKind::Relative, relative)
        };
        let zero = |name, samples, floor| quantity(name, samples, 0.0, 0.0, ErrorKind::Absolute, floor);
        if variant.method == Method::Extrapolated {
            let sequence = [0.5, 0.6, 0.7, 0.85, 1.0].map(|share| {
                let places = if share < 0.8 { 3 } else { 1 };
                let found = (0..places).map(|_| problem(&variant, knob * share).solve(place())).collect::<Result<Vec<Found>, Failure>>()?;
                Ok([1.0 / found[0].cells, found.iter().map(|found| found.friction).sum::<f64>() / found.len() as f64])
            });
            let sequence = sequence.into_iter().collect::<Result<Vec<[f64; 2]>, Failure>>()?;
            let limit = extrapolate(&sequence).ok_or_else(|| Failure::NothingMeasured("too few grids".into()))?;
            return Ok(Measurement {
                quantities: vec![
                    friction(EXTRAPOLATED, vec![limit.value]),
                    zero(UNCERTAINTY, vec![limit.uncertainty / limit.value], f64::EPSILON),
                ],
                runs: 1,
                ..Measurement::default()
            });
        }
        let cells = if variant.method.is_marched() { MARCHED_CELLS } else { knob };
        let problem = Problem { steps_a_diffusion_time: knob, ..problem(&variant, cells) };
        let count = if variant.method.is_marched() { 1 } else { places(cells) };
        let found = (0..count).map(|_| problem.solve(place())).collect::<Result<Vec<Found>, Failure>>()?;
        let all = |value: fn(&Found) -> f64| found.iter().map(value).collect::<Vec<f64>>();
        let sum = |count: fn(&Found) -> usize| found.iter().map(count).sum::<usize>() as u64;
        Ok(Measurement {
            quantities: vec![
                friction(FRICTION, all(|found| found.friction)),
                zero(DIVERGENCE, all(|found| found.divergence), 1e-14),
                zero(RESIDUAL, all(|found| found.residual), 1e-14),
                zero(FULL_RESIDUAL, all(|found| found.full_residual), 1e-9),
            ],
            work: BTreeMap::from([
                ("flows".to_string(), sum(|found| found.flows)),
                ("conditions".to_string(), sum(|found| found.conditions)),
                ("cells".to_string(), sum(|found| found.grid_cells)),
            ]),
            runs: found.len() as u64,
            curves: Vec::new(),
        })
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        let mut claims = Variant::claims(tier, claims_at);
        claims.extend(Variant::all().iter().filter_map(|variant| order_claim(variant, tier)));
        claims
    }

    fn scene(&self, _setup: &Setup, _knob: f64) -> Option<Scene> {
        None
    }

    fn description(&self) -> Description {
        page::description()
    }
}

const SOURCE: &str = "fundamental solutions with periodic Stokeslets (reference-data/zick_homsy)";

fn problem(variant: &Variant, cells: f64) -> Problem {
    Problem { method: variant.method, fraction: variant.fraction, cells, steps_a_diffusion_time: f64::NAN }
}

/// What must hold of a variant at a knob value.
fn claims_at(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, statistic, bound, expected| variant.claim_at(knob, quantity, statistic, bound, expected);
    let mut claims = Vec::new();
    match variant.method {
        Method::Extrapolated => {
            let part = "a two-thousandth, the width that an anchor of the field may have";
            claims.push(claim(EXTRAPOLATED, Statistic::Single, Bound::new(1.0, 5e-4, part), Expected::Holds));
            claims.push(claim(UNCERTAINTY, Statistic::Single, Bound::new(1.0, 5e-4, part), Expected::Holds));
            return claims;
        }
        Method::Sharp => {
            if variant.fraction != TOUCHING && variant.fraction > 0.01 {
                claims.push(claim(FRICTION, Statistic::Worst, sharp_bound(variant.fraction, knob), Expected::Holds));
            }
        }
        Method::Marched { explicit_forcing } => {
            let direct =
                Bound::new(2.0, 0.094, "the error of the same points without a split, found at a time step of 1e-4 diffusion times");
            let expected = if explicit_forcing > 0.0 {
                Expected::Holds
            } else {
                Expected::KnownLimit(
                    "without the forces of the last step the two halves of a step undo each other, by more the longer it is".into(),
                )
            };
            if knob == 100.0 {
                claims.push(claim(FRICTION, Statistic::Single, direct, expected));
            }
        }
        _ => {}
    }
    if !variant.method.is_marched() {
        let rounding = Bound::new(10.0, 1e-11, "rounding of the transforms, times the ratio of the largest velocity in a gap to the mean");
        claims.push(claim(DIVERGENCE, Statistic::Worst, rounding, Expected::Holds));
        claims.push(claim(RESIDUAL, Statistic::Worst, Bound::new(1.0, methods::TOLERANCE, "the tolerance of the solver"), Expected::Holds));
    }
    claims
}

/// The error of a quadratic continuation: the square of the spacing over the gap or the radius, whichever is less.
fn sharp_bound(fraction: f64, cells: f64) -> Bound {
    let diameter = methods::diameter(fraction);
    let length = (0.5 * diameter).min(1.0 - diameter) / diameter;
    let spacing = 1.0 / cells / length;
    Bound::new(0.5, spacing * spacing, "(spacing over the radius, or over the gap where that is less)^2")
}

fn order_claim(variant: &Variant, tier: Tier) -> Option<Claim> {
    let knobs = variant.knobs(tier);
    let range = [*knobs.first()?, *knobs.last()?];
    let (order, is_at_least, slack) = match variant.method {
        Method::Sharp if (0.1..0.4).contains(&variant.fraction) => (2.0, true, "a cell of the finest grid in the coarsest"),
        Method::Points { .. } => (1.25, false, "a cell of the finest grid in the coarsest"),
        _ => return None,
    };
    let subject = if is_at_least { Subject::OrderAtLeast { order, range } } else { Subject::OrderAbout { order, range } };
    let bound = Bound::new(1.0, 0.2, slack);
    Some(Claim { setup: variant.label(), quantity: FRICTION, statistic: Statistic::Median, subject, bound, expected: Expected::Holds })
}
