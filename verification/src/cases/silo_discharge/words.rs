//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::setting::{DIAMETER, HEIGHT, OUTLET, WIDTH, hopper_height};
use super::{Flows, LEFT_CURVE, RATE, RATIO, SLICE_CURVE, SMALL_HOLE, TIME};
use crate::case::Description;
use crate::variant::Variant;

pub(super) fn description() -> Description {
    Description {
        id: "silo_discharge",
        title: "Discharge of a silo",
        question: "How fast do grains flow out of vessels and of a silo of 14,000 beads, and how soft may they be?",
        model: vec![
            "Glass beads are put in rows, shifted at random, fall and come to rest over a shut outlet; then it is open. The small vessels are cylinders with a round hole in a flat bottom; their flow is steady while the filling is deeper than the hole is wide, and is measured there. The large one is the silo of González-Montellano et al. and of R section 5.4.1, discharged until it is empty. Beads that are well through the outlet leave the simulation.",
            "Contacts are linear springs with dashpots, friction has springs with memory. R's stiffness is softer than that of glass already, for the sake of the step; here it is divided further, by the softening, and the step grows by its root, so that a contact always has fifteen of R's steps.",
            "A filling is made once for each stiffness and random seed and shared by all that start from it.",
        ],
        equations: vec![Equation {
            latex: r"W = C\,\rho_b\sqrt{g}\,(D - k\,d)^{5/2}".into(),
            meaning: "Beverloo's law of the mass flow through a hole of diameter D; bulk density as measured in the filling.".into(),
        }],
        parameters: [
            ("bead", "13.8 mm, 2516 kg/m³", "14,000 of them weigh 48.5 kg"),
            ("stiffness of R", "7.2·10⁵ N/m, at walls 10⁶ N/m", "divided by the softening"),
            ("restitution", "0.75, at walls 0.62", "printed wall damping gives 0.715 (errata)"),
            ("friction", "0.3", "springs: 2/7 of the stiffness, a tenth of critical damping"),
            ("step", "10⁻⁵ s", "times the root of the softening"),
            ("silo of R", "0.25 m square, 0.5 m high", "hopper of 62.5°, outlet 57 mm square"),
            ("small vessel", "hole of 6 diameters, vessel of 14", "2000 beads; all lengths grow with the hole"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Discharge time: three experiments, 29.20 to 29.32 s, and one run of Grains3D, 29.36 s (R table 5.2). Flow through holes: Beverloo's law with two sets of constants, which differ by 8 to 15 %. Sizes and stiffnesses: own flows of 2000 and of the stiffest beads.",
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: Flows::Sample.label(),
            quantity: RATE.into(),
            statistic: "single run".into(),
            knob: SMALL_HOLE,
            order_quantity: None,
        },
        sources: vec![
            "R (Rakotonirina 2016), section 5.4.1, tables 5.1 and 5.2, figures 5.5 to 5.7",
            "C. González-Montellano et al., Chem. Eng. Sci. 66 (2011) 5116",
            "W. A. Beverloo, H. A. Leniger and J. van de Velde, Chem. Eng. Sci. 15 (1961) 260",
        ],
        answers: vec![
            "How soft may beads be made to save steps? R says that softer is fine; here the flow is measured against the stiffness.",
            "Errata of R: the damping rate printed for walls gives a restitution of 0.715, not 0.62; what that does to the discharge is a setup.",
        ],
        remarks: vec![
            "R gives no stiffness and no damping rate of friction; springs of 2/7 of the normal stiffness are ours, and R's own friction takes the normal damping rate.",
            "The full silo is run with one random filling at each setting: the experiments differ by 0.4 %.",
            "R holds that softer beads change little. Here the silo empties after 26.86, 28.55 and 29.10 s at softenings of 400, 100 and 25, and after 29.90 s at R's own stiffness (one filling, 66 minutes of CPU), for 29.27 s measured and 29.36 s of R. Against the stiff beads that is 10.2, 4.5 and 2.7 % too soon, about the root of the softening; that 25 comes nearest to the experiment is two errors that cancel.",
            "Outlets drop what leaves 1.5 diameters below the hole: beads further down cannot be touched by those above, and would only shorten the time between two lists of neighbours.",
        ],
        knob: Flows::knob(),
        setups: Flows::setups(),
        sample: "filling",
        budget_cpu_s: [5.0, 2400.0, 40_000.0],
    }
}

fn plots() -> Vec<Plot> {
    let convergence = |title: &str, quantity: &str, setups: Vec<String>, label: &str| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups,
        statistics: vec!["median".into(), "worst".into(), "single run".into()],
        orders: Vec::new(),
        knob_is_resolution: false,
        knob_label: label.into(),
    };
    let slices = |title: &str, name: &str, caption: &str| Plot::Slices {
        title: title.into(),
        file: format!("silo_discharge/{name}_{SLICE_CURVE}"),
        radius: 0.5 * DIAMETER,
        caption: caption.into(),
    };
    let silos = Flows::labels(|flows| matches!(flows, Flows::Silo(_)));
    vec![
        convergence(
            "Flow through holes against Beverloo's law",
            RATE,
            vec![Flows::Sample.label(), Flows::Hole.label(), Flows::Holes.label()],
            "diameter of the hole / diameter of a bead",
        ),
        convergence("Flow of softened beads against that of the stiffest", RATIO, vec![Flows::Stiffness.label()], "softening"),
        convergence("Flow of more beads against that of 2000", RATIO, vec![Flows::Sizes.label()], "beads"),
        convergence("Discharge time against the experiments", TIME, silos.clone(), "softening"),
        Plot::ErrorAgainstCost {
            title: "Discharge time against run time".into(),
            quantity: TIME.into(),
            setups: silos,
            statistic: "single run".into(),
            targets: vec![0.1, 0.01, 0.001],
        },
        slices("The flow in the middle of a small vessel", "vessel", "Beads behind the middle plane, darker where they are faster."),
        slices(
            "The flow in the middle of the silo",
            "silo_softened_100",
            "The same in the silo of R (figures 5.6 and 5.7), beads softened by 100; made at the standard tier.",
        ),
        Plot::Curves {
            title: "Beads that have left the silo".into(),
            file: format!("silo_discharge/silo_softened_100_{LEFT_CURVE}"),
            x_label: "time / s".into(),
            y_label: "beads".into(),
            columns: vec![["beads_left".into(), "softened by 100".into()]],
            log_x: false,
            log_y: false,
            caption:
                "The slope is the mass flow: nearly constant until the surface has come down to the hopper. Made at the standard tier."
                    .into(),
        },
    ]
}

fn picture() -> Picture {
    let (half, outlet, hopper) = (500.0 * WIDTH, 500.0 * OUTLET, 1000.0 * hopper_height());
    let (top, filled) = (hopper + 1000.0 * HEIGHT, hopper + 860.0 * HEIGHT);
    let length = hopper.hypot(half - outlet);
    let across = [hopper / length, (half - outlet) / length];
    let wall = |from: [f64; 2], to: [f64; 2], solid_side: [f64; 2]| PictureItem::Wall { from, to, solid_side };
    let dimension = |from: [f64; 2], to: [f64; 2]| PictureItem::Dashed { from, to };
    let label = |at: [f64; 2], text: &str| PictureItem::Label { at, text: text.into() };
    Picture {
        caption: "The silo of R in section: a square shaft on a pyramid with a square outlet; dashed is the surface of the filling.".into(),
        items: vec![
            wall([-half, top], [-half, hopper], [-1.0, 0.0]),
            wall([-half, hopper], [-outlet, 0.0], [-across[0], -across[1]]),
            wall([outlet, 0.0], [half, hopper], [across[0], -across[1]]),
            wall([half, hopper], [half, top], [1.0, 0.0]),
            dimension([-half, filled], [half, filled]),
            label([0.0, hopper + 500.0 * HEIGHT], "14,000 beads"),
            PictureItem::Arrow { from: [0.0, 0.35 * hopper], to: [0.0, -0.3 * hopper], label: "57 mm".into() },
        ],
    }
}
