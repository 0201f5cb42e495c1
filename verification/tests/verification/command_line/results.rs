//! `touchstone run`, `list`, `report`, `export` and `compare`: rows on disk, pages, verdicts.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

use serde_json::Value;
use tempfile::TempDir;
use verification::CASES;

use super::{Done, contents, folder, names, touchstone, touchstone_within, write};

const PLACES: [&str; 4] = ["--results", "results", "--site", "site"];

/// The command with results and site in the current folder.
fn at_places(folder: &Path, arguments: &[&str]) -> Done {
    touchstone(folder, &[arguments, &PLACES].concat())
}

/// A folder with the results of one case, made once and copied for each test.
fn with_results() -> TempDir {
    static ORIGINAL: OnceLock<TempDir> = OnceLock::new();
    let original = ORIGINAL.get_or_init(|| {
        let made = folder();
        let done = at_places(made.path(), &["run", "normal_contact", "--seed", "3"]);
        assert_eq!(done.code, 0, "{}{}", done.stdout, done.stderr);
        assert!(done.stdout.starts_with("normal_contact  met ") && done.stdout.contains("site: site/index.html"), "{}", done.stdout);
        made
    });
    let copy = folder();
    for (path, bytes) in contents(original.path()) {
        let target = copy.path().join(path);
        fs::create_dir_all(target.parent().expect("a file lies in a folder")).expect("a folder");
        fs::write(target, bytes).expect("a file is copied");
    }
    copy
}

fn text(path: PathBuf) -> String {
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn a_run_leaves_rows_card_curves_and_pages() {
    let folder = with_results();
    let path = folder.path();
    let rows = reports::read_rows(&text(path.join("results/normal_contact.jsonl"))).expect("rows");
    assert!(rows.iter().all(|row| row.random_seed == 3 && row.tier == "quick" && row.commit == "unknown" && row.machine.contains("cores")));
    assert!(rows.iter().any(|row| row.cost.cpu_s > Some(0.0)), "costs are measured");
    assert_eq!(names(&path.join("results/normal_contact")), ["card.json", "timing.csv"]);
    for page in ["index.html", "normal_contact.html", "scene-keys.html"] {
        assert!(text(path.join("site").join(page)).contains("</html>"), "{page}");
    }
    let list = at_places(path, &["list", "--json"]);
    let list: Value = serde_json::from_str(&list.stdout).expect("the list is JSON");
    let entry = list.as_array().and_then(|list| list.iter().find(|entry| entry["id"] == "normal_contact")).expect("the case is listed");
    assert_eq!((&entry["status"]["state"], &entry["status"]["tier"]), (&"met".into(), &"quick".into()));
    assert!(at_places(path, &["list"]).stdout.contains("(quick)"));
    assert!(touchstone(path, &["list"]).stdout.contains("not run"), "outside a checkout nothing has been run");
}

/// The same rows give the same bytes.
#[test]
fn rendering_twice_changes_nothing() {
    let folder = with_results();
    let before = contents(folder.path());
    let done = at_places(folder.path(), &["report"]);
    assert_eq!(done.code, 0, "{}", done.stderr);
    assert!(contents(folder.path()) == before);
}

#[test]
fn a_claim_that_is_not_met_is_exit_code_one() {
    let folder = with_results();
    let file = folder.path().join("results/normal_contact.jsonl");
    let mut rows = reports::read_rows(&text(file.clone())).expect("rows");
    let claimed = rows.iter_mut().find(|row| row.pass == Some(true)).expect("a claim that holds");
    claimed.pass = Some(false);
    fs::write(&file, reports::write_rows(&rows)).expect("rows are written");
    let done = at_places(folder.path(), &["report"]);
    assert_eq!(done.code, 1, "{}", done.stderr);
    assert!(done.stdout.contains("NOT MET"), "{}", done.stdout);
    assert!(at_places(folder.path(), &["list"]).stdout.contains("RED"));
}

#[test]
fn rows_that_cannot_be_read_are_named_with_their_line() {
    let folder = with_results();
    let file = folder.path().join("results/normal_contact.jsonl");
    let good = text(file.clone());
    for (bad, wanted) in [
        (good.replacen("\"case\"", "\"caze\"", 1), "results/normal_contact.jsonl:1: not a result row"),
        (good.clone() + "{\"schema\":1", "not a result row"),
        (good.replacen("\"schema\":1", "\"schema\":99", 1), "schema 99"),
    ] {
        fs::write(&file, bad).expect("rows are written");
        for command in ["report", "list"] {
            let done = at_places(folder.path(), &[command]);
            assert_eq!(done.code, 2, "{command}: {}", done.stdout);
            assert!(done.stderr.contains(wanted), "{}", done.stderr);
        }
    }
    fs::write(&file, good).expect("rows are written");
    fs::remove_file(folder.path().join("results/normal_contact/card.json")).expect("the card goes");
    let done = at_places(folder.path(), &["report"]);
    assert!(
        done.code == 2 && done.stderr.contains("card.json") && done.stderr.contains("touchstone run normal_contact"),
        "{}",
        done.stderr
    );
}

/// One point is run again with another seed: its rows are new, all others are as they were, and no claim is lost.
#[test]
fn a_point_of_a_case_can_be_run_alone() {
    let folder = with_results();
    let file = folder.path().join("results/normal_contact.jsonl");
    let before = reports::read_rows(&text(file.clone())).expect("rows");
    let (setup, knob) = ("e=0.85, until zero overlap, centred damping, resolved edges", 50.0);
    let missing = reports::Row { setup: setup.into(), knob: None, failed: Some("not made".into()), ..before[0].clone() };
    fs::write(&file, reports::write_rows(&[before.clone(), vec![missing]].concat())).expect("rows are written");
    let arguments = ["run", "normal_contact", "--seed", "4", "--setup", &format!("^{setup}$"), "--knob", "50"];
    let done = at_places(folder.path(), &arguments);
    assert_eq!(done.code, 0, "{}{}", done.stdout, done.stderr);
    let after = reports::read_rows(&text(file)).expect("rows");
    assert_eq!(after.len(), before.len(), "nothing but what was missing goes");
    let is_of_the_point = |row: &&reports::Row| row.setup == setup && row.knob.as_ref().is_some_and(|at| at.value == knob);
    let (renewed, others): (Vec<_>, Vec<_>) = after.iter().partition(is_of_the_point);
    assert!(renewed.len() == 6 && renewed.iter().all(|row| row.random_seed == 4) && renewed.iter().any(|row| row.pass == Some(true)));
    assert!(others.into_iter().eq(before.iter().filter(|row| !is_of_the_point(row))), "rows of other points have changed");
}

#[test]
fn points_that_are_not_there_are_refused_before_anything_runs() {
    let folder = folder();
    for (arguments, wanted) in [
        (["--setup", "e=0.7"], "`e=0.5, until zero overlap, lagged damping, sampled edges` at [5.0, 10.0"),
        (["--knob", "51"], "leave nothing of `normal_contact` at the quick tier"),
        (["--setup", "e=(0.5"], "is not a regular expression"),
        (["--knob", "fifty"], "invalid value 'fifty'"),
    ] {
        let done = at_places(folder.path(), &[&["run", "normal_contact"], &arguments[..]].concat());
        assert!(done.code == 2 && done.stderr.contains(wanted), "{arguments:?}: {}", done.stderr);
        assert!(!folder.path().join("results").exists(), "{arguments:?}");
    }
}

/// Rows without what depends on the machine: times, and the row that holds the case's time against its budget.
fn without_times(rows: &str) -> Vec<Value> {
    let mut kept = Vec::new();
    for line in rows.lines() {
        let mut row: Value = serde_json::from_str(line).expect("a row is JSON");
        for time in ["cpu_s", "cpu_s_range", "rounds", "reference_kernels", "wall_s"] {
            row["cost"].as_object_mut().expect("cost is an object").remove(time);
        }
        if row["quantity"] != "cpu time of the case" {
            kept.push(row);
        }
    }
    kept
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let identifiers: Vec<&str> = CASES.iter().take(2).map(|case| case.description().id).collect();
    let pattern = format!("^({})$", identifiers.join("|"));
    let [one, two] = ["1", "2"].map(|threads| {
        let folder = folder();
        let arguments = ["run", &pattern, "--threads", threads, "--json"];
        let done = touchstone_within(Duration::from_secs(120), folder.path(), &[&arguments[..], &PLACES].concat());
        assert_ne!(done.code, 2, "{}", done.stderr);
        let verdicts: Value = serde_json::from_str(&done.stdout).expect("the verdicts are JSON");
        assert_eq!(verdicts.as_array().map(Vec::len), Some(identifiers.len()));
        folder
    });
    for identifier in identifiers {
        let rows = |folder: &TempDir| without_times(&text(folder.path().join(format!("results/{identifier}.jsonl"))));
        assert!(rows(&one) == rows(&two), "{identifier} depends on the number of threads");
        let curves = |folder: &TempDir| {
            let files = contents(&folder.path().join("results").join(identifier));
            files.into_iter().filter(|(path, _)| !path.ends_with("timing.csv")).collect::<Vec<_>>()
        };
        assert!(curves(&one) == curves(&two), "curves of {identifier} depend on the number of threads");
    }
}

/// The places are found from anywhere inside a checkout.
#[test]
fn the_checkout_is_found_from_inside() {
    let folder = folder();
    let inside = folder.path().join("solver/src");
    fs::create_dir_all(&inside).expect("a folder");
    fs::create_dir_all(folder.path().join("reports")).expect("a folder");
    write(folder.path(), "Cargo.toml", "");
    let done = touchstone(&inside, &["report"]);
    assert!(done.code == 2 && done.stderr.contains("reports/results`"), "{}", done.stderr);
}

/// Lines of an exported template with the expected value filled in, times a factor.
fn filled_template(exported: &Path, factor: f64) -> String {
    let mut expected = csv::Reader::from_path(exported.join("expected.csv")).expect("the expected values");
    let mut writer = csv::Writer::from_writer(Vec::new());
    let template = text(exported.join("template.csv"));
    writer.write_record(template.lines().next().expect("a header").split(',')).expect("a header is written");
    for line in expected.records() {
        let line = line.expect("a line");
        let value: f64 = line[5].parse().expect("an expected value");
        let value = (value * factor).to_string();
        writer.write_record([&line[0], &line[1], &line[2], &line[3], &line[4], &value, "", "Other Code", "2.1"]).expect("a line");
    }
    String::from_utf8(writer.into_inner().expect("a table")).expect("text")
}

#[test]
fn another_code_comes_back_with_an_exported_case() {
    let folder = with_results();
    let path = folder.path();
    assert_eq!(touchstone(path, &["export", "normal_contact", "--out", "exported"]).code, 0);
    let exported = path.join("exported");
    for name in ["README.md", "expected.csv", "parameters.csv", "template.csv"] {
        assert!(exported.join(name).is_file(), "{name}");
    }
    let scene = names(&exported).into_iter().find(|name| name.starts_with("00_")).expect("a folder of the first setup");
    assert!(exported.join(&scene).join("bodies.csv").is_file());
    let scene = format!("exported/{scene}/scene.toml");
    assert_eq!(touchstone(path, &["scene", &scene, "--out", "out"]).code, 0, "an exported scene can be run");

    let empty = at_places(path, &["compare", "normal_contact", "exported/template.csv"]);
    assert!(empty.code == 2 && empty.stderr.contains("no line has a value"), "{}", empty.stderr);
    write(path, "perfect.csv", &filled_template(&exported, 1.0));
    let done = at_places(path, &["compare", "normal_contact", "perfect.csv"]);
    assert_eq!(done.code, 0, "{}", done.stderr);
    assert!(done.stdout.contains("Other Code 2.1: restitution") && done.stdout.contains(" met"), "{}", done.stdout);
    assert!(text(path.join("site/normal_contact.html")).contains("Other Code"), "it is on the page");
    let rows = reports::read_rows(&text(path.join("results/normal_contact/compared_other_code.jsonl"))).expect("rows");
    assert!(rows.iter().all(|row| row.code == "Other Code" && row.version == "2.1"));
    write(path, "wrong.csv", &filled_template(&exported, 1.5));
    let done = at_places(path, &["compare", "normal_contact", "wrong.csv", "--json"]);
    assert_eq!(done.code, 1, "{}", done.stderr);
    assert!(serde_json::from_str::<Value>(&done.stdout).is_ok_and(|rows| rows.is_array()));
    assert_eq!(at_places(path, &["report"]).code, 0, "another code does not turn our own case red");
}

/// A table that stands beside the results is on the page of every run; what is brought in takes its place, and a wrong one stops the run.
#[test]
fn kept_tables_of_other_codes_are_on_the_page() {
    let folder = folder();
    let path = folder.path();
    let header = "setup,quantity,unit,knob_name,knob_value,value,cpu_s,code,version";
    let case = CASES.iter().find(|case| case.description().id == "errata_s").map(|case| case.description());
    let case = case.expect("the case");
    let (setup, knob) = (&case.setups[0], (case.knob.values)(verification::Tier::Quick, &case.setups[0])[0]);
    let quantities = CASES.iter().find(|case| case.description().id == "errata_s").map(|case| case.evaluate(setup, knob, 1));
    let quantity = &quantities.expect("the case").expect("it runs").quantities[0];
    let line = |version: &str| {
        let (name, unit, knob_name) = (quantity.name, quantity.unit, (case.knob.name)(setup));
        format!("{header}\n\"{}\",\"{name}\",{unit},{knob_name},{knob},{},1e-3,Kept Code,{version}\n", setup.label, quantity.expected)
    };
    fs::create_dir(path.join("other_codes")).expect("a folder");
    write(path, "other_codes/errata_s.csv", &line("kept"));
    assert_eq!(at_places(path, &["run", "errata_s"]).code, 0);
    let page = || text(path.join("site/errata_s.html"));
    assert!(page().contains("Kept Code") && page().contains("kept"), "it is on the page");
    assert!(names(&path.join("results/errata_s")).contains(&"kept_kept_code.jsonl".to_string()));
    write(path, "brought.csv", &line("brought"));
    let done = at_places(path, &["compare", "errata_s", "brought.csv"]);
    assert!(done.code < 2 && page().contains("Kept Code brought") && !page().contains("Kept Code kept"), "{}", done.stderr);
    write(path, "other_codes/errata_s.csv", "setup\n");
    let done = at_places(path, &["run", "errata_s"]);
    assert!(done.code == 2 && done.stderr.contains("errata_s.csv:1"), "{}", done.stderr);
}

#[test]
fn bad_tables_of_other_codes_are_refused() {
    let folder = with_results();
    let path = folder.path();
    let header = "setup,quantity,unit,knob_name,knob_value,value,cpu_s,code,version";
    let case = CASES.iter().find(|case| case.description().id == "normal_contact").expect("the case");
    let setup = format!("\"{}\"", case.description().setups[0].label);
    let good = format!("{setup},restitution,1,steps_per_contact,50,0.5,,Other,1");
    let table = |line: &str| format!("{header}\n{line}\n");
    let change = |from: &str, to: &str| table(&good.replacen(from, to, 1));
    let rows: &[(&str, String, &[&str])] = &[
        ("empty file", String::new(), &["table.csv", "the file is empty", header]),
        ("wrong header", good.clone(), &["table.csv:1", "the header is", header]),
        ("columns swapped", format!("{}\n{good}\n", header.replace("value,cpu_s", "cpu_s,value")), &["table.csv:1", "the header is"]),
        ("header only", format!("{header}\n"), &["no line has a value"]),
        ("too few columns", table("a,b,c"), &["table.csv:2", "3 columns instead of 9"]),
        ("unknown setup", change(&setup, "\"e=0.5, until zero overlap\""), &["table.csv:2", "`setup`", "the nearest is `e=0.5"]),
        (
            "unknown quantity",
            change("restitution", "restitutin"),
            &["table.csv:2", "`quantity`", "`restitutin`", "the nearest is `restitution`"],
        ),
        ("other unit", change(",1,steps", ",m,steps"), &["table.csv:2", "`unit`", "`m`", "has it in `1`"]),
        ("unknown knob", change("steps_per_contact", "step"), &["table.csv:2", "`knob_name`", "`steps_per_contact`"]),
        ("unknown knob value", change(",50,", ",55,"), &["table.csv:2", "`knob_value`", "`55`", "the nearest is 50"]),
        ("knob not a number", change(",50,", ",many,"), &["table.csv:2", "`knob_value`", "`many`"]),
        ("value not a number", change(",0.5,,", ",nan,,"), &["table.csv:2", "`value`", "`nan`", "finite"]),
        ("infinite value", change(",0.5,,", ",inf,,"), &["table.csv:2", "`value`", "`inf`", "finite"]),
        ("value in words", change(",0.5,,", ",half,,"), &["table.csv:2", "`value`", "`half`", "a number is needed"]),
        ("negative time", change(",,Other", ",-1,Other"), &["table.csv:2", "`cpu_s`", "above zero"]),
        ("no code", change("Other", ""), &["table.csv:2", "`code`"]),
        ("our own name", change("Other", "Touchstone"), &["table.csv:2", "`code`", "`Touchstone`"]),
        ("given twice", format!("{}{good}\n", table(&good)), &["table.csv:3", "already in line 2"]),
        ("codes too alike", format!("{}{}\n", table(&good), good.replace("Other", "OTHER")), &["table.csv:3", "`code`", "too like"]),
    ];
    let results = contents(&path.join("results"));
    for (fault, table, wanted) in rows {
        write(path, "table.csv", table);
        let done = at_places(path, &["compare", "normal_contact", "table.csv"]);
        assert_eq!(done.code, 2, "{fault}: {}{}", done.stdout, done.stderr);
        for part in *wanted {
            assert!(done.stderr.contains(part), "{fault}: `{part}` is not in: {}", done.stderr);
        }
        assert!(contents(&path.join("results")) == results, "{fault} changed something");
    }
    fs::write(path.join("table.csv"), [0xff, 0xfe, 0x00]).expect("a file is written");
    for (file, wanted) in [("table.csv", "not text"), ("absent.csv", "cannot read `absent.csv`"), ("results", "it is a folder")] {
        let done = at_places(path, &["compare", "normal_contact", file]);
        assert!(done.code == 2 && done.stderr.contains(wanted), "{}", done.stderr);
    }
    let nothing_run = folder_without_results(path);
    let done = at_places(nothing_run.path(), &["compare", "normal_contact", "table.csv"]);
    assert!(done.code == 2 && done.stderr.contains("touchstone run normal_contact"), "{}", done.stderr);
}

fn folder_without_results(with_table: &Path) -> TempDir {
    let folder = folder();
    fs::copy(with_table.join("table.csv"), folder.path().join("table.csv")).expect("a file is copied");
    folder
}
