//! A cylinder with half a ball on either end; its axis is z.

use std::f64::consts::PI;

use crate::Vector;

/// All points within a radius of a straight line of given length along z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spherocylinder {
    /// Radius in m.
    pub radius: f64,
    /// Length of the straight part in m; zero is a ball.
    pub length: f64,
}

impl Spherocylinder {
    /// Volume in m^3.
    pub fn volume(&self) -> f64 {
        PI * self.radius * self.radius * (self.length + 4.0 / 3.0 * self.radius)
    }

    /// Mean squares of the coordinates over the volume, in m^2.
    pub fn mean_squares(&self) -> Vector {
        let (radius, half) = (self.radius, 0.5 * self.length);
        let (straight, balls) = (PI * radius * radius * self.length, 4.0 / 3.0 * PI * radius.powi(3));
        // Each half ball: its centre of mass lies 3/8 r from its flat side, its mean square height over that side is r^2 / 5.
        let along_caps = half * half + 0.75 * half * radius + 0.2 * radius * radius;
        let across = straight * 0.25 * radius * radius + balls * 0.2 * radius * radius;
        let along = straight * half * half / 3.0 + balls * along_caps;
        Vector::new(across, across, along) / (straight + balls)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent: midpoint quadrature over stacked discs, of second order.
    #[test]
    fn volume_and_mean_squares_match_quadrature_over_discs() {
        let body = Spherocylinder { radius: 0.7, length: 1.1 };
        let (discs, reach) = (200_000, 0.55 + 0.7);
        let thickness = 2.0 * reach / f64::from(discs);
        let (mut volume, mut across, mut along) = (0.0, 0.0, 0.0);
        for index in 0..discs {
            let height = -reach + (f64::from(index) + 0.5) * thickness;
            let beyond = (height.abs() - 0.55_f64).max(0.0);
            let disc = PI * (0.49 - beyond * beyond) * thickness;
            volume += disc;
            across += disc * 0.25 * (0.49 - beyond * beyond);
            along += disc * height * height;
        }
        let floor = (thickness / 0.7).powi(2) + 1e-13;
        assert!((body.volume() / volume - 1.0).abs() < 4.0 * floor);
        let expected = Vector::new(across, across, along) / volume;
        assert!((body.mean_squares() - expected).norm() < 8.0 * floor, "{}", body.mean_squares() - expected);
    }
}
