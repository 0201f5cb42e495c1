//! What must hold of flows through the bed.

use std::f64::consts::TAU;

use super::bed::{self, Trilobe};
use super::flows::{Regime, SLIP, TOLERANCE};
use super::{
    DIVERGENCE, DROP, EXCESS, EXTRAPOLATED, IMBALANCE, INERTIAL, LEAK, LONGER, RESIDUAL, SOLID, TORTUOSITY, UNCERTAINTY, VISCOUS, Variant,
    fine,
};
use crate::case::Tier;
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::ergun;
use crate::variant::Variant as _;

/// All claims at a tier.
pub(super) fn all(tier: Tier) -> Vec<Claim> {
    let mut claims = Variant::claims(tier, at_knob);
    claims.extend(order(tier));
    claims
}

fn at_knob(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, bound| variant.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
    match *variant {
        Variant::Flow(Regime::Creeping) => [of_any_flow(variant, knob), of_creeping(variant, knob)].concat(),
        Variant::Flow(_) => [of_any_flow(variant, knob), of_inertia(variant, knob)].concat(),
        Variant::Limit => vec![
            claim(EXTRAPOLATED, Bound::new(1.0, relative(fine::DROP), "what orders from 1 to 2 leave open")),
            claim(UNCERTAINTY, Bound::new(2.0, 1.0 / knob, "the spacing over the diameter: a limit of first order")),
        ],
        Variant::Longer => {
            let uneven = (-TAU * 6.0 / bed::WIDTH).exp();
            let what = "exp(-2 pi x / width), what is left of the slowest unevenness after the six diameters between beds";
            vec![claim(LONGER, Bound::new(1.0, uneven, what))]
        }
    }
}

/// No divergence, nothing lost on the way, and solids of the right volume.
fn of_any_flow(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, bound| variant.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
    let rounding = "rounding of transforms of forces that are larger than the mean flow's by the cells of a gap squared";
    let is_lossy = knob < 10.0 && !matches!(variant, Variant::Flow(Regime::Creeping));
    let thin = "jets are thinner than pores: at 8 cells a diameter a sixth of the flow goes through cells whose middles are solid";
    let kept = if is_lossy { Expected::KnownLimit(thin.into()) } else { Expected::Holds };
    let leak = Bound::new(1.0, 1.0 / knob, "the spacing over the diameter: what goes through cells whose middles are solid");
    vec![
        claim(IMBALANCE, Bound::new(10.0, 1e-12, "rounding of a transform there and back")),
        claim(DIVERGENCE, Bound::new(10.0, 1e-11, rounding)),
        claim(SOLID, Bound::new(1.0, flatness(knob), "(spacing over the radius of a lobe)^2 / 24, by which a surface bends in a cell")),
        variant.claim_at(knob, LEAK, Statistic::Single, leak, kept),
    ]
}

fn of_creeping(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, bound| variant.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
    let what = "the spacing over the diameter, and what the reference is uncertain by: conditions in gaps and at edges are of first order";
    vec![
        claim(DROP, Bound::new(2.0, 1.0 / knob + relative(fine::DROP), what)),
        claim(TORTUOSITY, Bound::new(0.25, 1.0 / knob + relative(fine::TORTUOSITY), what)),
        claim(RESIDUAL, Bound::new(1.0, TOLERANCE, "the tolerance of the solver, which changes the drop by a fifth of it at most")),
        claim(VISCOUS, half_band(ergun::viscous_band())),
    ]
}

fn of_inertia(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, bound| variant.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
    vec![
        claim(EXCESS, Bound::new(1.0, 1.0, "one: R finds that about three tenths of the drop are inertia")),
        claim(RESIDUAL, Bound::new(2.0, SLIP, "slip at which an iteration stops, over the velocity")),
        claim(INERTIAL, inertial_bound(knob)),
    ]
}

/// A difference of two drops, each with the error of its grid.
fn inertial_bound(knob: f64) -> Bound {
    let [least, most] = ergun::inertial_band();
    let what = "half of the band of all authors, and as much of its middle as the spacing is of the radius: pores are too wide by a part of a cell";
    Bound::new(1.0, 0.5 * (most - least) + (least + most) / knob, what)
}

fn half_band([least, most]: [f64; 2]) -> Bound {
    Bound::new(1.0, 0.5 * (most - least), "half of the band of all authors")
}

/// Where the surface of a lobe bends by that part of a cell, its share of a cell is wrong by as much.
fn flatness(knob: f64) -> f64 {
    1.0 / (knob * Trilobe::LOBE_RADIUS).powi(2) / 24.0
}

fn relative([value, uncertainty]: [f64; 2]) -> f64 {
    uncertainty / value
}

fn order(tier: Tier) -> Option<Claim> {
    let variant = Variant::Flow(Regime::Creeping);
    let knobs = variant.knobs(tier);
    let range = [*knobs.first()?, *knobs.last()?];
    let bound = Bound::new(1.0, 0.3, "what the uncertainty of the reference changes a slope");
    let subject = Subject::OrderAbout { order: 1.3, range };
    (knobs.len() > 2).then(|| Claim {
        setup: variant.label(),
        quantity: DROP,
        statistic: Statistic::Single,
        subject,
        bound,
        expected: Expected::Holds,
    })
}
