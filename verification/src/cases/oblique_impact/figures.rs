//! Sweeps of the angle: slip after over slip before for every law and for rigid spheres, and test 4 of Chung and Ooi.

use reports::row::{ErrorKind, Reference, ReferenceKind};

use super::chung_ooi::at_constant_speed;
use super::setting::Setting;
use super::{DEVIATION, FINE, GUESSED, RUBBER, SPRING, wall};
use crate::case::{Curve, Failure, Measurement, Quantity};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::oblique_impact::Velocities;
use crate::exact::rigid_oblique_impact::RigidObliqueImpact;
use crate::study::add_work;

pub(super) const SLIP_CURVES: &str = "oblique_impact_slip_after.csv";
pub(super) const CHUNG_OOI_CURVES: &str = "oblique_impact_chung_ooi_test_4.csv";

/// What a run leaves, with its deviation from the exact solution by the speed.
fn run(setting: &Setting, measurement: &mut Measurement, largest: &mut f64) -> Result<(Velocities, Velocities), Failure> {
    let exact = setting.exact().after(&setting.before);
    let run = setting.run(&exact, FINE, 0.381_966)?;
    add_work(&mut measurement.work, run.work);
    measurement.runs += 1;
    let deviation = (run.after.tangential - exact.after.tangential).abs() / setting.speed();
    *largest = if deviation > *largest || deviation.is_nan() { deviation } else { *largest };
    Ok((run.after, exact.after))
}

/// All curves, and the largest deviation of any point from its exact solution.
pub(super) fn evaluate(_knob: f64) -> Result<Measurement, Failure> {
    let mut measurement = Measurement::default();
    let mut largest = 0.0_f64;
    let rigid = RigidObliqueImpact { restitution: 0.9, friction: 0.3, tangential_restitution: 1.0 };
    let mut slips = Vec::new();
    for index in 0..=60 {
        let slip = 0.06 * f64::from(index);
        let mut row = vec![slip, rigid.slip_after(slip)];
        for laws in [SPRING, GUESSED, RUBBER] {
            let setting = wall(laws, slip);
            let (found, exact) = run(&setting, &mut measurement, &mut largest)?;
            row.extend([setting.exact().slip(&exact), setting.exact().slip(&found)]);
        }
        slips.push(row);
    }
    let columns = vec!["slip_before", "rigid", "spring_exact", "spring", "guessed_exact", "guessed", "hertz_exact", "hertz"];
    let mut angles = Vec::new();
    for index in 1..=44 {
        let angle = 2.0 * f64::from(index);
        let setting = at_constant_speed(angle);
        let before = setting.before;
        let (found, exact) = run(&setting, &mut measurement, &mut largest)?;
        let sliding = 1.0 - 0.092 * 1.98 * before.approach / before.tangential;
        angles.push(vec![angle, sliding.max(5.0 / 7.0), exact.tangential / before.tangential, found.tangential / before.tangential]);
    }
    measurement.curves = vec![
        Curve { file: SLIP_CURVES.into(), columns, rows: slips },
        Curve { file: CHUNG_OOI_CURVES.into(), columns: vec!["angle_deg", "rigid", "exact", "solver"], rows: angles },
    ];
    let source = "ordinary differential equation of the coded laws, extrapolated to 1e-12 with its events";
    measurement.quantities = vec![Quantity {
        name: DEVIATION,
        unit: "1",
        samples: vec![largest],
        expected: 0.0,
        reference: Reference { kind: ReferenceKind::Computed, uncertainty: 1e-12, source: source.into() },
        error_kind: ErrorKind::Absolute,
        floor: 1e-12,
    }];
    Ok(measurement)
}

/// Every point lies on its exact solution, as far as the steps of the figures tell.
pub(super) fn claims(label: &str) -> Vec<Claim> {
    let angle = wall(RUBBER, 1.0).largest_angle();
    vec![Claim {
        setup: label.into(),
        quantity: DEVIATION,
        statistic: Statistic::Single,
        subject: Subject::ErrorAt(FINE),
        bound: Bound::new(4.0, (angle / FINE).powi(2) / 24.0 * angle, "(angle in a step)^2 / 24 of the angle of a contact"),
        expected: Expected::Holds,
    }]
}
