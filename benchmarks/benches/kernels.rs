//! Kernels by criterion: one step of a contact, one free turn, one step of a crowd, one scene read and built.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use solver::motion::rotation::{ExplicitEuler, Precession, RotationIntegrator, RungeKutta4, Splitting, SplittingFourthOrder};
use solver::{Orientation, Scene, Simulation, Vector};
use verification::CASES;

const STEPS: u64 = 1000;

fn simulation_of(case: &str, setup: &str, knob: f64) -> Simulation {
    let case = CASES.iter().find(|candidate| candidate.description().id == case).expect("the case is in the list");
    let description = case.description();
    let setup = description.setups.iter().find(|candidate| candidate.label.contains(setup)).expect("the setup is in the case");
    let scene = case.scene(setup, knob).expect("the case has a scene");
    scene.build().expect("the scene of a case builds")
}

fn contact_step(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step of a sphere between two walls");
    group.throughput(Throughput::Elements(STEPS));
    for setup in ["sampled edges", "resolved edges"] {
        group.bench_function(setup, |bencher| {
            let mut simulation = simulation_of("sphere_bounce_long", setup, 20.0);
            bencher.iter(|| (0..STEPS).for_each(|_| simulation.step()));
        });
    }
    group.finish();
    let mut group = criterion.benchmark_group("step of a sphere on an incline");
    group.throughput(Throughput::Elements(STEPS));
    for setup in ["rolls: 15 degrees, friction 0.5", "creeps: viscous law, 15 degrees"] {
        group.bench_function(setup, |bencher| {
            let mut simulation = simulation_of("sphere_on_incline", setup, 50.0);
            bencher.iter(|| (0..STEPS).for_each(|_| simulation.step()));
        });
    }
    group.finish();
}

fn free_turn(criterion: &mut Criterion) {
    let integrators: [&dyn RotationIntegrator; 5] = [&Splitting, &SplittingFourthOrder, &RungeKutta4, &ExplicitEuler, &Precession];
    let mut group = criterion.benchmark_group("free turn");
    for integrator in integrators {
        let inertia = if integrator.name() == Precession.name() { Vector::new(1.0, 1.0, 0.5) } else { Vector::new(1.0, 2.0, 2.5) };
        group.bench_function(integrator.name(), |bencher| {
            let (mut orientation, mut momentum) = (Orientation::identity(), Vector::new(0.6, -0.4, 2.0));
            bencher.iter(|| integrator.turn(&mut orientation, &mut momentum, &inertia, 1e-3));
        });
    }
    group.finish();
}

fn scene_to_simulation(criterion: &mut Criterion) {
    let text = include_str!("../../verification/scenes/rolling_ball.toml");
    criterion.bench_function("scene file read, checked and built", |bencher| {
        bencher.iter_batched(
            || text,
            |text| Scene::from_toml(text, "rolling_ball.toml").and_then(|scene| scene.build()).expect("the example builds"),
            BatchSize::SmallInput,
        );
    });
}

criterion_group!(kernels, contact_step, free_turn, scene_to_simulation);
criterion_main!(kernels);
