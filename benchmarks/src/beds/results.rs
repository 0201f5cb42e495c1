//! Rows, the table, the file of bars and the card of the page.

use reports::card::Plot;
use reports::row::Cost;
use reports::{Card, Row};
use verification::cli::environment::Environment;

use super::kinds::Kind;
use crate::page::{card, lines, measured, with_goal};
use crate::pairs::Ratio;

/// Identifier of the page.
pub const PAGE: &str = "beds";
/// The bars, relative to the folder of results.
pub const BARS_FILE: &str = "beds/bars.csv";
const RATE: &str = "steps of bodies a second";

/// What the steps of a bed cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// What lies in the bed.
    pub kind: Kind,
    /// Bodies.
    pub bodies: u64,
    /// Steps of this bed and of the spheres in one sample.
    pub steps: [u64; 2],
    /// Steps of spheres over steps of this bed, in time of interleaved samples.
    pub ratio: Ratio,
    /// Contact points, pairs looked at and new lists, all of them over all samples.
    pub work: Work,
}

/// What was done in all samples.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Contact points whose force was evaluated, those at the floor too.
    pub contacts: u64,
    /// Pairs that were not known to be apart.
    pub pair_tests: u64,
    /// Lists of neighbours made.
    pub lists: u64,
}

impl Entry {
    fn body_steps(&self) -> u64 {
        self.bodies * self.steps[0] * self.ratio.pairs as u64
    }

    /// CPU time in s of one step of one body, median of all samples.
    fn cost(&self) -> f64 {
        self.ratio.base_cpu_s / (self.bodies * self.steps[0]) as f64
    }

    /// Steps of bodies a second of CPU time on one core.
    pub fn rate(&self) -> f64 {
        1.0 / self.cost()
    }

    /// Cost of a step of a body over that of a sphere, and its interval.
    fn over_spheres(&self) -> (f64, [f64; 2]) {
        let Ratio { median, interval: [low, high], .. } = self.ratio;
        let factor = self.steps[1] as f64 / self.steps[0] as f64;
        (factor / median, [factor / high, factor / low])
    }

    /// Contact points, and pairs looked at, of a body in a step.
    fn per_body(&self) -> [f64; 2] {
        [self.work.contacts, self.work.pair_tests].map(|count| count as f64 / self.body_steps() as f64)
    }

    /// Whether the goal is met, if there is one.
    pub fn meets_goal(&self) -> Option<bool> {
        self.kind.goal().map(|goal| self.rate() >= goal)
    }

    fn goal(&self) -> String {
        match (self.kind.goal(), self.meets_goal()) {
            (Some(goal), Some(true)) => format!("{goal:.1e}: met"),
            (Some(goal), _) => format!("{goal:.1e}: MISSED"),
            (None, _) => "none".into(),
        }
    }

    /// What [`Entry::line`] tells.
    pub const HEAD: &str = "bed              body steps/s  goal             over a sphere's [95 %]   points  pairs  ns/point  lists";

    /// A line of the table.
    pub fn line(&self) -> String {
        let (ratio, [low, high]) = self.over_spheres();
        let [points, pairs] = self.per_body();
        let (name, goal, rate) = (self.kind.name(), self.goal(), self.rate());
        let per_point = self.cost() * 1e9 / points;
        let lists = self.work.lists;
        format!("{name:<16} {rate:12.3e}  {goal:<15} {ratio:6.2} [{low:.2}, {high:.2}]  {points:6.2} {pairs:6.2}  {per_point:8.0}  {lists}")
    }

    /// As a row of the page.
    pub fn row(&self, environment: &Environment) -> Row {
        let Work { contacts, pair_tests, lists } = self.work;
        let work = [("contacts", contacts), ("pair_tests", pair_tests), ("lists", lists), ("body_steps", self.body_steps())];
        let row = Row {
            statistic: format!("median of {} interleaved samples", self.ratio.pairs),
            n: self.ratio.pairs as u64,
            value: Some(self.rate()),
            cost: Cost {
                work: work.map(|(name, count)| (name.to_string(), count)).into(),
                cpu_s: Some(self.ratio.base_cpu_s),
                rounds: Some(self.ratio.pairs as u32),
                runs: 1,
                ..Cost::default()
            },
            data: vec![BARS_FILE.into()],
            ..measured(PAGE, self.kind.name(), RATE, "1/s", environment)
        };
        match self.kind.goal() {
            Some(goal) => with_goal(row, goal, "the goal: steps of bodies a second of one core"),
            None => row,
        }
    }

    fn bar(&self) -> String {
        let (ratio, [low, high]) = self.over_spheres();
        let [points, pairs] = self.per_body();
        let (name, rate, goal) = (self.kind.name(), self.rate(), self.goal());
        let per_point = self.cost() * 1e9 / points;
        format!("{name},{ratio},{low},{high},{rate:.3e},{goal},{points:.2},{pairs:.2},{per_point:.0} ns\n")
    }
}

/// The file of bars.
pub fn bars(entries: &[Entry]) -> String {
    let header =
        "bed,over a sphere's step,low,high,body steps a second,goal,contact points a body,pairs looked at a body,a contact point\n";
    header.to_string() + &entries.iter().map(Entry::bar).collect::<String>()
}

/// What the page says of itself.
pub fn page(headline: &str) -> Card {
    let question = "What does one step of one body cost in a settled bed, whatever its shape?";
    let base = card(PAGE, "Beds of every shape", question, [headline, RATE]);
    Card {
        model: lines([
            "400 bodies with the volume of a ball of 3 mm lie settled on a floor in a column that repeats in x and y; stiffness 10⁵ N/m, restitution 0.75, friction 0.5 with history, time step 2 µs.",
            "Cubes, icosahedra, cylinders as long as wide, ellipsoids 4:1:1, superellipsoids 1.5:1.2:1 with exponents 0.55 and 0.7, crosses of three cylinders 5:1. Samples of each bed and of the spheres take turns, in CPU time of one thread.",
        ]),
        plots: vec![Plot::Bars {
            title: "Cost of a shape".into(),
            file: BARS_FILE.into(),
            x_label: "CPU time of a body's step over that of a sphere's".into(),
            caption: "Whiskers: 95 % interval of the median over interleaved samples. A contact point of two bodies counts once; so does one at the floor.".into(),
        }],
        sources: lines(["benchmarks/peers/README.md: what other codes need"]),
        ..base
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(kind: Kind, base_cpu_s: f64) -> Entry {
        let ratio = Ratio { median: 0.5, interval: [0.25, 1.0], base_cpu_s, pairs: 4 };
        let work = Work { contacts: 8000, pair_tests: 4000, lists: 1 };
        Entry { kind, bodies: 100, steps: [10, 40], ratio, work }
    }

    /// A thousand steps of bodies in a millisecond are a million a second; each has two points; forty steps of spheres take half the time of ten.
    #[test]
    fn figures_are_those_of_a_step_of_a_body() {
        let cubes = entry(Kind::Cube, 1e-3);
        assert!((cubes.rate() / 1e6 - 1.0).abs() < 1e-12 && cubes.meets_goal() == Some(true));
        assert_eq!(cubes.over_spheres(), (8.0, [4.0, 16.0]));
        assert_eq!(cubes.per_body(), [2.0, 1.0]);
        assert_eq!(entry(Kind::Cube, 2e-3).meets_goal(), Some(false));
        assert_eq!(entry(Kind::Sphere, 2e-3).meets_goal(), None);
    }

    #[test]
    fn bars_and_rows_are_as_pages_want_them() {
        let entries = [entry(Kind::Sphere, 1e-3), entry(Kind::Cube, 2e-3)];
        let cells: Vec<usize> = bars(&entries).lines().map(|line| line.split(',').count()).collect();
        assert_eq!(cells, [9, 9, 9]);
        let rows = entries.map(|entry| entry.row(&Environment::of(None))).to_vec();
        assert_eq!(reports::read_rows(&reports::write_rows(&rows)), Ok(rows));
    }
}
