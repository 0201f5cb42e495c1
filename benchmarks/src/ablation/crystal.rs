//! The scene of the ablations: a cubic lattice of balls between six walls, everything pressed together so that no contact opens, everything astir.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, EndOfContact, Geometry, InitialOverlap, LinearHistory, LinearSpringDashpot, Material, NamedShape,
    NormalLaw, Pair, PlaneGeometry, PlateGeometry, Scene, SphereGeometry, Step, TangentialLaw, ViscousCoulomb,
};
use verification::cases::pair_distance::poses::Random;

/// Radius of a ball in m.
pub const RADIUS: f64 = 1.5e-3;
/// Time step in s: a twentieth of a contact.
pub const STEP: f64 = 2e-6;
/// Largest component of a velocity at the start in m/s; moves a ball by a twentieth of the overlap.
pub const SPEED: f64 = 0.01;
/// Largest component of a spin at the start in rad/s.
pub const SPIN: f64 = 10.0;
/// Stiffness of all contacts in N/m.
pub const STIFFNESS: f64 = 1e5;
const DENSITY: f64 = 2500.0;
const RESTITUTION: f64 = 0.75;
/// Friction that nothing overcomes.
const FRICTION: f64 = 0.5;
/// Dissipation rate of the viscous law in 1/s.
const DAMPING_RATE: f64 = 3430.0;
/// Overlap of neighbours in m, and of outer balls and walls.
pub const OVERLAP: f64 = 2e-3 * RADIUS;

/// Mass of a ball in kg.
pub fn mass() -> f64 {
    DENSITY * volume()
}

fn volume() -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3)
}

/// Balls along each edge, and what they and walls touch by.
pub fn scene(per_edge: usize, tangential: Option<TangentialLaw>) -> Scene {
    let mut scene = Scene::empty("crystal", 1.0);
    let material = |name: &str, density| Material { name: name.into(), density };
    scene.materials = vec![material("glass", Some(DENSITY)), material("wall", None)];
    let (restitution, end_of_contact) = (RESTITUTION, EndOfContact::ZeroOverlap);
    let normal = NormalLaw::LinearSpringDashpot(LinearSpringDashpot { stiffness: STIFFNESS, restitution, end_of_contact });
    let pair = |other: &str| Pair {
        materials: ["glass".into(), other.into()],
        normal: normal.clone(),
        tangential: tangential.clone(),
        rolling: None,
    };
    scene.pairs = ["glass", "wall"].map(pair).to_vec();
    scene.shapes = vec![NamedShape { name: "ball".into(), geometry: Geometry::Sphere(SphereGeometry { radius: RADIUS }) }];
    let mut random = Random::new(1);
    let mut stir = |largest: f64| [(); 3].map(|()| largest * (2.0 * random.number() - 1.0));
    for place in 0..per_edge.pow(3) {
        let position = [place % per_edge, place / per_edge % per_edge, place / per_edge.pow(2)].map(|index| index as f64 * spacing());
        let (velocity, angular_velocity) = (stir(SPEED), stir(SPIN));
        scene.bodies.push(Body { position, velocity, angular_velocity, ..Body::new("ball", "glass") });
    }
    scene.boundaries = walls(per_edge, plane);
    scene.numerics.step = Step::Seconds(STEP);
    scene.numerics.initial_overlap = InitialOverlap::Allow;
    scene
}

fn spacing() -> f64 {
    2.0 * RADIUS - OVERLAP
}

/// Lower and upper corner coordinate of the space between the walls, in m.
pub fn ends(per_edge: usize) -> [f64; 2] {
    let reach = RADIUS - OVERLAP;
    [-reach, (per_edge - 1) as f64 * spacing() + reach]
}

/// Six walls; a form makes one of them from its axis, its coordinate there, and the direction into the crystal.
pub fn walls(per_edge: usize, form: impl Fn(usize, f64, f64) -> BoundaryGeometry) -> Vec<Boundary> {
    let [lower, upper] = ends(per_edge);
    let of_axis = |axis: usize| [(axis, lower, 1.0), (axis, upper, -1.0)];
    let wall = |(axis, at, inwards): (usize, f64, f64)| Boundary::new(&format!("wall {axis} {inwards}"), "wall", form(axis, at, inwards));
    (0..3).flat_map(of_axis).map(wall).collect()
}

/// An infinite wall.
pub fn plane(axis: usize, at: f64, inwards: f64) -> BoundaryGeometry {
    let along = |value: f64| [0, 1, 2].map(|other| if other == axis { value } else { 0.0 });
    BoundaryGeometry::Plane(PlaneGeometry { point: along(at), normal: along(inwards) })
}

/// A square, so wide that no ball reaches its edges.
pub fn plate(axis: usize, at: f64, _inwards: f64) -> BoundaryGeometry {
    BoundaryGeometry::Plate(PlateGeometry { corners: square(axis, at).to_vec() })
}

/// Corners of a wide square across an axis.
pub fn square(axis: usize, at: f64) -> [[f64; 3]; 4] {
    let wide = 1.0;
    [[-wide, -wide], [wide, -wide], [wide, wide], [-wide, wide]].map(|[one, other]| {
        let mut corner = [at; 3];
        (corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (one, other);
        corner
    })
}

/// Friction with memory.
pub fn history() -> TangentialLaw {
    TangentialLaw::LinearHistory(LinearHistory { friction: FRICTION, stiffness: 2.0 / 7.0 * STIFFNESS, damping_ratio: 0.1 })
}

/// Friction without memory.
pub fn viscous() -> TangentialLaw {
    TangentialLaw::ViscousCoulomb(ViscousCoulomb { friction: FRICTION, damping_rate: DAMPING_RATE })
}

/// A law with memory whose spring is so soft that nothing is left but the dashpot of the viscous one between two balls.
pub fn viscous_with_memory() -> TangentialLaw {
    let stiffness = 1e-12 * STIFFNESS;
    // 2 zeta sqrt(k m 2/7) = 2 gamma m, with the reduced mass m of two balls.
    let damping_ratio = DAMPING_RATE * (0.5 * mass()).sqrt() / (2.0 / 7.0 * stiffness).sqrt();
    TangentialLaw::LinearHistory(LinearHistory { friction: FRICTION, stiffness, damping_ratio })
}
