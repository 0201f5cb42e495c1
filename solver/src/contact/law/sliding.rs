//! Where the force of a spring points that slides: at second order of the step.
//!
//! A spring with memory that is kept at the Coulomb force turns towards the slip, because motion stretches it along the slip and the cap shortens it along
//! itself: with the unit vector $e$ of the force and the trial force $T$ that sticking would give, $\dot e = (\dot T)_\perp / \mu F_n$. Along a straight slip
//! that does nothing; where the slip turns, as it does under bodies that are no balls, the force lags behind it by $\mu F_n / k |v|$ times the rate of the turn.
//!
//! Shortening the trial force of every step to the cap (radial return, as every code does) is the backward Euler method for this equation, with the slip of
//! half a step ago: first order, however well contacts and motion are resolved. Here the trial force is weighted so that the turn has the second order while
//! the step is short against the lag, and the slip at its end is followed while the step is long.

use super::carried::carried_along;
use super::{StepKind, TangentialContact};
use crate::Vector;

/// Force in N of the size of the cap.
///
/// `trial` is the force of sticking, `last` the force of the last step, `stiffness` that of the spring in N/m. Choices without branches, so that several
/// contacts can be evaluated at once: what is not chosen may be infinite.
#[inline(always)]
pub(super) fn sliding_force(
    trial: &Vector,
    last: &Vector,
    contact: &TangentialContact,
    kind: &StepKind,
    stiffness: f64,
    cap: f64,
) -> Vector {
    let last = carried_along(*last, &contact.normal, contact.twist);
    let last_size = last.norm_squared().sqrt();
    let mean_cap = 0.5 * (last_size + cap);
    let pull = trial - last;
    // Of a whole turn into the slip, this much in a step: small where steps resolve the lag.
    let part = pull.norm_squared().sqrt() / mean_cap;
    let slip_of_now = contact.velocity + contact.acceleration * (0.5 * kind.step);
    let since_middle = slip_of_now * kind.step - contact.displacement;
    let pull = pull - since_middle * (stiffness * part / (2.0 + part));
    let start = last * (mean_cap / last_size);
    let along = start.dot(&pull) / (mean_cap * mean_cap);
    // A pull against the force first unloads the spring, which sticks until it is as long again on another side; only the rest of the pull finds it sliding.
    let unloading = -2.0 * along * mean_cap * mean_cap / pull.norm_squared();
    let unloads = unloading > 0.0 && unloading < 1.0;
    let rest = if unloads { 1.0 - unloading } else { 1.0 };
    let weight = exponential_weight(if unloads { -along * rest } else { along });
    let turned = start + pull * if unloads { unloading + rest * weight } else { weight };
    let is_known = last_size > 0.0 && !kind.lagged_damping && !kind.synchronous;
    let aim = if is_known { turned } else { *trial };
    aim * (cap / aim.norm_squared().sqrt().max(f64::MIN_POSITIVE))
}

/// $(e^x - 1) / x$ to the second order of $x$, and below $-1/x$ where $x$ is negative, so that a force that is turned with it never vanishes.
#[inline(always)]
fn exponential_weight(x: f64) -> f64 {
    if x > 0.0 { 1.0 + x / 2.0 } else { 1.0 / (1.0 - x / 2.0 + x * x / 12.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STIFFNESS: f64 = 300.0;
    const SPEED: f64 = 2.0;

    /// The slip turns faster and faster.
    fn slip_angle(time: f64) -> f64 {
        time + 3.0 * time * time
    }

    fn cap(time: f64) -> f64 {
        20.0 + 30.0 * time
    }

    fn slip(time: f64) -> Vector {
        let angle = slip_angle(time);
        Vector::new(angle.cos(), angle.sin(), 0.0) * SPEED
    }

    /// Angle of the force, turned round, at a time: from right across the slip.
    fn by_steps(end: f64, steps: u32) -> f64 {
        let step = end / f64::from(steps);
        let kind = StepKind { step, synchronous: false, lagged_damping: false, resolved_edges: true };
        let mut force = Vector::y() * -cap(0.0);
        for index in 0..steps {
            let (before, after) = (f64::from(index) * step, f64::from(index + 1) * step);
            let half = 0.5 * (before + after);
            let acceleration = (slip(after + 1e-6) - slip(after - 1e-6)) / 2e-6;
            // Velocities are those of half a step ago.
            let contact = TangentialContact { displacement: slip(half) * step, acceleration, ..TangentialContact::at_velocity(slip(half)) };
            let trial = force - contact.displacement * STIFFNESS;
            force = sliding_force(&trial, &force, &contact, &kind, STIFFNESS, cap(after));
        }
        (-force.y).atan2(-force.x)
    }

    /// Independent: the angle to the slip falls as $\dot\theta = -(k v / \mu F_n) \sin\theta - \dot\alpha$, by the classical method of Runge and Kutta.
    fn exact(end: f64) -> f64 {
        let rate = |time: f64, angle: f64| SPEED * STIFFNESS / cap(time) * (slip_angle(time) - angle).sin();
        let (steps, mut angle) = (20_000, std::f64::consts::FRAC_PI_2);
        let step = end / f64::from(steps);
        for index in 0..steps {
            let time = f64::from(index) * step;
            let one = rate(time, angle);
            let two = rate(time + 0.5 * step, angle + 0.5 * step * one);
            let three = rate(time + 0.5 * step, angle + 0.5 * step * two);
            let four = rate(time + step, angle + step * three);
            angle += step / 6.0 * (one + 2.0 * two + 2.0 * three + four);
        }
        angle
    }

    /// While the force turns in from the side, and long after.
    #[test]
    fn the_force_follows_a_turning_slip_at_second_order() {
        for (end, coarse, allowed) in [(0.05, 10, 4e-3), (0.2, 40, 4e-3), (1.0, 100, 2e-4)] {
            let [coarse, fine] = [coarse, 4 * coarse].map(|steps| (by_steps(end, steps) - exact(end)).sin().abs());
            println!("{end}: {coarse:e} {fine:e}");
            assert!(coarse < allowed && fine < allowed / 12.0, "{end} s: {coarse:e} {fine:e}");
        }
    }

    /// Back along its own line the spring unloads and slides to the other side, in however long a step.
    #[test]
    fn a_slip_that_turns_back_turns_the_force_back() {
        let kind = StepKind { step: 0.1, synchronous: false, lagged_damping: false, resolved_edges: true };
        for speed in [0.4, 3.0, 100.0] {
            let contact =
                TangentialContact { displacement: Vector::x() * (0.1 * speed), ..TangentialContact::at_velocity(Vector::x() * speed) };
            let last = Vector::x() * 5.0;
            let trial = last - contact.displacement * STIFFNESS;
            let force = sliding_force(&trial, &last, &contact, &kind, STIFFNESS, 5.0);
            assert!((force + last).norm() < 16.0 * f64::EPSILON * 5.0, "{speed}: {force}");
        }
    }

    /// The size is that of the cap wherever the force points.
    #[test]
    fn the_size_is_that_of_the_cap() {
        let kind = StepKind { step: 0.1, synchronous: false, lagged_damping: false, resolved_edges: true };
        let contact = TangentialContact { displacement: Vector::x() * 0.3, ..TangentialContact::at_velocity(Vector::x() * 3.0) };
        for last in [Vector::zeros(), Vector::x() * 7.0, Vector::x() * -7.0, Vector::y() * 7.0] {
            let trial = last - contact.displacement * STIFFNESS;
            let force = sliding_force(&trial, &last, &contact, &kind, STIFFNESS, 5.0);
            assert!((force.norm() - 5.0).abs() < 16.0 * f64::EPSILON * 5.0 && force.z == 0.0, "{last}: {force}");
        }
    }
}
