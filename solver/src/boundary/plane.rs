//! An infinite flat wall.

use crate::Vector;

/// A flat wall at rest: bodies live on the side its normal points to.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Any point of the wall, in m.
    pub point: Vector,
    /// Unit normal, out of the wall into the space where bodies are.
    pub normal: Vector,
}

impl Plane {
    /// Height of a point above the wall in m; negative inside the wall.
    #[inline]
    pub fn height(&self, point: &Vector) -> f64 {
        (point - self.point).dot(&self.normal)
    }
}
