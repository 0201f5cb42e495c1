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

/// Vertices that are looked at together, without a branch for each.
pub const LANES: usize = 8;

/// Vertices on a surface, coordinate by coordinate, in the own frame of the shape, in m.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertices {
    /// First coordinates.
    pub x: Vec<f64>,
    /// Second coordinates.
    pub y: Vec<f64>,
    /// Third coordinates.
    pub z: Vec<f64>,
}

impl Vertices {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Which of [`LANES`] vertices from one on reach at least so far along a direction: a bit for each.
    #[inline]
    pub fn beyond(&self, start: usize, direction: &Vector, least: f64) -> u32 {
        let reach = |index: usize| self.x[index] * direction.x + self.y[index] * direction.y + self.z[index] * direction.z;
        if let (Some(x), Some(y), Some(z)) = (lanes(&self.x, start), lanes(&self.y, start), lanes(&self.z, start)) {
            let reaches: [f64; LANES] = std::array::from_fn(|lane| x[lane] * direction.x + y[lane] * direction.y + z[lane] * direction.z);
            return reaches.iter().enumerate().fold(0, |bits, (lane, reach)| bits | u32::from(*reach >= least) << lane);
        }
        (start..self.len()).fold(0, |bits, index| bits | u32::from(reach(index) >= least) << (index - start))
    }

    /// A vertex.
    #[inline]
    pub fn at(&self, index: usize) -> Vector {
        Vector::new(self.x[index], self.y[index], self.z[index])
    }
}

#[inline]
fn lanes(numbers: &[f64], start: usize) -> Option<&[f64; LANES]> {
    numbers.get(start..start + LANES)?.try_into().ok()
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
        let points = (0..in_each_angle)
            .flat_map(|row| (0..in_each_angle).map(move |column| (row, column)))
            .map(|(row, column)| self.surface_point(PI * (2.0 * part(column) - 1.0), upwards(row)));
        let mut vertices = Vertices { x: Vec::new(), y: Vec::new(), z: Vec::new() };
        for point in points {
            vertices.x.push(point.x);
            vertices.y.push(point.y);
            vertices.z.push(point.z);
        }
        vertices
    }
}

#[cfg(test)]
mod tests {
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

    /// S figure 2-3: the side of a cylinder has no vertices in equal steps, and some in equal ratios.
    #[test]
    fn exponential_spacing_covers_the_side_of_a_cylinder() {
        let shape = Superellipsoid::new(Vector::new(4.0, 4.0, 2.65), [0.1, 1.0]).unwrap();
        let on_the_side = |spacing| shape.vertices(20, spacing).z.iter().filter(|z| z.abs() < 0.5 * 2.65).count();
        assert_eq!((on_the_side(Spacing::Linear), on_the_side(Spacing::Exponential)), (0, 320));
    }
}
