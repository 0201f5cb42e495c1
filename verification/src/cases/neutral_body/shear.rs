//! A spheroid of the fluid's own density between two walls that move apart, of unit shear rate, fluid density and largest semi-axis.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use solver::coupling::resolved::balance::{Driving, Stop};
use solver::coupling::resolved::immersed::{ImmersedBody, TOUCHING};
use solver::coupling::resolved::matter::Matter;
use solver::coupling::resolved::surface::spheroid::Spheroid;
use solver::coupling::resolved::unsteady::{Body, Settings, Step, Unsteady};
use solver::coupling::resolved::walls::Wall;
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::periodic::PeriodicBox;
use solver::{Orientation, Vector};

/// What may go wrong in a run.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// What is solved. The axis of the spheroid begins along the gradient and stays in the plane of flow and gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shear {
    /// Polar over equatorial axis.
    pub aspect: f64,
    /// Gap between the walls in largest diameters.
    pub gap: f64,
    /// Distance of images along and across the flow in largest diameters.
    pub apart: [f64; 2],
    /// Spacings a smallest diameter, about: cells are whole.
    pub cells: f64,
    /// Length of a step in inverse shear rates.
    pub step: f64,
    /// Where the centre is, in spacings from the middle of the box.
    pub place: [f64; 3],
}

/// Shear rate times the square of the largest semi-axis over the kinematic viscosity.
pub const REYNOLDS: f64 = 1e-3;
/// Slip at which the iteration of a step stops, in shear rates times largest semi-axes.
pub const SLIP: f64 = 1e-4;
/// Most flows of a step.
const MOST: usize = 300;

/// What was found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Turned {
    /// Times and angles of the axis from the gradient towards the flow.
    pub points: Vec<[f64; 2]>,
    /// Rate of that angle at the start.
    pub first_rate: f64,
    /// Largest velocity of the centre across the flow, and largest rate of turning out of the plane of flow and gradient.
    pub aside: f64,
    /// Flows solved for.
    pub flows: usize,
    /// Cells of the grid.
    pub grid_cells: usize,
    /// Largest slip that an iteration left.
    pub slip: f64,
}

impl Shear {
    /// The grid, and its middle.
    fn grid(&self) -> Result<(Grid, Vector), Error> {
        let smallest = 2.0 * self.aspect.min(1.0 / self.aspect);
        let between = (2.0 * self.gap * self.cells / smallest).round().max(1.0);
        let spacing = 2.0 * self.gap / between;
        let [along, across] = self.apart.map(|apart| (2.0 * apart / spacing).round() as usize);
        // The walls stand in the middles of the first and the last cells.
        let grid = Grid::new([along, across, between as usize + 1], spacing, Vector::zeros())?;
        Ok((grid, 0.5 * grid.extent()))
    }

    fn surface(&self) -> Spheroid {
        Spheroid { equatorial: 1.0_f64.min(1.0 / self.aspect), polar: 1.0_f64.min(self.aspect) }
    }

    fn settings(&self, step: f64) -> Settings {
        let wall = Vector::x() * self.gap;
        Settings {
            density: 1.0,
            viscosity: 1.0 / REYNOLDS,
            advection: true,
            gravity: Vector::new(0.0, 0.0, -1.0),
            driving: Driving::Force(Vector::zeros()),
            walls: [None, None, Some(Wall::Moving { lower: -wall, upper: wall })],
            fringe: None,
            step,
            stop: Stop { slip: SLIP, most_iterations: MOST },
            deepest_overlap: TOUCHING,
        }
    }

    fn body(&self, middle: &Vector, spacing: f64) -> Body {
        let surface = self.surface();
        let semi_axes = Vector::new(surface.equatorial, surface.equatorial, surface.polar);
        let centre = middle + Vector::from(self.place) * spacing;
        Body { immersed: ImmersedBody::fixed(Arc::new(surface), centre), matter: Some(Matter::ellipsoid(1.0, &semi_axes)) }
    }

    /// Turns until a time, or until its axis lies along the flow if that is asked for.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the body, or a step fails.
    pub fn run(&self, end: Option<f64>) -> Result<Turned, Error> {
        let (grid, middle) = self.grid()?;
        let flow = PeriodicBox::new(grid);
        let shear = FaceField::from_fn(&grid, |component, place| if component == 0 { place.z - middle.z } else { 0.0 });
        let mut turned = Turned { grid_cells: grid.len(), ..Turned::default() };
        // A step of any length from rest leaves the body where it is, and ends in creeping flow with the velocities that belong to it.
        let mut settling = Unsteady::new(flow.clone(), self.settings(1.0), vec![self.body(&middle, grid.spacing())], shear)?;
        turned.add(&settling.step()?);
        let settled = settling.bodies().to_vec();
        turned.first_rate = settled[0].immersed.angular_velocity.y;
        let mut unsteady = Unsteady::new(flow.clone(), self.settings(self.step), settled, settling.velocity().clone())?;
        turned.points.push([0.0, 0.0]);
        loop {
            let step = unsteady.step()?;
            turned.add(&step);
            let body = &unsteady.bodies()[0].immersed;
            let turning = &body.angular_velocity;
            turned.aside = turned.aside.max(body.velocity.yz().norm()).max(turning.x.hypot(turning.z));
            let [_, last] = turned.points[turned.points.len() - 1];
            let angle = unwrapped(&body.orientation, last);
            turned.points.push([unsteady.time(), angle]);
            let is_over = end.map_or(angle > FRAC_PI_2, |end| unsteady.time() > end - 0.5 * self.step);
            if is_over {
                return Ok(turned);
            }
        }
    }

    /// Largest velocity of the body and of its surface by turning after some steps at rest in fluid at rest.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the body, or a step fails.
    pub fn at_rest(&self, steps: usize) -> Result<f64, Error> {
        let (grid, middle) = self.grid()?;
        let flow = PeriodicBox::new(grid);
        let settings = Settings { walls: [None, None, Some(Wall::Resting)], ..self.settings(self.step) };
        let mut unsteady = Unsteady::new(flow.clone(), settings, vec![self.body(&middle, grid.spacing())], FaceField::zeros(&grid))?;
        for _ in 0..steps {
            unsteady.step()?;
        }
        let body = &unsteady.bodies()[0].immersed;
        Ok(body.velocity.norm().max(body.angular_velocity.norm()))
    }
}

impl Turned {
    fn add(&mut self, step: &Step) {
        self.flows += step.flows;
        self.slip = self.slip.max(step.slip);
    }

    /// Time at which the axis lies along the flow, by the parabola through the last three points: a quarter of a period.
    pub fn quarter(&self) -> Option<f64> {
        let [.., first, second, third] = self.points.as_slice() else { return None };
        // Of time as a function of the angle, by Lagrange.
        let through = [first, second, third];
        let time = through.iter().enumerate().map(|(one, [time, angle])| {
            let others = through.iter().enumerate().filter(|(other, _)| *other != one);
            time * others.map(|(_, [_, other])| (FRAC_PI_2 - other) / (angle - other)).product::<f64>()
        });
        Some(time.sum())
    }
}

/// Angle of the axis from the gradient towards the flow, nearest to the last one: an axis has no ends.
fn unwrapped(orientation: &Orientation, last: f64) -> f64 {
    let axis = orientation * Vector::z();
    let angle = axis.x.atan2(axis.z);
    angle + PI * ((last - angle) / PI).round()
}
