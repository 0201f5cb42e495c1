//! Deliberate bugs of what is read off flows, of the step that flow and bodies share, and of what arrays and beds are held against.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "waves of the stream function slip on the cylinder",
        file: "verification/src/exact/cylinder_array.rs",
        original: "(-size, -(power + 1.0) * size / surface)",
        planted: "(-size, -(power - 1.0) * size / surface)",
        caught_by: &[
            "exact::cylinder_array::tests::cylinders_that_nearly_touch_are_held_by_the_gaps",
            "exact::cylinder_array::tests::flow_across_few_cylinders_is_that_of_the_series",
            "exact::cylinder_array::tests::flow_across_is_that_of_the_printed_table",
        ],
    },
    Mutant {
        name: "mean flow along cylinders without that of the corner",
        file: "verification/src/exact/cylinder_array.rs",
        original: "let mean = 0.25 * 8.0 * side + 0.25 * a * a * (1.0 - solid_fraction) - 1.0 / 24.0",
        planted: "let mean = 0.25 * 8.0 * side + 0.25 * a * a * (1.0 - solid_fraction) - 1.0 / 48.0",
        caught_by: &["exact::cylinder_array::tests::flow_along_few_cylinders_is_that_of_the_series"],
    },
    Mutant {
        name: "Ergun's terms over the square of the void fraction",
        file: "verification/src/exact/ergun.rs",
        original: "viscosity * solid * solid * velocity / (self.void_fraction.powi(3)",
        planted: "viscosity * solid * solid * velocity / (self.void_fraction.powi(2)",
        caught_by: &["exact::ergun::tests::constants_are_those_of_the_gradient_that_they_give"],
    },
    Mutant {
        name: "nearest spheres of a body-centred lattice as far as those of a face-centred one",
        file: "verification/src/exact/periodic_array.rs",
        original: "Lattice::BodyCentred => 0.75_f64.sqrt(),",
        planted: "Lattice::BodyCentred => 0.5_f64.sqrt(),",
        caught_by: &["exact::periodic_array::tests::spheres_of_a_lattice_touch_at_its_close_packing"],
    },
    Mutant {
        name: "what a flow carries along counted twice in a steady state",
        file: "solver/src/coupling/resolved/inertial.rs",
        original: "combine(&mut explicit, density, &velocity, inertia);",
        planted: "combine(&mut explicit, 2.0 * density, &velocity, inertia);",
        caught_by: &[
            "coupling::resolved::inertial::tests::a_fringe_does_not_keep_it_from_its_end",
            "coupling::resolved::inertial::tests::it_is_the_flow_that_marching_ends_in",
        ],
    },
    Mutant {
        name: "inertia of an iteration on one side only",
        file: "solver/src/coupling/resolved/inertial.rs",
        original: "combine(&mut explicit, density, &velocity, inertia);",
        planted: "combine(&mut explicit, density, &velocity, 0.0);",
        caught_by: &["coupling::resolved::inertial::tests::a_fringe_does_not_keep_it_from_its_end"],
    },
    Mutant {
        name: "mixture of flows away from the least step",
        file: "solver/src/coupling/resolved/inertial.rs",
        original: "let along = product(&of_step, step);",
        planted: "let along = -product(&of_step, step);",
        caught_by: &[
            "coupling::resolved::inertial::tests::a_fringe_does_not_keep_it_from_its_end",
            "coupling::resolved::inertial::tests::it_is_the_flow_that_marching_ends_in",
        ],
    },
    Mutant {
        name: "loads of the flow before the last",
        file: "solver/src/coupling/resolved/inertial.rs",
        original: "forces = next.forces;",
        planted: "forces.iter_mut().zip(&next.forces).for_each(|(old, new)| *old = 0.5 * (*old + new));",
        caught_by: &["coupling::resolved::inertial::tests::without_density_the_flow_creeps"],
    },
    Mutant {
        name: "solid counted as void",
        file: "solver/src/coupling/resolved/measures.rs",
        original: "share[index] -= (0.5 - distance).clamp(0.0, 1.0);",
        planted: "share[index] -= (0.5 + distance).clamp(0.0, 1.0);",
        caught_by: &[
            "coupling::resolved::measures::tests::mean_pressure_is_that_of_the_fluid_alone",
            "coupling::resolved::measures::tests::mean_velocity_of_poiseuille_flow_is_of_second_order",
            "coupling::resolved::measures::tests::pressure_falls_over_a_body_by_its_drag",
            "coupling::resolved::measures::tests::void_fraction_of_a_box_with_a_ball_is_of_second_order",
            "coupling::resolved::measures::tests::void_fraction_of_layers_is_what_discs_leave",
        ],
    },
    Mutant {
        name: "pressures inside bodies counted with those of the fluid",
        file: "solver/src/coupling/resolved/measures.rs",
        original: "is_fluid[index] &= distance > 0.0;",
        planted: "is_fluid[index] &= distance > -9.0;",
        caught_by: &["coupling::resolved::measures::tests::mean_pressure_is_that_of_the_fluid_alone"],
    },
    Mutant {
        name: "tortuosity as a mean of ratios of the speed to itself",
        file: "solver/src/coupling/resolved/measures.rs",
        original: "along += weight * value[direction];",
        planted: "along += weight * value[direction].abs().max(0.9 * value.norm());",
        caught_by: &[
            "coupling::resolved::measures::tests::tortuosity_of_a_tilted_flow_is_one_over_the_cosine",
            "coupling::resolved::measures::tests::tortuosity_of_a_winding_flow_is_of_second_order_and_that_of_the_layers_asked_for",
        ],
    },
    Mutant {
        name: "mean pressure gradient left out",
        file: "solver/src/coupling/resolved/measures.rs",
        original: "*pressure += gradient.dot(&place);",
        planted: "*pressure += 0.0 * gradient.dot(&place);",
        caught_by: &[
            "coupling::resolved::measures::tests::pressure_falls_over_a_body_by_its_drag",
            "coupling::resolved::measures::tests::pressure_is_what_balances_a_gradient_and_a_mean_force",
        ],
    },
    Mutant {
        name: "pressure of a flow without its inertia",
        file: "solver/src/coupling/resolved/unsteady.rs",
        original: "*rate = self.settings.density * *rate + force",
        planted: "*rate = 0.0 * self.settings.density * *rate + force",
        caught_by: &["coupling::resolved::unsteady::tests::the_pressure_of_vortices_is_that_of_the_momentum_they_carry"],
    },
    Mutant {
        name: "velocity of one face written for the middle of a cell",
        file: "solver/src/coupling/resolved/measures.rs",
        original: "0.5 * (values[index] + values[grid.neighbour(grid.cell(index), component, 1)])",
        planted: "values[grid.neighbour(grid.cell(index), component, 1)]",
        caught_by: &["coupling::resolved::measures::tests::velocity_in_the_middle_of_a_cell_is_that_of_a_straight_profile"],
    },
    Mutant {
        name: "perimeter of half of the arcs",
        file: "solver/src/coupling/resolved/surface/lobes.rs",
        original: "2.0 * self.count as f64 * self.half_arc() * self.radius",
        planted: "self.count as f64 * self.half_arc() * self.radius",
        caught_by: &["coupling::resolved::surface::lobes::tests::the_perimeter_is_that_of_the_polygon_through_its_points"],
    },
    Mutant {
        name: "mean flow begun anew at every step under a force",
        file: "solver/src/coupling/resolved/balance.rs",
        original: "Driving::Force(force) => (field.mean() + force) / self.inertia,",
        planted: "Driving::Force(force) => force / self.inertia,",
        caught_by: &[
            "coupling::resolved::unsteady::tests::momentum_of_fluid_and_bodies_together_is_kept_to_rounding",
            "coupling::resolved::walls::tests::a_sphere_midway_between_walls_has_faxens_drag",
            "coupling::resolved::walls::tests::driven_fluid_has_the_parabola_of_poiseuille_across_any_direction",
            "coupling::resolved::walls::tests::sheared_fluid_has_the_straight_profile_and_the_stress_of_couette",
        ],
    },
    Mutant {
        name: "excess mass of a free body pulls forwards",
        file: "solver/src/coupling/resolved/balance.rs",
        original: "Load { force: self.force + load.force - motion.velocity * self.excess_mass_rate, torque",
        planted: "Load { force: self.force + load.force + motion.velocity * self.excess_mass_rate, torque",
        caught_by: &[
            "coupling::resolved::unsteady::tests::light_and_heavy_spheres_start_with_their_added_mass_and_layer_and_settle_without_a_wiggle",
            "coupling::resolved::unsteady::tests::momentum_of_fluid_and_bodies_together_is_kept_to_rounding",
        ],
    },
    Mutant {
        name: "what an iteration leaves of a balance given back with the wrong sign",
        file: "solver/src/coupling/resolved/balance.rs",
        original: "left[free.number] = -force.component_div(&ones[free.number].force);",
        planted: "left[free.number] = force.component_div(&ones[free.number].force);",
        caught_by: &["coupling::resolved::unsteady::tests::momentum_of_fluid_and_bodies_together_is_kept_to_rounding"],
    },
    Mutant {
        name: "angular momentum of the fluid inside counted twice",
        file: "solver/src/coupling/resolved/balance.rs",
        original: "- self.fluid.angular_momentum(velocity) * self.rate;",
        planted: "- 2.0 * self.fluid.angular_momentum(velocity) * self.rate;",
        caught_by: &["coupling::resolved::unsteady::tests::a_torque_turns_the_body_and_not_the_fluid_inside"],
    },
];
