//! What rows say about where they were made: commit and machine.

use std::path::Path;
use std::process::{Command, Stdio};

/// Where and from what a run was made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Environment {
    /// Commit of the checkout, with "-dirty" if files differ from it; "unknown" outside a checkout.
    pub commit: String,
    /// Date of that commit; "undated" if there is none.
    pub date: String,
    /// Processor, cores and system.
    pub machine: String,
}

impl Environment {
    /// The environment of a workspace.
    pub fn of(root: Option<&Path>) -> Environment {
        let date = root.and_then(|root| git(root, &["log", "-1", "--format=%cs"])).filter(|date| !date.is_empty());
        Environment {
            commit: root.and_then(commit).unwrap_or_else(|| "unknown".into()),
            date: date.unwrap_or_else(|| "undated".into()),
            machine: machine(),
        }
    }
}

fn commit(root: &Path) -> Option<String> {
    let commit = git(root, &["rev-parse", "--short=12", "HEAD"])?;
    let changes = git(root, &["status", "--porcelain"]).unwrap_or_default();
    let mark = if changes.is_empty() { "" } else { "-dirty" };
    Some(format!("{commit}{mark}"))
}

/// What git prints, without the last line end; `None` if it is absent or fails.
fn git(root: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").arg("-C").arg(root).args(arguments).stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim_end().to_string())
}

fn machine() -> String {
    let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| processor_name(&text));
    let processor = processor.unwrap_or_else(|| "unknown processor".into());
    let cores = std::thread::available_parallelism().map_or("unknown number of cores".into(), |cores| format!("{cores} cores"));
    format!("{processor}, {cores}, {} {}", std::env::consts::OS, std::env::consts::ARCH)
}

fn processor_name(text: &str) -> Option<String> {
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    let name = line.split_once(':')?.1.split_whitespace().collect::<Vec<_>>().join(" ");
    (!name.is_empty()).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_is_read_from_its_first_line() {
        assert_eq!(processor_name("processor\t: 0\nmodel name\t: Fast  Chip 9\n"), Some("Fast Chip 9".into()));
        assert_eq!(processor_name("processor\t: 0\n"), None);
    }

    #[test]
    fn outside_a_checkout_nothing_is_known_of_the_commit() {
        let environment = Environment::of(Some(Path::new("/nowhere/at/all")));
        assert_eq!((environment.commit.as_str(), environment.date.as_str()), ("unknown", "undated"));
    }
}
