//! Cost of the distance of two shapes, cold and warm, against parry at size 1, as interleaved ratios of CPU time.
//!
//! Both codes see the same pairs in the same order: random poses, 0 to 5 % of the size apart; warm questions begin with what the answer left when the second
//! body was a thousandth of its size and of a radian away. Parry is given its
//! relative pose and its shapes beforehand, ours is given world poses. Coal is measured by `benchmarks/peers/coal`, in its own process.

use std::hint::black_box;
use std::sync::Arc;

use benchmarks::pairs::compare;
use solver::Vector;
use solver::contact::detect::{OneSided, PlacedSurface, VertexSurface, vertex_pair};
use solver::distance::{Guess, Pose, Query, Relative, RoundedCore, Separation, separation};
use solver::shape::superellipsoid::vertices::Spacing;
use solver::shape::{Convex, Cuboid, Cylinder, ParryPair, Superellipsoid};
use verification::cases::pair_distance::poses::{Random, random_pair};

const QUESTIONS: usize = 2000;
const PAIRS: usize = 40;

/// One question to both codes.
struct Question {
    first: Pose,
    second: Pose,
    guess: Guess,
    /// The same in the frame of the first, in which parry is asked.
    guess_in_first: Vector,
    parry: ParryPair,
}

fn main() {
    let cube = Convex::Cuboid(Cuboid { lengths: Vector::repeat(1.0) });
    let cylinder = Convex::Cylinder(Cylinder { radius: 0.5, length: 1.0 });
    println!("ratio of CPU time [95 % interval] x cost of the base for {QUESTIONS} questions");
    for (name, first, second) in [("cubes", &cube, &cube), ("cylinders", &cylinder, &cylinder), ("cube and cylinder", &cube, &cylinder)] {
        let questions = questions(first, second);
        let cores = [RoundedCore::sharp(first), RoundedCore::sharp(second)];
        let parry = |is_warm: bool| {
            let questions = &questions;
            move || {
                questions.iter().for_each(|question| {
                    black_box(question.parry.distance(is_warm.then_some(&question.guess_in_first)));
                })
            }
        };
        let ours = |is_warm: bool| {
            let (questions, cores) = (&questions, &cores);
            move || {
                questions.iter().for_each(|question| {
                    black_box(ask(cores, question, is_warm));
                })
            }
        };
        let show = |what: &str, ratio: benchmarks::pairs::Ratio| {
            println!("{name}, {what:<40} {ratio}, {:.0} ns a question of the base", ratio.base_cpu_s * 1e9 / QUESTIONS as f64);
        };
        show("parry cold over ours cold", compare(ours(false), parry(false), PAIRS));
        show("parry warm over ours warm", compare(ours(true), parry(true), PAIRS));
        show("ours cold over ours warm", compare(ours(true), ours(false), PAIRS));
        show("ours warm over ours warm", compare(ours(true), ours(true), PAIRS));
    }
    superellipsoids();
}

/// Smooth surfaces, cold and warm, and vertices, for pairs that overlap by a hundredth of the size. No other code has them.
fn superellipsoids() {
    for (name, exponents) in [("ellipsoids", [1.0, 1.0]), ("exponents 0.6 and 1.3", [0.6, 1.3]), ("cylinders (0.1, 1)", [0.1, 1.0])] {
        let shape = Superellipsoid::new(Vector::new(1.0, 0.7, 0.5), exponents).expect("axes and exponents are in range");
        let core = RoundedCore::sharp(&Convex::Superellipsoid(Arc::new(shape.clone())));
        let surface = VertexSurface { vertices: shape.vertices(20, Spacing::Linear), shape: Arc::new(shape) };
        let pairs = overlapping_pairs(&core);
        let smooth = |is_warm: bool| {
            let (pairs, core) = (&pairs, &core.core);
            move || {
                pairs.iter().for_each(|(first, second, guess)| {
                    let query = Query { guess: is_warm.then_some(*guess), cutoff: f64::INFINITY };
                    black_box(separation((core, first), (core, second), &query));
                })
            }
        };
        let vertices = || {
            let mut touches = Vec::new();
            for (first, second, guess) in &pairs {
                touches.clear();
                let placed = |pose: &Pose| PlacedSurface { surface: &surface, pose: *pose, centre_of_body: pose.position };
                black_box(vertex_pair(&placed(first), &placed(second), Some(guess.direction), OneSided::Resolved, &mut touches));
            }
        };
        let show = |what: &str, ratio: benchmarks::pairs::Ratio| {
            println!("{name}, {what:<40} {ratio}, {:.0} ns a contact of the base", ratio.base_cpu_s * 1e9 / QUESTIONS as f64);
        };
        show("smooth cold over smooth warm", compare(smooth(true), smooth(false), PAIRS));
        show("400 vertices over smooth warm", compare(smooth(true), vertices, PAIRS));
        show("smooth warm over 400 vertices", compare(vertices, smooth(true), PAIRS));
    }
}

/// Random pairs of a shape that overlap by a hundredth of its size, each with what the step before has left, a fiftieth of the overlap away.
fn overlapping_pairs(rounded: &RoundedCore) -> Vec<(Pose, Pose, Guess)> {
    let mut random = Random::new(3);
    (0..QUESTIONS)
        .map(|_| {
            let pair = random_pair(&mut random, [rounded, rounded], 1.0, 0.0);
            let near = |moved: f64| Pose { position: pair.second.position - pair.guess.direction * (pair.gap + moved), ..pair.second };
            let before = separation((&rounded.core, &pair.first), (&rounded.core, &near(0.01 - 2e-4)), &Query::cold());
            (pair.first, near(0.01), before.guess())
        })
        .collect()
}

fn ask(cores: &[RoundedCore; 2], question: &Question, is_warm: bool) -> Separation {
    let query = Query { guess: is_warm.then_some(question.guess), cutoff: f64::INFINITY };
    separation((&cores[0].core, &question.first), (&cores[1].core, &question.second), &query)
}

fn questions(first: &Convex, second: &Convex) -> Vec<Question> {
    let mut random = Random::new(1);
    let cores = [RoundedCore::sharp(first), RoundedCore::sharp(second)];
    (0..QUESTIONS)
        .map(|_| {
            let pair = random_pair(&mut random, [&cores[0], &cores[1]], 1.0, 0.0);
            let Relative { rotation, position } = Relative::new(&pair.first, &pair.second);
            let parry = ParryPair::new(first, second, &rotation, &position).expect("parry has boxes and cylinders");
            let guess_in_first = pair.first.rotation.tr_mul(&pair.guess.direction);
            Question { first: pair.first, second: pair.second, guess: pair.guess, guess_in_first, parry }
        })
        .collect()
}
