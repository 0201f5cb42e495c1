//! Creeping flow through arrays of cylinders and lobed prisms (R section 7.4.2): friction factors by shape, their order on grids, and how shapes rank.

mod claims;
mod fine;
mod flows;
mod page;

use std::collections::BTreeMap;

use reports::row::{ErrorKind, Reference, ReferenceKind};

use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::cases::pair_distance::poses::Random;
use crate::claim::Claim;
use crate::exact::cylinder_array;
use crate::exact::richardson::extrapolate;
use crate::variant::Variant as _;
use flows::{Course, Family, Found, Method, Problem, Shape};

/// The case.
pub struct LobedArray;

const DRAG: &str = "drag of a length / (viscosity x mean velocity)";
const FRICTION: &str = "friction factor";
const EXTRAPOLATED: &str = "friction factor on no grid";
const UNCERTAINTY: &str = "uncertainty of the extrapolation";
const DIVERGENCE: &str = "largest divergence x spacing / mean velocity";
const RESIDUAL: &str = "residual of the conditions";
const IMBALANCE: &str = "drag and mean pressure gradient, their sum over the drag";
const ASYMMETRY: &str = "asymmetry of the resistance / its size";
const NEGATIVE: &str = "directions without resistance";
const MISRANKED: &str = "pairs of shapes that do not rank as R tells";

/// The slice picture, beside the rows.
const SLICE: &str = "slice.csv";

/// Solid fraction at which finite bodies are compared.
const COMPARED: f64 = 0.216;
/// Solid fractions of endless cylinders.
const ENDLESS: [f64; 2] = [0.125, 0.3];
/// Solid fractions of the ranking, as in R figure 7.11, to the densest of figures 7.9 and 7.10.
const RANKED: [f64; 4] = [0.1, 0.216, 0.34, 0.545];
/// The sequence of grids of a limit, as shares of the finest.
const SEQUENCE: [f64; 4] = [1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0];

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Variant {
    measure: Measure,
    shape: Shape,
    family: Family,
    course: Course,
    method: Method,
    fraction: f64,
}

/// What is found of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Measure {
    /// Flows on one grid.
    Flow,
    /// The limit of a sequence of grids.
    Limit,
    /// Drag in flows along three directions.
    Resistance,
    /// All shapes at all solid fractions.
    Ranking,
}

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        let of = |measure, shape, family, course, method, fraction| Variant { measure, shape, family, course, method, fraction };
        let mut all = Vec::new();
        for course in [Course::Across, Course::Along] {
            let endless = |method, fraction| of(Measure::Flow, Shape::Cylinder, Family::Endless, course, method, fraction);
            all.extend(ENDLESS.map(|fraction| endless(Method::Sharp, fraction)));
            all.push(endless(Method::Points, ENDLESS[0]));
        }
        let compared = |measure, shape, family, course, method| of(measure, shape, family, course, method, COMPARED);
        for course in [Course::Along, Course::Across, Course::Turned] {
            all.extend(Shape::ALL.map(|shape| compared(Measure::Flow, shape, Family::Short, course, Method::Sharp)));
        }
        all.extend(Shape::ALL.map(|shape| compared(Measure::Flow, shape, Family::Short, Course::Along, Method::Points)));
        for course in [Course::Along, Course::Across] {
            all.extend(Shape::ALL.map(|shape| compared(Measure::Flow, shape, Family::Long, course, Method::Sharp)));
        }
        for method in [Method::Sharp, Method::Points] {
            all.extend(Shape::ALL.map(|shape| compared(Measure::Limit, shape, Family::Short, Course::Along, method)));
        }
        let lobes = [Shape::Trilobe, Shape::Quadralobe];
        all.extend(lobes.map(|shape| compared(Measure::Resistance, shape, Family::Short, Course::Turned, Method::Sharp)));
        let ranking = |course| of(Measure::Ranking, Shape::Cylinder, Family::Compared, course, Method::Sharp, f64::NAN);
        all.extend([Course::Along, Course::Across].map(ranking));
        all
    }

    fn label(&self) -> String {
        let (family, course, method) = (self.family.name(), self.course.name(), self.method.name());
        if self.measure == Measure::Ranking {
            return format!("all shapes, {family}, flow {course}, {method}");
        }
        let place = format!("{}, {family}, flow {course}, {} % solid, {method}", self.shape.name(), 100.0 * self.fraction);
        match self.measure {
            Measure::Limit => format!("extrapolated: {place}"),
            Measure::Resistance => {
                format!("resistance: {}, {family}, turned 20/20/20, {} % solid", self.shape.name(), 100.0 * self.fraction)
            }
            _ => place,
        }
    }

    fn knob_name(&self) -> &'static str {
        "cells_an_edge"
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let of = |quick: &[f64], longer: &[f64]| if tier == Tier::Quick { quick.to_vec() } else { longer.to_vec() };
        match (self.measure, self.family, self.method) {
            (Measure::Flow, Family::Endless, _) => of(&[16.0, 24.0, 36.0], &[16.0, 24.0, 36.0, 54.0, 80.0, 120.0]),
            (Measure::Flow, Family::Long, _) if self.shape == Shape::Cylinder => of(&[], &[16.0, 20.0, 24.0, 32.0]),
            (Measure::Flow, Family::Long, _) => of(&[12.0], &[16.0, 20.0, 24.0, 32.0]),
            (Measure::Flow, _, Method::Points) => of(&[16.0], &[16.0, 20.0, 24.0, 32.0, 40.0]),
            (Measure::Flow, _, _) if self.shape == Shape::Trilobe && self.course == Course::Across => {
                of(&[16.0, 24.0], &[16.0, 20.0, 24.0, 32.0, 40.0, 54.0])
            }
            (Measure::Flow, _, _) => of(&[16.0], &[16.0, 20.0, 24.0, 32.0, 40.0, 54.0]),
            (Measure::Limit, ..) => of(&[], &[48.0]),
            (Measure::Resistance, ..) => of(&[16.0], &[16.0, 24.0, 32.0]),
            (Measure::Ranking, ..) => of(&[], &[24.0, 32.0]),
        }
    }
}

impl Variant {
    fn problem(&self, edge: f64) -> Problem {
        let Variant { shape, family, course, fraction, method, .. } = *self;
        Problem { shape, family, course, fraction, method, edge: edge.round() as usize }
    }

    /// The measured drag, held against what it should be.
    fn drag(&self, name: &'static str, samples: Vec<f64>) -> Result<Quantity, Failure> {
        let (expected, uncertainty, kind, source) = match (self.family, self.course) {
            (Family::Endless, course) => {
                let drag = if course == Course::Along { cylinder_array::along } else { cylinder_array::across };
                let drag = drag(self.fraction);
                (drag.value, drag.uncertainty, ReferenceKind::Computed, "harmonics of a square array of endless cylinders")
            }
            _ => {
                let fine = fine::friction(self.shape, self.family, self.course);
                let [value, uncertainty] = fine.ok_or_else(|| Failure::NothingMeasured(format!("no fine grid for {}", self.label())))?;
                (value, uncertainty, ReferenceKind::OwnFine, "more own grids, extrapolated with order 1.2")
            }
        };
        let reference = Reference { kind, uncertainty, source: source.into() };
        Ok(Quantity { name, unit: "1", samples, expected, reference, error_kind: ErrorKind::Relative, floor: uncertainty / expected })
    }

    fn quantity_name(&self) -> &'static str {
        if self.family == Family::Endless { DRAG } else { FRICTION }
    }

    /// Flows with the body at random places between the values of the grid.
    fn flows(&self, knob: f64, random: &mut Random) -> Result<Measurement, Failure> {
        let problem = self.problem(knob);
        let places: Vec<[f64; 3]> = (0..PLACES).map(|_| place(random)).collect();
        let found = places.iter().map(|place| problem.solve(*place)).collect::<Result<Vec<Found>, Failure>>()?;
        let all = |value: fn(&Found) -> f64| found.iter().map(value).collect::<Vec<f64>>();
        let sum = |count: fn(&Found) -> usize| found.iter().map(count).sum::<usize>() as u64;
        let along = self.course.direction();
        let quantities = vec![
            self.drag(self.quantity_name(), found.iter().map(|found| found.drag.dot(&along)).collect())?,
            Quantity::nothing(DIVERGENCE, all(|found| found.divergence), 1e-14, 0.0),
            Quantity::nothing(RESIDUAL, all(|found| found.residual), 1e-14, 0.0),
            Quantity::nothing(IMBALANCE, all(|found| found.imbalance), 1e-14, 0.0),
        ];
        let slice = if self.is_seen(knob) { Some(problem.slice(places[0])?) } else { None };
        Ok(Measurement {
            quantities,
            work: BTreeMap::from([
                ("flows".to_string(), sum(|found| found.flows)),
                ("cells x inverted operators".to_string(), found.iter().map(|found| found.inverted_cells as u64).sum()),
                ("conditions".to_string(), sum(|found| found.conditions)),
                ("conditions by straight lines".to_string(), sum(|found| found.fallbacks.linear)),
                ("conditions asked of ghosts themselves".to_string(), sum(|found| found.fallbacks.direct)),
            ]),
            runs: found.len() as u64,
            curves: slice.into_iter().map(slice_curve).collect(),
        })
    }

    /// Whether its flow is the one that the page shows.
    fn is_seen(&self, knob: f64) -> bool {
        (self.shape, self.family, self.course, knob) == (Shape::Trilobe, Family::Short, Course::Across, 24.0)
    }

    /// The limit of a sequence of grids, each the mean of several places.
    fn limit(&self, finest: f64, random: &mut Random) -> Result<Measurement, Failure> {
        let along = self.course.direction();
        let on_grid = |share: f64| {
            let problem = self.problem(finest * share);
            // Edges make places scatter: finer grids need as many as coarse ones, but pay for them.
            let places = if problem.edge > 32 { 4 } else { 9 };
            let drags = (0..places).map(|_| problem.solve(place(random)).map(|found| found.drag.dot(&along)));
            let drags = drags.collect::<Result<Vec<f64>, Failure>>()?;
            Ok([1.0 / problem.cells(), drags.iter().sum::<f64>() / drags.len() as f64])
        };
        let sequence = SEQUENCE.into_iter().map(on_grid).collect::<Result<Vec<[f64; 2]>, Failure>>()?;
        let limit = extrapolate(&sequence).ok_or_else(|| Failure::NothingMeasured("too few grids".into()))?;
        let quantities = vec![
            self.drag(EXTRAPOLATED, vec![limit.value])?,
            Quantity::nothing(UNCERTAINTY, vec![limit.uncertainty / limit.value], 1e-9, 0.0),
        ];
        Ok(Measurement { quantities, runs: 1, ..Measurement::default() })
    }

    /// The resistance of a turned body, which must be symmetric and positive (Lorentz 1896).
    fn resistance(&self, knob: f64, random: &mut Random) -> Result<Measurement, Failure> {
        let resistance = self.problem(knob).resistance(place(random))?;
        let symmetric = 0.5 * (resistance + resistance.transpose());
        let asymmetry = (resistance - resistance.transpose()).norm() / resistance.norm();
        let negative = symmetric.symmetric_eigenvalues().iter().filter(|value| **value <= 0.0 || value.is_nan()).count();
        let quantities =
            vec![Quantity::nothing(ASYMMETRY, vec![asymmetry], 1e-6, 0.0), Quantity::nothing(NEGATIVE, vec![negative as f64], 0.0, 0.0)];
        Ok(Measurement { quantities, runs: 1, ..Measurement::default() })
    }

    /// Friction factors of all shapes over the solid fraction, means of a few places, and how often they rank otherwise than R tells.
    fn ranking(&self, knob: f64, random: &mut Random) -> Result<Measurement, Failure> {
        let places: Vec<[f64; 3]> = (0..PLACES).map(|_| place(random)).collect();
        let mut rows = Vec::new();
        for fraction in RANKED {
            let mut row = vec![fraction];
            for shape in Shape::ALL {
                let problem = Variant { shape, fraction, ..*self }.problem(knob);
                let drags = places.iter().map(|place| problem.solve(*place).map(|found| found.drag.dot(&self.course.direction())));
                row.push(drags.collect::<Result<Vec<f64>, Failure>>()?.iter().sum::<f64>() / places.len() as f64);
            }
            rows.push(row);
        }
        let misranked = rows.iter().map(|row| self.misranked(row)).sum::<usize>();
        // The finest grid of a tier is drawn.
        let is_drawn = [Tier::Quick, Tier::Standard].iter().any(|tier| self.knobs(*tier).last() == Some(&knob));
        let curve = Curve { file: curve_file(self.course), columns: vec!["fraction", "cylinder", "trilobe", "quadralobe"], rows };
        let quantities = vec![Quantity::nothing(MISRANKED, vec![misranked as f64], 0.0, 0.0)];
        Ok(Measurement { quantities, runs: 1, curves: is_drawn.then_some(curve).into_iter().collect(), ..Measurement::default() })
    }

    /// Pairs out of R's order in a row of solid fraction and friction factors of cylinder, trilobe and quadralobe.
    ///
    /// Along the axis R has cylinder < trilobe < quadralobe; across it, where solids are dense, quadralobe < cylinder < trilobe, and no difference below 0.34.
    /// Where solids are dense cylinder and trilobe along the axis differ by less than the grids of a tier can tell.
    fn misranked(&self, row: &[f64]) -> usize {
        let [fraction, cylinder, trilobe, quadralobe] = *row else { return 0 };
        let ordered: &[f64] = match self.course {
            Course::Along if fraction < 0.4 => &[cylinder, trilobe, quadralobe],
            Course::Along => &[cylinder.max(trilobe), quadralobe],
            _ if fraction > 0.5 => &[quadralobe, cylinder, trilobe],
            _ => return 0,
        };
        // What is not a number ranks nowhere.
        ordered.windows(2).filter(|pair| pair[0].partial_cmp(&pair[1]) != Some(std::cmp::Ordering::Less)).count()
    }
}

/// Friction factors over the solid fraction, beside the rows.
fn curve_file(course: Course) -> String {
    format!("friction_{}.csv", course.name())
}

/// Random places of the body between values of the grid.
const PLACES: usize = 3;

/// A move of the body by up to half a spacing.
fn place(random: &mut Random) -> [f64; 3] {
    [(); 3].map(|()| random.number() - 0.5)
}

fn slice_curve(seen: Vec<flows::Seen>) -> Curve {
    Curve { file: SLICE.into(), columns: vec!["time", "across", "height", "speed"], rows: seen.into_iter().map(Vec::from).collect() }
}

impl Case for LobedArray {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let variant = Variant::of(setup)?;
        let mut random = Random::new(random_seed);
        match variant.measure {
            Measure::Flow => variant.flows(knob, &mut random),
            Measure::Limit => variant.limit(knob, &mut random),
            Measure::Resistance => variant.resistance(knob, &mut random),
            Measure::Ranking => variant.ranking(knob, &mut random),
        }
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        claims::all(tier)
    }

    fn description(&self) -> Description {
        page::description()
    }
}
