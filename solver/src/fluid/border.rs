//! Fields with a border of values beyond the sides of the box, so that differences need not know where the box ends (R section 7.3.1).

use std::ops::Range;

use super::grid::Grid;
use super::sides::{Condition, Sides};
use crate::parallel;

/// Fields of a grid with sides. In each direction places -1 to `cells + 1` are stored, first direction fastest; component `a` of the velocity has a face on either side in
/// direction `a`.
///
/// Values beyond a side are reflected, so that their mean with the value within is the one on the side, or their difference vanishes: of second order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    grid: Grid,
    sides: Sides,
    strides: [usize; 3],
}

/// One plane of a border from another: `factor` times that at `source`, and `constant`.
struct Plane {
    target: usize,
    source: usize,
    factor: f64,
    constant: f64,
}

impl Border {
    /// The border of a grid with sides.
    pub fn new(grid: Grid, sides: Sides) -> Border {
        let stored = grid.cells().map(|cells| cells + 3);
        Border { grid, sides, strides: [1, stored[0], stored[0] * stored[1]] }
    }

    /// The grid within.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The sides.
    pub fn sides(&self) -> &Sides {
        &self.sides
    }

    /// A field of zeros, border included.
    pub fn zeros(&self) -> Vec<f64> {
        vec![0.0; self.strides[2] * (self.grid.cells()[2] + 3)]
    }

    /// From a value to the next in a direction.
    #[inline]
    pub fn strides(&self) -> [usize; 3] {
        self.strides
    }

    /// Where the value of a cell or of its lower face is stored.
    #[inline]
    pub fn index(&self, cell: [usize; 3]) -> usize {
        (0..3).map(|direction| (cell[direction] + 1) * self.strides[direction]).sum()
    }

    /// The cell whose value, or that of whose lower face, is stored at a place.
    #[inline]
    pub fn cell(&self, at: usize) -> [usize; 3] {
        let [_, row, plane] = self.strides;
        [at % row - 1, at % plane / row - 1, at / plane - 1]
    }

    /// The same conditions with zero for whatever the sides give.
    pub fn homogeneous(&self) -> Border {
        Border { sides: self.sides.at_rest(), ..*self }
    }

    /// The places in each direction of what is not given by the sides: a component of the velocity, or the pressure.
    pub fn unknowns(&self, component: Option<usize>) -> [Range<usize>; 3] {
        std::array::from_fn(|direction| {
            let cells = self.grid.cells()[direction];
            match self.sides.conditions(component, direction) {
                Some([lower, upper]) if component == Some(direction) => {
                    usize::from(lower != Condition::Level)..cells + usize::from(upper == Condition::Level)
                }
                _ => 0..cells,
            }
        })
    }

    /// Where each row of unknowns begins.
    fn rows(&self, component: Option<usize>) -> impl Iterator<Item = usize> {
        let border = *self;
        let [first, second, third] = self.unknowns(component);
        third.flat_map(move |k| second.clone().map(move |j| (j, k))).map(move |(j, k)| border.index([first.start, j, k]))
    }

    /// One value for each unknown from the place where it is stored.
    pub fn evaluate(&self, component: Option<usize>, value: impl Fn(usize) -> f64 + Sync + Send) -> Vec<f64> {
        let shape = self.unknowns(component).map(|range| range.len());
        let count = shape.iter().product();
        let mut values = vec![0.0; count];
        let mut rows: Vec<(usize, &mut [f64])> = self.rows(component).zip(values.chunks_exact_mut(shape[0])).collect();
        parallel::for_each_part_of(count, &mut rows, |part| {
            for (start, row) in part {
                for (along, unknown) in row.iter_mut().enumerate() {
                    *unknown = value(*start + along);
                }
            }
        });
        values
    }

    /// Adds a multiple of one value for each unknown, and renews the border.
    pub fn add(&self, component: Option<usize>, field: &mut [f64], factor: f64, values: &[f64]) {
        let length = self.unknowns(component)[0].len();
        for (start, row) in self.rows(component).zip(values.chunks_exact(length)) {
            for (value, added) in field[start..][..length].iter_mut().zip(row) {
                *value += factor * added;
            }
        }
        self.fill(component, field);
    }

    /// Sets each unknown from its cell, and renews the border.
    pub fn set(&self, component: Option<usize>, field: &mut [f64], value: impl Fn([usize; 3]) -> f64) {
        let [first, second, third] = self.unknowns(component);
        for k in third {
            for j in second.clone() {
                for i in first.clone() {
                    field[self.index([i, j, k])] = value([i, j, k]);
                }
            }
        }
        self.fill(component, field);
    }

    /// Renews everything that the sides give, from the unknowns.
    pub fn fill(&self, component: Option<usize>, field: &mut [f64]) {
        for direction in 0..3 {
            for plane in self.planes(component, direction) {
                self.copy(direction, &plane, field);
            }
        }
    }

    fn planes(&self, component: Option<usize>, direction: usize) -> Vec<Plane> {
        let cells = self.grid.cells()[direction];
        let plane = |target, source, factor, constant| Plane { target, source, factor, constant };
        // Places are stored from -1 on, so cell 0 is the plane 1.
        let Some(conditions) = self.sides.conditions(component, direction) else {
            return vec![plane(0, cells, 1.0, 0.0), plane(cells + 1, 1, 1.0, 0.0), plane(cells + 2, 2, 1.0, 0.0)];
        };
        let on_faces = component == Some(direction);
        let (side, outside, within) =
            if on_faces { ([1, cells + 1], [0, cells + 2], [2, cells]) } else { ([0, 0], [0, cells + 1], [1, cells]) };
        let of_end = |end: usize| match conditions[end] {
            Condition::Given(value) if on_faces => plane(side[end], side[end], 0.0, value),
            Condition::Given(value) => plane(outside[end], within[end], -1.0, 2.0 * value),
            Condition::Level => plane(outside[end], within[end], 1.0, 0.0),
        };
        vec![of_end(0), of_end(1)]
    }

    fn copy(&self, direction: usize, plane: &Plane, field: &mut [f64]) {
        let [one, other] = [(1, 2), (0, 2), (0, 1)][direction].into();
        let stored = self.grid.cells().map(|cells| cells + 3);
        let (target, source) = (plane.target * self.strides[direction], plane.source * self.strides[direction]);
        for across in 0..stored[other] {
            for along in 0..stored[one] {
                let place = across * self.strides[other] + along * self.strides[one];
                field[place + target] = plane.factor * field[place + source] + plane.constant;
            }
        }
    }
}
