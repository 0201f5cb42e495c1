//! Every case holds its claims, on the part of its quick tier that takes less than a second.

use verification::case::{Case, Setup};
use verification::study::{Context, Outcome, run};
use verification::{CASES, Tier};

use reports::row::Verdict;

/// The part of a case that is run here: what a test can afford.
fn affordable(setup: &Setup, knob: f64) -> bool {
    let is_short_rest = knob == 20_000.0;
    let is_fine_grid = setup.label.contains("solid fraction") && (knob > 10.0 || setup.label.contains("cost of"));
    let is_wide_stream = setup.label.contains("6 diameters across") || (setup.label.contains("diameters across") && knob > 6.0);
    // The ends of the range, and a sphere of the fluid's own density; one grid of two frames.
    let is_other_settling = (setup.label.contains("times as dense") && ![0.01, 1.0, 1000.0].contains(&knob))
        || (setup.label.contains("held in a stream and moved") && knob > 6.0);
    let is_orbit = setup.label.contains("of aspect ratio") && setup.label.contains("in shear");
    let is_large_cell = setup.label.contains("aspect ratio 1") && knob > 16.0
        || ["aspect ratio 5", "all shapes"].iter().any(|part| setup.label.contains(part));
    // One collision at each end of its range.
    let is_one_collision = ["(S0", "(S1", "(S2"].iter().any(|test| setup.label.contains(test));
    (knob <= 100.0 || is_short_rest || is_one_collision || setup.label.contains("times as dense"))
        && !setup.label.contains("a million bounces")
        && !is_fine_grid
        && !is_wide_stream
        && !is_other_settling
        && !is_large_cell
        && !is_orbit
        && !["1000 spheres", "2000 beads", "13 diameters long"].iter().any(|part| setup.label.contains(part))
}

/// Runs the affordable part of a case, without a clock.
pub fn run_part(case: &dyn Case) -> Outcome {
    run(
        case,
        &Context {
            tier: Tier::Quick,
            random_seed: 1,
            commit: "test".into(),
            machine: "test".into(),
            only: Some(&affordable),
            clock: None,
            progress: &|_, _| {},
        },
    )
}

fn case(id: &str) -> &'static dyn Case {
    *CASES.iter().find(|case| case.description().id == id).unwrap_or_else(|| panic!("there is a case {id}"))
}

fn assert_claims_are_met(id: &str, at_least: usize) {
    let outcome = run_part(case(id));
    let judged = outcome.rows.iter().filter(|row| row.bound.is_some()).count();
    assert!(judged >= at_least, "{id}: only {judged} claims were judged");
    let unmet: Vec<String> = outcome
        .rows
        .iter()
        .filter(|row| matches!(row.verdict(), Verdict::NotMet | Verdict::UnexpectedPass))
        .map(|row| {
            format!(
                "{:?}: {} | {} | {} | knob {:?}: error {:?}, bound {:?}",
                row.verdict(),
                row.setup,
                row.quantity,
                row.statistic,
                row.knob,
                row.error,
                row.bound
            )
        })
        .collect();
    assert!(unmet.is_empty(), "{id}:\n{}", unmet.join("\n"));
    let failed: Vec<_> = outcome.rows.iter().filter_map(|row| Some((&row.setup, &row.knob, row.failed.as_ref()?))).collect();
    assert!(failed.is_empty(), "{id}: runs failed: {failed:?}");
}

#[test]
fn normal_contact_meets_its_claims() {
    assert_claims_are_met("normal_contact", 45);
}

#[test]
fn oblique_impact_meets_its_claims() {
    assert_claims_are_met("oblique_impact", 110);
}

#[test]
fn free_top_meets_its_claims() {
    assert_claims_are_met("free_top", 9);
}

#[test]
fn sphere_on_incline_meets_its_claims() {
    assert_claims_are_met("sphere_on_incline", 22);
}

#[test]
fn sphere_bounce_long_meets_its_claims() {
    assert_claims_are_met("sphere_bounce_long", 4);
}

#[test]
fn static_lattice_meets_its_claims() {
    assert_claims_are_met("static_lattice", 30);
}

#[test]
fn sphere_column_meets_its_claims() {
    assert_claims_are_met("sphere_column", 30);
}

#[test]
fn dense_elastic_bed_meets_its_claims() {
    assert_claims_are_met("dense_elastic_bed", 30);
}

#[test]
fn granular_gas_meets_its_claims() {
    assert_claims_are_met("granular_gas", 4);
}

#[test]
fn neighbour_search_meets_its_claims() {
    assert_claims_are_met("neighbour_search", 10);
}

#[test]
fn stability_contacts_meets_its_claims() {
    assert_claims_are_met("stability_contacts", 33);
}

#[test]
fn cylinder_wall_impact_meets_its_claims() {
    assert_claims_are_met("cylinder_wall_impact", 60);
}

#[test]
fn box_at_rest_meets_its_claims() {
    assert_claims_are_met("box_at_rest", 5);
}

#[test]
fn energy_fifty_cylinders_meets_its_claims() {
    assert_claims_are_met("energy_fifty_cylinders", 20);
}

#[test]
fn dam_break_meets_its_claims() {
    assert_claims_are_met("dam_break", 3);
}

#[test]
fn mass_properties_meets_its_claims() {
    assert_claims_are_met("mass_properties", 70);
}

#[test]
fn pair_distance_meets_its_claims() {
    assert_claims_are_met("pair_distance", 300);
}

#[test]
fn energy_two_ellipsoids_meets_its_claims() {
    assert_claims_are_met("energy_two_ellipsoids", 30);
}

#[test]
fn errata_s_meets_its_claims() {
    assert_claims_are_met("errata_s", 30);
}

#[test]
fn zick_homsy_meets_its_claims() {
    assert_claims_are_met("zick_homsy", 20);
}

#[test]
fn lobed_array_meets_its_claims() {
    assert_claims_are_met("lobed_array", 80);
}

#[test]
fn small_packed_bed_meets_its_claims() {
    assert_claims_are_met("small_packed_bed", 8);
}

#[test]
fn vertex_refinement_meets_its_claims() {
    assert_claims_are_met("vertex_refinement", 40);
}

#[test]
fn silo_discharge_meets_its_claims() {
    assert_claims_are_met("silo_discharge", 1);
}

#[test]
fn flow_orders_meets_its_claims() {
    assert_claims_are_met("flow_orders", 100);
}

#[test]
fn fixed_sphere_meets_its_claims() {
    assert_claims_are_met("fixed_sphere", 14);
}

#[test]
fn settling_sphere_meets_its_claims() {
    assert_claims_are_met("settling_sphere", 24);
}

#[test]
fn neutral_body_meets_its_claims() {
    assert_claims_are_met("neutral_body", 18);
}

#[test]
fn contact_in_fluid_meets_its_claims() {
    assert_claims_are_met("contact_in_fluid", 11);
}

/// A case that is not tested above would be a case that nobody checks.
#[test]
fn every_case_is_tested_here() {
    let ids: Vec<&str> = CASES.iter().map(|case| case.description().id).collect();
    assert_eq!(
        ids,
        [
            "normal_contact",
            "oblique_impact",
            "cylinder_wall_impact",
            "box_at_rest",
            "free_top",
            "sphere_on_incline",
            "sphere_bounce_long",
            "static_lattice",
            "sphere_column",
            "dense_elastic_bed",
            "granular_gas",
            "neighbour_search",
            "stability_contacts",
            "energy_fifty_cylinders",
            "dam_break",
            "mass_properties",
            "pair_distance",
            "energy_two_ellipsoids",
            "vertex_refinement",
            "errata_s",
            "silo_discharge",
            "zick_homsy",
            "lobed_array",
            "small_packed_bed",
            "flow_orders",
            "fixed_sphere",
            "settling_sphere",
            "neutral_body",
            "contact_in_fluid",
        ]
    );
}

#[test]
fn descriptions_are_consistent() {
    for case in CASES {
        let description = case.description();
        let has = |label: &str| description.setups.iter().any(|setup| setup.label == label);
        assert!(has(&description.headline.setup), "{}: headline", description.id);
        for plot in &description.plots {
            let setups = match plot {
                reports::card::Plot::Convergence { setups, .. } | reports::card::Plot::ErrorAgainstCost { setups, .. } => setups.clone(),
                reports::card::Plot::Curves { .. } | reports::card::Plot::Bars { .. } | reports::card::Plot::Slices { .. } => Vec::new(),
            };
            assert!(setups.iter().all(|label| has(label)), "{}: a plot names a setup that does not exist", description.id);
        }
        for tier in [Tier::Quick, Tier::Standard] {
            for claim in case.claims(tier) {
                assert!(has(&claim.setup), "{}: a claim names the setup {}", description.id, claim.setup);
                assert!(claim.bound.factor <= 10.0 && claim.bound.floor > 0.0, "{}: {:?}", description.id, claim.bound);
            }
        }
        let labels: std::collections::BTreeSet<&str> = description.setups.iter().map(|setup| setup.label.as_str()).collect();
        assert_eq!(labels.len(), description.setups.len(), "{}: labels are unique", description.id);
    }
}

#[test]
fn evaluation_is_the_same_to_the_bit_each_time() {
    for case in CASES {
        let description = case.description();
        let setup = &description.setups[0];
        let knob = (description.knob.values)(Tier::Quick, setup)[0];
        let measure = || case.evaluate(setup, knob, 3).unwrap_or_else(|failure| panic!("{}: {failure}", description.id));
        assert!(measure() == measure(), "{}", description.id);
    }
}
