//! Prescribed motion of a wall: what moves it is not asked, and what it meets does not slow it.
//!
//! A point that is at $x_0$ at rest is at $x(t) = c + s(t) + R(t) (x_0 - c)$: turned about an axis through $c$, and shifted by the sum of a
//! translation and an oscillation, which take the axis along. Before the start of a motion the wall rests where it begins; after its end, where it ends.

use nalgebra::{Matrix3, Unit};

use crate::distance::Pose;
use crate::{Orientation, Vector};

/// From when to when a wall moves, in s; the end may be infinite.
pub type Interval = [f64; 2];

/// Straight motion at constant velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Translation {
    /// Velocity in m/s.
    pub velocity: Vector,
    /// When.
    pub interval: Interval,
}

/// Harmonic motion along a line: $A \sin(2 \pi f (t - t_0) + \varphi)$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillation {
    /// Amplitude and direction in m.
    pub amplitude: Vector,
    /// Frequency in Hz.
    pub frequency: f64,
    /// Phase at the start in rad; anything but whole half turns shifts the wall from the outset.
    pub phase: f64,
    /// When.
    pub interval: Interval,
}

/// Turning about an axis at constant rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// A point of the axis at rest, in m.
    pub point: Vector,
    /// Angular velocity in rad/s.
    pub angular_velocity: Vector,
    /// When.
    pub interval: Interval,
}

/// How a wall moves. Whatever is absent does not.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Motion {
    /// Straight motion.
    pub translation: Option<Translation>,
    /// Shaking.
    pub oscillation: Option<Oscillation>,
    /// Turning.
    pub turn: Option<Turn>,
    /// When the wall is taken away, in s.
    pub removed_at: Option<f64>,
}

/// Time in s since the start of an interval, up to its end.
fn elapsed(interval: &Interval, time: f64) -> f64 {
    time.min(interval[1]).max(interval[0]) - interval[0]
}

/// Whether a wall moves at a time: from the start on, no more at the end.
fn is_during(interval: &Interval, time: f64) -> bool {
    (interval[0]..interval[1]).contains(&time)
}

impl Oscillation {
    /// Angle in rad, less whole turns: the sine of many of them would lose digits.
    fn angle(&self, time: f64) -> f64 {
        let turns = self.frequency * elapsed(&self.interval, time);
        std::f64::consts::TAU * (turns - turns.floor()) + self.phase
    }
}

impl Motion {
    /// Whether the wall stays where it is, until it is removed if it is.
    #[inline]
    pub fn is_rest(&self) -> bool {
        self.translation.is_none() && self.oscillation.is_none() && self.turn.is_none()
    }

    /// Whether the wall has been taken away: from the time of its removal on.
    #[inline]
    pub fn is_removed(&self, time: f64) -> bool {
        self.removed_at.is_some_and(|removed_at| time >= removed_at)
    }

    /// How far the wall is shifted at a time, in m.
    fn shift(&self, time: f64) -> Vector {
        let straight = self.translation.map_or(Vector::zeros(), |motion| motion.velocity * elapsed(&motion.interval, time));
        straight + self.oscillation.map_or(Vector::zeros(), |motion| motion.amplitude * motion.angle(time).sin())
    }

    /// Place and turn of the wall at a time: what a point at rest is turned and then shifted by.
    pub fn pose(&self, time: f64) -> Pose {
        let shift = self.shift(time);
        match &self.turn {
            None => Pose { position: shift, rotation: Matrix3::identity() },
            Some(turn) => {
                let (axis, rate) = Unit::new_and_get(turn.angular_velocity);
                let angle = rate * elapsed(&turn.interval, time);
                // Of an axis without length nothing is left but its angle, zero.
                let rotation = if angle == 0.0 {
                    Matrix3::identity()
                } else {
                    *Orientation::from_axis_angle(&axis, angle).to_rotation_matrix().matrix()
                };
                Pose { position: turn.point + shift - rotation * turn.point, rotation }
            }
        }
    }

    /// Velocity in m/s at a time of the material point of the wall that is then at a point.
    pub fn velocity(&self, time: f64, point: &Vector) -> Vector {
        let mut velocity = Vector::zeros();
        if let Some(motion) = self.translation.filter(|motion| is_during(&motion.interval, time)) {
            velocity += motion.velocity;
        }
        if let Some(motion) = self.oscillation.filter(|motion| is_during(&motion.interval, time)) {
            velocity += motion.amplitude * (std::f64::consts::TAU * motion.frequency * motion.angle(time).cos());
        }
        if let Some(turn) = self.turn.filter(|turn| is_during(&turn.interval, time)) {
            velocity += turn.angular_velocity.cross(&(point - turn.point - self.shift(time)));
        }
        velocity
    }

    /// Angular velocity in rad/s at a time.
    pub fn spin(&self, time: f64) -> Vector {
        self.turn.filter(|turn| is_during(&turn.interval, time)).map_or(Vector::zeros(), |turn| turn.angular_velocity)
    }

    /// Where a point of the axis of turning is at a time, in m, if the wall turns.
    pub fn point_of_axis(&self, time: f64) -> Option<Vector> {
        self.turn.map(|turn| turn.point + self.shift(time))
    }

    /// An upper bound in m/s of the speed at any time of the points of the wall at most so far, in m, from the axis of its turning.
    pub fn largest_speed(&self, from_axis: f64) -> f64 {
        let straight = self.translation.map_or(0.0, |motion| motion.velocity.norm());
        let shaking = self.oscillation.map_or(0.0, |motion| motion.amplitude.norm() * std::f64::consts::TAU * motion.frequency.abs());
        // A wall that does not turn may be infinite.
        let turning = self.turn.map_or(0.0, |turn| turn.angular_velocity.norm() * from_axis);
        straight + shaking + turning
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    const ALWAYS: Interval = [0.0, f64::INFINITY];

    fn place(motion: &Motion, time: f64, at_rest: Vector) -> Vector {
        let pose = motion.pose(time);
        pose.position + pose.rotation * at_rest
    }

    #[test]
    fn a_wall_goes_straight_from_its_start_to_its_end() {
        let translation = Some(Translation { velocity: Vector::new(0.0, 0.5, -2.0), interval: [1.0, 3.0] });
        let motion = Motion { translation, ..Motion::default() };
        for (time, shift, moves) in [(0.0, 0.0, false), (1.0, 0.0, true), (1.5, 0.5, true), (3.0, 2.0, false), (9.0, 2.0, false)] {
            assert_eq!(place(&motion, time, Vector::x()), Vector::x() + Vector::new(0.0, 0.5, -2.0) * shift);
            let expected = if moves { Vector::new(0.0, 0.5, -2.0) } else { Vector::zeros() };
            assert_eq!(motion.velocity(time, &Vector::x()), expected, "{time}");
        }
        assert!(!motion.is_rest() && Motion::default().is_rest());
    }

    /// Quarter periods have exact places and speeds, after a million periods as after one.
    #[test]
    fn a_wall_shakes_at_its_frequency() {
        let oscillation = Oscillation { amplitude: Vector::z() * 0.25, frequency: 4.0, phase: 0.0, interval: ALWAYS };
        let motion = Motion { oscillation: Some(oscillation), ..Motion::default() };
        for periods in [0.0, 1.0, 1e6] {
            for (quarter, sine, cosine) in [(0.0, 0.0, 1.0), (1.0, 1.0, 0.0), (2.0, 0.0, -1.0), (3.0, -1.0, 0.0)] {
                let time = (periods + 0.25 * quarter) / 4.0;
                assert!((motion.pose(time).position.z - 0.25 * sine).abs() < 1e-15, "{time}");
                assert!((motion.velocity(time, &Vector::zeros()).z - TAU * cosine).abs() < 1e-14, "{time}");
            }
        }
        assert_eq!(motion.largest_speed(f64::INFINITY), TAU);
        let late = Oscillation { phase: FRAC_PI_2, interval: [2.0, 2.125], ..oscillation };
        let late = Motion { oscillation: Some(late), ..motion };
        assert_eq!((late.pose(0.0).position.z, late.velocity(0.0, &Vector::zeros())), (0.25, Vector::zeros()));
        // Half a period later it stops at the other end.
        assert!((late.pose(5.0).position.z + 0.25).abs() < 1e-15);
    }

    #[test]
    fn a_wall_turns_about_its_axis() {
        let turn = Turn { point: Vector::new(1.0, 0.0, 0.0), angular_velocity: Vector::z() * PI, interval: [0.0, 0.5] };
        let motion = Motion { turn: Some(turn), ..Motion::default() };
        let quarter = place(&motion, 0.5, Vector::new(3.0, 0.0, 7.0));
        assert!((quarter - Vector::new(1.0, 2.0, 7.0)).norm() < 1e-15, "{quarter}");
        assert_eq!(motion.velocity(0.25, &Vector::new(1.0, 2.0, 7.0)), Vector::new(-2.0 * PI, 0.0, 0.0));
        assert_eq!(motion.velocity(0.5, &Vector::new(1.0, 2.0, 7.0)), Vector::zeros());
        assert_eq!(motion.largest_speed(2.0), 2.0 * PI);
        let still = Turn { angular_velocity: Vector::zeros(), ..turn };
        assert_eq!(Motion { turn: Some(still), ..motion }.pose(3.0).rotation, Matrix3::identity());
    }

    /// The velocity is the derivative of the place, for all motions at once: central differences of second order.
    #[test]
    fn velocity_is_the_rate_of_the_place() {
        let motion = Motion {
            translation: Some(Translation { velocity: Vector::new(0.3, -0.2, 0.1), interval: ALWAYS }),
            oscillation: Some(Oscillation { amplitude: Vector::new(0.1, 0.2, 0.0), frequency: 1.5, phase: 0.4, interval: ALWAYS }),
            turn: Some(Turn { point: Vector::new(1.0, 2.0, 3.0), angular_velocity: Vector::new(1.0, -2.0, 0.5), interval: ALWAYS }),
            removed_at: Some(4.0),
        };
        let (at_rest, half) = (Vector::new(0.5, 0.5, -1.0), 1e-4);
        for time in [0.7, 1.3, 2.9] {
            let rate = (place(&motion, time + half, at_rest) - place(&motion, time - half, at_rest)) / (2.0 * half);
            let velocity = motion.velocity(time, &place(&motion, time, at_rest));
            // Third derivatives: about 0.22 (2 pi 1.5)^3 + 2.3^3 4.6, times half^2 / 6.
            assert!((rate - velocity).norm() < 4e-7, "{time}: {rate} {velocity}");
            assert!(velocity.norm() <= motion.largest_speed((at_rest - motion.turn.unwrap().point).norm()));
        }
        assert!(!motion.is_removed(3.999) && motion.is_removed(4.0) && !Motion::default().is_removed(1e9));
    }
}
