//! Two ellipsoids meet, or one meets a wall: do energy and velocities come out as the restitution says (S figures 4-1 to 4-6)?

mod page;
mod setting;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::{Scene, Vector};

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::variant::Variant as _;
use setting::{Contact, MASS, SPEED, STIFFNESS, Scenario, Setting, rigid_impact};

/// The case.
pub struct EnergyTwoEllipsoids;

const ENERGY: &str = "kinetic energy / energy before";
const VELOCITY: &str = "velocity after / U_ref";
const DEVIATION: &str = "velocity beside that of a rigid impact / speed";

/// What is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sweep {
    Steps,
    Vertices,
    Stiffness,
}

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Variant {
    scenario: Scenario,
    contact: Contact,
    restitution: f64,
    sweep: Sweep,
}

/// All setups, in the order of pages.
fn variants() -> Vec<Variant> {
    use Contact::{EventDriven, Smooth, TimeDriven, Vertices};
    let mut all = Vec::new();
    for restitution in [0.4, 1.0] {
        let of = |scenario, contact, sweep| Variant { scenario, contact, restitution, sweep };
        for scenario in [Scenario::HeadOn, Scenario::Wall] {
            all.push(of(scenario, EventDriven, Sweep::Steps));
            all.push(of(scenario, TimeDriven, Sweep::Steps));
            all.push(of(scenario, Smooth, Sweep::Steps));
            all.push(of(scenario, Vertices, Sweep::Vertices));
        }
        all.push(of(Scenario::Turned, EventDriven, Sweep::Steps));
        all.push(of(Scenario::Turned, Smooth, Sweep::Stiffness));
    }
    let elastic = |contact, sweep| Variant { scenario: Scenario::Turned, contact, restitution: 1.0, sweep };
    all.push(elastic(Smooth, Sweep::Steps));
    all.push(elastic(Vertices, Sweep::Vertices));
    all
}

/// Start phases of soft runs; hard ones have four.
const PHASES: usize = 200;
/// Steps in a contact where something else is varied.
const FINE: f64 = 100.0;

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        variants()
    }

    fn label(&self) -> String {
        let scenario = match self.scenario {
            Scenario::HeadOn => "head-on",
            Scenario::Wall => "at a wall",
            Scenario::Turned => "turned",
        };
        let contact = match self.contact {
            Contact::EventDriven => "hard, event-driven",
            Contact::TimeDriven => "hard, time-driven (source)",
            Contact::Smooth if self.sweep == Sweep::Stiffness => "soft, stiffer and stiffer",
            Contact::Smooth => "soft, smooth surfaces",
            Contact::Vertices => "soft, vertices (source)",
        };
        format!("{scenario}, e={}, {contact}", self.restitution)
    }

    fn knob_name(&self) -> &'static str {
        match self.sweep {
            Sweep::Vertices => "vertices",
            Sweep::Stiffness => "stiffness_N_per_m",
            Sweep::Steps if self.is_hard() => "steps_before_meeting",
            Sweep::Steps => "steps_per_contact",
        }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match self.sweep {
            Sweep::Steps if self.is_hard() => vec![25.0, 50.0, 100.0],
            Sweep::Steps => vec![20.0, 50.0, 100.0, 200.0],
            Sweep::Vertices if tier == Tier::Quick => vec![100.0, 400.0, 1600.0],
            Sweep::Vertices => vec![100.0, 400.0, 900.0, 1600.0, 6400.0],
            Sweep::Stiffness => vec![1e5, 1e6, 1e7, 1e8],
        }
    }
}

impl Variant {
    fn is_hard(&self) -> bool {
        matches!(self.contact, Contact::EventDriven | Contact::TimeDriven)
    }

    fn setting(&self, knob: f64, phase: f64) -> Setting {
        let of = |sweep: Sweep, otherwise: f64| if self.sweep == sweep { knob } else { otherwise };
        Setting {
            scenario: self.scenario,
            contact: self.contact,
            restitution: self.restitution,
            // No contact of the sweeps lasts a whole number of steps.
            steps: of(Sweep::Steps, FINE) + if self.is_hard() { 0.0 } else { 0.618 },
            vertices: of(Sweep::Vertices, 400.0).sqrt() as u32,
            stiffness: of(Sweep::Stiffness, STIFFNESS),
            phase,
        }
    }

    /// Two runs of every kind of hundreds of vertices would take all the time that a test has.
    fn phases(&self) -> usize {
        match self.contact {
            Contact::EventDriven | Contact::TimeDriven => 4,
            Contact::Smooth if self.sweep == Sweep::Stiffness => 4,
            Contact::Vertices => 20,
            Contact::Smooth => PHASES,
        }
    }
}

/// Velocity of the first body in m/s and kinetic energy in J after a run.
fn run(setting: &Setting) -> Result<(Vector, f64), Failure> {
    let mut simulation = setting.scene().build()?;
    simulation.run_until(setting.end_time())?;
    let now = simulation.now();
    Ok((now.velocity(0), now.kinetic_energy()))
}

impl Case for EnergyTwoEllipsoids {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let variant = &Variant::of(setup)?;
        let count = variant.phases();
        let runs = (0..count).map(|phase| run(&variant.setting(knob, (phase as f64 + 0.5) / count as f64)));
        let runs = runs.collect::<Result<Vec<_>, Failure>>()?;
        let bodies = if variant.scenario == Scenario::Wall { 1.0 } else { 2.0 };
        let before = 0.5 * bodies * MASS * SPEED * SPEED;
        let quantity = |name, samples, expected, kind, source: &str| Quantity {
            name,
            unit: "1",
            samples,
            expected,
            reference: Reference { kind, uncertainty: 0.0, source: source.into() },
            error_kind: ErrorKind::Absolute,
            floor: rounding(variant),
        };
        let energies = runs.iter().map(|(_, energy)| energy / before).collect();
        let (rigid_velocity, rigid_energy) = rigid_impact(variant.restitution);
        let law = "the definition of restitution";
        let quantities = if variant.scenario == Scenario::Turned {
            let deviations = runs.iter().map(|(velocity, _)| (velocity - rigid_velocity).norm() / SPEED).collect();
            let source = "rigid impulse at the touching pose found by bisection";
            vec![
                quantity(ENERGY, energies, rigid_energy / before, ReferenceKind::Computed, source),
                quantity(DEVIATION, deviations, 0.0, ReferenceKind::Computed, source),
            ]
        } else {
            // The first body flies to the right, towards its partner, or to the left, towards the wall.
            let away = if variant.scenario == Scenario::Wall { 1.0 } else { -1.0 };
            let velocities = runs.iter().map(|(velocity, _)| away * velocity.x).collect();
            let square = variant.restitution * variant.restitution;
            vec![
                quantity(ENERGY, energies, square, ReferenceKind::Exact, law),
                quantity(VELOCITY, velocities, SPEED * variant.restitution, ReferenceKind::Exact, law),
            ]
        };
        Ok(Measurement { quantities, runs: count as u64, ..Measurement::default() })
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        Variant::all().iter().flat_map(|variant| claims_of(variant, tier)).collect()
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        Some(Variant::of(setup).ok()?.setting(knob, 0.5).scene())
    }

    fn description(&self) -> Description {
        page::description()
    }
}

/// Rounding of a velocity after a free flight of so many steps, and of the pose that the rigid impact is told for.
fn rounding(variant: &Variant) -> f64 {
    if variant.scenario == Scenario::Turned { 1e-11 } else { 64.0 * f64::EPSILON }
}

/// Error that a step of a contact leaves of a velocity: the square of its angle over 24.
fn design_error(steps: f64) -> f64 {
    (std::f64::consts::PI / steps).powi(2) / 24.0
}

fn claims_of(variant: &Variant, tier: Tier) -> Vec<Claim> {
    let claim = |quantity, statistic, subject, bound| Claim {
        setup: variant.label(),
        quantity,
        statistic,
        subject,
        bound,
        expected: Expected::Holds,
    };
    let knobs = variant.knobs(tier);
    let is_turned = variant.scenario == Scenario::Turned;
    match (variant.contact, variant.sweep) {
        (Contact::EventDriven | Contact::TimeDriven, _) => knobs
            .iter()
            .map(|knob| {
                let of_pose = "rounding of the pose in which the bodies touch";
                let bound =
                    if is_turned { Bound::new(10.0, rounding(variant), of_pose) } else { Bound::new(10.0, rounding(variant), "rounding") };
                let flies_through = variant.contact == Contact::TimeDriven && *knob < 100.0 && variant.restitution < 1.0;
                let expected = if flies_through && variant.scenario == Scenario::HeadOn {
                    Expected::KnownLimit("in a step the bodies fly through each other: the collision is seen too late or not at all".into())
                } else {
                    Expected::Holds
                };
                Claim { expected, ..claim(ENERGY, Statistic::Worst, Subject::ErrorAt(*knob), bound) }
            })
            .collect(),
        (Contact::Smooth, Sweep::Steps) => {
            let words = "(pi / steps per contact)^2 / 24";
            knobs
                .iter()
                .filter(|knob| **knob >= 50.0)
                .flat_map(|knob| {
                    let at = Subject::ErrorAt(*knob);
                    let bound = |factor| Bound::new(factor, design_error(*knob), words);
                    [claim(ENERGY, Statistic::Median, at, bound(1.0)), claim(ENERGY, Statistic::Worst, at, bound(4.0))]
                })
                .collect()
        }
        (Contact::Smooth, Sweep::Stiffness) => {
            let subject = Subject::OrderAbout { order: 0.5, range: [knobs[0], knobs[knobs.len() - 1]] };
            let next =
                Bound::new(4.0, (STIFFNESS / 1e5).sqrt() * 0.01, "the overlap over the length at the softest: the next term of the error");
            vec![claim(DEVIATION, Statistic::Median, subject, next)]
        }
        (Contact::Vertices, _) if is_turned && variant.restitution == 1.0 => {
            let bound = Bound::new(10.0, design_error(FINE), "what smooth surfaces leave at this step");
            let reason =
                "the overlap, place and normal that vertices tell jump as vertices come and go: such a force has no energy of its own";
            let expected = || Expected::KnownLimit(reason.into());
            knobs
                .iter()
                .filter(|knob| **knob <= 400.0)
                .map(|knob| Claim { expected: expected(), ..claim(ENERGY, Statistic::Median, Subject::ErrorAt(*knob), bound.clone()) })
                .collect()
        }
        (Contact::Vertices, _) | (Contact::Smooth, Sweep::Vertices) => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent of the setting: momentum along the line of centres and energy of an elastic impact.
    #[test]
    fn the_rigid_impact_keeps_energy_and_sends_bodies_apart() {
        let (velocity, energy) = rigid_impact(1.0);
        assert!((energy / (MASS * SPEED * SPEED) - 1.0).abs() < 1e-13, "{energy}");
        assert!(velocity.x < 0.5 * SPEED && velocity.yz().norm() > 0.01 * SPEED, "{velocity}");
        let (_, lost) = rigid_impact(0.4);
        assert!(lost < energy);
    }

    #[test]
    fn labels_are_unique() {
        let labels: std::collections::BTreeSet<String> = variants().iter().map(Variant::label).collect();
        assert_eq!(labels.len(), variants().len());
    }
}
