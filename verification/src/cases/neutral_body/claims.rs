//! What must hold of bodies of the fluid's own density.

use std::f64::consts::FRAC_PI_2;

use super::{ANGLE, ASIDE, GAP, GRID, GRIDS, MISSED, PERIOD, RATE, REST, SLIP, UNBOUNDED, UNCERTAINTY, Variant, shear};
use crate::case::Tier;
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::variant::Variant as _;

/// All claims at a tier.
pub(super) fn all(tier: Tier) -> Vec<Claim> {
    let mut claims = Variant::claims(tier, at_knob);
    let knobs = Variant::Sphere.knobs(tier);
    claims.push(Claim {
        setup: Variant::Sphere.label(),
        quantity: GRID,
        statistic: Statistic::Worst,
        subject: Subject::OrderAtLeast { order: 2.0, range: [knobs[0], knobs[knobs.len() - 1]] },
        bound: Bound::new(1.0, 0.2, "what half a cell of the coarsest grid changes a slope"),
        expected: Expected::Holds,
    });
    claims
}

const SHARES: &str =
    "(largest semi-axis / half the gap)^3, by which walls and images hold back a stresslet, and (two spacings / smallest diameter)^2";

/// Walls and images see a body as a stresslet, whose shear falls with the cube of the distance; a tenth to a half of it comes back.
fn held_back(gap: f64) -> f64 {
    1.0 / gap.powi(3)
}

fn grid_error(cells: f64) -> f64 {
    4.0 / (cells * cells)
}

fn at_knob(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, bound| variant.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
    let whole = |cells: f64| {
        vec![
            claim(SLIP, Bound::new(2.0, shear::SLIP, "slip at which the iteration of a step stops")),
            claim(ASIDE, Bound::new(1.0, grid_error(cells), "(two spacings / smallest diameter)^2")),
        ]
    };
    let orbit = |aspect: f64, gap: f64, cells: f64| {
        let mut claims = whole(cells);
        let shares = held_back(gap) + grid_error(cells);
        claims.push(claim(PERIOD, Bound::new(1.0, shares, SHARES)));
        // The even phase is late by its part of a quarter of a turn, and the angle goes at most the aspect ratio faster than it.
        let fastest = FRAC_PI_2 * aspect.max(1.0 / aspect);
        let what = "a quarter of a turn, times the aspect ratio or one over it, times the shares of walls, images and grid in the period";
        claims.push(claim(ANGLE, Bound::new(1.0, fastest * shares, what)));
        claims
    };
    match *variant {
        Variant::Rest => vec![claim(REST, Bound::new(1.0, f64::EPSILON, "rounding"))],
        Variant::Sphere => {
            let worst = |quantity, bound| variant.claim_at(knob, quantity, Statistic::Worst, bound, Expected::Holds);
            let mut claims = whole(knob);
            claims.push(worst(GRID, Bound::new(1.0, grid_error(knob), "(two spacings / diameter)^2")));
            claims.push(worst(RATE, Bound::new(1.0, held_back(GAP) + grid_error(knob), SHARES)));
            claims
        }
        Variant::SphereBoxes => {
            let mut claims = whole(GRIDS[1]);
            claims.push(claim(RATE, Bound::new(1.0, held_back(knob) + grid_error(GRIDS[1]), SHARES)));
            claims
        }
        Variant::Orbit(aspect) => orbit(aspect, GAP, knob),
        Variant::OrbitBoxes(aspect) => orbit(aspect, knob, GRIDS[0]),
        Variant::Limit(_) => vec![
            claim(MISSED, Bound::new(1.0, 1.0, "what the extrapolation is uncertain by")),
            claim(UNCERTAINTY, Bound::new(1.0, held_back(4.0) + grid_error(knob), "shares of the widest box and of the finest grid")),
            claim(
                UNBOUNDED,
                Bound::new(0.5, held_back(4.0) + grid_error(knob), "shares of the widest box and of the finest grid, which are taken out"),
            ),
        ],
    }
}
