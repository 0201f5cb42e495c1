//! What a contact remembers lies in its plane, and goes where the plane and the bodies go.
//!
//! Two bodies that turn together carry the spring between them along, about their normal too: without that last turn the friction of a loaded pair stays behind
//! the bodies. Where the two turn about the normal at different rates, their mean counts.

use crate::Vector;

/// A vector of the last contact plane, turned into the plane of a new normal and about it by an angle in rad, without change of length.
///
/// The tangent of the angle is that of a small one, $\theta + \theta^3 / 3$: no step turns by much.
#[inline(always)]
pub(super) fn carried_along(vector: Vector, normal: &Vector, twist: f64) -> Vector {
    let projected = vector - normal * vector.dot(normal);
    let turned = projected + normal.cross(&projected) * (twist + twist * twist * twist / 3.0);
    let squared = turned.norm_squared();
    if squared > 0.0 { turned * (vector.norm_squared() / squared).sqrt() } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vector_turns_with_the_contact_plane_and_keeps_its_length() {
        let turned = carried_along(Vector::x(), &Vector::new(0.6, 0.0, 0.8), 0.0);
        assert!((turned - Vector::new(0.8, 0.0, -0.6)).norm() < 4.0 * f64::EPSILON);
        assert_eq!(carried_along(Vector::zeros(), &Vector::z(), 0.1), Vector::zeros());
    }

    #[test]
    fn a_vector_turns_with_the_bodies_about_the_normal() {
        let mut vector = Vector::x();
        for _ in 0..1000 {
            vector = carried_along(vector, &Vector::z(), 0.01);
        }
        // The fifth order of each small angle is left.
        let wanted = Vector::new(10.0_f64.cos(), 10.0_f64.sin(), 0.0);
        assert!((vector - wanted).norm() < 1.01 * 1000.0 * 2.0 / 15.0 * 0.01_f64.powi(5) && (vector.norm() - 1.0).abs() < 1e-13);
    }
}
