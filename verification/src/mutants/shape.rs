//! Deliberate bugs of shapes, their distance and their detection.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "crust counted once",
        file: "solver/src/contact/detect/core_pair.rs",
        original: "let reach = first.rounded.radius + second.rounded.radius;",
        planted: "let reach = first.rounded.radius;",
        caught_by: &[
            "contact::detect::core_pair::tests::a_tilting_face_lets_go_of_its_corners_where_their_overlap_is_zero",
            "contact::detect::core_pair::tests::faces_overlap_as_sharp_faces_do",
            "contact::detect::core_pair::tests::turned_faces_meet_in_an_octagon_and_crossed_edges_in_a_point",
            "shaped::damping_and_friction_never_add_energy",
            "verification::snapshots::box_at_rest",
        ],
    },
    Mutant {
        name: "part of a body offset in the frame of the world",
        file: "solver/src/contact/detector.rs",
        original: "self.position + self.rotation * part.position",
        planted: "self.position + part.position",
        caught_by: &["shaped::parts_turn_with_their_body"],
    },
    Mutant {
        name: "turning left out of how far bodies have moved",
        file: "solver/src/contact/travel.rs",
        original: "let turned = (now.orientation.coords - before.orientation.coords).norm();",
        planted: "let turned = 0.0 * now.orientation.coords.norm();",
        caught_by: &["contact::travel::tests::no_point_moves_further_than_its_body_travels"],
    },
    Mutant {
        name: "travel of bodies lost when they are sorted",
        file: "solver/src/contact/travel.rs",
        original: "(self.last_seen[index as usize], self.length[index as usize]) = body;",
        planted: "self.last_seen[index as usize] = body.0;",
        caught_by: &["contact::travel::tests::sums_follow_their_bodies"],
    },
    Mutant {
        name: "bound of boxes across edges not over the length of the direction",
        file: "solver/src/distance/boxes.rs",
        original: "- reach) / squared.sqrt());",
        planted: "- reach) / squared);",
        caught_by: &["distance::boxes::tests::the_bound_is_below_the_distance_and_tells_most_slender_bodies_apart"],
    },
    Mutant {
        name: "a pair that is apart is not looked at when its balls part",
        file: "solver/src/contact/detector.rs",
        original: "look.gap.min(-between_balls)",
        planted: "look.gap",
        caught_by: &["neighbours::a_pair_that_leaves_the_list_and_comes_back_finds_what_one_that_stays_finds"],
    },
    Mutant {
        name: "corners of a common piece that coincide counted one by one",
        file: "solver/src/contact/detect/feature.rs",
        original: "const SAME_CORNER: f64 = 1e-9;",
        planted: "const SAME_CORNER: f64 = -1.0;",
        caught_by: &["contact::detect::core_pair::tests::no_two_contact_points_lie_at_the_same_place"],
    },
    Mutant {
        name: "boxes of slender bodies a tenth too small",
        file: "solver/src/distance/core.rs",
        original: "Core::Cylinder { radius, half_length } => Vector::new(*radius, *radius, *half_length),",
        planted: "Core::Cylinder { radius, half_length } => Vector::new(*radius, *radius, 0.9 * half_length),",
        caught_by: &["distance::boxes::tests::boxes_hold_their_cores"],
    },
    Mutant {
        name: "support map off by one corner",
        file: "solver/src/distance/core.rs",
        original: "    (best.1 as u32, vertices[best.1])\n",
        planted: "    (best.1 as u32, vertices[(best.1 + 1) % vertices.len()])\n",
        caught_by: &["distance::core::tests::no_corner_lies_farther_than_the_support_and_the_support_is_a_corner"],
    },
    Mutant {
        name: "answers of Newton's method for a rounded body and one with edges are not certified",
        file: "solver/src/distance/polish/smooth.rs",
        original: "(gap.abs() <= tolerance && !is_deep)",
        planted: "(tolerance >= 0.0 && !is_deep)",
        caught_by: &[
            "distance::polish::smooth::tests::balls_are_as_far_from_edged_sets_as_their_centres_less_their_radii",
            "distance::polish::smooth::tests::superellipsoids_and_edged_sets_are_certified_at_any_gap",
        ],
    },
    Mutant {
        name: "deep overlaps of a rounded body and one with edges taken for the least depth",
        file: "solver/src/distance/polish/smooth.rs",
        original: "-distance > SHALLOW * self.smooth",
        planted: "-distance > 1e9 * SHALLOW * self.smooth",
        caught_by: &["distance::polish::smooth::tests::superellipsoids_and_edged_sets_are_certified_at_any_gap"],
    },
];
