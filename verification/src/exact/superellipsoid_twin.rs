//! Distance and normal of two superellipsoids by bisection: slow, independent of the solver, and without a start that could mislead it.
//!
//! For a direction $d$ of any length the supporting planes leave the gap $g(d) = d \cdot r - h_1(d) - h_2(-d)$. Of all unit directions the normal has the
//! largest; of sets that are apart that is their distance, and $g(d)/|d|$ has no other maximum in the half space where it is positive. Of a
//! shallow overlap it is the least depth near by, negative. Over a plane of directions the slope of the one coordinate changes its sign once; over the other,
//! the slope at the best of the first. Both are bisected to the last bit. The plane lies about the best of several hundred directions.
//!
//! The support function is written out with plain powers: Barr (1981), by Hölder's inequality.

use nalgebra::{Matrix3, Vector3};

type Vector = Vector3<f64>;

/// A superellipsoid in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Semi-axes in m.
    pub semi_axes: Vector,
    /// Exponents towards z and in the plane of x and y, below two.
    pub exponents: [f64; 2],
    /// Centre in m.
    pub position: Vector,
    /// From the own frame to the world.
    pub rotation: Matrix3<f64>,
}

impl Placed {
    /// Farthest point in a direction, from the centre.
    pub fn support(&self, direction: &Vector) -> Vector {
        let scaled = self.rotation.tr_mul(direction).component_mul(&self.semi_axes).normalize();
        let [outer, inner] = self.exponents.map(|exponent| 2.0 / (2.0 - exponent));
        let in_plane = (scaled.x.abs().powf(inner) + scaled.y.abs().powf(inner)).powf(1.0 / inner);
        let whole = (in_plane.powf(outer) + scaled.z.abs().powf(outer)).powf(1.0 / outer);
        let share = |part: f64, of: f64, power: f64| if of > 0.0 { (part.abs() / of).powf(power - 1.0).copysign(part) } else { 0.0 };
        let across = share(in_plane, whole, outer);
        let point = Vector::new(
            share(scaled.x, in_plane, inner) * across,
            share(scaled.y, in_plane, inner) * across,
            share(scaled.z, whole, outer),
        );
        self.rotation * point.component_mul(&self.semi_axes)
    }
}

/// Distance in m, negative by the depth, and unit normal from the first to the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// Distance in m.
    pub distance: f64,
    /// Unit vector.
    pub normal: Vector,
}

/// Halvings of an interval: to the last bit and a few more.
const HALVINGS: usize = 58;

struct Planes<'a> {
    first: &'a Placed,
    second: &'a Placed,
}

impl Planes<'_> {
    /// The vector between both supported points, and the gap over the length of the direction.
    fn gap(&self, direction: &Vector) -> (Vector, f64) {
        let between = self.second.position - self.first.position + self.second.support(&-direction) - self.first.support(direction);
        (between, between.dot(direction) / direction.norm())
    }

    /// Sign of the slope of the gap along a vector.
    fn rises(&self, direction: &Vector, along: &Vector) -> bool {
        let (between, gap) = self.gap(direction);
        (between * direction.norm() - direction * gap).dot(along) > 0.0
    }

    fn best_in_window(&self, centre: Vector, window: f64) -> Vector {
        let one = centre.cross(&Vector::ith(centre.iamin(), 1.0)).normalize();
        let other = centre.cross(&one);
        let best_of_other = |along_one: f64| {
            let (mut low, mut high) = (-window, window);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                let rises = self.rises(&(centre + one * along_one + other * middle), &other);
                (low, high) = if rises { (middle, high) } else { (low, middle) };
            }
            centre + one * along_one + other * (0.5 * (low + high))
        };
        let (mut low, mut high) = (-window, window);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let rises = self.rises(&best_of_other(middle), &one);
            (low, high) = if rises { (middle, high) } else { (low, middle) };
        }
        best_of_other(0.5 * (low + high)).normalize()
    }
}

/// Directions even over the sphere, by the golden angle.
fn spread_directions(count: usize) -> impl Iterator<Item = Vector> {
    (0..count).map(move |index| {
        let (height, angle) = (1.0 - (2.0 * index as f64 + 1.0) / count as f64, 2.399_963_229_728_653 * index as f64);
        let across = (1.0 - height * height).sqrt();
        Vector::new(across * angle.cos(), across * angle.sin(), height)
    })
}

/// Distance and normal of two superellipsoids that are apart, or overlap a little.
pub fn distance(first: &Placed, second: &Placed) -> Answer {
    let planes = Planes { first, second };
    let centre = spread_directions(400).max_by(|one, other| planes.gap(one).1.total_cmp(&planes.gap(other).1)).unwrap_or_else(Vector::x);
    let is_apart = planes.gap(&centre).1 > 0.0;
    // Where sets overlap, or almost touch, there are other maxima farther away.
    let normal = if is_apart { planes.best_in_window(centre, 2.0) } else { planes.best_in_window(centre, 0.2) };
    Answer { distance: planes.gap(&normal).1, normal }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(semi_axes: [f64; 3], exponents: [f64; 2], position: Vector) -> Placed {
        Placed { semi_axes: semi_axes.into(), exponents, position, rotation: Matrix3::identity() }
    }

    /// Exact: balls, and ellipsoids turned alike that are balls in scaled space and touch.
    #[test]
    fn balls_and_ellipsoids_turned_alike_are_exact() {
        let way = Vector::new(0.6, -0.3, 0.74).normalize();
        for gap in [0.3, 1e-6, -0.05] {
            let found = distance(&placed([1.0; 3], [1.0; 2], Vector::zeros()), &placed([0.4; 3], [1.0; 2], way * (1.4 + gap)));
            assert!((found.distance - gap).abs() < 1e-14 && (found.normal - way).norm() < 1e-12, "{gap}: {found:?}");
        }
        let axes = [1.0, 0.2, 2.0];
        let found =
            distance(&placed(axes, [1.0; 2], Vector::zeros()), &placed(axes, [1.0; 2], 2.0 * way.component_mul(&Vector::from(axes))));
        let normal = way.component_div(&Vector::from(axes)).normalize();
        assert!(found.distance.abs() < 1e-14 && (found.normal - normal).norm() < 1e-11, "{found:?}");
    }

    #[test]
    fn the_support_lies_on_the_surface() {
        let shape = placed([1.0, 0.5, 2.0], [0.3, 1.6], Vector::zeros());
        for direction in spread_directions(100) {
            let point = shape.support(&direction).component_div(&shape.semi_axes).abs();
            let [outer, inner] = shape.exponents.map(|exponent| 2.0 / exponent);
            let value = (point.x.powf(inner) + point.y.powf(inner)).powf(outer / inner) + point.z.powf(outer);
            assert!((value - 1.0).abs() < 1e-12, "{value}");
        }
    }
}
