//! What a flow with bodies remembers from step to step, as a checkpoint keeps it.

use serde::{Deserialize, Serialize};

use super::{Memory, Two, Unsteady, UnsteadyError, ghosts};
use crate::coupling::resolved::balance::Motion;
use crate::coupling::resolved::constraint::Load;
use crate::fluid::grid::FaceField;
use crate::{Orientation, Vector};

/// The state of a flow; rates, ghosts and inverses follow from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlowState {
    time: f64,
    has_stepped: bool,
    velocity: Two<FaceField>,
    forces: FaceField,
    loads: Vec<Load>,
    memory: Vec<Memory>,
    motions: Vec<Motion>,
    bodies: Vec<Place>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Place {
    position: Vector,
    orientation: Orientation,
    velocity: Vector,
    angular_velocity: Vector,
}

impl Unsteady {
    /// The state of now.
    pub fn state(&self) -> FlowState {
        let place = |body: &super::Body| Place {
            position: body.immersed.position,
            orientation: body.immersed.orientation,
            velocity: body.immersed.velocity,
            angular_velocity: body.immersed.angular_velocity,
        };
        FlowState {
            time: self.time,
            has_stepped: self.rates.is_some(),
            velocity: self.velocity.clone(),
            forces: self.forces.clone(),
            loads: self.loads.clone(),
            memory: self.memory.clone(),
            motions: self.motions.clone(),
            bodies: self.bodies.iter().map(place).collect(),
        }
    }

    /// Goes on from a state, to the bit; tells whether it is one of such a flow, which is left as it was otherwise.
    ///
    /// # Errors
    ///
    /// [`UnsteadyError::Immersion`] if the grid cannot hold its bodies.
    pub fn restore(&mut self, state: FlowState) -> Result<bool, UnsteadyError> {
        let cells = self.flow.grid().len();
        let is_field = |field: &FaceField| field.component.iter().all(|values| values.len() == cells);
        let bodies = self.bodies.len();
        let counts = [state.memory.len(), state.motions.len(), state.bodies.len()];
        let fits = state.velocity.iter().chain([&state.forces]).all(is_field)
            && counts.iter().all(|count| *count == bodies)
            && state.loads.len() == self.loads.len();
        if !fits {
            return Ok(false);
        }
        for (body, place) in self.bodies.iter_mut().zip(&state.bodies) {
            let immersed = &mut body.immersed;
            (immersed.position, immersed.orientation) = (place.position, place.orientation);
            (immersed.velocity, immersed.angular_velocity) = (place.velocity, place.angular_velocity);
        }
        self.ghosts = ghosts(self.flow.grid(), &self.bodies, &self.walls, &self.settings, state.time)?;
        let rates = state.has_stepped.then(|| self.rates_of(&state.velocity[1]));
        (self.time, self.velocity, self.forces, self.rates) = (state.time, state.velocity, state.forces, rates);
        (self.loads, self.memory, self.motions, self.sheets) = (state.loads, state.memory, state.motions, None);
        Ok(true)
    }
}
