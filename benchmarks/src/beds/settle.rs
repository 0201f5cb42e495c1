//! How the beds were made.

use solver::scene::{InsertedOrientation, InsertedShape, Insertion, InsertionRegion, LatticeRegion};

use super::kinds::Kind;
use super::states::States;

/// Bodies of a bed.
const BODIES: u32 = 400;
/// While a bed settles, contacts are softer by this for so long in s, one after the other, and lose more: springs that are made stiffer all at once throw the
/// bodies up.
const SETTLING: [(f64, f64); 3] = [(100.0, 0.05), (10.0, 0.02), (1.0, 0.012)];
const RESTITUTION_OF_SETTLING: f64 = 0.2;

/// Lets a loose lattice of bodies, turned at random, fall and settle, softer at first.
///
/// # Errors
///
/// If the scene cannot be, or a guard stops the run.
pub fn settled(kind: Kind) -> Result<States, Box<dyn std::error::Error>> {
    let (side, longest) = (kind.side(), kind.longest());
    let in_a_row = (side / (1.1 * longest)).floor();
    let spacing = side / in_a_row * (1.0 - 1e-9);
    let loose = Insertion {
        name: "lattice".into(),
        material: "glass".into(),
        number: BODIES,
        shapes: vec![InsertedShape { shape: "body".into(), fraction: 1.0, scale: None }],
        region: InsertionRegion::Lattice(LatticeRegion {
            lower: [0.0; 3],
            upper: [side, side, 0.95],
            spacing: [spacing; 3],
            // Perfect columns would stay.
            jitter: 0.04 * longest,
        }),
        orientation: InsertedOrientation::default(),
        velocity: [0.0, 0.0, -1.0],
        angular_velocity: [0.0; 3],
        attempts: 1,
        during_run: None,
    };
    let fall = (f64::from(BODIES) / (in_a_row * in_a_row)).ceil() * spacing / 1.5;
    let mut states = States(Vec::new());
    for (softer, duration) in SETTLING {
        let mut scene = kind.column(softer, RESTITUTION_OF_SETTLING)?;
        let is_first = states.0.is_empty();
        if is_first {
            scene.insertions = vec![loose.clone()];
        } else {
            scene.bodies = kind.bodies(&states);
        }
        let mut simulation = scene.build()?;
        simulation.run_until(if is_first { fall + duration } else { duration })?;
        states = States::of(&simulation);
    }
    Ok(states)
}
