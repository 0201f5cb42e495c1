//! How bodies of a scene touch that are not spheres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use crate::contact::sharing::{DampedMass, Sharing};

/// How bodies touch that are not spheres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ShapedContact {
    /// How several contact points between the same two bodies share the contact law.
    pub sharing: Sharing,
    /// Which mass the normal dashpot is calibrated for.
    pub damped_mass: DampedMass,
    /// How many points of a flat or straight contact are looked at.
    pub points: ContactPoints,
    /// Thickness of the crust by which edges are rounded, as a part of the radius of the largest ball about the centre that fits into the part. In
    /// (0, 1). Contacts deeper than both crusts together lose their exact normal.
    pub crust: f64,
    /// How a shape is shrunk to the core inside its crust.
    pub crust_form: CrustForm,
    /// Whether edges are rounded against walls too. Absent: walls meet the sharp shape.
    pub crust_at_walls: bool,
    /// How superellipsoids touch each other and walls.
    pub superellipsoids: SuperellipsoidContact,
    /// Vertices of a superellipsoid in each angle, where contacts are found by them, from 4 to 1000; a surface has the square of it.
    pub vertices: u32,
    /// How the vertices' angle towards z is spaced.
    pub vertex_spacing: VertexSpacing,
}

impl Default for ShapedContact {
    fn default() -> Self {
        ShapedContact {
            sharing: Sharing::default(),
            damped_mass: DampedMass::default(),
            points: ContactPoints::default(),
            crust: 0.02,
            crust_form: CrustForm::default(),
            crust_at_walls: false,
            superellipsoids: SuperellipsoidContact::default(),
            vertices: 20,
            vertex_spacing: VertexSpacing::default(),
        }
    }
}

/// How superellipsoids touch each other and walls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SuperellipsoidContact {
    /// At the common normal of the smooth surfaces.
    #[default]
    Continuous,
    /// By the vertices of each that lie inside the other (S section 2.4); a contact that one side alone sees counts.
    Vertices,
    /// As S: a contact that one side alone sees is left out.
    VerticesOfBothSides,
}

/// How the angle towards z is spaced (S figure 2-3).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum VertexSpacing {
    /// In equal steps.
    #[default]
    Linear,
    /// In equal ratios, so that a straight side has vertices too.
    Exponential,
}

/// How many points of a flat or straight contact are looked at.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactPoints {
    /// All corners of the common piece of two faces or edges.
    #[default]
    All,
    /// The deepest only, as R does: on a face or a line it may lie anywhere.
    Deepest,
}

/// How a shape is shrunk to the core inside its crust.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CrustForm {
    /// By the same thickness everywhere: overlaps are exact.
    #[default]
    Even,
    /// By a ratio, as R does, with the crust counted as if it were even: overlaps of elongated shapes are wrong.
    ByRatio,
}
