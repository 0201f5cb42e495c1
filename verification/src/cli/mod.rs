//! The command line `touchstone`: arguments, files, clocks and progress bars. Everything that is computed comes from the library part.
//!
//! # Reading order
//!
//! [`arguments`] (what can be asked) -> [`places`] and [`environment`] (where, at which commit, on which machine) -> one file per command:
//! [`run`] (also the main job), [`list`], [`report`], [`scene`], [`export`], [`compare`] -> [`store`] (results on disk, site).

pub mod arguments;
pub mod clock;
pub mod compare;
pub mod environment;
pub mod error;
pub mod export;
mod files;
pub mod list;
mod packings;
pub mod places;
mod print;
mod progress;
pub mod report;
pub mod run;
pub mod scene;
mod select;
pub mod store;

use std::process::ExitCode;

use clap::Parser;

use arguments::{Arguments, Command};
pub use error::CommandError;
use places::Places;
use run::RunOptions;

/// How a command that did its work ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finish {
    /// All expectations are met, or there were none.
    Met,
    /// At least one claim is not met.
    NotMet,
}

/// Parses the arguments, does what they ask and gives the exit code: 0 all expectations met, 1 a claim not met, 2 bad input, 3 a runtime
/// guard stopped a run.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match execute(&arguments) {
        Ok(Finish::Met) => ExitCode::SUCCESS,
        Ok(Finish::NotMet) => ExitCode::from(1),
        Err(error) => {
            print::error_line(&format!("error: {error}"));
            ExitCode::from(error.exit_code())
        }
    }
}

fn execute(arguments: &Arguments) -> Result<Finish, CommandError> {
    let places = || Places::find(&arguments.places);
    match &arguments.command {
        None => run::main_job(&places()?),
        Some(Command::List { json }) => list::list(places().ok().as_ref(), *json),
        Some(Command::Run { pattern, tier, setup, knob, threads, seed, json }) => {
            let points = select::Points::new(setup.as_deref(), knob)?;
            let options = RunOptions { tier: *tier, points, threads: threads.get(), random_seed: *seed, json: *json };
            let cases = select::matching(pattern)?;
            options.points.of_each(&cases, *tier)?;
            run::run(&places()?, &cases, &options)
        }
        Some(Command::Scene(options)) => scene::scene(options),
        Some(Command::Export { case, out, tier }) => export::export(select::by_id(case)?, *tier, out),
        Some(Command::Compare { case, file, tier, json }) => compare::compare(&places()?, select::by_id(case)?, file, *tier, *json),
        Some(Command::Report) => report::report(&places()?),
    }
}
