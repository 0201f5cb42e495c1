//! Bodies in the grid of a box that repeats: which velocities lie inside which body.

use std::sync::Arc;

use super::surface::{Foot, Surface};
use super::walls::WallError;
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

    /// The arm from the centre of that of its images whose surface is nearest, or which holds the point deepest, and the foot on it.
    ///
    /// A body that reaches beyond half an edge of the box from its centre may hold points that lie nearer to the centre of another image.
    pub fn nearest(&self, point: &Vector, extent: &Vector) -> (Vector, Foot) {
        let first = self.arm(point, extent);
        let nearer = |one: (Vector, Foot), other: (Vector, Foot)| if other.1.distance < one.1.distance { other } else { one };
        self.other_images(first, extent).fold((first, self.foot(&first)), nearer)
    }

    /// Whether more than one of its images holds a point, more than so many m below the surface.
    fn is_held_twice(&self, point: &Vector, extent: &Vector, depth: f64) -> bool {
        let first = self.arm(point, extent);
        let others = self.other_images(first, extent).filter(|(_, foot)| foot.distance < -depth).count();
        others + usize::from(self.foot(&first).distance < -depth) > 1
    }

    /// Arms and feet of the other images whose bounding balls hold the point of an arm. A body without ends is one with its images along its axis.
    fn other_images(&self, first: Vector, extent: &Vector) -> impl Iterator<Item = (Vector, Foot)> + '_ {
        let (extent, reach) = (*extent, self.surface.bounding_radius());
        let joined = self.joined_direction();
        let [i, j, k] = [0, 1, 2].map(|direction| match joined {
            Some(axis) if axis == direction => 0,
            _ => (reach / extent[direction] + 0.5).floor() as i32,
        });
        let shifts = (-k..=k).flat_map(move |k| (-j..=j).flat_map(move |j| (-i..=i).map(move |i| [i, j, k])));
        shifts.filter(|shift| *shift != [0; 3]).filter_map(move |shift| {
            let arm = first + Vector::from(shift.map(f64::from)).component_mul(&extent);
            (arm.norm_squared() < reach * reach).then(|| (arm, self.foot(&arm)))
        })
    }

    /// Direction of the grid along which a body without ends lies.
    fn joined_direction(&self) -> Option<usize> {
        self.surface.joined_length()?;
        let axis = self.orientation * Vector::z();
        (0..3).find(|direction| axis[*direction].abs() > 1.0 - ROUNDING)
    }

    /// Values of a component of the velocity, or of the pressure, that lie in the body or within a spacing of it, and some more: place in a field, and in m.
    ///
    /// A body wider than the box meets each value once.
    pub(crate) fn values_near<'a>(&self, grid: &'a Grid, component: Option<usize>) -> impl Iterator<Item = (usize, Vector)> + 'a {
        let reach = self.surface.bounding_radius() + grid.spacing();
        let reached = |side: f64| grid.in_cells(component, &(self.position + Vector::repeat(side * reach)));
        let (lower, upper) = (reached(-1.0), reached(1.0));
        let range = |direction: usize| {
            let first = lower[direction].ceil() as isize;
            first..(upper[direction].floor() as isize + 1).min(first + grid.cells()[direction] as isize)
        };
        let [along, across, above] = [range(0), range(1), range(2)];
        let rows = above.flat_map(move |k| across.clone().map(move |j| [j, k]));
        let cells = rows.flat_map(move |[j, k]| along.clone().map(move |i| [i, j, k]));
        cells.map(move |cell| (grid.index_around(cell), grid.position(component, cell)))
    }

    /// Whether it can be put into a box of given edge lengths in m at all.
    pub(crate) fn check(&self, body: usize, extent: &Vector) -> Result<(), ImmersionError> {
        let motion = [self.position, self.velocity, self.angular_velocity];
        let reach = self.surface.bounding_radius();
        let is_finite = reach.is_finite() && self.orientation.coords.iter().all(|part| part.is_finite());
        if !is_finite || !motion.iter().flatten().all(|value| value.is_finite()) {
            return Err(ImmersionError::NotFinite { body });
        }
        let joined = self.joined_direction();
        if let Some(length) = self.surface.joined_length() {
            let is_box = |direction: usize| (extent[direction] / length - 1.0).abs() < ROUNDING;
            if !joined.is_some_and(is_box) {
                return Err(ImmersionError::NotJoined { body, length });
            }
        }
        let edges = (0..3).filter(|direction| joined != Some(*direction)).map(|direction| reach / extent[direction]).fold(0.0, f64::max);
        if edges > MOST_EDGES { Err(ImmersionError::TooLarge { body, edges }) } else { Ok(()) }
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
    /// A body claims a value twice.
    #[error("body {body} overlaps its own image across the sides of the box")]
    OwnImage {
        /// Its number.
        body: usize,
    },
    /// Not a place or a motion.
    #[error("body {body} has a position, orientation, velocity or size that is not a finite number")]
    NotFinite {
        /// Its number.
        body: usize,
    },
    /// Images of images would have to be looked for.
    #[error("body {body} reaches {edges:.1} edges of the box from its centre; at most {MOST_EDGES} are allowed")]
    TooLarge {
        /// Its number.
        body: usize,
        /// How far it reaches, in edges of the box.
        edges: f64,
    },
    /// A body without ends that does not fit its box.
    #[error("body {body} has no ends: it must lie along an edge of the box that is {length} m long, as it is itself")]
    NotJoined {
        /// Its number.
        body: usize,
        /// Its length in m.
        length: f64,
    },
    /// Bodies that a wall does not leave alone.
    #[error(transparent)]
    Wall(#[from] WallError),
    /// No room for the fluid.
    #[error("bodies fill the whole box for component {component} of the velocity; there must be fluid")]
    NoFluid {
        /// Component of the velocity.
        component: usize,
    },
}

impl ImmersionError {
    /// The same with other numbers for bodies.
    pub(super) fn renumbered(mut self, ids: &[u32]) -> ImmersionError {
        let rename = |number: &mut usize| *number = ids.get(*number).map_or(*number, |id| *id as usize);
        match &mut self {
            ImmersionError::Overlap { one, other } => [one, other].into_iter().for_each(rename),
            ImmersionError::Unresolved { body, .. }
            | ImmersionError::OwnImage { body }
            | ImmersionError::NotFinite { body }
            | ImmersionError::TooLarge { body, .. }
            | ImmersionError::NotJoined { body, .. }
            | ImmersionError::Wall(WallError::Body { body, .. }) => rename(body),
            ImmersionError::Wall(_) | ImmersionError::NoFluid { .. } => {}
        }
        self
    }
}

/// A body needs a value that is as many spacings deep: less, and no value has its surface on all sides.
pub const LEAST_DEPTH: f64 = 1.0;

/// Farthest that a body may reach from its centre, in edges of the box.
pub const MOST_EDGES: f64 = 2.0;

/// Relative error of lengths and directions that is rounding.
const ROUNDING: f64 = 1e-9;

/// Bodies that touch may overlap by rounding, in spacings.
pub const TOUCHING: f64 = 1e-9;

/// Which values of one component of the velocity lie inside a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Inside {
    /// Signed distance in m to the nearest of the bodies whose bounding balls are near; infinite elsewhere.
    pub distance: Vec<f64>,
    /// The body that this is.
    pub body: Vec<u32>,
}

impl Inside {
    /// Finds the values of each component that lie in or near bodies. Where two overlap, a value belongs to the one that it lies deeper in.
    ///
    /// # Errors
    ///
    /// [`ImmersionError`] if a body is too small or too large for the grid, is nowhere, a value lies more than so many spacings deep in two bodies or
    /// images, or there is no fluid.
    pub fn of_components(grid: &Grid, bodies: &[ImmersedBody], deepest_overlap: f64) -> Result<[Inside; 3], ImmersionError> {
        for (number, body) in bodies.iter().enumerate() {
            body.check(number, &grid.extent())?;
        }
        let [first, second, third] = [0, 1, 2].map(|component| Inside::new(grid, component, bodies, deepest_overlap));
        Ok([first?, second?, third?])
    }

    fn new(grid: &Grid, component: usize, bodies: &[ImmersedBody], deepest_overlap: f64) -> Result<Inside, ImmersionError> {
        let mut inside = Inside { distance: vec![f64::INFINITY; grid.len()], body: vec![0; grid.len()] };
        for (number, body) in bodies.iter().enumerate() {
            let mut deepest = 0.0_f64;
            let touching = deepest_overlap * grid.spacing();
            for (index, place) in body.values_near(grid, Some(component)) {
                let distance = body.nearest(&place, &grid.extent()).1.distance;
                if distance.max(inside.distance[index]) < -touching {
                    return Err(ImmersionError::Overlap { one: inside.body[index] as usize, other: number });
                }
                if distance < -touching && body.is_held_twice(&place, &grid.extent(), touching) {
                    return Err(ImmersionError::OwnImage { body: number });
                }
                deepest = deepest.max(-distance / grid.spacing());
                if distance < inside.distance[index] {
                    inside.distance[index] = distance;
                    inside.body[index] = number as u32;
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
    use crate::coupling::resolved::surface::outline::Circle;
    use crate::coupling::resolved::surface::prism::Prism;
    use crate::shape::Cuboid;

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
            for inside in Inside::of_components(&grid, &[ball(radius, position)], TOUCHING).expect("a body in its box") {
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
        let inside = &Inside::of_components(&grid(), &bodies, TOUCHING).expect("bodies apart")[0];
        let at = |cell| grid().index(cell);
        // Values of the first component lie on faces at -1.0 + 0.1 i.
        assert_eq!((inside.body[at([5, 12, 11])], inside.body[at([14, 12, 11])]), (0, 1));
        assert!(inside.is_solid(at([5, 12, 11])) && inside.is_solid(at([14, 12, 11])) && !inside.is_solid(at([10, 12, 11])));
    }

    #[test]
    fn what_a_grid_cannot_hold_is_refused() {
        let refused = |bodies: &[ImmersedBody]| Inside::of_components(&grid(), bodies, TOUCHING).expect_err("bodies that must be refused");
        let small = refused(&[ball(0.5, [0.0, 1.7, 1.1]), ball(0.09, [-0.9, 2.7, 0.1])]);
        assert!(matches!(small, ImmersionError::Unresolved { body: 1, depth, .. } if depth < 1.0), "{small}");
        assert!(small.to_string().contains("at least 1 are needed"), "{small}");
        assert_eq!(refused(&[ball(0.5, [0.0, 1.7, 1.1]), ball(0.5, [0.9, 1.7, 1.1])]), ImmersionError::Overlap { one: 0, other: 1 });
        assert_eq!(refused(&[ball(2.5, [0.0, 1.7, 1.1])]), ImmersionError::OwnImage { body: 0 });
        let brick = |lengths: [f64; 3], position| ImmersedBody::fixed(Arc::new(Cuboid { lengths: Vector::from(lengths) }), position);
        // Touching its images by less than rounding.
        let all = brick([2.0 + 1e-11, 2.4 + 1e-11, 2.2 + 1e-11], Vector::new(0.0, 1.7, 1.1));
        assert_eq!(refused(&[all]), ImmersionError::NoFluid { component: 0 });
        assert!(matches!(refused(&[ball(50.0, [0.0, 1.7, 1.1])]), ImmersionError::TooLarge { body: 0, .. }));
    }

    #[test]
    fn what_is_nowhere_is_refused() {
        let refused =
            |body: ImmersedBody| Inside::of_components(&grid(), &[ball(0.3, [0.5, 2.4, 1.9]), body], TOUCHING).expect_err("a body nowhere");
        let middle = [-0.3, 1.7, 1.1];
        let (bad, turned) =
            (Vector::new(0.0, f64::NAN, 0.0), Orientation::new_unchecked(nalgebra::Quaternion::new(f64::NAN, 0.0, 0.0, 0.0)));
        let nowhere = [
            ball(0.4, [f64::NAN, 1.7, 1.1]),
            ball(0.4, [0.0, f64::INFINITY, 1.1]),
            ball(f64::NAN, middle),
            ball(f64::INFINITY, middle),
            ImmersedBody { velocity: bad, ..ball(0.4, middle) },
            ImmersedBody { angular_velocity: bad, ..ball(0.4, middle) },
            ImmersedBody { orientation: turned, ..ball(0.4, middle) },
        ];
        for body in nowhere {
            assert_eq!(refused(body), ImmersionError::NotFinite { body: 1 });
        }
        assert!(matches!(refused(ball(-1.0, middle)), ImmersionError::Unresolved { body: 1, .. }));
    }

    /// A long body turned so that it reaches into its neighbours' half of the box: its parts there are found, with the arm from its own centre.
    #[test]
    fn parts_beyond_the_nearest_centre_are_found() {
        let turn = Orientation::from_axis_angle(&Vector::z_axis(), 0.62);
        let lengths = Vector::new(2.2, 0.3, 0.4);
        let body = ImmersedBody { orientation: turn, ..ImmersedBody::fixed(Arc::new(Cuboid { lengths }), Vector::new(0.1, 1.6, 1.0)) };
        let inside = &Inside::of_components(&grid(), std::slice::from_ref(&body), TOUCHING).expect("a body between its images")[1];
        let count = (0..grid().len()).filter(|index| inside.is_solid(*index)).count();
        // A layer of half a value is uncertain, by its root.
        assert!((count as f64 * 1e-3 / lengths.product() - 1.0).abs() < 0.05, "{count}");
        let tip = body.position + turn * Vector::new(1.08, 0.02, 0.1);
        let (arm, foot) = body.nearest(&(tip - Vector::new(2.0, 0.0, 0.0)), &grid().extent());
        assert!((arm - (tip - body.position)).norm() < 1e-12 && (foot.distance + 0.02).abs() < 1e-12, "{arm} {foot:?}");
        let longer = ImmersedBody { surface: Arc::new(Cuboid { lengths: Vector::new(2.9, 1.3, 0.4) }), ..body };
        let refused = Inside::of_components(&grid(), &[longer], TOUCHING).expect_err("a body across its image");
        assert_eq!(refused, ImmersionError::OwnImage { body: 0 });
    }

    #[test]
    fn a_body_without_ends_must_be_as_long_as_its_box() {
        let along = |length: f64, turn: Vector| ImmersedBody {
            orientation: Orientation::from_scaled_axis(turn),
            ..ImmersedBody::fixed(Arc::new(Prism::joined(Circle { radius: 0.5 }, length)), Vector::new(0.0, 1.7, 0.3))
        };
        let inside = |body: ImmersedBody| Inside::of_components(&grid(), &[body], TOUCHING);
        let solid = inside(along(2.2, Vector::zeros())).expect("a body along z")[2].clone();
        let count = (0..grid().len()).filter(|index| solid.is_solid(*index)).count();
        assert_eq!(count % 22, 0);
        assert!((count as f64 / 22.0 - PI * 25.0).abs() < 2.0 * 50.0_f64.sqrt());
        assert!(inside(along(2.4, Vector::x() * (0.5 * PI))).is_ok());
        for wrong in [along(2.0, Vector::zeros()), along(2.2, Vector::x() * 0.1), along(2.2, Vector::x() * (0.5 * PI))] {
            assert!(matches!(inside(wrong), Err(ImmersionError::NotJoined { body: 0, .. })));
        }
    }
}
