//! The list of cases. Adding a case is one file and one line here.

mod free_top;
mod normal_contact;
mod pair_distance;
mod sphere_bounce_long;
mod sphere_on_incline;

use crate::case::Case;

/// Every case, in the order of pages.
pub const CASES: &[&dyn Case] = &[
    &normal_contact::NormalContact,
    &free_top::FreeTop,
    &sphere_on_incline::SphereOnIncline,
    &sphere_bounce_long::SphereBounceLong,
    &pair_distance::PairDistance,
];
