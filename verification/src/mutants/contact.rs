//! Deliberate bugs of forces and memory of contacts.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "missing half in the reduced mass of two equal bodies: mass of the first for both",
        file: "solver/src/contact/sphere_pair.rs",
        original: "inverse_mass: first.inverse_mass + second.inverse_mass,",
        planted: "inverse_mass: first.inverse_mass + 0.0 * second.inverse_mass,",
        caught_by: &["verification::cases::normal_contact_meets_its_claims", "verification::snapshots::normal_contact"],
    },
    Mutant {
        name: "wrong lever arm: the radius of the other body",
        file: "solver/src/contact/detect/sphere_sphere.rs",
        original: "arm_of_first: normal * (radius_of_first - 0.5 * overlap),",
        planted: "arm_of_first: normal * (radius_of_second - 0.5 * overlap),",
        caught_by: &[
            "contact::detect::sphere_sphere::tests::normal_points_from_first_to_second_and_both_arms_meet",
            "momentum_and_angular_momentum_are_kept_by_contacts_with_friction",
        ],
    },
    Mutant {
        name: "sign of the torque",
        file: "solver/src/contact/sweep.rs",
        original: "torque_on_first: moment * arms[0],",
        planted: "torque_on_first: moment * -arms[0],",
        caught_by: &[
            "friction_spins_bodies_so_that_slip_falls",
            "momentum_and_angular_momentum_are_kept_by_contacts_with_friction",
            "verification::cases::sphere_on_incline_meets_its_claims",
            "verification::snapshots::sphere_on_incline",
        ],
    },
    Mutant {
        name: "the second body feels the force too, not its opposite",
        file: "solver/src/contact/sweep.rs",
        original: "self.add_to(second, -pair.force, &pair.torque_on_second);",
        planted: "self.add_to(second, pair.force, &pair.torque_on_second);",
        caught_by: &[
            "friction_spins_bodies_so_that_slip_falls",
            "momentum_and_angular_momentum_are_kept_by_contacts_with_friction",
            "verification::cases::normal_contact_meets_its_claims",
            "verification::snapshots::normal_contact",
        ],
    },
    Mutant {
        name: "slip of shaped bodies with the arms and the plane of the end of a step",
        file: "solver/src/contact/rigid_motion.rs",
        original: "    let arm_rate = (touch.arm_of_first - place) / kind.step + first.spin.cross(place);",
        planted: "    let arm_rate = Vector::zeros() * (touch.arm_of_first.x - place.x) / kind.step;",
        caught_by: &["shaped_friction::oblique_collisions_converge_at_second_order_whatever_the_shape"],
    },
    Mutant {
        name: "the stretch of a step is made with the arms and the plane of its end",
        file: "solver/src/contact/force.rs",
        original: "(velocity - growth * since_middle) * kind.step",
        planted: "velocity * kind.step",
        caught_by: &["verification::cases::oblique_impact_meets_its_claims", "verification::snapshots::oblique_impact"],
    },
    Mutant {
        name: "lanes without the last normal force",
        file: "solver/src/contact/sphere_lanes.rs",
        original: "lanes.last_normal_force[lane] = memory.normal.force;",
        planted: "lanes.last_normal_force[lane] = 0.0 * memory.normal.force;",
        caught_by: &["contact::sphere_lanes::tests::lanes_give_the_same_bits_as_one_contact_after_the_other"],
    },
    Mutant {
        name: "a contact that ends is left in its lane",
        file: "solver/src/contact/sphere_lanes.rs",
        original: "if outcome.lasts[lane] == 0.0 {",
        planted: "if outcome.lasts[lane] < 0.0 {",
        caught_by: &["contact::sphere_lanes::tests::lanes_give_the_same_bits_as_one_contact_after_the_other"],
    },
    Mutant {
        name: "contact memory survives the end of the contact",
        file: "solver/src/contact/sphere_lanes.rs",
        original: "is_as_before &= touches == candidate.is_remembered;",
        planted: "is_as_before &= touches <= candidate.is_remembered;",
        caught_by: &["a_contact_that_has_ended_is_forgotten"],
    },
    Mutant {
        name: "dashpot calibrated for the whole mass at an oblique contact",
        file: "solver/src/contact/shaped.rs",
        original: "if resolution.damped_mass == DampedMass::Effective {",
        planted: "if resolution.damped_mass == DampedMass::Reduced {",
        caught_by: &[
            "verification::cases::cylinder_wall_impact_meets_its_claims",
            "verification::snapshots::box_at_rest",
            "verification::snapshots::cylinder_wall_impact",
        ],
    },
    Mutant {
        name: "lanes without the angular acceleration of the second body",
        file: "solver/src/contact/sphere_lanes.rs",
        original: "lanes.other_spin_rate[lane] = second.angular_acceleration;",
        planted: "lanes.other_spin_rate[lane] = Vector::zeros();",
        caught_by: &[
            "contact::sphere_lanes::tests::lanes_give_the_same_bits_as_one_contact_after_the_other",
            "neighbours::a_list_misses_no_contact_of_a_fast_crowd_of_mixed_sizes_and_shapes",
            "openings::coming_and_going_is_bitwise_the_same_with_all_pairs_and_lists_looked_at_or_not",
            "moving_walls::a_list_misses_no_contact_with_walls_that_move",
        ],
    },
    Mutant {
        name: "a thread leaves out pairs with bodies of earlier threads",
        file: "solver/src/contact/pair_rows.rs",
        original: "law.evaluate(all_bodies, &mut worker.copies, &mut worker.sums);",
        planted: "law.evaluate(all_bodies, &mut worker.copies, &mut Sums { start: usize::MAX, turns: false, force: &mut [], torque: &mut [] });",
        caught_by: &[
            "neighbours::a_list_misses_no_contact_of_a_fast_crowd_of_mixed_sizes_and_shapes",
            "neighbours::results_are_bitwise_the_same_on_any_number_of_threads",
        ],
    },
];
