//! Random pairs of superellipsoids.

use solver::Vector;
use solver::distance::{Core, Pose, Query, RoundedCore, separation};
use solver::shape::{Convex, Superellipsoid};
use std::sync::Arc;

use crate::case::Failure;
use crate::cases::pair_distance::poses::Random;
use crate::exact::superellipsoid_twin::Placed;

/// Of what kind both shapes of a pair are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Balls, as in S table 4-6.
    Balls,
    /// Ellipsoids of aspect up to ten.
    Ellipsoids,
    /// The cylinders of S section 4.1.1.
    Cylinders,
    /// Exponents from 0.1 to 1.9, aspect up to ten.
    General,
}

impl Kind {
    pub const ALL: [Kind; 4] = [Kind::Balls, Kind::Ellipsoids, Kind::Cylinders, Kind::General];

    pub fn name(self) -> &'static str {
        match self {
            Kind::Balls => "balls",
            Kind::Ellipsoids => "ellipsoids",
            Kind::Cylinders => "cylinders (0.1, 1)",
            Kind::General => "exponents 0.1 to 1.9",
        }
    }

    fn numbers(self, random: &mut Random) -> ([f64; 3], [f64; 2]) {
        // Evenly in the logarithm of the aspect.
        let mut axes = || [1.0, 10.0_f64.powf(-random.number()), 10.0_f64.powf(-random.number())];
        match self {
            Kind::Balls => ([1.0; 3], [1.0; 2]),
            Kind::Ellipsoids => (axes(), [1.0; 2]),
            Kind::Cylinders => ([1.0, 1.0, 0.6625], [0.1, 1.0]),
            Kind::General => (axes(), [0.1 + 1.8 * random.number(), 0.1 + 1.8 * random.number()]),
        }
    }
}

/// Two bodies, far apart, and the direction in which the second comes near.
pub struct Pair {
    pub cores: [RoundedCore; 2],
    pub twins: [Placed; 2],
    pub first: Pose,
    /// Scale of both: their bounding radii together.
    pub size: f64,
    /// By how much a body moves in a step, over the size.
    pub step: Vector,
    far: Pose,
    way: Vector,
    distance: f64,
}

impl Pair {
    /// Unit direction from the first body to the second along which they come near: the common normal at every gap, and at overlaps that are small beside
    /// the radii of curvature.
    pub fn normal(&self) -> Vector {
        self.way
    }

    /// The second body moved along the line of nearest points to a gap in m, or an overlap if negative.
    pub fn second_at(&self, gap: f64) -> Pose {
        Pose { position: self.far.position - self.way * (self.distance - gap), ..self.far }
    }
}

/// By how much a body moves in a step, over the size: the overlap of a soft contact over its fifty steps.
const STEP: f64 = 2e-4;

/// A random pair.
///
/// # Errors
///
/// If the solver refuses the numbers of a shape.
pub fn pair(random: &mut Random, kind: Kind) -> Result<Pair, Failure> {
    let numbers = [kind.numbers(random), kind.numbers(random)];
    let shape = |(axes, exponents): ([f64; 3], [f64; 2])| {
        Superellipsoid::new(axes.into(), exponents).map_err(|error| Failure::NothingMeasured(error.to_string()))
    };
    let shapes = [shape(numbers[0])?, shape(numbers[1])?];
    let size: f64 = shapes.iter().map(Superellipsoid::bounding_radius).sum();
    let first = Pose { position: random.direction(), rotation: random.rotation() };
    let far = Pose { position: first.position + random.direction() * (2.0 * size), rotation: random.rotation() };
    let placed = |place: usize, pose: &Pose| Placed {
        semi_axes: numbers[place].0.into(),
        exponents: numbers[place].1,
        position: pose.position,
        rotation: pose.rotation,
    };
    let twins = [placed(0, &first), placed(1, &far)];
    let cores = shapes.map(|shape| RoundedCore::sharp(&Convex::Superellipsoid(Arc::new(shape))));
    let [one, other]: [&Core; 2] = [&cores[0].core, &cores[1].core];
    let found = separation((one, &first), (other, &far), &Query::cold());
    let step = random.direction() * STEP;
    Ok(Pair { twins, first, size, step, far, way: found.normal, distance: found.distance, cores })
}
