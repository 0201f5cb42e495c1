//! The bodies of a run as a scene lists them, so that another run can start where this one is.

use std::collections::{BTreeMap, HashMap};

use crate::Simulation;
use crate::scene::{Body, Geometry, NamedShape, SphereGeometry, identity};

/// Shapes and bodies as tables of a scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tables {
    /// Shapes that the scene of the run does not name: spheres that were inserted in sizes of their own.
    pub shapes: Vec<NamedShape>,
    /// All bodies, by id: places, turns and velocities of the same instant.
    pub bodies: Vec<Body>,
}

impl Simulation {
    /// Its bodies as tables. What contacts remember is not in them: springs of friction begin anew.
    pub fn as_tables(&mut self) -> Tables {
        let id_of = |(place, body): (usize, &Body)| (body.id.unwrap_or(place as u32), body.clone());
        let listed: HashMap<u32, Body> = self.scene.bodies.iter().enumerate().map(id_of).collect();
        let (names, materials) = (self.shape_names.clone(), self.scene.materials.clone());
        let now = self.now();
        let bodies = now.bodies();
        let (mut shapes, mut tables) = (BTreeMap::new(), Tables::default());
        for index in bodies.by_id() {
            let (id, sphere) = (bodies.id(index), bodies.shape(index).as_sphere());
            let table = listed.get(&id).cloned().unwrap_or_else(|| {
                let radius = sphere.map_or(f64::NAN, |sphere| sphere.radius);
                let name = names[bodies.shape_index(index)].clone().unwrap_or_else(|| {
                    let name = format!("sphere of radius {radius:?} m");
                    shapes.insert(name.clone(), radius);
                    name
                });
                Body::new(&name, &materials[bodies.material(index)].name)
            });
            let orientation = now.orientation(index);
            tables.bodies.push(Body {
                id: Some(id),
                position: now.position(index).into(),
                velocity: now.velocity(index).into(),
                // Spheres keep none unless somebody looks.
                orientation: if sphere.is_some() { identity() } else { [orientation.w, orientation.i, orientation.j, orientation.k] },
                angular_velocity: now.angular_velocity(index).into(),
                ..table
            });
        }
        let sphere = |(name, radius)| NamedShape { name, geometry: Geometry::Sphere(SphereGeometry { radius }) };
        tables.shapes = shapes.into_iter().map(sphere).collect();
        tables
    }
}
