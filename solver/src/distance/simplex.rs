//! The point nearest to the origin of a simplex of up to four points, and the smallest face that holds it.
//!
//! Source: the Voronoi regions of Ericson, Real-Time Collision Detection (2005), section 5.1, seen from the origin. A tetrahedron that is flat to
//! rounding has no inside: its faces stay candidates, else a distance of zero would be found where there is none.

use crate::Vector;

/// A tetrahedron flatter than this, relative to its base times its edge, has no inside.
const FLAT: f64 = 1e-11;

/// A triangle whose edges enclose a smaller sine than this has no normal.
const SLIVER: f64 = 1e-10;

/// A point of the difference of two bodies, and the point of the first body that it comes from.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Corner {
    /// Point of the second body less point of the first.
    pub difference: Vector,
    /// Point of the first body.
    pub on_first: Vector,
    /// Number of the corner of each body.
    pub numbers: [u32; 2],
}

/// The point of a simplex that is nearest to the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// Point of the second body less point of the first.
    pub difference: Vector,
    /// Point of the first body.
    pub on_first: Vector,
}

/// Up to four corners with the weights of the point nearest to the origin.
#[derive(Debug, Clone, Copy, Default)]
pub struct Simplex {
    corners: [Corner; 4],
    weights: [f64; 4],
    count: usize,
}

impl Simplex {
    /// The corners in use.
    #[inline]
    pub fn corners(&self) -> &[Corner] {
        &self.corners[..self.count]
    }

    /// The nearest point as a weighted sum of corners, which cannot leave the sets, and the point of the first body that belongs to it.
    #[inline]
    pub fn nearest(&self) -> Foot {
        let mut sum = Foot { difference: Vector::zeros(), on_first: Vector::zeros() };
        for (corner, weight) in self.corners().iter().zip(&self.weights) {
            sum.difference += corner.difference * *weight;
            sum.on_first += corner.on_first * *weight;
        }
        sum
    }

    /// Adds a corner without looking for the nearest point.
    #[inline]
    pub fn push(&mut self, corner: Corner) {
        self.corners[self.count] = corner;
        self.count += 1;
    }

    /// Adds a corner and reduces the simplex to the face that is nearest to the origin. Returns the nearest point; zero if the origin is inside.
    #[inline]
    pub fn add(&mut self, corner: Corner) -> Vector {
        let nearest = self.with(corner);
        self.keep(&nearest);
        nearest.point
    }

    /// The face nearest to the origin if a corner were added. Nothing changes until it is [kept](Simplex::keep).
    #[inline]
    pub fn with(&mut self, corner: Corner) -> Nearest {
        // The place behind the last corner is free.
        self.corners[self.count] = corner;
        match self.count {
            0 => Nearest::corner(corner.difference, 0),
            1 => nearest_on_segment(&self.points([0, 1])),
            2 => nearest_on_triangle(&self.points([0, 1, 2]), [0, 1, 2]),
            _ => self.nearest_on_tetrahedron(),
        }
    }

    /// Reduces the simplex to the corners that hold the point nearest to the origin.
    #[inline]
    pub fn keep(&mut self, nearest: &Nearest) {
        for (place, from) in nearest.places[..nearest.count.min(3)].iter().enumerate() {
            // Places rise, so that no corner is overwritten before it has moved.
            self.corners[place] = self.corners[*from];
            self.weights[place] = nearest.weights[place];
        }
        self.count = nearest.count;
    }

    #[inline]
    fn points<const N: usize>(&self, places: [usize; N]) -> [Vector; N] {
        places.map(|place| self.corners[place].difference)
    }

    /// The newest corner is the last; the face opposite to it was nearest before and cannot be again.
    #[inline]
    fn nearest_on_tetrahedron(&self) -> Nearest {
        let newest = self.corners[3].difference;
        let mut best: Option<Nearest> = None;
        for [one, other, opposite] in [[0, 1, 2], [1, 2, 0], [0, 2, 1]] {
            let [one_edge, other_edge, opposite_edge] = self.points([one, other, opposite]).map(|point| point - newest);
            let normal = one_edge.cross(&other_edge);
            let (height, side) = (opposite_edge.dot(&normal), -newest.dot(&normal));
            let is_flat = height * height <= FLAT * FLAT * normal.norm_squared() * opposite_edge.norm_squared();
            if is_flat || height * side < 0.0 {
                let nearest = nearest_on_triangle(&self.points([one, other, 3]), [one, other, 3]);
                if best.as_ref().is_none_or(|best| nearest.point.norm_squared() < best.point.norm_squared()) {
                    best = Some(nearest);
                }
            }
        }
        best.unwrap_or(Nearest { point: Vector::zeros(), places: [0, 1, 2], weights: [0.0; 3], count: 4 })
    }
}

/// The nearest point, and which corners hold it with which weights.
#[derive(Debug, Clone, Copy)]
pub struct Nearest {
    /// The point; zero if the origin lies inside.
    pub point: Vector,
    places: [usize; 3],
    weights: [f64; 3],
    count: usize,
}

impl Nearest {
    #[inline]
    fn corner(point: Vector, place: usize) -> Nearest {
        Nearest { point, places: [place, 0, 0], weights: [1.0, 0.0, 0.0], count: 1 }
    }

    /// At a fraction of the way between two corners.
    #[inline]
    fn edge(from: Vector, to: Vector, fraction: f64, places: [usize; 2]) -> Nearest {
        let point = from + (to - from) * fraction;
        Nearest { point, places: [places[0], places[1], 0], weights: [1.0 - fraction, fraction, 0.0], count: 2 }
    }
}

#[inline]
fn nearest_on_segment([from, to]: &[Vector; 2]) -> Nearest {
    let edge = to - from;
    let (along, squared) = (-from.dot(&edge), edge.norm_squared());
    if along <= 0.0 {
        Nearest::corner(*from, 0)
    } else if along >= squared {
        Nearest::corner(*to, 1)
    } else {
        Nearest::edge(*from, *to, along / squared, [0, 1])
    }
}

#[inline]
fn nearest_on_triangle([a, b, c]: &[Vector; 3], places: [usize; 3]) -> Nearest {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (-ab.dot(a), -ac.dot(a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return Nearest::corner(*a, places[0]);
    }
    let (d3, d4) = (-ab.dot(b), -ac.dot(b));
    if d3 >= 0.0 && d4 <= d3 {
        return Nearest::corner(*b, places[1]);
    }
    let (d5, d6) = (-ab.dot(c), -ac.dot(c));
    if d6 >= 0.0 && d5 <= d6 {
        return Nearest::corner(*c, places[2]);
    }
    let weight_c = d1 * d4 - d3 * d2;
    if weight_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return Nearest::edge(*a, *b, d1 / (d1 - d3), [places[0], places[1]]);
    }
    let weight_b = d5 * d2 - d1 * d6;
    if weight_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return Nearest::edge(*a, *c, d2 / (d2 - d6), [places[0], places[2]]);
    }
    let weight_a = d3 * d6 - d5 * d4;
    if weight_a <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return Nearest::edge(*b, *c, (d4 - d3) / ((d4 - d3) + (d5 - d6)), [places[1], places[2]]);
    }
    let normal = ab.cross(&ac);
    if normal.norm_squared() <= SLIVER * SLIVER * ab.norm_squared() * ac.norm_squared() {
        return nearest_on_sliver([*a, *b, *c], places);
    }
    let scale = 1.0 / (weight_a + weight_b + weight_c);
    let weights = [weight_a * scale, weight_b * scale, weight_c * scale];
    // The foot of the perpendicular: keeps its direction where the weighted sum of corners would lose it.
    let point = normal * (normal.dot(a) / normal.norm_squared());
    Nearest { point, places, weights, count: 3 }
}

/// A triangle without a plane of its own: the nearest of its edges.
#[cold]
fn nearest_on_sliver(points: [Vector; 3], places: [usize; 3]) -> Nearest {
    let edges = [[0, 1], [0, 2], [1, 2]].map(|[from, to]| {
        let mut nearest = nearest_on_segment(&[points[from], points[to]]);
        for place in &mut nearest.places {
            *place = places[[from, to][*place]];
        }
        nearest
    });
    let nearer = |best: Nearest, edge: Nearest| if edge.point.norm_squared() < best.point.norm_squared() { edge } else { best };
    nearer(nearer(edges[0], edges[1]), edges[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64, y: f64, z: f64) -> Corner {
        Corner { difference: Vector::new(x, y, z), on_first: Vector::zeros(), numbers: [0; 2] }
    }

    #[test]
    fn the_nearest_point_of_each_kind_of_face_is_found() {
        let mut simplex = Simplex::default();
        simplex.add(corner(2.0, 1.0, 1.0));
        assert_eq!(simplex.add(corner(-1.0, 1.0, 1.0)), Vector::new(0.0, 1.0, 1.0));
        assert_eq!(simplex.corners().len(), 2);
        let point = simplex.add(corner(0.0, -1.0, 1.0));
        assert!((point - Vector::z()).norm() < 1e-15 && simplex.corners().len() == 3);
        assert_eq!(simplex.add(corner(0.0, 0.0, -1.0)), Vector::zeros());
    }

    #[test]
    fn a_flat_tetrahedron_has_no_inside() {
        let mut simplex = Simplex::default();
        simplex.add(corner(1.0, 0.0, 1.0));
        simplex.add(corner(-1.0, 1.0, 1.0));
        simplex.add(corner(-1.0, -1.0, 1.0));
        let point = simplex.add(corner(0.1, 0.0, 1.0 - 1e-16));
        assert!((point - Vector::z()).norm() < 1e-14, "{point}");
    }
}
