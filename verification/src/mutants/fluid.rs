//! Deliberate bugs of flow and of the bodies in it.

use super::Mutant;

/// They.
pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "gradient of another sign of phase than the divergence",
        file: "solver/src/fluid/periodic.rs",
        original: "z[place] = (z[place] - along_third.conj() * pressure) * scale;",
        planted: "z[place] = (z[place] - along_third * pressure) * scale;",
        caught_by: &[],
    },
    Mutant {
        name: "highest mode of a line left out",
        file: "solver/src/fluid/spectrum.rs",
        original: "row[self.first_modes - 1].im = 0.0;",
        planted: "row[self.first_modes - 1] = Mode::default();",
        caught_by: &[],
    },
    Mutant {
        name: "viscosity halved in the Helmholtz solve",
        file: "solver/src/fluid/periodic.rs",
        original: "*mode *= share / (inertia + viscosity * (across + square))",
        planted: "*mode *= share / (inertia + 0.5 * viscosity * (across + square))",
        caught_by: &[],
    },
    Mutant {
        name: "parabola through points half a spacing nearer than they are",
        file: "solver/src/coupling/resolved/ghosts.rs",
        original: "    let [near, far] = PROBES;\n    [",
        planted: "    let [near, far] = [PROBES[0] - 0.5, PROBES[1] - 0.5];\n    [",
        caught_by: &[],
    },
    Mutant {
        name: "condition asked for at the ghost instead of at the surface",
        file: "solver/src/coupling/resolved/ghosts.rs",
        original: "self.wanted.push(owner.velocity_at(&at_surface)[component]);",
        planted: "self.wanted.push(owner.velocity_at(&arm)[component]);",
        caught_by: &[],
    },
    Mutant {
        name: "pockets not projected",
        file: "solver/src/coupling/resolved/ghosts.rs",
        original: "self.pockets.project(values);",
        planted: "let _ = values;",
        caught_by: &[],
    },
    Mutant {
        name: "stencils reach inwards",
        file: "solver/src/coupling/resolved/interpolation.rs",
        original: "let first = if outward[direction] >= 0.0 { floor } else { floor - 1.0 };",
        planted: "let first = if outward[direction] < 0.0 { floor } else { floor - 1.0 };",
        caught_by: &[],
    },
    Mutant {
        name: "torque about the wrong end of the arm",
        file: "solver/src/coupling/resolved/constraint.rs",
        original: "load.torque += arm.cross(&force);",
        planted: "load.torque += force.cross(&arm);",
        caught_by: &[],
    },
    Mutant {
        name: "forces of the last step kept only by half",
        file: "solver/src/coupling/resolved/marching.rs",
        original: "self.forces.iter_mut().for_each(|force| *force *= self.problem.explicit_forcing);",
        planted: "self.forces.iter_mut().for_each(|force| *force *= 0.5 * self.problem.explicit_forcing);",
        caught_by: &[],
    },
    Mutant {
        name: "pressure advanced without its viscous part",
        file: "solver/src/coupling/resolved/marching.rs",
        original: "*pressure += correction - 0.5 * step * viscosity / density * viscous;",
        planted: "*pressure += correction - 0.0 * step * viscosity / density * viscous;",
        caught_by: &[],
    },
    Mutant {
        name: "images across the sides forgotten",
        file: "solver/src/coupling/resolved/immersed.rs",
        original: "along - edge * (along / edge).round()",
        planted: "along - 0.0 * edge * (along / edge).round()",
        caught_by: &[],
    },
    Mutant {
        name: "conjugate directions begin anew at every step",
        file: "solver/src/coupling/resolved/krylov.rs",
        original: "*along = steepest + product / last * *along",
        planted: "*along = steepest + 0.0 * product / last * *along",
        caught_by: &[],
    },
];
