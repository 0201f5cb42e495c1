//! Deliberate bugs of contact laws.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "lagged damping declared as centred",
        file: "solver/src/contact/law/linear_spring_dashpot.rs",
        original: "let since = if kind.lagged_damping || kind.synchronous {",
        planted: "let since = if !kind.lagged_damping || kind.synchronous {",
        caught_by: &["verification::cases::normal_contact_meets_its_claims", "verification::snapshots::normal_contact"],
    },
    Mutant {
        name: "damping without the memory of its own last force",
        file: "solver/src/contact/law/linear_spring_dashpot.rs",
        original: "contact.approach_acceleration + last_force * contact.inverse_effective_mass;",
        planted: "contact.approach_acceleration;",
        caught_by: &[
            "contact::law::linear_spring_dashpot::tests::static_force_is_elastic_whatever_the_step",
            "verification::cases::normal_contact_meets_its_claims",
            "verification::cases::sphere_on_incline_meets_its_claims",
            "verification::cases::sphere_bounce_long_meets_its_claims",
            "verification::snapshots::normal_contact",
            "verification::snapshots::sphere_on_incline",
            "verification::snapshots::sphere_bounce_long",
        ],
    },
    Mutant {
        name: "sampled edges declared as resolved",
        file: "solver/src/contact/law/linear_spring_dashpot.rs",
        original: "let starts = kind.resolved_edges && !kind.synchronous",
        planted: "let starts = !kind.resolved_edges && !kind.synchronous",
        caught_by: &[
            "verification::cases::normal_contact_meets_its_claims",
            "verification::cases::sphere_bounce_long_meets_its_claims",
            "verification::snapshots::normal_contact",
            "verification::snapshots::sphere_bounce_long",
        ],
    },
    Mutant {
        name: "a resolved end of contact is not remembered",
        file: "solver/src/contact/law/linear_spring_dashpot.rs",
        original: "        memory.ended = true;\n        self.force_until_parted(whole)",
        planted: "        memory.ended = false;\n        self.force_until_parted(whole)",
        caught_by: &["verification::cases::normal_contact_meets_its_claims", "verification::snapshots::normal_contact"],
    },
    Mutant {
        name: "calibration of the other end of contact",
        file: "solver/src/contact/law/linear_spring_dashpot.rs",
        original: "EndOfContact::ZeroOverlap => -restitution.ln() / PI.hypot(restitution.ln()),",
        planted: "EndOfContact::ZeroOverlap => inverse_of_decreasing(restitution_without_attraction, restitution),",
        caught_by: &[
            "contact::law::linear_spring_dashpot::tests::calibration_inverts_the_restitution",
            "verification::cases::normal_contact_meets_its_claims",
            "verification::snapshots::normal_contact",
        ],
    },
    Mutant {
        name: "the spring does not turn with the contact plane",
        file: "solver/src/contact/law/linear_history.rs",
        original: "let mut stretch = carried_along(history.stretch, &contact.normal, contact.twist);",
        planted: "let mut stretch = history.stretch;",
        caught_by: &["contact::law::linear_history::tests::a_force_carried_round_keeps_its_size_and_its_place_in_the_plane"],
    },
    Mutant {
        name: "the spring does not turn about the normal with the bodies",
        file: "solver/src/contact/force.rs",
        original: "let twist = motion.twist(kind, normal_force.touched_before);",
        planted: "let twist = 0.0 * motion.twist(kind, normal_force.touched_before);",
        caught_by: &["contact::objectivity::a_loaded_pair_that_turns_about_its_normal_keeps_its_friction"],
    },
    Mutant {
        name: "slip does not rewrite the spring",
        file: "solver/src/contact/law/linear_history.rs",
        original: "Spring { stretch: (force + slip) * (-1.0 / (self.stiffness * touched)), force }",
        planted: "Spring { stretch: self.spring.stretch + (force + slip) * (0.0 / touched), force }",
        caught_by: &[
            "contact::law::linear_history::tests::slip_rewrites_the_spring",
            "verification::cases::sphere_on_incline_meets_its_claims",
            "verification::snapshots::sphere_on_incline",
        ],
    },
    Mutant {
        name: "the first step stretches the spring by a whole step",
        file: "solver/src/contact/law/linear_history.rs",
        original: "contact.displacement * if kind.synchronous { 0.0 } else { contact.touched_before };",
        planted: "contact.displacement * if kind.synchronous { 0.0 } else { 1.0 };",
        caught_by: &["contact::law::linear_history::tests::a_new_contact_is_stretched_since_it_touched"],
    },
    Mutant {
        name: "a spring that slides in the step of its first touch is rewritten for a dashpot of a whole step",
        file: "solver/src/contact/law/linear_history.rs",
        original: "let touched = if contact.touched > 0.0 { contact.touched } else { 1.0 };",
        planted: "let touched = 1.0;",
        caught_by: &["contact::law::linear_history::tests::a_spring_that_slides_from_first_touch_keeps_its_direction"],
    },
    Mutant {
        name: "sliding springs are shortened along the trial force of half a step ago",
        file: "solver/src/contact/law/sliding.rs",
        original: "    let mean_cap = 0.5 * (last_size + cap);",
        planted: "    return of_cap(trial);\n    let mean_cap = 0.5 * (last_size + cap);",
        caught_by: &[
            "contact::law::sliding::tests::the_force_follows_a_turning_slip_at_second_order",
            "shaped_friction::oblique_collisions_converge_at_second_order_whatever_the_shape",
        ],
    },
    Mutant {
        name: "Mindlin's stiffness without the root",
        file: "solver/src/contact/law/mindlin.rs",
        original: "(curvature_radius * overlap).sqrt()",
        planted: "(curvature_radius * overlap)",
        caught_by: &[
            "contact::law::mindlin::tests::loading_is_integrated_exactly_and_unloading_keeps_the_stretch",
            "contact::law::mindlin::tests::no_cycle_of_overlap_and_displacement_returns_energy",
            "contact::law::mindlin::tests::slip_rewrites_the_spring",
        ],
    },
    Mutant {
        name: "Mindlin's force keeps its size while the area shrinks",
        file: "solver/src/contact/law/mindlin.rs",
        original: "return before * (now / last) -",
        planted: "return before -",
        caught_by: &[
            "contact::law::mindlin::tests::loading_is_integrated_exactly_and_unloading_keeps_the_stretch",
            "contact::law::mindlin::tests::no_cycle_of_overlap_and_displacement_returns_energy",
        ],
    },
    Mutant {
        name: "Hertz's dashpot calibrated as a linear one",
        file: "solver/src/contact/law/hertz.rs",
        original: "5.0_f64.sqrt() * self.damping_ratio",
        planted: "2.0 * self.damping_ratio",
        caught_by: &["contact::law::hertz::tests::a_head_on_impact_returns_the_restitution"],
    },
    Mutant {
        name: "friction along the slip (S eq. 3.46-3.47 as printed)",
        file: "solver/src/contact/law/viscous_coulomb.rs",
        original: "let sticking = velocity * (-dashpot",
        planted: "let sticking = velocity * (dashpot",
        caught_by: &["contact::law::viscous_spring::tests::the_force_opposes_the_velocity_of_the_first_up_to_the_cap_on_the_total_force"],
    },
    Mutant {
        name: "rolling on does not rewrite the rolling spring",
        file: "solver/src/contact/law/rolling/spring_torque.rs",
        original: "angle = -loaded / self.stiffness;",
        planted: "angle = -spring / self.stiffness;",
        caught_by: &["contact::law::rolling::spring_torque::tests::rolling_on_rewrites_the_spring"],
    },
    Mutant {
        name: "Coulomb cap on the total force in the viscous law",
        file: "solver/src/contact/law/viscous_coulomb.rs",
        original: "self.friction * contact.elastic_force.max(0.0)",
        planted: "self.friction * contact.normal_force.max(0.0)",
        caught_by: &["contact::law::viscous_coulomb::tests::the_force_is_viscous_up_to_the_cap_on_the_elastic_force"],
    },
    Mutant {
        name: "duration of contact without the root (R eq. 3.34 as printed)",
        file: "solver/src/contact/law/linear_spring_dashpot.rs",
        original: "(self.stiffness / effective_mass).sqrt()",
        planted: "(self.stiffness / effective_mass)",
        caught_by: &["the tests do not end"],
    },
];
