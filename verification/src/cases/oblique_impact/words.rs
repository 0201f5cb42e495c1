//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::figures::{CHUNG_OOI_CURVES, SLIP_CURVES};
use super::{REBOUND, SPIN, TANGENTIAL};
use crate::case::{Description, Knob, Setup, Tier, setups};

pub(super) fn description(labels: Vec<String>, knobs: fn(Tier, &Setup) -> Vec<f64>) -> Description {
    let with = |part: &str| labels.iter().filter(|label| label.starts_with(part)).cloned().collect::<Vec<_>>();
    let springs = with("spring");
    let elastic = with("Hertz");
    let compared = [
        "spring, 45 degrees: slips, sticks, slips",
        "spring, 45 degrees, lagged damping, sampled edges",
        "guessed spring, 45 degrees, for a spring",
    ]
    .map(String::from)
    .to_vec();
    Description {
        id: "oblique_impact",
        title: "Oblique impact of a sphere",
        question: "Does a sphere leave a wall, or another sphere, with the slip, the spin and the rebound that its friction law says, whether it sticks or slides?",
        model: vec![
            "A sphere of 5 mm radius meets a flat wall, or a sphere of 3 mm, at 1 m/s along the normal and at any speed across it, with and without spin. Friction 0.3; elastic, or restitution 0.9.",
            "Three pairs of laws: linear springs with memory along and across the normal; the same with the tangential stretch guessed as velocity times the duration of a contact, as source S codes it; and Hertz's spring with Tsuji's dashpot and Mindlin's tangential spring, from Young's modulus and Poisson's ratio.",
            "The errors are those against the exact motion of the very laws that are coded, with contact points in the middle of the overlap and normals that turn; each point is 200 impacts that begin at different phases of a step. The eight tests of Chung and Ooi (2011) are run on the elastic laws.",
        ],
        equations: equations(),
        parameters: parameters(),
        reference: "The ordinary differential equation of the impact, in polar form, by extrapolation of order 20 with steps that end at every stick, slip and turn; the fourth root of the overlap stands for time where the laws are singular. Held against the pieces of closed form of linear springs, Hertz's closed forms, rigid spheres and published numbers.",
        picture: picture(),
        plots: vec![
            convergence("Tangential velocity after, linear springs", TANGENTIAL, springs.clone()),
            convergence("Tangential velocity after, Hertz and Mindlin", TANGENTIAL, elastic),
            convergence("Tangential velocity after, stretch guessed from the velocity", TANGENTIAL, with("guessed")),
            Plot::ErrorAgainstCost {
                title: "Error of the tangential velocity against run time, truth: the spring with memory at 45 degrees".into(),
                quantity: TANGENTIAL.into(),
                setups: compared,
                statistic: "median".into(),
                targets: vec![0.1, 0.01, 0.001],
            },
            convergence("Spin after, linear springs", SPIN, springs.clone()),
            convergence("Rebound velocity, linear springs", REBOUND, springs),
            slip_plot(),
            chung_ooi_plot(),
        ],
        headline: Headline {
            setup: "spring, 45 degrees: slips, sticks, slips".into(),
            quantity: TANGENTIAL.into(),
            statistic: "median".into(),
            knob: 50.0,
            order_quantity: Some(format!("observed order of {TANGENTIAL}")),
        },
        sources: vec![
            "S (Srinivasan 2019), section 3.2, eq. 3.41-3.47, appendix A",
            "Y. C. Chung and J. Y. Ooi, Benchmark tests for verifying discrete element modelling codes at particle impact level, Granular Matter 13 (2011) 643",
            "N. Maw, J. R. Barber and J. N. Fawcett, The oblique impact of elastic spheres, Wear 38 (1976) 101",
            "O. R. Walton, Numerical simulation of inelastic, frictional particle-particle interactions (1993); S. F. Foerster et al., Physics of Fluids 6 (1994) 1108",
            "C. Thornton, S. J. Cummins and P. W. Cleary, An investigation of the comparative behaviour of alternative contact force models during inelastic collisions, Powder Technology 233 (2013) 30",
            "E. Antypov and J. A. Elliott, On an analytical solution for the damped Hertzian spring, EPL 94 (2011) 50004",
        ],
        answers: vec![
            "S eq. 3.43 says that guessing the stretch loses little accuracy: it loses the rebound along the wall altogether.",
            "S's future work names nonlinear contact: here it is, with its closed forms and published tests.",
            "Which steps does an oblique impact need? The error at any number of steps per contact is on the first plots.",
        ],
        remarks: vec![
            "The rebound on Hertz's law with a dashpot would be of order 5/4 if the dashpot were sampled: its force rises as the fourth root of time.",
            "The stretch of a step is made with the lever arms and the contact plane of its middle: with those of its end, as most codes take them, the error is of first order as soon as bodies spin or roll round each other (measured: 1.4e-5 against 1.1e-6 at 400 steps, two elastic spheres with spin).",
            "The guessed spring is a dashpot under a cap that jumps at the first touch: its own solution is approached at first order.",
            "Chung and Ooi's test 5 names steel without constants in the sources at hand: 208 GPa, 0.3, 7850 kg/m³ are taken; the motion is scale-free but for Poisson's ratio.",
        ],
        knob: Knob { name: |_| "steps_per_contact", values: knobs },
        setups: setups(labels),
        sample: "start phase",
        budget_cpu_s: [5.0, 60.0, 60.0],
    }
}

fn convergence(title: &str, quantity: &str, setups: Vec<String>) -> Plot {
    Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups,
        statistics: vec!["median".into(), "worst".into()],
        orders: vec![1.0, 2.0],
        knob_is_resolution: true,
        knob_label: "steps per contact".into(),
    }
}

fn slip_plot() -> Plot {
    let column = |name: &str, text: &str| [name.to_string(), text.to_string()];
    Plot::Curves {
        title: "Slip after over slip before".into(),
        file: format!("oblique_impact/{SLIP_CURVES}"),
        x_label: "slip before / approach velocity".into(),
        y_label: "slip after / approach velocity".into(),
        columns: vec![
            column("rigid", "rigid sphere, sticking reverses the slip"),
            column("spring_exact", "spring with memory, exact"),
            column("spring", "spring with memory, solver"),
            column("guessed", "stretch guessed (S eq. 3.43), solver"),
            column("hertz_exact", "Hertz and Mindlin, exact"),
            column("hertz", "Hertz and Mindlin, solver"),
        ],
        log_x: false,
        log_y: false,
        caption: "A spring with memory throws a sticking contact point back; the guessed spring only stops it. All laws meet where the contact slides.".into(),
    }
}

fn chung_ooi_plot() -> Plot {
    let column = |name: &str, text: &str| [name.to_string(), text.to_string()];
    Plot::Curves {
        title: "Chung and Ooi, test 4: aluminium oxide on a rigid plane".into(),
        file: format!("oblique_impact/{CHUNG_OOI_CURVES}"),
        x_label: "impact angle from the normal, degrees".into(),
        y_label: "tangential restitution of the centre".into(),
        columns: vec![
            column("rigid", "rigid sphere: slides, or rolls off"),
            column("exact", "exact motion on Hertz's and Mindlin's laws"),
            column("solver", "solver"),
        ],
        log_x: false,
        log_y: false,
        caption: "Above 32.5 degrees the sphere slides all along and follows the rigid closed form.".into(),
    }
}

fn equations() -> Vec<Equation> {
    let equation = |latex: &str, meaning: &str| Equation { latex: latex.into(), meaning: meaning.into() };
    vec![
        equation(
            r"\mathbf{F}_t = -k_t\,\boldsymbol\xi,\qquad \dot{\boldsymbol\xi} = \mathbf{v}_t,\qquad |\mathbf{F}_t|\le\mu F_n",
            "Tangential spring with memory (S eq. 3.41-3.42, 3.47).",
        ),
        equation(
            r"\mathbf{F}_t = -(k_t\tau_c+\eta_t)\,\mathbf{v}_t,\qquad \tau_c=\frac{\pi}{\sqrt{k_n(1-\gamma^2)/m}}",
            "The guess of S eq. 3.43-3.44, with the sign of the velocity put right.",
        ),
        equation(
            r"F_n=\tfrac43E^*\sqrt{R^*}\,\delta^{3/2}+\sqrt5\,\zeta\sqrt{mK}\;\delta^{1/4}\dot\delta,\qquad \zeta=\frac{-\ln e}{\sqrt{\pi^2+\ln^2e}}",
            "Hertz's spring with Tsuji's dashpot: the restitution in closed form, at every speed.",
        ),
        equation(
            r"dF_t=-8G^*\sqrt{R^*\delta}\;d\xi\;\;(\dot\delta\ge0),\qquad d(F_t/k_t)=-d\xi\;\;(\dot\delta<0)",
            "Mindlin's spring; under a falling overlap the force sinks with the stiffness, so that no cycle returns energy.",
        ),
    ]
}

fn parameters() -> Vec<Parameter> {
    [
        ("radii, density", "5 mm and 3 mm, 2500 kg/m³", ""),
        ("normal stiffness", "10⁵ N/m", "overlap 2.3 % of the radius"),
        ("tangential stiffness", "half of the normal one", "shorter period across the normal than along it"),
        ("elastic constants", "20 MPa, 0.4", "rubber on a rigid wall, or on rubber"),
        ("restitution, friction", "1 and 0.9, 0.3", ""),
        ("approach velocity", "1 m/s", "along (2, 3, 6)/7: no axis is special"),
    ]
    .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
    .to_vec()
}

fn picture() -> Picture {
    let arrow = |from: [f64; 2], to: [f64; 2], label: &str| PictureItem::Arrow { from, to, label: label.into() };
    Picture {
        caption: "A sphere on its way to a wall, at an angle from the normal, perhaps spinning; and on its way back.".into(),
        items: vec![
            PictureItem::Wall { from: [-6.0, 0.0], to: [6.0, 0.0], solid_side: [0.0, -1.0] },
            PictureItem::Dashed { from: [0.0, 0.0], to: [0.0, 5.0] },
            PictureItem::Disc { center: [-3.2, 4.0], radius: 1.0, ghost: false },
            arrow([-3.2, 4.0], [-1.6, 2.4], "v"),
            PictureItem::Disc { center: [3.0, 3.6], radius: 1.0, ghost: true },
            arrow([3.0, 3.6], [4.2, 5.2], "v after"),
        ],
    }
}
