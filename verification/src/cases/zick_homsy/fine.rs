//! Friction factors of dense centred lattices on no grid, found once on finer grids than a tier pays for: no table of them is at hand.
//!
//! Each from flows with the default constraint on grids of up to 60 cells a diameter, at three to six places of the spheres, fitted by
//! $K_0 + C h^p$. Without the coarsest grid the limit moves by 1e-4 of a solid fraction of 0.216; at 0.45, where gaps are a seventh of a diameter, the order is not
//! settled there, and the uncertainty is what orders of 2.6 to 4 differ by.

use crate::exact::periodic_array::{FrictionFactor, Lattice};

/// The friction factor of a lattice at a solid fraction, if it was found.
pub fn friction_factor(lattice: Lattice, solid_fraction: f64) -> Option<FrictionFactor> {
    let of = |value, uncertainty| Some(FrictionFactor { value, uncertainty });
    match (lattice, solid_fraction) {
        (Lattice::BodyCentred, 0.216) => of(7.7385, 0.0022),
        (Lattice::BodyCentred, 0.45) => of(31.70, 0.04),
        (Lattice::FaceCentred, 0.216) => of(7.7577, 0.0019),
        (Lattice::FaceCentred, 0.45) => of(33.53, 0.03),
        _ => None,
    }
}
