//! Creeping flow through a simple cubic array of spheres, an eighth of it solid, as a field for ParaView.
//!
//! ```text
//! cargo run --release -p solver --example flow_field -- flow.vti          24 cells an edge
//! cargo run --release -p solver --example flow_field -- flow.vti 48
//! ```

use std::io::{BufWriter, Write};
use std::sync::Arc;

use solver::Vector;
use solver::coupling::resolved::constraint::Constraint;
use solver::coupling::resolved::ghosts::{Continuation, Ghosts};
use solver::coupling::resolved::immersed::ImmersedBody;
use solver::coupling::resolved::measures::{FluidShare, pressure};
use solver::coupling::resolved::steady::{SteadyProblem, solve};
use solver::coupling::resolved::surface::Ball;
use solver::fluid::grid::{FaceField, Grid};
use solver::fluid::periodic::PeriodicBox;
use solver::output::flow_vtk::{FlowSnapshot, write_flow};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("the name of a file to write, and, if other than 24, a number of cells")?;
    let cells = arguments.next().map_or(Ok(24), |word| word.parse::<usize>())?;
    let flow = PeriodicBox::new(Grid::new([cells; 3], 1.0 / cells as f64, Vector::zeros())?);
    let grid = flow.grid();
    let radius = (3.0 / (32.0 * std::f64::consts::PI)).cbrt();
    let bodies = [ImmersedBody::fixed(Arc::new(Ball { radius }), Vector::repeat(0.5))];
    let ghosts = Ghosts::new(grid, &bodies, Continuation::Quadratic)?;
    let steady =
        solve(&flow, &ghosts, &SteadyProblem { viscosity: 1.0, mean_velocity: Vector::x(), tolerance: 1e-6, most_iterations: 500 });
    let mut forces = FaceField::zeros(grid);
    ghosts.spread(&steady.forces, &mut forces);
    let (pressure, share) = (pressure(&flow, &forces), FluidShare::new(grid, &bodies)?);
    let mut writer = BufWriter::new(std::fs::File::create(&file)?);
    write_flow(&FlowSnapshot { grid, velocity: &steady.velocity, pressure: &pressure, share: &share }, &mut writer)?;
    writer.flush()?;
    println!("{file}: {} cells, {} flows, void fraction {:.4}", grid.len(), steady.iterations, share.void_fraction());
    Ok(())
}
