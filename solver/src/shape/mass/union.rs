//! Mass properties of parts that may overlap: exact where there is a way, by counting cells where there is none.

use super::MassProperties;
use super::cell_counting::CellGrid;
use super::crossing_cylinders::{cross_in_plane, cross_in_space};
use super::outline::union_moments;
use super::prism::Prism;
use crate::shape::{Convex, Part};
use crate::{Orientation, Vector};

/// How mass properties were found. In order: of several ways, the last is the least exact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum MassMethod {
    /// Closed forms of parts that do not overlap.
    ClosedForms,
    /// Prisms with parallel axes, over the exact outline of their union.
    Outline,
    /// Closed forms of equal cylinders that cross at right angles.
    CrossingCylinders,
    /// Counted cells, so many per direction (R section 2.3).
    CellCounting(usize),
}

impl MassMethod {
    /// In words, for ledgers.
    pub fn text(&self) -> String {
        match self {
            MassMethod::ClosedForms => "closed forms".into(),
            MassMethod::Outline => "exact outline of parallel prisms".into(),
            MassMethod::CrossingCylinders => "closed form of crossing cylinders".into(),
            MassMethod::CellCounting(cells) => format!("counting of {cells} cells per direction (R section 2.3)"),
        }
    }
}

/// Cells per direction where nothing exact is known. The volume is then known to 1e-5 for round bodies, to 1e-4 for a thick cylinder along the axes
/// and to 1e-3 for slender arms along them; errors of moments of inertia are about twice as large (case `mass_properties`). It takes some
/// tenths of a second. Cells lie along the axes in which the parts are given, so that bodies that are symmetric about planes of these axes keep
/// that symmetry to rounding.
pub const CELLS_PER_DIRECTION: usize = 256;

/// Directions, lengths and places that agree to this part of the size of the body are taken to be equal: some turns leave such errors behind.
const ROUNDING: f64 = 1e-12;

/// Mass properties of the union of parts, in the frame in which the parts are given. `overlaps` tells whether two parts overlap; a pair that
/// only touches may be told either way.
///
/// Groups of parts that overlap, directly or by way of others, are found first and then added.
pub fn mass_of_union(parts: &[Part], overlaps: &dyn Fn(&Part, &Part) -> bool) -> (MassProperties, MassMethod) {
    let nothing = (MassProperties::nothing(), MassMethod::ClosedForms);
    groups(parts, overlaps)
        .iter()
        .map(|group| mass_of_group(group))
        .fold(nothing, |(sum, method), (mass, found_by)| (sum.plus(&mass, 1.0), method.max(found_by)))
}

/// The parts in groups, such that parts of different groups do not overlap.
fn groups(parts: &[Part], overlaps: &dyn Fn(&Part, &Part) -> bool) -> Vec<Vec<Part>> {
    let mut groups: Vec<Vec<Part>> = Vec::new();
    for part in parts {
        let (joined, mut apart): (Vec<_>, Vec<_>) =
            groups.into_iter().partition(|group: &Vec<Part>| group.iter().any(|other| overlaps(part, other)));
        apart.push(joined.into_iter().flatten().chain([part.clone()]).collect());
        groups = apart;
    }
    groups
}

/// Mass properties of parts that hang together.
fn mass_of_group(parts: &[Part]) -> (MassProperties, MassMethod) {
    if let [part] = parts {
        return (part.convex.mass_properties().placed(part.position, &part.orientation), MassMethod::ClosedForms);
    }
    let by_outline = || Some((mass_of_prisms(parts)?, MassMethod::Outline));
    let by_crossing = || Some((mass_of_crossing_cylinders(parts)?, MassMethod::CrossingCylinders));
    by_outline().or_else(by_crossing).unwrap_or_else(|| {
        let counted = CellGrid::around(parts, CELLS_PER_DIRECTION).mass_of_parts(parts);
        (counted, MassMethod::CellCounting(CELLS_PER_DIRECTION))
    })
}

/// Mass properties of parts that are all prisms along one axis: between any two of their ends the union is a prism again, over the outline of
/// those that are there. `None` if they are not.
fn mass_of_prisms(parts: &[Part]) -> Option<MassProperties> {
    let origin = parts.iter().map(|part| part.position).sum::<Vector>() / parts.len() as f64;
    let size = parts.iter().map(|part| (part.position - origin).norm() + part.convex.bounding_radius()).fold(0.0, f64::max);
    let tolerance = ROUNDING * size;
    let seen_along = |axis: &Vector| {
        let orientation = Orientation::face_towards(axis, &Vector::ith(axis.iamin(), 1.0));
        let turned = |part: &Part| Part {
            convex: part.convex.clone(),
            position: orientation.inverse() * (part.position - origin),
            orientation: orientation.inverse() * part.orientation,
        };
        let prisms = parts.iter().map(|part| Prism::along_z(&turned(part), tolerance)).collect::<Option<Vec<Prism>>>()?;
        Some((orientation, prisms))
    };
    let (orientation, prisms) = Prism::axes(parts.first()?).iter().find_map(seen_along)?;
    Some(mass_of_layers(&prisms, tolerance).placed(origin, &orientation))
}

/// Mass properties of prisms along z, layer by layer.
fn mass_of_layers(prisms: &[Prism], tolerance: f64) -> MassProperties {
    let mut heights: Vec<f64> = prisms.iter().flat_map(|prism| [prism.lower, prism.upper]).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|higher, lower| *higher - *lower <= tolerance);
    heights.windows(2).fold(MassProperties::nothing(), |sum, ends| {
        let middle = 0.5 * (ends[0] + ends[1]);
        let there = prisms.iter().filter(|prism| prism.lower < middle && middle < prism.upper);
        let members: Vec<_> = there.map(|prism| prism.section.clone()).collect();
        sum.plus(&union_moments(&members).prism(ends[0], ends[1]), 1.0)
    })
}

/// Mass properties of two or three equal cylinders that cross at right angles in their middle. `None` for anything else.
fn mass_of_crossing_cylinders(parts: &[Part]) -> Option<MassProperties> {
    let Convex::Cylinder(cylinder) = parts.first()?.convex else { return None };
    let position = parts.first()?.position;
    let alike = |part: &Part| {
        let Convex::Cylinder(other) = part.convex else { return false };
        let differences = [other.radius - cylinder.radius, other.length - cylinder.length, (part.position - position).norm()];
        differences.iter().all(|difference| difference.abs() <= ROUNDING * cylinder.radius)
    };
    let axes: Vec<Vector> = parts.iter().map(|part| part.orientation * Vector::z()).collect();
    let upright = |(index, axis): (usize, &Vector)| axes[..index].iter().all(|other| other.dot(axis).abs() <= ROUNDING);
    if !parts.iter().all(alike) || !axes.iter().enumerate().all(upright) {
        return None;
    }
    let cross = match axes.len() {
        2 => cross_in_plane(cylinder.radius, cylinder.length)?,
        3 => cross_in_space(cylinder.radius, cylinder.length)?,
        _ => return None,
    };
    // The rotation that takes z to the direction across the first two axes and y to the second.
    let orientation = Orientation::face_towards(&axes[0].cross(&axes[1]), &axes[1]);
    Some(cross.placed(position, &orientation))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::shape::{Cuboid, Cylinder, Sphere, composites};

    fn all_overlap(_: &Part, _: &Part) -> bool {
        true
    }

    /// The parts as a body that is turned and moved.
    fn turned(parts: &[Part]) -> (Vec<Part>, Vector, Orientation) {
        let (position, turn) = (Vector::new(3.0, -1.0, 0.5), Orientation::from_euler_angles(0.7, -1.1, 2.0));
        let turned = |part: &Part| Part {
            convex: part.convex.clone(),
            position: position + turn * part.position,
            orientation: turn * part.orientation,
        };
        (parts.iter().map(turned).collect(), position, turn)
    }

    /// Finds mass properties of a body upright and turned by the same method, and holds both against the expected ones.
    fn assert_found(parts: &[Part], expected: &MassProperties, method: MassMethod) {
        let upright = mass_of_union(parts, &all_overlap);
        let (parts, position, turn) = turned(parts);
        for ((found, by), expected) in [(upright, *expected), (mass_of_union(&parts, &all_overlap), expected.placed(position, &turn))] {
            assert_eq!(by, method);
            assert!((found.volume / expected.volume - 1.0).abs() < 64.0 * f64::EPSILON, "{}", found.volume / expected.volume - 1.0);
            assert!((found.centre - expected.centre).norm() < 64.0 * f64::EPSILON * (1.0 + position.norm()));
            let difference = (found.second_moments - expected.second_moments).norm() / expected.second_moments.norm();
            assert!(difference < 256.0 * f64::EPSILON, "{difference}");
        }
    }

    #[test]
    fn slices_of_a_cylinder_are_the_cylinder() {
        let cylinder = Cylinder { radius: 0.4, length: 0.53 };
        let expected = MassProperties::centred(cylinder.volume(), cylinder.mean_squares());
        let slices = composites::sliced_cylinder(0.4, 0.53, 7);
        assert_found(&slices, &expected, MassMethod::Outline);
        let (found, method) = mass_of_union(&slices, &|_, _| false);
        assert_eq!(method, MassMethod::ClosedForms);
        assert!((found.second_moments - expected.second_moments).norm() < 16.0 * f64::EPSILON * expected.second_moments.norm());
    }

    #[test]
    fn crosses_are_found_by_their_closed_forms() {
        for (parts, expected) in [
            (composites::cross_in_plane(0.1, 1.0), cross_in_plane(0.1, 1.0)),
            (composites::cross_in_space(0.1, 1.0), cross_in_space(0.1, 1.0)),
        ] {
            assert_found(&parts, &expected.unwrap(), MassMethod::CrossingCylinders);
        }
    }

    /// Closed form by sectors of 300 degrees, lobes of radius r: area (5/2 pi + sqrt 3) r^2, polar moment (5 / sqrt 3 + 55/12 pi) r^4.
    #[test]
    fn a_turned_trilobe_is_found_by_its_outline() {
        let (radius, length) = (0.4, 1.3);
        let parts = composites::trilobe(2.0 * radius * (1.0 + 2.0 / 3.0_f64.sqrt()), length).unwrap();
        let area = (2.5 * PI + 3.0_f64.sqrt()) * radius.powi(2);
        let square = 0.5 * (5.0 / 3.0_f64.sqrt() + 55.0 / 12.0 * PI) * radius.powi(4) / area;
        let expected = MassProperties::centred(area * length, Vector::new(square, square, length * length / 12.0));
        assert_found(&parts, &expected, MassMethod::Outline);
    }

    /// A T of two boards, of which one reaches into the other, by the boxes it consists of.
    #[test]
    fn boards_of_different_length_are_found_layer_by_layer() {
        let board = |lengths: [f64; 3], position: Vector| Part {
            convex: Convex::Cuboid(Cuboid { lengths: lengths.into() }),
            position,
            orientation: Orientation::identity(),
        };
        let parts = [board([1.0, 1.0, 0.2], Vector::z() * 0.1), board([0.2, 0.3, 1.0], Vector::z() * 0.6)];
        let rest = board([0.2, 0.3, 0.9], Vector::z() * 0.65);
        let alone = |part: &Part| part.convex.mass_properties().placed(part.position, &part.orientation);
        assert_found(&parts, &alone(&parts[0]).plus(&alone(&rest), 1.0), MassMethod::Outline);
    }

    /// Three cylinders in a row, of which the outer two are tied only by the one between them, in whatever order: less a lens of `2 t - sin(2 t)` each,
    /// `cos t = 1/2`.
    #[test]
    fn parts_that_are_tied_by_another_one_are_one_group() {
        let cylinder = |x: f64| Part {
            convex: Convex::Cylinder(Cylinder { radius: 1.0, length: 2.0 }),
            position: Vector::x() * x,
            orientation: Orientation::identity(),
        };
        let overlap = |one: &Part, other: &Part| (one.position - other.position).norm() < 1.5;
        let lens = 2.0 / 3.0 * PI - 0.75_f64.sqrt();
        for order in [[-1.0, 1.0, 9.0, 0.0], [-1.0, 0.0, 9.0, 1.0]] {
            let (found, method) = mass_of_union(&order.map(cylinder), &overlap);
            assert_eq!(method, MassMethod::Outline);
            assert!((found.volume - 2.0 * (4.0 * PI - 2.0 * lens)).abs() < 64.0 * f64::EPSILON, "{}", found.volume);
        }
    }

    /// Closed form: two balls of radius 1 at distance 1 share a lens of volume 5/12 pi.
    #[test]
    fn overlapping_balls_are_counted() {
        let ball = |x: f64| Part {
            convex: Convex::Sphere(Sphere { radius: 1.0 }),
            position: Vector::x() * x,
            orientation: Orientation::identity(),
        };
        let parts = [ball(0.0), ball(1.0), ball(9.0)];
        let (found, method) = mass_of_union(&parts, &|one, other| (one.position - other.position).norm() < 2.0);
        assert_eq!(method, MassMethod::CellCounting(CELLS_PER_DIRECTION));
        assert!(method.text().contains("256 cells"));
        let expected = PI * (4.0 - 5.0 / 12.0);
        let by_chance = (3.0 / 256.0_f64).powi(2) * (6.0 * PI / 12.0).sqrt();
        assert!((found.volume - expected).abs() < 3.0 * by_chance, "{} {by_chance}", found.volume - expected);
    }

    #[test]
    fn no_parts_have_no_mass() {
        assert_eq!(mass_of_union(&[], &all_overlap), (MassProperties::nothing(), MassMethod::ClosedForms));
    }
}
