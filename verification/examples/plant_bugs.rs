//! Plants every deliberate bug in a copy of the workspace, runs the tests there and prints what turned red.
//!
//! ```text
//! cargo run -p verification --example plant_bugs              all of them: about a minute each on two cores
//! cargo run -p verification --example plant_bugs -- torque    those whose name contains a word
//! cargo run -p verification --example plant_bugs -- --first   the cases only of bugs that the solver's own tests miss: a third of the time
//! cargo run -p verification --example plant_bugs -- --json    as JSON: name of the bug to list of tests
//! ```
//!
//! Exit code 1 if a bug survives.

use std::collections::BTreeMap;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode};
use std::time::{Duration, Instant};

use verification::mutants::{Mutant, all};

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let is_asked = |option: &str| arguments.iter().any(|argument| argument == option);
    let (as_json, only_first) = (is_asked("--json"), is_asked("--first"));
    let words: Vec<&String> = arguments.iter().filter(|argument| !argument.starts_with("--")).collect();
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?;
    let copy = workspace.join("target").join("planted");
    copy_sources(&workspace, &copy)?;
    let mut found = BTreeMap::new();
    for mutant in all().filter(|mutant| words.iter().all(|word| mutant.name.contains(word.as_str()))) {
        let red = plant_and_test(mutant, &workspace, &copy, only_first)?;
        eprintln!("{}  {}: {}", if red.is_empty() { "SURVIVES" } else { "caught  " }, mutant.name, red.join(", "));
        found.insert(mutant.name, red);
    }
    if as_json {
        println!("{}", serde_json::to_string_pretty(&found)?);
    }
    let survivors = found.values().filter(|red| red.is_empty()).count();
    eprintln!("{} of {} bugs caught", found.len() - survivors, found.len());
    Ok(if survivors == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Copies what git tracks or would track, into an empty folder: a file that has moved since must not stand there twice.
fn copy_sources(workspace: &Path, copy: &Path) -> Result<(), Box<dyn std::error::Error>> {
    if copy.exists() {
        std::fs::remove_dir_all(copy)?;
    }
    let listed = Command::new("git").args(["ls-files", "-co", "--exclude-standard"]).current_dir(workspace).output()?;
    for file in String::from_utf8(listed.stdout)?.lines() {
        let (from, to) = (workspace.join(file), copy.join(file));
        if !from.is_file() {
            continue;
        }
        std::fs::create_dir_all(to.parent().unwrap_or(copy))?;
        std::fs::copy(&from, &to)?;
    }
    Ok(())
}

fn plant_and_test(mutant: &Mutant, workspace: &Path, copy: &Path, only_first: bool) -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let place: PathBuf = copy.join(mutant.file);
    let source = std::fs::read_to_string(&place)?;
    if source.matches(mutant.original).count() != 1 {
        return Err(format!("{}: its text does not stand exactly once in {}", mutant.name, mutant.file).into());
    }
    std::fs::write(&place, source.replace(mutant.original, mutant.planted))?;
    let mut red = Ok(Vec::new());
    for package in ["solver", "verification"] {
        red = red.and_then(|red: Vec<String>| {
            let is_enough = only_first && !red.is_empty();
            Ok(if is_enough { red } else { [red, test(package, mutant, workspace, copy)?].concat() })
        });
    }
    std::fs::write(&place, source)?;
    red
}

/// Runs the tests of a package with the bug in its place: those that turned red.
fn test(package: &str, mutant: &Mutant, workspace: &Path, copy: &Path) -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let (output, errors) = (copy.join("tests.out"), copy.join("tests.err"));
    let tests = Command::new(env!("CARGO"))
        .process_group(0)
        .args(["test", "--lib", "--tests", "--no-fail-fast", "-p", package])
        .args(["--", "--skip", "command_line", "--skip", "mutants"])
        .current_dir(copy)
        // The same folder as the workspace: libraries are built once, only the planted crates anew.
        .env("CARGO_TARGET_DIR", workspace.join("target"))
        .env("PLANTED_BUG", mutant.name)
        .env("INSTA_UPDATE", "no")
        .stdout(std::fs::File::create(&output)?)
        .stderr(std::fs::File::create(&errors)?)
        .spawn();
    let ended = wait(tests?, LONGEST_TESTS)?;
    let text = std::fs::read_to_string(&output)?;
    if !text.contains("running") {
        return Err(format!("{}: the planted bug does not compile:\n{}", mutant.name, std::fs::read_to_string(&errors)?).into());
    }
    let failed = text.lines().filter_map(|line| line.strip_prefix("test ")?.strip_suffix(" ... FAILED"));
    let mut red: Vec<String> = failed.map(str::to_string).collect();
    if !ended {
        red.push("the tests do not end".into());
    }
    Ok(red)
}

/// A bug that makes steps very small lets tests run for ever.
const LONGEST_TESTS: Duration = Duration::from_secs(600);

/// Waits for a process to end, at most so long; then stops it and all that it has started.
fn wait(mut process: Child, longest: Duration) -> Result<bool, Box<dyn std::error::Error>> {
    let begin = Instant::now();
    while begin.elapsed() < longest {
        if process.try_wait()?.is_some() {
            return Ok(true);
        }
        std::thread::sleep(Duration::from_millis(200));
    }
    // Cargo passes an interrupt on to the tests it runs, a kill would leave them running.
    Command::new("kill").args(["-INT", &format!("-{}", process.id())]).status()?;
    process.wait()?;
    Ok(false)
}
