//! Mass properties by counting cells, as source R does it.

use nalgebra::Matrix3;

use super::MassProperties;
use crate::Vector;
use crate::shape::{Convex, Part};

/// A box of equal cells, a chosen number along each axis (R section 2.3, figure 3.2).
///
/// A cell counts as a whole if its centre lies inside, so that
/// - the volume is the sum of the counted cells' volumes $v_i$,
/// - the centre is $\frac1V\sum X_i v_i$ (R eq. 3.11),
/// - second moments are $\sum (X_i - X_g)(X_i - X_g)^T v_i$, from which inertia follows (R eq. 3.12, which lacks the density: errata).
///
/// As in R, cells are points: their own second moments, `v h^2 / 12`, are left out.
///
/// The error is that of counting lattice points: whether a cell at the surface counts is as good as chance. Of about `S / h^2` such cells,
/// each wrong by up to half a cell, the sum is wrong by about `h^2 sqrt(S / 12)`: second order in the cell size. Where the surface is aligned
/// with the cells, whole rows err together: along a cylinder's axis the problem is that of counting in its cross-section, of order 3/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellGrid {
    lower: Vector,
    size: Vector,
    cells: [usize; 3],
}

/// Counted cells of a row, with their positions summed in whole numbers: nothing is rounded.
#[derive(Debug, Clone, Copy, Default)]
struct Row {
    count: u64,
    sum: u64,
    sum_of_squares: u64,
}

impl CellGrid {
    /// Cells that fill the box between two corners, in m.
    pub fn filling(lower: Vector, upper: Vector, cells_per_direction: usize) -> CellGrid {
        CellGrid { lower, size: (upper - lower) / cells_per_direction as f64, cells: [cells_per_direction; 3] }
    }

    /// Cells that fill the smallest box along the axes that holds all parts.
    pub fn around(parts: &[Part], cells_per_direction: usize) -> CellGrid {
        let boxes: Vec<PlacedPart> = parts.iter().map(PlacedPart::new).collect();
        let lower = boxes.iter().fold(Vector::repeat(f64::INFINITY), |lower, part| lower.inf(&part.lower));
        let upper = boxes.iter().fold(Vector::repeat(f64::NEG_INFINITY), |upper, part| upper.sup(&part.upper));
        CellGrid::filling(lower, upper, cells_per_direction)
    }

    /// Cells of the same size, moved back by a fraction (0 to 1) of a cell along each axis, and one more along each to fill the same box.
    #[must_use]
    pub fn shifted(&self, fraction: &Vector) -> CellGrid {
        CellGrid { lower: self.lower - self.size.component_mul(fraction), size: self.size, cells: self.cells.map(|cells| cells + 1) }
    }

    /// Edges of a cell, in m.
    pub fn size(&self) -> Vector {
        self.size
    }

    /// How many cells there are.
    pub fn number_of_cells(&self) -> u64 {
        self.cells.iter().map(|cells| *cells as u64).product()
    }

    /// Mass properties of the body that holds the points for which `contains` is true.
    pub fn mass(&self, contains: impl Fn(&Vector) -> bool) -> MassProperties {
        self.sum(|x, y| self.row(|layer| contains(&Vector::new(x, y, self.centre(2, layer)))))
    }

    /// Mass properties of the union of parts.
    pub fn mass_of_parts(&self, parts: &[Part]) -> MassProperties {
        let parts: Vec<PlacedPart> = parts.iter().map(PlacedPart::new).collect();
        let mut inside = vec![false; self.cells[2]];
        self.sum(|x, y| {
            inside.fill(false);
            parts.iter().filter(|part| part.may_hold(x, y)).for_each(|part| self.mark(part, x, y, &mut inside));
            self.row(|layer| inside[layer])
        })
    }

    /// Marks the cells of the row at x and y that a part holds.
    fn mark(&self, part: &PlacedPart<'_>, x: f64, y: f64, inside: &mut [bool]) {
        let lowest = part.turn * (Vector::new(x, y, self.centre(2, 0)) - part.part.position);
        let step = part.turn * Vector::new(0.0, 0.0, self.size.z);
        let convex = &part.part.convex;
        let layers = self.layers(part.lower.z, part.upper.z);
        for (cell, layer) in inside[layers.clone()].iter_mut().zip(layers) {
            *cell |= convex.contains(&(lowest + step * layer as f64));
        }
    }

    /// Centre of a cell along an axis, in m.
    fn centre(&self, axis: usize, index: usize) -> f64 {
        self.lower[axis] + (index as f64 + 0.5) * self.size[axis]
    }

    /// The layers along z that may have their centre between two heights.
    fn layers(&self, lower: f64, upper: f64) -> std::ops::Range<usize> {
        let index = |height: f64| ((height - self.lower.z) / self.size.z).clamp(0.0, self.cells[2] as f64);
        index(lower).floor() as usize..index(upper).ceil() as usize
    }

    /// Sums over the layers of a row that are inside.
    fn row(&self, inside: impl Fn(usize) -> bool) -> Row {
        let mut row = Row::default();
        for layer in (0..self.cells[2]).filter(|layer| inside(*layer)) {
            let position = layer as u64;
            row.count += 1;
            row.sum += position;
            row.sum_of_squares += position * position;
        }
        row
    }

    /// Sums of all rows, given the counted cells of the row at x and y.
    fn sum(&self, mut row_at: impl FnMut(f64, f64) -> Row) -> MassProperties {
        let middle = self.lower + 0.5 * self.size.component_mul(&Vector::from(self.cells.map(|cells| cells as f64)));
        let (mut count, mut first, mut second) = (0.0, Vector::zeros(), Matrix3::zeros());
        for i in 0..self.cells[0] {
            let x = self.centre(0, i);
            for j in 0..self.cells[1] {
                let y = self.centre(1, j);
                let row = row_at(x, y);
                let (number, base, size) = (row.count as f64, self.centre(2, 0) - middle.z, self.size.z);
                let (sum, squares) = (row.sum as f64, row.sum_of_squares as f64);
                let along = base * number + size * sum;
                let across = Vector::new(x - middle.x, y - middle.y, 0.0);
                count += number;
                first += across * number + Vector::z() * along;
                second += across * across.transpose() * number;
                second += (across * Vector::z().transpose() + Vector::z() * across.transpose()) * along;
                second[(2, 2)] += base * base * number + 2.0 * base * size * sum + size * size * squares;
            }
        }
        if count == 0.0 {
            return MassProperties::nothing();
        }
        let cell = self.size.product();
        let mut properties = MassProperties::from_raw_moments(count * cell, first * cell, second * cell);
        properties.centre += middle;
        properties
    }
}

/// A part with what is needed to ask it often.
struct PlacedPart<'a> {
    part: &'a Part,
    /// From the frame of the body to that of the part.
    turn: Matrix3<f64>,
    lower: Vector,
    upper: Vector,
}

impl PlacedPart<'_> {
    fn new(part: &Part) -> PlacedPart<'_> {
        let turn = part.orientation.to_rotation_matrix();
        // A ball is the same from all sides; a box about anything else fits its own box.
        let extent = match &part.convex {
            Convex::Sphere(sphere) => Vector::repeat(sphere.radius),
            Convex::Cylinder(cylinder) => {
                let axis = turn.matrix().column(2);
                axis.map(|along| 0.5 * cylinder.length * along.abs() + cylinder.radius * (1.0 - along * along).max(0.0).sqrt())
            }
            other => turn.matrix().abs() * other.half_extent(),
        };
        PlacedPart { part, turn: turn.matrix().transpose(), lower: part.position - extent, upper: part.position + extent }
    }

    fn may_hold(&self, x: f64, y: f64) -> bool {
        self.lower.x <= x && x <= self.upper.x && self.lower.y <= y && y <= self.upper.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Orientation;
    use crate::shape::{Cuboid, Cylinder, Polyhedron, Sphere, Spherocylinder};

    fn placed(convex: Convex) -> Part {
        Part { convex, position: Vector::new(0.3, -2.0, 1.0), orientation: Orientation::from_euler_angles(0.3, -0.5, 1.1) }
    }

    /// A box aligned with its cells has no error but that of taking cells as points: n layers of width h have the mean square
    /// `h^2 (n^2 - 1) / 12` instead of `h^2 n^2 / 12`.
    #[test]
    fn a_box_is_found_exactly_but_for_the_size_of_its_cells() {
        let part = Part {
            convex: Convex::Cuboid(Cuboid { lengths: Vector::new(1.0, 2.0, 3.0) }),
            position: Vector::x(),
            orientation: Orientation::identity(),
        };
        let found = CellGrid::around(std::slice::from_ref(&part), 10).mass_of_parts(&[part]);
        assert!((found.volume - 6.0).abs() < 16.0 * f64::EPSILON);
        assert!((found.centre - Vector::x()).norm() < 16.0 * f64::EPSILON);
        let expected = Matrix3::from_diagonal(&(Vector::new(1.0, 4.0, 9.0) * (6.0 / 12.0 * (1.0 - 0.01))));
        assert!((found.second_moments - expected).norm() < 64.0 * f64::EPSILON, "{}", found.second_moments);
    }

    /// Independent: the closed forms of all convex shapes, turned and moved, within a few times the error by chance at the surface.
    #[test]
    fn all_shapes_are_found_to_second_order() {
        let shapes = [
            Convex::Sphere(Sphere { radius: 0.5 }),
            Convex::Cuboid(Cuboid { lengths: Vector::new(1.0, 0.7, 0.4) }),
            Convex::Cylinder(Cylinder { radius: 0.4, length: 0.9 }),
            Convex::Spherocylinder(Spherocylinder { radius: 0.3, length: 0.5 }),
            Convex::Polyhedron(std::sync::Arc::new(Polyhedron::icosahedron(0.5).unwrap())),
        ];
        for part in shapes.map(placed) {
            let grid = CellGrid::around(std::slice::from_ref(&part), 80);
            let found = grid.shifted(&Vector::new(0.31, 0.77, 0.12)).mass_of_parts(std::slice::from_ref(&part));
            let expected = part.convex.mass_properties().placed(part.position, &part.orientation);
            // Surfaces of bodies of size 1 are about 3; the chance of a cell is uniform.
            let by_chance = grid.size.amax().powi(2) * (3.0_f64 / 12.0).sqrt();
            let name = part.convex.name();
            assert!((found.volume - expected.volume).abs() < 3.0 * by_chance, "{name} {} {by_chance}", found.volume - expected.volume);
            assert!((found.centre - expected.centre).norm() < 3.0 * by_chance, "{name}");
            assert!((found.second_moments - expected.second_moments).norm() < 3.0 * by_chance, "{name}");
        }
    }

    /// The closed question and the parts with their boxes must count the same cells.
    #[test]
    fn skipping_by_boxes_changes_nothing() {
        let mut parts = vec![placed(Convex::Cylinder(Cylinder { radius: 0.2, length: 1.5 }))];
        parts.push(Part {
            convex: Convex::Sphere(Sphere { radius: 0.4 }),
            position: Vector::new(0.9, -2.0, 1.2),
            orientation: Orientation::identity(),
        });
        parts
            .push(Part { position: Vector::new(0.3, -1.6, 1.4), ..placed(Convex::Cuboid(Cuboid { lengths: Vector::new(0.1, 1.0, 0.3) })) });
        let grid = CellGrid::around(&parts, 40).shifted(&Vector::new(0.2, 0.4, 0.6));
        let inside =
            |point: &Vector| parts.iter().any(|part| part.convex.contains(&(part.orientation.inverse() * (point - part.position))));
        let (by_parts, by_points) = (grid.mass_of_parts(&parts), grid.mass(inside));
        assert_eq!(by_parts.volume, by_points.volume);
        assert!((by_parts.second_moments - by_points.second_moments).norm() < 1e-14);
        assert_eq!(grid.mass(|_| false), MassProperties::nothing());
        assert_eq!(grid.number_of_cells(), 41 * 41 * 41);
    }
}
