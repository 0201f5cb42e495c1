//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{ON_GRID, PRESSURE, VELOCITY, Variant, energy, lid};
use crate::case::Description;
use crate::claim::Statistic;
use crate::variant::Variant as _;

pub(super) fn description() -> Description {
    let vortices = Variant::labels(|variant| matches!(variant, Variant::Vortex(_)));
    Description {
        id: "flow_orders",
        title: "Orders of the flow solver",
        question: "Do velocity and pressure converge with the order of their differences at every kind of side, and is the flow stable where theory says?",
        model: vec![
            "The Navier-Stokes equations on a staggered grid: pressures in the middles of cells, velocities on their faces, central differences and fluxes. Values beyond walls are reflected. Every implicit operator is a product of waves along the three directions (Fourier's, sines, cosines), so that it is inverted without any error but rounding.",
            "Source R steps in time by Adams and Bashforth (advection), Crank and Nicolson (friction), and one projection with the old pressure in the predictor. The default takes three Runge-Kutta stages instead of Adams and Bashforth's two rates. A third way iterates the pressure until the predictor itself has no divergence: no splitting is left.",
            "Flows with a known solution: vortices of Taylor and Green, whose decay is known on the grid too; flows made with a force for walls at rest, a moving wall, free slip, and an inlet with an outlet; Couette's and Poiseuille's. At longer tiers a cube with a moving lid against published profiles. Limits of stability are found by bisection.",
        ],
        equations: vec![
            Equation {
                latex: r"\rho\,\bigl(\partial_t u + \nabla\cdot(u u)\bigr) = -\nabla p + \mu\nabla^2 u + f,\qquad \nabla\cdot u = 0".into(),
                meaning: "Momentum and mass (R eq. 7.1 and 7.5).".into(),
            },
            Equation {
                latex: r"\frac{\tilde u - u^n}{\Delta t} = -\frac{\nabla p^n}{\rho} + \frac{\nu}{2}\nabla^2(\tilde u + u^n) - \tfrac32 N^n + \tfrac12 N^{n-1}".into(),
                meaning: "Predictor (R eq. 7.9, which prints the new pressure, and the projected velocity under the Laplacian: errata).".into(),
            },
            Equation {
                latex: r"\nabla^2\psi = \frac{\nabla\cdot\tilde u}{\Delta t},\quad u^{n+1} = \tilde u - \Delta t\nabla\psi,\quad \frac{p^{n+1}}{\rho} = \frac{p^n}{\rho} + \psi - \frac{\nu\Delta t}{2}\nabla^2\psi".into(),
                meaning: "Projection (R eq. 7.10 and 7.11). The pressure so found lives in the middle of the step.".into(),
            },
        ],
        parameters: [
            ("vortices", "viscosity 0.05 m²/s, until 2 s", "four cells across"),
            ("manufactured flows", "viscosity 0.02 m²/s, until 0.5 s, as many steps as cells", "in planes of all pairs of directions, four cells across"),
            ("Couette, Poiseuille", "viscosity 1 m²/s, forty relaxation times", ""),
            ("lid", "Reynolds number 1000, steps at a Courant number of 0.8", "standard tier and longer"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Closed forms, on paper and on the grid; force fields made for given flows, held against differences of those; for the lid a spectral computation to five digits.",
        picture: picture(),
        plots: plots(&vortices),
        headline: Headline {
            setup: vortices[0].clone(),
            quantity: VELOCITY.into(),
            statistic: Statistic::Single.name().into(),
            knob: 32.0,
            order_quantity: Some(format!("observed order of {VELOCITY}")),
        },
        sources: vec![
            "R (Rakotonirina 2016), section 7.3, eq. 7.1, 7.5, 7.9-7.11",
            "F. H. Harlow and J. E. Welch, Phys. Fluids 8 (1965) 2182",
            "Y. Morinishi et al., J. Comput. Phys. 143 (1998) 90: conservation by central fluxes",
            "P. R. Spalart, R. D. Moser and M. M. Rogers, J. Comput. Phys. 96 (1991) 297: the stages",
            "S. Albensoeder and H. C. Kuhlmann, J. Comput. Phys. 206 (2005) 536: the cube",
        ],
        answers: vec![
            "Stability tests S28 (limits of steps) and S29 (Reynolds numbers from creeping to 10⁴).",
            "Errata of R: eq. 7.9 as printed takes what is not known yet; with the old pressure and the predictor, 7.11 follows exactly.",
        ],
        remarks: vec![
            "Where the box repeats or slips, one projection is not a splitting at all: all operators commute, and the velocity is that of the coupled step to rounding. At walls it leaves an error of second order in the step.",
            "Iterating the pressure until no splitting is left makes steps at walls about twice as accurate, at four to six times the cost: shorter steps with one projection are better. It is kept to tell the error of splitting, not as the default.",
            "Two rates after Adams and Bashforth bear no advection for ever without friction. The default does, up to a Courant number of 1.73.",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "run",
        budget_cpu_s: [5.0, 1200.0, 7200.0],
    }
}

fn plots(vortices: &[String]) -> Vec<Plot> {
    let manufactured = Variant::labels(|variant| matches!(variant, Variant::Manufactured(_)));
    let splitting = Variant::labels(|variant| matches!(variant, Variant::Splitting(_)));
    let drift = Variant::labels(|variant| *variant == Variant::Energy(energy::Energy::Drift));
    let lid = Variant::labels(|variant| *variant == Variant::Lid);
    let single = || Statistic::Single.name().to_string();
    let against = |title: &str, quantity: &str, setups: &[String], orders: &[f64], knob_label: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: setups.to_vec(),
        statistics: vec![single()],
        orders: orders.to_vec(),
        knob_is_resolution: true,
        knob_label: knob_label.into(),
    };
    let cost = |title: &str, quantity: &str, setups: &[String], targets: &[f64]| Plot::ErrorAgainstCost {
        title: title.into(),
        quantity: quantity.into(),
        setups: setups.to_vec(),
        statistic: single(),
        targets: targets.to_vec(),
    };
    let cells = "cells along an edge";
    vec![
        against("Vortices: velocity", VELOCITY, vortices, &[2.0], cells),
        against("Vortices: pressure", PRESSURE, vortices, &[2.0], cells),
        against("Vortices: velocity against the decay on the grid", ON_GRID, vortices, &[], cells),
        against("Every kind of side: velocity", VELOCITY, &manufactured, &[2.0], cells),
        against("Every kind of side: pressure", PRESSURE, &manufactured, &[2.0], cells),
        against("Error in time at walls, with and without splitting", VELOCITY, &splitting, &[2.0], "steps"),
        against("Vortices without friction: energy lost", energy::LOST, &drift, &[3.0], "steps"),
        against("Cube with a moving lid: both profiles", lid::PROFILES, &lid, &[2.0], cells),
        cost("Every kind of side: velocity against run time", VELOCITY, &manufactured, &[0.1, 0.01, 0.001]),
        cost("Error in time at walls against run time", VELOCITY, &splitting, &[0.01, 0.001, 0.0001]),
    ]
}

/// A cell with the places of its pressure and velocities, at a wall.
fn picture() -> Picture {
    let square = |x: f64, ghost| PictureItem::Polygon { points: vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]], ghost };
    let arrow = |from: [f64; 2], to: [f64; 2], label: &str| PictureItem::Arrow { from, to, label: label.into() };
    let items = vec![
        square(0.0, false),
        square(-1.1, true),
        PictureItem::Wall { from: [-0.05, -0.3], to: [-0.05, 1.3], solid_side: [-1.0, 0.0] },
        PictureItem::Disc { center: [0.5, 0.5], radius: 0.06, ghost: false },
        PictureItem::Label { at: [0.62, 0.62], text: "p".into() },
        arrow([0.85, 0.5], [1.25, 0.5], "u"),
        arrow([0.5, -0.2], [0.5, 0.2], "v"),
        arrow([-0.6, 0.2], [-0.6, -0.2], "-v"),
    ];
    Picture { caption: "A cell at a wall at rest: the pressure in its middle, velocities on its faces. Beyond the wall the velocity along it is reflected with its sign turned.".into(), items }
}
