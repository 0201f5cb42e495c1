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
            if let Some(wrong) = velocities.iter().find(|velocity| velocity[across] != 0.0 || !velocity.iter().all(|part| part.is_finite())) {
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

    /// Whether no body claims a value that a wall holds.
    ///
    /// # Errors
    ///
    /// [`WallError::Body`].
    pub fn check_bodies(&self, inside: &[Inside; 3]) -> Result<(), WallError> {
        for HeldPlanes { across, numbers, .. } in &self.planes {
            for HeldValue { component, index, .. } in numbers.iter().flatten().map(|number| self.held[*number as usize]) {
                if inside[component].is_solid(index) {
                    return Err(WallError::Body { body: inside[component].body[index] as usize, across: *across });
                }
            }
        }
        Ok(())
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
