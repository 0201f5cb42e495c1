//! The clocks of the machine.

use std::time::Instant;

use cpu_time::ThreadTime;

use crate::study::Clock;

/// CPU time of the calling thread, and wall time since the clock was made.
pub struct SystemClock {
    started: Instant,
}

impl Default for SystemClock {
    fn default() -> Self {
        SystemClock { started: Instant::now() }
    }
}

impl Clock for SystemClock {
    fn cpu_seconds(&self) -> f64 {
        ThreadTime::try_now().map_or(0.0, |time| time.as_duration().as_secs_f64())
    }

    fn wall_seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }
}
