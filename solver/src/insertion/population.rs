//! Which bodies are wanted: shapes by their fractions of the number, sizes by their range, in a random order.

use super::Draws;

/// One kind of bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kind {
    /// Radius in m of a ball about the centre that holds the shape at scale one.
    pub radius: f64,
    /// Part of the number of bodies, relative to those of the other kinds.
    pub fraction: f64,
    /// Least and largest scale; uniform between them.
    pub scale: [f64; 2],
}

/// The bodies that are wanted, in the order in which they come.
///
/// What a body is depends on its number alone, not on how often it had to be tried: were a new size drawn for each attempt, small ones would find room
/// more often and the sizes would no longer be distributed as they should.
#[derive(Debug, Clone, PartialEq)]
pub struct Population {
    kinds: Vec<Kind>,
    /// Kind of each body.
    order: Vec<u32>,
    seed: u64,
    /// The stream of sizes.
    stream: u64,
}

impl Population {
    /// Bodies of several kinds. The number of each is its fraction of all, rounded so that the numbers add up (by largest remainder).
    pub fn new(kinds: Vec<Kind>, number: usize, seed: u64, stream: u64) -> Population {
        let mut order = Vec::with_capacity(number);
        for (kind, count) in counts(&kinds, number).into_iter().enumerate() {
            order.extend(std::iter::repeat_n(kind as u32, count));
        }
        // Fisher and Yates, at the places after those of the sizes.
        for last in (1..order.len()).rev() {
            let other = Draws::new(seed, stream, (number + last) as u64).below(last + 1);
            order.swap(last, other);
        }
        Population { kinds, order, seed, stream }
    }

    /// How many bodies are wanted.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Whether none is wanted.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// Kind and scale of a body by its number in the sequence.
    pub fn body(&self, number: usize) -> Option<(usize, f64)> {
        let kind = *self.order.get(number)? as usize;
        let [least, largest] = self.kinds[kind].scale;
        let scale = if least == largest { least } else { Draws::new(self.seed, self.stream, number as u64).between([least, largest]) };
        Some((kind, scale))
    }

    /// Radius in m of a ball that holds a body of a kind and scale.
    pub fn radius(&self, kind: usize, scale: f64) -> f64 {
        self.kinds[kind].radius * scale
    }

    /// Radius in m of a ball that holds any of the bodies.
    pub fn largest_radius(&self) -> f64 {
        self.kinds.iter().map(|kind| kind.radius * kind.scale[1]).fold(0.0, f64::max)
    }
}

/// How many bodies there are of each kind.
fn counts(kinds: &[Kind], number: usize) -> Vec<usize> {
    let total: f64 = kinds.iter().map(|kind| kind.fraction).sum();
    let exact: Vec<f64> = kinds.iter().map(|kind| kind.fraction / total * number as f64).collect();
    let mut counts: Vec<usize> = exact.iter().map(|share| share.floor() as usize).collect();
    let mut by_remainder: Vec<usize> = (0..kinds.len()).collect();
    by_remainder.sort_by(|one, other| (exact[*other].fract()).total_cmp(&exact[*one].fract()));
    let missing = number.saturating_sub(counts.iter().sum());
    by_remainder.iter().cycle().take(missing).for_each(|kind| counts[*kind] += 1);
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(fraction: f64, scale: [f64; 2]) -> Kind {
        Kind { radius: 0.5, fraction, scale }
    }

    #[test]
    fn numbers_of_each_kind_are_exact_and_mixed() {
        let population = Population::new(vec![kind(1.0, [1.0; 2]), kind(2.0, [1.0; 2]), kind(4.0, [1.0; 2])], 1000, 3, 0);
        let kinds: Vec<usize> = (0..1000).map(|number| population.body(number).unwrap().0).collect();
        // Shares of 142.857, 285.714 and 571.429: the two largest remainders are rounded up.
        assert_eq!([0, 1, 2].map(|wanted| kinds.iter().filter(|kind| **kind == wanted).count()), [143, 286, 571]);
        assert_eq!(population.body(1000), None);
        // In a mixed order the expected number of changes of kind is that of draws without return: 1000 (1 - sum of squared shares) = 571, deviation about 15.
        let changes = kinds.windows(2).filter(|pair| pair[0] != pair[1]).count();
        assert!((500..640).contains(&changes), "{changes}");
        let first_half = kinds[..500].iter().filter(|kind| **kind == 2).count();
        assert!((240..332).contains(&first_half), "{first_half}");
    }

    #[test]
    fn sizes_are_uniform_in_their_range() {
        let population = Population::new(vec![kind(1.0, [0.5, 1.5])], 10_000, 3, 0);
        let scales: Vec<f64> = (0..10_000).map(|number| population.body(number).unwrap().1).collect();
        assert!(scales.iter().all(|scale| (0.5..=1.5).contains(scale)));
        // Mean 1 with a deviation of 0.2887 / 100, variance 1/12.
        let mean = scales.iter().sum::<f64>() / 1e4;
        let variance = scales.iter().map(|scale| (scale - mean).powi(2)).sum::<f64>() / 1e4;
        assert!((mean - 1.0).abs() < 4.0 * 0.0029 && (variance * 12.0 - 1.0).abs() < 4.0 * 0.009, "{mean} {variance}");
        assert_eq!((population.largest_radius(), population.radius(0, 0.5)), (0.75, 0.25));
        assert_eq!(Population::new(vec![kind(1.0, [1.0; 2])], 0, 3, 0).len(), 0);
    }
}
