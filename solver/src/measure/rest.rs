//! Whether bodies have come to rest.

use crate::scene::Settled;

/// Looks at the speed of the bodies now and then, and tells when it has been low for long enough.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RestWatch {
    criterion: Settled,
    /// Steps between two looks.
    interval: u64,
    /// Steps for which the speed must stay low.
    hold: u64,
    /// The first of the last looks that all found the speed low.
    pub(crate) quiet_since: Option<u64>,
}

/// Looks in the time for which the speed must stay low: a body at the top of its path is not taken for one at rest.
const LOOKS: f64 = 20.0;

impl RestWatch {
    pub(crate) fn new(criterion: &Settled, step: f64) -> RestWatch {
        let steps = |time: f64| (time / step).ceil().max(1.0) as u64;
        let (interval, hold) = (steps(criterion.hold / LOOKS), steps(criterion.hold));
        RestWatch { criterion: criterion.clone(), interval, hold, quiet_since: None }
    }

    /// Whether it is time to look after so many steps.
    pub(crate) fn is_due(&self, steps: u64) -> bool {
        steps.is_multiple_of(self.interval)
    }

    /// Takes note of a look after so many steps: root mean square speed in m/s, and whether bodies are still to come.
    pub(crate) fn note(&mut self, steps: u64, speed: f64, are_all_in: bool) {
        let is_quiet = are_all_in && speed < self.criterion.speed;
        self.quiet_since = if is_quiet { self.quiet_since.or(Some(steps)) } else { None };
    }

    /// Whether the speed has been low for long enough after so many steps.
    pub(crate) fn has_settled(&self, steps: u64) -> bool {
        self.quiet_since.is_some_and(|since| steps >= since + self.hold)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_stop_is_no_rest() {
        let mut watch = RestWatch::new(&Settled { speed: 1e-3, hold: 0.1 }, 1e-3);
        let due: Vec<u64> = (0..400).filter(|steps| watch.is_due(*steps)).collect();
        assert_eq!(due[..3], [0, 5, 10]);
        // Moving, at rest for 90 steps, moving once, at rest, with bodies to come until step 200.
        let mut settled_at = None;
        for steps in due {
            let speed = if steps < 20 || steps == 110 { 1.0 } else { 9e-4 };
            watch.note(steps, speed, steps >= 200);
            if watch.has_settled(steps) {
                settled_at = settled_at.or(Some(steps));
            }
        }
        assert_eq!(settled_at, Some(300));
    }
}
