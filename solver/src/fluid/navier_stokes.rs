//! The Navier-Stokes equations of an incompressible fluid, step by step in a box with any sides (R eq. 7.1, 7.5, 7.9-7.11).

use super::border::Border;
use super::grid::Grid;
use super::projection::{Coupling, Factors, Projection};
use super::sides::Sides;
use super::stencils::{self, Velocity};
use crate::Vector;

/// A fluid of constant density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fluid {
    /// In kg/m^3.
    pub density: f64,
    /// In Pa s; zero for a fluid without friction.
    pub viscosity: f64,
}

/// How the flow carries itself in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Advection {
    /// None: creeping flow that takes its time.
    Creeping,
    /// Two old rates, extrapolated (R eq. 7.9); the first step is Euler's. Of second order.
    AdamsBashforth,
    /// Three stages with the memory of one (Wray; Spalart, Moser and Rogers 1991). Of third order in advection, second in all.
    RungeKutta,
}

/// How friction enters a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Diffusion {
    /// The mean of before and after: Crank and Nicolson. No limit to the step.
    Implicit,
    /// Like advection.
    Explicit,
}

/// How time is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numerics {
    /// Advection.
    pub advection: Advection,
    /// Friction.
    pub diffusion: Diffusion,
    /// Velocity and pressure.
    pub coupling: Coupling,
}

impl Numerics {
    /// R's scheme.
    pub const SOURCE: Numerics =
        Numerics { advection: Advection::AdamsBashforth, diffusion: Diffusion::Implicit, coupling: Coupling::Projected };
}

impl Default for Numerics {
    fn default() -> Numerics {
        Numerics { advection: Advection::RungeKutta, ..Numerics::SOURCE }
    }
}

/// Why a flow cannot be made or cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FlowError {
    /// No density.
    #[error("a density of {0} kg/m^3; it must be a positive number")]
    Density(f64),
    /// No viscosity.
    #[error("a viscosity of {0} Pa s; it must be a number and not negative")]
    Viscosity(f64),
    /// No duration.
    #[error("a step of {0} s; it must be a positive number")]
    Step(f64),
    /// The flow is no longer finite: the step was too long.
    #[error("the flow blew up at {time} s: a Courant number of {courant:.3}, and {diffusion:.3} for explicit friction")]
    BlewUp {
        /// In s, at the end of the step.
        time: f64,
        /// Courant number at the start of the step.
        courant: f64,
        /// Step times viscosity over density and the square of the spacing.
        diffusion: f64,
    },
}

/// Density of a force in N/m^3: a component at a place in m at a time in s.
pub type Force<'a> = &'a (dyn Fn(usize, Vector, f64) -> f64 + Sync);

/// A flow and its time.
#[derive(Debug, Clone)]
pub struct Flow {
    border: Border,
    fluid: Fluid,
    numerics: Numerics,
    projection: Projection,
    velocity: Velocity,
    pressure: Vec<f64>,
    /// Explicit rates of the stage before in m/s^2.
    last: Option<[Vec<f64>; 3]>,
    time: f64,
    pressure_time: f64,
}

/// Weights of the present and of the last explicit rates in each stage, in shares of the step.
const STAGES: [(f64, f64); 3] = [(8.0 / 15.0, 0.0), (5.0 / 12.0, -17.0 / 60.0), (3.0 / 4.0, -5.0 / 12.0)];

impl Flow {
    /// A fluid at rest.
    ///
    /// # Errors
    ///
    /// [`FlowError`] for a density or viscosity that is none.
    pub fn new(grid: Grid, sides: Sides, fluid: Fluid, numerics: Numerics) -> Result<Flow, FlowError> {
        if !(fluid.density.is_finite() && fluid.density > 0.0) {
            return Err(FlowError::Density(fluid.density));
        }
        if !(fluid.viscosity.is_finite() && fluid.viscosity >= 0.0) {
            return Err(FlowError::Viscosity(fluid.viscosity));
        }
        let border = Border::new(grid, sides);
        let mut flow = Flow {
            border,
            fluid,
            numerics,
            projection: Projection::new(border),
            velocity: std::array::from_fn(|_| border.zeros()),
            pressure: border.zeros(),
            last: None,
            time: 0.0,
            pressure_time: 0.0,
        };
        flow.set(|_, _| 0.0, |_| 0.0);
        Ok(flow)
    }

    /// Sets velocity in m/s and pressure in Pa from their positions in m, and takes the divergence away that is left on the grid.
    pub fn set(&mut self, velocity: impl Fn(usize, Vector) -> f64, pressure: impl Fn(Vector) -> f64) {
        for component in 0..3 {
            let grid = *self.border.grid();
            self.border
                .set(Some(component), &mut self.velocity[component], |cell| velocity(component, position(&grid, Some(component), cell)));
        }
        let grid = *self.border.grid();
        self.border.set(None, &mut self.pressure, |cell| pressure(position(&grid, None, cell)));
        self.projection.project(&mut self.velocity);
        self.last = None;
    }

    /// One step in s.
    ///
    /// # Errors
    ///
    /// [`FlowError::Step`], and [`FlowError::BlewUp`] if velocities are no longer finite.
    pub fn step(&mut self, step: f64, force: Option<Force<'_>>) -> Result<(), FlowError> {
        if !(step.is_finite() && step > 0.0) {
            return Err(FlowError::Step(step));
        }
        let courant = step * self.crossing_rate();
        match (self.numerics.advection, &self.last) {
            (Advection::RungeKutta, _) => STAGES.iter().for_each(|stage| self.advance(step, *stage, force)),
            (Advection::AdamsBashforth, Some(_)) => self.advance(step, (1.5, -0.5), force),
            (Advection::AdamsBashforth, None) | (Advection::Creeping, _) => self.advance(step, (1.0, 0.0), force),
        }
        if self.crossing_rate().is_finite() {
            return Ok(());
        }
        let diffusion = step * self.kinematic_viscosity() / self.border.grid().spacing().powi(2);
        Err(FlowError::BlewUp { time: self.time, courant, diffusion })
    }

    /// One stage: explicit rates with their weights, friction half before and half after, the pressure at last.
    fn advance(&mut self, step: f64, (present, past): (f64, f64), force: Option<Force<'_>>) {
        let duration = (present + past) * step;
        let rates: [Vec<f64>; 3] = std::array::from_fn(|component| self.explicit_rates(component));
        let last = self.last.take();
        let right = std::array::from_fn(|component| {
            let mut right: Vec<f64> = rates[component].iter().map(|rate| present * step * rate).collect();
            if let Some(last) = &last {
                add(&mut right, past * step, &last[component]);
            }
            if self.numerics.diffusion == Diffusion::Implicit && self.fluid.viscosity > 0.0 {
                add(
                    &mut right,
                    duration * self.kinematic_viscosity(),
                    &stencils::laplacian(&self.border, component, &self.velocity[component]),
                );
            }
            add(&mut right, -duration / self.fluid.density, &stencils::gradient(&self.border, &self.pressure, component));
            if let Some(force) = force {
                add(&mut right, duration / self.fluid.density, &self.forces(component, self.time + 0.5 * duration, force));
            }
            right
        });
        let implicit = if self.numerics.diffusion == Diffusion::Implicit { 0.5 } else { 0.0 };
        let factors = Factors { duration, beta: implicit * duration * self.kinematic_viscosity(), density: self.fluid.density };
        self.projection.advance(&mut self.velocity, &mut self.pressure, right, factors, self.numerics.coupling);
        self.last = Some(rates);
        self.pressure_time = self.time + 0.5 * duration;
        self.time += duration;
    }

    fn explicit_rates(&self, component: usize) -> Vec<f64> {
        let mut rates = if self.numerics.advection == Advection::Creeping {
            self.border.evaluate(Some(component), |_| 0.0)
        } else {
            let mut rates = stencils::advection(&self.border, &self.velocity, component);
            rates.iter_mut().for_each(|rate| *rate = -*rate);
            rates
        };
        if self.numerics.diffusion == Diffusion::Explicit {
            add(&mut rates, self.kinematic_viscosity(), &stencils::laplacian(&self.border, component, &self.velocity[component]));
        }
        rates
    }

    fn forces(&self, component: usize, time: f64, force: Force<'_>) -> Vec<f64> {
        let grid = self.border.grid();
        self.border.evaluate(Some(component), |at| force(component, position(grid, Some(component), self.border.cell(at)), time))
    }

    fn kinematic_viscosity(&self) -> f64 {
        self.fluid.viscosity / self.fluid.density
    }

    /// The grid and its sides.
    pub fn border(&self) -> &Border {
        &self.border
    }

    /// In m/s, border included.
    pub fn velocity(&self) -> &Velocity {
        &self.velocity
    }

    /// In Pa, border included; up to a constant where no outlet sets it.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Time of the velocity in s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Time of the pressure in s: the middle of the last stage. R eq. 7.9 calls it that of the end of the step.
    pub fn pressure_time(&self) -> f64 {
        self.pressure_time
    }

    /// Pressures solved for, one after the other.
    pub fn solves(&self) -> u64 {
        self.projection.solves
    }

    /// Largest divergence of a cell in 1/s.
    pub fn largest_divergence(&self) -> f64 {
        stencils::divergence(&self.border, &self.velocity).into_iter().fold(0.0, |largest, value| largest.max(value.abs()))
    }

    /// Kinetic energy in J: each unknown with the volume of a cell, half of it on an outlet.
    pub fn kinetic_energy(&self) -> f64 {
        let of_component = |component: usize| {
            let values = self.border.evaluate(Some(component), |at| self.velocity[component][at].powi(2));
            values.iter().sum::<f64>()
        };
        0.5 * self.fluid.density * self.border.grid().spacing().powi(3) * (0..3).map(of_component).sum::<f64>()
    }

    /// Largest sum over the directions of the speeds across a cell in 1/s. Times the step it is the Courant number, with the limits of [`Flow::longest_step`].
    pub fn crossing_rate(&self) -> f64 {
        stencils::crossing_rate(&self.border, &self.velocity)
    }

    /// The longest stable step in s: of advection without friction, where Runge and Kutta's stages bear a Courant number of $\sqrt 3$, and of explicit friction, where the
    /// largest eigenvalue of the Laplacian, $12 / h^2$, times the step may be 2.51 (1 for Adams and Bashforth's two rates, 2 without advection). The latter bear no
    /// advection for ever without friction; a Courant number of 0.5 grows by less than 3 per cent over a hundred steps.
    pub fn longest_step(&self) -> f64 {
        let (advective, diffusive) = match self.numerics.advection {
            Advection::Creeping => (f64::INFINITY, 2.0),
            Advection::AdamsBashforth => (0.5, 1.0),
            Advection::RungeKutta => (3f64.sqrt(), 2.512_745),
        };
        let square = self.border.grid().spacing().powi(2);
        let friction = match self.numerics.diffusion {
            Diffusion::Implicit => f64::INFINITY,
            Diffusion::Explicit => diffusive * square / (12.0 * self.kinematic_viscosity()),
        };
        friction.min(advective / self.crossing_rate())
    }
}

fn add(values: &mut [f64], factor: f64, others: &[f64]) {
    values.iter_mut().zip(others).for_each(|(value, other)| *value += factor * other);
}

/// Where a value of a cell lives in m: a component of the velocity, or the pressure.
pub fn position(grid: &Grid, component: Option<usize>, cell: [usize; 3]) -> Vector {
    grid.position(component, cell.map(|number| number as isize))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fluid::grid::{FaceField, GridError};
    use crate::fluid::operators;
    use crate::fluid::periodic::PeriodicBox;
    use crate::fluid::sides::{Ends, Side};

    const WATER: Fluid = Fluid { density: 2.0, viscosity: 0.3 };
    const EXACT: Coupling = Coupling::Exact { tolerance: 1e-10 };

    fn wave(component: usize, place: Vector) -> f64 {
        (3.0 * place.x + (component + 1) as f64 * place.y).sin() + (2.0 * place.z - place.x + component as f64).cos()
    }

    fn all_unknowns(flow: &Flow) -> Vec<f64> {
        let border = flow.border();
        (0..3).flat_map(|component| border.evaluate(Some(component), |at| flow.velocity()[component][at])).collect()
    }

    #[test]
    fn what_is_no_fluid_or_no_step_is_refused() {
        let grid = Grid::new([4; 3], 1.0, Vector::zeros()).unwrap();
        let make = |density, viscosity| Flow::new(grid, Sides::CLOSED, Fluid { density, viscosity }, Numerics::default());
        assert_eq!(make(0.0, 1.0).err(), Some(FlowError::Density(0.0)));
        assert!(matches!(make(f64::NAN, 1.0).err(), Some(FlowError::Density(_))));
        assert_eq!(make(1.0, -1.0).err(), Some(FlowError::Viscosity(-1.0)));
        let mut flow = make(1.0, 0.0).unwrap();
        assert_eq!(flow.step(0.0, None), Err(FlowError::Step(0.0)));
        assert!(matches!(flow.step(f64::NAN, None), Err(FlowError::Step(_))));
        assert_eq!(Grid::new([1, 8, 8], 1.0, Vector::zeros()), Err(GridError::TooFew { direction: 0, cells: 1 }));
    }

    #[test]
    fn a_step_beyond_the_limit_blows_up_with_an_error_and_one_below_does_not() {
        for (factor, is_stable) in [(0.9, true), (1.5, false)] {
            let grid = Grid::new([8; 3], 0.25, Vector::zeros()).unwrap();
            let numerics = Numerics { diffusion: Diffusion::Explicit, ..Numerics::default() };
            let mut flow = Flow::new(grid, Sides::CLOSED, Fluid { density: 1.0, viscosity: 0.5 }, numerics).unwrap();
            flow.set(|component, place| 1e-3 * wave(component, place), |_| 0.0);
            let step = factor * flow.longest_step();
            let end = (0..600).try_for_each(|_| flow.step(step, None));
            assert_eq!(end.is_ok(), is_stable, "{factor}");
            assert!(
                is_stable
                    || matches!(end, Err(FlowError::BlewUp { diffusion, .. }) if (diffusion - factor * 2.512_745 / 12.0).abs() < 1e-9)
            );
        }
    }

    /// A uniform force in a closed box, and at an outlet, is all pressure.
    #[test]
    fn a_fluid_at_rest_stays_at_rest_under_its_weight() {
        let weight = |component: usize, _: Vector, _: f64| if component == 1 { -9.81 } else { 0.0 };
        for coupling in [Coupling::Projected, EXACT] {
            let grid = Grid::new([5, 6, 4], 0.2, Vector::zeros()).unwrap();
            let mut flow = Flow::new(grid, Sides::CLOSED, WATER, Numerics { coupling, ..Numerics::default() }).unwrap();
            // One projection needs some steps to find the pressure; it never moves the fluid by more than the splitting.
            (0..300).for_each(|_| flow.step(0.05, Some(&weight)).unwrap());
            assert!(all_unknowns(&flow).iter().all(|speed| speed.abs() < 1e-12));
            let border = flow.border();
            let at = |cell| flow.pressure()[border.index(cell)];
            assert!((at([2, 4, 1]) - at([2, 1, 3]) + 9.81 * 0.6).abs() < 1e-10);
        }
    }

    /// Where the box repeats, the scheme of R is the exact step of the coupled equations.
    #[test]
    fn a_creeping_step_is_the_inverse_of_the_periodic_box() {
        let (step, grid) = (0.3, Grid::new([6, 5, 8], 0.4, Vector::new(0.1, 0.0, -1.0)).unwrap());
        let mut flow = Flow::new(grid, Sides::PERIODIC, WATER, Numerics { advection: Advection::Creeping, ..Numerics::default() }).unwrap();
        flow.set(wave, |place| place.x.sin());
        let border = *flow.border();
        let compact = |flow: &Flow| FaceField { component: std::array::from_fn(|c| border.evaluate(Some(c), |at| flow.velocity()[c][at])) };
        let before = compact(&flow);
        let force = |component: usize, place: Vector, time: f64| wave(component + 1, place) * (1.0 + time);
        flow.step(step, Some(&force)).unwrap();
        let inertia = WATER.density / step;
        let mut wanted = FaceField::from_fn(&grid, |component, place| force(component, place, 0.5 * step));
        let mut mean = before.mean();
        for component in 0..3 {
            let diffused = operators::laplacian(&grid, &before.component[component]);
            mean[component] += wanted.mean()[component] / inertia;
            for (place, value) in wanted.component[component].iter_mut().enumerate() {
                *value += inertia * before.component[component][place] + 0.5 * WATER.viscosity * diffused[place];
            }
        }
        PeriodicBox::new(grid).solve_stokes(&mut wanted, 0.5 * WATER.viscosity, inertia, mean);
        let got = compact(&flow);
        for (got, wanted) in got.component.iter().flatten().zip(wanted.component.iter().flatten()) {
            assert!((got - wanted).abs() < 1e-13);
        }
    }

    #[test]
    fn divergence_vanishes_with_every_kind_of_side() {
        let inlet = Side::Inlet { velocity: Vector::new(0.2, 1.0, 0.0) };
        let lid = Side::Wall { velocity: Vector::new(0.0, 0.5, 1.0) };
        let ends = [Ends::Sides([lid, Side::FreeSlip]), Ends::Sides([inlet, Side::Outlet]), Ends::Periodic];
        for sides in [Sides::PERIODIC, Sides::CLOSED, Sides::new(ends).unwrap()] {
            let grid = Grid::new([9, 12, 7], 0.1, Vector::zeros()).unwrap();
            let mut flow = Flow::new(grid, sides, WATER, Numerics::default()).unwrap();
            flow.set(|component, place| 0.3 * wave(component, 5.0 * place), |_| 0.0);
            (0..5).for_each(|_| flow.step(0.02, None).unwrap());
            assert!(flow.largest_divergence() < 1e-13 * flow.crossing_rate(), "{sides:?}");
        }
    }

    #[cfg(feature = "threads")]
    #[test]
    fn threads_change_no_bit() {
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let grid = Grid::new([27, 28, 30], 0.1, Vector::zeros()).unwrap();
                let wall = Ends::Sides([Side::REST, Side::Wall { velocity: Vector::x() }]);
                let through = Ends::Sides([Side::Inlet { velocity: Vector::x() }, Side::Outlet]);
                let sides = Sides::new([through, wall, Ends::Periodic]).unwrap();
                let mut flow =
                    Flow::new(grid, sides, WATER, Numerics { coupling: Coupling::Exact { tolerance: 1e-2 }, ..Numerics::SOURCE }).unwrap();
                flow.set(wave, |_| 0.0);
                flow.step(0.02, None).unwrap();
                all_unknowns(&flow)
            })
        };
        let one = run(1);
        assert!(run(2) == one && run(5) == one);
    }
}
