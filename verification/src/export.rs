//! A case for other codes: scenes, initial states, parameters in both forms, expected values. Text only; files belong to the caller.

use std::collections::BTreeMap;

use reports::Row;
use reports::row::ReferenceKind;
use solver::contact::law::{LinearSpringDashpot, hertz};
use solver::output::{bodies, digits17};
use solver::scene::{self, EndOfContact, NormalLaw, Pair, TangentialLaw};
use solver::{Bodies, Scene, SceneError, Simulation};

use crate::case::{Case, Description, Setup, Tier};
use crate::claim::Statistic;

/// The header of the file that another code comes back with.
pub const COMPARE_COLUMNS: [&str; 9] = ["setup", "quantity", "unit", "knob_name", "knob_value", "value", "cpu_s", "code", "version"];

/// The header of the expected values.
const EXPECTED_COLUMNS: [&str; 10] = [
    "setup",
    "quantity",
    "unit",
    "knob_name",
    "knob_value",
    "expected",
    "reference_kind",
    "reference_uncertainty",
    "bound",
    "bound_reason",
];

/// One file of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportFile {
    /// Path relative to the folder of the export, with forward slashes.
    pub path: String,
    /// The whole text.
    pub content: String,
}

/// Why a case cannot be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A scene of the case does not build.
    #[error("setup `{setup}`: {error}")]
    Scene {
        /// The setup.
        setup: String,
        /// Why its scene is refused.
        error: SceneError,
    },
    /// A scene cannot be written as TOML.
    #[error("setup `{setup}`: {error}")]
    Text {
        /// The setup.
        setup: String,
        /// What the writer said.
        error: toml::ser::Error,
    },
    /// A table cannot be written as CSV.
    #[error("{0}")]
    Table(String),
}

/// The files of a case: one folder per setup with its scene and initial state at a knob value of the tier, that nearest to the headline's, and
/// on top the tables of parameters and of expected values, the latter from the rows of a study.
///
/// # Errors
///
/// [`ExportError`] if a scene of the case does not build.
pub fn export(case: &dyn Case, tier: Tier, rows: &[Row]) -> Result<Vec<ExportFile>, ExportError> {
    let description = case.description();
    let mut files = Vec::new();
    let mut parameters = vec![["setup", "contact", "parameter", "value", "unit"].map(String::from).to_vec()];
    for setup in &description.setups {
        let knob = knob_of(&description, tier, setup);
        let Some(scene) = case.scene(setup, knob) else { continue };
        let simulation = initial_state(&scene).map_err(|error| ExportError::Scene { setup: setup.label.clone(), error })?;
        let folder = folder_of(setup);
        let text = toml::to_string(&scene).map_err(|error| ExportError::Text { setup: setup.label.clone(), error })?;
        files.push(ExportFile { path: format!("{folder}/scene.toml"), content: text });
        parameters.extend(parameters_of(setup, [(description.knob.name)(setup), &digits17(knob)], &scene, &simulation));
        files.push(ExportFile { path: format!("{folder}/bodies.csv"), content: bodies_table(simulation)? });
    }
    let has_scenes = !files.is_empty();
    if has_scenes {
        files.push(ExportFile { path: "parameters.csv".into(), content: table(&parameters)? });
    }
    files.push(ExportFile { path: "expected.csv".into(), content: table(&expected_lines(rows))? });
    files.push(ExportFile { path: "template.csv".into(), content: table(&template_lines(rows))? });
    files.push(ExportFile { path: "README.md".into(), content: readme(&description, has_scenes) });
    Ok(files)
}

/// The knob value of a setup that is nearest to the headline's, at its tier, or at the standard one if it has none.
fn knob_of(description: &Description, tier: Tier, setup: &Setup) -> f64 {
    let headline = description.headline.knob;
    let distance = |knob: &f64| (knob - headline).abs();
    let nearest =
        |tier| (description.knob.values)(tier, setup).into_iter().min_by(|left, right| distance(left).total_cmp(&distance(right)));
    nearest(tier).or_else(|| nearest(Tier::Standard)).unwrap_or(headline)
}

/// The simulation before its first step, with all orientations known, those of spheres too.
fn initial_state(scene: &Scene) -> Result<Simulation, SceneError> {
    let mut scene = scene.clone();
    scene.output.sphere_orientation = true;
    scene.build()
}

fn bodies_table(mut simulation: Simulation) -> Result<String, ExportError> {
    let mut content = Vec::new();
    bodies::write(&mut simulation, &mut content).map_err(|error| ExportError::Table(error.to_string()))?;
    Ok(String::from_utf8_lossy(&content).into_owned())
}

fn folder_of(setup: &Setup) -> String {
    format!("{:02}_{}", setup.index, slug(&setup.label))
}

/// A name in lower-case letters, digits and underscores, of at most sixty signs.
pub fn slug(name: &str) -> String {
    let mut slug = String::new();
    for sign in name.chars().flat_map(char::to_lowercase) {
        if sign.is_ascii_alphanumeric() {
            slug.push(sign);
        } else if !slug.is_empty() && !slug.ends_with('_') {
            slug.push('_');
        }
    }
    slug.truncate(60);
    slug.trim_end_matches('_').to_string()
}

/// Lines of parameters.csv for one setup: general ones, then those of each kind of contact.
fn parameters_of(setup: &Setup, knob: [&str; 2], scene: &Scene, simulation: &Simulation) -> Vec<Vec<String>> {
    let mut lines = Vec::new();
    let mut add = |contact: &str, parameter: &str, value: String, unit: &str| {
        lines.push([&setup.label, contact, parameter, value.as_str(), unit].map(String::from).to_vec());
    };
    add("", knob[0], knob[1].to_string(), "1");
    add("", "time_step", digits17(simulation.time_step()), "s");
    add("", "end_time", digits17(scene.scene.end_time), "s");
    for (component, gravity) in ["x", "y", "z"].iter().zip(scene.scene.gravity.unwrap_or_default()) {
        add("", &format!("gravity_{component}"), digits17(gravity), "m/s^2");
    }
    for contact in contact_kinds(scene, simulation.bodies()) {
        for (parameter, value, unit) in contact.parameters() {
            add(&contact.name, parameter, value, unit);
        }
    }
    lines
}

/// A kind of contact of a scene: two partners that differ from others in shape or mass, and the laws between them.
struct ContactKind<'a> {
    name: String,
    pair: &'a Pair,
    reduced_mass: f64,
    /// Effective mass of the contact point in the contact plane.
    tangential_mass: f64,
}

/// One partner of a contact: a class of bodies of the same shape and mass, or a wall.
struct Partner {
    name: String,
    inverse_mass: f64,
    /// Square of the lever arm of a tangential force over the moment of inertia.
    inverse_turning_mass: f64,
    /// Bodies of the class; none for a wall.
    bodies: usize,
}

fn contact_kinds<'a>(scene: &'a Scene, bodies: &Bodies) -> Vec<ContactKind<'a>> {
    let mut kinds = Vec::new();
    for pair in &scene.pairs {
        let [one, other] = [0, 1].map(|side| partners(scene, bodies, &pair.materials[side]));
        let is_like_on_like = pair.materials[0] == pair.materials[1];
        for (place, first) in one.iter().enumerate() {
            let begin = if is_like_on_like { place } else { 0 };
            for (place_of_second, second) in other.iter().enumerate().skip(begin) {
                let is_same_class = is_like_on_like && place == place_of_second;
                let walls_only = first.bodies + second.bodies == 0;
                if walls_only || is_same_class && first.bodies == 1 {
                    continue;
                }
                let inverse_mass = first.inverse_mass + second.inverse_mass;
                kinds.push(ContactKind {
                    name: format!("{} on {}", first.name, second.name),
                    pair,
                    reduced_mass: 1.0 / inverse_mass,
                    tangential_mass: 1.0 / (inverse_mass + first.inverse_turning_mass + second.inverse_turning_mass),
                });
            }
        }
    }
    kinds
}

/// Classes of bodies and walls of a material.
fn partners(scene: &Scene, bodies: &Bodies, material: &str) -> Vec<Partner> {
    let mut partners: Vec<Partner> = Vec::new();
    let mut place_of_class = BTreeMap::new();
    for (place, body) in scene.bodies.iter().enumerate().filter(|(_, body)| body.material == material) {
        let id = body.id.unwrap_or(place as u32);
        let Some(index) = bodies.index_of(id) else { continue };
        let mass = bodies.mass(index);
        let place = *place_of_class.entry((body.shape.as_str(), mass.to_bits())).or_insert(partners.len());
        if let Some(known) = partners.get_mut(place) {
            known.bodies += 1;
            continue;
        }
        let lever_arm = bodies.shape(index).bounding_radius();
        partners.push(Partner {
            name: format!("{} ({material}, {mass:.6e} kg)", body.shape),
            inverse_mass: bodies.inverse_mass(index),
            inverse_turning_mass: lever_arm * lever_arm / bodies.inertia(index).x,
            bodies: 1,
        });
    }
    let walls = scene.boundaries.iter().filter(|boundary| boundary.material == material);
    partners.extend(walls.map(|boundary| Partner {
        name: format!("wall {} ({material})", boundary.name),
        inverse_mass: 0.0,
        inverse_turning_mass: 0.0,
        bodies: 0,
    }));
    partners
}

impl ContactKind<'_> {
    /// Name, value and unit of each parameter: the normal law, then friction, then rolling.
    fn parameters(&self) -> Vec<(&'static str, String, &'static str)> {
        let mut parameters = vec![("effective_mass", digits17(self.reduced_mass), "kg")];
        parameters.extend(match &self.pair.normal {
            NormalLaw::LinearSpringDashpot(law) => self.linear_parameters(law),
            NormalLaw::Hertz(law) => hertz_parameters(law),
            NormalLaw::Impulse(law) => vec![("normal_law", "impulse".into(), ""), ("restitution", digits17(law.restitution), "1")],
        });
        parameters.extend(self.tangential_parameters());
        parameters.extend(self.pair.rolling.as_ref().map(rolling_parameters).unwrap_or_default());
        parameters
    }

    /// The linear law as stiffness and restitution, and as stiffness and damping.
    fn linear_parameters(&self, normal: &scene::LinearSpringDashpot) -> Vec<(&'static str, String, &'static str)> {
        let law = LinearSpringDashpot::new(normal.stiffness, normal.restitution, normal.end_of_contact);
        let end = match normal.end_of_contact {
            EndOfContact::ZeroOverlap => "zero_overlap",
            EndOfContact::NoAttraction => "no_attraction",
        };
        let damping = 2.0 * law.damping_ratio() * (normal.stiffness * self.reduced_mass).sqrt();
        vec![
            ("stiffness", digits17(normal.stiffness), "N/m"),
            ("restitution", digits17(normal.restitution), "1"),
            ("damping_coefficient", digits17(damping), "N s/m"),
            ("damping_ratio", digits17(law.damping_ratio()), "1"),
            ("undamped_half_period", digits17(law.half_period(self.reduced_mass)), "s"),
            ("end_of_contact", end.to_string(), ""),
        ]
    }

    fn tangential_parameters(&self) -> Vec<(&'static str, String, &'static str)> {
        match &self.pair.tangential {
            None => vec![("tangential_law", "none".into(), "")],
            Some(TangentialLaw::CoulombImpulse(law)) => vec![
                ("tangential_law", "coulomb_impulse".into(), ""),
                ("dynamic_friction", digits17(law.dynamic_friction), "1"),
                ("static_friction", digits17(law.static_friction.unwrap_or(law.dynamic_friction)), "1"),
            ],
            Some(TangentialLaw::ViscousCoulomb(law)) => vec![
                ("tangential_law", "viscous_coulomb".into(), ""),
                ("friction", digits17(law.friction), "1"),
                ("tangential_damping_rate", digits17(law.damping_rate), "1/s"),
                ("tangential_damping_coefficient", digits17(2.0 * law.damping_rate * self.reduced_mass), "N s/m"),
            ],
            Some(TangentialLaw::LinearHistory(law)) => vec![
                ("tangential_law", "linear_history".into(), ""),
                ("friction", digits17(law.friction), "1"),
                ("tangential_effective_mass", digits17(self.tangential_mass), "kg"),
                ("tangential_stiffness", digits17(law.stiffness), "N/m"),
                ("tangential_damping_ratio", digits17(law.damping_ratio), "1"),
                (
                    "tangential_damping_coefficient",
                    digits17(2.0 * law.damping_ratio * (law.stiffness * self.tangential_mass).sqrt()),
                    "N s/m",
                ),
            ],
            Some(TangentialLaw::ViscousSpring(law)) => vec![
                ("tangential_law", "viscous_spring".into(), ""),
                ("friction", digits17(law.friction), "1"),
                ("tangential_stiffness", digits17(law.stiffness), "N/m"),
            ],
            Some(TangentialLaw::Mindlin(law)) => vec![
                ("tangential_law", "mindlin".into(), ""),
                ("friction", digits17(law.friction), "1"),
                ("tangential_effective_mass", digits17(self.tangential_mass), "kg"),
                ("tangential_damping_ratio", digits17(law.damping_ratio), "1"),
            ],
        }
    }
}

/// Hertz's law as elastic constants of each side and restitution.
fn hertz_parameters(law: &scene::Hertz) -> Vec<(&'static str, String, &'static str)> {
    let sides: Vec<hertz::Elasticity> = std::iter::once(law.first).chain(law.second).collect();
    let mut parameters = vec![
        ("normal_law", "hertz".to_string(), ""),
        ("young_modulus_of_first", digits17(law.first.young_modulus), "Pa"),
        ("poisson_ratio_of_first", digits17(law.first.poisson_ratio), "1"),
    ];
    match &law.second {
        Some(second) => parameters.extend([
            ("young_modulus_of_second", digits17(second.young_modulus), "Pa"),
            ("poisson_ratio_of_second", digits17(second.poisson_ratio), "1"),
        ]),
        None => parameters.push(("second_is_rigid", "yes".to_string(), "")),
    }
    parameters.extend([
        ("effective_modulus", digits17(hertz::effective_modulus(&sides)), "Pa"),
        ("effective_shear_modulus", digits17(hertz::effective_shear_modulus(&sides)), "Pa"),
        ("restitution", digits17(law.restitution), "1"),
        ("end_of_contact", "zero_overlap".to_string(), ""),
    ]);
    parameters
}

fn rolling_parameters(law: &scene::RollingLaw) -> Vec<(&'static str, String, &'static str)> {
    match law {
        scene::RollingLaw::ConstantTorque(law) => {
            vec![("rolling_law", "constant_torque".to_string(), ""), ("rolling_friction", digits17(law.friction), "1")]
        }
        scene::RollingLaw::SpringTorque(law) => vec![
            ("rolling_law", "spring_torque".to_string(), ""),
            ("rolling_friction", digits17(law.friction), "1"),
            ("rolling_stiffness", digits17(law.stiffness), "N m"),
            ("rolling_damping_ratio", digits17(law.damping_ratio), "1"),
        ],
    }
}

/// Whether another code can come back with a value for a row: a median or a single run at a knob value.
fn is_comparable(row: &Row) -> bool {
    let statistic = |kind: Statistic| row.statistic.starts_with(kind.name());
    row.knob.is_some() && row.expected.is_some() && (statistic(Statistic::Median) || statistic(Statistic::Single))
}

/// The five columns that name a number: setup, quantity, unit, knob name, knob value.
fn key_of(row: &Row) -> Vec<String> {
    let knob = row.knob.as_ref();
    let knob = [knob.map_or(String::new(), |knob| knob.name.clone()), knob.map_or(String::new(), |knob| digits17(knob.value))];
    [row.setup.clone(), row.quantity.clone(), row.unit.clone()].into_iter().chain(knob).collect()
}

fn expected_lines(rows: &[Row]) -> Vec<Vec<String>> {
    let number = |value: Option<f64>| value.map_or(String::new(), digits17);
    let line = |row: &Row| {
        let reference = row.reference.as_ref();
        let mut line = key_of(row);
        line.push(number(row.expected));
        line.push(reference.map_or(String::new(), |reference| word(reference.kind)));
        line.push(number(reference.map(|reference| reference.uncertainty)));
        line.push(number(row.bound));
        line.push(row.bound_reason.clone().unwrap_or_default());
        line
    };
    let head = EXPECTED_COLUMNS.map(String::from).to_vec();
    std::iter::once(head).chain(rows.iter().filter(|row| is_comparable(row)).map(line)).collect()
}

/// The word for a kind of reference in rows.
fn word(kind: ReferenceKind) -> String {
    serde_json::to_value(kind).ok().and_then(|word| word.as_str().map(String::from)).unwrap_or_default()
}

fn template_lines(rows: &[Row]) -> Vec<Vec<String>> {
    let line = |row: &Row| {
        let mut line = key_of(row);
        line.resize(COMPARE_COLUMNS.len(), String::new());
        line
    };
    let head = COMPARE_COLUMNS.map(String::from).to_vec();
    std::iter::once(head).chain(rows.iter().filter(|row| is_comparable(row)).map(line)).collect()
}

fn table(lines: &[Vec<String>]) -> Result<String, ExportError> {
    let failed = |error: &dyn std::fmt::Display| ExportError::Table(error.to_string());
    let mut writer = csv::Writer::from_writer(Vec::new());
    for line in lines {
        writer.write_record(line).map_err(|error| failed(&error))?;
    }
    let content = writer.into_inner().map_err(|error| failed(&error))?;
    Ok(String::from_utf8_lossy(&content).into_owned())
}

fn readme(description: &Description, has_scenes: bool) -> String {
    let Description { id, title, question, reference, headline, sample, .. } = description;
    let of_headline = description.setups.iter().find(|setup| setup.label == headline.setup);
    let knob_name = of_headline.map_or("the knob", description.knob.name);
    let scenes = if has_scenes {
        format!(
            "- `<index>_<setup>/scene.toml`: the scene of each setup at {} = {} or the nearest value it is run at; `touchstone scene --keys` explains every key.\n\
             - `<index>_<setup>/bodies.csv`: its initial state. Quaternions (qw, qx, qy, qz) rotate body to world; angular velocity (wx, wy, wz) \
             is in the world frame.\n\
             - `parameters.csv`: the contact laws in both forms, stiffness with restitution and stiffness with damping coefficient and \
             damping ratio, for each pair of bodies and walls that differ.\n",
            knob_name, headline.knob
        )
    } else {
        String::new()
    };
    format!(
        "# {title}\n\n{question}\n\nAll numbers are in SI units. Reference: {reference}\n\n## Files\n\n{scenes}\
         - `expected.csv`: what each quantity should be, how well that is known, and the largest error that is allowed where a claim is made.\n\
         - `template.csv`: the table to fill in.\n\n\
         ## How to come back\n\n\
         1. Run the setups that your code can do, at the values of the knob (`{}`, where `knob_name` tells nothing else) that you like. Where a case takes the median over many samples \
         ({sample}s), do the same if you can: a single sample may be lucky.\n\
         2. In `template.csv` fill in `value`, `code` and `version`, and `cpu_s` (CPU seconds of the run) if you have it. Lines whose value \
         stays empty are passed over.\n\
         3. `touchstone compare {id} template.csv` holds your values against the claims and puts them on the page of the case.\n",
        knob_name
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CASES;
    use crate::study::{self, Context};

    #[test]
    fn slugs_are_plain_file_names() {
        assert_eq!(slug("e=0.85, until zero overlap"), "e_0_85_until_zero_overlap");
        assert_eq!(slug("__A  b__"), "a_b");
        assert!(slug(&"x ".repeat(100)).len() <= 60);
    }

    /// Every case can be exported, and its scenes read back as the same scenes.
    #[test]
    fn every_case_is_exported_and_its_scenes_read_back() {
        for case in CASES {
            let description = case.description();
            let knob = (description.knob.values)(Tier::Quick, &description.setups[0])[0];
            let context = Context {
                tier: Tier::Quick,
                random_seed: 1,
                commit: String::new(),
                machine: String::new(),
                only: Some(&move |setup, value| setup.index == 0 && value == knob),
                clock: None,
                progress: &|_, _| {},
            };
            let files = export(*case, Tier::Quick, &study::run(*case, &context).rows).expect("the case is exported");
            let content = |path: String| files.iter().find(|file| file.path == path).map(|file| file.content.as_str());
            for setup in &description.setups {
                let Some(scene) = case.scene(setup, knob_of(&description, Tier::Quick, setup)) else { continue };
                let text = content(format!("{}/scene.toml", folder_of(setup))).expect("the setup has a scene");
                assert_eq!(Scene::from_toml(text, "scene.toml"), Ok(scene), "{}: {}", description.id, setup.label);
            }
            let template = content("template.csv".into()).expect("there is a template");
            assert!(template.starts_with(&COMPARE_COLUMNS.join(",")) && template.lines().count() > 1, "{}", description.id);
        }
    }
}
