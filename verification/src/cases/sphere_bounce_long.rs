//! A sphere bounces between two walls a million times without loss: does its energy stay?

use std::f64::consts::PI;

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::scene::{
    Body, Boundary, BoundaryGeometry, ContactEdges, EndOfContact, Geometry, LinearSpringDashpot, Material, NamedShape, NormalLaw, Pair,
    PlaneGeometry, Scene, SphereGeometry, Step,
};
use solver::{Simulation, Vector};

use crate::case::{Case, Curve, Description, Failure, Knob, Measurement, Quantity, Setup, Tier, setups};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};

/// The case.
pub struct SphereBounceLong;

const RADIUS: f64 = 0.005;
const MASS: f64 = 1e-3;
const STIFFNESS: f64 = 1e5;
const VELOCITY: f64 = 0.7;
/// Free flight between walls, in durations of a contact.
const FLIGHT: f64 = 0.17;
/// Bounces after which a walk would have hardly begun.
const EARLY_BOUNCES: u64 = 20_000;
/// Points on the energy curve.
const SAMPLES: u64 = 500;

const ENERGY: &str = "energy change at the end";
const LARGEST: &str = "largest energy change";
const GROWTH: &str = "growth of the largest energy change after the first 20 000 bounces";
const PER_BOUNCE: &str = "energy change of a bounce, root mean square";

/// One setup.
#[derive(Clone, Copy, PartialEq)]
struct Variant {
    edges: ContactEdges,
    bounces: u64,
}

const VARIANTS: [Variant; 4] = [
    Variant { edges: ContactEdges::Sampled, bounces: 20_000 },
    Variant { edges: ContactEdges::Resolved, bounces: 20_000 },
    Variant { edges: ContactEdges::Sampled, bounces: 1_000_000 },
    Variant { edges: ContactEdges::Resolved, bounces: 1_000_000 },
];

impl Variant {
    fn label(&self) -> String {
        let edges = match self.edges {
            ContactEdges::Sampled => "sampled edges, as most codes",
            ContactEdges::Resolved => "resolved edges (default)",
        };
        let bounces = if self.bounces == 1_000_000 { "a million bounces" } else { "20 000 bounces" };
        format!("{edges}, {bounces}")
    }

    fn is_long(&self) -> bool {
        self.bounces == 1_000_000
    }

    /// Steps per contact at a tier.
    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match (self.is_long(), tier) {
            (false, _) => vec![5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0],
            // Sampled edges are there for comparison: a longer tier has time for them.
            (true, Tier::Quick) if self.edges == ContactEdges::Sampled => Vec::new(),
            (true, Tier::Quick) => vec![10.0],
            (true, _) => vec![10.0, 20.0, 50.0, 100.0, 200.0],
        }
    }
}

fn contact_duration() -> f64 {
    PI * (MASS / STIFFNESS).sqrt()
}

fn axis() -> Vector {
    Vector::new(2.0, 3.0, 6.0) / 7.0
}

fn scene(variant: &Variant, steps_per_contact: f64) -> Scene {
    let gap = FLIGHT * contact_duration() * VELOCITY;
    let mut scene = Scene::empty("a million bounces", (1.0 + FLIGHT) * contact_duration() * variant.bounces as f64);
    let material = |name: &str| Material { name: name.into(), density: None };
    scene.materials = vec![material("ball"), material("wall")];
    let normal = NormalLaw::LinearSpringDashpot(LinearSpringDashpot {
        stiffness: STIFFNESS,
        restitution: 1.0,
        end_of_contact: EndOfContact::ZeroOverlap,
    });
    scene.pairs = vec![Pair { materials: ["ball".into(), "wall".into()], normal, tangential: None, rolling: None }];
    scene.shapes = vec![NamedShape { name: "ball".into(), geometry: Geometry::Sphere(SphereGeometry { radius: RADIUS }) }];
    scene.bodies = vec![Body { mass: Some(MASS), velocity: (axis() * VELOCITY).into(), ..Body::new("ball", "ball") }];
    let wall = |name: &str, side: f64| {
        let (point, normal) = ((axis() * (side * (RADIUS + 0.5 * gap))).into(), (axis() * -side).into());
        Boundary::new(name, "wall", BoundaryGeometry::Plane(PlaneGeometry { point, normal }))
    };
    scene.boundaries = vec![wall("front", 1.0), wall("back", -1.0)];
    // An irrational excess, so that no two bounces begin at the same phase of a step.
    scene.numerics.step = Step::Seconds(contact_duration() / (steps_per_contact + 0.618_033_988_749_895));
    scene.numerics.contact_edges = variant.edges;
    scene
}

/// Energy relative to the start after each bounce, reduced on the fly.
struct Drift {
    bounces: u64,
    energy: f64,
    largest: f64,
    /// Largest change in the first bounces.
    largest_early: f64,
    sum_of_squares: f64,
    curve: Vec<Vec<f64>>,
}

fn bounce(simulation: &mut Simulation, bounces: u64) -> Result<Drift, Failure> {
    let start = simulation.bodies().half_step_velocity(0).norm_squared();
    let mut drift = Drift { bounces: 0, energy: 0.0, largest: 0.0, largest_early: 0.0, sum_of_squares: 0.0, curve: Vec::new() };
    let mut direction = 1.0;
    let gap = FLIGHT * contact_duration() * VELOCITY;
    let longest = (4.0 * (1.0 + FLIGHT) * contact_duration() * bounces as f64 / simulation.time_step()) as u64;
    while drift.bounces < bounces {
        if simulation.steps_taken() > longest {
            simulation.check_guards()?;
            return Err(Failure::NothingMeasured(
                "the sphere had not bounced as often as it should in four times the time it needs".into(),
            ));
        }
        simulation.step();
        // Past the middle between the walls, on the way back: in free flight.
        let along = simulation.bodies().position(0).dot(&axis());
        let velocity = simulation.bodies().half_step_velocity(0);
        if along * direction < 0.45 * gap && velocity.dot(&axis()) * direction < 0.0 {
            direction = -direction;
            let energy = velocity.norm_squared() / start - 1.0;
            drift.sum_of_squares += (energy - drift.energy).powi(2);
            drift.energy = energy;
            drift.largest = drift.largest.max(energy.abs());
            drift.bounces += 1;
            if drift.bounces == EARLY_BOUNCES {
                drift.largest_early = drift.largest;
            }
            if drift.bounces.is_multiple_of(bounces / SAMPLES) {
                drift.curve.push(vec![drift.bounces as f64, energy]);
            }
            if !energy.is_finite() || energy > 1e3 {
                return Err(Failure::NothingMeasured(format!("the energy had grown a thousandfold after {} bounces", drift.bounces)));
            }
        }
    }
    Ok(drift)
}

impl Case for SphereBounceLong {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let variant = VARIANTS[setup.index];
        let mut simulation = scene(&variant, knob).build()?;
        let drift = bounce(&mut simulation, variant.bounces)?;
        let reference = Reference { kind: ReferenceKind::Exact, uncertainty: 0.0, source: "conservation of energy".into() };
        let quantity = |name, value, floor| Quantity {
            name,
            unit: "1",
            samples: vec![value],
            expected: 0.0,
            reference: reference.clone(),
            error_kind: ErrorKind::Absolute,
            floor,
        };
        let growth = drift.largest / drift.largest_early;
        Ok(Measurement {
            quantities: vec![
                Quantity { expected: 1.0, ..quantity(GROWTH, growth, 2.0 * f64::EPSILON) },
                quantity(ENERGY, drift.energy, walk_floor(knob, variant.bounces)),
                quantity(LARGEST, drift.largest, walk_floor(knob, variant.bounces)),
                quantity(PER_BOUNCE, (drift.sum_of_squares / drift.bounces as f64).sqrt(), bounce_floor(knob)),
            ],
            work: simulation.ledger().total_work(),
            runs: 1,
            curves: vec![Curve {
                file: curve_file(setup.index, knob),
                columns: vec!["bounces", "relative_energy_error"],
                rows: drift.curve,
            }],
        })
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        let mut claims = Vec::new();
        for variant in &VARIANTS {
            let claim = |quantity, subject, bound, expected| Claim {
                setup: variant.label(),
                quantity,
                statistic: Statistic::Single,
                subject,
                bound,
                expected,
            };
            let is_resolved = variant.edges == ContactEdges::Resolved;
            if !variant.is_long() {
                let order = if is_resolved { 4.0 } else { 2.0 };
                let bound = Bound::new(2.0, 0.1, "the next term of the error at 10 steps, the coarsest of the fit");
                claims.push(claim(PER_BOUNCE, Subject::OrderAtLeast { order, range: [10.0, 40.0] }, bound, Expected::Holds));
                let reason = "a sampled edge changes the energy at second order, a hundred times more than a resolved one at 20 steps";
                let expected = if is_resolved { Expected::Holds } else { Expected::KnownLimit(reason.into()) };
                let bound = Bound::new(4.0, edge_error(20.0), "(angle in a step)^4 / 4!, the first term that straight edges neglect");
                claims.push(claim(PER_BOUNCE, Subject::ErrorAt(20.0), bound, expected));
                continue;
            }
            for knob in variant.knobs(tier) {
                // The sampled map is symplectic: its energy swings at every step. The resolved one is reversible but for rare bounces.
                claims.push(if knob <= 10.0 || !is_resolved {
                    claim(GROWTH, Subject::ErrorAt(knob), swing_bound(variant.bounces), Expected::Holds)
                } else {
                    claim(LARGEST, Subject::ErrorAt(knob), walk_bound(knob, variant.bounces), Expected::Holds)
                });
            }
        }
        claims
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        VARIANTS.get(setup.index).map(|variant| scene(variant, knob))
    }

    fn description(&self) -> Description {
        let labels: Vec<String> = VARIANTS.iter().map(Variant::label).collect();
        Description {
            id: "sphere_bounce_long",
            title: "A million elastic bounces",
            question: "How far does the energy of a sphere drift that bounces a million times without any loss?",
            model: vec![
                "A sphere flies to and fro between two walls and bounces off each elastically: restitution 1, no dashpot, no friction, no gravity. Its energy should be the same for ever.",
                "Leapfrog is symplectic, but that does not help here: the force of a contact has a kink where it begins and ends, and each kink changes the energy a little, up or down with the phase of the step at which it falls.",
                "The energy is taken in free flight after every bounce. What a million bounces make of it is shown as it is, for edges of contacts sampled as most codes do, and resolved as is the default here.",
            ],
            equations: vec![Equation {
                latex: r"m\,\ddot x = -k\,\max(0, x - x_\mathrm{wall}),\qquad \frac{v_n^2}{v_0^2} - 1 = 0\ \text{ exactly}".into(),
                meaning: "Elastic contact with a linear spring (R eq. 3.18); the energy error after n bounces.".into(),
            }],
            parameters: [
                ("mass, radius", "1 g, 5 mm", ""),
                ("stiffness", "10⁵ N/m", "a contact lasts 0.314 ms"),
                ("velocity", "0.7 m/s", "along (2, 3, 6)/7"),
                (
                    "free flight between walls",
                    "0.17 contact durations",
                    "phases never repeat: steps per contact exceed the stated number by 0.618",
                ),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "Conservation of energy: exact. The grey band is the walk of the rounding of a position of a few millimetres.",
            picture: picture(),
            plots: vec![
                curve_plot(3, 10.0, "Energy over a million bounces: resolved edges, 10 steps per contact"),
                curve_plot(2, 10.0, "Energy over a million bounces: sampled edges, 10 steps per contact"),
                Plot::Convergence {
                    title: "Energy change of one bounce".into(),
                    quantity: PER_BOUNCE.into(),
                    setups: labels[..2].to_vec(),
                    statistics: vec!["single run".into()],
                    orders: vec![2.0, 4.0],
                    knob_is_resolution: true,
                    knob_label: "steps per contact".into(),
                },
                Plot::ErrorAgainstCost {
                    title: "Energy change of one bounce against run time of 20 000".into(),
                    quantity: PER_BOUNCE.into(),
                    setups: labels[..2].to_vec(),
                    statistic: "single run".into(),
                    targets: vec![0.01, 0.001, 0.0001],
                },
            ],
            headline: Headline {
                setup: labels[1].clone(),
                quantity: PER_BOUNCE.into(),
                statistic: "single run".into(),
                knob: 20.0,
                order_quantity: Some(format!("observed order of {PER_BOUNCE}")),
            },
            sources: vec!["R (Rakotonirina 2016), sections 2.4 and 2.6, eq. 3.13 and 3.18"],
            answers: vec![
                "Stability test S08 (long-time energy): symplectic does not save contacts that are not smooth.",
                "Forward Euler, as found in a public code, gains 22 % of energy in a single bounce at 50 steps per contact; see the list of deliberate bugs.",
            ],
            remarks: vec![
                "Resolved edges make the energy change of a bounce of fourth order instead of second; the cost is two comparisons a contact and a short iteration at its end.",
                "Neither scheme gains energy steadily at 10 steps per contact: both maps can be run backwards, and their energy swings about its start. Sampled edges swing five times as far.",
                "The quick tier runs a million bounces at 10 steps per contact, with resolved edges; the standard tier at 10 to 200, with both.",
            ],
            knob: Knob { name: |_| "steps_per_contact", values: |tier, setup| VARIANTS[setup.index].knobs(tier) },
            setups: setups(labels),
            sample: "run",
            budget_cpu_s: [5.0, 240.0, 240.0],
        }
    }
}

/// Size of the energy change that the resolved edges of one bounce leave.
fn edge_error(knob: f64) -> f64 {
    (PI / knob).powi(4) / 24.0
}

/// A swing about the start has no more to grow after the first bounces; a walk grows by the square root of their number.
fn swing_bound(bounces: u64) -> Bound {
    let growth_of_a_walk = (bounces as f64 / EARLY_BOUNCES as f64).sqrt() - 1.0;
    Bound::new(0.25, growth_of_a_walk, "what an unbiased walk would have grown")
}

/// At a fine step the rare bounces whose end is not the mirror image of a start make the energy walk.
fn walk_bound(knob: f64, bounces: u64) -> Bound {
    let floor_is = "an unbiased walk of as many bounces, each off by what the edges of a bounce leave";
    Bound::new(4.0, edge_error(knob) * (bounces as f64).sqrt(), floor_is)
}

/// Energy change of a bounce from the rounding of an overlap of 0.07 mm computed from positions of some millimetres.
fn bounce_floor(knob: f64) -> f64 {
    let overlap = VELOCITY * contact_duration() / PI;
    4.0 * f64::EPSILON * RADIUS / overlap * knob.sqrt()
}

fn walk_floor(knob: f64, bounces: u64) -> f64 {
    bounce_floor(knob) * (bounces as f64).sqrt()
}

fn curve_file(index: usize, knob: f64) -> String {
    format!("energy_{index}_at_{knob}.csv")
}

fn curve_plot(index: usize, knob: f64, title: &str) -> Plot {
    Plot::Curves {
        title: title.into(),
        file: format!("sphere_bounce_long/{}", curve_file(index, knob)),
        x_label: "bounces".into(),
        y_label: "relative energy error".into(),
        columns: vec![["relative_energy_error".into(), VARIANTS[index].label()]],
        log_x: false,
        log_y: false,
        caption: String::new(),
    }
}

fn picture() -> Picture {
    let wall = |x: f64, side: f64| PictureItem::Wall { from: [x, -2.0], to: [x, 2.0], solid_side: [side, 0.0] };
    let arrow = |from: [f64; 2], to: [f64; 2]| PictureItem::Arrow { from, to, label: String::new() };
    Picture {
        caption: "A sphere flying to and fro between two walls; the gap is drawn much wider than it is.".into(),
        items: vec![
            wall(-4.0, -1.0),
            wall(4.0, 1.0),
            PictureItem::Disc { center: [-2.0, 0.0], radius: 1.0, ghost: true },
            PictureItem::Disc { center: [1.2, 0.0], radius: 1.0, ghost: false },
            arrow([1.2, 0.0], [3.4, 0.0]),
            arrow([-2.0, 1.4], [-3.6, 1.4]),
        ],
    }
}
