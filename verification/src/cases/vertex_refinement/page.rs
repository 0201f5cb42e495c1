//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{DISTANCE, MISSED, Method, NORMAL, OVERLAP, PLACE, Variant};
use crate::case::Description;
use crate::variant::Variant as _;

pub(super) fn description() -> Description {
    let by_vertices = Variant::labels(|variant| matches!(variant.method, Method::Vertices(..)));
    let timed = Variant::labels(|variant| variant.method == Method::Timed);
    Description {
        id: "vertex_refinement",
        title: "Vertices against smooth surfaces",
        question: "How well do 400, 900 or 1600 vertices tell the contact of two superellipsoids, how well do the smooth surfaces, and what does either cost?",
        model: vec![
            "S describes a superellipsoid by vertices: those that lie inside the other body give the contact point by their mean, the normal by the mean of their gradients, the overlap by their reach along it. Here the same pairs are asked by vertices and at the common normal of both surfaces.",
            "Smooth surfaces: both points and both normals are found by Newton's method on a chart that is smooth for flat and for pointed shapes alike, and are held against a slow twin that bisects the gap between supporting planes and, of an overlap, compares all directions. Pairs with a gap, almost touching, and overlapping; cold, and warm from a step before.",
            "Vertices: the overlap is one part in a hundred of the size, and the common normal is the reference.",
        ],
        equations: vec![
            Equation {
                latex: r"x_c = \tfrac12\Bigl(\tfrac1K\sum_{k} x_{1,k} + \tfrac1M\sum_{m} x_{2,m}\Bigr),\qquad n \propto \tfrac1K\sum_k \hat n_{1,k} - \tfrac1M\sum_m \hat n_{2,m}".into(),
                meaning: "Contact point and normal from flagged vertices (S eq. 2.24, which leaves out the half, and 2.29-2.32).".into(),
            },
            Equation {
                latex: r"n_1(p_1) = -n_2(p_2),\qquad (p_2 - p_1) \times n_1 = 0".into(),
                meaning: "Common normal: four equations for two parameters on each surface.".into(),
            },
        ],
        parameters: [
            ("random pairs", "aspect 1 to 10 evenly in its logarithm, exponents 0.1 to 1.9, all turned at random", ""),
            ("cylinders (0.1, 1)", "exponents 0.1 and 1 of S section 4.1.1, semi-axes 1 : 1 : 0.6625", "round about z, nearly flat at both ends"),
            ("balls, ellipsoids", "both exponents 1", ""),
            ("overlap for vertices and for times", "1 % of both bounding radii together", ""),
            ("step between warm questions", "2·10⁻⁴ of the size", "what a body moves in a step of a soft contact"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Smooth surfaces: bisection of the gap between supporting planes with a support function of its own, to the last bits; of overlaps the best of 1000 directions first. Vertices: the common normal.",
        picture: picture(),
        plots: plots(by_vertices, timed),
        headline: Headline {
            setup: Variant::labels(|_| true).swap_remove(3),
            quantity: DISTANCE.into(),
            statistic: "worst".into(),
            knob: 1e-3,
            order_quantity: None,
        },
        sources: vec![
            "S (Srinivasan 2019), sections 2.4 and 2.5, tables 4-6 and 4-7",
            "Barr, Superquadrics and angle-preserving transformations (1981)",
            "Houlsby, Potential particles (2009), and Johnson, Williams and Cook (2004), for the common normal",
        ],
        answers: vec!["How many vertices are enough? For the overlap a thousand; the normal of a contact aside of the equator does not get better with any number."],
        remarks: vec![
            "S gives 13.1 microseconds for a collision instance of 400 vertices. That is 7645 s of wall time over 72.98 million instances and over 8 processes; the core time of an instance is 8 times the quotient of the first two, 838 microseconds (spheres: 292), and each pair is counted twice. The cost of a run on this page is CPU time of one look at one pair; where bisection is the reference, bisection takes nearly all of it: what smooth surfaces cost is told by the setups that are called timed.",
            "An overlap is as deep as the least translation that parts both bodies: a function of the poses alone. Corners that are sharper than their overlap have several common normals; the twin seeks the best of all directions, and the solver must find the same, cold and warm. Pairs that Newton's method does not end are counted as left to the search, and are judged like all others.",
        ],
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "pair",
        budget_cpu_s: [5.0, 1200.0, 1200.0],
    }
}

fn plots(by_vertices: Vec<String>, timed: Vec<String>) -> Vec<Plot> {
    let against = |title: &str, quantity: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: by_vertices.clone(),
        statistics: vec!["median".into()],
        orders: vec![0.5, 1.0],
        knob_is_resolution: true,
        knob_label: "vertices of each body".into(),
    };
    vec![
        against("Error of the normal in radians", NORMAL),
        against("Error of the overlap", OVERLAP),
        against("Error of the contact point", PLACE),
        Plot::Convergence {
            title: "Contacts that are not seen at all".into(),
            quantity: MISSED.into(),
            setups: by_vertices.clone(),
            statistics: vec!["single run".into()],
            orders: Vec::new(),
            knob_is_resolution: true,
            knob_label: "vertices of each body".into(),
        },
        Plot::ErrorAgainstCost {
            title: "Error of the normal against the cost of a contact".into(),
            quantity: NORMAL.into(),
            setups: by_vertices.into_iter().chain(timed).collect(),
            statistic: "median".into(),
            targets: vec![1e-2, 1e-8],
        },
    ]
}

/// Two balls with vertices all round, those of each that lie inside the other drawn large.
fn picture() -> Picture {
    let (radius, half_distance) = (1.15_f64, 1.0);
    let vertices = |centre: f64| {
        (0..24).map(move |index| {
            let (sine, cosine) = (std::f64::consts::TAU * (f64::from(index) + 0.5) / 24.0).sin_cos();
            [centre + radius * cosine, radius * sine]
        })
    };
    let is_inside = |[x, y]: [f64; 2], centre: f64| (x - centre).hypot(y) < radius;
    let dots = |centre: f64| {
        vertices(centre).map(move |center| {
            let radius = if is_inside(center, -centre) { 0.05 } else { 0.02 };
            PictureItem::Disc { center, radius, ghost: false }
        })
    };
    let mut items = vec![
        PictureItem::Disc { center: [-half_distance, 0.0], radius, ghost: false },
        PictureItem::Disc { center: [half_distance, 0.0], radius, ghost: true },
    ];
    items.extend(dots(-half_distance).chain(dots(half_distance)));
    items.push(PictureItem::Arrow { from: [half_distance - radius, 0.0], to: [radius - half_distance, 0.0], label: "n".into() });
    Picture {
        caption: "Two bodies that overlap and their vertices: large dots lie inside the other body. The arrow is the common normal between the two deepest points.".into(),
        items,
    }
}
