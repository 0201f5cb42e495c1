//! Hoppers: four plates between a rectangular opening and a rectangular outlet below it. A wedge is a hopper that is as deep below as above.

use super::Plate;
use crate::Vector;
use crate::distance::PolygonError;

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

/// The plates of a hopper at -x, +x, -y and +y.
///
/// # Errors
///
/// Plates without area.
pub fn plates(hopper: &Hopper) -> Result<[Plate; 4], PolygonError> {
    let corner =
        |lengths: &[f64; 2], x: f64, y: f64, height: f64| hopper.outlet + Vector::new(0.5 * x * lengths[0], 0.5 * y * lengths[1], height);
    let side = |from: [f64; 2], to: [f64; 2]| {
        let mut corners = vec![
            corner(&hopper.lower, from[0], from[1], 0.0),
            corner(&hopper.lower, to[0], to[1], 0.0),
            corner(&hopper.upper, to[0], to[1], hopper.height),
            corner(&hopper.upper, from[0], from[1], hopper.height),
        ];
        // Where the outlet has shrunk to a line or a point, plates are triangles; so too above.
        corners.dedup();
        Plate::new(&corners)
    };
    // Seen from inside, the corners run counterclockwise: normals point to the bodies.
    Ok([side([-1.0, -1.0], [-1.0, 1.0])?, side([1.0, 1.0], [1.0, -1.0])?, side([1.0, -1.0], [-1.0, -1.0])?, side([-1.0, 1.0], [1.0, 1.0])?])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The silo of Gonzalez-Montellano et al. (2011), R section 5.4: 250 mm wide, an outlet of 57 mm, walls at 62.5 degrees.
    fn silo() -> Hopper {
        let height = 0.5 * (0.25 - 0.057) * 62.5_f64.to_radians().tan();
        Hopper { outlet: Vector::new(0.1, 0.2, 0.3), upper: [0.25; 2], lower: [0.057; 2], height }
    }

    #[test]
    fn walls_lean_as_they_should_and_face_the_bodies() {
        let plates = plates(&silo()).unwrap();
        assert!(silo().steepness().iter().all(|angle| (angle - 62.5_f64.to_radians()).abs() < 1e-15));
        let (sine, cosine) = 62.5_f64.to_radians().sin_cos();
        let normals = [
            Vector::new(sine, 0.0, cosine),
            Vector::new(-sine, 0.0, cosine),
            Vector::new(0.0, sine, cosine),
            Vector::new(0.0, -sine, cosine),
        ];
        let middle = silo().outlet + Vector::z() * 0.05;
        for (plate, normal) in plates.iter().zip(normals) {
            assert!((plate.polygon().normal() - normal).norm() < 1e-14, "{}", plate.polygon().normal());
            // Half the outlet across, less what the wall has leant back at this height.
            let expected = 0.0285 * sine + 0.05 * cosine;
            assert!((plate.distance(&middle) - expected).abs() < 1e-15, "{} {expected}", plate.distance(&middle));
        }
    }

    #[test]
    fn a_wedge_has_upright_ends_and_a_shut_one_triangles() {
        let wedge = plates(&Hopper { upper: [0.25, 0.1], lower: [0.05, 0.1], ..silo() }).unwrap();
        assert!((wedge[2].polygon().normal() - Vector::y()).norm() < 1e-15 && (wedge[3].polygon().normal() + Vector::y()).norm() < 1e-15);
        let shut = plates(&Hopper { lower: [0.0; 2], ..silo() }).unwrap();
        assert!(shut.iter().all(|plate| plate.polygon().corners().len() == 3));
        assert!(plates(&Hopper { lower: [0.0; 2], height: 0.0, upper: [0.0, 1.0], ..silo() }).is_err());
    }
}
