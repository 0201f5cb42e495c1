//! When something is due: at the first step at or after each multiple of an interval. It has no memory, so a resumed run has the same.

use solver::Simulation;

/// A rhythm of outputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Schedule {
    /// Never.
    Never,
    /// At every step.
    EachStep,
    /// Every so many seconds.
    Every(f64),
}

impl Schedule {
    /// Every interval in s; what is shorter than a step means every step.
    pub fn every(interval: f64, simulation: &Simulation) -> Schedule {
        if interval <= simulation.time_step() { Schedule::EachStep } else { Schedule::Every(interval) }
    }

    /// The first due step after a step.
    pub fn next_after(self, step: u64, simulation: &Simulation) -> u64 {
        match self {
            Schedule::Never => u64::MAX,
            Schedule::EachStep => step + 1,
            Schedule::Every(interval) => {
                let mut multiple = (step as f64 * simulation.time_step() / interval).floor();
                loop {
                    let due = simulation.steps_to(multiple * interval);
                    if due > step {
                        return due;
                    }
                    multiple += 1.0;
                }
            }
        }
    }

    /// Whether something is due at a step.
    pub fn is_due(self, step: u64, simulation: &Simulation) -> bool {
        match self {
            Schedule::Never => false,
            _ => step == 0 || self.next_after(step - 1, simulation) == step,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use solver::Scene;

    fn simulation(step: f64) -> Simulation {
        let text = format!(
            "scene = {{ name = \"free\", end_time = 1.0 }}\nnumerics = {{ step = {step:?} }}\n\
             material = [{{ name = \"any\", density = 1.0 }}]\nshape = [{{ name = \"ball\", geometry = {{ sphere = {{ radius = 1.0 }} }} }}]\n\
             body = [{{ shape = \"ball\", material = \"any\", position = [0.0, 0.0, 0.0] }}]\n"
        );
        Scene::from_toml(&text, "free.toml").and_then(|scene| scene.build()).expect("a free ball")
    }

    /// Independent: the due steps counted one multiple at a time from zero.
    #[test]
    fn due_steps_are_the_first_at_or_after_each_multiple() {
        for (step, interval) in [(1e-3, 1e-2), (1e-3, 2.5e-3), (0.1, 0.3), (1e-5, 3.3e-4), (0.01, 0.01)] {
            let simulation = simulation(step);
            let schedule = Schedule::every(interval, &simulation);
            let wanted: Vec<u64> = (0..60).map(|multiple| simulation.steps_to(f64::from(multiple) * interval)).collect();
            let (mut found, mut now) = (vec![0], 0);
            while found.len() < wanted.len() {
                now = schedule.next_after(now, &simulation);
                found.push(now);
            }
            assert_eq!(found, wanted, "step {step}, interval {interval}");
            let last = wanted[wanted.len() - 1];
            let due: Vec<u64> = (0..=last).filter(|step| schedule.is_due(*step, &simulation)).collect();
            assert_eq!(due, wanted);
        }
    }

    #[test]
    fn an_interval_below_the_step_means_every_step() {
        let simulation = simulation(1e-3);
        assert_eq!(Schedule::every(1e-300, &simulation), Schedule::EachStep);
        assert!(!Schedule::Never.is_due(0, &simulation) && Schedule::EachStep.is_due(7, &simulation));
    }
}
