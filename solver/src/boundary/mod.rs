//! Walls. One file per kind; a [`Wall`] is any of them at rest, a [`MovingWall`] a wall and its prescribed [`Motion`].
//!
//! Infinite walls are solid on one side: [`Plane`], and [`Cylinder`] as a vessel or a rod. [`Plate`], [`Mesh`] and a tube of finite length are surfaces
//! without thickness, touched from both sides, at edges and at corners: a body whose centre gets through is pushed out on the other side. What is
//! made of several walls is made by helpers: [`Plane::of_box`], [`hopper::surface`].
//!
//! A ball touches a convex wall, or the inside of a cylinder, at one point. A mesh may be touched at several; see [`mesh`].

mod cylinder;
pub mod hopper;
pub mod mesh;
mod motion;
mod plane;
mod plate;
mod tree;

pub use cylinder::{Cylinder, Side};
pub use mesh::{Mesh, MeshError};
pub use motion::{Motion, Oscillation, Translation, Turn};
pub use plane::Plane;
pub use plate::Plate;

use crate::Vector;
use crate::distance::{Pose, RoundedCore};

/// Contact of a ball with a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereTouch {
    /// Overlap in m, above zero.
    pub overlap: f64,
    /// Unit normal from the ball to the wall.
    pub normal: Vector,
    /// From the centre of the ball to the contact point, halfway between the two surfaces (R eq. 3.15), in m.
    pub arm: Vector,
    /// The normal is a choice: the centre of the ball lies on a wall without thickness, or on the axis of a cylinder.
    pub is_deep: bool,
}

impl SphereTouch {
    /// Contact of a ball whose centre is at a distance from a wall, along a unit normal towards it; `None` if they do not overlap.
    #[inline]
    fn at(distance: f64, normal: Vector, radius: f64) -> Option<SphereTouch> {
        let overlap = radius - distance;
        (overlap > 0.0).then(|| SphereTouch { overlap, normal, arm: normal * (radius - 0.5 * overlap), is_deep: false })
    }
}

/// A convex piece of a wall in its place, for shapes that find their distance by search.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedPiece {
    /// The piece, without a crust.
    pub rounded: RoundedCore,
    /// Its place and turn in the world.
    pub pose: Pose,
    /// Which piece of the wall it is: a face of a mesh.
    pub number: u32,
}

/// A wall at rest, whatever its kind.
#[derive(Debug, Clone, PartialEq)]
pub enum Wall {
    /// An infinite flat wall.
    Plane(Plane),
    /// A vessel, a tube or a rod.
    Cylinder(Cylinder),
    /// A flat convex polygon.
    Plate(Plate),
    /// A surface of triangles or other flat faces.
    Mesh(Mesh),
}

impl Wall {
    /// Adds the contacts of a ball to a list: none, one, or several with a mesh.
    #[inline]
    pub fn touch_sphere(&self, position: &Vector, radius: f64, touches: &mut Vec<SphereTouch>) {
        match self {
            Wall::Plane(plane) => touches.extend(plane.touch_sphere(position, radius)),
            Wall::Cylinder(cylinder) => touches.extend(cylinder.touch_sphere(position, radius)),
            Wall::Plate(plate) => touches.extend(plate.touch_sphere(position, radius)),
            Wall::Mesh(mesh) => mesh.touch_sphere(position, radius, touches),
        }
    }

    /// Distance in m of a point from the wall, for culling: nothing inside a ball about the point of a radius up to it touches. Negative inside a solid wall.
    pub fn distance(&self, point: &Vector) -> f64 {
        match self {
            Wall::Plane(plane) => plane.height(point),
            Wall::Cylinder(cylinder) => cylinder.distance(point),
            Wall::Plate(plate) => plate.distance(point),
            Wall::Mesh(mesh) => mesh.distance(point),
        }
    }

    /// Calls back with the convex pieces of the wall within reach of a point: a plate, a rod, faces of a mesh. Planes and vessels have none.
    pub fn each_piece_within(&self, point: &Vector, reach: f64, mut call: impl FnMut(PlacedPiece)) {
        match self {
            Wall::Plane(_) => {}
            Wall::Cylinder(cylinder) => {
                if cylinder.distance(point) <= reach {
                    cylinder.as_core_near(point, reach).into_iter().for_each(call);
                }
            }
            Wall::Plate(plate) => {
                if plate.distance(point) <= reach {
                    call(plate.as_core());
                }
            }
            Wall::Mesh(mesh) => mesh.each_within(point, reach, |number, _| call(mesh.as_core(number))),
        }
    }

    /// The word a scene file uses for it.
    pub fn name(&self) -> &'static str {
        match self {
            Wall::Plane(_) => "plane",
            Wall::Cylinder(_) => "cylinder",
            Wall::Plate(_) => "plate",
            Wall::Mesh(_) => "mesh",
        }
    }
}

/// A wall and how it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingWall {
    /// The wall at rest.
    pub wall: Wall,
    /// How it moves from there.
    pub motion: Motion,
}

impl MovingWall {
    /// The wall where it is at a time in s; `None` once it has been taken away.
    pub fn at(&self, time: f64) -> Option<PlacedWall<'_>> {
        if self.motion.is_removed(time) {
            return None;
        }
        let pose = (!self.motion.is_rest()).then(|| self.motion.pose(time));
        Some(PlacedWall { moving: self, time, pose })
    }

    /// The plane, if the wall is one that rests for the whole run.
    pub fn plane_at_rest(&self) -> Option<&Plane> {
        match &self.wall {
            Wall::Plane(plane) if self.motion == Motion::default() => Some(plane),
            _ => None,
        }
    }

    /// Velocity in m/s of the material point of the wall that is at a point at a time.
    #[inline]
    pub fn velocity_at(&self, point: &Vector, time: f64) -> Vector {
        self.motion.velocity(time, point)
    }
}

/// A wall in its place at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedWall<'a> {
    moving: &'a MovingWall,
    time: f64,
    /// From the place at rest; `None` for a wall that never moves, which costs nothing.
    pose: Option<Pose>,
}

impl PlacedWall<'_> {
    /// Adds the contacts of a ball to a list, in the world frame.
    #[inline]
    pub fn touch_sphere(&self, position: &Vector, radius: f64, touches: &mut Vec<SphereTouch>) {
        let Some(pose) = &self.pose else { return self.moving.wall.touch_sphere(position, radius, touches) };
        let before = touches.len();
        self.moving.wall.touch_sphere(&to_rest(pose, position), radius, touches);
        for touch in &mut touches[before..] {
            touch.normal = pose.rotation * touch.normal;
            touch.arm = pose.rotation * touch.arm;
        }
    }

    /// Distance in m of a point from the wall; see [`Wall::distance`].
    pub fn distance(&self, point: &Vector) -> f64 {
        match &self.pose {
            None => self.moving.wall.distance(point),
            Some(pose) => self.moving.wall.distance(&to_rest(pose, point)),
        }
    }

    /// Velocity in m/s of the material point of the wall that is at a point.
    #[inline]
    pub fn velocity_at(&self, point: &Vector) -> Vector {
        self.moving.velocity_at(point, self.time)
    }

    /// Velocity in m/s, a time in s ago, of the material point of the wall that is at a point, and its mean acceleration in m/s^2 at that point since. With no
    /// time between, the velocity of now and no acceleration.
    #[inline]
    pub fn motion_since(&self, point: &Vector, ago: f64) -> (Vector, Vector) {
        if self.pose.is_none() {
            return (Vector::zeros(), Vector::zeros());
        }
        let now = self.velocity_at(point);
        if ago == 0.0 {
            return (now, Vector::zeros());
        }
        let before = self.moving.velocity_at(point, self.time - ago);
        (before, (now - before) / ago)
    }

    /// Angular velocity in rad/s, a time in s ago.
    pub fn spin(&self, ago: f64) -> Vector {
        self.moving.motion.spin(self.time - ago)
    }

    /// The wall as a plane in the world, if it is one.
    pub fn as_plane(&self) -> Option<Plane> {
        let Wall::Plane(plane) = &self.moving.wall else { return None };
        Some(match &self.pose {
            None => plane.clone(),
            Some(pose) => Plane { point: to_world(pose, &plane.point), normal: pose.rotation * plane.normal },
        })
    }

    /// The wall as a vessel in the world, if bodies are inside a cylinder.
    pub fn as_vessel(&self) -> Option<Cylinder> {
        let Wall::Cylinder(cylinder) = &self.moving.wall else { return None };
        let (centre, axis) = match &self.pose {
            None => (cylinder.centre, cylinder.axis),
            Some(pose) => (to_world(pose, &cylinder.centre), pose.rotation * cylinder.axis),
        };
        (cylinder.side == Side::Inside).then(|| Cylinder { centre, axis, ..cylinder.clone() })
    }

    /// Calls back with the convex pieces within reach of a point; see [`Wall::each_piece_within`].
    pub fn each_piece_within(&self, point: &Vector, reach: f64, mut call: impl FnMut(PlacedPiece)) {
        let Some(pose) = &self.pose else { return self.moving.wall.each_piece_within(point, reach, call) };
        self.moving.wall.each_piece_within(&to_rest(pose, point), reach, |piece| {
            let position = to_world(pose, &piece.pose.position);
            call(PlacedPiece { pose: Pose { position, rotation: pose.rotation * piece.pose.rotation }, ..piece });
        });
    }
}

/// A point of the world as the wall at rest sees it.
fn to_rest(pose: &Pose, point: &Vector) -> Vector {
    pose.rotation.tr_mul(&(point - pose.position))
}

/// A point of the wall at rest in the world.
fn to_world(pose: &Pose, point: &Vector) -> Vector {
    pose.position + pose.rotation * point
}

/// All walls where they are at a time in s; `None` for those that have been taken away.
pub fn placed(walls: &[MovingWall], time: f64) -> Vec<Option<PlacedWall<'_>>> {
    walls.iter().map(|wall| wall.at(time)).collect()
}

#[cfg(test)]
mod tests;
