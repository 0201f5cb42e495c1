//! bodies.csv: the state of every body at one instant, by id.

use std::io::{self, Write};

use super::digits17;
use crate::Simulation;

/// Writes the state of all bodies. Spheres whose orientation nothing asks for keep their first one: any describes the same sphere. The
/// ledger says whether it is advanced.
///
/// # Errors
///
/// What the writer returns.
pub fn write(simulation: &mut Simulation, writer: &mut dyn Write) -> io::Result<()> {
    let now = simulation.now();
    writeln!(writer, "id,shape,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz")?;
    let bodies = now.bodies();
    for index in bodies.by_id() {
        let orientation = now.orientation(index);
        let mut values: Vec<f64> = now.position(index).iter().copied().collect();
        values.extend([orientation.w, orientation.i, orientation.j, orientation.k]);
        values.extend(now.velocity(index).iter());
        values.extend(now.angular_velocity(index).iter());
        let values = values.into_iter().map(digits17).collect::<Vec<_>>().join(",");
        writeln!(writer, "{},{},{values}", bodies.id(index), bodies.shape(index).name())?;
    }
    Ok(())
}
