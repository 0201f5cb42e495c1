//! Hundreds of elastic spheres, crowded: how well is their energy kept, and at what cost?

use std::f64::consts::{PI, SQRT_2};

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::ReferenceKind;
use solver::insertion::Draws;
use solver::scene::{
    Boundary, BoundaryGeometry, BoxGeometry, Domain, Elasticity, Hertz, InitialOverlap, LinearHistory, NormalLaw, Scene, Step,
    TangentialLaw,
};
use solver::{Simulation, Vector};

use super::soft_spheres::{MATERIAL, body, linear, scene, sphere, sphere_mass, vanishing};
use crate::case::{Case, Curve, Description, Failure, Measurement, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::kinetic_theory::thermal;
use crate::study::add_work;
use crate::variant::Variant;

/// The case.
pub struct DenseElasticBed;

const DIAMETER: f64 = 0.01;
const DENSITY: f64 = 2500.0;
const STIFFNESS: f64 = 1e5;
/// Random starts of each measurement.
const STARTS: u64 = 3;
/// Looks at the energy of a run.
const LOOKS: u64 = 100;
/// Length of a run in undamped contacts.
const RUN: f64 = 12.0;

const ENERGY: &str = "energy error, root mean square / kinetic energy";
const MOMENTUM: &str = "change of momentum / sum of its sizes";

/// How dense the crystal is from which the spheres begin: distance of neighbours over their diameter.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Crowd {
    /// All contacts closed, 1 % of overlap; no swing opens one.
    Jammed,
    /// Volume fraction 0.66: every sphere collides all the time.
    Loose,
    /// The loose one in a box with walls, falling.
    Falling,
}

/// What the contacts are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Springs {
    Hooke,
    Hertz,
    /// Hooke with tangential springs that never slip.
    Tangential,
}

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bed {
    crowd: Crowd,
    springs: Springs,
    /// Cells of four spheres along each side.
    cells: usize,
}

impl Variant for Bed {
    fn all() -> Vec<Bed> {
        let bed = |crowd, springs, cells| Bed { crowd, springs, cells };
        vec![
            bed(Crowd::Jammed, Springs::Hooke, 4),
            bed(Crowd::Jammed, Springs::Tangential, 4),
            bed(Crowd::Jammed, Springs::Hertz, 4),
            bed(Crowd::Loose, Springs::Hooke, 4),
            bed(Crowd::Loose, Springs::Hertz, 4),
            bed(Crowd::Falling, Springs::Hooke, 4),
            bed(Crowd::Loose, Springs::Hooke, 8),
            bed(Crowd::Falling, Springs::Hooke, 8),
        ]
    }

    fn label(&self) -> String {
        let crowd = match self.crowd {
            Crowd::Jammed => "jammed",
            Crowd::Loose => "loose",
            Crowd::Falling => "falling in a box",
        };
        let springs = match self.springs {
            Springs::Hooke => "Hooke",
            Springs::Hertz => "Hertz",
            Springs::Tangential => "Hooke with tangential springs",
        };
        format!("{} spheres, {crowd}, {springs}", self.count())
    }

    fn knob_name(&self) -> &'static str {
        "steps_per_contact"
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match (tier, self.cells) {
            (Tier::Quick, 4) => vec![14.0, 28.0, 56.0],
            (Tier::Quick, _) => Vec::new(),
            _ => vec![14.0, 28.0, 56.0, 112.0, 224.0],
        }
    }
}

impl Bed {
    fn count(&self) -> usize {
        4 * self.cells.pow(3)
    }

    fn mass(&self) -> f64 {
        sphere_mass(DENSITY, 0.5 * DIAMETER)
    }

    /// Duration in s of an undamped contact of two spheres at the stiffness that stands for the springs.
    fn contact(&self) -> f64 {
        PI * (0.5 * self.mass() / STIFFNESS).sqrt()
    }

    /// Root of temperature over mass in m/s: the speed, along each axis, that overlaps by so much of the diameter.
    fn speed(&self) -> f64 {
        let overlap = if self.crowd == Crowd::Jammed { 0.001 } else { 0.005 };
        overlap * DIAMETER * PI / self.contact()
    }

    fn spacing(&self) -> f64 {
        DIAMETER * if self.crowd == Crowd::Jammed { 0.99 } else { 1.04 }
    }

    /// Edge in m of a cubic cell of four spheres.
    fn cell(&self) -> f64 {
        SQRT_2 * self.spacing()
    }

    /// Edge in m of the box, and its distance from the nearest centres.
    fn edge_and_margin(&self) -> (f64, f64) {
        let margin = if self.crowd == Crowd::Falling { 0.5 * self.spacing() } else { 0.25 * self.cell() };
        ((self.cells as f64 - 0.5) * self.cell() + 2.0 * margin, margin)
    }

    fn normal(&self) -> NormalLaw {
        if self.springs != Springs::Hertz {
            return linear(STIFFNESS, 1.0);
        }
        // As stiff as the linear spring at an overlap of 1 %: 2 E* sqrt(R overlap), with half of the modulus of each sphere in E*.
        let modulus = STIFFNESS / (2.0 * (0.25 * DIAMETER * 0.01 * DIAMETER).sqrt());
        let sphere = Elasticity { young_modulus: 2.0 * modulus * (1.0 - 0.09), poisson_ratio: 0.3 };
        NormalLaw::Hertz(Hertz { first: sphere, second: Some(sphere), restitution: 1.0, reference_speed: Some(self.speed()) })
    }

    fn tangential(&self) -> Option<TangentialLaw> {
        let law = LinearHistory { friction: 1e3, stiffness: 2.0 / 7.0 * STIFFNESS, damping_ratio: 0.0 };
        (self.springs == Springs::Tangential).then_some(TangentialLaw::LinearHistory(law))
    }

    fn scene(&self, knob: f64, random_seed: u64) -> Scene {
        let mut scene = scene("dense elastic bed", DENSITY, self.normal(), self.tangential());
        scene.scene.random_seed = random_seed;
        scene.shapes = vec![sphere("ball", 0.5 * DIAMETER)];
        let (edge, margin) = self.edge_and_margin();
        let basis = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]];
        scene.bodies = (0..self.count())
            .map(|index| {
                let (site, place) = (index / 4, Vector::from(basis[index % 4]));
                let corner =
                    Vector::new((site % self.cells) as f64, (site / self.cells % self.cells) as f64, (site / self.cells.pow(2)) as f64);
                let velocity = thermal(&mut Draws::new(random_seed, 0, index as u64)) * self.speed();
                body("ball", (corner + place) * self.cell() + Vector::repeat(margin), velocity)
            })
            .collect();
        if self.crowd == Crowd::Falling {
            // So heavy that in the run all fall by about a tenth of a diameter, as fast as they move.
            let fall = RUN * self.contact();
            scene.scene.gravity = Some([0.0, 0.0, -0.2 * DIAMETER / (fall * fall)]);
            let geometry = BoxGeometry { lower: [0.0; 3], upper: [edge, edge, edge + 2.0 * DIAMETER] };
            scene.boundaries = vec![Boundary::new("box", MATERIAL, BoundaryGeometry::Box(geometry))];
        } else {
            scene.domain = Some(Domain { lower: [0.0; 3], upper: [edge; 3], periodic: [true; 3] });
        }
        scene.numerics.initial_overlap = InitialOverlap::Allow;
        scene.numerics.step = Step::Seconds(self.contact() / knob);
        scene.scene.end_time = RUN * self.contact();
        scene
    }

    /// One start: energy over time, and the change of momentum.
    fn run(&self, simulation: &mut Simulation) -> Result<(Vec<[f64; 2]>, f64), Failure> {
        let end = simulation.scene().scene.end_time;
        let (energy, kinetic, momentum) = (simulation.now().total_energy(), simulation.now().kinetic_energy(), simulation.now().momentum());
        let sizes = self.count() as f64 * self.mass() * self.speed();
        let mut curve = Vec::new();
        for look in 1..=LOOKS {
            simulation.run_until(end * look as f64 / LOOKS as f64)?;
            curve.push([simulation.time(), (simulation.now().total_energy() - energy) / kinetic]);
        }
        Ok((curve, (simulation.now().momentum() - momentum).norm() / sizes))
    }

    /// (angle of a step)^2 / 24 of the fastest swing, with twice the square of its amplitude in springs and motion: neighbours that swing against each other
    /// have four times the squared frequency of a single contact, and 1.4 times as much again where tangential springs turn them against each other.
    fn design_error(&self, knob: f64) -> f64 {
        let turning = if self.springs == Springs::Tangential { 12.0 * 2.0 / 7.0 * 2.0 / 3.0 * 2.0 / 0.4 / 8.0 } else { 1.0 };
        (PI / knob).powi(2) / 24.0 * 8.0 * turning
    }

    /// Each step rounds a velocity by the sum of the forces on its body, which may be larger than what is left of them.
    fn momentum_floor(&self, knob: f64) -> f64 {
        let forces = if self.crowd == Crowd::Jammed { 12.0 * 0.01 / 0.001 * PI / knob } else { 1.0 };
        f64::EPSILON * forces * (RUN * knob).sqrt()
    }

    fn curve_file(&self, knob: f64) -> String {
        format!("energy_{}_at_{knob}.csv", self.label().replace([' ', ','], "_"))
    }
}

impl Case for DenseElasticBed {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let bed = Bed::of(setup)?;
        let mut measurement = Measurement::default();
        let (mut energies, mut momenta) = (Vec::new(), Vec::new());
        for start in 0..STARTS {
            let mut simulation = bed.scene(knob, STARTS * random_seed + start).build()?;
            let (curve, momentum) = bed.run(&mut simulation)?;
            let square = curve.iter().map(|[_, change]| change * change).sum::<f64>() / curve.len() as f64;
            energies.push(square.sqrt());
            momenta.push(momentum);
            add_work(&mut measurement.work, simulation.ledger().total_work());
            measurement.runs += 1;
            if start == 0 {
                let rows = curve.into_iter().map(Vec::from).collect();
                measurement.curves = vec![Curve { file: bed.curve_file(knob), columns: vec!["time", "energy_change"], rows }];
            }
        }
        let exact =
            |name, samples, floor| vanishing(name, "1", samples, floor, ReferenceKind::Exact, "conservation of energy and momentum");
        measurement.quantities = vec![exact(ENERGY, energies, f64::EPSILON * (RUN * knob).sqrt())];
        if bed.crowd != Crowd::Falling {
            measurement.quantities.push(exact(MOMENTUM, momenta, bed.momentum_floor(knob)));
        }
        Ok(measurement)
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        let mut claims = Bed::claims(tier, |bed, knob| {
            let design = Bound::new(2.0, bed.design_error(knob), "error of leapfrog in the fastest swing of a sphere among twelve");
            let mut claims = vec![bed.claim_at(knob, ENERGY, Statistic::Median, design, Expected::Holds)];
            if bed.crowd != Crowd::Falling {
                let rounding = Bound::new(4.0, bed.momentum_floor(knob), "rounding of every step, at random");
                claims.push(bed.claim_at(knob, MOMENTUM, Statistic::Worst, rounding, Expected::Holds));
            }
            claims
        });
        for bed in Bed::all().into_iter().filter(|bed| !bed.knobs(tier).is_empty()) {
            claims.push(Claim {
                setup: bed.label(),
                quantity: ENERGY,
                statistic: Statistic::Median,
                subject: Subject::OrderAtLeast { order: 2.0, range: [14.0, 56.0] },
                bound: Bound::new(2.0, 0.1, "scatter of three starts"),
                expected: Expected::Holds,
            });
        }
        claims
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        Bed::of(setup).ok().map(|bed| bed.scene(knob, 1))
    }

    fn description(&self) -> Description {
        let labels = Bed::labels(|_| true);
        Description {
            id: "dense_elastic_bed",
            title: "Energy of a dense elastic bed",
            question: "How well does a crowd of elastic spheres keep its energy, at which step and at which cost?",
            model: vec![
                "Spheres begin in a face-centred crystal with random velocities. Jammed, each overlaps its twelve neighbours by 1 % and swings about its place; loose, all collide all the time at a volume fraction of 0.66; falling, the loose crystal drops in a box with walls. Nothing takes energy away: what must stay is the energy of motion, weight and springs together, and without walls the momentum.",
                "Springs along the plane that never slip keep energy too, as long as contacts last; an opening contact would lose what its spring holds. They are therefore in the jammed bed only.",
            ],
            equations: vec![Equation {
                latex: r"\sum_i \tfrac12 m v_i^2 + \tfrac12 I\omega_i^2 - m\,g\cdot x_i + \sum_c \tfrac12 k\delta_c^2 + \tfrac12 k_t\xi_c^2 = \text{const}".into(),
                meaning: "Energy of motion, weight and springs; for Hertz's springs 8/15 E* √R δ^(5/2) each.".into(),
            }],
            parameters: [
                ("diameter, density", "10 mm, 2500 kg/m³", ""),
                ("stiffness", "10⁵ N/m", "Hertz: as stiff at 1 % of overlap; tangential 2/7"),
                ("speeds", "so that a collision overlaps by 0.5 %, jammed 0.1 %", "normal deviates"),
                ("run", "12 undamped contacts", "100 looks"),
                ("random starts", "3", ""),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "Conservation of energy and momentum: exact.",
            picture: picture(),
            plots: plots(&labels),
            headline: Headline {
                setup: labels[3].clone(),
                quantity: ENERGY.into(),
                statistic: "median".into(),
                knob: 56.0,
                order_quantity: Some(format!("observed order of {ENERGY}")),
            },
            sources: vec!["R (Rakotonirina 2016), sections 2.4 and 3.3", "S (Srinivasan 2019), section 4.1.1, which shows kinetic energy alone"],
            answers: vec!["Energy in a crowd, where every body has many contacts at once, against step and run time."],
            remarks: vec!["The energy of springs is looked at with that of motion: kinetic energy alone falls whenever spheres touch."],
            knob: Bed::knob(),
            setups: Bed::setups(),
            sample: "start",
            budget_cpu_s: [5.0, 300.0, 300.0],
        }
    }
}

fn plots(labels: &[String]) -> Vec<Plot> {
    let curve = |title: &str, bed: Bed| Plot::Curves {
        title: title.into(),
        file: format!("dense_elastic_bed/{}", bed.curve_file(28.0)),
        x_label: "time in s".into(),
        y_label: "energy change / kinetic energy at the start".into(),
        columns: vec![["energy_change".into(), bed.label()]],
        log_x: false,
        log_y: false,
        caption: String::new(),
    };
    vec![
        Plot::Convergence {
            title: "Energy error".into(),
            quantity: ENERGY.into(),
            setups: labels.to_vec(),
            statistics: vec!["median".into()],
            orders: vec![2.0],
            knob_is_resolution: true,
            knob_label: "steps per contact".into(),
        },
        Plot::ErrorAgainstCost {
            title: "Energy error against run time".into(),
            quantity: ENERGY.into(),
            setups: labels.to_vec(),
            statistic: "median".into(),
            targets: vec![0.01, 0.001, 0.0001],
        },
        curve("Energy of the jammed bed at 28 steps per contact", Bed::all()[0]),
        curve("Energy of the loose bed at 28 steps per contact", Bed::all()[3]),
    ]
}

fn picture() -> Picture {
    let disc = |x: f64, y: f64| PictureItem::Disc { center: [x, y], radius: 1.0, ghost: false };
    let mut items = Vec::new();
    for row in 0..4 {
        let shift = f64::from(row % 2);
        items.extend((0..4).map(|site| disc(2.0 * f64::from(site) + shift, 1.73 * f64::from(row))));
    }
    Picture { caption: "A crowd of spheres that all touch or nearly do.".into(), items }
}
