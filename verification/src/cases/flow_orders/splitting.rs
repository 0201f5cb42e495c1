//! What it costs, and gains, to find velocity and pressure together at walls.

use std::sync::OnceLock;

use reports::row::ReferenceKind;
use solver::fluid::navier_stokes::{Advection, Flow, Numerics};
use solver::fluid::projection::Coupling;

use super::manufactured::{END_TIME, VISCOSITY, start};
use super::{Error, VELOCITY, Variant, error, measurement, run};
use crate::case::Measurement;
use crate::claim::{Bound, Claim, Expected, Statistic};
use crate::exact::manufactured_flow::{Kind, ManufacturedFlow};
use crate::variant::Variant as _;

/// A setup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Splitting {
    name: &'static str,
    numerics: Numerics,
}

const EXACT: Coupling = Coupling::Exact { tolerance: 1e-6 };

pub(super) const ALL: [Splitting; 4] = [
    Splitting {
        name: "Runge-Kutta, one projection (default)",
        numerics: Numerics { advection: Advection::RungeKutta, ..Numerics::SOURCE },
    },
    Splitting {
        name: "Runge-Kutta, no splitting",
        numerics: Numerics { advection: Advection::RungeKutta, coupling: EXACT, ..Numerics::SOURCE },
    },
    Splitting { name: "scheme of R", numerics: Numerics::SOURCE },
    Splitting { name: "scheme of R without splitting", numerics: Numerics { coupling: EXACT, ..Numerics::SOURCE } },
];

const FLOW: ManufacturedFlow = ManufacturedFlow { kind: Kind::Closed, plane: [0, 1], viscosity: VISCOSITY };
const CELLS: usize = 12;
const FINE_STEPS: usize = 256;

/// The same grid with steps so short that they do not matter, and how far they still do.
struct Reference {
    flow: Flow,
    uncertainty: f64,
}

fn evolve(numerics: Numerics, steps: usize) -> Result<Flow, Error> {
    let mut flow = start(&FLOW, CELLS, numerics)?;
    run(&mut flow, END_TIME, steps, Some(&|component, place, time| FLOW.force(component, &place, time)))?;
    Ok(flow)
}

/// Root mean square of the difference of two velocities over that of the second.
fn apart(one: &Flow, other: &Flow) -> f64 {
    let (mut missed, mut size) = (0.0, 0.0);
    for (one, other) in one.velocity().iter().zip(other.velocity()) {
        missed += one.iter().zip(other).map(|(one, other)| (one - other).powi(2)).sum::<f64>();
        size += other.iter().map(|value| value * value).sum::<f64>();
    }
    (missed / size).sqrt()
}

fn reference() -> Result<&'static Reference, Error> {
    static REFERENCE: OnceLock<Option<Reference>> = OnceLock::new();
    let find = || {
        let numerics = Numerics::default();
        let (half, flow) = (evolve(numerics, FINE_STEPS / 2).ok()?, evolve(numerics, FINE_STEPS).ok()?);
        let uncertainty = apart(&half, &flow) / 3.0;
        Some(Reference { flow, uncertainty })
    };
    REFERENCE.get_or_init(find).as_ref().ok_or_else(|| "the reference run failed".into())
}

impl Splitting {
    pub(super) fn label(self) -> String {
        format!("error in time at walls, {}", self.name)
    }

    pub(super) fn measure(self, steps: usize) -> Result<Measurement, Error> {
        let reference = reference()?;
        let flow = evolve(self.numerics, steps)?;
        let quantity = error(
            VELOCITY,
            vec![apart(&flow, &reference.flow)],
            reference.uncertainty,
            ReferenceKind::OwnFine,
            "256 steps of the default on the same grid; a third of the difference to 128",
        );
        Ok(measurement(vec![quantity], &flow, steps))
    }

    /// All schemes are of second order: the angle that the flow turns in a step, squared.
    pub(super) fn claims_at(self, variant: &Variant, knob: f64) -> Vec<Claim> {
        let angle = 3.0 * END_TIME / knob;
        let bound =
            Bound::new(2.0, angle * angle / 2.0, "(angle of the oscillation in a step)^2 / 2, of an extrapolation over half a step");
        vec![variant.claim_at(knob, VELOCITY, Statistic::Single, bound, Expected::Holds)]
    }
}
