//! Checkpoints: the whole state of a run as JSON text, exact to the bit.

use serde::{Deserialize, Serialize};

use crate::bodies::State;
use crate::broad_phase::neighbour_list::ListState;
use crate::openings::{Openings, Record};
use crate::scheme::hard::Counts;
use crate::scheme::resolved::{ResolvedFlow, SavedFlow};
use crate::{Scene, SceneError, Simulation};

/// Version of the format.
const FORMAT: u32 = 3;

/// Why a run cannot be resumed.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// The text is not a checkpoint.
    #[error("not a checkpoint: {0}")]
    Format(#[from] serde_json::Error),
    /// A checkpoint of another format.
    #[error("the checkpoint has format {found}, this version reads format {FORMAT}")]
    Version {
        /// Its format.
        found: u32,
    },
    /// A checkpoint of another scene.
    #[error(
        "the checkpoint belongs to another scene (`{found}`); only end_time, settled, output, and times of motions of walls that are still to come may differ between a run and its continuation"
    )]
    OtherScene {
        /// Name of its scene.
        found: String,
    },
    /// The scene of the checkpoint does not build.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Checkpoint {
    format: u32,
    scene: Scene,
    steps_taken: u64,
    body_steps: u64,
    synchronous: bool,
    forces_are_current: bool,
    /// Ids of the bodies in the order in which they are stored.
    ids: Vec<u32>,
    state: State,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    neighbours: Option<ListState>,
    contacts: Vec<serde_json::Value>,
    turns: Vec<u64>,
    /// Who has come and gone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    passed: Option<Record>,
    /// Since which step bodies are at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    quiet_since: Option<u64>,
    /// Work of hard contacts; the rest of their state is the motion of the bodies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    hard: Option<Counts>,
    /// The fluid between the bodies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    flow: Option<SavedFlow>,
}

impl Simulation {
    /// The state of the run.
    ///
    /// # Errors
    ///
    /// [`CheckpointError::Format`] if the state holds numbers that are not finite.
    pub fn checkpoint(&self) -> Result<String, CheckpointError> {
        let contacts = self.stages.contacts.iter().map(|stage| stage.save(&self.bodies)).collect::<Result<_, _>>()?;
        let checkpoint = Checkpoint {
            format: FORMAT,
            scene: self.scene.clone(),
            steps_taken: self.steps_taken,
            body_steps: self.body_steps,
            synchronous: self.kind.synchronous,
            forces_are_current: self.forces_are_current,
            ids: (0..self.bodies.len()).map(|index| self.bodies.id(index)).collect(),
            state: self.bodies.state.clone(),
            neighbours: self.stages.neighbours.as_ref().and_then(|neighbours| neighbours.state()),
            contacts,
            turns: self.stages.rotation.iter().map(|stage| stage.turns()).collect(),
            passed: self.openings.as_ref().map(|openings| openings.record().clone()),
            quiet_since: self.rest.as_ref().and_then(|rest| rest.quiet_since),
            hard: self.stages.hard.as_ref().map(|hard| hard.counts),
            flow: self.stages.flow.as_ref().map(ResolvedFlow::save),
        };
        Ok(serde_json::to_string(&checkpoint)?)
    }

    /// The run that a checkpoint of the same scene holds; it goes on bitwise as if it had never stopped.
    ///
    /// When a motion of a wall begins or ends, or a wall is taken away, may be told anew as long as it is still to come: bodies are filled in, settle for as
    /// long as they need, and then a gate opens.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`] if the text is not a checkpoint of this scene.
    pub fn resume(scene: &Scene, text: &str) -> Result<Simulation, CheckpointError> {
        let checkpoint: Checkpoint = serde_json::from_str(text)?;
        if checkpoint.format != FORMAT {
            return Err(CheckpointError::Version { found: checkpoint.format });
        }
        let mut simulation = scene.build()?;
        let other = || CheckpointError::OtherScene { found: checkpoint.scene.scene.name.clone() };
        let has_passed = match (&mut simulation.openings, checkpoint.passed) {
            (Some(openings), Some(record)) => openings.restore(record, &mut simulation.bodies),
            (openings, record) => (openings.is_none() && record.is_none()).then_some(()),
        };
        let order: Option<Vec<u32>> = checkpoint.ids.iter().map(|id| Some(simulation.bodies.index_of(*id)? as u32)).collect();
        let is_whole = |order: &Vec<u32>| {
            let places: std::collections::BTreeSet<_> = order.iter().collect();
            let still_out = simulation.openings.as_ref().map_or(0, Openings::still_out);
            let there = simulation.ids.len().checked_sub(still_out + simulation.departures().len());
            checkpoint.state.is_of(order.len()) && places.len() == order.len() && Some(order.len()) == there
        };
        let time = checkpoint.steps_taken as f64 * simulation.kind.step;
        let is_same = same_physics(scene, &checkpoint.scene, time) && has_passed.is_some();
        let order = order.filter(|order| is_same && is_whole(order)).ok_or_else(other)?;
        simulation.bodies.reorder(&order);
        simulation.steps_taken = checkpoint.steps_taken;
        simulation.body_steps = checkpoint.body_steps;
        if let Some(rest) = simulation.rest.as_mut() {
            // Rest by another criterion begins anew.
            rest.quiet_since = checkpoint.quiet_since.filter(|_| scene.scene.settled == checkpoint.scene.scene.settled);
        }
        simulation.kind.synchronous = checkpoint.synchronous;
        simulation.bodies.state = checkpoint.state;
        // Forces are evaluated once per instant, because that changes contact memory: a run stopped after it goes on after it.
        simulation.forces_are_current = checkpoint.forces_are_current;
        simulation.stages.find_bodies_that_turn(&simulation.bodies);
        if let Some(neighbours) = &mut simulation.stages.neighbours {
            neighbours.restore(checkpoint.neighbours, &simulation.bodies, &mut simulation.stages.contacts);
        }
        for (stage, saved) in simulation.stages.contacts.iter_mut().zip(checkpoint.contacts) {
            stage.restore(&simulation.bodies, saved)?;
        }
        // Whoever looks at contacts whose forces are current sees walls where they were for these.
        let time = simulation.time();
        simulation.stages.contacts.iter_mut().for_each(|stage| stage.set_time(time));
        for (stage, turns) in simulation.stages.rotation.iter_mut().zip(checkpoint.turns) {
            stage.set_turns(turns);
        }
        if let (Some(hard), Some(counts)) = (&mut simulation.stages.hard, checkpoint.hard) {
            hard.counts = counts;
        }
        match (&mut simulation.stages.flow, checkpoint.flow) {
            (Some(flow), Some(saved)) => flow.restore(saved).ok_or_else(other)?,
            (None, None) => {}
            _ => return Err(other()),
        }
        Ok(simulation)
    }
}

/// Whether two scenes differ in nothing that changes the motion up to a time in s.
fn same_physics(one: &Scene, other: &Scene, time: f64) -> bool {
    let until = |scene: &Scene| Scene {
        boundaries: scene.boundaries.iter().map(|boundary| boundary.known_until(time)).collect(),
        output: crate::scene::Output { sphere_orientation: scene.output.sphere_orientation, ..one.output.clone() },
        ..scene.clone()
    };
    let (one, mut other) = (until(one), until(other));
    other.scene.end_time = one.scene.end_time;
    other.scene.settled.clone_from(&one.scene.settled);
    one == other
}
