//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{Contact, DEVIATION, ENERGY, Sweep, Variant, variants};
use crate::case::{Description, Knob, Setup, setups};

pub(super) fn description() -> Description {
    let all = variants();
    Description {
        id: "energy_two_ellipsoids",
        title: "Two ellipsoids and a wall",
        question: "Do two ellipsoids that meet head-on, turned, or at a wall leave with the energy and velocity that their restitution says?",
        model: vec![
            "S verifies its collision models by two ellipsoids that fly at each other with 2 m/s and then at walls, with restitutions of 0.4 and 1: the kinetic energy falls to 0.16 of what it was, or stays, and the velocity goes from 2 to 0.8. S shows plots; here each is a number with its error.",
            "Hard bodies exchange an impulse, event by event or step by step as S does. Soft ones have a spring and a dashpot, between smooth surfaces or between the vertices of S.",
            "Head-on tips are kind to vertices, which lie even about them. A turned pair is not: there elastic vertices do not keep the energy.",
        ],
        equations: vec![
            Equation { latex: r"E'/E = e^2, \qquad u' = e\,u".into(), meaning: "A central impact (S section 4.1.1; S eq. 3.15 holds for such only).".into() },
            Equation {
                latex: r"j = \frac{(1+e)\,u_n}{\sum_i 1/m_i + n\cdot\bigl(I_i^{-1}(r_i\times n)\bigr)\times r_i}".into(),
                meaning: "The rigid impact of the turned pair (S eq. 3.24 with its bracket).".into(),
            },
        ],
        parameters: [
            ("semi-axes", "5, 3, 3 mm", "S gives none"),
            ("mass", "1 g", ""),
            ("speed", "2 m/s each", "two of S's units"),
            ("spring", "4 MN/m", "an overlap of about half a hundredth of the length"),
            ("time until hard bodies meet", "0.09 s", "as in S"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Restitution by definition; the rigid impulse of the turned pair at the pose in which it touches, found by bisection.",
        picture: Picture {
            caption: "Two ellipsoids fly at each other along their common axis; in the other setups at a wall, or turned and aside of each other.".into(),
            items: vec![
                PictureItem::Disc { center: [-2.0, 0.0], radius: 1.0, ghost: false },
                PictureItem::Disc { center: [2.0, 0.0], radius: 1.0, ghost: false },
                PictureItem::Arrow { from: [-2.0, 0.0], to: [-0.6, 0.0], label: "u".into() },
                PictureItem::Arrow { from: [2.0, 0.0], to: [0.6, 0.0], label: "-u".into() },
            ],
        },
        plots: plots(&all),
        headline: Headline {
            setup: labels(&all, |variant| variant.contact == Contact::Smooth && variant.sweep == Sweep::Steps).swap_remove(0),
            quantity: ENERGY.into(),
            statistic: "median".into(),
            knob: 100.0,
            order_quantity: None,
        },
        sources: vec!["S (Srinivasan 2019), section 4.1.1, figures 4-1 to 4-6"],
        answers: vec!["Does a plot of kinetic energy verify a collision model? Only of bodies apart, and only with the number beside it."],
        remarks: vec!["Start phases of a soft contact are spread over a step; no contact lasts a whole number of steps."],
        knob: Knob { name: knob_name, values: |tier, setup| variant_of(setup).map_or_else(Vec::new, |variant| variant.knobs(tier)) },
        setups: setups(all.iter().map(Variant::label)),
        sample: "start phase",
        budget_cpu_s: [5.0, 300.0, 300.0],
    }
}

fn variant_of(setup: &Setup) -> Option<Variant> {
    variants().get(setup.index).copied()
}

fn knob_name(setup: &Setup) -> &'static str {
    match variant_of(setup) {
        Some(variant) if variant.sweep == Sweep::Vertices => "vertices",
        Some(variant) if variant.sweep == Sweep::Stiffness => "stiffness_N_per_m",
        Some(variant) if variant.is_hard() => "steps_before_meeting",
        _ => "steps_per_contact",
    }
}

fn labels(all: &[Variant], wanted: impl Fn(&Variant) -> bool) -> Vec<String> {
    all.iter().filter(|variant| wanted(variant)).map(Variant::label).collect()
}

fn plots(all: &[Variant]) -> Vec<Plot> {
    let against = |title: &str, quantity: &str, knob_label: &str, orders: Vec<f64>, sweep: Sweep| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: labels(all, |variant| variant.sweep == sweep && !variant.is_hard()),
        statistics: vec!["median".into()],
        orders,
        knob_is_resolution: true,
        knob_label: knob_label.into(),
    };
    vec![
        against("Error of the energy against the step", ENERGY, "steps in the contact", vec![2.0], Sweep::Steps),
        against("Error of the energy against vertices", ENERGY, "vertices", vec![0.5], Sweep::Vertices),
        against("Soft against rigid", DEVIATION, "stiffness in N/m", vec![0.5], Sweep::Stiffness),
        Plot::ErrorAgainstCost {
            title: "Error of the energy against the cost of a run".into(),
            quantity: ENERGY.into(),
            setups: labels(all, |variant| variant.sweep != Sweep::Stiffness),
            statistic: "median".into(),
            targets: vec![1e-3, 1e-6],
        },
    ]
}
