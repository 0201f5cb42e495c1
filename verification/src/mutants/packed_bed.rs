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
];
