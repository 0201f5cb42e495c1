//! One sphere in a cubic cell that repeats, held by every method there is.

use std::f64::consts::PI;
use std::sync::Arc;

use solver::Vector;
use solver::coupling::resolved::constraint::Constraint;
use solver::coupling::resolved::ghosts::{Continuation, Ghosts};
use solver::coupling::resolved::immersed::ImmersedBody;
use solver::coupling::resolved::interpolation::Degree;
use solver::coupling::resolved::marching::{Marching, MarchingProblem};
use solver::coupling::resolved::points::{PointRules, Points};
use solver::coupling::resolved::steady::{SteadyProblem, solve};
use solver::coupling::resolved::surface::Ball;
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::operators::divergence;
use solver::fluid::periodic::PeriodicBox;

use crate::case::Failure;

/// How the sphere is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Forces on the outermost values inside, velocities continued by parabolas: the default.
    Sharp,
    /// The same on a sequence of grids, extrapolated.
    Extrapolated,
    /// The same continued by straight lines.
    SharpLinear,
    /// Collocation points, solved at once.
    Points {
        /// Interpolation at the surface.
        degree: Degree,
        /// Whether the inside is held too.
        interior: bool,
    },
    /// Collocation points marched in time as R states it.
    Marched {
        /// $\gamma$ of R eq. 7.9.
        explicit_forcing: f64,
    },
}

impl Method {
    /// Those that are compared at one solid fraction.
    pub const RIVALS: [Method; 6] = [
        Method::SharpLinear,
        Method::Points { degree: Degree::QuadraticOutward, interior: true },
        Method::Points { degree: Degree::QuadraticOutward, interior: false },
        Method::Points { degree: Degree::Linear, interior: true },
        Method::Marched { explicit_forcing: 1.0 },
        Method::Marched { explicit_forcing: 0.0 },
    ];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Method::Sharp => "sharp, parabolas (default)",
            Method::Extrapolated => "sharp, parabolas, extrapolated",
            Method::SharpLinear => "sharp, straight lines",
            Method::Points { degree: Degree::QuadraticOutward, interior: true } => "points of R (Q2, inside held)",
            Method::Points { degree: Degree::QuadraticOutward, interior: false } => "points on the surface alone (Q2)",
            Method::Points { degree: Degree::Linear, .. } => "points of R, multilinear",
            Method::Marched { explicit_forcing } if explicit_forcing > 0.0 => "points of R, marched as R",
            Method::Marched { .. } => "points of R, marched without explicit forcing",
        }
    }

    /// Whether it goes through time.
    pub fn is_marched(self) -> bool {
        matches!(self, Method::Marched { .. })
    }
}

/// Residual at which solvers stop, over the first.
pub const TOLERANCE: f64 = 1e-8;
/// Change of the mean velocity in a diffusion time at which a marched flow counts as steady.
const STEADY: f64 = 1e-5;

/// What is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Problem {
    /// How.
    pub method: Method,
    /// Volume of the sphere over that of the cell.
    pub fraction: f64,
    /// Spacings a diameter, about: the cell has a whole number of them.
    pub cells: f64,
    /// Steps in a diffusion time, the square of the diameter over the viscosity.
    pub steps_a_diffusion_time: f64,
}

/// What was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// $K = F / (6 \pi \mu a U)$.
    pub friction: f64,
    /// Largest, times spacing over mean velocity.
    pub divergence: f64,
    /// Of the conditions, over their right side.
    pub residual: f64,
    /// Of all conditions with those that no flow can meet, over the mean velocity.
    pub full_residual: f64,
    /// Flows solved for, or steps.
    pub flows: usize,
    /// Conditions on the velocity.
    pub conditions: usize,
    /// Cells of the grid.
    pub grid_cells: usize,
    /// Spacings a diameter as they came out.
    pub cells: f64,
}

/// Diameter of the sphere in edges of the cell.
pub fn diameter(fraction: f64) -> f64 {
    (6.0 * fraction / PI).cbrt()
}

impl Problem {
    /// Solves with the sphere moved from the middle by some spacings, in a cell of unit edge, viscosity and density.
    pub fn solve(&self, place: [f64; 3]) -> Result<Found, Failure> {
        let diameter = diameter(self.fraction);
        let edge = (self.cells / diameter).round().max(4.0) as usize;
        let spacing = 1.0 / edge as f64;
        let refused = |error: solver::fluid::grid::GridError| Failure::NothingMeasured(error.to_string());
        let grid = Grid::new([edge; 3], spacing, Vector::zeros()).map_err(refused)?;
        let flow = PeriodicBox::new(grid);
        let centre = Vector::repeat(0.5) + Vector::from(place) * spacing;
        let bodies = [ImmersedBody::fixed(Arc::new(Ball { radius: 0.5 * diameter }), centre)];
        let found = match self.method {
            Method::Sharp | Method::Extrapolated => self.steady(&flow, &Ghosts::new(&grid, &bodies, Continuation::Quadratic)),
            Method::SharpLinear => self.steady(&flow, &Ghosts::new(&grid, &bodies, Continuation::Linear)),
            Method::Points { degree, interior } => {
                self.steady(&flow, &Points::new(&grid, &bodies, &PointRules { distance: POINT_DISTANCE, degree, interior }))
            }
            Method::Marched { explicit_forcing } => {
                let rules = PointRules { distance: POINT_DISTANCE, degree: Degree::QuadraticOutward, interior: true };
                self.marched(&flow, &Points::new(&grid, &bodies, &rules), explicit_forcing)?
            }
        };
        Ok(Found { cells: diameter / spacing, ..found })
    }

    /// Solves at once for the flow of mean velocity one.
    fn steady(&self, flow: &PeriodicBox, constraint: &dyn Constraint) -> Found {
        let problem = SteadyProblem { viscosity: 1.0, mean_velocity: Vector::x(), tolerance: TOLERANCE, most_iterations: 600 };
        let steady = solve(flow, constraint, &problem);
        let force = constraint.loads(&steady.forces, 1)[0].force.x;
        Found {
            friction: self.friction(force, 1.0),
            divergence: largest_divergence(flow, &steady.velocity),
            residual: steady.residual,
            full_residual: steady.full_residual,
            flows: steady.iterations,
            conditions: constraint.len(),
            grid_cells: flow.grid().len(),
            cells: f64::NAN,
        }
    }

    /// Marches under a unit pressure gradient until the mean velocity stays.
    fn marched(&self, flow: &PeriodicBox, constraint: &dyn Constraint, explicit_forcing: f64) -> Result<Found, Failure> {
        let step = diameter(self.fraction).powi(2) / self.steps_a_diffusion_time;
        let problem = MarchingProblem { density: 1.0, viscosity: 1.0, driving: Vector::x(), step, explicit_forcing, tolerance: 1e-6 };
        let mut marching = Marching::new(flow, constraint, problem);
        let most = (MOST_DIFFUSION_TIMES * self.steps_a_diffusion_time) as usize;
        let mut last = 0.0;
        for steps in 1..=most {
            marching.step();
            let mean = marching.velocity.mean().x;
            if (mean - last).abs() * self.steps_a_diffusion_time < STEADY * mean {
                let missing = constraint.sample(&marching.velocity).iter().map(|value| value * value).sum::<f64>();
                let slip = (missing / constraint.len() as f64).sqrt() / mean;
                return Ok(Found {
                    friction: self.friction(1.0, mean),
                    divergence: largest_divergence(flow, &marching.velocity) / mean,
                    residual: slip,
                    full_residual: slip,
                    flows: steps,
                    conditions: constraint.len(),
                    grid_cells: flow.grid().len(),
                    cells: f64::NAN,
                });
            }
            last = mean;
        }
        Err(Failure::NothingMeasured(format!("the flow was not steady after {MOST_DIFFUSION_TIMES} diffusion times")))
    }

    fn friction(&self, force: f64, mean_velocity: f64) -> f64 {
        force / (3.0 * PI * diameter(self.fraction) * mean_velocity)
    }
}

/// Neighbouring collocation points are that many spacings apart.
const POINT_DISTANCE: f64 = 1.5;
/// A flow that is not steady by then will not be.
const MOST_DIFFUSION_TIMES: f64 = 30.0;

fn largest_divergence(flow: &PeriodicBox, velocity: &FaceField) -> f64 {
    let grid = flow.grid();
    divergence(grid, velocity).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs())) * grid.spacing()
}
