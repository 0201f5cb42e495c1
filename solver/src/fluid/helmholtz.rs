//! Exact inverse of $\alpha - \beta \nabla^2$ for one field in a box with any sides: a product of waves along each direction (`trigonometric.rs`).

use super::border::Border;
use super::trigonometric::{Line, Workspace};
use crate::parallel;

/// Lines that are worked on together: whole cache lines of the field.
const LINES: usize = 16;

/// The inverse for a component of the velocity, or the pressure.
#[derive(Clone)]
pub struct Helmholtz {
    lines: [Line; 3],
}

impl std::fmt::Debug for Helmholtz {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Helmholtz").field("unknowns", &self.shape()).finish_non_exhaustive()
    }
}

impl Helmholtz {
    /// The inverse for the unknowns of a field.
    pub fn new(border: &Border, component: Option<usize>) -> Helmholtz {
        let line = |direction| {
            let cells = border.grid().cells()[direction];
            Line::new(cells, border.grid().spacing(), border.sides().conditions(component, direction), component == Some(direction))
        };
        Helmholtz { lines: std::array::from_fn(line) }
    }

    fn shape(&self) -> [usize; 3] {
        self.lines.each_ref().map(|line| line.length)
    }

    /// Replaces the right side of $\alpha x - \beta \nabla^2 x = r$ by the solution, with zero for what the sides give. `beta` in m^2 if `alpha` has no unit.
    ///
    /// If $\alpha$ is zero and no side gives a value, the mean of the right side is left out and that of the solution is zero.
    pub fn solve(&self, field: &mut [f64], alpha: f64, beta: f64) {
        let [first, second, third] = &self.lines;
        let plane = first.length * second.length;
        let count = field.len();
        self.planes(field, |field, space| {
            for row in field.chunks_exact_mut(first.length) {
                first.forward(row, &mut space[0]);
            }
            columns(field, second, |line| second.forward(line, &mut space[1]));
        });
        let share = 1.0 / (first.gain * second.gain * third.gain);
        let scale = |number: usize, line: &mut [f64]| {
            let across = first.squares[number % first.length] + second.squares[number / first.length];
            for (amplitude, square) in line.iter_mut().zip(&third.squares) {
                let symbol = alpha + beta * (across + square);
                *amplitude *= if symbol != 0.0 { share / symbol } else { 0.0 };
            }
        };
        // Blocks of lines along the third direction, each in planes of its own.
        let mut blocks = vec![0.0; field.len()];
        let mut numbered: Vec<(usize, &mut [f64])> = blocks.chunks_mut(LINES * third.length).enumerate().collect();
        parallel::for_each_part_of(count, &mut numbered, |part| {
            let mut space = third.workspace();
            let mut lines = vec![0.0; LINES * third.length];
            for (number, block) in part {
                let start = *number * LINES;
                let count = block.len() / third.length;
                gather(&field[start..], plane, count, &mut lines, third.length);
                for (line, values) in lines.chunks_exact_mut(third.length).take(count).enumerate() {
                    third.forward(values, &mut space);
                    scale(start + line, values);
                    third.backward(values, &mut space);
                }
                scatter(&lines, third.length, block, count, count);
            }
        });
        let mut planes: Vec<(usize, &mut [f64])> = field.chunks_exact_mut(plane).enumerate().collect();
        parallel::for_each_part_of(count, &mut planes, |part| {
            let mut space = [first.workspace(), second.workspace()];
            for (number, field) in part {
                for (values, block) in field.chunks_mut(LINES).zip(blocks.chunks(LINES * third.length)) {
                    let count = values.len();
                    values.copy_from_slice(&block[*number * count..][..count]);
                }
                columns(field, second, |line| second.backward(line, &mut space[1]));
                for row in field.chunks_exact_mut(first.length) {
                    first.backward(row, &mut space[0]);
                }
            }
        });
    }

    /// Calls a function for each plane of the first two directions.
    fn planes(&self, field: &mut [f64], work: impl Fn(&mut [f64], &mut [Workspace; 2]) + Sync + Send) {
        let [first, second, _] = &self.lines;
        let count = field.len();
        let mut planes: Vec<&mut [f64]> = field.chunks_exact_mut(first.length * second.length).collect();
        parallel::for_each_part_of(count, &mut planes, |part| {
            let mut space = [first.workspace(), second.workspace()];
            part.iter_mut().for_each(|plane| work(plane, &mut space));
        });
    }
}

/// Calls a function for each column of a plane.
fn columns(plane: &mut [f64], along: &Line, mut work: impl FnMut(&mut [f64])) {
    let width = plane.len() / along.length;
    let mut lines = vec![0.0; LINES * along.length];
    for start in (0..width).step_by(LINES) {
        let count = LINES.min(width - start);
        gather(&plane[start..], width, count, &mut lines, along.length);
        lines.chunks_exact_mut(along.length).take(count).for_each(&mut work);
        scatter(&lines, along.length, &mut plane[start..], width, count);
    }
}

/// Some neighbouring lines of values that stand a stride apart.
fn gather(field: &[f64], stride: usize, count: usize, lines: &mut [f64], length: usize) {
    for (place, values) in field.chunks(stride).take(length).enumerate() {
        for (line, value) in values[..count].iter().enumerate() {
            lines[line * length + place] = *value;
        }
    }
}

fn scatter(lines: &[f64], length: usize, field: &mut [f64], stride: usize, count: usize) {
    for (place, values) in field.chunks_mut(stride).take(length).enumerate() {
        for (line, value) in values[..count].iter_mut().enumerate() {
            *value = lines[line * length + place];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vector;
    use crate::fluid::grid::Grid;
    use crate::fluid::sides::{Ends, Side, Sides};
    use crate::fluid::stencils::{divergence, gradient, laplacian};

    /// Every kind of end in every direction, with odd and even numbers of cells.
    fn borders() -> impl Iterator<Item = Border> {
        let inlet = |direction| Side::Inlet { velocity: Vector::ith(direction, 1.0) };
        let outlet_first = |direction| Side::Inlet { velocity: Vector::ith(direction, -1.0) };
        let kinds = move |direction: usize| {
            [
                Ends::Periodic,
                Ends::Sides([Side::REST; 2]),
                Ends::Sides([Side::FreeSlip, Side::REST]),
                Ends::Sides([Side::REST, Side::FreeSlip]),
                Ends::Sides([Side::FreeSlip; 2]),
                Ends::Sides([inlet(direction), Side::Outlet]),
                Ends::Sides([Side::Outlet, outlet_first(direction)]),
            ]
        };
        let all = (0..7).flat_map(|first| (0..7).flat_map(move |second| (0..7).map(move |third| [first, second, third])));
        all.filter_map(move |chosen| {
            let sides = Sides::new(std::array::from_fn(|direction| kinds(direction)[chosen[direction]])).ok()?;
            Grid::new([7, 4 + chosen[0], 20], 0.3, Vector::zeros()).ok().map(|grid| Border::new(grid, sides).homogeneous())
        })
    }

    fn noise(length: usize) -> Vec<f64> {
        (0..length).map(|place| ((place * place) as f64 * 0.7).sin()).collect()
    }

    fn count(border: &Border, component: Option<usize>) -> usize {
        border.unknowns(component).map(|range| range.len()).iter().product()
    }

    #[test]
    fn components_are_inverted_between_all_kinds_of_sides() {
        for border in borders() {
            for component in 0..3 {
                let right = noise(count(&border, Some(component)));
                let mut solution = right.clone();
                Helmholtz::new(&border, Some(component)).solve(&mut solution, 1.3, 0.4);
                let mut field = border.zeros();
                border.add(Some(component), &mut field, 1.0, &solution);
                let back = laplacian(&border, component, &field);
                for (place, wanted) in right.iter().enumerate() {
                    assert!((1.3 * solution[place] - 0.4 * back[place] - wanted).abs() < 1e-13, "{:?} {component}", border.sides());
                }
            }
        }
    }

    #[test]
    fn pressures_are_inverted_between_all_kinds_of_sides() {
        let mut with_outlet = 0;
        for border in borders() {
            let mut right = noise(count(&border, None));
            let has_outlet =
                (0..3).any(|direction| matches!(border.sides().ends(direction), Ends::Sides(pair) if pair.contains(&Side::Outlet)));
            with_outlet += usize::from(has_outlet);
            if !has_outlet {
                let mean = right.iter().sum::<f64>() / right.len() as f64;
                right.iter_mut().for_each(|value| *value -= mean);
            }
            let mut solution = right.clone();
            Helmholtz::new(&border, None).solve(&mut solution, 0.0, -1.0);
            let mut pressure = border.zeros();
            border.add(None, &mut pressure, 1.0, &solution);
            let slopes = std::array::from_fn(|component| {
                let mut field = border.zeros();
                border.add(Some(component), &mut field, 1.0, &gradient(&border, &pressure, component));
                field
            });
            for (got, wanted) in divergence(&border, &slopes).iter().zip(&right) {
                assert!((got - wanted).abs() < 1e-12, "{:?}", border.sides());
            }
        }
        assert!(with_outlet >= 100, "{with_outlet}");
    }
}
