//! Neighbour lists against every pair, and periodic boxes against larger ones: is a contact ever missed?

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::ReferenceKind;
use solver::insertion::Draws;
use solver::scene::{
    Body, Boundary, BoundaryGeometry, BoxGeometry, CuboidGeometry, Domain, Geometry, InitialOverlap, LinearHistory, NamedShape, Scene,
    SearchMethod, Step, TangentialLaw,
};
use solver::{Simulation, Vector};

use super::soft_spheres::{MATERIAL, body, contact_duration, linear, places, scene, sphere, sphere_mass, vanishing};
use crate::case::{Case, Description, Failure, Measurement, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::exact::kinetic_theory::thermal;
use crate::study::add_work;
use crate::variant::Variant;

/// The case.
pub struct NeighbourSearch;

const DENSITY: f64 = 2500.0;
const STIFFNESS: f64 = 1e5;
const DIAMETER: f64 = 0.01;

const BITS: &str = "coordinates that differ from those with every pair tested";
const MISSING: &str = "contacts in the run too many or too few";
const IMAGES: &str = "distance from the same bodies in a larger box / largest overlap";
const NEIGHBOURS: &str = "contacts at the start too many or too few";

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Search {
    /// Spheres of three sizes and bricks in a box; the knob is the number of steps in thousands.
    Crowd,
    /// The same with a skin so narrow that bodies cross several a step; the knob is how many.
    Fast,
    /// Two spheres in a periodic box little larger than they are, so that each meets the other eight times; the knob is how often the box is repeated along
    /// each side in the comparison.
    SmallBox,
}

impl Variant for Search {
    fn all() -> Vec<Search> {
        vec![Search::Crowd, Search::Fast, Search::SmallBox]
    }

    fn label(&self) -> String {
        match self {
            Search::Crowd => "mixed sizes and shapes",
            Search::Fast => "bodies that cross several skins a step",
            Search::SmallBox => "periodic box with room for two",
        }
        .into()
    }

    fn knob_name(&self) -> &'static str {
        match self {
            Search::Crowd => "thousand_steps",
            Search::Fast => "skins_per_step",
            Search::SmallBox => "repetitions",
        }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match (self, tier) {
            (Search::Crowd, Tier::Quick) => vec![1.0, 3.0],
            (Search::Crowd, _) => vec![1.0, 3.0, 100.0],
            (Search::Fast, _) => vec![0.5, 2.0, 10.0],
            (Search::SmallBox, _) => vec![2.0, 3.0],
        }
    }
}

/// A box of walls with spheres whose radii differ by thirty and bricks, at random places where nothing touches.
fn crowd(count: u64, random_seed: u64) -> Scene {
    let friction = LinearHistory { friction: 0.5, stiffness: 2.0 / 7.0 * STIFFNESS, damping_ratio: 0.2 };
    let mut scene = scene("mixed crowd", DENSITY, linear(STIFFNESS, 0.95), Some(TangentialLaw::LinearHistory(friction)));
    let brick = Geometry::Cuboid(CuboidGeometry { lengths: [0.004, 0.006, 0.01] });
    scene.shapes =
        vec![sphere("boulder", 0.015), NamedShape { name: "brick".into(), geometry: brick }, sphere("sand", 0.003), sphere("dust", 0.0005)];
    let edge = 0.08;
    let mut taken: Vec<(Vector, f64)> = Vec::new();
    let mut tried = 0;
    while (taken.len() as u64) < count {
        let (shape, radius) = match taken.len() {
            0..2 => ("boulder", 0.015),
            2..40 => ("brick", 0.0062),
            40..90 => ("sand", 0.003),
            _ => ("dust", 0.0005),
        };
        let mut draws = Draws::new(random_seed, 3, tried);
        tried += 1;
        let place = draws.in_box(&Vector::repeat(1.05 * radius), &Vector::repeat(edge - 1.05 * radius));
        if taken.iter().any(|(other, reach)| (place - other).norm() <= radius + reach) {
            continue;
        }
        taken.push((place, radius));
        let velocity = thermal(&mut draws) * 6.0;
        let spin = (thermal(&mut draws) * 20.0).into();
        scene.bodies.push(Body { angular_velocity: spin, ..body(shape, place, velocity) });
    }
    let geometry = BoxGeometry { lower: [0.0; 3], upper: [edge; 3] };
    scene.boundaries = vec![Boundary::new("box", MATERIAL, BoundaryGeometry::Box(geometry))];
    // Fifteen steps in a contact of two grains of dust, which are the shortest.
    scene.numerics.step = Step::Seconds(contact_duration(0.5 * sphere_mass(DENSITY, 0.0005), STIFFNESS) / 15.0);
    scene
}

fn with_search(mut scene: Scene, method: SearchMethod, skin: Option<f64>) -> Scene {
    scene.numerics.neighbours.method = method;
    scene.numerics.neighbours.skin = skin;
    scene
}

/// Count of bodies in the crowd.
const CROWD: u64 = 200;
/// Largest speed in m/s of the crowd, about.
const FASTEST: f64 = 20.0;

impl Search {
    fn scene(&self, knob: f64, random_seed: u64) -> Scene {
        match self {
            Search::Crowd => with_search(crowd(CROWD, random_seed), SearchMethod::List, None),
            Search::Fast => {
                let scene = crowd(CROWD, random_seed);
                let Step::Seconds(step) = scene.numerics.step else { return scene };
                with_search(scene, SearchMethod::List, Some(FASTEST * step / knob))
            }
            Search::SmallBox => small_box(1),
        }
    }
}

/// The crowd with lists and with every pair tested, as many steps each.
fn against_all_pairs(listed: &Scene, steps: u64, measurement: &mut Measurement) -> Result<(), Failure> {
    let oracle = with_search(listed.clone(), SearchMethod::AllPairs, None);
    let (mut listed, mut oracle) = (listed.build()?, oracle.build()?);
    for simulation in [&mut listed, &mut oracle] {
        (0..steps).for_each(|_| simulation.step());
        simulation.check_guards()?;
    }
    let bits = |simulation: &mut Simulation| -> Vec<u64> {
        let now = simulation.now();
        let of_body = |index| [now.position(index), now.velocity(index), now.spin_momentum(index)];
        now.bodies().by_id().flat_map(of_body).flat_map(|vector| [vector.x, vector.y, vector.z]).map(f64::to_bits).collect()
    };
    let differing = bits(&mut listed).into_iter().zip(bits(&mut oracle)).filter(|(one, other)| one != other).count();
    let contacts = |simulation: &Simulation| simulation.ledger().total_work()["contacts"] as f64;
    let source = "every pair tested at every step";
    measurement.quantities = vec![
        vanishing(BITS, "1", vec![differing as f64], COUNTED, ReferenceKind::Computed, source),
        vanishing(MISSING, "1", vec![contacts(&listed) - contacts(&oracle)], COUNTED, ReferenceKind::Computed, source),
    ];
    add_work(&mut measurement.work, listed.ledger().total_work());
    measurement.runs = 1;
    Ok(())
}

/// Half of one: a count is right or wrong.
const COUNTED: f64 = 0.5;

/// Spheres in the order of a body-centred crystal whose edge is a little above their diameter, repeated so often along each side; they swing.
fn small_box(repetitions: usize) -> Scene {
    let mut scene = scene("small box", DENSITY, linear(STIFFNESS, 1.0), None);
    scene.shapes = vec![sphere("ball", 0.5 * DIAMETER)];
    let edge = EDGE * DIAMETER;
    // Both off their sites, so that the eight contacts differ, and moving.
    let sites =
        [(Vector::new(0.26, 0.24, 0.25), Vector::new(0.3, -0.2, 0.1)), (Vector::new(0.74, 0.75, 0.76), Vector::new(-0.1, 0.25, -0.3))];
    for copy in 0..repetitions.pow(3) {
        let corner =
            Vector::new((copy % repetitions) as f64, (copy / repetitions % repetitions) as f64, (copy / repetitions.pow(2)) as f64);
        scene.bodies.extend(sites.map(|(place, velocity)| body("ball", (corner + place) * edge, velocity)));
    }
    scene.domain = Some(Domain { lower: [0.0; 3], upper: [repetitions as f64 * edge; 3], periodic: [true; 3] });
    scene.numerics.neighbours.skin = Some(0.02 * DIAMETER);
    scene.numerics.initial_overlap = InitialOverlap::Allow;
    let contact = contact_duration(0.5 * sphere_mass(DENSITY, 0.5 * DIAMETER), STIFFNESS);
    scene.numerics.step = Step::Seconds(contact / 50.0);
    scene.scene.end_time = 2.0 * contact;
    scene
}

/// Edge of the small box over the diameter: neighbours along the diagonal are 0.91 diameters apart.
const EDGE: f64 = 1.05;

fn in_a_larger_box(repetitions: usize) -> Result<Measurement, Failure> {
    let (mut small, mut large) = (small_box(1).build()?, small_box(repetitions).build()?);
    let copies = repetitions.pow(3);
    let touching =
        [(&mut small, 1), (&mut large, copies)].map(|(box_of, copies)| box_of.now().contacts().contacts as f64 - 8.0 * copies as f64);
    for simulation in [&mut small, &mut large] {
        simulation.run_until(simulation.scene().scene.end_time)?;
    }
    let (edge, alone) = (EDGE * DIAMETER, places(&small));
    let apart = |(index, place): (usize, Vector)| {
        let apart = place - alone[index % 2];
        (apart - (apart / edge).map(f64::round) * edge).norm()
    };
    let farthest = places(&large).into_iter().enumerate().map(apart).fold(0.0, f64::max);
    let source = "the same bodies, repeated in a larger box";
    let floor = images_floor(repetitions as f64);
    Ok(Measurement {
        quantities: vec![
            vanishing(IMAGES, "1", vec![farthest / (OVERLAP * DIAMETER)], floor, ReferenceKind::Computed, source),
            vanishing(NEIGHBOURS, "1", touching.to_vec(), COUNTED, ReferenceKind::Exact, "eight images of the other sphere"),
        ],
        work: small.ledger().total_work(),
        runs: 1,
        curves: Vec::new(),
    })
}

/// Overlap of neighbours over the diameter.
const OVERLAP: f64 = 0.09;

/// Places are rounded at each of 100 steps, and eight springs swing them on.
fn images_floor(repetitions: f64) -> f64 {
    f64::EPSILON * repetitions * EDGE / OVERLAP * 100.0
}

impl Case for NeighbourSearch {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let search = Search::of(setup)?;
        let mut measurement = Measurement { runs: 1, ..Measurement::default() };
        match search {
            Search::Crowd => against_all_pairs(&search.scene(knob, random_seed), 1000 * knob as u64, &mut measurement)?,
            Search::Fast => against_all_pairs(&search.scene(knob, random_seed), 1000, &mut measurement)?,
            Search::SmallBox => return in_a_larger_box(knob as usize),
        }
        Ok(measurement)
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        Search::claims(tier, |search, knob| {
            let claim = |quantity, statistic, bound| search.claim_at(knob, quantity, statistic, bound, Expected::Holds);
            let none = || Bound::new(1.0, COUNTED, "half of one: not one may differ");
            match search {
                Search::Crowd | Search::Fast => vec![claim(BITS, Statistic::Single, none()), claim(MISSING, Statistic::Single, none())],
                Search::SmallBox => {
                    let bound = Bound::new(4.0, images_floor(knob), "rounding of places over the steps");
                    vec![claim(IMAGES, Statistic::Single, bound), claim(NEIGHBOURS, Statistic::Worst, none())]
                }
            }
        })
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        Search::of(setup).ok().map(|search| search.scene(knob, 1))
    }

    fn description(&self) -> Description {
        let plot = |title: &str, quantity: &str, search: Search, label: &str| Plot::Convergence {
            title: title.into(),
            quantity: quantity.into(),
            setups: vec![search.label()],
            statistics: vec!["single run".into()],
            orders: Vec::new(),
            knob_is_resolution: true,
            knob_label: label.into(),
        };
        Description {
            id: "neighbour_search",
            title: "Neighbour search",
            question: "Is a contact ever missed by a neighbour list, whatever sizes, shapes, speeds and boxes?",
            model: vec![
                "Two hundred spheres and bricks whose sizes differ by thirty fly in a box. One run lists neighbours, another tests every pair at every step; if one contact were missed for one step, no bit would be the same afterwards. A narrow skin lets bodies cross several of its widths in a step: the list is then made anew at every step.",
                "In a periodic box little larger than a sphere each of two spheres touches eight images of the other. The same crystal in a box of two or three repetitions has no such images, and must move alike.",
            ],
            equations: vec![Equation {
                latex: r"|x_i - x_j| < r_i + r_j + s \;\Rightarrow\; (i,j) \in \text{list},\qquad \text{anew before any } |\Delta x| > s/2"
                    .into(),
                meaning: "Verlet's list with a skin s.".into(),
            }],
            parameters: [
                (
                    "crowd",
                    "2 boulders of 15 mm radius, 38 bricks, 50 sand of 3 mm, 110 dust of 0.5 mm",
                    "box of 80 mm, 6 m/s along each axis",
                ),
                ("step", "a fifteenth of a contact of two grains of dust", ""),
                ("small box", "1.05 diameters", "contacts overlap by 9 % of the diameter"),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "Every pair tested at every step; the same crystal in a larger box.",
            picture: picture(),
            plots: vec![plot("Periodic images", IMAGES, Search::SmallBox, "repetitions of the box in the comparison")],
            headline: Headline {
                setup: Search::Crowd.label(),
                quantity: BITS.into(),
                statistic: "single run".into(),
                knob: 3.0,
                order_quantity: None,
            },
            sources: vec!["L. Verlet, Phys. Rev. 159 (1967) 98", "R (Rakotonirina 2016), section 2.5: linked cells"],
            answers: vec!["Stability test S24 (fast particles, lists): a missed contact is an error, and there is none."],
            remarks: vec!["The standard tier compares over 10⁵ steps."],
            knob: Search::knob(),
            setups: Search::setups(),
            sample: "box",
            budget_cpu_s: [5.0, 300.0, 300.0],
        }
    }
}

fn picture() -> Picture {
    let disc = |x: f64, y: f64, radius: f64| PictureItem::Disc { center: [x, y], radius, ghost: false };
    let skin = |x: f64, y: f64, radius: f64| PictureItem::Disc { center: [x, y], radius, ghost: true };
    Picture {
        caption: "Spheres and their skins: pairs whose skins overlap are listed.".into(),
        items: vec![
            skin(0.0, 0.0, 1.2),
            skin(2.0, 0.6, 1.2),
            disc(0.0, 0.0, 1.0),
            disc(2.0, 0.6, 0.9),
            skin(1.4, -1.3, 0.5),
            disc(1.4, -1.3, 0.3),
        ],
    }
}
