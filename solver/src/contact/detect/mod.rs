//! Contact detection. One file per pair of shapes. The contact point is halfway between the two surfaces (R eq. 3.15).

mod core_pair;
mod core_plane;
mod core_vessel;
mod feature;
mod sphere_plane;
mod sphere_sphere;
mod vertices;

pub use core_pair::{Look, PlacedCore, Points, core_pair};
pub use core_plane::core_plane;
pub use core_vessel::core_vessel;
pub use sphere_plane::sphere_plane;
pub use sphere_sphere::sphere_sphere;
pub use vertices::{OneSided, PlacedSurface, VertexSurface, vertex_pair, vertex_plane};
