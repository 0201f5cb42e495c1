//! probes.csv: what the probes of a scene observe over time. Names in the first line, units in the second; `nan` where a body is not there.

use std::io::{self, Write};

use super::digits17;
use crate::measure::Now;
use crate::scene::{Measure, Probe};
use crate::{Simulation, Vector};

/// A column group of probes.csv.
struct Column {
    measure: Measure,
    /// Id of the body, for the measures of one body.
    body: Option<u32>,
}

/// The columns of a scene's probes, in the order of the scene.
pub struct Probes {
    columns: Vec<Column>,
}

impl Probes {
    /// The columns of a run's scene; one probe of every body has those of bodies that come later too.
    pub fn new(simulation: &Simulation) -> Probes {
        Probes { columns: simulation.scene().probes.iter().flat_map(|probe| columns_of(probe, simulation.ids())).collect() }
    }

    /// Whether the scene has no probe.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// Writes the two head lines.
    ///
    /// # Errors
    ///
    /// What the writer returns.
    pub fn write_head(&self, writer: &mut dyn Write) -> io::Result<()> {
        let (mut names, mut units) = (vec!["time".to_string()], vec!["s".to_string()]);
        for column in &self.columns {
            let body = column.body.map_or(String::new(), |id| format!(".{id}"));
            for component in components(column.measure) {
                let component = if component.is_empty() { String::new() } else { format!(".{component}") };
                names.push(format!("{}{body}{component}", name(column.measure)));
                units.push(unit(column.measure).to_string());
            }
        }
        writeln!(writer, "{}", names.join(","))?;
        writeln!(writer, "{}", units.join(","))
    }

    /// Writes one row.
    ///
    /// # Errors
    ///
    /// What the writer returns.
    pub fn write_row(&self, now: &Now<'_>, writer: &mut dyn Write) -> io::Result<()> {
        let mut values = vec![now.time()];
        for column in &self.columns {
            values.extend(observe(now, column));
        }
        writeln!(writer, "{}", values.into_iter().map(digits17).collect::<Vec<_>>().join(","))
    }
}

fn columns_of(probe: &Probe, ids: &[u32]) -> Vec<Column> {
    if !probe.measure.is_of_one_body() {
        return vec![Column { measure: probe.measure, body: None }];
    }
    let wanted = ids.iter().filter(|id| probe.body.is_none_or(|wanted| wanted == **id));
    wanted.map(|id| Column { measure: probe.measure, body: Some(*id) }).collect()
}

fn observe(now: &Now<'_>, column: &Column) -> Vec<f64> {
    let index = match column.body.map(|id| now.bodies().index_of(id)) {
        // Not there yet, or no more.
        Some(None) => return vec![f64::NAN; components(column.measure).len()],
        Some(Some(index)) => index,
        None => 0,
    };
    let of = |vector: Vector| vector.iter().copied().collect::<Vec<_>>();
    match column.measure {
        Measure::Position => of(now.position(index)),
        Measure::Velocity => of(now.velocity(index)),
        Measure::AngularVelocity => of(now.angular_velocity(index)),
        Measure::Orientation => {
            let orientation = now.orientation(index);
            vec![orientation.w, orientation.i, orientation.j, orientation.k]
        }
        Measure::KineticEnergy => vec![now.kinetic_energy()],
        Measure::GravitationalEnergy => vec![now.gravitational_energy()],
        Measure::ElasticEnergy => vec![now.contacts().elastic_energy],
        Measure::TotalEnergy => vec![now.total_energy()],
        Measure::Momentum => of(now.momentum()),
        Measure::AngularMomentum => of(now.angular_momentum()),
        Measure::Contacts => vec![now.contacts().contacts as f64],
        Measure::LargestOverlap => vec![now.contacts().largest_overlap],
        Measure::Bodies => vec![now.bodies().len() as f64],
        Measure::BodiesLeft => vec![now.departures().len() as f64],
        Measure::MassLeft => vec![now.departures().iter().map(|departure| departure.mass).sum()],
        Measure::RootMeanSquareSpeed => vec![now.root_mean_square_speed()],
        Measure::FluidForce => of(now.fluid_load(now.bodies().id(index)).force),
        Measure::FluidTorque => of(now.fluid_load(now.bodies().id(index)).torque),
        Measure::MeanFlow => of(now.mean_flow()),
        Measure::MeanPressureGradient => of(now.mean_pressure_gradient()),
    }
}

fn components(measure: Measure) -> &'static [&'static str] {
    match measure {
        Measure::Position
        | Measure::Velocity
        | Measure::AngularVelocity
        | Measure::Momentum
        | Measure::AngularMomentum
        | Measure::FluidForce
        | Measure::FluidTorque
        | Measure::MeanFlow
        | Measure::MeanPressureGradient => &["x", "y", "z"],
        Measure::Orientation => &["w", "x", "y", "z"],
        _ => &[""],
    }
}

fn name(measure: Measure) -> &'static str {
    match measure {
        Measure::Position => "position",
        Measure::Velocity => "velocity",
        Measure::Orientation => "orientation",
        Measure::AngularVelocity => "angular_velocity",
        Measure::KineticEnergy => "kinetic_energy",
        Measure::GravitationalEnergy => "gravitational_energy",
        Measure::ElasticEnergy => "elastic_energy",
        Measure::TotalEnergy => "total_energy",
        Measure::Momentum => "momentum",
        Measure::AngularMomentum => "angular_momentum",
        Measure::Contacts => "contacts",
        Measure::LargestOverlap => "largest_overlap",
        Measure::Bodies => "bodies",
        Measure::BodiesLeft => "bodies_left",
        Measure::MassLeft => "mass_left",
        Measure::RootMeanSquareSpeed => "root_mean_square_speed",
        Measure::FluidForce => "fluid_force",
        Measure::FluidTorque => "fluid_torque",
        Measure::MeanFlow => "mean_flow",
        Measure::MeanPressureGradient => "mean_pressure_gradient",
    }
}

fn unit(measure: Measure) -> &'static str {
    match measure {
        Measure::Position | Measure::LargestOverlap => "m",
        Measure::Velocity | Measure::RootMeanSquareSpeed | Measure::MeanFlow => "m/s",
        Measure::FluidForce => "N",
        Measure::FluidTorque => "N m",
        Measure::MeanPressureGradient => "Pa/m",
        Measure::Orientation | Measure::Contacts | Measure::Bodies | Measure::BodiesLeft => "1",
        Measure::MassLeft => "kg",
        Measure::AngularVelocity => "rad/s",
        Measure::Momentum => "kg m/s",
        Measure::AngularMomentum => "kg m^2/s",
        Measure::KineticEnergy | Measure::GravitationalEnergy | Measure::ElasticEnergy | Measure::TotalEnergy => "J",
    }
}
