//! Flows that solve the Navier-Stokes equations with a force made for them: one for each kind of side.
//!
//! In a plane, with a stream function that is a product: $u = U(y) + a(t) F(x) G'(y)$, $v = -a(t) F'(x) G(y)$, and a pressure $b(t) P(x) Q(y)$. So the divergence
//! vanishes, and the force follows from derivatives of functions of one variable.

use std::f64::consts::PI;

use nalgebra::Vector3;

/// A function of one variable and its first three derivatives.
type Profile = fn(f64) -> [f64; 4];

/// Which sides the flow meets, in a box of edge 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Walls at rest all round.
    Closed,
    /// It repeats along walls of which the upper one moves.
    MovingWall,
    /// Free slip all round.
    FreeSlip,
    /// In on one side and out on the other, free slip between.
    ThroughFlow,
}

/// A manufactured flow in the plane of two directions, the same everywhere along the third.
#[derive(Debug, Clone, Copy)]
pub struct ManufacturedFlow {
    /// Sides.
    pub kind: Kind,
    /// Directions of `x` and `y`.
    pub plane: [usize; 2],
    /// Kinematic viscosity in m^2/s; the density is 1.
    pub viscosity: f64,
}

fn sine_squared(x: f64) -> [f64; 4] {
    let (sine, cosine) = (2.0 * PI * x).sin_cos();
    [0.5 * (1.0 - cosine), PI * sine, 2.0 * PI * PI * cosine, -4.0 * PI.powi(3) * sine]
}

fn half_wave(x: f64) -> [f64; 4] {
    let (sine, cosine) = (PI * x).sin_cos();
    [sine, PI * cosine, -PI * PI * sine, -PI.powi(3) * cosine]
}

fn whole_wave(x: f64) -> [f64; 4] {
    let (sine, cosine) = (2.0 * PI * x).sin_cos();
    [sine, 2.0 * PI * cosine, -4.0 * PI * PI * sine, -8.0 * PI.powi(3) * cosine]
}

/// Slope zero at 0; slope and curvature zero at 1.
fn ramp(x: f64) -> [f64; 4] {
    let scale = 8.0;
    let slope = x * (1.0 - x).powi(2);
    let curvature = (1.0 - x) * (1.0 - 3.0 * x);
    [scale * (x * x / 2.0 - 2.0 * x.powi(3) / 3.0 + x.powi(4) / 4.0), scale * slope, scale * curvature, scale * (6.0 * x - 4.0)]
}

/// Everything at one point of the plane at one time.
struct Local {
    velocity: [f64; 2],
    pressure: f64,
    force: [f64; 2],
}

/// Angular frequency of the flow in rad/s.
const FREQUENCY: f64 = 3.0;
/// Size of the stream function in m^2/s.
const SIZE: f64 = 0.3;

impl ManufacturedFlow {
    fn profiles(&self) -> (Profile, Profile) {
        match self.kind {
            Kind::Closed => (sine_squared, sine_squared),
            Kind::MovingWall => (whole_wave, sine_squared),
            Kind::FreeSlip => (half_wave, half_wave),
            Kind::ThroughFlow => (ramp, half_wave),
        }
    }

    /// The parallel flow beneath in m/s, and its slope.
    fn base(&self, y: f64) -> [f64; 2] {
        match self.kind {
            Kind::MovingWall => [y, 1.0],
            Kind::ThroughFlow => [1.0, 0.0],
            Kind::Closed | Kind::FreeSlip => [0.0, 0.0],
        }
    }

    /// The pressure's shape in m^2/s^2, and its slopes.
    fn pressure_shape(&self, x: f64, y: f64) -> [f64; 3] {
        let (waves_x, waves_y) = match self.kind {
            Kind::MovingWall => (2.0 * PI, PI),
            Kind::ThroughFlow => (0.5 * PI, PI),
            Kind::Closed | Kind::FreeSlip => (PI, PI),
        };
        let ((sine_x, cosine_x), (sine_y, cosine_y)) = ((waves_x * x).sin_cos(), (waves_y * y).sin_cos());
        [cosine_x * cosine_y, -waves_x * sine_x * cosine_y, -waves_y * cosine_x * sine_y]
    }

    fn at(&self, place: &Vector3<f64>, time: f64) -> Local {
        let (x, y) = (place[self.plane[0]], place[self.plane[1]]);
        let (along, across) = self.profiles();
        let ([f, f1, f2, f3], [g, g1, g2, g3]) = (along(x), across(y));
        let ([base, shear], [shape, slope_x, slope_y]) = (self.base(y), self.pressure_shape(x, y));
        let (sine, cosine) = (FREQUENCY * time).sin_cos();
        let (size, rate) = (SIZE * cosine, -SIZE * FREQUENCY * sine);
        let pressure_size = 0.5 * (cosine + sine);
        let (u, v) = (base + size * f * g1, -size * f1 * g);
        let viscosity = self.viscosity;
        let force_x = rate * f * g1 + u * size * f1 * g1 + v * (shear + size * f * g2) + pressure_size * slope_x
            - viscosity * size * (f2 * g1 + f * g3);
        let force_y =
            -rate * f1 * g - u * size * f2 * g - v * size * f1 * g1 + pressure_size * slope_y + viscosity * size * (f3 * g + f1 * g2);
        Local { velocity: [u, v], pressure: pressure_size * shape, force: [force_x, force_y] }
    }

    fn component(&self, component: usize, values: [f64; 2]) -> f64 {
        self.plane.iter().position(|direction| *direction == component).map_or(0.0, |place| values[place])
    }

    /// A component of the velocity in m/s.
    pub fn velocity(&self, component: usize, place: &Vector3<f64>, time: f64) -> f64 {
        self.component(component, self.at(place, time).velocity)
    }

    /// In Pa; with an outlet, zero there.
    pub fn pressure(&self, place: &Vector3<f64>, time: f64) -> f64 {
        self.at(place, time).pressure
    }

    /// A component of the force density in N/m^3 that it needs.
    pub fn force(&self, component: usize, place: &Vector3<f64>, time: f64) -> f64 {
        self.component(component, self.at(place, time).force)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: [Kind; 4] = [Kind::Closed, Kind::MovingWall, Kind::FreeSlip, Kind::ThroughFlow];

    /// The equations by central differences of the printed fields: independent of the derivatives above.
    #[test]
    fn the_flows_solve_the_equations() {
        let (step, time) = (1e-4, 0.37);
        for (kind, plane) in KINDS.into_iter().zip([[0, 1], [1, 2], [2, 0], [0, 2]]) {
            let flow = ManufacturedFlow { kind, plane, viscosity: 0.03 };
            for place in [Vector3::new(0.21, 0.47, 0.68), Vector3::new(0.83, 0.12, 0.33)] {
                let shifted = |direction: usize, by: f64| place + Vector3::ith(direction, by);
                let slope = |component: usize, direction: usize| {
                    (flow.velocity(component, &shifted(direction, step), time) - flow.velocity(component, &shifted(direction, -step), time))
                        / (2.0 * step)
                };
                assert!((0..3).map(|direction| slope(direction, direction)).sum::<f64>().abs() < 1e-6, "{kind:?}");
                for component in 0..3 {
                    let here = flow.velocity(component, &place, time);
                    let rate =
                        (flow.velocity(component, &place, time + step) - flow.velocity(component, &place, time - step)) / (2.0 * step);
                    let carried: f64 = (0..3).map(|direction| flow.velocity(direction, &place, time) * slope(component, direction)).sum();
                    let pushed =
                        (flow.pressure(&shifted(component, step), time) - flow.pressure(&shifted(component, -step), time)) / (2.0 * step);
                    let curvature = |direction: usize| {
                        let [after, before] = [step, -step].map(|by| flow.velocity(component, &shifted(direction, by), time));
                        (after - 2.0 * here + before) / (step * step)
                    };
                    let diffused = 0.03 * (0..3).map(curvature).sum::<f64>();
                    let force = rate + carried + pushed - diffused;
                    assert!((force - flow.force(component, &place, time)).abs() < 1e-5, "{kind:?} {component}");
                }
            }
        }
    }
}
