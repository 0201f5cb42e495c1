//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::flows::{Found, Regime};
use super::{DROP, INERTIA, SEEN, TORTUOSITY, Variant, bed};
use crate::case::{Curve, Description};
use crate::claim::Statistic;
use crate::variant::Variant as _;

/// Words of file names.
fn word(regime: Regime) -> &'static str {
    if regime == Regime::Creeping { "creeping" } else { "inertia" }
}

/// Layers, and slices of speed and pressure, as tables beside the rows.
pub(super) fn curves(regime: Regime, found: &Found) -> Vec<Curve> {
    let file = |kind: &str| format!("{kind}_{}.csv", word(regime));
    let slice = |kind: &str, value: usize| Curve {
        file: file(kind),
        columns: vec!["time", "across", "height", "speed"],
        rows: found.slice.iter().map(|seen| vec![0.0, seen[0], seen[1], seen[value]]).collect(),
    };
    let layers = found.layers.iter().map(|layer| layer.to_vec()).collect();
    let columns = vec!["place", "void_fraction", "pressure"];
    vec![Curve { file: file("layers"), columns, rows: layers }, slice("speed", 2), slice("pressure", 3)]
}

pub(super) fn description() -> Description {
    Description {
        id: "small_packed_bed",
        title: "Flow through a small packed bed of trilobes",
        question: "What pressure drop do forty settled trilobes make, creeping and at a Reynolds number of 16, and how many cells a diameter does it need?",
        model: vec![
            "Forty trilobes, twice as long as wide, fall one storey after the other on a floor five diameters wide whose sides repeat, and come to rest under gravity with friction: composites of three cylinders and a prism, by our own discrete elements. Their places are kept in reference-data/trilobe_packing with the scene that made them; a test lets them go on from there and finds them at rest.",
            "The fluid goes up through the bed, which is held; the floor is gone. Creeping flow (R: Reynolds number 0.01, where inertia counts for less than a thousandth) is solved at once in a box that repeats in all directions, driven by a mean pressure gradient. No fringe is needed: what the bed makes uneven dies out as exp(-2 pi x / 5) with the diameters x, so the next bed, six diameters on, sees a uniform stream as that of R's inlet. With inertia jets go on for longer than that: a fringe of two diameters behind R's ten pulls the stream back to uniform, and Picard's iteration, accelerated by Anderson's mixture of all flows so far, goes from the creeping flow to the steady one without time.",
            "Bodies in contact leave gaps below a cell. There the parabola that continues the velocity to a value inside a body falls back to a straight line, and where that finds no fluid either, the value itself is held; the counts stand in the work of every row.",
        ],
        equations: vec![
            Equation {
                latex: r"\langle\varepsilon\rangle_x = \frac{\sum_i \delta_i v_i}{\sum_i v_i},\qquad \langle p\rangle_x = \frac{\sum_i \delta_i p_i v_i}{\sum_i \delta_i v_i}".into(),
                meaning: "Void fraction and pressure of a layer of cells; delta is the fluid's share of a cell. R eq. 7.29 to 7.31 print the share of the solid, and a sum of pressures over one of volumes (errata).".into(),
            },
            Equation {
                latex: r"T = \langle |v| \rangle / \langle v_x \rangle".into(),
                meaning: "Tortuosity, over the fluid between the cuts (R eq. 7.32).".into(),
            },
            Equation {
                latex: r"\frac{\Delta p}{H} = \alpha\,\frac{\mu(1-\varepsilon)^2U}{\varepsilon^3d_p^2} + \beta\,\frac{\rho(1-\varepsilon)U^2}{\varepsilon^3d_p},\qquad d_p = \frac{6V}{A}".into(),
                meaning: "Ergun's form (R eq. 7.23 and 7.24), by which alpha and beta are found between the cuts.".into(),
            },
        ],
        parameters: [
            ("trilobes", "40, length 2 diameters, lobes that just touch", "R's lobes overlap a little; by how much is not told"),
            ("box", "10 x 5 x 5 diameters, bed from 3 on", "with inertia 2 more for the fringe"),
            ("bodies in the flow", "smaller by 0.05 %", "so that bodies that were pressed together do not overlap"),
            ("packing", "friction 0.55, restitution 0.7, stiffness 1e4 N/m", "R table 4.1, ten times softer; diameter 1.6 mm"),
            ("cuts", "a fifth of the height of the bed inside either end", "height: twice that of the middle of the solids"),
            ("steady", "change of the velocity below 0.04 in an iteration", "the drag then stays to 2e-3"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Own grids, extrapolated, with the interval that the extrapolation leaves. Constants of Ergun's form: the band of all authors, which is no truth. Momentum and volumes: exact.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: Variant::Flow(Regime::Creeping).label(),
            quantity: DROP.into(),
            statistic: Statistic::Single.name().into(),
            knob: 8.0,
            order_quantity: None,
        },
        sources: vec![
            "R (Rakotonirina 2016), sections 7.4.3 and 7.5, tables 7.2 and 7.3",
            "S. Ergun, Chemical Engineering Progress 48 (1952) 89; D. Nemec and J. Levec, Chemical Engineering Science 60 (2005) 6947",
        ],
        answers: vec![
            "Requirement: packed bed of trilobes, its pressure drop and convergence, void fraction and pressure by layers, tortuosity.",
            "How many cells a diameter does the pressure drop of a bed of lobed bodies need?",
        ],
        remarks: remarks(),
        knob: Variant::knob(),
        setups: Variant::setups(),
        sample: "run",
        budget_cpu_s: [5.0, 1200.0, 1200.0],
    }
}

fn remarks() -> Vec<&'static str> {
    vec![
        "The error falls with an order of about 1.3, as R finds for single bodies, but from far higher: a fifth at 8 cells a diameter, 8 % at 16. R reports 2 % at 16 collocation points a diameter, which are 24 cells. What is left comes from the gaps: at 8 cells a diameter 40 % of all conditions are parabolas, 37 % straight lines, and 23 % are asked of values inside the bodies, which makes bodies thinner by a part of a cell just where the fluid is held most.",
        "A straight line along the grid to the fluid value beside, in place of holding the value itself, would know where the surface is; tried on 8 cells a diameter, the iteration had not ended after fifteen times as long.",
        "The viscous constant comes out at about 127 on no grid, below all authors' beds (150 to 295; R's ten beds 209) and above straight capillaries (72), which is why the band reaches down to these. The bed has a void fraction of 0.50 between the cuts, where R's have 0.40; it is four bodies high, and the grooves between lobes that just touch count in the surface by which the diameter is formed, though hardly any fluid goes through them.",
        "R prints a solid fraction of 0.55 for its bed; by twice the height of the middle of all bodies this one has 0.47. R's lobes overlap and fill 69 to 71 % of their circle, these 65.7 %.",
        "Flow with inertia is for the standard tier: at a Reynolds number of 16 the drop is 1.44, 1.38, 1.37 and 1.39 times that of creeping flow at 8, 10, 12 and 16 cells a diameter, for some 1200 flows each. Marched in time, with explicit advection that is up to twenty times faster in the narrowest pores than on the whole, the same grid of 8 cells had not come to rest after ten times the cost, and finer ones blew up. The constant of the inertial term comes out at half of the authors' beds, whose pores are narrower; its bound counts the spacing twice.",
        "The drag on all bodies and what the stream's momentum gains give the same pressure drop as the pressure field: to rounding in creeping flow, to what is not yet steady with inertia.",
    ]
}

fn plots() -> Vec<Plot> {
    let flows = vec![Variant::Flow(Regime::Creeping).label()];
    let single = || Statistic::Single.name().to_string();
    let against = |title: &str, quantity: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: flows.clone(),
        statistics: vec![single()],
        orders: vec![1.0, 2.0],
        knob_is_resolution: true,
        knob_label: "cells a diameter".into(),
    };
    let layers = |regime: Regime, column: &str, y_label: &str, title: String, caption: &str| Plot::Curves {
        title,
        file: format!("small_packed_bed/layers_{}.csv", word(regime)),
        x_label: "place along the flow (diameters)".into(),
        y_label: y_label.into(),
        columns: vec![[column.into(), y_label.into()]],
        log_x: false,
        log_y: false,
        caption: caption.into(),
    };
    let slices = |regime: Regime, kind: &str, title: String, caption: &str| Plot::Slices {
        title,
        file: format!("small_packed_bed/{kind}_{}.csv", word(regime)),
        radius: 0.5 / SEEN,
        caption: caption.into(),
    };
    let pressure = "pressure (viscosity x velocity / diameter)";
    vec![
        against("Pressure drop against that on no grid", DROP),
        Plot::ErrorAgainstCost {
            title: "Pressure drop against run time".into(),
            quantity: DROP.into(),
            setups: flows.clone(),
            statistic: single(),
            targets: vec![0.1, 0.03, 0.01],
        },
        against("Tortuosity between the cuts", TORTUOSITY),
        layers(
            Regime::Creeping,
            "void_fraction",
            "void fraction",
            "Void fraction by layers".into(),
            "From the floor, where all bodies stand or lie, to the rough top.",
        ),
        layers(
            Regime::Creeping,
            "pressure",
            pressure,
            "Pressure by layers, creeping".into(),
            "Flat before and behind the bed, steepest where it is densest.",
        ),
        layers(
            INERTIA,
            "pressure",
            pressure,
            "Pressure by layers, Reynolds number 16".into(),
            "In the same unit; the last two diameters are the fringe.",
        ),
        slices(
            Regime::Creeping,
            "speed",
            format!("Speed, creeping, {SEEN} cells a diameter"),
            "One dot a cell of the plane through the middle of the box, darker where the fluid is faster; flow from left to right, bodies are left white.",
        ),
        slices(
            Regime::Creeping,
            "pressure",
            format!("Pressure, creeping, {SEEN} cells a diameter"),
            "Darker where the pressure is higher.",
        ),
        slices(
            INERTIA,
            "speed",
            format!("Speed, Reynolds number 16, {SEEN} cells a diameter"),
            "Jets leave the bed and end in the fringe on the right.",
        ),
    ]
}

/// The box from the side: the outlines of the bodies that the middle plane cuts would say little, so each body is the disc of its volume at its place.
fn picture() -> Picture {
    let radius = 0.62;
    let place = |pose: &bed::Pose| pose.position.map(|along| along / bed::DIAMETER);
    let disc = |pose: &bed::Pose| {
        let [across, depth, up] = place(pose);
        PictureItem::Disc { center: [up + bed::BEFORE, across], radius, ghost: depth > 0.5 * bed::WIDTH }
    };
    let mut items: Vec<PictureItem> = bed::settled().iter().map(disc).collect();
    let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, bed::WIDTH], [0.0, bed::WIDTH]];
    items.extend((0..4).map(|side| PictureItem::Dashed { from: corners[side], to: corners[(side + 1) % 4] }));
    items.push(PictureItem::Polygon { points: vec![[10.0, 0.0], [12.0, 0.0], [12.0, bed::WIDTH], [10.0, bed::WIDTH]], ghost: true });
    items.push(PictureItem::Label { at: [11.0, 2.5], text: "fringe".into() });
    items.push(PictureItem::Arrow { from: [0.6, 2.5], to: [2.0, 2.5], label: "U".into() });
    Picture {
        caption: "Forty bodies at their places in the box, each as the ball of its volume, the farther ones fainter; the fringe is there with inertia only.".into(),
        items,
    }
}
