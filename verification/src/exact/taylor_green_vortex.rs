//! The plane vortices of Taylor and Green: an exact solution of the Navier-Stokes equations, and its exact decay on a staggered grid.

use nalgebra::Vector3;

/// Vortices of wave number 1/m and speed 1 m/s in a fluid of density 1 kg/m^3, which repeat after $2 \pi$ m in the first two directions.
#[derive(Debug, Clone, Copy)]
pub struct TaylorGreenVortex {
    /// Kinematic viscosity in m^2/s.
    pub viscosity: f64,
}

impl TaylorGreenVortex {
    /// A component of the velocity in m/s.
    pub fn velocity(&self, component: usize, place: &Vector3<f64>, time: f64) -> f64 {
        let decay = (-2.0 * self.viscosity * time).exp();
        match component {
            0 => -place.x.cos() * place.y.sin() * decay,
            1 => place.x.sin() * place.y.cos() * decay,
            _ => 0.0,
        }
    }

    /// Pressure in Pa.
    pub fn pressure(&self, place: &Vector3<f64>, time: f64) -> f64 {
        -0.25 * ((2.0 * place.x).cos() + (2.0 * place.y).cos()) * (-4.0 * self.viscosity * time).exp()
    }

    /// Factor by which central differences and one implicit step after Crank and Nicolson let the velocity decay.
    ///
    /// Central fluxes of the vortices on a staggered grid are a gradient there too, so that only friction changes them, with the modified wave number
    /// $2 \sin(h/2) / h$ in both directions.
    pub fn decay_on_grid(&self, spacing: f64, duration: f64) -> f64 {
        let square = 2.0 * (2.0 * (0.5 * spacing).sin() / spacing).powi(2);
        let half = 0.5 * self.viscosity * square * duration;
        (1.0 - half) / (1.0 + half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vortices_solve_the_equations() {
        let (vortex, step, time) = (TaylorGreenVortex { viscosity: 0.1 }, 1e-4, 0.6);
        let place = Vector3::new(0.7, 1.9, 0.0);
        let shifted = |direction: usize, by: f64| place + Vector3::ith(direction, by);
        for component in 0..2 {
            let at = |place: &Vector3<f64>, time| vortex.velocity(component, place, time);
            let rate = (at(&place, time + step) - at(&place, time - step)) / (2.0 * step);
            let slope = |direction| (at(&shifted(direction, step), time) - at(&shifted(direction, -step), time)) / (2.0 * step);
            let carried: f64 = (0..2).map(|direction| vortex.velocity(direction, &place, time) * slope(direction)).sum();
            let pushed =
                (vortex.pressure(&shifted(component, step), time) - vortex.pressure(&shifted(component, -step), time)) / (2.0 * step);
            // Both curvatures are minus the velocity.
            assert!((rate + carried + pushed + 2.0 * vortex.viscosity * at(&place, time)).abs() < 1e-7);
        }
    }

    #[test]
    fn the_decay_on_a_fine_grid_is_the_exact_one() {
        let vortex = TaylorGreenVortex { viscosity: 0.1 };
        let error = |size: f64| (vortex.decay_on_grid(size, size).powf(1.0 / size) - (-0.2_f64).exp()).abs();
        assert!(error(1e-3) < 1e-7 && (error(2e-2) / error(1e-2) - 4.0).abs() < 0.01);
    }
}
