//! The surface of a superellipsoid as a cloud of vertices (S section 2.1, figure 2-3).

use std::f64::consts::{FRAC_PI_2, PI};

use super::Superellipsoid;
use crate::Vector;

/// How the angle from the plane of x and y is spaced.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Spacing {
    /// In equal steps: on a cylinder almost all vertices come to lie at the rims.
    #[default]
    Linear,
    /// In equal ratios: the lowest vertices lie at one part in `N` of the height, so that a straight side has some too.
    Exponential,
}

/// Numbers that are looked at together, without a branch for each.
const LANES: usize = 8;
/// Rounding of a reach, over the farthest vertex.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Vertices on a surface, in the own frame of the shape, in m: row by row, each row at a height of its own.
///
/// All rows lie on the outline of the shape, made smaller. How far a row can reach in a direction follows from the reach of the outline, so that whole rows
/// are passed over at once.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertices {
    count: usize,
    points: Blocks<3>,
    /// Outward unit normals.
    normals: Vec<Vector>,
    in_each_row: usize,
    /// Heights of the rows, and their widths over that of the shape.
    rows: Blocks<2>,
    /// No vertex is farther from the centre.
    size: f64,
}

/// Points of some coordinates, lane by lane.
#[derive(Debug, Clone, PartialEq)]
struct Blocks<const AXES: usize>(Vec<[[f64; LANES]; AXES]>);

impl<const AXES: usize> Blocks<AXES> {
    /// Where the last block is not full, the last point stands in it again.
    fn new(points: &[[f64; AXES]]) -> Blocks<AXES> {
        let block =
            |points: &[[f64; AXES]]| std::array::from_fn(|axis| std::array::from_fn(|lane| points[lane.min(points.len() - 1)][axis]));
        Blocks(points.chunks(LANES).map(block).collect())
    }

    #[inline]
    fn at(&self, index: usize) -> [f64; AXES] {
        let block = &self.0[index / LANES];
        std::array::from_fn(|axis| block[axis][index % LANES])
    }
}

#[inline]
fn reaches<const AXES: usize>(block: &[[f64; LANES]; AXES], direction: &[f64; AXES]) -> [f64; LANES] {
    std::array::from_fn(|lane| (1..AXES).fold(block[0][lane] * direction[0], |reach, axis| reach + block[axis][lane] * direction[axis]))
}

/// Which points of a block reach at least so far in a direction: a bit for each.
#[inline]
fn beyond<const AXES: usize>(block: &[[f64; LANES]; AXES], direction: &[f64; AXES], least: f64) -> u32 {
    const BITS: [f64; LANES] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0];
    let reaches = reaches(block, direction);
    // Added as numbers and two by two, as the lanes of a register are.
    let bits: [f64; LANES] = std::array::from_fn(|lane| if reaches[lane] >= least { BITS[lane] } else { 0.0 });
    let halves: [f64; LANES / 2] = std::array::from_fn(|lane| bits[lane] + bits[lane + LANES / 2]);
    let quarters: [f64; LANES / 4] = std::array::from_fn(|lane| halves[lane] + halves[lane + LANES / 4]);
    (quarters[0] + quarters[1]) as u32
}

impl Vertices {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// A vertex.
    #[inline]
    pub fn at(&self, index: usize) -> Vector {
        self.points.at(index).into()
    }

    /// The outward unit normal of the surface at a vertex.
    #[inline]
    pub fn normal_at(&self, index: usize) -> &Vector {
        &self.normals[index]
    }

    /// Calls for every vertex that reaches at least so far along a unit direction, one after the other, and maybe for some that fall short by rounding; the
    /// reach of the outline of the shape along it is given.
    #[inline]
    pub fn beyond(&self, direction: &Vector, of_outline: f64, least: f64, mut call: impl FnMut(usize)) {
        let least = least - ROUNDING * (self.size + least.abs());
        let direction: [f64; 3] = (*direction).into();
        let mut next = 0;
        for (first_row, rows) in self.rows.0.iter().enumerate() {
            for row in places(beyond(rows, &[direction[2], of_outline], least)) {
                let row = first_row * LANES + row;
                // Blocks of vertices do not end where rows do.
                let (start, end) = (row * self.in_each_row / LANES, ((row + 1) * self.in_each_row).div_ceil(LANES));
                let start = start.max(next);
                next = end;
                for (number, block) in self.points.0.iter().enumerate().take(end).skip(start) {
                    for lane in places(beyond(block, &direction, least)) {
                        let index = number * LANES + lane;
                        if index < self.count {
                            call(index);
                        }
                    }
                }
            }
        }
    }
}

/// Places of the bits that are set.
#[inline]
fn places(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        place
    })
}

impl Superellipsoid {
    /// A number of vertices in each angle, so its square in all. S does not say where its angles begin: here they stand at the middles of equal
    /// parts, so that no two vertices coincide at the poles or at the seam.
    pub fn vertices(&self, in_each_angle: usize, spacing: Spacing) -> Vertices {
        let part = |index: usize| (index as f64 + 0.5) / in_each_angle as f64;
        let upwards = |index: usize| {
            let along = 2.0 * part(index) - 1.0;
            match spacing {
                Spacing::Linear => FRAC_PI_2 * along,
                Spacing::Exponential => {
                    let lowest = (in_each_angle as f64).ln() / self.exponents()[0];
                    (FRAC_PI_2 * (-lowest * (1.0 - along.abs())).exp()).copysign(along)
                }
            }
        };
        let about = |index: usize| PI * (2.0 * part(index) - 1.0);
        let each = || 0..in_each_angle;
        let points: Vec<Vector> = each()
            .flat_map(|row| each().map(move |column| (row, column)))
            .map(|(row, column)| self.surface_point(about(column), upwards(row)))
            .collect();
        let of_points: Vec<[f64; 3]> = points.iter().map(|point| (*point).into()).collect();
        // Over the first axis the outline is as wide as the shape.
        let row = |row: usize| {
            let point = self.surface_point(0.0, upwards(row));
            [point.z, point.x / self.semi_axes().x]
        };
        Vertices {
            count: points.len(),
            points: Blocks::new(&of_points),
            normals: points.iter().map(|point| self.gradient_of_gauge(point).normalize()).collect(),
            in_each_row: in_each_angle,
            rows: Blocks::new(&each().map(row).collect::<Vec<_>>()),
            size: self.bounding_radius(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{directions, samples};
    use super::*;

    #[test]
    fn vertices_lie_on_the_surface_and_nowhere_twice() {
        let shape = Superellipsoid::new(Vector::new(4.0, 4.0, 2.65), [0.1, 1.0]).unwrap();
        for spacing in [Spacing::Linear, Spacing::Exponential] {
            let vertices = shape.vertices(20, spacing);
            assert_eq!(vertices.len(), 400);
            for index in 0..vertices.len() {
                let vertex = vertices.at(index);
                assert!((shape.gauge(&vertex) - 1.0).abs() < 1e-13);
                assert!((0..index).all(|other| vertices.at(other) != vertex));
            }
        }
    }

    /// Slow twin: one vertex after the other.
    #[test]
    fn every_vertex_that_reaches_far_enough_is_called_once_and_in_order() {
        for (shape, in_each_angle) in samples().iter().zip([4, 8, 13, 20, 31].into_iter().cycle()) {
            for spacing in [Spacing::Linear, Spacing::Exponential] {
                let vertices = shape.vertices(in_each_angle, spacing);
                for (index, direction) in directions().step_by(3).enumerate() {
                    let direction = direction.normalize();
                    let reach = |index: usize| vertices.at(index).dot(&direction);
                    // A cap of any thickness, and one that ends at a vertex.
                    let reach_of_shape = shape.support(&direction).dot(&direction);
                    let at_a_vertex = reach((31 * index) % vertices.len());
                    for least in [0.999, 0.9, 0.3, -2.0].map(|part| part * reach_of_shape).into_iter().chain([at_a_vertex]) {
                        let mut found = Vec::new();
                        vertices.beyond(&direction, shape.reach(&direction).of_outline, least, |index| found.push(index));
                        let rounding = 64.0 * f64::EPSILON * shape.bounding_radius();
                        let all = |least: f64| (0..vertices.len()).filter(move |index| reach(*index) >= least);
                        assert!(all(least).all(|index| found.contains(&index)));
                        assert!(found.iter().all(|index| reach(*index) >= least - rounding));
                        assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
                    }
                }
            }
        }
    }

    /// S figure 2-3: the side of a cylinder has no vertices in equal steps, and some in equal ratios.
    #[test]
    fn exponential_spacing_covers_the_side_of_a_cylinder() {
        let shape = Superellipsoid::new(Vector::new(4.0, 4.0, 2.65), [0.1, 1.0]).unwrap();
        let on_the_side = |spacing| {
            let vertices = shape.vertices(20, spacing);
            (0..400).filter(|index| vertices.at(*index).z.abs() < 0.5 * 2.65).count()
        };
        assert_eq!((on_the_side(Spacing::Linear), on_the_side(Spacing::Exponential)), (0, 320));
    }
}
