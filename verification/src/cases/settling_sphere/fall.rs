//! A sphere that moves freely in a cubic cell that repeats, of unit edge, fluid density and kinematic viscosity.

use std::f64::consts::PI;
use std::sync::Arc;

use solver::Vector;
use solver::coupling::resolved::balance::{Driving, Stop};
use solver::coupling::resolved::immersed::{ImmersedBody, TOUCHING};
use solver::coupling::resolved::matter::Matter;
use solver::coupling::resolved::surface::Ball;
use solver::coupling::resolved::unsteady::{Body, Settings, Unsteady, UnsteadyError};
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::periodic::PeriodicBox;

/// What may go wrong in a run.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// What is solved: lengths in edges of the cell, times in squares of the radius over the viscosity, velocities in those of a sphere that falls without bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// Volume of the sphere over that of the cell.
    pub fraction: f64,
    /// Spacings a diameter, about: cells are whole.
    pub cells: f64,
    /// Of the sphere over the fluid.
    pub density_ratio: f64,
    /// Stokes' velocity over the viscosity times radius: how far it falls in a unit of time, in radii.
    pub speed: f64,
    /// Steps in the time in which vorticity spreads over a radius.
    pub steps_a_time: f64,
    /// Slip at which a step's iteration stops, over Stokes' velocity.
    pub slip: f64,
}

/// A point of a fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// In squares of the radius over the viscosity.
    pub time: f64,
    /// In Stokes' velocities.
    pub speed: f64,
    /// Fastest of what should be none: velocities across, and of the surface by turning; in Stokes' velocities.
    pub aside: f64,
}

/// What was found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Found {
    /// Every step.
    pub points: Vec<Point>,
    /// Flows solved for.
    pub flows: usize,
    /// Cells of the grid.
    pub grid_cells: usize,
    /// Largest slip that an iteration left, in Stokes' velocities.
    pub slip: f64,
    /// Spacings a diameter as they came out.
    pub cells: f64,
}

/// Where the centre is, in spacings from the middle of the cell.
const PLACE: [f64; 3] = [0.22, 0.13, 0.37];
/// Most flows of a step.
const MOST: usize = 300;

/// Cells along an edge for spacings a diameter.
fn edge(diameter: f64, cells: f64) -> usize {
    (cells / diameter).round().max(1.0) as usize
}

/// Radius in edges of the cell.
pub fn radius(fraction: f64) -> f64 {
    (0.75 * fraction / PI).cbrt()
}

impl Fall {
    /// Falls from rest for a time.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the sphere, or a step fails.
    pub fn run(&self, end: f64) -> Result<Found, Error> {
        let radius = radius(self.fraction);
        let edge = edge(2.0 * radius, self.cells);
        let flow = PeriodicBox::new(Grid::new([edge; 3], 1.0 / edge as f64, Vector::zeros())?);
        let (time, stokes) = (radius * radius, self.speed / radius);
        let matter = Matter::ellipsoid(self.density_ratio, &Vector::repeat(radius));
        // A sphere of the fluid's own density has no weight.
        let excess = (self.density_ratio - 1.0) * matter.volume;
        let gravity = if excess == 0.0 { 1.0 } else { 6.0 * PI * radius * stokes / excess };
        let settings = Settings {
            density: 1.0,
            viscosity: 1.0,
            advection: false,
            gravity: Vector::x() * gravity,
            driving: Driving::MeanVelocity(Vector::zeros()),
            walls: [None; 3],
            fringe: None,
            step: time / self.steps_a_time,
            stop: Stop { slip: self.slip * stokes, most_iterations: MOST },
            deepest_overlap: TOUCHING,
        };
        let centre = Vector::repeat(0.5) + Vector::from(PLACE) / edge as f64;
        let body = Body { immersed: ImmersedBody::fixed(Arc::new(Ball { radius }), centre), matter: Some(matter) };
        let mut unsteady = Unsteady::new(flow.clone(), settings, vec![body], FaceField::zeros(flow.grid()))?;
        let mut found = Found { grid_cells: flow.grid().len(), cells: 2.0 * radius * edge as f64, ..Found::default() };
        let steps = (end * self.steps_a_time).round().max(1.0) as usize;
        for _ in 0..steps {
            let step = unsteady.step()?;
            let body = &unsteady.bodies()[0].immersed;
            let aside = body.velocity.yz().norm().max(body.angular_velocity.norm() * radius);
            found.points.push(Point { time: unsteady.time() / time, speed: body.velocity.x / stokes, aside: aside / stokes });
            found.flows += step.flows;
            found.slip = found.slip.max(step.slip / stokes);
        }
        Ok(found)
    }
}

/// A sphere held in a stream through an array, or moved against the fluid at rest: the same flow in two frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frames {
    /// On the diameter.
    pub reynolds: f64,
    /// Edge of the cell in diameters.
    pub edge: f64,
    /// Spacings a diameter.
    pub cells: f64,
}

impl Frames {
    /// Drag over that of Stokes in the held frame and in the moved one, each the mean over the passage of two diameters after the start; and flows solved for.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the sphere, or a step fails.
    pub fn drags(&self) -> Result<([f64; 2], usize), Error> {
        let (held, flows) = self.drag(Vector::x(), Vector::zeros())?;
        let (moved, more) = self.drag(Vector::zeros(), -Vector::x())?;
        Ok(([held, moved], flows + more))
    }

    fn drag(&self, stream: Vector, velocity: Vector) -> Result<(f64, usize), UnsteadyError> {
        let number = (self.edge * self.cells).round() as usize;
        let spacing = self.edge / number as f64;
        let grid =
            Grid::new([number; 3], spacing, Vector::zeros()).map_err(|_| UnsteadyError::Number { name: "spacing", value: spacing })?;
        let flow = PeriodicBox::new(grid);
        let settings = Settings {
            density: 1.0,
            viscosity: 1.0 / self.reynolds,
            advection: true,
            gravity: Vector::zeros(),
            driving: Driving::MeanVelocity(stream),
            walls: [None; 3],
            fringe: None,
            step: 0.25 * spacing,
            stop: Stop { slip: 1e-4, most_iterations: MOST },
            deepest_overlap: TOUCHING,
        };
        let centre = Vector::repeat(0.5 * self.edge) + Vector::from(PLACE) * spacing;
        let mut immersed = ImmersedBody::fixed(Arc::new(Ball { radius: 0.5 }), centre);
        immersed.velocity = velocity;
        let start = FaceField::from_fn(flow.grid(), |component, _| stream[component]);
        let mut unsteady = Unsteady::new(flow.clone(), settings, vec![Body { immersed, matter: None }], start)?;
        let (mut flows, mut sum, mut count) = (0, 0.0, 0.0);
        while unsteady.time() < 3.0 {
            flows += unsteady.step()?.flows;
            if unsteady.time() > 1.0 {
                sum += unsteady.loads()[0].force.x;
                count += 1.0;
            }
        }
        Ok((sum / count * self.reynolds / (3.0 * PI), flows))
    }
}
