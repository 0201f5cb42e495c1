//! The convex hull of points, with whole faces instead of triangles.

use super::faces::{check_closed, coincident, plane, plane_tolerance, rounding, size};
use super::{Polyhedron, PolyhedronError};
use crate::Vector;
use crate::shape::parry::{hull_triangles, spread_out};

impl Polyhedron {
    /// The convex hull of points in m. Its corners are the points that were given, to the bit, less the offset; points that are no corners
    /// (inside, in a face, on an edge, or twice) are left out.
    ///
    /// # Errors
    ///
    /// Points that are not finite numbers, fewer than four, all in one plane, or so close to degenerate that the hull is lost in rounding.
    pub fn hull(points: &[Vector]) -> Result<Polyhedron, PolyhedronError> {
        let faces = hull_faces(points)?;
        let (corners, faces) = used_only(points, faces);
        Polyhedron::from_faces(corners, faces)
    }
}

/// The faces of the convex hull, by index of the points, counterclockwise seen from outside.
pub(super) fn hull_faces(points: &[Vector]) -> Result<Vec<Vec<usize>>, PolyhedronError> {
    if let Some(vertex) = points.iter().position(|point| !point.iter().all(|coordinate| coordinate.is_finite())) {
        return Err(PolyhedronError::NotFinite { vertex });
    }
    let tolerance = rounding(points);
    let distinct = distinct(points, tolerance);
    if distinct.len() < 4 {
        return Err(PolyhedronError::TooFew { vertices: distinct.len(), faces: 0 });
    }
    let places: Vec<Vector> = distinct.iter().map(|index| points[*index]).collect();
    let spread = spread_out(&places).ok_or(PolyhedronError::Flat)?;
    let attempt = |jitter: &f64| faces_of(&places, &hull_triangles(&jittered(&spread, *jitter))?, tolerance);
    let faces = JITTERS.iter().find_map(attempt).ok_or(PolyhedronError::NoHull)?;
    Ok(faces.into_iter().map(|face| face.into_iter().map(|corner| distinct[corner]).collect()).collect())
}

/// By how much points are moved at random, in units of their standard deviation, in one attempt after the other. Points in general position
/// are what quick hulls are good at; as faces are found from the points as they are, moving them costs no accuracy.
const JITTERS: [f64; 7] = [0.0, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5];

/// The points, each moved by up to `jitter` along every axis; the same for the same points.
fn jittered(points: &[Vector], jitter: f64) -> Vec<Vector> {
    // Multiples of numbers that are far from any fraction spread evenly over a period: powers of the root of x^4 = x + 1.
    let steps = Vector::new(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    let moved = |(index, point): (usize, &Vector)| point + steps.map(|step| jitter * (2.0 * (index as f64 * step).fract() - 1.0));
    points.iter().enumerate().map(moved).collect()
}

/// The faces that triangles make up, if they are those of a convex hull of all points.
fn faces_of(points: &[Vector], triangles: &[[usize; 3]], tolerance: f64) -> Option<Vec<Vec<usize>>> {
    let planes = planes(points, triangles, tolerance);
    let outside = |plane: &Plane| points.iter().any(|point| plane.height(point) > plane.tolerance);
    if planes.iter().any(outside) {
        return None;
    }
    let faces: Vec<Vec<usize>> = planes.iter().map(|plane| plane.outline(points)).collect();
    check_closed(&faces).ok()?;
    Some(faces)
}

/// Indices of the points less those that repeat another.
fn distinct(points: &[Vector], tolerance: f64) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..points.len()).collect();
    loop {
        let places: Vec<Vector> = kept.iter().map(|index| points[*index]).collect();
        match coincident(&places, tolerance) {
            Some((_, second)) => drop(kept.remove(second)),
            None => return kept,
        }
    }
}

/// The plane of a face.
struct Plane {
    normal: Vector,
    point: Vector,
    tolerance: f64,
}

impl Plane {
    fn height(&self, point: &Vector) -> f64 {
        self.normal.dot(&(point - self.point))
    }

    /// Corners of the convex outline of all points in the plane, counterclockwise seen from outside; points on its edges are left out.
    /// By Andrew's monotone chain.
    fn outline(&self, points: &[Vector]) -> Vec<usize> {
        let along = self.normal.cross(&Vector::ith(self.normal.iamin(), 1.0)).normalize();
        let across = self.normal.cross(&along);
        let flat = |index: &usize| (along.dot(&points[*index]), across.dot(&points[*index]));
        let mut order: Vec<usize> = (0..points.len()).filter(|index| self.height(&points[*index]).abs() <= self.tolerance).collect();
        order.sort_by(|left, right| flat(left).partial_cmp(&flat(right)).unwrap_or(std::cmp::Ordering::Equal));
        let lower = self.chain(points, order.iter().copied());
        let upper = self.chain(points, order.iter().rev().copied());
        lower.iter().chain(&upper).copied().collect()
    }

    /// One side of the outline of points in order: only left turns. The last point is that with which the other side begins.
    fn chain(&self, points: &[Vector], order: impl Iterator<Item = usize>) -> Vec<usize> {
        let mut chain: Vec<usize> = Vec::new();
        for next in order {
            while let [.., before, last] = chain[..] {
                let (leg, step) = (points[last] - points[before], points[next] - points[before]);
                // The last point must stand out from the line past it by more than rounding.
                if self.normal.dot(&leg.cross(&step)) > self.tolerance * step.norm() {
                    break;
                }
                chain.pop();
            }
            chain.push(next);
        }
        chain.pop();
        chain
    }
}

/// The planes of triangles, each once. Large triangles come first: they know their plane best.
fn planes(points: &[Vector], triangles: &[[usize; 3]], rounding: f64) -> Vec<Plane> {
    let size = size(points);
    let mut areas: Vec<(Vector, &[usize; 3])> = triangles.iter().map(|triangle| (plane(points, triangle).0, triangle)).collect();
    areas.sort_by(|left, right| right.0.norm().total_cmp(&left.0.norm()));
    let mut planes: Vec<Plane> = Vec::new();
    for (area, triangle) in areas {
        let lies_in = |plane: &Plane| triangle.iter().all(|corner| plane.height(&points[*corner]).abs() <= plane.tolerance);
        if area.norm() > rounding * size && !planes.iter().any(lies_in) {
            let tolerance = plane_tolerance(rounding, size, area.norm());
            planes.push(Plane { normal: area.normalize(), point: points[triangle[0]], tolerance });
        }
    }
    planes
}

/// The points that faces use, in their order, and the faces by their new indices.
fn used_only(points: &[Vector], mut faces: Vec<Vec<usize>>) -> (Vec<Vector>, Vec<Vec<usize>>) {
    let mut used: Vec<usize> = faces.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    for corner in faces.iter_mut().flatten() {
        *corner = used.partition_point(|index| *index < *corner);
    }
    (used.into_iter().map(|index| points[index]).collect(), faces)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::Orientation;

    /// All points of a grid of so many points along each edge of a box.
    fn grid(lengths: Vector, per_edge: usize) -> Vec<Vector> {
        let place = |index: usize| index as f64 / (per_edge - 1) as f64;
        let all = (0..per_edge).flat_map(|i| (0..per_edge).flat_map(move |j| (0..per_edge).map(move |k| [i, j, k])));
        all.map(|[i, j, k]| Vector::new(place(i), place(j), place(k)).component_mul(&lengths)).collect()
    }

    #[test]
    fn a_grid_of_points_gives_the_box_around_it_from_its_own_points() {
        let points = grid(Vector::new(1.0, 2.0, 3.0) * 1e-3, 5);
        let hull = Polyhedron::hull(&points).unwrap();
        assert_eq!((hull.vertices().len(), hull.faces().len()), (8, 6));
        assert!((hull.mass_properties().volume / 6e-9 - 1.0).abs() < 8.0 * f64::EPSILON);
        let given = |vertex: &Vector| points.iter().any(|point| point - hull.offset() == *vertex);
        assert!(hull.vertices().iter().all(given));
    }

    #[test]
    fn a_thin_turned_plate_with_points_twice_is_found_as_well() {
        let turn = Orientation::from_euler_angles(0.3, -0.5, 1.1);
        let mut points: Vec<Vector> = grid(Vector::new(1.0, 2.0, 1e-5), 4).iter().map(|point| turn * point).collect();
        points.extend(points.clone());
        let hull = Polyhedron::hull(&points).unwrap();
        assert_eq!((hull.vertices().len(), hull.faces().len()), (8, 6));
        assert!((hull.mass_properties().volume / 2e-5 - 1.0).abs() < 1e5 * 4.0 * f64::EPSILON);
    }

    #[test]
    fn too_few_flat_and_infinite_points_are_refused() {
        assert_eq!(Polyhedron::hull(&grid(Vector::new(1.0, 1.0, 0.0), 3)), Err(PolyhedronError::Flat));
        assert_eq!(Polyhedron::hull(&[Vector::x(); 9]), Err(PolyhedronError::TooFew { vertices: 1, faces: 0 }));
        assert_eq!(Polyhedron::hull(&[Vector::repeat(f64::INFINITY)]), Err(PolyhedronError::NotFinite { vertex: 0 }));
    }

    /// Found at random: on these points parry's hull is dented by more than the spacing, so that only moved points give the right one.
    #[test]
    fn points_on_which_the_quick_hull_fails_are_moved_a_little() {
        let lattice = [
            [311, 133, 101, 213, 221, 100, 0, 302, 121, 110],
            [223, 103, 3, 322, 33, 112, 201, 20, 301, 300],
            [11, 232, 321, 120, 333, 323, 200, 220, 312, 312],
        ];
        let place = |digits: u16| Vector::new(f64::from(digits / 100), f64::from(digits / 10 % 10), f64::from(digits % 10));
        let points: Vec<Vector> = lattice.into_iter().flatten().map(place).collect();
        let distinct = &points[..29];
        let plain = hull_triangles(&spread_out(distinct).unwrap()).unwrap();
        assert_eq!(faces_of(distinct, &plain, rounding(distinct)), None);
        let hull = Polyhedron::hull(&points).unwrap();
        let inside = |point: &Vector| hull.contains(&((point - hull.offset()) * (1.0 - 1e-14)));
        assert!(points.iter().all(inside));
    }

    proptest! {
        /// Every point lies inside, Euler's formula holds, and leaving out the inner points changes nothing.
        #[test]
        fn hulls_of_random_points_hold_all_points(
            coordinates in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 5..60),
            on_ball in any::<bool>(),
            scale in prop::sample::select(vec![1e-6, 1.0, 1e3]),
        ) {
            let place = |at: &[f64; 3]| if on_ball { Vector::from(*at).normalize() } else { Vector::from(*at) };
            let points: Vec<Vector> = coordinates.iter().map(|at| place(at) * scale).collect();
            let hull = Polyhedron::hull(&points).unwrap();
            let edges: usize = hull.faces().iter().map(Vec::len).sum::<usize>() / 2;
            prop_assert_eq!(hull.vertices().len() + hull.faces().len(), edges + 2);
            let reach = |point: &Vector| {
                let beyond = |(normal, distance): (&Vector, &f64)| normal.dot(&(point - hull.offset())) - distance;
                hull.face_normals().iter().zip(hull.face_distances()).map(beyond).fold(f64::NEG_INFINITY, f64::max)
            };
            prop_assert!(points.iter().all(|point| reach(point) < 1e-9 * scale));
            let again = Polyhedron::hull(hull.vertices()).unwrap();
            let relative = again.mass_properties().volume / hull.mass_properties().volume - 1.0;
            prop_assert!(relative.abs() < 1e-12, "{}", relative);
        }

        /// Points of a coarse lattice: most lie in common planes, on common lines or twice at one place.
        #[test]
        fn hulls_of_lattice_points_are_found_or_flat(
            lattice in prop::collection::vec(prop::array::uniform3(0..4_i32), 4..40),
            angles in prop::array::uniform3(-3.0..3.0_f64),
        ) {
            let turn = Orientation::from_euler_angles(angles[0], angles[1], angles[2]);
            let straight: Vec<Vector> = lattice.iter().map(|at| Vector::from(at.map(f64::from))).collect();
            let turned: Vec<Vector> = straight.iter().map(|point| turn * point).collect();
            match (Polyhedron::hull(&straight), Polyhedron::hull(&turned)) {
                (Ok(straight), Ok(turned)) => {
                    prop_assert_eq!(straight.faces().len(), turned.faces().len());
                    prop_assert_eq!(straight.vertices().len(), turned.vertices().len());
                    let change = turned.mass_properties().volume / straight.mass_properties().volume - 1.0;
                    prop_assert!(change.abs() < 1e-12, "{}", change);
                }
                (straight, turned) => {
                    prop_assert!(matches!(straight, Err(PolyhedronError::Flat | PolyhedronError::TooFew { .. })), "{:?}", straight);
                    prop_assert!(matches!(turned, Err(PolyhedronError::Flat | PolyhedronError::TooFew { .. })), "{:?}", turned);
                }
            }
        }
    }
}
