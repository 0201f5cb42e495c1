//! The order of bodies along a Morton curve: neighbours in space are neighbours in memory.

use crate::Bodies;

/// Bits of a coordinate in a key.
const BITS: u32 = 21;

/// Storage indices of all bodies along a Morton curve through the box that holds them; bodies in one cell of it by their ids.
///
/// Depends on positions and ids only: bodies listed in another order are sorted into the same one.
pub fn order(bodies: &Bodies) -> Vec<u32> {
    let positions = || (0..bodies.len()).map(|index| bodies.position(index));
    let Some(lower) = positions().reduce(|one, other| one.inf(&other)) else { return Vec::new() };
    let extent = positions().map(|position| (position - lower).max()).fold(0.0, f64::max);
    let cells = f64::from(1_u32 << BITS);
    let scale = if extent > 0.0 { (cells - 1.0) / extent } else { 0.0 };
    let key = |index: usize| {
        let cell = (bodies.position(index) - lower) * scale;
        [cell.x, cell.y, cell.z].iter().enumerate().fold(0, |key, (axis, coordinate)| key | spread(*coordinate as u64) << axis)
    };
    let mut keyed: Vec<(u64, u32, u32)> = (0..bodies.len()).map(|index| (key(index), bodies.id(index), index as u32)).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, _, index)| index).collect()
}

/// The lowest 21 bits of a number with two zeros before each.
fn spread(number: u64) -> u64 {
    let mut bits = number & ((1 << BITS) - 1);
    for (shift, mask) in [
        (32, 0x001F_0000_0000_FFFF_u64),
        (16, 0x001F_0000_FF00_00FF),
        (8, 0x100F_00F0_0F00_F00F),
        (4, 0x10C3_0C30_C30C_30C3),
        (2, 0x1249_2492_4924_9249),
    ] {
        bits = (bits | bits << shift) & mask;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_spread_by_three() {
        for number in [0_u64, 1, 2, 5, 0x1F_FFFF, 0x15_5555, 0x12_3456] {
            let expected = (0..BITS).fold(0, |bits, place| bits | (number >> place & 1) << (3 * place));
            assert_eq!(spread(number), expected, "{number:x}");
        }
    }
}
