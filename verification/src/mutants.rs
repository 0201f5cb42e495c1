//! Deliberate bugs and what catches them: the power of the suite, not only its verdict.
//!
//! `cargo run -p verification --example plant_bugs` plants each in a copy of the workspace, runs `cargo test` there, and prints what turned red. A
//! test keeps the list honest: every bug can still be planted.

/// A deliberate bug: a change of the solver's source text that must turn a test red.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mutant {
    /// The bug in words.
    pub name: &'static str,
    /// File, relative to the workspace.
    pub file: &'static str,
    /// Text that stands there exactly once.
    pub original: &'static str,
    /// Text that the bug puts in its place.
    pub planted: &'static str,
    /// Tests that turned red when it was planted.
    pub caught_by: &'static [&'static str],
}

impl Mutant {
    /// Whether the claims or the snapshot of a case turn red on it.
    pub fn caught_by_case(&self, id: &str) -> bool {
        self.caught_by.iter().any(|test| test.contains(id))
    }
}

/// All deliberate bugs.
pub const MUTANTS: &[Mutant] = &[
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
        name: "missing half in the reduced mass of two equal bodies: mass of the first for both",
        file: "solver/src/contact/sphere_pair.rs",
        original: "inverse_mass: first.inverse_mass + second.inverse_mass,",
        planted: "inverse_mass: first.inverse_mass + 0.0 * second.inverse_mass,",
        caught_by: &["verification::cases::normal_contact_meets_its_claims", "verification::snapshots::normal_contact"],
    },
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
        original: "self.force[place] -= force.force;",
        planted: "self.force[place] += force.force;",
        caught_by: &[
            "friction_spins_bodies_so_that_slip_falls",
            "momentum_and_angular_momentum_are_kept_by_contacts_with_friction",
            "verification::cases::normal_contact_meets_its_claims",
            "verification::snapshots::normal_contact",
        ],
    },
    Mutant {
        name: "the spring does not turn with the contact plane",
        file: "solver/src/contact/law/linear_history.rs",
        original: "let mut stretch = turned_into_plane(history.stretch, &contact.normal);",
        planted: "let mut stretch = history.stretch;",
        caught_by: &["contact::law::linear_history::tests::a_force_carried_round_keeps_its_size_and_its_place_in_the_plane"],
    },
    Mutant {
        name: "slip does not rewrite the spring",
        file: "solver/src/contact/law/linear_history.rs",
        original: "        if part < 1.0 {",
        planted: "        if part < 0.0 {",
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
        name: "the stretch of a step is made with the arms and the plane of its end",
        file: "solver/src/contact/force.rs",
        original: "(velocity - self.slip_by_overlap * since_middle) * kind.step",
        planted: "velocity * kind.step",
        caught_by: &["verification::cases::oblique_impact_meets_its_claims", "verification::snapshots::oblique_impact"],
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
    Mutant {
        name: "duration of contact without the root (R eq. 3.34 as printed)",
        file: "solver/src/contact/law/linear_spring_dashpot.rs",
        original: "(self.stiffness / effective_mass).sqrt()",
        planted: "(self.stiffness / effective_mass)",
        caught_by: &["the tests do not end"],
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
        original: "shift + self.bodies.orientation(index) * part.position",
        planted: "shift + part.position",
        caught_by: &["shaped::parts_turn_with_their_body"],
    },
    Mutant {
        name: "turning left out of how far bodies have moved",
        file: "solver/src/contact/travel.rs",
        original: "let turned = (orientation.coords - body.orientation.coords).norm();",
        planted: "let turned = 0.0 * orientation.coords.norm();",
        caught_by: &["contact::travel::tests::no_point_moves_further_than_its_body_travels"],
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
];
