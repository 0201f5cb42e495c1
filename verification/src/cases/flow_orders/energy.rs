//! Energy: advection makes none, time steps lose little, and no Reynolds number adds any.

use reports::row::ReferenceKind;
use solver::Vector;
use solver::fluid::grid::Grid;
use solver::fluid::navier_stokes::{Flow, Fluid, Numerics};
use solver::fluid::sides::{Ends, Side, Sides};
use solver::fluid::stencils;

use super::{Error, Variant, divergence, error, measurement, no_divergence, run};
use crate::case::Measurement;
use crate::cases::pair_distance::poses::Random;
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::variant::Variant as _;

const MADE: &str = "energy that advection makes / exchanges";
pub(super) const LOST: &str = "energy lost / energy";
const GAINED: &str = "energy gained / energy";
const CHECKERBOARD: &str = "checkerboard in the pressure / pressure";

/// A setup.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Energy {
    /// Power of advection in random flows in a box that repeats.
    Periodic,
    /// The same between walls, one of which moves.
    Walls,
    /// Vortices in space without friction.
    Drift,
}

pub(super) const ALL: [Energy; 3] = [Energy::Periodic, Energy::Walls, Energy::Drift];

/// Random flows at each seed.
const FLOWS: usize = 5;

fn vortices(cells: usize, viscosity: f64) -> Result<Flow, Error> {
    let grid = Grid::new([cells; 3], 2.0 * std::f64::consts::PI / cells as f64, Vector::zeros())?;
    let mut flow = Flow::new(grid, Sides::PERIODIC, Fluid { density: 1.0, viscosity }, Numerics::default())?;
    let velocity = |component: usize, place: Vector| match component {
        0 => place.x.sin() * place.y.cos() * place.z.cos(),
        1 => -place.x.cos() * place.y.sin() * place.z.cos(),
        _ => 0.0,
    };
    flow.set(velocity, |_| 0.0);
    Ok(flow)
}

impl Energy {
    pub(super) fn label(self) -> String {
        match self {
            Energy::Periodic => "power of advection, box that repeats".into(),
            Energy::Walls => "power of advection, between walls".into(),
            Energy::Drift => "vortices in space without friction".into(),
        }
    }

    pub(super) fn measure(self, knob: usize, random_seed: u64) -> Result<Measurement, Error> {
        match self {
            Energy::Periodic => power(Sides::PERIODIC, knob, random_seed),
            Energy::Walls => {
                let wall = Ends::Sides([Side::REST, Side::Wall { velocity: Vector::y() }]);
                power(Sides::new([wall, Ends::Sides([Side::REST; 2]), Ends::Sides([Side::FreeSlip, Side::REST])])?, knob, random_seed)
            }
            Energy::Drift => drift(knob),
        }
    }

    pub(super) fn claims_at(self, variant: &Variant, knob: f64) -> Vec<Claim> {
        let (quantity, statistic, bound) = match self {
            Energy::Drift => {
                // What turns by an angle in a step loses the fourth power of it over 12; vortices of speed and wave number 1 turn at about a half.
                let angle = 0.5 * 2.0 / knob;
                (
                    LOST,
                    Statistic::Single,
                    Bound::new(1.0, knob * angle.powi(4) / 12.0, "steps x (angle that vortices turn in a step)^4 / 12"),
                )
            }
            _ => (MADE, Statistic::Worst, Bound::new(4.0, f64::EPSILON * (knob.powi(3) * 3.0).sqrt(), "rounding of a sum over all faces")),
        };
        vec![variant.claim_at(knob, quantity, statistic, bound, Expected::Holds)]
    }
}

/// Work of advection over the sum of its magnitudes, in random flows without divergence.
fn power(sides: Sides, cells: usize, random_seed: u64) -> Result<Measurement, Error> {
    let mut random = Random::new(random_seed);
    let mut flow = Flow::new(
        Grid::new([cells, cells + 1, cells + 3], 0.1, Vector::zeros())?,
        sides,
        Fluid { density: 1.0, viscosity: 0.0 },
        Numerics::default(),
    )?;
    let mut samples = Vec::new();
    for _ in 0..FLOWS {
        let waves: Vec<Vector> = (0..6).map(|_| random.direction() * 20.0).collect();
        flow.set(
            |component, place| {
                waves.iter().enumerate().map(|(wave, direction)| (direction.dot(&place) + (wave * component) as f64).sin()).sum()
            },
            |_| 0.0,
        );
        let border = flow.border();
        let (mut work, mut exchanged) = (0.0, 0.0);
        for component in 0..3 {
            let carried = stencils::advection(border, flow.velocity(), component);
            let speeds = border.evaluate(Some(component), |at| flow.velocity()[component][at]);
            let products = || carried.iter().zip(&speeds).map(|(carried, speed)| carried * speed);
            work += products().sum::<f64>();
            exchanged += products().map(f64::abs).sum::<f64>();
        }
        samples.push(work / exchanged);
    }
    let floor = f64::EPSILON * (flow.border().grid().len() as f64 * 3.0).sqrt();
    Ok(measurement(vec![error(MADE, samples, floor, ReferenceKind::Exact, "conservation of energy"), divergence(&flow)], &flow, 0))
}

fn drift(steps: usize) -> Result<Measurement, Error> {
    let mut flow = vortices(8, 0.0)?;
    let before = flow.kinetic_energy();
    run(&mut flow, 2.0, steps, None)?;
    let lost = 1.0 - flow.kinetic_energy() / before;
    let floor = f64::EPSILON * steps as f64;
    Ok(measurement(vec![error(LOST, vec![lost], floor, ReferenceKind::Exact, "conservation of energy"), divergence(&flow)], &flow, steps))
}

/// Vortices at a Reynolds number (of wave length over $2 \pi$): bounded, without waves of two cells.
pub(super) fn measure_reynolds(reynolds: f64) -> Result<Measurement, Error> {
    let mut flow = vortices(12, 1.0 / reynolds)?;
    let before = flow.kinetic_energy();
    let mut most = before;
    let steps = 30;
    for _ in 0..steps {
        flow.step(0.1, None)?;
        most = most.max(flow.kinetic_energy());
    }
    let border = flow.border();
    let sign = |at: usize| if border.cell(at).iter().sum::<usize>().is_multiple_of(2) { 1.0 } else { -1.0 };
    let board: f64 = border.evaluate(None, |at| sign(at) * flow.pressure()[at]).iter().sum();
    let size: f64 = border.evaluate(None, |at| flow.pressure()[at].abs()).iter().sum();
    let floor = f64::EPSILON * steps as f64;
    let exact =
        |name, value| error(name, vec![value], floor, ReferenceKind::Exact, "friction takes energy; symmetry forbids waves of two cells");
    let quantities = vec![exact(GAINED, most / before - 1.0), exact(CHECKERBOARD, board / size), divergence(&flow)];
    Ok(measurement(quantities, &flow, steps))
}

pub(super) fn reynolds_claims_at(variant: &Variant, knob: f64) -> Vec<Claim> {
    let rounding = |floor| Bound::new(10.0, floor, "rounding of thirty steps");
    let mut claims = vec![variant.claim_at(knob, GAINED, Statistic::Single, rounding(30.0 * f64::EPSILON), Expected::Holds)];
    // What is left of a flow that has crept to rest is rounding.
    if knob >= 1.0 {
        claims.push(variant.claim_at(knob, CHECKERBOARD, Statistic::Single, Bound::new(1.0, 1e-6, "S29"), Expected::Holds));
        claims.push(no_divergence(variant, knob));
    }
    claims
}
