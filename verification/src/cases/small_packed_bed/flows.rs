//! Flow through the bed, in units of the trilobes' diameter, the superficial velocity and the density of the fluid.

use solver::Vector;
use solver::coupling::resolved::constraint::Constraint;
use solver::coupling::resolved::fringe::Fringe;
use solver::coupling::resolved::ghosts::{Continuation, Continued, Ghosts};
use solver::coupling::resolved::immersed::ImmersedBody;
use solver::coupling::resolved::inertial::{InertialFlow, InertialProblem, solve_inertial};
use solver::coupling::resolved::measures::{FluidShare, cell_velocity, pressure};
use solver::coupling::resolved::steady::{SteadyProblem, solve};
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::operators::divergence;
use solver::fluid::periodic::PeriodicBox;

use super::bed::{self, Trilobe};

/// What may go wrong in a run.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// How fast the fluid is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Regime {
    /// Without inertia: the box repeats, and the bed is its own inlet and outlet.
    Creeping,
    /// On the diameter and the superficial velocity; a fringe behind R's box makes the stream uniform again.
    Reynolds(f64),
}

/// What is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Problem {
    /// How fast.
    pub regime: Regime,
    /// Cells a diameter.
    pub cells: usize,
}

/// What was found. Pressures are in viscosity times velocity over diameter.
#[derive(Debug, Clone)]
pub struct Found {
    /// From before the bed to behind it.
    pub drop: f64,
    /// The drop by the pressure field less that by drag and momentum, over the drop.
    pub imbalance: f64,
    /// Drop over a diameter inside the bed, between the cuts.
    pub gradient: f64,
    /// Between the cuts.
    pub void_fraction: f64,
    /// Between the cuts.
    pub tortuosity: f64,
    /// Volume of all solids as cells see it, over the exact one.
    pub solid_volume: f64,
    /// Largest of the flow that is missing in a layer, over the flow.
    pub leak: f64,
    /// Largest, times spacing over velocity.
    pub divergence: f64,
    /// Of the conditions that can be met: over their right side in creeping flow, else over the velocity, root mean square.
    pub residual: f64,
    /// Place in diameters, void fraction and pressure of each layer.
    pub layers: Vec<[f64; 3]>,
    /// In the plane through the middle of the box.
    pub slice: Vec<Seen>,
    /// Iterations of the flow with inertia.
    pub iterations: usize,
    /// Flows solved for.
    pub flows: usize,
    /// Cells of the grid.
    pub grid_cells: usize,
    /// How many conditions there are of which kind.
    pub continued: Continued,
    /// Pockets of cells that ghosts close in.
    pub pockets: usize,
}

/// Place along and across the flow, speed, and pressure.
pub type Seen = [f64; 4];

/// R's box in diameters.
const LENGTH: usize = 10;
/// The fringe behind it.
const FRINGE: usize = 2;
/// Residual of creeping flow at which the solver stops, over the first.
pub const TOLERANCE: f64 = 1e-3;
/// Slip that an iteration of the flow with inertia leaves, over the velocity; root mean square.
pub const SLIP: f64 = 1e-3;
/// Change of the velocity in an iteration at which it stops, over the velocity; root mean square. The drag then stays to two thousandths.
const CHANGE: f64 = 0.04;
/// A flow that is not steady by then will not be.
const MOST_ITERATIONS: usize = 100;
/// Cuts through the bed between which gradient and void fraction are taken, as shares of its height.
const CUTS: [f64; 2] = [0.2, 0.8];

/// A bed in its box.
struct SetUp {
    flow: PeriodicBox,
    trilobe: Trilobe,
    bodies: Vec<ImmersedBody>,
    share: FluidShare,
}

/// A flow that was found: what acts on the fluid but friction, and what holds the bodies.
struct State {
    velocity: FaceField,
    forces: FaceField,
    drag: f64,
    residual: f64,
    iterations: usize,
    flows: usize,
}

impl Problem {
    /// The creeping flow, and from there that with inertia if it is asked for.
    ///
    /// # Errors
    ///
    /// If the grid cannot hold the bed, the solver does not converge, or the flow blows up or is not steady in the end.
    pub fn solve(&self) -> Result<(Found, Option<Found>), Error> {
        let set_up = self.set_up()?;
        let ghosts = Ghosts::new(set_up.flow.grid(), &set_up.bodies, Continuation::Quadratic)?;
        let creeping = creeping(&set_up, &ghosts)?;
        let of_creeping = self.found(&set_up, &ghosts, &creeping, 1.0);
        let Regime::Reynolds(reynolds) = self.regime else { return Ok((of_creeping, None)) };
        let state = self.inertial(&set_up, &ghosts, reynolds, creeping.velocity)?;
        Ok((of_creeping, Some(self.found(&set_up, &ghosts, &state, reynolds))))
    }

    /// The creeping flow in the box of a regime.
    ///
    /// # Errors
    ///
    /// As [`Problem::solve`].
    pub fn creeping(&self) -> Result<Found, Error> {
        let set_up = self.set_up()?;
        let ghosts = Ghosts::new(set_up.flow.grid(), &set_up.bodies, Continuation::Quadratic)?;
        Ok(self.found(&set_up, &ghosts, &creeping(&set_up, &ghosts)?, 1.0))
    }

    fn set_up(&self) -> Result<SetUp, Error> {
        let across = bed::WIDTH as usize * self.cells;
        let along = self.cells * (LENGTH + if self.regime == Regime::Creeping { 0 } else { FRINGE });
        let grid = Grid::new([along, across, across], 1.0 / self.cells as f64, Vector::zeros())?;
        let trilobe = Trilobe::new()?;
        let bodies = trilobe.immersed();
        let share = FluidShare::new(&grid, &bodies)?;
        Ok(SetUp { flow: PeriodicBox::new(grid), trilobe, bodies, share })
    }

    /// The flow with inertia, from the creeping one.
    fn inertial(&self, set_up: &SetUp, ghosts: &Ghosts, reynolds: f64, start: FaceField) -> Result<State, Error> {
        let between = [LENGTH, LENGTH + FRINGE].map(|diameters| diameters as f64);
        let problem = InertialProblem {
            density: 1.0,
            viscosity: 1.0 / reynolds,
            mean_velocity: Vector::x(),
            // What comes out of it is uniform to the exponential of minus six.
            fringe: Some(Fringe { between, rate: 12.0 / FRINGE as f64, velocity: Vector::x() }),
            change: CHANGE,
            slip: SLIP,
            most_iterations: MOST_ITERATIONS,
        };
        let found = solve_inertial(&set_up.flow, ghosts, &problem, start)?;
        let drag = found.loads.iter().map(|load| load.force.x).sum();
        let InertialFlow { velocity, force_densities, iterations, flows, slip, .. } = found;
        Ok(State { velocity, forces: force_densities, drag, residual: slip, iterations, flows })
    }

    fn found(&self, set_up: &SetUp, ghosts: &Ghosts, state: &State, reynolds: f64) -> Found {
        let SetUp { flow, trilobe, bodies, share } = set_up;
        let grid = flow.grid();
        let pressures: Vec<f64> = pressure(flow, &state.forces).into_iter().map(|pressure| pressure * reynolds).collect();
        let void_fractions = share.void_fraction_by_layers(0);
        let means = share.mean_by_layers(&pressures, 0);
        let place = |layer: usize| grid.position(None, [layer as isize, 0, 0]).x;
        let layers: Vec<[f64; 3]> = (0..means.len()).map(|layer| [place(layer), void_fractions[layer], means[layer]]).collect();
        let behind = self.cells * LENGTH - 1;
        let drop = means[0] - means[behind];
        let height = bed::height(bodies);
        let [first, last] = CUTS.map(|share| ((bed::BEFORE + share * height) * self.cells as f64).round() as usize);
        let between = first..last;
        let void_fraction = void_fractions[between.clone()].iter().sum::<f64>() / between.len() as f64;
        let solid: f64 = share.shares().iter().map(|share| 1.0 - share).sum::<f64>() * grid.spacing().powi(3);
        let velocities = share.superficial_velocity_by_layers(&state.velocity, 0);
        Found {
            drop,
            imbalance: (drop - drop_by_momentum(grid, state, reynolds, [0, behind])) / drop,
            gradient: (means[first] - means[last]) / (between.len() as f64 * grid.spacing()),
            void_fraction,
            tortuosity: share.tortuosity(&state.velocity, 0, between),
            solid_volume: solid / (bodies.len() as f64 * trilobe.volume()),
            leak: velocities.iter().map(|velocity| (velocity.x - 1.0).abs()).fold(0.0, f64::max),
            divergence: divergence(grid, &state.velocity).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
                * grid.spacing(),
            residual: state.residual,
            layers,
            slice: slice(grid, share, &state.velocity, &pressures),
            iterations: state.iterations,
            flows: state.flows,
            grid_cells: grid.len(),
            continued: ghosts.continued(),
            pockets: ghosts.pockets(),
        }
    }
}

/// Drop by the drag on all bodies and by what more momentum leaves than comes, between the middles of two layers of cells without bodies.
fn drop_by_momentum(grid: &Grid, state: &State, reynolds: f64, [before, behind]: [usize; 2]) -> f64 {
    let section = bed::WIDTH * bed::WIDTH;
    let momentum = |layer: usize| {
        let cells = (0..grid.len()).filter(|index| grid.cell(*index)[0] == layer);
        let square = cells.map(|index| cell_velocity(grid, &state.velocity, index).x.powi(2)).sum::<f64>();
        square * grid.spacing() * grid.spacing()
    };
    // Creeping flow carries none.
    let carried = if state.iterations == 0 { 0.0 } else { momentum(behind) - momentum(before) };
    (state.drag + carried) / section * reynolds
}

/// Creeping flow of unit viscosity and velocity, at once.
fn creeping(set_up: &SetUp, ghosts: &Ghosts) -> Result<State, Error> {
    let problem = SteadyProblem { viscosity: 1.0, mean_velocity: Vector::x(), tolerance: TOLERANCE, most_iterations: 1500 };
    let steady = solve(&set_up.flow, ghosts, &problem);
    if steady.residual > TOLERANCE || steady.residual.is_nan() {
        return Err(format!("a residual of {:e} after {} flows", steady.residual, steady.iterations).into());
    }
    let mut forces = FaceField::zeros(set_up.flow.grid());
    ghosts.spread(&steady.forces, &mut forces);
    let drag = ghosts.loads(&steady.forces, set_up.bodies.len()).iter().map(|load| load.force.x).sum();
    Ok(State { velocity: steady.velocity, forces, drag, residual: steady.residual, iterations: 0, flows: steady.iterations })
}

fn slice(grid: &Grid, share: &FluidShare, velocity: &FaceField, pressures: &[f64]) -> Vec<Seen> {
    let level = grid.cells()[2] / 2;
    let seen = |index: usize| {
        let cell = grid.cell(index);
        let at = grid.position(None, cell.map(|number| number as isize));
        let speed = || cell_velocity(grid, velocity, index).norm();
        (cell[2] == level && share.shares()[index] > 0.5).then(|| [at.x, at.y, speed(), pressures[index]])
    };
    (0..grid.len()).filter_map(seen).collect()
}
