//! A right circular cylinder; its axis is z.

use std::f64::consts::PI;

use crate::Vector;

/// A cylinder with its axis along z and its centre at the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Radius in m.
    pub radius: f64,
    /// Full length in m.
    pub length: f64,
}

impl Cylinder {
    /// Volume in m^3.
    pub fn volume(&self) -> f64 {
        PI * self.radius * self.radius * self.length
    }

    /// Mean squares of the coordinates over the volume, `r^2 / 4` across and `l^2 / 12` along the axis, in m^2.
    pub fn mean_squares(&self) -> Vector {
        let across = 0.25 * self.radius * self.radius;
        Vector::new(across, across, self.length * self.length / 12.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::MassProperties;

    /// Independent: masses and moments of the cylinder of R's table 3.1, printed to four digits, of density m/V.
    #[test]
    fn moments_are_those_of_a_measured_cylinder() {
        let cylinder = Cylinder { radius: 4e-3, length: 5.3e-3 };
        assert!((cylinder.volume() / 2.66407e-7 - 1.0).abs() < 1e-5);
        let properties = MassProperties::centred(cylinder.volume(), cylinder.mean_squares());
        let inertia = properties.inertia() * (3.1e-4 / cylinder.volume());
        assert!((inertia[(0, 0)] / 1.966e-9 - 1.0).abs() < 5e-4 && (inertia[(2, 2)] / 2.480e-9 - 1.0).abs() < 5e-4);
    }
}
