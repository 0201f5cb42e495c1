//! The flat or straight piece of a core that faces a direction, and what two such pieces have in common.
//!
//! A corner belongs to the piece if it lies no deeper under the foremost point than the overlap reaches: deeper ones cannot touch. So a tilted
//! face lets go of its corners one by one, each when its own overlap is zero, and nothing jumps.

use smallvec::SmallVec;

use crate::Vector;
use crate::distance::{Core, Relative, basis};

/// Points of a rim that stand for it.
const RIM_POINTS: usize = 8;
/// Straight pieces whose directions enclose a smaller sine than this touch along a line.
const PARALLEL: f64 = 0.05;
/// Corners of a common piece that are nearer to each other than this part of its extent are one. An edge that crosses a rim at its foremost point passes
/// through a corner of the piece of that rim, and rounding makes one crossing of it or two.
const SAME_CORNER: f64 = 1e-9;

/// A place across the contact normal, and the depth in m below the foremost point of the piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// First coordinate across the normal, in m.
    pub x: f64,
    /// Second coordinate across the normal, in m.
    pub y: f64,
    /// Depth in m.
    pub depth: f64,
}

/// Corners of a piece; as many as bodies mostly have need no allocation.
pub type Piece = SmallVec<[Place; 8]>;

/// Two unit vectors at right angles to a normal and to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Across {
    /// The first.
    pub x: Vector,
    /// The second.
    pub y: Vector,
}

impl Across {
    /// The same for the same normal.
    pub fn of(normal: &Vector) -> Across {
        let across = basis(normal);
        Across { x: across.column(0).into(), y: across.column(1).into() }
    }
}

/// Corners of a core that lie no deeper than `reach` under its foremost point in a direction, in the frame in which `relative` places it; convex,
/// counterclockwise, at least one.
pub fn facing_piece(core: &Core, relative: &Relative, normal: &Vector, sign: f64, reach: f64, across: &Across) -> Piece {
    let direction = relative.rotation.tr_mul(&(normal * sign));
    let (x, y) = (relative.rotation.tr_mul(&across.x), relative.rotation.tr_mul(&across.y));
    let centre = (relative.position.dot(&across.x), relative.position.dot(&across.y));
    let mut places = Piece::new();
    let mut add = |corner: Vector, depth: f64| {
        if depth <= reach {
            places.push(Place { x: centre.0 + corner.dot(&x), y: centre.1 + corner.dot(&y), depth: depth.max(0.0) });
        }
    };
    if let Core::Box { half_lengths } = core {
        each_corner_of_box(half_lengths, &direction, add);
    } else {
        let foremost = core.support(&direction).dot(&direction);
        each_corner(core, &direction, |corner| add(corner, foremost - corner.dot(&direction)));
    }
    keep_outline(&mut places);
    places
}

/// Calls back with every corner of a box and its depth below the foremost one, which grows with every side that is left for the one opposite.
fn each_corner_of_box(half_lengths: &Vector, direction: &Vector, mut call: impl FnMut(Vector, f64)) {
    let foremost = half_lengths.zip_map(direction, f64::copysign);
    let drop = 2.0 * half_lengths.component_mul(&direction.abs());
    for (z, below_z) in [(foremost.z, 0.0), (-foremost.z, drop.z)] {
        for (y, below_y) in [(foremost.y, below_z), (-foremost.y, below_z + drop.y)] {
            for (x, below) in [(foremost.x, below_y), (-foremost.x, below_y + drop.x)] {
                call(Vector::new(x, y, z), below);
            }
        }
    }
}

/// Calls back with every corner of a core; with points of the rims for a cylinder, the foremost one in a direction among them; with the foremost
/// point alone for a smooth one.
pub fn each_corner(core: &Core, direction: &Vector, mut call: impl FnMut(Vector)) {
    match core {
        Core::Point => call(Vector::zeros()),
        Core::Segment { half_length } => [-half_length, *half_length].into_iter().for_each(|z| call(Vector::new(0.0, 0.0, z))),
        Core::Box { half_lengths } => {
            for place in 0..8 {
                let side = |axis: usize| if place & (1 << axis) == 0 { -half_lengths[axis] } else { half_lengths[axis] };
                call(Vector::new(side(0), side(1), side(2)));
            }
        }
        Core::Cylinder { radius, half_length } => {
            for point in rim_directions::<RIM_POINTS>(direction) {
                for z in [-half_length, *half_length] {
                    call(Vector::new(radius * point[0], radius * point[1], z));
                }
            }
        }
        Core::Polyhedron(polyhedron) => polyhedron.vertices().iter().for_each(|vertex| call(*vertex)),
        Core::Superellipsoid(shape) => call(shape.support(direction)),
        Core::Polygon(polygon) => polygon.corners().iter().for_each(|corner| call(*corner)),
    }
}

/// Directions to points of a rim about z, evenly spaced, the first the one that is foremost in a direction.
pub fn rim_directions<const COUNT: usize>(direction: &Vector) -> [[f64; 2]; COUNT] {
    let across = direction.x.hypot(direction.y);
    // Straight along the axis no point is foremost: the choice is the body's own x axis.
    let is_along_axis = across <= 4.0 * f64::EPSILON * direction.z.abs();
    let (cosine, sine) = if is_along_axis { (1.0, 0.0) } else { (direction.x / across, direction.y / across) };
    std::array::from_fn(|place| {
        let (turn_sine, turn_cosine) = match 4 * place {
            0 => (0.0, 1.0),
            quarter if quarter == COUNT => (1.0, 0.0),
            half if half == 2 * COUNT => (0.0, -1.0),
            last if last == 3 * COUNT => (-1.0, 0.0),
            _ => (std::f64::consts::TAU * place as f64 / COUNT as f64).sin_cos(),
        };
        [cosine * turn_cosine - sine * turn_sine, sine * turn_cosine + cosine * turn_sine]
    })
}

/// Leaves the convex outline of places, counterclockwise (Andrew's monotone chain): a point, the two ends of a line, or a polygon.
fn keep_outline(places: &mut Piece) {
    if places.len() < 3 {
        return;
    }
    places.sort_by(|left, right| (left.x, left.y).partial_cmp(&(right.x, right.y)).unwrap_or(std::cmp::Ordering::Equal));
    let flat = 1e-12 * extent(places) * extent(places);
    let mut outline = Piece::new();
    add_chain(&mut outline, places.iter(), flat);
    add_chain(&mut outline, places.iter().rev(), flat);
    if outline.is_empty() {
        places.truncate(1);
    } else {
        places.clear();
        places.extend_from_slice(&outline);
    }
}

/// Adds half an outline from sorted places, without its last one, with which the other half begins.
fn add_chain<'a>(outline: &mut Piece, places: impl Iterator<Item = &'a Place>, flat: f64) {
    let start = outline.len();
    for place in places {
        while outline.len() >= start + 2 && turn(&outline[outline.len() - 2], &outline[outline.len() - 1], place) <= flat {
            outline.pop();
        }
        outline.push(*place);
    }
    outline.pop();
}

/// Twice the area of a triangle: positive if it turns left.
fn turn(from: &Place, over: &Place, to: &Place) -> f64 {
    (over.x - from.x) * (to.y - from.y) - (over.y - from.y) * (to.x - from.x)
}

/// Depth of a piece as a linear function of the place.
struct Slope {
    middle: Place,
    x: f64,
    y: f64,
}

impl Slope {
    /// The plane nearest to all corners; along a straight piece, the line.
    fn of(piece: &[Place]) -> Slope {
        let count = piece.len() as f64;
        let mean = |of: fn(&Place) -> f64| piece.iter().map(of).sum::<f64>() / count;
        let middle = Place { x: mean(|place| place.x), y: mean(|place| place.y), depth: mean(|place| place.depth) };
        let [mut xx, mut xy, mut yy, mut xd, mut yd] = [0.0; 5];
        for place in piece {
            let (x, y, depth) = (place.x - middle.x, place.y - middle.y, place.depth - middle.depth);
            xx += x * x;
            xy += x * y;
            yy += y * y;
            xd += x * depth;
            yd += y * depth;
        }
        let (determinant, trace) = (xx * yy - xy * xy, xx + yy);
        if trace == 0.0 {
            Slope { middle, x: 0.0, y: 0.0 }
        } else if piece.len() > 2 && determinant > 1e-9 * trace * trace {
            Slope { middle, x: (yy * xd - xy * yd) / determinant, y: (xx * yd - xy * xd) / determinant }
        } else {
            // All on one line: the slope along it.
            Slope { middle, x: xd / trace, y: yd / trace }
        }
    }

    fn depth_at(&self, x: f64, y: f64) -> f64 {
        self.middle.depth + self.x * (x - self.middle.x) + self.y * (y - self.middle.y)
    }
}

/// Calls back with the corners of what two pieces have in common across the normal, each with its depth below both pieces together, and the depth below the
/// first alone. There are none if they meet in a point: then the nearest points of the distance are the contact.
pub fn common_piece(first: &[Place], second: &[Place], mut call: impl FnMut(Place, f64)) {
    let mut shared = match (first.len(), second.len()) {
        (0 | 1, _) | (_, 0 | 1) => return,
        (2, 2) => common_stretch(first, second),
        (2, _) => clipped(first, second),
        _ => clipped(second, first),
    };
    if shared.is_empty() {
        return;
    }
    drop_doubles(&mut shared, first);
    let (slope_of_first, slope_of_second) = (Slope::of(first), Slope::of(second));
    for place in shared {
        let below_first = slope_of_first.depth_at(place.x, place.y);
        let depth = below_first + slope_of_second.depth_at(place.x, place.y);
        call(Place { depth, ..place }, below_first);
    }
}

/// Leaves one of corners that lie at the same place to rounding: each would carry a spring of its own.
fn drop_doubles(corners: &mut Piece, piece: &[Place]) {
    let is_same = |one: &Place, other: &Place| (one.x - other.x).abs().max((one.y - other.y).abs()) <= SAME_CORNER * extent(piece);
    corners.dedup_by(|next, kept| is_same(next, kept));
    if let [first, .., last] = corners.as_slice()
        && is_same(first, last)
    {
        corners.pop();
    }
}

/// Largest coordinate of a piece.
fn extent(piece: &[Place]) -> f64 {
    piece.iter().map(|place| place.x.abs().max(place.y.abs())).fold(0.0, f64::max)
}

/// Common stretch of two nearly parallel lines, seen along the first.
fn common_stretch(first: &[Place], second: &[Place]) -> Piece {
    let (dx, dy) = (first[1].x - first[0].x, first[1].y - first[0].y);
    let (ex, ey) = (second[1].x - second[0].x, second[1].y - second[0].y);
    let (squared, other_squared) = (dx * dx + dy * dy, ex * ex + ey * ey);
    let sine = dx * ey - dy * ex;
    if squared == 0.0 || other_squared == 0.0 || sine * sine > PARALLEL * PARALLEL * squared * other_squared {
        return Piece::new();
    }
    let along = |place: &Place| ((place.x - first[0].x) * dx + (place.y - first[0].y) * dy) / squared;
    let (one, other) = (along(&second[0]), along(&second[1]));
    let (low, high) = (one.min(other).max(0.0), one.max(other).min(1.0));
    if low > high {
        return Piece::new();
    }
    [low, high].into_iter().map(|part| Place { x: first[0].x + part * dx, y: first[0].y + part * dy, depth: 0.0 }).collect()
}

/// The part of a line or polygon inside a counterclockwise polygon (Sutherland and Hodgman).
fn clipped(piece: &[Place], polygon: &[Place]) -> Piece {
    let is_line = piece.len() == 2;
    let mut inside = Piece::from_slice(piece);
    let mut heights = SmallVec::<[f64; 16]>::new();
    for (place, from) in polygon.iter().enumerate() {
        if is_line && inside.len() == 1 {
            break;
        }
        let to = &polygon[if place + 1 == polygon.len() { 0 } else { place + 1 }];
        heights.clear();
        heights.extend(inside.iter().map(|corner| turn(from, to, corner)));
        if heights.iter().all(|height| *height >= 0.0) {
            continue;
        }
        let corners = std::mem::take(&mut inside);
        for (index, (corner, height)) in corners.iter().zip(&heights).enumerate() {
            if *height >= 0.0 {
                inside.push(*corner);
            }
            let next = if index + 1 == corners.len() { 0 } else { index + 1 };
            let ends_here = is_line && next == 0;
            if !ends_here && (*height >= 0.0) != (heights[next] >= 0.0) {
                let part = height / (height - heights[next]);
                let between = |one: f64, other: f64| one + part * (other - one);
                inside.push(Place { x: between(corner.x, corners[next].x), y: between(corner.y, corners[next].y), depth: 0.0 });
            }
        }
    }
    inside
}
