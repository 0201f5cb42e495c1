//! R's figures 3.7, 3.8 and 3.11: velocities after the impact over the tilt for each representation, and the force over time.

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::scene::{DampedMass, Sharing};

use super::setting::{APPROACH, MASS, RADIUS, RESTITUTION, Representation, STIFFNESS, Setting, force_of};
use super::{FINE, phases};
use crate::case::{Curve, Failure, Measurement, Quantity};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::study::add_work;

pub(super) const VELOCITY_CURVES: &str = "cylinder_wall_impact_velocity_over_tilt.csv";
pub(super) const SPIN_CURVES: &str = "cylinder_wall_impact_spin_over_tilt.csv";
pub(super) const FORCE_CURVES: &str = "cylinder_wall_impact_force_over_time.csv";

const FROM_CLOSED_FORM: &str = "velocity after, by the cylinder, from the closed form where it holds";
const FROM_CLOSED_FORM_NINE: &str = "velocity after, by 9 spheres, from the closed form where it holds";
const FROM_CLOSED_FORM_MANY: &str = "velocity after, by 54 spheres, from the closed form where it holds";

/// Tilts of the figures in degrees.
fn tilts() -> impl Iterator<Item = f64> {
    (0..=36).map(|index| 2.5 * f64::from(index))
}

/// Representations of the figures.
fn represented(tilt: f64) -> [Setting; 5] {
    let cylinder = Setting::cylinder(tilt);
    let by = |representation| Setting { representation, sharing: Sharing::ByCount, ..cylinder };
    [
        cylinder,
        by(Representation::Slices(10)),
        by(Representation::NineSpheres),
        by(Representation::FiftyFourSpheres),
        Setting { damped_mass: DampedMass::Reduced, ..cylinder },
    ]
}

/// All curves, and how far the representations are from the closed form where a single contact point leaves the wall for good.
pub(super) fn evaluate() -> Result<Measurement, Failure> {
    let mut measurement = Measurement { runs: 1, ..Measurement::default() };
    let (mut velocities, mut spins) = (Vec::new(), Vec::new());
    let mut largest = [0.0_f64; 5];
    for tilt in tilts() {
        let rigid = Setting::cylinder(tilt).rigid();
        let closed_form = if tilt % 90.0 == 0.0 { rigid.after_flat_impact() } else { rigid.after_impact(tilt.to_radians()) };
        let holds = tilt % 90.0 != 0.0 && rigid.next_rim_contact(tilt.to_radians()).is_none();
        let mut row_of_velocity = vec![tilt, closed_form.velocity / APPROACH];
        let mut row_of_spin = vec![tilt, closed_form.angular_velocity * RADIUS / APPROACH];
        for (setting, largest) in represented(tilt).iter().zip(&mut largest) {
            let step = setting.exact().duration / FINE;
            let (after, simulation) = setting.run(step, 0.5, |_| {})?;
            add_work(&mut measurement.work, simulation.ledger().total_work());
            measurement.runs += 1;
            row_of_velocity.push(after.velocity / APPROACH);
            row_of_spin.push(-after.spin / APPROACH);
            if holds {
                *largest = largest.max((after.velocity - closed_form.velocity).abs());
            }
        }
        velocities.push(row_of_velocity);
        spins.push(row_of_spin);
    }
    let columns =
        || vec!["tilt_deg", "closed_form", "cylinder", "ten_slices", "nine_spheres", "fifty_four_spheres", "dashpot_of_the_whole_mass"];
    measurement.curves = vec![
        Curve { file: VELOCITY_CURVES.into(), columns: columns(), rows: velocities },
        Curve { file: SPIN_CURVES.into(), columns: columns(), rows: spins },
        force_curves(&mut measurement)?,
    ];
    let named = [(FROM_CLOSED_FORM, largest[0]), (FROM_CLOSED_FORM_NINE, largest[2]), (FROM_CLOSED_FORM_MANY, largest[3])];
    measurement.quantities = named
        .map(|(name, value)| Quantity {
            name,
            unit: "m/s",
            samples: vec![value],
            expected: 0.0,
            reference: Reference {
                kind: ReferenceKind::Exact,
                uncertainty: 1e-15,
                source: "impulse on a rigid cylinder, R eq 3.37-3.38 corrected".into(),
            },
            error_kind: ErrorKind::Absolute,
            floor: 1e-12,
        })
        .to_vec();
    Ok(measurement)
}

/// Force over time of a cylinder that lands on its side, in one piece and in slices, for models A and B (R figure 3.8).
fn force_curves(measurement: &mut Measurement) -> Result<Curve, Failure> {
    let columns = vec!["time_s", "exact", "one_piece", "a_2", "a_5", "a_10", "b_2", "b_5", "b_10"];
    let flat = |sharing, slices| Setting { sharing, representation: Representation::Slices(slices), ..Setting::cylinder(90.0) };
    let one_piece = flat(Sharing::ByCount, 1);
    let step = one_piece.exact().duration / FINE;
    let mut settings = vec![one_piece];
    for sharing in [Sharing::Sum, Sharing::ByCount] {
        settings.extend([2, 5, 10].map(|slices| flat(sharing, slices)));
    }
    let exact = one_piece.exact_force(FINE as usize);
    let mut rows: Vec<Vec<f64>> = exact.iter().map(|[time, force]| vec![*time, *force]).collect();
    for setting in settings {
        let mut forces = Vec::new();
        let phase = phases(1).next().unwrap_or(0.5);
        let (_, simulation) = setting.run(step, phase, |simulation| forces.push(force_of(simulation)))?;
        add_work(&mut measurement.work, simulation.ledger().total_work());
        measurement.runs += 1;
        // The first touch lies one step and a half after the start: force number n belongs to the middle of part n - 2.
        let from_touch = forces.iter().skip(2).chain(std::iter::repeat(&0.0));
        rows.iter_mut().zip(from_touch).for_each(|(row, force)| row.push(*force));
    }
    Ok(Curve { file: FORCE_CURVES.into(), columns, rows })
}

/// The cylinder follows the closed form up to its softness; glued spheres do not.
pub(super) fn claims(label: &str) -> Vec<Claim> {
    let softness = (MASS / STIFFNESS).sqrt() * APPROACH / RADIUS;
    let claim = |quantity, expected| Claim {
        setup: label.into(),
        quantity,
        statistic: Statistic::Single,
        subject: Subject::ErrorAt(FINE),
        bound: Bound::new(4.0, softness * (1.0 + RESTITUTION), "turn of the contact arm during a contact of this stiffness"),
        expected,
    };
    let spheres = "glued spheres have round edges: their contact point is not that of the cylinder (R section 3.2)";
    vec![
        claim(FROM_CLOSED_FORM, Expected::Holds),
        claim(FROM_CLOSED_FORM_NINE, Expected::KnownLimit(spheres.into())),
        claim(FROM_CLOSED_FORM_MANY, Expected::KnownLimit(spheres.into())),
    ]
}
