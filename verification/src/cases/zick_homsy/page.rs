//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{DIVERGENCE, FRICTION, FULL_RESIDUAL, Method, TOUCHING, Variant};
use crate::case::Description;
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
            ("array", "simple cubic, flow along an edge", "solid fractions 0.001 to touching (0.5236)"),
            ("place of the sphere", "random between grid points", "three places where a diameter has up to 20 cells, else one"),
            ("tolerance of the solvers", "1e-8 of the first residual", ""),
            ("collocation points", "1.5 spacings apart on a spiral", "R: 1 to 2"),
            ("marched runs", "10 cells a diameter", "until the mean velocity changes by less than 1e-5 in a diffusion time"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Independent computation by fundamental solutions with periodic Stokeslets, 2e-6 relative (5e-6 where spheres touch); the printed values of Zick and Homsy agree with it to all their digits.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: Variant { method: Method::Sharp, fraction: 0.216 }.label(),
            quantity: FRICTION.into(),
            statistic: "worst".into(),
            knob: 28.0,
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
            "Forces of collocation points reach two cells into the fluid with their transposed weights and thicken the body by a part of a cell: order 1.2 to 1.3, as R reports, whatever the interpolation. Holding the inside too makes it worse.",
            "With R's explicit forcing of one the marched scheme tends to the very friction factor of the same points solved at once, whatever the time step: in the steady state both halves of a step agree. Without it the result depends on the step by tens of per cent.",
            "Where the stencil of a parabola would reach through a gap into the inside of another sphere the ghost falls back to a straight line, and to the ghost itself: so spheres that touch are of first order.",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "place between grid points",
        budget_cpu_s: [5.0, 1200.0, 1200.0],
    }
}

fn plots() -> Vec<Plot> {
    let sharp = Variant::labels(|variant| variant.method == Method::Sharp && (variant.fraction > 0.1 || variant.fraction == TOUCHING));
    let rivals =
        Variant::labels(|variant| variant.fraction == 0.125 && !variant.method.is_marched() && variant.method != Method::Extrapolated);
    let marched = Variant::labels(|variant| variant.method.is_marched());
    let against_cells = |title: &str, quantity: &str, setups: &[String], orders: Vec<f64>| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: setups.to_vec(),
        statistics: vec!["median".into(), "worst".into()],
        orders,
        knob_is_resolution: true,
        knob_label: "cells a diameter".into(),
    };
    vec![
        Plot::ErrorAgainstCost {
            title: "Friction factor at solid fraction 0.125: relative error against the cost of one flow".into(),
            quantity: FRICTION.into(),
            setups: rivals.iter().chain(&marched).cloned().collect(),
            statistic: "median".into(),
            targets: vec![0.1, 0.01, 1e-3],
        },
        against_cells("Friction factor, default, from loose to touching", FRICTION, &sharp, vec![1.0, 2.0]),
        against_cells("Friction factor at solid fraction 0.125, all ways to hold the sphere", FRICTION, &rivals, vec![1.25, 2.0]),
        against_cells("Slip that is left at the surface", FULL_RESIDUAL, &sharp, vec![2.0, 3.0]),
        Plot::Convergence {
            title: "Marched in time: friction factor against the time step".into(),
            quantity: FRICTION.into(),
            setups: marched.clone(),
            statistics: vec!["median".into()],
            orders: vec![0.5],
            knob_is_resolution: true,
            knob_label: "steps in a diffusion time".into(),
        },
        Plot::Convergence {
            title: "Marched in time: divergence that the second half of a step leaves".into(),
            quantity: DIVERGENCE.into(),
            setups: marched,
            statistics: vec!["median".into()],
            orders: Vec::new(),
            knob_is_resolution: true,
            knob_label: "steps in a diffusion time".into(),
        },
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
