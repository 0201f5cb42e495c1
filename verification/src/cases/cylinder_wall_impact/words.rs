//! What the case says about itself.

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};

use solver::shape::composites;

use super::figures::{FORCE_CURVES, SPIN_CURVES, VELOCITY_CURVES};
use super::setting::{LENGTH, RADIUS};
use super::{DURATION, FINE, SPIN, VELOCITY, variants};
use crate::case::{Description, Knob, setups};

pub(super) fn description(labels: &[String]) -> Description {
    Description {
        id: "cylinder_wall_impact",
        title: "Cylinder-wall impact",
        question: "Does a cylinder leave a wall with the right velocity and spin at every tilt, whatever stands for it?",
        model: vec![
            "A cylinder of 8 mm diameter and 5.3 mm length falls with 1 m/s and without spin on a frictionless wall; its end face is tilted by 0 (standing) to 90 degrees (lying). Source R (section 3.2) takes it to test glued bodies: the cylinder itself, the cylinder cut into slices that are glued again, and nine or fifty-four glued spheres.",
            "Two references. The impulse on a rigid cylinder in closed form, which holds where one point of the rim hits once: between 31.1 and 79.5 degrees. And the soft impact that is really coded, solved independently to 1e-12 with every touch and parting found exactly. The first shows the error of the model, the second that of the program.",
            "Where a face or a line comes down, all its corners are contact points. How they share spring and dashpot is a choice: each has all of it (model A of R, corrected), or they share by count (model B) or by overlap.",
        ],
        equations: vec![
            Equation {
                latex: r"\omega^+ = -\frac{M V (1+e)\, x}{I + M x^2},\qquad V^+ = \omega^+ x + e V,\qquad x = r\cos(\alpha+\theta)".into(),
                meaning: "Rigid cylinder hit at one point of its rim, R eq. 3.37-3.38 with the restitution at the contact point; r and alpha from the centre to the rim.".into(),
            },
            Equation {
                latex: r"F_j = q_j\,k\,\delta_j + c_j\,\dot\delta_j,\qquad c_j = 2\zeta\sqrt{k m}\;\{q_j \text{ or } 1/\sqrt N\}".into(),
                meaning: "Contact point j of N. Sum (model A): q = 1; by count (model B): q = 1/N; by overlap: q = its part of the overlap.".into(),
            },
            Equation {
                latex: r"\frac1m = \frac1M + \frac{\bar x^2}{I}".into(),
                meaning: "Effective mass at the resultant of the contact points, for which the dashpot is calibrated. R eq. 3.19 takes M.".into(),
            },
        ],
        parameters: [
            ("diameter, length", "8 mm, 5.3 mm", "R table 3.1"),
            ("mass", "0.31 g", "moments of the cylinder for every representation, so that only the contact differs"),
            ("stiffness", "10⁶ N/m", "not printed by R; overlap 0.2 % of the diameter; swept from 10⁴ to 10⁹"),
            ("restitution", "0.85", ""),
            ("wall", "normal along (2, 3, 6)/7", "no axis is special"),
        ]
        .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
        .to_vec(),
        reference: "Planar soft impact by Gragg-Bulirsch-Stoer extrapolation between exactly located events, agreeing with a 32-digit computation to 5e-14; rigid impulse in closed form, agreeing with 20 tabulated tilts to their digits.",
        picture: picture(),
        plots: plots(labels),
        headline: Headline {
            setup: labels[0].clone(),
            quantity: VELOCITY.into(),
            statistic: "median".into(),
            knob: FINE,
            order_quantity: Some(format!("observed order of {VELOCITY}")),
        },
        sources: vec![
            "R (Rakotonirina 2016), sections 2.6 and 3.2 of chapter 3, eq. 3.28-3.38, figures 3.6-3.11, tables 3.1-3.2",
            "Kodam et al. 2010 (Powder Technology 198), Park 2003: the impact, measured and in closed form",
        ],
        answers: vec![
            "A public code whose dashpot is calibrated for the mass of the body lets the restitution of an oblique impact fall to 0.81 at 30 degrees and 0.77 at 15: reproduced by the setups with the dashpot of the whole mass.",
            "The same code leaves 2.3 rad/s of spin after a landing on the side, where there can be none; R's figure 3.9 shows the like. With all corners of the line as contact points the spin is rounding error.",
            "R's claim that glued spheres fail this test: they do, at every tilt but 0 and 90 degrees.",
        ],
        remarks: vec![
            "R's formula is not the final state at every tilt: outside 31.1-79.5 degrees another point of the rim hits the wall after the first; at 0 and 90 degrees the landing is flat, without spin, where the formula gives 331 and 367 rad/s.",
            "No way to share a spring is at once independent of the number of points, continuous and conservative. Model B jumps when a further point touches: elastic landings a fraction of a degree from flat then leave with up to 2.1 times their energy, and its error is of first order. Sharing by overlap does not jump, but has no potential either (up to 1.3 times). Model A keeps energy and is the default; its contacts are shorter by the root of the number of points.",
            "The end of a contact is found one step ahead along a straight line. Where a turning body leaves the wall within about a ten-thousandth of a step after a kick, the line may miss it; such a contact keeps an error of half a step of its dashpot (4e-4 m/s at 250 steps). Contact durations here are no whole number of steps, so that this is as rare as in a simulation.",
            "Slices meet the wall with their inner faces too, so that points count twice there; that is part of the model of glued convex bodies.",
        ],
        knob: Knob {
            name: |setup| match variants()[setup.index].sweep {
                super::Sweep::Steps | super::Sweep::Figures => "steps_per_contact",
                super::Sweep::Stiffness => "stiffness",
                super::Sweep::Crust => "crust",
                super::Sweep::Slices => "slices",
            },
            values: |tier, setup| variants()[setup.index].knobs(tier),
        },
        setups: setups(labels.iter().cloned()),
        sample: "phase",
        budget_cpu_s: [5.0, 300.0, 300.0],
    }
}

fn plots(labels: &[String]) -> Vec<Plot> {
    let of = |sweep: super::Sweep| -> Vec<String> {
        variants().into_iter().filter(|variant| variant.sweep == sweep).map(|variant| variant.label).collect()
    };
    let convergence =
        |title: &str, quantity: &str, setups: Vec<String>, orders: Vec<f64>, is_resolution: bool, label: &str| Plot::Convergence {
            title: title.into(),
            quantity: quantity.into(),
            setups,
            statistics: vec!["median".into(), "worst".into()],
            orders,
            knob_is_resolution: is_resolution,
            knob_label: label.into(),
        };
    let curves = |title: &str, file: &str, x_label: &str, y_label: &str, columns: &[[&str; 2]], caption: &str| Plot::Curves {
        title: title.into(),
        file: format!("cylinder_wall_impact/{file}"),
        x_label: x_label.into(),
        y_label: y_label.into(),
        columns: columns.iter().map(|pair| pair.map(String::from)).collect(),
        log_x: false,
        log_y: false,
        caption: caption.into(),
    };
    let representations = [
        ["closed_form", "rigid, closed form"],
        ["cylinder", "cylinder"],
        ["ten_slices", "ten slices"],
        ["nine_spheres", "9 spheres"],
        ["fifty_four_spheres", "54 spheres"],
        ["dashpot_of_the_whole_mass", "dashpot of the whole mass"],
    ];
    let slices = of(super::Sweep::Slices);
    vec![
        Plot::ErrorAgainstCost {
            title: "Error of the velocity against run time".into(),
            quantity: VELOCITY.into(),
            setups: of(super::Sweep::Steps),
            statistic: "median".into(),
            targets: vec![0.1, 0.01, 0.001],
        },
        convergence("Velocity after the impact", VELOCITY, labels[..9].to_vec(), vec![1.0, 2.0], true, "steps per contact"),
        convergence("Spin after the impact", SPIN, labels[..4].to_vec(), vec![1.0, 2.0], true, "steps per contact"),
        curves(
            "Velocity over tilt (R figures 3.7a, 3.11)",
            VELOCITY_CURVES,
            "tilt in degrees",
            "velocity after / before",
            &representations,
            "The closed form is that of a single hit; at 0 and 90 degrees that of the flat landing. Glued spheres agree at these two only.",
        ),
        curves(
            "Spin over tilt (R figures 3.7b, 3.11)",
            SPIN_CURVES,
            "tilt in degrees",
            "spin x radius / velocity before",
            &representations,
            "Below 31 and above 79 degrees a second point of the rim hits the wall after the first, and changes the spin again if it does so within the time followed.",
        ),
        curves(
            "Force over time, landing on the side (R figure 3.8)",
            FORCE_CURVES,
            "time in s",
            "force in N",
            &[
                ["exact", "one piece, exact"],
                ["one_piece", "one piece"],
                ["a_2", "model A, 2 slices"],
                ["a_5", "model A, 5 slices"],
                ["a_10", "model A, 10 slices"],
                ["b_2", "model B, 2 slices"],
                ["b_5", "model B, 5 slices"],
                ["b_10", "model B, 10 slices"],
            ],
            "Model A: more points, larger force, shorter contact. Model B: all slices are one curve.",
        ),
        convergence("Spin after landing on the side (R figure 3.9b)", SPIN, slices.clone(), vec![], true, "slices"),
        convergence("Duration of contact against that of one point", DURATION, slices, vec![], true, "slices"),
        convergence("Distance from the rigid impact", VELOCITY, of(super::Sweep::Stiffness), vec![0.5], true, "stiffness in N/m"),
        convergence("Error of a crust", SPIN, of(super::Sweep::Crust), vec![1.0], false, "crust / half length"),
    ]
}

/// A tilted cylinder above the wall, and both arrangements of spheres.
fn picture() -> Picture {
    let (radius, half) = (RADIUS * 1e3, 0.5 * LENGTH * 1e3);
    let tilt = 45.0_f64.to_radians();
    let place = |axial: f64, radial: f64, centre: [f64; 2]| {
        [centre[0] + axial * tilt.sin() + radial * tilt.cos(), centre[1] + axial * tilt.cos() - radial * tilt.sin()]
    };
    let height = half * tilt.cos() + radius * tilt.sin();
    let corners = |centre: [f64; 2]| {
        [(half, radius), (half, -radius), (-half, -radius), (-half, radius)].map(|(axial, radial)| place(axial, radial, centre)).to_vec()
    };
    let cylinder = [0.0, height];
    let mut items = vec![
        PictureItem::Wall { from: [-8.0, 0.0], to: [34.0, 0.0], solid_side: [0.0, -1.0] },
        PictureItem::Polygon { points: corners(cylinder), ghost: false },
        PictureItem::Arrow { from: cylinder, to: [0.0, height - 4.0], label: "V".into() },
        PictureItem::Label { at: [0.0, 2.2 * height], text: "cylinder".into() },
    ];
    let arrangements = [
        (13.0, "9 spheres", composites::glued_spheres_cylinder_9(RADIUS, LENGTH)),
        (26.0, "54 spheres", composites::glued_spheres_cylinder_54(RADIUS, LENGTH)),
    ];
    for (x, name, spheres) in arrangements {
        items.push(PictureItem::Polygon { points: corners([x, height]), ghost: true });
        for part in spheres.iter().flatten() {
            let center = place(part.position.z * 1e3, part.position.x * 1e3, [x, height]);
            items.push(PictureItem::Disc { center, radius: part.convex.bounding_radius() * 1e3, ghost: true });
        }
        items.push(PictureItem::Label { at: [x, 2.2 * height], text: name.into() });
    }
    Picture {
        caption: "A cylinder at 45 degrees above the wall, and the nine and fifty-four spheres that stand for it, seen from the side."
            .into(),
        items,
    }
}
