//! Bodies that wait to come in: which, and where there is room for them.

use crate::bodies::BodySpecification;
use crate::boundary::{MovingWall, PlacedWall};
use crate::domain::Domain;
use crate::insertion::{Inflow, NewBody, NoRoom};
use crate::{Bodies, Vector};

/// Bodies of one `[[insertion]]` that come during the run.
#[derive(Debug, Clone, PartialEq)]
pub struct Inlet {
    /// Name for ledgers and errors.
    pub name: String,
    /// When and where they come.
    pub inflow: Inflow,
    /// What each of them is made from, in the order in which they come; places and turns are those of the inflow.
    pub waiting: Vec<BodySpecification>,
    /// Walls that they would touch.
    pub walls: Vec<MovingWall>,
}

impl Inlet {
    /// Lets in what is due at a time in s and finds room: clear of all bodies, of their images, and of walls.
    ///
    /// # Errors
    ///
    /// A body has waited for longer than its patience.
    pub(super) fn due(&mut self, bodies: &Bodies, domain: Option<&Domain>, time: f64) -> Result<Vec<NewBody>, NoRoom> {
        if self.inflow.next_due().is_none_or(|due| due > time) {
            return Ok(Vec::new());
        }
        let near = self.near_window(bodies, domain);
        let walls: Vec<PlacedWall<'_>> = self.walls.iter().filter_map(|wall| wall.at(time)).collect();
        let is_free = |position: &Vector, radius: f64| {
            near.iter().all(|(other, reach)| (other - position).norm_squared() >= (radius + reach).powi(2))
                && walls.iter().all(|wall| wall.distance(position) >= radius)
        };
        self.inflow.due(time, domain, is_free)
    }

    /// Balls about bodies, and their images, that may be in the way of one whose centre is in the window.
    fn near_window(&self, bodies: &Bodies, domain: Option<&Domain>) -> Vec<(Vector, f64)> {
        let [lower, upper] = self.inflow.window.bounds();
        let largest = self.inflow.population.largest_radius();
        let mut near = Vec::new();
        for body in &bodies.state.motion {
            let reach = body.radius + largest;
            let mut add_if_near = |place: Vector| {
                if (place - place.sup(&lower).inf(&upper)).norm_squared() < reach * reach {
                    near.push((place, body.radius));
                }
            };
            let place = domain.map_or(body.position, |domain| domain.wrapped(&body.position));
            add_if_near(place);
            domain.into_iter().flat_map(|domain| domain.images_near(&place, reach)).for_each(|(_, image)| add_if_near(image));
        }
        near
    }
}
