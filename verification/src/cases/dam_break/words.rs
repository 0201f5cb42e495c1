//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::figures::{FRONT_COLUMNS, PROFILE_COLUMNS, file};
use super::variants::{LOW, OF_R, Setting};
use super::{RUN_OUT, SPREAD, STIFFER};
use crate::case::Description;
use crate::variant::Variant;

pub(super) fn description() -> Description {
    Description {
        id: "dam_break",
        title: "Collapse of a granular column",
        question: "How far does a column of grains run, and how high does it stay, when the gate that holds it is taken away?",
        model: vec![
            "Grains of 3 mm stand as a jittered lattice behind a gate, fall, and settle into a random packing between a back wall, the gate and a smooth floor; across, the slice repeats. The gate has no friction; as soon as the column has settled (a root mean square speed below a fiftieth of the root of gravity times height for half of the root of height over gravity) it vanishes, or is lifted. Fewer than two grains in a hundred may then be faster than a twentieth of the root of gravity times height. The heap spreads along the floor and comes to rest. Its height over its length, the aspect ratio, is measured when the gate opens, from twice the mean height of the grains.",
            "The end of the heap is found as R does: a box of a diameter by a diameter by the width is moved along the floor until the solid fraction of the grains whose centres are inside it is at most a tenth. Grains that lie or roll scattered beyond do not count. Profiles are heights at the solid fraction of the column, so that they hold all of its volume. The height of the heap is that of its first quarter length at the back wall.",
            "The floor and the back wall are flat, with friction 0.5: R's choice. It matters: experiments run on rough floors or on flat ones, and a heap of spheres on a flat floor ends in spheres that roll away one by one, which nothing but rolling friction stops. The run ends when less than a tenth of the grains is faster than a tenth of the root of gravity times diameter, or at six times the root of height over gravity.",
            "Grains are softened: the stiffness is chosen so that a grain that has fallen over the height of the column is pressed in by 15 % of its diameter. What that does to the run-out is a setup of its own: each stiffness is held against four times as much, up to 64 times the softened one.",
        ],
        equations: vec![
            Equation {
                latex: r"\frac{L_\infty - L}{L} = \begin{cases} 1.2\,a & a < 2.3 \\ 1.9\,a^{2/3} & a > 2.3\end{cases}".into(),
                meaning: "Run-out of Lube et al. (2005): a band with others, never the truth.".into(),
            },
            Equation {
                latex: r"\frac{H_\infty}{L} = \begin{cases} a & a < 1.15 \\ 0.65\,a^{2/5} & a > 1.15\end{cases}".into(),
                meaning:
                    "Final height over length. R prints H∞/H ~ a for low columns (errata): it is H∞/L, for a low column keeps its height."
                        .into(),
            },
            Equation {
                latex: r"\phi(X) = \frac{1}{d^2 W}\sum_{i \in V_b(X)} \frac{\pi d^3}{6} \le 0.1".into(),
                meaning: "The end of the heap, R eq. 5.9.".into(),
            },
        ],
        parameters: [
            ("diameter", "3 mm", "of the ball of equal volume; spheres, and icosahedra as R"),
            ("density", "2500 kg/m³", "R prints none; his duration of a contact, 41.9 µs, gives it"),
            ("restitution", "0.75 and 0.816 at walls", "R prints 0.75 at walls; his damping there gives 0.816 (errata)"),
            ("friction", "0.5 of grains, floor and back wall; none at the gate", "spring with memory; R's viscous law is a setup"),
            ("stiffness", "15 % of a diameter at the speed of the fall", "R: 10⁵ N/m; paper tier"),
            ("step", "a fifteenth of a contact", "S eq. 3.52"),
            ("length", "5, 8.3 (R's size 1: 25 mm), 13 and 16.7 diameters", ""),
            ("width", "10 to 20 diameters, periodic", "5 to 20 in a setup of its own; R: 167"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Power laws of Lube et al. and of Staron and Hinch as a band; grains four times as stiff; a column of half the size; conservation of volume.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: Setting::Long.label(),
            quantity: RUN_OUT.into(),
            statistic: "single run".into(),
            knob: LOW,
            order_quantity: None,
        },
        sources: vec![
            "R (Rakotonirina 2016), section 5.4.2, eq. 5.9, table 5.4, figures 5.13 to 5.18",
            "G. Lube, H. E. Huppert, R. S. J. Sparks and A. Freundt, Phys. Rev. E 72 (2005) 041301",
            "E. Lajeunesse, J. B. Monnier and G. M. Homsy, Phys. Fluids 17 (2005) 103302",
            "N. J. Balmforth and R. R. Kerswell, J. Fluid Mech. 538 (2005) 399",
            "L. Staron and E. J. Hinch, J. Fluid Mech. 545 (2005) 1",
        ],
        answers: vec![
            "One run of a granular flow is no measurement: every number is a mean over random fillings with its 95 % interval as floor.",
            "How much softer grains may be than real ones, for this flow.",
        ],
        remarks: vec![
            "R finds 10.5 lengths at a = 7.3, Lube's law 7.15, Balmforth and Kerswell's experiments 7 to 13: laws differ by more than any numerical error here, so they are bands.",
            "Spheres have rolling friction of 0.1 (largest torque over force and rolling radius) in all setups but that of rolling friction: without it a heap of spheres on a flat floor has no end. Icosahedra have none.",
            "A filling lattice with little room between its sites keeps its rows and storeys: stiff spheres then stand at the solid fraction of a cubic lattice. Sites are therefore 1.25 diameters apart.",
            "Grains a quarter as stiff as the softened ones are too soft: they ring on, six in a hundred still move when the gate does not wait any longer, and the column is denser than any that has come to rest. The claim on the grains that move is there for that.",
            "Setups whose numbers are missing on this page belong to the standard tier: `touchstone run dam_break --tier standard`.",
            "R's sizes 1 to 5 have 98,000 to 2,450,000 icosahedra, 167 diameters wide, at 10⁵ N/m. They are setups of the paper tier and were not run here: about 4·10⁵ steps and 20 hours for size 1 on one core, some 56 times as much for size 5. The standard tier has a slice of size 1, 20 diameters wide and softened, and shows what the width does.",
        ],
        knob: Setting::knob(),
        setups: Setting::setups(),
        sample: "filling",
        budget_cpu_s: [5.0, 2400.0, 1e7],
    }
}

fn plots() -> Vec<Plot> {
    let against_knob = |title: &str, settings: &[Setting], orders: &[f64], label: &str| Plot::Convergence {
        title: title.into(),
        quantity: SPREAD.into(),
        setups: settings.iter().map(Variant::label).collect(),
        statistics: vec!["median".into(), "single run".into()],
        orders: orders.to_vec(),
        knob_is_resolution: true,
        knob_label: label.into(),
    };
    let curves = |title: &str, file: String, [x_label, y_label]: [&str; 2], columns: Vec<[String; 2]>, caption: &str| Plot::Curves {
        title: title.into(),
        file: format!("dam_break/{file}"),
        x_label: x_label.into(),
        y_label: y_label.into(),
        columns,
        log_x: false,
        log_y: false,
        caption: caption.into(),
    };
    let named = |names: &[&str]| names.iter().map(|name| [(*name).to_string(), name.replace('_', " ")]).collect::<Vec<_>>();
    let front = |setting, knob, title: &str, caption: &str| {
        let axes = ["time since the gate opened / √(H/g)", "run-out over length, height over length"];
        curves(title, file("front", setting, knob), axes, named(&FRONT_COLUMNS[1..]), caption)
    };
    let profiles = |setting, knob, title: &str| {
        let axes = ["distance from the back wall / length", "height / length"];
        curves(
            title,
            file("profiles", setting, knob),
            axes,
            named(&PROFILE_COLUMNS[1..]),
            "Times are over √(H/g). Volume is conserved: the area under each curve is the same.",
        )
    };
    vec![
        front(
            Setting::Long,
            LOW,
            "Front of a low column",
            "Mean and range over three fillings: it begins to move as the column falls, runs at constant speed, and stops.",
        ),
        profiles(Setting::Long, LOW, "Heap of a low column"),
        against_knob(
            "Run-out against aspect ratio",
            &[Setting::Sweep, Setting::Icosahedra, Setting::SliceOfR, Setting::Lube, Setting::StaronHinch],
            &[-1.0, -2.0 / 3.0],
            "aspect ratio a",
        ),
        front(
            Setting::Sweep,
            OF_R,
            "Front of R's aspect ratio, spheres",
            "Free fall first, then constant speed, then rest; Lube: rest after 3.3.",
        ),
        profiles(Setting::Sweep, OF_R, "Heap of R's aspect ratio, spheres"),
        front(Setting::SliceOfR, OF_R, "Front of R's size 1, icosahedra", "One filling of a slice."),
        profiles(Setting::SliceOfR, OF_R, "Heap of R's size 1, icosahedra"),
        curves(
            "Scaled profiles of two sizes",
            file("scaled", Setting::Size, 50.0 / 3.0),
            ["distance from the back wall / length", "height / length"],
            named(&["whole", "half"]),
            "Columns of 16.7 and 8.3 diameters: R's collapse on a master profile.",
        ),
        against_knob("Run-out against friction", &[Setting::GrainFriction, Setting::WallFriction, Setting::Rolling], &[], "friction"),
        against_knob("Run-out against the width of the slice", &[Setting::Width], &[], "width / diameter"),
        against_knob("Run-out against the speed of the gate", &[Setting::LiftedGate], &[], "speed / √(gH)"),
        Plot::ErrorAgainstCost {
            title: "Run-out of softened grains against run time".into(),
            quantity: STIFFER.into(),
            setups: vec![Setting::Stiffness.label()],
            statistic: "single run".into(),
            targets: vec![0.1, 0.03, 0.01],
        },
    ]
}

/// The column behind its gate, and the heap it becomes.
fn picture() -> Picture {
    let polygon = |points: &[[f64; 2]], ghost| PictureItem::Polygon { points: points.to_vec(), ghost };
    let label = |x: f64, y: f64, text: &str| PictureItem::Label { at: [x, y], text: text.into() };
    Picture {
        caption: "The column before the gate opens, and the heap at rest.".into(),
        items: vec![
            PictureItem::Wall { from: [0.0, 2.3], to: [0.0, 0.0], solid_side: [-1.0, 0.0] },
            PictureItem::Wall { from: [0.0, 0.0], to: [5.0, 0.0], solid_side: [0.0, -1.0] },
            polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]], true),
            polygon(&[[0.0, 0.0], [4.3, 0.0], [3.0, 0.2], [1.5, 0.55], [0.6, 0.85], [0.0, 0.95]], false),
            PictureItem::Dashed { from: [1.0, 0.0], to: [1.0, 2.3] },
            PictureItem::Arrow { from: [1.15, 1.6], to: [1.15, 2.3], label: "gate".into() },
            label(0.5, 2.15, "L"),
            label(-0.25, 1.0, "H"),
            label(4.3, 0.3, "L∞"),
        ],
    }
}
