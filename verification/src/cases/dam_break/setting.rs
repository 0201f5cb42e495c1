//! The column behind the gate: grains, walls, stiffness and step, and the scene made of them.

use solver::Scene;
use solver::scene::{
    Boundary, BoundaryGeometry, BoundaryMotion, Domain, EndOfContact, Geometry, InsertedOrientation, InsertedShape, Insertion,
    InsertionRegion, LatticeRegion, LinearHistory, LinearSpringDashpot, Material, NamedShape, NormalLaw, Pair, PlaneGeometry,
    PlateGeometry, RegularGeometry, RollingLaw, SphereGeometry, SpringTorque, Step, TangentialLaw, TranslationMotion, ViscousCoulomb,
};

/// Diameter in m of the ball of the volume of a grain (R section 5.4.2).
pub(super) const DIAMETER: f64 = 3e-3;
pub(super) const GRAVITY: f64 = 9.81;
/// kg/m^3; R prints none, and its duration of a contact gives this.
const DENSITY: f64 = 2500.0;
/// Between grains (R table 5.4).
const RESTITUTION: f64 = 0.75;
/// At walls: what R's damping really gives where it says 0.75 (errata).
const WALL_RESTITUTION: f64 = 0.816;
/// R's friction of grains and walls.
pub(super) const FRICTION: f64 = 0.5;
/// Stiffness of R in N/m.
const STIFFNESS_OF_R: f64 = 1e5;
/// Volume of grains per volume of a column that has settled, by which the number of grains of a wanted height is chosen; the height is then measured.
const EXPECTED_FRACTION: f64 = 0.57;
/// Steps in the shortest contact: S asks for 15, and rounding shall not make them fewer.
const STEPS_IN_CONTACT: f64 = 15.01;
/// Largest overlap of two grains that meet at the speed of a fall over the height of the column, in diameters: it sets the softened stiffness.
const OVERLAP_AT_FALL_SPEED: f64 = 0.15;
/// Distance of neighbouring sites of the filling lattice in diameters, for spheres and icosahedra alike. From a closer lattice rows and storeys of spheres stay
/// as they are: a stiff column then has the solid fraction of a cubic lattice.
const SPACING: f64 = 1.25;

/// Longest wait for the column to rest behind the gate, and from the opening on for the heap, in time scales of the fall.
const LONGEST_FILLING: f64 = 8.0;
pub(super) const LONGEST: u32 = 6;

/// Skin of the neighbour list in diameters: soft grains take long steps, and fall far in each.
const SKIN: f64 = 0.35;

/// What the grains are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Grains {
    Spheres,
    Icosahedra,
}

impl Grains {
    /// Edge in m of the icosahedron of the volume of the ball.
    fn edge() -> f64 {
        // An icosahedron has 5 (3 + sqrt 5) / 12 edges cubed.
        let volume = std::f64::consts::FRAC_PI_6 * DIAMETER.powi(3);
        (volume * 12.0 / (5.0 * (3.0 + 5.0_f64.sqrt()))).cbrt()
    }

    fn geometry(self) -> Geometry {
        match self {
            Grains::Spheres => Geometry::Sphere(SphereGeometry { radius: 0.5 * DIAMETER }),
            Grains::Icosahedra => Geometry::Icosahedron(RegularGeometry { edge: Grains::edge() }),
        }
    }

    /// Diameter in m of the ball that holds a grain.
    fn outer_diameter(self) -> f64 {
        match self {
            Grains::Spheres => DIAMETER,
            // Corners lie at a quarter of sqrt(10 + 2 sqrt 5) edges.
            Grains::Icosahedra => Grains::edge() * 0.5 * (10.0 + 2.0 * 5.0_f64.sqrt()).sqrt(),
        }
    }
}

/// How the gate opens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Gate {
    /// It is gone at once.
    Removed,
    /// It is lifted at a speed in m/s, without friction.
    Lifted(f64),
}

/// Resistance in the contact plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Friction {
    /// Spring with memory, capped: a heap can rest.
    WithMemory,
    /// R's viscous law with a rate in 1/s, capped: a heap creeps.
    Viscous(f64),
}

/// A column and what becomes of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Column {
    pub(super) grains: Grains,
    /// Length behind the gate, in diameters.
    pub(super) length: f64,
    /// Height over length that is aimed at.
    pub(super) aspect_ratio: f64,
    /// Periodic width, in diameters.
    pub(super) width: f64,
    pub(super) friction: f64,
    /// Of the floor and the back wall.
    pub(super) wall_friction: f64,
    /// Coefficient of rolling friction: largest torque over force and rolling radius (Ai et al. 2011, type C with their stiffness). Spheres only.
    pub(super) rolling: f64,
    pub(super) law: Friction,
    /// Stiffness over the softened one.
    pub(super) stiffening: f64,
    pub(super) gate: Gate,
}

impl Column {
    /// Spheres with R's friction, and with rolling friction that lets a heap of them rest on a flat floor; softened.
    pub(super) fn of_spheres(length: f64, aspect_ratio: f64, width: f64) -> Column {
        Column {
            grains: Grains::Spheres,
            length,
            aspect_ratio,
            width,
            friction: FRICTION,
            wall_friction: FRICTION,
            rolling: 0.1,
            law: Friction::WithMemory,
            stiffening: 1.0,
            gate: Gate::Removed,
        }
    }

    /// Height in m that is aimed at.
    pub(super) fn height(&self) -> f64 {
        self.aspect_ratio * self.length * DIAMETER
    }

    /// Time in s in which the column falls: the root of height over gravity.
    pub(super) fn time_scale(&self) -> f64 {
        (self.height() / GRAVITY).sqrt()
    }

    /// Speed in m/s of a fall over twice the height: the root of gravity times height.
    pub(super) fn speed_scale(&self) -> f64 {
        (self.height() * GRAVITY).sqrt()
    }

    pub(super) fn number_of_grains(&self) -> u32 {
        let volume = self.length * DIAMETER * self.height() * self.width * DIAMETER;
        (EXPECTED_FRACTION * volume / (std::f64::consts::FRAC_PI_6 * DIAMETER.powi(3))).round() as u32
    }

    fn mass() -> f64 {
        DENSITY * std::f64::consts::FRAC_PI_6 * DIAMETER.powi(3)
    }

    /// Stiffness in N/m: so soft that a grain that falls over the height of the column is pressed in by a written part of its diameter, but not stiffer than R's.
    pub(super) fn stiffness(&self) -> f64 {
        let speed_squared = 2.0 * GRAVITY * self.height();
        let softened = 0.5 * Column::mass() * speed_squared / (OVERLAP_AT_FALL_SPEED * DIAMETER).powi(2);
        (softened * self.stiffening).min(STIFFNESS_OF_R)
    }

    /// Duration in s of the contact of two grains.
    fn contact_duration(&self) -> f64 {
        let undamped = std::f64::consts::PI * (0.5 * Column::mass() / self.stiffness()).sqrt();
        undamped * (1.0 + (RESTITUTION.ln() / std::f64::consts::PI).powi(2)).sqrt()
    }

    /// When the gate opens at the latest, in s: the lattice has come down, grains have found their places, and waves have died away. Most columns rest long
    /// before, and a run does not wait longer than for that.
    pub(super) fn latest_opening(&self) -> f64 {
        LONGEST_FILLING * self.time_scale() + 3.0 * (DIAMETER / GRAVITY).sqrt()
    }

    fn pair(&self, other: &str, friction: f64, restitution: f64) -> Pair {
        let (stiffness, end_of_contact) = (self.stiffness(), EndOfContact::ZeroOverlap);
        let tangential = match self.law {
            Friction::WithMemory => {
                TangentialLaw::LinearHistory(LinearHistory { friction, stiffness: 2.0 / 7.0 * stiffness, damping_ratio: 0.1 })
            }
            Friction::Viscous(damping_rate) => TangentialLaw::ViscousCoulomb(ViscousCoulomb { friction, damping_rate }),
        };
        // The rolling radius of two equal spheres is a quarter of their diameter.
        let rolling_stiffness = 2.25 * stiffness * (0.25 * self.rolling * DIAMETER).powi(2);
        let rolling = RollingLaw::SpringTorque(SpringTorque { friction: self.rolling, stiffness: rolling_stiffness, damping_ratio: 0.3 });
        Pair {
            materials: ["grain".into(), other.into()],
            normal: NormalLaw::LinearSpringDashpot(LinearSpringDashpot { stiffness, restitution, end_of_contact }),
            tangential: (friction > 0.0).then_some(tangential),
            rolling: (self.rolling > 0.0 && friction > 0.0 && self.grains == Grains::Spheres).then_some(rolling),
        }
    }

    fn gate(&self, opening_time: f64) -> Boundary {
        let (place, wide) = (self.length * DIAMETER, self.width * DIAMETER);
        match self.gate {
            Gate::Removed => {
                let plane = PlaneGeometry { point: [place, 0.0, 0.0], normal: [-1.0, 0.0, 0.0] };
                let motion = BoundaryMotion { removed_at: Some(opening_time), ..BoundaryMotion::default() };
                Boundary { motion: Some(motion), ..Boundary::new("gate", "gate", BoundaryGeometry::Plane(plane)) }
            }
            Gate::Lifted(speed) => {
                // Walls have no images: it ends beyond the sides. It stands a tenth of a diameter above the floor.
                let (low, high) = (0.1 * DIAMETER, 4.0 * self.height());
                let corner = |y: f64, z: f64| [place, y, z];
                let corners = vec![
                    corner(-2.0 * DIAMETER, low),
                    corner(wide + 2.0 * DIAMETER, low),
                    corner(wide + 2.0 * DIAMETER, high),
                    corner(-2.0 * DIAMETER, high),
                ];
                let translation = TranslationMotion { velocity: [0.0, 0.0, speed], start: opening_time, end: None };
                let motion = BoundaryMotion {
                    translation: Some(translation),
                    removed_at: Some(opening_time + high / speed),
                    ..BoundaryMotion::default()
                };
                Boundary { motion: Some(motion), ..Boundary::new("gate", "gate", BoundaryGeometry::Plate(PlateGeometry { corners })) }
            }
        }
    }

    fn filling(&self) -> Insertion {
        let outer = self.grains.outer_diameter();
        let (length, width) = (self.length * DIAMETER, self.width * DIAMETER);
        let along = |wide: f64| ((wide / (SPACING * DIAMETER)).floor().max(1.0), wide);
        let ((rows, length), (layers, width)) = (along(length), along(width));
        let spacing = [length / rows, width / layers, SPACING * DIAMETER];
        let storeys = (f64::from(self.number_of_grains()) / (rows * layers)).ceil();
        let least = spacing.iter().copied().fold(f64::INFINITY, f64::min);
        let region =
            LatticeRegion { lower: [0.0; 3], upper: [length, width, storeys * spacing[2]], spacing, jitter: 0.499 * (least - outer) };
        Insertion {
            name: "column".into(),
            material: "grain".into(),
            number: self.number_of_grains(),
            shapes: vec![InsertedShape { shape: "grain".into(), fraction: 1.0, scale: None }],
            region: InsertionRegion::Lattice(region),
            orientation: InsertedOrientation::default(),
            velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
            attempts: 1,
            during_run: None,
        }
    }

    /// The scene from the lattice on, with a gate that opens at a time in s, to the time in which every heap has come to rest.
    pub(super) fn scene(&self, opening_time: f64, random_seed: u64) -> Scene {
        let end_time = opening_time + f64::from(LONGEST) * self.time_scale();
        let mut scene = Scene::empty("granular column behind a gate", end_time);
        scene.scene.gravity = Some([0.0, 0.0, -GRAVITY]);
        scene.scene.random_seed = random_seed;
        scene.domain = Some(Domain {
            lower: [0.0; 3],
            upper: [self.length * DIAMETER, self.width * DIAMETER, self.height()],
            periodic: [false, true, false],
        });
        let material = |name: &str, density| Material { name: name.into(), density };
        scene.materials = vec![material("grain", Some(DENSITY)), material("wall", None), material("gate", None)];
        scene.pairs = vec![
            self.pair("grain", self.friction, RESTITUTION),
            self.pair("wall", self.wall_friction, WALL_RESTITUTION),
            self.pair("gate", 0.0, WALL_RESTITUTION),
        ];
        scene.shapes = vec![NamedShape { name: "grain".into(), geometry: self.grains.geometry() }];
        scene.insertions = vec![self.filling()];
        let plane = |name: &str, normal| Boundary::new(name, "wall", BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal }));
        scene.boundaries = vec![plane("floor", [0.0, 0.0, 1.0]), plane("back wall", [1.0, 0.0, 0.0]), self.gate(opening_time)];
        scene.numerics.neighbours.skin = Some(SKIN * DIAMETER);
        scene.numerics.step = Step::Seconds(self.contact_duration() / STEPS_IN_CONTACT);
        scene
    }
}
