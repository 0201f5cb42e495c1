//! Distances of pairs of shapes: are they right for every pair, at every scale, in every degenerate pose, and what do they cost?

mod kinds;
mod page;
pub mod poses;
mod variants;

use std::hint::black_box;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::distance::{CERTIFIED_GAP, Query, Relative, RoundedCore, search_alone, separation};
use solver::shape::{Convex, ParryPair};

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::exact::distance_certificate::{Answer, Body, Bounds, Placed};
use crate::variant::Variant as _;
use kinds::Kind;
use poses::{PosedPair, Random, Touch, random_pair};
use variants::{Crust, Mode, Variant};

/// The case.
pub struct PairDistance;

const ERROR: &str = "error of the distance / size";
const ASYMMETRY: &str = "change of the distance / size when the bodies are swapped";
const FAILURES: &str = "pairs without a right answer";

/// Errors over the size above which an answer counts as a failure: where Newton's method has the last word, and where it has not.
const FAILED_IF_CURVED: f64 = 1e-10;
const FAILED_IF_STRAIGHT: f64 = 1e-12;

/// Above this many answers, only the worst of each block are kept.
const LARGEST_NUMBER_OF_SAMPLES: usize = 100_000;
const BLOCK: usize = 1000;

/// What an answer to one pair amounts to, over the size.
struct Judged {
    error: f64,
    asymmetry: f64,
}

/// Two shapes of a size, for the solver and for the certificate.
struct Shapes {
    convex: [Convex; 2],
    cores: [RoundedCore; 2],
    bodies: [Body; 2],
    size: f64,
}

impl Shapes {
    fn new(kinds: [Kind; 2], size: f64) -> Result<Shapes, Failure> {
        let convex = |kind: Kind| kind.convex(size).ok_or_else(|| Failure::NothingMeasured(format!("no {} of {size} m", kind.name())));
        let convex = [convex(kinds[0])?, convex(kinds[1])?];
        let cores = [RoundedCore::sharp(&convex[0]), RoundedCore::sharp(&convex[1])];
        Ok(Shapes { convex, cores, bodies: kinds.map(|kind| kind.body(size)), size })
    }

    /// The answer of the solver; `None` if the search alone finds none.
    fn ask(&self, mode: Mode, pair: &PosedPair) -> Option<Answer> {
        let [first, second] = &self.cores;
        let (first_core, second_core) = ((&first.core, &pair.first), (&second.core, &pair.second));
        let found = match mode {
            Mode::SearchAlone => search_alone(first_core, second_core)?,
            Mode::Warm => separation(first_core, second_core, &Query { guess: Some(pair.guess), cutoff: f64::INFINITY }),
            _ => separation(first_core, second_core, &Query::cold()),
        };
        let distance = found.distance - first.radius - second.radius;
        Some(Answer { distance, normal: found.normal, on_first: found.on_first, on_second: found.on_second })
    }

    fn bounds(&self, pair: &PosedPair, answer: &Answer) -> Bounds {
        let placed = |place: usize, pose: &solver::distance::Pose| Placed {
            body: &self.bodies[place],
            position: pose.position,
            rotation: pose.rotation,
        };
        Bounds::of(&placed(0, &pair.first), &placed(1, &pair.second), answer)
    }

    /// The same pair with the second body first.
    fn swapped(&self, mode: Mode, pair: &PosedPair) -> Option<Answer> {
        let [first, second] = &self.cores;
        let (first_core, second_core) = ((&second.core, &pair.second), (&first.core, &pair.first));
        let found = match mode {
            Mode::SearchAlone => search_alone(first_core, second_core)?,
            Mode::Warm => separation(first_core, second_core, &Query { guess: Some(pair.guess.swapped()), cutoff: f64::INFINITY }),
            _ => separation(first_core, second_core, &Query::cold()),
        };
        let distance = found.distance - first.radius - second.radius;
        Some(Answer { distance, normal: found.normal, on_first: found.on_first, on_second: found.on_second })
    }

    fn judge(&self, mode: Mode, pair: &PosedPair) -> Judged {
        let Some(answer) = self.ask(mode, pair) else { return Judged { error: f64::NAN, asymmetry: f64::NAN } };
        let error = self.bounds(pair, &answer).error_of(answer.distance) / self.size;
        let asymmetry = self.swapped(mode, pair).map_or(f64::NAN, |other| (other.distance - answer.distance).abs() / self.size);
        Judged { error, asymmetry }
    }

    /// Parry's distance against the certified one. Where it sees an overlap or gives up, there is no force and no gap: a distance of zero.
    fn parry(&self, pair: &PosedPair) -> Option<ParryPair> {
        let relative = Relative::new(&pair.first, &pair.second);
        ParryPair::new(&self.convex[0], &self.convex[1], &relative.rotation, &relative.position)
    }

    fn judge_parry(&self, pair: &PosedPair) -> Judged {
        let parry = self.parry(pair);
        let distance = parry.and_then(|parry| parry.distance(None)).unwrap_or(0.0);
        let error = self.ask(Mode::Cold, pair).map_or(f64::NAN, |certain| self.bounds(pair, &certain).error_of(distance) / self.size);
        Judged { error, asymmetry: 0.0 }
    }
}

fn measure_random(variant: &Variant, size: f64, offset: f64, random_seed: u64) -> Result<Vec<Judged>, Failure> {
    let shapes = Shapes::new(variant.kinds, size)?;
    let mut random = Random::new(random_seed);
    let [first, second] = &shapes.cores;
    let mut judged = Vec::with_capacity(variant.pairs);
    for _ in 0..variant.pairs {
        let pair = random_pair(&mut random, [first, second], size, offset);
        if variant.mode == Mode::Parry {
            judged.push(shapes.judge_parry(&pair));
            repeat_parry(&shapes, &pair, variant.repeats);
        } else {
            judged.push(shapes.judge(variant.mode, &pair));
            // The same question again and again, so that the cost of a run is the cost of a question.
            for _ in 0..variant.repeats {
                black_box(shapes.ask(variant.mode, black_box(&pair)));
            }
        }
    }
    Ok(judged)
}

fn repeat_parry(shapes: &Shapes, pair: &PosedPair, repeats: usize) {
    let parry = shapes.parry(pair);
    for _ in 0..repeats {
        black_box(black_box(&parry).as_ref().and_then(|pair| pair.distance(None)));
    }
}

/// How much a crust changes the distance, against that of the sharp shapes.
fn measure_crust(variant: &Variant, crust: Crust, fraction: f64, random_seed: u64) -> Result<Vec<Judged>, Failure> {
    let shapes = Shapes::new(variant.kinds, 1.0)?;
    let rounded = |convex: &Convex| {
        let thickness = fraction * convex.inner_radius();
        match crust {
            Crust::Even => RoundedCore::with_crust(convex, thickness),
            Crust::Ratio => RoundedCore::shrunk_by_ratio(convex, thickness),
        }
    };
    let [Some(first), Some(second)] = [rounded(&shapes.convex[0]), rounded(&shapes.convex[1])] else {
        return Err(Failure::NothingMeasured(format!("no crust of {fraction} inner radii")));
    };
    let mut random = Random::new(random_seed);
    let mut judged = Vec::with_capacity(variant.pairs);
    for _ in 0..variant.pairs {
        let pair = random_pair(&mut random, [&shapes.cores[0], &shapes.cores[1]], 1.0, 0.0);
        let found = separation((&first.core, &pair.first), (&second.core, &pair.second), &Query::cold());
        judged.push(Judged { error: (found.distance - first.radius - second.radius - pair.gap).abs(), asymmetry: 0.0 });
    }
    Ok(judged)
}

/// Touching pairs at all gaps: against the gap itself.
fn measure_touch(touch: &Touch, size: f64, turns: usize, random_seed: u64) -> Result<Vec<Judged>, Failure> {
    let shapes = Shapes::new([touch.first, touch.second], size)?;
    let mut random = Random::new(random_seed);
    let mut judged = Vec::new();
    for _ in 0..turns {
        for gap in touch.gaps() {
            let pair = touch.pair(&mut random, [&shapes.cores[0], &shapes.cores[1]], size, *gap);
            let distance = |answer: Option<Answer>| answer.map_or(f64::NAN, |answer| answer.distance / size);
            for mode in [Mode::Cold, Mode::Warm] {
                let found = distance(shapes.ask(mode, &pair));
                let asymmetry = (distance(shapes.swapped(mode, &pair)) - found).abs();
                judged.push(Judged { error: (found - touch.distance - gap).abs(), asymmetry });
            }
        }
    }
    Ok(judged)
}

/// Of a million answers only the worst of each thousand are kept, as samples; NaN is worst.
fn worst_of_blocks(judged: Vec<Judged>) -> Vec<Judged> {
    if judged.len() < LARGEST_NUMBER_OF_SAMPLES {
        return judged;
    }
    let worse = |one: f64, other: f64| if one.total_cmp(&other).is_lt() { other } else { one };
    let worst = |block: &[Judged]| {
        block.iter().fold(Judged { error: 0.0, asymmetry: 0.0 }, |worst, judged| Judged {
            error: worse(worst.error, judged.error),
            asymmetry: worse(worst.asymmetry, judged.asymmetry),
        })
    };
    judged.chunks(BLOCK).map(worst).collect()
}

impl Variant {
    /// Rounding of a distance over the size: of the points that are farthest from the centres, and of their difference.
    fn rounding(&self) -> f64 {
        let reach: f64 = self
            .kinds
            .iter()
            .map(|kind| {
                let body = kind.body(1.0);
                body.core.reach() + body.rounding
            })
            .sum();
        4.0 * f64::EPSILON * reach
    }

    /// Smallest error that is promised: rounding, and the gap at which Newton's method is content.
    fn floor(&self) -> f64 {
        let reach: f64 = self.kinds.iter().map(|kind| kind.body(1.0).core.reach()).sum();
        if self.is_curved() { self.rounding() + CERTIFIED_GAP * reach } else { self.rounding() }
    }

    fn is_curved(&self) -> bool {
        // A ball against anything has a closed form.
        self.kinds.iter().any(|kind| kind.is_curved()) && !self.kinds.contains(&Kind::Sphere)
    }

    /// Distance over the size by which rounding the edges by an even crust changes that of two bodies at most: twice the depth of a rounded corner.
    fn rounded_corner(&self, fraction: f64) -> f64 {
        let depth = |kind: &Kind| {
            let faces = if *kind == Kind::Cube { 3.0_f64 } else { 2.0 };
            kind.convex(1.0).map_or(f64::NAN, |convex| fraction * convex.inner_radius() * (faces.sqrt() - 1.0))
        };
        self.kinds.iter().map(depth).sum()
    }
}

impl Case for PairDistance {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let variant = &Variant::of(setup)?;
        let judged = match variant.mode {
            Mode::Crust(crust) => measure_crust(variant, crust, knob, random_seed)?,
            Mode::Touch(touch) => measure_touch(&touch, knob, variant.pairs, random_seed)?,
            Mode::FarAway => measure_random(variant, 1.0, knob, random_seed)?,
            Mode::Cold | Mode::Warm | Mode::SearchAlone | Mode::Parry => measure_random(variant, knob, 0.0, random_seed)?,
        };
        let limit = if variant.is_curved() { FAILED_IF_CURVED } else { FAILED_IF_STRAIGHT };
        let failures = judged.iter().filter(|judged| judged.error.is_nan() || judged.error > limit).count();
        let runs = (judged.len() * variant.repeats.max(1)) as u64;
        let judged = worst_of_blocks(judged);
        let quantity = |name, samples, floor| Quantity {
            name,
            unit: "1",
            samples,
            expected: 0.0,
            reference: Reference {
                kind: ReferenceKind::Exact,
                uncertainty: 0.0,
                source: "certificate: supporting planes and points".into(),
            },
            error_kind: ErrorKind::Absolute,
            floor,
        };
        let errors = judged.iter().map(|judged| judged.error).collect();
        let mut quantities = vec![quantity(ERROR, errors, variant.rounding())];
        if !matches!(variant.mode, Mode::Parry | Mode::Crust(_)) {
            quantities.push(quantity(ASYMMETRY, judged.iter().map(|judged| judged.asymmetry).collect(), variant.rounding()));
        }
        if !matches!(variant.mode, Mode::Crust(_)) {
            quantities.push(quantity(FAILURES, vec![failures as f64], 0.5));
        }
        Ok(Measurement { quantities, runs, ..Measurement::default() })
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        Variant::claims(tier, claims_at)
    }

    fn description(&self) -> Description {
        page::description()
    }
}

/// What must hold of a variant at a knob value.
fn claims_at(variant: &Variant, knob: f64) -> Vec<Claim> {
    let claim = |quantity, statistic, bound, expected| variant.claim_at(knob, quantity, statistic, bound, expected);
    let rounding = "the rounding of the farthest points of both bodies and of their difference";
    let floor_is = if variant.is_curved() { "the gap between bounds that ends Newton's method, and rounding" } else { rounding };
    let none_fails = || Bound::new(1.0, 0.5, "half a pair: none may fail");
    match variant.mode {
        Mode::Cold | Mode::Warm | Mode::Touch(_) | Mode::FarAway => vec![
            claim(ERROR, Statistic::Worst, Bound::new(10.0, variant.floor(), floor_is), Expected::Holds),
            claim(ASYMMETRY, Statistic::Worst, Bound::new(10.0, f64::EPSILON, "one unit in the last place"), Expected::Holds),
            claim(FAILURES, Statistic::Single, none_fails(), Expected::Holds),
        ],
        Mode::SearchAlone => {
            let reason = "a search for corners closes in on a curved surface slowly and ends in slivers: it needs the polish";
            vec![claim(FAILURES, Statistic::Single, none_fails(), Expected::KnownLimit(reason.into()))]
        }
        Mode::Parry => {
            parry_claims(variant, knob).into_iter().map(|(bound, expected)| claim(ERROR, Statistic::Worst, bound, expected)).collect()
        }
        Mode::Crust(crust) => {
            let bound = Bound::new(1.0, variant.rounded_corner(knob), "the depth by which an even crust rounds a corner of each body");
            let expected = match crust {
                Crust::Ratio if variant.kinds.contains(&Kind::Rod) => Expected::SourceError(
                    "R section 2.5 shrinks by a ratio: the crust of an elongated body is thicker at its ends than it is counted".into(),
                ),
                _ => Expected::Holds,
            };
            vec![claim(ERROR, Statistic::Worst, bound, expected)]
        }
    }
}

/// Parry at size 1 and at a thousandth: what its tolerances are made for, and what they are not.
fn parry_claims(variant: &Variant, size: f64) -> Option<(Bound, Expected)> {
    if size != 1.0 && size != 1e-3 {
        return None;
    }
    let bound = Bound::new(10.0, variant.floor(), "what is asked of the solver");
    let reason = if size == 1.0 {
        "parry ends its search at a relative change of the root of ten machine epsilons"
    } else {
        "absolute tolerances: at a millimetre parry takes near corners for the same"
    };
    Some((bound, if variant.is_curved() { Expected::KnownLimit(reason.into()) } else { Expected::Holds }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::distance_certificate::{Solid, distance_of_hulls};

    #[test]
    fn polyhedra_are_as_far_as_the_least_over_all_pairs_of_their_faces() {
        for kinds in [[Kind::Tetrahedron, Kind::Icosahedron], [Kind::Tetrahedron, Kind::Tetrahedron]] {
            let shapes = Shapes::new(kinds, 1.0).unwrap();
            let [Solid::Hull(first), Solid::Hull(second)] = [&shapes.bodies[0].core, &shapes.bodies[1].core] else { panic!("hulls") };
            let mut random = Random::new(7);
            for _ in 0..200 {
                let pair = random_pair(&mut random, [&shapes.cores[0], &shapes.cores[1]], 1.0, 0.0);
                let found = shapes.ask(Mode::Cold, &pair).unwrap().distance;
                let exact = distance_of_hulls(
                    (first, &pair.first.position, &pair.first.rotation),
                    (second, &pair.second.position, &pair.second.rotation),
                );
                assert!((found - exact).abs() < 64.0 * f64::EPSILON, "{kinds:?}: {found} {exact}");
            }
        }
    }

    #[test]
    fn labels_are_unique_and_every_pair_of_kinds_is_asked_a_million_times() {
        let all = Variant::all();
        let labels: std::collections::BTreeSet<String> = all.iter().map(Variant::label).collect();
        assert_eq!(labels.len(), all.len());
        assert_eq!(all.iter().filter(|variant| variant.pairs == 1_000_000).count(), 36);
        assert_eq!(all.iter().filter(|variant| variant.pairs == 100_000).count(), 19);
    }
}
