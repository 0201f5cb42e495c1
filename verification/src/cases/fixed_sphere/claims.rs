//! What must hold of a sphere in a stream.

use std::f64::consts::PI;

use super::{DIVERGENCE, DRAG, FRICTION, MISSED, SLIP, UNBOUNDED, UNCERTAINTY, Variant, sphere};
use crate::case::Tier;
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::sphere_drag::tabulated;
use crate::variant::Variant as _;

/// All claims at a tier.
pub(super) fn all(tier: Tier) -> Vec<Claim> {
    let mut claims = Variant::claims(tier, at_knob);
    claims.push(order_of_array(tier));
    claims
}

fn at_knob(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, bound| variant.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
    let whole = |slip: f64| {
        vec![
            claim(DIVERGENCE, Bound::new(4.0, f64::EPSILON * 16.0, "rounding of a transform there and back, of 2^16 cells")),
            claim(SLIP, Bound::new(2.0, slip, "slip at which the iteration of a step stops, over the speed")),
        ]
    };
    match *variant {
        Variant::Stream { reynolds, across } => {
            let mut claims = whole(sphere::SLIP);
            claims.push(claim(DRAG, Bound::new(2.0, blockage(reynolds, across) + grid_error(reynolds, knob), SHARES)));
            claims
        }
        Variant::Array => {
            let mut claims = whole(0.01 * sphere::SLIP);
            let what = "(two spacings / diameter)^2, by which a parabola misses a velocity that bends over the radius";
            claims.push(claim(FRICTION, Bound::new(0.5, 4.0 / (knob * knob), what)));
            claims
        }
        Variant::Limit { reynolds } => vec![
            claim(MISSED, Bound::new(1.0, 1.0, "what the extrapolation and the table are uncertain by")),
            claim(
                UNCERTAINTY,
                Bound::new(3.0, blockage(reynolds, 9.0) + grid_error(reynolds, knob), "shares of the widest box and of the finest grid"),
            ),
            claim(
                UNBOUNDED,
                Bound::new(
                    0.5,
                    blockage(reynolds, 9.0) + grid_error(reynolds, 8.0),
                    "shares of the widest box and of its grid, which are taken out",
                ),
            ),
        ],
    }
}

const SHARES: &str = "flow that the wake drives aside, over the section of the box, and (spacing / boundary layer)^2 / 12";

/// The wake carries less by the drag over the momentum of the stream (twice the drag coefficient's eighth of pi), and what it lacks speeds up the rest of the section.
fn blockage(reynolds: f64, across: f64) -> f64 {
    tabulated(reynolds).map_or(f64::NAN, |drag| drag.coefficient) * PI / 8.0 / (across * across)
}

/// A layer is as thick as a diameter over the root of the Reynolds number.
fn grid_error(reynolds: f64, cells: f64) -> f64 {
    reynolds.max(10.0) / (cells * cells) / 12.0
}

fn order_of_array(tier: Tier) -> Claim {
    let knobs = Variant::Array.knobs(tier);
    let range = [knobs[0], knobs[knobs.len() - 1]];
    Claim {
        setup: Variant::Array.label(),
        quantity: FRICTION,
        statistic: Statistic::Single,
        subject: Subject::OrderAtLeast { order: 2.0, range },
        bound: Bound::new(1.0, 0.2, "what half a cell of the coarsest grid changes a slope"),
        expected: Expected::Holds,
    }
}
