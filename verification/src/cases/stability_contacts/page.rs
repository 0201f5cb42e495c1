//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{EXIT, Extreme, FRAME, PINCHED, SCALED};
use crate::case::Description;
use crate::variant::Variant;

pub(super) fn description() -> Description {
    Description {
        id: "stability_contacts",
        title: "Contacts at the ends of their range",
        question: "Do contacts of spheres stay right at extreme stiffness, size, mass ratio, size ratio, depth and distance from the origin, and in any frame?",
        model: vec![
            "An oblique collision of two spinning spheres with friction and loss is made stiffer, softer, larger and smaller in such a way that nothing changes but the units; it is moved far from the origin, looked at from a moving and a turned frame, mirrored, and its bodies swap their ids. Scaled velocities and spins must stay as they are. An absolute tolerance anywhere in a code would show.",
            "Head-on, a sphere meets another of the same size that is up to 10⁹ times as heavy; two spheres spring apart from overlaps of up to a whole diameter; and a small grain is pinched by two spheres up to a hundred times as large, with half of the friction that would hold it: it must be expelled, and at the speed of a ten times finer step.",
        ],
        equations: vec![
            Equation {
                latex: r"\frac{m v^2}{k R^2} = \text{const}".into(),
                meaning: "What must be kept for collisions of different scales to be alike.".into(),
            },
            Equation {
                latex: r"v = \delta_0\sqrt{k / m_\mathrm{red}}".into(),
                meaning: "Speed at which two spheres at rest spring apart.".into(),
            },
            Equation {
                latex: r"\mu < \tan\theta = h / (R + w)".into(),
                meaning: "Friction below which a pinched grain is expelled; here half of it.".into(),
            },
        ],
        parameters: [
            ("radius, density, stiffness", "5 mm, 2500 kg/m³, 10⁴ N/m", "before scaling"),
            ("speed, restitution, friction", "1 m/s, 0.8, 0.3", "tangential stiffness 2/7"),
            ("steps per contact", "50; 200 where a closed form is held", ""),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Invariance, conservation laws and the energy of a spring; the pinched grain against a ten times finer step.",
        picture: picture(),
        plots: vec![
            plot("Stiffness", SCALED, Extreme::Stiffness, "factor of the stiffness"),
            plot("Size", SCALED, Extreme::Size, "factor of lengths"),
            plot("Mass ratio", EXIT, Extreme::MassRatio, "mass of the second over the first"),
            plot("Deep overlap", EXIT, Extreme::Depth, "overlap over diameter"),
            plot("Far from the origin", FRAME, Extreme::FarOrigin, "distance over diameter"),
            plot("Frames: moving, turned, mirrored, swapped", FRAME, Extreme::Frames, "number of the frame"),
            plot("Pinched grain", PINCHED, Extreme::Pinch, "radius of the spheres over that of the grain"),
        ],
        headline: Headline {
            setup: Extreme::Stiffness.label(),
            quantity: SCALED.into(),
            statistic: "single run".into(),
            knob: 1e7,
            order_quantity: None,
        },
        sources: vec!["Vyas and others, Comput. Phys. Commun. 310 (2025): small grains that plain Verlet traps between large ones"],
        answers: vec![
            "Stability tests S02, S04, S05, S12, S21, S22 and S23.",
            "Half a step of lag in the history of friction traps small grains in other codes; here velocities between two places are their exact difference.",
        ],
        remarks: vec![
            "Far from the origin the error is that of the places themselves, which carry fewer digits there; it grows with the distance and is bounded by it.",
        ],
        knob: Extreme::knob(),
        setups: Extreme::setups(),
        sample: "run",
        budget_cpu_s: [5.0, 5.0, 5.0],
    }
}

fn plot(title: &str, quantity: &str, extreme: Extreme, label: &str) -> Plot {
    Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: vec![extreme.label()],
        statistics: vec!["single run".into()],
        orders: Vec::new(),
        knob_is_resolution: true,
        knob_label: label.into(),
    }
}

fn picture() -> Picture {
    let disc = |x: f64, y: f64, radius: f64| PictureItem::Disc { center: [x, y], radius, ghost: false };
    let arrow = |from: [f64; 2], to: [f64; 2]| PictureItem::Arrow { from, to, label: String::new() };
    Picture {
        caption: "A grain pinched by two larger spheres is expelled.".into(),
        items: vec![
            disc(-3.15, 0.0, 3.0),
            disc(3.15, 0.0, 3.0),
            disc(0.0, 1.0, 0.3),
            arrow([-3.15, 0.0], [-1.5, 0.0]),
            arrow([3.15, 0.0], [1.5, 0.0]),
            arrow([0.0, 1.0], [0.0, 2.4]),
        ],
    }
}
