//! No tangential force.

use super::{StepKind, TangentialContact, TangentialLaw};
use crate::Vector;

/// No tangential force: needs no rotation and no memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frictionless;

impl TangentialLaw for Frictionless {
    type History = ();
    const NEEDS_ROTATION: bool = false;
    const NAME: &'static str = "frictionless";

    fn mean_force(&self, _contact: &TangentialContact, _kind: &StepKind, _history: &mut ()) -> Vector {
        Vector::zeros()
    }

    fn stored_energy(&self, _history: &(), _share: f64) -> f64 {
        0.0
    }

    fn half_period(&self, _effective_mass: f64) -> f64 {
        f64::INFINITY
    }

    fn damping_time(&self, _effective_mass: f64, _reduced_mass: f64) -> f64 {
        f64::INFINITY
    }

    fn largest_step(&self, _effective_mass: f64, _reduced_mass: f64, _lagged_damping: bool) -> f64 {
        f64::INFINITY
    }
}
