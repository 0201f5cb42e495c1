//! Who touches, where, and with what force.
//!
//! [`detect`] finds overlap, normal and lever arms of a pair; [`law`] turns them into forces; [`stage`] runs both over all
//! candidate pairs of one law and adds the forces to the bodies in the order of their ids.

pub mod detect;
pub mod law;
pub mod stage;

use crate::Vector;

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
    /// The normal is arbitrary because the centres coincide.
    pub is_concentric: bool,
}
