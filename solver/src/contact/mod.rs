//! Who touches, where, and with what force.
//!
//! [`detect`] finds overlap, normal and lever arms of a pair; [`law`] turns them into forces, [`sharing`] divides a law among the points of a
//! contact; a [`stage`] runs all that over its candidate pairs and adds the forces to the bodies in the order of their ids. Pairs are sorted into stages
//! by the kinds of their shapes when a scene is built: [`spheres`] never meet what [`shaped`] bodies and [`sphere_walls`] need. Hard bodies know no forces: [`impulse`] holds
//! their law, [`crate::scheme::hard`] finds when they collide.

pub mod detect;
mod detector;
mod force;
pub mod impulse;
mod lanes;
pub mod law;
pub mod neighbours;
#[cfg(test)]
mod objectivity;
mod pair_rows;
pub mod pairs;
mod rigid_motion;
pub mod shaped;
pub mod sharing;
mod sphere_lanes;
mod sphere_pair;
pub mod sphere_walls;
pub mod spheres;
pub mod stage;
mod sweep;
mod travel;

use crate::Vector;
use crate::boundary::SphereTouch;

/// The geometry of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Overlap in m, above zero.
    pub overlap: f64,
    /// Unit normal from the first partner to the second.
    pub normal: Vector,
    /// From the centre of mass of the first partner to the contact point, in m.
    pub arm_of_first: Vector,
    /// From the centre of mass of the second partner to the contact point, in m; of no meaning for a wall at rest.
    pub arm_of_second: Vector,
    /// The normal is a choice: the centres of spheres coincide, or even the cores of shapes overlap.
    pub is_deep: bool,
}

impl From<SphereTouch> for Touch {
    /// A ball first, a wall second.
    #[inline]
    fn from(touch: SphereTouch) -> Touch {
        let SphereTouch { overlap, normal, arm, is_deep } = touch;
        Touch { overlap, normal, arm_of_first: arm, arm_of_second: Vector::zeros(), is_deep }
    }
}
