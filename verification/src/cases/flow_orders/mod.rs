//! Do velocity and pressure of the flow solver converge with the orders that its differences promise, at every kind of side, and is it stable where theory says?

mod channel;
mod energy;
mod lid;
mod manufactured;
mod page;
mod splitting;
mod stability;
mod vortex;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::Vector;
use solver::fluid::navier_stokes::{Flow, FlowError, position};

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::variant::Variant as _;

/// The case.
pub struct FlowOrders;

/// What may go wrong in a run: a grid, sides, or a flow that blows up.
type Error = Box<dyn std::error::Error + Send + Sync>;

const VELOCITY: &str = "error of the velocity / velocity";
const PRESSURE: &str = "error of the pressure / pressure";
const ON_GRID: &str = "error of the velocity / velocity, against the solution on the grid";
const DIVERGENCE: &str = "largest divergence x spacing / speed";

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Variant {
    Vortex(vortex::Vortex),
    Manufactured(manufactured::Manufactured),
    Splitting(splitting::Splitting),
    Channel(channel::Channel),
    Energy(energy::Energy),
    Stability(stability::Limit),
    Reynolds,
    Lid,
}

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        let mut all: Vec<Variant> = vortex::ALL.map(Variant::Vortex).into();
        all.extend(manufactured::ALL.map(Variant::Manufactured));
        all.extend(splitting::ALL.map(Variant::Splitting));
        all.extend(channel::ALL.map(Variant::Channel));
        all.extend(energy::ALL.map(Variant::Energy));
        all.extend(stability::ALL.map(Variant::Stability));
        all.extend([Variant::Reynolds, Variant::Lid]);
        all
    }

    fn label(&self) -> String {
        match self {
            Variant::Vortex(vortex) => vortex.label(),
            Variant::Manufactured(flow) => flow.label(),
            Variant::Splitting(splitting) => splitting.label(),
            Variant::Channel(channel) => channel.label(),
            Variant::Energy(energy) => energy.label(),
            Variant::Stability(limit) => limit.label(),
            Variant::Reynolds => "vortices in space, from creeping to nearly without friction".into(),
            Variant::Lid => "cube with a moving lid, Reynolds number 1000".into(),
        }
    }

    fn knob_name(&self) -> &'static str {
        match self {
            Variant::Splitting(_) | Variant::Energy(energy::Energy::Drift) => "steps",
            Variant::Stability(_) => "steps_watched",
            Variant::Reynolds => "reynolds_number",
            _ => "cells",
        }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match self {
            Variant::Vortex(_) => until(tier, &[12.0, 16.0, 24.0, 32.0], &[48.0, 64.0, 96.0]),
            Variant::Manufactured(_) => until(tier, &[8.0, 12.0, 16.0, 24.0], &[32.0, 48.0, 64.0]),
            Variant::Splitting(_) => vec![4.0, 8.0, 16.0, 32.0],
            Variant::Channel(_) => vec![4.0, 8.0, 16.0],
            Variant::Energy(energy::Energy::Drift) => vec![6.0, 8.0, 12.0, 16.0, 24.0],
            Variant::Energy(_) => vec![8.0],
            Variant::Stability(_) => vec![stability::STEPS],
            Variant::Reynolds => vec![1e-8, 1.0, 100.0, 1e4],
            Variant::Lid => until(tier, &[], &[16.0, 24.0, 32.0]),
        }
    }
}

/// Values of the quick tier, and what longer tiers add.
fn until(tier: Tier, quick: &[f64], longer: &[f64]) -> Vec<f64> {
    let more = if tier == Tier::Quick { &[] } else { longer };
    quick.iter().chain(more).copied().collect()
}

impl Variant {
    fn claims_at(&self, tier: Tier, knob: f64) -> Vec<Claim> {
        match self {
            Variant::Vortex(vortex) => vortex.claims_at(self, knob),
            Variant::Manufactured(_) => manufactured::claims_at(self, knob),
            Variant::Splitting(splitting) => splitting.claims_at(self, knob),
            Variant::Channel(channel) => channel.claims_at(self, knob),
            Variant::Energy(energy) => energy.claims_at(self, knob),
            Variant::Stability(_) => stability::claims_at(self, knob),
            Variant::Reynolds => energy::reynolds_claims_at(self, knob),
            Variant::Lid => lid::claims_at(self, tier, knob),
        }
    }

    /// A claim about an order, made once, at the coarsest value of the knob.
    fn order(&self, tier: Tier, quantity: &'static str, order: f64) -> Claim {
        let knobs = self.knobs(tier);
        let range = [knobs[0], knobs[knobs.len() - 1]];
        Claim {
            setup: self.label(),
            quantity,
            statistic: Statistic::Single,
            subject: Subject::OrderAtLeast { order, range },
            // Pressures of R's scheme remember its first step, Euler's, on coarse grids.
            bound: Bound::new(if quantity == PRESSURE { 3.0 } else { 2.0 }, 1.0 / range[0], "one over the coarsest value of the knob"),
            expected: Expected::Holds,
        }
    }

    /// Orders that are claimed of it.
    fn orders(&self, tier: Tier) -> Vec<Claim> {
        let of = |quantity, order| self.order(tier, quantity, order);
        match self {
            Variant::Vortex(_) | Variant::Manufactured(_) => vec![of(VELOCITY, 2.0), of(PRESSURE, 2.0)],
            Variant::Splitting(_) => vec![of(VELOCITY, 2.0)],
            Variant::Channel(channel::Channel::Poiseuille) => vec![of(VELOCITY, 2.0)],
            Variant::Energy(energy::Energy::Drift) => vec![of(energy::LOST, 3.0)],
            Variant::Lid if tier != Tier::Quick => {
                let reason = "even cells of 1/32 are as wide as the layer at the lid: the second order has not set in";
                vec![Claim { expected: Expected::KnownLimit(reason.into()), ..of(lid::PROFILES, 2.0) }]
            }
            _ => Vec::new(),
        }
    }
}

impl Case for FlowOrders {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        match Variant::of(setup)? {
            Variant::Vortex(vortex) => vortex.measure(knob as usize),
            Variant::Manufactured(flow) => flow.measure(knob as usize),
            Variant::Splitting(splitting) => splitting.measure(knob as usize),
            Variant::Channel(channel) => channel.measure(knob as usize),
            Variant::Energy(energy) => energy.measure(knob as usize, random_seed),
            Variant::Stability(limit) => limit.measure(knob as usize, random_seed),
            Variant::Reynolds => energy::measure_reynolds(knob),
            Variant::Lid => lid::measure(knob as usize),
        }
        .map_err(|error| Failure::NothingMeasured(error.to_string()))
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        let mut claims: Vec<Claim> = Variant::all().iter().flat_map(|variant| variant.orders(tier)).collect();
        claims.extend(Variant::claims(tier, |variant, knob| variant.claims_at(tier, knob)));
        claims
    }

    fn description(&self) -> Description {
        page::description()
    }
}

/// Root mean square errors of velocity and pressure over the root mean squares of what they should be.
struct Errors {
    velocity: f64,
    pressure: f64,
}

/// Holds a flow against exact fields; the mean of the pressure counts only where an outlet sets it.
fn errors(
    flow: &Flow,
    velocity: impl Fn(usize, &Vector) -> f64 + Sync + Send,
    pressure: impl Fn(&Vector) -> f64 + Sync + Send,
    free_mean: bool,
) -> Errors {
    let border = flow.border();
    let place = |component, at| position(border.grid(), component, border.cell(at));
    let (mut missed, mut size) = (0.0, 0.0);
    for component in 0..3 {
        let values = &flow.velocity()[component];
        let exact = border.evaluate(Some(component), |at| velocity(component, &place(Some(component), at)));
        let got = border.evaluate(Some(component), |at| values[at]);
        missed += got.iter().zip(&exact).map(|(got, exact)| (got - exact).powi(2)).sum::<f64>();
        size += exact.iter().map(|exact| exact * exact).sum::<f64>();
    }
    let exact = border.evaluate(None, |at| pressure(&place(None, at)));
    let apart = border.evaluate(None, |at| flow.pressure()[at] - pressure(&place(None, at)));
    let square = |values: &[f64]| {
        let mean = if free_mean { values.iter().sum::<f64>() / values.len() as f64 } else { 0.0 };
        values.iter().map(|value| (value - mean).powi(2)).sum::<f64>()
    };
    Errors { velocity: (missed / size).sqrt(), pressure: (square(&apart) / square(&exact)).sqrt() }
}

/// A relative error that should be zero.
fn error(name: &'static str, samples: Vec<f64>, floor: f64, kind: ReferenceKind, source: &str) -> Quantity {
    Quantity {
        name,
        unit: "1",
        samples,
        expected: 0.0,
        reference: Reference { kind, uncertainty: floor, source: source.into() },
        error_kind: ErrorKind::Absolute,
        floor,
    }
}

/// The largest divergence that a flow has left, and its floor.
fn divergence(flow: &Flow) -> Quantity {
    let speed = flow.crossing_rate();
    error(DIVERGENCE, vec![flow.largest_divergence() / speed], rounding(flow), ReferenceKind::Exact, "conservation of mass")
}

/// Rounding of a transform there and back.
fn rounding(flow: &Flow) -> f64 {
    f64::EPSILON * (flow.border().grid().len() as f64).log2()
}

/// What is claimed of the divergence everywhere.
fn no_divergence(variant: &Variant, knob: f64) -> Claim {
    let bound = Bound::new(4.0, f64::EPSILON * 16.0, "rounding of a transform there and back, of 2^16 cells");
    variant.claim_at(knob, DIVERGENCE, Statistic::Single, bound, Expected::Holds)
}

/// What a run measured, with its work.
fn measurement(quantities: Vec<Quantity>, flow: &Flow, steps: usize) -> Measurement {
    let cells = flow.border().grid().len() as u64;
    let work = [("steps".to_string(), steps as u64), ("cells".to_string(), cells), ("pressure solves".to_string(), flow.solves())];
    Measurement { quantities, work: work.into(), runs: 1, curves: Vec::new() }
}

/// Steps a flow to its end.
fn run(flow: &mut Flow, end_time: f64, steps: usize, force: Option<solver::fluid::navier_stokes::Force<'_>>) -> Result<(), FlowError> {
    (0..steps).try_for_each(|_| flow.step(end_time / steps as f64, force))
}
