//! Cost of the distance of two shapes, cold and warm, against parry at size 1, as interleaved ratios of CPU time.
//!
//! Both codes see the same pairs in the same order: random poses, 0 to 5 % of the size apart; warm guesses are off by a thousandth. Parry is given its
//! relative pose and its shapes beforehand, ours is given world poses. Coal is measured by `benchmarks/peers/coal`, in its own process.

use std::hint::black_box;

use benchmarks::pairs::compare;
use solver::Vector;
use solver::distance::{Pose, Query, Relative, RoundedCore, Separation, separation};
use solver::shape::{Convex, Cuboid, Cylinder, ParryPair};

const QUESTIONS: usize = 2000;
const PAIRS: usize = 40;
const LARGEST_GAP: f64 = 0.05;
const GUESS_IS_OFF: f64 = 1e-3;

/// One question to both codes.
struct Question {
    first: Pose,
    second: Pose,
    guess: Vector,
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
}

fn ask(cores: &[RoundedCore; 2], question: &Question, is_warm: bool) -> Separation {
    let query = Query { guess: is_warm.then_some(question.guess), cutoff: f64::INFINITY };
    separation((&cores[0].core, &question.first), (&cores[1].core, &question.second), &query)
}

fn questions(first: &Convex, second: &Convex) -> Vec<Question> {
    let mut random = Random(1);
    let cores = [RoundedCore::sharp(first), RoundedCore::sharp(second)];
    (0..QUESTIONS)
        .map(|_| {
            let own = Pose { position: random.vector(), rotation: random.rotation() };
            let far = Pose { position: own.position + random.vector().normalize() * 5.0, rotation: random.rotation() };
            let found = separation((&cores[0].core, &own), (&cores[1].core, &far), &Query::cold());
            let gap = LARGEST_GAP * random.number();
            let other = Pose { position: far.position - found.normal * (found.distance - gap), ..far };
            let guess = found.normal + random.vector().normalize() * GUESS_IS_OFF;
            let Relative { rotation, position } = Relative::new(&own, &other);
            let parry = ParryPair::new(first, second, &rotation, &position).expect("parry has boxes and cylinders");
            Question { first: own, second: other, guess, guess_in_first: own.rotation.tr_mul(&guess), parry }
        })
        .collect()
}

/// Random numbers by SplitMix64.
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Even in a cube about the origin.
    fn vector(&mut self) -> Vector {
        Vector::from_fn(|_, _| 2.0 * self.number() - 1.0)
    }

    /// About a random axis by a random angle.
    fn rotation(&mut self) -> nalgebra::Matrix3<f64> {
        let axis = nalgebra::Unit::new_normalize(self.vector());
        *nalgebra::Rotation3::from_axis_angle(&axis, std::f64::consts::TAU * self.number()).matrix()
    }
}
