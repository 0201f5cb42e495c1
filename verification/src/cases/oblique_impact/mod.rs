//! A sphere meets a wall or another sphere obliquely: do slip, spin and rebound come out as the friction law says?

mod chung_ooi;
mod figures;
mod setting;
mod words;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::Scene;
use solver::contact::law::hertz::Elasticity;

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::oblique_impact::Velocities;
use crate::study::add_work;
use setting::{Laws, Scheme, Setting};

/// The case.
pub struct ObliqueImpactCase;

pub(super) const TANGENTIAL: &str = "tangential velocity after";
pub(super) const SPIN: &str = "spin after x radius";
pub(super) const REBOUND: &str = "rebound velocity";
pub(super) const DEVIATION: &str = "largest deviation of velocities, by the impact speed";
const SAMPLES: usize = 200;
/// Steps in a contact of the figures.
const FINE: f64 = 200.0;
/// Low-discrepancy steps in two dimensions: start phase, and part of a step by which the contact is longer than a whole number.
const STRIDES: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

const STIFFNESS: f64 = 1e5;
/// Not 2/7 of the normal one: with the same period across and along the normal a point that sticks lets go in the very last moment, where chance decides.
const TANGENTIAL_STIFFNESS: f64 = 0.5 * STIFFNESS;
const SPRING: Laws = Laws::Spring { stiffness: STIFFNESS, tangential: TANGENTIAL_STIFFNESS };
const GUESSED: Laws = Laws::Guessed { stiffness: STIFFNESS, tangential: TANGENTIAL_STIFFNESS };
/// Soft, so that turn and arms of the contact matter as with the linear springs.
const RUBBER: Laws = Laws::Elastic(Elasticity { young_modulus: 2e7, poisson_ratio: 0.4 });

/// One setup: an impact and what it is held against.
#[derive(Debug, Clone)]
struct Variant {
    label: String,
    setting: Setting,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// Against the exact solution of its own laws.
    Own,
    /// Against the exact solution with a spring that remembers.
    Model,
    /// A test of Chung and Ooi, by number.
    ChungOoi(usize),
    /// Sweeps of the angle.
    Figures,
}

fn at(tangential: f64, spin: f64) -> Velocities {
    Velocities { approach: 1.0, tangential, spin_of_first: spin, spin_of_second: 0.0 }
}

/// A sphere of 5 mm radius at a wall.
fn wall(laws: Laws, tangential: f64) -> Setting {
    Setting {
        laws,
        scheme: Scheme::Resolved,
        radii: [Some(0.005), None],
        density: 2500.0,
        restitution: 0.9,
        friction: 0.3,
        before: at(tangential, 0.0),
    }
}

fn variants() -> Vec<Variant> {
    let of = |label: &str, setting: Setting, kind: Kind| Variant { label: label.into(), setting, kind };
    let spinning = |laws| Setting { before: at(0.0, 200.0), ..wall(laws, 0.0) };
    let pair = |laws| Setting {
        radii: [Some(0.005), Some(0.003)],
        before: Velocities { approach: 1.0, tangential: 0.8, spin_of_first: 40.0, spin_of_second: -90.0 },
        ..wall(laws, 0.0)
    };
    let elastic = |setting: Setting| Setting { restitution: 1.0, ..setting };
    let lagged = |setting: Setting| Setting { scheme: Scheme::Lagged, ..setting };
    let mut variants = vec![
        of("spring, 17 degrees: sticks", elastic(wall(SPRING, 0.3)), Kind::Own),
        of("spring, 45 degrees: slips, sticks, slips", elastic(wall(SPRING, 1.0)), Kind::Own),
        of("spring, 72 degrees: slides", elastic(wall(SPRING, 3.0)), Kind::Own),
        of("spring, spin before", elastic(spinning(SPRING)), Kind::Own),
        of("spring, two spheres with spin", elastic(pair(SPRING)), Kind::Own),
        of("spring, 45 degrees, e=0.9", wall(SPRING, 1.0), Kind::Own),
        of("spring, 45 degrees, lagged damping, sampled edges", lagged(wall(SPRING, 1.0)), Kind::Own),
        of("guessed spring, 17 degrees, own solution", wall(GUESSED, 0.3), Kind::Own),
        of("guessed spring, 45 degrees, own solution", wall(GUESSED, 1.0), Kind::Own),
        of("guessed spring, 17 degrees, for a spring", wall(GUESSED, 0.3), Kind::Model),
        of("guessed spring, 45 degrees, for a spring", wall(GUESSED, 1.0), Kind::Model),
        of("Hertz-Mindlin, 17 degrees: sticks", elastic(wall(RUBBER, 0.3)), Kind::Own),
        of("Hertz-Mindlin, 45 degrees: slips, then sticks", elastic(wall(RUBBER, 1.0)), Kind::Own),
        of("Hertz-Mindlin, 72 degrees: slides", elastic(wall(RUBBER, 3.0)), Kind::Own),
        of("Hertz-Mindlin, spin before", elastic(spinning(RUBBER)), Kind::Own),
        of("Hertz-Mindlin, two spheres with spin", elastic(pair(RUBBER)), Kind::Own),
        of("Hertz-Mindlin, 45 degrees, e=0.9", wall(RUBBER, 1.0), Kind::Own),
        of("Hertz-Mindlin, 45 degrees, lagged damping, sampled edges", lagged(wall(RUBBER, 1.0)), Kind::Own),
    ];
    variants.extend((1..=8).map(|test| of(&format!("Chung and Ooi, test {test}"), chung_ooi::first_impact(test), Kind::ChungOoi(test))));
    variants.push(of("all angles", wall(SPRING, 1.0), Kind::Figures));
    variants
}

impl Variant {
    fn knobs(&self) -> Vec<f64> {
        match self.kind {
            Kind::Own | Kind::Model => vec![10.0, 20.0, 50.0, 100.0, 200.0, 400.0],
            Kind::ChungOoi(_) => vec![100.0, 1000.0, 4000.0],
            Kind::Figures => vec![FINE],
        }
    }

    /// The impact that it is held against.
    fn truth(&self) -> Setting {
        if self.kind == Kind::Model { Setting { laws: SPRING, ..self.setting } } else { self.setting }
    }

    /// The first term of the error of leapfrog, and what it is.
    fn design_error(&self, quantity: &'static str, steps: f64) -> (f64, &'static str) {
        let [velocity, spin] = self.setting.design_errors_across(steps);
        let across = "(angle in a step)^2 / 24 of the angle of a contact, times its share of the slip that friction takes";
        match quantity {
            REBOUND => (
                self.setting.design_error_of_rebound(steps),
                "(angle in a step)^2 / 24 of the angle of a contact, times the approach velocity and what dashpot, turn and edges feel of it",
            ),
            SPIN => (spin, across),
            _ => (velocity, across),
        }
    }

    /// Steps of a sample, spread over one about the nominal number, and the phase at which its contact begins.
    fn steps_and_phase(knob: f64, sample: usize, random_seed: u64) -> (f64, f64) {
        let spread = |dimension: usize| {
            let shift = (random_seed as f64 * STRIDES[1 - dimension]).fract();
            (shift + (sample + 1) as f64 * STRIDES[dimension]).fract()
        };
        (knob + spread(1) - 0.5, spread(0))
    }

    fn evaluate(&self, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let exact = self.setting.exact().after(&self.setting.before);
        let truth = self.truth().exact().after(&self.setting.before).after;
        let mut measurement = Measurement { runs: SAMPLES as u64, ..Measurement::default() };
        let mut samples = [Vec::new(), Vec::new(), Vec::new()];
        let radius = self.setting.radius();
        for sample in 0..SAMPLES {
            let (steps, phase) = Variant::steps_and_phase(knob, sample, random_seed);
            let run = self.setting.run(&exact, steps, phase)?;
            samples[0].push(run.after.tangential);
            samples[1].push(run.after.spin_of_first * radius);
            samples[2].push(-run.after.approach);
            add_work(&mut measurement.work, run.work);
        }
        // An overlap is the difference of lengths of the size of the radius, known to their rounding at each step.
        let floor = 16.0 * f64::EPSILON * radius / exact.duration * knob.sqrt() + 1e-12 * self.setting.speed();
        let source = "ordinary differential equation of the coded laws, extrapolated to 1e-12 with its events";
        let reference = Reference { kind: ReferenceKind::Computed, uncertainty: 1e-12, source: source.into() };
        let expected = [truth.tangential, truth.spin_of_first * radius, -truth.approach];
        measurement.quantities = [TANGENTIAL, SPIN, REBOUND]
            .into_iter()
            .zip(samples)
            .zip(expected)
            .map(|((name, samples), expected)| Quantity {
                name,
                unit: "m/s",
                samples,
                expected,
                reference: reference.clone(),
                error_kind: ErrorKind::Absolute,
                floor,
            })
            .collect();
        Ok(measurement)
    }

    fn claims(&self) -> Vec<Claim> {
        let order_bound = |factor| Bound::new(factor, 1.0 / 20.0, "the next term of the error at 20 steps, the coarsest of the fit");
        let claim = |quantity, statistic, subject, bound, expected| Claim {
            setup: self.label.clone(),
            quantity,
            statistic,
            subject,
            bound,
            expected,
        };
        let range = [20.0, 400.0];
        let error = |quantity, statistic, factor, expected| {
            let (floor, floor_is) = self.design_error(quantity, 50.0);
            let bound = Bound::new(factor, floor, floor_is);
            claim(quantity, statistic, Subject::ErrorAt(50.0), bound, expected)
        };
        match (self.kind, self.setting.scheme) {
            (Kind::Own, Scheme::Resolved) => [TANGENTIAL, SPIN, REBOUND]
                .into_iter()
                .flat_map(|quantity| {
                    // A dashpot under a cap that jumps at the first touch has a kink there, which lies within a step.
                    let is_guessed = matches!(self.setting.laws, Laws::Guessed { .. });
                    let order = if is_guessed && quantity != REBOUND { 1.0 } else { 2.0 };
                    let subject = Subject::OrderAtLeast { order, range };
                    [
                        claim(quantity, Statistic::Median, subject, order_bound(10.0), Expected::Holds),
                        error(quantity, Statistic::Median, 1.0, Expected::Holds),
                        error(quantity, Statistic::Worst, 3.0, Expected::Holds),
                    ]
                })
                .collect(),
            (Kind::Own, Scheme::Lagged) => {
                // A sampled dashpot that jumps at the edges costs an order; one that rises as the fourth root of time, three quarters of one.
                let order = if matches!(self.setting.laws, Laws::Elastic(_)) { 1.25 } else { 1.0 };
                vec![claim(REBOUND, Statistic::Median, Subject::OrderAbout { order, range }, order_bound(4.0), Expected::Holds)]
            }
            (Kind::Model, _) => {
                let reason =
                    "S eq. 3.43: the stretch guessed from the velocity stores nothing, so that a point which sticks is not thrown back";
                vec![error(TANGENTIAL, Statistic::Median, 4.0, Expected::SourceError(reason.into()))]
            }
            (Kind::ChungOoi(test), _) => chung_ooi::claims(&self.label, test),
            (Kind::Figures, _) => figures::claims(&self.label),
        }
    }
}

impl Case for ObliqueImpactCase {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let all = variants();
        let variant = all.get(setup.index).ok_or_else(|| Failure::NothingMeasured(setup.label.clone()))?;
        match variant.kind {
            Kind::Own | Kind::Model => variant.evaluate(knob, random_seed),
            Kind::ChungOoi(test) => chung_ooi::evaluate(test, knob),
            Kind::Figures => figures::evaluate(knob),
        }
    }

    fn claims(&self, _tier: Tier) -> Vec<Claim> {
        variants().iter().flat_map(Variant::claims).collect()
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        let setting = variants().get(setup.index)?.setting;
        let duration = setting.exact().after(&setting.before).duration;
        Some(setting.scene(duration / knob, 0.5, duration))
    }

    fn description(&self) -> Description {
        let labels = variants().into_iter().map(|variant| variant.label).collect();
        words::description(labels, |_, setup| variants().get(setup.index).map_or(Vec::new(), Variant::knobs))
    }
}
