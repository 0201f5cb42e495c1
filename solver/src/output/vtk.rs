//! VTK snapshots (VTU, one point per body) and the PVD file that lists them over time, for ParaView.

use std::io::{self, Write};

use crate::{Simulation, Vector};

/// Writes one snapshot as an unstructured grid of points: position, id, bounding radius, velocity, angular velocity, orientation (w x y z).
///
/// # Errors
///
/// What the writer returns.
pub fn write_snapshot(simulation: &mut Simulation, writer: &mut dyn Write) -> io::Result<()> {
    let now = simulation.now();
    let bodies = now.bodies();
    let count = bodies.len();
    let vectors = |of: &dyn Fn(usize) -> Vector| bodies.by_id().flat_map(|index| of(index).iter().copied().collect::<Vec<_>>()).collect();
    writeln!(writer, "<?xml version=\"1.0\"?>")?;
    writeln!(writer, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">")?;
    writeln!(writer, "<UnstructuredGrid><Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{count}\">")?;
    writeln!(writer, "<Points>")?;
    write_floats(writer, "position", 3, vectors(&|index| now.position(index)))?;
    writeln!(writer, "</Points>")?;
    writeln!(writer, "<Cells>")?;
    write_integers(writer, "connectivity", 0..count as u64)?;
    write_integers(writer, "offsets", 1..=count as u64)?;
    write_integers(writer, "types", (0..count).map(|_| 1))?;
    writeln!(writer, "</Cells>")?;
    writeln!(writer, "<PointData>")?;
    write_integers(writer, "id", bodies.by_id().map(|index| u64::from(bodies.id(index))))?;
    write_floats(writer, "radius", 1, bodies.by_id().map(|index| bodies.shape(index).bounding_radius()).collect())?;
    write_floats(writer, "velocity", 3, vectors(&|index| now.velocity(index)))?;
    write_floats(writer, "angular_velocity", 3, vectors(&|index| now.angular_velocity(index)))?;
    let quaternion = |index| {
        let orientation = now.orientation(index);
        [orientation.w, orientation.i, orientation.j, orientation.k]
    };
    write_floats(writer, "orientation", 4, bodies.by_id().flat_map(quaternion).collect())?;
    writeln!(writer, "</PointData></Piece></UnstructuredGrid></VTKFile>")
}

/// Writes the list of snapshots: time in s and file name of each.
///
/// # Errors
///
/// What the writer returns.
pub fn write_series(snapshots: &[(f64, String)], writer: &mut dyn Write) -> io::Result<()> {
    writeln!(writer, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\"><Collection>")?;
    for (time, file) in snapshots {
        writeln!(writer, "<DataSet timestep=\"{time:?}\" file=\"{file}\"/>")?;
    }
    writeln!(writer, "</Collection></VTKFile>")
}

/// Writes an array of numbers that read back to the bit.
pub(super) fn write_floats(writer: &mut dyn Write, name: &str, components: usize, values: Vec<f64>) -> io::Result<()> {
    let head = format!("type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\"");
    let values = values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(" ");
    writeln!(writer, "<DataArray {head}>{values}</DataArray>")
}

fn write_integers(writer: &mut dyn Write, name: &str, values: impl Iterator<Item = u64>) -> io::Result<()> {
    let values = values.map(|value| value.to_string()).collect::<Vec<_>>().join(" ");
    writeln!(writer, "<DataArray type=\"UInt64\" Name=\"{name}\" format=\"ascii\">{values}</DataArray>")
}
