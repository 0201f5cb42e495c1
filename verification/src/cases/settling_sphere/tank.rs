//! A sphere that settles in a closed tank full of a viscous oil, as measured by ten Cate et al. (2002). SI units.

use std::sync::Arc;

use solver::Vector;
use solver::coupling::resolved::balance::{Driving, Stop};
use solver::coupling::resolved::immersed::{ImmersedBody, TOUCHING};
use solver::coupling::resolved::matter::Matter;
use solver::coupling::resolved::surface::Ball;
use solver::coupling::resolved::unsteady::{Body, Settings, Unsteady};
use solver::coupling::resolved::walls::Wall;
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::periodic::PeriodicBox;

use super::fall::Error;
use crate::exact::tank::Experiment;

/// Edges of the tank in m; gravity acts along the last.
pub const TANK: [f64; 3] = [0.1, 0.1, 0.16];
/// Of the centre above the floor at the start, in m.
const START: f64 = 0.1275;
/// Weight of a unit of mass in N/kg.
const GRAVITY: f64 = 9.81;
/// Slip at which the iteration of a step stops, over the velocity without bounds.
pub const SLIP: f64 = 1e-4;
/// Most flows of a step.
const MOST: usize = 300;
/// Height of the centre above the floor in diameters at which a run ends: the floor has long slowed the sphere down.
const END: f64 = 2.5;
/// Spacings that the sphere falls on its way over which velocities are averaged: the ripple of the grid is gone, and the velocity hardly changes.
const AVERAGED: f64 = 2.0;
/// The sphere's place across, between values of the grid, in spacings: no plane of symmetry helps.
const PLACE: [f64; 2] = [0.22, 0.13];

/// What is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tank {
    /// Fluid, sphere and what was measured.
    pub experiment: Experiment,
    /// Cells across the tank: a multiple of five, so that its height is whole.
    pub across: usize,
    /// Spacings that the sphere falls in a step at its velocity without bounds.
    pub courant: f64,
    /// How much wider than the tank of the experiment; its height and the spacing stay.
    pub wider: f64,
}

/// What was found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Settled {
    /// Times in s, heights of the centre above the floor in m, and speeds downwards in m/s.
    pub points: Vec<[f64; 3]>,
    /// Largest speed downwards in m/s, each averaged over the fall of two spacings.
    pub fastest: f64,
    /// Largest velocity across in m/s.
    pub aside: f64,
    /// Flows solved for.
    pub flows: usize,
    /// Cells of the grid.
    pub grid_cells: usize,
    /// Largest slip in m/s that an iteration left.
    pub slip: f64,
}

impl Tank {
    /// Falls from rest until the floor is near.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the sphere, or a step fails.
    pub fn run(&self) -> Result<Settled, Error> {
        let Experiment { fluid_density, viscosity, solid_density, diameter, unbounded, .. } = self.experiment;
        let spacing = TANK[0] / self.across as f64;
        let cells = [self.wider * TANK[0], self.wider * TANK[1], TANK[2]].map(|length| (length / spacing).round() as usize);
        let flow = PeriodicBox::new(Grid::new(cells, spacing, Vector::zeros())?);
        let (grid, radius) = (flow.grid(), 0.5 * diameter);
        let settings = Settings {
            density: fluid_density,
            viscosity,
            advection: true,
            gravity: Vector::new(0.0, 0.0, -GRAVITY),
            driving: Driving::MeanVelocity(Vector::zeros()),
            walls: [Some(Wall::Resting); 3],
            fringe: None,
            step: self.courant * spacing / unbounded,
            stop: Stop { slip: SLIP * unbounded, most_iterations: MOST },
            deepest_overlap: TOUCHING,
        };
        // The walls stand in the middles of the first cells.
        let floor = 0.5 * spacing;
        let middle = 0.5 * (grid.extent() + Vector::repeat(spacing));
        let centre = Vector::new(middle.x + PLACE[0] * spacing, middle.y + PLACE[1] * spacing, floor + START);
        let matter = Some(Matter::ellipsoid(solid_density, &Vector::repeat(radius)));
        let body = Body { immersed: ImmersedBody::fixed(Arc::new(Ball { radius }), centre), matter };
        let mut unsteady = Unsteady::new(flow.clone(), settings, vec![body], FaceField::zeros(grid))?;
        let mut settled = Settled { grid_cells: grid.len(), ..Settled::default() };
        while settled.points.last().is_none_or(|[_, height, _]| *height > END * diameter) {
            let step = unsteady.step()?;
            let body = &unsteady.bodies()[0].immersed;
            let (height, speed) = (body.position.z - floor, -body.velocity.z);
            settled.points.push([unsteady.time(), height, speed]);
            settled.aside = settled.aside.max(body.velocity.xy().norm());
            settled.flows += step.flows;
            settled.slip = settled.slip.max(step.slip);
        }
        let window = (AVERAGED / self.courant).ceil() as usize;
        let means =
            settled.points.windows(window + 1).map(|points| (points[0][1] - points[window][1]) / (points[window][0] - points[0][0]));
        settled.fastest = means.fold(0.0, f64::max);
        Ok(settled)
    }
}
