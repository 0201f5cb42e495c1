//! The constraint as R states it (section 7.3.4): collocation points on the surface and in the body, each asking for the body's velocity by interpolation and
//! spreading its force with the same weights.
//!
//! The transpose of an interpolation that reaches outwards puts forces into the fluid, up to two cells from the surface. That thickens the body by a part of a cell,
//! so the order is one and a bit, whatever the order of the interpolation.

use super::constraint::{Constraint, Load, sum_loads};
use super::immersed::{ImmersedBody, ImmersionError, Inside, TOUCHING};
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
    ///
    /// # Errors
    ///
    /// [`ImmersionError`] if the grid cannot hold the bodies.
    pub fn new(grid: &Grid, bodies: &[ImmersedBody], rules: &PointRules) -> Result<Points, ImmersionError> {
        let mut points = Points { grid: *grid, points: Vec::new(), weights: Vec::new(), wanted: Vec::new(), scale: Vec::new() };
        for (component, inside) in Inside::of_components(grid, bodies, TOUCHING)?.iter().enumerate() {
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
                points.add_interior(component, inside, bodies, first);
            }
        }
        Ok(points)
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
            let (arm, _) = owner.nearest(&place, &self.grid.extent());
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::coupling::resolved::surface::Ball;

    const RADIUS: f64 = 0.27;

    fn grid() -> Grid {
        Grid::new([20; 3], 0.05, Vector::zeros()).expect("enough cells")
    }

    fn points(degree: Degree, interior: bool) -> Points {
        let ball = ImmersedBody::fixed(Arc::new(Ball { radius: RADIUS }), Vector::new(0.53, 0.48, 0.51));
        Points::new(&grid(), &[ball], &PointRules { distance: 1.5, degree, interior }).expect("a body in its box")
    }

    fn wavy() -> FaceField {
        FaceField::from_fn(&grid(), |component, place| (7.0 * place.x + 3.0 * place.y - 5.0 * place.z + component as f64).sin())
    }

    #[test]
    fn spreading_is_the_transpose_of_sampling() {
        for degree in [Degree::Linear, Degree::QuadraticOutward] {
            let points = points(degree, true);
            let forces: Vec<f64> = (0..points.len()).map(|number| (0.37 * number as f64).sin()).collect();
            let mut spread = FaceField::zeros(&grid());
            points.spread(&forces, &mut spread);
            let inner = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(one, other)| one * other).sum::<f64>();
            let on_grid: f64 = (0..3).map(|a| inner(&spread.component[a], &wavy().component[a])).sum();
            assert!((inner(&forces, &points.sample(&wavy())) - on_grid).abs() < 1e-12 * points.len() as f64);
        }
    }

    #[test]
    fn velocities_are_met_with_the_order_of_the_interpolation() {
        let quadratic = points(Degree::QuadraticOutward, false);
        let bent = |place: &Vector| 1.0 + place.x * place.y - 2.0 * place.z * place.z + place.x;
        let got = quadratic.sample(&FaceField::from_fn(&grid(), |_, place| bent(&place)));
        for (point, got) in quadratic.points.iter().zip(got) {
            assert!((got - bent(&(Vector::new(0.53, 0.48, 0.51) + point.arm))).abs() < 1e-13);
        }
    }

    #[test]
    fn the_interior_is_what_the_surface_leaves() {
        let (surface, all) = (points(Degree::QuadraticOutward, false), points(Degree::QuadraticOutward, true));
        let inner: Vec<&Point> = all.points.iter().filter(|point| point.arm.norm() < 0.999 * RADIUS).collect();
        assert_eq!(all.len(), surface.len() + inner.len());
        // The interior fills the ball but for a layer of a spacing that stencils of the surface use.
        let volume = 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3);
        let filled = inner.len() as f64 / 3.0 * 0.05_f64.powi(3) / volume;
        assert!((0.4..0.8).contains(&filled), "{filled}");
    }

    #[test]
    fn loads_are_what_the_fluid_is_given_reversed() {
        let points = points(Degree::QuadraticOutward, true);
        let forces: Vec<f64> = (0..points.len()).map(|number| (0.37 * number as f64).cos()).collect();
        let mut field = FaceField::zeros(&grid());
        points.spread(&forces, &mut field);
        assert!((points.loads(&forces, 1)[0].force + field.mean() * grid().volume()).norm() < 1e-13);
    }
}
