//! Every pair: quadratic cost, no assumption. The oracle for faster algorithms, and enough for small scenes.

use super::NearPair;
use crate::domain::Image;

/// All pairs of so many bodies, in order. Knows no periodic sides.
pub fn all_pairs(bodies: usize) -> Vec<NearPair> {
    let bodies = bodies as u32;
    (0..bodies).flat_map(|low| (low + 1..bodies).map(move |high| NearPair { low, high, image: Image::SAME })).collect()
}
