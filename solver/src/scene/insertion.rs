//! Bodies that a scene does not list one by one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::boundary::check_box;
use super::validate::{Check, direction, finite_all, known, not_negative, out_of_range, positive};
use super::{Scene, SceneError, SceneErrorKind};

/// Bodies that come in numbers: before the start, or during the run. Their ids follow the largest id of a body, in the order of the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Insertion {
    /// Name, for errors and ledgers.
    pub name: String,
    /// Name of the material of the bodies; it needs a density.
    pub material: String,
    /// How many bodies, at least one.
    pub number: u32,
    /// Which shapes, how many of each and how large.
    pub shapes: Vec<InsertedShape>,
    /// Where.
    pub region: InsertionRegion,
    /// How bodies are turned: a quaternion [w, x, y, z] of any length but zero, or "random", uniform over all rotations.
    #[serde(default)]
    pub orientation: InsertedOrientation,
    /// Velocity in m/s at which they begin.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Angular velocity in the world frame in rad/s at which they begin.
    #[serde(default)]
    pub angular_velocity: [f64; 3],
    /// How often a body is tried in a window before the start until it counts as having no room, at least once.
    #[serde(default = "attempts")]
    pub attempts: u32,
    /// Bodies come during the run, each as soon as it is due and there is room. Absent: all before the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub during_run: Option<DuringRun>,
}

fn attempts() -> u32 {
    100_000
}

/// A shape of inserted bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InsertedShape {
    /// Name of the shape.
    pub shape: String,
    /// Part of the number of bodies, above zero, relative to the parts of the others: numbers are rounded so that they add up.
    #[serde(default = "whole")]
    pub fraction: f64,
    /// Least and largest size, as multiples of the shape, uniform between them. Absent: as it is. Only for spheres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f64; 2]>,
}

fn whole() -> f64 {
    1.0
}

/// Where bodies come.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum InsertionRegion {
    /// In rows, layers and storeys, filled along x first and z last.
    Lattice(LatticeRegion),
    /// One after the other at a point.
    Point(PointRegion),
    /// At random places of a flat surface.
    Rectangle(RectangleRegion),
    /// At random places in a box.
    Box(BoxRegion),
}

impl InsertionRegion {
    /// The word a scene file uses for it.
    pub fn name(&self) -> &'static str {
        match self {
            InsertionRegion::Lattice(_) => "lattice",
            InsertionRegion::Point(_) => "point",
            InsertionRegion::Rectangle(_) => "rectangle",
            InsertionRegion::Box(_) => "box",
        }
    }
}

/// Rows, layers and storeys in a box; the first site is half a spacing inside it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LatticeRegion {
    /// Lower corner of the box in m.
    pub lower: [f64; 3],
    /// Upper corner in m, above the lower one along each axis.
    pub upper: [f64; 3],
    /// Distances of neighbours along each axis in m, at least the diameter of the largest body.
    pub spacing: [f64; 3],
    /// Largest random shift of a body off its site along each axis in m, zero or above; such that none can overlap.
    #[serde(default)]
    pub jitter: f64,
}

/// A point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointRegion {
    /// Centre of each body in m.
    pub position: [f64; 3],
}

/// A flat surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleRegion {
    /// A corner in m; centres of bodies lie on the surface.
    pub corner: [f64; 3],
    /// From there to one neighbouring corner in m, of any length but zero.
    pub first_edge: [f64; 3],
    /// From there to the other in m, of any length but zero, at any angle.
    pub second_edge: [f64; 3],
}

/// A box; centres of bodies lie inside.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxRegion {
    /// Lower corner in m.
    pub lower: [f64; 3],
    /// Upper corner in m, above the lower one along each axis.
    pub upper: [f64; 3],
}

/// How inserted bodies are turned.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a quaternion [w, x, y, z], or \"random\"")]
pub enum InsertedOrientation {
    /// All the same way: body to world.
    Quaternion([f64; 4]),
    /// Drawn.
    Drawn(RandomOrientation),
}

impl Default for InsertedOrientation {
    fn default() -> Self {
        InsertedOrientation::Drawn(RandomOrientation::Random)
    }
}

/// How orientations are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RandomOrientation {
    /// Uniformly over all rotations.
    Random,
}

/// When bodies come during the run. Only for windows: a point, a rectangle or a box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DuringRun {
    /// When the first is due, in s.
    #[serde(default)]
    pub start: f64,
    /// Bodies per s, above zero. Absent: all are due at the start and come as fast as there is room.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<f64>,
    /// Attempts in each step, at least one. R tries once a step.
    #[serde(default = "attempts_per_step")]
    pub attempts_per_step: u32,
    /// How long a body that is due may wait for room in s, above zero, before the run ends. Absent: for ever.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub patience: Option<f64>,
}

fn attempts_per_step() -> u32 {
    10
}

/// More bodies in one table than memory is likely to hold.
const LARGEST_NUMBER: u32 = 10_000_000;

/// Names, and numbers one by one; whether bodies fit is seen when they are placed.
pub(super) fn check(scene: &Scene, key: &str, insertion: &Insertion) -> Check {
    let of = |name: &str| format!("{key}.{name}");
    known(&of("material"), "[[material]]", &insertion.material, scene.materials.iter().map(|material| material.name.as_str()))?;
    let density = scene.materials.iter().find(|material| material.name == insertion.material).and_then(|material| material.density);
    if density.is_none() {
        let message = format!("`{}` has no density, which the mass of inserted bodies is made from", insertion.material);
        return Err(SceneError::new(SceneErrorKind::Combination, of("material"), message));
    }
    if !(1..=LARGEST_NUMBER).contains(&insertion.number) {
        return Err(out_of_range(&of("number"), f64::from(insertion.number), &format!("a whole number from 1 to {LARGEST_NUMBER}")));
    }
    if insertion.attempts == 0 {
        return Err(out_of_range(&of("attempts"), 0.0, "a whole number of at least 1"));
    }
    check_shapes(scene, &of("shapes"), &insertion.shapes)?;
    check_region(&format!("{key}.region.{}", insertion.region.name()), &insertion.region)?;
    if let InsertedOrientation::Quaternion(quaternion) = &insertion.orientation {
        direction(&of("orientation"), quaternion)?;
    }
    finite_all(&of("velocity"), &insertion.velocity)?;
    finite_all(&of("angular_velocity"), &insertion.angular_velocity)?;
    let Some(during) = &insertion.during_run else { return Ok(()) };
    if matches!(insertion.region, InsertionRegion::Lattice(_)) {
        let message = "a lattice is filled before the start: use a point, a rectangle or a box";
        return Err(SceneError::new(SceneErrorKind::Combination, of("during_run"), message));
    }
    check_during(&of("during_run"), during)
}

fn check_shapes(scene: &Scene, key: &str, shapes: &[InsertedShape]) -> Check {
    if shapes.is_empty() {
        return Err(SceneError::new(SceneErrorKind::Empty, key, "bodies need at least one shape"));
    }
    for (index, inserted) in shapes.iter().enumerate() {
        let key = format!("{key}[{index}]");
        known(&format!("{key}.shape"), "[[shape]]", &inserted.shape, scene.shapes.iter().map(|shape| shape.name.as_str()))?;
        positive(&format!("{key}.fraction"), inserted.fraction, "relative to the others")?;
        let Some([least, largest]) = inserted.scale else { continue };
        positive(&format!("{key}.scale"), least, "of the shape")?;
        positive(&format!("{key}.scale"), largest, "of the shape")?;
        if largest < least {
            return Err(out_of_range(&format!("{key}.scale"), largest, &format!("at least the least scale, {least}")));
        }
        let is_sphere = |shape: &&super::NamedShape| shape.name == inserted.shape && shape.geometry.name() == "sphere";
        if scene.shapes.iter().find(is_sphere).is_none() {
            let message = format!("`{}` is no sphere, and only spheres are scaled: give each size as a shape of its own", inserted.shape);
            return Err(SceneError::new(SceneErrorKind::Unsupported, format!("{key}.scale"), message));
        }
    }
    Ok(())
}

fn check_region(key: &str, region: &InsertionRegion) -> Check {
    let of = |name: &str| format!("{key}.{name}");
    match region {
        InsertionRegion::Lattice(lattice) => {
            check_box(key, &lattice.lower, &lattice.upper)?;
            lattice.spacing.iter().try_for_each(|spacing| positive(&of("spacing"), *spacing, "m"))?;
            not_negative(&of("jitter"), lattice.jitter)
        }
        InsertionRegion::Point(point) => finite_all(&of("position"), &point.position),
        InsertionRegion::Rectangle(rectangle) => {
            finite_all(&of("corner"), &rectangle.corner)?;
            direction(&of("first_edge"), &rectangle.first_edge)?;
            direction(&of("second_edge"), &rectangle.second_edge)
        }
        InsertionRegion::Box(region) => check_box(key, &region.lower, &region.upper),
    }
}

fn check_during(key: &str, during: &DuringRun) -> Check {
    not_negative(&format!("{key}.start"), during.start)?;
    during.rate.map_or(Ok(()), |rate| positive(&format!("{key}.rate"), rate, "1/s"))?;
    during.patience.map_or(Ok(()), |patience| positive(&format!("{key}.patience"), patience, "s"))?;
    if during.attempts_per_step == 0 {
        return Err(out_of_range(&format!("{key}.attempts_per_step"), 0.0, "a whole number of at least 1"));
    }
    Ok(())
}
