//! Regions that bodies leave the simulation by.

use serde::{Deserialize, Serialize};

use crate::Vector;

/// A region that takes out every body whose centre comes into it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outlet {
    /// Everything on the side of a plane that its normal points away from.
    Behind {
        /// A point of the plane in m.
        point: Vector,
        /// Unit normal towards the side where bodies stay.
        normal: Vector,
    },
    /// A box.
    Box {
        /// Lower corner in m.
        lower: Vector,
        /// Upper corner in m.
        upper: Vector,
    },
}

impl Outlet {
    /// Its form in words, for ledgers.
    pub fn name(&self) -> &'static str {
        match self {
            Outlet::Behind { .. } => "everything behind a plane",
            Outlet::Box { .. } => "everything in a box",
        }
    }

    /// Whether a point is in it. The border belongs to the side where bodies stay.
    #[inline]
    pub fn holds(&self, place: &Vector) -> bool {
        match self {
            Outlet::Behind { point, normal } => (place - point).dot(normal) < 0.0,
            Outlet::Box { lower, upper } => (0..3).all(|axis| lower[axis] < place[axis] && place[axis] < upper[axis]),
        }
    }
}

/// A body that has left.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// Its id, which no other body gets.
    pub id: u32,
    /// Index of the outlet.
    pub outlet: u32,
    /// End in s of the step in which its centre came into the outlet.
    pub time: f64,
    /// In kg.
    pub mass: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_belong_to_the_side_where_bodies_stay() {
        let behind = Outlet::Behind { point: Vector::new(5.0, 1.0, -3.0), normal: Vector::new(0.0, 0.6, 0.8) };
        assert!(behind.holds(&Vector::new(0.0, 0.9, -3.0)) && !behind.holds(&Vector::new(0.0, 1.1, -3.0)));
        assert!(!behind.holds(&Vector::new(-7.0, 1.0, -3.0)));
        let bin = Outlet::Box { lower: Vector::zeros(), upper: Vector::new(1.0, 2.0, 3.0) };
        assert!(bin.holds(&Vector::new(0.5, 1.9, 2.9)) && !bin.holds(&Vector::new(0.5, 1.9, 3.1)));
        assert!(!bin.holds(&Vector::new(0.5, 2.0, 1.0)) && !bin.holds(&Vector::new(f64::NAN, 1.0, 1.0)));
    }
}
