//! Two spheres meet head-on: does the contact give back the restitution, the duration and the overlap that its law promises?

use std::f64::consts::PI;

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::scene::{
    Body, ContactEdges, DampingTime, EndOfContact, Geometry, LinearSpringDashpot, Material, NamedShape, NormalLaw, Pair, Scene,
    SphereGeometry, Step,
};
use solver::{Simulation, Vector};

use crate::case::{Case, Description, Failure, Knob, Measurement, Quantity, Setup, Tier, setups};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::linear_contact::{LinearContact, restitution_of_leapfrog};
use crate::study::add_work;

/// The case.
pub struct NormalContact;

const STIFFNESS: f64 = 1e5;
const DENSITY: f64 = 2500.0;
const RADII: [f64; 2] = [0.003, 0.005];
const IMPACT_VELOCITY: f64 = 1.0;
const PHASES: usize = 200;
const RESTITUTION: &str = "restitution";
const DURATION: &str = "duration x frequency";
const OVERLAP: &str = "largest overlap x frequency / impact velocity";
const RESTITUTIONS: [f64; 4] = [0.5, 0.85, 0.9, 1.0];
const ENDS: [EndOfContact; 2] = [EndOfContact::ZeroOverlap, EndOfContact::NoAttraction];
/// Low-discrepancy steps in two dimensions: start phase, and part of a step by which the contact is longer than a whole number.
const PHASE_STRIDES: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// How a scheme weighs a contact in time.
#[derive(Clone, Copy, PartialEq)]
enum Scheme {
    Lagged,
    Centred,
    Resolved,
}

/// One setup.
#[derive(Clone, Copy, PartialEq)]
struct Variant {
    restitution: f64,
    end: EndOfContact,
    scheme: Scheme,
    /// Contacts last exactly a whole number of steps: a flattering special case.
    whole_steps: bool,
}

impl Variant {
    fn all() -> Vec<Variant> {
        let mut variants = Vec::new();
        for end in ENDS {
            for restitution in RESTITUTIONS {
                for scheme in [Scheme::Lagged, Scheme::Centred, Scheme::Resolved] {
                    variants.push(Variant { restitution, end, scheme, whole_steps: false });
                }
            }
        }
        let flattering = Variant { restitution: 0.85, end: ENDS[0], scheme: Scheme::Centred, whole_steps: true };
        variants.push(flattering);
        variants
    }

    fn label(&self) -> String {
        let end = match self.end {
            EndOfContact::ZeroOverlap => "until zero overlap",
            EndOfContact::NoAttraction => "no attraction",
        };
        let scheme = match self.scheme {
            Scheme::Lagged => "lagged damping, sampled edges",
            Scheme::Centred => "centred damping, sampled edges",
            Scheme::Resolved => "centred damping, resolved edges",
        };
        let whole = if self.whole_steps { ", whole steps only" } else { "" };
        format!("e={}, {end}, {scheme}{whole}", self.restitution)
    }

    fn exact(&self) -> LinearContact {
        match self.end {
            EndOfContact::ZeroOverlap => LinearContact::until_zero_overlap(self.restitution),
            EndOfContact::NoAttraction => LinearContact::without_attraction(self.restitution),
        }
    }

    /// Step and initial gap, in s and m, that make contacts last about `steps` steps and begin at a phase of a step.
    fn step_and_gap(&self, exact: &LinearContact, steps: f64, sample: usize, random_seed: u64) -> (f64, f64) {
        let phase = |dimension: usize| {
            let shift = (random_seed as f64 * PHASE_STRIDES[1 - dimension]).fract();
            (shift + (sample + 1) as f64 * PHASE_STRIDES[dimension]).fract()
        };
        let excess = if self.whole_steps { 0.0 } else { phase(1) - 0.5 };
        let step = exact.force_duration / frequency() / (steps + excess);
        (step, (1.0 + phase(0)) * step * IMPACT_VELOCITY)
    }

    fn scene(&self, step: f64, gap: f64) -> Scene {
        let mut scene = Scene::empty("normal contact", 10.0 * PI / frequency());
        scene.materials = vec![Material { name: "glass".into(), density: Some(DENSITY) }];
        let normal = NormalLaw::LinearSpringDashpot(LinearSpringDashpot {
            stiffness: STIFFNESS,
            restitution: self.restitution,
            end_of_contact: self.end,
        });
        scene.pairs = vec![Pair { materials: ["glass".into(), "glass".into()], normal, tangential: None, rolling: None }];
        let shape = |radius: f64| NamedShape { name: format!("{radius} m"), geometry: Geometry::Sphere(SphereGeometry { radius }) };
        scene.shapes = RADII.map(shape).to_vec();
        let distance = RADII[0] + RADII[1] + gap;
        let share = masses()[1] / (masses()[0] + masses()[1]);
        let body = |index: usize, along: f64, speed: f64| Body {
            position: (axis() * along).into(),
            velocity: (axis() * speed).into(),
            ..Body::new(&scene.shapes[index].name, "glass")
        };
        // The centre of mass is at rest at the origin.
        scene.bodies =
            vec![body(0, -share * distance, share * IMPACT_VELOCITY), body(1, (1.0 - share) * distance, -(1.0 - share) * IMPACT_VELOCITY)];
        scene.numerics.step = Step::Seconds(step);
        scene.numerics.damping = if self.scheme == Scheme::Lagged { DampingTime::Lagged } else { DampingTime::Centred };
        scene.numerics.contact_edges = if self.scheme == Scheme::Resolved { ContactEdges::Resolved } else { ContactEdges::Sampled };
        scene
    }

    /// Design error of the restitution of a scheme whose edges are exact, relative.
    fn design_error(&self, steps: f64) -> f64 {
        let exact = self.exact();
        let step = exact.force_duration / steps;
        let inside = (restitution_of_leapfrog(exact.damping_ratio, step)
            / (-PI * exact.damping_ratio / (1.0 - exact.damping_ratio.powi(2)).sqrt()).exp()
            - 1.0)
            .abs();
        // Without damping the inside is exact, and the edges leave the first term their straight lines neglect.
        inside.max(step.powi(4) / 120.0)
    }
}

fn masses() -> [f64; 2] {
    RADII.map(|radius| DENSITY * 4.0 / 3.0 * PI * radius.powi(3))
}

fn reduced_mass() -> f64 {
    let [one, other] = masses();
    one * other / (one + other)
}

/// Undamped angular frequency of the contact in rad/s.
fn frequency() -> f64 {
    (STIFFNESS / reduced_mass()).sqrt()
}

/// Oblique, so that no coordinate is special.
fn axis() -> Vector {
    Vector::new(2.0, 3.0, 6.0) / 7.0
}

/// What one collision gave.
struct Collision {
    restitution: f64,
    duration: f64,
    largest_overlap: f64,
}

fn overlap(simulation: &Simulation) -> f64 {
    let bodies = simulation.bodies();
    RADII[0] + RADII[1] - (bodies.position(1) - bodies.position(0)).norm()
}

fn collide(mut simulation: Simulation, gap: f64) -> Result<(Collision, Simulation), Failure> {
    let last = simulation.steps_to(simulation.scene().scene.end_time);
    let mut overlaps = [f64::NEG_INFINITY; 3];
    let mut largest = f64::NEG_INFINITY;
    let mut has_touched = false;
    while simulation.steps_taken() < last {
        simulation.step();
        overlaps = [overlaps[1], overlaps[2], overlap(&simulation)];
        if overlaps[1] >= overlaps[0] && overlaps[1] >= overlaps[2] {
            largest = vertex(overlaps);
        }
        has_touched |= overlaps[2] > 0.0;
        // One step outside tells the straight line that the balls leave on.
        if has_touched && overlaps[1] <= 0.0 && overlaps[2] < overlaps[1] {
            simulation.check_guards()?;
            let rebound = (overlaps[1] - overlaps[2]) / simulation.time_step();
            let separation = simulation.time() + overlaps[2] / rebound;
            let velocities = [0, 1].map(|index| simulation.bodies().half_step_velocity(index));
            let restitution = (velocities[1] - velocities[0]).dot(&axis()) / IMPACT_VELOCITY;
            let duration = separation - gap / IMPACT_VELOCITY;
            return Ok((Collision { restitution, duration, largest_overlap: largest }, simulation));
        }
    }
    Err(Failure::NothingMeasured("the balls had not parted after ten times the duration of an undamped contact".into()))
}

/// Height of the parabola through three equidistant points.
fn vertex([left, middle, right]: [f64; 3]) -> f64 {
    let curvature = left - 2.0 * middle + right;
    if curvature == 0.0 { middle } else { middle - (right - left).powi(2) / (8.0 * curvature) }
}

impl Case for NormalContact {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let variant = Variant::all()[setup.index];
        let exact = variant.exact();
        let mut measurement = Measurement { runs: PHASES as u64, ..Measurement::default() };
        let mut samples = [Vec::new(), Vec::new(), Vec::new()];
        for sample in 0..PHASES {
            let (step, gap) = variant.step_and_gap(&exact, knob, sample, random_seed);
            let (collision, simulation) = collide(variant.scene(step, gap).build()?, gap)?;
            samples[0].push(collision.restitution);
            samples[1].push(collision.duration * frequency());
            samples[2].push(collision.largest_overlap * frequency() / IMPACT_VELOCITY);
            add_work(&mut measurement.work, simulation.ledger().total_work());
        }
        let source = match variant.end {
            EndOfContact::ZeroOverlap => "R eq. 3.23-3.27",
            EndOfContact::NoAttraction => "Schwager and Poeschel 2007",
        };
        // Overlap is the difference of lengths of 8 mm, known to their rounding; a rate taken over a contact knows it no better.
        let floor = 4.0 * f64::EPSILON * (RADII[0] + RADII[1]) * frequency() / IMPACT_VELOCITY * knob.sqrt();
        let reference = Reference { kind: ReferenceKind::Exact, uncertainty: 4.0 * f64::EPSILON, source: source.into() };
        let [restitution, duration, largest_overlap] = samples;
        measurement.quantities = [
            (RESTITUTION, restitution, exact.restitution),
            (DURATION, duration, exact.duration),
            (OVERLAP, largest_overlap, exact.largest_overlap),
        ]
        .into_iter()
        .map(|(name, samples, expected)| Quantity {
            name,
            unit: "1",
            samples,
            expected,
            reference: reference.clone(),
            error_kind: ErrorKind::Relative,
            floor,
        })
        .collect();
        Ok(measurement)
    }

    fn claims(&self, _tier: Tier) -> Vec<Claim> {
        Variant::all().iter().flat_map(claims_of).collect()
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        let variant = *Variant::all().get(setup.index)?;
        let (step, gap) = variant.step_and_gap(&variant.exact(), knob, 0, 0);
        Some(variant.scene(step, gap))
    }

    fn description(&self) -> Description {
        let label = |restitution, end, scheme| Variant { restitution, end, scheme, whole_steps: false }.label();
        let three =
            |restitution, end| [Scheme::Lagged, Scheme::Centred, Scheme::Resolved].map(|scheme| label(restitution, end, scheme)).to_vec();
        let resolved = |end| RESTITUTIONS.map(|restitution| label(restitution, end, Scheme::Resolved)).to_vec();
        Description {
            id: "normal_contact",
            title: "Head-on contact of two spheres",
            question: "Does a collision give back the restitution, duration and overlap that its contact law promises, whenever within a time step it begins?",
            model: vec![
                "Two glass spheres of 3 and 5 mm radius meet head-on at 1 m/s without gravity or friction. A linear spring and a dashpot in parallel push them apart; the dashpot is calibrated for the restitution e.",
                "A contact ends either when the overlap is zero, although the dashpot then pulls (the rule of source R), or when the total force is zero (no attraction). The two rules need different dashpots for the same e and are calibrated each by its own closed form.",
                "Each point is 200 collisions that begin at different phases of a step and last a number of steps that is not whole. Median and worst are shown: a single run gives an arbitrary number.",
            ],
            equations: vec![
                Equation {
                    latex: r"m_\mathrm{eff}\,\ddot\delta + 2\zeta\sqrt{k\,m_\mathrm{eff}}\;\dot\delta + k\,\delta = 0,\qquad \delta(0)=0,\quad \dot\delta(0)=v_0".into(),
                    meaning: "Overlap during contact (R eq. 3.22; S eq. 3.35 with the sign of the errata list).".into(),
                },
                Equation {
                    latex: r"\zeta = \frac{-\ln e}{\sqrt{\pi^2+\ln^2 e}}".into(),
                    meaning: "Damping ratio if the contact ends at zero overlap (R eq. 3.27, S eq. 3.40).".into(),
                },
                Equation {
                    latex: r"e = \exp\!\left(-\frac{2\zeta\arccos\zeta}{\sqrt{1-\zeta^2}}\right)".into(),
                    meaning: "Restitution if it ends at zero force: the three branches of Schwager and Poeschel in one.".into(),
                },
            ],
            parameters: parameters(),
            reference: "Closed form of the model that is coded, for each rule; uncertainty 4 units in the last place. The grey band is the rounding of an overlap of 0.1 mm computed from positions of 8 mm.",
            picture: picture(),
            plots: vec![
                convergence("Restitution, e = 0.85, contact until zero overlap", three(0.85, ENDS[0]), vec![1.0, 2.0]),
                convergence("Restitution, e = 0.85, no attraction", three(0.85, ENDS[1]), vec![1.0, 2.0]),
                convergence("Restitution, e = 1: no damping", three(1.0, ENDS[0]), vec![2.0, 4.0]),
                convergence("Restitution of the default scheme, all e, until zero overlap", resolved(ENDS[0]), vec![2.0, 4.0]),
                Plot::ErrorAgainstCost {
                    title: "Error of the restitution against run time, e = 0.85, until zero overlap".into(),
                    quantity: RESTITUTION.into(),
                    setups: three(0.85, ENDS[0]),
                    statistic: "median".into(),
                    targets: vec![0.1, 0.01, 0.001],
                },
            ],
            headline: Headline {
                setup: label(0.85, ENDS[0], Scheme::Resolved),
                quantity: RESTITUTION.into(),
                statistic: "median".into(),
                knob: 50.0,
                order_quantity: Some("observed order of restitution".into()),
            },
            sources: vec![
                "R (Rakotonirina 2016), section 2.6, eq. 3.17-3.27",
                "S (Srinivasan 2019), section 3.2, eq. 3.35-3.40",
                "T. Schwager and T. Poeschel, Coefficient of restitution and linear-dashpot model revisited, Granular Matter 9 (2007) 465",
            ],
            answers: vec![
                "Which time step? The error at any number of steps per contact is on the first plot.",
                "Stability test S01 (step over contact time) and S03 (ends of restitution) in part.",
                "The end of a contact is a choice that changes the restitution: it is named in every row.",
            ],
            remarks: vec![
                "Damping centred in time alone is not enough: with sampled edges the error is of first order, because the dashpot force jumps at the first and last touch and a whole step of it more or less is applied. It looks like second order only if contacts last a whole number of steps (last setup), because the two errors then cancel.",
                "Without damping the restitution and the overlap are of fourth order with resolved edges: the inside of a linear contact is then exact, and what is left are the straight lines before and after it.",
            ],
            knob: Knob { name: |_| "steps_per_contact", values: |_, _| vec![5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 400.0] },
            setups: setups(Variant::all().iter().map(Variant::label)),
            sample: "start phase",
            budget_cpu_s: [5.0, 60.0, 60.0],
        }
    }
}

fn claims_of(variant: &Variant) -> Vec<Claim> {
    let restitution = |statistic, subject, bound, expected| claim(variant, RESTITUTION, statistic, subject, bound, expected);
    let damped = variant.restitution < 1.0;
    let second_order = |expected| {
        restitution(Statistic::Median, Subject::OrderAtLeast { order: 2.0, range: [20.0, 400.0] }, order_bound(20.0, 2.0), expected)
    };
    match variant.scheme {
        Scheme::Resolved => claims_of_default(variant, damped),
        Scheme::Centred if variant.whole_steps || !damped => vec![second_order(Expected::Holds)],
        Scheme::Centred => {
            let reason = "a whole step of dashpot force more or less at either edge: first order unless contacts last whole steps";
            vec![second_order(Expected::KnownLimit(reason.into()))]
        }
        Scheme::Lagged if damped => {
            let subject = Subject::OrderAbout { order: 1.0, range: [20.0, 400.0] };
            vec![restitution(Statistic::Median, subject, order_bound(20.0, 4.0), Expected::Holds)]
        }
        Scheme::Lagged => vec![second_order(Expected::Holds)],
    }
}

/// The default scheme: errors at 20 and 50 steps, and orders, of all three quantities, median and worst.
fn claims_of_default(variant: &Variant, damped: bool) -> Vec<Claim> {
    let mut claims = Vec::new();
    let mut error = |quantity, steps: f64, statistic, factor, floor, floor_is: &str| {
        let bound = Bound::new(factor, floor, floor_is);
        claims.push(claim(variant, quantity, statistic, Subject::ErrorAt(steps), bound, Expected::Holds));
    };
    let recursion = "the error of the scheme's own recursion inside the contact";
    error(RESTITUTION, 20.0, Statistic::Median, 4.0, variant.design_error(20.0), recursion);
    error(RESTITUTION, 50.0, Statistic::Median, 4.0, variant.design_error(50.0), recursion);
    error(RESTITUTION, 50.0, Statistic::Worst, 10.0, variant.design_error(50.0), recursion);
    let angle = variant.exact().force_duration / 50.0;
    let frequency = angle * angle / 24.0;
    error(DURATION, 50.0, Statistic::Median, 4.0, frequency, "the error of leapfrog's frequency, (angle in a step)^2 / 24");
    let overlap = if damped { frequency } else { variant.design_error(50.0) };
    error(OVERLAP, 50.0, Statistic::Median, 4.0, overlap, "the first term of the angle in a step that the scheme neglects");
    let order_of_energy = if damped { 2.0 } else { 4.0 };
    // The fourth-order errors reach round-off beyond 200 steps.
    let range = if damped { [20.0, 400.0] } else { [10.0, 200.0] };
    for (quantity, statistic, order) in [
        (RESTITUTION, Statistic::Median, order_of_energy),
        (RESTITUTION, Statistic::Worst, order_of_energy),
        (DURATION, Statistic::Median, 2.0),
        (OVERLAP, Statistic::Median, order_of_energy),
    ] {
        let subject = Subject::OrderAtLeast { order, range };
        claims.push(claim(variant, quantity, statistic, subject, order_bound(range[0], 2.0), Expected::Holds));
    }
    claims
}

fn claim(variant: &Variant, quantity: &'static str, statistic: Statistic, subject: Subject, bound: Bound, expected: Expected) -> Claim {
    Claim { setup: variant.label(), quantity, statistic, subject, bound, expected }
}

/// What a fitted order may fall short by: the next term of the error at the coarsest point of the fit.
fn order_bound(coarsest: f64, factor: f64) -> Bound {
    Bound::new(factor, 1.0 / coarsest, format!("the next term of the error at {coarsest} steps, the coarsest of the fit"))
}

fn convergence(title: &str, setups: Vec<String>, orders: Vec<f64>) -> Plot {
    Plot::Convergence {
        title: title.into(),
        quantity: RESTITUTION.into(),
        setups,
        statistics: vec!["median".into(), "worst".into()],
        orders,
        knob_is_resolution: true,
        knob_label: "steps per contact".into(),
    }
}

fn parameters() -> Vec<Parameter> {
    let parameter = |name: &str, value: String, remark: &str| Parameter { name: name.into(), value, remark: remark.into() };
    vec![
        parameter("radii", "3 mm and 5 mm".into(), "unequal, so that the reduced mass is not half of either"),
        parameter("density", "2500 kg/m³".into(), ""),
        parameter("stiffness", "10⁵ N/m".into(), "largest overlap about 1.6 % of the smaller radius"),
        parameter("impact velocity", "1 m/s".into(), "along (2, 3, 6)/7: no axis is special"),
        parameter("undamped duration", format!("{:.4e} s", PI / frequency()), "π √(m_eff / k)"),
        parameter("samples", "200 collisions a point".into(), "start phase and excess over whole steps from a low-discrepancy sequence"),
    ]
}

fn picture() -> Picture {
    let label = |at: [f64; 2], text: &str| PictureItem::Label { at, text: text.into() };
    let arrow = |from: [f64; 2], to: [f64; 2]| PictureItem::Arrow { from, to, label: "v".into() };
    Picture {
        caption: "Two spheres of 3 and 5 mm radius on a collision course along the line through their centres.".into(),
        items: vec![
            PictureItem::Dashed { from: [-9.5, 0.0], to: [13.0, 0.0] },
            PictureItem::Disc { center: [-4.2, 0.0], radius: 3.0, ghost: false },
            PictureItem::Disc { center: [5.0, 0.0], radius: 5.0, ghost: false },
            arrow([-4.2, 0.0], [-1.6, 0.0]),
            arrow([5.0, 0.0], [3.2, 0.0]),
            label([-4.2, -4.2], "3 mm"),
            label([5.0, -6.2], "5 mm"),
        ],
    }
}
