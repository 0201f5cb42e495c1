//! Planes of forces across a direction of a box that repeats, and the exact inverse of the flow that they make where they act.
//!
//! Waves along a plane do not mix: of each, a handful of forces makes a handful of velocities, by a matrix that is the inverse of the box summed over the waves
//! across. Its inverse holds the fluid at rest on the plane by one transform along the plane, whatever the number of cells.

use nalgebra::DMatrix;

use super::periodic::PeriodicBox;
use super::spectrum::{LineOfModes, Mode, Spectrum};

/// The unsteady flow that is to be inverted on the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// In Pa s.
    pub viscosity: f64,
    /// Density over the implicit part of the step in kg/(m^3 s).
    pub inertia: f64,
    /// Velocity of the whole box under a unit mean force density in m^3 s/kg; zero if its mean is given.
    pub mean_mobility: f64,
}

/// Values of a component of the velocity in a plane across a direction, and the forces on them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaneOfValues {
    /// 0, 1 or 2.
    pub component: usize,
    /// Cell along the direction across.
    pub place: usize,
}

/// Inverse of the flow on some planes of values across one direction.
#[derive(Debug, Clone)]
pub struct Sheet {
    spectrum: Spectrum,
    /// Modes along the second direction of the plane.
    second_modes: usize,
    /// Of each wave along the plane, row by row, over the number of values of a plane.
    inverse: Vec<Mode>,
}

/// Singular values over the largest one, below which a force does nothing: a uniform one through the plane if the mean flow is given.
const NOTHING: f64 = 1e-10;

/// The two directions along a plane across one.
pub fn along(across: usize) -> [usize; 2] {
    [[1, 2], [0, 2], [0, 1]][across]
}

impl Sheet {
    /// The inverse on three or five planes of values across a direction.
    pub fn new(flow: &PeriodicBox, across: usize, planes: &[PlaneOfValues], response: &Response) -> Sheet {
        let cells = along(across).map(|direction| flow.grid().cells()[direction]);
        let spectrum = Spectrum::new([cells[0], cells[1], 1]);
        let share = 1.0 / (cells[0] * cells[1]) as f64;
        let waves = (0..=cells[0] / 2).flat_map(|first| (0..cells[1]).map(move |second| [first, second]));
        let inverse = waves.flat_map(|wave| {
            let matrix = matrix(flow, across, planes, response, wave);
            let (least, nothing) = (NOTHING * matrix.norm(), DMatrix::zeros(planes.len(), planes.len()));
            // Numbers beyond all bounds have no singular values to look for; a step of them blows up, and says so.
            let inverse = if least.is_finite() { matrix.pseudo_inverse(least).unwrap_or(nothing) } else { nothing };
            inverse.transpose().iter().map(|value| value * share).collect::<Vec<Mode>>()
        });
        Sheet { spectrum, second_modes: cells[1], inverse: inverse.collect() }
    }

    /// Replaces velocities in m/s, plane by plane, by the force densities in N/m^3 that make them.
    pub fn solve(&self, values: &mut [Vec<f64>]) {
        match values {
            [one, two, three] => self.apply([one, two, three]),
            [one, two, three, four, five] => self.apply([one, two, three, four, five]),
            _ => debug_assert!(false, "three planes of values, or five"),
        }
    }

    fn apply<const PLANES: usize>(&self, values: [&mut Vec<f64>; PLANES]) {
        let values = values.map(Vec::as_mut_slice);
        self.spectrum.apply(values, |LineOfModes { first, second }, modes| {
            let begin = (first * self.second_modes + second) * PLANES * PLANES;
            let inverse = &self.inverse[begin..][..PLANES * PLANES];
            let given: [Mode; PLANES] = std::array::from_fn(|plane| modes[plane][0]);
            for (mode, row) in modes.iter_mut().zip(inverse.chunks_exact(PLANES)) {
                mode[0] = row.iter().zip(&given).map(|(factor, given)| factor * given).sum();
            }
        });
    }
}

/// Velocities that unit forces of a wave along the planes make on each of them.
fn matrix(flow: &PeriodicBox, across: usize, planes: &[PlaneOfValues], response: &Response, wave: [usize; 2]) -> DMatrix<Mode> {
    let cells = flow.grid().cells()[across];
    let mut number = [0; 3];
    for (direction, wave) in along(across).into_iter().zip(wave) {
        number[direction] = wave;
    }
    let mut matrix = DMatrix::zeros(planes.len(), planes.len());
    for of_line in 0..cells {
        number[across] = of_line;
        let symbol = flow.symbol(number, response);
        for (row, to) in planes.iter().enumerate() {
            for (column, from) in planes.iter().enumerate() {
                let turn = std::f64::consts::TAU * (of_line as f64) * (to.place as f64 - from.place as f64) / cells as f64;
                matrix[(row, column)] += symbol[to.component][from.component] * Mode::from_polar(1.0 / cells as f64, turn);
            }
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vector;
    use crate::fluid::grid::{FaceField, Grid};

    /// Forces on planes make a flow; from its values on the planes the same flow must follow. Forces themselves need not: a uniform one through a plane does nothing.
    #[test]
    fn forces_are_found_again_from_the_flow_that_they_make_on_their_planes() {
        let grid = Grid::new([8, 7, 10], 0.1, Vector::zeros()).expect("enough cells");
        let flow = PeriodicBox::new(grid);
        for (across, mean_mobility) in [(0, 0.0), (1, 0.0), (2, 0.0), (2, 1.0 / 3.0)] {
            let [one, other] = along(across);
            let last = grid.cells()[across] - 1;
            let value = |component, place| PlaneOfValues { component, place };
            let thin = vec![value(one, 0), value(other, 0), value(across, 0)];
            let thick = [thin.clone(), vec![value(one, last), value(other, last)]].concat();
            for planes in [thin, thick] {
                let response = Response { viscosity: 0.7, inertia: 3.0, mean_mobility };
                let sheet = Sheet::new(&flow, across, &planes, &response);
                let place = |plane: &PlaneOfValues, i: usize, j: usize| {
                    let mut cell = [0; 3];
                    [cell[one], cell[other], cell[across]] = [i, j, plane.place];
                    grid.index(cell)
                };
                let make = |forces: &[Vec<f64>]| {
                    let mut field = FaceField::zeros(&grid);
                    for (plane, forces) in planes.iter().zip(forces) {
                        for (number, force) in forces.iter().enumerate() {
                            let at = place(plane, number % grid.cells()[one], number / grid.cells()[one]);
                            field.component[plane.component][at] = *force;
                        }
                    }
                    let mean = field.mean() * mean_mobility;
                    flow.solve_stokes(&mut field, response.viscosity, response.inertia, mean);
                    field
                };
                let count = grid.cells()[one] * grid.cells()[other];
                let forces: Vec<Vec<f64>> =
                    (0..planes.len()).map(|plane| (0..count).map(|at| ((at * at + 3 * plane) as f64 * 0.7).sin()).collect()).collect();
                let wanted = make(&forces);
                let sample = |plane: &PlaneOfValues| {
                    (0..count)
                        .map(|at| wanted.component[plane.component][place(plane, at % grid.cells()[one], at / grid.cells()[one])])
                        .collect()
                };
                let mut values: Vec<Vec<f64>> = planes.iter().map(sample).collect();
                sheet.solve(&mut values);
                let got = make(&values);
                let apart = got.component.iter().flatten().zip(wanted.component.iter().flatten()).map(|(got, wanted)| (got - wanted).abs());
                let (apart, size) =
                    (apart.fold(0.0, f64::max), wanted.component.iter().flatten().fold(0.0, |most: f64, v| most.max(v.abs())));
                assert!(apart < 1e-12 * size, "{across} {} {apart} {size}", planes.len());
            }
        }
    }
}
