//! Deliberate bugs of boundaries and insertion.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "wrong lever arm at a wall: to the surface, not to the middle of the overlap",
        file: "solver/src/boundary/mod.rs",
        original: "arm: normal * (radius - 0.5 * overlap)",
        planted: "arm: normal * radius",
        caught_by: &[
            "boundary::plane::tests::normal_points_into_the_wall_and_the_arm_to_the_middle_of_the_overlap",
            "contact::detect::sphere_plane::tests::normal_points_into_the_wall_and_the_arm_to_the_middle_of_the_overlap",
            "verification::cases::sphere_on_incline_meets_its_claims",
            "verification::snapshots::sphere_on_incline",
        ],
    },
    Mutant {
        name: "a ball touches edges and corners whether or not their faces come nearer",
        file: "solver/src/boundary/mesh.rs",
        original: "if !is_known && self.is_minimum(candidate, &candidates[..place], rounding) {",
        planted: "if !is_known {",
        caught_by: &[
            "boundary::mesh::tests::a_ball_that_rolls_over_seams_of_a_plane_feels_the_plane",
            "boundary::mesh::tests::grooves_have_two_contacts_and_ridges_one",
            "boundary::mesh::tests::the_facets_of_a_drum_are_one_contact",
        ],
    },
    Mutant {
        name: "a wall turns about its axis at rest although that has moved",
        file: "solver/src/boundary/motion.rs",
        original: "(point - turn.point - self.shift(time))",
        planted: "(point - turn.point)",
        caught_by: &["boundary::motion::tests::velocity_is_the_rate_of_the_place"],
    },
    Mutant {
        name: "random rotations that are not uniform",
        file: "solver/src/insertion/draws.rs",
        original: "((1.0 - share).sqrt(), share.sqrt())",
        planted: "(1.0 - share, share)",
        caught_by: &["insertion::draws::tests::rotations_are_uniform_and_the_usual_mistakes_are_told_from_them"],
    },
    Mutant {
        name: "bodies just placed are not in the way of the next",
        file: "solver/src/insertion/window.rs",
        original: "taken.add(position, radius);",
        planted: "",
        caught_by: &[
            "insertion::window::tests::bodies_do_not_overlap_and_keep_out_of_what_is_not_free",
            "insertion::window::tests::what_does_not_fit_is_counted",
        ],
    },
    Mutant {
        name: "a neighbour list lasts for its whole skin",
        file: "solver/src/broad_phase/neighbour_list.rs",
        original: "let allowed = 0.5 * self.state.skin;",
        planted: "let allowed = self.state.skin;",
        caught_by: &[
            "openings::coming_and_going_is_bitwise_the_same_with_all_pairs_and_lists_looked_at_or_not",
            "moving_walls::a_list_misses_no_contact_with_walls_that_move",
        ],
    },
    Mutant {
        name: "walls told anew although they have moved already",
        file: "solver/src/scene/boundary.rs",
        original: "let start = |start: f64| if start > time { f64::INFINITY } else { start };",
        planted: "let start = |start: f64| if start > -time { f64::INFINITY } else { start };",
        caught_by: &["moving_walls::what_walls_will_do_may_be_told_in_a_continuation_but_not_what_they_did"],
    },
];
