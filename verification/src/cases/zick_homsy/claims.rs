//! What must hold of flows through arrays.

use super::{
    AT_ONCE, COMPARED, COST_RATIO, DIVERGENCE, EXTRAPOLATED, FRICTION, FULL_RESIDUAL, INVERTED_CELLS, LEVEL, Measure, Method, RESIDUAL,
    TOUCHING, UNCERTAINTY, Variant, methods,
};
use crate::case::Tier;
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::periodic_array::Lattice;
use crate::variant::Variant as _;

/// All claims at a tier.
pub(super) fn all(tier: Tier) -> Vec<Claim> {
    let mut claims = Variant::claims(tier, at_knob);
    claims.extend(Variant::all().iter().flat_map(|variant| orders(variant, tier)));
    claims
}

/// Errors of R's points that a program of another hand found at solid fraction 0.125, and its cells a diameter.
const SOURCE_LEVELS: [[f64; 2]; 3] = [[10.0, 0.084], [20.0, 0.038], [40.0, 0.017]];

/// The level of the source's error at a knob value, where it is known.
pub(super) fn source_level(variant: &Variant, knob: f64) -> Option<f64> {
    let is_source = variant.method == Method::SOURCE && variant.fraction == COMPARED;
    SOURCE_LEVELS.iter().find(|[cells, _]| is_source && *cells == knob).map(|[_, level]| *level)
}

fn at_knob(variant: &Variant, knob: f64) -> Vec<Claim> {
    match (variant.measure, variant.method) {
        (Measure::Limit, _) => of_limit(variant, knob),
        (Measure::Cost, _) => {
            let bound = Bound::new(1.0, 0.01, "a hundredth: the default costs a hundred times less");
            vec![variant.claim_at(knob, COST_RATIO, Statistic::Single, bound, Expected::Holds)]
        }
        (Measure::Flow, Method::Marched { explicit_forcing }) => of_marched(variant, knob, explicit_forcing),
        (Measure::Flow, Method::Points { .. }) => {
            let mut claims = both_at_once(variant, knob);
            if let Some(level) = source_level(variant, knob) {
                // Grids are whole numbers of cells and places are random.
                let bound = Bound::new(2.0, level / 20.0, "what half a cell more in ten changes an error of first order");
                claims.push(variant.claim_at(knob, LEVEL, Statistic::Median, bound, Expected::Holds));
            }
            claims
        }
        (Measure::Flow, Method::Sharp(_)) => of_sharp(variant, knob),
    }
}

/// No divergence, and the conditions met, in one and the same velocity.
fn both_at_once(variant: &Variant, knob: f64) -> Vec<Claim> {
    let rounding =
        Bound::new(10.0, 1e-11, "rounding of transforms of forces that are larger than the mean flow's by the cells of a gap squared");
    let tolerance = Bound::new(1.0, methods::TOLERANCE, "the tolerance of the solver");
    vec![
        variant.claim_at(knob, DIVERGENCE, Statistic::Worst, rounding, Expected::Holds),
        variant.claim_at(knob, RESIDUAL, Statistic::Worst, tolerance, Expected::Holds),
    ]
}

fn of_sharp(variant: &Variant, knob: f64) -> Vec<Claim> {
    let mut claims = both_at_once(variant, knob);
    if variant.method != Method::SHARP {
        return claims;
    }
    claims.push(variant.claim_at(knob, FRICTION, Statistic::Worst, error_bound(variant, knob), Expected::Holds));
    if variant.lattice != Lattice::SimpleCubic {
        return claims;
    }
    // What the field's anchor must show, on a grid of forty cells a diameter.
    let goal = |part: f64| Bound::new(1.0, part, "what an anchor of the field is asked for");
    let at_forty = [(0.125, 1e-3), (0.216, 1e-3), (0.343, 2e-3), (0.45, 6e-3)];
    if let Some((_, part)) = at_forty.iter().find(|(fraction, _)| *fraction == variant.fraction && knob == 40.0) {
        claims.push(variant.claim_at(knob, FRICTION, Statistic::Worst, goal(*part), Expected::Holds));
    }
    // One per cent for 0.15 and a tenth for 2 CPU seconds, set-up and all.
    let cheap = [(15.0, 1e-2, 0.15), (30.0, 1e-3, 2.0)];
    if let Some((_, part, seconds)) = cheap.iter().find(|(cells, ..)| variant.fraction == 0.216 && *cells == knob) {
        let cells = Bound::new(1.0, seconds / SECONDS_A_CELL, format!("what {seconds} CPU s pay at 40 ns a cell, measured with set-up"));
        claims.push(variant.claim_at(knob, FRICTION, Statistic::Worst, goal(*part), Expected::Holds));
        claims.push(variant.claim_at(knob, INVERTED_CELLS, Statistic::Worst, cells, Expected::Holds));
    }
    claims
}

/// CPU time of a whole flow over its inverted cells, set-up and Krylov vectors included: time is too noisy to be judged, counts are not.
const SECONDS_A_CELL: f64 = 40e-9;

/// The error by design: the square of the spacing over the radius, or over the gap where that is less.
fn error_bound(variant: &Variant, cells: f64) -> Bound {
    if variant.fraction == TOUCHING {
        return Bound::new(4.0, 1.0 / cells, "the spacing over the diameter: next to contacts conditions are of first order");
    }
    let diameter = variant.lattice.diameter(variant.fraction);
    let gap = variant.lattice.nearest() - diameter;
    let spacing = diameter / (0.5 * diameter).min(gap) / cells;
    Bound::new(0.5, spacing * spacing, "(spacing over the radius, or over the gap where that is less)^2")
}

fn of_limit(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim =
        |quantity, part, what: &str| variant.claim_at(knob, quantity, Statistic::Single, Bound::new(1.0, part, what), Expected::Holds);
    let width = "half a thousandth, the width that an anchor of the field may have";
    vec![claim(EXTRAPOLATED, 5e-4, width), claim(UNCERTAINTY, 5e-4, width)]
}

fn of_marched(variant: &Variant, knob: f64, explicit_forcing: f64) -> Vec<Claim> {
    let settled = Bound::new(10.0, methods::STEADY, "the change of the mean velocity in a diffusion time at which the run ends");
    let rounding = Bound::new(10.0, 1e-11, "what the default leaves");
    let split =
        "the half of a step that holds the spheres makes divergence, which the other takes out: R's split holds one of both at a time";
    let undone = "without the forces of the last step the halves of a step undo each other";
    let steady = if explicit_forcing > 0.0 { Expected::Holds } else { Expected::KnownLimit(undone.into()) };
    vec![
        variant.claim_at(knob, AT_ONCE, Statistic::Single, settled, steady),
        variant.claim_at(knob, DIVERGENCE, Statistic::Single, rounding, Expected::KnownLimit(split.into())),
    ]
}

fn orders(variant: &Variant, tier: Tier) -> Vec<Claim> {
    let knobs = variant.knobs(tier);
    let (Some(coarse), Some(fine)) = (knobs.first(), knobs.last()) else { return Vec::new() };
    let range = [*coarse, *fine];
    let claim = |quantity, subject| {
        let bound = Bound::new(1.0, 0.2, "what half a cell of the coarsest grid changes a slope");
        Claim { setup: variant.label(), quantity, statistic: Statistic::Median, subject, bound, expected: Expected::Holds }
    };
    match (variant.measure, variant.method) {
        (Measure::Flow, Method::SHARP) if variant.lattice != Lattice::SimpleCubic => {
            let has_settled = variant.fraction == 0.216 && knobs.len() > 2;
            has_settled.then(|| claim(FRICTION, Subject::OrderAtLeast { order: 2.0, range })).into_iter().collect()
        }
        (Measure::Flow, Method::SHARP) if [0.125, 0.216].contains(&variant.fraction) => vec![
            claim(FRICTION, Subject::OrderAtLeast { order: 2.0, range }),
            claim(FULL_RESIDUAL, Subject::OrderAtLeast { order: 2.0, range }),
        ],
        (Measure::Flow, Method::SOURCE) => vec![claim(FRICTION, Subject::OrderAbout { order: 1.25, range })],
        _ => Vec::new(),
    }
}
