//! The vortices of Taylor and Green.

use reports::row::ReferenceKind;
use solver::Vector;
use solver::fluid::grid::Grid;
use solver::fluid::navier_stokes::{Flow, Fluid, Numerics};
use solver::fluid::sides::Sides;

use super::{Error, ON_GRID, PRESSURE, VELOCITY, Variant, divergence, error, errors, measurement, no_divergence, run};
use crate::case::Measurement;
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::exact::taylor_green_vortex::TaylorGreenVortex;
use crate::variant::Variant as _;

/// How long a step is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StepRule {
    /// A Courant number of about 0.2.
    WithSpacing,
    /// The same for all grids.
    Fixed,
}

/// A setup.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Vortex {
    is_source: bool,
    step: StepRule,
}

pub(super) const ALL: [Vortex; 3] = [
    Vortex { is_source: false, step: StepRule::WithSpacing },
    Vortex { is_source: true, step: StepRule::WithSpacing },
    Vortex { is_source: false, step: StepRule::Fixed },
];

const EXACT: TaylorGreenVortex = TaylorGreenVortex { viscosity: 0.05 };
const END_TIME: f64 = 2.0;
const FIXED_STEPS: usize = 50;

impl Vortex {
    pub(super) fn label(self) -> String {
        let scheme = if self.is_source { "scheme of R" } else { "Runge-Kutta (default)" };
        let step = if self.step == StepRule::Fixed { "step fixed" } else { "step with the spacing" };
        format!("Taylor-Green vortices, {scheme}, {step}")
    }

    pub(super) fn measure(self, cells: usize) -> Result<Measurement, Error> {
        let spacing = 2.0 * std::f64::consts::PI / cells as f64;
        let numerics = if self.is_source { Numerics::SOURCE } else { Numerics::default() };
        let fluid = Fluid { density: 1.0, viscosity: EXACT.viscosity };
        let mut flow = Flow::new(Grid::new([cells, cells, 4], spacing, Vector::zeros())?, Sides::PERIODIC, fluid, numerics)?;
        flow.set(|component, place| EXACT.velocity(component, &place, 0.0), |place| EXACT.pressure(&place, 0.0));
        let steps = if self.step == StepRule::Fixed { FIXED_STEPS } else { (END_TIME / (0.2 * spacing)).round() as usize };
        run(&mut flow, END_TIME, steps, None)?;
        let found = errors(
            &flow,
            |component, place| EXACT.velocity(component, place, flow.time()),
            |place| EXACT.pressure(place, flow.pressure_time()),
            true,
        );
        let step = END_TIME / steps as f64;
        let stages: &[f64] = if self.is_source { &[1.0] } else { &[8.0 / 15.0, 2.0 / 15.0, 1.0 / 3.0] };
        let decay = stages.iter().map(|share| EXACT.decay_on_grid(spacing, share * step)).product::<f64>().powi(steps as i32);
        let on_grid = errors(&flow, |component, place| EXACT.velocity(component, place, 0.0) * decay, |_| 1.0, false);
        let rounding = f64::EPSILON * steps as f64;
        let closed = "closed form of Taylor and Green";
        let quantities = vec![
            error(VELOCITY, vec![found.velocity], rounding, ReferenceKind::Exact, closed),
            error(PRESSURE, vec![found.pressure], rounding, ReferenceKind::Exact, closed),
            error(ON_GRID, vec![on_grid.velocity], rounding, ReferenceKind::Exact, "closed form of the decay on the grid"),
            divergence(&flow),
        ];
        Ok(measurement(quantities, &flow, steps))
    }

    pub(super) fn claims_at(self, variant: &Variant, knob: f64) -> Vec<Claim> {
        let square = (2.0 * std::f64::consts::PI / knob).powi(2);
        // The Laplacian on the grid is smaller by one part in 12/h^2; the mean of neighbours in the fluxes by h^2/8 each.
        let slower = 2.0 * EXACT.viscosity * END_TIME * square / 12.0;
        let claim = |quantity, factor, floor, floor_is: &str| {
            variant.claim_at(knob, quantity, Statistic::Single, Bound::new(factor, floor, floor_is), Expected::Holds)
        };
        vec![
            claim(VELOCITY, 2.0, slower, "2 nu T h^2/12, by which vortices on the grid decay later"),
            claim(PRESSURE, 2.0, 2.0 * slower + square / 4.0, "twice that of the velocity, and h^2/4 of the means in the fluxes"),
            claim(ON_GRID, 10.0, f64::EPSILON * FIXED_STEPS as f64, "rounding of fifty steps"),
            no_divergence(variant, knob),
        ]
    }
}
