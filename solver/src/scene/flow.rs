//! Keys of a fluid and of how bodies meet it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::validate::{Check, finite_all, out_of_range, positive};
use super::{BoundaryGeometry, Domain, NormalLaw, Rotation, Scene, SceneError, SceneErrorKind};

/// An incompressible fluid that fills `[domain]`. Where the domain does not repeat, walls at rest stand at its sides, to which the fluid sticks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fluid {
    /// Density in kg/m^3, above zero.
    pub density: f64,
    /// Dynamic viscosity in Pa s, above zero.
    pub viscosity: f64,
    /// Edge in m of the cubic cells of the grid. Each edge of the domain must be a whole number of them, at least four.
    pub spacing: f64,
    /// Time step of the fluid in s. Contacts of bodies take as many steps in it as they need.
    pub step: f64,
    /// Root mean square in m/s by which the fluid may miss the velocity of bodies and walls: the iteration of a step ends there.
    pub slip: f64,
    /// Most iterations in a step, from 1 to 10000; the run stops if twice the slip is left after them. Each is a solve for the flow and keeps a vector of conditions.
    #[serde(default = "most_flows")]
    pub most_flows: u32,
    /// Velocity in m/s of all of the fluid at the start.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// Whether the fluid carries its momentum along. Without it the flow creeps, but takes its time to begin.
    #[serde(default = "yes")]
    pub advection: bool,
    /// Mean velocity in m/s over the whole box, bodies included, which with moving sides is one cell longer than the domain; the mean pressure gradient is whatever
    /// that takes. Absent: whatever `driving_force` makes of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean_velocity: Option<[f64; 3]>,
    /// Minus the mean pressure gradient in N/m^3, besides the hydrostatic one. Absent: zero; where the domain repeats along gravity, fluid and bodies then fall
    /// together by what bodies weigh more. Not together with `mean_velocity`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub driving_force: Option<[f64; 3]>,
    /// Pairs of sides that move along themselves, in directions in which the domain does not repeat.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub moving_sides: Vec<MovingSides>,
}

fn yes() -> bool {
    true
}

fn most_flows() -> u32 {
    200
}

/// Two sides of the domain that move along themselves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MovingSides {
    /// The direction across them.
    pub across: Direction,
    /// Velocity in m/s of the side with the lower coordinate.
    #[serde(default)]
    pub lower: [f64; 3],
    /// Velocity in m/s of the other side.
    #[serde(default)]
    pub upper: [f64; 3],
}

/// A direction of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Direction {
    /// 0, 1 or 2.
    pub fn index(self) -> usize {
        match self {
            Direction::X => 0,
            Direction::Y => 1,
            Direction::Z => 2,
        }
    }
}

/// How bodies meet the fluid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Coupling {
    /// The flow is resolved around every body, which imposes its rigid motion on it (R chapter 7).
    pub resolved: ResolvedCoupling,
}

/// Flow that is resolved around every body.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResolvedCoupling {
    /// What moves the bodies.
    #[serde(default)]
    pub bodies: ImmersedMotion,
}

/// What moves bodies in a flow.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ImmersedMotion {
    /// The fluid, gravity and contacts.
    #[default]
    Free,
    /// Nothing: they keep the velocities that they start with, and must not meet each other or a wall.
    Given,
}

/// Cells along an edge that differ from a whole number by less are rounding.
const ROUNDING: f64 = 1e-6;

impl Fluid {
    /// Cells along each edge of a domain.
    ///
    /// # Errors
    ///
    /// [`SceneErrorKind::Value`] if they are not whole, too few, or more than can be counted.
    pub(crate) fn cells(&self, domain: &Domain) -> Result<[usize; 3], SceneError> {
        let mut cells = [0; 3];
        for (axis, cells) in cells.iter_mut().enumerate() {
            let along = (domain.upper[axis] - domain.lower[axis]) / self.spacing;
            let whole = along.round();
            if !(LEAST_CELLS..=MOST_CELLS).contains(&whole) || (along - whole).abs() > ROUNDING * whole {
                let allowed = format!(
                    "a length that divides the domain into whole cells: {along} cells in direction {axis}, where {LEAST_CELLS} to {MOST_CELLS} are allowed"
                );
                return Err(out_of_range("fluid.spacing", self.spacing, &allowed));
            }
            *cells = whole as usize;
        }
        Ok(cells)
    }
}

/// Differences know both neighbours.
const LEAST_CELLS: f64 = 4.0;
/// Along one edge.
const MOST_CELLS: f64 = 4096.0;

/// Whether fluid and coupling go together with each other and with the rest of the scene.
pub(super) fn check(scene: &Scene) -> Check {
    let refuse = |key: &str, message: &str| Err(SceneError::new(SceneErrorKind::Combination, key, message));
    let Some(fluid) = &scene.fluid else {
        return match scene.coupling {
            None => Ok(()),
            Some(_) => refuse("coupling", "there is no [fluid] to couple bodies to: leave it out"),
        };
    };
    check_numbers(fluid)?;
    let Some(domain) = &scene.domain else { return refuse("fluid", "needs a [domain]: the box that it fills") };
    fluid.cells(domain)?;
    check_sides(fluid, domain)?;
    let has_bodies = !(scene.bodies.is_empty() && scene.insertions.is_empty());
    match &scene.coupling {
        None if has_bodies => return refuse("coupling", "missing: say how bodies meet the [fluid], as `[coupling.resolved]`"),
        Some(_) if !has_bodies => return refuse("coupling", "there are no bodies to couple to the fluid: leave it out"),
        Some(coupling) if coupling.resolved.bodies == ImmersedMotion::Given && !scene.pairs.is_empty() => {
            return refuse(
                "coupling.resolved.bodies",
                "bodies whose motion is given feel no contact: leave [[pair]] out, or let them be free",
            );
        }
        _ => {}
    }
    let are_free = scene.coupling.as_ref().is_some_and(|coupling| coupling.resolved.bodies == ImmersedMotion::Free);
    if scene.scene.settled.is_some() && !are_free {
        return refuse("scene.settled", "no body moves freely in the [fluid], so none can come to rest: leave it out");
    }
    if matches!(scene.numerics.rotation, Rotation::ExplicitEuler | Rotation::ExplicitEulerAsPrinted) {
        return refuse("numerics.rotation", "does not keep the angular momentum of bodies in a [fluid]: use another");
    }
    check_boundaries(scene, domain)?;
    if !scene.outlets.is_empty() {
        return refuse("outlet[0]", "bodies cannot leave a scene with a [fluid]");
    }
    if let Some(index) = scene.insertions.iter().position(|insertion| insertion.during_run.is_some()) {
        return refuse(&format!("insertion[{index}].during_run"), "bodies cannot come into a scene with a [fluid] during the run");
    }
    if let Some(index) = scene.pairs.iter().position(|pair| matches!(pair.normal, NormalLaw::Impulse(_))) {
        return refuse(&format!("pair[{index}].normal"), "hard bodies know no forces, so a [fluid] cannot move them: use a soft law");
    }
    Ok(())
}

/// The fluid knows no walls but those at the sides of the domain: bodies must not either.
fn check_boundaries(scene: &Scene, domain: &Domain) -> Check {
    for (index, boundary) in scene.boundaries.iter().enumerate() {
        let is_at_side = match &boundary.geometry {
            BoundaryGeometry::Plane(plane) => (0..3).any(|axis| {
                let sides = [(domain.lower[axis], 1.0), (domain.upper[axis], -1.0)];
                let is_across = (0..3).all(|other| other == axis || plane.normal[other] == 0.0);
                let near = ROUNDING * (domain.upper[axis] - domain.lower[axis]);
                let is_at = |(side, inwards): (f64, f64)| (plane.point[axis] - side).abs() <= near && plane.normal[axis] * inwards > 0.0;
                is_across && !domain.periodic[axis] && sides.into_iter().any(is_at)
            }),
            _ => false,
        };
        if !is_at_side || boundary.motion.is_some() {
            let message =
                "the [fluid] would pass through it: only planes at rest, at sides of the domain that do not repeat, can be walls of both";
            return Err(SceneError::new(SceneErrorKind::Unsupported, format!("boundary[{index}].geometry"), message));
        }
    }
    Ok(())
}

fn check_numbers(fluid: &Fluid) -> Check {
    positive("fluid.density", fluid.density, "kg/m^3")?;
    positive("fluid.viscosity", fluid.viscosity, "Pa s")?;
    positive("fluid.spacing", fluid.spacing, "m")?;
    positive("fluid.step", fluid.step, "s")?;
    positive("fluid.slip", fluid.slip, "m/s")?;
    finite_all("fluid.velocity", &fluid.velocity)?;
    fluid.mean_velocity.map_or(Ok(()), |mean| finite_all("fluid.mean_velocity", &mean))?;
    fluid.driving_force.map_or(Ok(()), |force| finite_all("fluid.driving_force", &force))?;
    if fluid.mean_velocity.is_some() && fluid.driving_force.is_some() {
        let message = "a mean_velocity is given, which takes whatever force it needs: leave one of them out";
        return Err(SceneError::new(SceneErrorKind::Combination, "fluid.driving_force", message));
    }
    if !(1..=10_000).contains(&fluid.most_flows) {
        return Err(out_of_range("fluid.most_flows", f64::from(fluid.most_flows), "a whole number from 1 to 10000"));
    }
    Ok(())
}

/// Whether walls at the sides of the domain can be what they are said to be, and the flow between them.
fn check_sides(fluid: &Fluid, domain: &Domain) -> Check {
    for (index, sides) in fluid.moving_sides.iter().enumerate() {
        let (key, axis) = (format!("fluid.moving_sides[{index}]"), sides.across.index());
        finite_all(&format!("{key}.lower"), &sides.lower)?;
        finite_all(&format!("{key}.upper"), &sides.upper)?;
        let refuse = |key: String, message: &str| Err(SceneError::new(SceneErrorKind::Combination, key, message));
        if domain.periodic[axis] {
            return refuse(format!("{key}.across"), "the domain repeats in this direction, so it has no sides there");
        }
        if fluid.moving_sides[..index].iter().any(|other| other.across == sides.across) {
            return refuse(format!("{key}.across"), "these sides are given twice");
        }
        if sides.lower[axis] != 0.0 || sides.upper[axis] != 0.0 {
            return refuse(key, "sides may only move along themselves: the component across must be zero");
        }
    }
    let mean = fluid.mean_velocity.map(|mean| ("fluid.mean_velocity", mean));
    let force = fluid.driving_force.map(|force| ("fluid.driving_force", force));
    for (key, velocity) in [("fluid.velocity", fluid.velocity)].into_iter().chain(mean).chain(force) {
        if let Some(axis) = (0..3).find(|axis| !domain.periodic[*axis] && velocity[*axis] != 0.0) {
            return Err(out_of_range(key, velocity[axis], "zero in a direction in which the domain does not repeat: walls stand there"));
        }
    }
    Ok(())
}
