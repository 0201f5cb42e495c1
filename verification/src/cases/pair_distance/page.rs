//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::ERROR;
use super::variants::{Mode, Variant};
use crate::case::Description;
use crate::variant::Variant as _;

pub(super) fn description() -> Description {
    Description {
        id: "pair_distance",
        title: "Distance of two shapes",
        question: "Is the distance right for every pair of shapes, at every scale and in degenerate poses, and what does it cost?",
        model: vec![
            "Two convex shapes in random poses are put a random gap of 0 to 5 % of their size apart and asked for their distance: from no guess (cold), and from what a look left when the second body was a thousandth of its size and of a radian away, as in the last step of a simulation (warm).",
            "The search is that of Gilbert, Johnson and Keerthi. Where a surface is curved, Newton's method on the angles of rims, the lines of sides and the normals of superellipsoids has the last word, and is only believed with a certificate.",
            "Besides: pairs that touch in every special way at gaps on both sides of rounding; pairs far from the origin; what a crust changes, even or shrunk by a ratio as in R; the search without its polish; and parry's distances.",
        ],
        equations: equations(),
        parameters: [
            ("gap of random pairs", "0 to 5 % of the size", ""),
            ("step between warm questions", "10⁻³", "of the size and of a radian, in random directions"),
            ("proportions", "cube, cylinder 1:1, rod 10:1, coin 1:10, spherocylinder 1:1, tetrahedron, icosahedron, sphere; ellipsoid and pebble (exponents 0.6 and 1.3) 10 : 7 : 5", ""),
            ("failure", "error above 10⁻¹⁰ of the size, 10⁻¹² without curved surfaces, or no number", ""),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "A certificate from the shapes' own numbers, independent of the solver: no distance is below the gap of the supporting planes, none above the distance of two points of the bodies. Touching pairs: the gap at which they were put.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: label_of(Mode::Cold, 1),
            quantity: ERROR.into(),
            statistic: "worst".into(),
            knob: 1.0,
            order_quantity: None,
        },
        sources: vec![
            "Gilbert, Johnson and Keerthi, A fast procedure for computing the distance between complex objects in three-dimensional space (1988)",
            "R (Rakotonirina 2016), section 2.5: distance of convex shapes with a crust",
            "Ericson, Real-Time Collision Detection (2005), sections 5.1 and 9.5",
            "parry3d 0.31, the distance of the Rapier engine",
        ],
        answers: vec![
            "Is a contact of boxes ever missed, or its depth wrong by its size? FCL issues 493 and 495, MuJoCo-Warp issues 1430 and 1526: none here, in a million pairs of each two kinds.",
            "Do results depend on the unit of length? Errors over the size are the same from a micrometre to a kilometre.",
        ],
        remarks: vec![
            "The cost of a run is that of a question: each pair is asked twelve times over for it, its placing and its certificate included as a thirteenth.",
            "A shape that is shrunk by a ratio, as R does it, keeps its proportions, not the thickness of its crust: exact for cubes and equilateral cylinders, wrong at the ends of rods.",
            "The standard tier asks a million pairs of each two kinds, a hundred thousand where one of them is a superellipsoid.",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "pair",
        budget_cpu_s: [5.0, 900.0, 900.0],
    }
}

/// Label of one of the setups of a mode, by place.
fn label_of(mode: Mode, place: usize) -> String {
    Variant::labels(|variant| variant.mode == mode).swap_remove(place)
}

fn plots() -> Vec<Plot> {
    let against = |title: &str, knob_label: &str, setups: Vec<String>| Plot::Convergence {
        title: title.into(),
        quantity: ERROR.into(),
        setups,
        statistics: vec!["worst".into()],
        orders: Vec::new(),
        knob_is_resolution: false,
        knob_label: knob_label.into(),
    };
    let is_timed = |variant: &Variant| variant.repeats > 0;
    let is_few = |variant: &Variant| variant.mode == Mode::Cold && is_timed(variant);
    vec![
        against("Largest error of 250 pairs against their size", "size in m", Variant::labels(is_few)),
        against(
            "Largest error against size: other ways",
            "size in m",
            Variant::labels(|variant| matches!(variant.mode, Mode::Warm | Mode::SearchAlone | Mode::Parry)),
        ),
        against("What a crust changes", "crust over inner radius", Variant::labels(|variant| matches!(variant.mode, Mode::Crust(_)))),
        against("Touching pairs", "size in m", Variant::labels(|variant| matches!(variant.mode, Mode::Touch(_)))),
        Plot::ErrorAgainstCost {
            title: "Largest error against the cost of a question".into(),
            quantity: ERROR.into(),
            setups: Variant::labels(is_timed),
            statistic: "worst".into(),
            targets: vec![1e-6, 1e-10],
        },
    ]
}

fn equations() -> Vec<Equation> {
    let equation = |latex: &str, meaning: &str| Equation { latex: latex.into(), meaning: meaning.into() };
    vec![
        equation(
            r"\max_{|n|=1}\;\bigl(-h_A(n) - h_B(-n)\bigr) \;=\; d \;=\; \min_{a\in A,\,b\in B} |b-a|",
            "Distance as the widest gap between supporting planes, and as the nearest two points: any direction and any two points bound it.",
        ),
        equation(
            r"t_1\cdot d = t_2\cdot d = 0,\qquad d = b - a",
            "At the nearest points of two rims, d is at right angles to both tangents.",
        ),
        equation(r"\delta = r_A + r_B - d(\mathrm{core}_A, \mathrm{core}_B)", "Overlap of two cores with crusts (R section 2.5)."),
    ]
}

fn picture() -> Picture {
    let arrow = |from: [f64; 2], to: [f64; 2], label: &str| PictureItem::Arrow { from, to, label: label.into() };
    Picture {
        caption: "Two bodies, their nearest points, and the supporting planes across the line between them: planes bound the distance from below, points from above.".into(),
        items: vec![
            PictureItem::Disc { center: [-1.8, 0.0], radius: 1.2, ghost: false },
            PictureItem::Disc { center: [1.8, 0.0], radius: 1.2, ghost: false },
            PictureItem::Dashed { from: [-0.6, -1.6], to: [-0.6, 1.6] },
            PictureItem::Dashed { from: [0.6, -1.6], to: [0.6, 1.6] },
            arrow([-0.6, 0.0], [0.6, 0.0], "d"),
        ],
    }
}
