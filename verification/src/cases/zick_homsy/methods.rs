//! Spheres in a cubic cell that repeats, held by every method there is.

use std::f64::consts::PI;
use std::sync::Arc;

use solver::Vector;
use solver::coupling::resolved::constraint::Constraint;
use solver::coupling::resolved::ghosts::{Continuation, Continued, Ghosts};
use solver::coupling::resolved::immersed::ImmersedBody;
use solver::coupling::resolved::interpolation::Degree;
use solver::coupling::resolved::marching::{Marching, MarchingProblem};
use solver::coupling::resolved::points::{PointRules, Points};
use solver::coupling::resolved::steady::{SteadyFlow, SteadyProblem, solve};
use solver::coupling::resolved::surface::Ball;
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::operators::divergence;
use solver::fluid::periodic::PeriodicBox;

use crate::case::Failure;
use crate::exact::periodic_array::Lattice;

/// How the spheres are held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Forces on the outermost values inside, velocities continued by parabolas or straight lines. Parabolas are the default.
    Sharp(Continuation),
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
    /// The default.
    pub const SHARP: Method = Method::Sharp(Continuation::Quadratic);
    /// The points of R.
    pub const SOURCE: Method = Method::Points { degree: Degree::QuadraticOutward, interior: true };
    /// The scheme of R.
    pub const MARCHED: Method = Method::Marched { explicit_forcing: 1.0 };
    /// Those that are held against the default at one solid fraction.
    pub const RIVALS: [Method; 7] = [
        Method::Sharp(Continuation::Linear),
        Method::SOURCE,
        Method::Points { degree: Degree::QuadraticOutward, interior: false },
        Method::Points { degree: Degree::Linear, interior: true },
        Method::Points { degree: Degree::Linear, interior: false },
        Method::MARCHED,
        Method::Marched { explicit_forcing: 0.0 },
    ];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Method::Sharp(Continuation::Quadratic) => "sharp, parabolas (default)",
            Method::Sharp(Continuation::Linear) => "sharp, straight lines",
            Method::Points { degree: Degree::QuadraticOutward, interior: true } => "points of R, Q2",
            Method::Points { degree: Degree::QuadraticOutward, interior: false } => "points on the surface alone, Q2",
            Method::Points { degree: Degree::Linear, interior: true } => "points of R, multilinear",
            Method::Points { degree: Degree::Linear, interior: false } => "points on the surface alone, multilinear",
            Method::Marched { explicit_forcing } if explicit_forcing > 0.0 => "points of R, marched as R",
            Method::Marched { .. } => "points of R, marched without explicit forcing",
        }
    }

    /// Whether it goes through time.
    pub fn is_marched(self) -> bool {
        matches!(self, Method::Marched { .. })
    }
}

/// Residual at which solvers stop, over the first. The friction factor then has eight digits.
pub const TOLERANCE: f64 = 1e-6;
/// Change of the mean velocity in a diffusion time at which a marched flow counts as steady.
pub const STEADY: f64 = 1e-5;
/// Neighbouring collocation points are that many spacings apart.
const POINT_DISTANCE: f64 = 1.5;
/// A flow that is not steady by then will not be.
const MOST_DIFFUSION_TIMES: f64 = 30.0;

/// What is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Problem {
    /// How.
    pub method: Method,
    /// Where the spheres are.
    pub lattice: Lattice,
    /// Volume of the spheres over that of the cell.
    pub fraction: f64,
    /// Spacings a diameter, about: see [`Problem::edge`].
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
    /// Of the conditions that can be met, over their right side; of marched flows the slip that is left, over the mean velocity.
    pub residual: f64,
    /// Of all conditions with those that no flow can meet, over the mean velocity.
    pub full_residual: f64,
    /// Flows solved for, or steps.
    pub flows: usize,
    /// Cells of the grid times inversions of one scalar operator: the transforms that were paid for.
    pub inverted_cells: f64,
    /// Conditions on the velocity.
    pub conditions: usize,
    /// Which of them are by straight lines or asked of the ghost itself.
    pub fallbacks: Continued,
    /// Spacings a diameter as they came out.
    pub cells: f64,
}

/// A value at a place in the plane through the middle of a sphere.
pub type Seen = [f64; 4];

impl Problem {
    /// Cells along an edge: the number next to what is asked for that transforms like, of factors 2, 3 and 5.
    pub fn edge(&self) -> usize {
        let wanted = self.cells / self.lattice.diameter(self.fraction);
        let is_smooth = |number: &usize| {
            let left = [2, 3, 5].into_iter().fold(*number, |mut left, factor| {
                while left % factor == 0 {
                    left /= factor;
                }
                left
            });
            left == 1
        };
        let most = 2 * wanted.ceil() as usize + 8;
        let away = |number: &usize| (*number as f64 - wanted).abs();
        (4..most).filter(is_smooth).min_by(|one, other| away(one).total_cmp(&away(other))).unwrap_or(4)
    }

    /// Solves with the spheres moved by some spacings, in a cell of unit edge, viscosity and density.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the spheres or the solver does not converge.
    pub fn solve(&self, place: [f64; 3]) -> Result<Found, Failure> {
        let (flow, bodies) = self.set_up(place)?;
        match self.method {
            Method::Sharp(_) => self.sharp(&flow, &bodies).map(|(found, _)| found),
            Method::Points { degree, interior } => Ok(self.steady(&flow, &points(&flow, &bodies, degree, interior)?)?.0),
            Method::Marched { explicit_forcing } => {
                self.marched(&flow, &points(&flow, &bodies, Degree::QuadraticOutward, true)?, explicit_forcing)
            }
        }
    }

    /// Time, place along and across the flow, and speed of the fluid in the plane through the middle of the first sphere.
    ///
    /// # Errors
    ///
    /// As [`Problem::solve`].
    pub fn slice(&self, place: [f64; 3]) -> Result<Vec<Seen>, Failure> {
        let (flow, bodies) = self.set_up(place)?;
        let (_, steady) = self.sharp(&flow, &bodies)?;
        let (grid, centre) = (flow.grid(), bodies[0].position);
        let level = grid.in_cells(None, &centre).z.round() as usize;
        let seen = |index: usize| {
            let cell = grid.cell(index);
            let at = grid.position(None, cell.map(|number| number as isize));
            let is_fluid = bodies.iter().all(|body| body.foot(&body.arm(&at, &grid.extent())).distance > 0.0);
            let middle = |direction: usize| {
                let values = &steady.velocity.component[direction];
                0.5 * (values[index] + values[grid.neighbour(cell, direction, 1)])
            };
            (cell[2] == level && is_fluid).then(|| [0.0, at.x, at.y, Vector::from_fn(|direction, _| middle(direction)).norm()])
        };
        Ok((0..grid.len()).filter_map(seen).collect())
    }

    fn set_up(&self, place: [f64; 3]) -> Result<(PeriodicBox, Vec<ImmersedBody>), Failure> {
        let edge = self.edge();
        let spacing = 1.0 / edge as f64;
        let grid = Grid::new([edge; 3], spacing, Vector::zeros()).map_err(|error| Failure::NothingMeasured(error.to_string()))?;
        let ball = Arc::new(Ball { radius: 0.5 * self.lattice.diameter(self.fraction) });
        let moved = |centre: &[f64; 3]| Vector::from(*centre) + Vector::from(place) * spacing;
        let bodies = self.lattice.centres().iter().map(|centre| ImmersedBody::fixed(ball.clone(), moved(centre)));
        Ok((PeriodicBox::new(grid), bodies.collect()))
    }

    fn sharp(&self, flow: &PeriodicBox, bodies: &[ImmersedBody]) -> Result<(Found, SteadyFlow), Failure> {
        let continuation = if let Method::Sharp(continuation) = self.method { continuation } else { Continuation::Quadratic };
        let ghosts = Ghosts::new(flow.grid(), bodies, continuation).map_err(|error| Failure::NothingMeasured(error.to_string()))?;
        let (found, steady) = self.steady(flow, &ghosts)?;
        Ok((Found { fallbacks: ghosts.continued(), ..found }, steady))
    }

    /// Solves at once for the flow of mean velocity one.
    fn steady(&self, flow: &PeriodicBox, constraint: &dyn Constraint) -> Result<(Found, SteadyFlow), Failure> {
        let problem = SteadyProblem { viscosity: 1.0, mean_velocity: Vector::x(), tolerance: TOLERANCE, most_iterations: 600 };
        let steady = solve(flow, constraint, &problem);
        if steady.residual > TOLERANCE || steady.residual.is_nan() {
            return Err(Failure::NothingMeasured(format!("a residual of {:e} after {} flows", steady.residual, steady.iterations)));
        }
        let spheres = self.lattice.centres().len();
        let force: f64 = constraint.loads(&steady.forces, spheres).iter().map(|load| load.force.x).sum();
        let found = Found {
            friction: self.friction(force, 1.0),
            divergence: largest_divergence(flow, &steady.velocity),
            residual: steady.residual,
            full_residual: steady.full_residual,
            flows: steady.iterations,
            inverted_cells: (3 * steady.iterations * flow.grid().len()) as f64,
            conditions: constraint.len(),
            fallbacks: Continued::default(),
            cells: self.lattice.diameter(self.fraction) / flow.grid().spacing(),
        };
        Ok((found, steady))
    }

    /// Marches under a unit pressure gradient until the mean velocity stays.
    fn marched(&self, flow: &PeriodicBox, constraint: &dyn Constraint, explicit_forcing: f64) -> Result<Found, Failure> {
        let diameter = self.lattice.diameter(self.fraction);
        let step = diameter.powi(2) / self.steps_a_diffusion_time;
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
                    // Three components and the pressure; the iterations that hold the bodies need no transform.
                    inverted_cells: (4 * steps * flow.grid().len()) as f64,
                    conditions: constraint.len(),
                    fallbacks: Continued::default(),
                    cells: diameter / flow.grid().spacing(),
                });
            }
            last = mean;
        }
        Err(Failure::NothingMeasured(format!("the flow was not steady after {MOST_DIFFUSION_TIMES} diffusion times")))
    }

    /// From the force on all spheres of a cell.
    fn friction(&self, force: f64, mean_velocity: f64) -> f64 {
        force / (3.0 * PI * self.lattice.diameter(self.fraction) * mean_velocity * self.lattice.centres().len() as f64)
    }
}

fn points(flow: &PeriodicBox, bodies: &[ImmersedBody], degree: Degree, interior: bool) -> Result<Points, Failure> {
    let rules = PointRules { distance: POINT_DISTANCE, degree, interior };
    Points::new(flow.grid(), bodies, &rules).map_err(|error| Failure::NothingMeasured(error.to_string()))
}

fn largest_divergence(flow: &PeriodicBox, velocity: &FaceField) -> f64 {
    let grid = flow.grid();
    divergence(grid, velocity).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs())) * grid.spacing()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(cells: f64) -> Problem {
        Problem { method: Method::SHARP, lattice: Lattice::SimpleCubic, fraction: 0.216, cells, steps_a_diffusion_time: f64::NAN }
    }

    #[test]
    fn grids_are_next_to_what_is_asked_for_and_smooth() {
        assert_eq!([10.0, 14.0, 20.0, 28.0, 40.0].map(|cells| problem(cells).edge()), [12, 18, 27, 36, 54]);
        assert_eq!(problem(0.1).edge(), 4);
    }

    #[test]
    fn a_grid_too_coarse_is_a_failed_run_with_its_minimum() {
        let coarse = Problem { fraction: 0.001, ..problem(0.5) };
        let message = coarse.solve([0.2, 0.1, 0.3]).expect_err("a sphere between the values").to_string();
        assert!(message.contains("at least 1 are needed"), "{message}");
    }
}
