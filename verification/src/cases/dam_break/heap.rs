//! A heap of grains on a level floor seen from the side: how far it reaches, how high it stands, what is still moving.
//!
//! The floor is z = 0, the heap spreads towards positive x from a wall at x = 0 and is alike all along y.

use solver::Vector;
use solver::measure::Now;

/// A grain of a heap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grain {
    /// Centre in m.
    position: Vector,
    /// Volume in m^3.
    volume: f64,
    /// Speed in m/s.
    speed: f64,
}

/// Grains by id, in a slice of some width.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Heap {
    grains: Vec<Grain>,
    /// Width of the slice along y in m.
    width: f64,
}

/// Steps in which R's control volume is moved along the floor, as a part of the diameter.
const SHIFT: f64 = 0.1;

impl Heap {
    /// All bodies as grains of a heap of a width in m along y.
    pub(super) fn of(now: &Now<'_>, width: f64) -> Heap {
        let bodies = now.bodies();
        let grain =
            |index| Grain { position: now.position(index), volume: bodies.shape(index).volume(), speed: now.velocity(index).norm() };
        Heap { grains: bodies.by_id().map(grain).collect(), width }
    }

    /// Twice the mean height of the grains in m: the height of a column that is filled evenly.
    pub(super) fn height_of_even_column(&self) -> f64 {
        2.0 * self.grains.iter().map(|grain| grain.position.z).sum::<f64>() / self.grains.len() as f64
    }

    /// Volume of all grains in m^3.
    pub(super) fn volume(&self) -> f64 {
        self.grains.iter().map(|grain| grain.volume).sum()
    }

    /// How far the heap reaches in m (R section 5.4.2): a box of the length and height of a diameter in m and of the width of the slice is moved along the
    /// floor, until the solid fraction in it (R eq. 5.9: volumes of the grains whose centres are inside) is at most `least_fraction`. The middle of the box is
    /// then the end. Grains that lie scattered beyond do not count. R begins at the wall; here the box begins where half of the lowest layer is behind it,
    /// because the first rows at a flat wall have gaps between them.
    pub(super) fn reach(&self, diameter: f64, least_fraction: f64) -> f64 {
        let box_volume = diameter * diameter * self.width;
        let mut layer: Vec<(f64, f64)> =
            self.grains.iter().filter(|grain| grain.position.z < diameter).map(|grain| (grain.position.x, grain.volume)).collect();
        layer.sort_by(|one, other| one.0.total_cmp(&other.0));
        let middle = layer.get(layer.len() / 2).map_or(0.0, |grain| grain.0);
        let (mut first, mut last, mut inside) = (0, 0, 0.0);
        for shift in 0_u32.. {
            let start = middle + f64::from(shift) * SHIFT * diameter;
            while last < layer.len() && layer[last].0 < start + diameter {
                inside += layer[last].1;
                last += 1;
            }
            while first < last && layer[first].0 < start {
                inside -= layer[first].1;
                first += 1;
            }
            if first == layer.len() || inside <= least_fraction * box_volume {
                return start + 0.5 * diameter;
            }
        }
        f64::NAN
    }

    /// Heights in m over stretches of a length in m from the wall on, as if the grains of each were packed to a solid fraction: the sum of heights times
    /// lengths is the volume of all grains. The last stretch is the last with a grain.
    pub(super) fn profile(&self, length: f64, solid_fraction: f64) -> Vec<f64> {
        let mut heights = Vec::new();
        for grain in &self.grains {
            let place = (grain.position.x / length).max(0.0) as usize;
            if heights.len() <= place {
                heights.resize(place + 1, 0.0);
            }
            heights[place] += grain.volume / (solid_fraction * length * self.width);
        }
        heights
    }

    /// Part of the grains that are faster than a speed in m/s.
    pub(super) fn part_faster_than(&self, speed: f64) -> f64 {
        self.grains.iter().filter(|grain| grain.speed > speed).count() as f64 / self.grains.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Grains of unit diameter in a slice ten wide: `full` rows of ten that touch, then single grains one apart, and a second storey that must not count.
    fn rows(full: usize, single: usize) -> Heap {
        let volume = std::f64::consts::FRAC_PI_6;
        let grain = |x: f64, y: f64, z: f64, speed| Grain { position: Vector::new(x, y, z), volume, speed };
        let mut grains = Vec::new();
        for row in 0..full {
            grains.extend((0..10).map(|place| grain(row as f64 + 0.5, f64::from(place) + 0.5, 0.5, 0.0)));
        }
        grains.extend((0..single).map(|row| grain((full + row) as f64 + 0.5, 0.5, 0.5, 1.0)));
        grains.extend((0..2 * full).map(|row| grain(row as f64 + 0.5, 0.5, 1.5, 0.0)));
        Heap { grains, width: 10.0 }
    }

    /// A full row fills its box to pi/6 and a single grain to pi/60, which is below a tenth: the box that first holds none but single grains begins where the
    /// last row has left it.
    #[test]
    fn the_end_is_where_a_box_holds_less_than_a_tenth() {
        for full in [3, 8] {
            let reach = rows(full, 5).reach(1.0, 0.1);
            // The box has left the last row once it begins beyond its centres, half a diameter before its end; so is its middle half a diameter beyond.
            let end = full as f64;
            assert!(reach > end && reach <= end + SHIFT + 1e-12, "{reach} {end}");
        }
        // Single grains count once the criterion is below what they fill.
        let all = rows(4, 5).reach(1.0, 0.05);
        assert!(all > 9.0 && all <= 9.0 + SHIFT + 1e-12, "{all}");
        assert!((rows(0, 0).reach(1.0, 0.1) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn a_profile_holds_all_the_volume_and_its_height() {
        let heap = rows(6, 2);
        let profile = heap.profile(1.5, 0.6);
        assert_eq!(profile.len(), 8);
        let volume: f64 = profile.iter().map(|height| height * 1.5 * 10.0 * 0.6).sum();
        assert!((volume - heap.volume()).abs() < 1e-12 * volume);
        // One row of centres lies in the first stretch and two in the second, with one grain of the second storey a row.
        let grain = std::f64::consts::FRAC_PI_6 / (0.6 * 15.0);
        assert!((profile[0] - 11.0 * grain).abs() < 1e-12 && (profile[1] - 22.0 * grain).abs() < 1e-12, "{profile:?}");
    }

    #[test]
    fn an_even_column_is_twice_as_high_as_its_middle() {
        let column: Vec<Grain> = (0..7).map(|place| f64::from(place) + 0.5).map(|z| grain_at(z, 0.0)).collect();
        assert!((Heap { grains: column, width: 1.0 }.height_of_even_column() - 7.0).abs() < 1e-12);
        let speeds = [0.1, 0.3, 0.0, 0.2].map(|speed| grain_at(0.5, speed));
        let moving = Heap { grains: speeds.to_vec(), width: 1.0 };
        assert_eq!(moving.part_faster_than(0.15), 0.5);
    }

    fn grain_at(z: f64, speed: f64) -> Grain {
        Grain { position: Vector::new(0.5, 0.5, z), volume: 1.0, speed }
    }
}
