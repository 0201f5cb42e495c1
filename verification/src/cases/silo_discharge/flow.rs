//! Runs of the case: fill, open, and what is seen of the flow.

use std::collections::BTreeMap;

use solver::openings::Departure;
use solver::{Scene, Simulation};

use super::setting::{DIAMETER, FlatBottom, GRAVITY, HEIGHT, Laws, WIDTH, bead_mass, hopper_height, silo_filling, silo_open};
use crate::case::Failure;
use crate::packing::Packing;
use crate::study::add_work;

/// Time in s between two looks at a flow through a hole, and how many of them lie between two pictures.
const LOOK_AT_FLOW: f64 = 0.02;
const LOOKS_IN_A_PICTURE: u32 = 6;
/// Parts of the beads that have left when a steady flow is taken to begin and to end.
const STEADY: [f64; 2] = [0.05, 0.25];

/// A flow through a hole in a flat bottom.
pub struct Flow {
    /// Steady mass flow in kg/s.
    pub rate: f64,
    /// Mass of beads in a cubic metre of the filling, before it flows.
    pub bulk_density: f64,
    /// What was seen of it.
    pub seen: Seen,
    /// Work counts of filling and flow.
    pub work: BTreeMap<String, u64>,
}

/// What is kept of a flow for pages.
#[derive(Default)]
pub struct Seen {
    /// When each bead left, in s.
    pub departures: Vec<f64>,
    /// Beads of the slice behind the middle at several times: time, place across, height, speed.
    pub slices: Vec<[f64; 4]>,
}

impl Flow {
    /// $W / (\rho_b \sqrt{g d^5})$, as Beverloo's law has it.
    pub fn reduced(&self) -> f64 {
        self.rate / (self.bulk_density * (GRAVITY * DIAMETER.powi(5)).sqrt())
    }
}

/// Lets a packing flow out of a scene.
fn open(packing: &Packing, mut scene: Scene) -> Result<Simulation, Failure> {
    packing.start(&mut scene);
    Ok(scene.build()?)
}

/// Beads per second between two parts of all that have left, from the times at which they left.
fn steady_rate(departures: &[Departure], beads: u32) -> f64 {
    let [first, last] = STEADY.map(|part| (part * f64::from(beads)) as usize);
    (last - first) as f64 / (departures[last].time - departures[first].time)
}

/// The steady flow of a vessel with a hole.
pub fn flow(vessel: &FlatBottom, random_seed: u64) -> Result<Flow, Failure> {
    let packing = Packing::of(&vessel.filling(random_seed))?;
    let mut simulation = open(&packing, vessel.open(random_seed))?;
    let enough = (STEADY[1] * f64::from(vessel.beads)) as usize + 1;
    let mut seen = Seen::default();
    for look in 0.. {
        if simulation.departures().len() >= enough {
            break;
        }
        if look % LOOKS_IN_A_PICTURE == 0 {
            seen.slices.extend(slice(&mut simulation));
        }
        if simulation.time() >= simulation.scene().scene.end_time {
            let left = simulation.departures().len();
            return Err(Failure::NothingMeasured(format!("the flow has stopped: {left} of {} beads have left", vessel.beads)));
        }
        simulation.run_until(simulation.time() + LOOK_AT_FLOW)?;
    }
    seen.departures = times_of(&simulation);
    let mut work = packing.work.clone();
    add_work(&mut work, simulation.ledger().total_work());
    let rate = steady_rate(simulation.departures(), vessel.beads) * bead_mass();
    Ok(Flow { rate, bulk_density: bulk_density(&packing, vessel), seen, work })
}

/// From beads in the middle of the height, where neither the bottom nor the surface shows.
fn bulk_density(packing: &Packing, vessel: &FlatBottom) -> f64 {
    let top = packing.bodies.iter().map(|body| body.position[2]).fold(0.0, f64::max);
    let (low, high) = (0.25 * top, 0.75 * top);
    let volume: f64 = packing.bodies.iter().map(|body| volume_between(body.position[2], low, high)).sum();
    let area = std::f64::consts::PI * (0.5 * vessel.vessel * DIAMETER).powi(2);
    bead_mass() * volume / volume_between(0.5 * (low + high), low, high) / (area * (high - low))
}

/// Volume in m^3 of a bead at a height that lies between two heights further apart than it is thick.
fn volume_between(height: f64, low: f64, high: f64) -> f64 {
    let radius = 0.5 * DIAMETER;
    // Of a ball below a height above its centre.
    let below = |above: f64| {
        let above = above.clamp(-radius, radius);
        std::f64::consts::PI * (radius * radius * above - above.powi(3) / 3.0 + 2.0 / 3.0 * radius.powi(3))
    };
    below(high - height) - below(low - height)
}

/// A discharge of R's silo.
pub struct Discharge {
    /// When the last bead has left, in s.
    pub time: f64,
    /// Height of the filling above the hopper, over the height of the silo there.
    pub fill_height: f64,
    /// What was seen of it.
    pub seen: Seen,
    /// Work counts of filling and discharge.
    pub work: BTreeMap<String, u64>,
}

/// Times in s at which the slice is kept: R's figure 5.7.
const SLICES: [f64; 6] = [0.0, 2.0, 5.0, 10.0, 20.0, 27.0];
/// Time in s between two looks whether all have left.
const LOOK: f64 = 0.05;

/// Fills and discharges R's silo.
pub fn discharge(laws: Laws, softening: f64, random_seed: u64) -> Result<Discharge, Failure> {
    let packing = Packing::of(&silo_filling(laws, softening, random_seed))?;
    let mut simulation = open(&packing, silo_open(laws, softening, random_seed))?;
    let mut seen = Seen::default();
    let mut due = SLICES.iter().peekable();
    while !simulation.bodies().is_empty() {
        if due.next_if(|due| simulation.time() >= **due - 0.5 * LOOK).is_some() {
            seen.slices.extend(slice(&mut simulation));
        }
        if simulation.time() >= simulation.scene().scene.end_time {
            return Err(Failure::NothingMeasured(format!("{} beads are left after {} s", simulation.bodies().len(), simulation.time())));
        }
        simulation.run_until(simulation.time() + LOOK)?;
    }
    seen.departures = times_of(&simulation);
    let mut work = packing.work.clone();
    add_work(&mut work, simulation.ledger().total_work());
    let time = seen.departures.last().copied().unwrap_or(f64::NAN);
    Ok(Discharge { time, fill_height: fill_height(&packing), seen, work })
}

fn times_of(simulation: &Simulation) -> Vec<f64> {
    simulation.departures().iter().map(|departure| departure.time).collect()
}

/// Beads whose centres are within a diameter behind the middle.
fn slice(simulation: &mut Simulation) -> Vec<[f64; 4]> {
    let now = simulation.now();
    let is_in = |index: &usize| (0.0..DIAMETER).contains(&now.position(*index).y);
    let row = |index: usize| [now.time(), now.position(index).x, now.position(index).z, now.velocity(index).norm()];
    now.bodies().by_id().filter(is_in).map(row).collect()
}

/// Squares along a side of the silo whose highest beads are its surface.
const SQUARES: usize = 6;

/// Mean height of the surface above the hopper, over the height of the silo there.
fn fill_height(packing: &Packing) -> f64 {
    let mut tops = [[f64::NAN; SQUARES]; SQUARES];
    let square = |coordinate: f64| ((coordinate / WIDTH + 0.5) * SQUARES as f64).clamp(0.0, SQUARES as f64 - 1.0) as usize;
    for body in &packing.bodies {
        let top = &mut tops[square(body.position[0])][square(body.position[1])];
        *top = top.max(body.position[2] + 0.5 * DIAMETER);
    }
    (tops.as_flattened().iter().sum::<f64>() / (SQUARES * SQUARES) as f64 - hopper_height()) / HEIGHT
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bead_across_a_height_counts_in_part() {
        let whole = bead_mass() / super::super::setting::DENSITY;
        assert!((volume_between(0.05, 0.0, 0.1) / whole - 1.0).abs() < 1e-14);
        assert!((volume_between(0.1, 0.0, 0.1) / whole - 0.5).abs() < 1e-14);
        // A cap of half the radius: (pi/3) h^2 (3 r - h) is 5/32 of the ball.
        assert!((volume_between(0.25 * DIAMETER, -1.0, 0.0) / whole - 5.0 / 32.0).abs() < 1e-14);
        assert_eq!(volume_between(0.2, 0.0, 0.1), 0.0);
    }

    #[test]
    fn the_rate_is_that_of_even_departures() {
        let left = |index: u32| Departure { id: index, outlet: 0, time: 1.0 + 0.01 * f64::from(index), mass: 1.0 };
        let departures: Vec<Departure> = (0..100).map(left).collect();
        assert!((steady_rate(&departures, 200) - 100.0).abs() < 1e-9);
    }
}
