//! The constraint as R states it (section 7.3.4): collocation points on the surface and in the body, each asking for the body's velocity by interpolation and
//! spreading its force with the same weights.
//!
//! The transpose of an interpolation that reaches outwards puts forces into the fluid, up to two cells from the surface. That thickens the body by a part of a cell,
//! so the order is one and a bit, whatever the order of the interpolation.

use super::constraint::{Constraint, Load, sum_loads};
use super::immersed::{ImmersedBody, Inside};
use super::interpolation::{Degree, Weighted, add_stencil};
use crate::Vector;
use crate::fluid::grid::{FaceField, Grid};
use crate::fluid::operators::laplacian;

/// How points are laid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointRules {
    /// Distance of neighbours on the surface in spacings of the grid: 1 to 2 in R.
    pub distance: f64,
    /// How the velocity is interpolated at the surface.
    pub degree: Degree,
    /// Whether values inside the body are held too. A fixed body does not need them.
    pub interior: bool,
}

/// The constraint of collocation points.
pub struct Points {
    grid: Grid,
    points: Vec<Point>,
    weights: Vec<Weighted>,
    wanted: Vec<f64>,
    /// One over the sum of the squares of a point's weights.
    scale: Vec<f64>,
}

/// One component of the velocity at one point.
struct Point {
    component: usize,
    body: u32,
    /// From the centre of the body, in m.
    arm: Vector,
    /// Where its weights end.
    end: usize,
}

impl Points {
    /// Points on and in some bodies.
    pub fn new(grid: &Grid, bodies: &[ImmersedBody], rules: &PointRules) -> Points {
        let mut points = Points { grid: *grid, points: Vec::new(), weights: Vec::new(), wanted: Vec::new(), scale: Vec::new() };
        for component in 0..3 {
            let inside = Inside::new(grid, component, bodies);
            let first = points.weights.len();
            for (number, body) in bodies.iter().enumerate() {
                for place in body.surface.points(rules.distance * grid.spacing()) {
                    let arm = body.orientation * place;
                    let normal = body.foot(&arm).normal;
                    let mut stencil = Vec::new();
                    add_stencil(grid, component, &(body.position + arm), &normal, rules.degree, 1.0, &mut stencil);
                    points.add(component, number as u32, arm, body, stencil);
                }
            }
            if rules.interior {
                points.add_interior(component, &inside, bodies, first);
            }
        }
        points
    }

    fn add(&mut self, component: usize, body: u32, arm: Vector, owner: &ImmersedBody, mut stencil: Vec<Weighted>) {
        self.scale.push(1.0 / stencil.iter().map(|(_, weight)| weight * weight).sum::<f64>());
        self.weights.append(&mut stencil);
        self.wanted.push(owner.velocity_at(&arm)[component]);
        self.points.push(Point { component, body, arm, end: self.weights.len() });
    }

    /// Values inside bodies that no point of the surface uses.
    fn add_interior(&mut self, component: usize, inside: &Inside, bodies: &[ImmersedBody], first: usize) {
        let mut is_used = vec![false; self.grid.len()];
        for (index, _) in &self.weights[first..] {
            is_used[*index as usize] = true;
        }
        for index in (0..self.grid.len()).filter(|index| inside.is_solid(*index) && !is_used[*index]) {
            let body = inside.body[index];
            let owner = &bodies[body as usize];
            let place = self.grid.position(Some(component), self.grid.cell(index).map(|number| number as isize));
            let arm = owner.arm(&place, &self.grid.extent());
            self.add(component, body, arm, owner, vec![(index as u32, 1.0)]);
        }
    }

    fn stencils(&self) -> impl Iterator<Item = (&Point, &[Weighted])> {
        let mut begin = 0;
        self.points.iter().map(move |point| {
            let stencil = &self.weights[begin..point.end];
            begin = point.end;
            (point, stencil)
        })
    }
}

impl Constraint for Points {
    fn len(&self) -> usize {
        self.points.len()
    }

    fn spread(&self, forces: &[f64], onto: &mut FaceField) {
        for ((point, stencil), force) in self.stencils().zip(forces) {
            for (index, weight) in stencil {
                onto.component[point.component][*index as usize] += weight * force;
            }
        }
    }

    fn sample(&self, velocity: &FaceField) -> Vec<f64> {
        let of_point = |(point, stencil): (&Point, &[Weighted])| {
            let values = &velocity.component[point.component];
            stencil.iter().map(|(index, weight)| weight * values[*index as usize]).sum()
        };
        self.stencils().map(of_point).collect()
    }

    fn wanted(&self) -> &[f64] {
        &self.wanted
    }

    fn is_symmetric(&self) -> bool {
        true
    }

    fn loads(&self, forces: &[f64], bodies: usize) -> Vec<Load> {
        sum_loads(&self.grid, bodies, self.points.iter().map(|point| (point.body, point.component, point.arm)), forces)
    }

    /// The Laplacian between points, with the overlap of their stencils divided out.
    fn precondition(&self, residual: &[f64]) -> Vec<f64> {
        let scaled = |values: &[f64]| values.iter().zip(&self.scale).map(|(value, scale)| value * scale).collect::<Vec<f64>>();
        let mut field = FaceField::zeros(&self.grid);
        self.spread(&scaled(residual), &mut field);
        let component = field.component.map(|values| laplacian(&self.grid, &values).into_iter().map(|value| -value).collect());
        scaled(&self.sample(&FaceField { component }))
    }

    fn project(&self, _values: &mut [f64]) {}
}
