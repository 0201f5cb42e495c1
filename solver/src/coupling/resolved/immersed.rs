//! Bodies in the grid of a box that repeats: which velocities lie inside which body.

use std::sync::Arc;

use super::surface::{Foot, Surface};
use crate::fluid::grid::Grid;
use crate::{Orientation, Vector};

/// A rigid body in a flow.
#[derive(Clone)]
pub struct ImmersedBody {
    /// Its surface, about its centre of mass.
    pub surface: Arc<dyn Surface>,
    /// Centre of mass in m.
    pub position: Vector,
    /// Body to world.
    pub orientation: Orientation,
    /// In m/s.
    pub velocity: Vector,
    /// World frame, rad/s.
    pub angular_velocity: Vector,
}

impl ImmersedBody {
    /// A body at rest, not turned.
    pub fn fixed(surface: Arc<dyn Surface>, position: Vector) -> ImmersedBody {
        let zero = Vector::zeros();
        ImmersedBody { surface, position, orientation: Orientation::identity(), velocity: zero, angular_velocity: zero }
    }

    /// The shortest way from its centre to a point in a box of given edge lengths in m that repeats.
    pub fn arm(&self, point: &Vector, extent: &Vector) -> Vector {
        (point - self.position).zip_map(extent, |along, edge| along - edge * (along / edge).round())
    }

    /// The nearest point of its surface, seen from an arm; world frame.
    pub fn foot(&self, arm: &Vector) -> Foot {
        let foot = self.surface.foot(&(self.orientation.inverse() * arm));
        Foot { normal: self.orientation * foot.normal, ..foot }
    }

    /// Velocity in m/s of its material at an arm.
    pub fn velocity_at(&self, arm: &Vector) -> Vector {
        self.velocity + self.angular_velocity.cross(arm)
    }
}

/// Which values of one component of the velocity lie inside a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Inside {
    /// Signed distance in m to the nearest of the bodies whose bounding balls are near; infinite elsewhere.
    pub distance: Vec<f64>,
    /// The body that this is.
    pub body: Vec<u32>,
}

impl Inside {
    /// Finds the values of a component that lie in or near bodies.
    pub fn new(grid: &Grid, component: usize, bodies: &[ImmersedBody]) -> Inside {
        let mut inside = Inside { distance: vec![f64::INFINITY; grid.len()], body: vec![0; grid.len()] };
        for (number, body) in bodies.iter().enumerate() {
            let reach = body.surface.bounding_radius() + grid.spacing();
            let reached = |side: f64| grid.in_cells(Some(component), &(body.position + Vector::repeat(side * reach)));
            let (lower, upper) = (reached(-1.0), reached(1.0));
            // A body wider than the box meets each value once.
            let range = |direction: usize| {
                let first = lower[direction].ceil() as isize;
                first..(upper[direction].floor() as isize + 1).min(first + grid.cells()[direction] as isize)
            };
            for k in range(2) {
                for j in range(1) {
                    for i in range(0) {
                        let index = grid.index_around([i, j, k]);
                        let arm = body.arm(&grid.position(Some(component), [i, j, k]), &grid.extent());
                        let distance = body.foot(&arm).distance;
                        if distance < inside.distance[index] {
                            inside.distance[index] = distance;
                            inside.body[index] = number as u32;
                        }
                    }
                }
            }
        }
        inside
    }

    /// Whether a value belongs to a body.
    #[inline]
    pub fn is_solid(&self, index: usize) -> bool {
        self.distance[index] < 0.0
    }
}
