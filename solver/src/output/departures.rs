//! departures.csv: the bodies that have left, by time.

use std::io::{self, Write};

use super::digits17;
use crate::Simulation;

/// Writes id, name of the outlet, time and mass of every body that has left.
///
/// # Errors
///
/// What the writer returns.
pub fn write(simulation: &Simulation, writer: &mut dyn Write) -> io::Result<()> {
    writeln!(writer, "id,outlet,time,mass\n1,1,s,kg")?;
    for departure in simulation.departures() {
        let outlet = &simulation.scene().outlets[departure.outlet as usize].name.replace([',', '\n', '\r', '"'], " ");
        writeln!(writer, "{},{outlet},{},{}", departure.id, digits17(departure.time), digits17(departure.mass))?;
    }
    Ok(())
}
