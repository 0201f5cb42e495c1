//! Random numbers. What is drawn depends on the seed, the stream and the place in the stream alone: on no other draw, no thread, no restart.

use nalgebra::Quaternion;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::{Orientation, Vector};

/// Words of 32 bits that one place of a stream may use.
const WORDS_AT_A_PLACE: u128 = 64;

/// A sequence of random numbers.
#[derive(Debug, Clone)]
pub struct Draws {
    generator: ChaCha8Rng,
}

impl Draws {
    /// The numbers at a place of a stream. Streams and places do not overlap as long as fewer than 32 numbers are drawn at each place.
    pub fn new(seed: u64, stream: u64, place: u64) -> Draws {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        let mut generator = ChaCha8Rng::from_seed(key);
        generator.set_stream(stream);
        generator.set_word_pos(u128::from(place) * WORDS_AT_A_PLACE);
        Draws { generator }
    }

    /// A number from 0, included, to 1, excluded.
    pub fn unit(&mut self) -> f64 {
        // The 53 bits that a number below one can hold.
        (self.generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number from one bound to another.
    pub fn between(&mut self, [least, largest]: [f64; 2]) -> f64 {
        (least + self.unit() * (largest - least)).min(largest)
    }

    /// A whole number below a bound.
    pub fn below(&mut self, bound: usize) -> usize {
        ((self.unit() * bound as f64) as usize).min(bound.saturating_sub(1))
    }

    /// A point of a box.
    pub fn in_box(&mut self, lower: &Vector, upper: &Vector) -> Vector {
        Vector::from_fn(|axis, _| self.between([lower[axis], upper[axis]]))
    }

    /// A rotation, uniform over all rotations (Shoemake 1992). Three random Euler angles are not, nor is a random turn about a random axis.
    pub fn orientation(&mut self) -> Orientation {
        let share = self.unit();
        let [(sine, cosine), (other_sine, other_cosine)] = std::array::from_fn(|_| (std::f64::consts::TAU * self.unit()).sin_cos());
        let (one, other) = ((1.0 - share).sqrt(), share.sqrt());
        Orientation::new_normalize(Quaternion::new(other * other_cosine, one * sine, one * cosine, other * other_sine))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: usize = 20_000;

    /// Pearson's statistic of counts that should be equal.
    fn chi_square(cells: &[usize]) -> f64 {
        let expected = cells.iter().sum::<usize>() as f64 / cells.len() as f64;
        cells.iter().map(|count| (*count as f64 - expected).powi(2) / expected).sum()
    }

    fn histogram(cells: usize, values: impl Iterator<Item = f64>) -> Vec<usize> {
        let mut counts = vec![0; cells];
        values.for_each(|value| counts[((value * cells as f64) as usize).min(cells - 1)] += 1);
        counts
    }

    /// Three marginal laws of the uniform distribution, each mapped to [0, 1): cosine of the angle of a turned axis with a fixed one, its azimuth, and the
    /// angle of the rotation, whose distribution function is (a - sin a) / pi.
    fn statistics(orientations: &[Orientation]) -> [f64; 4] {
        let tilted = |axis: Vector| orientations.iter().map(move |turn| 0.5 * (1.0 + (turn * axis).dot(&Vector::new(0.6, 0.0, 0.8))));
        let azimuth = orientations.iter().map(|turn| turn * Vector::x()).map(|x| x.y.atan2(x.x) / std::f64::consts::TAU + 0.5);
        let angle = orientations.iter().map(|turn| turn.angle()).map(|angle| (angle - angle.sin()) / std::f64::consts::PI);
        [
            chi_square(&histogram(20, tilted(Vector::x()))),
            chi_square(&histogram(20, tilted(Vector::z()))),
            chi_square(&histogram(20, azimuth)),
            chi_square(&histogram(20, angle)),
        ]
    }

    /// Chi-square with 19 degrees of freedom exceeds this once in 10^5.
    const LARGEST_CHI_SQUARE: f64 = 57.0;

    #[test]
    fn rotations_are_uniform_and_the_usual_mistakes_are_told_from_them() {
        for seed in [1, 2, 3] {
            let turns: Vec<_> = (0..COUNT).map(|place| Draws::new(seed, 0, place as u64).orientation()).collect();
            let found = statistics(&turns);
            assert!(found.iter().all(|value| *value < LARGEST_CHI_SQUARE), "{seed}: {found:?}");
        }
        let mut draws = Draws::new(4, 0, 0);
        let mut angle = || draws.between([0.0, std::f64::consts::TAU]);
        let by_angles: Vec<_> = (0..COUNT).map(|_| Orientation::from_euler_angles(angle(), angle(), angle())).collect();
        let about_axes: Vec<_> = (0..COUNT)
            .map(|place| Draws::new(5, 0, place as u64).orientation() * Vector::z())
            .map(|axis| Orientation::from_axis_angle(&nalgebra::Unit::new_normalize(axis), 0.5 * angle()))
            .collect();
        for wrong in [by_angles, about_axes] {
            assert!(statistics(&wrong).iter().any(|value| *value > 10.0 * LARGEST_CHI_SQUARE));
        }
    }

    #[test]
    fn numbers_are_uniform_and_places_and_streams_differ() {
        let values: Vec<f64> = (0..COUNT).map(|place| Draws::new(7, 1, place as u64).unit()).collect();
        assert!(chi_square(&histogram(20, values.iter().copied())) < LARGEST_CHI_SQUARE);
        let neighbours = values.windows(2).map(|pair| (pair[1] - pair[0]).rem_euclid(1.0));
        assert!(chi_square(&histogram(20, neighbours)) < LARGEST_CHI_SQUARE);
        assert_eq!(Draws::new(7, 1, 5).unit(), values[5]);
        assert!(Draws::new(7, 2, 5).unit() != values[5] && Draws::new(8, 1, 5).unit() != values[5]);
        let point = Draws::new(7, 1, 5).in_box(&Vector::repeat(-1.0), &Vector::new(-1.0, 2.0, 3.0));
        assert!(point.x == -1.0 && point.y < 2.0 && point.z < 3.0);
        assert!((0..1000).all(|place| Draws::new(9, 0, place).below(3) < 3));
    }
}
