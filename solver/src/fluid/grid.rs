//! Where pressure and velocities live: a box cut into cubes, velocities on their faces (R section 7.3.1, after Harlow and Welch).

use serde::{Deserialize, Serialize};

use crate::Vector;

/// A box of cubic cells. Pressure lives in their middles; component `a` of the velocity in the middle of the face that looks against direction `a`.
///
/// Fields are stored with the first direction fastest. Faces are counted like the cells that they belong to, so in a direction that repeats all fields have one
/// entry a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    cells: [usize; 3],
    spacing: f64,
    lower: Vector,
}

/// Why a grid cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GridError {
    /// Too few cells for differences that know both neighbours.
    #[error("{cells} cells in direction {direction}; at least 4 are needed")]
    TooFew {
        /// 0, 1 or 2.
        direction: usize,
        /// The number asked for.
        cells: usize,
    },
    /// Not a length.
    #[error("a spacing of {0} m; it must be a positive number")]
    Spacing(f64),
}

impl Grid {
    /// A grid of so many cells of an edge length in m, from a lower corner in m.
    ///
    /// # Errors
    ///
    /// [`GridError`] for fewer than four cells in a direction or a spacing that is no length.
    pub fn new(cells: [usize; 3], spacing: f64, lower: Vector) -> Result<Grid, GridError> {
        if let Some(direction) = (0..3).find(|direction| cells[*direction] < 4) {
            return Err(GridError::TooFew { direction, cells: cells[direction] });
        }
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(GridError::Spacing(spacing));
        }
        Ok(Grid { cells, spacing, lower })
    }

    /// Cells in each direction.
    pub fn cells(&self) -> [usize; 3] {
        self.cells
    }

    /// Number of all cells.
    pub fn len(&self) -> usize {
        self.cells.iter().product()
    }

    /// Never: there are at least 64 cells.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Edge length of a cell in m.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Lower corner in m.
    pub fn lower(&self) -> Vector {
        self.lower
    }

    /// Edge lengths of the box in m.
    pub fn extent(&self) -> Vector {
        Vector::from(self.cells.map(|cells| cells as f64 * self.spacing))
    }

    /// Volume of the box in m^3.
    pub fn volume(&self) -> f64 {
        self.extent().product()
    }

    /// Place of a cell in a field.
    #[inline]
    pub fn index(&self, cell: [usize; 3]) -> usize {
        (cell[2] * self.cells[1] + cell[1]) * self.cells[0] + cell[0]
    }

    /// Place in a field of a cell counted on beyond the sides, in a box that repeats.
    #[inline]
    pub fn index_around(&self, cell: [isize; 3]) -> usize {
        let around = |direction: usize| cell[direction].rem_euclid(self.cells[direction] as isize) as usize;
        self.index([around(0), around(1), around(2)])
    }

    /// Place in a field of the next or the last cell in a direction, in a box that repeats.
    #[inline]
    pub fn neighbour(&self, cell: [usize; 3], direction: usize, step: isize) -> usize {
        let mut other = cell.map(|number| number as isize);
        other[direction] += step;
        self.index_around(other)
    }

    /// The cell at a place in a field.
    #[inline]
    pub fn cell(&self, index: usize) -> [usize; 3] {
        let row = index / self.cells[0];
        [index % self.cells[0], row % self.cells[1], row / self.cells[1]]
    }

    /// Where a value lives in m: component `Some(a)` of the velocity, or the pressure.
    #[inline]
    pub fn position(&self, component: Option<usize>, cell: [isize; 3]) -> Vector {
        self.lower + Vector::from_fn(|direction, _| (cell[direction] as f64 + self.offset(component, direction)) * self.spacing)
    }

    /// Place of a value within its cell in a direction, in spacings.
    #[inline]
    pub fn offset(&self, component: Option<usize>, direction: usize) -> f64 {
        if component == Some(direction) { 0.0 } else { 0.5 }
    }

    /// A point in m in units of cells, counted so that values of a component have whole numbers.
    #[inline]
    pub fn in_cells(&self, component: Option<usize>, point: &Vector) -> Vector {
        Vector::from_fn(|direction, _| (point[direction] - self.lower[direction]) / self.spacing - self.offset(component, direction))
    }
}

/// A velocity field in m/s, or a force density in N/m^3: one array a component, on faces.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FaceField {
    /// Components.
    pub component: [Vec<f64>; 3],
}

impl FaceField {
    /// A field of zeros.
    pub fn zeros(grid: &Grid) -> FaceField {
        FaceField { component: std::array::from_fn(|_| vec![0.0; grid.len()]) }
    }

    /// Each component from its position in m.
    pub fn from_fn(grid: &Grid, value: impl Fn(usize, Vector) -> f64) -> FaceField {
        let of_component = |component: usize| {
            let at = |index| value(component, grid.position(Some(component), grid.cell(index).map(|number| number as isize)));
            (0..grid.len()).map(at).collect()
        };
        FaceField { component: std::array::from_fn(of_component) }
    }

    /// Mean of each component over the box.
    pub fn mean(&self) -> Vector {
        Vector::from_fn(|component, _| {
            let values = &self.component[component];
            values.iter().sum::<f64>() / values.len() as f64
        })
    }
}

/// A field of pressures from their positions in m.
pub fn cell_field(grid: &Grid, value: impl Fn(Vector) -> f64) -> Vec<f64> {
    (0..grid.len()).map(|index| value(grid.position(None, grid.cell(index).map(|number| number as isize)))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stand_where_the_staggered_grid_has_them() {
        let grid = Grid::new([4, 5, 6], 0.5, Vector::new(1.0, -2.0, 0.0)).expect("enough cells");
        assert_eq!(grid.position(None, [0, 0, 0]), Vector::new(1.25, -1.75, 0.25));
        assert_eq!(grid.position(Some(1), [3, 0, 5]), Vector::new(2.75, -2.0, 2.75));
        assert_eq!(grid.in_cells(Some(1), &Vector::new(2.75, -2.0, 2.75)), Vector::new(3.0, 0.0, 5.0));
        assert_eq!((grid.extent(), grid.volume()), (Vector::new(2.0, 2.5, 3.0), 15.0));
    }

    #[test]
    fn cells_are_counted_first_direction_fastest_and_around() {
        let grid = Grid::new([4, 5, 6], 0.5, Vector::zeros()).expect("enough cells");
        for index in 0..grid.len() {
            assert_eq!(grid.index(grid.cell(index)), index);
        }
        assert_eq!((grid.index([1, 0, 0]), grid.index([0, 1, 0]), grid.index([0, 0, 1])), (1, 4, 20));
        assert_eq!(grid.index_around([-1, 5, -7]), grid.index([3, 0, 5]));
        assert_eq!(grid.neighbour([0, 4, 0], 1, 1), 0);
    }

    #[test]
    fn grids_that_are_none_are_refused() {
        assert_eq!(Grid::new([8, 3, 8], 0.5, Vector::zeros()), Err(GridError::TooFew { direction: 1, cells: 3 }));
        assert_eq!(Grid::new([8, 8, 0], 0.5, Vector::zeros()), Err(GridError::TooFew { direction: 2, cells: 0 }));
        for spacing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Grid::new([8; 3], spacing, Vector::zeros()), Err(GridError::Spacing(_))), "{spacing}");
        }
    }
}
