//! Checks that need no simulation: finite numbers in their ranges, names that exist, ids that are unique.

use std::collections::BTreeSet;

use super::hard_checks;
use super::load::nearest;
use super::validate_laws::check_laws;
use super::{Body, CompositeGeometry, Geometry, Scene, SceneError, SceneErrorKind, Step, SuperellipsoidGeometry};

pub(super) type Check = Result<(), SceneError>;

/// Above it, a number of steps times the step is no longer a time that differs from the one before.
const LARGEST_NUMBER_OF_STEPS: f64 = 9_007_199_254_740_992.0;

impl Scene {
    /// Checks everything about a scene that can be checked without building it.
    ///
    /// # Errors
    ///
    /// The first fault found, with the path of its key.
    pub fn validate(&self) -> Check {
        self.check_general()?;
        self.check_materials()?;
        self.check_shapes()?;
        for (index, body) in self.bodies.iter().enumerate() {
            self.check_body(&format!("body[{index}]"), body)?;
        }
        self.check_ids()?;
        self.check_boundaries()?;
        self.check_insertions()?;
        self.check_outlets()?;
        self.check_pairs()?;
        self.check_numerics()?;
        self.check_domain()?;
        super::flow::check(self)?;
        self.check_probes()?;
        if self.bodies.is_empty() && self.insertions.is_empty() && self.fluid.is_none() {
            let message = "the scene is empty: it needs at least one [[body]], [[insertion]] or [fluid]";
            return Err(SceneError::new(SceneErrorKind::Empty, "body", message));
        }
        Ok(())
    }

    fn check_general(&self) -> Check {
        positive("scene.end_time", self.scene.end_time, "s")?;
        if let Some(gravity) = &self.scene.gravity {
            finite_all("scene.gravity", gravity)?;
        }
        if let Some(settled) = &self.scene.settled {
            positive("scene.settled.speed", settled.speed, "m/s")?;
            positive("scene.settled.hold", settled.hold, "s")?;
        }
        for (key, interval) in [
            ("output.probe_interval", self.output.probe_interval),
            ("output.vtk_interval", self.output.vtk_interval),
            ("output.checkpoint_interval", self.output.checkpoint_interval),
        ] {
            interval.map_or(Ok(()), |interval| positive(key, interval, "s"))?;
        }
        Ok(())
    }

    fn check_materials(&self) -> Check {
        unique("material", self.materials.iter().map(|material| material.name.as_str()))?;
        for (index, material) in self.materials.iter().enumerate() {
            if let Some(density) = material.density {
                positive(&format!("material[{index}].density"), density, "kg/m^3")?;
            }
        }
        Ok(())
    }

    fn check_shapes(&self) -> Check {
        unique("shape", self.shapes.iter().map(|shape| shape.name.as_str()))?;
        for (index, shape) in self.shapes.iter().enumerate() {
            let key = format!("shape[{index}].geometry.{}", shape.geometry.name());
            self.check_geometry(&key, &shape.geometry)?;
        }
        Ok(())
    }

    fn check_geometry(&self, key: &str, geometry: &Geometry) -> Check {
        let length = |name: &str, value: f64| positive(&format!("{key}.{name}"), value, "m");
        match geometry {
            Geometry::Sphere(sphere) => length("radius", sphere.radius),
            Geometry::Cuboid(cuboid) => cuboid.lengths.iter().try_for_each(|value| length("lengths", *value)),
            Geometry::Cylinder(rod) | Geometry::Spherocylinder(rod) => length("radius", rod.radius).and(length("length", rod.length)),
            Geometry::Tetrahedron(regular) | Geometry::Octahedron(regular) | Geometry::Icosahedron(regular) => length("edge", regular.edge),
            Geometry::Polyhedron(polyhedron) => finite_all(&format!("{key}.vertices"), polyhedron.vertices.as_flattened()),
            Geometry::Hull(hull) => finite_all(&format!("{key}.points"), hull.points.as_flattened()),
            Geometry::Superellipsoid(shape) => check_superellipsoid(key, shape),
            Geometry::Trilobe(lobes) | Geometry::Quadralobe(lobes) => {
                length("diameter", lobes.diameter).and(length("length", lobes.length))
            }
            Geometry::CrossInPlane(rod) | Geometry::CrossInSpace(rod) => {
                length("radius", rod.radius).and(length("length", rod.length))?;
                if rod.length >= 2.0 * rod.radius {
                    return Ok(());
                }
                Err(out_of_range(
                    &format!("{key}.length"),
                    rod.length,
                    &format!("at least the diameter of the rods, {} m", 2.0 * rod.radius),
                ))
            }
            Geometry::Composite(composite) => self.check_composite(key, composite),
        }
    }

    fn check_composite(&self, key: &str, composite: &CompositeGeometry) -> Check {
        if composite.parts.is_empty() {
            return Err(SceneError::new(SceneErrorKind::Empty, format!("{key}.parts"), "a composite needs at least one part"));
        }
        if let Some(given) = &composite.mass_properties {
            positive(&format!("{key}.mass_properties.volume"), given.volume, "m^3")?;
            for value in given.mean_squares {
                positive(&format!("{key}.mass_properties.mean_squares"), value, "m^2")?;
            }
        }
        for (index, part) in composite.parts.iter().enumerate() {
            let key = format!("{key}.parts[{index}]");
            known(&format!("{key}.shape"), "[[shape]]", &part.shape, self.shapes.iter().map(|shape| shape.name.as_str()))?;
            finite_all(&format!("{key}.position"), &part.position)?;
            direction(&format!("{key}.orientation"), &part.orientation)?;
            let glued = self.shapes.iter().find(|shape| shape.name == part.shape).filter(|shape| !shape.geometry.is_convex());
            if let Some(shape) = glued {
                let message = format!("`{}` is a {}, which is not convex: give its parts instead", shape.name, shape.geometry.name());
                return Err(SceneError::new(SceneErrorKind::Combination, format!("{key}.shape"), message));
            }
        }
        Ok(())
    }

    fn check_body(&self, key: &str, body: &Body) -> Check {
        known(&format!("{key}.shape"), "[[shape]]", &body.shape, self.shapes.iter().map(|shape| shape.name.as_str()))?;
        self.check_material(&format!("{key}.material"), &body.material)?;
        finite_all(&format!("{key}.position"), &body.position)?;
        finite_all(&format!("{key}.velocity"), &body.velocity)?;
        finite_all(&format!("{key}.angular_velocity"), &body.angular_velocity)?;
        direction(&format!("{key}.orientation"), &body.orientation)?;
        if let Some(inertia) = &body.principal_inertia {
            check_inertia(&format!("{key}.principal_inertia"), inertia)?;
        }
        let density = self.materials.iter().find(|material| material.name == body.material).and_then(|material| material.density);
        match (body.mass, density) {
            (Some(mass), _) => positive(&format!("{key}.mass"), mass, "kg"),
            (None, Some(_)) => Ok(()),
            (None, None) => Err(SceneError::new(
                SceneErrorKind::Combination,
                format!("{key}.mass"),
                format!("missing: material `{}` has no density, so the body needs a mass in kg", body.material),
            )),
        }
    }

    fn check_material(&self, key: &str, name: &str) -> Check {
        known(key, "[[material]]", name, self.materials.iter().map(|material| material.name.as_str()))
    }

    fn check_ids(&self) -> Check {
        let mut seen = BTreeSet::new();
        for (index, body) in self.bodies.iter().enumerate() {
            let id = body.id.unwrap_or(index as u32);
            if !seen.insert(id) {
                return Err(SceneError::new(
                    SceneErrorKind::Reference,
                    format!("body[{index}].id"),
                    format!("id {id} is used twice (a body without id takes its position in the file)"),
                ));
            }
        }
        Ok(())
    }

    fn check_boundaries(&self) -> Check {
        unique("boundary", self.boundaries.iter().map(|boundary| boundary.name.as_str()))?;
        for (index, boundary) in self.boundaries.iter().enumerate() {
            self.check_material(&format!("boundary[{index}].material"), &boundary.material)?;
            super::boundary::check(&format!("boundary[{index}]"), boundary)?;
        }
        Ok(())
    }

    fn check_insertions(&self) -> Check {
        unique("insertion", self.insertions.iter().map(|insertion| insertion.name.as_str()))?;
        self.insertions
            .iter()
            .enumerate()
            .try_for_each(|(index, insertion)| super::insertion::check(self, &format!("insertion[{index}]"), insertion))
    }

    fn check_outlets(&self) -> Check {
        unique("outlet", self.outlets.iter().map(|outlet| outlet.name.as_str()))?;
        let check = |(index, outlet)| super::outlet::check(&format!("outlet[{index}]"), outlet);
        self.outlets.iter().enumerate().try_for_each(check)
    }

    fn check_pairs(&self) -> Check {
        let mut seen = BTreeSet::new();
        for (index, pair) in self.pairs.iter().enumerate() {
            let key = format!("pair[{index}]");
            for name in &pair.materials {
                self.check_material(&format!("{key}.materials"), name)?;
            }
            let mut names = pair.materials.clone();
            names.sort();
            if !seen.insert(names) {
                let message = format!("the pair `{}` and `{}` is given twice", pair.materials[0], pair.materials[1]);
                return Err(SceneError::new(SceneErrorKind::Reference, format!("{key}.materials"), message));
            }
            check_laws(&key, pair)?;
        }
        hard_checks::check_together(self)
    }

    fn check_domain(&self) -> Check {
        if let Some(skin) = self.numerics.neighbours.skin {
            positive("numerics.neighbours.skin", skin, "m")?;
        }
        let Some(domain) = &self.domain else { return Ok(()) };
        finite_all("domain.lower", &domain.lower)?;
        finite_all("domain.upper", &domain.upper)?;
        for axis in 0..3 {
            if domain.upper[axis] <= domain.lower[axis] {
                let allowed = format!("above domain.lower, {}, in every direction", domain.lower[axis]);
                return Err(out_of_range("domain.upper", domain.upper[axis], &allowed));
            }
        }
        Ok(())
    }

    fn check_numerics(&self) -> Check {
        if let Step::Seconds(step) = self.numerics.step {
            positive("numerics.step", step, "s")?;
        }
        let steps = self.numerics.steps_per_contact.0;
        if !(steps.is_finite() && steps >= 1.0) {
            return Err(out_of_range("numerics.steps_per_contact", steps, "a finite number of at least 1"));
        }
        let vertices = self.numerics.shaped_contact.vertices;
        if !VERTICES_IN_EACH_ANGLE.contains(&vertices) {
            return Err(out_of_range("numerics.shaped_contact.vertices", f64::from(vertices), "from 4 to 1000 in each angle"));
        }
        let crust = self.numerics.shaped_contact.crust;
        if !(crust > 0.0 && crust < 1.0) {
            return Err(out_of_range(
                "numerics.shaped_contact.crust",
                crust,
                "a number above 0 and below 1, a part of the size of a shape",
            ));
        }
        Ok(())
    }

    /// Refuses a run of so many steps that they could no longer be counted exactly, let alone taken.
    pub(crate) fn check_number_of_steps(&self, step: f64) -> Check {
        let steps = self.scene.end_time / step;
        if steps <= LARGEST_NUMBER_OF_STEPS {
            return Ok(());
        }
        let message = format!("{} s are {steps:e} steps of {step:e} s; at most 2^53 can be counted", self.scene.end_time);
        Err(SceneError::new(SceneErrorKind::Combination, "scene.end_time", message))
    }

    fn check_probes(&self) -> Check {
        for (index, probe) in self.probes.iter().enumerate() {
            let refuse = |key: &str, kind, message: &str| Err(SceneError::new(kind, format!("probe[{index}].{key}"), message));
            if self.probes[..index].contains(probe) {
                return refuse("measure", SceneErrorKind::Reference, "this probe is given twice");
            }
            if probe.measure.needs_fluid() && self.fluid.is_none() {
                return refuse("measure", SceneErrorKind::Combination, "this measure is of a fluid, and the scene has no [fluid]");
            }
            let Some(id) = probe.body else { continue };
            if !probe.measure.is_of_one_body() {
                return refuse("body", SceneErrorKind::Combination, "this measure is of all bodies together: leave `body` out");
            }
            let exists = self.bodies.iter().enumerate().any(|(place, body)| body.id.unwrap_or(place as u32) == id);
            if !exists {
                let message = format!("there is no body with id {id}");
                return Err(SceneError::new(SceneErrorKind::Reference, format!("probe[{index}].body"), message));
            }
        }
        Ok(())
    }
}

/// Moments of a real body: positive, and none above the sum of the other two (equal for a flat one).
fn check_inertia(key: &str, inertia: &[f64; 3]) -> Check {
    for moment in inertia {
        positive(key, *moment, "kg m^2")?;
    }
    let largest = inertia.iter().copied().fold(0.0, f64::max);
    if largest > (inertia.iter().sum::<f64>() - largest) * (1.0 + 4.0 * f64::EPSILON) {
        let message = format!("{largest} is above the sum of the other two moments: no body has such inertia");
        return Err(SceneError::new(SceneErrorKind::Value, key, message));
    }
    Ok(())
}

/// Vertices in each angle: fewer enclose no volume, more take longer than any continuous surface.
const VERTICES_IN_EACH_ANGLE: std::ops::RangeInclusive<u32> = 4..=1000;

fn check_superellipsoid(key: &str, shape: &SuperellipsoidGeometry) -> Check {
    shape.semi_axes.iter().try_for_each(|axis| positive(&format!("{key}.semi_axes"), *axis, "m"))?;
    if let Some(exponent) = shape.exponents.iter().find(|exponent| !(**exponent > 0.0 && **exponent <= 2.0)) {
        let allowed = "above 0 and at most 2: beyond, the shape is not convex";
        return Err(out_of_range(&format!("{key}.exponents"), *exponent, allowed));
    }
    Ok(())
}

pub(super) fn out_of_range(key: &str, value: f64, allowed: &str) -> SceneError {
    SceneError::new(SceneErrorKind::Value, key, format!("{value} is not {allowed}"))
}

pub(super) fn positive(key: &str, value: f64, unit: &str) -> Check {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(out_of_range(key, value, &format!("a finite number above 0 ({unit})")))
}

pub(super) fn not_negative(key: &str, value: f64) -> Check {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(out_of_range(key, value, "a finite number of at least 0"))
}

pub(super) fn finite_all(key: &str, values: &[f64]) -> Check {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(out_of_range(key, *value, "a finite number")),
        None => Ok(()),
    }
}

/// A direction or quaternion: finite, and long enough to be normalised.
pub(super) fn direction(key: &str, values: &[f64]) -> Check {
    finite_all(key, values)?;
    let length = values.iter().map(|value| value * value).sum::<f64>().sqrt();
    if length.is_finite() && length > f64::MIN_POSITIVE.sqrt() {
        return Ok(());
    }
    Err(SceneError::new(SceneErrorKind::Value, key, "has no direction: its length must be above zero and finite"))
}

fn unique<'a>(table: &str, names: impl Iterator<Item = &'a str>) -> Check {
    let mut seen = BTreeSet::new();
    for (index, name) in names.enumerate() {
        if !seen.insert(name) {
            let message = format!("the name `{name}` is used twice");
            return Err(SceneError::new(SceneErrorKind::Reference, format!("{table}[{index}].name"), message));
        }
    }
    Ok(())
}

pub(super) fn known<'a>(key: &str, table: &str, name: &str, names: impl Iterator<Item = &'a str> + Clone) -> Check {
    if names.clone().any(|known| known == name) {
        return Ok(());
    }
    let defined = names.clone().map(|known| format!("`{known}`")).collect::<Vec<_>>().join(", ");
    let defined = if defined.is_empty() { "none".to_string() } else { defined };
    let hint = nearest(name, names).map_or(String::new(), |near| format!("; did you mean `{near}`?"));
    let message = format!("`{name}` is not defined in {table} (defined: {defined}){hint}");
    Err(SceneError::new(SceneErrorKind::Reference, key, message))
}
