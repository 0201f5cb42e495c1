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
    /// All walls in the order of the scene, boxes as their planes.
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
        Ok(walls)
    }

    /// Refuses walls that no contact stage knows yet: anything but planes at rest.
    pub(super) fn refuse_unsupported_boundaries(&self) -> Result<(), SceneError> {
        let is_supported = |boundary: &Boundary| matches!(boundary.geometry, BoundaryGeometry::Plane(_)) && boundary.motion.is_none();
        let Some(index) = self.boundaries.iter().position(|boundary| !is_supported(boundary)) else { return Ok(()) };
        let boundary = &self.boundaries[index];
        let key = if boundary.motion.is_some() { "motion" } else { "geometry" };
        let message = format!("`{}`: only planes at rest are simulated in this version, not a {}", boundary.name, boundary.geometry.name());
        Err(SceneError::new(SceneErrorKind::Unsupported, format!("boundary[{index}].{key}"), message))
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
