//! Creeping flow through arrays of spheres (R section 7.4, after Zick and Homsy 1982): friction factor, its order and its cost, of every way to hold a body.

mod claims;
mod methods;
mod page;

use std::collections::BTreeMap;

use reports::row::{ErrorKind, Reference, ReferenceKind};

use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::cases::pair_distance::poses::Random;
use crate::claim::Claim;
use crate::exact::periodic_array::{FrictionFactor, Lattice, friction_factor};
use crate::exact::richardson::extrapolate;
use crate::variant::Variant as _;
use methods::{Found, Method, Problem};

/// The case.
pub struct ZickHomsy;

const FRICTION: &str = "friction factor";
const LEVEL: &str = "excess of the friction factor over the exact one";
const EXTRAPOLATED: &str = "friction factor on no grid";
const UNCERTAINTY: &str = "uncertainty of the extrapolation";
const DIVERGENCE: &str = "largest divergence x spacing / mean velocity";
const RESIDUAL: &str = "residual of the conditions";
const FULL_RESIDUAL: &str = "slip at the surface / mean velocity, root mean square";
const INVERTED_CELLS: &str = "cells x inverted operators of a flow";
const AT_ONCE: &str = "friction factor / that of the same points solved at once";
const COST_RATIO: &str = "inverted cells of the default / of the marched points, at their error";

/// The slice picture, beside the rows.
const SLICE: &str = "slice.csv";

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Variant {
    measure: Measure,
    method: Method,
    lattice: Lattice,
    fraction: f64,
}

/// What is found of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Measure {
    /// Flows on one grid.
    Flow,
    /// The limit of a sequence of grids.
    Limit,
    /// The cost of the default where it is as good as the marched points.
    Cost,
}

/// Solid fractions of the table, the last one of spheres that touch.
const FRACTIONS: [f64; 9] = [0.001, 0.008, 0.027, 0.064, 0.125, 0.216, 0.343, 0.45, TOUCHING];
#[expect(clippy::approx_constant, reason = "as the table writes it, which is searched for it")]
const TOUCHING: f64 = 0.523_598_8;
/// Lattices of several spheres a cell.
const CENTRED: [Lattice; 2] = [Lattice::BodyCentred, Lattice::FaceCentred];
/// Solid fraction at which methods are compared.
const COMPARED: f64 = 0.125;
/// Cells a diameter of runs that are marched.
const MARCHED_CELLS: f64 = 8.0;
/// Steps a diffusion time of the marched run whose cost is compared: R's.
const COMPARED_STEPS: f64 = 100.0;
/// The sequence of grids of a limit, as shares of the finest.
const SEQUENCE: [f64; 4] = [0.375, 0.5, 0.75, 1.0];

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        let simple = |measure, method, fraction| Variant { measure, method, lattice: Lattice::SimpleCubic, fraction };
        let centred = |measure, fraction| CENTRED.map(|lattice| Variant { measure, method: Method::SHARP, lattice, fraction });
        // From dense to dilute: the most dilute one costs too much for a quick look, and cases begin with what is looked at.
        let mut all: Vec<Variant> = FRACTIONS.iter().rev().map(|fraction| simple(Measure::Flow, Method::SHARP, *fraction)).collect();
        all.extend(Method::RIVALS.map(|method| simple(Measure::Flow, method, COMPARED)));
        all.push(simple(Measure::Cost, Method::MARCHED, COMPARED));
        all.extend([0.125, 0.216, 0.343].map(|fraction| simple(Measure::Limit, Method::SHARP, fraction)));
        all.extend([0.008, 0.027, 0.216, 0.45].iter().flat_map(|fraction| centred(Measure::Flow, *fraction)));
        all.extend([0.027, 0.216].iter().flat_map(|fraction| centred(Measure::Limit, *fraction)));
        all
    }

    fn label(&self) -> String {
        let (name, lattice) = (self.method.name(), self.lattice.name());
        let place = format!("{lattice}, solid fraction {}", self.fraction);
        match self.measure {
            Measure::Flow => format!("{name}, {place}"),
            Measure::Limit => format!("{name}, extrapolated, {place}"),
            Measure::Cost => format!("cost of the default against {name}, {place}"),
        }
    }

    fn knob_name(&self) -> &'static str {
        if self.measure == Measure::Flow && self.method.is_marched() { "steps_a_diffusion_time" } else { "cells_a_diameter" }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let of = |quick: &[f64], longer: &[f64]| if tier == Tier::Quick { quick.to_vec() } else { longer.to_vec() };
        match (self.measure, self.method) {
            // Gaps of centred lattices are narrower.
            (Measure::Limit, _) if self.lattice != Lattice::SimpleCubic && self.fraction > 0.1 => of(&[], &[60.0]),
            (Measure::Limit, _) => of(&[], &[40.0]),
            (Measure::Cost, _) => of(&[10.0], &[10.0, 20.0]),
            (_, Method::Marched { .. }) => of(&[100.0], &[100.0, 300.0, 1000.0, 3000.0]),
            // Spheres that fill little of their cell cost many cells.
            (_, Method::SHARP) if self.fraction < 0.005 => of(&[5.0], &[5.0, 8.0, 10.0, 15.0]),
            // Four spheres a cell at these fractions cost the quick tier more than it has.
            (_, Method::SHARP) if self.lattice == Lattice::FaceCentred && self.fraction == 0.216 => of(&[], &[16.0, 20.0, 30.0, 40.0]),
            (_, Method::SHARP) if self.lattice == Lattice::FaceCentred && self.fraction == 0.008 => of(&[], &[6.0, 8.0, 10.0]),
            (_, Method::SHARP) if self.lattice != Lattice::SimpleCubic && self.fraction > 0.4 => of(&[10.0], &[10.0, 15.0, 30.0]),
            (_, Method::SHARP) if self.lattice != Lattice::SimpleCubic && self.fraction > 0.1 => of(&[16.0], &[16.0, 20.0, 30.0, 40.0]),
            (_, Method::SHARP) if self.lattice != Lattice::SimpleCubic => of(&[6.0], &[6.0, 8.0, 10.0, 15.0, 20.0]),
            (_, Method::SHARP) if self.fraction < 0.01 => of(&[6.0], &[6.0, 8.0, 10.0, 15.0]),
            (_, Method::SHARP) if self.fraction < 0.1 => of(&[8.0], &[8.0, 10.0, 15.0, 20.0]),
            (_, Method::SHARP) if self.fraction == 0.216 => of(&[10.0, 15.0, 20.0, 30.0], &[10.0, 15.0, 20.0, 30.0, 40.0]),
            (_, Method::SHARP) if self.fraction > 0.3 => of(&[10.0, 15.0], &[10.0, 15.0, 20.0, 30.0, 40.0]),
            (_, Method::SHARP) => of(&[10.0, 15.0, 20.0], &[10.0, 15.0, 20.0, 30.0, 40.0]),
            (_, Method::SOURCE) => of(&[10.0, 12.4, 15.0], &[10.0, 12.4, 15.0, 20.0, 30.0, 40.0]),
            _ => of(&[10.0], &[10.0, 12.4, 15.0, 20.0, 30.0]),
        }
    }
}

impl Variant {
    fn problem(&self, cells: f64) -> Problem {
        let Variant { method, lattice, fraction, .. } = *self;
        Problem { method, lattice, fraction, cells, steps_a_diffusion_time: f64::NAN }
    }

    /// What the friction factor should be, and where that comes from.
    fn reference(&self) -> Result<(FrictionFactor, Reference), Failure> {
        let of = |kind, value: FrictionFactor, source: &str| {
            Ok((value, Reference { kind, uncertainty: value.uncertainty, source: source.into() }))
        };
        match friction_factor(self.lattice, self.fraction) {
            Some(value) => of(ReferenceKind::Computed, value, "fundamental solutions with periodic Stokeslets (reference-data/zick_homsy)"),
            None => Err(Failure::NothingMeasured(format!("no reference at the solid fraction {}", self.fraction))),
        }
    }

    fn friction(&self, name: &'static str, samples: Vec<f64>) -> Result<Quantity, Failure> {
        let (expected, reference) = self.reference()?;
        let floor = expected.uncertainty / expected.value;
        Ok(Quantity { name, unit: "1", samples, expected: expected.value, reference, error_kind: ErrorKind::Relative, floor })
    }

    /// Flows with the spheres at random places between the values of the grid.
    fn flows(&self, knob: f64, random: &mut Random) -> Result<Measurement, Failure> {
        let is_marched = self.method.is_marched();
        let cells = if is_marched { MARCHED_CELLS } else { knob };
        let problem = Problem { steps_a_diffusion_time: knob, ..self.problem(cells) };
        let places: Vec<[f64; 3]> = (0..if is_marched { 1 } else { number_of_places(&problem) }).map(|_| place(random)).collect();
        let found = places.iter().map(|place| problem.solve(*place)).collect::<Result<Vec<Found>, Failure>>()?;
        let all = |value: fn(&Found) -> f64| found.iter().map(value).collect::<Vec<f64>>();
        let sum = |count: fn(&Found) -> usize| found.iter().map(count).sum::<usize>() as u64;
        let mut quantities = vec![
            self.friction(FRICTION, all(|found| found.friction))?,
            Quantity::nothing(DIVERGENCE, all(|found| found.divergence), 1e-14, 0.0),
            Quantity::nothing(RESIDUAL, all(|found| found.residual), 1e-14, 0.0),
            Quantity::nothing(FULL_RESIDUAL, all(|found| found.full_residual), 1e-9, 0.0),
            Quantity::nothing(INVERTED_CELLS, all(|found| found.inverted_cells), 1.0, 0.0),
        ];
        if is_marched {
            let at_once = Problem { method: Method::SOURCE, ..problem }.solve(places[0])?.friction;
            quantities.push(own(AT_ONCE, found[0].friction / at_once, 1.0, "the same points solved at once"));
        }
        if let Some(level) = claims::source_level(self, knob) {
            let exact = self.reference()?.0.value;
            let excess = all(|found| found.friction).into_iter().map(|friction| friction / exact - 1.0).collect();
            quantities.push(Quantity {
                name: LEVEL,
                unit: "1",
                samples: excess,
                expected: level,
                reference: Reference {
                    kind: ReferenceKind::Code,
                    uncertainty: 5e-4,
                    source: "a program of another hand and language, same rules".into(),
                },
                error_kind: ErrorKind::Absolute,
                floor: 5e-4,
            });
        }
        let is_seen = self.method == Method::SHARP && self.fraction == 0.216 && knob == 15.0;
        let slice = if is_seen { Some(problem.slice(places[0])?) } else { None };
        Ok(Measurement {
            quantities,
            work: BTreeMap::from([
                ("flows or steps".to_string(), sum(|found| found.flows)),
                ("conditions".to_string(), sum(|found| found.conditions)),
                ("conditions by straight lines".to_string(), sum(|found| found.fallbacks.linear)),
                ("conditions asked of ghosts themselves".to_string(), sum(|found| found.fallbacks.direct)),
            ]),
            runs: found.len() as u64,
            curves: slice.into_iter().map(slice_curve).collect(),
        })
    }

    /// The limit of a sequence of grids; coarse ones are the mean of several places.
    fn limit(&self, finest: f64, random: &mut Random) -> Result<Measurement, Failure> {
        let on_grid = |share: f64| {
            let problem = self.problem(finest * share);
            let found = (0..number_of_places(&problem)).map(|_| problem.solve(place(random))).collect::<Result<Vec<Found>, Failure>>()?;
            Ok([1.0 / found[0].cells, found.iter().map(|found| found.friction).sum::<f64>() / found.len() as f64])
        };
        let sequence = SEQUENCE.into_iter().map(on_grid).collect::<Result<Vec<[f64; 2]>, Failure>>()?;
        let limit = extrapolate(&sequence).ok_or_else(|| Failure::NothingMeasured("too few grids".into()))?;
        let quantities = vec![
            self.friction(EXTRAPOLATED, vec![limit.value])?,
            Quantity::nothing(UNCERTAINTY, vec![limit.uncertainty / limit.value], f64::EPSILON, 0.0),
        ];
        Ok(Measurement { quantities, runs: 1, ..Measurement::default() })
    }

    /// The coarsest grid on which the default is as good, at its worst place, as the marched points are on a grid.
    fn cost(&self, knob: f64, random: &mut Random) -> Result<Measurement, Failure> {
        let exact = self.reference()?.0.value;
        let error = |found: &Found| (found.friction / exact - 1.0).abs();
        let marched = Problem { steps_a_diffusion_time: COMPARED_STEPS, ..self.problem(knob) }.solve(place(random))?;
        for cells in 4..=knob as usize {
            let problem = Problem { method: Method::SHARP, ..self.problem(cells as f64) };
            let found = (0..5).map(|_| problem.solve(place(random))).collect::<Result<Vec<Found>, Failure>>()?;
            if found.iter().all(|found| error(found) <= error(&marched)) {
                let ratio = found.iter().map(|found| found.inverted_cells / marched.inverted_cells).fold(0.0, f64::max);
                return Ok(Measurement {
                    quantities: vec![Quantity::nothing(COST_RATIO, vec![ratio], f64::EPSILON, 0.0)],
                    runs: 1,
                    ..Measurement::default()
                });
            }
        }
        Err(Failure::NothingMeasured("the default is not as good on the same grid".into()))
    }
}

/// Random places of the spheres between values of the grid: more on coarse grids, where those of the sharp constraint scatter more and cost less.
fn number_of_places(problem: &Problem) -> usize {
    match problem.edge() {
        _ if matches!(problem.method, Method::Points { .. }) => 3,
        ..=16 => 9,
        17..=24 => 5,
        _ => 3,
    }
}

/// A move of the spheres by up to half a spacing.
fn place(random: &mut Random) -> [f64; 3] {
    [(); 3].map(|()| random.number() - 0.5)
}

fn own(name: &'static str, sample: f64, expected: f64, source: &str) -> Quantity {
    let reference = Reference { kind: ReferenceKind::Computed, uncertainty: methods::TOLERANCE, source: source.into() };
    Quantity { name, unit: "1", samples: vec![sample], expected, reference, error_kind: ErrorKind::Absolute, floor: methods::TOLERANCE }
}

fn slice_curve(seen: Vec<methods::Seen>) -> Curve {
    Curve { file: SLICE.into(), columns: vec!["time", "across", "height", "speed"], rows: seen.into_iter().map(Vec::from).collect() }
}

impl Case for ZickHomsy {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let variant = Variant::of(setup)?;
        let mut random = Random::new(random_seed);
        match variant.measure {
            Measure::Flow => variant.flows(knob, &mut random),
            Measure::Limit => variant.limit(knob, &mut random),
            Measure::Cost => variant.cost(knob, &mut random),
        }
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        claims::all(tier)
    }

    fn description(&self) -> Description {
        page::description()
    }
}
