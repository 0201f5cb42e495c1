//! Settled packings: a scene is run until its bodies are at rest, once, and every scene that starts from that rest shares it.
//!
//! A packing is known by its scene, which holds the random seed, and by the source of the solver. What is made is kept in memory; the command line also
//! installs a [`Store`] on disk. With and without a store the same bits come out: numbers are written exactly, and what was damaged is made anew.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, LazyLock, Mutex, OnceLock, PoisonError};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use solver::Scene;
use solver::scene::{Body, NamedShape};

use crate::case::Failure;

/// Bodies at rest, and what it took to bring them there.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Packing {
    /// Shapes that the scene does not name.
    pub shapes: Vec<NamedShape>,
    /// The bodies.
    pub bodies: Vec<Body>,
    /// When they had settled, in s.
    pub time: f64,
    /// Work counts of the run.
    pub work: BTreeMap<String, u64>,
}

/// A place that texts are kept in from one process to the next.
pub trait Store: Send + Sync {
    /// What is kept under a key.
    fn load(&self, key: &str) -> Option<String>;
    /// Keeps a text under a key, whole or not at all; a store that cannot may leave it.
    fn save(&self, key: &str, text: &str);
}

static STORE: OnceLock<Box<dyn Store>> = OnceLock::new();
static MADE: LazyLock<Mutex<HashMap<String, Arc<Packing>>>> = LazyLock::new(Mutex::default);

/// Installs the store of this process; only the first one counts.
pub fn install_store(store: Box<dyn Store>) {
    // A second store would be no error to anybody: the first goes on.
    let _ = STORE.set(store);
}

impl Packing {
    /// The packing that a scene settles to: from memory, from the store, or by running the scene.
    ///
    /// # Errors
    ///
    /// The scene is refused, a guard stops it, or its end comes before rest.
    pub fn of(scene: &Scene) -> Result<Arc<Packing>, Failure> {
        let key = key_of(scene)?;
        // The lock is not held while the scene runs: who waits for it might be what its threads wait for.
        if let Some(known) = MADE.lock().unwrap_or_else(PoisonError::into_inner).get(&key) {
            return Ok(known.clone());
        }
        let packing = Arc::new(match STORE.get() {
            Some(store) => Packing::through(store.as_ref(), &key, scene)?,
            None => Packing::settle(scene)?,
        });
        MADE.lock().unwrap_or_else(PoisonError::into_inner).insert(key, packing.clone());
        Ok(packing)
    }

    /// What a store keeps, if it is sound; otherwise the scene is run and the store is given what comes out.
    fn through(store: &dyn Store, key: &str, scene: &Scene) -> Result<Packing, Failure> {
        if let Some(packing) = store.load(key).as_deref().and_then(read) {
            return Ok(packing);
        }
        let packing = Packing::settle(scene)?;
        if let Ok(text) = write(&packing) {
            store.save(key, &text);
        }
        Ok(packing)
    }

    /// Runs a scene until its bodies have settled.
    fn settle(scene: &Scene) -> Result<Packing, Failure> {
        let mut simulation = scene.build()?;
        simulation.run_until(scene.scene.end_time)?;
        if !simulation.has_settled() {
            let (name, time) = (&scene.scene.name, scene.scene.end_time);
            return Err(Failure::NothingMeasured(format!("`{name}` has not settled within {time} s")));
        }
        let tables = simulation.as_tables();
        let work = simulation.ledger().total_work();
        Ok(Packing { shapes: tables.shapes, bodies: tables.bodies, time: simulation.time(), work })
    }

    /// Lets a scene start with these bodies in place of its own and of its insertions.
    pub fn start(&self, scene: &mut Scene) {
        scene.shapes.extend(self.shapes.iter().cloned());
        scene.bodies.clone_from(&self.bodies);
        scene.insertions.clear();
        scene.numerics.initial_overlap = solver::scene::InitialOverlap::Allow;
        scene.scene.settled = None;
    }
}

/// What a packing is known by.
fn key_of(scene: &Scene) -> Result<String, Failure> {
    let text = serde_json::to_string(scene).map_err(|error| Failure::NothingMeasured(format!("a scene without a text: {error}")))?;
    Ok(hash_of(&format!("{}\n{}\n{text}", env!("CARGO_PKG_VERSION"), solver::FINGERPRINT)))
}

fn hash_of(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A packing as text: a line with the hash of the rest, and the rest.
fn write(packing: &Packing) -> Result<String, serde_json::Error> {
    let text = serde_json::to_string(packing)?;
    Ok(format!("{}\n{text}", hash_of(&text)))
}

/// The packing that a text holds; `None` if it was damaged.
fn read(text: &str) -> Option<Packing> {
    let (hash, text) = text.split_once('\n')?;
    serde_json::from_str(text).ok().filter(|_| hash == hash_of(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten balls of several sizes that fall into a box; `seed` tells tests apart that share the memory of the process.
    fn scene(seed: u64) -> Scene {
        let text = format!(
            r#"
scene = {{ name = "heap", gravity = [0.0, 0.0, -9.81], end_time = 5.0, random_seed = {seed}, settled = {{ speed = 5e-3, hold = 0.05 }} }}
material = [{{ name = "glass", density = 2500.0 }}]
shape = [{{ name = "ball", geometry = {{ sphere = {{ radius = 0.005 }} }} }}, {{ name = "brick", geometry = {{ cuboid = {{ lengths = [0.006, 0.008, 0.01] }} }} }}]
boundary = [{{ name = "box", material = "glass", geometry = {{ box = {{ lower = [0.0, 0.0, 0.0], upper = [0.03, 0.03, 0.2] }} }} }}]
numerics = {{ step = 5e-5 }}

[[pair]]
materials = ["glass", "glass"]
normal = {{ linear_spring_dashpot = {{ stiffness = 300.0, restitution = 0.3 }} }}
tangential = {{ linear_history = {{ friction = 0.5, stiffness = 100.0 }} }}

[[insertion]]
name = "cloud"
material = "glass"
number = 10
shapes = [{{ shape = "ball", fraction = 4.0, scale = [0.6, 1.0] }}, {{ shape = "brick" }}]
region = {{ box = {{ lower = [0.01, 0.01, 0.01], upper = [0.02, 0.02, 0.1] }} }}
"#
        );
        Scene::from_toml(&text, "heap.toml").expect("a scene")
    }

    /// A store in memory that counts.
    #[derive(Default)]
    struct Shelf {
        texts: Mutex<HashMap<String, String>>,
        saves: Mutex<u32>,
    }

    impl Store for Shelf {
        fn load(&self, key: &str) -> Option<String> {
            self.texts.lock().expect("one thread").get(key).cloned()
        }
        fn save(&self, key: &str, text: &str) {
            self.texts.lock().expect("one thread").insert(key.into(), text.into());
            *self.saves.lock().expect("one thread") += 1;
        }
    }

    #[test]
    fn the_same_bits_come_from_a_run_from_memory_and_from_a_store() {
        let (scene, shelf) = (scene(1), Shelf::default());
        let made = Packing::of(&scene).expect("it settles");
        assert!(made.bodies.len() == 10 && !made.shapes.is_empty() && made.time > 0.05);
        assert!(Arc::ptr_eq(&made, &Packing::of(&scene).expect("it is known")));
        let through = || Packing::through(&shelf, "key", &scene).expect("it settles");
        assert!(through() == *made && through() == *made);
        assert_eq!(*shelf.saves.lock().expect("one thread"), 1, "the second came from the store");
    }

    #[test]
    fn what_was_damaged_is_made_anew() {
        let (scene, shelf) = (scene(2), Shelf::default());
        let made = Packing::through(&shelf, "key", &scene).expect("it settles");
        let sound = shelf.load("key").expect("it was saved");
        let digit = sound.rfind(|sign: char| sign.is_ascii_digit()).expect("numbers");
        let other = if &sound[digit..=digit] == "7" { "8" } else { "7" };
        let changed = format!("{}{other}{}", &sound[..digit], &sound[digit + 1..]);
        for damaged in [changed.as_str(), &sound[..sound.len() / 2], "", "\n{}"] {
            shelf.texts.lock().expect("one thread").insert("key".into(), damaged.into());
            assert!(Packing::through(&shelf, "key", &scene).expect("it settles") == made);
            assert_eq!(shelf.load("key").as_deref(), Some(sound.as_str()), "the sound text is back");
        }
    }

    #[test]
    fn packings_are_told_apart_by_whatever_is_in_the_scene() {
        let key = |change: fn(&mut Scene)| {
            let mut scene = scene(3);
            change(&mut scene);
            key_of(&scene).expect("a text")
        };
        let keys =
            [key(|_| {}), key(|scene| scene.scene.random_seed = 4), key(|scene| scene.materials[0].density = Some(2500.0000000000005))];
        assert!(keys[0] != keys[1] && keys[0] != keys[2] && keys[0] == key(|_| {}));
    }

    /// Started from its packing, the heap stays where it is.
    #[test]
    fn a_scene_that_starts_from_a_packing_is_at_rest() {
        let mut scene = scene(5);
        let packing = Packing::of(&scene).expect("it settles");
        packing.start(&mut scene);
        let mut simulation = scene.build().expect("a scene");
        simulation.run_until(0.1).expect("no guard stops this run");
        for (index, body) in packing.bodies.iter().enumerate() {
            let moved = (simulation.bodies().position(index) - solver::Vector::from(body.position)).norm();
            // At rest is slower than 5 mm/s: a body that rolls on goes half a millimetre in the time, and one whose spring of friction starts anew gives way by less.
            assert!(moved < 1e-3, "{moved}");
        }
    }

    #[test]
    fn a_scene_that_does_not_settle_says_so() {
        let mut scene = scene(6);
        scene.scene.end_time = 0.05;
        let error = Packing::of(&scene).expect_err("it is still falling").to_string();
        assert!(error.contains("`heap` has not settled within 0.05 s"), "{error}");
    }
}
