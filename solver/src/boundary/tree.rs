//! A tree of boxes over the pieces of a wall, so that few of them are looked at.

use crate::Vector;

/// Pieces in a leaf.
const LEAF: usize = 4;

/// A box along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    lower: Vector,
    upper: Vector,
}

impl Extent {
    /// The box round points.
    pub(super) fn of(points: impl IntoIterator<Item = Vector>) -> Extent {
        let empty = Extent { lower: Vector::repeat(f64::INFINITY), upper: Vector::repeat(f64::NEG_INFINITY) };
        points.into_iter().fold(empty, |extent, point| Extent { lower: extent.lower.inf(&point), upper: extent.upper.sup(&point) })
    }

    fn with(&self, other: &Extent) -> Extent {
        Extent { lower: self.lower.inf(&other.lower), upper: self.upper.sup(&other.upper) }
    }

    fn centre(&self) -> Vector {
        0.5 * (self.lower + self.upper)
    }

    /// Squared distance of a point, in m^2.
    fn squared_distance(&self, point: &Vector) -> f64 {
        (self.lower - point).sup(&(point - self.upper)).sup(&Vector::zeros()).norm_squared()
    }
}

/// A node: a leaf if it has pieces, else both its halves follow, the first at once, the second from a place on.
#[derive(Debug, Clone, PartialEq)]
struct Node {
    extent: Extent,
    /// Place of the first piece, and how many.
    pieces: (u32, u32),
    second: u32,
}

/// The tree. Pieces are known by their numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl Tree {
    /// A tree over the boxes of at least one piece.
    pub(super) fn new(extents: &[Extent]) -> Tree {
        let mut tree = Tree { nodes: Vec::new(), order: (0..extents.len() as u32).collect() };
        tree.grow(extents, 0, extents.len());
        tree
    }

    /// Halves the pieces at the median along the longest side of the box round their centres.
    fn grow(&mut self, extents: &[Extent], start: usize, end: usize) {
        let pieces = &mut self.order[start..end];
        let of = |piece: &u32| &extents[*piece as usize];
        let extent = pieces.iter().map(of).fold(Extent::of([]), |extent, other| extent.with(other));
        let node = self.nodes.len();
        let count = end - start;
        self.nodes.push(Node { extent, pieces: (start as u32, count as u32), second: 0 });
        if count <= LEAF {
            return;
        }
        let centres = Extent::of(pieces.iter().map(|piece| of(piece).centre()));
        let axis = (centres.upper - centres.lower).imax();
        let middle = count / 2;
        pieces.select_nth_unstable_by(middle, |one, other| {
            (of(one).centre()[axis], one).partial_cmp(&(of(other).centre()[axis], other)).unwrap_or(std::cmp::Ordering::Equal)
        });
        self.grow(extents, start, start + middle);
        let second = self.nodes.len() as u32;
        self.grow(extents, start + middle, end);
        self.nodes[node] = Node { extent, pieces: (0, 0), second };
    }

    /// Calls back with every piece whose box may be within a reach of a point; the call returns the reach from then on.
    pub(super) fn within(&self, point: &Vector, reach: f64, mut call: impl FnMut(u32) -> f64) {
        self.descend(0, point, &mut reach.clone(), &mut call);
    }

    fn descend(&self, place: usize, point: &Vector, reach: &mut f64, call: &mut impl FnMut(u32) -> f64) {
        let node = &self.nodes[place];
        if node.extent.squared_distance(point) > *reach * *reach {
            return;
        }
        let (start, count) = node.pieces;
        if count > 0 {
            for piece in &self.order[start as usize..(start + count) as usize] {
                *reach = call(*piece);
            }
            return;
        }
        let halves = [place + 1, node.second as usize];
        let is_second_nearer = self.nodes[halves[1]].extent.squared_distance(point) < self.nodes[halves[0]].extent.squared_distance(point);
        for half in if is_second_nearer { [halves[1], halves[0]] } else { halves } {
            self.descend(half, point, reach, call);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_every_piece_within_reach_and_few_others() {
        let place = |index: u32| {
            let part = |stride: f64| (f64::from(index) * stride).fract();
            Vector::new(part(0.618_034), part(0.754_878), part(0.569_841))
        };
        let extents: Vec<Extent> = (0..2000).map(|index| Extent::of([place(index), place(index) + Vector::repeat(0.01)])).collect();
        let tree = Tree::new(&extents);
        for sample in 5000..5100 {
            let (point, reach) = (place(sample), 0.1);
            let mut found = Vec::new();
            tree.within(&point, reach, |piece| {
                found.push(piece);
                reach
            });
            let expected = (0..2000).filter(|piece| extents[*piece as usize].squared_distance(&point) <= reach * reach);
            let expected: Vec<u32> = expected.collect();
            assert!(expected.iter().all(|piece| found.contains(piece)), "{sample}");
            assert!(found.len() < 4 * expected.len() + 40, "{} {}", found.len(), expected.len());
            // With a reach that shrinks to the nearest so far, the nearest of all is found.
            let mut nearest = f64::INFINITY;
            tree.within(&point, f64::INFINITY, |piece| {
                nearest = nearest.min(extents[piece as usize].squared_distance(&point).sqrt());
                nearest
            });
            let least = extents.iter().map(|extent| extent.squared_distance(&point)).fold(f64::INFINITY, f64::min);
            assert_eq!(nearest, least.sqrt());
        }
    }

    #[test]
    fn pieces_at_one_place_are_no_trouble() {
        let tree = Tree::new(&[Extent::of([Vector::zeros()]); 100]);
        let mut count = 0;
        tree.within(&Vector::x(), 1.0, |_| {
            count += 1;
            1.0
        });
        assert_eq!(count, 100);
    }
}
