//! How several contact points between the same two bodies share one contact law (R section 2.6).
//!
//! # The rules
//!
//! - *Sum* (default; R's model A): every point has the full spring, so that a contact of $N$ points lasts $\sqrt N$ times shorter; the dashpot is $1/\sqrt N$ of that of a
//!   single point (corrected eq. 3.35). The only rule whose springs have a potential: elastic motion keeps its energy, damped motion never gains any.
//! - *By overlap*: point $j$ carries the part $q_j = \delta_j / \sum \delta$ of spring and dashpot. Like R's model B it keeps force and duration of a
//!   contact the same however many points it has; unlike model B it does not jump when a further point begins to touch, so that the
//!   order of the scheme survives.
//! - *By count* (R's model B, eq. 3.36): $q_j = 1/N$.
//! - *Sum as printed*: the dashpot of eq. 3.33-3.35 as R prints them, with the reduced mass of eq. 3.19. Errata: a pair gets $\sqrt 2$ times, a wall twice the right dashpot.
//!
//! No rule can be independent of the number of points, continuous and conservative at once: a potential that is the same for one point and for two equal
//! ones, and rises with each overlap, depends on the deepest point alone. A cylinder that falls elastically on its rim, a fraction of a degree from lying flat,
//! leaves the wall with up to 2.1 times its kinetic energy by count and 1.3 times by overlap (case `cylinder_wall_impact`).
//!
//! # The damped mass
//!
//! A dashpot that gives a restitution must know the mass it stops: that of the resultant of all points,
//! $1/m = \bar n^2/m_r + a_1 I_1^{-1} a_1 + a_2 I_2^{-1} a_2$ with the mean normal and the mean moment arm $a = \overline{r \times n}$. R (eq. 3.19) takes the
//! reduced mass of the bodies instead, which damps every oblique impact too much.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How several contact points between the same two bodies share the contact law.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sharing {
    /// Not at all: every point has the full spring (model A of R), with the corrected dashpot. Conserves energy; contacts of many points are shorter.
    #[default]
    Sum,
    /// In proportion to their overlaps: force and duration do not depend on their number, and nothing jumps.
    ByOverlap,
    /// Equally (model B of R, eq. 3.36): the force jumps when a further point touches.
    ByCount,
    /// Model A with the dashpot as R eq. 3.35 prints it: too strong.
    SumAsPrinted,
}

/// Which mass the normal dashpot is calibrated for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DampedMass {
    /// The effective mass of the bodies at the contact point: the restitution holds at the contact point.
    #[default]
    Effective,
    /// The reduced mass of the bodies (R eq. 3.19), wherever they touch.
    Reduced,
}

/// The part of the contact law that one point carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Part of the stiffness.
    pub stiffness: f64,
    /// Part of the dashpot of a single contact of the damped mass.
    pub dashpot: f64,
}

impl Share {
    /// A single point carries everything.
    pub const WHOLE: Share = Share { stiffness: 1.0, dashpot: 1.0 };
}

impl Sharing {
    /// The share of a point of given overlap among `count` points of `total` overlap, between two bodies or at a wall.
    pub fn share(self, overlap: f64, total: f64, count: usize, at_wall: bool) -> Share {
        let count = count as f64;
        match self {
            Sharing::ByOverlap => Share { stiffness: overlap / total, dashpot: overlap / total },
            Sharing::ByCount => Share { stiffness: 1.0 / count, dashpot: 1.0 / count },
            Sharing::Sum => Share { stiffness: 1.0, dashpot: 1.0 / count.sqrt() },
            // Eq. 3.35 with w0^2 = 2k/M puts sqrt(2) for 1; M is twice the reduced mass of a pair of equal bodies, but the mass itself at a wall.
            Sharing::SumAsPrinted => Share { stiffness: 1.0, dashpot: if at_wall { 2.0 } else { 2.0_f64.sqrt() } / count.sqrt() },
        }
    }

    /// Weight of a point in the resultant of all.
    pub fn weight(self, overlap: f64, total: f64, count: usize) -> f64 {
        match self {
            Sharing::ByOverlap => overlap / total,
            Sharing::ByCount | Sharing::Sum | Sharing::SumAsPrinted => 1.0 / count as f64,
        }
    }

    /// By how much the stiffness of a contact can exceed that of a single point, for a number of points.
    pub fn largest_stiffness(self, count: usize) -> f64 {
        match self {
            Sharing::ByOverlap | Sharing::ByCount => 1.0,
            Sharing::Sum | Sharing::SumAsPrinted => count as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R's own check: whatever the number of points, spring and dashpot together must give the restitution of a single contact.
    #[test]
    fn damping_ratio_of_equal_points_is_that_of_one() {
        for sharing in [Sharing::ByOverlap, Sharing::ByCount, Sharing::Sum] {
            for count in [1, 2, 4, 10] {
                let share = sharing.share(0.1, 0.1 * f64::from(count), count as usize, true);
                let (stiffness, dashpot) = (f64::from(count) * share.stiffness, f64::from(count) * share.dashpot);
                // Ratio of damping: dashpot over the root of stiffness.
                assert!((dashpot / stiffness.sqrt() - 1.0).abs() < 4.0 * f64::EPSILON, "{sharing:?} {count}");
            }
        }
        assert_eq!(Sharing::SumAsPrinted.share(0.1, 0.1, 1, true).dashpot, 2.0);
        assert_eq!(Sharing::ByOverlap.share(0.1, 0.4, 4, false), Sharing::ByOverlap.share(0.2, 0.8, 2, false));
    }
}
