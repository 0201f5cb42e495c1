//! A cylinder falls on a wall: do velocity and spin come out right at every tilt, whatever stands for the cylinder?

mod figures;
mod setting;
mod words;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::Scene;
use solver::scene::{ContactPoints, DampedMass, Sharing};

use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::study::add_work;
use setting::{APPROACH, After, LENGTH, MASS, RADIUS, RESTITUTION, Representation, STIFFNESS, Setting, SoftImpact, transverse_inertia};

/// The case.
pub struct CylinderWallImpact;

pub(super) const VELOCITY: &str = "velocity after";
pub(super) const SPIN: &str = "spin after x radius";
pub(super) const RESTITUTION_AT_POINT: &str = "restitution at the contact point";
pub(super) const DURATION: &str = "duration of contact";
const SAMPLES: usize = 200;
/// Steps in a contact where the step is not the knob.
const FINE: f64 = 250.0;

/// One setup: a setting and what is varied.
#[derive(Debug, Clone)]
struct Variant {
    label: String,
    setting: Setting,
    sweep: Sweep,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Sweep {
    /// Steps per contact, against the exact soft impact.
    Steps,
    /// Stiffness, against the rigid impact.
    Stiffness,
    /// Crust, against the exact soft impact of the sharp cylinder.
    Crust,
    /// Slices of a cylinder that lies flat, against no spin and the duration of one contact.
    Slices,
    /// All tilts and representations: the figures of R.
    Figures,
}

fn variants() -> Vec<Variant> {
    let of = |label: &str, setting: Setting, sweep: Sweep| Variant { label: label.into(), setting, sweep };
    let at = Setting::cylinder;
    let flat = |sharing| Setting { sharing, representation: Representation::Slices(1), ..at(90.0) };
    let single = |sharing| Setting { points: ContactPoints::Deepest, ..flat(sharing) };
    let glued = |representation| Setting { representation, ..at(45.0) };
    vec![
        of("45 degrees", at(45.0), Sweep::Steps),
        of("30 degrees", at(30.0), Sweep::Steps),
        of("75 degrees", at(75.0), Sweep::Steps),
        of("45 degrees, lagged damping, sampled edges", Setting { plain_scheme: true, ..at(45.0) }, Sweep::Steps),
        of("on its face, 0 degrees", at(0.0), Sweep::Steps),
        of("on its side, 90 degrees", at(90.0), Sweep::Steps),
        of("89.9 degrees, two points in turn", at(89.9), Sweep::Steps),
        of("89.9 degrees, shared by overlap", Setting { sharing: Sharing::ByOverlap, ..at(89.9) }, Sweep::Steps),
        of("89.9 degrees, model B: shared by count", Setting { sharing: Sharing::ByCount, ..at(89.9) }, Sweep::Steps),
        of("30 degrees, dashpot of the whole mass", Setting { damped_mass: DampedMass::Reduced, ..at(30.0) }, Sweep::Steps),
        of("15 degrees, dashpot of the whole mass", Setting { damped_mass: DampedMass::Reduced, ..at(15.0) }, Sweep::Steps),
        of("on its side, model A as printed", Setting { sharing: Sharing::SumAsPrinted, ..at(90.0) }, Sweep::Steps),
        of("45 degrees, 10 slices", glued(Representation::Slices(10)), Sweep::Steps),
        of("45 degrees, 9 spheres", glued(Representation::NineSpheres), Sweep::Steps),
        of("45 degrees, 54 spheres", glued(Representation::FiftyFourSpheres), Sweep::Steps),
        of("45 degrees, stiffness", at(45.0), Sweep::Stiffness),
        of("45 degrees, stiffness, dashpot of the whole mass", Setting { damped_mass: DampedMass::Reduced, ..at(45.0) }, Sweep::Stiffness),
        of("45 degrees, crust", at(45.0), Sweep::Crust),
        of("slices on their side, model A", flat(Sharing::Sum), Sweep::Slices),
        of("slices on their side, model B", flat(Sharing::ByCount), Sweep::Slices),
        of("slices on their side, model A, one point a slice", single(Sharing::Sum), Sweep::Slices),
        of("slices on their side, model B, one point a slice", single(Sharing::ByCount), Sweep::Slices),
        of("all tilts", at(45.0), Sweep::Figures),
    ]
}

impl Variant {
    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let fine = tier > Tier::Quick;
        match self.sweep {
            Sweep::Steps if self.setting.representation != Representation::Cylinder && !fine => vec![25.0, 100.0],
            Sweep::Steps if !fine => vec![25.0, 50.0, 100.0, 250.0],
            Sweep::Steps => vec![10.0, 25.0, 50.0, 100.0, 250.0, 500.0, 1000.0],
            Sweep::Stiffness => vec![1e4, 1e5, 1e6, 1e7, 1e8, 1e9],
            Sweep::Crust => vec![0.2, 0.1, 0.05, 0.02, 0.01],
            Sweep::Slices if !fine => vec![1.0, 2.0, 5.0, 10.0, 30.0],
            Sweep::Slices => (1..=30).map(f64::from).collect(),
            Sweep::Figures => vec![FINE],
        }
    }

    fn setting_at(&self, knob: f64) -> Setting {
        match self.sweep {
            Sweep::Steps | Sweep::Figures => self.setting,
            Sweep::Stiffness => Setting { stiffness: knob, ..self.setting },
            Sweep::Crust => Setting { crust: knob, ..self.setting },
            Sweep::Slices => Setting { representation: Representation::Slices(knob as usize), ..self.setting },
        }
    }

    /// Never a whole number: else a contact would end at the phase of a step at which it begins.
    fn steps_per_contact(&self, knob: f64) -> f64 {
        0.618_033_988_749_895 + if self.sweep == Sweep::Steps { knob } else { FINE }
    }

    /// What the impact should leave.
    fn expected(&self, setting: &Setting) -> (After, ReferenceKind, f64, &'static str) {
        match self.sweep {
            Sweep::Stiffness => {
                let rigid = setting.rigid().after_impact(setting.tilt_in_degrees.to_radians());
                let after = After { velocity: rigid.velocity, spin: -rigid.angular_velocity * RADIUS };
                (after, ReferenceKind::Exact, 1e-15, "impulse on a rigid cylinder, R eq 3.37-3.38 corrected")
            }
            _ => {
                (setting.exact().motion.into(), ReferenceKind::Computed, 1e-12, "soft planar impact, extrapolated to 1e-13 with its events")
            }
        }
    }
}

/// Phases of the first touch within a step.
fn phases(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |sample| (sample as f64 + 0.5) / count as f64)
}

fn evaluate(variant: &Variant, knob: f64) -> Result<Measurement, Failure> {
    let setting = variant.setting_at(knob);
    let (expected, kind, uncertainty, source) = variant.expected(&setting);
    let SoftImpact { motion, duration } = setting.exact();
    let steps = variant.steps_per_contact(knob);
    // Model errors do not need the statistics of start phases: they stand far above those of the step.
    let count = if variant.sweep == Sweep::Steps { SAMPLES } else { 10 };
    let mut measurement = Measurement { runs: count as u64, ..Measurement::default() };
    let (mut velocities, mut spins, mut durations, mut restitutions) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let step = duration / steps;
    for phase in phases(count) {
        let (mut first, mut last) = (None, 0);
        let look = |simulation: &mut solver::Simulation| {
            if simulation.bodies().force(0).norm_squared() > 0.0 {
                first = first.or(Some(simulation.steps_taken()));
                last = simulation.steps_taken();
            }
        };
        let (after, simulation) = setting.run(step, phase, look)?;
        velocities.push(after.velocity);
        spins.push(after.spin);
        durations.push((last - first.unwrap_or(last) + 1) as f64 * step);
        // The arm of the contact point at the end of the contact, where its velocity is taken.
        let arm = motion.tilt;
        restitutions.push(restitution_at_point(&after, arm));
        add_work(&mut measurement.work, simulation.ledger().total_work());
    }
    // Heights of some millimetres are rounded against overlaps of some micrometres, once a step.
    let overlap = APPROACH * (MASS / setting.stiffness).sqrt();
    let floor = f64::EPSILON * (RADIUS / overlap + 1.0) * steps.sqrt() * APPROACH;
    let quantity = |name, unit, samples, expected, floor, error_kind| {
        let reference = Reference { kind, uncertainty, source: source.into() };
        Quantity { name, unit, samples, expected, reference, error_kind, floor }
    };
    measurement.quantities = vec![
        quantity(VELOCITY, "m/s", velocities, expected.velocity, floor, ErrorKind::Absolute),
        quantity(SPIN, "m/s", spins, expected.spin, floor, ErrorKind::Absolute),
    ];
    if variant.sweep == Sweep::Slices {
        let single = Setting { sharing: Sharing::ByCount, representation: Representation::Cylinder, ..setting };
        let one_contact = single.exact().duration;
        measurement.quantities.push(quantity(DURATION, "s", durations, one_contact, 1.0 / steps, ErrorKind::Relative));
    }
    if variant.sweep == Sweep::Steps && setting.representation == Representation::Cylinder {
        measurement.quantities.push(quantity(RESTITUTION_AT_POINT, "1", restitutions, RESTITUTION, floor, ErrorKind::Relative));
    }
    Ok(measurement)
}

/// Velocity of the lowest point of the rim away from the wall, over that of the approach.
fn restitution_at_point(after: &After, tilt: f64) -> f64 {
    let (sine, cosine) = tilt.sin_cos();
    // Horizontal arm of the lower rim: behind the centre at small tilts. Face and line have no arm, but their symmetric points.
    let arm = -0.5 * LENGTH * sine + RADIUS * cosine;
    (after.velocity - after.spin / RADIUS * arm) / APPROACH
}

impl Case for CylinderWallImpact {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let variants = variants();
        let variant = &variants[setup.index];
        match variant.sweep {
            Sweep::Figures => figures::evaluate(),
            _ => evaluate(variant, knob),
        }
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        variants().iter().flat_map(|variant| claims_of(variant, tier)).collect()
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        let variants = variants();
        let variant = variants.get(setup.index)?;
        let setting = variant.setting_at(knob);
        let SoftImpact { duration, .. } = setting.exact();
        Some(setting.scene(duration / variant.steps_per_contact(knob), 0.5))
    }

    fn description(&self) -> Description {
        words::description(&variants().into_iter().map(|variant| variant.label).collect::<Vec<_>>())
    }
}

/// What a step of a contact leaves: (pi/n)^2/24 of the approach velocity, the error of a kick that stands for a step.
fn design_error(steps_per_contact: f64) -> f64 {
    (std::f64::consts::PI / steps_per_contact).powi(2) / 24.0 * APPROACH
}

fn claims_of(variant: &Variant, tier: Tier) -> Vec<Claim> {
    let claim = |quantity, statistic, subject, bound| Claim {
        setup: variant.label.clone(),
        quantity,
        statistic,
        subject,
        bound,
        expected: Expected::Holds,
    };
    let setting = &variant.setting;
    let mut claims = Vec::new();
    match variant.sweep {
        Sweep::Steps => {
            let knobs = variant.knobs(tier);
            let (coarsest, finest) = (knobs[0], knobs[knobs.len() - 1]);
            let range = [coarsest, finest];
            // By overlap, shares change within a few steps while a second point comes down: the fit is not asymptotic.
            let factor = if setting.sharing == Sharing::ByOverlap { 10.0 } else { 5.0 };
            let next_term = Bound::new(factor, 1.0 / coarsest, "the next term of the error at the coarsest step of the fit");
            let subject = if setting.plain_scheme || setting.sharing == Sharing::ByCount {
                Subject::OrderAbout { order: 1.0, range }
            } else {
                Subject::OrderAtLeast { order: 2.0, range }
            };
            claims.push(claim(VELOCITY, Statistic::Median, subject, next_term));
            let is_second_order = matches!(subject, Subject::OrderAtLeast { .. });
            let is_flat = setting.tilt_in_degrees % 90.0 == 0.0;
            for at in knobs.iter().copied().filter(|knob| is_second_order && *knob >= 100.0) {
                let design = design_error(at);
                let words = "(pi / steps per contact)^2 / 24 of the approach velocity";
                for quantity in [VELOCITY, SPIN] {
                    // Spin feels fast changes of shares more than the bound tells.
                    let is_smooth = !is_flat && setting.sharing != Sharing::ByOverlap;
                    if quantity == VELOCITY || is_smooth {
                        let touches_twice = quantity == SPIN && setting.tilt_in_degrees > 89.0 && at >= 1000.0;
                        let expected = if touches_twice {
                            let reason = "a dashpot sees the others as they were predicted, so that the step in which a second point touches leaves \
                                          a first-order remainder of two parts in a million";
                            Expected::KnownLimit(reason.into())
                        } else {
                            Expected::Holds
                        };
                        for (statistic, factor) in [(Statistic::Median, 1.5), (Statistic::Worst, 6.0)] {
                            let bound = Bound::new(factor, design, words);
                            claims.push(Claim { expected: expected.clone(), ..claim(quantity, statistic, Subject::ErrorAt(at), bound) });
                        }
                    }
                }
            }
            if is_flat {
                let floor = f64::EPSILON * RADIUS / (APPROACH * (MASS / STIFFNESS).sqrt()) * MASS * RADIUS * RADIUS / transverse_inertia();
                let words = "rounding of heights against the overlap, for every step of the contact alike";
                claims.push(claim(SPIN, Statistic::Worst, Subject::ErrorAt(finest), Bound::new(10.0, floor, words)));
            }
            if setting.damped_mass == DampedMass::Reduced || setting.sharing == Sharing::SumAsPrinted {
                let overlap = (MASS / STIFFNESS).sqrt() * APPROACH;
                let bound = Bound::new(4.0, overlap / RADIUS, "turn of the contact arm during a contact of this stiffness");
                let reason = if setting.damped_mass == DampedMass::Reduced {
                    "R eq. 3.19 calibrates the dashpot for the mass of the body, not for its effective mass at the contact point"
                } else {
                    "R eq. 3.35 as printed doubles the dashpot at a wall"
                };
                let wrong = claim(RESTITUTION_AT_POINT, Statistic::Median, Subject::ErrorAt(finest), bound);
                claims.push(Claim { expected: Expected::SourceError(reason.into()), ..wrong });
            } else if setting.representation == Representation::Cylinder && is_second_order && setting.tilt_in_degrees < 89.0 {
                let overlap = (MASS / STIFFNESS).sqrt() * APPROACH;
                let bound = Bound::new(4.0, overlap / RADIUS, "turn of the contact arm during a contact of this stiffness");
                claims.push(claim(RESTITUTION_AT_POINT, Statistic::Median, Subject::ErrorAt(finest), bound));
            }
        }
        Sweep::Stiffness => {
            let subject = Subject::OrderAbout { order: 0.5, range: [1e5, 1e9] };
            let bound =
                Bound::new(4.0, (1e5 * 1e-4_f64.powi(2) / MASS).sqrt().recip() / 100.0, "the next power of the softness at the softest");
            let order = claim(VELOCITY, Statistic::Median, subject, bound);
            let expected = if setting.damped_mass == DampedMass::Reduced {
                Expected::SourceError("with the dashpot of the whole mass the soft impact does not tend to the rigid one".into())
            } else {
                Expected::Holds
            };
            claims.push(Claim { expected, ..order });
        }
        Sweep::Crust => {
            // Coarser is larger here: the order is counted against the knob.
            let subject = Subject::OrderAbout { order: -1.0, range: [0.01, 0.2] };
            claims.push(claim(
                SPIN,
                Statistic::Median,
                subject,
                Bound::new(2.0, 0.1, "half the largest crust, the next term of its error"),
            ));
        }
        Sweep::Slices => {
            let floor = f64::EPSILON * RADIUS / (APPROACH * (MASS / STIFFNESS).sqrt()) * MASS * RADIUS * RADIUS / transverse_inertia();
            let words = "rounding of heights against the overlap, for every step of the contact alike";
            let no_spin = claim(SPIN, Statistic::Worst, Subject::ErrorAt(1.0), Bound::new(10.0, floor, words));
            let expected = if setting.points == ContactPoints::Deepest {
                Expected::KnownLimit("one point on a line of contact lies at one of its ends: its force turns the cylinder".into())
            } else {
                Expected::Holds
            };
            claims.push(Claim { expected, ..no_spin });
            let duration = claim(DURATION, Statistic::Median, Subject::ErrorAt(10.0), Bound::new(2.0, 1.0 / FINE, "a step of the contact"));
            let expected = if setting.sharing == Sharing::Sum {
                Expected::KnownLimit("model A: a contact of N points is as stiff as N springs, and shorter by the root of N".into())
            } else {
                Expected::Holds
            };
            claims.push(Claim { expected, ..duration });
        }
        Sweep::Figures => claims.extend(figures::claims(&variant.label)),
    }
    claims
}
