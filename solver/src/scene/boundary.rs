//! Walls as a scene gives them, and how they move.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::validate::{Check, direction, finite_all, not_negative, out_of_range, positive};
use super::{SceneError, SceneErrorKind};
pub use crate::boundary::Side;

/// A wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Boundary {
    /// Name, for errors and ledgers.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// The geometry.
    pub geometry: BoundaryGeometry,
    /// How it moves, whatever it meets. Absent: it rests.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<BoundaryMotion>,
}

impl Boundary {
    /// A wall at rest.
    pub fn new(name: &str, material: &str, geometry: BoundaryGeometry) -> Boundary {
        Boundary { name: name.to_string(), material: material.to_string(), geometry, motion: None }
    }
}

/// The geometry of a wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum BoundaryGeometry {
    /// An infinite flat wall.
    Plane(PlaneGeometry),
    /// Six infinite flat walls round bodies: a rectangular box along the axes.
    Box(BoxGeometry),
    /// A cylinder round bodies or among them.
    Cylinder(CylinderWallGeometry),
    /// A flat convex polygon without thickness, touched on both faces, at its edges and at its corners.
    Plate(PlateGeometry),
    /// Four flat walls between a rectangular opening and a rectangular outlet below it.
    Hopper(HopperGeometry),
    /// A surface of triangles without thickness, touched from both sides.
    Mesh(MeshGeometry),
}

impl BoundaryGeometry {
    /// The word a scene file uses for it.
    pub fn name(&self) -> &'static str {
        match self {
            BoundaryGeometry::Plane(_) => "plane",
            BoundaryGeometry::Box(_) => "box",
            BoundaryGeometry::Cylinder(_) => "cylinder",
            BoundaryGeometry::Plate(_) => "plate",
            BoundaryGeometry::Hopper(_) => "hopper",
            BoundaryGeometry::Mesh(_) => "mesh",
        }
    }
}

/// An infinite flat wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneGeometry {
    /// Any point of the wall in m.
    pub point: [f64; 3],
    /// Direction out of the wall into the space where bodies are, of any length but zero.
    pub normal: [f64; 3],
}

/// Six infinite flat walls.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxGeometry {
    /// Lower corner in m.
    pub lower: [f64; 3],
    /// Upper corner in m, above the lower one along each axis.
    pub upper: [f64; 3],
}

/// A cylinder round bodies or among them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderWallGeometry {
    /// Middle of the axis in m; any point of it if there is no length.
    pub centre: [f64; 3],
    /// Direction of the axis, of any length but zero.
    pub axis: [f64; 3],
    /// Radius in m, above zero.
    pub radius: f64,
    /// Length in m, above zero. Absent: infinite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// On which side bodies are.
    #[serde(default)]
    pub side: Side,
}

/// A flat convex polygon.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlateGeometry {
    /// Corners in m, at least three, in order round the outline, in one plane and convex.
    pub corners: Vec<[f64; 3]>,
}

/// A rectangular funnel that stands upright along z. With a length of the outlet equal to that above it is a wedge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HopperGeometry {
    /// Middle of the outlet, the lower opening, in m.
    pub outlet: [f64; 3],
    /// Lengths of the upper opening along x and y in m, each above zero.
    pub upper: [f64; 2],
    /// Lengths of the outlet along x and y in m, zero or above.
    pub lower: [f64; 2],
    /// Height of the upper opening above the outlet in m, above zero.
    pub height: f64,
}

/// A surface of triangles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshGeometry {
    /// Corners of triangles in m; corners at the same place are one.
    pub vertices: Vec<[f64; 3]>,
    /// Three corners of each triangle by number, from 0, in any order.
    pub triangles: Vec<[usize; 3]>,
    /// Angle in rad, above 0 and below pi: contacts of a ball whose normals enclose less are one, the deepest. So the facets of a curved surface do not
    /// count twice in the shallow grooves between them.
    #[serde(default = "smooth_below")]
    pub smooth_below: f64,
}

/// Twice the angle between the facets of a cylinder of 36.
fn smooth_below() -> f64 {
    0.35
}

/// How a wall moves. Turned first, then shifted by the translation and the oscillation, which take the axis of the rotation along.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoundaryMotion {
    /// Straight motion at constant velocity. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translation: Option<TranslationMotion>,
    /// Harmonic motion along a line. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub oscillation: Option<OscillationMotion>,
    /// Turning about an axis at constant rate. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<RotationMotion>,
    /// When the wall is taken away, in s. Absent: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub removed_at: Option<f64>,
}

/// Straight motion at constant velocity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TranslationMotion {
    /// Velocity in m/s.
    pub velocity: [f64; 3],
    /// When it begins, in s.
    #[serde(default)]
    pub start: f64,
    /// When it ends, in s, after the start. Absent: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<f64>,
}

/// Harmonic motion along a line: the amplitude times $\sin(2 \pi f (t - t_{start}) + \varphi)$.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OscillationMotion {
    /// Amplitude and direction in m.
    pub amplitude: [f64; 3],
    /// Frequency in Hz, above zero.
    pub frequency: f64,
    /// Phase at the start in rad.
    #[serde(default)]
    pub phase: f64,
    /// When it begins, in s.
    #[serde(default)]
    pub start: f64,
    /// When it ends, in s, after the start. Absent: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<f64>,
}

/// Turning about an axis at constant rate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RotationMotion {
    /// A point of the axis in m.
    pub point: [f64; 3],
    /// Direction of the axis, of any length but zero.
    pub axis: [f64; 3],
    /// Rate in rad/s, by the right-hand rule about the axis.
    pub angular_velocity: f64,
    /// When it begins, in s.
    #[serde(default)]
    pub start: f64,
    /// When it ends, in s, after the start. Absent: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<f64>,
}

impl Boundary {
    /// The wall as it is known up to a time in s: whatever comes after it comes at the end of time. So walls that have done the same until then are equal.
    pub(crate) fn known_until(&self, time: f64) -> Boundary {
        let start = |start: f64| if start > time { f64::INFINITY } else { start };
        let end = |end: Option<f64>| end.filter(|end| *end <= time);
        let motion = self.motion.as_ref().map(|motion| BoundaryMotion {
            translation: motion.translation.as_ref().map(|it| TranslationMotion { start: start(it.start), end: end(it.end), ..it.clone() }),
            oscillation: motion.oscillation.as_ref().map(|it| OscillationMotion { start: start(it.start), end: end(it.end), ..it.clone() }),
            rotation: motion.rotation.as_ref().map(|it| RotationMotion { start: start(it.start), end: end(it.end), ..it.clone() }),
            removed_at: motion.removed_at.map(start),
        });
        Boundary { motion, ..self.clone() }
    }
}

/// Numbers of a wall, one by one; whether corners form a plate or triangles a surface is seen when it is built.
pub(super) fn check(key: &str, boundary: &Boundary) -> Check {
    check_geometry(&format!("{key}.geometry.{}", boundary.geometry.name()), &boundary.geometry)?;
    boundary.motion.as_ref().map_or(Ok(()), |motion| check_motion(&format!("{key}.motion"), motion))
}

fn check_geometry(key: &str, geometry: &BoundaryGeometry) -> Check {
    let of = |name: &str| format!("{key}.{name}");
    match geometry {
        BoundaryGeometry::Plane(plane) => finite_all(&of("point"), &plane.point).and(direction(&of("normal"), &plane.normal)),
        BoundaryGeometry::Box(walls) => check_box(key, &walls.lower, &walls.upper),
        BoundaryGeometry::Cylinder(wall) => {
            finite_all(&of("centre"), &wall.centre)?;
            direction(&of("axis"), &wall.axis)?;
            positive(&of("radius"), wall.radius, "m")?;
            wall.length.map_or(Ok(()), |length| positive(&of("length"), length, "m"))
        }
        BoundaryGeometry::Plate(plate) => finite_all(&of("corners"), plate.corners.as_flattened()),
        BoundaryGeometry::Hopper(hopper) => {
            finite_all(&of("outlet"), &hopper.outlet)?;
            hopper.upper.iter().try_for_each(|length| positive(&of("upper"), *length, "m"))?;
            hopper.lower.iter().try_for_each(|length| not_negative(&of("lower"), *length))?;
            positive(&of("height"), hopper.height, "m")
        }
        BoundaryGeometry::Mesh(mesh) => {
            finite_all(&of("vertices"), mesh.vertices.as_flattened())?;
            if mesh.smooth_below > 0.0 && mesh.smooth_below < std::f64::consts::PI {
                return Ok(());
            }
            Err(out_of_range(&of("smooth_below"), mesh.smooth_below, "an angle above 0 and below pi (rad)"))
        }
    }
}

/// Corners of a box along the axes.
pub(super) fn check_box(key: &str, lower: &[f64; 3], upper: &[f64; 3]) -> Check {
    finite_all(&format!("{key}.lower"), lower)?;
    finite_all(&format!("{key}.upper"), upper)?;
    match lower.iter().zip(upper).find(|(least, most)| most <= least) {
        None => Ok(()),
        Some((least, most)) => Err(out_of_range(&format!("{key}.upper"), *most, &format!("above the lower corner, {least} m"))),
    }
}

fn check_motion(key: &str, motion: &BoundaryMotion) -> Check {
    if let Some(translation) = &motion.translation {
        finite_all(&format!("{key}.translation.velocity"), &translation.velocity)?;
        check_times(&format!("{key}.translation"), translation.start, translation.end)?;
    }
    if let Some(oscillation) = &motion.oscillation {
        let key = format!("{key}.oscillation");
        finite_all(&format!("{key}.amplitude"), &oscillation.amplitude)?;
        positive(&format!("{key}.frequency"), oscillation.frequency, "Hz")?;
        finite_all(&format!("{key}.phase"), &[oscillation.phase])?;
        check_times(&key, oscillation.start, oscillation.end)?;
    }
    if let Some(rotation) = &motion.rotation {
        let key = format!("{key}.rotation");
        finite_all(&format!("{key}.point"), &rotation.point)?;
        direction(&format!("{key}.axis"), &rotation.axis)?;
        finite_all(&format!("{key}.angular_velocity"), &[rotation.angular_velocity])?;
        check_times(&key, rotation.start, rotation.end)?;
    }
    motion.removed_at.map_or(Ok(()), |time| not_negative(&format!("{key}.removed_at"), time))
}

/// A start, and an end after it.
fn check_times(key: &str, start: f64, end: Option<f64>) -> Check {
    not_negative(&format!("{key}.start"), start)?;
    let Some(end) = end else { return Ok(()) };
    positive(&format!("{key}.end"), end, "s")?;
    if end > start {
        return Ok(());
    }
    let message = format!("{end} s is not after the start, {start} s");
    Err(SceneError::new(SceneErrorKind::Value, format!("{key}.end"), message))
}
