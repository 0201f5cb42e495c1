//! The settled packings of `benchmarks/peers/packing`: read, written for other codes, and as a scene of ours.

use solver::scene::{
    Body, Boundary, BoundaryGeometry, Domain, EndOfContact, Geometry, InitialOverlap, LinearHistory, LinearSpringDashpot, Material,
    NamedShape, NormalLaw, Pair, PlaneGeometry, Scene, SphereGeometry, Step, TangentialLaw, ViscousCoulomb,
};

/// Time step in s.
pub const STEP: f64 = 2e-6;
/// Side of the periodic column in m.
pub const SIDE: f64 = 0.036;
const HEIGHT: f64 = 0.4;
const RADIUS: f64 = 1.5e-3;
const DENSITY: f64 = 2500.0;
const STIFFNESS: f64 = 1e5;
const RESTITUTION: f64 = 0.75;
const FRICTION: f64 = 0.5;
/// Rate of the tangential dashpot per reduced mass in 1/s: half of the normal one.
const TANGENTIAL_RATE: f64 = 6859.83;
/// Gap in m up to which all codes keep pairs in their lists.
const SKIN: f64 = 0.3e-3;

/// Laws along the contact plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// Tangential spring with memory, dashpot, Coulomb's cap.
    History,
    /// The dashpot and Coulomb's cap alone.
    Viscous,
    /// None.
    Frictionless,
}

impl Law {
    /// All of them.
    pub const ALL: [Law; 3] = [Law::History, Law::Viscous, Law::Frictionless];

    /// Its name in the decks.
    pub fn name(self) -> &'static str {
        match self {
            Law::History => "history",
            Law::Viscous => "viscous",
            Law::Frictionless => "frictionless",
        }
    }

    /// The packing that stays together under it.
    pub fn packing(self) -> &'static str {
        if self == Law::History { "settled.csv" } else { "settled_frictionless.csv" }
    }
}

/// Position in m, velocity in m/s and spin in rad/s of each sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct Packing(pub Vec<[f64; 9]>);

impl Packing {
    /// Reads whole picometres, nanometres per second and microradians per second, nine in a line after a header. `None` if a line is not that.
    pub fn parse(text: &str) -> Option<Packing> {
        // Division by a power of ten that is exact in binary rounds once: every code gets the same double.
        let scale = |column: usize| [1e12, 1e9, 1e6][column / 3];
        let row = |line: &str| {
            let numbers = line.split(',').map(|number| number.parse::<i64>().ok()).collect::<Option<Vec<_>>>()?;
            let values: Vec<f64> = numbers.iter().enumerate().map(|(column, number)| *number as f64 / scale(column.min(8))).collect();
            values.try_into().ok()
        };
        text.lines().skip(1).map(row).collect::<Option<Vec<_>>>().map(Packing)
    }

    /// Data file of LAMMPS and LIGGGHTS; walls may have laws of a second type.
    pub fn data(&self) -> String {
        let sides = format!("0 {SIDE} xlo xhi\n0 {SIDE} ylo yhi\n0 {HEIGHT} zlo zhi\n");
        let mut text = format!("settled packing\n\n{} atoms\n2 atom types\n\n{sides}\nAtoms\n\n", self.0.len());
        for (index, row) in self.0.iter().enumerate() {
            text += &format!("{} 1 {} {DENSITY} {}\n", index + 1, 2.0 * RADIUS, words(&row[..3]));
        }
        text += "\nVelocities\n\n";
        for (index, row) in self.0.iter().enumerate() {
            text += &format!("{} {}\n", index + 1, words(&row[3..]));
        }
        text
    }

    /// Position, velocity, spin and radius, one sphere a line.
    pub fn text(&self) -> String {
        self.0.iter().map(|row| format!("{} {RADIUS}\n", words(row))).collect()
    }

    /// Our scene of it.
    pub fn scene(&self, law: Law) -> Scene {
        self.tiled_scene(law, [1, 1])
    }

    /// Our scene of copies side by side along x and y: as many contacts a sphere as in one of them.
    pub fn tiled_scene(&self, law: Law, copies: [usize; 2]) -> Scene {
        let mut scene = Scene::empty("settled packing", 1.0);
        scene.scene.gravity = Some([0.0, 0.0, -9.81]);
        let material = |name: &str, density| Material { name: name.into(), density };
        scene.materials = vec![material("glass", Some(DENSITY)), material("wall", None)];
        scene.pairs = ["glass", "wall"].map(|other| pair(law, other)).to_vec();
        scene.shapes = vec![NamedShape { name: "ball".into(), geometry: Geometry::Sphere(SphereGeometry { radius: RADIUS }) }];
        let places = (0..copies[0]).flat_map(|along_x| (0..copies[1]).map(move |along_y| [along_x, along_y]));
        scene.bodies = places.flat_map(|place| self.0.iter().map(move |row| body(row, place))).collect();
        let geometry = BoundaryGeometry::Plane(PlaneGeometry { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
        scene.boundaries = vec![Boundary::new("floor", "wall", geometry)];
        scene.domain = Some(Domain {
            lower: [0.0; 3],
            upper: [SIDE * copies[0] as f64, SIDE * copies[1] as f64, HEIGHT],
            periodic: [true, true, false],
        });
        scene.numerics.neighbours.skin = Some(SKIN);
        scene.numerics.step = Step::Seconds(STEP);
        scene.numerics.initial_overlap = InitialOverlap::Allow;
        scene
    }
}

fn words(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

/// A sphere of the copy at a place, which is counted in sides.
fn body(row: &[f64; 9], place: [usize; 2]) -> Body {
    let [x, y, z, vx, vy, vz, wx, wy, wz] = *row;
    let [along_x, along_y] = place.map(|count| count as f64 * SIDE);
    Body { position: [x + along_x, y + along_y, z], velocity: [vx, vy, vz], angular_velocity: [wx, wy, wz], ..Body::new("ball", "glass") }
}

fn pair(law: Law, other: &str) -> Pair {
    let (restitution, end_of_contact) = (RESTITUTION, EndOfContact::ZeroOverlap);
    let normal = NormalLaw::LinearSpringDashpot(LinearSpringDashpot { stiffness: STIFFNESS, restitution, end_of_contact });
    let friction = FRICTION;
    let damping_ratio = {
        // A dashpot of half the normal one: c_t = c_n / 2 = zeta sqrt(k m), held against 2 sqrt(k_t m_t) with k_t = 2/7 k and m_t = 2/7 m.
        let logarithm = RESTITUTION.ln();
        -logarithm / logarithm.hypot(std::f64::consts::PI) * 7.0 / 4.0
    };
    let tangential = match law {
        Law::History => Some(TangentialLaw::LinearHistory(LinearHistory { friction, stiffness: 2.0 / 7.0 * STIFFNESS, damping_ratio })),
        Law::Viscous => Some(TangentialLaw::ViscousCoulomb(ViscousCoulomb { friction, damping_rate: 0.5 * TANGENTIAL_RATE })),
        Law::Frictionless => None,
    };
    Pair { materials: ["glass".into(), other.into()], normal, tangential, rolling: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "head\n1500000000,18000000000,1499996533,-39100,0,1,8068,-26067,-5823746\n17000000000,35000000000,9,0,0,0,0,0,0\n";

    #[test]
    fn a_packing_is_read_in_si_units() {
        let Packing(rows) = Packing::parse(TEXT).expect("the text is a packing");
        assert_eq!(rows[0], [1.5e-3, 0.018, 1.499996533e-3, -39.1e-6, 0.0, 1e-9, 8.068e-3, -26.067e-3, -5.823746]);
        assert_eq!(Packing::parse("head\n1,2,3\n"), None);
    }

    /// What is written for other codes reads back as the same numbers, to the last bit.
    #[test]
    fn other_codes_get_the_same_bits() {
        let packing = Packing::parse(TEXT).expect("the text is a packing");
        let read = |line: &str| line.split(' ').map(|word| word.parse().expect("a number")).collect::<Vec<f64>>();
        let text = packing.text();
        assert_eq!(read(text.lines().next().expect("a line"))[..9], packing.0[0]);
        let data = packing.data();
        let atoms = data.lines().position(|line| line == "Atoms").expect("a section");
        assert_eq!(read(data.lines().nth(atoms + 2).expect("an atom"))[4..], packing.0[0][..3]);
    }

    /// Both spheres reach through periodic sides; the scene builds under every law.
    #[test]
    fn our_scene_has_all_spheres() {
        let packing = Packing::parse(TEXT).expect("the text is a packing");
        for law in Law::ALL {
            let scene = packing.scene(law);
            assert_eq!(scene.bodies.len(), 2);
            assert!(scene.build().is_ok(), "{law:?}");
        }
    }

    /// Copies side by side are one bed: each touches as often as it does alone, across the periodic sides or the sides of copies.
    #[test]
    fn copies_touch_as_often_as_one() {
        let packing = Packing::parse(include_str!("../../peers/packing/settled_thousand.csv")).expect("the file is a packing");
        let contacts = |copies| {
            let mut simulation = packing.tiled_scene(Law::History, copies).build().expect("the bed builds");
            simulation.step();
            simulation.ledger().total_work()["contacts"]
        };
        let alone = contacts([1, 1]);
        assert!(alone > 2000, "{alone}");
        assert_eq!(contacts([2, 3]), 6 * alone);
    }

    /// The tangential dashpots of our two laws and of the decks are one number: rate x reduced mass.
    #[test]
    fn the_dashpots_are_those_of_the_decks() {
        let mass = DENSITY * 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3);
        let reduced = 0.5 * mass;
        let Some(TangentialLaw::LinearHistory(history)) = pair(Law::History, "glass").tangential else { panic!("a spring with memory") };
        let of_history = history.damping_ratio * 2.0 * (history.stiffness * 2.0 / 7.0 * reduced).sqrt();
        // The decks give the rate to two places.
        assert!((of_history / reduced - TANGENTIAL_RATE).abs() < 0.005 * 1.01, "{of_history}");
    }
}
