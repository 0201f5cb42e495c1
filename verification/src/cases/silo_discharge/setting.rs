//! Scenes of the case: R's silo, and cylinders with a hole in a flat bottom, filled and discharged.

use std::f64::consts::TAU;

use solver::Scene;
use solver::scene::{
    Boundary, BoundaryGeometry, CylinderWallGeometry, EndOfContact, Geometry, HopperGeometry, InsertedOrientation, InsertedShape,
    Insertion, InsertionRegion, LatticeRegion, LinearHistory, LinearSpringDashpot, Material, MeshGeometry, NamedShape, NormalLaw, Outlet,
    OutletRegion, Pair, PlaneGeometry, PlateGeometry, Settled, Side, SphereGeometry, Step, TangentialLaw, ViscousCoulomb,
};

/// Diameter of a bead in m.
pub const DIAMETER: f64 = 0.0138;
/// In kg/m^3.
pub const DENSITY: f64 = 2516.0;
/// In m/s^2.
pub const GRAVITY: f64 = 9.81;
/// Beads in R's silo.
pub const BEADS: u32 = 14_000;
/// Width of R's silo, width of its outlet, height of the part above the hopper, in m.
pub const WIDTH: f64 = 0.25;
pub const OUTLET: f64 = 0.057;
pub const HEIGHT: f64 = 0.5;
/// Angle of the hopper's walls to the horizontal in degrees.
const HOPPER_ANGLE: f64 = 62.5;
/// R's step in s, fifteen to the contact of two beads; a stiffness divided by s goes with one that is longer by the root of s.
const STEP: f64 = 1e-5;
/// R's stiffness in N/m between beads, and at walls.
const STIFFNESS: [f64; 2] = [7.2e5, 1e6];
/// R's restitution between beads.
const RESTITUTION: f64 = 0.75;
/// R's restitution at walls, and that which its printed damping rate gives (errata, table 5.1).
const AT_WALLS: f64 = 0.62;
const AT_WALLS_AS_PRINTED: f64 = 0.715;
const FRICTION: f64 = 0.3;
/// Tangential over normal stiffness of springs of friction, as long as the source gives none: that of Mindlin's incompressible spheres.
const TANGENTIAL: f64 = 2.0 / 7.0;
/// Damping of springs of friction as a part of critical: enough for a packing to come to rest.
const TANGENTIAL_DAMPING: f64 = 0.1;
/// Tangential damping rate of R's friction in 1/s; the source gives none, so the normal one of table 5.1.
const SLIP_DAMPING: f64 = 1.87e3;

/// The laws of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Laws {
    /// Friction with springs, restitution as stated.
    Springs,
    /// Friction of R: of Coulomb, capped by a dashpot.
    Viscous,
    /// Springs, and at walls the restitution of R's printed damping rate.
    PrintedWalls,
}

/// Height of the hopper in m.
pub fn hopper_height() -> f64 {
    0.5 * (WIDTH - OUTLET) * HOPPER_ANGLE.to_radians().tan()
}

/// Mass of a bead in kg.
pub fn bead_mass() -> f64 {
    DENSITY * std::f64::consts::PI / 6.0 * DIAMETER.powi(3)
}

/// Beads, walls and laws with a stiffness divided by `softening`; no walls yet.
fn beads(name: &str, laws: Laws, softening: f64, end_time: f64, random_seed: u64) -> Scene {
    let mut scene = Scene::empty(name, end_time);
    scene.scene.gravity = Some([0.0, 0.0, -GRAVITY]);
    scene.scene.random_seed = random_seed;
    scene.materials = vec![Material { name: "glass".into(), density: Some(DENSITY) }, Material { name: "wall".into(), density: None }];
    let at_walls = if laws == Laws::PrintedWalls { AT_WALLS_AS_PRINTED } else { AT_WALLS };
    let pair = |other: &str, stiffness: f64, restitution: f64| Pair {
        materials: ["glass".into(), other.into()],
        normal: NormalLaw::LinearSpringDashpot(LinearSpringDashpot {
            stiffness: stiffness / softening,
            restitution,
            end_of_contact: EndOfContact::ZeroOverlap,
        }),
        tangential: Some(match laws {
            Laws::Viscous => TangentialLaw::ViscousCoulomb(ViscousCoulomb { friction: FRICTION, damping_rate: SLIP_DAMPING }),
            Laws::Springs | Laws::PrintedWalls => TangentialLaw::LinearHistory(LinearHistory {
                friction: FRICTION,
                stiffness: TANGENTIAL * stiffness / softening,
                damping_ratio: TANGENTIAL_DAMPING,
            }),
        }),
        rolling: None,
    };
    scene.pairs = vec![pair("glass", STIFFNESS[0], RESTITUTION), pair("wall", STIFFNESS[1], at_walls)];
    scene.shapes = vec![NamedShape { name: "bead".into(), geometry: Geometry::Sphere(SphereGeometry { radius: 0.5 * DIAMETER }) }];
    scene.numerics.step = Step::Seconds(STEP * softening.sqrt());
    scene
}

/// Beads in rows from a corner on, shifted at random, that fall until they are at rest.
fn fill(scene: &mut Scene, number: u32, lower: [f64; 3], upper: [f64; 2], spacing: f64) {
    let rows = ((upper[0] - lower[0]) / spacing).floor() * ((upper[1] - lower[1]) / spacing).floor();
    // Where corners are cut off by a round wall there are fewer sites in a storey: there is room for twice as many storeys.
    let top = lower[2] + spacing * (2.0 * f64::from(number) / rows).ceil();
    scene.insertions = vec![Insertion {
        name: "fill".into(),
        material: "glass".into(),
        number,
        shapes: vec![InsertedShape { shape: "bead".into(), fraction: 1.0, scale: None }],
        region: InsertionRegion::Lattice(LatticeRegion {
            lower,
            upper: [upper[0], upper[1], top],
            spacing: [spacing; 3],
            jitter: 0.45 * (spacing - DIAMETER),
        }),
        orientation: InsertedOrientation::default(),
        velocity: [0.0; 3],
        angular_velocity: [0.0; 3],
        attempts: 1,
        during_run: None,
    }];
    scene.scene.settled = Some(Settled { speed: 0.03 * (GRAVITY * DIAMETER).sqrt(), hold: 0.02 });
}

fn wall(name: &str, geometry: BoundaryGeometry) -> Boundary {
    Boundary::new(name, "wall", geometry)
}

/// Beads leave when they are well through an outlet at the origin.
fn outlet() -> Outlet {
    let region = OutletRegion::BehindPlane(PlaneGeometry { point: [0.0, 0.0, -1.5 * DIAMETER], normal: [0.0, 0.0, 1.0] });
    Outlet { name: "outlet".into(), region }
}

/// R's silo, without beads.
fn silo(laws: Laws, softening: f64, end_time: f64, random_seed: u64) -> Scene {
    let mut scene = beads("silo", laws, softening, end_time, random_seed);
    let half = 0.5 * WIDTH;
    for (name, point, normal) in [
        ("left", [-half, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ("right", [half, 0.0, 0.0], [-1.0, 0.0, 0.0]),
        ("front", [0.0, -half, 0.0], [0.0, 1.0, 0.0]),
        ("back", [0.0, half, 0.0], [0.0, -1.0, 0.0]),
    ] {
        scene.boundaries.push(wall(name, BoundaryGeometry::Plane(PlaneGeometry { point, normal })));
    }
    let hopper = HopperGeometry { outlet: [0.0; 3], upper: [WIDTH; 2], lower: [OUTLET; 2], height: hopper_height() };
    scene.boundaries.push(wall("hopper", BoundaryGeometry::Hopper(hopper)));
    scene
}

/// R's silo with the outlet shut by a plate, to be filled.
pub fn silo_filling(laws: Laws, softening: f64, random_seed: u64) -> Scene {
    let mut scene = silo(laws, softening, 10.0, random_seed);
    let half = 0.5 * OUTLET;
    let corners = vec![[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0]];
    scene.boundaries.push(wall("plate", BoundaryGeometry::Plate(PlateGeometry { corners })));
    let half = 0.5 * WIDTH;
    fill(&mut scene, BEADS, [-half, -half, hopper_height() + DIAMETER], [half, half], 1.05 * DIAMETER);
    scene
}

/// R's silo, open, without beads.
pub fn silo_open(laws: Laws, softening: f64, random_seed: u64) -> Scene {
    let mut scene = silo(laws, softening, 60.0, random_seed);
    scene.outlets = vec![outlet()];
    scene
}

/// A cylinder with a hole in its flat bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatBottom {
    /// Of the hole, over that of a bead.
    pub hole: f64,
    /// Of the vessel, over that of a bead.
    pub vessel: f64,
    /// Beads in it.
    pub beads: u32,
    /// R's stiffness over that of the beads.
    pub softening: f64,
}

/// Corners of the hole, a polygon of the area of the circle.
const CORNERS: u32 = 48;

impl FlatBottom {
    /// A vessel with a hole of so many diameters: all lengths grow with the hole.
    pub fn of_hole(hole: f64, softening: f64) -> FlatBottom {
        let scale = hole / 6.0;
        FlatBottom { hole, vessel: 14.0 * scale, beads: (2000.0 * scale.powi(3)).round() as u32, softening }
    }

    /// The same hole with more beads, wider and deeper alike.
    pub fn with_beads(self, beads: f64) -> FlatBottom {
        FlatBottom { beads: beads as u32, vessel: self.vessel * (beads / f64::from(self.beads)).cbrt(), ..self }
    }

    fn vessel(&self, random_seed: u64) -> Scene {
        let mut scene = beads("flat bottom", Laws::Springs, self.softening, 20.0, random_seed);
        let radius = 0.5 * self.vessel * DIAMETER;
        let side = CylinderWallGeometry { centre: [0.0; 3], axis: [0.0, 0.0, 1.0], radius, length: None, side: Side::Inside };
        scene.boundaries = vec![
            wall("vessel", BoundaryGeometry::Cylinder(side)),
            wall("bottom", BoundaryGeometry::Mesh(ring(0.5 * self.hole * DIAMETER, 1.2 * radius))),
        ];
        scene
    }

    /// The vessel with its hole shut, to be filled.
    pub fn filling(&self, random_seed: u64) -> Scene {
        let mut scene = self.vessel(random_seed);
        scene.boundaries[1] = wall("bottom", BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: [0.0, 0.0, 1.0] }));
        let radius = 0.5 * self.vessel * DIAMETER;
        fill(&mut scene, self.beads, [-radius, -radius, 0.0], [radius, radius], 1.08 * DIAMETER);
        scene
    }

    /// The vessel, open, without beads.
    pub fn open(&self, random_seed: u64) -> Scene {
        let mut scene = self.vessel(random_seed);
        scene.outlets = vec![outlet()];
        scene
    }
}

/// A flat ring about the origin between a polygon of the area of a circle and one that holds a circle.
fn ring(inner: f64, outer: f64) -> MeshGeometry {
    let count = f64::from(CORNERS);
    let inner = inner * (TAU / count / (TAU / count).sin()).sqrt();
    let corner = |radius: f64, number: u32| {
        let (sine, cosine) = (TAU * f64::from(number) / count).sin_cos();
        [radius * cosine, radius * sine, 0.0]
    };
    let vertices = [inner, outer].into_iter().flat_map(|radius| (0..CORNERS).map(move |number| corner(radius, number))).collect();
    let count = CORNERS as usize;
    let triangles = (0..count).flat_map(move |one| {
        let next = (one + 1) % count;
        [[one, one + count, next + count], [one, next + count, next]]
    });
    MeshGeometry { vertices, triangles: triangles.collect(), smooth_below: 0.35 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 48 corners on the circle would have a hole that is too small by 0.3 %.
    #[test]
    fn the_hole_has_the_area_of_the_circle() {
        let ring = ring(1.0, 2.0);
        let area: f64 = (0..CORNERS as usize)
            .map(|one| (ring.vertices[one], ring.vertices[(one + 1) % CORNERS as usize]))
            .map(|(one, next)| 0.5 * (one[0] * next[1] - one[1] * next[0]))
            .sum();
        assert!((area / std::f64::consts::PI - 1.0).abs() < 1e-12, "{area}");
    }

    #[test]
    fn the_hopper_is_as_high_as_its_angle_says() {
        assert!((hopper_height() - 0.1854).abs() < 5e-5);
        // 14,000 beads weigh what the experiment's do.
        assert!((f64::from(BEADS) * bead_mass() - 48.47).abs() < 0.01);
    }

    #[test]
    fn all_scenes_build() {
        let small = FlatBottom::of_hole(6.0, 400.0);
        assert_eq!(small.filling(1).build().unwrap().bodies().len(), 2000);
        for laws in [Laws::Springs, Laws::Viscous, Laws::PrintedWalls] {
            assert_eq!(silo_filling(laws, 100.0, 1).build().unwrap().bodies().len(), BEADS as usize);
        }
    }
}
