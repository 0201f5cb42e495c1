//! Poses of pairs: random ones a small gap apart, and those in which two shapes touch in a special way.

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};
use solver::distance::{Guess, Pose, Query, RoundedCore, separation};

use super::kinds::Kind;

/// Largest gap of a random pair, relative to size.
const LARGEST_GAP: f64 = 0.05;

/// Random numbers by SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(u64);

impl Random {
    /// A sequence of its own for every seed.
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15))
    }

    /// Even in [0, 1).
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Even on the unit sphere.
    pub fn direction(&mut self) -> Vector3<f64> {
        let (height, angle) = (2.0 * self.number() - 1.0, std::f64::consts::TAU * self.number());
        let across = (1.0 - height * height).sqrt();
        Vector3::new(across * angle.cos(), across * angle.sin(), height)
    }

    /// Even over all rotations (Shoemake 1992).
    pub fn rotation(&mut self) -> Matrix3<f64> {
        let [share, one, other] = [self.number(), std::f64::consts::TAU * self.number(), std::f64::consts::TAU * self.number()];
        let (a, b) = ((1.0 - share).sqrt(), share.sqrt());
        let quaternion = Quaternion::new(b * other.cos(), a * one.sin(), a * one.cos(), b * other.sin());
        *UnitQuaternion::new_normalize(quaternion).to_rotation_matrix().matrix()
    }
}

/// Two bodies in their places.
#[derive(Debug, Clone, Copy)]
pub struct PosedPair {
    /// The first body.
    pub first: Pose,
    /// The second body.
    pub second: Pose,
    /// What a look a step before has left.
    pub guess: Guess,
    /// Gap at which they were put, in m.
    pub gap: f64,
}

/// By how much a pair moves in a step, relative to size, and turns, in radians.
const STEP: f64 = 1e-3;

/// What a look at a pair has left, a step before the second body came to its place.
pub fn guess_a_step_before(random: &mut Random, cores: [&RoundedCore; 2], poses: [&Pose; 2], size: f64) -> Guess {
    let turn = Rotation3::new(random.direction() * STEP);
    let before = Pose { position: poses[1].position + random.direction() * (STEP * size), rotation: turn * poses[1].rotation };
    separation((&cores[0].core, poses[0]), (&cores[1].core, &before), &Query::cold()).guess()
}

/// A pair in random poses, put a random gap apart along the direction of their nearest points.
pub fn random_pair(random: &mut Random, cores: [&RoundedCore; 2], size: f64, offset: f64) -> PosedPair {
    let first = Pose { position: random.direction() * offset + random.direction() * size, rotation: random.rotation() };
    let reach: f64 = cores.iter().map(|rounded| rounded.core.reach() + rounded.radius).sum();
    let far = Pose { position: first.position + random.direction() * (2.0 * reach), rotation: random.rotation() };
    let found = separation((&cores[0].core, &first), (&cores[1].core, &far), &Query::cold());
    let gap = LARGEST_GAP * size * random.number();
    let way = found.distance - cores[0].radius - cores[1].radius - gap;
    let second = Pose { position: far.position - found.normal * way, ..far };
    let guess = guess_a_step_before(random, cores, [&first, &second], size);
    PosedPair { first, second, guess, gap }
}

/// A way in which two shapes touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// What it is called on pages.
    pub name: &'static str,
    /// Kind of the first body.
    pub first: Kind,
    /// Kind of the second body.
    pub second: Kind,
    /// Where the second lies from the first when both touch, over the size.
    offset: [f64; 3],
    /// Along which they part.
    direction: [f64; 3],
    /// Axis and angle in radians by which the second is turned from the first.
    turn: ([f64; 3], f64),
    /// Distance at no gap, over the size: zero but for coincident centres.
    pub distance: f64,
}

const QUARTER: f64 = std::f64::consts::FRAC_PI_2;
const X: [f64; 3] = [1.0, 0.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

const fn touch(name: &'static str, kind: Kind, offset: [f64; 3], direction: [f64; 3], turn: ([f64; 3], f64)) -> Touch {
    Touch { name, first: kind, second: kind, offset, direction, turn, distance: 0.0 }
}

/// Touches of every kind of feature with every other.
pub const TOUCHES: [Touch; 15] = [
    touch("cubes, face on face", Kind::Cube, Z, Z, (Z, 0.0)),
    touch("cubes, face on face, turned and aside", Kind::Cube, [0.3, 0.2, 1.0], Z, (Z, 0.5)),
    touch("cubes, edge on edge, crossed", Kind::Cube, [1.0, 0.0, 1.0], [1.0, 0.0, 1.0], ([1.0, 0.0, 1.0], QUARTER)),
    touch("cubes, edge along edge", Kind::Cube, [1.0, 0.3, 1.0], [1.0, 0.0, 1.0], (Z, 0.0)),
    touch("cubes, corner on corner", Kind::Cube, [1.0; 3], [1.0; 3], ([1.0; 3], 1.0)),
    touch("icosahedra, corner on corner", Kind::Icosahedron, [0.0, 0.5, GOLDEN], [0.0, 0.5, GOLDEN], (Z, 0.0)),
    touch("cylinders, side by side, parallel", Kind::Cylinder, [1.0, 0.0, 0.4], X, (Z, 0.0)),
    touch("cylinders, side on side, crossed", Kind::Cylinder, X, X, (X, QUARTER)),
    touch("cylinders, end on end, coaxial", Kind::Cylinder, Z, Z, (Z, 0.0)),
    touch("cylinders, end on end, aside", Kind::Cylinder, [0.4, 0.3, 1.0], Z, (Z, 0.0)),
    touch("cylinders, rim on rim", Kind::Cylinder, [1.0, 0.0, 1.0], [1.0, 0.0, 1.0], (Z, 0.0)),
    touch("rods, side by side, parallel", Kind::Rod, [0.1, 0.0, 0.4], X, (Z, 0.0)),
    Touch { second: Kind::Cylinder, ..touch("cylinder, side on the face of a cube", Kind::Cube, [0.0, 0.1, 1.0], Z, (X, QUARTER)) },
    Touch { distance: -1.0, ..touch("cubes, centre on centre", Kind::Cube, [0.0; 3], Z, (Z, 0.0)) },
    Touch { distance: -1.0, ..touch("cylinders, centre on centre", Kind::Cylinder, [0.0; 3], Z, (Z, 0.0)) },
];

/// Half the golden ratio: with one half, a corner of the icosahedron of edge 1.
const GOLDEN: f64 = 0.25 * (1.0 + 2.236_067_977_499_79);

/// Gaps, over the size: both sides of rounding, and far from it.
pub const GAPS: [f64; 9] = [0.0, 1e-16, -1e-16, 2.5e-16, -2.5e-16, 1e-15, -1e-15, 1e-12, 1e-6];

impl Touch {
    /// The gaps at which it is looked at: centres that coincide are not moved.
    pub fn gaps(&self) -> &'static [f64] {
        if self.distance < 0.0 { &GAPS[..1] } else { &GAPS }
    }

    /// The pair at a gap, all of it turned and moved at random.
    pub fn pair(&self, random: &mut Random, cores: [&RoundedCore; 2], size: f64, gap: f64) -> PosedPair {
        let world = random.rotation();
        let direction = Vector3::from(self.direction).normalize();
        let turn = Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::from(self.turn.0)), self.turn.1);
        let first = Pose { position: random.direction() * size, rotation: world };
        let from_first = (Vector3::from(self.offset) + direction * gap) * size;
        let second = Pose { position: first.position + world * from_first, rotation: world * turn.matrix() };
        let guess = guess_a_step_before(random, cores, [&first, &second], size);
        PosedPair { first, second, guess, gap: gap * size }
    }
}
