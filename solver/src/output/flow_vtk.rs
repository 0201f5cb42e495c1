//! A VTK snapshot of a flow (VTI, values in the middles of the cells of its grid), for ParaView.

use std::io::{self, Write};

use super::vtk::write_floats;
use crate::coupling::resolved::immersed::ImmersedBody;
use crate::coupling::resolved::measures::{FluidShare, cell_velocity};
use crate::fluid::grid::{FaceField, Grid};
use crate::{Simulation, Vector};

/// A flow at one time.
#[derive(Debug, Clone, Copy)]
pub struct FlowSnapshot<'a> {
    /// The grid.
    pub grid: &'a Grid,
    /// In m/s, on faces; means of the two faces of a cell are written.
    pub velocity: &'a FaceField,
    /// In Pa, in the middles of cells.
    pub pressure: &'a [f64],
    /// Which part of each cell is fluid; one less that is written as the solid indicator.
    pub share: &'a FluidShare,
}

/// Writes the fluid of a run as it was after the last step of the fluid; nothing if there is none.
///
/// # Errors
///
/// What the writer returns.
pub fn write_flow_of(simulation: &Simulation, writer: &mut dyn Write) -> io::Result<()> {
    let Some(resolved) = &simulation.stages.flow else { return Ok(()) };
    let (flow, grid) = (resolved.flow(), resolved.flow().flow().grid());
    let bodies: Vec<ImmersedBody> = flow.bodies().iter().map(|body| body.immersed.clone()).collect();
    let share = FluidShare::new(grid, &bodies).map_err(io::Error::other)?;
    write_flow(&FlowSnapshot { grid, velocity: flow.velocity(), pressure: &resolved.pressure(), share: &share }, writer)
}

/// Writes velocity, pressure and solid indicator (nothing in the fluid, one in a body, between them where a surface cuts a cell) as an image of cells.
///
/// # Errors
///
/// What the writer returns; `InvalidInput` for fields of another grid.
pub fn write_flow(snapshot: &FlowSnapshot<'_>, writer: &mut dyn Write) -> io::Result<()> {
    let FlowSnapshot { grid, velocity, pressure, share } = snapshot;
    let lengths = velocity.component.iter().map(Vec::len).chain([pressure.len(), share.shares().len()]);
    if let Some(length) = lengths.into_iter().find(|length| *length != grid.len()) {
        let message = format!("a field of {length} values on a grid of {} cells; all must be of the same grid", grid.len());
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    let [i, j, k] = grid.cells();
    let triple = |vector: Vector| format!("{:?} {:?} {:?}", vector.x, vector.y, vector.z);
    let extent = format!("0 {i} 0 {j} 0 {k}");
    let (origin, spacing) = (triple(grid.lower()), triple(Vector::repeat(grid.spacing())));
    writeln!(writer, "<?xml version=\"1.0\"?>")?;
    writeln!(writer, "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\">")?;
    writeln!(writer, "<ImageData WholeExtent=\"{extent}\" Origin=\"{origin}\" Spacing=\"{spacing}\"><Piece Extent=\"{extent}\">")?;
    writeln!(writer, "<CellData Scalars=\"pressure\" Vectors=\"velocity\">")?;
    let of_cells = (0..grid.len()).flat_map(|index| <[f64; 3]>::from(cell_velocity(grid, velocity, index)));
    write_floats(writer, "velocity", 3, of_cells.collect())?;
    write_floats(writer, "pressure", 1, pressure.to_vec())?;
    write_floats(writer, "solid", 1, share.shares().iter().map(|share| 1.0 - share).collect())?;
    writeln!(writer, "</CellData></Piece></ImageData></VTKFile>")
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::coupling::resolved::surface::Ball;
    use crate::fluid::grid::cell_field;

    fn attribute<'a>(text: &'a str, name: &str) -> &'a str {
        let from = text.find(&format!(" {name}=\"")).unwrap_or_else(|| panic!("no {name}")) + name.len() + 3;
        text[from..].split('"').next().expect("a closed attribute")
    }

    fn array(text: &str, name: &str) -> Vec<f64> {
        let head = text.find(&format!("Name=\"{name}\"")).unwrap_or_else(|| panic!("no {name}"));
        let values = text[head..].split('>').nth(1).and_then(|rest| rest.split('<').next()).expect("values");
        values.split_whitespace().map(|word| word.parse().expect("a number")).collect()
    }

    #[test]
    fn a_flow_reads_back_to_the_bit_with_its_grid() {
        let grid = Grid::new([6, 5, 4], 0.3, Vector::new(0.1, -2.0, 0.0)).expect("enough cells");
        let ball = ImmersedBody::fixed(Arc::new(Ball { radius: 0.5 }), Vector::new(0.9, -1.2, 0.7));
        let share = FluidShare::new(&grid, &[ball]).expect("a ball");
        let velocity = FaceField::from_fn(&grid, |component, place| (place.x - 2.0 * place.z).sin() + component as f64);
        let pressure = cell_field(&grid, |place| (3.0 * place.y).cos() / 3.0);
        let snapshot = FlowSnapshot { grid: &grid, velocity: &velocity, pressure: &pressure, share: &share };
        let mut text = Vec::new();
        write_flow(&snapshot, &mut text).expect("a vector takes everything");
        let text = String::from_utf8(text).expect("text");
        assert_eq!((attribute(&text, "WholeExtent"), attribute(&text, "Extent")), ("0 6 0 5 0 4", "0 6 0 5 0 4"));
        assert_eq!((attribute(&text, "Origin"), attribute(&text, "Spacing")), ("0.1 -2.0 0.0", "0.3 0.3 0.3"));
        assert_eq!(array(&text, "pressure"), pressure);
        // A cell away from all sides, by its six faces, the first direction fastest.
        let (index, values) = (grid.index([4, 3, 2]), array(&text, "velocity"));
        let face = |component: usize, cell| velocity.component[component][grid.index(cell)];
        assert_eq!(values[3 * index], 0.5 * (face(0, [4, 3, 2]) + face(0, [5, 3, 2])));
        assert_eq!(values[3 * index + 1], 0.5 * (face(1, [4, 3, 2]) + face(1, [4, 4, 2])));
        assert_eq!(values[3 * index + 2], 0.5 * (face(2, [4, 3, 2]) + face(2, [4, 3, 3])));
        let solid = array(&text, "solid");
        assert!(solid[grid.index([2, 2, 2])] == 1.0 && solid[grid.index([5, 0, 0])] == 0.0 && solid.len() == 120);
    }

    #[test]
    fn fields_of_another_grid_are_refused() {
        let grid = Grid::new([6, 5, 4], 0.3, Vector::zeros()).expect("enough cells");
        let share = FluidShare::new(&grid, &[]).expect("no body");
        let snapshot = FlowSnapshot { grid: &grid, velocity: &FaceField::zeros(&grid), pressure: &[0.0; 7], share: &share };
        let error = write_flow(&snapshot, &mut Vec::new()).expect_err("too few pressures");
        assert!(error.kind() == io::ErrorKind::InvalidInput && error.to_string().contains("7 values on a grid of 120 cells"), "{error}");
    }
}
