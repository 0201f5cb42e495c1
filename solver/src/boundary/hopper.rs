//! Hoppers: four flat walls between a rectangular opening and a rectangular outlet below it. A wedge is a hopper that is as deep below as above.

use super::{Mesh, MeshError};
use crate::Vector;

/// A rectangular funnel that stands upright, its openings level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hopper {
    /// Middle of the outlet, the lower opening, in m.
    pub outlet: Vector,
    /// Lengths of the upper opening along x and y, in m.
    pub upper: [f64; 2],
    /// Lengths of the outlet along x and y, in m; zero for walls that meet.
    pub lower: [f64; 2],
    /// Height from the outlet to the upper opening, in m.
    pub height: f64,
}

impl Hopper {
    /// Angle in rad between the plates that face x and the ground, and those that face y: a right angle for a side of a wedge that stands upright.
    pub fn steepness(&self) -> [f64; 2] {
        std::array::from_fn(|axis| self.height.atan2(0.5 * (self.upper[axis] - self.lower[axis])))
    }
}

/// Contacts whose normals enclose less, in rad, are those of two walls at the corner that they share: grooves keep both of theirs.
const SHARED: f64 = 1e-6;

/// The walls of a hopper at -x, +x, -y and +y, as one surface: where two of them meet, a ball is not pushed twice. Normals point to the bodies.
///
/// # Errors
///
/// Walls without area.
pub fn surface(hopper: &Hopper) -> Result<Mesh, MeshError> {
    let sides = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let ring = |lengths: [f64; 2], height: f64| {
        sides.map(|(x, y)| hopper.outlet + Vector::new(0.5 * x * lengths[0], 0.5 * y * lengths[1], height))
    };
    let vertices = [ring(hopper.lower, 0.0), ring(hopper.upper, hopper.height)].concat();
    let wall = |from: usize, to: usize| {
        let mut corners = vec![from, to, to + 4, from + 4];
        // Where the outlet has shrunk to a line or a point, walls are triangles.
        corners.dedup_by(|next, last| vertices[*next] == vertices[*last]);
        corners
    };
    Mesh::new(&vertices, &[wall(0, 1), wall(2, 3), wall(3, 0), wall(1, 2)], SHARED)
}

#[cfg(test)]
mod tests {
    use super::super::SphereTouch;
    use super::*;
    use crate::distance::Core;

    /// The silo of Gonzalez-Montellano et al. (2011), R section 5.4: 250 mm wide, an outlet of 57 mm, walls at 62.5 degrees.
    fn silo() -> Hopper {
        let height = 0.5 * (0.25 - 0.057) * 62.5_f64.to_radians().tan();
        Hopper { outlet: Vector::new(0.1, 0.2, 0.3), upper: [0.25; 2], lower: [0.057; 2], height }
    }

    /// Contacts of a ball of a radius in m at a place from the outlet.
    fn touches(hopper: &Hopper, place: Vector, radius: f64) -> Vec<SphereTouch> {
        let mut touches = Vec::new();
        surface(hopper).unwrap().touch_sphere(&(hopper.outlet + place), radius, &mut touches);
        touches
    }

    #[test]
    fn walls_lean_as_they_should_and_face_the_bodies() {
        assert!(silo().steepness().iter().all(|angle| (angle - 62.5_f64.to_radians()).abs() < 1e-15));
        let (sine, cosine) = 62.5_f64.to_radians().sin_cos();
        let normals = [
            Vector::new(sine, 0.0, cosine),
            Vector::new(-sine, 0.0, cosine),
            Vector::new(0.0, sine, cosine),
            Vector::new(0.0, -sine, cosine),
        ];
        let surface = surface(&silo()).unwrap();
        for (number, normal) in normals.iter().enumerate() {
            let piece = surface.as_core(number as u32);
            let Core::Polygon(polygon) = &piece.rounded.core else { panic!("a face") };
            assert!((polygon.normal() - normal).norm() < 1e-14, "{}", polygon.normal());
            // Half the outlet across, less what the wall has leant back at this height.
            let aside = -normal.component_mul(&Vector::new(1.0, 1.0, 0.0)).normalize() * 0.01;
            let found = touches(&silo(), aside + Vector::z() * 0.05, 0.045);
            let expected = 0.045 - (0.0185 * sine + 0.05 * cosine);
            assert!((found[0].overlap - expected).abs() < 1e-15 && (found[0].normal + normal).norm() < 1e-13, "{found:?} {expected}");
        }
        // In the middle, all four; in a groove, two.
        assert_eq!(touches(&silo(), Vector::z() * 0.05, 0.05).len(), 4);
        assert_eq!(touches(&silo(), Vector::new(0.01, 0.01, 0.05), 0.045).len(), 2);
    }

    /// Under a corner of the outlet, which two walls share, there is one contact.
    #[test]
    fn a_shared_corner_is_one_contact() {
        let found = touches(&silo(), Vector::new(0.0285 + 0.002, 0.0285 + 0.003, -0.006), 0.0075);
        assert_eq!(found.len(), 1);
        assert!((found[0].overlap - 0.0005).abs() < 1e-15, "{found:?}");
    }

    #[test]
    fn a_wedge_has_upright_ends_and_a_shut_one_triangles() {
        let wedge = Hopper { upper: [0.25, 0.1], lower: [0.05, 0.1], ..silo() };
        let found = touches(&wedge, Vector::new(0.0, 0.045, 0.1), 0.006);
        assert!(
            found.len() == 1 && (found[0].overlap - 0.001).abs() < 1e-15 && (found[0].normal - Vector::y()).norm() < 1e-15,
            "{found:?}"
        );
        let shut = Hopper { lower: [0.0; 2], ..silo() };
        let bottom = touches(&shut, Vector::z() * 0.01, 0.01);
        assert_eq!(bottom.len(), 4);
        assert!(surface(&Hopper { lower: [0.0; 2], height: 0.0, upper: [0.0, 1.0], ..silo() }).is_err());
    }
}
