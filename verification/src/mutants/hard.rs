//! Deliberate bugs of hard contacts and superellipsoids.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "friction of hard bodies with the signs of S eq. 3.33 as printed",
        file: "solver/src/contact/impulse.rs",
        original: "FrictionClamp::None => dynamic(-1.0),",
        planted: "FrictionClamp::None => dynamic(1.0),",
        caught_by: &[
            "contact::impulse::tests::friction_as_printed_creates_the_energy_of_the_errata",
            "verification::cases::energy_fifty_cylinders_meets_its_claims",
            "verification::snapshots::energy_fifty_cylinders",
        ],
    },
    Mutant {
        name: "friction of hard bodies without the limit by sticking",
        file: "solver/src/contact/impulse.rs",
        original: "FrictionClamp::Stick => self.clamped(contact, push),",
        planted: "FrictionClamp::Stick => dynamic(-1.0),",
        caught_by: &[
            "contact::impulse::tests::between_the_coefficients_a_contact_sticks_and_above_both_it_slips_by_the_dynamic_one",
            "contact::impulse::tests::friction_as_printed_creates_the_energy_of_the_errata",
            "hard::a_collision_in_free_space_keeps_momentum_and_angular_momentum",
            "hard::friction_and_restitution_only_take_energy_away",
            "impulse::no_collision_creates_energy_and_every_one_keeps_its_restitution",
            "verification::cases::energy_fifty_cylinders_meets_its_claims",
            "verification::snapshots::energy_fifty_cylinders",
        ],
    },
    Mutant {
        name: "friction of hard bodies may create energy (Kane's paradox)",
        file: "solver/src/contact/impulse.rs",
        original: "let part = by_cone.min(by_energy).min(1.0);",
        planted: "let part = by_cone.min(by_energy.max(1.0)).min(1.0);",
        caught_by: &["impulse::no_collision_creates_energy_and_every_one_keeps_its_restitution"],
    },
    Mutant {
        name: "each of two bodies is pushed away by the whole overlap",
        file: "solver/src/scheme/hard/time_driven.rs",
        original: "if candidate.second_body().is_some() { 0.5 } else { 1.0 };",
        planted: "if candidate.second_body().is_some() { 1.0 } else { 1.0 };",
        caught_by: &["hard::bodies_that_overlap_are_pushed_apart_by_equal_shares_and_off_walls_alone"],
    },
    Mutant {
        name: "gradient of a vertex taken in the frame of the other body (S eq. 2.25 as printed)",
        file: "solver/src/contact/detect/vertices.rs",
        original: "seen.normals += own.vertices.normal_at(index)",
        planted: "seen.normals += own.shape.gradient_of_gauge(&inside).normalize()",
        caught_by: &[
            "contact::detect::vertices::tests::a_contact_that_one_side_sees_is_resolved_or_left_out",
            "contact::detect::vertices::tests::vertices_come_closer_where_they_lie_evenly_and_only_there",
        ],
    },
    Mutant {
        name: "moments of inertia divided by the mass (S eq. 2.4 as printed)",
        file: "solver/src/build/mod.rs",
        original: "shape.specific_inertia() * mass",
        planted: "shape.specific_inertia() / mass",
        caught_by: &[
            "elastic_and_rolling::a_rolling_ball_is_slowed_by_the_torque_and_comes_to_rest",
            "hard::a_box_that_lands_flat_comes_back",
            "hard::a_tilted_cylinder_leaves_a_wall_as_the_closed_form_says",
            "shaped::momentum_and_angular_momentum_are_kept_whatever_the_shapes",
            "spheres::momentum_and_angular_momentum_are_kept_by_contacts_with_friction",
        ],
    },
];
