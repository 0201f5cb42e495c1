//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{FASTEST, FRAMES, STARTED, TANK_CELLS, TERMINAL, TRANSIENT, Variant, curve_file};
use crate::case::Description;
use crate::claim::Statistic;
use crate::variant::Variant as _;

pub(super) fn description() -> Description {
    Description {
        id: "settling_sphere",
        title: "Spheres that settle",
        question: "Does a sphere that moves freely settle with the velocity of its array and of a tank, start with its added mass, and stay stable from a hundredth to a thousand times the density of the fluid?",
        model: vec![
            "A sphere in a cubic cell that repeats falls by its net weight; the fluid as a whole stays where it is, as in a vessel. Velocity of the fluid, forces of the constraint and velocities of the sphere are the solution of one linear system a step: without divergence, rigid at the surface, with balanced loads. Nothing is lagged, so that the density ratio does not matter to stability; at a ratio of one the body's own inertia drops out of the balance and the system is as good as ever.",
            "The load on a sphere is that of the constraint's forces and the rate of change of the momentum of the fluid inside. Without divergence the linear momentum inside is that of a rigid body, whatever the fluid does there. The angular momentum is summed from the values inside: fluid takes its time to turn with the body.",
            "Differences backwards over two steps; the place of the sphere is extrapolated, its velocity implicit.",
            "In the tank of ten Cate et al. six walls close the fluid in. They are planes of values within the box that repeats, on which forces hold the fluid at rest; each plane is inverted exactly, wave by wave, and what planes, edges and sphere do to each other is left to the iteration of a step.",
        ],
        equations: vec![
            Equation {
                latex: r"(\rho_s - \rho_f) V \frac{dU}{dt} = (\rho_s - \rho_f) V g - \int E\lambda\,dV".into(),
                meaning: "Balance of forces on a body filled with fluid (R eq. 7.2).".into(),
            },
            Equation {
                latex: r"\frac{d}{dt}\Bigl(I_s\omega - \int_{body}\rho_f\,r\times u\,dV\Bigr) = -\int r\times E\lambda\,dV".into(),
                meaning: "Balance of torques. R eq. 7.3 takes the fluid inside as rigid, and prints the first term without the factor (density ratio - 1): errata.".into(),
            },
            Equation {
                latex: r"U_\infty = \frac{(\rho_s - \rho_f) V g}{6\pi\mu a K}".into(),
                meaning: "Terminal velocity in an array of friction factor K.".into(),
            },
            Equation {
                latex: r"\frac{\rho_s V U}{\Delta t} = (\rho_s - \rho_f) V g - 6\pi\mu a U\,\Bigl(1 + \frac{a}{\delta} + \frac{a^2}{9\delta^2}\Bigr),\qquad \delta^2 = \nu\Delta t".into(),
                meaning: "First step from rest of a sphere alone: friction, its layer, and the added mass of half the displaced fluid. In an array the last two grow with the dipole of a sphere by 1 / (1 - c).".into(),
            },
        ],
        parameters: [
            ("array", "simple cubic, solid fraction 0.125, no mean flow", ""),
            ("step", "a twentieth of radius^2 / viscosity", "transient: 10 to 40 steps against 160"),
            ("fall", "half a radius times Stokes' velocity a time", "creeping: no advection"),
            ("start", "solid fraction 0.02, one step of a ninth, 12 cells a diameter", "a layer of a third of the radius: two spacings"),
            ("tank", "100 x 100 x 160 mm, sphere of 15 mm and 1120 kg/m^3, centre 127.5 mm above the floor, 9.81 N/kg", "E1: 970 kg/m^3, 0.373 Pa s; E4: 960 kg/m^3, 0.058 Pa s"),
            ("step in the tank", "a fifth of a spacing at the velocity without bounds", "velocities averaged over the fall of two spacings"),
            ("two frames", "cell of two diameters, Reynolds number 20, mean over the passage of two diameters", "not steady yet: the same transient"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Terminal velocity: independent fundamental solutions for the friction factor, 2e-6. Start: Stokes' unsteady drag in closed form. Transient: own fine steps. Frames: the same flow seen from the sphere. Tank: measured by ten Cate et al. (2002), 1 %.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: Variant::Terminal.label(),
            quantity: TERMINAL.into(),
            statistic: Statistic::Single.name().into(),
            knob: 12.0,
            order_quantity: Some(format!("observed order of {TERMINAL}")),
        },
        sources: vec![
            "R (Rakotonirina 2016), section 7.2, eq. 7.1 to 7.4",
            "A. A. Zick and G. M. Homsy, J. Fluid Mech. 115 (1982) 13",
            "G. G. Stokes, Trans. Camb. Phil. Soc. 9 (1851) 8: unsteady drag",
            "N. Zuber, Chem. Eng. Sci. 19 (1964) 897: added mass in an array",
            "A. ten Cate, C. H. Nieuwstad, J. J. Derksen and H. E. A. Van den Akker, Phys. Fluids 14 (2002) 4012: settling in a tank",
        ],
        answers: vec![
            "Stability test S34: density ratios from 0.01 to 1000, one included; S32: ripple on the way over cells.",
            "Erratum of R eq. 7.3: the missing factor.",
            "Freely moving bodies and a constraint that is rigid and free of divergence at once: perspectives of R.",
        ],
        remarks: vec![
            "The sphere of density one has no weight and stays at rest exactly; its balance holds forces of the constraint alone.",
            "The transient starts with a layer that grows with the root of time from nothing; the order is that of whole runs from rest.",
            "Case E1 of the tank ends four to five hundredths below the measured velocity, which is said to be known to one, on every grid; E4 within its uncertainty and that of the grid. Why is not known: the reference velocity without bounds, Abraham's, is itself 6 % below that of Schiller and Naumann at that Reynolds number.",
            "The tank is at the longer tiers only. Its error is split into the share of the grid (extrapolated over three), that of the step (halved on the coarsest) and that of the walls (half as far again on the coarsest).",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "run",
        budget_cpu_s: [5.0, 1200.0, 1200.0],
    }
}

fn plots() -> Vec<Plot> {
    let single = || Statistic::Single.name().to_string();
    let against = |title: &str, quantity: &str, variant: Variant, orders: &[f64], label: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: vec![variant.label()],
        statistics: vec![single()],
        orders: orders.to_vec(),
        knob_is_resolution: variant != Variant::Ratios,
        knob_label: label.into(),
    };
    let cost = |title: &str, quantity: &str, variant: Variant| Plot::ErrorAgainstCost {
        title: title.into(),
        quantity: quantity.into(),
        setups: vec![variant.label()],
        statistic: single(),
        targets: vec![0.1, 0.01, 1e-3],
    };
    vec![
        against("Terminal velocity", TERMINAL, Variant::Terminal, &[2.0], "cells a diameter"),
        cost("Terminal velocity against run time", TERMINAL, Variant::Terminal),
        against("Velocity on the way", TRANSIENT, Variant::Transient, &[2.0], "steps a viscous time"),
        cost("Velocity on the way against run time", TRANSIENT, Variant::Transient),
        against(
            "Start of light and heavy spheres: error of the velocity after the first step",
            STARTED,
            Variant::Ratios,
            &[],
            "density ratio",
        ),
        against_tank(),
        tank_curve("E1"),
        tank_curve("E4"),
        against("One flow in two frames: difference of the drag", FRAMES, Variant::Frames, &[1.0, 2.0], "cells a diameter"),
    ]
}

fn against_tank() -> Plot {
    Plot::Convergence {
        title: "Largest velocity in ten Cate's tank, against the experiment".into(),
        quantity: FASTEST.into(),
        setups: ["E1", "E4"]
            .into_iter()
            .flat_map(|name| [Variant::Tank(name), Variant::TankShares(name)])
            .map(|variant| variant.label())
            .collect(),
        statistics: vec![Statistic::Single.name().into()],
        orders: vec![2.0],
        knob_is_resolution: true,
        knob_label: "cells a diameter".into(),
    }
}

fn tank_curve(name: &str) -> Plot {
    Plot::Curves {
        title: format!("Fall in ten Cate's tank, case {name}"),
        file: format!("settling_sphere/{}", curve_file(name, TANK_CELLS[2])),
        x_label: "time / s".into(),
        y_label: "height of the centre / m, speed / (m/s)".into(),
        columns: vec![["height".into(), "height".into()], ["speed".into(), "speed".into()]],
        log_x: false,
        log_y: false,
        caption: "The largest velocity is reached well above the floor, which then slows the sphere down. At the longer tiers.".into(),
    }
}

/// The cell with its sphere, its neighbours fainter, and where it goes.
fn picture() -> Picture {
    let radius = 0.31;
    let disc = |x: f64, y: f64| PictureItem::Disc { center: [x, y], radius, ghost: x != 0.0 || y != 0.0 };
    let mut items: Vec<PictureItem> = [-1.0, 0.0, 1.0].into_iter().flat_map(|x| [-1.0, 0.0, 1.0].map(|y| disc(x, y))).collect();
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    items.extend((0..4).map(|side| PictureItem::Dashed { from: corners[side], to: corners[(side + 1) % 4] }));
    items.push(PictureItem::Arrow { from: [0.0, 0.0], to: [0.0, -0.45], label: "U".into() });
    Picture {
        caption: "A sphere falls in a cubic cell (dashed) that repeats in all directions, its images with it. Solid fraction 0.125.".into(),
        items,
    }
}
