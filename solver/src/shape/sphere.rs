//! A ball.

use std::f64::consts::PI;

use crate::Vector;

/// A ball of given radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Radius in m.
    pub radius: f64,
}

impl Sphere {
    /// Volume in m^3.
    pub fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius.powi(3)
    }

    /// Mean squares of the coordinates over the volume, `r^2 / 5` three times, in m^2.
    pub fn mean_squares(&self) -> Vector {
        Vector::repeat(0.2 * self.radius * self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent: midpoint quadrature over stacked discs, second order, so 1e5 discs leave an error of about 1e-10.
    #[test]
    fn volume_and_inertia_match_quadrature_over_discs() {
        let sphere = Sphere { radius: 0.7 };
        let discs = 100_000;
        let thickness = 2.0 * sphere.radius / discs as f64;
        let (mut volume, mut second_moment) = (0.0, 0.0);
        for index in 0..discs {
            let height = -sphere.radius + (index as f64 + 0.5) * thickness;
            let squared = sphere.radius * sphere.radius - height * height;
            volume += PI * squared * thickness;
            second_moment += 0.5 * PI * squared * squared * thickness;
        }
        let floor = (thickness / sphere.radius).powi(2);
        assert!((sphere.volume() / volume - 1.0).abs() < 2.0 * floor);
        assert!((2.0 * sphere.mean_squares().z / (second_moment / volume) - 1.0).abs() < 2.0 * floor);
    }
}
