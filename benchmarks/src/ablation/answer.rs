//! Whether two runs end the same.

use solver::{Bodies, Simulation};

use super::crystal::{RADIUS, SPEED, SPIN};

/// How alike two ends must be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Agreement {
    /// In every bit of every position, velocity and spin.
    Bits,
    /// To a floor, by which rounding or a known error of method differ, times a factor.
    Floor {
        /// Largest difference that rounding or method explain, over the radius, the speed or the spin.
        floor: f64,
        /// At most ten.
        factor: f64,
        /// What the floor is.
        reason: &'static str,
    },
}

impl Agreement {
    /// The largest difference that is allowed.
    pub fn bound(&self) -> f64 {
        match self {
            Agreement::Bits => 0.0,
            Agreement::Floor { floor, factor, .. } => floor * factor,
        }
    }
}

/// The largest difference of positions over the radius, velocities over the speed and spins over the spin at the start.
pub fn difference(one: &Simulation, other: &Simulation) -> f64 {
    let (one, other) = (one.bodies(), other.bodies());
    assert_eq!(one.len(), other.len(), "the same bodies");
    let pairs = one.by_id().zip(other.by_id()).map(|(place, other_place)| difference_of(one, place, other, other_place));
    // A NaN must not hide behind a smaller number.
    pairs.fold(0.0, |largest, difference| if largest.is_nan() || difference <= largest { largest } else { difference })
}

fn difference_of(one: &Bodies, place: usize, other: &Bodies, other_place: usize) -> f64 {
    let moved = (one.position(place) - other.position(other_place)).norm() / RADIUS;
    let faster = (one.half_step_velocity(place) - other.half_step_velocity(other_place)).norm() / SPEED;
    let turned = (one.half_step_angular_velocity(place) - other.half_step_angular_velocity(other_place)).norm() / SPIN;
    moved.max(faster).max(turned) + 0.0 * (moved + faster + turned)
}
