//! What bounds the fluid on each side of the box.

use crate::Vector;

/// What stands on one side of a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Side {
    /// A solid wall that the fluid sticks to. It moves along itself at a velocity in m/s.
    Wall {
        /// Zero for a wall at rest.
        velocity: Vector,
    },
    /// No flow through it and no shear on it: a plane of symmetry.
    FreeSlip,
    /// Fluid enters at a velocity in m/s.
    Inlet {
        /// Points into the box.
        velocity: Vector,
    },
    /// Fluid leaves: the velocity does not change along the normal, the pressure is zero.
    Outlet,
}

impl Side {
    /// A wall at rest.
    pub const REST: Side = Side::Wall { velocity: Vector::new(0.0, 0.0, 0.0) };

    fn velocity(&self) -> Option<Vector> {
        match self {
            Side::Wall { velocity } | Side::Inlet { velocity } => Some(*velocity),
            Side::FreeSlip | Side::Outlet => None,
        }
    }
}

/// How a box ends in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ends {
    /// It repeats.
    Periodic,
    /// A lower and an upper side.
    Sides([Side; 2]),
}

/// What a field does at a side: of a second-order equation, one condition each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Condition {
    /// Has this value on it.
    Given(f64),
    /// Does not change along the normal.
    Level,
}

/// How a box ends in all directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sides {
    ends: [Ends; 3],
}

/// Why sides make no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SidesError {
    /// A number that is none.
    #[error("direction {direction}: a velocity of {velocity:?} m/s; numbers must be finite")]
    NotFinite {
        /// 0, 1 or 2.
        direction: usize,
        /// As given.
        velocity: [f64; 3],
    },
    /// A wall that moves into or out of the box.
    #[error("direction {direction}: a wall that moves at {speed} m/s through itself; walls may only move along themselves")]
    MovesThrough {
        /// 0, 1 or 2.
        direction: usize,
        /// Component along the normal.
        speed: f64,
    },
    /// Fluid enters and cannot leave, or the other way round.
    #[error("direction {direction}: an inlet needs an outlet on the opposite side, and an outlet an inlet")]
    Unpaired {
        /// 0, 1 or 2.
        direction: usize,
    },
    /// More than one direction of through-flow.
    #[error("inlets in directions {0} and {1}; fluid may flow through in one direction only")]
    TwoInlets(usize, usize),
    /// An inlet out of which fluid is sucked.
    #[error("direction {direction}: an inlet at {speed} m/s into the box; it must be positive")]
    Suction {
        /// 0, 1 or 2.
        direction: usize,
        /// Component into the box.
        speed: f64,
    },
}

impl Sides {
    /// A box that repeats in all directions.
    pub const PERIODIC: Sides = Sides { ends: [Ends::Periodic; 3] };

    /// A closed box of walls at rest.
    pub const CLOSED: Sides = Sides { ends: [Ends::Sides([Side::REST; 2]); 3] };

    /// Sides from the ends of each direction.
    ///
    /// # Errors
    ///
    /// [`SidesError`] for velocities that are not finite, walls that move through themselves, and in- and outflow that do not match.
    pub fn new(ends: [Ends; 3]) -> Result<Sides, SidesError> {
        let mut inlet = None;
        for (direction, end) in ends.iter().enumerate() {
            let Ends::Sides(pair) = end else { continue };
            for (side, inwards) in pair.iter().zip([1.0, -1.0]) {
                check(side, direction, inwards)?;
            }
            match pair {
                [Side::Inlet { .. }, Side::Outlet] | [Side::Outlet, Side::Inlet { .. }] => match inlet {
                    Some(other) => return Err(SidesError::TwoInlets(other, direction)),
                    None => inlet = Some(direction),
                },
                [Side::Inlet { .. } | Side::Outlet, _] | [_, Side::Inlet { .. } | Side::Outlet] => {
                    return Err(SidesError::Unpaired { direction });
                }
                _ => {}
            }
        }
        Ok(Sides { ends })
    }

    /// How the box ends in a direction.
    pub fn ends(&self, direction: usize) -> Ends {
        self.ends[direction]
    }

    /// The same sides, all velocities zero.
    pub(super) fn at_rest(&self) -> Sides {
        let stop = |side: Side| match side {
            Side::Wall { .. } | Side::Inlet { .. } => Side::REST,
            other => other,
        };
        let of_ends = |ends: Ends| match ends {
            Ends::Sides(pair) => Ends::Sides(pair.map(stop)),
            Ends::Periodic => Ends::Periodic,
        };
        Sides { ends: self.ends.map(of_ends) }
    }

    /// What a field does on the lower and the upper side in a direction, if it does not repeat: a component of the velocity, or the pressure.
    pub(super) fn conditions(&self, component: Option<usize>, direction: usize) -> Option<[Condition; 2]> {
        let Ends::Sides(pair) = self.ends[direction] else { return None };
        let condition = |side: Side| match (component, side.velocity()) {
            (None, _) if side == Side::Outlet => Condition::Given(0.0),
            (None, _) => Condition::Level,
            (Some(component), Some(velocity)) => Condition::Given(velocity[component]),
            (Some(component), None) if component == direction && side == Side::FreeSlip => Condition::Given(0.0),
            (Some(_), None) => Condition::Level,
        };
        Some(pair.map(condition))
    }
}

fn check(side: &Side, direction: usize, inwards: f64) -> Result<(), SidesError> {
    let Some(velocity) = side.velocity() else { return Ok(()) };
    if velocity.iter().any(|value| !value.is_finite()) {
        return Err(SidesError::NotFinite { direction, velocity: velocity.into() });
    }
    let speed = velocity[direction];
    match side {
        Side::Wall { .. } if speed != 0.0 => Err(SidesError::MovesThrough { direction, speed }),
        Side::Inlet { .. } if speed * inwards <= 0.0 => Err(SidesError::Suction { direction, speed: speed * inwards }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along_first(pair: [Side; 2]) -> Result<Sides, SidesError> {
        Sides::new([Ends::Sides(pair), Ends::Periodic, Ends::Periodic])
    }

    #[test]
    fn sides_that_make_no_sense_are_refused() {
        let inlet = |speed| Side::Inlet { velocity: Vector::new(speed, 0.0, 0.0) };
        let wall = |velocity| Side::Wall { velocity };
        assert_eq!(along_first([inlet(1.0), Side::REST]), Err(SidesError::Unpaired { direction: 0 }));
        assert_eq!(along_first([Side::FreeSlip, Side::Outlet]), Err(SidesError::Unpaired { direction: 0 }));
        assert_eq!(along_first([inlet(1.0), inlet(-1.0)]), Err(SidesError::Unpaired { direction: 0 }));
        assert_eq!(along_first([Side::Outlet, Side::Outlet]), Err(SidesError::Unpaired { direction: 0 }));
        assert_eq!(along_first([inlet(-1.0), Side::Outlet]), Err(SidesError::Suction { direction: 0, speed: -1.0 }));
        assert_eq!(along_first([inlet(0.0), Side::Outlet]), Err(SidesError::Suction { direction: 0, speed: 0.0 }));
        assert_eq!(along_first([Side::Outlet, inlet(1.0)]), Err(SidesError::Suction { direction: 0, speed: -1.0 }));
        assert_eq!(along_first([wall(Vector::x()), Side::REST]), Err(SidesError::MovesThrough { direction: 0, speed: 1.0 }));
        assert!(matches!(along_first([wall(Vector::new(0.0, f64::NAN, 0.0)), Side::REST]), Err(SidesError::NotFinite { .. })));
        let through = |speed| Ends::Sides([Side::Inlet { velocity: Vector::repeat(speed) }, Side::Outlet]);
        assert_eq!(Sides::new([Ends::Periodic, through(1.0), through(1.0)]), Err(SidesError::TwoInlets(1, 2)));
        assert!(along_first([wall(Vector::y()), Side::FreeSlip]).is_ok() && along_first([inlet(2.0), Side::Outlet]).is_ok());
    }
}
