//! A gas of grains left to itself: does it cool by Haff's law, and does an elastic one share its energy evenly?

mod page;

use std::f64::consts::PI;

use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::insertion::Draws;
use solver::measure::Now;
use solver::scene::{Body, Domain, Scene, Step};
use solver::{Simulation, Vector};

use super::soft_spheres::{body, contact_duration, linear, scene, sphere, sphere_mass};
use crate::case::{Case, Curve, Description, Failure, Measurement, Quantity, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::exact::kinetic_theory::{EvenMixture, Gas, thermal, variance_of_mean};
use crate::study::add_work;
use crate::variant::Variant;

/// The case.
pub struct GranularGas;

const DIAMETER: f64 = 0.001;
const DENSITY: f64 = 2500.0;
/// Part of the volume that is filled.
const VOLUME_FRACTION: f64 = 0.05;
/// Root of temperature over mass at the start, in m/s.
const SPEED: f64 = 0.1;
/// Duration of a contact over the mean time between collisions of a sphere at the start: what is soft about the gas.
const SOFTNESS: f64 = 0.01;
/// Looks at the energy of a run.
const LOOKS: u32 = 40;
/// Heavy spheres of the mixture are so much wider than light ones, of the same density.
const RATIO: f64 = 1.5;
/// Collisions of a sphere in the run of the mixture.
const MIXING: f64 = 40.0;

const RATE: &str = "rate of cooling / kinetic theory";
const SHAPE: &str = "slope of 1/sqrt(E) in the second half / first half";
const SHARE: &str = "temperature of heavy spheres / light spheres";
const SPREAD: &str = "fourth moment of speeds / Maxwell";

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Variety {
    /// Cooling, of a restitution, for so many cooling times.
    Cooling { spheres: usize, restitution: f64, times: f64 },
    /// Elastic, of two sizes: light spheres begin with all the energy.
    Mixture { spheres: usize },
}

impl Variant for Variety {
    fn all() -> Vec<Variety> {
        let cooling = |spheres, restitution, times| Variety::Cooling { spheres, restitution, times };
        vec![
            cooling(216, 0.8, 0.5),
            cooling(1000, 0.8, 0.5),
            cooling(1000, 0.9, 0.5),
            cooling(8000, 0.9, 2.0),
            Variety::Mixture { spheres: 216 },
            Variety::Mixture { spheres: 2000 },
        ]
    }

    fn label(&self) -> String {
        match self {
            Variety::Cooling { spheres, restitution, .. } => format!("cooling, {spheres} spheres, restitution {restitution}"),
            Variety::Mixture { spheres } => format!("elastic mixture, {spheres} spheres"),
        }
    }

    fn knob_name(&self) -> &'static str {
        "steps_per_contact"
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match (tier, self.spheres()) {
            (Tier::Quick, 216) => vec![10.0],
            (Tier::Quick, 1000) if self.gas().restitution == 0.8 => vec![10.0],
            (Tier::Quick, _) => Vec::new(),
            (_, 8000) => vec![10.0],
            _ => vec![10.0, 20.0, 40.0],
        }
    }
}

impl Variety {
    fn spheres(&self) -> usize {
        match *self {
            Variety::Cooling { spheres, .. } | Variety::Mixture { spheres } => spheres,
        }
    }

    /// Random starts of each measurement.
    fn starts(&self) -> u64 {
        if self.spheres() == 216 { 6 } else { 3 }
    }

    fn radius(&self, index: usize) -> f64 {
        let is_heavy = matches!(self, Variety::Mixture { .. }) && index % 2 == 1;
        0.5 * DIAMETER * if is_heavy { RATIO } else { 1.0 }
    }

    /// The gas of kinetic theory; a mixture by its mean diameter, for its time scale alone.
    fn gas(&self) -> Gas {
        let (restitution, diameter) = match self {
            Variety::Cooling { restitution, .. } => (*restitution, DIAMETER),
            Variety::Mixture { .. } => (1.0, 0.5 * DIAMETER * (1.0 + RATIO)),
        };
        Gas { diameter, number_density: self.spheres() as f64 / self.edge().powi(3), restitution }
    }

    /// Edge in m of the periodic box.
    fn edge(&self) -> f64 {
        let volume: f64 = (0..self.spheres()).map(|index| PI / 6.0 * (2.0 * self.radius(index)).powi(3)).sum();
        (volume / VOLUME_FRACTION).cbrt()
    }

    /// Duration in s of a contact of two light spheres, the shortest.
    fn contact(&self) -> f64 {
        SOFTNESS / self.gas().collision_rate(SPEED)
    }

    fn end_time(&self) -> f64 {
        match self {
            Variety::Cooling { times, .. } => times * self.gas().cooling_time(SPEED),
            Variety::Mixture { .. } => MIXING / self.gas().collision_rate(SPEED),
        }
    }

    fn scene(&self, knob: f64, random_seed: u64) -> Scene {
        let reduced_mass = 0.5 * sphere_mass(DENSITY, 0.5 * DIAMETER);
        let stiffness = reduced_mass * (PI / self.contact()).powi(2);
        let restitution = self.gas().restitution;
        let mut scene = scene("granular gas", DENSITY, linear(stiffness, restitution), None);
        scene.scene.random_seed = random_seed;
        scene.shapes = vec![sphere("light", 0.5 * DIAMETER), sphere("heavy", 0.5 * DIAMETER * RATIO)];
        scene.bodies = self.thrown(random_seed);
        scene.domain = Some(Domain { lower: [0.0; 3], upper: [self.edge(); 3], periodic: [true; 3] });
        let shortest = contact_duration(reduced_mass, stiffness);
        scene.numerics.step = Step::Seconds(shortest / knob);
        scene.scene.end_time = self.end_time();
        scene
    }

    /// Spheres at random places without overlap, which is nearly equilibrium in so thin a gas, with normal deviates for velocities; none on the whole. In a
    /// mixture only light ones move.
    fn thrown(&self, random_seed: u64) -> Vec<Body> {
        let edge = self.edge();
        let mut bodies: Vec<Body> = Vec::new();
        let mut tried = 0;
        while bodies.len() < self.spheres() {
            let index = bodies.len();
            let place = Draws::new(random_seed, 1, tried).in_box(&Vector::zeros(), &Vector::repeat(edge));
            tried += 1;
            let is_free = |(other, body): (usize, &Body)| {
                let apart = (place - Vector::from(body.position)).map(|along| along - edge * (along / edge).round());
                apart.norm() > self.radius(index) + self.radius(other)
            };
            if !bodies.iter().enumerate().all(is_free) {
                continue;
            }
            let is_heavy = self.radius(index) > 0.5 * DIAMETER;
            let velocity = if is_heavy { Vector::zeros() } else { thermal(&mut Draws::new(random_seed, 2, index as u64)) * SPEED };
            bodies.push(body(if is_heavy { "heavy" } else { "light" }, place, velocity));
        }
        without_momentum(&mut bodies, |index| sphere_mass(DENSITY, self.radius(index)));
        bodies
    }

    /// What is measured.
    fn names(&self) -> [&'static str; 2] {
        match self {
            Variety::Cooling { .. } => [RATE, SHAPE],
            Variety::Mixture { .. } => [SHARE, SPREAD],
        }
    }

    /// Standard deviations from one start, of the first and of the second quantity.
    fn scatter(&self) -> [f64; 2] {
        match *self {
            // Each collision takes an energy whose deviation is its mean, at times as random. Each half has half of the collisions, and the two differ.
            Variety::Cooling { spheres, times, .. } => {
                let collisions = 0.5 * spheres as f64 * self.gas().collisions_until(times);
                let of_rate = (2.0 / collisions).sqrt();
                [of_rate, 2.0 * of_rate]
            }
            // Temperatures of half the spheres each. Their difference lives as long as spheres of two kinds take to share it, that of speeds from Maxwell's
            // for a mean time between collisions.
            Variety::Mixture { spheres } => {
                let at_one_time = 2.0 * 2.0 / 3.0 / (0.5 * spheres as f64);
                let half = 0.5 * self.end_time();
                let of_share = at_one_time * variance_of_mean(self.equilibration_rate(), half);
                [of_share.sqrt(), (at_one_time / (0.5 * MIXING)).sqrt()]
            }
        }
    }

    /// How fast the mixture shares its energy in 1/s when both kinds have half of what the light ones began with.
    fn equilibration_rate(&self) -> f64 {
        let diameters = [DIAMETER, DIAMETER * RATIO];
        let masses = diameters.map(|diameter| sphere_mass(DENSITY, diameter));
        let mixture = EvenMixture { masses, diameters, number_density: 0.5 * self.gas().number_density };
        mixture.equilibration_rate(0.5 * masses[0] * SPEED * SPEED)
    }

    /// Standard deviations of the medians of all starts, with what soft collisions that take time may change.
    fn floors(&self) -> [f64; 2] {
        self.scatter().map(|scatter| (0.5 * PI).sqrt() * scatter / (self.starts() as f64).sqrt() + SOFTNESS)
    }

    fn curve_file(&self, knob: f64) -> String {
        format!("energy_{}_at_{knob}.csv", self.label().replace([' ', ','], "_"))
    }
}

fn without_momentum(bodies: &mut [Body], mass: impl Fn(usize) -> f64) {
    let total: f64 = (0..bodies.len()).map(&mass).sum();
    let momentum: Vector = bodies.iter().enumerate().map(|(index, body)| Vector::from(body.velocity) * mass(index)).sum();
    for body in bodies {
        body.velocity = (Vector::from(body.velocity) - momentum / total).into();
    }
}

/// Slope through the first point of values over times.
fn slope(points: &[[f64; 2]]) -> f64 {
    let [time, value] = points[0];
    let sums = points[1..].iter().fold([0.0, 0.0], |[product, square], point| {
        let (time, value) = (point[0] - time, point[1] - value);
        [product + time * value, square + time * time]
    });
    sums[0] / sums[1]
}

/// Energy over time of a cooling gas as points of $\sqrt{E_0/E}$, which Haff's law makes a straight line.
fn cool(simulation: &mut Simulation) -> Result<Vec<[f64; 2]>, Failure> {
    let end = simulation.scene().scene.end_time;
    let start = simulation.now().total_energy();
    let mut points = vec![[0.0, 1.0]];
    for look in 1..=LOOKS {
        simulation.run_until(end * f64::from(look) / f64::from(LOOKS))?;
        let now = simulation.now();
        points.push([now.time(), (start / now.total_energy()).sqrt()]);
    }
    Ok(points)
}

/// Ratio of the temperatures of heavy and light spheres, and the fourth moment of light ones over Maxwell's, over the second half of a run.
fn mix(simulation: &mut Simulation) -> Result<[f64; 2], Failure> {
    let end = simulation.scene().scene.end_time;
    let (mut temperatures, mut moments) = ([0.0, 0.0], [0.0, 0.0]);
    for look in LOOKS / 2..=LOOKS {
        simulation.run_until(end * f64::from(look) / f64::from(LOOKS))?;
        let now = simulation.now();
        for index in now.bodies().by_id() {
            let is_heavy = now.bodies().id(index) % 2 == 1;
            let square = now.velocity(index).norm_squared();
            temperatures[usize::from(is_heavy)] += now.bodies().mass(index) * square;
            if !is_heavy {
                moments = [moments[0] + square, moments[1] + square * square];
            }
        }
    }
    let looks = f64::from(LOOKS / 2 + 1) * light(&simulation.now()) as f64;
    // Maxwell: the mean fourth power of the speed is 5/3 of the square of the mean square.
    Ok([temperatures[1] / temperatures[0], moments[1] / looks / (5.0 / 3.0 * (moments[0] / looks).powi(2))])
}

fn light(now: &Now<'_>) -> usize {
    now.bodies().len().div_ceil(2)
}

impl Case for GranularGas {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        let variety = Variety::of(setup)?;
        let mut measurement = Measurement::default();
        let mut samples = [Vec::new(), Vec::new()];
        for start in 0..variety.starts() {
            let mut simulation = variety.scene(knob, variety.starts() * random_seed + start).build()?;
            match variety {
                Variety::Cooling { .. } => {
                    let thermal_speed = (2.0 / 3.0 * simulation.now().kinetic_energy() / total_mass(&simulation)).sqrt();
                    let points = cool(&mut simulation)?;
                    let half = points.len() / 2;
                    samples[0].push(slope(&points) * variety.gas().cooling_time(thermal_speed));
                    samples[1].push(slope(&points[half..]) / slope(&points[..=half]));
                    if start == 0 {
                        let time = variety.gas().cooling_time(thermal_speed);
                        let rows = points.iter().map(|[at, root]| vec![at / time, root.powi(-2), (1.0 + at / time).powi(-2)]).collect();
                        let columns = vec!["time_over_cooling_time", "energy", "haff"];
                        measurement.curves = vec![Curve { file: variety.curve_file(knob), columns, rows }];
                    }
                }
                Variety::Mixture { .. } => {
                    let found = mix(&mut simulation)?;
                    samples[0].push(found[0]);
                    samples[1].push(found[1]);
                }
            }
            add_work(&mut measurement.work, simulation.ledger().total_work());
            measurement.runs += 1;
        }
        let source = match variety {
            Variety::Cooling { .. } => "Haff's law with Enskog's collision rate",
            Variety::Mixture { .. } => "equipartition and Maxwell's distribution",
        };
        let names = variety.names();
        let quantity = |((name, floor), samples)| Quantity {
            name,
            unit: "1",
            samples,
            expected: 1.0,
            reference: Reference { kind: ReferenceKind::Exact, uncertainty: SOFTNESS, source: source.into() },
            error_kind: ErrorKind::Absolute,
            floor,
        };
        measurement.quantities = names.into_iter().zip(variety.floors()).zip(samples).map(quantity).collect();
        Ok(measurement)
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        Variety::claims(tier, |variety, knob| {
            let claim = |(name, floor)| {
                let bound = Bound::new(3.0, floor, "standard deviation over the starts, and duration of a contact");
                variety.claim_at(knob, name, Statistic::Median, bound, Expected::Holds)
            };
            variety.names().into_iter().zip(variety.floors()).map(claim).collect()
        })
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        Variety::of(setup).ok().map(|variety| variety.scene(knob, 1))
    }

    fn description(&self) -> Description {
        page::description()
    }
}

fn total_mass(simulation: &Simulation) -> f64 {
    let bodies = simulation.bodies();
    (0..bodies.len()).map(|index| bodies.mass(index)).sum()
}
