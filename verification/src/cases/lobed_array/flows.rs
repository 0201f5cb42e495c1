//! One body in a cell that repeats, and the creeping flow past it.

use std::f64::consts::{FRAC_PI_4, PI};
use std::sync::Arc;

use solver::coupling::resolved::constraint::Constraint;
use solver::coupling::resolved::ghosts::{Continuation, Continued, Ghosts};
use solver::coupling::resolved::immersed::ImmersedBody;
use solver::coupling::resolved::interpolation::Degree;
use solver::coupling::resolved::points::{PointRules, Points};
use solver::coupling::resolved::steady::{SteadyFlow, SteadyProblem, solve};
use solver::coupling::resolved::surface::Surface;
use solver::coupling::resolved::surface::lobes::Lobes;
use solver::coupling::resolved::surface::outline::{Circle, Outline};
use solver::coupling::resolved::surface::prism::Prism;
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::operators::divergence;
use solver::fluid::periodic::PeriodicBox;
use solver::{Orientation, Vector};

use crate::case::Failure;

/// A shape of R section 7.4.2.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Round.
    Cylinder,
    /// Three lobes.
    Trilobe,
    /// Four lobes.
    Quadralobe,
}

impl Shape {
    /// All.
    pub const ALL: [Shape; 3] = [Shape::Cylinder, Shape::Trilobe, Shape::Quadralobe];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Cylinder => "cylinder",
            Shape::Trilobe => "trilobe",
            Shape::Quadralobe => "quadralobe",
        }
    }

    /// Diameter over length of R's bodies of one volume and length (table 7.1).
    pub fn diameter_over_length(self) -> f64 {
        match self {
            Shape::Cylinder => 0.349,
            Shape::Trilobe => 0.414,
            Shape::Quadralobe => 0.405,
        }
    }

    /// Share of the circumscribed cylinder that it fills, from the same table: the only measure of its lobes that R prints and that is consistent.
    pub fn share(self) -> f64 {
        (Shape::Cylinder.diameter_over_length() / self.diameter_over_length()).powi(2)
    }
}

/// Sizes and cell of a body along z; the short edge of the cell is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// As long as wide, in a cube.
    Short,
    /// Five times as long as wide, in a cell of edges 1, 1, 5.
    Long,
    /// Bodies of one volume and length (R table 7.1), in a cell of edges 1, 1, 5/2.
    Compared,
    /// Without ends.
    Endless,
}

impl Family {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Family::Short => "aspect ratio 1",
            Family::Long => "aspect ratio 5",
            Family::Compared => "equal volume and length",
            Family::Endless => "endless",
        }
    }

    /// Cells along the axis over those across.
    fn edges_along(self) -> f64 {
        match self {
            Family::Short | Family::Endless => 1.0,
            Family::Long => 5.0,
            Family::Compared => 2.5,
        }
    }

    /// Length of the body over its diameter.
    fn aspect(self, shape: Shape) -> f64 {
        match self {
            Family::Short | Family::Endless => 1.0,
            Family::Long => 5.0,
            Family::Compared => 1.0 / shape.diameter_over_length(),
        }
    }
}

/// Where the fluid goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
    /// Along the axis of the body.
    Along,
    /// Across it, along a side of the cell; of a trilobe, against the tip of a lobe.
    Across,
    /// Along a side of the cell, the body turned by 20 degrees about x, y and z, one after the other.
    Turned,
}

impl Course {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Course::Along => "along",
            Course::Across => "across",
            Course::Turned => "turned 20/20/20",
        }
    }

    /// Direction of the mean velocity.
    pub fn direction(self) -> Vector {
        if self == Course::Across { Vector::x() } else { Vector::z() }
    }
}

/// How the body is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Forces on the outermost values inside, velocities continued by parabolas: the default.
    Sharp,
    /// Collocation points of R.
    Points,
}

impl Method {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Method::Sharp => "sharp, parabolas (default)",
            Method::Points => "points of R, Q2",
        }
    }
}

/// Residual at which solvers stop, over the first.
pub const TOLERANCE: f64 = 1e-6;
/// Neighbouring collocation points are that many spacings apart.
const POINT_DISTANCE: f64 = 1.5;
/// Cells along a body without ends: any number does, and a grid needs four.
const ENDLESS_CELLS: usize = 4;

/// What is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Problem {
    /// The body.
    pub shape: Shape,
    /// Its sizes and cell.
    pub family: Family,
    /// The flow.
    pub course: Course,
    /// Volume of the body over that of the cell.
    pub fraction: f64,
    /// How.
    pub method: Method,
    /// Cells along the short edge of the cell of the array, even.
    pub edge: usize,
}

/// What was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Drag over $6 \pi \mu a U$, a the radius of the sphere of equal volume; for endless bodies over $\mu U$ and a length.
    pub drag: Vector,
    /// Largest, times spacing over mean velocity.
    pub divergence: f64,
    /// Of the conditions that can be met, over their right side.
    pub residual: f64,
    /// Drag and force of the mean pressure gradient, their sum over one of them.
    pub imbalance: f64,
    /// Flows solved for.
    pub flows: usize,
    /// Cells of the grid times inversions of one scalar operator.
    pub inverted_cells: f64,
    /// Conditions on the velocity.
    pub conditions: usize,
    /// Which of them are by straight lines or asked of the ghost itself.
    pub fallbacks: Continued,
}

/// Time, place along and across the flow, and speed.
pub type Seen = [f64; 4];

impl Problem {
    /// Diameter of the circumscribed cylinder in short edges of the cell.
    pub fn diameter(&self) -> f64 {
        let volume = self.fraction * self.family.edges_along();
        let of_unit = 0.25 * PI * self.shape.share();
        match self.family {
            Family::Endless => (volume / of_unit).sqrt(),
            _ => (volume / (of_unit * self.family.aspect(self.shape))).cbrt(),
        }
    }

    /// Cells a diameter.
    pub fn cells(&self) -> f64 {
        self.diameter() * self.edge as f64
    }

    /// The body in its cell, moved by some spacings.
    fn set_up(&self, place: [f64; 3]) -> Result<(PeriodicBox, ImmersedBody), Failure> {
        let spacing = 1.0 / self.edge as f64;
        let along = match self.family {
            Family::Endless => ENDLESS_CELLS,
            _ => (self.edge as f64 * self.family.edges_along()).round() as usize,
        };
        let grid = Grid::new([self.edge, self.edge, along], spacing, Vector::zeros()).map_err(failure)?;
        let length = if self.family == Family::Endless { along as f64 * spacing } else { self.diameter() * self.family.aspect(self.shape) };
        let centre = 0.5 * grid.extent() + Vector::from(place) * spacing;
        let body = ImmersedBody { orientation: self.orientation(), ..ImmersedBody::fixed(self.surface(length)?, centre) };
        Ok((PeriodicBox::new(grid), body))
    }

    fn surface(&self, length: f64) -> Result<Arc<dyn Surface>, Failure> {
        let diameter = self.diameter();
        let lobes = |count| lobes_that_fill(count, diameter, self.shape.share());
        Ok(match self.shape {
            Shape::Cylinder => self.prism(Circle { radius: 0.5 * diameter }, length),
            Shape::Trilobe => self.prism(lobes(3)?, length),
            Shape::Quadralobe => self.prism(lobes(4)?, length),
        })
    }

    fn prism(&self, outline: impl Outline + 'static, length: f64) -> Arc<dyn Surface> {
        if self.family == Family::Endless { Arc::new(Prism::joined(outline, length)) } else { Arc::new(Prism::closed(outline, length)) }
    }

    /// A quadralobe stands with two lobes on each side of the cell, as its neighbours are nearest so.
    fn orientation(&self) -> Orientation {
        let square = if self.shape == Shape::Quadralobe { FRAC_PI_4 } else { 0.0 };
        let turn = if self.course == Course::Turned { 20.0_f64.to_radians() } else { 0.0 };
        let about = |axis: Vector| Orientation::from_scaled_axis(axis * turn);
        about(Vector::z()) * about(Vector::y()) * about(Vector::x()) * Orientation::from_scaled_axis(Vector::z() * square)
    }

    /// Solves with the body moved by some spacings.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the body or the solver does not converge.
    pub fn solve(&self, place: [f64; 3]) -> Result<Found, Failure> {
        let (flow, body) = self.set_up(place)?;
        self.held(&flow, body, &[self.course.direction()]).map(|(found, _)| found[0])
    }

    /// Drag on the body in flows along each direction, as columns, all over the same.
    ///
    /// # Errors
    ///
    /// As [`Problem::solve`].
    pub fn resistance(&self, place: [f64; 3]) -> Result<nalgebra::Matrix3<f64>, Failure> {
        let (flow, body) = self.set_up(place)?;
        let found = self.held(&flow, body, &[Vector::x(), Vector::y(), Vector::z()])?.0;
        Ok(nalgebra::Matrix3::from_columns(&[found[0].drag, found[1].drag, found[2].drag]))
    }

    /// Time, places along and across the flow, and speed of the fluid in the plane through the middle of the body, at right angles to its axis.
    ///
    /// # Errors
    ///
    /// As [`Problem::solve`].
    pub fn slice(&self, place: [f64; 3]) -> Result<Vec<Seen>, Failure> {
        let (flow, body) = self.set_up(place)?;
        let (_, steady) = self.held(&flow, body.clone(), &[self.course.direction()])?;
        let grid = flow.grid();
        let level = grid.in_cells(None, &body.position).z.round() as usize;
        let seen = |index: usize| {
            let cell = grid.cell(index);
            let at = grid.position(None, cell.map(|number| number as isize));
            let is_fluid = body.nearest(&at, &grid.extent()).1.distance > 0.0;
            let middle = |direction: usize| {
                let values = &steady.velocity.component[direction];
                0.5 * (values[index] + values[grid.neighbour(cell, direction, 1)])
            };
            (cell[2] == level && is_fluid).then(|| [0.0, at.x, at.y, Vector::from_fn(|direction, _| middle(direction)).norm()])
        };
        Ok((0..grid.len()).filter_map(seen).collect())
    }

    /// What is found in flows of some mean velocities, and the last of these flows.
    fn held(&self, flow: &PeriodicBox, body: ImmersedBody, mean_velocities: &[Vector]) -> Result<(Vec<Found>, SteadyFlow), Failure> {
        let bodies = [body];
        let (ghosts, points);
        let (constraint, fallbacks): (&dyn Constraint, Continued) = match self.method {
            Method::Sharp => {
                ghosts = Ghosts::new(flow.grid(), &bodies, Continuation::Quadratic).map_err(failure)?;
                (&ghosts, ghosts.continued())
            }
            Method::Points => {
                let rules = PointRules { distance: POINT_DISTANCE, degree: Degree::QuadraticOutward, interior: true };
                points = Points::new(flow.grid(), &bodies, &rules).map_err(failure)?;
                (&points, Continued::default())
            }
        };
        let mut found = Vec::new();
        let mut last = None;
        for mean_velocity in mean_velocities {
            let (one, steady) = self.steady(flow, &bodies[0], constraint, *mean_velocity)?;
            found.push(Found { fallbacks, ..one });
            last = Some(steady);
        }
        Ok((found, last.ok_or_else(|| Failure::NothingMeasured("no flow".into()))?))
    }

    fn steady(
        &self,
        flow: &PeriodicBox,
        body: &ImmersedBody,
        constraint: &dyn Constraint,
        mean_velocity: Vector,
    ) -> Result<(Found, SteadyFlow), Failure> {
        let problem = SteadyProblem { viscosity: 1.0, mean_velocity, tolerance: TOLERANCE, most_iterations: 900 };
        let steady = solve(flow, constraint, &problem);
        if steady.residual > TOLERANCE || steady.residual.is_nan() {
            return Err(Failure::NothingMeasured(format!("a residual of {:e} after {} flows", steady.residual, steady.iterations)));
        }
        let grid = flow.grid();
        let force = constraint.loads(&steady.forces, 1)[0].force;
        let driving = steady.mean_pressure_gradient * grid.volume();
        let found = Found {
            drag: force / self.drag_unit(grid) / superficial_velocity(grid, body, &steady.velocity, mean_velocity),
            divergence: largest_divergence(grid, &steady.velocity),
            residual: steady.residual,
            imbalance: (force + driving).norm() / force.norm(),
            flows: steady.iterations,
            inverted_cells: (3 * steady.iterations * grid.len()) as f64,
            conditions: constraint.len(),
            fallbacks: Continued::default(),
        };
        Ok((found, steady))
    }

    /// What drag is measured in, at unit viscosity and velocity.
    fn drag_unit(&self, grid: &Grid) -> f64 {
        match self.family {
            Family::Endless => grid.extent().z,
            _ => 6.0 * PI * (3.0 * self.fraction * grid.volume() / (4.0 * PI)).cbrt(),
        }
    }
}

/// Mean over the whole cell of the velocity of the fluid alone, along the flow.
///
/// No fluid is gained or lost, so every plane across the flow sees the mean of the whole cell; where one misses the body that is a flow of fluid alone. Past
/// a body without ends in its own direction every plane also cuts what the body holds, which moves though its surface does not, and has to be left out.
fn superficial_velocity(grid: &Grid, body: &ImmersedBody, velocity: &FaceField, mean_velocity: Vector) -> f64 {
    let is_along_endless = body.surface.joined_length().is_some() && mean_velocity.z != 0.0;
    if !is_along_endless {
        return mean_velocity.norm();
    }
    let is_fluid = |index: usize| {
        let place = grid.position(Some(2), grid.cell(index).map(|number| number as isize));
        body.nearest(&place, &grid.extent()).1.distance > 0.0
    };
    let of_fluid = velocity.component[2].iter().enumerate().filter(|(index, _)| is_fluid(*index));
    of_fluid.map(|(_, value)| value).sum::<f64>() / grid.len() as f64
}

/// Lobes that fill a share of their circumscribed circle: those that fill more overlap more.
fn lobes_that_fill(count: usize, diameter: f64, share: f64) -> Result<Lobes, Failure> {
    let of = |radius: f64| Lobes::new(count, radius, 0.5 * diameter - radius);
    let touching = Lobes::touching(count, diameter).map_err(failure)?;
    // Lobes merge where each holds the centres of its neighbours.
    let sine = (PI / count as f64).sin();
    let merged = 0.5 * diameter * 2.0 * sine / (1.0 + 2.0 * sine);
    let (mut low, mut high) = (0.5 * diameter * sine / (1.0 + sine), merged * (1.0 - 1e-9));
    let area = share * 0.25 * PI * diameter * diameter;
    if area < touching.area() {
        return Err(Failure::NothingMeasured(format!("{count} lobes that touch fill more than {share} of their circle")));
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if of(middle).map_err(failure)?.area() < area { low = middle } else { high = middle }
    }
    of(high).map_err(failure)
}

fn failure(error: impl std::fmt::Display) -> Failure {
    Failure::NothingMeasured(error.to_string())
}

fn largest_divergence(grid: &Grid, velocity: &FaceField) -> f64 {
    divergence(grid, velocity).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs())) * grid.spacing()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(shape: Shape, family: Family, fraction: f64, edge: usize) -> Problem {
        Problem { shape, family, course: Course::Turned, fraction, method: Method::Sharp, edge }
    }

    /// R's table 7.1: one volume and one length, so diameters are to each other as R prints them.
    #[test]
    fn bodies_that_are_compared_have_the_diameters_of_the_source() {
        let diameters = Shape::ALL.map(|shape| problem(shape, Family::Compared, 0.34, 16).diameter());
        for (shape, diameter) in Shape::ALL.into_iter().zip(diameters) {
            assert!((diameter / diameters[0] - shape.diameter_over_length() / 0.349).abs() < 1e-14, "{shape:?}");
        }
        let volume = 0.25 * PI * diameters[0].powi(3) / 0.349;
        assert!((volume / (0.34 * 2.5) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn lobes_fill_what_is_asked_for_within_their_circle() {
        for (count, shape) in [(3, Shape::Trilobe), (4, Shape::Quadralobe)] {
            let lobes = lobes_that_fill(count, 0.8, shape.share()).expect("a share between touching and merged");
            assert!((lobes.area() / (shape.share() * PI * 0.16) - 1.0).abs() < 1e-12);
            assert!((lobes.diameter() - 0.8).abs() < 1e-15);
        }
        assert!(lobes_that_fill(3, 0.8, 0.5).is_err());
    }

    #[test]
    fn grids_that_cannot_hold_a_body_are_failed_runs_that_say_why() {
        let message = |problem: Problem| problem.solve([0.1, 0.2, 0.3]).expect_err("a body that must be refused").to_string();
        assert!(message(problem(Shape::Trilobe, Family::Short, 0.01, 4)).contains("at least 1 are needed"));
        assert!(message(problem(Shape::Cylinder, Family::Short, 0.95, 16)).contains("its own image"));
        assert!(message(problem(Shape::Cylinder, Family::Short, 0.2, 2)).contains("at least 4 are needed"));
        assert!(message(problem(Shape::Cylinder, Family::Short, f64::NAN, 16)).contains("not a finite number"));
        assert!(problem(Shape::Trilobe, Family::Short, f64::NAN, 16).solve([0.0; 3]).is_err());
    }
}
