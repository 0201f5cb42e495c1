//! The eight tests of Chung and Ooi (2011) on Hertz's and Mindlin's laws, each held against the exact solution of the coded model.
//!
//! 1 two spheres head-on; 2 a sphere on a rigid plane head-on; 3 the same with damping; 4 oblique at constant speed; 5 oblique at constant normal
//! velocity; 6 spin alone; 7 two spheres whose spins match at the contact; 8 two spheres whose spins oppose there, which mirrors 6.

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::contact::law::hertz::Elasticity;

use super::DEVIATION;
use super::setting::{Laws, Scheme, Setting};
use crate::case::{Failure, Measurement, Quantity};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::oblique_impact::Velocities;
use crate::study::add_work;

const OVERLAP: &str = "largest deviation of the largest overlap, relative";
const DURATION: &str = "largest deviation of the duration, relative";
/// Steps in a contact of the claims: of second order, they know velocities to one in a million.
const FINEST: f64 = 4000.0;
/// Where within a step the contacts begin: anywhere but at a special place.
const PHASE: f64 = 0.381_966_011_250_105;

/// A material: name, Young's modulus in Pa, Poisson's ratio, density in kg/m^3. By way of Yade's scripts; steel of test 5 by the author.
type Material = (f64, f64, f64);
const GLASS: Material = (4.8e10, 0.2, 2800.0);
const LIMESTONE: Material = (2e10, 0.25, 2500.0);
const ALUMINIUM: Material = (7e10, 0.3, 2699.0);
const MAGNESIUM: Material = (4e10, 0.35, 1800.0);
pub(super) const ALUMINIUM_OXIDE: Material = (3.8e11, 0.23, 4000.0);
const CAST_IRON: Material = (1e11, 0.25, 7000.0);
const STEEL: Material = (2.08e11, 0.3, 7850.0);

pub(super) fn impact((young_modulus, poisson_ratio, density): Material, radius: f64, approach: f64, tangential: f64) -> Setting {
    Setting {
        laws: Laws::Elastic(Elasticity { young_modulus, poisson_ratio }),
        scheme: Scheme::Resolved,
        radii: [Some(radius), None],
        density,
        restitution: 1.0,
        friction: 0.35,
        before: Velocities { approach, tangential, ..Velocities::default() },
    }
}

fn with_spins(setting: Setting, spin_of_first: f64, spin_of_second: f64) -> Setting {
    let second = setting.radii[0];
    Setting { radii: [second, second], before: Velocities { spin_of_first, spin_of_second, ..setting.before }, ..setting }
}

/// Test 4 at an angle from the normal in degrees.
pub(super) fn at_constant_speed(angle: f64) -> Setting {
    let (along, into) = (3.9 * angle.to_radians().sin(), 3.9 * angle.to_radians().cos());
    Setting { restitution: 0.98, friction: 0.092, ..impact(ALUMINIUM_OXIDE, 0.0025, into, along) }
}

fn impacts(test: usize) -> Vec<Setting> {
    let materials = |materials: [Material; 2], of: &dyn Fn(Material) -> Vec<Setting>| materials.into_iter().flat_map(of).collect();
    match test {
        1 => materials([GLASS, LIMESTONE], &|material| vec![with_spins(impact(material, 0.01, 20.0, 0.0), 0.0, 0.0)]),
        2 => materials([ALUMINIUM, MAGNESIUM], &|material| vec![impact(material, 0.1, 0.2, 0.0)]),
        3 => materials([ALUMINIUM_OXIDE, CAST_IRON], &|material| {
            let damped = |restitution| Setting { restitution, ..impact(material, 0.0025, 3.9, 0.0) };
            [0.2, 0.4, 0.6, 0.8, 1.0].map(damped).to_vec()
        }),
        4 => (1..=17).map(|index| at_constant_speed(5.0 * f64::from(index))).collect(),
        5 => (0..=10).map(|index| Setting { friction: 0.3, ..impact(STEEL, 1e-5, 5.0, 1.5 * f64::from(index)) }).collect(),
        6 => materials([ALUMINIUM, MAGNESIUM], &|material| {
            let spinning = |index: i32| {
                let before = Velocities { approach: 0.2, spin_of_first: 1.6 * f64::from(index), ..Velocities::default() };
                Setting { before, restitution: 0.5, friction: 0.4, ..impact(material, 0.1, 0.2, 0.0) }
            };
            (0..=10).map(spinning).collect()
        }),
        7 => materials([ALUMINIUM, MAGNESIUM], &|material| {
            (0..=5).map(|index| 3.2 * f64::from(index)).map(|spin| with_spins(impact(material, 0.1, 0.4, 0.0), spin, -spin)).collect()
        }),
        // Twice the approach of test 6 between two spheres is the same to each.
        _ => materials([ALUMINIUM, MAGNESIUM], &|material| {
            let spinning = |spin| Setting { restitution: 0.5, friction: 0.4, ..with_spins(impact(material, 0.1, 0.4, 0.0), spin, spin) };
            (0..=10).map(|index| spinning(1.6 * f64::from(index))).collect()
        }),
    }
}

/// The impact that stands for a test where a single one is asked for.
pub(super) fn first_impact(test: usize) -> Setting {
    let impacts = impacts(test);
    impacts[impacts.len() / 2]
}

fn is_head_on(test: usize) -> bool {
    test <= 3
}

/// All impacts of a test at a number of steps in each contact.
pub(super) fn evaluate(test: usize, steps: f64) -> Result<Measurement, Failure> {
    let impacts = impacts(test);
    let mut measurement = Measurement { runs: impacts.len() as u64, ..Measurement::default() };
    let mut largest = [0.0_f64; 3];
    let mut floor = 0.0_f64;
    for setting in &impacts {
        let exact = setting.exact().after(&setting.before);
        let run = setting.run(&exact, steps, PHASE)?;
        let (found, truth, radius) = (&run.after, &exact.after, setting.radius());
        let deviations = [
            found.approach - truth.approach,
            found.tangential - truth.tangential,
            (found.spin_of_first - truth.spin_of_first) * radius,
            (found.spin_of_second - truth.spin_of_second) * radius,
        ];
        let velocity = deviations.into_iter().map(f64::abs).fold(0.0, f64::max) / setting.speed();
        // Not `max`, which would lose a value that is not a number.
        let worst = |known: f64, new: f64| if new > known || new.is_nan() { new } else { known };
        largest = [
            worst(largest[0], velocity),
            worst(largest[1], (run.largest_overlap / exact.largest_overlap - 1.0).abs()),
            worst(largest[2], (run.duration / exact.duration - 1.0).abs()),
        ];
        // Overlaps are differences of lengths of the size of the radius, each known to its rounding.
        floor = floor.max(16.0 * f64::EPSILON * setting.radius() / exact.largest_overlap * steps.sqrt());
        add_work(&mut measurement.work, run.work);
    }
    let source = "ordinary differential equation of the coded laws, extrapolated to 1e-12 with its events";
    let quantity = |name, value| Quantity {
        name,
        unit: "1",
        samples: vec![value],
        expected: 0.0,
        reference: Reference { kind: ReferenceKind::Computed, uncertainty: 1e-12, source: source.into() },
        error_kind: ErrorKind::Absolute,
        floor,
    };
    measurement.quantities = vec![quantity(DEVIATION, largest[0])];
    if is_head_on(test) {
        measurement.quantities.extend([quantity(OVERLAP, largest[1]), quantity(DURATION, largest[2])]);
    }
    Ok(measurement)
}

/// Velocities to one part in a million and better: the design error at 4000 steps in a contact.
pub(super) fn claims(label: &str, test: usize) -> Vec<Claim> {
    let impacts = impacts(test);
    let largest = |error: &dyn Fn(&Setting) -> f64| impacts.iter().map(error).fold(0.0, f64::max);
    // Matching spins of test 7 leave no slip.
    let velocity = if is_head_on(test) || test == 7 {
        let rebound = largest(&|setting| setting.design_error_of_rebound(FINEST) / setting.before.approach);
        Bound::new(1.0, rebound, "(angle in a step)^2 / 24 of the angle of a contact, and what dashpot and edges feel of it")
    } else {
        let across = largest(&|setting| setting.design_errors_across(FINEST).into_iter().fold(0.0, f64::max) / setting.speed());
        Bound::new(3.0, across, "(angle in a step)^2 / 24 of the angle of a contact, times the share of spin or velocity in the slip")
    };
    let claim = |quantity, bound| Claim {
        setup: label.into(),
        quantity,
        statistic: Statistic::Single,
        subject: Subject::ErrorAt(FINEST),
        bound,
        expected: Expected::Holds,
    };
    let mut claims = vec![claim(DEVIATION, velocity)];
    if is_head_on(test) {
        let half_turn = std::f64::consts::PI;
        let of_contact =
            Bound::new(4.0, (half_turn / FINEST).powi(2) / 24.0 * half_turn, "(angle in a step)^2 / 24 of the half turn of a contact");
        claims.extend([claim(OVERLAP, of_contact.clone()), claim(DURATION, of_contact)]);
    }
    claims
}
