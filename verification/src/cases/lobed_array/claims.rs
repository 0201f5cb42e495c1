//! What must hold of flows past lobed bodies.

use super::flows::{Course, Family, Method, Shape, TOLERANCE};
use super::{ASYMMETRY, DIVERGENCE, DRAG, EXTRAPOLATED, FRICTION, IMBALANCE, MISRANKED, Measure, NEGATIVE, RESIDUAL, Variant, fine};
use crate::case::Tier;
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::cylinder_array;
use crate::variant::Variant as _;

/// All claims at a tier.
pub(super) fn all(tier: Tier) -> Vec<Claim> {
    let mut claims = Variant::claims(tier, at_knob);
    claims.extend(Variant::all().iter().flat_map(|variant| orders(variant, tier)));
    claims
}

fn at_knob(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, statistic, bound| variant.claim_at(knob, quantity, statistic, bound, Expected::Holds);
    let one_pair = || Bound::new(0.5, 1.0, "half of one");
    match variant.measure {
        Measure::Flow => {
            let mut claims = of_any_flow(variant, knob);
            if variant.method == Method::Sharp {
                let quantity = if variant.family == Family::Endless { DRAG } else { FRICTION };
                claims.push(claim(quantity, Statistic::Worst, error_bound(variant, knob)));
            }
            claims
        }
        Measure::Limit => {
            let what = "a hundredth, what corners and the places of a few bodies leave of an extrapolation, and what the reference is uncertain by";
            let unsure = fine::friction(variant.shape, variant.family, variant.course).map_or(f64::NAN, |[value, half]| half / value);
            vec![claim(EXTRAPOLATED, Statistic::Single, Bound::new(1.5, 0.01 + unsure, what))]
        }
        Measure::Resistance => {
            let spacing = 1.0 / variant.problem(knob).cells();
            let what = "the spacing over the diameter: the weights of forces and conditions differ";
            vec![claim(ASYMMETRY, Statistic::Single, Bound::new(1.0, spacing, what)), claim(NEGATIVE, Statistic::Single, one_pair())]
        }
        Measure::Ranking => vec![claim(MISRANKED, Statistic::Single, one_pair())],
    }
}

/// No divergence, the conditions met, and the box in balance.
fn of_any_flow(variant: &Variant, knob: f64) -> Vec<Claim> {
    let rounding =
        || Bound::new(10.0, 1e-11, "rounding of transforms of forces that are larger than the mean flow's by the cells of a gap squared");
    let tolerance = Bound::new(1.0, TOLERANCE, "the tolerance of the solver");
    vec![
        variant.claim_at(knob, DIVERGENCE, Statistic::Worst, rounding(), Expected::Holds),
        variant.claim_at(knob, RESIDUAL, Statistic::Worst, tolerance, Expected::Holds),
        variant.claim_at(knob, IMBALANCE, Statistic::Worst, rounding(), Expected::Holds),
    ]
}

/// The error by design: of the second order for round bodies without ends, of the first with the edges of their ends.
fn error_bound(variant: &Variant, knob: f64) -> Bound {
    let cells = variant.problem(knob).cells();
    if variant.family == Family::Endless {
        let radius = cylinder_array::radius(variant.fraction);
        let spacing = 1.0 / (knob * radius.min(1.0 - 2.0 * radius));
        return Bound::new(1.0, spacing * spacing, "(spacing over the radius, or over the gap where that is less)^2");
    }
    Bound::new(
        2.0,
        1.0 / cells,
        "the spacing over the diameter: stresses are singular at the edges of the ends, whose places between values differ",
    )
}

fn orders(variant: &Variant, tier: Tier) -> Vec<Claim> {
    let knobs = variant.knobs(tier);
    let (Some(coarse), Some(fine)) = (knobs.first(), knobs.last()) else { return Vec::new() };
    let range = [*coarse, *fine];
    let claim = |quantity, subject, bound| {
        vec![Claim { setup: variant.label(), quantity, statistic: Statistic::Median, subject, bound, expected: Expected::Holds }]
    };
    let places = Bound::new(1.0, 0.3, "what the places of the body on the coarsest grid change of a slope");
    match (variant.measure, variant.family, variant.method, variant.course) {
        (Measure::Flow, Family::Endless, Method::Sharp, Course::Along) if tier != Tier::Quick => {
            claim(DRAG, Subject::OrderAtLeast { order: 2.0, range }, places)
        }
        // A layer of a part of a cell about the body is of the first order; what is left of it on coarse grids adds a tenth.
        (Measure::Flow, Family::Endless, Method::Points, _) if tier != Tier::Quick => {
            claim(DRAG, Subject::OrderAbout { order: 1.1, range }, places)
        }
        // R's rate is that of its lobed bodies.
        (Measure::Flow, Family::Short, Method::Points, _) if tier != Tier::Quick && variant.shape != Shape::Cylinder => {
            claim(FRICTION, Subject::OrderAbout { order: 1.3, range }, places)
        }
        _ => Vec::new(),
    }
}
