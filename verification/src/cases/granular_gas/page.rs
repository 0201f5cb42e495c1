//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use super::{RATE, SHARE, Variety};
use crate::case::Description;
use crate::variant::Variant;

pub(super) fn description() -> Description {
    let cooling = Variety::labels(|variety| matches!(variety, Variety::Cooling { .. }));
    let mixtures = Variety::labels(|variety| matches!(variety, Variety::Mixture { .. }));
    Description {
        id: "granular_gas",
        title: "A granular gas",
        question: "Does a gas of grains cool by Haff's law at the rate of kinetic theory, and does an elastic mixture share its energy evenly?",
        model: vec![
            "Smooth spheres fly and collide in a periodic box of which they fill a twentieth; a contact lasts a hundredth of the time between two collisions of a sphere. With restitution below one the gas cools: as long as it stays even, energy over time is known, and so is its rate.",
            "Without loss, spheres of two sizes begin with all the energy in the light ones. What is left of the difference falls by a factor of e in about four collisions each; between the twentieth and the fortieth both sizes must have the same temperature, and speeds Maxwell's distribution.",
        ],
        equations: vec![
            Equation {
                latex: r"E(t) = \frac{E_0}{(1 + t/\tau)^2},\qquad \tau = \frac{6}{(1-e^2)\,\omega_0\,(1 + \frac{3}{16}a_2)}".into(),
                meaning: "Haff's law; a collision takes (1 - e²) T on average.".into(),
            },
            Equation {
                latex: r"\omega_0 = 4\sqrt\pi\,n d^2 \chi \sqrt{T_0/m},\qquad \chi = \frac{1 - \phi/2}{(1-\phi)^3}".into(),
                meaning: "Collisions of a sphere in a unit of time (Enskog), with the pair correlation of Carnahan and Starling.".into(),
            },
        ],
        parameters: [
            ("diameter, density", "1 mm, 2500 kg/m³", "heavy spheres of the mixture 1.5 times as wide"),
            ("volume fraction", "0.05", "periodic cube"),
            ("duration of a contact", "0.01 of the mean time between collisions", "at the start"),
            ("run", "half a cooling time, 2 for 8000 spheres; mixture 40 collisions a sphere", ""),
            ("random starts", "6 of 216 spheres, 3 of more", ""),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Kinetic theory of hard spheres; the floor is the scatter of as many collisions, and the duration of a contact.",
        picture: picture(),
        plots: vec![
            Plot::Curves {
                title: "Energy of a cooling gas".into(),
                file: format!("granular_gas/{}", Variety::all()[1].curve_file(10.0)),
                x_label: "time / cooling time".into(),
                y_label: "energy / energy at the start".into(),
                columns: vec![["energy".into(), cooling[1].clone()], ["haff".into(), "Haff's law".into()]],
                log_x: false,
                log_y: true,
                caption: String::new(),
            },
            plot("Rate of cooling", RATE, cooling.clone()),
            plot("Share of energy in the mixture", SHARE, mixtures),
        ],
        headline: Headline {
            setup: cooling[1].clone(),
            quantity: RATE.into(),
            statistic: "median".into(),
            knob: 10.0,
            order_quantity: None,
        },
        sources: vec![
            "P. K. Haff, J. Fluid Mech. 134 (1983) 401",
            "T. P. C. van Noije and M. H. Ernst, Granular Matter 1 (1998) 57: second Sonine coefficient",
            "N. F. Carnahan and K. E. Starling, J. Chem. Phys. 51 (1969) 635",
        ],
        answers: vec!["Haff's law with its rate, not a fitted one, and the scatter that so many collisions must have."],
        remarks: vec![
            "Spheres begin at random places without overlap and not in the order that collisions would make: in so thin a gas the difference is below the scatter.",
            "More steps per contact do not show: at 10 the loss of a collision is already nearer to the truth than the scatter of thousands of collisions.",
        ],
        knob: Variety::knob(),
        setups: Variety::setups(),
        sample: "start",
        budget_cpu_s: [5.0, 600.0, 600.0],
    }
}

fn plot(title: &str, quantity: &str, setups: Vec<String>) -> Plot {
    Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups,
        statistics: vec!["median".into(), "worst".into()],
        orders: Vec::new(),
        knob_is_resolution: true,
        knob_label: "steps per contact".into(),
    }
}

fn picture() -> Picture {
    let places = [[0.3, 0.6], [1.9, 2.7], [3.2, 0.9], [0.9, 3.4], [2.6, 1.8], [3.6, 3.3], [1.4, 1.3]];
    let steps = [[0.5, 0.3], [-0.4, 0.5], [0.2, -0.6], [0.6, -0.1], [-0.5, -0.4], [-0.3, 0.4], [0.4, 0.5]];
    let disc = |center: [f64; 2]| PictureItem::Disc { center, radius: 0.14, ghost: false };
    let arrow =
        |(from, step): ([f64; 2], [f64; 2])| PictureItem::Arrow { from, to: [from[0] + step[0], from[1] + step[1]], label: String::new() };
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let side = |corner: usize| PictureItem::Dashed { from: corners[corner], to: corners[(corner + 1) % 4] };
    let items = (0..4).map(side).chain(places.map(disc)).chain(places.into_iter().zip(steps).map(arrow)).collect();
    Picture { caption: "Spheres in free flight in a periodic box.".into(), items }
}
