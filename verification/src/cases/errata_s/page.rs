//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem};

use super::{errata, labels};
use crate::case::{Description, Knob, setups};

pub(super) fn description() -> Description {
    let labels = labels();
    Description {
        id: "errata_s",
        title: "Formulas that source S prints wrong",
        question: "What does each formula that S prints wrong do to a number, and what does the solver do instead?",
        model: vec![
            "Every formula of S was checked against definitions, finite differences, quadrature or conservation laws. Those that code must not copy stand here, each with one number: by the formula as printed, which must fail, and by the solver, which must not.",
            "Most are slips of print. Some are not: S implements friction without a limit and takes the tangential spring for a dashpot; energy that such a model creates is real in its results.",
        ],
        equations: vec![
            Equation { latex: r"\frac{\partial f}{\partial x} = \frac{2}{\varepsilon_1 a_1} A^{\varepsilon_2/\varepsilon_1 - 1} \Bigl|\frac{x}{a_1}\Bigr|^{2/\varepsilon_2 - 1} \mathrm{sgn}\,x".into(), meaning: "S eq. 2.28 as it should be, with A the sum of both powers in the plane.".into() },
            Equation { latex: r"j_t = \min(\mu_d\, j_n,\; j_\mathrm{stick})".into(), meaning: "S eq. 3.32 as it should be: friction ends the slip at most.".into() },
            Equation { latex: r"I\dot\omega + \omega\times I\omega = T".into(), meaning: "S eq. 3.49 as it should be.".into() },
        ],
        parameters: vec![Parameter { name: "formulas".into(), value: errata().len().to_string(), remark: "the knob is the number of the equation".into() }],
        reference: "Definitions and conservation laws, by hand.",
        picture: Picture {
            caption: "Friction as printed pushes the slip on: a ball that slides along a wall leaves it faster.".into(),
            items: vec![
                PictureItem::Disc { center: [0.0, 1.0], radius: 1.0, ghost: false },
                PictureItem::Dashed { from: [-2.0, 0.0], to: [2.0, 0.0] },
                PictureItem::Arrow { from: [0.0, 1.0], to: [1.2, 1.0], label: "v".into() },
            ],
        },
        plots: Vec::new(),
        headline: Headline {
            setup: labels[1].clone(),
            quantity: errata()[0].quantity.into(),
            statistic: "single".into(),
            knob: errata()[0].equation,
            order_quantity: None,
        },
        sources: vec!["S (Srinivasan 2019), chapters 2 and 3, appendix A"],
        answers: vec!["May a code be written from the thesis? Only with this list beside it."],
        remarks: vec![
            "The tangential law without memory (S eq. 3.43) is a choice of model, not a slip: its error stands on the page of oblique_impact.",
            "The explicit Euler turn of S is on the page of free_top.",
        ],
        knob: Knob { name: |_| "equation", values: |_, setup| errata().get(setup.index / super::FORMS.len()).map_or_else(Vec::new, |erratum| vec![erratum.equation]) },
        setups: setups(labels),
        sample: "formula",
        budget_cpu_s: [5.0, 5.0, 5.0],
    }
}
