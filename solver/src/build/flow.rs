//! The flow of a scene, if it has a fluid: grid, walls at the sides of the domain, and the surfaces of bodies.

use std::sync::Arc;

use super::shapes::ResolvedShape;
use crate::coupling::resolved::balance::{Driving, Stop};
use crate::coupling::resolved::immersed::{ImmersedBody, ImmersionError, TOUCHING};
use crate::coupling::resolved::matter::Matter;
use crate::coupling::resolved::surface::lobes::Lobes;
use crate::coupling::resolved::surface::outline::Circle;
use crate::coupling::resolved::surface::prism::Prism;
use crate::coupling::resolved::surface::spheroid::Spheroid;
use crate::coupling::resolved::surface::{Ball, Surface, Turned};
use crate::coupling::resolved::unsteady::{Body, Settings, Unsteady, UnsteadyError};
use crate::coupling::resolved::walls::{Wall, WallError};
use crate::fluid::grid::{FaceField, Grid};
use crate::fluid::periodic::PeriodicBox;
use crate::scene::{Domain, Fluid, Geometry, ImmersedMotion, MovingSides, NamedShape, Scene, SceneError, SceneErrorKind};
use crate::scheme::resolved::{ResolvedFlow, virtual_mass};
use crate::shape::{Convex, Shape};
use crate::{Bodies, Orientation, Vector};

/// How deep bodies with contacts may lie in each other and in walls, in spacings.
const DEEPEST_OVERLAP: f64 = 0.5;

/// A flow at its start, and the ids of its bodies in its order.
pub(super) struct Flow {
    unsteady: Unsteady,
    ids: Vec<u32>,
    are_free: bool,
}

impl Flow {
    /// The flow of a run whose contacts take so many steps in each of the fluid.
    pub(super) fn with_contact_steps(self, contact_steps: u64) -> ResolvedFlow {
        ResolvedFlow::new(self.unsteady, self.ids, self.are_free, contact_steps)
    }
}

impl Scene {
    /// The flow of a scene, whose bodies it makes as heavy for their contacts as the fluid that they push makes them; `None` without a fluid.
    pub(super) fn flow_and_virtual_masses(&self, shapes: &[ResolvedShape], bodies: &mut Bodies) -> Result<Option<Flow>, SceneError> {
        let (Some(fluid), Some(domain)) = (&self.fluid, &self.domain) else { return Ok(None) };
        let are_free = self.coupling.as_ref().is_none_or(|coupling| coupling.resolved.bodies == ImmersedMotion::Free);
        let ids: Vec<u32> = bodies.by_id().map(|index| bodies.id(index)).collect();
        let mut immersed = Vec::with_capacity(ids.len());
        for index in bodies.by_id().collect::<Vec<_>>() {
            let body = self.immersed(shapes, bodies, index, domain)?;
            if are_free {
                bodies.state.motion[index].inverse_mass = 1.0 / virtual_mass(bodies.mass(index), &body, fluid.density);
            }
            let density = bodies.mass(index) / bodies.shape(index).volume();
            let matter = Matter { density, volume: bodies.shape(index).volume(), moments: bodies.inertia(index) };
            immersed.push(Body { immersed: body, matter: are_free.then_some(matter) });
        }
        let (flow, walls) = box_of(fluid, domain)?;
        let check = |(number, body): (usize, &Body)| body.immersed.check(number, &flow.grid().extent());
        // Before anything is looked for inside of them.
        let checked = immersed.iter().enumerate().try_for_each(check).map_err(|cause| UnsteadyError::Immersion { time: 0.0, cause });
        checked.map_err(|error| self.error_of_flow(error.renumbered(&ids)))?;
        let velocity = velocity_at_start(flow.grid(), fluid, &immersed);
        let settings = self.flow_settings(fluid, walls);
        let made = Unsteady::new(flow, settings, immersed, velocity);
        let unsteady = made.map_err(|error| self.error_of_flow(error.renumbered(&ids)))?;
        Ok(Some(Flow { unsteady, ids, are_free }))
    }

    fn flow_settings(&self, fluid: &Fluid, walls: [Option<Wall>; 3]) -> Settings {
        Settings {
            density: fluid.density,
            viscosity: fluid.viscosity,
            advection: fluid.advection,
            gravity: self.scene.gravity.unwrap_or_default().into(),
            driving: match fluid.mean_velocity {
                Some(mean) => Driving::MeanVelocity(mean.into()),
                None => Driving::Force(fluid.driving_force.unwrap_or_default().into()),
            },
            walls,
            fringe: None,
            step: fluid.step,
            stop: Stop { slip: fluid.slip, most_iterations: fluid.most_flows as usize },
            deepest_overlap: if self.pairs.is_empty() { TOUCHING } else { DEEPEST_OVERLAP },
        }
    }

    /// A body as the flow sees it.
    fn immersed(&self, shapes: &[ResolvedShape], bodies: &Bodies, index: usize, domain: &Domain) -> Result<ImmersedBody, SceneError> {
        let position = bodies.position(index);
        let id = bodies.id(index);
        if let Some(axis) =
            (0..3).find(|axis| !domain.periodic[*axis] && !(domain.lower[*axis]..=domain.upper[*axis]).contains(&position[*axis]))
        {
            let message = format!("{} is outside the [domain], at whose sides the [fluid] has walls", position[axis]);
            return Err(SceneError::new(SceneErrorKind::Value, format!("{}.position", self.key_of_body(id)), message));
        }
        let shape = &bodies.shapes()[bodies.shape_index(index)];
        // Spheres of sizes of their own have no name.
        let named = shapes.iter().position(|named| Arc::ptr_eq(&named.shape, shape)).map(|place| (place, &self.shapes[place]));
        Ok(ImmersedBody {
            surface: self.surface(bodies.shape(index), named)?,
            position,
            orientation: if shape.as_sphere().is_some() { Orientation::identity() } else { bodies.orientation(index) },
            velocity: bodies.half_step_velocity(index),
            angular_velocity: bodies.half_step_angular_velocity(index),
        })
    }

    /// The surface of a shape in its principal axes.
    fn surface(&self, shape: &Shape, named: Option<(usize, &NamedShape)>) -> Result<Arc<dyn Surface>, SceneError> {
        if let Some(sphere) = shape.as_sphere() {
            return Ok(Arc::new(Ball { radius: sphere.radius }));
        }
        let refuse = |what: &str| {
            let (key, name) =
                named.map_or(("shape".to_string(), ""), |(place, named)| (format!("shape[{place}].geometry"), named.name.as_str()));
            let message = format!(
                "shape `{name}` {what} in a resolved flow: a sphere, cuboid, cylinder, polyhedron, trilobe, quadralobe or spheroid can be"
            );
            Err(SceneError::new(SceneErrorKind::Unsupported, key, message))
        };
        let lobed = |count: usize, diameter: f64, length: f64| match Lobes::touching(count, diameter) {
            Ok(lobes) => Ok(turned(Arc::new(Prism::closed(lobes, length)), shape.axes().inverse())),
            Err(_) => refuse("has no outline that can be"),
        };
        match named.map(|(_, named)| &named.geometry) {
            Some(Geometry::Trilobe(lobes)) => lobed(3, lobes.diameter, lobes.length),
            Some(Geometry::Quadralobe(lobes)) => lobed(4, lobes.diameter, lobes.length),
            _ => match shape.parts() {
                [part] => match surface_of(&part.convex) {
                    Some(surface) => Ok(turned(surface, part.orientation)),
                    None => refuse("cannot be"),
                },
                _ => refuse("is glued and cannot be"),
            },
        }
    }

    fn error_of_flow(&self, error: UnsteadyError) -> SceneError {
        let of_body = |body: &usize, key: &str| format!("{}.{key}", self.key_of_body(*body as u32));
        let key = match &error {
            UnsteadyError::Immersion { cause: ImmersionError::Overlap { other: body, .. }, .. }
            | UnsteadyError::Immersion { cause: ImmersionError::OwnImage { body }, .. }
            | UnsteadyError::Immersion { cause: ImmersionError::Wall(WallError::Body { body, .. }), .. } => of_body(body, "position"),
            UnsteadyError::Immersion { cause: ImmersionError::TooLarge { body, .. }, .. } => of_body(body, "shape"),
            UnsteadyError::Immersion { .. } => "fluid.spacing".into(),
            UnsteadyError::Matter(body) => of_body(body, "mass"),
            _ => "fluid".into(),
        };
        SceneError::new(SceneErrorKind::Combination, key, error.to_string())
    }
}

/// The surface of a convex shape, if a flow can be resolved around it.
fn surface_of(convex: &Convex) -> Option<Arc<dyn Surface>> {
    match convex {
        Convex::Sphere(sphere) => Some(Arc::new(Ball { radius: sphere.radius })),
        Convex::Cuboid(cuboid) => Some(Arc::new(*cuboid)),
        Convex::Cylinder(cylinder) => Some(Arc::new(Prism::closed(Circle { radius: cylinder.radius }, cylinder.length))),
        Convex::Polyhedron(polyhedron) => Some(polyhedron.clone()),
        Convex::Superellipsoid(shape) if shape.exponents() == [1.0, 1.0] => {
            let axes = shape.semi_axes();
            // Its own axis, the third, may lie along any of the body's.
            let polar = (0..3).find(|polar| axes[(polar + 1) % 3] == axes[(polar + 2) % 3])?;
            let turn = Orientation::rotation_between(&Vector::z(), &Vector::ith(polar, 1.0)).unwrap_or_default();
            Some(turned(Arc::new(Spheroid { equatorial: axes[(polar + 1) % 3], polar: axes[polar] }), turn))
        }
        Convex::Superellipsoid(_) | Convex::Spherocylinder(_) => None,
    }
}

/// Velocity at the start: that of the fluid, and inside bodies theirs, so that a body that is set in motion has its whole momentum: what values of the grid make its
/// volume too large or too small by is made up for. The first step takes out the divergence.
fn velocity_at_start(grid: &Grid, fluid: &Fluid, bodies: &[Body]) -> FaceField {
    let mut velocity = FaceField::from_fn(grid, |component, _| fluid.velocity[component]);
    for Body { immersed, matter } in bodies {
        for (component, values) in velocity.component.iter_mut().enumerate() {
            let near = immersed.values_near(grid, Some(component)).map(|(index, place)| (index, immersed.nearest(&place, &grid.extent())));
            let inside: Vec<(usize, Vector)> =
                near.filter(|(_, (_, foot))| foot.distance < 0.0).map(|(index, (arm, _))| (index, arm)).collect();
            let counted = inside.len() as f64 * grid.spacing().powi(3);
            let missing = matter.map_or(0.0, |matter| matter.volume / counted - 1.0);
            for (index, arm) in inside {
                values[index] =
                    immersed.velocity_at(&arm)[component] + missing * (immersed.velocity[component] - fluid.velocity[component]);
            }
        }
    }
    velocity
}

fn turned(surface: Arc<dyn Surface>, orientation: Orientation) -> Arc<dyn Surface> {
    if orientation == Orientation::identity() { surface } else { Arc::new(Turned { surface, orientation }) }
}

/// More cells, some twenty fields of them, do not fit the memory of most machines.
const MOST_CELLS_IN_ALL: f64 = 5e7;

/// The box of the flow and its walls. A wall at rest runs through the middles of the first cells, and is both sides of its direction; two that move apart need a
/// further cell between them, outside of the fluid.
fn box_of(fluid: &Fluid, domain: &Domain) -> Result<(PeriodicBox, [Option<Wall>; 3]), SceneError> {
    let mut cells = fluid.cells(domain)?;
    let (mut lower, mut walls) = (Vector::from(domain.lower), [None; 3]);
    for axis in (0..3).filter(|axis| !domain.periodic[*axis]) {
        lower[axis] -= 0.5 * fluid.spacing;
        walls[axis] = Some(match fluid.moving_sides.iter().find(|sides| sides.across.index() == axis) {
            None => Wall::Resting,
            Some(MovingSides { lower, upper, .. }) => {
                cells[axis] += 1;
                Wall::Moving { lower: Vector::from(*lower), upper: Vector::from(*upper) }
            }
        });
    }
    let all: f64 = cells.iter().map(|cells| *cells as f64).product();
    if all > MOST_CELLS_IN_ALL {
        let message = format!("{} m cuts the domain into {all} cells; at most {MOST_CELLS_IN_ALL} are allowed", fluid.spacing);
        return Err(SceneError::new(SceneErrorKind::Value, "fluid.spacing", message));
    }
    let grid = Grid::new(cells, fluid.spacing, lower);
    let grid = grid.map_err(|error| SceneError::new(SceneErrorKind::Value, "fluid.spacing", error.to_string()))?;
    Ok((PeriodicBox::new(grid), walls))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the flow takes for solid is what contacts take for it, in every shape that is not symmetric in its principal axes too.
    #[test]
    fn surfaces_of_the_flow_hold_the_same_points_as_the_shapes() {
        let shapes = [
            "cuboid = { lengths = [1.0, 2.0, 1.5] }",
            "cylinder = { radius = 0.5, length = 1.6 }",
            "tetrahedron = { edge = 2.0 }",
            "icosahedron = { edge = 0.9 }",
            "hull = { points = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.3, 1.2, 0.1], [0.2, 0.1, 1.9], [0.9, 0.8, 0.7]] }",
            "superellipsoid = { semi_axes = [0.6, 0.6, 1.1], exponents = [1.0, 1.0] }",
            "superellipsoid = { semi_axes = [1.1, 0.6, 0.6], exponents = [1.0, 1.0] }",
            "superellipsoid = { semi_axes = [0.9, 0.5, 0.9], exponents = [1.0, 1.0] }",
            "trilobe = { diameter = 1.2, length = 0.9 }",
            "quadralobe = { diameter = 1.2, length = 3.0 }",
        ];
        for geometry in shapes {
            let text = format!(
                "scene = {{ name = \"a\", end_time = 1.0 }}\n[[material]]\nname = \"a\"\ndensity = 1.0\n[[shape]]\nname = \"a\"\ngeometry = {{ {geometry} }}\n\
                 [[body]]\nshape = \"a\"\nmaterial = \"a\"\nposition = [0.0, 0.0, 0.0]\n"
            );
            let scene = Scene::from_toml(&text, "a test").expect("a sound scene");
            let shape = scene.resolve_shapes().expect("a sound shape").remove(0).shape;
            let surface = scene.surface(&shape, Some((0, &scene.shapes[0]))).expect("a surface");
            let (mut inside, mut wrong) = (0, 0);
            let (side, parts) = (2.0 * shape.bounding_radius(), 24);
            let along = |number: usize| side * ((number as f64 + 0.37) / f64::from(parts) - 0.5);
            for number in 0..(parts as usize).pow(3) {
                let point = Vector::new(along(number % 24), along(number / 24 % 24), along(number / 576));
                let is_in = |part: &crate::shape::Part| part.convex.contains(&(part.orientation.inverse() * (point - part.position)));
                let (holds, distance) = (shape.parts().iter().any(is_in), surface.foot(&point).distance);
                inside += usize::from(holds);
                wrong += usize::from(holds != (distance < 0.0) && distance.abs() > 1e-9);
            }
            assert!(inside > 300 && wrong == 0, "{geometry}: {inside} {wrong}");
        }
    }
}
