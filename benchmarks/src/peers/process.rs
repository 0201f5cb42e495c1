//! What a run of another program costs: CPU time of all its processes and threads, and wall time.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What a run costs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spent {
    /// CPU seconds, user and system; absent where the system does not tell.
    pub cpu_s: Option<f64>,
    /// Wall seconds.
    pub wall_s: f64,
}

impl Spent {
    /// What one run costs beyond another.
    pub fn less(&self, other: &Spent) -> Spent {
        let cpu_s = self.cpu_s.zip(other.cpu_s).map(|(one, other)| one - other);
        Spent { cpu_s, wall_s: self.wall_s - other.wall_s }
    }
}

/// How often a run is looked at that may have ended.
const LOOK: Duration = Duration::from_millis(2);

/// Runs a program in a folder of its own; what it printed comes back with its cost.
///
/// # Errors
///
/// Words, if it cannot be started, fails, or does not end in time.
pub fn run(command: &mut Command, folder: &Path, limit: Duration) -> Result<(Spent, String), String> {
    let Ended { spent, printed, is_well } = run_to_end(command, folder, limit)?;
    if is_well { Ok((spent, printed)) } else { Err(last_words(&printed)) }
}

/// How a program ended.
pub struct Ended {
    /// What it cost.
    pub spent: Spent,
    /// What it printed.
    pub printed: String,
    /// Whether it says that all went well.
    pub is_well: bool,
}

/// The same, if a program that says it failed is to be heard all the same.
///
/// # Errors
///
/// Words, if it cannot be started or does not end in time.
pub fn run_to_end(command: &mut Command, folder: &Path, limit: Duration) -> Result<Ended, String> {
    let failed = |error: std::io::Error| format!("cannot run: {error}");
    let log = folder.join("printed");
    let out = File::create(&log).map_err(failed)?;
    command.current_dir(folder).stdin(Stdio::null()).stderr(out.try_clone().map_err(failed)?).stdout(out);
    let (cpu, start) = (cpu_of_children(), Instant::now());
    let mut child = command.spawn().map_err(failed)?;
    let status = loop {
        match child.try_wait().map_err(failed)? {
            Some(status) => break status,
            None if start.elapsed() < limit => std::thread::sleep(LOOK),
            None => {
                child.kill().and_then(|()| child.wait()).map_err(failed)?;
                return Err(format!("did not end within {} s", limit.as_secs()));
            }
        }
    };
    let wall_s = start.elapsed().as_secs_f64();
    let cpu_s = cpu_of_children().zip(cpu).map(|(after, before)| after - before);
    let printed = String::from_utf8_lossy(&fs::read(&log).map_err(failed)?).into_owned();
    Ok(Ended { spent: Spent { cpu_s, wall_s }, printed, is_well: status.success() })
}

fn last_words(printed: &str) -> String {
    let error = printed.lines().rev().find(|line| line.contains("rror")).or_else(|| printed.lines().last());
    format!("failed: {}", error.unwrap_or("without a word"))
}

/// CPU seconds of all child processes that have ended, and of theirs.
#[cfg(unix)]
fn cpu_of_children() -> Option<f64> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeValLike;
    let usage = getrusage(UsageWho::RUSAGE_CHILDREN).ok()?;
    Some((usage.user_time() + usage.system_time()).num_microseconds() as f64 * 1e-6)
}

#[cfg(not(unix))]
fn cpu_of_children() -> Option<f64> {
    None
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str, limit: Duration) -> Result<(Spent, String), String> {
        let folder = tempfile::tempdir().expect("a folder");
        run(Command::new("sh").args(["-c", script]), folder.path(), limit)
    }

    #[test]
    fn what_is_printed_comes_back() {
        let (spent, printed) = shell("echo one; echo two >&2", Duration::from_secs(60)).expect("it runs");
        assert_eq!(printed, "one\ntwo\n");
        assert!(spent.wall_s > 0.0 && spent.cpu_s.is_some());
    }

    #[test]
    fn failures_are_told_in_words() {
        assert_eq!(shell("echo ERROR: no such style; exit 1", Duration::from_secs(60)), Err("failed: ERROR: no such style".into()));
        assert_eq!(shell("sleep 60", Duration::from_millis(20)), Err("did not end within 0 s".into()));
        let folder = tempfile::tempdir().expect("a folder");
        let missing = run(&mut Command::new("no-such-program-at-all"), folder.path(), Duration::from_secs(1));
        assert!(missing.is_err_and(|words| words.starts_with("cannot run")));
    }
}
