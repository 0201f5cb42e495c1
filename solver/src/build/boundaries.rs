//! Walls of a scene: tables to geometry and motion.

use crate::Vector;
use crate::boundary::{
    Cylinder, Mesh, Motion, MovingWall, Oscillation, Plane, Plate, Translation, Turn, Wall,
    hopper::{self, Hopper},
};
use crate::scene::{Boundary, BoundaryGeometry, BoundaryMotion, Scene, SceneError, SceneErrorKind};

/// A wall of a scene: a box is several.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneWall {
    /// The wall and how it moves.
    pub wall: MovingWall,
    /// Index of its `[[boundary]]`.
    pub boundary: usize,
}

impl Scene {
    /// All walls, boxes as their planes: planes at rest first, then the others, each in the order of the scene.
    ///
    /// # Errors
    ///
    /// Corners that are no plate, triangles that are no surface.
    pub fn moving_walls(&self) -> Result<Vec<SceneWall>, SceneError> {
        let mut walls = Vec::with_capacity(self.boundaries.len());
        for (boundary, table) in self.boundaries.iter().enumerate() {
            let motion = table.motion.as_ref().map_or(Motion::default(), motion_of);
            let moving = |wall| SceneWall { wall: MovingWall { wall, motion }, boundary };
            walls.extend(walls_of(&format!("boundary[{boundary}].geometry"), &table.geometry)?.into_iter().map(moving));
        }
        walls.sort_by_key(|wall| wall.wall.plane_at_rest().is_none());
        Ok(walls)
    }

    /// Boundaries of all walls, in the order of [`Scene::moving_walls`].
    fn boundaries_of_walls(&self) -> impl Iterator<Item = usize> {
        let is_flat = |table: &Boundary| matches!(table.geometry, BoundaryGeometry::Plane(_) | BoundaryGeometry::Box(_));
        let rests = |table: &Boundary| table.motion.as_ref().is_none_or(|motion| motion_of(motion) == Motion::default());
        let walls = |table: &Boundary| if matches!(table.geometry, BoundaryGeometry::Box(_)) { 6 } else { 1 };
        let of_kind = move |first: bool| {
            let tables = self.boundaries.iter().enumerate().filter(move |(_, table)| first == (is_flat(table) && rests(table)));
            tables.flat_map(move |(index, table)| std::iter::repeat_n(index, walls(table)))
        };
        of_kind(true).chain(of_kind(false))
    }

    /// The `[[boundary]]` that a wall is of.
    pub(super) fn boundary_of_wall(&self, wall: usize) -> &Boundary {
        // Walls are made of boundaries: the default is never used.
        &self.boundaries[self.boundaries_of_walls().nth(wall).unwrap_or_default()]
    }

    /// Path of a key of the `[[boundary]]` that a wall is of.
    pub(super) fn key_of_wall(&self, wall: usize, key: &str) -> String {
        format!("boundary[{}].{key}", self.boundaries_of_walls().nth(wall).unwrap_or_default())
    }

    /// All walls as planes at rest, which are all that hard bodies know.
    pub(super) fn planes_for_hard_bodies(&self, walls: &[SceneWall]) -> Result<Vec<Plane>, SceneError> {
        let plane = |wall: &SceneWall| {
            wall.wall.plane_at_rest().cloned().ok_or_else(|| {
                let table = &self.boundaries[wall.boundary];
                let key = if matches!(wall.wall.wall, Wall::Plane(_)) { "motion" } else { "geometry" };
                let message = format!("`{}`: hard bodies know no walls but planes and boxes at rest", table.name);
                SceneError::new(SceneErrorKind::Unsupported, format!("boundary[{}].{key}", wall.boundary), message)
            })
        };
        walls.iter().map(plane).collect()
    }
}

fn walls_of(key: &str, geometry: &BoundaryGeometry) -> Result<Vec<Wall>, SceneError> {
    let wrong = |name: &str, error: String| SceneError::new(SceneErrorKind::Value, format!("{key}.{}.{name}", geometry.name()), error);
    let vectors = |points: &[[f64; 3]]| points.iter().map(|point| Vector::from(*point)).collect::<Vec<_>>();
    Ok(match geometry {
        BoundaryGeometry::Plane(plane) => {
            vec![Wall::Plane(Plane { point: plane.point.into(), normal: Vector::from(plane.normal).normalize() })]
        }
        BoundaryGeometry::Box(walls) => Plane::of_box(&walls.lower.into(), &walls.upper.into()).map(Wall::Plane).to_vec(),
        BoundaryGeometry::Cylinder(wall) => vec![Wall::Cylinder(Cylinder {
            centre: wall.centre.into(),
            axis: Vector::from(wall.axis).normalize(),
            radius: wall.radius,
            half_length: wall.length.map_or(f64::INFINITY, |length| 0.5 * length),
            side: wall.side,
        })],
        BoundaryGeometry::Plate(plate) => {
            vec![Wall::Plate(Plate::new(&vectors(&plate.corners)).map_err(|error| wrong("corners", error.to_string()))?)]
        }
        BoundaryGeometry::Hopper(table) => {
            let hopper = Hopper { outlet: table.outlet.into(), upper: table.upper, lower: table.lower, height: table.height };
            vec![Wall::Mesh(hopper::surface(&hopper).map_err(|error| wrong("height", error.to_string()))?)]
        }
        BoundaryGeometry::Mesh(mesh) => {
            let made = Mesh::new(&vectors(&mesh.vertices), &mesh.triangles, mesh.smooth_below);
            vec![Wall::Mesh(made.map_err(|error| wrong("triangles", error.to_string()))?)]
        }
    })
}

fn motion_of(table: &BoundaryMotion) -> Motion {
    let interval = |start: f64, end: Option<f64>| [start, end.unwrap_or(f64::INFINITY)];
    Motion {
        translation: table
            .translation
            .as_ref()
            .map(|motion| Translation { velocity: motion.velocity.into(), interval: interval(motion.start, motion.end) }),
        oscillation: table.oscillation.as_ref().map(|motion| Oscillation {
            amplitude: motion.amplitude.into(),
            frequency: motion.frequency,
            phase: motion.phase,
            interval: interval(motion.start, motion.end),
        }),
        turn: table.rotation.as_ref().map(|motion| Turn {
            point: motion.point.into(),
            angular_velocity: Vector::from(motion.axis).normalize() * motion.angular_velocity,
            interval: interval(motion.start, motion.end),
        }),
        removed_at: table.removed_at,
    }
}
