//! The binary `touchstone` as its users meet it: exit codes, messages, what is on disk afterwards.

mod bad_input;
mod results;
mod scene;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A ball above a floor, with marks that tests replace.
const SCENE: &str = "\
[scene]
name = \"test\"
gravity = [0.0, 0.0, -9.81]
end_time = 0.35

[[material]]
name = \"rubber\"
density = 1100.0

[[material]]
name = \"floor\"

[[pair]]
materials = [\"rubber\", \"floor\"]
normal = { linear_spring_dashpot = { stiffness = 1e4, restitution = 0.8 } }
tangential = { linear_history = { friction = 0.3, stiffness = 3e3 } }

[[shape]]
name = \"ball\"
geometry = { sphere = { radius = 0.02 } }

[[body]]
shape = \"ball\"
material = \"rubber\"
position = [0.0, 0.0, 0.5]
velocity = [0.3, 0.0, 0.0]

[[boundary]]
name = \"ground\"
material = \"floor\"
geometry = { plane = { point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] } }

[[probe]]
measure = \"position\"

[[probe]]
measure = \"total_energy\"

[output]
probe_interval = 0.0037
vtk_interval = 0.1
checkpoint_interval = 0.09
";

/// What a command did.
struct Done {
    code: i32,
    stdout: String,
    stderr: String,
}

/// Runs the binary in a folder; a run of more than ten seconds counts as hung.
fn touchstone(folder: &Path, arguments: &[&str]) -> Done {
    touchstone_within(Duration::from_secs(10), folder, arguments)
}

/// Runs the binary in a folder; a run of more than the patience counts as hung.
fn touchstone_within(patience: Duration, folder: &Path, arguments: &[&str]) -> Done {
    let (out, err) = (tempfile::tempfile().expect("a file"), tempfile::tempfile().expect("a file"));
    let (mut out_end, mut err_end) = (out.try_clone().expect("a handle"), err.try_clone().expect("a handle"));
    let mut child = Command::new(env!("CARGO_BIN_EXE_touchstone"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(out)
        .stderr(err)
        .spawn()
        .expect("the binary starts");
    let started = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("the binary can be waited for") {
            break status;
        }
        if started.elapsed() > patience {
            child.kill().expect("a hung binary can be stopped");
            panic!("touchstone {arguments:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let read = |file: &mut fs::File| {
        use std::io::{Read, Seek};
        let mut text = String::new();
        file.rewind().and_then(|()| file.read_to_string(&mut text)).expect("the output is text");
        text
    };
    Done { code: status.code().unwrap_or(-1), stdout: read(&mut out_end), stderr: read(&mut err_end) }
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn write(folder: &Path, name: &str, content: &str) {
    fs::write(folder.join(name), content).expect("a file is written");
}

/// Names in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Every file below a folder with its bytes, by path.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder is read") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(contents(&path).into_iter().map(|(inner, bytes)| (path.join(inner), bytes)));
        } else {
            found.push((path.clone(), fs::read(&path).expect("a file is read")));
        }
    }
    found.sort();
    found.into_iter().map(|(path, bytes)| (path.strip_prefix(folder).map(Path::to_path_buf).unwrap_or(path), bytes)).collect()
}

#[test]
fn every_command_has_help_with_examples() {
    let folder = folder();
    for command in [&[][..], &["list"], &["run"], &["scene"], &["export"], &["compare"], &["report"]] {
        let done = touchstone(folder.path(), &[command, &["--help"]].concat());
        assert_eq!(done.code, 0);
        assert!(done.stdout.contains("Examples:") && done.stdout.contains("touchstone "), "{command:?}: {}", done.stdout);
    }
}

/// A reader that goes away (`| head`) must not make the command panic.
#[test]
fn a_closed_pipe_is_no_panic() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_touchstone"))
        .args(["scene", "--keys"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the binary ends");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}
