//! A rectangular box.

use crate::Vector;

/// A box with edges along its own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    /// Full edge lengths in m.
    pub lengths: Vector,
}

impl Cuboid {
    /// Volume in m^3.
    pub fn volume(&self) -> f64 {
        self.lengths.product()
    }

    /// Half the edge lengths, in m.
    pub fn half_lengths(&self) -> Vector {
        0.5 * self.lengths
    }

    /// Mean squares of the coordinates over the volume, `a^2 / 12` and so on, in m^2.
    pub fn mean_squares(&self) -> Vector {
        self.lengths.component_mul(&self.lengths) / 12.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::MassProperties;

    /// Independent: the second moment of a uniform rod of length a is a^2 / 12; a box is three rods at right angles.
    #[test]
    fn inertia_is_that_of_crossed_rods() {
        let cuboid = Cuboid { lengths: Vector::new(1.0, 2.0, 4.0) };
        let expected = Vector::new((4.0 + 16.0) / 12.0, (1.0 + 16.0) / 12.0, (1.0 + 4.0) / 12.0);
        let inertia = MassProperties::centred(cuboid.volume(), cuboid.mean_squares()).inertia() / cuboid.volume();
        assert!((inertia.diagonal() - expected).norm() < 4.0 * f64::EPSILON * expected.norm());
        assert_eq!(cuboid.volume(), 8.0);
    }
}
