//! Everything that moves, as a structure of arrays.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::shape::Shape;
use crate::{Orientation, Vector};

/// Everything that moves. Bodies are stored by increasing id, so that results do not depend on the order in which a scene lists them.
///
/// Positions live at the current time `t`, velocities and momenta at `t - step/2` (at `t` before the first kick), forces at `t`
/// once they are evaluated, accelerations at the time of the last kick.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Bodies {
    id: Vec<u32>,
    shape: Vec<Arc<Shape>>,
    material: Vec<usize>,
    mass: Vec<f64>,
    inverse_mass: Vec<f64>,
    /// Principal moments of inertia in kg m^2.
    inertia: Vec<Vector>,
    pub(crate) motion: Motion,
}

/// The part of the bodies that changes with time: what a checkpoint holds.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Motion {
    pub(crate) position: Vec<Vector>,
    pub(crate) velocity: Vec<Vector>,
    pub(crate) acceleration: Vec<Vector>,
    pub(crate) force: Vec<Vector>,
    /// World frame. Kept for isotropic bodies; for others it follows from orientation and angular momentum.
    pub(crate) angular_velocity: Vec<Vector>,
    /// Rate of the angular velocity that the torque of the last kick gave: gyroscopic turning is not in it.
    pub(crate) angular_acceleration: Vec<Vector>,
    pub(crate) torque: Vec<Vector>,
    pub(crate) orientation: Vec<Orientation>,
    /// World frame. Kept for bodies that are not isotropic.
    pub(crate) angular_momentum: Vec<Vector>,
}

/// What a body is made from.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySpecification {
    /// Stable number, unique.
    pub id: u32,
    /// Shape.
    pub shape: Arc<Shape>,
    /// Index of its material.
    pub material: usize,
    /// Mass in kg.
    pub mass: f64,
    /// Principal moments of inertia in kg m^2.
    pub inertia: Vector,
    /// Centre of mass in m.
    pub position: Vector,
    /// Velocity in m/s.
    pub velocity: Vector,
    /// Body to world.
    pub orientation: Orientation,
    /// World frame, rad/s.
    pub angular_velocity: Vector,
}

impl Bodies {
    /// Bodies at rest in time, stored by increasing id.
    pub fn new(mut specifications: Vec<BodySpecification>) -> Bodies {
        specifications.sort_by_key(|body| body.id);
        let mut bodies = Bodies::default();
        for body in specifications {
            let inertia = body.inertia;
            let spin_in_body = body.orientation.inverse() * body.angular_velocity;
            bodies.id.push(body.id);
            bodies.mass.push(body.mass);
            bodies.inverse_mass.push(1.0 / body.mass);
            bodies.inertia.push(inertia);
            bodies.material.push(body.material);
            bodies.shape.push(body.shape);
            let motion = &mut bodies.motion;
            motion.position.push(body.position);
            motion.velocity.push(body.velocity);
            motion.orientation.push(body.orientation);
            motion.angular_velocity.push(body.angular_velocity);
            motion.angular_momentum.push(body.orientation * inertia.component_mul(&spin_in_body));
        }
        let count = bodies.len();
        bodies.motion.acceleration = vec![Vector::zeros(); count];
        bodies.motion.force = vec![Vector::zeros(); count];
        bodies.motion.angular_acceleration = vec![Vector::zeros(); count];
        bodies.motion.torque = vec![Vector::zeros(); count];
        bodies
    }

    /// Number of bodies.
    #[inline]
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there is no body.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Place in storage of a body of given id.
    pub fn index_of(&self, id: u32) -> Option<usize> {
        self.id.binary_search(&id).ok()
    }

    /// Stable number.
    pub fn id(&self, index: usize) -> u32 {
        self.id[index]
    }

    /// Shape.
    #[inline]
    pub fn shape(&self, index: usize) -> &Shape {
        &self.shape[index]
    }

    /// Shape, shared by all bodies that have it.
    pub(crate) fn shared_shape(&self, index: usize) -> &Arc<Shape> {
        &self.shape[index]
    }

    /// Index of the material.
    #[inline]
    pub fn material(&self, index: usize) -> usize {
        self.material[index]
    }

    /// Mass in kg.
    #[inline]
    pub fn mass(&self, index: usize) -> f64 {
        self.mass[index]
    }

    /// One over the mass, in 1/kg.
    #[inline]
    pub fn inverse_mass(&self, index: usize) -> f64 {
        self.inverse_mass[index]
    }

    /// Principal moments of inertia in kg m^2.
    #[inline]
    pub fn inertia(&self, index: usize) -> Vector {
        self.inertia[index]
    }

    /// Whether all principal moments are equal: such a body's spin does not depend on its orientation.
    #[inline]
    pub fn is_isotropic(&self, index: usize) -> bool {
        let inertia = self.inertia[index];
        inertia.x == inertia.y && inertia.y == inertia.z
    }

    /// Centre of mass in m at the current time.
    #[inline]
    pub fn position(&self, index: usize) -> Vector {
        self.motion.position[index]
    }

    /// Velocity in m/s half a step before the current time.
    #[inline]
    pub fn half_step_velocity(&self, index: usize) -> Vector {
        self.motion.velocity[index]
    }

    /// Orientation at the current time; the initial one for bodies whose rotation is left out.
    pub fn orientation(&self, index: usize) -> Orientation {
        self.motion.orientation[index]
    }

    /// Angular momentum about the centre of mass in kg m^2/s, half a step before the current time.
    pub fn half_step_angular_momentum(&self, index: usize) -> Vector {
        if self.is_isotropic(index) {
            self.inertia[index].x * self.motion.angular_velocity[index]
        } else {
            self.motion.angular_momentum[index]
        }
    }

    /// Force in N on a body at the current time, without gravity.
    #[inline]
    pub fn force(&self, index: usize) -> Vector {
        self.motion.force[index]
    }

    /// Torque in N m on a body at the current time.
    #[inline]
    pub fn torque(&self, index: usize) -> Vector {
        self.motion.torque[index]
    }

    /// Angular velocity in rad/s, world frame, half a step before the current time.
    pub fn half_step_angular_velocity(&self, index: usize) -> Vector {
        let motion = &self.motion;
        if self.is_isotropic(index) {
            motion.angular_velocity[index]
        } else {
            angular_velocity(&motion.orientation[index], &motion.angular_momentum[index], &self.inertia[index])
        }
    }

    /// What moving the centres needs.
    pub(crate) fn inverse_masses_and_motion(&mut self) -> (&[f64], &mut Motion) {
        (&self.inverse_mass, &mut self.motion)
    }
}

/// Angular velocity in the world frame of a body of given orientation, angular momentum and principal inertia.
pub(crate) fn angular_velocity(orientation: &Orientation, angular_momentum: &Vector, inertia: &Vector) -> Vector {
    orientation * (orientation.inverse() * angular_momentum).component_div(inertia)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Convex, Cuboid, Sphere};

    fn specification(id: u32, shape: Convex) -> BodySpecification {
        let shape = Arc::new(Shape::of_one(shape));
        BodySpecification {
            id,
            inertia: shape.specific_inertia() * 2.0,
            shape,
            material: 0,
            mass: 2.0,
            position: Vector::new(f64::from(id), 0.0, 0.0),
            velocity: Vector::zeros(),
            orientation: Orientation::from_euler_angles(0.3, -0.2, 1.0),
            angular_velocity: Vector::new(1.0, -2.0, 0.5),
        }
    }

    #[test]
    fn bodies_are_stored_by_id() {
        let ball = Convex::Sphere(Sphere { radius: 1.0 });
        let bodies = Bodies::new(vec![specification(7, ball.clone()), specification(3, ball)]);
        assert_eq!((bodies.id(0), bodies.index_of(7), bodies.index_of(4)), (3, Some(1), None));
        assert_eq!(bodies.position(1).x, 7.0);
    }

    #[test]
    fn angular_momentum_and_velocity_belong_together() {
        let brick = Convex::Cuboid(Cuboid { lengths: Vector::new(1.0, 2.0, 3.0) });
        let bodies = Bodies::new(vec![specification(0, brick)]);
        let back = bodies.half_step_angular_velocity(0);
        assert!((back - Vector::new(1.0, -2.0, 0.5)).norm() < 16.0 * f64::EPSILON);
        assert!(!bodies.is_isotropic(0));
    }
}
