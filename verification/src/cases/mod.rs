//! The list of cases. Adding a case is one file and one line here.

mod box_at_rest;
mod contact_in_fluid;
mod cylinder_wall_impact;
mod dam_break;
mod dense_elastic_bed;
mod energy_fifty_cylinders;
mod energy_two_ellipsoids;
mod errata_s;
mod fixed_sphere;
mod flow_orders;
mod free_top;
mod granular_gas;
mod lobed_array;
mod mass_properties;
mod neighbour_search;
mod neutral_body;
mod normal_contact;
mod oblique_impact;
pub mod pair_distance;
mod settling_sphere;
mod silo_discharge;
mod small_packed_bed;
mod soft_spheres;
mod sphere_bounce_long;
mod sphere_column;
mod sphere_on_incline;
mod stability_contacts;
mod static_lattice;
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
    &static_lattice::StaticLattice,
    &sphere_column::SphereColumn,
    &dense_elastic_bed::DenseElasticBed,
    &granular_gas::GranularGas,
    &neighbour_search::NeighbourSearch,
    &stability_contacts::StabilityContacts,
    &energy_fifty_cylinders::EnergyFiftyCylinders,
    &dam_break::DamBreak,
    &mass_properties::CountedMass,
    &pair_distance::PairDistance,
    &energy_two_ellipsoids::EnergyTwoEllipsoids,
    &vertex_refinement::VertexRefinement,
    &errata_s::ErrataS,
    &silo_discharge::SiloDischarge,
    &zick_homsy::ZickHomsy,
    &lobed_array::LobedArray,
    &small_packed_bed::SmallPackedBed,
    &flow_orders::FlowOrders,
    &fixed_sphere::FixedSphere,
    &settling_sphere::SettlingSphere,
    &neutral_body::NeutralBody,
    &contact_in_fluid::ContactInFluid,
];
