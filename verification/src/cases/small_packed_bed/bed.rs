//! The bed: forty trilobes that our own discrete elements have let settle (R section 7.4.3), and how they stand in the box of a flow.
//!
//! `reference-data/trilobe_packing` holds the scene (`recipe.toml`), and its settled bodies as it left them (`data.csv`): to settle costs more than all flows of the
//! quick tier. A test lets the bodies go on from there.

use std::f64::consts::PI;
use std::sync::Arc;

use solver::coupling::resolved::immersed::ImmersedBody;
use solver::coupling::resolved::surface::lobes::Lobes;
use solver::coupling::resolved::surface::outline::Outline as _;
use solver::coupling::resolved::surface::prism::Prism;
use solver::{Orientation, Vector};

use crate::case::Failure;
use crate::exact::ergun;

const SETTLED: &str = include_str!("../../../../reference-data/trilobe_packing/data.csv");

/// Diameter in m of the circle round the lobes, in the packing; in flows it is one.
pub const DIAMETER: f64 = 1.6e-3;
/// Length over diameter (R).
pub const ASPECT: f64 = 2.0;
/// Periodic width in diameters (R).
pub const WIDTH: f64 = 5.0;
/// Free way before the bed in diameters (R).
pub const BEFORE: f64 = 3.0;
/// Bodies of a flow are smaller by that part, so that those that are pressed into each other where they touch do not overlap.
pub const SHRUNK: f64 = 5e-4;

/// A settled body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Centre in m.
    pub position: [f64; 3],
    /// Quaternion [w, x, y, z] from body to world.
    pub orientation: [f64; 4],
}

/// The settled bodies, the third direction upwards and the floor at zero.
pub fn settled() -> Vec<Pose> {
    let pose = |line: &str| {
        let numbers: Vec<f64> = line.split(',').filter_map(|word| word.parse().ok()).collect();
        let [_, x, y, z, w, i, j, k] = numbers.try_into().ok()?;
        Some(Pose { position: [x, y, z], orientation: [w, i, j, k] })
    };
    SETTLED.lines().skip(1).filter_map(pose).collect()
}

/// A trilobe of a flow: its lobes just touch.
pub struct Trilobe {
    outline: Lobes,
    length: f64,
}

impl Trilobe {
    /// Of lobes that touch, in diameters: a half over 1 + 2 / sqrt 3.
    pub const LOBE_RADIUS: f64 = 0.232_051;

    /// Smaller than one diameter by what keeps bodies apart.
    ///
    /// # Errors
    ///
    /// None for these sizes.
    pub fn new() -> Result<Trilobe, Failure> {
        let diameter = 1.0 - SHRUNK;
        let outline = Lobes::touching(3, diameter).map_err(|error| Failure::NothingMeasured(error.to_string()))?;
        Ok(Trilobe { outline, length: ASPECT * diameter })
    }

    /// In cubes of a diameter.
    pub fn volume(&self) -> f64 {
        self.outline.area() * self.length
    }

    /// Six volumes over the surface, in diameters (R eq. 7.24).
    pub fn equivalent_diameter(&self) -> f64 {
        6.0 * self.volume() / (self.outline.perimeter() * self.length + 2.0 * self.outline.area())
    }

    /// A bed of it by its void fraction.
    pub fn bed(&self, void_fraction: f64) -> ergun::Bed {
        ergun::Bed { void_fraction, diameter: self.equivalent_diameter() }
    }

    /// The bed of a flow, in diameters: upwards is the first direction, so that the fluid goes up from the floor that is not there any more.
    pub fn immersed(&self) -> Vec<ImmersedBody> {
        let surface = Arc::new(Prism::closed(self.outline, self.length));
        let turn = Orientation::from_scaled_axis(Vector::repeat(2.0 * PI / 27.0_f64.sqrt()));
        let of_pose = |pose: Pose| {
            let [w, i, j, k] = pose.orientation;
            let orientation = Orientation::from_quaternion(nalgebra::Quaternion::new(w, i, j, k));
            let position = turn * Vector::from(pose.position) / DIAMETER + Vector::x() * BEFORE;
            ImmersedBody { orientation: turn * orientation, ..ImmersedBody::fixed(surface.clone(), position) }
        };
        settled().into_iter().map(of_pose).collect()
    }
}

/// Highest point of a bed over its lowest one is not the height of a bed whose top is rough: this is twice the height of the middle of all solids.
pub fn height(bodies: &[ImmersedBody]) -> f64 {
    2.0 * (bodies.iter().map(|body| body.position.x).sum::<f64>() / bodies.len().max(1) as f64 - BEFORE)
}

#[cfg(test)]
mod tests {
    use solver::Scene;
    use solver::scene::{Body, InitialOverlap};

    use super::*;

    const RECIPE: &str = include_str!("../../../../reference-data/trilobe_packing/recipe.toml");

    fn recipe() -> Scene {
        Scene::from_toml(RECIPE, "recipe.toml").expect("a scene")
    }

    /// The scene goes on from the settled bodies: springs of friction begin anew and give way by little, nothing falls.
    #[test]
    fn the_settled_bodies_are_at_rest_in_the_scene_that_made_them() {
        let mut scene = recipe();
        let inserted: u32 = scene.insertions.iter().map(|insertion| insertion.number).sum();
        assert_eq!((scene.scene.gravity.map(|gravity| gravity[2]), inserted), (Some(-9.81), 40));
        let (shape, material) = (scene.shapes[0].name.clone(), scene.insertions[0].material.clone());
        let body = |pose: Pose| Body { position: pose.position, orientation: pose.orientation, ..Body::new(&shape, &material) };
        let before = settled();
        scene.bodies = before.iter().copied().map(body).collect();
        scene.insertions.clear();
        scene.numerics.initial_overlap = InitialOverlap::Allow;
        scene.scene.settled = None;
        let mut simulation = scene.build().expect("a scene");
        simulation.run_until(0.01).expect("no guard stops this run");
        assert_eq!(simulation.bodies().len(), 40);
        for (index, pose) in before.iter().enumerate() {
            let moved = simulation.bodies().position(index) - Vector::from(pose.position);
            // A body that nothing held would fall by half a millimetre, a third of its diameter.
            assert!(moved.norm() < 0.01 * DIAMETER, "{index}: {}", moved.norm());
        }
    }

    /// Settled bodies touch: bodies of full size overlap somewhere, those of a flow nowhere.
    #[test]
    fn bodies_of_a_flow_fill_what_is_left_of_forty_and_do_not_overlap() {
        use solver::coupling::resolved::immersed::{Inside, TOUCHING};
        use solver::fluid::grid::Grid;
        let trilobe = Trilobe::new().expect("a trilobe");
        // Lobes that touch fill 65.7 % of their circle.
        assert!((trilobe.volume() / (0.25 * PI * ASPECT * 0.657 * (1.0 - SHRUNK).powi(3)) - 1.0).abs() < 1e-3);
        assert!((trilobe.equivalent_diameter() - 0.744).abs() < 1e-3, "{}", trilobe.equivalent_diameter());
        let bodies = trilobe.immersed();
        assert_eq!(bodies.len(), 40);
        let grid = Grid::new([120, 60, 60], 1.0 / 12.0, Vector::zeros()).expect("enough cells");
        let [first, ..] = Inside::of_components(&grid, &bodies, TOUCHING).expect("bodies that do not overlap");
        let solid = (0..grid.len()).filter(|index| first.is_solid(*index)).count() as f64 / 12.0_f64.powi(3);
        assert!((solid / (40.0 * trilobe.volume()) - 1.0).abs() < 0.01, "{solid}");
        assert!(bodies.iter().all(|body| body.position.x > BEFORE));
        let height = height(&bodies);
        let fraction = 40.0 * trilobe.volume() / (height * WIDTH * WIDTH);
        assert!((0.45..0.65).contains(&fraction), "{height} {fraction}");
    }
}
