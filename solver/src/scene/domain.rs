//! The box that bodies live in, and how their neighbours are found.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The box that bodies live in. Only its periodic sides act on bodies: walls are boundaries.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Domain {
    /// Corner with the smallest coordinates, in m.
    pub lower: [f64; 3],
    /// Corner with the largest coordinates, in m; above the lower one in each direction.
    pub upper: [f64; 3],
    /// In which directions the box repeats: a body that leaves comes back on the other side. No period may be shorter than the largest body is thick, with
    /// the skin of the neighbour list.
    #[serde(default)]
    pub periodic: [bool; 3],
}

impl Domain {
    /// Whether it repeats in any direction.
    pub fn is_periodic(&self) -> bool {
        self.periodic.contains(&true)
    }
}

/// How it is found out which bodies may touch.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct NeighbourSearch {
    /// The algorithm.
    pub method: SearchMethod,
    /// Width in m by which bodies may be apart and still be listed as neighbours, above zero: a wide skin means fewer lists with more pairs. Absent: three hundredths
    /// of the mean diameter of the bodies' bounding balls for the first list, and then what costs least at the speed with which the last list was used up.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skin: Option<f64>,
    /// Lists after which bodies are sorted in space, so that neighbours are near in memory; 0 for never. Absent: 20 for more than 4000 bodies, never for
    /// fewer. Sums run in storage order: sorting changes results by rounding.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lists_between_sorts: Option<u32>,
}

/// How it is found out which bodies may touch.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SearchMethod {
    /// All pairs up to 100 bodies without periodic sides, else a list.
    #[default]
    Automatic,
    /// Every pair at every step: the oracle. Not with periodic sides; for at most 3000 bodies.
    AllPairs,
    /// Pairs within a skin, found by cells, until a body has moved by half the skin.
    List,
}
