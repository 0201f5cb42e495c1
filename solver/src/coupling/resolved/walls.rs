//! Flat walls across directions of a box that repeats: planes of values on which the fluid is held, like the surfaces of bodies, by forces that only act there.
//!
//! A wall runs through the middles of the first cells of its direction, where the components along it have their values, so these are met on the wall itself.
//! Of the component through it the face next to the wall is held; without divergence the one on its other side then stands still as well. The fluid on either side
//! sees it half a spacing away from the wall, where it is of second order in the spacing anyway.
//! A wall without thickness bounds the fluid from both sides, being its own image. Where both ends of the fluid move apart, the last plane of cells is the upper
//! end: a wall one spacing thick.

use super::immersed::Inside;
use crate::Vector;
use crate::fluid::grid::Grid;
use crate::fluid::periodic::PeriodicBox;
use crate::fluid::sheet::{PlaneOfValues, Response, Sheet, along};

/// A wall across a direction. The fluid sticks to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wall {
    /// At rest, without thickness: the fluid fills the edge of the box.
    Resting,
    /// Its sides move along themselves; one spacing thick.
    Moving {
        /// Of the lower end of the fluid, which is half a spacing within the box, in m/s.
        lower: Vector,
        /// Of the upper end of the fluid, as far within the box, in m/s.
        upper: Vector,
    },
}

/// Why there cannot be such a wall.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WallError {
    /// A velocity that is no number, or that leads through the wall.
    #[error("the wall across direction {across} moves at {velocity:?} m/s; it may only move along itself, at a finite velocity")]
    Velocity {
        /// 0, 1 or 2.
        across: usize,
        /// As given.
        velocity: [f64; 3],
    },
    /// A mean flow that would have to pass a wall.
    #[error("a mean velocity of {speed} m/s across direction {across}, where a wall stands; it must be zero")]
    MeanThrough {
        /// 0, 1 or 2.
        across: usize,
        /// As given.
        speed: f64,
    },
    /// A body in a wall.
    #[error("body {body} reaches through the wall across direction {across}")]
    Body {
        /// Its number.
        body: usize,
        /// 0, 1 or 2.
        across: usize,
    },
}

/// A value of the velocity that a wall holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldValue {
    /// Component of the velocity.
    pub component: usize,
    /// Its place in a field.
    pub index: usize,
    /// Number of the side that holds it, among all sides of all walls.
    pub side: u32,
}

/// All walls in a box.
#[derive(Debug, Clone)]
pub struct Walls {
    cells: [usize; 3],
    walls: [Option<Wall>; 3],
    held: Vec<HeldValue>,
    /// Velocities in m/s of all sides.
    velocities: Vec<Vector>,
    planes: Vec<HeldPlanes>,
}

/// The values that one wall holds, plane by plane.
#[derive(Debug, Clone)]
struct HeldPlanes {
    across: usize,
    planes: Vec<PlaneOfValues>,
    /// Numbers among all held values. Those on an edge belong to two walls.
    numbers: Vec<Vec<u32>>,
}

impl Walls {
    /// A box without walls.
    pub fn none(grid: &Grid) -> Walls {
        Walls { cells: grid.cells(), walls: [None; 3], held: Vec::new(), velocities: Vec::new(), planes: Vec::new() }
    }

    /// Walls across some of the three directions.
    ///
    /// # Errors
    ///
    /// [`WallError::Velocity`].
    pub fn new(grid: &Grid, walls: [Option<Wall>; 3]) -> Result<Walls, WallError> {
        let mut all = Walls { walls, ..Walls::none(grid) };
        let mut number: [Vec<Option<u32>>; 3] = std::array::from_fn(|_| vec![None; grid.len()]);
        for (across, wall) in walls.iter().enumerate() {
            let velocities = match wall {
                None => continue,
                Some(Wall::Resting) => vec![Vector::zeros()],
                Some(Wall::Moving { lower, upper }) => vec![*lower, *upper],
            };
            if let Some(wrong) = velocities.iter().find(|velocity| velocity[across] != 0.0 || !velocity.iter().all(|part| part.is_finite()))
            {
                return Err(WallError::Velocity { across, velocity: (*wrong).into() });
            }
            all.hold(grid, across, velocities, &mut number);
        }
        Ok(all)
    }

    fn hold(&mut self, grid: &Grid, across: usize, velocities: Vec<Vector>, number: &mut [Vec<Option<u32>>; 3]) {
        let [one, other] = along(across);
        let first_side = self.velocities.len();
        let mut held = HeldPlanes { across, planes: Vec::new(), numbers: Vec::new() };
        let ends = [0, grid.cells()[across] - 1];
        let tangential = (0..velocities.len()).flat_map(|side| [one, other].map(|component| (side, component, ends[side])));
        for (side, component, place) in tangential.chain([(0, across, 0)]) {
            let mut numbers = Vec::new();
            for second in 0..grid.cells()[other] {
                for first in 0..grid.cells()[one] {
                    let mut cell = [0; 3];
                    [cell[one], cell[other], cell[across]] = [first, second, place];
                    let index = grid.index(cell);
                    numbers.push(*number[component][index].get_or_insert_with(|| {
                        self.held.push(HeldValue { component, index, side: (first_side + side) as u32 });
                        self.held.len() as u32 - 1
                    }));
                }
            }
            held.planes.push(PlaneOfValues { component, place });
            held.numbers.push(numbers);
        }
        self.planes.push(held);
        self.velocities.extend(velocities);
    }

    /// The values that they hold.
    pub fn held(&self) -> &[HeldValue] {
        &self.held
    }

    /// Velocities in m/s of their sides: of each wall in the order of directions that of its lower end and, if it is another, of its upper one.
    pub fn velocities(&self) -> &[Vector] {
        &self.velocities
    }

    /// Whether a flow of this mean velocity in m/s can be between them.
    ///
    /// # Errors
    ///
    /// [`WallError::MeanThrough`].
    pub fn check_mean(&self, mean: &Vector) -> Result<(), WallError> {
        match (0..3).find(|across| self.walls[*across].is_some() && mean[*across] != 0.0) {
            Some(across) => Err(WallError::MeanThrough { across, speed: mean[across] }),
            None => Ok(()),
        }
    }

    /// Whether no body reaches more than so many spacings into a wall.
    ///
    /// # Errors
    ///
    /// [`WallError::Body`].
    pub fn check_bodies(&self, grid: &Grid, inside: &[Inside; 3], deepest_overlap: f64) -> Result<(), WallError> {
        for HeldPlanes { across, numbers, .. } in &self.planes {
            for HeldValue { component, index, .. } in numbers.iter().flatten().map(|number| self.held[*number as usize]) {
                // A body that touches the upper end holds the face that lies half a spacing before it.
                let allowed = if component == *across { deepest_overlap + 0.5 } else { deepest_overlap };
                if inside[component].distance[index] < -allowed * grid.spacing() {
                    return Err(WallError::Body { body: inside[component].body[index] as usize, across: *across });
                }
            }
        }
        Ok(())
    }

    /// Takes what walls hold from the places, in order, where bodies have ghosts of each component.
    pub fn keep_what_they_hold(&self, ghosts: &mut [Vec<usize>; 3]) {
        for HeldValue { component, index, .. } in &self.held {
            if let Ok(place) = ghosts[*component].binary_search(index) {
                ghosts[*component].remove(place);
            }
        }
    }

    /// Whether a wall stands between two values of a component that are less than half a box apart, by their cells.
    pub fn separate(&self, component: usize, one: [usize; 3], other: [usize; 3]) -> bool {
        (0..3).any(|across| {
            // The shortest way leads around the box, and there stands the wall. Its own values are seen from either side.
            let is_around = 2 * one[across].abs_diff(other[across]) > self.cells[across];
            is_around
                && match self.walls[across] {
                    None => false,
                    Some(Wall::Resting) => other[across] != 0,
                    Some(Wall::Moving { .. }) => other[across] != 0 || component != across,
                }
        })
    }

    /// The inverses of a flow on each wall.
    pub fn inverse(&self, flow: &PeriodicBox, response: &Response) -> Vec<Sheet> {
        self.planes.iter().map(|HeldPlanes { across, planes, .. }| Sheet::new(flow, *across, planes, response)).collect()
    }

    /// Forces on held values that give them these velocities, as if each wall stood alone; on edges those of the first wall.
    pub fn solve(&self, sheets: &[Sheet], velocities: &[f64]) -> Vec<f64> {
        let mut forces = vec![0.0; velocities.len()];
        for (sheet, HeldPlanes { numbers, .. }) in sheets.iter().zip(&self.planes).rev() {
            let mut values: Vec<Vec<f64>> =
                numbers.iter().map(|numbers| numbers.iter().map(|number| velocities[*number as usize]).collect()).collect();
            sheet.solve(&mut values);
            for (number, force) in numbers.iter().flatten().zip(values.iter().flatten()) {
                forces[*number as usize] = *force;
            }
        }
        forces
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};
    use std::sync::Arc;

    use super::*;
    use crate::coupling::resolved::balance::{Balance, Driving, Implicit, Motion, Stop};
    use crate::coupling::resolved::ghosts::{Continuation, Ghosts};
    use crate::coupling::resolved::immersed::{ImmersedBody, ImmersionError, TOUCHING};
    use crate::coupling::resolved::surface::Ball;
    use crate::coupling::resolved::unsteady::{Body, Settings, Unsteady, UnsteadyError};
    use crate::fluid::grid::FaceField;
    use crate::fluid::operators::divergence;

    const SLIP: f64 = 1e-10;

    /// So long a step that a few of them end in the steady flow.
    const SETTINGS: Settings = Settings {
        density: 1.0,
        viscosity: 1.0,
        advection: true,
        gravity: Vector::new(0.0, 0.0, 0.0),
        driving: Driving::Force(Vector::new(0.0, 0.0, 0.0)),
        walls: [None; 3],
        fringe: None,
        step: 100.0,
        stop: Stop { slip: SLIP, most_iterations: 200 },
        deepest_overlap: TOUCHING,
    };

    fn flow(cells: [usize; 3], spacing: f64) -> PeriodicBox {
        PeriodicBox::new(Grid::new(cells, spacing, Vector::zeros()).expect("enough cells"))
    }

    fn across(direction: usize, wall: Wall) -> [Option<Wall>; 3] {
        std::array::from_fn(|other| (other == direction).then_some(wall))
    }

    fn steady(flow: &PeriodicBox, settings: Settings, bodies: Vec<Body>) -> Unsteady {
        let mut unsteady = Unsteady::new(flow.clone(), settings, bodies, FaceField::zeros(flow.grid())).expect("walls in a box");
        (0..8).for_each(|_| assert!(unsteady.step().expect("a step").slip <= SLIP));
        unsteady
    }

    fn largest_error(flow: &PeriodicBox, velocity: &FaceField, exact: impl Fn(usize, Vector) -> f64) -> f64 {
        let wanted = FaceField::from_fn(flow.grid(), exact);
        let errors = velocity.component.iter().flatten().zip(wanted.component.iter().flatten()).map(|(got, wanted)| (got - wanted).abs());
        errors.fold(0.0, f64::max)
    }

    #[test]
    fn sheared_fluid_has_the_straight_profile_and_the_stress_of_couette() {
        let flow = flow([6, 5, 11], 0.1);
        let (lower, upper) = (Vector::new(-1.0, 0.4, 0.0), Vector::new(2.0, 0.4, 0.0));
        let unsteady = steady(&flow, Settings { walls: across(2, Wall::Moving { lower, upper }), ..SETTINGS }, vec![]);
        // Between walls of one unit of distance; the first stands in the middle of the first cells.
        let profile = |component: usize, place: Vector| (lower + (upper - lower) * (place.z - 0.05))[component];
        let on_profile = |component: usize, place: Vector| if component == 2 { 0.0 } else { profile(component, place) };
        assert!(largest_error(&flow, unsteady.velocity(), on_profile) < 1e3 * SLIP);
        // The fluid within the wall, a tenth as thick as the one outside, is sheared the other way.
        let stress = (upper - lower) * (0.6 * 0.5) * (1.0 + 10.0);
        let [below, above] = unsteady.wall_loads() else { panic!("two sides") };
        assert!((below.force - stress).norm() < 1e4 * SLIP && (above.force + stress).norm() < 1e4 * SLIP, "{below:?} {above:?}");
    }

    #[test]
    fn driven_fluid_has_the_parabola_of_poiseuille_across_any_direction() {
        for direction in 0..3 {
            let [along, other] = along(direction);
            let (mut cells, mut force) = ([7; 3], Vector::zeros());
            (cells[direction], cells[other], force[along]) = (10, 5, 2.0);
            let flow = flow(cells, 0.1);
            let settings = Settings { walls: across(direction, Wall::Resting), driving: Driving::Force(force), ..SETTINGS };
            let unsteady = steady(&flow, settings, vec![]);
            let parabola = |component: usize, place: Vector| {
                let height = place[direction] - 0.05;
                if component == along { height * (1.0 - height) } else { 0.0 }
            };
            assert!(largest_error(&flow, unsteady.velocity(), parabola) < 1e3 * SLIP);
            assert!((unsteady.wall_loads()[0].force - force * flow.grid().volume()).norm() < 1e4 * SLIP);
        }
    }

    /// Rolls that stand still on walls: a stream function $\sin^2(\pi z) \cos(2 \pi x)$ between walls of unit distance, driven by what friction takes.
    fn roll(component: usize, place: &Vector) -> f64 {
        match component {
            0 => PI * (TAU * place.z).sin() * (TAU * place.x).cos(),
            2 => TAU * (PI * place.z).sin().powi(2) * (TAU * place.x).sin(),
            _ => 0.0,
        }
    }

    fn friction_of_roll(component: usize, place: &Vector) -> f64 {
        match component {
            0 => 2.0 * TAU * TAU * roll(0, place),
            2 => TAU * TAU * roll(2, place) - TAU * (TAU * place.x).sin() * 0.5 * TAU * TAU * (TAU * place.z).cos(),
            _ => 0.0,
        }
    }

    /// Largest error of rolls between walls on a grid, walls being where rolls are.
    fn error_of_rolls(cells: usize, inertia: f64) -> f64 {
        let flow = flow([cells, 4, cells], 1.0 / cells as f64);
        let grid = flow.grid();
        let walls = Walls::new(grid, across(2, Wall::Resting)).expect("a wall");
        let ghosts = Ghosts::between(grid, &[], &walls, Continuation::Quadratic, TOUCHING).expect("walls alone");
        let implicit = Implicit { viscosity: 1.0, inertia, driving: Driving::MeanVelocity(Vector::zeros()) };
        let sheets = walls.inverse(&flow, &implicit.response());
        let above = |place: Vector| place - Vector::z() * (0.5 * grid.spacing());
        let right = FaceField::from_fn(grid, |component, place| {
            inertia * roll(component, &above(place)) + friction_of_roll(component, &above(place))
        });
        let balance = Balance { flow: &flow, ghosts: &ghosts, walls: &walls, sheets: &sheets, implicit, free: &[] };
        let at_rest = [Motion { velocity: Vector::zeros(), angular_velocity: Vector::zeros() }];
        let balanced = balance.solve(&right, &vec![0.0; walls.held().len()], &at_rest, &Stop { slip: 1e-12, most_iterations: 100 });
        // What holds a wall alone is known by its inverse: one flow to see what is missing, one or two to supply it, one for the result.
        assert!(balanced.flows <= 4 && balanced.full_slip < 1e-12, "{} {}", balanced.flows, balanced.full_slip);
        let largest = divergence(grid, &balanced.velocity).into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        assert!(largest * grid.spacing() < 1e-12, "{largest}");
        largest_error(&flow, &balanced.velocity, |component, place| roll(component, &above(place)))
    }

    #[test]
    fn rolls_between_walls_are_of_second_order() {
        for inertia in [1e-3, 100.0] {
            let [coarse, fine] = [16, 32].map(|cells| error_of_rolls(cells, inertia));
            let order = (coarse / fine).log2();
            assert!((order - 2.0).abs() < 0.25 && fine < 0.05 * TAU, "{inertia}: {coarse} {fine} {order}");
        }
    }

    /// Faxén's drag on a sphere that moves midway between two walls, a quarter of their distance across. Its images along the walls are felt with one sign if the
    /// pressure drop is zero and with the other if the mean flow is: dipoles of a square lattice share their mean field evenly, so their mean is that of one alone.
    #[test]
    fn a_sphere_midway_between_walls_has_faxens_drag() {
        let (radius, cells) = (0.125, 24);
        let flow = flow([60, 60, cells], 1.0 / cells as f64);
        let ratio: f64 = 2.0 * radius;
        let wanted = 1.0 / (1.0 - 1.004 * ratio + 0.418 * ratio.powi(3) + 0.21 * ratio.powi(4) - 0.169 * ratio.powi(5));
        let drag = |driving: Driving| {
            let spacing = flow.grid().spacing();
            let centre = 0.5 * (flow.grid().extent() + Vector::new(0.44, 0.26, 1.0) * spacing);
            // So slow that it stays where it is in so long a step.
            let speed = 1e-9;
            let mut immersed = ImmersedBody::fixed(Arc::new(Ball { radius }), centre);
            immersed.velocity = Vector::x() * speed;
            let settings = Settings {
                walls: across(2, Wall::Resting),
                driving,
                step: 1e6,
                stop: Stop { slip: 1e-5 * speed, most_iterations: 200 },
                deepest_overlap: TOUCHING,
                ..SETTINGS
            };
            let mut unsteady = Unsteady::new(flow.clone(), settings, vec![Body { immersed, matter: None }], FaceField::zeros(flow.grid()))
                .expect("a sphere between walls");
            unsteady.step().expect("a step");
            -unsteady.loads()[0].force.x / (6.0 * PI * radius * speed)
        };
        let [free, closed] = [Driving::Force(Vector::zeros()), Driving::MeanVelocity(Vector::zeros())].map(drag);
        let mean = 0.5 * (free + closed);
        // Half of (two spacings / diameter)^2 of six cells a diameter.
        assert!((mean / wanted - 1.0).abs() < 0.5 / 9.0 && free < closed, "{free} {closed} {wanted}");
    }

    #[test]
    fn stencils_of_bodies_do_not_look_through_walls() {
        let grid = *flow([20; 3], 0.05).grid();
        let near = |wall: Wall, direction: usize, height: f64| {
            let mut centre = Vector::new(0.51, 0.48, 0.53);
            centre[direction] = height;
            let ball = ImmersedBody::fixed(Arc::new(Ball { radius: 0.2 }), centre);
            let walls = Walls::new(&grid, across(direction, wall)).expect("a wall");
            Ghosts::between(&grid, &[ball], &walls, Continuation::Quadratic, TOUCHING)
        };
        let moving = Wall::Moving { lower: Vector::zeros(), upper: Vector::zeros() };
        for direction in 0..3 {
            for (wall, top) in [(Wall::Resting, 1.025), (moving, 0.975)] {
                let far = near(wall, direction, 0.5).expect("a ball in the middle").continued();
                assert!(far.linear == 0 && far.direct == 0, "{far:?}");
                for height in [0.025 + 0.27, top - 0.27] {
                    let close = near(wall, direction, height).expect("a ball above a wall").continued();
                    assert!(close.linear > 0 && close.quadratic > 2 * close.linear, "{close:?}");
                }
                for height in [0.025 + 0.19, top - 0.19, 0.0] {
                    let refused = near(wall, direction, height).err();
                    assert_eq!(refused, Some(ImmersionError::Wall(WallError::Body { body: 0, across: direction })), "{height}");
                }
            }
        }
    }

    /// Three walls meet in edges and corners, where values belong to more than one of them.
    #[test]
    fn fluid_in_a_closed_tank_is_held_on_all_its_walls() {
        let flow = flow([12, 10, 14], 0.1);
        let settings =
            Settings { walls: [Some(Wall::Resting); 3], step: 0.02, stop: Stop { slip: 1e-9, most_iterations: 200 }, ..SETTINGS };
        let ball = ImmersedBody::fixed(Arc::new(Ball { radius: 0.22 }), Vector::new(0.6, 0.55, 0.8));
        let ball = ImmersedBody { velocity: Vector::new(0.1, 0.0, -1.0), angular_velocity: Vector::y(), ..ball };
        let start = FaceField::zeros(flow.grid());
        let settings = Settings { driving: Driving::MeanVelocity(Vector::zeros()), ..settings };
        let mut unsteady =
            Unsteady::new(flow.clone(), settings, vec![Body { immersed: ball, matter: None }], start).expect("a ball in a tank");
        (0..3).for_each(|_| assert!(unsteady.step().expect("a step").slip <= 1e-9));
        let walls = Walls::new(flow.grid(), settings.walls).expect("walls");
        let held = walls.held().iter().map(|held| unsteady.velocity().component[held.component][held.index].abs());
        assert!(held.fold(0.0, f64::max) < 1e-7);
        // Of the component through a wall one face beside it is held; nothing passes the other one either.
        for index in 0..flow.grid().len() {
            let cell = flow.grid().cell(index);
            for direction in (0..3).filter(|direction| cell[*direction] < 2) {
                assert!(unsteady.velocity().component[direction][index].abs() < 1e-7, "{direction} {cell:?}");
            }
        }
        assert!(largest_error(&flow, unsteady.velocity(), |_, _| 0.0) > 0.5);
        // Values on each edge are held once.
        let places: std::collections::BTreeSet<(usize, usize)> = walls.held().iter().map(|held| (held.component, held.index)).collect();
        assert_eq!(places.len(), walls.held().len());
    }

    #[test]
    fn walls_that_cannot_be_are_refused() {
        let flow = flow([8; 3], 0.1);
        let make = |settings: Settings| Unsteady::new(flow.clone(), settings, vec![], FaceField::zeros(flow.grid())).err();
        let moving = |velocity| across(1, Wall::Moving { lower: Vector::zeros(), upper: velocity });
        for velocity in [Vector::y(), Vector::new(f64::NAN, 0.0, 0.0), Vector::new(0.0, 0.0, f64::INFINITY)] {
            let refused = make(Settings { walls: moving(velocity), ..SETTINGS });
            assert!(matches!(refused, Some(UnsteadyError::Wall(WallError::Velocity { across: 1, .. }))), "{refused:?}");
        }
        let through = Settings { walls: moving(Vector::x()), driving: Driving::MeanVelocity(Vector::new(0.3, -0.2, 0.0)), ..SETTINGS };
        let refused = make(through).expect("a mean flow through a wall");
        assert_eq!(refused, UnsteadyError::Wall(WallError::MeanThrough { across: 1, speed: -0.2 }));
        assert!(refused.to_string().contains("must be zero"), "{refused}");
    }
}
