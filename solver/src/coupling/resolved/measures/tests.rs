//! Measures of fields whose means are known.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use super::*;
use crate::Orientation;
use crate::coupling::resolved::constraint::Constraint;
use crate::coupling::resolved::ghosts::{Continuation, Ghosts};
use crate::coupling::resolved::steady::{SteadyProblem, solve};
use crate::coupling::resolved::surface::Ball;
use crate::fluid::grid::cell_field;
use crate::fluid::operators::gradient;
use crate::shape::Cuboid;

fn grid(refinement: usize) -> Grid {
    Grid::new([12, 8, 10].map(|cells| cells * refinement), 0.1 / refinement as f64, Vector::new(0.3, -0.2, 0.1)).expect("enough cells")
}

const CENTRE: [f64; 3] = [0.893, 0.217, 0.611];
const RADIUS: f64 = 0.347;

fn ball() -> ImmersedBody {
    ImmersedBody::fixed(Arc::new(Ball { radius: RADIUS }), Vector::from(CENTRE))
}

fn share(grid: &Grid, body: ImmersedBody) -> FluidShare {
    FluidShare::new(grid, &[body]).expect("a body in its box")
}

/// Errors on three grids, each twice as fine as the last, fall with at least this order on the whole, and the finest is below a bound.
fn assert_order(error: impl Fn(&Grid) -> f64, order: f64, finest: f64) {
    let [coarse, fine] = [1, 4].map(|refinement| error(&grid(refinement)));
    assert!((coarse / fine).log2() / 2.0 > order - 0.25 && fine < finest, "{coarse:e} {fine:e}");
}

#[test]
fn void_fraction_of_a_box_with_a_ball_is_of_second_order() {
    let exact = 1.0 - 4.0 / 3.0 * PI * RADIUS.powi(3) / 0.96;
    assert_order(|grid| (share(grid, ball()).void_fraction() / exact - 1.0).abs(), 2.0, 4e-4);
}

/// Layers of a ball are discs whose area is integrated over the layer.
#[test]
fn void_fraction_of_layers_is_what_discs_leave() {
    let error = |grid: &Grid| {
        let below = |height: f64| {
            let height = height.clamp(-RADIUS, RADIUS);
            PI * (RADIUS * RADIUS * height - height.powi(3) / 3.0)
        };
        let got = share(grid, ball()).void_fraction_by_layers(2);
        let wanted = (0..grid.cells()[2]).map(|layer| {
            let lower = grid.lower().z + layer as f64 * grid.spacing() - CENTRE[2];
            1.0 - (below(lower + grid.spacing()) - below(lower)) / (1.2 * 0.8 * grid.spacing())
        });
        got.iter().zip(wanted).map(|(got, wanted)| (got - wanted).abs()).fold(0.0, f64::max)
    };
    // In the caps of a ball the surface lies along the layer and jumps by a cell.
    assert_order(error, 1.0, 0.02);
}

/// Pressure $z^2$ around a ball: a mean over what is left of the layer, here over layers along x.
#[test]
fn mean_pressure_is_that_of_the_fluid_alone() {
    let error = |grid: &Grid| {
        let values =
            cell_field(grid, |place| if (place - Vector::from(CENTRE)).norm() < RADIUS { 1e9 } else { (place.z - CENTRE[2]).powi(2) });
        let got = share(grid, ball()).mean_by_layers(&values, 0);
        let mean = |at: f64| {
            // Second moments of the rectangle and of the disc that the ball cuts out of it.
            let [below, above] = [0.1 - CENTRE[2], 1.1 - CENTRE[2]];
            let square = (RADIUS * RADIUS - (at - CENTRE[0]).powi(2)).max(0.0);
            (0.8 * (above.powi(3) - below.powi(3)) / 3.0 - 0.25 * PI * square * square) / (0.8 - PI * square)
        };
        let at = |layer: usize| grid.position(None, [layer as isize, 0, 0]).x;
        let errors = got.iter().enumerate().map(|(layer, got)| (got - mean(at(layer))).abs());
        errors.sum::<f64>() / got.len() as f64
    };
    assert_order(error, 1.0, 2e-3);
}

/// The channel between a slab and its image: $u = 6 U s (1 - s)$ over the width, which lies askew to no direction but between the values.
fn channel(grid: &Grid, turn: f64) -> (FluidShare, FaceField) {
    let (width, middle): (f64, f64) = (0.613, 0.477);
    let slab = Cuboid { lengths: Vector::new(1.2, 0.8, 1.0 - width) };
    let body = ImmersedBody::fixed(Arc::new(slab), Vector::new(0.9, 0.2, middle));
    let velocity = FaceField::from_fn(grid, |component, place| {
        let from_wall = (place.z - middle).rem_euclid(1.0) - 0.5 * (1.0 - width);
        let part = (from_wall / width).clamp(0.0, 1.0);
        [turn.cos(), turn.sin(), 0.0][component] * 6.0 * part * (1.0 - part)
    });
    (share(grid, body), velocity)
}

#[test]
fn mean_velocity_of_poiseuille_flow_is_of_second_order() {
    let error = |grid: &Grid| {
        let (share, velocity) = channel(grid, 0.0);
        let means = share.superficial_velocity_by_layers(&velocity, 0);
        means.iter().map(|mean| (mean - Vector::x() * 0.613).norm()).fold(0.0, f64::max)
    };
    assert_order(error, 2.0, 1e-3);
}

#[test]
fn tortuosity_of_a_tilted_flow_is_one_over_the_cosine() {
    for turn in [0.0, 0.4, -1.1] {
        let (share, velocity) = channel(&grid(1), turn);
        let got = share.tortuosity(&velocity, 0, 0..12);
        assert!((got * turn.cos() - 1.0).abs() < 1e-14, "{turn}: {got}");
    }
}

/// A flow that winds, of constant speed: $v = (1, a \cos \phi, a \sin \phi)$; what is read between faces is of second order.
#[test]
fn tortuosity_of_a_winding_flow_is_of_second_order_and_that_of_the_layers_asked_for() {
    let empty = |grid: &Grid| FluidShare::new(grid, &[]).expect("no body");
    let winding = |grid: &Grid, amplitude: f64| {
        FaceField::from_fn(grid, |component, place| {
            let phase = TAU * ((place.y + 0.2) / 0.8 + (place.z - 0.1));
            [1.0, amplitude * phase.cos(), amplitude * phase.sin()][component]
        })
    };
    let exact = (1.0_f64 + 0.49).sqrt();
    assert_order(|grid| (empty(grid).tortuosity(&winding(grid, 0.7), 0, 0..grid.cells()[0]) / exact - 1.0).abs(), 2.0, 2e-3);
    // The other half of the box stands still.
    let grid = grid(1);
    let mut velocity = winding(&grid, 0.0);
    for (index, value) in velocity.component[1].iter_mut().enumerate() {
        *value = if grid.cell(index)[0] < 6 { 1.0 } else { 0.0 };
    }
    let part = |layers: std::ops::Range<usize>| empty(&grid).tortuosity(&velocity, 0, layers);
    assert!((part(0..6) - 2.0_f64.sqrt()).abs() < 1e-14 && (part(6..12) - 1.0).abs() < 1e-14);
}

#[test]
fn pressure_is_what_balances_a_gradient_and_a_mean_force() {
    let flow = PeriodicBox::new(grid(1));
    let grid = flow.grid();
    let wave = cell_field(grid, |place| (TAU * ((place.x - 0.3) / 1.2 - (place.z - 0.1))).sin());
    let mut force = gradient(grid, &wave);
    let mean = Vector::new(-3.0, 0.5, 2.0);
    force.component.iter_mut().zip(&mean).for_each(|(values, mean)| values.iter_mut().for_each(|value| *value += mean));
    let got = pressure(&flow, &force);
    for (index, (got, wave)) in got.iter().zip(&wave).enumerate() {
        let place = grid.position(None, grid.cell(index).map(|number| number as isize)) - grid.lower();
        assert!((got - wave - mean.dot(&place)).abs() < 1e-12);
    }
}

/// In front of and behind an array of balls the mean pressure falls by the drag over the section, to rounding.
#[test]
fn pressure_falls_over_a_body_by_its_drag() {
    let flow = PeriodicBox::new(Grid::new([48, 16, 16], 1.0 / 16.0, Vector::zeros()).expect("enough cells"));
    let turned = Orientation::from_scaled_axis(Vector::new(0.3, 0.1, -0.2));
    let body = ImmersedBody { orientation: turned, ..ImmersedBody::fixed(Arc::new(Ball { radius: 0.3 }), Vector::new(1.5, 0.52, 0.47)) };
    let ghosts = Ghosts::new(flow.grid(), std::slice::from_ref(&body), Continuation::Quadratic).expect("a body in its box");
    let problem = SteadyProblem { viscosity: 0.8, mean_velocity: Vector::x(), tolerance: 1e-9, most_iterations: 200 };
    let steady = solve(&flow, &ghosts, &problem);
    let mut force = FaceField::zeros(flow.grid());
    ghosts.spread(&steady.forces, &mut force);
    let share = share(flow.grid(), body);
    let means = share.mean_by_layers(&pressure(&flow, &force), 0);
    let drag = ghosts.loads(&steady.forces, 1)[0].force.x;
    assert!(((means[2] - means[45]) / drag - 1.0).abs() < 1e-9, "{} {drag}", means[2] - means[45]);
    // What goes through a layer is the mean flow, but for the layer of half cells at the surface.
    let worst = share.superficial_velocity_by_layers(&steady.velocity, 0).iter().map(|mean| (mean.x - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst < 0.02, "{worst}");
}

#[test]
fn bodies_that_are_nowhere_are_refused() {
    let nowhere = ImmersedBody { position: Vector::repeat(f64::NAN), ..ball() };
    assert_eq!(FluidShare::new(&grid(1), &[ball(), nowhere]), Err(ImmersionError::NotFinite { body: 1 }));
}

#[test]
fn velocity_in_the_middle_of_a_cell_is_that_of_a_straight_profile() {
    let grid = Grid::new([6, 5, 4], 0.2, Vector::new(0.3, 0.0, -1.0)).expect("enough cells");
    let profile = |place: &Vector| Vector::new(2.0 * place.x + 0.1, place.x - 3.0 * place.y, 0.5 * place.z);
    let field = FaceField::from_fn(&grid, |component, place| profile(&place)[component]);
    for cell in [[1, 1, 1], [4, 3, 2], [2, 2, 1]] {
        let middle = grid.position(None, cell.map(|number| number as isize));
        assert!((cell_velocity(&grid, &field, grid.index(cell)) - profile(&middle)).norm() < 1e-14);
    }
}
