//! The scenes of the case and what is seen in them.

use solver::scene::{Body, InitialOverlap, LinearHistory, Scene, Step, TangentialLaw};
use solver::{Orientation, Simulation, Vector};

use super::super::soft_spheres::{body, contact_duration, linear, scene, sphere, sphere_mass};
use crate::case::Failure;

const RADIUS: f64 = 0.005;
const DENSITY: f64 = 2500.0;
/// In N/m.
const STIFFNESS: f64 = 1e4;
/// Of the collisions, in m/s.
const SPEED: f64 = 1.0;

/// Steps per contact of collisions that are compared with each other.
pub(super) const STEPS: f64 = 50.0;
/// Steps per contact of collisions that are compared with a closed form.
pub(super) const MANY_STEPS: f64 = 200.0;

/// Error of a velocity over the speed from the rounding of places a number of diameters off, which are two parts in a hundred of a diameter in overlap.
pub(super) fn overlap_rounding(diameters: f64) -> f64 {
    let overlap = SPEED * contact_duration(0.5 * sphere_mass(DENSITY, RADIUS), STIFFNESS) / std::f64::consts::PI;
    f64::EPSILON * (1.0 + diameters) * 2.0 * RADIUS / overlap
}

/// From where a collision is looked at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    /// In diameters.
    pub(super) shift: Vector,
    /// In units of the speed.
    pub(super) boost: Vector,
    pub(super) turn: Orientation,
    /// Whether x points the other way.
    pub(super) is_mirrored: bool,
    /// Whether the bodies have each other's ids.
    pub(super) is_swapped: bool,
}

impl Default for Frame {
    fn default() -> Frame {
        let (shift, boost) = (Vector::zeros(), Vector::zeros());
        Frame { shift, boost, turn: Orientation::identity(), is_mirrored: false, is_swapped: false }
    }
}

impl Frame {
    /// Moving, turned, mirrored, swapped: from one.
    pub(super) fn numbered(number: usize) -> Frame {
        let plain = Frame::default();
        match number {
            1 => Frame { boost: Vector::new(1.0, -2.0, 2.0), ..plain },
            2 => Frame { turn: Orientation::from_scaled_axis(Vector::new(0.3, -1.1, 0.7)), ..plain },
            3 => Frame { is_mirrored: true, ..plain },
            _ => Frame { is_swapped: true, ..plain },
        }
    }

    fn mirrored(&self, vector: Vector) -> Vector {
        if self.is_mirrored { Vector::new(-vector.x, vector.y, vector.z) } else { vector }
    }

    /// A spin is mirrored as the plane it turns in, not as an arrow.
    fn mirrored_spin(&self, spin: Vector) -> Vector {
        if self.is_mirrored { -self.mirrored(spin) } else { spin }
    }
}

/// An oblique collision of two spinning spheres with friction and loss.
#[derive(Debug, Clone, Copy)]
pub(super) struct Collision {
    /// Factor of the stiffness; speeds grow with its root, so that the collision stays alike.
    pub(super) stiffness: f64,
    /// Factor of lengths; the stiffness grows with it, so that the collision stays alike.
    pub(super) size: f64,
    pub(super) frame: Frame,
}

impl Default for Collision {
    fn default() -> Collision {
        Collision { stiffness: 1.0, size: 1.0, frame: Frame::default() }
    }
}

/// Velocities over the speed and spins times radius over the speed after a collision, as the first frame sees them.
pub(super) struct Outcome {
    pub(super) velocities: Vec<Vector>,
    pub(super) spins: Vec<Vector>,
}

impl Collision {
    fn radius(&self) -> f64 {
        RADIUS * self.size
    }

    fn speed(&self) -> f64 {
        SPEED * self.stiffness.sqrt()
    }

    pub(super) fn scene(&self) -> Scene {
        let (radius, speed, frame) = (self.radius(), self.speed(), &self.frame);
        let stiffness = STIFFNESS * self.stiffness * self.size;
        let friction = LinearHistory { friction: 0.3, stiffness: 2.0 / 7.0 * stiffness, damping_ratio: 0.2 };
        let mut scene = scene("oblique collision", DENSITY, linear(stiffness, 0.8), Some(TangentialLaw::LinearHistory(friction)));
        scene.shapes = vec![sphere("ball", radius)];
        // Centres on a skew line, a part in a hundred apart.
        let [one, other] = [Vector::new(0.48, 0.64, 0.6), Vector::new(-0.48, -0.64, -0.6)].map(|place| place * 1.01);
        let velocities = [Vector::new(-0.3, -0.5, -0.2), Vector::new(0.4, 0.1, 0.3)];
        let spins = [Vector::new(0.3, -0.7, 0.2), Vector::new(-0.1, 0.5, 0.9)];
        scene.bodies = (0..2)
            .map(|index| {
                let place = frame.turn * frame.mirrored([one, other][index]) * radius + frame.shift * (2.0 * radius);
                let velocity = (frame.turn * frame.mirrored(velocities[index]) + frame.boost) * speed;
                let spin = frame.turn * frame.mirrored_spin(spins[index]) * (speed / radius);
                let id = if frame.is_swapped { 1 - index } else { index };
                Body { id: Some(id as u32), angular_velocity: spin.into(), ..body("ball", place, velocity) }
            })
            .collect();
        let contact = contact_duration(0.5 * sphere_mass(DENSITY, radius), stiffness);
        scene.numerics.step = Step::Seconds(contact / STEPS);
        scene.scene.end_time = 2.0 * contact;
        scene
    }

    pub(super) fn run(&self) -> Result<Outcome, Failure> {
        let mut simulation = self.scene().build()?;
        simulation.run_until(simulation.scene().scene.end_time)?;
        let (now, frame) = (simulation.now(), &self.frame);
        let back = frame.turn.inverse();
        let mut outcome = Outcome { velocities: Vec::new(), spins: Vec::new() };
        for index in now.bodies().by_id() {
            outcome.velocities.push(frame.mirrored(back * (now.velocity(index) / self.speed() - frame.boost)));
            outcome.spins.push(frame.mirrored_spin(back * now.angular_velocity(index) * (self.radius() / self.speed())));
        }
        if frame.is_swapped {
            outcome.velocities.reverse();
            outcome.spins.reverse();
        }
        Ok(outcome)
    }
}

/// Two elastic spheres of one size, the second so many times as heavy, head-on along a skew line.
pub(super) fn unequal_pair(ratio: f64) -> Scene {
    let mut scene = scene("unequal masses", DENSITY, linear(STIFFNESS, 1.0), None);
    scene.shapes = vec![sphere("ball", RADIUS)];
    let light = sphere_mass(DENSITY, RADIUS);
    let moving = Body { mass: Some(light), ..body("ball", -axis() * (1.01 * RADIUS), axis() * SPEED) };
    let resting = Body { mass: Some(ratio * light), ..body("ball", axis() * (1.01 * RADIUS), Vector::zeros()) };
    scene.bodies = vec![moving, resting];
    let contact = contact_duration(light * ratio / (1.0 + ratio), STIFFNESS);
    scene.numerics.step = Step::Seconds(contact / MANY_STEPS);
    scene.scene.end_time = 2.0 * contact;
    scene
}

fn axis() -> Vector {
    Vector::new(2.0, 3.0, 6.0) / 7.0
}

/// Relative speed after over before, less one, and change of the momentum over that of the light sphere.
pub(super) fn unequal_masses(ratio: f64) -> Result<[f64; 2], Failure> {
    let mut simulation = unequal_pair(ratio).build()?;
    let momentum = simulation.now().momentum();
    simulation.run_until(simulation.scene().scene.end_time)?;
    let change = simulation.now().momentum() - momentum;
    Ok([relative_speed(&mut simulation) / SPEED - 1.0, change.norm() / momentum.norm()])
}

/// Two elastic spheres at rest, with an overlap over their diameter.
pub(super) fn overlapping_pair(overlap: f64) -> Scene {
    let mut scene = scene("deep overlap", DENSITY, linear(STIFFNESS, 1.0), None);
    scene.shapes = vec![sphere("ball", RADIUS)];
    scene.bodies = [-1.0, 1.0].map(|side| body("ball", axis() * (side * RADIUS * (1.0 - overlap)), Vector::zeros())).to_vec();
    scene.numerics.initial_overlap = InitialOverlap::Allow;
    let contact = contact_duration(0.5 * sphere_mass(DENSITY, RADIUS), STIFFNESS);
    // No whole number of steps in the way out.
    scene.numerics.step = Step::Seconds(contact / (MANY_STEPS + 0.618));
    scene.scene.end_time = contact;
    scene
}

/// Relative speed at which they spring apart, over that which their spring gives, less one.
pub(super) fn sprung_apart(overlap: f64) -> Result<f64, Failure> {
    let mut simulation = overlapping_pair(overlap).build()?;
    simulation.run_until(simulation.scene().scene.end_time)?;
    let frequency = (STIFFNESS / (0.5 * sphere_mass(DENSITY, RADIUS))).sqrt();
    Ok(relative_speed(&mut simulation) / (overlap * 2.0 * RADIUS * frequency) - 1.0)
}

/// Speed in m/s at which two bodies part.
fn relative_speed(simulation: &mut Simulation) -> f64 {
    let now = simulation.now();
    (now.velocity(1) - now.velocity(0)).dot(&axis())
}

/// Two spheres move towards each other on either side of a grain that touches both above their line of centres. Friction is half of what would hold the grain.
pub(super) fn pinch(ratio: f64, steps: f64) -> Scene {
    let grain = RADIUS / ratio;
    let half_gap = 0.5 * grain;
    let apart = RADIUS + half_gap;
    let height = ((RADIUS + grain).powi(2) - apart * apart).sqrt();
    let friction = LinearHistory { friction: 0.5 * height / apart, stiffness: 2.0 / 7.0 * STIFFNESS, damping_ratio: 0.0 };
    let mut scene = scene("pinch", DENSITY, linear(STIFFNESS, 1.0), Some(TangentialLaw::LinearHistory(friction)));
    scene.shapes = vec![sphere("ball", RADIUS), sphere("grain", grain)];
    let contact = contact_duration(sphere_mass(DENSITY, grain), STIFFNESS);
    // Slow enough for small overlaps: a fiftieth of the grain in the time in which its contact swings by a radian.
    let speed = 0.02 * grain * std::f64::consts::PI / contact;
    let ball = |side: f64| body("ball", Vector::x() * (side * apart), Vector::x() * (-side * speed));
    // A hair off the surfaces, so that nothing overlaps at the start.
    scene.bodies = vec![ball(-1.0), ball(1.0), body("grain", Vector::z() * (height * (1.0 + 1e-12)), Vector::zeros())];
    scene.numerics.step = Step::Seconds(contact / steps);
    scene.scene.end_time = 0.4 * grain / speed;
    scene
}

/// Speed in m/s of the grain along the way out.
pub(super) fn pinched(ratio: f64, steps: f64) -> Result<f64, Failure> {
    let mut simulation = pinch(ratio, steps).build()?;
    simulation.run_until(simulation.scene().scene.end_time)?;
    Ok(simulation.now().velocity(2).z)
}
