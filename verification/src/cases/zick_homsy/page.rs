//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{AT_ONCE, COMPARED, DIVERGENCE, FRICTION, FULL_RESIDUAL, Measure, Method, SLICE, Variant};
use crate::case::Description;
use crate::exact::periodic_array::Lattice;
use crate::variant::Variant as _;

pub(super) fn description() -> Description {
    Description {
        id: "zick_homsy",
        title: "Creeping flow through arrays of spheres",
        question: "How near does the friction factor of a periodic array of spheres come to that of Zick and Homsy, with what order, and at what cost?",
        model: vec![
            "A sphere is held in a cubic cell that repeats. A mean pressure gradient drives a fluid without inertia past it; the friction factor is the force on the sphere over that of Stokes at the mean velocity of the whole cell.",
            "Default: the flow without bodies is inverted exactly by Fourier transform, and only forces on the outermost values inside the sphere are unknown. They are found so that the velocity, continued through the surface by parabolas, does not slip. Velocity without divergence and body at rest hold at once, and no time is marched.",
            "As R states it: collocation points on the surface and inside, velocities by Q2 interpolation outwards, forces spread with the same weights; solved at once, or marched by R's split scheme until the flow is steady.",
        ],
        equations: vec![
            Equation {
                latex: r"-\mu \nabla^2 u + \nabla p = E\lambda,\qquad \nabla\cdot u = 0,\qquad J u = u_{body}".into(),
                meaning: "Fluid everywhere, forces only where the body is, conditions on its surface; J = E^T for collocation points (R eq. 7.1 to 7.5).".into(),
            },
            Equation {
                latex: r"\frac{\Delta p}{l} = \frac92 \frac{\mu}{a^2}\,\phi\, K\, U".into(),
                meaning: "Friction factor from the pressure gradient and the mean velocity of the cell (R eq. 7.16).".into(),
            },
        ],
        parameters: [
            ("arrays", "simple, body-centred and face-centred cubic, flow along an edge", "solid fractions 0.001 to touching (0.5236)"),
            ("places of the spheres", "random between the values of the grid", "nine up to 16 cells an edge, five up to 24, else three; points three, marched runs one"),
            ("cells an edge", "next product of 2, 3 and 5", "what transforms like; cells a diameter are as near as that allows"),
            ("tolerance of the solvers", "1e-6 of the first residual", "the friction factor then has eight digits"),
            ("collocation points", "1.5 spacings apart on a spiral", "R: 1 to 2"),
            ("marched runs", "8 cells a diameter", "until the mean velocity changes by less than 1e-5 in a diffusion time"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Independent computation by fundamental solutions with periodic Stokeslets, 2e-6 relative (5e-6 where spheres touch); the printed values of Zick and Homsy agree with it to all their digits, the series of Sangani and Acrivos to 1e-6 where spheres are few. Centred lattices by the same method (the script is in reference-data/zick_homsy), which where spheres are few agree with the leading terms of Hasimoto.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: Variant { measure: Measure::Flow, method: Method::SHARP, lattice: Lattice::SimpleCubic, fraction: 0.216 }.label(),
            quantity: FRICTION.into(),
            statistic: "worst".into(),
            knob: 30.0,
            order_quantity: Some(format!("order of {FRICTION}")),
        },
        sources: vec![
            "R (Rakotonirina 2016), sections 7.3 and 7.4",
            "Zick and Homsy, Stokes flow through periodic arrays of spheres, Journal of Fluid Mechanics 115 (1982)",
            "Sangani and Acrivos, Slow flow through a periodic array of spheres, International Journal of Multiphase Flow 8 (1982)",
        ],
        answers: vec![
            "A constraint that keeps the velocity free of divergence and the body rigid at once: R's open perspective.",
            "How many cells a diameter does one per cent need, and what does it cost?",
        ],
        remarks: vec![
            "Cost is judged by counts, cells times scalar operators inverted (three a flow, four a marched step), because times on a shared machine are noise. Times stand in the plot and its table.",
            "Forces of collocation points reach two cells into the fluid with their transposed weights and thicken the body by a part of a cell: order 1.2 to 1.3, as R reports, whatever the interpolation. Holding the inside too makes it worse.",
            "With R's explicit forcing of one the marched scheme tends to the very friction factor of the same points solved at once, whatever the time step: in the steady state both halves of a step agree; with 25 steps in a diffusion time it had not settled after 30 of them. Without it the result depends on the step by tens of per cent.",
            "Where the stencil of a parabola would reach through a gap into the inside of another sphere the ghost falls back to a straight line, and to the ghost itself: so spheres that touch are of first order. Every row counts such conditions in its work.",
            "Slip at the surface is what is left of all conditions: the pressure in a pocket of cells that ghosts close in is free, and as many conditions cannot be met by a flow without divergence. It falls with the third power of the spacing.",
            "Other codes at solid fraction 0.125, run once on a machine like this, CPU seconds to an error of 1 % and of 0.1 %: lbmpy 2.6 to 5.2 and 100 to 1000 (by viscosity), Basilisk with embedded boundaries 45 to 79 and above 2000, its DLM/FD about 500 and above 100,000, with a friction factor that moves with the root of the time step.",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "place",
        budget_cpu_s: [5.0, 1200.0, 1200.0],
    }
}

fn plots() -> Vec<Plot> {
    let flows = |wanted: &dyn Fn(&Variant) -> bool| Variant::labels(|variant| variant.measure == Measure::Flow && wanted(variant));
    let dense = flows(&|variant| variant.method == Method::SHARP && variant.lattice == Lattice::SimpleCubic && variant.fraction > 0.1);
    let dilute = flows(&|variant| variant.method == Method::SHARP && variant.fraction < 0.1);
    let centred = flows(&|variant| variant.lattice != Lattice::SimpleCubic && variant.fraction > 0.1);
    let compared = flows(&|variant| variant.fraction == COMPARED && !variant.method.is_marched());
    let marched = flows(&|variant| variant.method.is_marched());
    let against = |title: &str, quantity: &str, setups: &[String], orders: Vec<f64>| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: setups.to_vec(),
        statistics: vec!["median".into(), "worst".into()],
        orders,
        knob_is_resolution: true,
        knob_label: "cells a diameter".into(),
    };
    let over_time = |title: &str, quantity: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: marched.clone(),
        statistics: vec!["single run".into()],
        orders: Vec::new(),
        knob_is_resolution: true,
        knob_label: "steps in a diffusion time".into(),
    };
    vec![
        Plot::ErrorAgainstCost {
            title: "Friction factor at solid fraction 0.125: relative error against run time of all methods".into(),
            quantity: FRICTION.into(),
            setups: compared.iter().chain(&marched).cloned().collect(),
            statistic: "median".into(),
            targets: vec![0.1, 0.01, 1e-3],
        },
        Plot::ErrorAgainstCost {
            title: "The default at all solid fractions: relative error against run time".into(),
            quantity: FRICTION.into(),
            setups: dense.clone(),
            statistic: "median".into(),
            targets: vec![0.1, 0.01, 1e-3],
        },
        against("Friction factor at solid fraction 0.125, all ways to hold the sphere", FRICTION, &compared, vec![1.25, 2.0]),
        against("Friction factor, default, from 0.125 to touching", FRICTION, &dense, vec![1.0, 2.0]),
        against("Friction factor, default, few spheres, three lattices", FRICTION, &dilute, vec![2.0]),
        against("Friction factor, default, dense centred lattices", FRICTION, &centred, vec![2.0]),
        against("Slip that is left at the surface", FULL_RESIDUAL, &dense, vec![2.0, 3.0]),
        Plot::Slices {
            title: "The flow past a sphere at solid fraction 0.216".into(),
            file: format!("zick_homsy/{SLICE}"),
            radius: 0.5 / 20.0,
            caption: "One dot a cell of the plane through the middle of the sphere, darker where the fluid is faster; flow from left to right, the sphere is left white.".into(),
        },
        over_time("Marched in time: friction factor against that of the same points solved at once", AT_ONCE),
        over_time("Marched in time: divergence that the second half of a step leaves", DIVERGENCE),
    ]
}

/// The cell with its sphere, those of its neighbours fainter, and the flow.
fn picture() -> Picture {
    let radius = 0.31;
    let disc = |x: f64, y: f64| PictureItem::Disc { center: [x, y], radius, ghost: x != 0.0 || y != 0.0 };
    let mut items: Vec<PictureItem> = [-1.0, 0.0, 1.0].into_iter().flat_map(|x| [-1.0, 0.0, 1.0].map(|y| disc(x, y))).collect();
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    items.extend((0..4).map(|side| PictureItem::Dashed { from: corners[side], to: corners[(side + 1) % 4] }));
    items.push(PictureItem::Arrow { from: [-1.45, 0.5], to: [-0.75, 0.5], label: "U".into() });
    Picture {
        caption: "One sphere in a cubic cell (dashed) that repeats in all directions, and the mean flow. Solid fraction 0.125.".into(),
        items,
    }
}
