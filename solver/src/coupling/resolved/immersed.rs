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

/// Why bodies cannot be put into a grid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ImmersionError {
    /// Too small for the grid.
    #[error("body {body} is {depth:.2} spacings deep for component {component} of the velocity; at least {LEAST_DEPTH} are needed")]
    Unresolved {
        /// Its number.
        body: usize,
        /// Component of the velocity that sees least of it.
        component: usize,
        /// Distance of its deepest value from its surface, in spacings.
        depth: f64,
    },
    /// Two bodies claim the same value.
    #[error("bodies {one} and {other} overlap")]
    Overlap {
        /// The one with the lower number.
        one: usize,
        /// The other.
        other: usize,
    },
    /// No room for the fluid.
    #[error("bodies fill the whole box for component {component} of the velocity; there must be fluid")]
    NoFluid {
        /// Component of the velocity.
        component: usize,
    },
}

/// A body needs a value that is as many spacings deep: less, and no value has its surface on all sides.
pub const LEAST_DEPTH: f64 = 1.0;

/// Bodies that touch may overlap by rounding, in spacings.
const TOUCHING: f64 = 1e-9;

/// Which values of one component of the velocity lie inside a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Inside {
    /// Signed distance in m to the nearest of the bodies whose bounding balls are near; infinite elsewhere.
    pub distance: Vec<f64>,
    /// The body that this is.
    pub body: Vec<u32>,
}

impl Inside {
    /// Finds the values of each component that lie in or near bodies.
    ///
    /// # Errors
    ///
    /// [`ImmersionError`] if a body is too small for the grid, bodies overlap, or there is no fluid.
    pub fn of_components(grid: &Grid, bodies: &[ImmersedBody]) -> Result<[Inside; 3], ImmersionError> {
        let [first, second, third] = [0, 1, 2].map(|component| Inside::new(grid, component, bodies));
        Ok([first?, second?, third?])
    }

    fn new(grid: &Grid, component: usize, bodies: &[ImmersedBody]) -> Result<Inside, ImmersionError> {
        let mut inside = Inside { distance: vec![f64::INFINITY; grid.len()], body: vec![0; grid.len()] };
        for (number, body) in bodies.iter().enumerate() {
            let mut deepest = 0.0_f64;
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
                        if distance.max(inside.distance[index]) < -TOUCHING * grid.spacing() {
                            return Err(ImmersionError::Overlap { one: inside.body[index] as usize, other: number });
                        }
                        deepest = deepest.max(-distance / grid.spacing());
                        if distance < inside.distance[index] {
                            inside.distance[index] = distance;
                            inside.body[index] = number as u32;
                        }
                    }
                }
            }
            if deepest < LEAST_DEPTH {
                return Err(ImmersionError::Unresolved { body: number, component, depth: deepest });
            }
        }
        if (0..grid.len()).all(|index| inside.is_solid(index)) { Err(ImmersionError::NoFluid { component }) } else { Ok(inside) }
    }

    /// Whether a value belongs to a body.
    #[inline]
    pub fn is_solid(&self, index: usize) -> bool {
        self.distance[index] < 0.0
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::coupling::resolved::surface::Ball;

    fn grid() -> Grid {
        Grid::new([20, 24, 22], 0.1, Vector::new(-1.0, 0.5, 0.0)).expect("enough cells")
    }

    fn ball(radius: f64, position: [f64; 3]) -> ImmersedBody {
        ImmersedBody::fixed(Arc::new(Ball { radius }), Vector::from(position))
    }

    #[test]
    fn values_inside_fill_the_volume_also_across_the_sides() {
        let (grid, radius): (Grid, f64) = (grid(), 0.62);
        let volume = 4.0 / 3.0 * PI * radius.powi(3);
        for position in [[0.03, 1.7, 1.1], [-0.97, 2.88, 0.01], [5.03, -3.1, 10.1]] {
            for inside in Inside::of_components(&grid, &[ball(radius, position)]).expect("a body in its box") {
                let count = (0..grid.len()).filter(|index| inside.is_solid(*index)).count();
                // Random places of the surface between values: the root of their number counts.
                let scatter = grid.spacing().powi(3) * (4.0 * PI * (radius / grid.spacing()).powi(2)).sqrt();
                assert!((count as f64 * grid.spacing().powi(3) - volume).abs() < 2.0 * scatter, "{count}");
            }
        }
    }

    #[test]
    fn each_value_belongs_to_the_nearest_body() {
        let bodies = [ball(0.4, [-0.5, 1.7, 1.1]), ball(0.3, [0.4, 1.7, 1.1])];
        let inside = &Inside::of_components(&grid(), &bodies).expect("bodies apart")[0];
        let at = |cell| grid().index(cell);
        // Values of the first component lie on faces at -1.0 + 0.1 i.
        assert_eq!((inside.body[at([5, 12, 11])], inside.body[at([14, 12, 11])]), (0, 1));
        assert!(inside.is_solid(at([5, 12, 11])) && inside.is_solid(at([14, 12, 11])) && !inside.is_solid(at([10, 12, 11])));
    }

    #[test]
    fn what_a_grid_cannot_hold_is_refused() {
        let refused = |bodies: &[ImmersedBody]| Inside::of_components(&grid(), bodies).expect_err("bodies that must be refused");
        let small = refused(&[ball(0.5, [0.0, 1.7, 1.1]), ball(0.09, [-0.9, 2.7, 0.1])]);
        assert!(matches!(small, ImmersionError::Unresolved { body: 1, depth, .. } if depth < 1.0), "{small}");
        assert!(small.to_string().contains("at least 1 are needed"), "{small}");
        assert_eq!(refused(&[ball(0.5, [0.0, 1.7, 1.1]), ball(0.5, [0.9, 1.7, 1.1])]), ImmersionError::Overlap { one: 0, other: 1 });
        assert_eq!(refused(&[ball(2.5, [0.0, 1.7, 1.1])]), ImmersionError::NoFluid { component: 0 });
    }
}
