//! The longest stable step, by bisection, over what theory says (S28).

use nalgebra::Complex;
use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::Vector;
use solver::fluid::grid::Grid;
use solver::fluid::navier_stokes::{Advection, Diffusion, Flow, Fluid, Numerics};
use solver::fluid::sides::Sides;

use super::{Error, Variant};
use crate::case::{Measurement, Quantity};
use crate::cases::pair_distance::poses::Random;
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::variant::Variant as _;

/// Which limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Limit {
    /// Explicit friction, with what steps advection.
    Friction(Advection),
    /// Advection by a uniform stream without friction.
    RungeKuttaCourant,
    /// Advection by a uniform stream with implicit friction.
    AdamsBashforthCourant,
}

pub(super) const ALL: [Limit; 5] = [
    Limit::Friction(Advection::Creeping),
    Limit::Friction(Advection::AdamsBashforth),
    Limit::Friction(Advection::RungeKutta),
    Limit::RungeKuttaCourant,
    Limit::AdamsBashforthCourant,
];

const RATIO: &str = "longest stable step / theory";
const CELLS: usize = 4;
const SPACING: f64 = 0.25;
/// Steps over which a disturbance must not grow.
pub(super) const STEPS: f64 = 200.0;
/// Velocity of the stream in m/s.
const STREAM: [f64; 3] = [0.9, 0.5, -0.7];
/// Kinematic viscosity in m^2/s of friction limits, and of the damped stream.
const VISCOSITY: f64 = 0.3;
const DAMPED: f64 = 0.02;
const DISTURBANCE: f64 = 1e-6;

impl Limit {
    pub(super) fn label(self) -> String {
        match self {
            Limit::Friction(Advection::Creeping) => "longest step: explicit friction, Euler".into(),
            Limit::Friction(Advection::AdamsBashforth) => "longest step: explicit friction, Adams-Bashforth".into(),
            Limit::Friction(Advection::RungeKutta) => "longest step: explicit friction, Runge-Kutta".into(),
            Limit::RungeKuttaCourant => "longest step: stream without friction, Runge-Kutta".into(),
            Limit::AdamsBashforthCourant => "longest step: stream with implicit friction, Adams-Bashforth".into(),
        }
    }

    fn flow(self) -> (Numerics, f64, Vector) {
        let explicit = |advection| Numerics { advection, diffusion: Diffusion::Explicit, ..Numerics::SOURCE };
        match self {
            Limit::Friction(advection) => (explicit(advection), VISCOSITY, Vector::zeros()),
            Limit::RungeKuttaCourant => (Numerics::default(), 0.0, Vector::from(STREAM)),
            Limit::AdamsBashforthCourant => (Numerics::SOURCE, DAMPED, Vector::from(STREAM)),
        }
    }

    /// The longest step in s by theory.
    fn theory(self) -> f64 {
        let friction = |limit: f64| limit * SPACING * SPACING / (12.0 * VISCOSITY);
        match self {
            // Where the amplification of a wave that friction damps reaches -1.
            Limit::Friction(Advection::Creeping) => friction(2.0),
            Limit::Friction(Advection::AdamsBashforth) => friction(1.0),
            Limit::Friction(Advection::RungeKutta) => friction(2.512_745_326_618_33),
            Limit::RungeKuttaCourant => 3_f64.sqrt() * SPACING / STREAM.iter().map(|speed| speed.abs()).sum::<f64>(),
            Limit::AdamsBashforthCourant => bisect(1e-3, 10.0, |step| largest_amplification(step) <= 1.0),
        }
    }

    pub(super) fn measure(self, steps: usize, random_seed: u64) -> Result<Measurement, Error> {
        let theory = self.theory();
        let mut failed = None;
        let limit = bisect(0.7 * theory, 1.4 * theory, |step| {
            self.is_stable(step, steps, random_seed).unwrap_or_else(|error| {
                failed = Some(error);
                false
            })
        });
        if let Some(error) = failed {
            return Err(error);
        }
        let ratio = Quantity {
            name: RATIO,
            unit: "1",
            samples: vec![limit / theory],
            expected: 1.0,
            reference: Reference { kind: ReferenceKind::Exact, uncertainty: 1e-9, source: "amplification of single waves".into() },
            error_kind: ErrorKind::Relative,
            floor: 2e-3,
        };
        Ok(Measurement {
            quantities: vec![ratio],
            work: [("steps watched".to_string(), steps as u64)].into(),
            runs: 1,
            ..Measurement::default()
        })
    }

    /// Whether a small random disturbance is not larger in the end than at first.
    fn is_stable(self, step: f64, steps: usize, random_seed: u64) -> Result<bool, Error> {
        let (numerics, viscosity, stream) = self.flow();
        let grid = Grid::new([CELLS; 3], SPACING, Vector::zeros())?;
        let mut flow = Flow::new(grid, Sides::PERIODIC, Fluid { density: 1.0, viscosity }, numerics)?;
        let mut random = Random::new(random_seed);
        let noise: Vec<f64> = (0..3 * grid.len()).map(|_| DISTURBANCE * (random.number() - 0.5)).collect();
        let place = |component: usize, at: Vector| {
            let cell = grid.in_cells(Some(component), &at).map(|number| number.round() as usize);
            component * grid.len() + grid.index(cell.into())
        };
        flow.set(|component, at| stream[component] + noise[place(component, at)], |_| 0.0);
        let before = disturbance(&flow, &stream);
        for _ in 0..steps {
            // A flow that is no longer finite was not stable.
            if flow.step(step, None).is_err() {
                return Ok(false);
            }
        }
        Ok(disturbance(&flow, &stream) <= before)
    }
}

/// Energy of what is not the stream, per mass and cell.
fn disturbance(flow: &Flow, stream: &Vector) -> f64 {
    let border = flow.border();
    (0..3)
        .map(|component| {
            border.evaluate(Some(component), |at| (flow.velocity()[component][at] - stream[component]).powi(2)).iter().sum::<f64>()
        })
        .sum()
}

/// The largest value up to which something holds, to one part in five hundred.
fn bisect(mut holds: f64, mut fails: f64, mut is_true: impl FnMut(f64) -> bool) -> f64 {
    while fails - holds > 2e-3 * holds {
        let middle = 0.5 * (holds + fails);
        if is_true(middle) {
            holds = middle;
        } else {
            fails = middle;
        }
    }
    holds
}

/// Largest amplification of all waves of the grid by Adams and Bashforth's advection and Crank and Nicolson's friction.
fn largest_amplification(step: f64) -> f64 {
    let angle = |number: usize| std::f64::consts::TAU * number as f64 / CELLS as f64;
    let mut largest = 0.0_f64;
    for number in 0..CELLS.pow(3) {
        let angles = [number % CELLS, number / CELLS % CELLS, number / CELLS / CELLS].map(angle);
        let turn = step / SPACING * angles.iter().zip(STREAM).map(|(angle, speed)| speed * angle.sin()).sum::<f64>();
        let half = 0.5 * step * DAMPED / (SPACING * SPACING) * angles.iter().map(|angle| 4.0 * (0.5 * angle).sin().powi(2)).sum::<f64>();
        // (1 + z) g^2 - (1 - z - 3/2 i a) g - 1/2 i a = 0
        let middle = Complex::new(1.0 - half, -1.5 * turn);
        let root = (middle * middle + Complex::new(0.0, 2.0 * turn * (1.0 + half))).sqrt();
        for sign in [1.0, -1.0] {
            largest = largest.max(((middle + root * sign) / (2.0 * (1.0 + half))).norm());
        }
    }
    // Waves that the stream does not carry and friction does not damp stay as they are, but for rounding.
    if largest < 1.0 + 1e-12 { 1.0 } else { largest }
}

pub(super) fn claims_at(variant: &Variant, knob: f64) -> Vec<Claim> {
    let hidden = 0.5 * ((CELLS.pow(3) * 2) as f64).ln() / knob;
    let bound = Bound::new(
        4.0,
        hidden,
        "logarithm of the share in which a growing wave may hide, over the steps watched; it grows by a quarter of the excess or more",
    );
    vec![variant.claim_at(knob, RATIO, Statistic::Single, bound, Expected::Holds)]
}
