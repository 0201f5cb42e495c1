//! The site as a whole: same bytes, right verdicts, sound pages.

mod fixture;
mod html_check;

use std::collections::BTreeSet;

use fixture::{claim, empty_case, failed, good_case, meta, red_case, results, row};
use html_check::{attributes, loaded_resources, unbalanced_tag};
use reports::row::{Expectation, Verdict};
use reports::{CaseResults, RenderError, Results, SiteFile, read_rows, render, verdict_line, write_rows};

fn site() -> Vec<SiteFile> {
    render(&results(), &meta()).expect("the fixture is well-formed")
}

fn page<'a>(files: &'a [SiteFile], path: &str) -> &'a str {
    &files.iter().find(|file| file.path == path).unwrap_or_else(|| panic!("{path} is missing")).content
}

fn page_of(case: CaseResults) -> String {
    let path = format!("{}.html", case.card.case);
    let files = render(&Results { cases: vec![case], scene_keys: Vec::new() }, &meta()).expect("a well-formed case");
    page(&files, &path).to_string()
}

#[test]
fn same_results_make_the_same_bytes() {
    assert_eq!(site(), site());
}

/// Not a check but a service: the pages lie in the build's temporary folder for people to look at.
#[test]
fn the_site_can_be_looked_at() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("site");
    for file in site() {
        let path = folder.join(&file.path);
        let parent = path.parent().expect("the path has a folder");
        std::fs::create_dir_all(parent).and_then(|()| std::fs::write(&path, &file.content)).expect("a writable folder");
    }
}

#[test]
fn rows_survive_the_way_through_text() {
    let rows = good_case().rows;
    assert_eq!(read_rows(&write_rows(&rows)), Ok(rows));
}

#[test]
fn a_malformed_row_is_named_by_its_line() {
    let good = write_rows(&[row("case", "setup", 10.0, "median", 0.1)]);
    for (broken, word) in [
        ("{}".to_string(), "missing field"),
        ("nonsense".to_string(), "expected"),
        (good.trim().replacen("\"schema\":1", "\"schema\":2", 1), "schema 2"),
        (good.trim().replacen("{", "{\"surprise\":1,", 1), "unknown field"),
    ] {
        let error = read_rows(&format!("{good}\n{broken}\n{good}")).expect_err("the third line is broken");
        assert_eq!(error.line, 3, "{error}");
        assert!(error.message.contains(word), "{error}");
    }
}

#[test]
fn verdict_lines_say_what_counts() {
    assert_eq!(
        verdict_line(&good_case()),
        "normal_contact  met 26/26  1 failed run, restitution error 1.4e-4 (bound 3.5e-4 = 3 × design error at this \
         knob), order 2.02, 2.3 µs CPU a run"
    );
    assert_eq!(
        verdict_line(&red_case()),
        "silo_discharge  NOT MET 2/3  1 unexpected pass, restitution error 0.010 (bound 0.0040 = 3 × design error at this \
         knob), 2.3 µs CPU a run; first not met: restitution error 0.010 (bound 0.0040 = 3 × design error at this knob) \
         [e=0.9, until zero overlap, velocity Verlet, centred damping, steps_per_contact=80]"
    );
    assert_eq!(verdict_line(&empty_case()), "dam_break  no result 0/0  no headline row");
}

#[test]
fn a_failing_row_makes_its_case_red_and_first() {
    let files = site();
    let index = page(&files, "index.html");
    let place = |name: &str| index.find(&format!("href=\"{name}.html\"")).expect("every case is in the index");
    assert!(place("silo_discharge") < place("dam_break") && place("dam_break") < place("normal_contact"));
    assert!(index.contains("1 of 3 cases does not meet all expectations."));
    let silo = page(&files, "silo_discharge.html");
    assert!(silo.contains("1 of 3 claims is not met.") && silo.contains("2.5 times larger than allowed"));
    let first_claim = silo.split("<table class=\"claims cards\">").nth(1).and_then(|table| table.split("<tr").nth(2));
    assert!(first_claim.is_some_and(|claim| claim.starts_with(" class=\"red\"") && claim.contains("not met")));
}

#[test]
fn each_kind_of_expectation_has_its_verdict() {
    let plain = || row("silo_discharge", "s", 10.0, "median", 0.1);
    let verdicts = [
        (claim(plain(), 0.2, Expectation::Holds), Verdict::Met, "✓ met"),
        (claim(plain(), 0.05, Expectation::Holds), Verdict::NotMet, "✕ not met"),
        (claim(plain(), 0.05, Expectation::KnownLimit), Verdict::Met, "✓ known limit"),
        (claim(plain(), 0.2, Expectation::KnownLimit), Verdict::UnexpectedPass, "! unexpected pass"),
        (claim(plain(), 0.05, Expectation::SourceError), Verdict::Met, "✓ fails as it must"),
        (claim(plain(), 0.2, Expectation::SourceError), Verdict::NotMet, "✕ passes but must fail"),
        (failed(claim(plain(), 0.2, Expectation::Holds), "blew up"), Verdict::NotMet, "✕ not met"),
    ];
    for (row, verdict, words) in verdicts {
        assert_eq!(row.verdict(), verdict);
        let red = verdict == Verdict::NotMet;
        let case = CaseResults { rows: vec![row], ..red_case() };
        assert_eq!(verdict_line(&case).contains("NOT MET"), red);
        assert!(page_of(case).contains(words), "{words}");
    }
}

#[test]
fn the_numbers_overrule_a_flag() {
    let mut row = claim(row("c", "s", 10.0, "median", 0.1), 0.05, Expectation::Holds);
    row.pass = Some(true);
    assert_eq!(row.verdict(), Verdict::NotMet);
    row.error = Some(0.01);
    row.failed = Some("stopped by a guard".into());
    row.pass = None;
    assert_eq!(row.verdict(), Verdict::NotMet);
}

#[test]
fn a_failed_run_stays_on_the_page_with_its_reason() {
    let files = site();
    let contact = page(&files, "normal_contact.html");
    assert!(contact.matches("the sphere stuck to the wall").count() >= 2);
    assert!(contact.contains("1 run failed."));
    assert!(contact.contains("stroke=\"var(--bad)\""), "a cross stands in the plot");
}

#[test]
fn missing_pieces_are_said_and_other_codes_do_not_decide() {
    let files = site();
    let empty = page(&files, "dam_break.html");
    assert!(page(&files, "normal_contact.html").contains("normal_contact/lost.csv (missing)"));
    for words in ["There is no result yet", "This case has no picture", "Not drawn:", "There are no rows."] {
        assert!(empty.contains(words), "{words}");
    }
    let contact = page(&files, "normal_contact.html");
    assert!(contact.contains("othercode 2024.1") && contact.contains("All 26 claims are met."));
}

#[test]
fn the_change_since_the_last_release_is_shown() {
    let files = site();
    assert!(page(&files, "normal_contact.html").contains("<span class=\"better\"><span aria-hidden=\"true\">↓</span>"));
    assert!(page(&files, "silo_discharge.html").contains("no earlier row to compare with"));
}

#[test]
fn cost_to_a_target_is_the_number_computed_by_hand() {
    // Second order between 4e-2 at 1 s and 2.5e-3 at 4 s: one percent costs exactly 2 s.
    let rows = [(10.0, 4e-2, 1.0), (20.0, 2.5e-3, 4.0)].map(|(knob, error, seconds)| {
        let mut row = row("silo_discharge", &red_case().card.headline.setup, knob, "median", error);
        row.cost.cpu_s = Some(seconds * 200.0);
        row.cost.cpu_s_range = None;
        row
    });
    let case = CaseResults { rows: rows.to_vec(), ..red_case() };
    let html = page_of(case);
    let line = html.split("cost to 0.1\u{a0}%").nth(1).and_then(|table| table.split("</tr>").nth(2));
    let line = line.expect("the second setup's line of the cost table");
    for words in ["≤ 1.0\u{a0}s", "coarsest run", "class=\"best\">2.0\u{a0}s<", "not reached"] {
        assert!(line.contains(words), "{words} is not in {line}");
    }
    assert!(html.contains("<span class=\"big\">2.0\u{a0}s</span>"), "the head quotes it too");
}

#[test]
fn text_from_rows_and_cards_is_escaped() {
    let mut case = good_case();
    let evil = "<script>alert('x')</script>&";
    for row in &mut case.rows {
        row.setup = evil.into();
        row.statistic = format!("median {evil}");
        row.machine = evil.into();
    }
    case.card.title = evil.into();
    case.card.headline.setup = evil.into();
    case.card.plots.iter_mut().for_each(|plot| {
        if let reports::card::Plot::Convergence { setups, title, knob_label, .. } = plot {
            *setups = vec![evil.into()];
            *title = evil.into();
            *knob_label = evil.into();
        }
    });
    case.card.equations[0].latex = format!(r"\text{{{evil}}}");
    case.card.picture.items.push(reports::card::PictureItem::Label { at: [0.0, 0.0], text: evil.into() });
    let html = page_of(case);
    assert!(!html.contains("<script>alert"));
    assert!(html.contains("&lt;script&gt;alert"));
    assert_eq!(unbalanced_tag(&html), None);
}

#[test]
fn every_link_has_a_target() {
    let files = site();
    let paths: BTreeSet<&str> = files.iter().map(|file| file.path.as_str()).collect();
    for file in files.iter().filter(|file| file.path.ends_with(".html")) {
        let ids = attributes(&file.content, "id");
        let unique: BTreeSet<&str> = ids.iter().copied().collect();
        assert_eq!(ids.len(), unique.len(), "an id occurs twice in {}", file.path);
        for href in attributes(&file.content, "href") {
            match href.strip_prefix('#') {
                Some(anchor) => assert!(unique.contains(anchor), "{}: no target for #{anchor}", file.path),
                None if href.starts_with("https://") || href == "data:," => {}
                None => assert!(paths.contains(href), "{}: no file {href}", file.path),
            }
        }
    }
}

#[test]
fn pages_are_small_balanced_and_load_nothing() {
    for file in site().iter().filter(|file| file.path.ends_with(".html")) {
        assert!(file.content.len() < 1_000_000, "{} has {} bytes", file.path, file.content.len());
        assert_eq!(loaded_resources(&file.content), ["data:,"], "{}", file.path);
        assert_eq!(unbalanced_tag(&file.content), None, "{}", file.path);
        let body = file.content.split("<script>").next().unwrap_or_default();
        assert!(!body.contains("NaN") && !body.contains(">inf<"), "{}", file.path);
    }
}

#[test]
fn a_case_with_very_many_rows_stays_below_a_megabyte() {
    let mut case = red_case();
    case.rows = (0..3000).map(|i| row("silo_discharge", &format!("setup {i}"), 10.0, "median", 0.1)).collect();
    case.rows.push(claim(row("silo_discharge", "the claim", 10.0, "median", 0.1), 0.2, Expectation::Holds));
    let html = page_of(case);
    assert!(html.len() < 1_000_000, "{}", html.len());
    assert!(html.contains("rows without a claim are in that file only"));
    assert!(html.contains("\"setup\":\"the claim\""), "claims keep their JSON");
}

#[test]
fn drawings_carry_their_numbers_as_text() {
    let files = site();
    let contact = page(&files, "normal_contact.html");
    let drawings = contact.matches("<svg").count();
    assert_eq!(drawings, contact.matches("role=\"img\"").count());
    assert!(contact.contains("1.4e-4 at 80,"));
}

#[test]
fn names_that_cannot_be_files_are_refused() {
    let with = |change: fn(&mut CaseResults)| {
        let mut case = good_case();
        change(&mut case);
        render(&Results { cases: vec![case], scene_keys: Vec::new() }, &meta()).expect_err("a bad name")
    };
    assert!(matches!(with(|case| case.card.case = "../up".into()), RenderError::CaseName { .. }));
    assert!(matches!(with(|case| case.card.case = "index".into()), RenderError::CaseName { .. }));
    assert!(matches!(with(|case| case.rows[4].case = "other".into()), RenderError::ForeignRow { line: 5, .. }));
    for path in ["normal_contact/../x", "/etc/x", "other/x.csv", "normal_contact"] {
        let mut case = good_case();
        case.data[0].path = path.into();
        let error = render(&Results { cases: vec![case], scene_keys: Vec::new() }, &meta()).expect_err("a bad path");
        assert!(matches!(error, RenderError::DataPath { .. }), "{path}");
    }
    let twice = Results { cases: vec![good_case(), good_case()], scene_keys: Vec::new() };
    assert!(matches!(render(&twice, &meta()), Err(RenderError::CaseTwice { .. })));
}

#[test]
fn the_crate_metadata_lists_every_file_with_its_checksum() {
    let files = site();
    let metadata: serde_json::Value = serde_json::from_str(page(&files, "ro-crate-metadata.json")).expect("JSON");
    let graph = metadata["@graph"].as_array().expect("a graph");
    for file in files.iter().filter(|file| file.path != "ro-crate-metadata.json") {
        let entry = graph.iter().find(|entry| entry["@id"] == file.path.as_str()).expect("an entry");
        assert_eq!(entry["contentSize"], file.content.len().to_string());
        assert_eq!(entry["sha256"].as_str().map(str::len), Some(64));
    }
}

/// Bars are drawn with their names and told in a table; a page that a bench makes names the bench.
#[test]
fn bars_and_benches_are_told() {
    let html = page_of(good_case());
    assert!(html.contains("wall as plate") && html.contains("yes: to the bit") && html.contains("1.240"), "the bars and their table");
    assert!(html.contains("touchstone run normal_contact"));
    let mut case = good_case();
    case.card.command = Some("cargo bench --bench ablation".into());
    let html = page_of(case);
    assert!(html.contains("cargo bench --bench ablation") && !html.contains("touchstone run normal_contact"));
}
