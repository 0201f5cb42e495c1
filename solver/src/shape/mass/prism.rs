//! Parts that are prisms along an axis.

use super::outline::{Member, Point};
use crate::Vector;
use crate::shape::{Convex, Cuboid, Part, Polyhedron};

/// A body between two heights with the same section at all of them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Prism {
    /// Lower end, in m along z.
    pub(super) lower: f64,
    /// Upper end.
    pub(super) upper: f64,
    /// The section across z.
    pub(super) section: Member,
}

impl Prism {
    /// Directions along which a part is a prism, or may be one.
    pub(super) fn axes(part: &Part) -> Vec<Vector> {
        let own: Vec<Vector> = match &part.convex {
            Convex::Cylinder(_) => vec![Vector::z()],
            Convex::Cuboid(_) => vec![Vector::x(), Vector::y(), Vector::z()],
            Convex::Polyhedron(polyhedron) => polyhedron.face_normals().to_vec(),
            Convex::Sphere(_) | Convex::Spherocylinder(_) | Convex::Superellipsoid(_) => Vec::new(),
        };
        own.into_iter().map(|axis| part.orientation * axis).collect()
    }

    /// The part as a prism along z, if it is one within a tolerance in m.
    pub(super) fn along_z(part: &Part, tolerance: f64) -> Option<Prism> {
        match &part.convex {
            Convex::Cylinder(cylinder) => {
                let axis = part.orientation * Vector::z();
                let reach = Vector::z() * (0.5 * cylinder.length).copysign(axis.z);
                let upright = (axis * (0.5 * cylinder.length) - reach).norm() <= tolerance;
                let section = Member::Disc { centre: part.position.xy(), radius: cylinder.radius };
                upright.then(|| Prism { lower: part.position.z - reach.z.abs(), upper: part.position.z + reach.z.abs(), section })
            }
            Convex::Cuboid(cuboid) => of_faces(&corners(part, &vertices_of(cuboid)), &CUBOID_FACES.map(|face| face.to_vec()), tolerance),
            Convex::Polyhedron(polyhedron) => of_polyhedron(part, polyhedron, tolerance),
            Convex::Sphere(_) | Convex::Spherocylinder(_) | Convex::Superellipsoid(_) => None,
        }
    }
}

/// Corners of a cuboid in its own frame: bit 0, 1, 2 of the index tell the side along x, y, z.
fn vertices_of(cuboid: &Cuboid) -> Vec<Vector> {
    let side = |index: usize, bit: usize| if index >> bit & 1 == 1 { 1.0 } else { -1.0 };
    (0..8).map(|index| Vector::new(side(index, 0), side(index, 1), side(index, 2)).component_mul(&cuboid.half_lengths())).collect()
}

/// Faces of a cuboid, counterclockwise seen from outside.
const CUBOID_FACES: [[usize; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn of_polyhedron(part: &Part, polyhedron: &Polyhedron, tolerance: f64) -> Option<Prism> {
    of_faces(&corners(part, polyhedron.vertices()), polyhedron.faces(), tolerance)
}

/// Corners of a part where it is.
fn corners(part: &Part, own: &[Vector]) -> Vec<Vector> {
    own.iter().map(|corner| part.position + part.orientation * corner).collect()
}

/// A prism by its corners and faces: each corner lies at one of two heights, and right below or above another one.
fn of_faces(corners: &[Vector], faces: &[Vec<usize>], tolerance: f64) -> Option<Prism> {
    let upper = corners.iter().map(|corner| corner.z).fold(f64::NEG_INFINITY, f64::max);
    let lower = corners.iter().map(|corner| corner.z).fold(f64::INFINITY, f64::min);
    let is_upper = |corner: &Vector| upper - corner.z <= tolerance;
    let is_lower = |corner: &Vector| corner.z - lower <= tolerance;
    let has_twin = |corner: &Vector| {
        let opposite = corners.iter().filter(|other| is_upper(other) != is_upper(corner));
        opposite.into_iter().any(|other| (other.xy() - corner.xy()).norm() <= tolerance)
    };
    if !corners.iter().all(|corner| (is_upper(corner) || is_lower(corner)) && has_twin(corner)) {
        return None;
    }
    let top = faces.iter().find(|face| face.iter().all(|corner| is_upper(&corners[*corner])))?;
    let section: Vec<Point> = top.iter().map(|corner| corners[*corner].xy()).collect();
    (2 * section.len() == corners.len()).then_some(Prism { lower, upper, section: Member::Polygon(section) })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;
    use std::sync::Arc;

    use super::*;
    use crate::Orientation;
    use crate::shape::{Cylinder, Sphere};

    fn part(convex: Convex, axis: Vector, angle: f64) -> Part {
        Part { convex, position: Vector::new(1.0, 2.0, 3.0), orientation: Orientation::from_scaled_axis(axis * angle) }
    }

    #[test]
    fn a_box_is_a_prism_along_each_of_its_edges_and_along_nothing_else() {
        let cuboid = Convex::Cuboid(Cuboid { lengths: Vector::new(1.0, 2.0, 4.0) });
        let lying = Prism::along_z(&part(cuboid.clone(), Vector::x(), FRAC_PI_2), 1e-12).unwrap();
        assert!((lying.lower - 2.0).abs() < 1e-15 && (lying.upper - 4.0).abs() < 1e-15);
        let Member::Polygon(corners) = lying.section else { panic!("{:?}", lying.section) };
        let middle = Point::new(1.0, 2.0);
        let next = corners.iter().cycle().skip(1);
        let area: f64 = corners.iter().zip(next).map(|(from, to)| 0.5 * (from - middle).perp(&(to - middle))).sum();
        assert!((area - 4.0).abs() < 1e-14, "counterclockwise");
        assert_eq!(Prism::along_z(&part(cuboid.clone(), Vector::x(), 0.1), 1e-12), None);
        assert_eq!(Prism::axes(&part(cuboid, Vector::x(), 0.1)).len(), 3);
    }

    #[test]
    fn cylinders_and_prisms_by_their_faces_are_prisms_and_pyramids_and_balls_are_not() {
        let cylinder = Convex::Cylinder(Cylinder { radius: 0.5, length: 2.0 });
        let upside_down = Prism::along_z(&part(cylinder.clone(), Vector::x(), 2.0 * FRAC_PI_2), 1e-12).unwrap();
        assert_eq!(upside_down.section, Member::Disc { centre: Point::new(1.0, 2.0), radius: 0.5 });
        assert!((upside_down.lower - 2.0).abs() < 1e-15 && (upside_down.upper - 4.0).abs() < 1e-15);
        assert_eq!(Prism::along_z(&part(cylinder, Vector::x(), FRAC_PI_2), 1e-12), None);
        let triangle = [Vector::zeros(), Vector::x(), Vector::y()];
        let prism = Polyhedron::hull(&triangle.map(|corner| [corner, corner + Vector::z()]).concat()).unwrap();
        let prism = part(Convex::Polyhedron(Arc::new(prism)), Vector::z(), 0.3);
        let found: Vec<Prism> = Prism::axes(&prism).iter().filter_map(|_| Prism::along_z(&prism, 1e-12)).collect();
        assert_eq!(found.len(), 5);
        // Corners at two heights, as many above as below, but not above each other.
        let square = [Vector::x(), Vector::y(), -Vector::x(), -Vector::y()];
        let frustum = Polyhedron::hull(&square.map(|corner| [corner, corner * 0.9 + Vector::z()]).concat()).unwrap();
        assert_eq!(Prism::along_z(&part(Convex::Polyhedron(Arc::new(frustum)), Vector::z(), 0.0), 1e-12), None);
        let octahedron = Convex::Polyhedron(Arc::new(Polyhedron::octahedron(1.0).unwrap()));
        assert_eq!(Prism::along_z(&part(octahedron, Vector::z(), 0.0), 1e-12), None);
        assert_eq!(Prism::along_z(&part(Convex::Sphere(Sphere { radius: 1.0 }), Vector::z(), 0.0), 1e-12), None);
    }
}
