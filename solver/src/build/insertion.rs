//! Bodies of a scene that come in numbers, as far as they are there before the start.

use std::sync::Arc;

use super::boundaries::SceneWall;
use super::shapes::{ResolvedShape, orientation_of};
use crate::Vector;
use crate::bodies::BodySpecification;
use crate::boundary::PlacedWall;
use crate::insertion::{Kind, Lattice, NewBody, Occupancy, Population, Turned, Window};
use crate::scene::{InsertedOrientation, Insertion, InsertionRegion, Scene, SceneError, SceneErrorKind};
use crate::shape::{Convex, Shape, Sphere};

/// More sites than anybody waits for.
const LARGEST_NUMBER_OF_SITES: usize = 100_000_000;
/// A jitter, in radii, that is rounding of none.
const ROUNDING: f64 = 1e-12;

/// What inserted bodies are made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// Shape of each kind.
    shapes: Vec<Arc<Shape>>,
    material: usize,
    /// In kg/m^3.
    density: f64,
    velocity: Vector,
    angular_velocity: Vector,
}

impl Source {
    /// The body that has found room, under an id.
    pub fn specification(&self, body: &NewBody, id: u32) -> BodySpecification {
        let shape = scaled(&self.shapes[body.kind], body.scale);
        let mass = self.density * shape.volume();
        BodySpecification {
            id,
            material: self.material,
            mass,
            inertia: shape.specific_inertia() * mass,
            position: body.position,
            velocity: self.velocity,
            orientation: body.orientation * shape.axes(),
            angular_velocity: self.angular_velocity,
            shape,
        }
    }
}

/// A shape of another size; validation lets only spheres through.
fn scaled(shape: &Arc<Shape>, scale: f64) -> Arc<Shape> {
    match shape.as_sphere() {
        Some(sphere) if scale != 1.0 => Arc::new(Shape::of_one(Convex::Sphere(Sphere { radius: sphere.radius * scale }))),
        _ => shape.clone(),
    }
}

impl Scene {
    /// Adds the bodies that come before the start to those that are listed, clear of them, of each other and of the walls that they would touch; a remark on
    /// each insertion for the ledger.
    pub(super) fn insert_before_the_start(
        &self,
        shapes: &[ResolvedShape],
        walls: &[SceneWall],
        bodies: &mut Vec<BodySpecification>,
    ) -> Result<Vec<(String, String)>, SceneError> {
        let insertions: Vec<_> = self.insertions.iter().enumerate().filter(|(_, insertion)| insertion.during_run.is_none()).collect();
        if insertions.is_empty() {
            return Ok(Vec::new());
        }
        let mut remarks = Vec::new();
        let ready: Vec<_> = insertions.iter().map(|(index, _)| (self.population(*index, shapes), self.source(*index, shapes))).collect();
        let mut taken =
            grid_over(bodies, insertions.iter().map(|(_, insertion)| insertion).zip(ready.iter().map(|(population, _)| population)));
        for ((index, insertion), (population, source)) in insertions.into_iter().zip(&ready) {
            let met: Vec<PlacedWall<'_>> = walls
                .iter()
                .filter(|wall| self.has_pair(&insertion.material, &self.boundaries[wall.boundary].material))
                .filter_map(|wall| wall.wall.at(0.0))
                .collect();
            let is_clear = |position: &Vector, radius: f64| met.iter().all(|wall| wall.distance(position) >= radius);
            let placed = place(index, insertion, self.scene.random_seed, population, &mut taken, is_clear)?;
            let first = bodies.iter().map(|body| body.id).max().map_or(0, |id| u64::from(id) + 1);
            if first + placed.len() as u64 > u64::from(u32::MAX) {
                let message = format!("ids from {first} on do not suffice for {} bodies: give smaller ids to the others", placed.len());
                return Err(SceneError::new(SceneErrorKind::Combination, format!("insertion[{index}].number"), message));
            }
            bodies.extend((first as u32..).zip(&placed).map(|(id, body)| source.specification(body, id)));
            let remark = format!("{} bodies in a {} before the start, ids from {first}", placed.len(), insertion.region.name());
            remarks.push((format!("insertion `{}`", insertion.name), remark));
        }
        Ok(remarks)
    }

    pub(super) fn population(&self, index: usize, shapes: &[ResolvedShape]) -> Population {
        let insertion = &self.insertions[index];
        let radii = shapes_of(insertion, shapes).into_iter().map(|shape| shape.bounding_radius());
        let kind = |(inserted, radius): (&crate::scene::InsertedShape, f64)| Kind {
            radius,
            fraction: inserted.fraction,
            scale: inserted.scale.unwrap_or([1.0; 2]),
        };
        let kinds = insertion.shapes.iter().zip(radii).map(kind).collect();
        Population::new(kinds, insertion.number as usize, self.scene.random_seed, stream_of_population(index))
    }

    pub(super) fn source(&self, index: usize, shapes: &[ResolvedShape]) -> Source {
        let insertion = &self.insertions[index];
        let material = self.material_index(&insertion.material);
        Source {
            shapes: shapes_of(insertion, shapes),
            material,
            // Validation has found the material and its density.
            density: self.materials.get(material).and_then(|material| material.density).unwrap_or(f64::NAN),
            velocity: insertion.velocity.into(),
            angular_velocity: insertion.angular_velocity.into(),
        }
    }

    pub(super) fn has_pair(&self, one: &str, other: &str) -> bool {
        self.pairs.iter().any(|pair| {
            let [first, second] = [pair.materials[0].as_str(), pair.materials[1].as_str()];
            (first, second) == (one, other) || (second, first) == (one, other)
        })
    }
}

/// Each insertion has a stream of kinds and sizes and one of places.
fn stream_of_population(index: usize) -> u64 {
    2 * index as u64
}

pub(super) fn stream_of_places(index: usize) -> u64 {
    2 * index as u64 + 1
}

/// Validation has found every name.
fn shapes_of(insertion: &Insertion, shapes: &[ResolvedShape]) -> Vec<Arc<Shape>> {
    let of =
        |inserted: &crate::scene::InsertedShape| shapes.iter().find(|shape| shape.name == inserted.shape).map(|found| found.shape.clone());
    insertion.shapes.iter().filter_map(of).collect()
}

pub(super) fn turned(orientation: &InsertedOrientation) -> Turned {
    match orientation {
        InsertedOrientation::Quaternion(quaternion) => Turned::As(orientation_of(quaternion)),
        InsertedOrientation::Drawn(_) => Turned::Random,
    }
}

/// The window that a region is; `None` for a lattice.
pub(super) fn window_of(region: &InsertionRegion) -> Option<Window> {
    Some(match region {
        InsertionRegion::Lattice(_) => return None,
        InsertionRegion::Point(point) => Window::Point(point.position.into()),
        InsertionRegion::Rectangle(rectangle) => {
            Window::Rectangle { corner: rectangle.corner.into(), edges: [rectangle.first_edge.into(), rectangle.second_edge.into()] }
        }
        InsertionRegion::Box(region) => Window::Box { lower: region.lower.into(), upper: region.upper.into() },
    })
}

/// A grid over all bodies that are listed and all that will be placed, with those that are listed in it.
fn grid_over<'a>(bodies: &[BodySpecification], insertions: impl Iterator<Item = (&'a &'a Insertion, &'a Population)>) -> Occupancy {
    let (mut lower, mut upper) = (Vector::repeat(f64::INFINITY), Vector::repeat(f64::NEG_INFINITY));
    let (mut largest, mut count) = (0.0_f64, bodies.len());
    for body in bodies {
        (lower, upper) = (lower.inf(&body.position), upper.sup(&body.position));
        largest = largest.max(body.shape.bounding_radius());
    }
    for (insertion, population) in insertions {
        let [least, most] = match &insertion.region {
            InsertionRegion::Lattice(lattice) => [lattice.lower.into(), lattice.upper.into()],
            region => window_of(region).map_or([lower, upper], |window| window.bounds()),
        };
        (lower, upper) = (lower.inf(&least), upper.sup(&most));
        (largest, count) = (largest.max(population.largest_radius()), count + population.len());
    }
    let mut taken = Occupancy::new(lower, upper, largest, count);
    bodies.iter().for_each(|body| taken.add(body.position, body.shape.bounding_radius()));
    taken
}

/// All bodies of one insertion, and the places they take.
fn place(
    index: usize,
    insertion: &Insertion,
    seed: u64,
    population: &Population,
    taken: &mut Occupancy,
    is_clear: impl Fn(&Vector, f64) -> bool,
) -> Result<Vec<NewBody>, SceneError> {
    let key = format!("insertion[{index}]");
    let no_room = |error: crate::insertion::NoRoom| {
        SceneError::new(SceneErrorKind::Overlap, format!("{key}.number"), format!("`{}`: {error}", insertion.name))
    };
    let (turned, random) = (turned(&insertion.orientation), (seed, stream_of_places(index)));
    if let InsertionRegion::Lattice(region) = &insertion.region {
        let lattice =
            Lattice { lower: region.lower.into(), upper: region.upper.into(), spacing: region.spacing.into(), jitter: region.jitter };
        check_lattice(&format!("{key}.region.lattice"), &lattice, population.largest_radius())?;
        let is_free = |position: &Vector, radius: f64| taken.is_free(position, radius) && is_clear(position, radius);
        let placed = lattice.fill(population, &turned, random, is_free).map_err(no_room)?;
        placed.iter().for_each(|body| taken.add(body.position, body.radius));
        return Ok(placed);
    }
    // A region that is no lattice is a window.
    let Some(window) = window_of(&insertion.region) else { return Ok(Vec::new()) };
    window.fill(population, &turned, random, u64::from(insertion.attempts), taken, is_clear).map_err(no_room)
}

/// A lattice on which bodies cannot overlap, however they are shifted.
fn check_lattice(key: &str, lattice: &Lattice, radius: f64) -> Result<(), SceneError> {
    let refuse = |name: &str, message: String| Err(SceneError::new(SceneErrorKind::Combination, format!("{key}.{name}"), message));
    let most = lattice.largest_jitter(radius);
    if most < -ROUNDING * radius {
        return refuse("spacing", format!("{} m is below the diameter of the largest body, {} m", lattice.spacing.min(), 2.0 * radius));
    }
    if lattice.jitter > most.max(0.0) + ROUNDING * radius {
        return refuse("jitter", format!("{} m lets bodies overlap: at most {} m", lattice.jitter, most.max(0.0)));
    }
    let sites = lattice.number_of_sites();
    if sites > LARGEST_NUMBER_OF_SITES {
        return refuse("spacing", format!("makes {sites} sites; at most {LARGEST_NUMBER_OF_SITES}: give a smaller box"));
    }
    Ok(())
}
