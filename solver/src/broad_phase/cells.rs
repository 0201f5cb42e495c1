//! Near pairs of balls of any sizes by cells: linear cost, whatever the spread of their sizes and wherever they have flown.
//!
//! Every octave of sizes has its own cells, twice as wide as the balls in them are thick at most. A ball looks at the 27 cells round it among its own size and
//! among each larger one, so that a pair is found from its smaller ball. Cells are kept by a hash of their coordinates: no box has to be
//! known, and a ball that escapes costs nothing. Across periodic sides balls near a side are entered a second time for the length of the search,
//! as images.

use crate::Vector;
use crate::domain::{Domain, Image};

/// A ball that others may be near to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Centre in m.
    pub position: Vector,
    /// Radius in m: two balls are near each other if they overlap.
    pub reach: f64,
}

/// Two near balls by their numbers, the lower one first, and the image of the second that the first is near to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct NearPair {
    /// The lower number.
    pub low: u32,
    /// The other number: the same if a ball is near to its own image.
    pub high: u32,
    /// Image of the second.
    pub image: Image,
}

/// All pairs of balls that overlap, in order. Balls must lie inside the domain where it is periodic, and no period may be shorter than twice the largest reach.
pub fn near_pairs(balls: &[Ball], domain: Option<&Domain>) -> Vec<NearPair> {
    let largest = balls.iter().map(|ball| ball.reach).fold(0.0, f64::max);
    if largest <= 0.0 {
        return Vec::new();
    }
    let octave = |ball: &Ball| ((largest / ball.reach).log2().floor() as usize).min(LARGEST_OCTAVE);
    let octaves: Vec<u8> = balls.iter().map(|ball| octave(ball) as u8).collect();
    let levels: Vec<Level> = (0..=LARGEST_OCTAVE)
        .filter(|octave| octaves.contains(&(*octave as u8)))
        .map(|octave| Level::new(octave, 2.0 * largest / (1u64 << octave) as f64, balls, &octaves, largest, domain))
        .collect();
    let mut found = Vec::with_capacity(4 * balls.len());
    for (index, ball) in balls.iter().enumerate() {
        let own = usize::from(octaves[index]);
        // Levels come from coarse to fine.
        for level in levels.iter().take_while(|level| level.octave <= own) {
            level.look_round(index as u32, ball, level.octave == own, &mut found);
        }
    }
    sorted_by_row(found, balls.len())
}

/// Balls smaller than the largest by this many octaves share the finest cells.
const LARGEST_OCTAVE: usize = 40;

/// The cells of one octave of sizes.
struct Level {
    octave: usize,
    width: f64,
    /// Where the entries of each bucket begin; one more than there are buckets.
    starts: Vec<u32>,
    entries: Vec<Entry>,
    /// Whether some entries are images, which nothing is looked for from.
    has_images: bool,
}

#[derive(Clone, Copy)]
struct Entry {
    ball: Ball,
    cell: Cell,
    number: u32,
    image: Image,
}

type Cell = [i64; 3];

/// Number of a cell itself among the 27 round it.
const OWN_CELL: i64 = 13;

impl Level {
    fn new(octave: usize, width: f64, balls: &[Ball], octaves: &[u8], largest: f64, domain: Option<&Domain>) -> Level {
        let mut unsorted = Vec::new();
        let mut enter = |number: usize, ball: Ball, image: Image| {
            unsorted.push(Entry { ball, cell: cell_of(&ball.position, width), number: number as u32, image });
        };
        for (number, ball) in balls.iter().enumerate().filter(|(number, _)| usize::from(octaves[*number]) == octave) {
            enter(number, *ball, Image::SAME);
            if let Some(domain) = domain {
                for (image, position) in domain.images_near(&ball.position, ball.reach + largest) {
                    enter(number, Ball { position, ..*ball }, image);
                }
            }
        }
        let buckets = unsorted.len().next_power_of_two().max(2);
        let mut starts = vec![0u32; buckets + 1];
        let hashes: Vec<usize> = unsorted.iter().map(|entry| bucket_of(&entry.cell, buckets)).collect();
        for hash in &hashes {
            starts[hash + 1] += 1;
        }
        for bucket in 0..buckets {
            starts[bucket + 1] += starts[bucket];
        }
        let mut next = starts.clone();
        let mut entries = unsorted.clone();
        for (entry, hash) in unsorted.iter().zip(&hashes) {
            entries[next[*hash] as usize] = *entry;
            next[*hash] += 1;
        }
        let has_images = entries.iter().any(|entry| entry.image != Image::SAME);
        Level { octave, width, starts, entries, has_images }
    }

    /// Adds the near pairs of a ball with those of this level. Among balls of its own level each pair is seen from both sides and counted once: from the cell
    /// that comes first, or where there are images, whose cells may be shifted, from the ball of the lower number.
    fn look_round(&self, number: u32, ball: &Ball, is_own: bool, found: &mut Vec<NearPair>) {
        let centre = cell_of(&ball.position, self.width);
        let buckets = self.starts.len() - 1;
        let is_from_first_cell = is_own && !self.has_images;
        for offset in if is_from_first_cell { OWN_CELL..27 } else { 0..27 } {
            let cell: Cell = [
                centre[0].wrapping_add(offset / 9 - 1),
                centre[1].wrapping_add(offset / 3 % 3 - 1),
                centre[2].wrapping_add(offset % 3 - 1),
            ];
            let bucket = bucket_of(&cell, buckets);
            for entry in &self.entries[self.starts[bucket] as usize..self.starts[bucket + 1] as usize] {
                let reach = ball.reach + entry.ball.reach;
                // Not near, also if a coordinate is not a number; or of another cell with the same hash.
                let is_near = (entry.ball.position - ball.position).norm_squared() < reach * reach;
                if !is_near || entry.cell != cell {
                    continue;
                }
                let is_lower = number < entry.number || number == entry.number && entry.image > Image::SAME;
                if is_lower {
                    found.push(NearPair { low: number, high: entry.number, image: entry.image });
                } else if !is_own || is_from_first_cell && offset > OWN_CELL {
                    found.push(NearPair { low: entry.number, high: number, image: entry.image.reversed() });
                }
            }
        }
    }
}

#[inline]
fn cell_of(position: &Vector, width: f64) -> Cell {
    [position.x, position.y, position.z].map(|coordinate| (coordinate / width).floor() as i64)
}

/// A hash that spreads neighbouring cells over all buckets, whose number is a power of two.
#[inline]
fn bucket_of(cell: &Cell, buckets: usize) -> usize {
    let [x, y, z] = cell.map(|coordinate| coordinate as u64);
    let mixed = x.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ y.wrapping_mul(0xC2B2_AE3D_27D4_EB4F) ^ z.wrapping_mul(0x1656_67B1_9E37_79F9);
    (mixed.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (64 - buckets.trailing_zeros())) as usize
}

/// The pairs in order: first by their lower number, which a count of each sorts, then within the few of a row.
fn sorted_by_row(pairs: Vec<NearPair>, rows: usize) -> Vec<NearPair> {
    let mut starts = vec![0usize; rows + 1];
    for pair in &pairs {
        starts[pair.low as usize + 1] += 1;
    }
    for row in 0..rows {
        starts[row + 1] += starts[row];
    }
    let mut next = starts.clone();
    let mut sorted = pairs.clone();
    for pair in pairs {
        let place = &mut next[pair.low as usize];
        sorted[*place] = pair;
        *place += 1;
    }
    for row in 0..rows {
        sorted[starts[row]..starts[row + 1]].sort_unstable();
    }
    sorted
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Every pair and every image of it, one by one.
    fn by_brute_force(balls: &[Ball], domain: Option<&Domain>) -> Vec<NearPair> {
        let mut found = Vec::new();
        let lengths = domain.map_or_else(Vector::zeros, |domain| domain.lengths);
        let periodic = domain.map_or([false; 3], |domain| domain.periodic);
        for (low, ball) in balls.iter().enumerate() {
            for (high, other) in balls.iter().enumerate().skip(low) {
                for packed in 0..27 {
                    let offset = [packed / 9 - 1, packed / 3 % 3 - 1, packed % 3 - 1].map(|length: i32| length as i8);
                    let image = Image::new(offset);
                    let exists = (0..3).all(|axis| periodic[axis] || offset[axis] == 0);
                    let between = other.position + Vector::from(offset.map(f64::from)).component_mul(&lengths) - ball.position;
                    let is_new = low != high || image > Image::SAME;
                    if exists && is_new && between.norm() < ball.reach + other.reach {
                        found.push(NearPair { low: low as u32, high: high as u32, image });
                    }
                }
            }
        }
        found.sort_unstable();
        found
    }

    prop_compose! {
        fn ball()(x in -1.0..1.0_f64, y in -1.0..1.0_f64, z in -1.0..1.0_f64, size in 0.0..2.0_f64) -> Ball {
            // Sizes over a ratio of 100.
            Ball { position: Vector::new(x, y, z), reach: 0.4 * 10.0_f64.powf(-size) }
        }
    }

    proptest! {
        #[test]
        fn no_pair_is_missed_and_none_is_found_twice(
            balls in prop::collection::vec(ball(), 0..60),
            periodic in prop::array::uniform3(any::<bool>()),
        ) {
            prop_assert_eq!(near_pairs(&balls, None), by_brute_force(&balls, None));
            let domain = Domain { lower: Vector::new(-1.0, -1.0, -1.0), lengths: Vector::new(2.0, 2.0, 2.0), periodic };
            prop_assert_eq!(near_pairs(&balls, Some(&domain)), by_brute_force(&balls, Some(&domain)));
        }
    }

    /// In a box shorter than two balls a ball touches its own image, and another one from both sides.
    #[test]
    fn a_ball_is_near_to_its_own_images_in_a_short_box() {
        let domain = Domain { lower: Vector::zeros(), lengths: Vector::new(1.0, 10.0, 10.0), periodic: [true, false, false] };
        let balls = [0.2, 0.7].map(|x| Ball { position: Vector::new(x, 0.0, 0.0), reach: 0.5 });
        let pairs = near_pairs(&balls, Some(&domain));
        assert_eq!(pairs, by_brute_force(&balls, Some(&domain)));
        assert_eq!(pairs.len(), 2, "one from each side; an image of itself is just out of reach");
    }

    /// Balls at the ends of the floating-point grid of coordinates neither panic nor hide the others.
    #[test]
    fn runaways_do_no_harm() {
        let at = |x: f64| Ball { position: Vector::new(x, 0.0, 0.0), reach: 1.0 };
        let pairs = near_pairs(&[at(0.0), at(1e300), at(f64::NAN), at(1.0), at(-1e18)], None);
        assert_eq!(pairs, [NearPair { low: 0, high: 3, image: Image::SAME }]);
    }
}
