//! A bed of settled spheres of any number, and what its steps cost.

use std::time::Instant;

use cpu_time::ThreadTime;
use rayon::{ThreadPool, ThreadPoolBuilder};
use solver::{Scene, Simulation};

use crate::peers::packing::{Law, Packing};

/// Spheres of one copy.
pub const SPHERES_OF_A_COPY: usize = 1000;
/// The settled bed that copies are made of, as text.
pub const SETTLED: &str = include_str!("../../peers/packing/settled_thousand.csv");

/// A simulation and the threads that step it.
pub struct Bed {
    /// Spheres.
    pub spheres: usize,
    pub(crate) simulation: Simulation,
    threads: ThreadPool,
}

/// CPU time of the stepping thread and wall time, in s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// Of the thread that began the steps: all of it if there is only one.
    pub cpu_s: f64,
    /// Wall time.
    pub wall_s: f64,
}

/// Copies side by side of the settled bed, under friction with memory.
pub fn scene(copies: [usize; 2]) -> Option<Scene> {
    Packing::parse(SETTLED).map(|packing| packing.tiled_scene(Law::History, copies))
}

impl Bed {
    /// Builds a scene on some threads.
    ///
    /// # Errors
    ///
    /// Words, if the scene or the threads cannot be made.
    pub fn build(scene: &Scene, threads: usize) -> Result<Bed, String> {
        let threads = ThreadPoolBuilder::new().num_threads(threads).build().map_err(|error| error.to_string())?;
        let simulation = threads.install(|| scene.build()).map_err(|error| error.to_string())?;
        Ok(Bed { spheres: simulation.bodies().len(), simulation, threads })
    }

    /// Takes some steps and says what they cost.
    pub fn step(&mut self, steps: usize) -> Time {
        let simulation = &mut self.simulation;
        self.threads.install(|| {
            let (cpu, wall) = (ThreadTime::now(), Instant::now());
            (0..steps).for_each(|_| simulation.step());
            Time { cpu_s: cpu.elapsed().as_secs_f64(), wall_s: wall.elapsed().as_secs_f64() }
        })
    }

    /// A work count of the ledger, over all steps so far.
    pub fn work(&self, name: &str) -> u64 {
        self.simulation.ledger().total_work().get(name).copied().unwrap_or(0)
    }

    /// Whether every position and velocity is the same, to the bit, as in another.
    pub fn is_same(&self, other: &Bed) -> bool {
        let (one, other) = (self.simulation.bodies(), other.simulation.bodies());
        one.by_id().zip(other.by_id()).all(|(one_place, other_place)| {
            let velocity = one.half_step_velocity(one_place) == other.half_step_velocity(other_place);
            velocity && one.position(one_place) == other.position(other_place)
        })
    }
}

/// Sets a bed into a flow along x whose speed rises from the floor to a largest one in m/s at the top.
pub fn sheared(mut scene: Scene, speed: f64) -> Scene {
    let top = scene.bodies.iter().map(|body| body.position[2]).fold(0.0, f64::max);
    for body in &mut scene.bodies {
        body.velocity[0] += speed * body.position[2] / top;
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_do_not_change_the_answer() {
        let scene = scene([2, 2]).expect("the file is a packing");
        let mut beds = [1, 2].map(|threads| Bed::build(&scene, threads).expect("the bed builds"));
        beds.iter_mut().for_each(|bed| assert!(bed.step(20).wall_s > 0.0));
        assert!(beds[0].is_same(&beds[1]));
        assert!(beds[0].work("contacts") > 20 * 8000, "two contacts a sphere");
        beds[1].step(1);
        assert!(!beds[0].is_same(&beds[1]));
    }

    #[test]
    fn a_flow_makes_lists_and_a_settled_bed_does_not() {
        let scene = scene([1, 1]).expect("the file is a packing");
        let lists_of = |scene: &Scene| {
            let mut bed = Bed::build(scene, 1).expect("the bed builds");
            bed.step(200);
            bed.work("lists")
        };
        assert_eq!(lists_of(&scene), 1);
        assert!(lists_of(&sheared(scene, 2.0)) > 2);
    }
}
