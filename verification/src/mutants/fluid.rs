//! Deliberate bugs of flow and of the bodies in it.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "gradient of another sign of phase than the divergence",
        file: "solver/src/fluid/periodic.rs",
        original: "z[place] = (z[place] - along_third.conj() * pressure) * scale;",
        planted: "z[place] = (z[place] - along_third * pressure) * scale;",
        caught_by: &[
            "coupling::resolved::marching::tests::the_steady_state_is_that_of_the_points_solved_at_once_if_forces_are_kept",
            "coupling::resolved::pockets::tests::no_flow_feels_what_is_projected_away_and_nothing_else_is",
            "coupling::resolved::steady::tests::a_dense_matrix_gives_the_same_flow",
            "coupling::resolved::steady::tests::velocity_has_no_divergence_and_the_body_is_held_at_the_same_time",
        ],
    },
    Mutant {
        name: "highest mode of a line left out",
        file: "solver/src/fluid/spectrum.rs",
        original: "row[self.first_modes - 1].im = 0.0;",
        planted: "row[self.first_modes - 1] = Mode::default();",
        caught_by: &[
            "coupling::resolved::steady::tests::velocity_has_no_divergence_and_the_body_is_held_at_the_same_time",
            "fluid::navier_stokes::tests::a_creeping_step_is_the_inverse_of_the_periodic_box",
            "fluid::periodic::tests::a_dense_matrix_gives_the_same_flow",
            "fluid::periodic::tests::helmholtz_inverts_viscosity_and_inertia",
        ],
    },
    Mutant {
        name: "viscosity halved in the Helmholtz solve",
        file: "solver/src/fluid/periodic.rs",
        original: "*mode *= share / (inertia + viscosity * (across + square))",
        planted: "*mode *= share / (inertia + 0.5 * viscosity * (across + square))",
        caught_by: &[
            "coupling::resolved::marching::tests::the_steady_state_is_that_of_the_points_solved_at_once_if_forces_are_kept",
            "coupling::resolved::marching::tests::vortices_decay_by_the_factor_of_crank_and_nicolson",
            "fluid::periodic::tests::helmholtz_inverts_viscosity_and_inertia",
        ],
    },
    Mutant {
        name: "parabola through points half a spacing nearer than they are",
        file: "solver/src/coupling/resolved/ghosts.rs",
        original: "    let [near, far] = PROBES;\n    [",
        planted: "    let [near, far] = [PROBES[0] - 0.5, PROBES[1] - 0.5];\n    [",
        caught_by: &[
            "coupling::resolved::ghosts::tests::parabolas_meet_velocities_of_second_degree_exactly_at_the_surface",
            "coupling::resolved::steady::tests::a_turning_sphere_feels_the_torque_of_its_array",
            "coupling::resolved::steady::tests::velocity_has_no_divergence_and_the_body_is_held_at_the_same_time",
        ],
    },
    Mutant {
        name: "condition asked for at the ghost instead of at the surface",
        file: "solver/src/coupling/resolved/ghosts.rs",
        original: "self.wanted.push(owner.velocity_at(&at_surface)[component]);",
        planted: "self.wanted.push(owner.velocity_at(&arm)[component]);",
        caught_by: &[
            "coupling::resolved::ghosts::tests::a_turning_body_asks_for_the_velocity_of_its_surface",
            "coupling::resolved::steady::tests::a_turning_sphere_feels_the_torque_of_its_array",
        ],
    },
    Mutant {
        name: "pockets not projected",
        file: "solver/src/coupling/resolved/ghosts.rs",
        original: "self.pockets.project(values);",
        planted: "let _ = values;",
        caught_by: &[
            "coupling::resolved::steady::tests::a_dense_matrix_gives_the_same_flow",
            "coupling::resolved::steady::tests::only_the_relative_velocity_counts",
            "coupling::resolved::steady::tests::velocity_has_no_divergence_and_the_body_is_held_at_the_same_time",
        ],
    },
    Mutant {
        name: "stencils reach inwards",
        file: "solver/src/coupling/resolved/interpolation.rs",
        original: "let first = if outward[direction] >= 0.0 { floor } else { floor - 1.0 };",
        planted: "let first = if outward[direction] < 0.0 { floor } else { floor - 1.0 };",
        caught_by: &[
            "coupling::resolved::ghosts::tests::forces_act_inside_where_the_fluid_is_next",
            "coupling::resolved::ghosts::tests::narrow_gaps_fall_back_and_say_so",
            "coupling::resolved::ghosts::tests::parabolas_meet_velocities_of_second_degree_exactly_at_the_surface",
            "coupling::resolved::interpolation::tests::a_quadratic_stencil_reaches_outwards_alone",
        ],
    },
    Mutant {
        name: "torque about the wrong end of the arm",
        file: "solver/src/coupling/resolved/constraint.rs",
        original: "load.torque += arm.cross(&force);",
        planted: "load.torque += force.cross(&arm);",
        caught_by: &[
            "coupling::resolved::ghosts::tests::loads_are_what_the_fluid_is_given_reversed",
            "coupling::resolved::steady::tests::a_turning_sphere_feels_the_torque_of_its_array",
        ],
    },
    Mutant {
        name: "forces of the last step kept only by half",
        file: "solver/src/coupling/resolved/marching.rs",
        original: "self.forces.iter_mut().for_each(|force| *force *= self.problem.explicit_forcing);",
        planted: "self.forces.iter_mut().for_each(|force| *force *= 0.5 * self.problem.explicit_forcing);",
        caught_by: &["coupling::resolved::marching::tests::the_steady_state_is_that_of_the_points_solved_at_once_if_forces_are_kept"],
    },
    Mutant {
        name: "pressure advanced without its viscous part",
        file: "solver/src/coupling/resolved/marching.rs",
        original: "*pressure += correction - 0.5 * step * viscosity / density * viscous;",
        planted: "*pressure += correction - 0.0 * step * viscosity / density * viscous;",
        caught_by: &["coupling::resolved::marching::tests::a_step_without_bodies_is_that_of_crank_and_nicolson_with_its_own_pressure"],
    },
    Mutant {
        name: "images across the sides forgotten",
        file: "solver/src/coupling/resolved/immersed.rs",
        original: "along - edge * (along / edge).round()",
        planted: "along - 0.0 * edge * (along / edge).round()",
        caught_by: &["coupling::resolved::immersed::tests::what_a_grid_cannot_hold_is_refused"],
    },
    Mutant {
        name: "conjugate directions begin anew at every step",
        file: "solver/src/coupling/resolved/krylov.rs",
        original: "*along = steepest + product / last * *along",
        planted: "*along = steepest + 0.0 * product / last * *along",
        caught_by: &["coupling::resolved::krylov::tests::conjugate_gradients_solve_what_is_symmetric"],
    },
    Mutant {
        name: "walls that the fluid slips along",
        file: "solver/src/fluid/border.rs",
        original: "Condition::Given(value) => plane(outside[end], within[end], -1.0, 2.0 * value),",
        planted: "Condition::Given(value) => plane(outside[end], within[end], 1.0, 0.0 * value),",
        caught_by: &[
            "fluid::helmholtz::tests::components_are_inverted_between_all_kinds_of_sides",
            "fluid::helmholtz::tests::pressures_are_inverted_between_all_kinds_of_sides",
            "fluid::navier_stokes::tests::divergence_vanishes_with_every_kind_of_side",
            "fluid::projection::tests::exact_coupling_is_the_solution_of_the_whole_dense_system",
        ],
    },
    Mutant {
        name: "second stage of Runge and Kutta without the memory of the first",
        file: "solver/src/fluid/navier_stokes.rs",
        original: "(5.0 / 12.0, -17.0 / 60.0)",
        planted: "(2.0 / 15.0, 0.0)",
        caught_by: &["fluid::navier_stokes::tests::a_step_beyond_the_limit_blows_up_with_an_error_and_one_below_does_not"],
    },
    Mutant {
        name: "pressure without its own diffusion in a step with sides",
        file: "solver/src/fluid/projection.rs",
        original: "potential - diffused * surplus",
        planted: "potential - 0.0 * diffused * surplus",
        caught_by: &["fluid::projection::tests::one_projection_is_exact_where_nothing_sticks_and_splits_where_it_does"],
    },
    Mutant {
        name: "pressure that does not vanish at an outlet",
        file: "solver/src/fluid/sides.rs",
        original: "(None, _) if side == Side::Outlet => Condition::Given(0.0),",
        planted: "(None, _) if side == Side::Outlet => Condition::Given(1.0),",
        caught_by: &[
            "fluid::helmholtz::tests::pressures_are_inverted_between_all_kinds_of_sides",
            "fluid::navier_stokes::tests::divergence_vanishes_with_every_kind_of_side",
            "fluid::projection::tests::exact_coupling_is_the_solution_of_the_whole_dense_system",
        ],
    },
    Mutant {
        name: "carriers of momentum taken from one side of a face",
        file: "solver/src/fluid/stencils.rs",
        original: "(carrier[at] + carrier[at - across]) * (carried[at] + carried[at - stride])",
        planted: "2.0 * carrier[at] * (carried[at] + carried[at - stride])",
        caught_by: &["verification::cases::flow_orders_meets_its_claims"],
    },
    Mutant {
        name: "last rate of Adams and Bashforth left out",
        file: "solver/src/fluid/navier_stokes.rs",
        original: "self.advance(step, (1.5, -0.5), force)",
        planted: "self.advance(step, (1.0, 0.0), force)",
        caught_by: &["verification::cases::flow_orders_meets_its_claims"],
    },
    Mutant {
        name: "grooves between lobes not seen from inside",
        file: "solver/src/coupling/resolved/surface/lobes.rs",
        original: "if !is_inside || from_centre.y.atan2(from_centre.x) <= self.half_arc() {",
        planted: "if !is_inside || from_centre.y.atan2(from_centre.x) <= PI {",
        caught_by: &[
            "coupling::resolved::surface::lobes::tests::feet_are_the_nearest_points_of_the_union",
            "coupling::resolved::surface::lobes::tests::inside_is_the_union_of_discs_and_polygon",
            "coupling::resolved::surface::lobes::tests::touching_lobes_have_the_area_of_their_sectors",
        ],
    },
    Mutant {
        name: "edges of a prism rounded off the wrong way",
        file: "solver/src/coupling/resolved/surface/prism.rs",
        original: "let distance = across.hypot(beyond);",
        planted: "let distance = across.max(beyond);",
        caught_by: &[
            "coupling::resolved::surface::lobes::tests::feet_are_the_nearest_points_of_the_union",
            "coupling::resolved::surface::prism::tests::feet_on_a_cylinder_are_nearest",
        ],
    },
    Mutant {
        name: "points of ends laid onto those of the rim",
        file: "solver/src/coupling/resolved/surface/outline.rs",
        original: "const INSET: f64 = 0.85;",
        planted: "const INSET: f64 = 0.3;",
        caught_by: &[
            "coupling::resolved::surface::lobes::tests::points_are_spread_evenly_with_the_grooves_among_them",
            "coupling::resolved::surface::polyhedron::tests::points_of_a_polyhedron_are_evenly_spread",
            "coupling::resolved::surface::prism::tests::points_of_a_cylinder_are_evenly_spread",
        ],
    },
    Mutant {
        name: "farthest face of a box taken for the nearest",
        file: "solver/src/coupling/resolved/surface/cuboid.rs",
        original: "let direction = beyond.imax();",
        planted: "let direction = beyond.imin();",
        caught_by: &[
            "coupling::resolved::surface::cuboid::tests::feet_on_a_box_are_nearest",
            "coupling::resolved::surface::polyhedron::tests::a_box_by_its_faces_has_the_feet_of_a_box",
        ],
    },
    Mutant {
        name: "planes of a polyhedron without edges",
        file: "solver/src/coupling/resolved/surface/polyhedron.rs",
        original: ".filter(|edge| !edge.is_within);",
        planted: ".filter(|edge| edge.is_within && !edge.is_within);",
        caught_by: &[
            "coupling::resolved::surface::polyhedron::tests::a_box_by_its_faces_has_the_feet_of_a_box",
            "coupling::resolved::surface::polyhedron::tests::feet_on_a_polyhedron_are_nearest",
        ],
    },
    Mutant {
        name: "images of long bodies forgotten",
        file: "solver/src/coupling/resolved/immersed.rs",
        original: "_ => (reach / extent[direction] + 0.5).floor() as i32,",
        planted: "_ => 0 * (reach / extent[direction] + 0.5).floor() as i32,",
        caught_by: &[
            "coupling::resolved::immersed::tests::parts_beyond_the_nearest_centre_are_found",
            "coupling::resolved::immersed::tests::what_a_grid_cannot_hold_is_refused",
        ],
    },
];
