//! A sphere held in a stream, of unit diameter, speed and density, marched until its drag stays.

use std::f64::consts::PI;
use std::sync::Arc;

use solver::Vector;
use solver::coupling::resolved::balance::{Driving, Stop};
use solver::coupling::resolved::fringe::Fringe;
use solver::coupling::resolved::immersed::{ImmersedBody, TOUCHING};
use solver::coupling::resolved::surface::Ball;
use solver::coupling::resolved::unsteady::{Body, Settings, Unsteady};
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::operators::divergence;
use solver::fluid::periodic::PeriodicBox;

/// What may go wrong in a run.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// What surrounds the sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surroundings {
    /// A stream in a box of so many diameters across, half as long again, its last quarter a fringe; it repeats across, which is a row of spheres side by side.
    Stream {
        /// In diameters.
        across: f64,
    },
    /// A simple cubic array without advection.
    CreepingArray {
        /// Edge of a cell in diameters.
        edge: f64,
    },
}

/// What is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Problem {
    /// On the diameter and the speed of the stream.
    pub reynolds: f64,
    /// The box.
    pub surroundings: Surroundings,
    /// Spacings a diameter.
    pub cells: f64,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Found {
    /// Drag over that of the dynamic pressure on the cross-section.
    pub drag_coefficient: f64,
    /// Drag over Stokes' drag.
    pub friction: f64,
    /// Largest, times spacing over speed.
    pub divergence: f64,
    /// Root mean square over the speed, of conditions that can be met.
    pub slip: f64,
    /// The same of all.
    pub full_slip: f64,
    /// Steps.
    pub steps: usize,
    /// Flows solved for.
    pub flows: usize,
    /// Cells of the grid.
    pub grid_cells: usize,
    /// Time, place along and across the stream, and speed in the plane through the middle.
    pub slice: Vec<[f64; 4]>,
}

/// Residual slip of a step over the speed.
pub const SLIP: f64 = 1e-3;
/// Change of the drag over the time in which the stream passes a diameter, at which it counts as steady.
pub const STEADY: f64 = 3e-4;
/// Spacings that the stream passes in a step.
const COURANT: f64 = 0.5;
/// A flow that is not steady by then will not be, in diameters over speed.
const LONGEST: f64 = 60.0;
/// The sphere's place between the values of the grid, in spacings: no plane of symmetry helps.
const PLACE: [f64; 3] = [0.22, 0.13, 0.37];

impl Problem {
    /// Marches from a uniform stream until the drag stays.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the sphere, the flow blows up or is not steady in the end.
    pub fn solve(&self) -> Result<Found, Error> {
        let flow = PeriodicBox::new(self.grid()?);
        let (grid, stream) = (flow.grid(), Vector::x());
        let start = FaceField::from_fn(grid, |component, _| stream[component]);
        let settings = self.settings(grid, stream);
        let body = Body { immersed: ImmersedBody::fixed(Arc::new(Ball { radius: 0.5 }), self.centre(grid)), matter: None };
        let mut unsteady = Unsteady::new(flow.clone(), settings, vec![body], start)?;
        let (mut steps, mut flows) = (0, 0);
        let (mut last, mut checked) = (f64::INFINITY, 0.0);
        let unit = settings.step.max(self.unit_of_time());
        loop {
            let step = unsteady.step()?;
            (steps, flows) = (steps + 1, flows + step.flows);
            if unsteady.time() < checked + unit {
                continue;
            }
            let drag = unsteady.loads()[0].force.x;
            if (drag - last).abs() <= STEADY * drag * (unsteady.time() - checked) / self.unit_of_time() {
                return Ok(self.found(&unsteady, grid, drag, (steps, flows), (step.slip, step.full_slip)));
            }
            (last, checked) = (drag, unsteady.time());
            if unsteady.time() > LONGEST * self.unit_of_time() {
                return Err(format!("the drag still changed after {LONGEST} diameters").into());
            }
        }
    }

    /// The time in which things change: that of the stream, or of diffusion in an array.
    fn unit_of_time(&self) -> f64 {
        match self.surroundings {
            Surroundings::Stream { .. } => 1.0,
            Surroundings::CreepingArray { .. } => 0.25 * self.reynolds,
        }
    }

    fn extent(&self) -> [f64; 3] {
        match self.surroundings {
            Surroundings::Stream { across } => [1.5 * across, across, across],
            Surroundings::CreepingArray { edge } => [edge; 3],
        }
    }

    fn grid(&self) -> Result<Grid, Error> {
        let extent = self.extent();
        let cells = extent.map(|length| (length * self.cells).round().max(1.0) as usize);
        // The cells of an array are what must be exact; those of a stream are whole.
        Ok(Grid::new(cells, extent[0] / cells[0] as f64, Vector::zeros())?)
    }

    fn centre(&self, grid: &Grid) -> Vector {
        let extent = grid.extent();
        Vector::new(0.3 * extent.x, 0.5 * extent.y, 0.5 * extent.z) + Vector::from(PLACE) * grid.spacing()
    }

    fn settings(&self, grid: &Grid, stream: Vector) -> Settings {
        let length = grid.extent().x;
        let (fringe, step) = match self.surroundings {
            // What comes out of the fringe is uniform to the exponential of minus six.
            Surroundings::Stream { .. } => {
                let fringe = Fringe { between: [0.75 * length, length], rate: 12.0 / (0.25 * length), velocity: stream };
                (Some(fringe), COURANT * grid.spacing())
            }
            Surroundings::CreepingArray { .. } => (None, 0.25 * self.unit_of_time()),
        };
        Settings {
            density: 1.0,
            viscosity: 1.0 / self.reynolds,
            advection: fringe.is_some(),
            gravity: Vector::zeros(),
            driving: Driving::MeanVelocity(stream),
            walls: [None; 3],
            fringe,
            step,
            stop: Stop { slip: if fringe.is_some() { SLIP } else { 0.01 * SLIP }, most_iterations: 300 },
            deepest_overlap: TOUCHING,
        }
    }

    fn found(&self, unsteady: &Unsteady, grid: &Grid, drag: f64, (steps, flows): (usize, usize), (slip, full_slip): (f64, f64)) -> Found {
        let largest = divergence(grid, unsteady.velocity()).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        Found {
            drag_coefficient: drag / (0.125 * PI),
            friction: drag * self.reynolds / (3.0 * PI),
            divergence: largest * grid.spacing(),
            slip,
            full_slip,
            steps,
            flows,
            grid_cells: grid.len(),
            slice: slice(unsteady, grid),
        }
    }
}

fn slice(unsteady: &Unsteady, grid: &Grid) -> Vec<[f64; 4]> {
    let body = &unsteady.bodies()[0].immersed;
    let level = grid.in_cells(None, &body.position).z.round() as usize;
    let seen = |index: usize| {
        let cell = grid.cell(index);
        let at = grid.position(None, cell.map(|number| number as isize));
        let is_fluid = body.foot(&body.arm(&at, &grid.extent())).distance > 0.0;
        let middle = |direction: usize| {
            let values = &unsteady.velocity().component[direction];
            0.5 * (values[index] + values[grid.neighbour(cell, direction, 1)])
        };
        (cell[2] == level && is_fluid).then(|| [0.0, at.x, at.y, Vector::from_fn(|direction, _| middle(direction)).norm()])
    };
    (0..grid.len()).filter_map(seen).collect()
}
