//! Bugs in how bodies of a granular run meet a flow.

use super::Mutant;

pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "the impulse of the last step forgotten in the differences of this one",
        file: "solver/src/coupling/resolved/unsteady.rs",
        original: "(new * weights.new + last * weights.old[1]) / step",
        planted: "(new * weights.new + last * (0.0 * weights.old[1])) / step",
        caught_by: &["scheme::resolved::tests::a_body_at_rest_presses_with_its_net_weight"],
    },
    Mutant {
        name: "bodies as heavy for contacts as without the fluid that they push",
        file: "solver/src/scheme/resolved.rs",
        original: "mass + 0.5 * density * 4.0",
        planted: "mass + 0.0 * density * 4.0",
        caught_by: &["scheme::resolved::tests::a_body_at_rest_presses_with_its_net_weight"],
    },
    Mutant {
        name: "the pull of the fluid counted among the impulses of contacts",
        file: "solver/src/scheme/resolved.rs",
        original: "force: momentum - before.force - pull.force * length,",
        planted: "force: momentum - before.force - pull.force * (0.0 * length),",
        caught_by: &["scheme::resolved::tests::a_body_that_touches_nothing_moves_as_the_flow_alone_moves_it"],
    },
    Mutant {
        name: "pressure that a former step has left in a closed pocket",
        file: "solver/src/coupling/resolved/balance.rs",
        original: "push them for ever.\n        self.ghosts.project(&mut forces);",
        planted: "push them for ever.",
        caught_by: &["scheme::resolved::tests::a_body_at_rest_presses_with_its_net_weight"],
    },
    Mutant {
        name: "what a wall holds is held by a body that touches it as well",
        file: "solver/src/coupling/resolved/ghosts.rs",
        original: "walls.keep_what_they_hold(&mut found);",
        planted: "walls.keep_what_they_hold(&mut found.clone());",
        caught_by: &["scheme::resolved::tests::a_body_at_rest_presses_with_its_net_weight"],
    },
    Mutant {
        name: "bodies of given motion turned as free ones",
        file: "solver/src/scheme/resolved.rs",
        original: "            bodies.state.orientation[index] = body.immersed.orientation;\n",
        planted: "",
        caught_by: &["scheme::resolved::tests::bodies_of_given_motion_keep_it_and_their_drag_balances_the_pressure"],
    },
    Mutant {
        name: "the surface of a shape in the axes of another frame",
        file: "solver/src/build/flow.rs",
        original: "Some(surface) => Ok(turned(surface, part.orientation)),",
        planted: "Some(surface) => Ok(turned(surface, part.orientation.inverse())),",
        caught_by: &["build::flow::tests::surfaces_of_the_flow_hold_the_same_points_as_the_shapes"],
    },
    Mutant {
        name: "a flow resumed with the rates of another step",
        file: "solver/src/coupling/resolved/unsteady/state.rs",
        original: "self.rates_of(&state.velocity[1])",
        planted: "self.rates_of(&state.velocity[0])",
        caught_by: &["scheme::resolved::tests::a_run_goes_on_from_a_checkpoint_to_the_bit"],
    },
    Mutant {
        name: "forces that stay current keep the pull of the step before",
        file: "solver/src/scheme/resolved.rs",
        original: "bodies.state.force[index] += new.force - pull.force;",
        planted: "bodies.state.force[index] += 0.0 * (new.force - pull.force);",
        caught_by: &["scheme::resolved::tests::a_body_that_touches_nothing_moves_as_the_flow_alone_moves_it"],
    },
    Mutant {
        name: "torques of contacts lost on their way to the flow",
        file: "solver/src/coupling/resolved/unsteady.rs",
        original: "pushed(arrival.impulse.torque, memory.impulse.torque)",
        planted: "pushed(0.0 * arrival.impulse.torque, memory.impulse.torque)",
        caught_by: &["scheme::resolved::tests::friction_turns_a_ball_in_a_thin_fluid_as_without_one"],
    },
    Mutant {
        name: "the fluid inside a body that is launched still at rest",
        file: "solver/src/build/flow.rs",
        original: "immersed.velocity_at(&arm)[component] + missing *",
        planted: "fluid.velocity[component] + missing *",
        caught_by: &["scheme::resolved::tests::a_ball_that_is_launched_keeps_its_direction_and_its_momentum"],
    },
    Mutant {
        name: "surfaces of spheres turned if somebody looks at their orientation",
        file: "solver/src/scheme/resolved.rs",
        original: "if bodies.shape(index).as_sphere().is_some() {",
        planted: "if bodies.shape(index).as_sphere().is_some() && false {",
        caught_by: &["scheme::resolved::tests::friction_turns_a_ball_in_a_thin_fluid_as_without_one"],
    },
];
