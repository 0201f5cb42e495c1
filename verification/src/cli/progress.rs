//! Progress bars: only if standard error is a terminal, and only for what takes more than two seconds.

use std::cell::Cell;
use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};

/// What is quicker than this shows no bar.
const PATIENCE: Duration = Duration::from_secs(2);

/// The bars of a command.
pub struct Progress {
    bars: MultiProgress,
    wanted: bool,
}

impl Progress {
    /// No bars yet.
    pub fn new() -> Progress {
        Progress { bars: MultiProgress::new(), wanted: std::io::stderr().is_terminal() }
    }

    /// A bar for one piece of work.
    pub fn bar(&self, name: &str) -> Bar<'_> {
        let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len}{prefix}, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_message(name.to_string());
        Bar { bar, group: self, started: Instant::now(), is_shown: Cell::new(false) }
    }

    /// Prints without tearing a bar.
    pub fn suspended(&self, print: impl FnOnce()) {
        self.bars.suspend(print);
    }
}

/// One bar; it goes when dropped.
pub struct Bar<'a> {
    bar: ProgressBar,
    group: &'a Progress,
    started: Instant,
    is_shown: Cell<bool>,
}

impl Bar<'_> {
    /// So many are done of so many.
    pub fn set(&self, done: u64, total: u64) {
        if !self.is_shown.get() && self.group.wanted && self.started.elapsed() >= PATIENCE {
            self.is_shown.set(true);
            self.group.bars.add(self.bar.clone());
        }
        self.bar.set_length(total);
        self.bar.set_position(done);
    }

    /// So much work has been done since the bar began: its rate is shown.
    pub fn set_rate(&self, work: u64, unit: &str) {
        let rate = work as f64 / self.started.elapsed().as_secs_f64().max(f64::MIN_POSITIVE);
        self.bar.set_prefix(format!(", {rate:.2e} {unit}/s"));
    }
}

impl Drop for Bar<'_> {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
