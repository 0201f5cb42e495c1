//! `touchstone scene`: what it writes, resuming, overwriting, guards.

use std::fs;
use std::path::{Path, PathBuf};

use super::{SCENE, contents, folder, names, touchstone, write};

fn assert_same_folders(one: &Path, other: &Path) {
    let (one, other) = (contents(one), contents(other));
    let names = |files: &[(PathBuf, Vec<u8>)]| files.iter().map(|(path, _)| path.clone()).collect::<Vec<_>>();
    assert_eq!(names(&one), names(&other));
    for ((path, left), (_, right)) in one.iter().zip(&other) {
        assert!(left == right, "{} differs", path.display());
    }
}

/// A run that is broken off and resumed leaves bitwise the files of one that was not, wherever it was broken off.
#[test]
fn a_resumed_run_leaves_the_same_files() {
    let folder = folder();
    let path = folder.path();
    write(path, "whole.toml", SCENE);
    assert_eq!(touchstone(path, &["scene", "whole.toml", "--out", "whole"]).code, 0);
    // One break in free flight, one during the first contact, one on a due output.
    for end in ["0.1234", "0.3135", "0.2"] {
        write(path, "part.toml", &SCENE.replace("0.35", end));
        assert_eq!(touchstone(path, &["scene", "part.toml", "--out", "part"]).code, 0);
        let done = touchstone(path, &["scene", "whole.toml", "--out", "part", "--resume"]);
        assert_eq!(done.code, 0, "{}", done.stderr);
        assert_same_folders(&path.join("whole"), &path.join("part"));
        fs::remove_dir_all(path.join("part")).expect("the folder goes");
    }
}

/// The same with bodies that come and leave while snapshots are written: broken off while some come, at rest, and while some leave.
#[test]
fn a_resumed_run_whose_bodies_come_and_go_leaves_the_same_files() {
    let folder = folder();
    let path = folder.path();
    let scene = include_str!("../../../scenes/hopper.toml").replace("probe_interval = 0.01", "probe_interval = 0.01\nvtk_interval = 0.1");
    write(path, "whole.toml", &scene);
    assert_eq!(touchstone(path, &["scene", "whole.toml", "--out", "whole"]).code, 0);
    for end in ["0.0501", "0.45", "0.5703"] {
        write(path, "part.toml", &scene.replace("end_time = 1.0", &format!("end_time = {end}")));
        assert_eq!(touchstone(path, &["scene", "part.toml", "--out", "part"]).code, 0);
        let done = touchstone(path, &["scene", "whole.toml", "--out", "part", "--resume"]);
        assert_eq!(done.code, 0, "{}", done.stderr);
        assert_same_folders(&path.join("whole"), &path.join("part"));
        fs::remove_dir_all(path.join("part")).expect("the folder goes");
    }
    let departures = fs::read_to_string(path.join("whole/departures.csv")).expect("bodies have left");
    let lines: Vec<&str> = departures.lines().collect();
    assert_eq!(lines[..2], ["id,outlet,time,mass", "1,1,s,kg"]);
    assert_eq!(lines.len(), 22, "all twenty have left");
    let rows = fs::read_to_string(path.join("whole/probes.csv")).expect("rows");
    assert!(rows.starts_with("time,bodies,bodies_left,mass_left,root_mean_square_speed\ns,1,1,kg,m/s\n"));
    assert!(
        rows.lines().last().is_some_and(|row| row.starts_with("1.0") && row.contains(",0,20,") && row.ends_with(",0")),
        "{:?}",
        rows.lines().last()
    );
}

/// The same with a fluid: broken off in the middle of one of its steps too.
#[test]
fn a_resumed_run_in_a_fluid_leaves_the_same_files() {
    let folder = folder();
    let path = folder.path();
    let scene = include_str!("../../../scenes/balls_in_oil.toml").replace("end_time = 0.15", "end_time = 0.02");
    let scene = scene.replace("probe_interval = 0.001", "probe_interval = 0.001\nvtk_interval = 0.01");
    write(path, "whole.toml", &scene);
    assert_eq!(touchstone(path, &["scene", "whole.toml", "--out", "whole"]).code, 0);
    for end in ["0.0102", "0.005"] {
        write(path, "part.toml", &scene.replace("end_time = 0.02", &format!("end_time = {end}")));
        assert_eq!(touchstone(path, &["scene", "part.toml", "--out", "part"]).code, 0);
        let done = touchstone(path, &["scene", "whole.toml", "--out", "part", "--resume"]);
        assert_eq!(done.code, 0, "{}", done.stderr);
        assert_same_folders(&path.join("whole"), &path.join("part"));
        fs::remove_dir_all(path.join("part")).expect("the folder goes");
    }
    let flow = fs::read_to_string(path.join("whole/flow.pvd")).expect("a list of snapshots");
    let last = flow.split("timestep=\"0.02\" file=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("the last snapshot");
    let text = fs::read_to_string(path.join("whole").join(last)).expect("the fluid");
    assert!(text.contains("WholeExtent=\"0 16 0 16 0 32\"") && text.contains("Name=\"pressure\""));
}

/// A body that comes to a wall without a contact there stops the run, and says so.
#[test]
fn a_flow_that_cannot_go_on_is_stopped_by_a_guard() {
    let folder = folder();
    let path = folder.path();
    let scene =
        include_str!("../../../scenes/balls_in_oil.toml").replace("position = [0.006, 0.006, 0.013]", "position = [0.006, 0.006, 0.0035]");
    let at_ceiling = "plane = { point = [0.0, 0.0, 0.024], normal = [0.0, 0.0, -1.0] }";
    write(path, "through.toml", &scene.replace("plane = { point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] }", at_ceiling));
    let done = touchstone(path, &["scene", "through.toml", "--out", "out"]);
    assert_eq!(done.code, 3, "{}", done.stderr);
    assert!(done.stderr.contains("body 0 reaches through the wall across direction 2"), "{}", done.stderr);
}

/// A run that ends at rest says so; with another criterion it goes on.
#[test]
fn a_run_ends_at_rest_and_goes_on_without_the_criterion() {
    let folder = folder();
    let path = folder.path();
    let scene =
        include_str!("../../../scenes/hopper.toml").replace("random_seed = 7", "random_seed = 7\nsettled = { speed = 5e-3, hold = 0.03 }");
    write(path, "rest.toml", &scene);
    let done = touchstone(path, &["scene", "rest.toml", "--out", "out", "--json"]);
    let summary: serde_json::Value = serde_json::from_str(&done.stdout).expect("the summary is JSON");
    assert!(summary["settled"] == true && summary["time"].as_f64() < Some(0.5), "{summary}");
    write(path, "on.toml", include_str!("../../../scenes/hopper.toml"));
    let done = touchstone(path, &["scene", "on.toml", "--out", "out", "--resume", "--json"]);
    let summary: serde_json::Value = serde_json::from_str(&done.stdout).expect("the summary is JSON");
    assert!(summary["settled"] == false && summary["time"].as_f64() >= Some(1.0), "{summary}");
}

/// A run that was killed after a checkpoint: later rows and snapshots are there already, the last row cut off.
#[test]
fn what_lies_after_the_checkpoint_is_taken_away_on_resuming() {
    let folder = folder();
    let path = folder.path();
    write(path, "whole.toml", SCENE);
    write(path, "part.toml", &SCENE.replace("0.35", "0.1234"));
    assert_eq!(touchstone(path, &["scene", "whole.toml", "--out", "whole"]).code, 0);
    assert_eq!(touchstone(path, &["scene", "whole.toml", "--out", "killed"]).code, 0);
    assert_eq!(touchstone(path, &["scene", "part.toml", "--out", "part"]).code, 0);
    fs::copy(path.join("part/checkpoint.json"), path.join("killed/checkpoint.json")).expect("the older checkpoint");
    let rows = fs::read_to_string(path.join("killed/probes.csv")).expect("rows");
    write(path, "killed/probes.csv", &rows[..rows.len() - 17]);
    assert_eq!(touchstone(path, &["scene", "whole.toml", "--out", "killed", "--resume"]).code, 0);
    assert_same_folders(&path.join("whole"), &path.join("killed"));
}

#[test]
fn a_former_run_can_be_overwritten_and_only_whole() {
    let folder = folder();
    let path = folder.path();
    write(path, "long.toml", SCENE);
    write(path, "short.toml", &SCENE.replace("0.35", "0.01"));
    for out in ["out", "fresh"] {
        assert_eq!(touchstone(path, &["scene", "short.toml", "--out", out]).code, 0);
    }
    assert_eq!(touchstone(path, &["scene", "long.toml", "--out", "out", "--overwrite"]).code, 0);
    assert_eq!(touchstone(path, &["scene", "short.toml", "--out", "out", "--overwrite"]).code, 0);
    assert_same_folders(&path.join("out"), &path.join("fresh"));
    assert_eq!(names(path), ["fresh", "long.toml", "out", "short.toml"], "nothing is left beside");
}

/// A run that blows up ends with exit code 3 and keeps its rows, all of them finite numbers.
#[test]
fn a_blown_up_run_keeps_its_rows() {
    let folder = folder();
    let fast = SCENE.replace("velocity = [0.3, 0.0, 0.0]", "velocity = [6e153, 0.0, 0.0]").replace("end_time = 0.35", "end_time = 10.0");
    write(folder.path(), "fast.toml", &fast);
    let done = touchstone(folder.path(), &["scene", "fast.toml", "--out", "out"]);
    assert_eq!(done.code, 3, "{}", done.stderr);
    assert!(done.stderr.contains("error: body 0 has left the finite numbers") && done.stderr.contains("`out`"), "{}", done.stderr);
    let rows = fs::read_to_string(folder.path().join("out/probes.csv")).expect("the rows are kept");
    assert!(rows.ends_with('\n') && rows.lines().count() > 100);
    assert!(folder.path().join("out/ledger.json").is_file());
}

#[test]
fn every_example_scene_runs_and_is_commented() {
    let folder = folder();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    for name in names(&scenes) {
        let file = scenes.join(&name);
        let done = touchstone(folder.path(), &["scene", &file.to_string_lossy(), "--out", &name, "--json"]);
        assert_eq!(done.code, 0, "{name}: {}", done.stderr);
        let summary: serde_json::Value = serde_json::from_str(&done.stdout).expect("the summary is JSON");
        assert!(summary["steps"].as_u64() > Some(100) && summary["ledger"].is_array(), "{summary}");
        let text = fs::read_to_string(&file).expect("a scene");
        assert!(text.lines().filter(|line| line.starts_with('#')).count() >= 8, "{name} explains too little");
    }
}

#[test]
fn the_reference_of_keys_is_printed_and_its_schema_is_json() {
    let folder = folder();
    let text = touchstone(folder.path(), &["scene", "--keys"]);
    assert_eq!(text.code, 0);
    for part in ["[scene]", "[[body]]", "end_time", "required", "default \"zero_overlap\""] {
        assert!(text.stdout.contains(part), "`{part}` is missing");
    }
    let schema = touchstone(folder.path(), &["scene", "--keys", "--json"]);
    let schema: serde_json::Value = serde_json::from_str(&schema.stdout).expect("the schema is JSON");
    assert!(schema["properties"]["body"].is_object());
}
