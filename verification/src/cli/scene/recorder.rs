//! Writes what a run observes: probe rows, VTK snapshots and checkpoints while it goes on, the rest at its end.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::Path;

use solver::Simulation;
use solver::output::probes::Probes;
use solver::output::{bodies, departures, flow_vtk, vtk};

use super::folder::{BODIES, CHECKPOINT, DEPARTURES, FLOW_SERIES, LEDGER, OutputFolder, PROBES, SERIES, SNAPSHOTS};
use super::schedule::Schedule;
use crate::cli::CommandError;
use crate::cli::files::{create_folder, names_in, write_whole};

/// The outputs of a run and when they are due.
pub struct Recorder {
    probes: Option<ProbeFile>,
    probe_rows: Schedule,
    snapshots: Schedule,
    checkpoints: Schedule,
    /// Steps at which there is a snapshot.
    snapshot_steps: Vec<u64>,
}

struct ProbeFile {
    probes: Probes,
    writer: BufWriter<File>,
}

impl Recorder {
    /// Begins the outputs of a run, or goes on with them: what lies after the checkpoint that the run goes on from is taken away.
    ///
    /// # Errors
    ///
    /// If a file cannot be written, or those of the former run are not what they should be.
    pub fn new(simulation: &Simulation, folder: &OutputFolder) -> Result<Recorder, CommandError> {
        let output = simulation.scene().output.clone();
        let every = |interval: Option<f64>, otherwise| interval.map_or(otherwise, |interval| Schedule::every(interval, simulation));
        let (probe_rows, snapshots) = (every(output.probe_interval, Schedule::EachStep), every(output.vtk_interval, Schedule::Never));
        let checkpoints = every(output.checkpoint_interval, Schedule::Never);
        let probes = Probes::new(simulation);
        let has_probes = !probes.is_empty();
        let snapshot_steps = former_snapshots(&folder.path().join(SNAPSHOTS), simulation.steps_taken())?;
        Ok(Recorder {
            probes: if has_probes { Some(ProbeFile::open(probes, &folder.path().join(PROBES), simulation)?) } else { None },
            probe_rows: if has_probes { probe_rows } else { Schedule::Never },
            snapshots,
            checkpoints,
            snapshot_steps,
        })
    }

    /// The next step at which something is due.
    pub fn next_step(&self, simulation: &Simulation) -> u64 {
        let next = |schedule: Schedule| schedule.next_after(simulation.steps_taken(), simulation);
        next(self.probe_rows).min(next(self.snapshots)).min(next(self.checkpoints))
    }

    /// Writes what is due at the current step.
    ///
    /// # Errors
    ///
    /// If a file cannot be written.
    pub fn record(&mut self, simulation: &mut Simulation, folder: &mut OutputFolder) -> Result<(), CommandError> {
        let step = simulation.steps_taken();
        if let Some(file) = self.probes.as_mut().filter(|_| self.probe_rows.is_due(step, simulation)) {
            let written = file.probes.write_row(&simulation.now(), &mut file.writer);
            written.map_err(|error| CommandError::file("write", &folder.path().join(PROBES), &error))?;
        }
        if self.snapshots.is_due(step, simulation) {
            let path = |name: String| folder.path().join(SNAPSHOTS).join(name);
            write_with(&path(bodies_at(step)), |writer| vtk::write_snapshot(simulation, writer))?;
            if simulation.scene().fluid.is_some() {
                write_with(&path(flow_at(step)), |writer| flow_vtk::write_flow_of(simulation, writer))?;
            }
            self.snapshot_steps.push(step);
        }
        if step > 0 && self.checkpoints.is_due(step, simulation) {
            self.save(simulation, folder)?;
            folder.publish()?;
        }
        Ok(())
    }

    /// Writes a checkpoint, after everything that lies before it.
    fn save(&mut self, simulation: &mut Simulation, folder: &OutputFolder) -> Result<(), CommandError> {
        self.flush(simulation, folder.path())?;
        let checkpoint = simulation.checkpoint();
        let checkpoint = checkpoint.map_err(|error| CommandError::input(format!("cannot write a checkpoint: {error}")))?;
        write_whole(&folder.path().join(CHECKPOINT), &checkpoint)
    }

    fn flush(&mut self, simulation: &Simulation, folder: &Path) -> Result<(), CommandError> {
        if let Some(file) = &mut self.probes {
            file.writer.flush().map_err(|error| CommandError::file("write", &folder.join(PROBES), &error))?;
        }
        if !self.snapshot_steps.is_empty() {
            let time = |step: u64| step as f64 * simulation.time_step();
            let series = |name: fn(u64) -> String, time: &dyn Fn(u64) -> f64| -> Vec<(f64, String)> {
                self.snapshot_steps.iter().map(|step| (time(*step), format!("{SNAPSHOTS}/{}", name(*step)))).collect()
            };
            write_with(&folder.join(SERIES), |writer| vtk::write_series(&series(bodies_at, &time), writer))?;
            if let Some(fluid) = &simulation.scene().fluid {
                // The fluid is that of its last whole step.
                let of_flow = |step: u64| (time(step) / fluid.step * (1.0 + 4.0 * f64::EPSILON)).floor() * fluid.step;
                write_with(&folder.join(FLOW_SERIES), |writer| vtk::write_series(&series(flow_at, &of_flow), writer))?;
            }
        }
        Ok(())
    }

    /// Writes the final state, the ledger and, for a run that has come to its end, the last checkpoint.
    ///
    /// # Errors
    ///
    /// If a file cannot be written.
    pub fn finish(&mut self, simulation: &mut Simulation, folder: &mut OutputFolder, is_whole: bool) -> Result<(), CommandError> {
        write_with(&folder.path().join(BODIES), |writer| bodies::write(simulation, writer))?;
        if !simulation.scene().outlets.is_empty() {
            write_with(&folder.path().join(DEPARTURES), |writer| departures::write(simulation, writer))?;
        }
        let ledger = serde_json::to_string_pretty(&simulation.ledger());
        let ledger = ledger.map_err(|error| CommandError::input(format!("cannot write the ledger: {error}")))?;
        write_whole(&folder.path().join(LEDGER), &(ledger + "\n"))?;
        if is_whole {
            self.save(simulation, folder)?;
        } else {
            self.flush(simulation, folder.path())?;
        }
        folder.publish()
    }
}

impl ProbeFile {
    fn open(probes: Probes, path: &Path, simulation: &Simulation) -> Result<ProbeFile, CommandError> {
        let failed = |error: io::Error| CommandError::file("write", path, &error);
        let mut head = Vec::new();
        probes.write_head(&mut head).map_err(failed)?;
        if simulation.steps_taken() > 0 {
            let length = length_up_to(path, &head, simulation.time())?;
            let file = OpenOptions::new().append(true).open(path).map_err(failed)?;
            file.set_len(length).map_err(failed)?;
            return Ok(ProbeFile { probes, writer: BufWriter::new(file) });
        }
        let mut writer = BufWriter::new(File::create(path).map_err(failed)?);
        writer.write_all(&head).map_err(failed)?;
        Ok(ProbeFile { probes, writer })
    }
}

/// Bytes of probes.csv up to the last whole row at or before a time.
fn length_up_to(path: &Path, head: &[u8], time: f64) -> Result<u64, CommandError> {
    let failed = |error: io::Error| CommandError::file("read", path, &error);
    let mut reader = BufReader::new(File::open(path).map_err(failed)?);
    let (mut line, mut length, mut number) = (Vec::new(), 0, 0);
    loop {
        line.clear();
        number += 1;
        reader.read_until(b'\n', &mut line).map_err(failed)?;
        if number <= 2 {
            if head.split_inclusive(|byte| *byte == b'\n').nth(number - 1) != Some(&line) {
                return Err(CommandError::input(format!("`{}`: line {number} does not belong to the probes of the scene", path.display())));
            }
        } else if line.last() != Some(&b'\n') {
            // The end, or a row that was cut off.
            return Ok(length);
        } else {
            let text = String::from_utf8_lossy(&line);
            let row_time: Option<f64> = text.split(',').next().and_then(|time| time.trim().parse().ok());
            match row_time {
                Some(row_time) if row_time <= time => {}
                Some(_) => return Ok(length),
                None => return Err(CommandError::input(format!("`{}`: line {number} is not a row of probes", path.display()))),
            }
        }
        length += line.len() as u64;
    }
}

/// Name of the snapshot of bodies at a step.
fn bodies_at(step: u64) -> String {
    format!("step_{step:08}.vtu")
}

/// Name of the snapshot of the fluid at a step.
fn flow_at(step: u64) -> String {
    format!("flow_{step:08}.vti")
}

/// The step of a snapshot of bodies, and of one of the fluid.
fn step_in(name: &str) -> Option<(u64, bool)> {
    let of = |start: &str, end: &str| name.strip_prefix(start)?.strip_suffix(end)?.parse().ok();
    of("step_", ".vtu").map(|step| (step, true)).or_else(|| Some((of("flow_", ".vti")?, false)))
}

/// Steps of the snapshots in a folder; those after a step are taken away.
fn former_snapshots(folder: &Path, last: u64) -> Result<Vec<u64>, CommandError> {
    let mut steps = Vec::new();
    for name in names_in(folder)? {
        let Some((step, is_of_bodies)) = step_in(&name) else { continue };
        if step <= last {
            steps.extend(is_of_bodies.then_some(step));
        } else {
            let path = folder.join(name);
            fs::remove_file(&path).map_err(|error| CommandError::file("remove the snapshot", &path, &error))?;
        }
    }
    steps.sort_unstable();
    Ok(steps)
}

/// Writes a file whole from what a function writes.
fn write_with(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), CommandError> {
    let mut content = Vec::new();
    write(&mut content).map_err(|error| CommandError::file("write", path, &error))?;
    if let Some(folder) = path.parent() {
        create_folder(folder)?;
    }
    write_whole(path, &String::from_utf8_lossy(&content))
}
