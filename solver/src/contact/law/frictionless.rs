//! No tangential force.

use super::{ContactScale, StepKind, TangentialContact, TangentialLaw, TimeScales};
use crate::Vector;

/// No tangential force: needs no rotation and no memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frictionless;

impl TangentialLaw for Frictionless {
    type History = ();
    const NEEDS_ROTATION: bool = false;
    const NAME: &'static str = "frictionless";

    #[inline(always)]
    fn mean_force(&self, _contact: &TangentialContact, _kind: &StepKind, _history: &mut ()) -> Vector {
        Vector::zeros()
    }

    fn stored_energy(&self, _history: &(), _share: f64) -> f64 {
        0.0
    }

    fn time_scales(&self, _contact: &ContactScale) -> TimeScales {
        TimeScales::NONE
    }
}
