//! Balls that touch in a fluid which is resolved around them: do contacts and flow together keep restitution, weight and momentum?

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::scene::{Boundary, BoundaryGeometry, Coupling, Domain, Fluid, NormalLaw, PlaneGeometry, ResolvedCoupling, Scene};
use solver::{Simulation, Vector};

use super::soft_spheres::{MATERIAL, body, contact_duration, linear, scene, sphere, sphere_mass, vanishing};
use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::variant::Variant;

/// The case.
pub struct ContactInFluid;

const RADIUS: f64 = 3e-3;
/// Six cells a diameter: what is claimed does not depend on how well the flow is resolved.
const SPACING: f64 = 1e-3;
const FLUID_DENSITY: f64 = 1000.0;
const GRAVITY: f64 = 10.0;
/// Of the ball that bounces.
const HEAVY: f64 = 20_000.0;
const RESTITUTION: f64 = 0.8;
const IMPACT_SPEED: f64 = 0.5;
/// N/m, between the ball that bounces and its wall.
const STIFF: f64 = 2e4;
/// N/m, of contacts in which balls rest or meet slowly.
const SOFT: f64 = 400.0;
/// Step of the fluid in s where balls rest or meet.
const STEP: f64 = 1e-3;
/// Slip in m/s that is left in each step there.
const SLIP: f64 = 1e-8;
/// Steps until the fluid that the last of the fall has stirred is at rest.
const STEPS_TO_REST: u32 = 250;
const STEPS_OF_COLLISION: u32 = 30;
/// Speed in m/s of the faster of two balls that meet.
const LAUNCH: f64 = 0.3;
/// Parts of a step of the fluid at which a bounce begins.
const PHASES: u32 = 8;

const REBOUND: &str = "velocity after over before the contact, reversed";
const PRESSED: &str = "force on the wall over net weight";
const MOMENTUM: &str = "change of the momentum of fluid and balls, over that of one ball";

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Meeting {
    /// A heavy ball bounces off a floor in a thin fluid; the knob is the number of steps of the fluid in the contact.
    Bounce,
    /// A ball comes to rest on the floor, or if it is lighter than the fluid under the ceiling; the knob is its density over that of the fluid.
    Rest,
    /// Two balls meet in a box that repeats; the knob is their density over that of the fluid.
    Collision,
}

impl Variant for Meeting {
    fn all() -> Vec<Meeting> {
        vec![Meeting::Bounce, Meeting::Rest, Meeting::Collision]
    }

    fn label(&self) -> String {
        match self {
            Meeting::Bounce => "heavy ball off a floor, thin fluid",
            Meeting::Rest => "ball at rest on the floor or under the ceiling",
            Meeting::Collision => "two balls in a box that repeats",
        }
        .into()
    }

    fn knob_name(&self) -> &'static str {
        match self {
            Meeting::Bounce => "fluid_steps_in_contact",
            Meeting::Rest | Meeting::Collision => "density_ratio",
        }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match (self, tier) {
            (Meeting::Bounce, Tier::Quick) => vec![0.5, 1.0, 2.0, 4.0],
            (Meeting::Bounce, _) => vec![0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0],
            (Meeting::Rest, Tier::Quick) => vec![0.01, 0.3, 1.05, 8.0],
            (Meeting::Rest, _) => vec![1e-3, 0.01, 0.1, 0.3, 0.9, 1.05, 2.5, 8.0, 100.0],
            (Meeting::Collision, Tier::Quick) => vec![0.1, 1.0, 2.5],
            (Meeting::Collision, _) => vec![0.01, 0.1, 1.0, 2.5, 100.0],
        }
    }
}

impl Meeting {
    fn density(&self, knob: f64) -> f64 {
        if *self == Meeting::Bounce { HEAVY } else { knob * FLUID_DENSITY }
    }

    fn cells(&self) -> [f64; 3] {
        if *self == Meeting::Collision { [14.0, 12.0, 12.0] } else { [10.0, 10.0, 12.0] }
    }

    fn law(&self, knob: f64) -> NormalLaw {
        match self {
            Meeting::Bounce => linear(STIFF, RESTITUTION),
            Meeting::Rest => linear(SOFT, 0.3),
            Meeting::Collision => linear(SOFT * (knob / 2.5).max(1.0), 0.9),
        }
    }

    /// Step of the fluid in s.
    fn step(&self, knob: f64) -> f64 {
        match self {
            Meeting::Bounce => contact_duration(sphere_mass(HEAVY, RADIUS), STIFF) / knob,
            Meeting::Rest | Meeting::Collision => STEP,
        }
    }

    /// The scene; a ball that bounces starts higher by a part of what it flies in a step.
    fn scene(&self, knob: f64, phase: f64) -> Scene {
        let mut scene = scene("balls in a fluid", self.density(knob), self.law(knob), None);
        let upper = self.cells().map(|cells| cells * SPACING);
        scene.domain = Some(Domain { lower: [0.0; 3], upper, periodic: [true, true, *self == Meeting::Collision] });
        scene.fluid = Some(Fluid {
            density: FLUID_DENSITY,
            viscosity: if *self == Meeting::Bounce { 1e-3 } else { 0.02 },
            spacing: SPACING,
            step: self.step(knob),
            slip: if *self == Meeting::Rest { SLIP } else { 1e-6 },
            most_flows: 200,
            velocity: [0.0; 3],
            advection: true,
            mean_velocity: None,
            driving_force: None,
            moving_sides: Vec::new(),
        });
        scene.coupling = Some(Coupling { resolved: ResolvedCoupling::default() });
        scene.shapes = vec![sphere("ball", RADIUS)];
        let ball = |place: [f64; 3], velocity: [f64; 3]| body("ball", Vector::from(place) * SPACING, velocity.into());
        scene.bodies = match self {
            Meeting::Bounce => {
                let height = 4.6 + phase * IMPACT_SPEED * self.step(knob) / SPACING;
                vec![ball([4.2, 4.9, height], [0.0, 0.0, -IMPACT_SPEED])]
            }
            Meeting::Rest => vec![ball([4.2, 4.9, if knob < 1.0 { 8.95 } else { 3.05 }], [0.0; 3])],
            Meeting::Collision => {
                // Heavy balls squeeze the fluid out much faster than they are, and the step must resolve that.
                let speed = if knob > 10.0 { 0.1 } else { LAUNCH };
                vec![ball([3.9, 6.0, 6.2], [speed, 0.0, 0.0]), ball([10.1, 6.4, 5.9], [-0.7 * speed, 0.0, 0.0])]
            }
        };
        if *self != Meeting::Collision {
            let plane = |name: &str, height: f64, up: f64| {
                let plane = PlaneGeometry { point: [0.0, 0.0, height], normal: [0.0, 0.0, up] };
                Boundary::new(name, MATERIAL, BoundaryGeometry::Plane(plane))
            };
            scene.boundaries = vec![plane("floor", 0.0, 1.0), plane("ceiling", upper[2], -1.0)];
        }
        scene.scene.gravity = (*self == Meeting::Rest).then_some([0.0, 0.0, -GRAVITY]);
        scene.scene.end_time = f64::from(STEPS_TO_REST) * self.step(knob);
        scene
    }

    /// Mass of a ball with the fluid that it pushes in free fall over that fluid's, less one part: what of its momentum is not its own.
    fn part_of_fluid(&self, knob: f64) -> f64 {
        0.5 * FLUID_DENSITY / (self.density(knob) + 0.5 * FLUID_DENSITY)
    }

    fn net_weight(&self, knob: f64) -> f64 {
        (sphere_mass(self.density(knob), RADIUS) - sphere_mass(FLUID_DENSITY, RADIUS)).abs() * GRAVITY
    }

    /// Error of the force on the wall, over the net weight, if each of the three velocities whose difference is taken were off by the slip: their weights are 1.5, 2 and 0.5.
    fn floor_at_rest(&self, knob: f64) -> f64 {
        (sphere_mass(self.density(knob), RADIUS) + 0.5 * sphere_mass(FLUID_DENSITY, RADIUS)) * (4.0 * SLIP / STEP) / self.net_weight(knob)
    }

    /// Rounding of as many sums over all values of the velocity.
    fn floor_of_momentum(&self) -> f64 {
        f64::EPSILON * f64::from(STEPS_OF_COLLISION) * self.cells().iter().product::<f64>().sqrt()
    }
}

/// Restitution of the first contact with the floor, seen step by step of the fluid.
fn rebound(simulation: &mut Simulation, step: f64) -> Result<f64, Failure> {
    let (mut before, mut now, mut touches) = (0.0, -IMPACT_SPEED, false);
    let mut steps = 0_u32;
    while now < 0.0 || touches {
        before = if touches { before } else { now };
        steps += 1;
        simulation.run_until(f64::from(steps) * step)?;
        (now, touches) = (simulation.now().velocity(0).z, simulation.now().contacts().contacts > 0);
        if f64::from(steps) * step > 4.0 * RADIUS / IMPACT_SPEED {
            return Err(Failure::NothingMeasured("the ball had not left the floor in four times the time it needs".into()));
        }
    }
    Ok(-now / before)
}

/// Momentum in kg m/s of the fluid and of what balls weigh more than it.
fn momentum_of_all(simulation: &mut Simulation) -> Vector {
    let Some(domain) = simulation.scene().domain.clone() else { return Vector::zeros() };
    let volume: f64 = (0..3).map(|axis| domain.upper[axis] - domain.lower[axis]).product();
    let now = simulation.now();
    let excess = |index: usize| (now.bodies().mass(index) - sphere_mass(FLUID_DENSITY, RADIUS)) * now.velocity(index);
    now.mean_flow() * (FLUID_DENSITY * volume) + (0..now.bodies().len()).map(excess).sum::<Vector>()
}

/// Largest change of the momentum of all over that of one ball, if the balls touch at all.
fn change_of_momentum(simulation: &mut Simulation) -> Result<f64, Failure> {
    let start = momentum_of_all(simulation);
    let scale = simulation.bodies().mass(0).max(sphere_mass(FLUID_DENSITY, RADIUS)) * LAUNCH;
    let (mut largest, mut has_touched) = (0.0_f64, false);
    for step in 1..=STEPS_OF_COLLISION {
        simulation.run_until(f64::from(step) * STEP)?;
        has_touched |= simulation.now().contacts().contacts > 0;
        largest = largest.max((momentum_of_all(simulation) - start).norm() / scale);
    }
    if has_touched { Ok(largest) } else { Err(Failure::NothingMeasured("the balls never touched".into())) }
}

impl Case for ContactInFluid {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let meeting = Meeting::of(setup)?;
        let mut simulation = meeting.scene(knob, 0.0).build()?;
        let quantity = |name, samples, expected, floor, source: &str| Quantity {
            name,
            unit: "1",
            samples,
            expected,
            reference: Reference { kind: ReferenceKind::Exact, uncertainty: 0.0, source: source.into() },
            error_kind: ErrorKind::Absolute,
            floor,
        };
        let measured = match meeting {
            Meeting::Bounce => {
                let mut rebounds = Vec::new();
                for phase in 0..PHASES {
                    simulation = meeting.scene(knob, f64::from(phase) / f64::from(PHASES)).build()?;
                    rebounds.push(rebound(&mut simulation, meeting.step(knob))?);
                }
                quantity(REBOUND, rebounds, RESTITUTION, 0.0, "restitution of the contact law, which a heavy ball in a thin fluid keeps")
            }
            Meeting::Rest => {
                simulation.run_until(f64::from(STEPS_TO_REST) * STEP)?;
                let force = simulation.now().contacts().largest_overlap * SOFT;
                let value = force / meeting.net_weight(knob);
                quantity(PRESSED, vec![value], 1.0, meeting.floor_at_rest(knob), "weight less that of the fluid displaced")
            }
            Meeting::Collision => {
                let value = change_of_momentum(&mut simulation)?;
                vanishing(MOMENTUM, "1", vec![value], meeting.floor_of_momentum(), ReferenceKind::Exact, "conservation of momentum")
            }
        };
        Ok(Measurement {
            quantities: vec![measured],
            work: simulation.ledger().total_work(),
            runs: if meeting == Meeting::Bounce { u64::from(PHASES) } else { 1 },
            curves: Vec::new(),
        })
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        Meeting::claims(tier, |meeting, knob| {
            let claim = |quantity, statistic, bound| meeting.claim_at(knob, quantity, statistic, bound, Expected::Holds);
            match meeting {
                Meeting::Bounce => {
                    let words = "the added mass over the mass, twice over the steps in a contact, and a quarter of it for friction: at the wall it is another than in free fall, which a contact is weighed with";
                    let bound = |factor| Bound::new(factor, meeting.part_of_fluid(knob) * (2.0 / knob.max(1.0) + 0.25), words);
                    let reason =
                        "a contact that is over within a step of the fluid gives the impulse of the mass in free fall to that at the wall";
                    let expected = || if knob < 1.0 { Expected::KnownLimit(reason.into()) } else { Expected::Holds };
                    [(Statistic::Median, 1.0), (Statistic::Worst, 2.0)]
                        .map(|(statistic, factor)| meeting.claim_at(knob, REBOUND, statistic, bound(factor), expected()))
                        .to_vec()
                }
                Meeting::Rest => {
                    let bound =
                        Bound::new(5.0, meeting.floor_at_rest(knob), "the slip that is left, in all velocities of a step, as a force");
                    vec![claim(PRESSED, Statistic::Single, bound)]
                }
                Meeting::Collision => {
                    let bound = Bound::new(10.0, meeting.floor_of_momentum(), "rounding of the sums over all values");
                    vec![claim(MOMENTUM, Statistic::Single, bound)]
                }
            }
        })
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        Meeting::of(setup).ok().map(|meeting| meeting.scene(knob, 0.0))
    }

    fn description(&self) -> Description {
        description()
    }
}

fn description() -> Description {
    let plot = |title: &str, quantity: &str, meeting: Meeting, is_resolution: bool, label: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: vec![meeting.label()],
        statistics: if meeting == Meeting::Bounce {
            ["median", "worst"].map(|word| format!("{word} of {PHASES} runs")).to_vec()
        } else {
            vec!["single run".into()]
        },
        orders: Vec::new(),
        knob_is_resolution: is_resolution,
        knob_label: label.into(),
    };
    Description {
        id: "contact_in_fluid",
        title: "Balls that touch in a fluid",
        question: "Do balls in a fluid that is resolved around them bounce with their restitution, rest with their net weight and keep momentum?",
        model: vec![
            "Flow and motion of the bodies are found together in one implicit step (R eq. 7.1 to 7.4); the contacts of the bodies take many short steps within it. Bodies go where contacts, the fluid's force of the last step and weight bring them; then flow and velocities are solved for at the new places, under the impulses that the contacts have given (the force F of contacts in R eq. 7.2).",
            "Three things must hold on a grid of six cells a diameter as well. A ball of twenty times the density of a thin fluid leaves a wall as its contact law says, if the contact lasts as long as a step of the fluid or longer. What lies on a floor presses on it with its weight less that of the fluid it displaces, and what is lighter than the fluid presses on the ceiling. Two balls that meet keep the momentum of everything.",
        ],
        equations: vec![
            Equation {
                latex: r"(\rho_s - \rho_f) V\,\dot U = (\rho_s - \rho_f) V g + \sum F_c - \int \lambda".into(),
                meaning: "Balance of a body (R eq. 7.2): what it weighs more than the fluid, contacts, and the forces that hold the fluid to its motion.".into(),
            },
            Equation {
                latex: r"\mathcal{D}\left[(\rho_s - \rho_f) V\,U - J\right] = \dots,\qquad J = \int F_c\,dt".into(),
                meaning: "As coded: differences backwards over two steps of the momentum less the sum of all impulses, so that a bounce is over at the end of its step.".into(),
            },
        ],
        parameters: [
            ("ball", "radius 3 mm", "six cells a diameter"),
            ("bouncing ball", "20 000 kg/m³, 0.5 m/s", "stiffness 2·10⁴ N/m, restitution 0.8, fluid 10⁻³ Pa s: Stokes number 6000"),
            ("resting and meeting balls", "400 N/m", "fluid 0.02 Pa s, steps of 1 ms; slip 10⁻⁸ m/s at rest, 10⁻⁶ m/s of two balls"),
            ("box", "10 x 10 x 12 cells; 14 x 12 x 12 for two balls", "walls below and above; repeats in all directions for two balls"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Restitution of the contact law; weight less buoyancy; conservation of momentum: all exact. The fluid takes a part of the bounce, which the bound holds.",
        picture: picture(),
        plots: vec![
            plot("Restitution against steps of the fluid in a contact", REBOUND, Meeting::Bounce, true, "steps of the fluid in a contact"),
            plot("Force of a ball at rest against its density", PRESSED, Meeting::Rest, false, "density of the ball over that of the fluid"),
            plot("Momentum of fluid and balls", MOMENTUM, Meeting::Collision, false, "density of the balls over that of the fluid"),
        ],
        headline: Headline {
            setup: Meeting::Rest.label(),
            quantity: PRESSED.into(),
            statistic: "single run".into(),
            knob: 0.01,
            order_quantity: None,
        },
        sources: vec!["R (Rakotonirina 2016), sections 7.1 and 7.2, eq. 7.1 to 7.4"],
        answers: vec![
            "Stability test S27 (a coarse step of the fluid at a given contact): restitution within 0.04 at one step a contact, 0.01 at four.",
            "Stability test S34 (density ratios) with contacts.",
        ],
        remarks: vec![
            "For its contacts a ball weighs what it weighs with half of the fluid it displaces, its added mass far from walls. With its bare mass one of a hundredth of the fluid's density comes to rest under the ceiling a hundred times more slowly.",
            "The film of fluid in a gap below one cell is not resolved, and no lubrication force stands in for it. In a viscous fluid a ball therefore keeps more of its speed than in experiments: at a Stokes number of 280 and 8 cells a diameter 0.94 of the restitution of the contact.",
            "A cell that a wall and a ball close in has a pressure that nothing determines. It is left out of the guess of each step; else what the impact left there would press for ever.",
        ],
        knob: Meeting::knob(),
        setups: Meeting::setups(),
        sample: "run",
        budget_cpu_s: [5.0, 120.0, 120.0],
    }
}

fn picture() -> Picture {
    let wall = |y: f64, side: f64| PictureItem::Wall { from: [-5.0, y], to: [5.0, y], solid_side: [0.0, side] };
    let disc = |center: [f64; 2], ghost| PictureItem::Disc { center, radius: 3.0, ghost };
    let arrow = |from: [f64; 2], to: [f64; 2]| PictureItem::Arrow { from, to, label: String::new() };
    Picture {
        caption: "A ball between the two walls of the box: it bounces off the floor, or comes to rest on it.".into(),
        items: vec![wall(0.0, -1.0), wall(12.0, 1.0), disc([-0.8, 4.6], true), disc([-0.8, 3.0], false), arrow([3.4, 5.0], [3.4, 1.0])],
    }
}
