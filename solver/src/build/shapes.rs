//! Shapes of a scene: convex parts, glued ones with the mass properties of their union, and the cores that detection sees.

use std::sync::Arc;

use crate::contact::detect::VertexSurface;
use crate::contact::shaped::DetectedPart;
use crate::distance::{Pose, Query, RoundedCore, separation};
use crate::scene::{
    CompositeGeometry, CrustForm, Geometry, GivenMassProperties, NamedShape, RodGeometry, Scene, SceneError, SceneErrorKind, ShapedContact,
    SuperellipsoidContact, VertexSpacing,
};
use crate::shape::superellipsoid::vertices::Spacing;
use crate::shape::{
    Convex, Cuboid, Cylinder, MassMethod, MassProperties, Part, Polyhedron, PolyhedronError, Shape, Sphere, Spherocylinder, Superellipsoid,
    composites, mass_of_union,
};
use crate::{Orientation, Vector};

/// A shape of a scene and what should be said of it.
pub(super) struct ResolvedShape {
    pub(super) name: String,
    pub(super) shape: Arc<Shape>,
    /// For composites: how their mass was found, and whether all parts hang together.
    pub(super) remark: Option<String>,
}

impl Scene {
    pub(super) fn resolve_shapes(&self) -> Result<Vec<ResolvedShape>, SceneError> {
        self.shapes.iter().enumerate().map(|(index, shape)| self.resolve_shape(index, shape)).collect()
    }

    fn resolve_shape(&self, index: usize, named: &NamedShape) -> Result<ResolvedShape, SceneError> {
        let key = format!("shape[{index}].geometry.{}", named.geometry.name());
        let (shape, remark) = match &named.geometry {
            Geometry::Composite(composite) => match &composite.mass_properties {
                Some(given) => as_given(self.parts_of(composite)?, given),
                None => glued("composite", self.parts_of(composite)?),
            },
            Geometry::Trilobe(lobes) => {
                let parts = composites::trilobe(lobes.diameter, lobes.length);
                glued("trilobe", parts.map_err(|error| SceneError::new(SceneErrorKind::Value, &key, error.to_string()))?)
            }
            Geometry::Quadralobe(lobes) => glued("quadralobe", composites::quadralobe(lobes.diameter, lobes.length)),
            Geometry::CrossInPlane(rod) => glued("cross_in_plane", composites::cross_in_plane(rod.radius, rod.length)),
            Geometry::CrossInSpace(rod) => glued("cross_in_space", composites::cross_in_space(rod.radius, rod.length)),
            convex => (Shape::of_one(convex_of(&key, convex)?), None),
        };
        Ok(ResolvedShape { name: named.name.clone(), shape: Arc::new(shape), remark })
    }

    fn parts_of(&self, composite: &CompositeGeometry) -> Result<Vec<Part>, SceneError> {
        let mut parts = Vec::with_capacity(composite.parts.len());
        for part in &composite.parts {
            // Validation has found every name.
            let Some(place) = self.shapes.iter().position(|shape| shape.name == part.shape) else { continue };
            let geometry = &self.shapes[place].geometry;
            let convex = convex_of(&format!("shape[{place}].geometry.{}", geometry.name()), geometry)?;
            parts.push(Part { convex, position: part.position.into(), orientation: orientation_of(&part.orientation) });
        }
        Ok(parts)
    }
}

/// A rotation from a quaternion of any length.
pub(super) fn orientation_of([w, x, y, z]: &[f64; 4]) -> Orientation {
    Orientation::new_normalize(nalgebra::Quaternion::new(*w, *x, *y, *z))
}

fn convex_of(key: &str, geometry: &Geometry) -> Result<Convex, SceneError> {
    let polyhedron = |made: Result<Polyhedron, PolyhedronError>| match made {
        Ok(polyhedron) => Ok(Convex::Polyhedron(Arc::new(polyhedron))),
        Err(error) => Err(SceneError::new(SceneErrorKind::Value, key, error.to_string())),
    };
    let vectors = |points: &[[f64; 3]]| points.iter().map(|point| Vector::from(*point)).collect::<Vec<_>>();
    let convex = match geometry {
        Geometry::Sphere(sphere) => Convex::Sphere(Sphere { radius: sphere.radius }),
        Geometry::Cuboid(cuboid) => Convex::Cuboid(Cuboid { lengths: cuboid.lengths.into() }),
        Geometry::Cylinder(RodGeometry { radius, length }) => Convex::Cylinder(Cylinder { radius: *radius, length: *length }),
        Geometry::Spherocylinder(rod) => Convex::Spherocylinder(Spherocylinder { radius: rod.radius, length: rod.length }),
        Geometry::Tetrahedron(regular) => polyhedron(Polyhedron::tetrahedron(regular.edge))?,
        Geometry::Octahedron(regular) => polyhedron(Polyhedron::octahedron(regular.edge))?,
        Geometry::Icosahedron(regular) => polyhedron(Polyhedron::icosahedron(regular.edge))?,
        Geometry::Polyhedron(given) => polyhedron(Polyhedron::from_faces(vectors(&given.vertices), given.faces.clone()))?,
        Geometry::Hull(hull) => polyhedron(Polyhedron::hull(&vectors(&hull.points)))?,
        Geometry::Superellipsoid(given) => {
            let shape = Superellipsoid::new(given.semi_axes.into(), given.exponents);
            Convex::Superellipsoid(Arc::new(shape.map_err(|error| SceneError::new(SceneErrorKind::Value, key, error.to_string()))?))
        }
        Geometry::Composite(_) | Geometry::Trilobe(_) | Geometry::Quadralobe(_) | Geometry::CrossInPlane(_) | Geometry::CrossInSpace(_) => {
            // Validation has refused composites of composites.
            return Err(SceneError::new(SceneErrorKind::Combination, key, "is not convex"));
        }
    };
    Ok(convex)
}

/// Overlaps of parts below this part of their size are rounding of parts that touch.
const TOUCHING: f64 = 1e-12;

/// Distance of two parts in m, negative if they overlap, and their size.
fn distance_of(one: &Part, other: &Part) -> (f64, f64) {
    let pose = |part: &Part| Pose { position: part.position, rotation: *part.orientation.to_rotation_matrix().matrix() };
    let (first, second) = (RoundedCore::sharp(&one.convex), RoundedCore::sharp(&other.convex));
    let found = separation((&first.core, &pose(one)), (&second.core, &pose(other)), &Query::cold());
    (found.distance - first.radius - second.radius, one.convex.bounding_radius() + other.convex.bounding_radius())
}

fn as_given(parts: Vec<Part>, given: &GivenMassProperties) -> (Shape, Option<String>) {
    let properties = MassProperties::centred(given.volume, given.mean_squares.into());
    let shape = Shape::glued("composite", parts, |_| properties);
    let remark = format!("{} parts; mass properties as given", shape.parts().len());
    (shape, Some(remark))
}

fn glued(name: &'static str, parts: Vec<Part>) -> (Shape, Option<String>) {
    let overlaps = |one: &Part, other: &Part| {
        let (distance, size) = distance_of(one, other);
        distance < -TOUCHING * size
    };
    let mut method = MassMethod::ClosedForms;
    let shape = Shape::glued(name, parts, |parts| {
        let (properties, found_by) = mass_of_union(parts, &overlaps);
        method = found_by;
        properties
    });
    let mut remark = format!("{} parts; mass properties by {}", shape.parts().len(), method.text());
    let islands = number_of_islands(shape.parts());
    if islands > 1 {
        remark += &format!("; the parts form {islands} groups that do not touch each other");
    }
    (shape, Some(remark))
}

/// Groups of parts that touch each other.
fn number_of_islands(parts: &[Part]) -> usize {
    let mut island: Vec<usize> = (0..parts.len()).collect();
    for (index, part) in parts.iter().enumerate() {
        for (other_index, other) in parts[..index].iter().enumerate() {
            let (distance, size) = distance_of(part, other);
            let (one, another) = (island[index], island[other_index]);
            if distance <= TOUCHING * size && one != another {
                island.iter_mut().filter(|name| **name == one).for_each(|name| *name = another);
            }
        }
    }
    island.sort_unstable();
    island.dedup();
    island.len()
}

/// The cores of a body's parts, with the crust that a scene asks for, and the vertices of superellipsoids if it asks for them.
pub(super) fn detected_parts(shape: &Shape, settings: &ShapedContact) -> Result<Vec<DetectedPart>, SceneError> {
    let detected = |part: &Part| {
        let against_bodies = rounded(part, settings)?;
        let against_walls = if settings.crust_at_walls { against_bodies.clone() } else { RoundedCore::sharp(&part.convex) };
        Ok(DetectedPart {
            against_bodies,
            against_walls,
            vertices: vertex_surface(&part.convex, settings),
            position: part.position,
            orientation: part.orientation,
            rotation: (part.orientation != Orientation::identity()).then(|| *part.orientation.to_rotation_matrix().matrix()),
            bounding_radius: part.convex.bounding_radius(),
        })
    };
    shape.parts().iter().map(detected).collect()
}

/// The vertices of a superellipsoid, if contacts are to be found by them.
fn vertex_surface(convex: &Convex, settings: &ShapedContact) -> Option<Arc<VertexSurface>> {
    let Convex::Superellipsoid(shape) = convex else { return None };
    if settings.superellipsoids == SuperellipsoidContact::Continuous {
        return None;
    }
    let spacing = match settings.vertex_spacing {
        VertexSpacing::Linear => Spacing::Linear,
        VertexSpacing::Exponential => Spacing::Exponential,
    };
    Some(Arc::new(VertexSurface { vertices: shape.vertices(settings.vertices as usize, spacing), shape: shape.clone() }))
}

/// The core of a part inside its crust.
fn rounded(part: &Part, settings: &ShapedContact) -> Result<RoundedCore, SceneError> {
    let crust = settings.crust * part.convex.inner_radius();
    let core = match settings.crust_form {
        CrustForm::Even => RoundedCore::with_crust(&part.convex, crust),
        CrustForm::ByRatio => RoundedCore::shrunk_by_ratio(&part.convex, crust),
    };
    let message = || format!("a crust of {crust} m leaves nothing of a {}: give a thinner one", part.convex.name());
    core.ok_or_else(|| SceneError::new(SceneErrorKind::Combination, "numerics.shaped_contact.crust", message()))
}
