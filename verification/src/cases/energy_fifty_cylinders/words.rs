//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{HARD_CURVE, KINETIC, PLACES, SOFT_CURVE, TOTAL, VARIANTS};
use crate::case::{Description, Knob, setups};

pub(super) fn description() -> Description {
    let labels: Vec<String> = VARIANTS.iter().map(|(_, label)| (*label).to_string()).collect();
    Description {
        id: "energy_fifty_cylinders",
        title: "Energy of fifty cylinders",
        question: "Do fifty cylinders that collide without loss in a closed box keep their energy, with impulses and with springs?",
        model: vec![
            "Fifty cylinders of the proportions of source S (semi-axes 4 : 4 : 2.65) start at random in a closed cubic box with 1 m/s each in a random direction and no spin. Collisions with each other and with the six walls are elastic and smooth, so that kinetic energy spreads to all rotations and its sum must stay. S shows a flat curve (figures 4-7 and 4-8) and prints neither size nor duration; the sizes here are ours.",
            "Three ways. Hard and event-driven: every collision at its own time, found to 1e-12 of the size by certified steps between which nothing can touch; cylinders turn exactly, by precession and spin. Hard and time-driven as S: all move for a step, what then overlaps takes its impulses and is pushed apart. Soft: linear springs without dashpot.",
            "With springs the energy that must stay is that of motion and springs together. S plots the kinetic energy alone, which falls whenever cylinders touch.",
        ],
        equations: vec![
            Equation {
                latex: r"j = \frac{(1+e)\,u_n}{\frac1{m_1}+\frac1{m_2}+\left[(I_1^{-1}(r_1\times n))\times r_1+(I_2^{-1}(r_2\times n))\times r_2\right]\cdot n}".into(),
                meaning: "Impulse along the normal, S eq. 3.24 with its bracket closed (errata). It keeps the energy exactly at e = 1.".into(),
            },
            Equation {
                latex: r"J_t = s\,J_\mathrm{stick},\qquad s \le 1,\quad |J_t| \le \mu\,j_n,\quad \Delta E_t(s) \le 0".into(),
                meaning: "Friction takes away the slip and no more, lies in the cone, and creates no energy (S eq. 3.32-3.33 corrected: printed, it pushes the slip on and has no limit).".into(),
            },
        ],
        parameters: [
            ("cylinders", "50 of 8 mm diameter, 5.3 mm length, 1000 kg/m³", "a sixteenth of the box"),
            ("box", "60 mm", "six flat walls"),
            ("speed at the start", "1 m/s", "U_ref of S; no spin, no gravity"),
            ("passage", "8 ms", "flight over one diameter"),
            ("stiffness of the soft cylinders", "10⁶ N/m", "a contact lasts 36 µs"),
            ("random starts", "3 of each measurement", "no two balls about cylinders overlap"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Conservation of energy, momentum and angular momentum. Places of time-driven cylinders: the event-driven run of the same start.",
        picture: picture(),
        plots: plots(&labels),
        headline: Headline {
            setup: labels[0].clone(),
            quantity: KINETIC.into(),
            statistic: "worst".into(),
            knob: 5000.0,
            order_quantity: None,
        },
        sources: vec![
            "S (Srinivasan 2019), sections 3.1, 4.1.1 and A.1, eq. 3.13-3.33 and A.1-A.8, figures 4-7 and 4-8",
            "A. Chatterjee and A. Ruina, J. Appl. Mech. 65 (1998) 939: a rigid-body collision law that creates no energy",
            "B. Mirtich, Impulse-based dynamic simulation of rigid body systems (1996): conservative advancement",
        ],
        answers: vec![
            "Kinetic energy alone is no test of a soft code: it dips with every contact, and returns.",
            "Errata of S: the sign of friction in eq. 3.33 and its missing limit by sticking create energy, and are shown to.",
        ],
        remarks: vec![
            "Time-driven impulses keep the kinetic energy as well as event-driven ones: pushing apart what overlaps does no work on it. Their error is in places and times, of first order in the step, and in collisions that begin and end within a step and are never seen. Energy is the wrong measure of that scheme.",
            "With restitution below one a cylinder that clatters against a wall collides ever faster, without end in finite time: the event-driven run then stops with an error that says so. The rough setup is therefore short.",
            "After some collisions of each cylinder the motion depends on the start beyond any precision; places are therefore compared after two passages.",
            "Edges of the cylinders are rounded against each other by a fiftieth of half their length, so that the normal of every contact is known; against walls they are sharp.",
        ],
        knob: Knob { name: |setup| VARIANTS[setup.index].0.knob(), values: |tier, setup| VARIANTS[setup.index].0.knobs(tier) },
        setups: setups(labels),
        sample: "sample",
        budget_cpu_s: [5.0, 300.0, 300.0],
    }
}

fn plots(labels: &[String]) -> Vec<Plot> {
    let convergence = |title: &str, quantity: &str, setup: usize, orders: Vec<f64>, label: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: vec![labels[setup].clone()],
        statistics: vec!["median".into(), "worst".into()],
        orders,
        knob_is_resolution: true,
        knob_label: label.into(),
    };
    let curves = |title: &str, file: &str, x_label: &str, columns: &[[&str; 2]], caption: &str| Plot::Curves {
        title: title.into(),
        file: format!("energy_fifty_cylinders/{file}"),
        x_label: x_label.into(),
        y_label: "relative energy change".into(),
        columns: columns.iter().map(|column| column.map(String::from)).collect(),
        log_x: false,
        log_y: false,
        caption: caption.into(),
    };
    vec![
        curves(
            "Energy of hard cylinders",
            HARD_CURVE,
            "collisions",
            &[["relative_energy_change", "event-driven"]],
            "Figure 4-8 of S, seen closely enough to see its rounding.",
        ),
        curves(
            "Energy of soft cylinders",
            SOFT_CURVE,
            "time / s",
            &[["kinetic_and_spring", "kinetic and spring energy"], ["kinetic_alone", "kinetic energy alone, as S plots it"]],
            "Every dip is a contact whose springs hold the difference.",
        ),
        convergence("Energy of soft cylinders", TOTAL, 2, vec![2.0], "steps per contact"),
        convergence("Places of time-driven cylinders", PLACES, 1, vec![1.0], "steps per passage"),
        Plot::ErrorAgainstCost {
            title: "Places of time-driven cylinders against run time".into(),
            quantity: PLACES.into(),
            setups: vec![labels[1].clone()],
            statistic: "median".into(),
            targets: vec![0.1, 0.01, 0.001],
        },
    ]
}

fn picture() -> Picture {
    // A cylinder from the side: a rectangle of 8 by 5.3, turned.
    let cylinder = |x: f64, y: f64, angle: f64, ghost: bool| {
        let (sine, cosine) = angle.sin_cos();
        let corner = |along: f64, across: f64| [x + along * cosine - across * sine, y + along * sine + across * cosine];
        PictureItem::Polygon { points: [(-4.0, -2.65), (4.0, -2.65), (4.0, 2.65), (-4.0, 2.65)].map(|(a, b)| corner(a, b)).to_vec(), ghost }
    };
    let wall = |from: [f64; 2], to: [f64; 2], solid_side: [f64; 2]| PictureItem::Wall { from, to, solid_side };
    let mut items = vec![
        wall([-30.0, -20.0], [30.0, -20.0], [0.0, -1.0]),
        wall([30.0, -20.0], [30.0, 20.0], [1.0, 0.0]),
        wall([30.0, 20.0], [-30.0, 20.0], [0.0, 1.0]),
        wall([-30.0, 20.0], [-30.0, -20.0], [-1.0, 0.0]),
    ];
    for (place, (x, y)) in [(-22.0, -12.0), (-6.0, 10.0), (8.0, -8.0), (20.0, 11.0), (-18.0, 8.0)].into_iter().enumerate() {
        let angle = 0.9 * place as f64;
        items.push(cylinder(x - 2.0, y - 1.5, angle - 0.3, true));
        items.push(cylinder(x, y, angle, false));
        items.push(PictureItem::Arrow { from: [x, y], to: [x + 6.0, y + 4.5], label: String::new() });
    }
    Picture { caption: "Cylinders fly, turn and collide in a closed box.".into(), items }
}
