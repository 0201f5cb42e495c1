//! Everything that moves, as a structure of arrays.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::shape::Shape;
use crate::{Orientation, Vector, parallel};

/// Everything that moves. Bodies are stored by increasing id until they are sorted in space; their order never depends on the order in which a scene
/// lists them.
///
/// Positions live at the current time `t`, velocities and momenta at `t - step/2` (at `t` before the first kick), forces at `t`
/// once they are evaluated, accelerations at the time of the last kick.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Bodies {
    id: Vec<u32>,
    /// Storage indices by increasing id.
    by_id: Vec<u32>,
    /// The shapes there are.
    shapes: Vec<Arc<Shape>>,
    /// Index of the shape of each body.
    shape: Vec<u32>,
    material: Vec<u32>,
    mass: Vec<f64>,
    /// Principal moments of inertia in kg m^2.
    inertia: Vec<Vector>,
    pub(crate) state: State,
}

/// The part of the bodies that changes with time: what a checkpoint holds. One entry per body in each array.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    pub(crate) motion: Vec<Motion>,
    pub(crate) force: Vec<Vector>,
    pub(crate) torque: Vec<Vector>,
    pub(crate) orientation: Vec<Orientation>,
    /// World frame. Kept for bodies that are not isotropic.
    pub(crate) angular_momentum: Vec<Vector>,
}

impl State {
    /// Sets forces to zero, and torques if there are any.
    pub(crate) fn clear_forces(&mut self, with_torques: bool) {
        let values = 6 * self.force.len();
        parallel::for_each_part_of(values, &mut self.force, |part| part.fill(Vector::zeros()));
        if with_torques {
            parallel::for_each_part_of(values, &mut self.torque, |part| part.fill(Vector::zeros()));
        }
    }

    /// Whether every array is of so many bodies.
    pub(crate) fn is_of(&self, bodies: usize) -> bool {
        let others = [self.force.len(), self.torque.len(), self.orientation.len(), self.angular_momentum.len()];
        self.motion.len() == bodies && others.iter().all(|length| *length == bodies)
    }
}

/// What a contact must know of a body, together in memory because its partners are looked up one by one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[repr(C, align(32))]
pub(crate) struct Motion {
    pub(crate) position: Vector,
    /// Of a sphere; of other shapes, that of the ball about the centre that holds them. In m.
    pub(crate) radius: f64,
    pub(crate) velocity: Vector,
    pub(crate) inverse_mass: f64,
    pub(crate) acceleration: Vector,
    /// One over the moment of inertia of an isotropic body, in 1/(kg m^2); of others, one over the first of their moments.
    pub(crate) inverse_inertia: f64,
    /// World frame. Kept for isotropic bodies; for others it follows from orientation and angular momentum.
    pub(crate) angular_velocity: Vector,
    /// Rate of the angular velocity that the torque of the last kick gave: gyroscopic turning is not in it.
    pub(crate) angular_acceleration: Vector,
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
            bodies.push(body);
        }
        bodies
    }

    /// Stores a further body behind all others; its id is above theirs.
    pub(crate) fn push(&mut self, body: BodySpecification) {
        let inertia = body.inertia;
        let known = self.shapes.iter().rposition(|shape| Arc::ptr_eq(shape, &body.shape));
        let shape = known.unwrap_or(self.shapes.len());
        let size = body.shape.as_sphere().map_or(body.shape.bounding_radius(), |sphere| sphere.radius);
        if known.is_none() {
            self.shapes.push(body.shape);
        }
        self.by_id.push(self.id.len() as u32);
        self.id.push(body.id);
        self.shape.push(shape as u32);
        self.material.push(body.material as u32);
        self.mass.push(body.mass);
        self.inertia.push(inertia);
        let state = &mut self.state;
        state.motion.push(Motion {
            position: body.position,
            radius: size,
            velocity: body.velocity,
            inverse_mass: 1.0 / body.mass,
            inverse_inertia: 1.0 / inertia.x,
            angular_velocity: body.angular_velocity,
            ..Motion::default()
        });
        state.force.push(Vector::zeros());
        state.torque.push(Vector::zeros());
        state.orientation.push(body.orientation);
        state.angular_momentum.push(angular_momentum(&body.orientation, &body.angular_velocity, &inertia));
    }

    /// Stores the bodies in another order: the one at `order[n]` goes to place `n`. Those that are not in the order are taken out; their shapes stay known.
    pub(crate) fn reorder(&mut self, order: &[u32]) {
        permute(&mut self.id, order);
        permute(&mut self.shape, order);
        permute(&mut self.material, order);
        permute(&mut self.mass, order);
        permute(&mut self.inertia, order);
        permute(&mut self.state.motion, order);
        permute(&mut self.state.force, order);
        permute(&mut self.state.torque, order);
        permute(&mut self.state.orientation, order);
        permute(&mut self.state.angular_momentum, order);
        let ids = &self.id;
        self.by_id = (0..ids.len() as u32).collect();
        self.by_id.sort_unstable_by_key(|place| ids[*place as usize]);
    }

    /// Gives a body another velocity in m/s and another angular velocity in rad/s, world frame.
    pub(crate) fn set_velocities(&mut self, index: usize, velocity: Vector, angular_velocity: Vector) {
        let (state, inertia) = (&mut self.state, self.inertia[index]);
        (state.motion[index].velocity, state.motion[index].angular_velocity) = (velocity, angular_velocity);
        state.angular_momentum[index] = angular_momentum(&state.orientation[index], &angular_velocity, &inertia);
    }

    /// Storage indices by increasing id.
    pub fn by_id(&self) -> impl Iterator<Item = usize> {
        self.by_id.iter().map(|place| *place as usize)
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
        let rank = self.by_id.binary_search_by_key(&id, |place| self.id[*place as usize]).ok()?;
        Some(self.by_id[rank] as usize)
    }

    /// Stable number.
    pub fn id(&self, index: usize) -> u32 {
        self.id[index]
    }

    /// Shape.
    #[inline]
    pub fn shape(&self, index: usize) -> &Shape {
        &self.shapes[self.shape[index] as usize]
    }

    /// All shapes, by the index that bodies have.
    pub(crate) fn shapes(&self) -> &[Arc<Shape>] {
        &self.shapes
    }

    /// Index of the shape of a body.
    #[inline]
    pub(crate) fn shape_index(&self, index: usize) -> usize {
        self.shape[index] as usize
    }

    /// Index of the material.
    #[inline]
    pub fn material(&self, index: usize) -> usize {
        self.material[index] as usize
    }

    /// Mass in kg.
    #[inline]
    pub fn mass(&self, index: usize) -> f64 {
        self.mass[index]
    }

    /// One over the mass, in 1/kg.
    #[inline]
    pub fn inverse_mass(&self, index: usize) -> f64 {
        self.state.motion[index].inverse_mass
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
        self.state.motion[index].position
    }

    /// Velocity in m/s half a step before the current time.
    #[inline]
    pub fn half_step_velocity(&self, index: usize) -> Vector {
        self.state.motion[index].velocity
    }

    /// Orientation at the current time; the initial one for bodies whose rotation is left out.
    pub fn orientation(&self, index: usize) -> Orientation {
        self.state.orientation[index]
    }

    /// Angular momentum about the centre of mass in kg m^2/s, half a step before the current time.
    pub fn half_step_angular_momentum(&self, index: usize) -> Vector {
        if self.is_isotropic(index) {
            self.inertia[index].x * self.state.motion[index].angular_velocity
        } else {
            self.state.angular_momentum[index]
        }
    }

    /// Force in N on a body at the current time, without gravity.
    #[inline]
    pub fn force(&self, index: usize) -> Vector {
        self.state.force[index]
    }

    /// Torque in N m on a body at the current time.
    #[inline]
    pub fn torque(&self, index: usize) -> Vector {
        self.state.torque[index]
    }

    /// Angular velocity in rad/s, world frame, half a step before the current time.
    pub fn half_step_angular_velocity(&self, index: usize) -> Vector {
        let state = &self.state;
        if self.is_isotropic(index) {
            state.motion[index].angular_velocity
        } else {
            angular_velocity(&state.orientation[index], &state.angular_momentum[index], &self.inertia[index])
        }
    }
}

fn permute<Item: Clone>(items: &mut Vec<Item>, order: &[u32]) {
    *items = order.iter().map(|place| items[*place as usize].clone()).collect();
}

/// Angular velocity in the world frame of a body of given orientation, angular momentum and principal inertia.
pub(crate) fn angular_velocity(orientation: &Orientation, angular_momentum: &Vector, inertia: &Vector) -> Vector {
    orientation * (orientation.inverse() * angular_momentum).component_div(inertia)
}

/// Angular momentum in the world frame of a body of given orientation, angular velocity and principal inertia.
pub(crate) fn angular_momentum(orientation: &Orientation, angular_velocity: &Vector, inertia: &Vector) -> Vector {
    orientation * inertia.component_mul(&(orientation.inverse() * angular_velocity))
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
