//! Spheres and cubes in regular order at rest, in closed form: every contact a linear spring of the same stiffness.

use super::extrapolation::root;

/// Overlaps in m of a stack of equal bodies under their weight, from the ground up: each contact carries what is above it.
///
/// `weight` in N is that of one body, `stiffness` in N/m that of one contact with all its points.
pub fn stack_overlaps(bodies: usize, weight: f64, stiffness: f64) -> Vec<f64> {
    (0..bodies).map(|below| (bodies - below) as f64 * weight / stiffness).collect()
}

/// Height in m between two layers of a face-centred crystal whose layers are squares of a spacing: each sphere lies in the pocket of four, whose vertical
/// forces carry `load` in N. With the distance $r = \sqrt{s^2/2 + h^2}$ of their centres, $4 k (d - r) h / r = W$.
pub fn layer_height(diameter: f64, spacing: f64, load: f64, stiffness: f64) -> f64 {
    let half_diagonal = spacing * std::f64::consts::FRAC_1_SQRT_2;
    let carried = |height: f64| {
        let distance = half_diagonal.hypot(height);
        4.0 * stiffness * (diameter - distance) * height / distance
    };
    let unloaded = (diameter * diameter - half_diagonal * half_diagonal).sqrt();
    // The force falls as the layer is lifted, from far above any load that leaves the crystal stiff, to none where spheres part.
    root(|height| load - carried(height), 0.8 * unloaded, unloaded)
}

/// Spring energy in J of a periodic face-centred crystal in which each of so many spheres overlaps its twelve neighbours.
pub fn face_centred_energy(spheres: usize, overlap: f64, stiffness: f64) -> f64 {
    6.0 * spheres as f64 * 0.5 * stiffness * overlap * overlap
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stack_carries_its_weight() {
        let overlaps = stack_overlaps(4, 2.0, 100.0);
        assert_eq!(overlaps, [0.08, 0.06, 0.04, 0.02]);
        // Ground and gravity balance: the lowest contact carries all.
        assert!((100.0 * overlaps[0] - 4.0 * 2.0).abs() < 1e-14);
    }

    /// For a small load the pocket is a spring of stiffness 4 k cos^2, twice that of one contact at 45 degrees.
    #[test]
    fn a_pocket_of_four_is_a_spring_of_twice_the_stiffness_for_small_loads() {
        let (diameter, stiffness, load) = (0.01, 1e4, 1e-6);
        let unloaded = diameter * std::f64::consts::FRAC_1_SQRT_2;
        let sunk = unloaded - layer_height(diameter, diameter, load, stiffness);
        let linear = load / (2.0 * stiffness);
        // Rounding of the height, and the next term of the load, overlap over diameter.
        assert!((sunk - linear).abs() < 4.0 * f64::EPSILON * unloaded + 4.0 * linear * linear / diameter, "{sunk:e} {linear:e}");
    }

    /// The derivative of the energy to the edge is minus the pressure on a face times the three areas: virial and energy agree.
    #[test]
    fn energy_of_the_crystal_belongs_to_its_forces() {
        let (cells, diameter, stiffness) = (2.0_f64, 0.01, 1e4);
        let spheres = 32;
        let overlap = |edge: f64| diameter - edge / cells * std::f64::consts::FRAC_1_SQRT_2;
        let energy = |edge: f64| face_centred_energy(spheres, overlap(edge), stiffness);
        let (edge, change) = (0.028, 1e-7);
        let slope = (energy(edge + change) - energy(edge - change)) / (2.0 * change);
        let virial: f64 = 6.0 * 32.0 * stiffness * overlap(edge) * (diameter - overlap(edge));
        assert!((slope * edge + virial).abs() < 1e-8 * virial, "{slope} {virial}");
    }
}
