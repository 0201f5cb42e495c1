//! Fifty cylinders collide in a closed box without loss: does their energy stay, hard or soft, and what does each way cost?

mod setting;
mod words;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::scene::FrictionClamp;
use solver::{Scene, Simulation, Vector};

use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::study::add_work;
use setting::{CLUSTER_TIME, Contact, PASSAGE, RADIUS, closed_box, cluster, contact_duration, slipping_balls};

/// The case.
pub struct EnergyFiftyCylinders;

const KINETIC: &str = "change of the kinetic energy";
const TOTAL: &str = "largest change of kinetic and spring energy together";
const KINETIC_ALONE: &str = "largest change of the kinetic energy alone";
const RISE: &str = "largest rise of the kinetic energy";
const PLACES: &str = "place of a cylinder after two passages / radius";
const LOST: &str = "collisions that are not seen, as a part of all";
const MOMENTUM: &str = "change of momentum";
const TURNING: &str = "change of angular momentum";
const SLIP: &str = "slip after the collision";

const HARD_CURVE: &str = "energy_of_hard_cylinders.csv";
const SOFT_CURVE: &str = "energy_of_soft_cylinders.csv";

/// Random starts of each measurement.
const STARTS: u64 = 3;
/// Time in s of a soft run.
const SOFT_TIME: f64 = 0.25 * PASSAGE;
/// Time in s between two looks at event-driven cylinders: some four collisions.
const LEAP: f64 = 0.125 * PASSAGE;
/// Points on an energy curve, and looks at a run whose largest change is wanted.
const LOOKS: u64 = 400;

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Variant {
    Events,
    Steps,
    Springs,
    Rough,
    FreeEvents,
    FreeSprings,
    Friction(FrictionClamp),
}

const VARIANTS: [(Variant, &str); 9] = [
    (Variant::Events, "hard, event-driven"),
    (Variant::Steps, "hard, time-driven as S"),
    (Variant::Springs, "soft, springs without dashpot"),
    (Variant::Rough, "hard, event-driven, restitution 0.9 and friction 0.3"),
    (Variant::FreeEvents, "cluster in free space, hard"),
    (Variant::FreeSprings, "cluster in free space, soft"),
    (Variant::Friction(FrictionClamp::Stick), "two balls with friction"),
    (Variant::Friction(FrictionClamp::None), "two balls with friction, no limit by sticking (S eq. 3.32 as implemented)"),
    (Variant::Friction(FrictionClamp::NoneSignAsPrinted), "two balls with friction, signs of S eq. 3.33 as printed"),
];

impl Variant {
    fn knob(self) -> &'static str {
        match self {
            Variant::Events | Variant::Rough => "collisions",
            Variant::Steps => "steps_per_passage",
            Variant::Springs | Variant::FreeSprings => "steps_per_contact",
            Variant::FreeEvents => "steps_per_passage",
            Variant::Friction(_) => "slip",
        }
    }

    fn knobs(self, tier: Tier) -> Vec<f64> {
        let with = |quick: &[f64], more: &[f64]| match tier {
            Tier::Quick => quick.to_vec(),
            Tier::Standard | Tier::Paper => [quick, more].concat(),
        };
        match self {
            Variant::Events => with(&[100.0, 1000.0, 5000.0], &[100_000.0]),
            Variant::Rough => vec![100.0, 300.0],
            Variant::Steps => with(&[25.0, 50.0, 100.0, 200.0, 400.0], &[800.0, 1600.0]),
            Variant::Springs => with(&[12.5, 25.0, 50.0], &[100.0, 200.0]),
            Variant::FreeEvents | Variant::FreeSprings => vec![20.0],
            Variant::Friction(_) => vec![SMALL_SLIP, LARGE_SLIP],
        }
    }

    fn scene(self, knob: f64, random_seed: u64) -> Scene {
        match self {
            Variant::Events => closed_box(Contact::EventDriven, LEAP, 1e3, random_seed),
            Variant::Rough => closed_box(Contact::Rough, LEAP, 1e3, random_seed),
            Variant::Steps => closed_box(Contact::TimeDriven, PASSAGE / knob, 2.0 * PASSAGE, random_seed),
            Variant::Springs => closed_box(Contact::Soft, contact_duration() / knob, SOFT_TIME, random_seed),
            Variant::FreeEvents => cluster(Contact::EventDriven, PASSAGE / knob, random_seed),
            Variant::FreeSprings => cluster(Contact::Soft, contact_duration() / knob, random_seed),
            Variant::Friction(clamp) => slipping_balls(knob, friction_at(knob), clamp),
        }
    }
}

/// Slips in m/s of the two collisions of the errata.
const SMALL_SLIP: f64 = 0.1;
const LARGE_SLIP: f64 = 1.6;

/// Friction of the two collisions of the errata.
fn friction_at(slip: f64) -> f64 {
    if slip == SMALL_SLIP { 0.5 } else { 0.2 }
}

fn collisions(simulation: &Simulation) -> u64 {
    simulation.ledger().total_work().get("collisions").copied().unwrap_or(0)
}

/// What all random starts of a setup give together.
#[derive(Default)]
struct Gathered {
    measurement: Measurement,
}

impl Gathered {
    fn ran(&mut self, simulation: &Simulation) {
        add_work(&mut self.measurement.work, simulation.ledger().total_work());
        self.measurement.runs += 1;
    }

    fn add(&mut self, name: &'static str, unit: &'static str, values: impl IntoIterator<Item = f64>, floor: f64) {
        if let Some(known) = self.measurement.quantities.iter_mut().find(|quantity| quantity.name == name) {
            known.samples.extend(values);
            return;
        }
        let (kind, source) = match name {
            PLACES | LOST => (ReferenceKind::Computed, "event-driven run of the same start"),
            _ => (ReferenceKind::Exact, "conservation of energy and momentum; Coulomb's law"),
        };
        self.measurement.quantities.push(Quantity {
            name,
            unit,
            samples: values.into_iter().collect(),
            expected: 0.0,
            reference: Reference { kind, uncertainty: 1e-15, source: source.into() },
            error_kind: ErrorKind::Absolute,
            floor,
        });
    }
}

/// Rounding of an energy after many collisions: each rounds it once, at random.
fn rounding(collisions: f64) -> f64 {
    f64::EPSILON * collisions.sqrt()
}

/// Event-driven until so many collisions.
fn until_collisions(variant: Variant, knob: f64, random_seed: u64, gathered: &mut Gathered) -> Result<(), Failure> {
    let mut simulation = variant.scene(knob, random_seed).build()?;
    let (start, mut last, mut rise) = (simulation.now().kinetic_energy(), f64::INFINITY, 0.0_f64);
    let mut curve = Vec::new();
    while (collisions(&simulation) as f64) < knob {
        simulation.run_until(simulation.time() + simulation.time_step())?;
        let energy = simulation.now().kinetic_energy();
        rise = rise.max(energy / last - 1.0);
        last = energy;
        curve.push(vec![collisions(&simulation) as f64, energy / start - 1.0]);
    }
    gathered.ran(&simulation);
    if variant == Variant::Rough {
        gathered.add(RISE, "1", [rise], rounding(1.0));
        return Ok(());
    }
    gathered.add(KINETIC, "1", [last / start - 1.0], rounding(knob));
    let every = curve.len().div_ceil(LOOKS as usize);
    gathered.measurement.curves = vec![Curve {
        file: HARD_CURVE.into(),
        columns: vec!["collisions", "relative_energy_change"],
        rows: curve.into_iter().step_by(every).collect(),
    }];
    Ok(())
}

fn places(simulation: &Simulation) -> Vec<Vector> {
    (0..simulation.bodies().len()).map(|index| simulation.bodies().position(index)).collect()
}

/// Time-driven, against the event-driven run of the same start.
fn in_steps(knob: f64, random_seed: u64, gathered: &mut Gathered) -> Result<(), Failure> {
    let end = 2.0 * PASSAGE;
    let mut exact = closed_box(Contact::EventDriven, end, end, random_seed).build()?;
    exact.run_until(end)?;
    let mut simulation = Variant::Steps.scene(knob, random_seed).build()?;
    let start = simulation.now().kinetic_energy();
    simulation.run_until(end)?;
    gathered.ran(&simulation);
    let change = simulation.now().kinetic_energy() / start - 1.0;
    gathered.add(KINETIC, "1", [change], rounding(knob));
    let errors: Vec<f64> = places(&simulation).iter().zip(places(&exact)).map(|(place, exact)| (place - exact).norm() / RADIUS).collect();
    gathered.add(PLACES, "1", errors, 1e-10);
    let (seen, all) = (collisions(&simulation) as f64, collisions(&exact) as f64);
    gathered.add(LOST, "1", [1.0 - seen / all], 1.0 / all.sqrt());
    Ok(())
}

/// Soft, looked at many times.
fn by_springs(knob: f64, random_seed: u64, gathered: &mut Gathered) -> Result<(), Failure> {
    let mut simulation = Variant::Springs.scene(knob, random_seed).build()?;
    let last = simulation.steps_to(SOFT_TIME);
    let start = simulation.now().total_energy();
    let (mut total_change, mut kinetic_change, mut curve) = (0.0_f64, 0.0_f64, Vec::new());
    for look in 1..=LOOKS {
        while simulation.steps_taken() < look * last / LOOKS {
            simulation.step();
        }
        let now = simulation.now();
        let (total, kinetic) = (now.total_energy() / start - 1.0, now.kinetic_energy() / start - 1.0);
        total_change = total_change.max(total.abs());
        kinetic_change = kinetic_change.max(kinetic.abs());
        curve.push(vec![now.time(), total, kinetic]);
    }
    simulation.check_guards()?;
    gathered.ran(&simulation);
    let floor = rounding(last as f64);
    gathered.add(TOTAL, "1", [total_change], floor);
    gathered.add(KINETIC_ALONE, "1", [kinetic_change], floor);
    gathered.measurement.curves =
        vec![Curve { file: SOFT_CURVE.into(), columns: vec!["time", "kinetic_and_spring", "kinetic_alone"], rows: curve }];
    Ok(())
}

/// Momentum and angular momentum of a cluster about the middle of its flight, as parts of the sums of their sizes.
fn in_free_space(variant: Variant, knob: f64, random_seed: u64, gathered: &mut Gathered) -> Result<(), Failure> {
    let mut simulation = variant.scene(knob, random_seed).build()?;
    let (momentum, turning) = (simulation.now().momentum(), simulation.now().angular_momentum());
    let sizes = sizes(&mut simulation);
    simulation.run_until(simulation.scene().scene.end_time)?;
    gathered.ran(&simulation);
    let floor = free_floor(variant, knob);
    gathered.add(MOMENTUM, "1", [(simulation.now().momentum() - momentum).norm() / sizes[0]], floor);
    gathered.add(TURNING, "1", [(simulation.now().angular_momentum() - turning).norm() / sizes[1]], floor);
    Ok(())
}

/// A place is rounded at every step, and in straight flight alike, so that half of the steps add up.
fn free_floor(variant: Variant, knob: f64) -> f64 {
    let step = if variant == Variant::FreeEvents { PASSAGE / knob } else { contact_duration() / knob };
    0.5 * f64::EPSILON * CLUSTER_TIME / step
}

/// Sums over all bodies of the sizes of momentum and angular momentum.
fn sizes(simulation: &mut Simulation) -> [f64; 2] {
    let now = simulation.now();
    let mut sizes = [0.0, 0.0];
    for index in 0..now.bodies().len() {
        let momentum = now.velocity(index) * now.bodies().mass(index);
        sizes[0] += momentum.norm();
        sizes[1] += now.position(index).norm() * momentum.norm() + now.spin_momentum(index).norm();
    }
    sizes
}

/// One collision of two balls.
fn with_friction(variant: Variant, knob: f64, gathered: &mut Gathered) -> Result<(), Failure> {
    let mut simulation = variant.scene(knob, 0).build()?;
    let start = simulation.now().kinetic_energy();
    simulation.run_until(1.0)?;
    gathered.ran(&simulation);
    let now = simulation.now();
    // Material points at the contact, one metre from either centre along x.
    let at = |index: usize, side: f64| now.velocity(index) + now.angular_velocity(index).cross(&(Vector::x() * side));
    let slip = (at(0, 1.0) - at(1, -1.0)).y;
    gathered.add(RISE, "1", [(now.kinetic_energy() / start - 1.0).max(0.0)], rounding(1.0));
    gathered.add(SLIP, "m/s", [slip], rounding(1.0));
    Ok(())
}

impl Case for EnergyFiftyCylinders {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let (variant, _) = VARIANTS[setup.index];
        let mut gathered = Gathered::default();
        if let Variant::Friction(_) = variant {
            with_friction(variant, knob, &mut gathered)?;
            return Ok(gathered.measurement);
        }
        for start in 0..STARTS {
            let random_seed = STARTS * random_seed + start;
            match variant {
                Variant::Events | Variant::Rough => until_collisions(variant, knob, random_seed, &mut gathered)?,
                Variant::Steps => in_steps(knob, random_seed, &mut gathered)?,
                Variant::Springs => by_springs(knob, random_seed, &mut gathered)?,
                _ => in_free_space(variant, knob, random_seed, &mut gathered)?,
            }
        }
        Ok(gathered.measurement)
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        VARIANTS.iter().flat_map(|(variant, label)| claims_of(*variant, label, tier)).collect()
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        VARIANTS.get(setup.index).map(|(variant, _)| variant.scene(knob, 0))
    }

    fn description(&self) -> Description {
        words::description()
    }
}

fn claims_of(variant: Variant, label: &str, tier: Tier) -> Vec<Claim> {
    let claim =
        |quantity, statistic, subject, bound, expected| Claim { setup: label.into(), quantity, statistic, subject, bound, expected };
    let worst_at = |quantity, knob, bound, expected| claim(quantity, Statistic::Worst, Subject::ErrorAt(knob), bound, expected);
    let knobs = variant.knobs(tier);
    match variant {
        Variant::Events => {
            let bound = |knob: f64| Bound::new(4.0, rounding(knob), "one rounding of the energy a collision, at random");
            knobs.iter().map(|knob| worst_at(KINETIC, *knob, bound(*knob), Expected::Holds)).collect()
        }
        Variant::Rough => {
            let bound = || Bound::new(8.0, rounding(1.0), "one rounding of the energy");
            knobs.iter().map(|knob| worst_at(RISE, *knob, bound(), Expected::Holds)).collect()
        }
        Variant::Steps => {
            let bound = |knob: f64| Bound::new(8.0, rounding(knob), "one rounding of the energy a step, at random");
            let mut claims: Vec<Claim> = knobs.iter().map(|knob| worst_at(KINETIC, *knob, bound(*knob), Expected::Holds)).collect();
            let range = [25.0, 400.0];
            let bound = Bound::new(1.0, 0.25, "scatter of collisions that fall into another order");
            claims.push(claim(PLACES, Statistic::Median, Subject::OrderAbout { order: 1.0, range }, bound, Expected::Holds));
            claims
        }
        Variant::Springs => {
            let angle = std::f64::consts::PI / 12.5;
            let bound = Bound::new(2.0, angle, "the phase of the spring in a step of the coarsest point of the fit");
            let order = Subject::OrderAtLeast { order: 2.0, range: [12.5, 50.0] };
            let reason =
                "what S plots: while cylinders touch, springs hold energy; no step, however small, makes the kinetic energy constant";
            let phase = std::f64::consts::PI / 50.0;
            let scheme =
                || Bound::new(1.0, phase * phase / 24.0, "(phase of the spring in a step)^2 / 24, by which a second-order scheme swings");
            vec![
                claim(TOTAL, Statistic::Median, order, bound, Expected::Holds),
                worst_at(TOTAL, 50.0, scheme(), Expected::Holds),
                worst_at(KINETIC_ALONE, 50.0, scheme(), Expected::KnownLimit(reason.into())),
            ]
        }
        Variant::FreeEvents | Variant::FreeSprings => {
            let bound =
                || Bound::new(2.0, free_floor(variant, knobs[0]), "rounding of places that every step of straight flight adds alike");
            [MOMENTUM, TURNING].map(|quantity| worst_at(quantity, knobs[0], bound(), Expected::Holds)).to_vec()
        }
        Variant::Friction(clamp) => friction_claims(clamp, &claim),
    }
}

/// What the errata say of S eq. 3.32-3.33.
fn friction_claims(clamp: FrictionClamp, claim: &dyn Fn(&'static str, Statistic, Subject, Bound, Expected) -> Claim) -> Vec<Claim> {
    let expected = |quantity, slip| match clamp {
        FrictionClamp::Stick => Expected::Holds,
        FrictionClamp::NoneSignAsPrinted => Expected::SourceError(
            "S eq. 3.25 and 3.33 push the slip on: it grows from 1.6 to 4.26 m/s and the energy from 1.64 to 2.56 J".into(),
        ),
        FrictionClamp::None if quantity == RISE && slip == LARGE_SLIP => Expected::Holds,
        FrictionClamp::None => {
            Expected::SourceError("S eq. 3.32 has no limit by sticking: a slip of 0.10 m/s becomes one of -6.55 and creates energy".into())
        }
    };
    let mut claims = Vec::new();
    for slip in [SMALL_SLIP, LARGE_SLIP] {
        for quantity in [RISE, SLIP] {
            let bound = Bound::new(8.0, rounding(1.0), "one rounding");
            claims.push(claim(quantity, Statistic::Single, Subject::ErrorAt(slip), bound, expected(quantity, slip)));
        }
    }
    claims
}
