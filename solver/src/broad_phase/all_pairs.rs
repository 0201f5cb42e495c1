//! Every pair: quadratic cost, no assumption. The oracle for faster algorithms, and enough for small scenes.

use crate::Bodies;

/// Above this many bodies every pair is too many: four million tests a step.
pub const LARGEST_NUMBER_OF_BODIES: usize = 3000;

/// All pairs of bodies whose materials interact, as storage indices, lower id first, in order of their ids.
pub fn all_pairs(bodies: &Bodies, interact: impl Fn(usize, usize) -> bool) -> Vec<(usize, usize)> {
    let mut pairs = Vec::new();
    for first in 0..bodies.len() {
        for second in first + 1..bodies.len() {
            if interact(bodies.material(first), bodies.material(second)) {
                pairs.push((first, second));
            }
        }
    }
    pairs
}
