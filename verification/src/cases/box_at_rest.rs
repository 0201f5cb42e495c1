//! Boxes on a plane, on a slope and on each other: do they stay where they are, and slide where they must?

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::scene::{
    Body, Boundary, BoundaryGeometry, ContactPoints, CuboidGeometry, EndOfContact, Geometry, LinearHistory, LinearSpringDashpot, Material,
    NamedShape, NormalLaw, Pair, PlaneGeometry, Scene, TangentialLaw, ViscousCoulomb,
};
use solver::{Orientation, Simulation, Vector};

use crate::case::{Case, Description, Failure, Knob, Measurement, Quantity, Setup, Tier, setups};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::study::add_work;

/// The case.
pub struct BoxAtRest;

const LENGTH: f64 = 0.01;
const DENSITY: f64 = 2500.0;
const STIFFNESS: f64 = 1e5;
const FRICTION: f64 = 0.5;
const RESTITUTION: f64 = 0.5;
const GRAVITY: f64 = 9.81;
const DAMPING_RATE: f64 = 500.0;

const DRIFT: &str = "drift / edge length";
const TURN: &str = "turn";
const ACCELERATION: &str = "acceleration along the slope";

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Variant {
    name: &'static str,
    /// Slope as a part of the friction angle's tangent.
    steepness: f64,
    /// Boxes on top of each other, each turned about the vertical by another angle.
    boxes: usize,
    law: Law,
    points: ContactPoints,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Law {
    Spring,
    Viscous,
}

const VARIANTS: [Variant; 8] = [
    variant("on a plane", 0.0, 1),
    variant("on a slope, 0.99 of the friction angle", 0.99, 1),
    variant("on a slope, 1.01 of the friction angle", 1.01, 1),
    Variant { law: Law::Viscous, ..variant("on a slope, 0.99 of the friction angle, viscous law of R", 0.99, 1) },
    Variant { points: ContactPoints::Deepest, ..variant("on a slope, 0.99 of the friction angle, one contact point", 0.99, 1) },
    variant("box on box", 0.0, 2),
    variant("three boxes on a slope, half the friction angle", 0.5, 3),
    Variant { points: ContactPoints::Deepest, ..variant("box on box, one contact point", 0.0, 2) },
];

const fn variant(name: &'static str, steepness: f64, boxes: usize) -> Variant {
    Variant { name, steepness, boxes, law: Law::Spring, points: ContactPoints::All }
}

fn mass() -> f64 {
    DENSITY * LENGTH * LENGTH * LENGTH
}

impl Variant {
    fn slope(&self) -> f64 {
        (self.steepness * FRICTION).atan()
    }

    fn slides(&self) -> bool {
        self.steepness > 1.0
    }

    fn scene(&self, steps: f64) -> Scene {
        let mut scene = Scene::empty("box at rest", 1.0);
        let (sine, cosine) = self.slope().sin_cos();
        scene.scene.gravity = Some((downhill() * (GRAVITY * sine) - uphill_normal() * (GRAVITY * cosine)).into());
        scene.materials = vec![Material { name: "brick".into(), density: Some(DENSITY) }];
        let normal = NormalLaw::LinearSpringDashpot(LinearSpringDashpot {
            stiffness: STIFFNESS,
            restitution: RESTITUTION,
            end_of_contact: EndOfContact::ZeroOverlap,
        });
        let tangential = match self.law {
            Law::Spring => {
                TangentialLaw::LinearHistory(LinearHistory { friction: FRICTION, stiffness: 2.0 / 7.0 * STIFFNESS, damping_ratio: 0.3 })
            }
            Law::Viscous => TangentialLaw::ViscousCoulomb(ViscousCoulomb { friction: FRICTION, damping_rate: DAMPING_RATE }),
        };
        scene.pairs = vec![Pair { materials: ["brick".into(), "brick".into()], normal, tangential: Some(tangential), rolling: None }];
        let geometry = Geometry::Cuboid(CuboidGeometry { lengths: [LENGTH; 3] });
        scene.shapes = vec![NamedShape { name: "cube".into(), geometry }];
        scene.bodies = (0..self.boxes).map(body).collect();
        let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: uphill_normal().into() });
        scene.boundaries = vec![Boundary::new("ground", "brick", geometry)];
        scene.numerics.shaped_contact.points = self.points;
        // Four corners carry a box: a contact is as stiff as four springs.
        let contact = std::f64::consts::PI * (mass() / (4.0 * STIFFNESS)).sqrt();
        scene.numerics.step = solver::scene::Step::Seconds(contact / STEPS_PER_CONTACT);
        scene.scene.end_time = steps * contact / STEPS_PER_CONTACT;
        scene
    }
}

const STEPS_PER_CONTACT: f64 = 50.0;

/// A box of the stack; each is turned a little more about the vertical, so that faces overlap in octagons.
fn body(level: usize) -> Body {
    let upright = nalgebra::Matrix3::from_columns(&[downhill(), uphill_normal().cross(&downhill()), uphill_normal()]);
    let upright = Orientation::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(upright));
    let turn = upright * Orientation::from_scaled_axis(Vector::z() * (0.5 * level as f64));
    Body {
        position: (uphill_normal() * (LENGTH * (0.5 + level as f64))).into(),
        orientation: [turn.w, turn.i, turn.j, turn.k],
        ..Body::new("cube", "brick")
    }
}

/// The ground is oblique in space, so that no coordinate is special.
fn uphill_normal() -> Vector {
    Vector::new(2.0, 3.0, 6.0) / 7.0
}

fn downhill() -> Vector {
    Vector::new(6.0, 2.0, -3.0) / 7.0
}

/// Where all boxes are, and how fast the lowest slides.
struct Look {
    time: f64,
    places: Vec<Vector>,
    turns: Vec<Orientation>,
    velocity: f64,
}

impl Look {
    fn new(simulation: &mut Simulation) -> Look {
        let now = simulation.now();
        let count = now.bodies().len();
        Look {
            time: now.time(),
            places: (0..count).map(|index| now.position(index)).collect(),
            turns: (0..count).map(|index| now.orientation(index)).collect(),
            velocity: now.velocity(0).dot(&downhill()),
        }
    }
}

impl Case for BoxAtRest {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let variant = VARIANTS[setup.index];
        let mut simulation = variant.scene(knob).build()?;
        let end = simulation.scene().scene.end_time;
        // The boxes settle in a few thousand steps; what they do after half of the time is drift.
        simulation.run_until(0.5 * end)?;
        let middle = Look::new(&mut simulation);
        simulation.run_until(end)?;
        let last = Look::new(&mut simulation);
        let mut measurement = Measurement { runs: 1, ..Measurement::default() };
        add_work(&mut measurement.work, simulation.ledger().total_work());
        let quantity = |name, unit, value, expected, floor, error_kind| Quantity {
            name,
            unit,
            samples: vec![value],
            expected,
            reference: Reference { kind: ReferenceKind::Exact, uncertainty: 1e-15, source: "statics; Coulomb friction".into() },
            error_kind,
            floor,
        };
        if variant.slides() {
            let (sine, cosine) = variant.slope().sin_cos();
            let exact = GRAVITY * (sine - FRICTION * cosine);
            let mean = (last.velocity - middle.velocity) / (last.time - middle.time);
            let floor = f64::EPSILON * LENGTH / (simulation.time_step() * (last.time - middle.time)) / exact;
            measurement.quantities = vec![quantity(ACCELERATION, "m/s^2", mean, exact, floor, ErrorKind::Relative)];
        } else {
            let drifts = last.places.iter().zip(&middle.places).map(|(last, middle)| (last - middle).norm() / LENGTH);
            let turns = last.turns.iter().zip(&middle.turns).map(|(last, middle)| last.angle_to(middle));
            let (drift, turn) = (drifts.fold(0.0, f64::max), turns.fold(0.0, f64::max));
            measurement.quantities = vec![
                quantity(DRIFT, "1", drift, 0.0, rounding(&variant, knob), ErrorKind::Absolute),
                quantity(TURN, "rad", turn, 0.0, rounding(&variant, knob), ErrorKind::Absolute),
            ];
        }
        Ok(measurement)
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        let mut claims = Vec::new();
        for variant in &VARIANTS {
            for at in knobs(tier) {
                let claim = |quantity, bound| Claim {
                    setup: variant.name.into(),
                    quantity,
                    statistic: Statistic::Single,
                    subject: Subject::ErrorAt(at),
                    bound,
                    expected: Expected::Holds,
                };
                if variant.slides() {
                    let words = "twice the damped swing of the contact springs that is left, against the sliding";
                    claims.push(claim(ACCELERATION, Bound::new(4.0, residual_swing(at), words)));
                    continue;
                }
                // A stack rocks for longer than the short run.
                if variant.boxes > 1 && at < LONG {
                    continue;
                }
                let words = "rounding of places and normals that every step of the second half adds alike";
                let still = claim(DRIFT, Bound::new(4.0, rounding(variant, at), words));
                let expected = match (variant.law, variant.points) {
                    (Law::Viscous, _) => Expected::KnownLimit("the viscous law of R has no static friction: the box creeps".into()),
                    (_, ContactPoints::Deepest) => Expected::KnownLimit(
                        "a face that rests on one point at a time rocks, and its friction is forgotten at every change".into(),
                    ),
                    _ => Expected::Holds,
                };
                claims.push(Claim { expected, ..still });
            }
        }
        claims
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        VARIANTS.get(setup.index).map(|variant| variant.scene(knob))
    }

    fn description(&self) -> Description {
        let names: Vec<String> = VARIANTS.iter().map(|variant| variant.name.to_string()).collect();
        let resting: Vec<String> = VARIANTS.iter().filter(|variant| !variant.slides()).map(|variant| variant.name.into()).collect();
        Description {
            id: "box_at_rest",
            title: "Box at rest",
            question: "Does a box stay where it is below the friction angle, slide as it must above it, and stay on another box?",
            model: vec![
                "Cubes of 10 mm edge on a plane, on a slope just below and just above the friction angle, and on top of each other, each turned by half a radian against the one below, so that faces meet in octagons. After half of the run, when all has settled, positions and orientations are noted; what changes until the end is drift.",
                "Every corner of the common face is a contact point with its own tangential spring, found again from step to step by its place on the lower body. A code that looks at one point per pair lets the box rock on it, forgets its friction at every change of the point, and creeps.",
            ],
            equations: vec![
                Equation {
                    latex: r"\tan\alpha < \mu \;\Rightarrow\; \dot x = 0".into(),
                    meaning: "A box on a slope below the friction angle rests.".into(),
                },
                Equation {
                    latex: r"\tan\alpha > \mu \;\Rightarrow\; \ddot x = g(\sin\alpha - \mu\cos\alpha)".into(),
                    meaning: "Above it, it slides.".into(),
                },
            ],
            parameters: [
                ("edge, density", "10 mm, 2500 kg/m³", ""),
                ("stiffness of a contact point", "10⁵ N/m", "tangential 2/7 of it, damping ratio 0.3"),
                ("restitution, friction", "0.5, 0.5", ""),
                ("step", "1/50 of a contact on four corners", "5 µs"),
                ("ground", "normal along (2, 3, 6)/7", "no axis is special"),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "Statics: nothing moves; Coulomb's law: uniform acceleration.",
            picture: picture(),
            plots: vec![
                Plot::Convergence {
                    title: "Drift in the second half of the run".into(),
                    quantity: DRIFT.into(),
                    setups: resting.clone(),
                    statistics: vec!["single run".into()],
                    orders: vec![],
                    knob_is_resolution: true,
                    knob_label: "steps".into(),
                },
                Plot::Convergence {
                    title: "Turn in the second half of the run".into(),
                    quantity: TURN.into(),
                    setups: resting.clone(),
                    statistics: vec!["single run".into()],
                    orders: vec![],
                    knob_is_resolution: true,
                    knob_label: "steps".into(),
                },
                Plot::ErrorAgainstCost {
                    title: "Drift against run time".into(),
                    quantity: DRIFT.into(),
                    setups: resting,
                    statistic: "single run".into(),
                    targets: vec![1e-3, 1e-6, 1e-9],
                },
            ],
            headline: Headline {
                setup: names[1].clone(),
                quantity: DRIFT.into(),
                statistic: "single run".into(),
                knob: LONG,
                order_quantity: None,
            },
            sources: vec!["R (Rakotonirina 2016), sections 2.5-2.6 of chapter 3", "S (Srinivasan 2019), section 3.2: friction with memory"],
            answers: vec![
                "Codes with one contact point per pair of faces let a cube creep on a slope below the friction angle: shown by the setups with one contact point.",
                "A stack of boxes must not creep apart over 10⁵ steps.",
            ],
            remarks: vec!["Contact points are not held fixed and bodies are never put to sleep: what rests does so by its forces."],
            knob: Knob { name: |_| "steps", values: |tier, setup| knobs_of(&VARIANTS[setup.index], tier) },
            setups: setups(names),
            sample: "run",
            budget_cpu_s: [5.0, 60.0, 60.0],
        }
    }
}

const LONG: f64 = 100_000.0;

/// A stack that rests on one point at a time rocks by rounding: its short run says nothing that another would say again.
fn knobs_of(variant: &Variant, tier: Tier) -> Vec<f64> {
    let rocks = variant.boxes > 1 && variant.points == ContactPoints::Deepest;
    knobs(tier).into_iter().filter(|knob| !rocks || *knob >= LONG).collect()
}

fn knobs(tier: Tier) -> Vec<f64> {
    match tier {
        Tier::Quick => vec![20_000.0, LONG],
        Tier::Standard | Tier::Paper => vec![20_000.0, LONG, 1e6],
    }
}

/// Each step rounds places; what rests is rounded alike at every step, so that half of the steps add up. Faces on each other take their normal from the
/// distance of their cores, two crusts apart, which magnifies rounding by the edge over that distance.
fn rounding(variant: &Variant, steps: f64) -> f64 {
    let magnified = if variant.boxes > 1 { LENGTH / (2.0 * CRUST * 0.5 * LENGTH) } else { 1.0 };
    f64::EPSILON * 0.5 * steps * magnified
}

/// Default crust, as a part of half the edge.
const CRUST: f64 = 0.02;

/// The springs swing with a damping ratio of at least a tenth of a radian a step; after half the run only rounding is left of it.
fn residual_swing(steps: f64) -> f64 {
    let contact = std::f64::consts::PI * (mass() / (4.0 * STIFFNESS)).sqrt();
    let time = 0.5 * steps * contact / STEPS_PER_CONTACT;
    let exact = GRAVITY * 0.01 * FRICTION;
    let speed_of_rounding = f64::EPSILON * LENGTH / (contact / STEPS_PER_CONTACT);
    2.0 * speed_of_rounding * (0.5 * steps).sqrt() / (exact * time)
}

fn picture() -> Picture {
    let slope = FRICTION.atan();
    let (sine, cosine) = slope.sin_cos();
    let place = |along: f64, height: f64| [along * cosine + height * sine, -along * sine + height * cosine];
    let cube = |along: f64, height: f64, ghost: bool| PictureItem::Polygon {
        points: [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, z)| place(along + x, height + z)).to_vec(),
        ghost,
    };
    Picture {
        caption: "A cube on a slope at about the friction angle, and where it would be if it slid.".into(),
        items: vec![
            PictureItem::Wall { from: place(-1.5, 0.0), to: place(4.0, 0.0), solid_side: [-sine, -cosine] },
            cube(2.0, 0.0, true),
            cube(0.0, 0.0, false),
            PictureItem::Arrow { from: place(0.5, 0.5), to: [place(0.5, 0.5)[0], place(0.5, 0.5)[1] - 1.4], label: "g".into() },
            PictureItem::Dashed { from: place(-1.5, 0.0), to: [place(4.0, 0.0)[0], place(-1.5, 0.0)[1]] },
        ],
    }
}
