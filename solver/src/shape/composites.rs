//! Bodies of several parts that sources R and Kodam et al. use, as lists of parts in a natural frame. All sizes must be positive.

use std::f64::consts::{FRAC_PI_2, SQRT_2, TAU};
use std::sync::Arc;

use super::{Convex, Cuboid, Cylinder, Part, Polyhedron, PolyhedronError, Sphere};
use crate::{Orientation, Vector};

/// A trilobe along z: three cylinders and the triangular prism that fills the gap between them (R sections 4.2.4 and 7.3.4, figures 4.3 and 7.3).
///
/// `diameter` (in m) is that of the circumscribed cylinder. Neighbouring lobes touch along the faces of the prism, whose edges are the lobes'
/// axes: the lobes' radius is `diameter / 2 / (1 + 2 / sqrt 3)`. The body then fills 65.7 % of its circumscribed cylinder; R tells 69 %, so that
/// R's lobes overlap a little.
///
/// # Errors
///
/// If a size is not a positive number.
pub fn trilobe(diameter: f64, length: f64) -> Result<Vec<Part>, PolyhedronError> {
    let radius = 0.5 * diameter / (1.0 + 2.0 / 3.0_f64.sqrt());
    let mut parts = lobes(3, radius, length);
    let ends = [-0.5, 0.5].map(|share| Vector::z() * (share * length));
    let corners: Vec<Vector> = parts.iter().flat_map(|lobe| ends.map(|end| lobe.position + end)).collect();
    let faces = vec![vec![0, 4, 2], vec![1, 3, 5], vec![0, 2, 3, 1], vec![2, 4, 5, 3], vec![4, 0, 1, 5]];
    let prism = Polyhedron::from_faces(corners, faces)?;
    let position = prism.offset();
    parts.push(Part { convex: Convex::Polyhedron(Arc::new(prism)), position, orientation: Orientation::identity() });
    Ok(parts)
}

/// A quadralobe along z: four cylinders and the box that fills the gap between them (R, as for [`trilobe`]).
///
/// The lobes' radius is `diameter / 2 / (1 + sqrt 2)`. The body fills 73.3 % of its circumscribed cylinder; R tells 74 %.
pub fn quadralobe(diameter: f64, length: f64) -> Vec<Part> {
    let radius = 0.5 * diameter / (1.0 + SQRT_2);
    let mut parts = lobes(4, radius, length);
    let convex = Convex::Cuboid(Cuboid { lengths: Vector::new(2.0 * radius, 2.0 * radius, length) });
    parts.push(Part { convex, position: Vector::zeros(), orientation: Orientation::from_scaled_axis(Vector::z() * (0.5 * FRAC_PI_2)) });
    parts
}

/// Cylinders along z in a ring, each of which touches its neighbours; the first lies on the x axis.
fn lobes(count: usize, radius: f64, length: f64) -> Vec<Part> {
    let distance = radius / (0.5 * TAU / count as f64).sin();
    let place = |angle: f64| Vector::new(angle.cos(), angle.sin(), 0.0) * distance;
    (0..count).map(|index| upright(radius, length, place(TAU * index as f64 / count as f64))).collect()
}

/// A cylinder along z.
fn upright(radius: f64, length: f64, position: Vector) -> Part {
    Part { convex: Convex::Cylinder(Cylinder { radius, length }), position, orientation: Orientation::identity() }
}

/// The 2-D cross of R (figure 3.12): two equal cylinders, along x and y, that cross in their middle.
pub fn cross_in_plane(radius: f64, length: f64) -> Vec<Part> {
    [Vector::y() * FRAC_PI_2, Vector::x() * -FRAC_PI_2]
        .map(|turn| Part { orientation: Orientation::from_scaled_axis(turn), ..upright(radius, length, Vector::zeros()) })
        .to_vec()
}

/// The 3-D cross of R (figure 3.12): three equal cylinders, along x, y and z, that cross in their middle.
pub fn cross_in_space(radius: f64, length: f64) -> Vec<Part> {
    let mut parts = cross_in_plane(radius, length);
    parts.push(upright(radius, length, Vector::zeros()));
    parts
}

/// A cylinder along z, cut across into equal slices (R figure 3.6b).
pub fn sliced_cylinder(radius: f64, length: f64, slices: usize) -> Vec<Part> {
    let thickness = length / slices as f64;
    let height = |index: usize| (index as f64 + 0.5) * thickness - 0.5 * length;
    (0..slices).map(|index| upright(radius, thickness, Vector::z() * height(index))).collect()
}

/// Nine glued spheres that stand for a cylinder along z: one in the middle, eight in a ring around it, all touching both ends and the eight
/// touching the mantle. `None` for cylinders that are not shorter than wide.
///
/// R shows such a body (figure 3.10a) but tells no places. For R's cylinder of 8 mm diameter and 5.3 mm length this one, counted with 400 cells,
/// has a volume of 1.9488e-7 m^3, and its moments of inertia have the ratio 1.317; R tells 1.948e-7 m^3 and 1.738 / 1.320 = 1.317 (table 3.2), so
/// that this is very likely R's body. R's moments themselves are both 1.19 times those of this body at the mass that R tells.
pub fn glued_spheres_cylinder_9(radius: f64, length: f64) -> Option<Vec<Part>> {
    let sphere = 0.5 * length;
    (sphere < radius).then(|| [ring(1, 0.0, 0.0, sphere), ring(8, radius - sphere, 0.0, sphere)].concat())
}

/// Fifty-four glued spheres that stand for a cylinder along z: three layers of a ring of twelve, which touch the mantle, and one of six halfway
/// in; the outer layers touch the ends. `None` for cylinders that are not shorter than wide.
///
/// R shows such a body (figure 3.10c) but tells no places. For R's cylinder this one has a volume of 2.254e-7 m^3, R's 2.244e-7 m^3 (table 3.2), and
/// at R's mass a moment of inertia about the axis that is 0.6 % larger. The moment about a diameter that R prints, 3.281e-9 kg m^2, is more than
/// that of the whole cylinder, 1.966e-9 kg m^2, and so cannot be that of spheres inside it.
pub fn glued_spheres_cylinder_54(radius: f64, length: f64) -> Option<Vec<Part>> {
    let sphere = 0.25 * length;
    let outer = radius - sphere;
    let layer = |height: f64| [ring(12, outer, height, sphere), ring(6, 0.5 * outer, height, sphere)].concat();
    (2.0 * sphere < radius).then(|| [-sphere, 0.0, sphere].map(layer).concat())
}

/// Spheres at equal distances around the z axis; the first lies on the side of x.
fn ring(count: usize, distance: f64, height: f64, radius: f64) -> Vec<Part> {
    let place = |angle: f64| Vector::new(distance * angle.cos(), distance * angle.sin(), height);
    let sphere = |position| Part { convex: Convex::Sphere(Sphere { radius }), position, orientation: Orientation::identity() };
    (0..count).map(|index| sphere(place(TAU * index as f64 / count as f64))).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::shape::mass::cell_counting::CellGrid;
    use crate::shape::mass::union::{MassMethod, mass_of_union};

    /// Share of the circumscribed cylinder that a body fills, in percent.
    fn share(parts: &[Part], diameter: f64, length: f64) -> f64 {
        let (mass, method) = mass_of_union(parts, &|_, _| true);
        assert_eq!(method, MassMethod::Outline);
        assert!(mass.centre.norm() < 16.0 * f64::EPSILON * diameter);
        100.0 * mass.volume / (PI / 4.0 * diameter * diameter * length)
    }

    /// Shares by sectors of discs: (5/2 pi + sqrt 3) / pi / (1 + 2 / sqrt 3)^2 and (3 pi + 4) / pi / (1 + sqrt 2)^2. R prints 69 and 74 % (section
    /// 4.2.4).
    #[test]
    fn lobes_fill_about_what_the_source_tells() {
        let (diameter, length) = (1.6e-3, 4e-3);
        let three = share(&trilobe(diameter, length).unwrap(), diameter, length);
        let four = share(&quadralobe(diameter, length), diameter, length);
        assert!((three / (100.0 * (2.5 + 3.0_f64.sqrt() / PI) / (1.0 + 2.0 / 3.0_f64.sqrt()).powi(2)) - 1.0).abs() < 64.0 * f64::EPSILON);
        assert!((four / (100.0 * (3.0 + 4.0 / PI) / (1.0 + SQRT_2).powi(2)) - 1.0).abs() < 64.0 * f64::EPSILON);
        assert!((three - 65.7).abs() < 0.05 && (four - 73.3).abs() < 0.05);
        assert!(matches!(trilobe(f64::NAN, 1.0), Err(PolyhedronError::NotFinite { .. })));
        assert!(trilobe(0.0, 1.0).is_err() && trilobe(1.0, -1.0).is_err());
    }

    /// How far the parts reach from the z axis and along it.
    fn reach(parts: &[Part]) -> (f64, f64) {
        let of = |part: &Part| {
            (part.position.xy().norm() + part.convex.bounding_radius(), part.position.z.abs() + part.convex.bounding_radius())
        };
        parts.iter().map(of).fold((0.0, 0.0), |(across, along), (x, z)| (f64::max(across, x), f64::max(along, z)))
    }

    #[test]
    fn glued_spheres_fill_their_cylinder_to_its_surface_and_about_as_much_of_it_as_the_source_tells() {
        let (radius, length) = (4e-3, 5.3e-3);
        let nine = glued_spheres_cylinder_9(radius, length).unwrap();
        let many = glued_spheres_cylinder_54(radius, length).unwrap();
        for (parts, count, told, counted) in [(&nine, 9, 1.948e-7, 1.9488e-7), (&many, 54, 2.244e-7, 2.254e-7)] {
            assert_eq!(parts.len(), count);
            let (across, along) = reach(parts);
            assert!((across - radius).abs() < 1e-17 && (along - 0.5 * length).abs() < 1e-17);
            let volume = CellGrid::around(parts, 100).mass_of_parts(parts).volume;
            assert!((volume / counted - 1.0).abs() < 1e-3 && (counted / told - 1.0).abs() < 5e-3, "{count} {volume}");
        }
        assert_eq!(glued_spheres_cylinder_9(1.0, 2.0), None);
        assert_eq!(glued_spheres_cylinder_54(1.0, 2.0), None);
    }

    #[test]
    fn cylinders_of_crosses_and_slices_lie_where_they_must() {
        let axes: Vec<Vector> = cross_in_space(1.0, 4.0).iter().map(|part| part.orientation * Vector::z()).collect();
        for (axis, expected) in axes.iter().zip([Vector::x(), Vector::y(), Vector::z()]) {
            assert!((axis - expected).norm() < 2.0 * f64::EPSILON);
        }
        let slices = sliced_cylinder(1.0, 3.0, 3);
        assert_eq!(slices.iter().map(|part| part.position.z).collect::<Vec<f64>>(), [-1.0, 0.0, 1.0]);
    }
}
