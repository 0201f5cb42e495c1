//! How fast this machine moves memory: McCalpin's triad, a = b + s c.

use std::hint::black_box;
use std::time::Instant;

use rayon::prelude::*;

/// Bytes that an element moves: two are read, one is written.
const BYTES: usize = 3 * size_of::<f64>();
const ROUNDS: usize = 12;
/// Elements that a thread takes at a time.
const PIECE: usize = 1 << 14;

/// Bytes a second on the threads of the current pool, the best of some rounds, over three arrays that together have a size in bytes.
pub fn bandwidth(size: usize) -> f64 {
    let count = (size / BYTES).max(1);
    let (mut sum, one, other) = (vec![0.0_f64; count], vec![1.0_f64; count], vec![2.0_f64; count]);
    let mut seconds = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        let pieces = sum.par_chunks_mut(PIECE).zip(one.par_chunks(PIECE)).zip(other.par_chunks(PIECE));
        pieces.for_each(|((sum, one), other)| {
            sum.iter_mut().zip(one).zip(other).for_each(|((sum, one), other)| *sum = one + 3.0 * other);
        });
        seconds = seconds.min(start.elapsed().as_secs_f64());
        black_box(&mut sum);
    }
    (count * BYTES) as f64 / seconds
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Faster than a disk and slower than light: the clock and the count of bytes are of the right size.
    #[test]
    fn memory_is_as_fast_as_memory() {
        let found = bandwidth(1 << 22);
        assert!((1e7..1e13).contains(&found), "{found}");
    }
}
