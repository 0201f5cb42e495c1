//! Contacts at the ends of their range: scales, stiffnesses, mass and size ratios, depths, places far off, and frames.

mod page;
mod scenes;

use reports::row::ReferenceKind;
use solver::Vector;

use crate::case::{Case, Description, Failure, Measurement, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::variant::Variant;
use scenes::{Collision, Frame, Outcome};

use super::soft_spheres::vanishing;

/// The case.
pub struct StabilityContacts;

const SCALED: &str = "change of the scaled velocities and spins after the collision";
const EXIT: &str = "relative error of the exit speed";
const MOMENTUM: &str = "change of momentum / momentum";
const FRAME: &str = "difference from the collision in the first frame / speed";
const PINCHED: &str = "relative change of the speed of the expelled grain with a step of a tenth";

/// One setup. Numbers are those of the stability tests in the field's lists: S02, S22, S04, S12, S21, S23, S05.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Extreme {
    /// The knob is the factor of the stiffness.
    Stiffness,
    /// The knob is the factor of all lengths.
    Size,
    /// The knob is the ratio of the masses.
    MassRatio,
    /// The knob is the overlap over the diameter from which two spheres spring apart.
    Depth,
    /// The knob is the distance of the collision from the origin, in diameters.
    FarOrigin,
    /// The knob is the number of a frame.
    Frames,
    /// A grain pinched by two large spheres; the knob is the ratio of the sizes.
    Pinch,
}

impl Variant for Extreme {
    fn all() -> Vec<Extreme> {
        use Extreme::{Depth, FarOrigin, Frames, MassRatio, Pinch, Size, Stiffness};
        vec![Stiffness, Size, MassRatio, Depth, FarOrigin, Frames, Pinch]
    }

    fn label(&self) -> String {
        match self {
            Extreme::Stiffness => "stiffness (S02)",
            Extreme::Size => "size (S22)",
            Extreme::MassRatio => "mass ratio (S04)",
            Extreme::Depth => "deep overlap (S12)",
            Extreme::FarOrigin => "far from the origin (S21)",
            Extreme::Frames => "moving, turned, mirrored and swapped (S23)",
            Extreme::Pinch => "grain pinched by two large ones (S05)",
        }
        .into()
    }

    fn knob_name(&self) -> &'static str {
        match self {
            Extreme::Stiffness => "stiffness_factor",
            Extreme::Size => "size_factor",
            Extreme::MassRatio => "mass_ratio",
            Extreme::Depth => "overlap_of_diameter",
            Extreme::FarOrigin => "distance_in_diameters",
            Extreme::Frames => "frame",
            Extreme::Pinch => "size_ratio",
        }
    }

    fn knobs(&self, _tier: Tier) -> Vec<f64> {
        match self {
            Extreme::Stiffness => vec![1e-3, 0.1, 7.0, 1e3, 1e5, 1e7],
            Extreme::Size => vec![1e-7, 1e-4, 0.03, 50.0, 1e4, 1e8],
            Extreme::MassRatio => vec![1.0, 1e3, 1e6, 1e9],
            Extreme::Depth => vec![0.01, 0.1, 0.5, 0.9, 0.999],
            Extreme::FarOrigin => vec![1.0, 1e3, 1e6],
            Extreme::Frames => vec![1.0, 2.0, 3.0, 4.0],
            Extreme::Pinch => vec![1.0, 3.0, 10.0, 30.0, 100.0],
        }
    }
}

impl Extreme {
    /// Smallest error that means anything.
    fn floor(self, knob: f64) -> f64 {
        match self {
            Extreme::Stiffness | Extreme::Size | Extreme::Frames => scenes::overlap_rounding(0.0),
            Extreme::FarOrigin => scenes::overlap_rounding(knob),
            // What the straight edges of a contact neglect, and the phase of leapfrog between them.
            Extreme::MassRatio => (std::f64::consts::PI / scenes::MANY_STEPS).powi(4) / 24.0,
            Extreme::Depth => (std::f64::consts::PI / scenes::MANY_STEPS).powi(2) / 24.0,
            // Three contacts of some fifty steps, each of second order.
            Extreme::Pinch => (std::f64::consts::PI / scenes::STEPS).powi(2),
        }
    }

    fn floor_is(self) -> &'static str {
        match self {
            Extreme::Stiffness | Extreme::Size | Extreme::Frames => "rounding of places in an overlap, at every step",
            Extreme::FarOrigin => "rounding of places so far off in an overlap, at every step",
            Extreme::MassRatio => "(angle of a step)^4 / 24, what straight edges of a contact neglect",
            Extreme::Depth => "(angle of a step)^2 / 24, the phase of leapfrog where it starts at the turning point",
            Extreme::Pinch => "(angle of a step)^2 of a contact of the grain",
        }
    }
}

/// Largest difference of scaled velocities and spins.
fn difference(one: &Outcome, other: &Outcome) -> f64 {
    let pairs = one.velocities.iter().zip(&other.velocities).chain(one.spins.iter().zip(&other.spins));
    pairs.map(|(one, other)| (one - other).norm()).fold(0.0, f64::max)
}

impl Case for StabilityContacts {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let extreme = Extreme::of(setup)?;
        let floor = extreme.floor(knob);
        let exact = |name, value, source: &str| vanishing(name, "1", vec![value], floor, ReferenceKind::Exact, source);
        let quantities = match extreme {
            Extreme::Stiffness | Extreme::Size => {
                let plain = Collision::default();
                let scaled =
                    if extreme == Extreme::Size { Collision { size: knob, ..plain } } else { Collision { stiffness: knob, ..plain } };
                vec![exact(SCALED, difference(&scaled.run()?, &plain.run()?), "dimensional analysis")]
            }
            Extreme::FarOrigin => {
                let there =
                    Collision { frame: Frame { shift: Vector::new(0.6, 0.0, 0.8) * knob, ..Frame::default() }, ..Collision::default() };
                vec![exact(FRAME, difference(&there.run()?, &Collision::default().run()?), "places have no origin")]
            }
            Extreme::Frames => {
                let there = Collision { frame: Frame::numbered(knob as usize), ..Collision::default() };
                vec![exact(FRAME, difference(&there.run()?, &Collision::default().run()?), "Galilean invariance, mirror and exchange")]
            }
            Extreme::MassRatio => {
                let [exit, momentum] = scenes::unequal_masses(knob)?;
                let momentum = vanishing(MOMENTUM, "1", vec![momentum], MOMENTUM_FLOOR, ReferenceKind::Exact, "conservation of momentum");
                vec![exact(EXIT, exit, "conservation of momentum and energy"), momentum]
            }
            Extreme::Depth => vec![exact(EXIT, scenes::sprung_apart(knob)?, "energy of the spring")],
            Extreme::Pinch => {
                let [coarse, fine] = [scenes::pinched(knob, scenes::STEPS)?, scenes::pinched(knob, 10.0 * scenes::STEPS)?];
                let source = "the same with a step of a tenth";
                vec![vanishing(PINCHED, "1", vec![coarse / fine - 1.0], floor, ReferenceKind::OwnFine, source)]
            }
        };
        Ok(Measurement { quantities, runs: 2, ..Measurement::default() })
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        Extreme::claims(tier, |extreme, knob| {
            let bound = Bound::new(10.0, extreme.floor(knob), extreme.floor_is());
            let claim = |quantity, bound| extreme.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
            match extreme {
                Extreme::Stiffness | Extreme::Size => vec![claim(SCALED, bound)],
                Extreme::FarOrigin | Extreme::Frames => vec![claim(FRAME, bound)],
                Extreme::MassRatio => {
                    let rounding = Bound::new(4.0, MOMENTUM_FLOOR, "rounding of the momentum at each step, at random");
                    vec![claim(EXIT, bound), claim(MOMENTUM, rounding)]
                }
                Extreme::Depth => vec![claim(EXIT, bound)],
                Extreme::Pinch => vec![claim(PINCHED, bound)],
            }
        })
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<solver::Scene> {
        let scene = match Extreme::of(setup).ok()? {
            Extreme::Stiffness => Collision { stiffness: knob, ..Collision::default() }.scene(),
            Extreme::Size => Collision { size: knob, ..Collision::default() }.scene(),
            Extreme::MassRatio => scenes::unequal_pair(knob),
            Extreme::Depth => scenes::overlapping_pair(knob),
            Extreme::FarOrigin => {
                Collision { frame: Frame { shift: Vector::x() * knob, ..Frame::default() }, ..Collision::default() }.scene()
            }
            Extreme::Frames => Collision { frame: Frame::numbered(knob as usize), ..Collision::default() }.scene(),
            Extreme::Pinch => scenes::pinch(knob, scenes::STEPS),
        };
        Some(scene)
    }

    fn description(&self) -> Description {
        page::description()
    }
}

/// Rounding of a momentum at each of some hundred steps.
const MOMENTUM_FLOOR: f64 = 16.0 * f64::EPSILON;
