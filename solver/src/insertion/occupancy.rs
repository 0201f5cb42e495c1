//! Which places are taken: balls in a grid of cells.

use crate::Vector;

/// Cells for each ball that is expected.
const CELLS_FOR_A_BALL: f64 = 2.0;

/// Balls in a grid of cells at least as wide as the largest of them. Balls outside the grid belong to its outermost cells.
#[derive(Debug, Clone)]
pub struct Occupancy {
    lower: Vector,
    /// Cells per metre along each axis.
    per_length: Vector,
    cells: [usize; 3],
    /// Last ball of each cell, and for each ball the one before it.
    last: Vec<u32>,
    before: Vec<u32>,
    balls: Vec<(Vector, f64)>,
}

/// No ball.
const NONE: u32 = u32::MAX;

impl Occupancy {
    /// An empty grid over a box, for about so many balls of at most a radius (in m, above zero).
    pub fn new(lower: Vector, upper: Vector, largest_radius: f64, expected: usize) -> Occupancy {
        let lengths = (upper - lower).sup(&Vector::zeros());
        let diameter = 2.0 * largest_radius;
        // No more cells than balls can fill: halving the number along the axis that has most never lets cells become too narrow.
        let largest = (CELLS_FOR_A_BALL * expected as f64).max(8.0);
        let mut cells = lengths.map(|length| (length / diameter).floor().clamp(1.0, largest));
        while cells.product() > largest {
            let most = cells.imax();
            cells[most] = (0.5 * cells[most]).floor().max(1.0);
        }
        let per_length = cells.zip_map(&lengths, |count, length| if length > 0.0 { count / length } else { 0.0 });
        let cells: [usize; 3] = cells.map(|count| count as usize).into();
        Occupancy { lower, per_length, cells, last: vec![NONE; cells.iter().product()], before: Vec::new(), balls: Vec::new() }
    }

    /// The cell of a point along each axis.
    fn cell(&self, position: &Vector) -> [usize; 3] {
        std::array::from_fn(|axis| {
            let place = (position[axis] - self.lower[axis]) * self.per_length[axis];
            (place.max(0.0) as usize).min(self.cells[axis] - 1)
        })
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.cells[0] * (y + self.cells[1] * z)
    }

    /// Adds a ball. One larger than the grid was made for is looked for in too few cells.
    pub fn add(&mut self, position: Vector, radius: f64) {
        let cell = self.index(self.cell(&position));
        self.before.push(std::mem::replace(&mut self.last[cell], self.balls.len() as u32));
        self.balls.push((position, radius));
    }

    /// Whether a ball overlaps none of those that are there. Balls that touch do not overlap.
    pub fn is_free(&self, position: &Vector, radius: f64) -> bool {
        let [x, y, z] = self.cell(position);
        let around = |place: usize, axis: usize| place.saturating_sub(1)..(place + 2).min(self.cells[axis]);
        for k in around(z, 2) {
            for j in around(y, 1) {
                for i in around(x, 0) {
                    let mut ball = self.last[self.index([i, j, k])];
                    while ball != NONE {
                        let (other, other_radius) = &self.balls[ball as usize];
                        let reach = radius + other_radius;
                        if (other - position).norm_squared() < reach * reach {
                            return false;
                        }
                        ball = self.before[ball as usize];
                    }
                }
            }
        }
        true
    }

    /// Number of balls.
    pub fn len(&self) -> usize {
        self.balls.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.balls.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::insertion::Draws;

    /// In boxes of any form, with balls of many sizes, inside and outside: what a look at all balls says.
    #[test]
    fn the_grid_sees_what_all_pairs_see() {
        for (seed, upper) in [(1, [1.0, 1.0, 1.0]), (2, [10.0, 0.1, 0.0]), (3, [0.01, 0.01, 100.0]), (4, [0.0; 3])] {
            let (lower, upper) = (Vector::zeros(), Vector::from(upper));
            let mut grid = Occupancy::new(lower, upper, 0.1, 300);
            assert!(grid.cells.iter().product::<usize>() <= 600);
            let mut balls: Vec<(Vector, f64)> = Vec::new();
            let (mut free, mut taken) = (0, 0);
            for place in 0..2000 {
                let mut draws = Draws::new(seed, 0, place);
                let position = draws.in_box(&(lower - Vector::repeat(0.3)), &(upper + Vector::repeat(0.3)));
                let radius = draws.between([0.001, 0.1]);
                let expected = balls.iter().all(|(other, size)| (other - position).norm() >= radius + size);
                assert_eq!(grid.is_free(&position, radius), expected, "{seed} {place}");
                if expected {
                    grid.add(position, radius);
                    balls.push((position, radius));
                }
                *(if expected { &mut free } else { &mut taken }) += 1;
            }
            assert!(free > 20 && taken > 20 && grid.len() == free, "{free} {taken}");
        }
    }

    #[test]
    fn balls_that_touch_do_not_overlap() {
        let mut grid = Occupancy::new(Vector::zeros(), Vector::repeat(4.0), 0.5, 10);
        grid.add(Vector::repeat(1.0), 0.5);
        assert!(grid.is_free(&Vector::new(2.0, 1.0, 1.0), 0.5) && !grid.is_free(&Vector::new(1.999, 1.0, 1.0), 0.5));
    }
}
