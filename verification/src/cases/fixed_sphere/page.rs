//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{DRAG, FRICTION, FULL_SLIP, SLICE, Variant};
use crate::case::Description;
use crate::claim::Statistic;
use crate::variant::Variant as _;

/// The run whose slice is shown.
pub(super) fn seen() -> Variant {
    Variant::Stream { reynolds: 20.0, across: 4.0 }
}

/// Its cells a diameter.
pub(super) const SEEN_CELLS: f64 = 8.0;

pub(super) fn description() -> Description {
    Description {
        id: "fixed_sphere",
        title: "A sphere held in a stream",
        question: "Does the drag of a sphere that is held in a stream come out at Reynolds numbers of 1 to 150, and what share of its error is the grid's and what the box's?",
        model: vec![
            "The Navier-Stokes equations on a staggered grid with a rigid sphere. Friction and constraint are implicit (differences backwards over two steps), advection is extrapolated from two steps: of second order in time. Each step is solved exactly for a velocity without divergence that meets the conditions at the surface at the same time; R splits it in two halves that undo each other.",
            "The box repeats. A fringe in its last quarter pulls the flow back to the uniform stream, so that what leaves on one side does not come in at the other. Across, the sphere has its images for neighbours: what the wake drives aside speeds up the rest. The share of the box falls with its section and is found by three boxes.",
            "An array in creeping flow, marched to its steady state by the same steps, is held against the independent table of friction factors.",
        ],
        equations: vec![
            Equation {
                latex: r"\rho\,\bigl(\partial_t u + \nabla\cdot(u u)\bigr) = -\nabla p + \mu\nabla^2 u + E\lambda,\qquad \nabla\cdot u = 0,\qquad J u = u_{body}".into(),
                meaning: "Momentum, mass, and the rigid motion (R eq. 7.1, 7.4 and 7.5).".into(),
            },
            Equation {
                latex: r"\rho\,\frac{3u^{n+1} - 4u^n + u^{n-1}}{2\Delta t} - \mu\nabla^2u^{n+1} + \nabla p - E\lambda = -\rho\,(2N^n - N^{n-1})".into(),
                meaning: "A step. Its flow without bodies is inverted exactly, so that the forces are all that is iterated for.".into(),
            },
            Equation {
                latex: r"C_d = \frac{F}{\tfrac12\rho U^2\,\tfrac{\pi}{4}D^2}".into(),
                meaning: "Drag coefficient; the force is that of the constraint, which in a steady flow is all of it.".into(),
            },
        ],
        parameters: [
            ("box", "4, 6, 9 diameters across, half as long again", "sphere at three tenths of its length"),
            ("fringe", "last quarter, at most 12 speeds over its length", "what comes out is uniform to exp(-6)"),
            ("step", "half a spacing over the speed", ""),
            ("end", "change of the drag below 3e-4 in the passage of a diameter", "two to sixty passages"),
            ("slip at which a step's iteration stops", "1e-3 of the speed", "two to four flows a step"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Independent steady axisymmetric computation to 67 radii (0.001 to 0.005; 0.1 at Reynolds number 1); at 100 and 150 an own program of the same kind, in reference-data/sphere_drag_fixed. Array: independent fundamental solutions, 2e-6.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: Variant::Array.label(),
            quantity: FRICTION.into(),
            statistic: Statistic::Single.name().into(),
            knob: 12.0,
            order_quantity: Some(format!("observed order of {FRICTION}")),
        },
        sources: vec![
            "R (Rakotonirina 2016), sections 7.2 and 7.3",
            "J. Nordström, N. Nordin and D. Henningson, SIAM J. Sci. Comput. 20 (1999) 1365: the fringe",
        ],
        answers: vec![
            "Requirement: drag of a fixed sphere at Reynolds numbers from 1 to 150.",
            "How wide must a box be, and how fine a grid, for the drag of a sphere to a per cent?",
        ],
        remarks: vec![
            "At one box the error against the table holds the share of the box: at Reynolds number 20 about ten per cent at 4 diameters across, which falls with about the square of the width. Only the extrapolated setup of the standard tier is free of it.",
            "Uncertainty of an extrapolated drag is 1.25 times what extrapolation over boxes and over grids adds, each with the order that its own sequence shows.",
            "At Reynolds numbers of 100 and 150 the boundary layer is a tenth of a diameter thick and less, a cell or two: grids of 12 and 16 cells, at the standard tier, err by what it takes off the drag. At six cells the run at 100 does not hold, with central differences and extrapolated advection on a layer thinner than a cell.",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "run",
        budget_cpu_s: [5.0, 2400.0, 2400.0],
    }
}

fn plots() -> Vec<Plot> {
    let single = || Statistic::Single.name().to_string();
    let streams = Variant::labels(|variant| matches!(variant, Variant::Stream { reynolds: 20.0, .. }));
    let array = vec![Variant::Array.label()];
    let against = |title: &str, quantity: &str, setups: &[String], orders: &[f64]| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: setups.to_vec(),
        statistics: vec![single()],
        orders: orders.to_vec(),
        knob_is_resolution: true,
        knob_label: "cells a diameter".into(),
    };
    let cost = |title: &str, quantity: &str, setups: &[String]| Plot::ErrorAgainstCost {
        title: title.into(),
        quantity: quantity.into(),
        setups: setups.to_vec(),
        statistic: single(),
        targets: vec![0.1, 0.03, 0.01],
    };
    vec![
        against("Friction factor of an array, marched", FRICTION, &array, &[2.0]),
        cost("Friction factor of an array against run time", FRICTION, &array),
        against("Drag at Reynolds number 20 against the table without bounds: grid and box", DRAG, &streams, &[2.0]),
        cost("Drag at Reynolds number 20 against run time", DRAG, &streams),
        against("Slip that is left at the surface", FULL_SLIP, &streams, &[2.0]),
        Plot::Slices {
            title: "The stream past a sphere at Reynolds number 20".into(),
            file: format!("fixed_sphere/{SLICE}"),
            radius: 0.5 / SEEN_CELLS,
            caption: "One dot a cell of the plane through the middle of the sphere, darker where the fluid is faster; the stream from left to right, its fringe on the right.".into(),
        },
    ]
}

/// The box with the sphere, the stream and the fringe.
fn picture() -> Picture {
    let corners = [[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0]];
    let mut items = vec![PictureItem::Disc { center: [1.8, 2.0], radius: 0.5, ghost: false }];
    items.extend((0..4).map(|side| PictureItem::Dashed { from: corners[side], to: corners[(side + 1) % 4] }));
    items.push(PictureItem::Polygon { points: vec![[4.5, 0.0], [6.0, 0.0], [6.0, 4.0], [4.5, 4.0]], ghost: true });
    items.push(PictureItem::Arrow { from: [-1.0, 2.0], to: [-0.2, 2.0], label: "U".into() });
    items.push(PictureItem::Label { at: [4.8, 2.0], text: "fringe".into() });
    Picture {
        caption: "A sphere in a box that repeats (dashed), four diameters across. In the fringe the flow is made uniform again.".into(),
        items,
    }
}
