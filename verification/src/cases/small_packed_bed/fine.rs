//! What creeping flow does on no grid, found once from the grids of the standard tier: there is no other measure of just this bed.
//!
//! Drops of 980.0, 1040.4, 1086.3 and 1131.5 on 8, 10, 12 and 16 cells a diameter are fitted by $K_0 + C h^p$. The order is not settled where half of all conditions
//! lie in gaps too narrow for a parabola: the value is that of the order 1.3, which R finds for single bodies, and the uncertainty what orders from 1 to 2 differ by.

/// Pressure drop in viscosity times velocity over diameter, and its uncertainty.
pub const DROP: [f64; 2] = [1232.0, 50.0];

/// Tortuosity between the cuts, and its uncertainty.
pub const TORTUOSITY: [f64; 2] = [1.326, 0.006];
