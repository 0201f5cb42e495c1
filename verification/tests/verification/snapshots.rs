//! The snapshot of a case is its convergence table and the ledger of its scene, at the digits that are promised.
//!
//! A changed snapshot is accepted only with the reason in the commit message.

use std::fmt::Write;

use insta::comparator::Comparator;
use insta::internals::SnapshotContents;
use verification::CASES;

use super::cases::run_part;

/// Snapshots are printed with three significant digits, of which two are promised.
const PROMISED: f64 = 0.01;

/// Compares texts word by word: numbers by value, all else by letters.
#[derive(Debug, Clone, Copy)]
struct ByValue;

impl Comparator for ByValue {
    fn matches(&self, reference: &insta::Snapshot, test: &insta::Snapshot) -> bool {
        match (text(reference), text(test)) {
            (Some(reference), Some(test)) => same_by_value(&reference, &test),
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(*self)
    }
}

fn text(snapshot: &insta::Snapshot) -> Option<String> {
    match snapshot.contents() {
        SnapshotContents::Text(text) => Some(text.to_string()),
        SnapshotContents::Binary(_) => None,
    }
}

fn same_by_value(one: &str, other: &str) -> bool {
    let words = |text: &str| text.split_whitespace().map(str::to_string).collect::<Vec<_>>();
    let (one, other) = (words(one), words(other));
    one.len() == other.len() && one.iter().zip(&other).all(|(one, other)| same_word(one, other))
}

fn same_word(one: &str, other: &str) -> bool {
    match (one.parse::<f64>(), other.parse::<f64>()) {
        (Ok(one), Ok(other)) => (one - other).abs() <= PROMISED * one.abs().max(other.abs()),
        _ => one == other,
    }
}

/// One line per setup, quantity and statistic: the error at each knob value. Errors near their floor carry no digits.
fn table(id: &str) -> String {
    let case = CASES.iter().find(|case| case.description().id == id).unwrap_or_else(|| panic!("there is a case {id}"));
    let outcome = run_part(*case);
    let mut lines: Vec<(String, String)> = Vec::new();
    for row in outcome.rows.iter().filter(|row| row.knob.is_some()) {
        let name = format!("{} | {} | {}", row.setup, row.quantity, row.statistic);
        let knob = row.knob.as_ref().map_or(f64::NAN, |knob| knob.value);
        let (error, floor) = (row.error.unwrap_or(f64::NAN), row.floor.unwrap_or(0.0));
        let round_off = matches!(&row.reference, Some(reference) if error < 100.0 * floor.min(1e-9).max(reference.uncertainty));
        let error = if round_off { "floor".to_string() } else { format!("{error:.2e}") };
        let entry = format!("  {knob} {error}");
        match lines.iter_mut().find(|(known, _)| *known == name) {
            Some((_, entries)) => entries.push_str(&entry),
            None => lines.push((name, entry)),
        }
    }
    let mut text = String::new();
    for (name, entries) in lines {
        let _ = writeln!(text, "{name}\n  {entries}");
    }
    text.push_str("\nledger\n");
    for line in &outcome.card.ledger {
        let _ = writeln!(text, "{} {}: {} {:?}", if line.used { "used" } else { "left out" }, line.stage, line.reason, line.work);
    }
    text
}

fn assert_matches(id: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_comparator(Box::new(ByValue));
    settings.set_prepend_module_to_snapshot(false);
    settings.bind(|| insta::assert_snapshot!(id, table(id)));
}

#[test]
fn normal_contact() {
    assert_matches("normal_contact");
}

#[test]
fn oblique_impact() {
    assert_matches("oblique_impact");
}

#[test]
fn cylinder_wall_impact() {
    assert_matches("cylinder_wall_impact");
}

#[test]
fn box_at_rest() {
    assert_matches("box_at_rest");
}

#[test]
fn free_top() {
    assert_matches("free_top");
}

#[test]
fn sphere_on_incline() {
    assert_matches("sphere_on_incline");
}

#[test]
fn sphere_bounce_long() {
    assert_matches("sphere_bounce_long");
}

#[test]
fn static_lattice() {
    assert_matches("static_lattice");
}

#[test]
fn sphere_column() {
    assert_matches("sphere_column");
}

#[test]
fn dense_elastic_bed() {
    assert_matches("dense_elastic_bed");
}

#[test]
fn granular_gas() {
    assert_matches("granular_gas");
}

#[test]
fn neighbour_search() {
    assert_matches("neighbour_search");
}

#[test]
fn stability_contacts() {
    assert_matches("stability_contacts");
}

#[test]
fn energy_fifty_cylinders() {
    assert_matches("energy_fifty_cylinders");
}

#[test]
fn dam_break() {
    assert_matches("dam_break");
}

#[test]
fn mass_properties() {
    assert_matches("mass_properties");
}

#[test]
fn pair_distance() {
    assert_matches("pair_distance");
}

#[test]
fn energy_two_ellipsoids() {
    assert_matches("energy_two_ellipsoids");
}

#[test]
fn errata_s() {
    assert_matches("errata_s");
}

#[test]
fn silo_discharge() {
    assert_matches("silo_discharge");
}

#[test]
fn vertex_refinement() {
    assert_matches("vertex_refinement");
}

#[test]
fn zick_homsy() {
    assert_matches("zick_homsy");
}

#[test]
fn lobed_array() {
    assert_matches("lobed_array");
}

#[test]
fn small_packed_bed() {
    assert_matches("small_packed_bed");
}

#[test]
fn fixed_sphere() {
    assert_matches("fixed_sphere");
}

#[test]
fn settling_sphere() {
    assert_matches("settling_sphere");
}

#[test]
fn neutral_body() {
    assert_matches("neutral_body");
}

#[test]
fn contact_in_fluid() {
    assert_matches("contact_in_fluid");
}

#[test]
fn flow_orders() {
    assert_matches("flow_orders");
}

#[test]
fn the_comparison_sees_the_third_digit_as_noise_and_the_second_as_change() {
    assert!(same_by_value("error 1.23e-5 at 50", "error  1.235e-5 at 50"));
    assert!(!same_by_value("error 1.23e-5 at 50", "error 1.33e-5 at 50"));
    assert!(!same_by_value("error 1.23e-5 at 50", "error 1.23e-5 at 51"));
    assert!(!same_by_value("used contacts", "left contacts"));
}
