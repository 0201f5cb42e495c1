//! Friction factors on no grid, found once from more grids than a tier pays for: there is no closed form for these bodies.
//!
//! For each body 11 to 18 flows with the default constraint (aspect ratio 5: 12), on grids of 10 to 52 (11 to 24) cells a diameter and at places of the body
//! between values that differ, fitted by $K_0 + C h^{1.2}$, the order of bodies with edges. The uncertainty is twice the standard error of the limit, by which
//! places count, together with half of what an order of 1 or of 1.5 changes. Collocation points, whose errors have the other sign, give along the axis
//! at aspect ratio 1 limits of 6.86, 6.53 and 7.24 (cylinder, trilobe, quadralobe; 0.1 uncertain): within 0.3 % of these.

use super::flows::{Course, Family, Shape};

/// Friction factor and its uncertainty at 21.6 % solid, if it was found.
pub fn friction(shape: Shape, family: Family, course: Course) -> Option<[f64; 2]> {
    let [cylinder, trilobe, quadralobe] = match (family, course) {
        (Family::Short, Course::Along) => [[6.847, 0.06], [6.534, 0.05], [7.264, 0.11]],
        (Family::Short, Course::Across) => [[9.63, 0.15], [12.58, 0.22], [11.11, 0.23]],
        (Family::Short, Course::Turned) => [[8.035, 0.04], [8.128, 0.05], [8.663, 0.05]],
        (Family::Long, Course::Along) => [[16.19, 0.31], [16.36, 0.21], [17.97, 0.22]],
        (Family::Long, Course::Across) => [[3.715, 0.07], [7.07, 0.16], [6.40, 0.15]],
        _ => return None,
    };
    Some(match shape {
        Shape::Cylinder => cylinder,
        Shape::Trilobe => trilobe,
        Shape::Quadralobe => quadralobe,
    })
}
