//! Deliberate bugs of motion, order of bodies and checkpoints.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "no gyroscopic term",
        file: "solver/src/motion/rotation/explicit_euler.rs",
        original: "spin + rate * step, step);",
        planted: "spin, step);",
        caught_by: &[
            "motion::rotation::tests::integrators_have_their_orders",
            "verification::cases::free_top_meets_its_claims",
            "verification::snapshots::free_top",
        ],
    },
    Mutant {
        name: "elementary rotations in the order 1-2-3, not symmetric",
        file: "solver/src/motion/rotation/splitting.rs",
        original: "[(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)]",
        planted: "[(0, 1.0), (1, 1.0), (2, 1.0), (1, 0.0), (0, 0.0)]",
        caught_by: &[
            "motion::rotation::tests::splitting_keeps_angular_momentum_exactly_and_energy_bounded",
            "motion::rotation::tests::integrators_have_their_orders",
            "verification::cases::free_top_meets_its_claims",
            "verification::snapshots::free_top",
        ],
    },
    Mutant {
        name: "momentum turned with the body instead of against it",
        file: "solver/src/motion/rotation/splitting.rs",
        original: "momentum[next] = cosine * along_next + sine * along_last;\n    momentum[last] = cosine * along_last - sine * along_next;",
        planted: "momentum[next] = cosine * along_next - sine * along_last;\n    momentum[last] = cosine * along_last + sine * along_next;",
        caught_by: &[
            "motion::rotation::tests::splitting_keeps_angular_momentum_exactly_and_energy_bounded",
            "motion::rotation::tests::integrators_have_their_orders",
            "verification::cases::free_top_meets_its_claims",
            "verification::snapshots::free_top",
        ],
    },
    Mutant {
        name: "forward Euler: positions move with the old velocity",
        file: "solver/src/motion/leapfrog.rs",
        original: "        self.velocity += acceleration * kick;\n        self.position += self.velocity * step;",
        planted: "        self.position += self.velocity * step;\n        self.velocity += acceleration * kick;",
        caught_by: &[
            "a_contact_that_has_ended_is_forgotten",
            "momentum_and_angular_momentum_are_kept_by_contacts_with_friction",
            "export::tests::every_case_is_exported_and_its_scenes_read_back",
            "verification::cases::evaluation_is_the_same_to_the_bit_each_time",
            "verification::cases::sphere_bounce_long_meets_its_claims",
            "verification::cases::normal_contact_meets_its_claims",
            "verification::snapshots::normal_contact",
            "verification::snapshots::sphere_bounce_long",
        ],
    },
    Mutant {
        name: "first kick as long as the others",
        file: "solver/src/motion/leapfrog.rs",
        original: "if synchronous { 0.5 * step } else { step }",
        planted: "if synchronous { step } else { step }",
        caught_by: &[
            "a_contact_that_has_ended_is_forgotten",
            "verification::cases::sphere_on_incline_meets_its_claims",
            "verification::snapshots::sphere_on_incline",
        ],
    },
    Mutant {
        name: "bodies kept in the order of the scene",
        file: "solver/src/bodies.rs",
        original: "specifications.sort_by_key(|body| body.id);",
        planted: "specifications.sort_by_key(|body| std::cmp::Reverse(body.id));",
        caught_by: &[
            "bodies::tests::bodies_are_stored_by_id",
            "friction_spins_bodies_so_that_slip_falls",
            "a_restarted_run_is_bitwise_the_same",
            "what_a_scene_does_not_need_is_not_there",
            "verification::cases::normal_contact_meets_its_claims",
            "verification::snapshots::normal_contact",
        ],
    },
    Mutant {
        name: "a checkpoint forgets that forces were evaluated",
        file: "solver/src/output/checkpoint.rs",
        original: "simulation.forces_are_current = checkpoint.forces_are_current;",
        planted: "simulation.forces_are_current = false;",
        caught_by: &["a_restarted_run_is_bitwise_the_same"],
    },
];
