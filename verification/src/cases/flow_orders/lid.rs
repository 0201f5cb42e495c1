//! The cube whose lid moves, at a Reynolds number of 1000.

use std::sync::OnceLock;

use reports::row::ReferenceKind;
use solver::Vector;
use solver::fluid::grid::Grid;
use solver::fluid::navier_stokes::{Flow, Fluid, Numerics};
use solver::fluid::sides::{Ends, Side, Sides};

use super::{Error, Variant, divergence, error, measurement, no_divergence};
use crate::case::{Curve, Measurement, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::variant::Variant as _;

pub(super) const PROFILES: &str = "error of the profiles / speed of the lid";
const TABLE: &str = include_str!("../../../../reference-data/lid_driven_cube/data.csv");
/// Digits of the table.
const PRINTED: f64 = 5e-6;
/// Change of a velocity in a unit of time at which the flow is steady, over the speed of the lid.
const STEADY: f64 = 1e-5;
const LONGEST: f64 = 150.0;
const COURANT: f64 = 0.8;

/// A row of the table: place and speed along the one line and along the other.
type TableRow = [f64; 4];

fn table() -> &'static [TableRow] {
    static ROWS: OnceLock<Vec<TableRow>> = OnceLock::new();
    ROWS.get_or_init(|| {
        let row = |line: &str| {
            let mut numbers = line.split(',').filter_map(|word| word.parse().ok());
            Some([numbers.next()?, numbers.next()?, numbers.next()?, numbers.next()?])
        };
        TABLE.lines().filter_map(row).collect()
    })
}

/// The steady flow and the steps that it took.
fn steady(cells: usize) -> Result<(Flow, usize), Error> {
    let grid = Grid::new([cells; 3], 1.0 / cells as f64, Vector::repeat(-0.5))?;
    let wall = Ends::Sides([Side::REST; 2]);
    let lid = Ends::Sides([Side::Wall { velocity: Vector::y() }, Side::REST]);
    let mut flow = Flow::new(grid, Sides::new([lid, wall, wall])?, Fluid { density: 1.0, viscosity: 1e-3 }, Numerics::default())?;
    let step = COURANT / cells as f64;
    let every = (1.0 / step).round() as usize;
    let mut steps = 0;
    while flow.time() < LONGEST {
        let before = flow.velocity().clone();
        (0..every).try_for_each(|_| flow.step(step, None))?;
        steps += every;
        let change =
            flow.velocity().iter().zip(&before).flat_map(|(now, before)| now.iter().zip(before)).map(|(now, before)| (now - before).abs());
        if change.fold(0.0, f64::max) < STEADY * every as f64 * step {
            return Ok((flow, steps));
        }
    }
    Err(format!("not steady after {LONGEST} times the lid's passage").into())
}

/// Velocities along the middle line of a direction, from wall to wall: the component of the other direction of the plane.
fn profile(flow: &Flow, direction: usize) -> Vec<[f64; 2]> {
    let border = flow.border();
    let grid = border.grid();
    let (cells, component) = (grid.cells()[direction], 1 - direction);
    let middle = cells / 2;
    let at = |number: usize, depth: usize| {
        let mut cell = [middle, middle, depth];
        cell[direction] = number;
        flow.velocity()[component][border.index(cell)]
    };
    let walls = [if direction == 0 { 1.0 } else { 0.0 }, 0.0];
    let place = |number: usize| -0.5 + (number as f64 + 0.5) * grid.spacing();
    let inner = (0..cells).map(|number| [place(number), 0.5 * (at(number, middle - 1) + at(number, middle))]);
    std::iter::once([-0.5, walls[0]]).chain(inner).chain([[0.5, walls[1]]]).collect()
}

/// A value between points, by the cubic through the nearest four.
fn interpolate(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.partition_point(|point| point[0] < x);
    let first = after.saturating_sub(2).min(points.len() - 4);
    let near = &points[first..first + 4];
    let weight = |own: usize| {
        (0..4).filter(|other| *other != own).map(|other| (x - near[other][0]) / (near[own][0] - near[other][0])).product::<f64>()
    };
    (0..4).map(|own| weight(own) * near[own][1]).sum()
}

pub(super) fn measure(cells: usize) -> Result<Measurement, Error> {
    let (flow, steps) = steady(cells)?;
    let (across, along) = (profile(&flow, 0), profile(&flow, 1));
    let rows: Vec<Vec<f64>> =
        table().iter().map(|[x, v, y, u]| vec![*x, interpolate(&across, *x), *v, *y, interpolate(&along, *y), *u]).collect();
    let misses = rows.iter().flat_map(|row| [row[1] - row[2], row[4] - row[5]]);
    let root = (misses.map(|miss| miss * miss).sum::<f64>() / (2 * rows.len()) as f64).sqrt();
    let source = "Albensoeder and Kuhlmann 2005, tables 5 and 6";
    let profiles = error(PROFILES, vec![root], PRINTED, ReferenceKind::Computed, source);
    let mut measured = measurement(vec![profiles, divergence(&flow)], &flow, steps);
    measured.curves = vec![Curve { file: format!("lid_{cells}.csv"), columns: vec!["x", "v", "v_table", "y", "u", "u_table"], rows }];
    Ok(measured)
}

pub(super) fn claims_at(variant: &Variant, tier: Tier, knob: f64) -> Vec<Claim> {
    let finest = variant.knobs(tier).last() == Some(&knob);
    // A layer at the lid is as thick as the root of viscosity times passage over speed.
    let layer = 1000_f64.sqrt() / knob;
    let bound = Bound::new(1.0, layer * layer / 12.0, "(h / thickness of the layer at the lid)^2 / 12");
    let error = variant.claim_at(knob, PROFILES, Statistic::Single, bound, Expected::Holds);
    finest.then_some(error).into_iter().chain([no_divergence(variant, knob)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_whole_and_cubics_are_interpolated_exactly() {
        assert_eq!((table().len(), table()[4]), (17, [-0.4531, 0.33171, -0.4062, -0.24407]));
        let cubic = |x: f64| 1.0 + x * (2.0 + x * (3.0 - 4.0 * x));
        let points: Vec<[f64; 2]> = [-0.5, -0.4, -0.1, 0.2, 0.3, 0.5].map(|x| [x, cubic(x)]).into();
        for x in [-0.5, -0.45, 0.0, 0.25, 0.41, 0.5] {
            assert!((interpolate(&points, x) - cubic(x)).abs() < 1e-14);
        }
    }
}
