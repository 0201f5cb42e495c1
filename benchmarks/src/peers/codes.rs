//! The other codes: which are installed, what they say of themselves, and how each runs steps of the settled packing.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use super::packing::Law;
use super::process::{self, Spent};

/// A code that can run the packing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Pair styles gran/hooke and gran/hooke/history.
    Lammps,
    /// hooke/stiffness.
    Liggghts,
    /// `ViscElMat`.
    Yade,
}

impl Kind {
    /// All of them.
    pub const ALL: [Kind; 3] = [Kind::Lammps, Kind::Liggghts, Kind::Yade];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Lammps => "LAMMPS",
            Kind::Liggghts => "LIGGGHTS",
            Kind::Yade => "YADE",
        }
    }

    /// Environment variable that names its programs, separated as in `PATH`, instead of the usual one.
    pub fn variable(self) -> &'static str {
        match self {
            Kind::Lammps => "PEER_LAMMPS",
            Kind::Liggghts => "PEER_LIGGGHTS",
            Kind::Yade => "PEER_YADE",
        }
    }

    fn usual_program(self) -> &'static str {
        match self {
            Kind::Lammps => "lmp",
            Kind::Liggghts => "liggghts",
            Kind::Yade => "yade",
        }
    }

    /// Steps of a timed run: about a second of CPU time.
    pub fn steps(self) -> u64 {
        match self {
            Kind::Lammps => 300,
            Kind::Liggghts => 250,
            Kind::Yade => 60,
        }
    }
}

/// An installed code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Code {
    /// Which.
    pub kind: Kind,
    /// Its program.
    pub program: PathBuf,
    /// Version, in its own words.
    pub version: String,
    /// What it says of compiler and flags.
    pub build: String,
}

/// Cost of the steps of one run, and contacts a sphere at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// Of the steps alone.
    pub spent: Spent,
    /// Twice the number of contacts between spheres over that of spheres.
    pub coordination: Option<f64>,
}

/// No run here takes longer unless it hangs.
const LIMIT: Duration = Duration::from_secs(120);

/// The installed programs of a code; none if it is missing.
pub fn find(kind: Kind, folder: &Path) -> Vec<Code> {
    let named = std::env::var_os(kind.variable());
    let programs: Vec<PathBuf> = match named {
        Some(named) => std::env::split_paths(&named).collect(),
        None => vec![kind.usual_program().into()],
    };
    programs.into_iter().filter_map(|program| ask(kind, program, folder)).collect()
}

fn ask(kind: Kind, program: PathBuf, folder: &Path) -> Option<Code> {
    let question = if kind == Kind::Yade { "--version" } else { "-h" };
    // LIGGGHTS prints its help and then says that it failed.
    let answer = process::run_to_end(Command::new(&program).arg(question), folder, LIMIT).ok()?;
    let (version, build) = words(kind, &answer.printed);
    Some(Code { kind, program, version, build })
}

/// Version and build, from what a code says of itself.
fn words(kind: Kind, printed: &str) -> (String, String) {
    let first = printed.lines().find(|line| !line.trim().is_empty()).unwrap_or("").trim();
    let not_told = || "build not told".to_string();
    match kind {
        Kind::Lammps => {
            let version = first.split_once(" - ").map_or(first, |(_, version)| version);
            let compiler = printed.lines().find_map(|line| line.strip_prefix("Compiler: "));
            (version.into(), compiler.map_or_else(not_told, |compiler| format!("{compiler}; optimisation not told")))
        }
        Kind::Liggghts => {
            let inside = first.split_once("LIGGGHTS-PUBLIC ").map_or(first, |(_, inside)| inside);
            let (version, build) = inside.split_once(", ").unwrap_or((inside, ""));
            (version.into(), if build.is_empty() { not_told() } else { build.trim_end_matches(')').into() })
        }
        Kind::Yade => (first.rsplit(": ").next().unwrap_or(first).trim().into(), not_told()),
    }
}

impl Code {
    /// Steps of the packing on a number of cores; the folder holds the file that [`Code::state`] names.
    ///
    /// # Errors
    ///
    /// Words, if the code fails.
    pub fn run(&self, decks: &Path, folder: &Path, law: Law, cores: u32) -> Result<Run, String> {
        let (state, steps) = (folder.join(self.state(law)), self.kind.steps());
        let once = |steps: u64| process::run(&mut self.command(decks, &state, law, cores, steps), folder, LIMIT);
        let (whole, printed) = once(steps)?;
        let number_after = |word: &str| -> Option<Vec<f64>> {
            let line = printed.lines().find_map(|line| line.strip_prefix(word))?;
            line.split_whitespace().map(|number| number.parse().ok()).collect()
        };
        let coordination = number_after("coordination ").and_then(|numbers| numbers.first().copied());
        // YADE tells what its steps cost; its start takes longer than they do. The others read the state and find neighbours in less than a fifth of a second.
        let spent = match number_after("stepping ").as_deref() {
            Some([cpu_s, wall_s]) => Spent { cpu_s: Some(*cpu_s), wall_s: *wall_s },
            _ => whole.less(&once(0)?.0),
        };
        Ok(Run { spent, coordination })
    }

    /// Name of the file that it reads the packing from.
    pub fn state(&self, law: Law) -> String {
        format!("{}.{}", law.name(), if self.kind == Kind::Yade { "txt" } else { "data" })
    }

    fn command(&self, decks: &Path, state: &Path, law: Law, cores: u32, steps: u64) -> Command {
        if self.kind == Kind::Yade {
            let mut command = Command::new(&self.program);
            command.args(["-n", "-x", &format!("-j{cores}")]);
            command.arg(decks.join("yade.py")).arg(state).args([law.name(), &steps.to_string()]);
            return command;
        }
        let mut command = if cores == 1 { Command::new(&self.program) } else { on_ranks(&self.program, cores) };
        command.arg("-in").arg(decks.join(if self.kind == Kind::Lammps { "lammps.in" } else { "liggghts.in" }));
        command.args(["-log", "none", "-var", "state"]).arg(state);
        command.args(["-var", "law", law.name(), "-var", "steps", &steps.to_string()]);
        command
    }
}

/// A program under `mpirun`, or what `PEER_MPIRUN` names, allowed to share cores and to run in containers.
fn on_ranks(program: &Path, ranks: u32) -> Command {
    let mut command = Command::new(std::env::var_os("PEER_MPIRUN").unwrap_or_else(|| "mpirun".into()));
    command.args(["-np", &ranks.to_string()]).arg(program);
    for name in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"] {
        command.env(name, "1");
    }
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_taken_at_their_word() {
        let lammps = "\nLarge-scale Atomic/Molecular Massively Parallel Simulator - 29 Sep 2021 - Update 2\n\nCompiler: GNU C++ 12.2.0\n";
        assert_eq!(words(Kind::Lammps, lammps), ("29 Sep 2021 - Update 2".into(), "GNU C++ 12.2.0; optimisation not told".into()));
        let liggghts = "LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled 2022-01-26 by buildd, git commit unknown)\n";
        assert_eq!(words(Kind::Liggghts, liggghts), ("3.8.0".into(), "compiled 2022-01-26 by buildd, git commit unknown".into()));
        assert_eq!(words(Kind::Yade, "Yade version: 2023.02a \n"), ("2023.02a".into(), "build not told".into()));
    }

    #[test]
    fn a_program_that_is_not_there_is_missing() {
        let folder = tempfile::tempdir().expect("a folder");
        assert_eq!(ask(Kind::Lammps, "no-such-program-at-all".into(), folder.path()), None);
    }
}
