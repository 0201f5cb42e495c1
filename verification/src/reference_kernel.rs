//! A fixed piece of work that is timed beside everything else: it tells a slow machine from slow code.
//!
//! One million steps of an undamped oscillator by leapfrog: a chain of dependent floating-point operations that no compiler shortens.

/// Runs the kernel; the result is returned so that the work cannot be left out.
pub fn run() -> f64 {
    let (mut position, mut velocity) = (1.0_f64, 0.0_f64);
    let step = 1e-3;
    for _ in 0..1_000_000 {
        velocity -= step * position;
        position += step * velocity;
    }
    position
}

#[cfg(test)]
mod tests {
    /// Exact: leapfrog turns the phase by 2 asin(step / 2) a step.
    #[test]
    fn the_kernel_oscillates_at_the_frequency_of_leapfrog() {
        let half_angle = (0.5e-3_f64).asin();
        // Started at rest half a step before the first position, the motion is even about that time.
        let expected = ((2e6 + 1.0) * half_angle).cos() / half_angle.cos();
        // Round-off of a million turns walks as the square root, and the phase itself is known to epsilon times 1000.
        let floor = f64::EPSILON * 1e3;
        assert!((super::run() - expected).abs() < 10.0 * floor, "{}", (super::run() - expected) / floor);
    }
}
