//! Rows, the file of bars and the card of the page.

use reports::card::{Headline, Plot};
use reports::row::{Cost, Knob};
use reports::{Card, Row};
use verification::cli::environment::Environment;

use super::answer::Agreement;
use super::list::STEPS;
use crate::page::{card, lines, measured};
use crate::pairs::Ratio;

/// Identifier of the page.
pub const PAGE: &str = "ablation";
/// The bars, relative to the folder of results.
pub const BARS_FILE: &str = "ablation/bars.csv";
const DIFFERENCE: &str = "difference of the answer";
const QUESTION: &str = "What would a scene pay for things that it does not need, and would its answer change?";

/// What forcing one thing on gave.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// What is forced on.
    pub name: &'static str,
    /// Why the scene does not need it.
    pub reason: &'static str,
    /// Largest difference of positions, velocities and spins after the steps, over radius, speed and spin.
    pub difference: f64,
    /// How large it may be.
    pub agreement: Agreement,
    /// Cost with it over cost without.
    pub ratio: Ratio,
    /// Balls, and steps of one run that was timed.
    pub work: [u64; 2],
    /// Instructions of a ball's step without it and with it, where they were counted.
    pub instructions: Option<[f64; 2]>,
}

impl Entry {
    /// Whether the answer is the same.
    pub fn is_same(&self) -> bool {
        self.difference <= self.agreement.bound()
    }

    /// The same in words.
    pub fn answer(&self) -> String {
        match (self.is_same(), self.agreement) {
            (true, Agreement::Bits) => "yes: to the last bit".into(),
            (true, Agreement::Floor { .. }) => format!("yes: to {:.1e} of {:.1e} allowed", self.difference, self.agreement.bound()),
            (false, _) => format!("NO: {:.1e} above {:.1e}", self.difference, self.agreement.bound()),
        }
    }

    fn base_nanoseconds(&self) -> f64 {
        self.ratio.base_cpu_s * 1e9 / self.work.iter().product::<u64>() as f64
    }

    fn ratio_of_instructions(&self) -> Option<f64> {
        self.instructions.map(|[without, with]| with / without)
    }

    /// A line of the table.
    pub fn line(&self) -> String {
        let Ratio { median, interval: [low, high], .. } = self.ratio;
        let instructions = self.ratio_of_instructions().map_or("-".into(), |ratio| format!("{ratio:.3}"));
        let base = self.base_nanoseconds();
        format!("{:<36} {median:7.3} [{low:.3}, {high:.3}] x {base:7.1} ns  {instructions:>8}  {}", self.name, self.answer())
    }

    /// The answer as a claim, and the cost.
    fn rows(&self, environment: &Environment) -> [Row; 2] {
        let row = |quantity: &str| measured(PAGE, self.name, quantity, "1", environment);
        let (floor, reason) = match self.agreement {
            Agreement::Bits => (0.0, "no bit may differ".to_string()),
            Agreement::Floor { floor, factor, reason } => (floor, format!("{factor} x {reason}")),
        };
        let answer = Row {
            knob: Some(Knob { name: "steps".into(), value: STEPS as f64 }),
            value: Some(self.difference).filter(|value| value.is_finite()),
            expected: Some(0.0),
            error: Some(self.difference).filter(|value| value.is_finite()),
            floor: Some(floor),
            bound: Some(self.agreement.bound()),
            bound_reason: Some(reason),
            pass: Some(self.is_same()),
            ..row(DIFFERENCE)
        };
        let [balls, steps] = self.work;
        let work = [("steps", steps), ("body_steps", balls * steps)].map(|(name, count)| (name.to_string(), count));
        let cost = Row {
            statistic: format!("median of {} interleaved pairs", self.ratio.pairs),
            n: self.ratio.pairs as u64,
            value: Some(self.ratio.median),
            cost: Cost {
                work: work.into(),
                cpu_s: Some(self.ratio.base_cpu_s),
                rounds: Some(self.ratio.pairs as u32),
                runs: 1,
                ..Cost::default()
            },
            data: vec![BARS_FILE.into()],
            ..row("CPU time with it over without")
        };
        [answer, cost]
    }

    fn bar(&self) -> String {
        let Ratio { median, interval: [low, high], .. } = self.ratio;
        let instructions = self.ratio_of_instructions().map_or("not counted".into(), |ratio| format!("{ratio:.3}"));
        let base = self.base_nanoseconds();
        format!("{},{median},{low},{high},{base:.0} ns,{instructions},{},{}\n", self.name, self.answer(), self.reason)
    }
}

/// Rows of the page.
pub fn rows(entries: &[Entry], environment: &Environment) -> Vec<Row> {
    entries.iter().flat_map(|entry| entry.rows(environment)).collect()
}

/// The file of bars, the dearest first.
pub fn bars(entries: &[Entry]) -> String {
    let mut sorted: Vec<&Entry> = entries.iter().collect();
    sorted.sort_by(|one, other| other.ratio.median.total_cmp(&one.ratio.median));
    let header = "forced on,ratio,low,high,without: a ball's step,instructions,same answer,left out because\n";
    header.to_string() + &sorted.into_iter().map(Entry::bar).collect::<String>()
}

/// What the page says of itself.
pub fn page(headline: &str) -> Card {
    let base = card(PAGE, "What leaving out saves", QUESTION, [headline, DIFFERENCE]);
    Card {
        model: lines([
            "A cubic lattice of balls lies pressed between six walls, each ball with a velocity and a spin of its own, so small that no contact opens. Each thing that the solver leaves out there is forced on by a choice that the scene has, alone.",
            "After 100 steps every position, velocity and spin is compared with that of the scene without it. Both are then timed in interleaved pairs, in CPU time of one thread.",
        ]),
        reference: "The same scene without the thing.".into(),
        plots: vec![Plot::Bars {
            title: "Cost of what is left out".into(),
            file: BARS_FILE.into(),
            x_label: "CPU time with it over without".into(),
            caption: "Bars begin at one: no cost. Whiskers: 95 % interval of the median over interleaved pairs. Instructions are those of callgrind, which counts every one.".into(),
        }],
        headline: Headline { knob: STEPS as f64, ..base.headline.clone() },
        ..base
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(difference: f64, agreement: Agreement) -> Entry {
        let ratio = Ratio { median: 2.0, interval: [1.9, 2.1], base_cpu_s: 1e-3, pairs: 6 };
        Entry { name: "a thing", reason: "none", difference, agreement, ratio, work: [100, 10], instructions: Some([10.0, 15.0]) }
    }

    #[test]
    fn an_answer_that_differs_is_a_claim_not_met() {
        let floor = Agreement::Floor { floor: 1e-12, factor: 2.0, reason: "rounding" };
        let holds = |difference, agreement| entry(difference, agreement).rows(&Environment::of(None))[0].holds();
        assert_eq!(holds(0.0, Agreement::Bits), Some(true));
        assert_eq!(holds(1e-300, Agreement::Bits), Some(false));
        assert_eq!(holds(1.9e-12, floor), Some(true));
        assert_eq!(holds(2.1e-12, floor), Some(false));
        assert_eq!(holds(f64::NAN, floor), Some(false));
    }

    /// A bar has as many cells as the header, and the base is that of one ball's step.
    #[test]
    fn bars_are_told_with_their_base() {
        let text = bars(&[entry(0.0, Agreement::Bits)]);
        let cells: Vec<usize> = text.lines().map(|line| line.split(',').count()).collect();
        assert_eq!(cells, [8, 8]);
        assert!(text.ends_with("a thing,2,1.9,2.1,1000 ns,1.500,yes: to the last bit,none\n"), "{text}");
    }
}
