//! Where bodies leave a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::PlaneGeometry;
use super::boundary::check_box;
use super::insertion::BoxRegion;
use super::validate::{Check, direction, finite_all};

/// A region that bodies leave the run by: one whose centre is in it at the end of a step is taken out, its id, time and mass are kept. Not for hard bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Outlet {
    /// Name, for ledgers and departures.csv.
    pub name: String,
    /// Where.
    pub region: OutletRegion,
}

/// The form of an outlet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum OutletRegion {
    /// Everything on the side of a plane that its normal points away from.
    BehindPlane(PlaneGeometry),
    /// Everything inside a box.
    Box(BoxRegion),
}

pub(super) fn check(key: &str, outlet: &Outlet) -> Check {
    match &outlet.region {
        OutletRegion::BehindPlane(plane) => {
            finite_all(&format!("{key}.region.behind_plane.point"), &plane.point)?;
            direction(&format!("{key}.region.behind_plane.normal"), &plane.normal)
        }
        OutletRegion::Box(region) => check_box(&format!("{key}.region.box"), &region.lower, &region.upper),
    }
}
