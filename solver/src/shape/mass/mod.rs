//! Mass properties: volume, centre and second moments, and how they add, move and turn.

mod area_moments;
pub mod cell_counting;
pub mod crossing_cylinders;
pub mod outline;
mod outline_crossings;
mod prism;
pub(crate) mod tetrahedra;
pub mod union;

pub use area_moments::AreaMoments;
use nalgebra::{Matrix3, SymmetricEigen};

use crate::{Orientation, Vector};

/// Volume, centre and second moments of a body of unit density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// Volume in m^3.
    pub volume: f64,
    /// Centre of volume in m.
    pub centre: Vector,
    /// Second moments about the centre, $\int (x - c)(x - c)^T\,dV$, in m^5.
    pub second_moments: Matrix3<f64>,
}

impl MassProperties {
    /// Nothing.
    pub fn nothing() -> MassProperties {
        MassProperties { volume: 0.0, centre: Vector::zeros(), second_moments: Matrix3::zeros() }
    }

    /// A body centred at the origin, symmetric about its own planes, from its volume and the mean squares of its coordinates in m^2.
    pub fn centred(volume: f64, mean_squares: Vector) -> MassProperties {
        MassProperties { volume, centre: Vector::zeros(), second_moments: Matrix3::from_diagonal(&(mean_squares * volume)) }
    }

    /// From raw moments about the origin: $\int dV$, $\int x\,dV$, $\int x x^T\,dV$.
    pub fn from_raw_moments(volume: f64, first: Vector, second: Matrix3<f64>) -> MassProperties {
        let centre = first / volume;
        MassProperties { volume, centre, second_moments: second - centre * centre.transpose() * volume }
    }

    /// The same body turned, then moved.
    #[must_use]
    pub fn placed(&self, position: Vector, orientation: &Orientation) -> MassProperties {
        let turn = orientation.to_rotation_matrix();
        MassProperties {
            volume: self.volume,
            centre: position + orientation * self.centre,
            second_moments: turn.matrix() * self.second_moments * turn.matrix().transpose(),
        }
    }

    /// Both bodies together; they must not overlap. With a negative `sign` the other body is taken away instead.
    #[must_use]
    pub fn plus(&self, other: &MassProperties, sign: f64) -> MassProperties {
        let volume = self.volume + sign * other.volume;
        if volume == 0.0 {
            return MassProperties::nothing();
        }
        let centre = (self.centre * self.volume + other.centre * (sign * other.volume)) / volume;
        let about = |body: &MassProperties| {
            let offset = body.centre - centre;
            body.second_moments + offset * offset.transpose() * body.volume
        };
        MassProperties { volume, centre, second_moments: about(self) + about(other) * sign }
    }

    /// Inertia tensor about the centre for unit density, in m^5.
    pub fn inertia(&self) -> Matrix3<f64> {
        Matrix3::identity() * self.second_moments.trace() - self.second_moments
    }

    /// Principal moments of inertia per unit mass in m^2 and the rotation from principal axes to the body's axes. Axes that are principal
    /// already are kept as they are; moments that agree to rounding are made equal.
    pub fn principal(&self) -> (Vector, Orientation) {
        let inertia = self.inertia() / self.volume;
        let rounding = 64.0 * f64::EPSILON * inertia.norm();
        let off_diagonal = inertia[(0, 1)].abs().max(inertia[(0, 2)].abs()).max(inertia[(1, 2)].abs());
        let (mut moments, axes) = if off_diagonal <= rounding {
            (inertia.diagonal(), Orientation::identity())
        } else {
            let eigen = SymmetricEigen::new(inertia);
            let mut axes = eigen.eigenvectors;
            if axes.determinant() < 0.0 {
                axes.set_column(2, &-axes.column(2));
            }
            (eigen.eigenvalues, Orientation::from_matrix(&axes))
        };
        for (one, other) in [(0, 1), (1, 2), (0, 2), (0, 1)] {
            if (moments[one] - moments[other]).abs() <= rounding {
                moments[other] = moments[one];
            }
        }
        (moments, axes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Cuboid;

    fn brick(lengths: Vector) -> MassProperties {
        let cuboid = Cuboid { lengths };
        MassProperties::centred(cuboid.volume(), cuboid.mean_squares())
    }

    #[test]
    fn two_halves_make_a_whole_and_taking_one_away_leaves_the_other() {
        let whole = brick(Vector::new(2.0, 1.0, 3.0));
        let half = brick(Vector::new(1.0, 1.0, 3.0));
        let left = half.placed(Vector::x() * -0.5, &Orientation::identity());
        let right = half.placed(Vector::x() * 0.5, &Orientation::identity());
        let joined = left.plus(&right, 1.0);
        assert!((joined.second_moments - whole.second_moments).norm() < 16.0 * f64::EPSILON);
        let rest = whole.plus(&right, -1.0);
        assert!((rest.second_moments - left.second_moments).norm() < 32.0 * f64::EPSILON && (rest.centre - left.centre).norm() < 1e-15);
    }

    #[test]
    fn a_turned_brick_has_the_principal_moments_of_the_brick_and_its_axes() {
        let turn = Orientation::from_euler_angles(0.3, -0.5, 1.1);
        let turned = brick(Vector::new(2.0, 1.0, 3.0)).placed(Vector::new(5.0, 0.0, -1.0), &turn);
        let (moments, axes) = turned.principal();
        let mut sorted: Vec<f64> = moments.iter().copied().collect();
        sorted.sort_by(f64::total_cmp);
        for (moment, expected) in sorted.iter().zip([5.0 / 12.0, 10.0 / 12.0, 13.0 / 12.0]) {
            assert!((moment - expected).abs() < 64.0 * f64::EPSILON, "{moment} {expected}");
        }
        let diagonal = axes.inverse().to_rotation_matrix().matrix() * turned.inertia() * axes.to_rotation_matrix().matrix();
        assert!((diagonal - Matrix3::from_diagonal(&(moments * turned.volume))).norm() < 1e-13);
    }
}
