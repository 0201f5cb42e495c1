//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{GAP, GRID, GRIDS, PERIOD, RATE, Variant};
use crate::case::Description;
use crate::claim::Statistic;
use crate::exact::jeffery;
use crate::variant::Variant as _;

pub(super) fn description() -> Description {
    Description {
        id: "neutral_body",
        title: "Neutrally buoyant bodies in shear",
        question: "Does a body of the fluid's own density stay at rest in fluid at rest, and turn in shear between moving walls as Jeffery's spheroids do?",
        model: vec![
            "A body of the fluid's own density between two flat walls that move apart along themselves. Its excess mass is nothing, so that no inertia of its own helps: forces and torques of the fluid alone must vanish. Velocity of the fluid, forces on body and walls, and velocities of the body are the solution of one linear system a step.",
            "Walls are planes of values within a box that repeats, held like the surfaces of bodies by forces that only act there. Waves along a plane do not mix, so what holds a wall alone is found exactly, by one transform along it; only what bodies and walls do to each other is left to the iteration. Components along a wall are met on it; the one through it half a spacing beside it, which is of second order.",
            "The flow without body is straight to rounding. Walls and images hold the body back by the cube of its size over their distance: they are a sweep of their own, and extrapolated to none.",
        ],
        equations: vec![
            Equation {
                latex: r"\tan\varphi = r\,\tan\frac{\dot\gamma t}{r + 1/r},\qquad T = \frac{2\pi}{\dot\gamma}\Bigl(r + \frac1r\Bigr)".into(),
                meaning: "Angle of the axis from the gradient towards the flow, and period of a whole turn, of a spheroid of aspect ratio r (Jeffery 1922).".into(),
            },
            Equation {
                latex: r"\omega = \tfrac12\dot\gamma".into(),
                meaning: "A sphere turns with the vorticity, at half the shear rate.".into(),
            },
            Equation {
                latex: r"\frac{d}{dt}\Bigl(I_s\omega - \int_{body}\rho_f\,r\times u\,dV\Bigr) = -\int r\times E\lambda\,dV".into(),
                meaning: "Balance of torques on a body filled with fluid (R eq. 7.3 as it should be).".into(),
            },
        ],
        parameters: [
            ("Reynolds number", "shear rate times squared largest semi-axis over viscosity: 0.001", "with advection"),
            ("box", "gap between the walls and distance of images: 2 largest diameters", "wider boxes: 3 and 4"),
            ("step", "a tenth of an inverse shear rate", "half of it changes the period by less than 0.001"),
            ("grid", "6, 8 and 12 cells a smallest diameter", "6 for wider boxes, 8 for spheres in them"),
            ("place", "four places of a sphere between values of the grid", "one of them on all planes of symmetry, where coarse grids are worst"),
            ("start", "axis along the gradient, velocities of creeping flow", "a quarter of an orbit by symmetry is enough"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Jeffery's orbit in closed form, without bounds and without inertia. Grids: own finer grid in the same box.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: Variant::Sphere.label(),
            quantity: GRID.into(),
            statistic: Statistic::Worst.name().into(),
            knob: 12.0,
            order_quantity: Some(format!("observed order of {GRID}")),
        },
        sources: vec![
            "R (Rakotonirina 2016), section 7.2, eq. 7.1 to 7.4",
            "G. B. Jeffery, Proc. R. Soc. A 102 (1922) 161",
        ],
        answers: vec![
            "Freely moving bodies and walls together, which R's resolved flow leaves to further work.",
            "A neutrally buoyant body, where schemes that divide by the difference of densities fail.",
        ],
        remarks: vec![
            "A spheroid of aspect ratio 2 is no thicker than six cells on the coarsest grid, and walls two diameters apart slow it down by some hundredths: the error without extrapolation is mostly that of the box.",
            "The exact period is that of a Reynolds number of nothing; a thousandth slows a sphere down by less than 1e-5.",
            "At the quick tier there is the longer spheroid alone, in the smallest box on the coarsest grid, and no extrapolation.",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "place",
        budget_cpu_s: [5.0, 1200.0, 1200.0],
    }
}

fn plots() -> Vec<Plot> {
    let single = || Statistic::Single.name().to_string();
    let against = |title: &str, quantity: &str, variants: &[Variant], orders: &[f64], label: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: variants.iter().map(Variant::label).collect(),
        statistics: if quantity == GRID { vec![Statistic::Worst.name().into(), Statistic::Median.name().into()] } else { vec![single()] },
        orders: orders.to_vec(),
        knob_is_resolution: true,
        knob_label: label.into(),
    };
    let curve = |aspect: f64| Plot::Curves {
        title: format!("Orbit of aspect ratio {aspect}"),
        file: format!("neutral_body/orbit_{aspect}_{GAP}_{}.csv", GRIDS[0]),
        x_label: "shear rate x time".into(),
        y_label: "angle of the axis from the gradient / rad".into(),
        columns: vec![["angle".into(), "measured".into()], ["angle_without_bounds".into(), "Jeffery, without bounds".into()]],
        log_x: false,
        log_y: false,
        caption: "A quarter of an orbit; walls and images slow the body down a little.".into(),
    };
    vec![
        against("Sphere: rate of turning on finer grids", GRID, &[Variant::Sphere], &[2.0], "cells a diameter"),
        Plot::ErrorAgainstCost {
            title: "Rate of turning against run time".into(),
            quantity: GRID.into(),
            setups: vec![Variant::Sphere.label()],
            statistic: Statistic::Worst.name().into(),
            targets: vec![0.1, 0.01, 1e-3],
        },
        against("Sphere: rate of turning in wider boxes", RATE, &[Variant::SphereBoxes], &[3.0], "gap / diameter"),
        curve(2.0),
        curve(0.5),
        against(
            "Spheroids: period in wider boxes",
            PERIOD,
            &[Variant::OrbitBoxes(2.0), Variant::OrbitBoxes(0.5)],
            &[3.0],
            "gap / largest diameter",
        ),
    ]
}

/// A spheroid between its walls on its way round.
fn picture() -> Picture {
    let outline = |angle: f64, ghost: bool| {
        let point = |number: usize| {
            let (sine, cosine) = (std::f64::consts::TAU * number as f64 / 60.0).sin_cos();
            let (along, across) = (cosine, 0.5 * sine);
            [along * angle.sin() + across * angle.cos(), along * angle.cos() - across * angle.sin()]
        };
        PictureItem::Polygon { points: (0..60).map(point).collect(), ghost }
    };
    let mut items = vec![outline(0.0, true), outline(jeffery::angle(2.0, 2.4), true), outline(jeffery::angle(2.0, 0.7), false)];
    for side in [-1.0, 1.0] {
        items.push(PictureItem::Wall { from: [-2.0, side * GAP], to: [2.0, side * GAP], solid_side: [0.0, side] });
        items.push(PictureItem::Arrow { from: [0.0, 0.9 * side * GAP], to: [0.8 * side * GAP, 0.9 * side * GAP], label: "U".into() });
    }
    Picture {
        caption: "A spheroid of aspect ratio 2 turns between walls that move apart; earlier and later positions fainter.".into(),
        items,
    }
}
