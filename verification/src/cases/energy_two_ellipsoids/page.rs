//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{Contact, DEVIATION, ENERGY, Scenario, Sweep, Variant};
use crate::case::Description;
use crate::variant::Variant as _;

pub(super) fn description() -> Description {
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
                ellipse(-2.0),
                ellipse(2.0),
                PictureItem::Arrow { from: [-2.0, 0.0], to: [-0.6, 0.0], label: "u".into() },
                PictureItem::Arrow { from: [2.0, 0.0], to: [0.6, 0.0], label: "\u{2212}u".into() },
            ],
        },
        plots: plots(),
        headline: Headline {
            setup: Variant::labels(|variant| variant.contact == Contact::Smooth && variant.sweep == Sweep::Steps).swap_remove(0),
            quantity: ENERGY.into(),
            statistic: "median".into(),
            knob: 100.0,
            order_quantity: None,
        },
        sources: vec!["S (Srinivasan 2019), section 4.1.1, figures 4-1 to 4-6"],
        answers: vec!["Does a plot of kinetic energy verify a collision model? Only of bodies apart, and only with the number beside it."],
        remarks: vec!["Start phases of a soft contact are spread over a step; no contact lasts a whole number of steps."],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "start phase",
        budget_cpu_s: [5.0, 300.0, 300.0],
    }
}

fn plots() -> Vec<Plot> {
    let against = |title: &str, quantity: &str, knob_label: &str, orders: Vec<f64>, sweep: Sweep| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: Variant::labels(|variant| variant.sweep == sweep && !variant.is_hard()),
        statistics: vec!["median".into()],
        orders,
        knob_is_resolution: true,
        knob_label: knob_label.into(),
    };
    vec![
        against("Error of the energy against the step", ENERGY, "steps in the contact", vec![2.0], Sweep::Steps),
        against("Error of the energy against vertices", ENERGY, "vertices", vec![0.5], Sweep::Vertices),
        against("Soft against rigid", DEVIATION, "stiffness in N/m", vec![0.5], Sweep::Stiffness),
        against_cost("Head-on with restitution 0.4: error of the energy against the cost of a run", Scenario::HeadOn, 0.4),
        against_cost("Head-on, elastic: error of the energy against the cost of a run", Scenario::HeadOn, 1.0),
        against_cost("Turned, elastic: error of the energy against the cost of a run", Scenario::Turned, 1.0),
    ]
}

/// One scenario in all ways.
fn against_cost(title: &str, scenario: Scenario, restitution: f64) -> Plot {
    let is_shown =
        |variant: &Variant| variant.scenario == scenario && variant.restitution == restitution && variant.sweep != Sweep::Stiffness;
    Plot::ErrorAgainstCost {
        title: title.into(),
        quantity: ENERGY.into(),
        setups: Variant::labels(is_shown),
        statistic: "median".into(),
        targets: vec![1e-3, 1e-6],
    }
}

/// Outline of an ellipsoid of semi-axes 5 and 3, seen from the side.
fn ellipse(centre: f64) -> PictureItem {
    let corner = |index: u8| {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(index) / 60.0).sin_cos();
        [centre + cosine, 0.6 * sine]
    };
    PictureItem::Polygon { points: (0..60).map(corner).collect(), ghost: false }
}
