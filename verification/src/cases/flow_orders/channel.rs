//! Steady flow between two walls: dragged along by one of them, or pushed.

use reports::row::ReferenceKind;
use solver::Vector;
use solver::fluid::grid::Grid;
use solver::fluid::navier_stokes::{Flow, Fluid, Numerics};
use solver::fluid::sides::{Ends, Side, Sides};

use super::{Error, ON_GRID, VELOCITY, Variant, error, errors, measurement, run};
use crate::case::Measurement;
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::variant::Variant as _;

/// Who moves the fluid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Channel {
    /// The upper wall.
    Couette,
    /// A force.
    Poiseuille,
}

pub(super) const ALL: [Channel; 2] = [Channel::Couette, Channel::Poiseuille];

/// Relaxation times of the slowest wave between the walls, in all: rounding is reached after 36.
const RELAXATIONS: f64 = 40.0;

impl Channel {
    pub(super) fn label(self) -> String {
        match self {
            Channel::Couette => "between walls of which one moves (Couette)".into(),
            Channel::Poiseuille => "pushed between walls (Poiseuille)".into(),
        }
    }

    /// The flow along the third direction between walls in the second, at rest to begin with.
    pub(super) fn measure(self, cells: usize) -> Result<Measurement, Error> {
        let along = Vector::z();
        let upper = if self == Channel::Couette { Side::Wall { velocity: along } } else { Side::REST };
        let sides = Sides::new([Ends::Periodic, Ends::Sides([Side::REST, upper]), Ends::Periodic])?;
        let spacing = 1.0 / cells as f64;
        let grid = Grid::new([4, cells, 4], spacing, Vector::zeros())?;
        let mut flow = Flow::new(grid, sides, Fluid { density: 1.0, viscosity: 1.0 }, Numerics::SOURCE)?;
        let end_time = RELAXATIONS / std::f64::consts::PI.powi(2);
        // Short enough that no wave is damped more slowly than the slowest.
        let steps = (end_time / (0.1 * spacing)).round() as usize;
        let push = |component: usize, _: Vector, _: f64| if component == 2 { 8.0 } else { 0.0 };
        run(&mut flow, end_time, steps, if self == Channel::Poiseuille { Some(&push) } else { None })?;
        let profile = |y: f64| match self {
            Channel::Couette => y,
            Channel::Poiseuille => 4.0 * y * (1.0 - y),
        };
        // Reflection about a wall adds a quarter of h^2 times half the curvature to a parabola, everywhere.
        let shift = if self == Channel::Poiseuille { spacing * spacing } else { 0.0 };
        let against = |shift: f64| {
            errors(&flow, |component, place| if component == 2 { profile(place.y) + shift } else { 0.0 }, |_| 1.0, false).velocity
        };
        let rounding = f64::EPSILON * steps as f64;
        let quantities = vec![
            error(VELOCITY, vec![against(0.0)], rounding, ReferenceKind::Exact, "closed form"),
            error(ON_GRID, vec![against(shift)], rounding, ReferenceKind::Exact, "closed form of the differences"),
        ];
        Ok(measurement(quantities, &flow, steps))
    }

    pub(super) fn claims_at(self, variant: &Variant, knob: f64) -> Vec<Claim> {
        let rounding = Bound::new(4.0, f64::EPSILON * 10.0 * RELAXATIONS * knob / 9.9, "rounding of each step");
        let mut claims = vec![variant.claim_at(knob, ON_GRID, Statistic::Single, rounding, Expected::Holds)];
        if self == Channel::Poiseuille {
            let bound = Bound::new(2.0, 1.0 / (knob * knob), "h^2, by which reflection lifts the parabola");
            claims.push(variant.claim_at(knob, VELOCITY, Statistic::Single, bound, Expected::Holds));
        }
        claims
    }
}
