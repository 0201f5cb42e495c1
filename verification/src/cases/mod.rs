//! The list of cases. Adding a case is one file and one line here.

mod box_at_rest;
mod cylinder_wall_impact;
mod energy_fifty_cylinders;
mod energy_two_ellipsoids;
mod errata_s;
mod free_top;
mod mass_properties;
mod normal_contact;
mod oblique_impact;
pub mod pair_distance;
mod sphere_bounce_long;
mod sphere_on_incline;
mod vertex_refinement;
mod zick_homsy;

use crate::case::Case;

/// Every case, in the order of pages.
pub const CASES: &[&dyn Case] = &[
    &normal_contact::NormalContact,
    &oblique_impact::ObliqueImpactCase,
    &cylinder_wall_impact::CylinderWallImpact,
    &box_at_rest::BoxAtRest,
    &free_top::FreeTop,
    &sphere_on_incline::SphereOnIncline,
    &sphere_bounce_long::SphereBounceLong,
    &energy_fifty_cylinders::EnergyFiftyCylinders,
    &mass_properties::CountedMass,
    &pair_distance::PairDistance,
    &energy_two_ellipsoids::EnergyTwoEllipsoids,
    &vertex_refinement::VertexRefinement,
    &zick_homsy::ZickHomsy,
    &errata_s::ErrataS,
];
