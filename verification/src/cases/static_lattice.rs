//! Spheres and cubes in regular order under their weight or in a box that is too small: does every contact carry what it must?

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::ReferenceKind;
use solver::scene::{
    Boundary, BoundaryGeometry, CuboidGeometry, Domain, Geometry, InitialOverlap, NamedShape, PlaneGeometry, Scene, StepsPerContact,
};
use solver::{Simulation, Vector};

use super::soft_spheres::{MATERIAL, body, linear, places, scene, sphere, sphere_mass, vanishing};
use crate::case::{Case, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::exact::crystal::{face_centred_energy, layer_height, stack_overlaps};
use crate::variant::Variant;

/// The case.
pub struct StaticLattice;

/// Diameter of a sphere and edge of a cube in m.
const SIZE: f64 = 0.01;
const DENSITY: f64 = 2500.0;
const GRAVITY: f64 = 9.81;
/// A body sinks by so much of its size into a single contact under its weight.
const SOFTNESS: f64 = 1e-3;
/// Spheres of a layer and of the crystal in the periodic box along each side.
const ACROSS: usize = 3;
/// Distance of spheres in a layer over their diameter: they press each other sideways.
const CLOSENESS: f64 = 0.999;

const UNBALANCED: &str = "largest force on a body where it should rest / load";
const PLACE: &str = "distance from where it should rest / largest overlap";
const ENERGY: &str = "relative error of the spring energy";
const CONTACTS: &str = "contacts too many or too few";

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Lattice {
    /// Spheres on top of each other; the knob is their number.
    Column,
    /// Cubes on top of each other.
    Cubes,
    /// A face-centred crystal between periodic sides, on a plane; the knob is the number of layers.
    Layers,
    /// A simple cubic crystal between six walls that stand too near; the knob is the part of its edge that is missing.
    BetweenWalls,
    /// A face-centred crystal in a periodic box that is too small.
    PeriodicBox,
}

impl Variant for Lattice {
    fn all() -> Vec<Lattice> {
        vec![Lattice::Column, Lattice::Cubes, Lattice::Layers, Lattice::BetweenWalls, Lattice::PeriodicBox]
    }

    fn label(&self) -> String {
        match self {
            Lattice::Column => "column of spheres under its weight",
            Lattice::Cubes => "stack of cubes under its weight",
            Lattice::Layers => "face-centred layers under their weight, pressed sideways",
            Lattice::BetweenWalls => "simple cubic, squeezed between six walls",
            Lattice::PeriodicBox => "face-centred, squeezed in a periodic box",
        }
        .into()
    }

    fn knob_name(&self) -> &'static str {
        if self.has_weight() { "layers" } else { "compression" }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match (self, tier) {
            (Lattice::BetweenWalls | Lattice::PeriodicBox, _) => vec![1e-2, 1e-3, 1e-4],
            (_, Tier::Quick) => vec![1.0, 3.0, 5.0],
            (Lattice::Cubes, _) => vec![1.0, 3.0, 5.0, 8.0],
            _ => vec![1.0, 3.0, 5.0, 10.0, 20.0],
        }
    }
}

/// Where the bodies should rest, where they begin, and what presses them.
struct Order {
    /// Exact places in m.
    at_rest: Vec<Vector>,
    /// Places in m at which the run begins.
    start: Vec<Vector>,
    /// Force in N that the most loaded contact carries.
    load: f64,
    /// Its overlap in m.
    overlap: f64,
    /// Size in m of the places from which overlaps are computed.
    extent: f64,
}

impl Lattice {
    fn has_weight(&self) -> bool {
        matches!(self, Lattice::Column | Lattice::Cubes | Lattice::Layers)
    }

    fn mass(&self) -> f64 {
        if *self == Lattice::Cubes { DENSITY * SIZE.powi(3) } else { sphere_mass(DENSITY, 0.5 * SIZE) }
    }

    /// Stiffness in N/m of a contact point.
    fn stiffness(&self) -> f64 {
        self.mass() * GRAVITY / (SOFTNESS * SIZE)
    }

    fn order(&self, knob: f64) -> Order {
        match self {
            Lattice::Column => self.stack(knob as usize, 1.0),
            // Four corners carry a cube.
            Lattice::Cubes => self.stack(knob as usize, 4.0),
            Lattice::Layers => self.layers(knob as usize),
            Lattice::BetweenWalls => self.between_walls(knob),
            Lattice::PeriodicBox => self.periodic_crystal(knob),
        }
    }

    fn stack(&self, count: usize, points: f64) -> Order {
        let weight = self.mass() * GRAVITY;
        let overlaps = stack_overlaps(count, weight, points * self.stiffness());
        let mut sunk = 0.0;
        let heights = overlaps.iter().enumerate().map(|(below, overlap)| {
            sunk += overlap;
            (below as f64 + 0.5) * SIZE - sunk
        });
        Order {
            at_rest: heights.map(|height| Vector::z() * height).collect(),
            start: (0..count).map(|below| Vector::z() * ((below as f64 + 0.5) * SIZE)).collect(),
            load: count as f64 * weight,
            overlap: overlaps[0],
            extent: count as f64 * SIZE,
        }
    }

    fn layers(&self, count: usize) -> Order {
        let (weight, stiffness, spacing) = (self.mass() * GRAVITY, self.stiffness(), CLOSENESS * SIZE);
        let lowest = 0.5 * SIZE - count as f64 * weight / stiffness;
        let steps = (1..count).map(|below| layer_height(SIZE, spacing, (count - below) as f64 * weight, stiffness));
        let heights: Vec<f64> = std::iter::once(lowest)
            .chain(steps.scan(lowest, |height, step| {
                *height += step;
                Some(*height)
            }))
            .collect();
        let unloaded = (SIZE * SIZE - 0.5 * spacing * spacing).sqrt();
        let place = |layer: usize, site: usize, height: f64| {
            let shift = if layer.is_multiple_of(2) { 0.25 } else { 0.75 };
            let [x, y] = [site % ACROSS, site / ACROSS].map(|along| (along as f64 + shift) * spacing);
            Vector::new(x, y, height)
        };
        let all = |height: &dyn Fn(usize) -> f64| {
            (0..count).flat_map(|layer| (0..ACROSS * ACROSS).map(move |site| (layer, site))).map(|(l, s)| place(l, s, height(l))).collect()
        };
        Order {
            at_rest: all(&|layer| heights[layer]),
            start: all(&|layer| 0.5 * SIZE + layer as f64 * unloaded),
            load: count as f64 * weight,
            overlap: count as f64 * weight / stiffness,
            extent: count as f64 * SIZE,
        }
    }

    /// Every contact of a row takes the same part of what is missing, those with the walls too.
    fn between_walls(&self, compression: f64) -> Order {
        let edge = ACROSS as f64 * SIZE;
        let overlap = compression * edge / (ACROSS + 1) as f64;
        let sites = (0..ACROSS.pow(3)).map(|site| [site % ACROSS, site / ACROSS % ACROSS, site / (ACROSS * ACROSS)]);
        let at = |first: f64, spacing: f64| {
            sites.clone().map(move |site| Vector::from(site.map(|along| first + along as f64 * spacing))).collect::<Vec<Vector>>()
        };
        Order {
            at_rest: at(0.5 * SIZE - overlap, SIZE - overlap),
            start: at(0.5 * SIZE - 2.0 * overlap, SIZE),
            load: self.stiffness() * overlap,
            overlap,
            extent: edge,
        }
    }

    fn periodic_crystal(&self, compression: f64) -> Order {
        let cell = (1.0 - compression) * SIZE * std::f64::consts::SQRT_2;
        let basis = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]];
        let cells = (0..ACROSS.pow(3)).map(|site| [site % ACROSS, site / ACROSS % ACROSS, site / (ACROSS * ACROSS)]);
        let at_rest: Vec<Vector> =
            cells.flat_map(|site| basis.map(|place| Vector::from_fn(|axis, _| (site[axis] as f64 + place[axis] + 0.25) * cell))).collect();
        let overlap = compression * SIZE;
        let load = self.stiffness() * overlap;
        Order { start: at_rest.clone(), at_rest, load, overlap, extent: ACROSS as f64 * cell }
    }

    fn scene(&self, knob: f64, places: &[Vector]) -> Scene {
        let mut scene = scene("lattice at rest", DENSITY, linear(self.stiffness(), RESTITUTION), None);
        scene.shapes = vec![match self {
            Lattice::Cubes => NamedShape { name: "body".into(), geometry: Geometry::Cuboid(CuboidGeometry { lengths: [SIZE; 3] }) },
            _ => sphere("body", 0.5 * SIZE),
        }];
        scene.bodies = places.iter().map(|place| body("body", *place, Vector::zeros())).collect();
        if self.has_weight() {
            scene.scene.gravity = Some([0.0, 0.0, -GRAVITY]);
            scene.boundaries = vec![wall("ground", Vector::zeros(), Vector::z())];
        }
        let periodic_box = |edges: [f64; 3], periodic| Some(Domain { lower: [0.0; 3], upper: edges, periodic });
        match self {
            Lattice::Layers => {
                let edge = ACROSS as f64 * CLOSENESS * SIZE;
                scene.domain = periodic_box([edge, edge, 1.0], [true, true, false]);
            }
            Lattice::PeriodicBox => scene.domain = periodic_box([self.order(knob).extent; 3], [true; 3]),
            Lattice::BetweenWalls => {
                let edge = (1.0 - knob) * ACROSS as f64 * SIZE;
                for (name, axis) in [("x", Vector::x()), ("y", Vector::y()), ("z", Vector::z())] {
                    scene.boundaries.push(wall(&format!("low {name}"), Vector::zeros(), axis));
                    scene.boundaries.push(wall(&format!("high {name}"), axis * edge, -axis));
                }
            }
            Lattice::Column | Lattice::Cubes => {}
        }
        scene.numerics.initial_overlap = InitialOverlap::Allow;
        scene.numerics.steps_per_contact = StepsPerContact(STEPS_PER_CONTACT);
        scene.scene.end_time = self.settling_time(knob);
        scene
    }

    /// Time in s in which the slowest swing of a stack, a quarter wave over its height, falls below rounding.
    fn settling_time(&self, knob: f64) -> f64 {
        let layers = if self.has_weight() { knob } else { ACROSS as f64 };
        let frequency = (self.stiffness() / self.mass()).sqrt();
        let slowness = (2.0 * layers + 1.0) / std::f64::consts::PI;
        SETTLING * slowness * slowness / frequency
    }

    /// Overlaps are differences of places that are as large as the lattice.
    fn floor(&self, order: &Order) -> f64 {
        let magnified = if *self == Lattice::Cubes { SIZE / (CRUST * SIZE) } else { 1.0 };
        f64::EPSILON * order.extent / order.overlap * magnified
    }
}

/// Strong damping, for a short way to rest.
const RESTITUTION: f64 = 0.1;
/// Steps in the half period of a contact: places at rest do not depend on it.
const STEPS_PER_CONTACT: f64 = 20.0;
/// e-folds of rounding over the damping ratio at that restitution.
const SETTLING: f64 = 80.0;
/// The default crust of a cube, as a part of half its edge: its faces take their normal from the distance of cores two crusts apart.
const CRUST: f64 = 0.02;

fn wall(name: &str, point: Vector, normal: Vector) -> Boundary {
    Boundary::new(name, MATERIAL, BoundaryGeometry::Plane(PlaneGeometry { point: point.into(), normal: normal.into() }))
}

/// Largest force in N on a body besides its weight and those of its contacts.
fn largest_unbalanced_force(simulation: &mut Simulation) -> f64 {
    let gravity = simulation.scene().scene.gravity.map_or(Vector::zeros(), Vector::from);
    let now = simulation.now();
    let bodies = now.bodies();
    (0..bodies.len()).map(|index| (bodies.force(index) + gravity * bodies.mass(index)).norm()).fold(0.0, f64::max)
}

impl Case for StaticLattice {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let lattice = Lattice::of(setup)?;
        let order = lattice.order(knob);
        let floor = lattice.floor(&order);
        let zero = |name, samples, floor| vanishing(name, "1", samples, floor, ReferenceKind::Exact, "balance of forces, linear springs");
        let mut placed = lattice.scene(knob, &order.at_rest).build()?;
        let mut quantities: Vec<Quantity> = vec![zero(UNBALANCED, vec![largest_unbalanced_force(&mut placed) / order.load], floor)];
        if lattice == Lattice::PeriodicBox {
            let count = order.at_rest.len();
            let energy = face_centred_energy(count, order.overlap, lattice.stiffness());
            let seen = placed.now().contacts();
            quantities.push(zero(ENERGY, vec![seen.elastic_energy / energy - 1.0], floor));
            quantities.push(zero(CONTACTS, vec![seen.contacts as f64 - 6.0 * count as f64], 0.1));
        }
        let mut simulation = lattice.scene(knob, &order.start).build()?;
        simulation.run_until(simulation.scene().scene.end_time)?;
        let distances = places(&simulation).into_iter().zip(&order.at_rest).map(|(place, exact)| (place - exact).norm());
        quantities.push(zero(PLACE, vec![distances.fold(0.0, f64::max) / order.overlap], floor));
        Ok(Measurement { quantities, work: simulation.ledger().total_work(), runs: 1, curves: Vec::new() })
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        Lattice::claims(tier, |lattice, knob| {
            let bound = |factor, words: &str| Bound::new(factor, lattice.floor(&lattice.order(knob)), words);
            let claim = |quantity, bound| lattice.claim_at(knob, quantity, Statistic::Single, bound, Expected::Holds);
            let mut claims = vec![
                claim(UNBALANCED, bound(4.0, "rounding of places as large as the lattice, in an overlap")),
                claim(PLACE, bound(8.0, "rounding of places as large as the lattice, in an overlap")),
            ];
            if *lattice == Lattice::PeriodicBox {
                claims.push(claim(ENERGY, bound(4.0, "rounding of places as large as the lattice, in an overlap")));
                claims.push(claim(CONTACTS, Bound::new(1.0, 0.1, "a tenth of a contact")));
            }
            claims
        })
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        let lattice = Lattice::of(setup).ok()?;
        Some(lattice.scene(knob, &lattice.order(knob).start))
    }

    fn description(&self) -> Description {
        let plot = |title: &str, quantity: &str, setups: Vec<String>, label: &str| Plot::Convergence {
            title: title.into(),
            quantity: quantity.into(),
            setups,
            statistics: vec!["single run".into()],
            orders: Vec::new(),
            knob_is_resolution: true,
            knob_label: label.into(),
        };
        let (heavy, squeezed) = (Lattice::labels(Lattice::has_weight), Lattice::labels(|lattice| !lattice.has_weight()));
        Description {
            id: "static_lattice",
            title: "Lattices at rest",
            question: "Does every contact of a crystal at rest carry the force that balance asks of it, to rounding?",
            model: vec![
                "Equal spheres or cubes in regular order, without friction. Under their weight each contact carries what lies above it; in a box that is too small each takes its part of what is missing. In both cases forces and places at rest follow from balance alone, in closed form.",
                "Two looks. Bodies are put where they should rest, and the forces that are left on them are compared with the load. And they are put where they just touch, or where the crystal just fits against one wall, and run with strong damping until all motion has died: then they must stand where they should rest.",
            ],
            equations: vec![
                Equation {
                    latex: r"k\,\delta_i = (N - i)\,m g / p".into(),
                    meaning: "A stack: the contact above i bodies, shared by p points (1 for spheres, 4 for cubes).".into(),
                },
                Equation {
                    latex: r"4 k (d - r)\frac{h}{r} = W,\qquad r = \sqrt{s^2/2 + h^2}".into(),
                    meaning: "Face-centred layers of spacing s: each sphere lies in the pocket of four at the height h.".into(),
                },
                Equation {
                    latex: r"E = 6 N \cdot \tfrac12 k \delta^2".into(),
                    meaning: "Spring energy of a face-centred crystal of twelve contacts a sphere.".into(),
                },
            ],
            parameters: [
                ("diameter or edge, density", "10 mm, 2500 kg/m³", ""),
                ("stiffness", "weight of a body / 10⁻³ of its size", "soft, so that overlaps keep their digits"),
                ("restitution", "0.1", "only for the way to rest"),
                ("layers", "9 spheres each, in a periodic square", "sideways 10⁻³ nearer than they are thick"),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "Balance of forces in closed form; the height of a layer is a root found to rounding.",
            picture: picture(),
            plots: vec![
                plot("Force that is left", UNBALANCED, heavy.clone(), "layers"),
                plot("Distance from the place of rest", PLACE, heavy, "layers"),
                plot("Force that is left in a box that is too small", UNBALANCED, squeezed.clone(), "part of the edge that is missing"),
                plot("Distance from the place of rest in a box that is too small", PLACE, squeezed, "part of the edge that is missing"),
            ],
            headline: Headline {
                setup: Lattice::Layers.label(),
                quantity: PLACE.into(),
                statistic: "single run".into(),
                knob: 5.0,
                order_quantity: None,
            },
            sources: vec!["R (Rakotonirina 2016), section 3.3: Hooke's law of contact, eq. 3.18"],
            answers: vec!["Chains of contacts, periodic images and walls give and take the same force: what balance asks, to rounding."],
            remarks: vec![
                "Errors are over the largest overlap, a thousandth of a body or less: the digits of a place that are lost in it are the floor.",
                "A column of spheres stands only because rounding leaves its axis alone; it would buckle in truth.",
            ],
            knob: Lattice::knob(),
            setups: Lattice::setups(),
            sample: "run",
            budget_cpu_s: [5.0, 60.0, 60.0],
        }
    }
}

/// The layers from the side.
fn picture() -> Picture {
    let disc = |x: f64, y: f64| PictureItem::Disc { center: [x, y], radius: 1.0, ghost: false };
    let mut items = vec![PictureItem::Wall { from: [-1.5, 0.0], to: [7.5, 0.0], solid_side: [0.0, -1.0] }];
    for layer in 0..3 {
        let shift = if layer == 1 { 1.0 } else { 0.0 };
        items.extend((0..3).map(|site| disc(2.0 * f64::from(site) + shift, 1.0 + std::f64::consts::SQRT_2 * f64::from(layer))));
    }
    Picture { caption: "Three layers of a face-centred crystal on a plane: each sphere lies in the pocket of four below.".into(), items }
}
