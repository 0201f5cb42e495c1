//! What must hold of spheres that move freely.

use super::{
    ASIDE, COURANT, FALLBACK, FASTEST, FRAMES, NO_GRID, REST, RIPPLE, SLIP, STARTED, STEP_SHARE, TERMINAL, TRANSIENT, Variant, tank,
};
use crate::case::Tier;
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::tank::UNCERTAINTY;
use crate::variant::Variant as _;

/// All claims at a tier.
pub(super) fn all(tier: Tier) -> Vec<Claim> {
    let mut claims = Variant::claims(tier, at_knob);
    let order = |variant: Variant, quantity, bound| {
        let knobs = variant.knobs(tier);
        let subject = Subject::OrderAtLeast { order: 2.0, range: [knobs[0], knobs[knobs.len() - 1]] };
        Claim { setup: variant.label(), quantity, statistic: Statistic::Single, subject, bound, expected: Expected::Holds }
    };
    claims.push(order(Variant::Terminal, TERMINAL, Bound::new(1.0, 0.2, "what half a cell of the coarsest grid changes a slope")));
    claims.push(order(
        Variant::Transient,
        TRANSIENT,
        Bound::new(1.0, 0.2, "two steps at the start of the coarsest run, of which the first is Euler's"),
    ));
    claims
}

const SLOWER: &str = "at the lowest Reynolds number, where walls are felt most, the sphere falls some four hundredths slower than was measured, and finer grids do not \
    make it faster; an oil thinner by as much would explain it";

fn at_knob(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, bound| variant.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
    let slip = || {
        claim(
            SLIP,
            Bound::new(
                10.0,
                super::LEFT,
                "slip at which the iteration of a step stops, over Stokes' velocity; then forces are shifted to keep momentum to rounding",
            ),
        )
    };
    let in_tank = || {
        let square = 4.0 / (knob * knob);
        let what = "uncertainty of the measurement, and half of (two spacings / diameter)^2";
        vec![
            claim(FASTEST, Bound::new(2.0, UNCERTAINTY + 0.5 * square, what)),
            claim(ASIDE, Bound::new(1.0, square, "(two spacings / diameter)^2")),
            claim(SLIP, Bound::new(2.0, tank::SLIP, "slip at which the iteration of a step stops, over the velocity without bounds")),
        ]
    };
    match variant {
        Variant::Terminal => {
            let square = 4.0 / (knob * knob);
            let what = "(two spacings / diameter)^2, by which a parabola misses a velocity that bends over the radius";
            vec![
                claim(TERMINAL, Bound::new(0.5, square, what)),
                claim(RIPPLE, Bound::new(0.1, square, "(two spacings / diameter)^2; a tenth of it depends on the place")),
                claim(ASIDE, Bound::new(1.0, square, "(two spacings / diameter)^2")),
                slip(),
            ]
        }
        Variant::Transient => vec![claim(TRANSIENT, Bound::new(2.0, 1.0 / (knob * knob), "(step / viscous time)^2"))],
        Variant::Ratios if knob == 1.0 => vec![claim(REST, Bound::new(1.0, f64::EPSILON, "rounding"))],
        Variant::Ratios => vec![
            claim(
                STARTED,
                Bound::new(
                    1.0,
                    0.05,
                    "(half a spacing / layer)^2 of a layer of two spacings, and the solid fraction: a twentieth (stability test S34)",
                ),
            ),
            claim(
                FALLBACK,
                Bound::new(0.2, 4.0 / 64.0, "(two spacings / diameter)^2 of eight cells a diameter; a fifth of it depends on the place"),
            ),
            slip(),
        ],
        Variant::Tank(_) => in_tank(),
        Variant::TankShares(name) => {
            let mut claims = in_tank();
            let what = "uncertainty of the measurement, and half of (two spacings / diameter)^2, which is taken out";
            let bound = Bound::new(1.0, UNCERTAINTY + 0.5 * 4.0 / (knob * knob), what);
            let expected = if *name == "E1" { Expected::KnownLimit(SLOWER.into()) } else { Expected::Holds };
            claims.push(variant.claim_at(knob, NO_GRID, Statistic::Single, bound, expected));
            claims.push(claim(STEP_SHARE, Bound::new(1.0, COURANT * COURANT, "(spacings that the sphere falls in a step)^2")));
            claims
        }
        Variant::Frames => vec![claim(FRAMES, Bound::new(1.0, 4.0 / (knob * knob), "(two spacings / diameter)^2"))],
    }
}
