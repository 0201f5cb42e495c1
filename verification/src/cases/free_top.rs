//! A body without equal moments turns freely: do attitude, energy and angular momentum stay right?

use std::f64::consts::PI;
use std::sync::OnceLock;

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::scene::{Body, CuboidGeometry, Geometry, Material, NamedShape, Rotation, Scene, Step};
use solver::{Orientation, Simulation, Vector};

use crate::case::{Case, Curve, Description, Failure, Knob, Measurement, Quantity, Setup, Tier, setups};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::free_top::FreeTop as ExactTop;

/// The case.
pub struct FreeTop;

const INERTIA: [f64; 3] = [1.0, 2.0, 3.0];
const SPINS: [f64; 2] = [0.6, 1.0];
const END_TIME: f64 = 20.0;
const REVOLUTIONS: f64 = 1e4;
/// Steps per revolution of the run over many revolutions.
const LONG_RUN_KNOB: f64 = 50.0;
/// Revolutions at either end of the long run over which energy is averaged: drift is the difference of the two means.
const AVERAGED: usize = 500;
/// The methods of the short run; the first [`LONG_RUNS`] of them also make the long one.
const METHODS: [Rotation; 5] = [
    Rotation::Splitting,
    Rotation::SplittingFourthOrder,
    Rotation::RungeKuttaFourthOrder,
    Rotation::ExplicitEuler,
    Rotation::ExplicitEulerAsPrinted,
];
const LONG_RUNS: usize = 4;

const ATTITUDE: &str = "attitude angle after 20 s";
const DRIFT: &str = "energy drift";
const LARGEST: &str = "largest energy error";
const MOMENTUM: &str = "change of angular momentum";

fn label(method: Rotation) -> String {
    match method {
        Rotation::Splitting | Rotation::SplittingWithoutShortcut => "splitting 1-2-3-2-1 (default)",
        Rotation::SplittingFourthOrder => "splitting, fourth order",
        Rotation::RungeKuttaFourthOrder => "Runge-Kutta, fourth order",
        Rotation::ExplicitEuler => "explicit Euler of S, corrected",
        Rotation::ExplicitEulerAsPrinted => "explicit Euler of S, as printed",
    }
    .into()
}

fn long_label(method: Rotation) -> String {
    format!("{}, ten thousand revolutions", label(method))
}

/// Duration of a revolution at the initial spin in s.
fn revolution() -> f64 {
    2.0 * PI / (SPINS[0] * SPINS[0] + SPINS[1] * SPINS[1]).sqrt()
}

fn scene(method: Rotation, steps_per_revolution: f64, end_time: f64) -> Scene {
    let mut scene = Scene::empty("free top", end_time);
    scene.materials = vec![Material { name: "any".into(), density: None }];
    let geometry = Geometry::Cuboid(CuboidGeometry { lengths: [4.9, 3.5, 0.1] });
    scene.shapes = vec![NamedShape { name: "plate".into(), geometry }];
    scene.bodies = vec![Body {
        mass: Some(1.0),
        principal_inertia: Some(INERTIA),
        angular_velocity: [SPINS[0], 0.0, SPINS[1]],
        ..Body::new("plate", "any")
    }];
    // The end of the run falls on a whole step.
    let steps = (end_time * steps_per_revolution / revolution()).round().max(1.0);
    scene.numerics.step = Step::Seconds(end_time / steps);
    scene.numerics.rotation = method;
    scene
}

fn energy(simulation: &mut Simulation) -> f64 {
    simulation.now().kinetic_energy()
}

/// Energy at the end of each revolution, relative to the start.
fn energy_history(simulation: &mut Simulation, steps_per_revolution: usize) -> Vec<f64> {
    let start = energy(simulation);
    let mut history = Vec::with_capacity(REVOLUTIONS as usize);
    for _ in 0..REVOLUTIONS as usize {
        for _ in 0..steps_per_revolution {
            simulation.step();
        }
        history.push(energy(simulation) / start - 1.0);
    }
    history
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

impl Case for FreeTop {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        match METHODS.get(setup.index) {
            Some(method) => short_run(*method, knob),
            None => long_run(setup.index - METHODS.len(), knob),
        }
    }

    fn claims(&self, _tier: Tier) -> Vec<Claim> {
        let claim = |method, quantity, subject, bound, expected| Claim {
            setup: if quantity == DRIFT || quantity == LARGEST { long_label(method) } else { label(method) },
            quantity,
            statistic: Statistic::Single,
            subject,
            bound,
            expected,
        };
        let order_claim = |method, order, range: [f64; 2]| {
            let bound = Bound::new(1.0, 2.0 * PI / range[0], "the angle turned in a step of the coarsest point of the fit");
            claim(method, ATTITUDE, Subject::OrderAtLeast { order, range }, bound, Expected::Holds)
        };
        let drift_bound = Bound::new(4.0, drift_floor(), "the round-off of a random walk over all turns, and the spread of the two means");
        let drift = |method, expected| claim(method, DRIFT, Subject::ErrorAt(LONG_RUN_KNOB), drift_bound.clone(), expected);
        let largest = |method, expected| {
            let angle = 2.0 * PI / LONG_RUN_KNOB;
            let bound = Bound::new(1.0, angle * angle / 24.0, "(angle in a step)^2 / 24, the energy by which a second-order scheme swings");
            claim(method, LARGEST, Subject::ErrorAt(LONG_RUN_KNOB), bound, expected)
        };
        let momentum = |method, expected| {
            let bound = Bound::new(2.0, 2.0 * f64::EPSILON, "the rounding of a vector");
            claim(method, MOMENTUM, Subject::ErrorAt(LONG_RUN_KNOB), bound, expected)
        };
        let angle = 2.0 * PI / 200.0;
        let total_angle = 2.0 * PI * END_TIME / revolution();
        let design = angle * angle / 24.0 * total_angle;
        let design_is = "(angle in a step)^2 / 24 of the angle turned in all";
        vec![
            claim(METHODS[0], ATTITUDE, Subject::ErrorAt(200.0), Bound::new(4.0, design, design_is), Expected::Holds),
            order_claim(METHODS[0], 2.0, [50.0, 800.0]),
            order_claim(METHODS[1], 4.0, [50.0, 400.0]),
            order_claim(METHODS[2], 4.0, [50.0, 400.0]),
            order_claim(METHODS[3], 1.0, [800.0, 3200.0]),
            claim(
                METHODS[4],
                ATTITUDE,
                Subject::OrderAtLeast { order: 1.0, range: [50.0, 800.0] },
                Bound::new(1.0, 2.0 * PI / 50.0, "the angle turned in a step of the coarsest point of the fit"),
                Expected::SourceError("S eq. 3.49 lacks the gyroscopic term: the attitude converges to the wrong motion".into()),
            ),
            drift(METHODS[0], Expected::Holds),
            drift(METHODS[1], Expected::Holds),
            drift(METHODS[2], Expected::KnownLimit("Runge-Kutta is not symplectic: it loses energy steadily".into())),
            largest(METHODS[0], Expected::Holds),
            largest(METHODS[1], Expected::Holds),
            largest(
                METHODS[3],
                Expected::KnownLimit(
                    "explicit Euler loses a third of the energy in twenty revolutions and ends turning about a principal axis".into(),
                ),
            ),
            momentum(METHODS[0], Expected::Holds),
            momentum(METHODS[1], Expected::Holds),
            momentum(METHODS[2], Expected::Holds),
            momentum(METHODS[3], Expected::KnownLimit("explicit Euler keeps neither momentum nor energy".into())),
            momentum(
                METHODS[4],
                Expected::SourceError("with the angular velocity held constant the angular momentum turns with the body".into()),
            ),
        ]
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        match METHODS.get(setup.index) {
            Some(method) => Some(scene(*method, knob, END_TIME)),
            None => METHODS.get(setup.index - METHODS.len()).map(|method| scene(*method, knob, REVOLUTIONS * revolution())),
        }
    }

    fn description(&self) -> Description {
        let labels: Vec<String> = METHODS.iter().map(|method| label(*method)).collect();
        Description {
            id: "free_top",
            title: "Free asymmetric top",
            question: "Does a freely turning body keep its attitude, its angular momentum and its energy, over few and over ten thousand revolutions?",
            model: vec![
                "A flat plate with principal moments 1, 2 and 3 kg m² turns freely in empty space, started with spins of 0.6 and 1 rad/s about its first and third axes. No force acts: the only physics is the gyroscopic coupling of its axes.",
                "Five integrators turn it. The default splits the free motion into elementary rotations about the body axes in the order 1-2-3-2-1; the angular momentum in space is never touched. Source S advances the angular velocity by explicit Euler; as printed it lacks the gyroscopic term.",
                "Attitude is compared after 20 s (3.7 revolutions). Energy is followed over 10⁴ revolutions at 50 steps each, and its drift is the difference between the mean over the last and the first 500 revolutions.",
            ],
            equations: vec![
                Equation {
                    latex: r"I\,\dot\omega + \omega\times I\omega = 0".into(),
                    meaning: "Euler's equations in the body frame. S eq. 3.49 prints them without the second term (errata).".into(),
                },
                Equation {
                    latex: r"\omega = \left(A_1\,\mathrm{cn}(Wt),\; A_2\,\mathrm{sn}(Wt),\; A_3\,\mathrm{dn}(Wt)\right),\qquad W = 1,\; k^2 = 0.12".into(),
                    meaning: "Exact angular velocity in Jacobi's elliptic functions; the attitude follows by one quadrature.".into(),
                },
            ],
            parameters: [
                ("principal moments", "1, 2, 3 kg m²", "a lamina: the third is the sum of the others"),
                ("initial spin (body frame)", "(0.6, 0, 1) rad/s", "one revolution takes 5.39 s at this rate"),
                ("end time", "20 s", "3.7 revolutions"),
                ("long run", "10⁴ revolutions", "at 50 steps per revolution"),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "Closed form by Jacobi's elliptic functions, checked to 10⁻⁹ against a table computed elsewhere by an eighth-order method; uncertainty of the attitude 10⁻¹².",
            picture: picture(),
            plots: vec![
                Plot::Convergence {
                    title: "Attitude error after 20 s".into(),
                    quantity: ATTITUDE.into(),
                    setups: labels.clone(),
                    statistics: vec!["single run".into()],
                    orders: vec![1.0, 2.0, 4.0],
                    knob_is_resolution: true,
                    knob_label: "steps per revolution".into(),
                },
                Plot::ErrorAgainstCost {
                    title: "Attitude error after 20 s against run time".into(),
                    quantity: ATTITUDE.into(),
                    setups: labels.clone(),
                    statistic: "single run".into(),
                    targets: vec![0.1, 0.01, 0.001],
                },
                energy_plot(0, "Energy over ten thousand revolutions: default", "Bounded for ever: the scheme keeps a nearby energy exactly."),
                energy_plot(2, "Energy over ten thousand revolutions: Runge-Kutta", "A straight line down: fourth order is not conservation."),
                energy_plot(3, "Energy over ten thousand revolutions: explicit Euler", "A third of the energy is lost in the first twenty revolutions; the body then turns about a principal axis, where no gyroscopic term acts."),
            ],
            headline: Headline {
                setup: labels[0].clone(),
                quantity: ATTITUDE.into(),
                statistic: "single run".into(),
                knob: 200.0,
                order_quantity: Some(format!("observed order of {ATTITUDE}")),
            },
            sources: vec![
                "S (Srinivasan 2019), sections 2.3 and 3.2, eq. 2.8-2.15 and 3.49",
                "T. F. Miller et al., Symplectic quaternion scheme for biophysical molecular dynamics, J. Chem. Phys. 116 (2002) 8649",
                "A. Dullweber, B. Leimkuhler, R. McLachlan, J. Chem. Phys. 107 (1997) 5840",
            ],
            answers: vec![
                "Energy alone misleads: without the gyroscopic term energy looks right while the attitude is wrong.",
                "Stability test S20 (fast spin) in part.",
                "Errata of S: eq. 3.49 as printed must fail, and does.",
            ],
            remarks: vec![
                "Bodies with two equal moments do not use any of these integrators: they turn exactly, by precession and spin. Spheres need no orientation at all.",
            ],
            knob: Knob { name: |_| "steps_per_revolution", values: |_, setup| knobs(setup) },
            setups: setups(labels.into_iter().chain(METHODS[..LONG_RUNS].iter().map(|method| long_label(*method)))),
            sample: "run",
            budget_cpu_s: [5.0, 60.0, 60.0],
        }
    }
}

/// Round-off of the energy over the long run, and the wobble that is left in a mean over some hundred revolutions.
fn drift_floor() -> f64 {
    let turns = REVOLUTIONS * LONG_RUN_KNOB;
    let angle = 2.0 * PI / LONG_RUN_KNOB;
    // The shadow energy differs by about angle^2 / 24; sampled at incommensurate phases its mean wobbles by one over the number of samples.
    f64::EPSILON * (5.0 * turns).sqrt() + angle * angle / 24.0 / AVERAGED as f64
}

fn knobs(setup: &Setup) -> Vec<f64> {
    if setup.index < METHODS.len() { vec![12.5, 25.0, 50.0, 100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0] } else { vec![LONG_RUN_KNOB] }
}

fn quantity(name: &'static str, unit: &'static str, value: f64, floor: f64) -> Quantity {
    let source = "Jacobi elliptic functions and one quadrature; conservation of energy and angular momentum";
    Quantity {
        name,
        unit,
        samples: vec![value],
        expected: 0.0,
        reference: Reference { kind: ReferenceKind::Exact, uncertainty: 1e-12, source: source.into() },
        error_kind: ErrorKind::Absolute,
        floor,
    }
}

/// The exact attitude at the end, found once: its quadrature is no part of the cost of a run.
fn exact_attitude() -> Result<Orientation, Failure> {
    static ATTITUDE_AT_END: OnceLock<Option<Orientation>> = OnceLock::new();
    let find = || ExactTop::new(Vector::from(INERTIA), SPINS[0], SPINS[1]).map(|top| top.attitude(END_TIME));
    ATTITUDE_AT_END.get_or_init(find).ok_or_else(|| Failure::NothingMeasured("the top does not circle its third axis".into()))
}

fn short_run(method: Rotation, knob: f64) -> Result<Measurement, Failure> {
    let mut simulation = scene(method, knob, END_TIME).build()?;
    let momentum = simulation.now().spin_momentum(0);
    simulation.run_until(END_TIME)?;
    let attitude_error = simulation.now().orientation(0).angle_to(&exact_attitude()?);
    let momentum_change = (simulation.now().spin_momentum(0) - momentum).norm() / momentum.norm();
    // Each elementary rotation rounds once; errors of attitude grow with the square root of their number, and the quadrature of the
    // reference is good to 1e-12.
    let round_off = f64::EPSILON * (5.0 * simulation.steps_taken() as f64).sqrt();
    Ok(Measurement {
        quantities: vec![
            quantity(ATTITUDE, "rad", attitude_error, 1e-12 + round_off),
            quantity(MOMENTUM, "1", momentum_change, 2.0 * f64::EPSILON),
        ],
        work: simulation.ledger().total_work(),
        runs: 1,
        curves: Vec::new(),
    })
}

fn long_run(index: usize, knob: f64) -> Result<Measurement, Failure> {
    let mut simulation = scene(METHODS[index], knob, REVOLUTIONS * revolution()).build()?;
    let history = energy_history(&mut simulation, knob as usize);
    let drift = mean(&history[history.len() - AVERAGED..]) - mean(&history[..AVERAGED]);
    let largest = history.iter().fold(0.0, |largest: f64, error| largest.max(error.abs()));
    let every = history.len() / 500;
    let rows = history.iter().enumerate().skip(every - 1).step_by(every);
    Ok(Measurement {
        quantities: vec![quantity(DRIFT, "1", drift, drift_floor()), quantity(LARGEST, "1", largest, drift_floor())],
        work: simulation.ledger().total_work(),
        runs: 1,
        curves: vec![Curve {
            file: energy_file(index),
            columns: vec!["revolutions", "relative_energy_error"],
            rows: rows.map(|(index, error)| vec![(index + 1) as f64, *error]).collect(),
        }],
    })
}

fn energy_file(index: usize) -> String {
    format!("energy_{index}.csv")
}

fn energy_plot(index: usize, title: &str, caption: &str) -> Plot {
    Plot::Curves {
        title: title.into(),
        file: format!("free_top/{}", energy_file(index)),
        x_label: "revolutions".into(),
        y_label: "relative energy error".into(),
        columns: vec![["relative_energy_error".into(), label(METHODS[index])]],
        log_x: false,
        log_y: false,
        caption: caption.into(),
    }
}

fn picture() -> Picture {
    let arrow = |to: [f64; 2], label: &str| PictureItem::Arrow { from: [0.0, 0.0], to, label: label.into() };
    Picture {
        caption:
            "A thin plate turning freely; arrows show its three principal axes and the angular momentum L, which stays fixed in space."
                .into(),
        items: vec![
            PictureItem::Polygon { points: vec![[-3.4, -0.6], [1.2, -1.8], [3.4, 0.6], [-1.2, 1.8]], ghost: true },
            PictureItem::Polygon { points: vec![[-3.0, -1.5], [1.8, -1.2], [3.0, 1.5], [-1.8, 1.2]], ghost: false },
            arrow([2.9, -0.9], "1"),
            arrow([1.6, 1.9], "2"),
            arrow([-0.4, 3.0], "3"),
            arrow([0.6, 3.9], "L"),
        ],
    }
}
