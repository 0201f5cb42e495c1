//! Velocity and pressure of one implicit viscous step, found together: $u - \beta \nabla^2 u + \tau \nabla p / \rho = r$, $\nabla \cdot u = 0$.

use super::border::Border;
use super::helmholtz::Helmholtz;
use super::operators::dot;
use super::stencils::{Velocity, divergence, gradient};

/// How the two are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Coupling {
    /// One predictor with the old pressure and one projection (R eq. 7.9-7.11, corrected). Exact where the box repeats or slips; at walls the fluid slips
    /// by an error of second order in the time step.
    Projected,
    /// The pressure is corrected until the slip along walls is a tolerance of what one projection leaves: conjugate gradients, with the projection as the guess.
    Exact {
        /// Divergence of the predicted velocity, relative to that of the first predictor.
        tolerance: f64,
    },
}

/// The operators of one implicit step.
#[derive(Debug, Clone)]
pub struct Projection {
    border: Border,
    velocity: [Helmholtz; 3],
    pressure: Helmholtz,
    /// Divergences solved for: projections, and corrections of the pressure.
    pub solves: u64,
}

/// Factors of one implicit step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Factors {
    /// Duration in s that the new pressure acts for.
    pub duration: f64,
    /// Viscosity times the implicit part of the duration in m^2.
    pub beta: f64,
    /// In kg/m^3.
    pub density: f64,
}

/// Most corrections of the pressure in one step.
const MOST_CORRECTIONS: usize = 200;

impl Projection {
    /// Operators of a box.
    pub fn new(border: Border) -> Projection {
        Projection {
            border,
            velocity: std::array::from_fn(|component| Helmholtz::new(&border, Some(component))),
            pressure: Helmholtz::new(&border, None),
            solves: 0,
        }
    }

    /// Advances a velocity by right sides in m/s that hold the gradient of the old pressure, and the pressure with it.
    pub fn advance(&mut self, velocity: &mut Velocity, pressure: &mut [f64], right: [Vec<f64>; 3], factors: Factors, coupling: Coupling) {
        for (component, mut increment) in right.into_iter().enumerate() {
            self.diffuse(component, &mut increment, factors.beta);
            self.border.add(Some(component), &mut velocity[component], 1.0, &increment);
        }
        let mut surplus = divergence(&self.border, velocity);
        if let Coupling::Exact { tolerance } = coupling {
            self.correct(velocity, pressure, &mut surplus, factors, tolerance);
        }
        let potential = self.potential(&surplus, factors.duration);
        self.subtract_gradient(velocity, &potential, factors.duration);
        self.border.add(None, pressure, factors.density, &pressure_of(&potential, &surplus, factors));
    }

    /// Takes the divergence of a velocity away.
    pub fn project(&mut self, velocity: &mut Velocity) {
        let surplus = divergence(&self.border, velocity);
        let potential = self.potential(&surplus, 1.0);
        self.subtract_gradient(velocity, &potential, 1.0);
    }

    /// Solves for one component what diffusion leaves of an increment.
    fn diffuse(&self, component: usize, increment: &mut [f64], beta: f64) {
        if beta > 0.0 {
            self.velocity[component].solve(increment, 1.0, beta);
        }
    }

    /// The potential in m^2/s^2 whose gradient over a duration takes a divergence away (R eq. 7.10).
    fn potential(&mut self, surplus: &[f64], duration: f64) -> Vec<f64> {
        self.solves += 1;
        let mut potential: Vec<f64> = surplus.iter().map(|surplus| surplus / duration).collect();
        self.pressure.solve(&mut potential, 0.0, -1.0);
        potential
    }

    fn subtract_gradient(&self, velocity: &mut Velocity, potential: &[f64], duration: f64) {
        let bordered = self.bordered(potential);
        for (component, velocity) in velocity.iter_mut().enumerate() {
            self.border.add(Some(component), velocity, -duration, &gradient(&self.border, &bordered, component));
        }
    }

    fn bordered(&self, values: &[f64]) -> Vec<f64> {
        let mut field = self.border.zeros();
        self.border.add(None, &mut field, 1.0, values);
        field
    }

    /// Corrects the pressure until the predicted velocity itself has no divergence: preconditioned conjugate gradients on the divergence of what a pressure
    /// does to the predictor (Cahouet and Chabard 1988).
    fn correct(&mut self, velocity: &mut Velocity, pressure: &mut [f64], surplus: &mut [f64], factors: Factors, tolerance: f64) {
        let wanted = tolerance * norm(surplus);
        let (mut direction, mut last) = (Vec::new(), 0.0);
        for _ in 0..MOST_CORRECTIONS {
            if norm(surplus) <= wanted {
                return;
            }
            let potential = self.potential(surplus, factors.duration);
            let guess = pressure_of(&potential, surplus, factors);
            let product = dot(&guess, surplus);
            if direction.is_empty() {
                direction = guess;
            } else {
                direction.iter_mut().zip(&guess).for_each(|(along, guess)| *along = guess + product / last * *along);
            }
            last = product;
            let response = self.response(&direction, factors);
            let spread = divergence(&self.border, &response);
            let length = product / dot(&direction, &spread);
            for component in 0..3 {
                let response = self.border.evaluate(Some(component), |at| response[component][at]);
                self.border.add(Some(component), &mut velocity[component], -length, &response);
            }
            self.border.add(None, pressure, length * factors.density, &direction);
            surplus.iter_mut().zip(&spread).for_each(|(surplus, spread)| *surplus -= length * spread);
        }
    }

    /// What a pressure over density in m^2/s^2 does to the predictor, up to its sign: the diffused gradient, with zero on sides.
    fn response(&self, pressure: &[f64], factors: Factors) -> Velocity {
        let bordered = self.bordered(pressure);
        std::array::from_fn(|component| {
            let mut slopes = gradient(&self.border, &bordered, component);
            slopes.iter_mut().for_each(|slope| *slope *= factors.duration);
            self.diffuse(component, &mut slopes, factors.beta);
            let mut field = self.border.zeros();
            self.border.homogeneous().add(Some(component), &mut field, 1.0, &slopes);
            field
        })
    }
}

/// The pressure over density in m^2/s^2 that would have spared the predictor a divergence: the potential, less its own diffusion (R eq. 7.11).
fn pressure_of(potential: &[f64], surplus: &[f64], factors: Factors) -> Vec<f64> {
    let diffused = factors.beta / factors.duration;
    potential.iter().zip(surplus).map(|(potential, surplus)| potential - diffused * surplus).collect()
}

fn norm(values: &[f64]) -> f64 {
    dot(values, values).sqrt()
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::Vector;
    use crate::fluid::grid::Grid;
    use crate::fluid::sides::{Ends, Side, Sides};
    use crate::fluid::stencils::laplacian;

    const FACTORS: Factors = Factors { duration: 0.2, beta: 0.07, density: 1.7 };

    /// What a residual of 1e-13 leaves in a system whose condition number is some hundreds.
    const TOLERANCE: f64 = 1e-10;

    fn boxes() -> Vec<Border> {
        let wall = Ends::Sides([Side::REST; 2]);
        let lid = Ends::Sides([Side::FreeSlip, Side::Wall { velocity: Vector::new(0.5, 0.0, -0.3) }]);
        let through = Ends::Sides([Side::Inlet { velocity: Vector::new(0.8, 0.1, 0.0) }, Side::Outlet]);
        let of = |cells, ends| Border::new(Grid::new(cells, 0.3, Vector::zeros()).unwrap(), Sides::new(ends).unwrap());
        vec![of([4, 5, 4], [wall; 3]), of([5, 4, 4], [wall, lid, Ends::Periodic]), of([6, 4, 4], [through, wall, Ends::Periodic])]
    }

    fn noise(length: usize, seed: usize) -> Vec<f64> {
        (0..length).map(|place| (((place + 3 * seed) * (place + 7)) as f64 * 0.7).sin()).collect()
    }

    /// A velocity without divergence, and a right side.
    fn start(border: &Border) -> (Velocity, Vec<f64>, [Vec<f64>; 3]) {
        let lengths: [usize; 3] =
            std::array::from_fn(|component| border.unknowns(Some(component)).map(|range| range.len()).iter().product());
        let mut velocity: Velocity = std::array::from_fn(|component| {
            let mut field = border.zeros();
            border.add(Some(component), &mut field, 1.0, &noise(lengths[component], component));
            field
        });
        Projection::new(*border).project(&mut velocity);
        let mut pressure = border.zeros();
        border.add(None, &mut pressure, 1.0, &noise(border.grid().len(), 4));
        (velocity, pressure, std::array::from_fn(|component| noise(lengths[component], component + 5)))
    }

    /// The whole linear system as a dense matrix: increments of velocities, then of pressure over density.
    fn solve_densely(border: &Border, right: &[Vec<f64>; 3]) -> Vec<f64> {
        let homogeneous = border.homogeneous();
        let velocities: usize = right.iter().map(Vec::len).sum();
        let size = velocities + border.grid().len();
        let apply = |unknowns: &[f64]| {
            let (mut rest, mut fields) = (unknowns, Vec::new());
            for (component, right) in right.iter().enumerate() {
                let (mine, others) = rest.split_at(right.len());
                let mut field = border.zeros();
                homogeneous.add(Some(component), &mut field, 1.0, mine);
                fields.push(field);
                rest = others;
            }
            let velocity: Velocity = fields.try_into().unwrap();
            let mut pressure = border.zeros();
            border.add(None, &mut pressure, 1.0, rest);
            let mut out = Vec::with_capacity(size);
            for (component, values) in velocity.iter().enumerate() {
                let (diffused, slopes) = (laplacian(border, component, values), gradient(border, &pressure, component));
                let own = border.evaluate(Some(component), |at| values[at]);
                out.extend((0..own.len()).map(|i| own[i] - FACTORS.beta * diffused[i] + FACTORS.duration * slopes[i]));
            }
            out.extend(divergence(border, &velocity));
            out
        };
        let mut matrix = DMatrix::zeros(size, size);
        for column in 0..size {
            let mut unit = vec![0.0; size];
            unit[column] = 1.0;
            matrix.set_column(column, &DVector::from_vec(apply(&unit)));
        }
        let right = right.iter().flatten().copied().chain(std::iter::repeat_n(0.0, border.grid().len()));
        // The least squares of smallest norm: the mean of the pressure is free without an outlet.
        matrix.svd(true, true).solve(&DVector::from_iterator(size, right), 1e-11).unwrap().as_slice().to_vec()
    }

    #[test]
    fn exact_coupling_is_the_solution_of_the_whole_dense_system() {
        for border in boxes() {
            let (mut velocity, mut pressure, right) = start(&border);
            let before = (velocity.clone(), pressure.clone());
            let wanted = solve_densely(&border, &right);
            Projection::new(border).advance(&mut velocity, &mut pressure, right.clone(), FACTORS, Coupling::Exact { tolerance: 1e-13 });
            let mut wanted = wanted.into_iter();
            for (component, (after, before)) in velocity.iter().zip(&before.0).enumerate() {
                let got = border.evaluate(Some(component), |at| after[at] - before[at]);
                assert!(got.iter().all(|got| (got - wanted.next().unwrap()).abs() < TOLERANCE), "{:?}", border.sides());
            }
            let got = border.evaluate(None, |at| (pressure[at] - before.1[at]) / FACTORS.density);
            let wanted: Vec<f64> = wanted.collect();
            let shift = got.iter().zip(&wanted).map(|(got, wanted)| got - wanted).sum::<f64>() / got.len() as f64;
            assert!(got.iter().zip(&wanted).all(|(got, wanted)| (got - wanted - shift).abs() < 10.0 * TOLERANCE), "{:?}", border.sides());
        }
    }

    #[test]
    fn one_projection_is_exact_where_nothing_sticks_and_splits_where_it_does() {
        let slip = Ends::Sides([Side::FreeSlip; 2]);
        for (ends, exact) in
            [([Ends::Periodic; 3], true), ([slip, Ends::Periodic, slip], true), ([slip, Ends::Sides([Side::REST; 2]), slip], false)]
        {
            let border = Border::new(Grid::new([6, 5, 4], 0.3, Vector::zeros()).unwrap(), Sides::new(ends).unwrap());
            let (velocity, pressure, right) = start(&border);
            let advance = |coupling| {
                let (mut velocity, mut pressure) = (velocity.clone(), pressure.clone());
                Projection::new(border).advance(&mut velocity, &mut pressure, right.clone(), FACTORS, coupling);
                assert!(norm(&divergence(&border, &velocity)) < 1e-13 * velocity.iter().map(|values| norm(values)).sum::<f64>() / 0.3);
                (velocity, pressure)
            };
            let (one, other) = (advance(Coupling::Projected), advance(Coupling::Exact { tolerance: 1e-13 }));
            let apart =
                |one: &[f64], other: &[f64]| one.iter().zip(other).fold(0.0, |most: f64, (one, other)| most.max((one - other).abs()));
            let velocities = (0..3).map(|component| apart(&one.0[component], &other.0[component])).fold(0.0, f64::max);
            assert_eq!(velocities < 1e-13 && apart(&one.1, &other.1) < 1e-12, exact, "{ends:?}: {velocities:e}");
            assert!(exact || velocities > 1e-3);
        }
    }
}
