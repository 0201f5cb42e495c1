//! What a body that moves freely is made of, and the fluid that fills it (R eq. 7.2 and 7.3).

use std::f64::consts::PI;

use nalgebra::Matrix3;

use super::immersed::ImmersedBody;
use crate::Vector;
use crate::fluid::grid::{FaceField, Grid};

/// A homogeneous solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matter {
    /// In kg/m^3.
    pub density: f64,
    /// In m^3.
    pub volume: f64,
    /// Principal moments of inertia about the centre, body frame, in kg m^2.
    pub moments: Vector,
}

impl Matter {
    /// A solid ellipsoid of three semi-axes in m along the axes of its body; a sphere has three equal ones.
    pub fn ellipsoid(density: f64, semi_axes: &Vector) -> Matter {
        let volume = 4.0 / 3.0 * PI * semi_axes.product();
        let squares = semi_axes.component_mul(semi_axes);
        Matter { density, volume, moments: (Vector::repeat(squares.sum()) - squares) * (0.2 * density * volume) }
    }

    /// Whether all of it is finite and positive.
    pub fn is_sound(&self) -> bool {
        [self.density, self.volume].iter().chain(self.moments.iter()).all(|value| value.is_finite() && *value > 0.0)
    }

    /// Tensor of inertia of a body in the world frame in kg m^2.
    pub fn inertia(&self, body: &ImmersedBody) -> Matrix3<f64> {
        let turn = body.orientation.to_rotation_matrix();
        turn * Matrix3::from_diagonal(&self.moments) * turn.inverse()
    }
}

/// Angular momentum of the fluid that fills a body, as weights of the values inside.
///
/// The load on a body is that of the constraint's forces and the rate of change of the momentum of the fluid inside. Without divergence the linear momentum
/// of that fluid is the one of a rigid body, whatever it does inside, because the velocity of its surface alone tells it. The angular momentum is not: fluid
/// inside takes its time to turn with the body, so it is summed here. (R eq. 7.3 takes it as rigid, and lacks a factor: errata.)
#[derive(Debug, Clone, Default)]
pub struct FluidInside {
    weights: Vec<(usize, u32, Vector)>,
}

impl FluidInside {
    /// Weights of a body in a fluid of a density in kg/m^3. Values count with the part of their cell that lies inside, as if the surface were flat there.
    pub fn new(grid: &Grid, body: &ImmersedBody, density: f64) -> FluidInside {
        let reach = body.surface.bounding_radius() + grid.spacing();
        let mass = density * grid.spacing().powi(3);
        let mut weights = Vec::new();
        for component in 0..3 {
            let mut parts: Vec<(u32, f64, Vector)> = Vec::new();
            let reached = |side: f64| grid.in_cells(Some(component), &(body.position + Vector::repeat(side * reach)));
            let (lower, upper) = (reached(-1.0), reached(1.0));
            let range = |direction: usize| lower[direction].ceil() as isize..upper[direction].floor() as isize + 1;
            for (k, j, i) in range(2).flat_map(|k| range(1).flat_map(move |j| range(0).map(move |i| (k, j, i)))) {
                let arm = grid.position(Some(component), [i, j, k]) - body.position;
                let part = (0.5 - body.foot(&arm).distance / grid.spacing()).clamp(0.0, 1.0);
                if part > 0.0 {
                    parts.push((grid.index_around([i, j, k]) as u32, part * mass, arm));
                }
            }
            // Arms from the centre of these masses: fluid that goes along without turning has no angular momentum, wherever the body lies between values.
            let total: f64 = parts.iter().map(|(_, mass, _)| mass).sum();
            let centre = parts.iter().map(|(_, mass, arm)| arm * (mass / total)).sum::<Vector>();
            weights.extend(parts.into_iter().map(|(index, mass, arm)| {
                let mut along = Vector::zeros();
                along[component] = mass;
                (component, index, (arm - centre).cross(&along))
            }));
        }
        FluidInside { weights }
    }

    /// Angular momentum about the centre of the body in kg m^2/s.
    pub fn angular_momentum(&self, velocity: &FaceField) -> Vector {
        self.weights.iter().map(|(component, index, weight)| *weight * velocity.component[*component][*index as usize]).sum()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::Orientation;
    use crate::coupling::resolved::surface::Ball;

    fn ball(radius: f64) -> ImmersedBody {
        ImmersedBody::fixed(Arc::new(Ball { radius }), Vector::new(0.02, 0.47, 0.51))
    }

    #[test]
    fn moments_of_a_sphere_are_two_fifths_and_turn_with_the_body() {
        let matter = Matter::ellipsoid(2.0, &Vector::repeat(0.3));
        let mass = 2.0 * 4.0 / 3.0 * PI * 0.027;
        assert!((matter.moments - Vector::repeat(0.4 * mass * 0.09)).norm() < 1e-16);
        let long = Matter::ellipsoid(2.0, &Vector::new(0.1, 0.1, 0.4));
        let body = ImmersedBody { orientation: Orientation::from_scaled_axis(Vector::y() * (0.5 * PI)), ..ball(0.3) };
        // The long axis of the body points along the first of the world: least inertia about it.
        let inertia = long.inertia(&body);
        assert!((inertia[(0, 0)] - long.moments.z).abs() < 1e-15 && (inertia[(2, 2)] - long.moments.x).abs() < 1e-15);
        assert!(!Matter { density: f64::NAN, ..long }.is_sound() && !Matter { volume: 0.0, ..long }.is_sound() && long.is_sound());
    }

    #[test]
    fn fluid_that_goes_along_has_no_angular_momentum() {
        let grid = Grid::new([16; 3], 1.0 / 16.0, Vector::zeros()).expect("enough cells");
        let velocity = FaceField::from_fn(&grid, |component, _| [1.0, -0.4, 0.3][component]);
        assert!(FluidInside::new(&grid, &ball(0.31), 1.3).angular_momentum(&velocity).norm() < 1e-15);
    }

    #[test]
    fn fluid_that_turns_with_a_sphere_has_the_angular_momentum_of_one_at_second_order() {
        let rate = Vector::new(0.4, -1.0, 0.7);
        let error = |cells: usize| {
            let grid = Grid::new([cells; 3], 1.0 / cells as f64, Vector::zeros()).expect("enough cells");
            let body = ball(0.31);
            let velocity = FaceField::from_fn(&grid, |component, place| rate.cross(&body.arm(&place, &grid.extent()))[component]);
            let exact = rate * Matter::ellipsoid(1.3, &Vector::repeat(0.31)).moments.x;
            (FluidInside::new(&grid, &body, 1.3).angular_momentum(&velocity) - exact).norm() / exact.norm()
        };
        let (coarse, fine) = (error(16), error(32));
        assert!(coarse < 0.05 && fine < 0.4 * coarse, "{coarse} {fine}");
    }
}
