//! Manufactured flows: one for each kind of side.

use reports::row::ReferenceKind;
use solver::Vector;
use solver::fluid::grid::Grid;
use solver::fluid::navier_stokes::{Flow, Fluid, Numerics};
use solver::fluid::sides::{Ends, Side, Sides};

use super::{Error, PRESSURE, VELOCITY, Variant, divergence, error, errors, measurement, no_divergence, run};
use crate::case::Measurement;
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::exact::manufactured_flow::{Kind, ManufacturedFlow};
use crate::variant::Variant as _;

/// A setup.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Manufactured {
    kind: Kind,
    /// Directions of the plane: all pairs occur.
    plane: [usize; 2],
    is_source: bool,
}

pub(super) const ALL: [Manufactured; 8] = [
    Manufactured { kind: Kind::Closed, plane: [0, 1], is_source: false },
    Manufactured { kind: Kind::MovingWall, plane: [1, 2], is_source: false },
    Manufactured { kind: Kind::FreeSlip, plane: [2, 0], is_source: false },
    Manufactured { kind: Kind::ThroughFlow, plane: [1, 0], is_source: false },
    Manufactured { kind: Kind::Closed, plane: [2, 1], is_source: true },
    Manufactured { kind: Kind::MovingWall, plane: [0, 2], is_source: true },
    Manufactured { kind: Kind::FreeSlip, plane: [0, 1], is_source: true },
    Manufactured { kind: Kind::ThroughFlow, plane: [2, 1], is_source: true },
];

pub(super) const VISCOSITY: f64 = 0.02;
pub(super) const END_TIME: f64 = 0.5;

impl Manufactured {
    pub(super) fn label(self) -> String {
        let kind = match self.kind {
            Kind::Closed => "walls all round",
            Kind::MovingWall => "a moving wall",
            Kind::FreeSlip => "free slip all round",
            Kind::ThroughFlow => "inlet and outlet",
        };
        format!("manufactured flow, {kind}, {}", if self.is_source { "scheme of R" } else { "Runge-Kutta (default)" })
    }

    pub(super) fn measure(self, cells: usize) -> Result<Measurement, Error> {
        let exact = ManufacturedFlow { kind: self.kind, plane: self.plane, viscosity: VISCOSITY };
        let mut flow = start(&exact, cells, if self.is_source { Numerics::SOURCE } else { Numerics::default() })?;
        run(&mut flow, END_TIME, cells, Some(&|component, place, time| exact.force(component, &place, time)))?;
        let is_free = self.kind != Kind::ThroughFlow;
        let (time, pressure_time) = (flow.time(), flow.pressure_time());
        let found =
            errors(&flow, |component, place| exact.velocity(component, place, time), |place| exact.pressure(place, pressure_time), is_free);
        let rounding = f64::EPSILON * cells as f64;
        let quantities = vec![
            error(VELOCITY, vec![found.velocity], rounding, ReferenceKind::Exact, "manufactured solution"),
            error(PRESSURE, vec![found.pressure], rounding, ReferenceKind::Exact, "manufactured solution"),
            divergence(&flow),
        ];
        Ok(measurement(quantities, &flow, cells))
    }
}

/// A manufactured flow at time zero, on so many cells along both directions of its plane.
pub(super) fn start(exact: &ManufacturedFlow, cells: usize, numerics: Numerics) -> Result<Flow, Error> {
    let mut shape = [4; 3];
    exact.plane.iter().for_each(|direction| shape[*direction] = cells);
    let grid = Grid::new(shape, 1.0 / cells as f64, Vector::zeros())?;
    let mut flow = Flow::new(grid, sides(exact)?, Fluid { density: 1.0, viscosity: exact.viscosity }, numerics)?;
    flow.set(|component, place| exact.velocity(component, &place, 0.0), |place| exact.pressure(&place, 0.0));
    Ok(flow)
}

fn sides(exact: &ManufacturedFlow) -> Result<Sides, Error> {
    let along = Vector::ith(exact.plane[0], 1.0);
    let (wall, slip) = (Ends::Sides([Side::REST; 2]), Ends::Sides([Side::FreeSlip; 2]));
    let of_plane = match exact.kind {
        Kind::Closed => [wall, wall],
        Kind::MovingWall => [Ends::Periodic, Ends::Sides([Side::REST, Side::Wall { velocity: along }])],
        Kind::FreeSlip => [slip, slip],
        Kind::ThroughFlow => [Ends::Sides([Side::Inlet { velocity: along }, Side::Outlet]), slip],
    };
    let mut ends = [Ends::Periodic; 3];
    for (direction, end) in exact.plane.iter().zip(of_plane) {
        ends[*direction] = end;
    }
    Ok(Sides::new(ends)?)
}

pub(super) fn claims_at(variant: &Variant, knob: f64) -> Vec<Claim> {
    let design = (2.0 * std::f64::consts::PI / knob).powi(2) / 12.0;
    let claim = |quantity, factor| {
        let bound = Bound::new(factor, design, "(k h)^2/12 of second differences of the shortest wave, of one wave length over the box");
        variant.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds)
    };
    vec![claim(VELOCITY, 6.0), claim(PRESSURE, 6.0), no_divergence(variant, knob)]
}
