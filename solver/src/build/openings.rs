//! Where bodies leave a scene and come in during the run.

use super::SceneWall;
use super::insertion::{Source, stream_of_places, turned, window_of};
use super::shapes::ResolvedShape;
use crate::bodies::BodySpecification;
use crate::boundary::MovingWall;
use crate::insertion::{Inflow, InflowState, NewBody, Schedule};
use crate::openings::{Inlet, Openings, Outlet};
use crate::scene::{Insertion, OutletRegion, Scene, SceneError, SceneErrorKind};
use crate::{Orientation, Vector};

impl Scene {
    /// Outlets and inlets; `None` if there are neither. `first_id` is above the ids of all bodies that are there at the start.
    pub(super) fn openings(&self, shapes: &[ResolvedShape], walls: &[SceneWall], first_id: u64) -> Result<Option<Openings>, SceneError> {
        let inlets: Vec<Inlet> =
            self.insertions.iter().enumerate().filter_map(|(index, insertion)| self.inlet(index, insertion, shapes, walls)).collect();
        let outlets: Vec<(String, Outlet)> = self.outlets.iter().map(|table| (table.name.clone(), outlet_of(&table.region))).collect();
        if inlets.is_empty() && outlets.is_empty() {
            return Ok(None);
        }
        let is_hard = self.pairs.iter().any(|pair| matches!(pair.normal, crate::scene::NormalLaw::Impulse(_)));
        if is_hard {
            let during_run = self.insertions.iter().position(|insertion| insertion.during_run.is_some());
            let key = during_run.map_or("outlet[0]".to_string(), |index| format!("insertion[{index}].during_run"));
            let message = "hard bodies can neither come nor leave during the run: leave it out, or give a soft contact law";
            return Err(SceneError::new(SceneErrorKind::Unsupported, key, message));
        }
        let coming: u64 = inlets.iter().map(|inlet| inlet.waiting.len() as u64).sum();
        if first_id + coming > u64::from(u32::MAX) {
            let message = format!("ids from {first_id} on do not suffice for {coming} bodies that come: give smaller ids to the others");
            return Err(SceneError::new(SceneErrorKind::Combination, "body", message));
        }
        Ok(Some(Openings::new(outlets, inlets, self.periodic_domain(), first_id as u32)))
    }

    fn inlet(&self, index: usize, insertion: &Insertion, shapes: &[ResolvedShape], walls: &[SceneWall]) -> Option<Inlet> {
        let (during, window) = (insertion.during_run.as_ref()?, window_of(&insertion.region)?);
        let (population, source) = (self.population(index, shapes), self.source(index, shapes));
        let waiting = waiting(&source, (0..population.len()).filter_map(|number| population.body(number)));
        let inflow = Inflow {
            population,
            window,
            turned: turned(&insertion.orientation),
            schedule: Schedule {
                start: during.start,
                rate: during.rate.unwrap_or(f64::INFINITY),
                attempts_per_step: during.attempts_per_step,
                patience: during.patience.unwrap_or(f64::INFINITY),
            },
            random: (self.scene.random_seed, stream_of_places(index)),
            state: InflowState::default(),
        };
        let touched = |wall: &&SceneWall| self.has_pair(&insertion.material, &self.boundaries[wall.boundary].material);
        let walls: Vec<MovingWall> = walls.iter().filter(touched).map(|wall| wall.wall.clone()).collect();
        Some(Inlet { name: insertion.name.clone(), inflow, waiting, walls })
    }
}

/// Bodies that have no place yet.
fn waiting(source: &Source, bodies: impl Iterator<Item = (usize, f64)>) -> Vec<BodySpecification> {
    let nowhere = |(kind, scale)| NewBody { kind, scale, radius: 0.0, position: Vector::zeros(), orientation: Orientation::identity() };
    bodies.map(|body| source.specification(&nowhere(body), 0)).collect()
}

fn outlet_of(region: &OutletRegion) -> Outlet {
    match region {
        OutletRegion::BehindPlane(plane) => Outlet::Behind { point: plane.point.into(), normal: Vector::from(plane.normal).normalize() },
        OutletRegion::Box(region) => Outlet::Box { lower: region.lower.into(), upper: region.upper.into() },
    }
}
