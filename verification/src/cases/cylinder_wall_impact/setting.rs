//! One impact: what stands for the cylinder, how it is tilted, which rules are in force; its scene and its exact solution.

use std::f64::consts::PI;
use std::sync::{LazyLock, Mutex};

use solver::scene::{
    Body, Boundary, BoundaryGeometry, CompositeGeometry, ContactEdges, ContactPoints, DampedMass, DampingTime, EndOfContact, Geometry,
    GivenMassProperties, LinearSpringDashpot, Material, NamedShape, NormalLaw, Pair, PartGeometry, PlaneGeometry, RodGeometry, Scene,
    Sharing, SphereGeometry, Step,
};
use solver::shape::{Convex, Part, composites};
use solver::{Simulation, Vector};

use crate::case::Failure;
use crate::exact::rigid_cylinder_impact::CylinderImpact;
use crate::exact::soft_impact::{self, Law, Motion, PlanarBody, Point};

pub(super) const RADIUS: f64 = 4e-3;
pub(super) const LENGTH: f64 = 5.3e-3;
pub(super) const MASS: f64 = 3.1e-4;
pub(super) const APPROACH: f64 = 1.0;
pub(super) const RESTITUTION: f64 = 0.85;
/// R does not print its stiffness: this one lets the cylinder overlap the wall by 0.2 % of its diameter.
pub(super) const STIFFNESS: f64 = 1e6;

/// What stands for the cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Representation {
    /// The cylinder itself.
    Cylinder,
    /// Thinner cylinders glued in a row.
    Slices(usize),
    /// Nine glued spheres.
    NineSpheres,
    /// Fifty-four glued spheres.
    FiftyFourSpheres,
}

/// One impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setting {
    pub(super) representation: Representation,
    /// 0: standing on its face, 90: lying on its side.
    pub(super) tilt_in_degrees: f64,
    pub(super) stiffness: f64,
    pub(super) restitution: f64,
    pub(super) sharing: Sharing,
    pub(super) damped_mass: DampedMass,
    pub(super) points: ContactPoints,
    /// Crust by which edges are rounded against the wall, as a part of half the length; zero for sharp edges.
    pub(super) crust: f64,
    /// As most codes do it: lagged damping, sampled edges of contacts.
    pub(super) plain_scheme: bool,
}

impl Setting {
    /// The cylinder itself under the default rules.
    pub(super) fn cylinder(tilt_in_degrees: f64) -> Setting {
        Setting {
            representation: Representation::Cylinder,
            tilt_in_degrees,
            stiffness: STIFFNESS,
            restitution: RESTITUTION,
            sharing: Sharing::Sum,
            damped_mass: DampedMass::Effective,
            points: ContactPoints::All,
            crust: 0.0,
            plain_scheme: false,
        }
    }

    fn tilt(&self) -> f64 {
        // Exact at the ends, so that faces and lines are faces and lines.
        self.tilt_in_degrees.to_radians()
    }

    /// The closed form of the rigid cylinder.
    pub(super) fn rigid(&self) -> CylinderImpact {
        CylinderImpact {
            radius: RADIUS,
            length: LENGTH,
            mass: MASS,
            inertia: transverse_inertia(),
            approach: APPROACH,
            restitution: self.restitution,
        }
    }

    fn planar_body(&self) -> PlanarBody {
        let sphere = |part: &Part| {
            let radius = if let Convex::Sphere(sphere) = &part.convex { sphere.radius } else { f64::NAN };
            Point { axial: part.position.z, radial: part.position.x, radius }
        };
        let points = match self.representation {
            Representation::Cylinder => soft_impact::cylinder_points(RADIUS, LENGTH),
            Representation::Slices(count) => soft_impact::sliced_cylinder_points(RADIUS, LENGTH, count),
            Representation::NineSpheres | Representation::FiftyFourSpheres => self.spheres().iter().map(sphere).collect(),
        };
        PlanarBody { mass: MASS, inertia: transverse_inertia(), points }
    }

    fn spheres(&self) -> Vec<Part> {
        let spheres = match self.representation {
            Representation::NineSpheres => composites::glued_spheres_cylinder_9(RADIUS, LENGTH),
            _ => composites::glued_spheres_cylinder_54(RADIUS, LENGTH),
        };
        spheres.unwrap_or_default()
    }

    fn planar_law(&self) -> Law {
        Law {
            stiffness: self.stiffness,
            restitution: self.restitution,
            sharing: match self.sharing {
                Sharing::Sum => soft_impact::Sharing::Sum,
                Sharing::ByOverlap => soft_impact::Sharing::ByOverlap,
                Sharing::ByCount => soft_impact::Sharing::ByCount,
                Sharing::SumAsPrinted => soft_impact::Sharing::SumAsPrinted,
            },
            damping_mass: match self.damped_mass {
                DampedMass::Effective => soft_impact::DampingMass::Effective,
                DampedMass::Reduced => soft_impact::DampingMass::Reduced,
            },
        }
    }

    /// The soft impact, exactly; found once, because it is no part of the cost of a run.
    pub(super) fn exact(&self) -> SoftImpact {
        static KNOWN: LazyLock<Mutex<Vec<(Setting, SoftImpact)>>> = LazyLock::new(Mutex::default);
        let sharp = Setting { points: ContactPoints::All, crust: 0.0, plain_scheme: false, ..*self };
        let mut known = KNOWN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some((_, found)) = known.iter().find(|(setting, _)| *setting == sharp) {
            return *found;
        }
        let found = sharp.solve();
        known.push((sharp, found));
        found
    }

    fn solve(&self) -> SoftImpact {
        let (body, law) = (self.planar_body(), self.planar_law());
        let longest = 4.0 * PI * (MASS / self.stiffness).sqrt();
        let duration = soft_impact::impact(&body, &law, self.tilt(), APPROACH, longest).contact_duration.unwrap_or(longest);
        let motion = soft_impact::impact(&body, &law, self.tilt(), APPROACH, FLIGHT_AFTER * duration);
        SoftImpact { motion, duration }
    }

    /// Total force over time, exactly.
    pub(super) fn exact_force(&self, samples: usize) -> Vec<[f64; 2]> {
        let duration = 2.0 * PI * (MASS / self.stiffness).sqrt();
        soft_impact::force_history(&self.planar_body(), &self.planar_law(), self.tilt(), APPROACH, duration, samples)
    }

    /// The scene with a step in s, the first touch at a fraction of the second step.
    pub(super) fn scene(&self, step: f64, phase: f64) -> Scene {
        let SoftImpact { duration, .. } = self.exact();
        let mut scene = Scene::empty("cylinder-wall impact", (1.0 + phase) * step + FLIGHT_AFTER * duration);
        let material = |name: &str| Material { name: name.into(), density: None };
        scene.materials = vec![material("cylinder"), material("wall")];
        let law =
            LinearSpringDashpot { stiffness: self.stiffness, restitution: self.restitution, end_of_contact: EndOfContact::ZeroOverlap };
        let normal = NormalLaw::LinearSpringDashpot(law);
        scene.pairs = vec![Pair { materials: ["cylinder".into(), "wall".into()], normal, tangential: None, rolling: None }];
        scene.shapes = self.shapes();
        let gap = APPROACH * step * (1.0 + phase);
        let lowest = |point: Point| {
            let (sine, cosine) = self.tilt().sin_cos();
            point.axial * cosine - point.radial * sine - point.radius
        };
        let height = gap - self.planar_body().points.into_iter().map(lowest).fold(f64::INFINITY, f64::min);
        scene.bodies = vec![Body {
            mass: Some(MASS),
            principal_inertia: Some([transverse_inertia(), transverse_inertia(), 0.5 * MASS * RADIUS * RADIUS]),
            position: (away_from_wall() * height).into(),
            velocity: (away_from_wall() * -APPROACH).into(),
            orientation: self.orientation(),
            ..Body::new("body", "cylinder")
        }];
        let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: away_from_wall().into() });
        scene.boundaries = vec![Boundary::new("wall", "wall", geometry)];
        scene.numerics.step = Step::Seconds(step);
        scene.numerics.shaped_contact.sharing = self.sharing;
        scene.numerics.shaped_contact.damped_mass = self.damped_mass;
        scene.numerics.shaped_contact.points = self.points;
        if self.crust > 0.0 {
            scene.numerics.shaped_contact.crust = self.crust;
            scene.numerics.shaped_contact.crust_at_walls = true;
        }
        if self.plain_scheme {
            (scene.numerics.damping, scene.numerics.contact_edges) = (DampingTime::Lagged, ContactEdges::Sampled);
        }
        scene
    }

    fn shapes(&self) -> Vec<NamedShape> {
        let named = |name: &str, geometry: Geometry| NamedShape { name: name.into(), geometry };
        let rod = |length: f64| Geometry::Cylinder(RodGeometry { radius: RADIUS, length });
        let (part_geometry, places): (Geometry, Vec<Vector>) = match self.representation {
            Representation::Cylinder => return vec![named("body", rod(LENGTH))],
            Representation::Slices(count) => {
                let thickness = LENGTH / count as f64;
                let place = |slice: usize| Vector::z() * (thickness * (slice as f64 + 0.5 - 0.5 * count as f64));
                (rod(thickness), (0..count).map(place).collect())
            }
            Representation::NineSpheres | Representation::FiftyFourSpheres => {
                let spheres = self.spheres();
                let radius = spheres.first().map_or(f64::NAN, |part| part.convex.bounding_radius());
                (Geometry::Sphere(SphereGeometry { radius }), spheres.into_iter().map(|part| part.position).collect())
            }
        };
        let part = |place: Vector| PartGeometry { shape: "part".into(), position: place.into(), orientation: [1.0, 0.0, 0.0, 0.0] };
        // Whatever stands for the cylinder has the mass properties of the cylinder, so that only the contact differs.
        let across = 0.25 * RADIUS * RADIUS;
        let mass_properties =
            GivenMassProperties { volume: PI * RADIUS * RADIUS * LENGTH, mean_squares: [across, across, LENGTH * LENGTH / 12.0] };
        let composite = CompositeGeometry { parts: places.into_iter().map(part).collect(), mass_properties: Some(mass_properties) };
        vec![named("part", part_geometry), named("body", Geometry::Composite(composite))]
    }

    fn orientation(&self) -> [f64; 4] {
        let (sine, cosine) = self.tilt().sin_cos();
        let axis = away_from_wall() * cosine + along_wall() * sine;
        let radial = along_wall() * cosine - away_from_wall() * sine;
        let matrix = nalgebra::Matrix3::from_columns(&[radial, axis.cross(&radial), axis]);
        let turn = solver::Orientation::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(matrix));
        [turn.w, turn.i, turn.j, turn.k]
    }
}

/// An exact soft impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SoftImpact {
    /// Its end.
    pub(super) motion: Motion,
    /// From the first touch until no point touches, in s.
    pub(super) duration: f64,
}

/// The motion is followed for this many contact durations after the first touch.
const FLIGHT_AFTER: f64 = 1.05;

pub(super) fn transverse_inertia() -> f64 {
    MASS * (3.0 * RADIUS * RADIUS + LENGTH * LENGTH) / 12.0
}

/// The wall is oblique in space, so that no coordinate is special.
fn away_from_wall() -> Vector {
    Vector::new(2.0, 3.0, 6.0) / 7.0
}

fn along_wall() -> Vector {
    Vector::new(6.0, 2.0, -3.0) / 7.0
}

/// What an impact leaves: velocity away from the wall, and rate of the tilt times the radius, both in m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct After {
    pub(super) velocity: f64,
    pub(super) spin: f64,
}

impl From<Motion> for After {
    fn from(motion: Motion) -> After {
        After { velocity: motion.velocity, spin: motion.tilt_rate * RADIUS }
    }
}

impl Setting {
    /// Runs the impact to its end; calls back after every step.
    pub(super) fn run(&self, step: f64, phase: f64, mut each: impl FnMut(&mut Simulation)) -> Result<(After, Simulation), Failure> {
        let mut simulation = self.scene(step, phase).build()?;
        let last = simulation.steps_to(simulation.scene().scene.end_time);
        while simulation.steps_taken() < last {
            simulation.step();
            each(&mut simulation);
        }
        simulation.check_guards()?;
        let now = simulation.now();
        let after = After {
            velocity: now.velocity(0).dot(&away_from_wall()),
            spin: now.angular_velocity(0).dot(&away_from_wall().cross(&along_wall())) * RADIUS,
        };
        Ok((after, simulation))
    }
}

/// Force away from the wall, in N.
pub(super) fn force_of(simulation: &Simulation) -> f64 {
    simulation.bodies().force(0).dot(&away_from_wall())
}
