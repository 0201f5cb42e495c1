//! What scenes of soft spheres of one material have in common, and the quantities that must vanish in them.

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::scene::{
    Body, EndOfContact, Geometry, LinearSpringDashpot, Material, NamedShape, NormalLaw, Pair, Scene, SphereGeometry, TangentialLaw,
};
use solver::{Simulation, Vector};

use crate::case::Quantity;

/// The one material, of bodies and walls.
pub(super) const MATERIAL: &str = "glass";

/// A linear spring and a dashpot, in contact until the overlap is zero.
pub(super) fn linear(stiffness: f64, restitution: f64) -> NormalLaw {
    NormalLaw::LinearSpringDashpot(LinearSpringDashpot { stiffness, restitution, end_of_contact: EndOfContact::ZeroOverlap })
}

/// An empty scene of one material that touches itself.
pub(super) fn scene(name: &str, density: f64, normal: NormalLaw, tangential: Option<TangentialLaw>) -> Scene {
    let mut scene = Scene::empty(name, 1.0);
    scene.materials = vec![Material { name: MATERIAL.into(), density: Some(density) }];
    scene.pairs = vec![Pair { materials: [MATERIAL.into(), MATERIAL.into()], normal, tangential, rolling: None }];
    scene
}

/// A sphere of a radius in m.
pub(super) fn sphere(name: &str, radius: f64) -> NamedShape {
    NamedShape { name: name.into(), geometry: Geometry::Sphere(SphereGeometry { radius }) }
}

/// A body at a place in m with a velocity in m/s.
pub(super) fn body(shape: &str, position: Vector, velocity: Vector) -> Body {
    Body { position: position.into(), velocity: velocity.into(), ..Body::new(shape, MATERIAL) }
}

/// Mass in kg of a solid sphere.
pub(super) fn sphere_mass(density: f64, radius: f64) -> f64 {
    density * std::f64::consts::PI * radius.powi(3) * 4.0 / 3.0
}

/// Duration in s of an undamped contact of a reduced mass in kg on a spring in N/m.
pub(super) fn contact_duration(reduced_mass: f64, stiffness: f64) -> f64 {
    std::f64::consts::PI * (reduced_mass / stiffness).sqrt()
}

/// Centres of the bodies in m, by id.
pub(super) fn places(simulation: &Simulation) -> Vec<Vector> {
    simulation.bodies().by_id().map(|index| simulation.bodies().position(index)).collect()
}

/// A quantity that is zero in truth.
pub(super) fn vanishing(
    name: &'static str,
    unit: &'static str,
    samples: Vec<f64>,
    floor: f64,
    kind: ReferenceKind,
    source: &str,
) -> Quantity {
    Quantity {
        name,
        unit,
        samples,
        expected: 0.0,
        reference: Reference { kind, uncertainty: f64::EPSILON, source: source.into() },
        error_kind: ErrorKind::Absolute,
        floor,
    }
}
