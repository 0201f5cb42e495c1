//! The kinds of bodies and the scenes of their beds.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, CuboidGeometry, Domain, EndOfContact, Geometry, InitialOverlap, LinearHistory, LinearSpringDashpot,
    Material, NamedShape, NormalLaw, Pair, PlaneGeometry, RegularGeometry, RodGeometry, Scene, SceneError, SphereGeometry, Step,
    SuperellipsoidGeometry, TangentialLaw,
};

use super::states::States;

/// Time step in s.
const STEP: f64 = 2e-6;
/// Diameter in m of the ball whose volume all bodies have, and their density in kg/m^3.
pub(super) const DIAMETER: f64 = 3e-3;
const DENSITY: f64 = 2500.0;
/// Normal stiffness in N/m; friction; restitution.
const STIFFNESS: f64 = 1e5;
const FRICTION: f64 = 0.5;
const RESTITUTION: f64 = 0.75;

/// Kinds of shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Balls, the base.
    Sphere,
    /// Cubes.
    Cube,
    /// Regular icosahedra.
    Icosahedron,
    /// Cylinders as long as they are wide.
    Cylinder,
    /// Ellipsoids of revolution, 4:1:1.
    Ellipsoid,
    /// Superellipsoids without a whole exponent, 1.5:1.2:1.
    Superellipsoid,
    /// Three crossing cylinders, five times as long as wide.
    Cross,
}

impl Kind {
    /// All of them, the base first.
    pub const ALL: [Kind; 7] =
        [Kind::Sphere, Kind::Cube, Kind::Icosahedron, Kind::Cylinder, Kind::Ellipsoid, Kind::Superellipsoid, Kind::Cross];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Sphere => "spheres",
            Kind::Cube => "cubes",
            Kind::Icosahedron => "icosahedra",
            Kind::Cylinder => "cylinders",
            Kind::Ellipsoid => "ellipsoids",
            Kind::Superellipsoid => "superellipsoids",
            Kind::Cross => "crosses",
        }
    }

    /// Name of the file of its settled state.
    pub fn file(self) -> String {
        format!("{}.csv", self.name())
    }

    /// Steps of bodies a second on one core that the project aims at.
    pub fn goal(self) -> Option<f64> {
        match self {
            Kind::Sphere => None,
            Kind::Cube | Kind::Ellipsoid => Some(8e5),
            Kind::Icosahedron => Some(6e5),
            Kind::Cylinder => Some(3e5),
            Kind::Superellipsoid => Some(2.5e5),
            Kind::Cross => Some(1.5e5),
        }
    }

    /// The same shape with a size in m.
    fn of_size(self, size: f64) -> Geometry {
        match self {
            Kind::Sphere => Geometry::Sphere(SphereGeometry { radius: 0.5 * size }),
            Kind::Cube => Geometry::Cuboid(CuboidGeometry { lengths: [size; 3] }),
            Kind::Icosahedron => Geometry::Icosahedron(RegularGeometry { edge: size }),
            Kind::Cylinder => Geometry::Cylinder(RodGeometry { radius: 0.5 * size, length: size }),
            Kind::Ellipsoid => {
                Geometry::Superellipsoid(SuperellipsoidGeometry { semi_axes: [0.5 * size, 0.5 * size, 2.0 * size], exponents: [1.0; 2] })
            }
            Kind::Superellipsoid => Geometry::Superellipsoid(SuperellipsoidGeometry {
                semi_axes: [0.75 * size, 0.6 * size, 0.5 * size],
                exponents: [0.55, 0.7],
            }),
            Kind::Cross => Geometry::CrossInSpace(RodGeometry { radius: 0.1 * size, length: 0.5 * size }),
        }
    }

    /// The shape with the volume of the ball.
    fn geometry(self) -> Result<Geometry, SceneError> {
        let volume = |size: f64| {
            let mut scene = Scene::empty("volume", 1.0);
            scene.materials = vec![Material { name: "glass".into(), density: Some(1.0) }];
            scene.shapes = vec![NamedShape { name: "body".into(), geometry: self.of_size(size) }];
            scene.bodies = vec![Body::new("body", "glass")];
            scene.numerics.step = Step::Seconds(STEP);
            scene.build().map(|simulation| simulation.bodies().mass(0))
        };
        let ball = std::f64::consts::PI / 6.0 * DIAMETER.powi(3);
        Ok(self.of_size(DIAMETER * (ball / volume(DIAMETER)?).cbrt()))
    }

    /// Side in m of the column, which repeats in x and y: twice the longest body at least.
    pub(super) fn side(self) -> f64 {
        if self == Kind::Ellipsoid { 0.026 } else { 0.018 }
    }

    /// A column with a floor and nothing in it, whose contacts are softer by a factor and, if they are, more damped and stepped with more care.
    pub(super) fn column(self, softer: f64, restitution: f64) -> Result<Scene, SceneError> {
        let side = self.side();
        let mut scene = Scene::empty(self.name(), 1.0);
        scene.scene.gravity = Some([0.0, 0.0, -9.81]);
        let material = |name: &str, density| Material { name: name.into(), density };
        scene.materials = vec![material("glass", Some(DENSITY)), material("wall", None)];
        let stiffness = STIFFNESS / softer;
        let normal =
            NormalLaw::LinearSpringDashpot(LinearSpringDashpot { stiffness, restitution, end_of_contact: EndOfContact::ZeroOverlap });
        let history =
            LinearHistory { friction: FRICTION, stiffness: 2.0 / 7.0 * stiffness, damping_ratio: if softer > 1.0 { 0.4 } else { 0.16 } };
        let pair = |other: &str| Pair {
            materials: ["glass".into(), other.into()],
            normal: normal.clone(),
            tangential: Some(TangentialLaw::LinearHistory(history.clone())),
            rolling: None,
        };
        scene.pairs = ["glass", "wall"].map(pair).to_vec();
        scene.shapes = vec![NamedShape { name: "body".into(), geometry: self.geometry()? }];
        let floor = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
        scene.boundaries = vec![Boundary::new("floor", "wall", floor)];
        scene.domain = Some(Domain { lower: [0.0; 3], upper: [side, side, 1.0], periodic: [true, true, false] });
        scene.numerics.step = Step::Seconds(STEP * softer.sqrt() / if softer > 1.0 { 2.0 } else { 1.0 });
        scene.numerics.initial_overlap = InitialOverlap::Allow;
        Ok(scene)
    }

    /// The bed from its file.
    ///
    /// # Errors
    ///
    /// [`SceneError`] if a shape is not what the solver takes.
    pub fn bed(self, states: &States) -> Result<Scene, SceneError> {
        let mut scene = self.column(1.0, RESTITUTION)?;
        scene.bodies = self.bodies(states);
        Ok(scene)
    }

    pub(super) fn bodies(self, states: &States) -> Vec<Body> {
        let body = |state: &[f64; 7]| {
            let [x, y, z, orientation @ ..] = *state;
            let orientation = if self == Kind::Sphere { [1.0, 0.0, 0.0, 0.0] } else { orientation };
            Body { position: [x, y, z], orientation, ..Body::new("body", "glass") }
        };
        states.0.iter().map(body).collect()
    }

    /// Diameter in m of the ball round a body, or a little more.
    pub(super) fn longest(self) -> f64 {
        DIAMETER
            * match self {
                Kind::Sphere => 1.0,
                Kind::Cube | Kind::Icosahedron | Kind::Cylinder => 1.4,
                Kind::Ellipsoid => 2.53,
                Kind::Superellipsoid => 1.5,
                Kind::Cross => 1.75,
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every shape builds, with the mass of the ball.
    #[test]
    fn all_bodies_have_the_volume_of_the_ball() {
        for kind in Kind::ALL {
            let scene = kind.bed(&States(vec![[0.009, 0.009, 0.01, 1.0, 0.0, 0.0, 0.0]])).expect("a scene");
            let simulation = scene.build().expect("a scene that builds");
            let ball = DENSITY * std::f64::consts::PI / 6.0 * DIAMETER.powi(3);
            // The cross is the exact union of its cylinders; rounding of the cube root.
            assert!((simulation.bodies().mass(0) / ball - 1.0).abs() < 1e-12, "{kind:?}");
            assert!(2.0 * simulation.bodies().shape(0).bounding_radius() <= kind.longest() * (1.0 + 1e-12), "{kind:?}");
        }
    }
}
