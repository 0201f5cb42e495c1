//! The sharp constraint: forces on the outermost values inside a body, conditions on its surface.
//!
//! A *ghost* is a value inside a body that a value in the fluid has for a neighbour. Each ghost carries one force and one condition: the velocity, continued from
//! the fluid through the nearest point of the surface to the ghost, is that of the body there. No force acts in the fluid, which is what makes it of second
//! order and better: forces of collocation points that are spread outwards (R section 7.3.4) thicken the body by a part of a cell.

use super::constraint::{Constraint, Load, sum_loads};
use super::immersed::{ImmersedBody, ImmersionError, Inside, TOUCHING};
use super::interpolation::{Degree, Weighted, add_stencil};
use super::pockets::Pockets;
use super::walls::{HeldValue, Walls};
use crate::Vector;
use crate::fluid::grid::{FaceField, Grid};

/// How the velocity is continued from the fluid to a ghost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Continuation {
    /// A parabola through the surface and two points of the fluid.
    Quadratic,
    /// A straight line through the surface and one point of the fluid.
    Linear,
}

/// How many ghosts were continued how: gaps that are too narrow for one way make it fall back to the next.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Continued {
    /// By a parabola.
    pub quadratic: usize,
    /// By a straight line.
    pub linear: usize,
    /// Not at all: the ghost itself moves with the body.
    pub direct: usize,
}

/// The sharp constraint.
pub struct Ghosts {
    grid: Grid,
    /// Those of bodies, then what walls hold.
    ghosts: Vec<Ghost>,
    /// How many are of bodies.
    of_bodies: usize,
    /// Weights of all conditions, one after the other.
    weights: Vec<Weighted>,
    wanted: Vec<f64>,
    /// Numbers of the ghosts next to each ghost, one after the other.
    beside: Vec<u32>,
    pockets: Pockets,
    continued: Continued,
}

struct Ghost {
    component: usize,
    index: usize,
    body: u32,
    /// Its own arm from the centre of the body in m, where its force acts.
    arm: Vector,
    /// Arm of the nearest point of the surface, where its condition is asked for.
    foot: Vector,
    /// Where its condition's weights end.
    end: usize,
    /// Where its neighbours end in the list of them.
    end_beside: usize,
}

/// Distances of the points in the fluid from the surface, in spacings: near enough to be accurate, far enough that their stencils hold ghosts and fluid alone.
const PROBES: [f64; 2] = [1.0, 2.0];

impl Ghosts {
    /// The ghosts of some bodies.
    ///
    /// # Errors
    ///
    /// [`ImmersionError`] if the grid cannot hold the bodies. Gaps too narrow for a continuation are no error: see [`Ghosts::continued`].
    pub fn new(grid: &Grid, bodies: &[ImmersedBody], continuation: Continuation) -> Result<Ghosts, ImmersionError> {
        Ghosts::between(grid, bodies, &Walls::none(grid), continuation, TOUCHING)
    }

    /// The ghosts of some bodies, and what walls hold. Sides of walls are numbered on from the bodies. What a wall holds it keeps where a body touches it.
    ///
    /// # Errors
    ///
    /// [`ImmersionError`] as in [`Ghosts::new`], and if a value lies more than so many spacings deep in two bodies, or in a body and a wall.
    pub fn between(
        grid: &Grid,
        bodies: &[ImmersedBody],
        walls: &Walls,
        continuation: Continuation,
        deepest_overlap: f64,
    ) -> Result<Ghosts, ImmersionError> {
        let inside = Inside::of_components(grid, bodies, deepest_overlap)?;
        walls.check_bodies(grid, &inside, deepest_overlap)?;
        let mut found: [Vec<usize>; 3] = std::array::from_fn(|component| rim(grid, &inside[component]));
        walls.keep_what_they_hold(&mut found);
        let mut number: [Vec<Option<u32>>; 3] = std::array::from_fn(|_| vec![None; grid.len()]);
        for (count, (component, index)) in each(&found).enumerate() {
            number[component][index] = Some(count as u32);
        }
        let of_bodies = each(&found).count();
        for (count, HeldValue { component, index, .. }) in walls.held().iter().enumerate() {
            number[*component][*index] = Some((of_bodies + count) as u32);
        }
        let mut ghosts = Ghosts {
            grid: *grid,
            ghosts: Vec::new(),
            of_bodies,
            weights: Vec::new(),
            wanted: Vec::new(),
            beside: Vec::new(),
            pockets: Pockets::new(grid, &number),
            continued: Continued::default(),
        };
        for (component, index) in each(&found) {
            ghosts.add((component, index), &inside[component], &number[component], (bodies, walls), continuation);
        }
        for held in walls.held() {
            ghosts.hold(held, bodies.len(), walls.velocities());
        }
        Ok(ghosts)
    }

    /// How the ghosts were continued.
    pub fn continued(&self) -> Continued {
        self.continued
    }

    /// Number of pockets that ghosts close in.
    pub fn pockets(&self) -> usize {
        self.pockets.len()
    }

    /// How many conditions are those of bodies; they come before those of walls.
    pub fn of_bodies(&self) -> usize {
        self.of_bodies
    }

    /// One more than the highest number of a body, or of a side of a wall.
    pub fn bodies(&self) -> usize {
        self.ghosts.iter().map(|ghost| ghost.body as usize + 1).max().unwrap_or(0)
    }

    /// What each condition sees of a velocity that a body's number and an arm in m from its centre tell.
    pub fn at_surface(&self, velocity: impl Fn(usize, &Vector) -> Vector) -> Vec<f64> {
        self.ghosts.iter().map(|ghost| velocity(ghost.body as usize, &ghost.foot)[ghost.component]).collect()
    }

    /// The values of a field where the forces act: the adjoint of [`Constraint::spread`].
    pub fn collect(&self, field: &FaceField) -> Vec<f64> {
        self.ghosts.iter().map(|ghost| field.component[ghost.component][ghost.index]).collect()
    }

    /// Adds the ghost at a place, with the numbers that places of its component have.
    fn add(
        &mut self,
        (component, index): (usize, usize),
        inside: &Inside,
        number: &[Option<u32>],
        (bodies, walls): (&[ImmersedBody], &Walls),
        continuation: Continuation,
    ) {
        let grid = self.grid;
        let body = inside.body[index];
        let owner = &bodies[body as usize];
        let place = grid.position(Some(component), grid.cell(index).map(|number| number as isize));
        let (arm, foot) = owner.nearest(&place, &grid.extent());
        let at_surface = arm - foot.normal * foot.distance;
        let depth = -foot.distance / grid.spacing();
        let probe = |distance: f64| owner.position + at_surface + foot.normal * (distance * grid.spacing());
        let cell = grid.cell(index);
        let is_known = |weights: &[Weighted]| {
            weights.iter().all(|(index, _)| {
                let index = *index as usize;
                (!inside.is_solid(index) || number[index].is_some()) && !walls.separate(component, cell, grid.cell(index))
            })
        };
        let mut weights = Vec::new();
        let parabola = |weights: &mut Vec<Weighted>| {
            let [of_ghost, of_first, of_second] = parabola_at_surface(depth);
            weights.push((index as u32, of_ghost));
            add_stencil(&grid, component, &probe(PROBES[0]), &foot.normal, Degree::QuadraticOutward, of_first, weights);
            add_stencil(&grid, component, &probe(PROBES[1]), &foot.normal, Degree::QuadraticOutward, of_second, weights);
        };
        let line = |weights: &mut Vec<Weighted>| {
            weights.push((index as u32, PROBES[0] / (depth + PROBES[0])));
            add_stencil(&grid, component, &probe(PROBES[0]), &foot.normal, Degree::Linear, depth / (depth + PROBES[0]), weights);
        };
        if continuation == Continuation::Quadratic {
            parabola(&mut weights);
        }
        if !weights.is_empty() && is_known(&weights) {
            self.continued.quadratic += 1;
        } else {
            weights.clear();
            line(&mut weights);
            if is_known(&weights) {
                self.continued.linear += 1;
            } else {
                weights = vec![(index as u32, 1.0)];
                self.continued.direct += 1;
            }
        }
        self.weights.append(&mut weights);
        let of_bodies = self.of_bodies;
        self.beside.extend(neighbours(&grid, index).filter_map(|other| number[other]).filter(|other| (*other as usize) < of_bodies));
        self.ghosts.push(Ghost { component, index, body, arm, foot: at_surface, end: self.weights.len(), end_beside: self.beside.len() });
        self.wanted.push(owner.velocity_at(&at_surface)[component]);
    }

    /// Adds a value that a wall holds: it has the velocity of its side, which is all that there is to a wall.
    fn hold(&mut self, held: &HeldValue, bodies: usize, velocities: &[Vector]) {
        let HeldValue { component, index, side } = *held;
        self.weights.push((index as u32, 1.0));
        self.wanted.push(velocities[side as usize][component]);
        let (arm, foot) = (Vector::zeros(), Vector::zeros());
        let (end, end_beside) = (self.weights.len(), self.beside.len());
        self.ghosts.push(Ghost { component, index, body: bodies as u32 + side, arm, foot, end, end_beside });
    }
}

/// Weights of a ghost at a depth and of the two points in the fluid in the value at the surface, by Lagrange's polynomials.
fn parabola_at_surface(depth: f64) -> [f64; 3] {
    let [near, far] = PROBES;
    [
        near * far / ((depth + near) * (depth + far)),
        depth * far / ((depth + near) * (far - near)),
        -depth * near / ((depth + far) * (far - near)),
    ]
}

/// Places of the six values around one.
fn neighbours(grid: &Grid, index: usize) -> impl Iterator<Item = usize> + '_ {
    let cell = grid.cell(index);
    (0..3).flat_map(|direction| [(direction, -1), (direction, 1)]).map(move |(direction, step)| grid.neighbour(cell, direction, step))
}

/// Values inside a body that have a neighbour outside.
fn rim(grid: &Grid, inside: &Inside) -> Vec<usize> {
    let is_rim = |index: &usize| inside.is_solid(*index) && neighbours(grid, *index).any(|other| !inside.is_solid(other));
    (0..grid.len()).filter(is_rim).collect()
}

fn each(found: &[Vec<usize>; 3]) -> impl Iterator<Item = (usize, usize)> + '_ {
    found.iter().enumerate().flat_map(|(component, indices)| indices.iter().map(move |index| (component, *index)))
}

impl Constraint for Ghosts {
    fn len(&self) -> usize {
        self.ghosts.len()
    }

    fn spread(&self, forces: &[f64], onto: &mut FaceField) {
        for (ghost, force) in self.ghosts.iter().zip(forces) {
            onto.component[ghost.component][ghost.index] += force;
        }
    }

    fn sample(&self, velocity: &FaceField) -> Vec<f64> {
        let mut begin = 0;
        let of_ghost = |ghost: &Ghost| {
            let weights = &self.weights[begin..ghost.end];
            begin = ghost.end;
            let values = &velocity.component[ghost.component];
            weights.iter().map(|(index, weight)| weight * values[*index as usize]).sum()
        };
        self.ghosts.iter().map(of_ghost).collect()
    }

    fn wanted(&self) -> &[f64] {
        &self.wanted
    }

    fn is_symmetric(&self) -> bool {
        false
    }

    fn loads(&self, forces: &[f64], bodies: usize) -> Vec<Load> {
        let acting = self.ghosts.iter().map(|ghost| (ghost.body, ghost.component, ghost.arm));
        sum_loads(&self.grid, bodies, acting, forces)
    }

    /// The Laplacian among ghosts alone.
    fn precondition(&self, residual: &[f64]) -> Vec<f64> {
        let square = self.grid.spacing() * self.grid.spacing();
        let mut begin = 0;
        let of_ghost = |(ghost, value): (&Ghost, &f64)| {
            let beside = &self.beside[begin..ghost.end_beside];
            begin = ghost.end_beside;
            let around: f64 = beside.iter().map(|other| residual[*other as usize]).sum();
            (6.0 * value - around) / square
        };
        self.ghosts.iter().zip(residual).map(of_ghost).collect()
    }

    fn project(&self, values: &mut [f64]) {
        self.pockets.project(values);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::coupling::resolved::surface::Ball;

    const POSITION: [f64; 3] = [0.53, 0.48, 0.51];
    const RADIUS: f64 = 0.27;

    fn grid() -> Grid {
        Grid::new([24; 3], 1.0 / 24.0, Vector::zeros()).expect("enough cells")
    }

    fn ball() -> ImmersedBody {
        ImmersedBody::fixed(Arc::new(Ball { radius: RADIUS }), Vector::from(POSITION))
    }

    fn ghosts(continuation: Continuation) -> Ghosts {
        Ghosts::new(&grid(), &[ball()], continuation).expect("a body in its box")
    }

    /// Where the condition of each ghost is asked for: on the surface, straight above it.
    fn feet(ghosts: &Ghosts) -> Vec<(usize, Vector)> {
        ghosts.ghosts.iter().map(|ghost| (ghost.component, Vector::from(POSITION) + ghost.arm.normalize() * RADIUS)).collect()
    }

    fn largest_miss(continuation: Continuation, field: impl Fn(usize, &Vector) -> f64) -> f64 {
        let ghosts = ghosts(continuation);
        let got = ghosts.sample(&FaceField::from_fn(&grid(), |component, place| field(component, &place)));
        feet(&ghosts).iter().zip(got).map(|((component, foot), got)| (got - field(*component, foot)).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn parabolas_meet_velocities_of_second_degree_exactly_at_the_surface() {
        let bent = |component: usize, place: &Vector| {
            let along = place.x - 0.7 * place.y + 0.4 * place.z + component as f64;
            1.0 + along + 2.0 * along * along - 3.0 * place.x * place.z
        };
        assert!(largest_miss(Continuation::Quadratic, bent) < 1e-12);
        // Straight lines do not.
        assert!(largest_miss(Continuation::Linear, bent) > 1e-4);
        let straight = |component: usize, place: &Vector| place.x - 0.7 * place.y + 0.4 * place.z + component as f64;
        assert!(largest_miss(Continuation::Linear, straight) < 1e-13);
    }

    #[test]
    fn forces_act_inside_where_the_fluid_is_next() {
        let ghosts = ghosts(Continuation::Quadratic);
        assert!(ghosts.len() > 1000 && ghosts.continued() == Continued { quadratic: ghosts.len(), linear: 0, direct: 0 });
        for ghost in &ghosts.ghosts {
            let depth = (RADIUS - ghost.arm.norm()) / grid().spacing();
            assert!(depth > 0.0 && depth <= 1.0, "{depth}");
        }
    }

    #[test]
    fn a_turning_body_asks_for_the_velocity_of_its_surface() {
        let body = ImmersedBody { velocity: Vector::new(0.3, 0.0, -0.1), angular_velocity: Vector::new(0.2, 1.0, -0.5), ..ball() };
        let ghosts = Ghosts::new(&grid(), std::slice::from_ref(&body), Continuation::Quadratic).expect("a body in its box");
        for ((component, foot), wanted) in feet(&ghosts).iter().zip(ghosts.wanted()) {
            let velocity = body.velocity + body.angular_velocity.cross(&(foot - body.position));
            assert!((velocity[*component] - wanted).abs() < 1e-14);
        }
    }

    #[test]
    fn narrow_gaps_fall_back_and_say_so() {
        let near = |gap: f64| {
            let apart = Vector::new(0.5 * (0.5 + gap / 24.0), 0.011, 0.007);
            let [one, other] =
                [-1.0, 1.0].map(|side| ImmersedBody::fixed(Arc::new(Ball { radius: 0.25 }), Vector::repeat(0.51) + apart * side));
            Ghosts::new(&grid(), &[one, other], Continuation::Quadratic).expect("two bodies apart").continued()
        };
        let narrow = near(0.3);
        assert!(narrow.linear > 0 && narrow.direct > 0 && narrow.quadratic > 4 * (narrow.linear + narrow.direct), "{narrow:?}");
    }

    #[test]
    fn loads_are_what_the_fluid_is_given_reversed() {
        let ghosts = ghosts(Continuation::Quadratic);
        let forces: Vec<f64> = (0..ghosts.len()).map(|number| (0.37 * number as f64).sin()).collect();
        let mut field = FaceField::zeros(&grid());
        ghosts.spread(&forces, &mut field);
        let load = ghosts.loads(&forces, 1)[0];
        assert!((load.force + field.mean() * grid().volume()).norm() < 1e-15);
        // A force that pushes the fluid round the first axis turns the body back.
        let round: Vec<f64> = ghosts.ghosts.iter().map(|ghost| Vector::x().cross(&ghost.arm)[ghost.component]).collect();
        let load = ghosts.loads(&round, 1)[0];
        assert!(
            load.torque.x < 0.0 && load.torque.yz().norm() < 0.05 * load.torque.x.abs() && load.force.norm() < 0.2 * load.torque.norm()
        );
    }
}
