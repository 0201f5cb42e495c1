//! `touchstone scene`: runs any scene file.

mod folder;
mod keys;
mod message;
mod recorder;
mod schedule;

use std::path::Path;

use serde_json::json;
use solver::output::checkpoint::CheckpointError;
use solver::{Scene, Simulation};

use super::arguments::SceneOptions;
use super::files::read_text;
use super::progress::Progress;
use super::{CommandError, Finish, print};
use folder::OutputFolder;
use recorder::Recorder;

/// Steps between two looks at the clock of the progress bar.
const PROGRESS_INTERVAL: u64 = 1000;

/// A scene file and the scene in it.
struct SceneFile {
    name: String,
    text: String,
    scene: Scene,
}

/// Runs a scene, or prints the reference of scene keys.
///
/// # Errors
///
/// [`CommandError::Input`] for a wrong scene or place, in which case nothing is left behind; [`CommandError::Stopped`] if a guard stops the
/// run, in which case the rows so far are kept.
pub fn scene(options: &SceneOptions) -> Result<Finish, CommandError> {
    let (Some(file), Some(out)) = (&options.file, &options.out) else {
        keys::print(options.json);
        return Ok(Finish::Met);
    };
    let file = SceneFile::read(file)?;
    let (simulation, folder) = if options.resume {
        let folder = OutputFolder::of_former_run(out)?;
        (file.resume(&folder)?, folder)
    } else {
        let simulation = file.build()?;
        (simulation, OutputFolder::new(out, options.overwrite)?)
    };
    run(simulation, folder, options.json)
}

impl SceneFile {
    fn read(path: &Path) -> Result<SceneFile, CommandError> {
        let text = read_text(path)?;
        let name = path.display().to_string();
        let scene = Scene::from_toml(&text, &name).map_err(|error| CommandError::input(message::with_source_line(&error, &text)))?;
        Ok(SceneFile { name, text, scene })
    }

    fn build(&self) -> Result<Simulation, CommandError> {
        self.scene.build().map_err(|error| self.locate(error))
    }

    fn resume(&self, folder: &OutputFolder) -> Result<Simulation, CommandError> {
        let path = folder.path().join(folder::CHECKPOINT);
        let text = read_text(&path)?;
        let simulation = Simulation::resume(&self.scene, &text).map_err(|error| match error {
            CheckpointError::Scene(error) => self.locate(error),
            error => CommandError::input(format!("cannot resume `{}` from `{}`: {error}", self.name, path.display())),
        })?;
        let end_time = self.scene.scene.end_time;
        if simulation.steps_taken() > simulation.steps_to(end_time) {
            let time = simulation.time();
            let message = format!("{}: `scene.end_time`: the checkpoint is at t = {time} s already, beyond {end_time} s", self.name);
            return Err(CommandError::input(message));
        }
        Ok(simulation)
    }

    fn locate(&self, error: solver::SceneError) -> CommandError {
        let error = Scene::locate(&self.text, &self.name, error);
        CommandError::input(message::with_source_line(&error, &self.text))
    }
}

fn run(mut simulation: Simulation, mut folder: OutputFolder, json: bool) -> Result<Finish, CommandError> {
    let name = simulation.scene().scene.name.clone();
    let progress = Progress::new();
    let bar = progress.bar(&name);
    let mut recorder = Recorder::new(&simulation, &folder)?;
    let (first, last) = (simulation.steps_taken(), simulation.steps_to(simulation.scene().scene.end_time));
    let body_steps_before = simulation.body_steps();
    if first == 0 {
        recorder.record(&mut simulation, &mut folder)?;
    }
    while simulation.steps_taken() < last && !simulation.has_settled() {
        let now = simulation.steps_taken();
        let next = recorder.next_step(&simulation).min(now + PROGRESS_INTERVAL).min(last);
        if let Err(error) = simulation.run_until(simulation.time_step() * next as f64) {
            recorder.finish(&mut simulation, &mut folder, false)?;
            return Err(CommandError::Stopped(format!("{error} (rows until then are in `{}`)", folder.path().display())));
        }
        recorder.record(&mut simulation, &mut folder)?;
        bar.set(simulation.steps_taken() - first, last - first);
        bar.set_rate(simulation.body_steps() - body_steps_before, "particle-steps");
    }
    recorder.finish(&mut simulation, &mut folder, true)?;
    drop(bar);
    summarise(&simulation, &folder, json);
    Ok(Finish::Met)
}

fn summarise(simulation: &Simulation, folder: &OutputFolder, json: bool) {
    let (name, out) = (&simulation.scene().scene.name, folder.path().display().to_string());
    let (steps, step, time) = (simulation.steps_taken(), simulation.time_step(), simulation.time());
    let settled = simulation.has_settled();
    if json {
        let stages = &simulation.ledger().entries;
        print::json(
            &json!({ "scene": name, "out": out, "steps": steps, "time_step": step, "time": time, "settled": settled, "ledger": stages }),
        );
        return;
    }
    let at_rest = if settled { ", at rest" } else { "" };
    print::line(&format!("{name}: {steps} steps of {step} s to t = {time} s{at_rest}"));
    print::line(simulation.ledger().to_string().trim_end());
    print::line(&format!("written to {out}"));
}
