//! A sphere on a wall with friction: does it slip, roll, and pass from one to the other as it must?

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::Vector;
use solver::scene::{
    Body, Boundary, BoundaryGeometry, ConstantTorque, ContactEdges, DampingTime, EndOfContact, Geometry, InitialOverlap, LinearHistory,
    LinearSpringDashpot, Material, NamedShape, NormalLaw, Pair, PlaneGeometry, RollingLaw, Scene, SphereGeometry, Step, TangentialLaw,
    ViscousCoulomb,
};

use crate::case::{Case, Description, Failure, Knob, Measurement, Quantity, Setup, Tier, setups};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::rolling_sphere::{Rolling, RollingSphere};
use crate::study::add_work;

/// The case.
pub struct SphereOnIncline;

const RADIUS: f64 = 0.005;
const DENSITY: f64 = 2500.0;
const GRAVITY: f64 = 9.81;
const STIFFNESS: f64 = 1e4;
const TANGENTIAL_STIFFNESS: f64 = 2.0 / 7.0 * STIFFNESS;
const DAMPING_RATIO: f64 = 0.2;
const RESTITUTION: f64 = 0.7;
const DAMPING_RATE: f64 = 200.0;
const SAMPLES: usize = 200;

/// One setup: what the sphere is to do.
#[derive(Clone, Copy, PartialEq)]
struct Variant {
    name: &'static str,
    /// Inclination in radians.
    inclination: f64,
    friction: f64,
    start_velocity: f64,
    end_time: f64,
    law: Law,
    damping: DampingTime,
    /// Coefficient of rolling friction of a sphere that rolls from the start; zero for one that does not spin then.
    rolling_friction: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum Law {
    Spring,
    Viscous,
}

const VARIANTS: [Variant; 7] = [
    Variant {
        name: "slips: 40 degrees, friction 0.2",
        inclination: 40.0 / 180.0 * std::f64::consts::PI,
        friction: 0.2,
        start_velocity: 0.0,
        end_time: 0.006,
        law: Law::Spring,
        damping: DampingTime::Centred,
        rolling_friction: 0.0,
    },
    Variant {
        name: "rolls: 15 degrees, friction 0.5",
        inclination: 15.0 / 180.0 * std::f64::consts::PI,
        friction: 0.5,
        start_velocity: 0.0,
        end_time: 0.003,
        law: Law::Spring,
        damping: DampingTime::Centred,
        rolling_friction: 0.0,
    },
    Variant {
        name: "rolls: 15 degrees, friction 0.5, lagged damping",
        inclination: 15.0 / 180.0 * std::f64::consts::PI,
        friction: 0.5,
        start_velocity: 0.0,
        end_time: 0.003,
        law: Law::Spring,
        damping: DampingTime::Lagged,
        rolling_friction: 0.0,
    },
    Variant {
        name: "slides, then rolls: flat, friction 0.5, 0.1 m/s",
        inclination: 0.0,
        friction: 0.5,
        start_velocity: 0.1,
        end_time: 0.0065,
        law: Law::Spring,
        damping: DampingTime::Centred,
        rolling_friction: 0.0,
    },
    Variant {
        name: "creeps: viscous law, 15 degrees",
        inclination: 15.0 / 180.0 * std::f64::consts::PI,
        friction: 0.5,
        start_velocity: 0.0,
        end_time: 0.0015,
        law: Law::Viscous,
        damping: DampingTime::Centred,
        rolling_friction: 0.0,
    },
    Variant {
        name: "creeps: viscous law, 15 degrees, lagged damping",
        inclination: 15.0 / 180.0 * std::f64::consts::PI,
        friction: 0.5,
        start_velocity: 0.0,
        end_time: 0.0015,
        law: Law::Viscous,
        damping: DampingTime::Lagged,
        rolling_friction: 0.0,
    },
    Variant {
        name: "rolls against a torque: flat, rolling friction 0.05, 0.1 m/s",
        inclination: 0.0,
        friction: 0.5,
        start_velocity: 0.1,
        end_time: 0.003,
        law: Law::Spring,
        damping: DampingTime::Centred,
        rolling_friction: 0.05,
    },
];

const VELOCITY: &str = "final velocity";
const SPIN: &str = "final spin x lever arm";

/// Half period in s of the contact along the normal.
fn half_period() -> f64 {
    std::f64::consts::PI * (mass() / STIFFNESS).sqrt()
}

fn mass() -> f64 {
    DENSITY * 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3)
}

impl Variant {
    /// Overlap in m under which the spring carries the weight.
    fn overlap(&self) -> f64 {
        mass() * GRAVITY * self.inclination.cos() / STIFFNESS
    }

    /// The same sphere, exactly. The contact point lies in the middle of the overlap.
    fn exact(&self) -> RollingSphere {
        RollingSphere {
            mass: mass(),
            inertia: 0.4 * mass() * RADIUS * RADIUS,
            arm: RADIUS - 0.5 * self.overlap(),
            pull: GRAVITY * self.inclination.sin(),
            cap: self.friction * mass() * GRAVITY * self.inclination.cos(),
            start_velocity: self.start_velocity,
            start_slip: if self.rolling_friction > 0.0 { 0.0 } else { self.start_velocity },
            resistance: self.rolling_friction * RADIUS * mass() * GRAVITY * self.inclination.cos(),
        }
    }

    /// The exact motion, found once for all samples: its events are no part of the cost of a run.
    fn exact_motion(&self) -> Box<dyn Fn(f64) -> Rolling> {
        let sphere = self.exact();
        match self.law {
            Law::Viscous => Box::new(move |time| sphere.with_viscous_friction(2.0 * DAMPING_RATE * mass(), time)),
            Law::Spring => {
                let dashpot = 2.0 * DAMPING_RATIO * (TANGENTIAL_STIFFNESS * sphere.effective_mass()).sqrt();
                // Runs end on a whole step, up to one contact after the nominal end.
                let motion = sphere.with_spring(TANGENTIAL_STIFFNESS, dashpot, self.end_time + half_period());
                Box::new(move |time| motion.at(time))
            }
        }
    }

    /// Velocity of the size of the motion, for floors.
    fn velocity_scale(&self) -> f64 {
        self.start_velocity + GRAVITY * self.inclination.sin() * self.end_time
    }

    /// Steps per contact of a sample: spread over one about the nominal number, so that stick and slip begin at all phases of a step.
    fn steps_per_contact(knob: f64, sample: usize) -> f64 {
        knob + (sample as f64 + 0.5) / SAMPLES as f64 - 0.5
    }

    fn scene(&self, steps_per_contact: f64) -> Scene {
        let mut scene = Scene::empty("sphere on incline", self.end_time);
        let (sine, cosine) = self.inclination.sin_cos();
        scene.scene.gravity = Some((downhill() * (GRAVITY * sine) - uphill_normal() * (GRAVITY * cosine)).into());
        let material = |name: &str, density| Material { name: name.into(), density };
        scene.materials = vec![material("glass", Some(DENSITY)), material("wall", None)];
        let normal = NormalLaw::LinearSpringDashpot(LinearSpringDashpot {
            stiffness: STIFFNESS,
            restitution: RESTITUTION,
            end_of_contact: EndOfContact::ZeroOverlap,
        });
        let tangential = match self.law {
            Law::Spring => TangentialLaw::LinearHistory(LinearHistory {
                friction: self.friction,
                stiffness: TANGENTIAL_STIFFNESS,
                damping_ratio: DAMPING_RATIO,
            }),
            Law::Viscous => TangentialLaw::ViscousCoulomb(ViscousCoulomb { friction: self.friction, damping_rate: DAMPING_RATE }),
        };
        let friction = self.rolling_friction;
        let rolling = (friction > 0.0).then_some(RollingLaw::ConstantTorque(ConstantTorque { friction }));
        scene.pairs = vec![Pair { materials: ["glass".into(), "wall".into()], normal, tangential: Some(tangential), rolling }];
        scene.shapes = vec![NamedShape { name: "ball".into(), geometry: Geometry::Sphere(SphereGeometry { radius: RADIUS }) }];
        scene.bodies = vec![Body {
            position: (uphill_normal() * (RADIUS - self.overlap())).into(),
            velocity: (downhill() * self.start_velocity).into(),
            angular_velocity: (turning() * ((self.start_velocity - self.exact().start_slip) / self.exact().arm)).into(),
            ..Body::new("ball", "glass")
        }];
        let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: uphill_normal().into() });
        scene.boundaries = vec![Boundary::new("incline", "wall", geometry)];
        scene.numerics.step = Step::Seconds(half_period() / steps_per_contact);
        scene.numerics.initial_overlap = InitialOverlap::Allow;
        scene.numerics.damping = self.damping;
        scene.numerics.contact_edges = if self.damping == DampingTime::Lagged { ContactEdges::Sampled } else { ContactEdges::Resolved };
        scene
    }
}

/// The wall is oblique in space, so that no coordinate is special.
fn uphill_normal() -> Vector {
    Vector::new(2.0, 3.0, 6.0) / 7.0
}

/// The axis about which a sphere turns that rolls downhill.
fn turning() -> Vector {
    uphill_normal().cross(&downhill())
}

fn downhill() -> Vector {
    Vector::new(6.0, 2.0, -3.0) / 7.0
}

impl Case for SphereOnIncline {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let variant = VARIANTS[setup.index];
        let mut measurement = Measurement { runs: SAMPLES as u64, ..Measurement::default() };
        let mut samples = [Vec::new(), Vec::new()];
        let arm = variant.exact().arm;
        let exact_motion = variant.exact_motion();
        let end = exact_motion(variant.end_time);
        for sample in 0..SAMPLES {
            let mut simulation = variant.scene(Variant::steps_per_contact(knob, sample)).build()?;
            simulation.run_until(variant.end_time)?;
            let exact = exact_motion(simulation.time());
            let now = simulation.now();
            // Runs end on a whole step: the deviation is taken at that time and told as one of the nominal end.
            let velocity = now.velocity(0).dot(&downhill()) - exact.velocity;
            let spin = now.angular_velocity(0).dot(&turning()) - exact.angular_velocity;
            samples[0].push(end.velocity + velocity);
            samples[1].push((end.angular_velocity + spin) * arm);
            add_work(&mut measurement.work, simulation.ledger().total_work());
        }
        // A sum of many kicks of rounding error; the equilibrium overlap is known to the rounding of a position of 5 mm.
        let steps = variant.end_time * knob / half_period();
        let weight_error = f64::EPSILON * RADIUS / variant.overlap();
        let floor = (f64::EPSILON * steps.sqrt() + 4.0 * weight_error) * variant.velocity_scale();
        let source = "closed form by pieces, joined at stick and slip";
        measurement.quantities = [(VELOCITY, end.velocity), (SPIN, end.angular_velocity * arm)]
            .into_iter()
            .zip(samples)
            .map(|((name, expected), samples)| Quantity {
                name,
                unit: "m/s",
                samples,
                expected,
                reference: Reference { kind: ReferenceKind::Exact, uncertainty: 1e-14, source: source.into() },
                error_kind: ErrorKind::Absolute,
                floor,
            })
            .collect();
        Ok(measurement)
    }

    fn claims(&self, _tier: Tier) -> Vec<Claim> {
        let order = |variant: &Variant, quantity, subject, factor: f64| Claim {
            setup: variant.name.into(),
            quantity,
            statistic: Statistic::Median,
            subject,
            bound: Bound::new(factor, 1.0 / 20.0, "the next term of the error at 20 steps, the coarsest of the fit"),
            expected: Expected::Holds,
        };
        let range = [20.0, 400.0];
        let mut claims: Vec<Claim> = Vec::new();
        for variant in &VARIANTS {
            for quantity in [VELOCITY, SPIN] {
                claims.push(match variant.damping {
                    DampingTime::Lagged => order(variant, quantity, Subject::OrderAbout { order: 1.0, range }, 4.0),
                    DampingTime::Centred => order(variant, quantity, Subject::OrderAtLeast { order: 2.0, range }, 3.0),
                });
                if variant.damping == DampingTime::Centred {
                    claims.push(error_at_fifty(variant, quantity));
                }
            }
        }
        claims
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        VARIANTS.get(setup.index).map(|variant| variant.scene(knob))
    }

    fn description(&self) -> Description {
        let names: Vec<String> = VARIANTS.iter().map(|variant| variant.name.to_string()).collect();
        Description {
            id: "sphere_on_incline",
            title: "Sphere on an incline",
            question: "Does a sphere slip, roll, and pass from slipping to rolling exactly as its friction law says?",
            model: vec![
                "A glass sphere of 5 mm radius lies on a flat wall, pressed on by its weight. On a steep slope with little friction it slips; on a gentle one it rolls; thrown flat it slides until it rolls.",
                "In the last setup a torque of constant size resists the rolling: the sphere slows by 5/7 of it over mass and radius.",
                "Two friction laws: a tangential spring with memory and a dashpot beside it, capped by Coulomb's law; and the viscous law of source R, which has no static friction, so that the sphere keeps a slip velocity while it rolls.",
                "The error is that of velocity and spin at the end of each motion against the exact solution of the coded law, with its springs: not against the rigid sphere.",
            ],
            equations: vec![
                Equation {
                    latex: r"\dot v = g\sin\alpha - F/m,\qquad \dot\omega = F a/I,\qquad |F|\le\mu m g\cos\alpha".into(),
                    meaning: "Motion along the wall; a is the distance from the centre to the contact point.".into(),
                },
                Equation {
                    latex: r"F = k_t\,\xi + c_t\,u,\qquad \dot\xi = u = v - \omega a".into(),
                    meaning: "Tangential spring with memory (S eq. 3.42), below the Coulomb cap.".into(),
                },
                Equation {
                    latex: r"F = 2\gamma_t m\,u \;\Rightarrow\; u_\infty = \frac{g\sin\alpha}{7\gamma_t}".into(),
                    meaning: "Viscous law of R (eq. 3.21): terminal slip of a rolling sphere.".into(),
                },
            ],
            parameters: [
                ("radius, density", "5 mm, 2500 kg/m³", ""),
                ("normal stiffness", "10⁴ N/m", "overlap under the weight 1.3 µm"),
                ("tangential stiffness", "2/7 of the normal one", "damping ratio 0.2"),
                ("viscous rate γ_t", "200 1/s", "terminal slip 1.8 mm/s at 15°"),
                ("wall", "normal along (2, 3, 6)/7", "no axis is special"),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "Closed forms of each piece of the motion (sticking oscillator, uniform slip, viscous relaxation), joined at events found to the last bit; checked against a brute-force integration and the published rigid-ball results.",
            picture: picture(),
            plots: vec![
                convergence("Velocity at the end", VELOCITY, &names),
                convergence("Spin at the end", SPIN, &names),
                Plot::ErrorAgainstCost {
                    title: "Error of the velocity against run time".into(),
                    quantity: VELOCITY.into(),
                    setups: names.clone(),
                    statistic: "median".into(),
                    targets: vec![0.1, 0.01, 0.001],
                },
            ],
            headline: Headline {
                setup: names[1].clone(),
                quantity: VELOCITY.into(),
                statistic: "median".into(),
                knob: 50.0,
                order_quantity: Some(format!("observed order of {VELOCITY}")),
            },
            sources: vec![
                "S (Srinivasan 2019), section 3.2, eq. 3.41-3.47",
                "R (Rakotonirina 2016), section 2.6, eq. 3.20-3.21",
                "MFiX verification suite, case DEM04: end of slip 2 u0 / (7 mu g), final velocity 5/7 u0",
            ],
            answers: vec![
                "Does a tangential law hold a grain at rest, let it roll, let it slip? Each regime has its own setup.",
                "R's law has no static friction: shown as the terminal slip it is.",
            ],
            remarks: vec![
                "The tangential spring is stretched by leapfrog's own displacement over each step, so it carries no half-step lag; only its dashpot needs the centred velocity.",
            ],
            knob: Knob { name: |_| "steps_per_contact", values: |_, _| vec![10.0, 20.0, 50.0, 100.0, 200.0, 400.0] },
            setups: setups(names),
            sample: "phase",
            budget_cpu_s: [5.0, 60.0, 60.0],
        }
    }
}

/// The size of a second-order error: (rate x step)^2 / 12 of the velocity at which the contact point moves, times what is left of a motion that
/// decays, times the share of it that goes into velocity or spin.
fn error_at_fifty(variant: &Variant, quantity: &'static str) -> Claim {
    let exact = variant.exact();
    let (rate, decay) = match variant.law {
        Law::Spring => ((TANGENTIAL_STIFFNESS / exact.effective_mass()).sqrt(), DAMPING_RATIO),
        Law::Viscous => (2.0 * DAMPING_RATE * mass() / exact.effective_mass(), 1.0),
    };
    let slides = exact.start_slip > 0.0;
    // Beyond the slope 7/2 of the friction coefficient a sphere cannot roll.
    let slips = slides || exact.slip_pull() * exact.effective_mass() > exact.cap;
    let pull = if slides { exact.cap / mass() } else { exact.slip_pull() };
    let time = rate * variant.end_time;
    let left = if slips && variant.law == Law::Spring { 1.0 } else { time * (-decay * time).exp() };
    let share_of_velocity = exact.effective_mass() / mass();
    let share = if quantity == VELOCITY { share_of_velocity } else { 1.0 - share_of_velocity };
    let in_a_step = rate * half_period() / 50.0;
    let design = in_a_step * in_a_step / 12.0 * pull / rate * left * share;
    Claim {
        setup: variant.name.into(),
        quantity,
        statistic: Statistic::Median,
        subject: Subject::ErrorAt(50.0),
        bound: Bound::new(
            4.0,
            design,
            "(rate x step)^2 / 12 of the velocity at which the contact point moves, as far as it has not decayed",
        ),
        expected: Expected::Holds,
    }
}

fn convergence(title: &str, quantity: &str, setups: &[String]) -> Plot {
    Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: setups.to_vec(),
        statistics: vec!["median".into(), "worst".into()],
        orders: vec![1.0, 2.0],
        knob_is_resolution: true,
        knob_label: "steps per contact".into(),
    }
}

fn picture() -> Picture {
    let (sine, cosine) = (30.0_f64.to_radians().sin(), 30.0_f64.to_radians().cos());
    let along = |distance: f64, height: f64| [distance * cosine + height * sine, -distance * sine + height * cosine];
    let arrow = |from: [f64; 2], to: [f64; 2], label: &str| PictureItem::Arrow { from, to, label: label.into() };
    Picture {
        caption: "A sphere on an inclined wall: gravity pulls it down, friction at the contact point turns it.".into(),
        items: vec![
            PictureItem::Wall { from: along(-4.0, 0.0), to: along(5.0, 0.0), solid_side: [-sine, -cosine] },
            PictureItem::Disc { center: along(3.4, 1.0), radius: 1.0, ghost: true },
            PictureItem::Disc { center: along(-1.5, 1.0), radius: 1.0, ghost: false },
            arrow(along(-1.5, 1.0), along(0.6, 1.0), "v"),
            arrow(along(-1.5, 1.0), [along(-1.5, 1.0)[0], along(-1.5, 1.0)[1] - 2.2], "g"),
            PictureItem::Dashed { from: along(-4.0, 0.0), to: [along(5.0, 0.0)[0], along(-4.0, 0.0)[1]] },
        ],
    }
}
