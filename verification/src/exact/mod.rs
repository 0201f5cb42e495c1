//! Closed forms and event-exact solutions that cases are held against. Independent of the solver: nothing here calls it.

pub mod beverloo;
mod bisection;
pub mod crystal;
pub mod cylinder_array;
pub mod distance_certificate;
pub mod ergun;
pub mod extrapolation;
pub mod free_top;
pub mod hertz_contact;
pub mod jeffery;
pub mod kinetic_theory;
pub mod linear_contact;
pub mod linear_oblique_impact;
pub mod manufactured_flow;
pub mod oblique_impact;
pub mod periodic_array;
pub mod richardson;
pub mod rigid_cylinder_impact;
pub mod rigid_oblique_impact;
pub mod rolling_sphere;
pub mod soft_impact;
pub mod sphere_column;
pub mod sphere_drag;
pub mod superellipsoid_twin;
pub mod tank;
pub mod taylor_green_vortex;
