//! Tests of bodies in unsteady flow.

use std::sync::Arc;

use super::*;
use crate::coupling::resolved::immersed::TOUCHING;
use crate::coupling::resolved::measures::pressure;
use crate::coupling::resolved::steady::{SteadyProblem, solve};
use crate::coupling::resolved::surface::Ball;
use crate::fluid::grid::{Grid, cell_field};
use crate::fluid::operators::divergence;

const RADIUS: f64 = 0.31;
const SLIP: f64 = 1e-7;

const SETTINGS: Settings = Settings {
    density: 1.3,
    viscosity: 0.7,
    advection: true,
    gravity: Vector::new(0.0, 0.0, 0.0),
    driving: Driving::MeanVelocity(Vector::new(0.0, 0.0, 0.0)),
    walls: [None; 3],
    fringe: None,
    step: 0.01,
    stop: Stop { slip: SLIP, most_iterations: 200 },
    deepest_overlap: TOUCHING,
};

fn flow(cells: usize) -> PeriodicBox {
    PeriodicBox::new(Grid::new([cells; 3], 1.0 / cells as f64, Vector::zeros()).expect("enough cells"))
}

fn sphere(density_ratio: Option<f64>) -> Body {
    let matter = density_ratio.map(|ratio| Matter::ellipsoid(ratio * SETTINGS.density, &Vector::repeat(RADIUS)));
    Body { immersed: ImmersedBody::fixed(Arc::new(Ball { radius: RADIUS }), Vector::new(0.52, 0.47, 0.51)), matter }
}

fn still(flow: &PeriodicBox) -> FaceField {
    FaceField::zeros(flow.grid())
}

/// A flow without divergence that nothing favours.
fn wavy(flow: &PeriodicBox) -> FaceField {
    let mut field = FaceField::from_fn(flow.grid(), |component, place| {
        (std::f64::consts::TAU * (place.x + (component + 1) as f64 * place.y - place.z)).sin() + (3.0 * component as f64).cos()
    });
    flow.solve_stokes(&mut field, 0.0, 1.0, Vector::new(0.4, -0.2, 0.1));
    field
}

#[test]
fn a_held_sphere_ends_in_the_creeping_flow_that_is_solved_at_once() {
    let flow = flow(12);
    let settings = Settings { advection: false, driving: Driving::MeanVelocity(Vector::x()), step: 0.05, ..SETTINGS };
    let start = FaceField::from_fn(flow.grid(), |component, _| if component == 0 { 1.0 } else { 0.0 });
    let mut unsteady = Unsteady::new(flow.clone(), settings, vec![sphere(None)], start).expect("a sphere in its box");
    (0..40).for_each(|_| assert!(unsteady.step().expect("a step").slip <= SLIP));
    let problem = SteadyProblem { viscosity: settings.viscosity, mean_velocity: Vector::x(), tolerance: 1e-10, most_iterations: 200 };
    let steady = solve(&flow, unsteady.ghosts(), &problem);
    let wanted = unsteady.ghosts().loads(&steady.forces, 1)[0];
    let load = unsteady.loads()[0];
    assert!((load.force - wanted.force).norm() < 1e-5 * wanted.force.norm(), "{load:?} {wanted:?}");
    let largest = divergence(flow.grid(), unsteady.velocity()).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    assert!(largest * flow.grid().spacing() < 1e-13, "{largest}");
}

#[test]
fn a_neutral_sphere_stays_at_rest_and_goes_with_a_uniform_stream() {
    let flow = flow(12);
    let settings = Settings { gravity: Vector::new(0.0, 0.0, -9.81), ..SETTINGS };
    let mut unsteady = Unsteady::new(flow.clone(), settings, vec![sphere(Some(1.0))], still(&flow)).expect("a sphere in its box");
    (0..5).for_each(|_| assert_eq!(unsteady.step().expect("a step").full_slip, 0.0));
    assert_eq!(unsteady.bodies()[0].immersed.velocity, Vector::zeros());
    let stream = Vector::new(0.5, -0.2, 1.1);
    let mut body = sphere(Some(1.0));
    body.immersed.velocity = stream;
    let start = FaceField::from_fn(flow.grid(), |component, _| stream[component]);
    let settings = Settings { driving: Driving::MeanVelocity(stream), ..settings };
    let mut unsteady = Unsteady::new(flow.clone(), settings, vec![body], start).expect("a sphere in its box");
    (0..10).for_each(|_| assert!(unsteady.step().expect("a step").full_slip < 1e-12));
    let body = &unsteady.bodies()[0].immersed;
    assert!((body.velocity - stream).norm() < 1e-12 && body.angular_velocity.norm() < 1e-11);
    assert!((body.position - Vector::new(0.52, 0.47, 0.51) - 0.1 * stream).norm() < 1e-12);
}

#[test]
fn momentum_of_fluid_and_bodies_together_is_kept_to_rounding() {
    let flow = flow(12);
    let settings = Settings { driving: Driving::Force(Vector::zeros()), stop: Stop { slip: 1e-4, most_iterations: 100 }, ..SETTINGS };
    for ratio in [0.1, 1.0, 3.0] {
        let mut unsteady = Unsteady::new(flow.clone(), settings, vec![sphere(Some(ratio))], wavy(&flow)).expect("a sphere in its box");
        let before = unsteady.momentum();
        (0..6).for_each(|_| assert!(unsteady.step().expect("a step").flows > 2));
        assert!((unsteady.momentum() - before).norm() < 1e-13 * before.norm(), "{ratio}: {} {before}", unsteady.momentum());
        assert!(unsteady.bodies()[0].immersed.velocity.norm() > 0.05 && unsteady.bodies()[0].immersed.angular_velocity.norm() > 0.01);
    }
}

/// What the constraint's torque changes in a step is the angular momentum of the body less that of the fluid which fills it, once.
#[test]
fn a_torque_turns_the_body_and_not_the_fluid_inside() {
    let flow = flow(12);
    for ratio in [0.1, 1.0, 3.0] {
        let mut body = sphere(Some(ratio));
        body.immersed.angular_velocity = Vector::new(1.0, 0.5, -2.0);
        let settings = Settings { advection: false, ..SETTINGS };
        let mut unsteady = Unsteady::new(flow.clone(), settings, vec![body], wavy(&flow)).expect("a sphere in its box");
        let excess = |unsteady: &Unsteady| {
            let body = &unsteady.bodies()[0];
            let inertia = body.matter.expect("it is free").inertia(&body.immersed);
            let inside = FluidInside::new(flow.grid(), &body.immersed, SETTINGS.density).angular_momentum(unsteady.velocity());
            inertia * body.immersed.angular_velocity - inside
        };
        let before = excess(&unsteady);
        unsteady.step().expect("a step");
        let change = excess(&unsteady) - before;
        let torque = unsteady.loads()[0].torque * SETTINGS.step;
        assert!(change.norm() > 0.01 * before.norm(), "{ratio}: {change} of {before}");
        assert!((change - torque).norm() < 1e-5 * before.norm(), "{ratio}: {change} {torque}");
    }
}

/// A first step from rest is Stokes' unsteady drag at the rate of one over the step: with $\delta^2 = \nu \Delta t$ it is $6 \pi \mu a U (1 + a / \delta + a^2 / (9 \delta^2))$.
/// Images are felt through pressure alone: dipoles are stronger by the fluid that must come back past the sphere.
#[test]
fn light_and_heavy_spheres_start_with_their_added_mass_and_layer_and_settle_without_a_wiggle() {
    let flow = flow(24);
    let (radius, layers): (f64, f64) = (0.17, 2.5);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
    let dipole = 1.0 / (1.0 - volume);
    let drag = 1.0 + layers * dipole * dipole + layers * layers / 9.0 * (3.0 * dipole - 2.0);
    let step = (radius / layers).powi(2) * SETTINGS.density / SETTINGS.viscosity;
    // In masses of the displaced fluid over the step.
    let fluid = 4.5 / (layers * layers) * drag;
    for ratio in [0.01, 0.5, 0.99, 1.01, 2.0, 1000.0] {
        let stop = Stop { slip: 1e-5 * step / (ratio + fluid), most_iterations: 300 };
        let settings = Settings { gravity: Vector::new(0.0, 0.0, -1.0 / (ratio - 1.0)), step, stop, ..SETTINGS };
        let matter = Some(Matter::ellipsoid(ratio * SETTINGS.density, &Vector::repeat(radius)));
        let body = Body { matter, immersed: ImmersedBody { surface: Arc::new(Ball { radius }), ..sphere(None).immersed } };
        let mut unsteady = Unsteady::new(flow.clone(), settings, vec![body], still(&flow)).expect("a sphere in its box");
        let mut speed = || {
            unsteady.step().expect("a step");
            -unsteady.bodies()[0].immersed.velocity.z
        };
        let mut last = speed();
        let inertia = step / last;
        // Eight cells a diameter; a layer of less than two.
        assert!((inertia / (ratio + fluid) - 1.0).abs() < 0.1, "{ratio}: {inertia} {}", ratio + fluid);
        for _ in 0..5 {
            let next = speed();
            assert!(next > last * (1.0 - 2e-3), "{ratio}: {next} after {last}");
            last = next;
        }
    }
}

#[test]
fn what_cannot_be_marched_is_refused() {
    let flow = flow(12);
    let make = |settings: Settings, bodies: Vec<Body>| Unsteady::new(flow.clone(), settings, bodies, still(&flow)).err();
    assert!(matches!(make(Settings { step: f64::NAN, ..SETTINGS }, vec![]), Some(UnsteadyError::Number { name: "step", .. })));
    assert!(matches!(make(Settings { viscosity: 0.0, ..SETTINGS }, vec![]), Some(UnsteadyError::Number { name: "viscosity", .. })));
    assert_eq!(make(SETTINGS, vec![sphere(None), sphere(Some(-1.0))]), Some(UnsteadyError::Matter(1)));
    let twice = make(SETTINGS, vec![sphere(None), sphere(Some(1.0))]).expect("two spheres at one place");
    assert!(twice.to_string().contains("bodies 0 and 1 overlap"), "{twice}");
    let few = Settings { driving: Driving::MeanVelocity(Vector::x()), stop: Stop { slip: 1e-9, most_iterations: 2 }, ..SETTINGS };
    let mut unsteady = Unsteady::new(flow.clone(), few, vec![sphere(None)], still(&flow)).expect("a sphere in its box");
    assert!(matches!(unsteady.step(), Err(UnsteadyError::NotConverged { .. })));
    let far = Settings { step: 1e3, viscosity: 1e-9, ..SETTINGS };
    let mut unsteady = Unsteady::new(flow.clone(), far, vec![sphere(None)], wavy(&flow)).expect("a sphere in its box");
    assert!((0..12).any(|_| unsteady.step().is_err()));
}

/// Vortices of Taylor and Green in a plane: the momentum that they carry makes the pressure $\rho (\cos 2 k x + \cos 2 k y) / 4$.
#[test]
fn the_pressure_of_vortices_is_that_of_the_momentum_they_carry() {
    let wave = std::f64::consts::TAU;
    let error = |cells: usize| {
        let flow = flow(cells);
        let vortices = FaceField::from_fn(flow.grid(), |component, place| match component {
            0 => (wave * place.x).sin() * (wave * place.y).cos(),
            1 => -(wave * place.x).cos() * (wave * place.y).sin(),
            _ => 0.0,
        });
        let unsteady = Unsteady::new(flow.clone(), SETTINGS, vec![], vortices).expect("a box");
        let got = pressure(&flow, &unsteady.force_densities());
        let wanted =
            cell_field(flow.grid(), |place| 0.25 * SETTINGS.density * ((2.0 * wave * place.x).cos() + (2.0 * wave * place.y).cos()));
        got.iter().zip(&wanted).map(|(got, wanted)| (got - wanted).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(12), error(24));
    // Twelve cells hold six of the wave of the pressure: the order has not quite settled at two.
    assert!((coarse / fine).log2() > 1.7 && fine < 0.015, "{coarse} {fine}");
}
