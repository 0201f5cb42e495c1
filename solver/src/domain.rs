//! The box that bodies live in, periodic in any of its directions.
//!
//! A body exists once. What lies across a periodic side is seen through an [`Image`]: whole lengths of the box added to the place of the second
//! partner of a pair. Bodies that leave are put back when neighbours are looked for, so that images hold from one search to the next.

use serde::{Deserialize, Serialize};

use crate::Vector;

/// A periodic box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain {
    /// Corner with the smallest coordinates, in m.
    pub lower: Vector,
    /// Lengths in m.
    pub lengths: Vector,
    /// In which directions it repeats.
    pub periodic: [bool; 3],
}

/// How many lengths of the box lie between a body and its image in each direction: -1, 0 or 1, packed as digits to base 3.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Image(u8);

impl Image {
    /// Not across any side.
    pub const SAME: Image = Image(13);

    /// An image so many lengths away, each -1, 0 or 1.
    pub fn new(lengths: [i8; 3]) -> Image {
        Image(lengths.iter().fold(0, |packed, length| 3 * packed + (length + 1) as u8))
    }

    /// Lengths away.
    pub fn lengths(self) -> [i8; 3] {
        [self.0 / 9, self.0 / 3 % 3, self.0 % 3].map(|digit| digit as i8 - 1)
    }

    /// The image of the first partner as the second sees it.
    pub fn reversed(self) -> Image {
        Image(26 - self.0)
    }
}

/// Displacements of all images of a box, in m.
#[derive(Debug, Clone, PartialEq)]
pub struct Shifts([Vector; SHIFTS]);

/// More than there are images, so that an index is cut to the table by its lowest bits.
const SHIFTS: usize = 32;

impl Shifts {
    /// Those of a box; none anywhere without one.
    pub fn of(domain: Option<&Domain>) -> Shifts {
        let lengths = domain.map_or_else(Vector::zeros, |domain| domain.lengths);
        Shifts(std::array::from_fn(|packed| Vector::from(Image(packed as u8).lengths().map(f64::from)).component_mul(&lengths)))
    }

    /// What to add to the place of a body to see its image.
    #[inline]
    pub fn shift(&self, image: Image) -> &Vector {
        &self.0[usize::from(image.0) % SHIFTS]
    }
}

impl Domain {
    /// The place inside the box of a body at a position; unchanged in directions that are not periodic.
    pub fn wrapped(&self, position: &Vector) -> Vector {
        let mut inside = *position;
        for axis in (0..3).filter(|axis| self.periodic[*axis]) {
            let (lower, length) = (self.lower[axis], self.lengths[axis]);
            let beyond = ((inside[axis] - lower) / length).floor();
            if beyond != 0.0 {
                // Rounding may leave it just at the upper side, which is the lower one.
                inside[axis] -= beyond * length;
                if inside[axis] >= lower + length {
                    inside[axis] = lower;
                }
            }
        }
        inside
    }

    /// The shortest of the displacements between two points and all their images.
    pub fn shortest(&self, between: &Vector) -> Vector {
        let along = |axis: usize| if self.periodic[axis] { (between[axis] / self.lengths[axis]).round() * self.lengths[axis] } else { 0.0 };
        between - Vector::new(along(0), along(1), along(2))
    }

    /// Smallest periodic length in m: infinite if none is.
    pub fn smallest_period(&self) -> f64 {
        (0..3).filter(|axis| self.periodic[*axis]).map(|axis| self.lengths[axis]).fold(f64::INFINITY, f64::min)
    }

    /// Images of a point inside the box, other than itself, that lie within a distance of the box.
    pub fn images_near(&self, position: &Vector, distance: f64) -> impl Iterator<Item = (Image, Vector)> + use<> {
        let (position, lengths) = (*position, self.lengths);
        let offsets: [Vec<i8>; 3] = std::array::from_fn(|axis| {
            let height = position[axis] - self.lower[axis];
            let (is_low, is_high) = (height <= distance, height >= self.lengths[axis] - distance);
            let mut offsets = vec![0];
            if self.periodic[axis] {
                offsets.extend(is_low.then_some(1));
                offsets.extend(is_high.then_some(-1));
            }
            offsets
        });
        let [along_x, along_y, along_z] = offsets;
        let all = along_x.into_iter().flat_map(move |x| {
            let along_z = along_z.clone();
            along_y.clone().into_iter().flat_map(move |y| along_z.clone().into_iter().map(move |z| [x, y, z]))
        });
        all.filter(|offset| *offset != [0; 3])
            .map(move |offset| (Image::new(offset), position + Vector::from(offset.map(f64::from)).component_mul(&lengths)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Domain = Domain { lower: Vector::new(-1.0, 0.0, 2.0), lengths: Vector::new(2.0, 4.0, 8.0), periodic: [true, false, true] };

    #[test]
    fn images_pack_and_reverse() {
        for x in -1..=1 {
            for y in -1..=1 {
                for z in -1..=1 {
                    let image = Image::new([x, y, z]);
                    assert_eq!(image.lengths(), [x, y, z]);
                    assert_eq!(image.reversed().lengths(), [-x, -y, -z]);
                }
            }
        }
        assert_eq!(Image::SAME.lengths(), [0; 3]);
        assert_eq!(*Shifts::of(Some(&BOX)).shift(Image::new([1, 0, -1])), Vector::new(2.0, 0.0, -8.0));
    }

    #[test]
    fn bodies_are_put_back_where_the_box_repeats() {
        assert_eq!(BOX.wrapped(&Vector::new(1.5, 9.0, 1.0)), Vector::new(-0.5, 9.0, 9.0));
        assert_eq!(BOX.wrapped(&Vector::new(-7.0, -9.0, 2.0)), Vector::new(-1.0, -9.0, 2.0));
        let just_below = BOX.wrapped(&Vector::new(-1.0 - 1e-17, 0.0, 2.0));
        assert!(just_below.x >= -1.0 && just_below.x < 1.0);
        assert_eq!(BOX.shortest(&Vector::new(1.5, 3.0, -7.0)), Vector::new(-0.5, 3.0, 1.0));
    }

    #[test]
    fn a_corner_has_three_images_and_the_middle_none() {
        let corner = Vector::new(-0.9, 0.1, 9.9);
        let mut images: Vec<_> = BOX.images_near(&corner, 0.2).map(|(image, _)| image.lengths()).collect();
        images.sort_unstable();
        assert_eq!(images, [[0, 0, -1], [1, 0, -1], [1, 0, 0]]);
        assert_eq!(BOX.images_near(&Vector::new(0.0, 2.0, 6.0), 0.5).count(), 0);
    }
}
