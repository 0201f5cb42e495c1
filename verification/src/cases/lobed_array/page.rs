//! What the case says about itself.

use std::f64::consts::{FRAC_PI_2, TAU};

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::flows::{Course, Family, Method, Shape};
use super::{DRAG, ENDLESS, FRICTION, Measure, SLICE, Variant, curve_file};
use crate::case::Description;
use crate::variant::Variant as _;

pub(super) fn description() -> Description {
    Description {
        id: "lobed_array",
        title: "Creeping flow through arrays of lobed prisms",
        question: "What is the friction of cylinders, trilobes and quadralobes in periodic arrays, how fast do grids find it, and do the shapes rank as R tells?",
        model: vec![
            "One body is held in a cell that repeats: a cylinder, a trilobe or a quadralobe, as long as wide or five times as long, its axis along the flow, across it, or turned by 20 degrees about all three axes. A mean pressure gradient drives a fluid without inertia past it.",
            "Lobed prisms are unions of discs in a ring and the polygon of their centres, drawn along an axis. The nearest point of the surface is that of the union, in closed form; grooves between lobes, ends and their edges included.",
            "A cylinder without ends is one with its images. The flow past a square array of these is known to ten digits along and across the axis: the outside measure for everything that is not a sphere.",
        ],
        equations: vec![
            Equation {
                latex: r"\frac{\Delta p}{l} = \frac92 \frac{\mu}{a^2}\,\phi\, K\, U".into(),
                meaning: "Friction factor by the radius a of the sphere of equal volume and the mean velocity U of the whole cell (R eq. 7.16).".into(),
            },
            Equation {
                latex: r"K(h) = K_0 + C\, N_p^{-\beta},\qquad N_p = d/h".into(),
                meaning: "Order and limit of a sequence of grids; R finds 1.3 for all its bodies (R eq. 7.14, sections 7.4.1 and 7.4.2).".into(),
            },
        ],
        parameters: [
            ("lobes", "filling 71.1 % (trilobe) and 74.3 % (quadralobe) of their circumscribed cylinder", "from diameters and lengths of equal volume in R table 7.1; R's text tells 69 % and 74 % (section 4.2.4), and R prints no radius"),
            ("cells", "edges 1, 1, 1 (aspect ratio 1), 1, 1, 5 (aspect ratio 5) and 1, 1, 5/2 (ranking)", "R does not tell the edges of its cells"),
            ("places of the bodies", "random between the values of the grid", "three; one where a flow is dear"),
            ("turned", "20 degrees about x, then y, then z", "R does not tell the order"),
            ("tolerance of the solvers", "1e-6 of the first residual", "drag then has eight digits"),
            ("collocation points", "1.5 spacings apart", "R: 1 to 2"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Endless cylinders: harmonics collocated on the sides of a cell, ten digits; they meet the table and series of Sangani and Acrivos and those of Drummond and Tahir. Finite bodies: more and finer own grids, extrapolated, 0.5 to 2.4 % uncertain; R prints curves but no numbers.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: endless(Course::Along, Method::Sharp, ENDLESS[1]).label(),
            quantity: DRAG.into(),
            statistic: "worst".into(),
            knob: 36.0,
            order_quantity: None,
        },
        sources: vec![
            "R (Rakotonirina 2016), sections 7.3.4 and 7.4.2",
            "Sangani and Acrivos, Slow flow past periodic arrays of cylinders, International Journal of Multiphase Flow 8 (1982)",
            "Drummond and Tahir, Laminar viscous flow through regular arrays of parallel solid cylinders, International Journal of Multiphase Flow 10 (1984)",
            "Sparrow and Loeffler, Longitudinal laminar flow between cylinders arranged in regular array, AIChE Journal 5 (1959)",
        ],
        answers: vec![
            "Collocation points on bodies that are not convex, and what they cost: R's open question.",
            "How well does a grid know a body with edges?",
        ],
        remarks: vec![
            "Edges of flat ends make the stress singular. There every constraint is of the first order and a bit, the default included, and the result depends on where between values the edges lie: by some per cent with ten cells a diameter. Turned bodies scatter less, as their edges lie everywhere. Round bodies without ends keep the second order.",
            "Collocation points thicken every body and come from above, the default comes from below: the two enclose the limit.",
            "R explains the ranking along the axis by cross-sections that differ between its shapes. Bodies of one volume and length have one cross-section; what differs is its circumference, which is least for the cylinder.",
            "Where solids are dense and the flow is along the axis, cylinder and trilobe differ by one or two per cent only, which the grids here cannot tell; R ranks them too.",
            "Past a body without ends along its own axis the mean velocity of the cell is not that of the fluid: what the body holds moves too, though its surface does not, and is left out.",
            "In grooves between lobes parabolas would reach into the other lobe; conditions there fall back to straight lines and to the ghost itself, and every row counts them.",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "place",
        budget_cpu_s: [5.0, 1200.0, 1200.0],
    }
}

fn endless(course: Course, method: Method, fraction: f64) -> Variant {
    Variant { measure: Measure::Flow, shape: Shape::Cylinder, family: Family::Endless, course, method, fraction }
}

fn plots() -> Vec<Plot> {
    let flows = |wanted: &dyn Fn(&Variant) -> bool| Variant::labels(|variant| variant.measure == Measure::Flow && wanted(variant));
    let against = |title: &str, quantity: &str, setups: Vec<String>, orders: Vec<f64>| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups,
        statistics: vec!["median".into(), "worst".into()],
        orders,
        knob_is_resolution: true,
        knob_label: "cells an edge of the cell".into(),
    };
    let over_fraction = |title: &str, course, caption: &str| Plot::Curves {
        title: title.into(),
        file: format!("lobed_array/{}", curve_file(course)),
        x_label: "solid fraction".into(),
        y_label: "friction factor".into(),
        columns: Shape::ALL.map(|shape| [shape.name().to_string(), shape.name().to_string()]).to_vec(),
        log_x: false,
        log_y: true,
        caption: caption.into(),
    };
    let is_short = |variant: &Variant| variant.family == Family::Short;
    let along = flows(&|variant| is_short(variant) && variant.course == Course::Along);
    vec![
        against("Endless cylinders, against the exact drag", DRAG, flows(&|variant| variant.family == Family::Endless), vec![1.25, 2.0]),
        against("Aspect ratio 1, flow along the axis, both ways to hold the body", FRICTION, along.clone(), vec![1.0, 1.3]),
        against(
            "Aspect ratio 1, flow across the axis and bodies turned",
            FRICTION,
            flows(&|variant| is_short(variant) && variant.course != Course::Along),
            vec![1.0, 1.3],
        ),
        against("Aspect ratio 5", FRICTION, flows(&|variant| variant.family == Family::Long), vec![1.0, 1.3]),
        Plot::ErrorAgainstCost {
            title: "Friction factor along the axis: relative error against run time".into(),
            quantity: FRICTION.into(),
            setups: along,
            statistic: "median".into(),
            targets: vec![0.1, 0.01],
        },
        over_fraction(
            "Flow along the axis: friction factor of bodies of equal volume and length (R figure 7.11b)",
            Course::Along,
            "Cylinder, trilobe, quadralobe from below, as R tells.",
        ),
        over_fraction(
            "Flow across the axis: friction factor of bodies of equal volume and length (R figure 7.11a)",
            Course::Across,
            "Alike where solids are few; where they are dense the trilobe blocks the flow most and the quadralobe least, as R tells.",
        ),
        Plot::Slices {
            title: "The flow across a trilobe, aspect ratio 1".into(),
            file: format!("lobed_array/{SLICE}"),
            radius: 0.5 / 24.0,
            caption: "One dot a cell of the plane through the middle of the body, darker where the fluid is faster; flow from left to right, the body is left white.".into(),
        },
    ]
}

/// A trilobe in its cell, its lobes as discs, and the flow across it.
fn picture() -> Picture {
    let lobe = |number: usize| {
        let angle = TAU * number as f64 / 3.0;
        PictureItem::Disc { center: [0.185 * angle.cos(), 0.185 * angle.sin()], radius: 0.185, ghost: false }
    };
    let corner = |number: usize| {
        let angle = FRAC_PI_2 * (number as f64 + 0.5);
        [0.5_f64.sqrt() * angle.cos(), 0.5_f64.sqrt() * angle.sin()]
    };
    let mut items: Vec<PictureItem> = (0..3).map(lobe).collect();
    items.extend((0..4).map(|side| PictureItem::Dashed { from: corner(side), to: corner((side + 1) % 4) }));
    items.push(PictureItem::Arrow { from: [-0.95, 0.0], to: [-0.6, 0.0], label: "U".into() });
    Picture {
        caption: "A trilobe, seen along its axis, in a cell (dashed) that repeats in all directions, and a mean flow across it.".into(),
        items,
    }
}
