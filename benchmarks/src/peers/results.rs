//! What the rounds gave: a table to read, rows and a card for the pages, all rounds as CSV.

use reports::row::Cost;
use reports::{Card, Row};
use verification::cli::environment::Environment;
use verification::statistics::{median, median_interval};

use super::codes::Run;
use crate::page::{self, lines, measured, with_goal};

/// Identifier of the page.
pub const PAGE: &str = "peers";
/// All rounds, relative to the folder of results.
pub const ROUNDS_FILE: &str = "peers/rounds.csv";

/// A code at one kind of work, over all rounds.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Name of the code; `touchstone` is ours.
    pub code: String,
    /// Its version; the variable and program that were looked for if it is missing.
    pub version: String,
    /// Compiler and flags, as it tells them.
    pub build: String,
    /// Law and cores, in words.
    pub setup: String,
    /// Threads and ranks.
    pub parallel: [u32; 2],
    /// Spheres.
    pub bodies: usize,
    /// Steps of a run.
    pub steps: u64,
    /// A run a round; none for a code that is missing.
    pub runs: Vec<Result<Run, String>>,
}

impl Entry {
    /// Whether there is such a program.
    pub fn is_missing(&self) -> bool {
        self.runs.is_empty()
    }

    /// CPU and wall seconds of one sphere's step in each round that went well.
    fn costs(&self) -> Vec<[f64; 2]> {
        let per = (self.bodies as u64 * self.steps) as f64;
        let cost = |run: &Run| [run.spent.cpu_s.unwrap_or(f64::NAN) / per, run.spent.wall_s / per];
        self.runs.iter().flatten().map(cost).collect()
    }

    /// Median CPU and wall seconds of one sphere's step.
    pub fn cost(&self) -> [f64; 2] {
        let costs = self.costs();
        [0, 1].map(|kind| if costs.is_empty() { f64::NAN } else { median(&costs.iter().map(|cost| cost[kind]).collect::<Vec<_>>()) })
    }

    fn coordination(&self) -> Option<f64> {
        self.runs.iter().flatten().find_map(|run| run.coordination)
    }

    /// CPU time of a sphere's step over that of another code in the same rounds: median and its 95 % interval.
    fn over(&self, base: &Entry) -> Option<(f64, Option<[f64; 2]>)> {
        let ratios = self.ratios(base, |run| run.spent.cpu_s);
        (!ratios.is_empty()).then(|| (median(&ratios), median_interval(&ratios)))
    }

    /// Time of a sphere's step over that of another code, round by round.
    fn ratios(&self, base: &Entry, time: impl Fn(&Run) -> Option<f64>) -> Vec<f64> {
        let pairs = self.runs.iter().zip(&base.runs).filter_map(|(one, other)| Some((one.as_ref().ok()?, other.as_ref().ok()?)));
        let per = |entry: &Entry, run: &Run| Some(time(run)? / (entry.bodies as u64 * entry.steps) as f64);
        pairs.filter_map(|(one, other)| Some(per(self, one)? / per(base, other)?)).collect()
    }

    /// How many times as long as ours a code should need, if that is a goal: in CPU time on one core, in wall time on more.
    fn goal(&self) -> Option<f64> {
        match (self.code.as_str(), self.setup.as_str()) {
            ("LAMMPS", "history, 1 core") => Some(1.5),
            ("LIGGGHTS", "history, 1 core") => Some(2.0),
            ("LAMMPS" | "LIGGGHTS", "history, 2 cores") => Some(1.0),
            _ => None,
        }
    }

    /// The goal that the code sets us as a claim, if it sets one and both have run.
    pub fn row_of_goal(&self, ours: &Entry, environment: &Environment) -> Option<Row> {
        let goal = self.goal()?;
        let is_serial = self.parallel == [1, 1];
        let ratios = self.ratios(ours, |run| if is_serial { run.spent.cpu_s } else { Some(run.spent.wall_s) });
        let (clock, reason) = match is_serial {
            true => ("CPU time", "the goal on one core"),
            false => ("wall time", "no slower on two cores"),
        };
        let row = Row {
            statistic: format!("median of {} rounds", ratios.len()),
            n: ratios.len() as u64,
            ci95: median_interval(&ratios),
            value: (!ratios.is_empty()).then(|| median(&ratios)),
            data: vec![ROUNDS_FILE.into()],
            ..measured(PAGE, &self.setup_of_goal(), &format!("{clock} of one sphere's step over ours"), "1", environment)
        };
        row.value.is_some().then(|| with_goal(row, goal, reason))
    }

    fn setup_of_goal(&self) -> String {
        format!("{}, {} {}", self.setup, self.code, self.version)
    }

    /// A line of the table; ratios are to a base.
    pub fn line(&self, base: &Entry) -> String {
        if self.is_missing() {
            return format!("  {:<11} missing ({})", self.code, self.version);
        }
        if let Some(failure) = self.runs.iter().find_map(|run| run.as_ref().err()) {
            return format!("  {:<11} {failure}", self.code);
        }
        let [cpu, wall] = self.cost().map(|seconds| seconds * 1e9);
        let ratio = match self.over(base) {
            Some((ratio, Some([low, high]))) => format!("{ratio:7.3} [{low:.3}, {high:.3}]"),
            Some((ratio, None)) => format!("{ratio:7.3}"),
            None => "-".into(),
        };
        let coordination = self.coordination().map_or("-".into(), |number| format!("{number:.2}"));
        format!(
            "  {:<11} {cpu:9.1} {wall:9.1}  {ratio:<24} {:6} x {:<4} {coordination:>5}  {} ({})",
            self.code, self.bodies, self.steps, self.version, self.build
        )
    }

    /// The head of the table.
    pub fn head(base: &str) -> String {
        let over = format!("CPU over {base} [95 %]");
        format!(
            "  {:<11} {:>9} {:>9}  {over:<24} {:>6} x {:<4} {:>5}  version (build)",
            "code", "CPU ns", "wall ns", "bodies", "steps", "Z"
        )
    }

    /// The entry as a row of the page; its value is CPU seconds of one sphere's step.
    pub fn row(&self, environment: &Environment) -> Row {
        let costs = self.costs();
        let cpu: Vec<f64> = self.runs.iter().flatten().filter_map(|run| run.spent.cpu_s).collect();
        let wall: Vec<f64> = self.runs.iter().flatten().map(|run| run.spent.wall_s).collect();
        let range = |values: &[f64]| {
            let ends = values.iter().fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], value| [low.min(*value), high.max(*value)]);
            (values.len() > 2).then_some(ends)
        };
        let work = [("steps", self.steps), ("body_steps", self.steps * self.bodies as u64)];
        let [threads, ranks] = self.parallel;
        let failure = self.runs.iter().find_map(|run| run.as_ref().err().cloned());
        Row {
            statistic: format!("median of {} rounds", costs.len()),
            n: costs.len() as u64,
            value: Some(self.cost()[0]).filter(|value| value.is_finite()),
            failed: failure.or_else(|| self.is_missing().then(|| format!("missing ({})", self.version))),
            cost: Cost {
                work: work.map(|(name, count)| (name.to_string(), count)).into(),
                cpu_s: (!cpu.is_empty()).then(|| median(&cpu)),
                cpu_s_range: range(&cpu),
                rounds: Some(costs.len() as u32),
                runs: 1,
                wall_s: (!wall.is_empty()).then(|| median(&wall)),
                ..Cost::default()
            },
            threads,
            ranks,
            code: self.code.clone(),
            version: if self.build.is_empty() { self.version.clone() } else { format!("{} ({})", self.version, self.build) },
            data: vec![ROUNDS_FILE.into()],
            ..measured(PAGE, &self.setup, "CPU time of one sphere's step", "s", environment)
        }
    }
}

/// All rounds of all entries.
pub fn rounds_csv(entries: &[Entry]) -> String {
    let mut text = String::from("setup,code,version,round,cpu_s,wall_s,bodies,steps,contacts_per_sphere\n");
    for entry in entries {
        for (round, run) in entry.runs.iter().enumerate() {
            let Ok(run) = run else { continue };
            let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
            let (cpu_s, coordination) = (number(run.spent.cpu_s), number(run.coordination));
            let Entry { setup, code, version, bodies, steps, .. } = entry;
            text += &format!("\"{setup}\",{code},\"{version}\",{round},{cpu_s},{},{bodies},{steps},{coordination}\n", run.spent.wall_s);
        }
    }
    text
}

/// What the page says of itself: it opens with the first goal, if there is one, or with the first cost.
pub fn card(rows: &[Row]) -> Card {
    let question = "What does one step of one sphere cost in a settled packing, here and in other codes?";
    let first = rows.iter().find(|row| row.pass.is_some()).or(rows.first());
    let headline = first.map_or(["", ""], |row| [row.setup.as_str(), row.quantity.as_str()]);
    Card {
        model: lines([
            "10,000 spheres of 3 mm lie in a periodic column of 12 x 12 diameters on a floor. All codes start from the same numbers, with the same stiffness (10⁵ N/m), restitution (0.75), friction (0.5), gravity and time step (2 µs).",
            "Runs of all codes take turns, in turn forwards and backwards; a cost is that of the steps alone, in CPU time of all processes and threads.",
        ]),
        sources: lines(["benchmarks/peers/README.md: decks, versions, laws and how they differ"]),
        remarks: lines(["Number of bodies and contacts of a sphere stand in rounds.csv: where they differ, so does the work."]),
        ..page::card(PAGE, "Speed beside other codes", question, headline)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peers::process::Spent;

    fn entry(code: &str, bodies: usize, cpu: &[f64]) -> Entry {
        let run = |cpu_s: &f64| Ok(Run { spent: Spent { cpu_s: Some(*cpu_s), wall_s: 2.0 * cpu_s }, coordination: Some(4.5) });
        Entry {
            code: code.into(),
            version: "1".into(),
            build: "-O2".into(),
            setup: "history, 1 core".into(),
            parallel: [1, 1],
            bodies,
            steps: 10,
            runs: cpu.iter().map(run).collect(),
        }
    }

    /// Ratios are taken round by round per sphere and step, so that a slow round of the machine cancels.
    #[test]
    fn ratios_are_those_of_rounds() {
        let base = entry("touchstone", 100, &[1.0, 10.0, 2.0]);
        let other = entry("LAMMPS", 200, &[1.0, 10.0, 2.0]);
        assert_eq!(other.over(&base).map(|(ratio, _)| ratio), Some(0.5));
        assert_eq!(base.cost(), [2.0 / 1000.0, 4.0 / 1000.0]);
    }

    /// A code that needs twice our time meets a goal of one and a half, and misses it with a fifth more.
    #[test]
    fn a_goal_is_a_claim() {
        let ours = entry("touchstone", 100, &[1.0, 2.0, 3.0]);
        let row = |cpu: &[f64]| entry("LAMMPS", 100, cpu).row_of_goal(&ours, &Environment::of(None)).expect("a goal");
        let (met, missed) = (row(&[2.0, 4.0, 6.0]), row(&[1.2, 2.4, 3.6]));
        assert_eq!((met.holds(), met.error), (Some(true), Some(0.75)));
        assert_eq!(missed.holds(), Some(false));
        assert!((missed.error.unwrap_or(0.0) - 1.25).abs() < 1e-12);
        assert_eq!(entry("YADE", 100, &[2.0]).row_of_goal(&ours, &Environment::of(None)), None);
        assert_eq!(card(&[ours.row(&Environment::of(None)), met.clone()]).headline.setup, met.setup);
        assert_eq!(reports::read_rows(&reports::write_rows(std::slice::from_ref(&met))), Ok(vec![met]));
    }

    #[test]
    fn what_is_missing_or_fails_is_said() {
        let base = entry("touchstone", 100, &[1.0]);
        let missing = entry("YADE", 100, &[]);
        assert_eq!(missing.line(&base), "  YADE        missing (1)");
        assert_eq!(missing.row(&Environment::of(None)).failed.as_deref(), Some("missing (1)"));
        let failed = Entry { runs: vec![Err("failed: ERROR".into())], ..missing };
        assert!(failed.line(&base).contains("failed: ERROR"));
        assert_eq!(failed.row(&Environment::of(None)).failed.as_deref(), Some("failed: ERROR"));
    }

    /// Rows go through their text and back.
    #[test]
    fn rows_are_rows_of_the_contract() {
        let rows = vec![entry("LAMMPS", 100, &[1.0, 2.0, 3.0]).row(&Environment::of(None))];
        assert_eq!(reports::read_rows(&reports::write_rows(&rows)), Ok(rows));
    }
}
