//! How long two bodies in free flight certainly stay apart: conservative advancement of second order.
//!
//! For any fixed direction $n$ the gap at a time $\tau$ from now is at least the distance of the two supporting planes across $n$,
//! $g(\tau) = n \cdot \Delta x(\tau) - h_1(\tau) - h_2(\tau)$. A material point $r$ of a turning body moves along $n$ by
//! $\tau\, n \cdot (\omega \times r)$ and at most $\tau^2 \omega^2 |r|$ besides ($|\dot\omega| \le \omega^2$ in free flight, whatever the moments), so that
//!
//! $$g(\tau) \ge F(\tau) = n \cdot \Delta x(\tau) - h_1(n + \tau\, n \times \omega_1) - h_2(-n - \tau\, n \times \omega_2) - \tau^2 (\omega_1^2 R_1 + \omega_2^2 R_2),$$
//!
//! with the supports $h$ of the bodies as they are turned now. $F$ is concave, so its first zero is found to any accuracy from below with two
//! supports a try, without a search for the distance; until then the bodies are apart, **certainly**. With $n$ along the present distance the gap that is left
//! falls with the square of the one before. The usual bound, the gap over $v \cdot n + \omega_1 R_1 + \omega_2 R_2$ (B. Mirtich 1996), falls by a
//! factor. Centred balls have no turning part: there the zero is that of the exact quadratic.

use super::flight::{Flight, approach_rate};
use crate::Vector;
use crate::boundary::Plane;
use crate::contact::impulse::CollisionPoint;
use crate::contact::shaped::DetectedPart;
use crate::distance::{Core, Guess, Pose, Query, RoundedCore, separation};

/// A body of a pair at one time.
#[derive(Debug, Clone, Copy)]
pub struct Side<'a> {
    /// Its state.
    pub flight: Flight,
    /// Its convex parts.
    pub parts: &'a [DetectedPart],
    /// Radius in m of a ball about the centre of mass that holds it.
    pub bounding_radius: f64,
}

/// What is known of a pair at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Look {
    /// They touch and approach.
    Touch(CollisionPoint),
    /// They certainly stay apart for this time in s.
    ClearFor(f64),
    /// They overlap by this depth in m, which free flight and impulses do not lead to.
    Overlap(f64),
}

/// What a look needs besides the bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Gap at which bodies touch, as a part of their size.
    pub tolerance: f64,
    /// Time in s beyond which nothing is asked.
    pub horizon: f64,
}

/// Overlap, as a part of size, that rounding does not explain.
const DEEP: f64 = 1e-7;

/// A part of a body in its place.
#[derive(Clone, Copy)]
struct PlacedPart<'a> {
    rounded: &'a RoundedCore,
    pose: Pose,
    /// From the centre of mass of the body to that of the part, in m.
    offset: Vector,
    spin: Vector,
    /// Bound in m/s^2 on the acceleration of points by turning.
    centripetal: f64,
}

impl<'a> PlacedPart<'a> {
    fn new(side: &Side<'_>, part: &DetectedPart, rounded: &'a RoundedCore) -> PlacedPart<'a> {
        let orientation = side.flight.orientation;
        let offset = orientation * part.position;
        let rotation = *(orientation * part.orientation).to_rotation_matrix().matrix();
        let reach = part.position.norm() + rounded.core.reach();
        let spin = side.flight.largest_spin();
        // The ball round the core turns into itself: only the core counts.
        let centripetal = if reach > 0.0 { 2.0 * spin * spin * reach } else { 0.0 };
        PlacedPart {
            rounded,
            pose: Pose { position: side.flight.position + offset, rotation },
            offset,
            spin: side.flight.spin(),
            centripetal,
        }
    }

    /// Farthest point of the core in a direction, from the centre of mass of the body.
    fn farthest(&self, direction: &Vector) -> Vector {
        self.offset + self.pose.rotation * self.rounded.core.support(&self.pose.rotation.tr_mul(direction))
    }

    /// Support of the core in a direction that turns against the body for a time.
    fn turned_support(&self, direction: &Vector, time: f64) -> f64 {
        if matches!(self.rounded.core, Core::Point) && self.offset == Vector::zeros() {
            return 0.0;
        }
        let turned = direction + direction.cross(&self.spin) * time;
        self.farthest(&turned).dot(&turned)
    }
}

/// The lower bound $F$ of a gap.
struct Closing<'a> {
    first: PlacedPart<'a>,
    second: Option<PlacedPart<'a>>,
    normal: Vector,
    /// Distance in m along the normal of the centres of mass, or of the centre and the wall, less both rounding radii.
    between: f64,
    /// Rate of the same in m/s.
    rate: f64,
    /// Second-order loss in m/s^2, at least zero.
    loss: f64,
    /// Added so that what touches but parts can move off, in m.
    lift: f64,
}

impl Closing<'_> {
    fn gap_after(&self, time: f64) -> f64 {
        let supports = self.first.turned_support(&self.normal, time)
            + self.second.as_ref().map_or(0.0, |second| second.turned_support(&-self.normal, time));
        self.lift + self.between + self.rate * time - supports - 0.5 * self.loss * time * time
    }

    /// Upper bound in s on the zero: that of the tangent at present.
    fn latest_zero(&self, approach_rate: f64, gap: f64) -> f64 {
        if self.loss == 0.0 {
            return if approach_rate > 0.0 { gap / approach_rate } else { f64::INFINITY };
        }
        let root = (approach_rate * approach_rate + 2.0 * self.loss * gap).sqrt();
        // The form without a difference of near numbers.
        if approach_rate > 0.0 { 2.0 * gap / (approach_rate + root) } else { (root - approach_rate) / self.loss }
    }

    /// Time in s before which the gap is certainly open, at most a horizon.
    fn clear_for(&self, approach_rate: f64, horizon: f64) -> f64 {
        let start = self.gap_after(0.0);
        // The tangent bounds a concave function from above; a little more makes up for rounding.
        let mut high = (self.latest_zero(approach_rate, start) * (1.0 + 1e-9)).min(horizon);
        let mut at_high = self.gap_after(high);
        if at_high >= 0.0 {
            return high;
        }
        let (mut low, mut at_low) = (0.0, start);
        for _ in 0..LARGEST_NUMBER_OF_TRIES {
            // The chord of a concave function lies below it.
            let on_chord = low + (high - low) * (at_low / (at_low - at_high));
            let at_chord = self.gap_after(on_chord);
            if at_chord > 0.0 {
                (low, at_low) = (on_chord, at_chord);
            }
            if at_low <= NEAR_ENOUGH * start || high - low <= NEAR_ENOUGH * low {
                break;
            }
            let middle = 0.5 * (low + high);
            let at_middle = self.gap_after(middle);
            if at_middle > 0.0 {
                (low, at_low) = (middle, at_middle);
            } else {
                (high, at_high) = (middle, at_middle);
            }
        }
        low
    }
}

/// Tries for the zero of a lower bound.
const LARGEST_NUMBER_OF_TRIES: usize = 60;
/// A lower bound this near to its zero, as a part of what it was, is near enough: the next look begins from there.
const NEAR_ENOUGH: f64 = 1e-4;

/// What is known of two parts whose gap, normal and nearest points are given.
fn look(closing: Closing<'_>, gap: f64, point: CollisionPoint, sides: (&Side<'_>, Option<&Side<'_>>), settings: &Settings) -> Look {
    let size = sides.0.bounding_radius + sides.1.map_or(0.0, |side| side.bounding_radius);
    let approach_rate = approach_rate(&sides.0.flight, sides.1.map(|side| &side.flight), &point);
    if gap < -DEEP * size {
        return Look::Overlap(-gap);
    }
    let (tolerance, certain_gap) = (settings.tolerance * size, closing.gap_after(0.0));
    let touches = certain_gap <= tolerance;
    if touches && approach_rate > 0.0 {
        return Look::Touch(point);
    }
    // A fixed level below the surface, so that repeated touches do not sink step by step.
    let lift = if touches { tolerance.max(-certain_gap) } else { 0.0 };
    Look::ClearFor(Closing { lift, ..closing }.clear_for(approach_rate, settings.horizon))
}

/// The nearer event of two.
fn sooner(one: Look, other: Look) -> Look {
    match (one, other) {
        (Look::ClearFor(time), Look::ClearFor(other)) => Look::ClearFor(time.min(other)),
        (Look::ClearFor(_), event) | (event, _) => event,
    }
}

/// What is known of two bodies. `guesses` hold one entry for each two parts, what the last look left.
pub fn look_at_bodies(first: &Side<'_>, second: &Side<'_>, guesses: &mut Vec<Option<Guess>>, settings: &Settings) -> Look {
    let mut known = Look::ClearFor(settings.horizon);
    guesses.resize(first.parts.len() * second.parts.len(), None);
    for (place, part) in first.parts.iter().enumerate() {
        let one = PlacedPart::new(first, part, &part.against_bodies);
        for (other_place, other_part) in second.parts.iter().enumerate() {
            let other = PlacedPart::new(second, other_part, &other_part.against_bodies);
            let guess = &mut guesses[place * second.parts.len() + other_place];
            let query = Query { guess: *guess, cutoff: f64::INFINITY };
            let found = separation((&one.rounded.core, &one.pose), (&other.rounded.core, &other.pose), &query);
            *guess = Some(found.guess());
            let radii = one.rounded.radius + other.rounded.radius;
            let point = CollisionPoint {
                normal: found.normal,
                arm_of_first: one.offset + found.on_first + found.normal * one.rounded.radius,
                arm_of_second: other.offset + found.on_second - found.normal * other.rounded.radius,
            };
            let closing = Closing {
                between: (second.flight.position - first.flight.position).dot(&found.normal) - radii,
                rate: (second.flight.velocity - first.flight.velocity).dot(&found.normal),
                loss: one.centripetal + other.centripetal,
                normal: found.normal,
                first: one,
                second: Some(other),
                lift: 0.0,
            };
            known = sooner(known, look(closing, found.distance - radii, point, (first, Some(second)), settings));
        }
    }
    known
}

/// What is known of a body and a flat wall.
pub fn look_at_wall(side: &Side<'_>, wall: &Plane, settings: &Settings) -> Look {
    let mut known = Look::ClearFor(settings.horizon);
    for part in side.parts {
        let one = PlacedPart::new(side, part, &part.against_walls);
        let normal = -wall.normal;
        let lowest = one.farthest(&normal) + normal * one.rounded.radius;
        let height = wall.height(&side.flight.position);
        let point = CollisionPoint { normal, arm_of_first: lowest, arm_of_second: Vector::zeros() };
        let closing = Closing {
            between: height - one.rounded.radius,
            rate: side.flight.velocity.dot(&wall.normal),
            // Gravity may only bring the body nearer: what lifts it is left out of the bound.
            loss: one.centripetal + (-side.flight.acceleration().dot(&wall.normal)).max(0.0),
            normal,
            first: one,
            second: None,
            lift: 0.0,
        };
        known = sooner(known, look(closing, height - lowest.dot(&normal), point, (side, None), settings));
    }
    known
}

/// Time in s from now at which two balls that fly straight touch; zero if they overlap, infinite if they never touch.
pub fn time_to_meet(relative_position: &Vector, relative_velocity: &Vector, reach: f64) -> f64 {
    let apart = relative_position.norm_squared() - reach * reach;
    if apart <= 0.0 {
        return 0.0;
    }
    let closing = -relative_position.dot(relative_velocity);
    let discriminant = closing * closing - relative_velocity.norm_squared() * apart;
    if closing <= 0.0 || discriminant < 0.0 { f64::INFINITY } else { apart / (closing + discriminant.sqrt()) }
}

/// Time in s from now at which a ball at a height above a wall touches it; zero if it does, infinite if it never will.
pub fn time_to_fall(height: f64, velocity: f64, acceleration: f64, radius: f64) -> f64 {
    let apart = height - radius;
    if apart <= 0.0 {
        return 0.0;
    }
    let discriminant = velocity * velocity - 2.0 * acceleration * apart;
    if discriminant < 0.0 || (velocity >= 0.0 && acceleration >= 0.0) {
        return f64::INFINITY;
    }
    let root = discriminant.sqrt();
    // Of apart + v t + a t^2/2: the first zero ahead, in the form without a difference of near numbers.
    if velocity <= 0.0 { 2.0 * apart / (root - velocity) } else { (-velocity - root) / acceleration }
}

#[cfg(test)]
mod tests;
