//! The free asymmetric top in closed form: Jacobi elliptic functions for the spin, one quadrature for the attitude.
//!
//! Body frame, $I_1 < I_2 < I_3$, started with no spin about the second axis and fast enough about the third: $\omega_1 = A_1 \operatorname{cn}$,
//! $\omega_2 = A_2 \operatorname{sn}$, $\omega_3 = A_3 \operatorname{dn}$ of $W t$. The attitude is written in Euler angles about the angular momentum, whose
//! precession rate is $|L| (I_1\omega_1^2 + I_2\omega_2^2)/(I_1^2\omega_1^2 + I_2^2\omega_2^2)$.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

/// A free top with attitude "body frame = world frame" at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeTop {
    /// Principal moments, increasing, in kg m^2.
    pub inertia: Vector3<f64>,
    amplitudes: Vector3<f64>,
    rate: f64,
    parameter: f64,
}

impl FreeTop {
    /// A top with spins about its first and third axes at the start; `None` unless the moments increase and the spin about the third axis is
    /// fast enough for the solution to circle that axis.
    pub fn new(inertia: Vector3<f64>, first_spin: f64, third_spin: f64) -> Option<FreeTop> {
        let [one, two, three] = [inertia.x, inertia.y, inertia.z];
        let parameter = first_spin * first_spin * one * (two - one) / (third_spin * third_spin * three * (three - two));
        let second = first_spin * (one * (three - one) / (two * (three - two))).sqrt();
        let rate = third_spin * ((three - one) * (three - two) / (one * two)).sqrt();
        let amplitudes = Vector3::new(first_spin, second, third_spin);
        (one < two && two < three && parameter < 1.0).then_some(FreeTop { inertia, amplitudes, rate, parameter })
    }

    /// Angular velocity in the body frame at a time.
    pub fn spin(&self, time: f64) -> Vector3<f64> {
        let (sn, cn, dn) = jacobi(self.rate * time, self.parameter);
        self.amplitudes.component_mul(&Vector3::new(cn, sn, dn))
    }

    /// Rotation from body to world at a time, accurate to about 1e-13 for times of some revolutions.
    pub fn attitude(&self, time: f64) -> UnitQuaternion<f64> {
        let about_momentum = |time: f64, precession: f64| {
            let momentum = self.inertia.component_mul(&self.spin(time)).normalize();
            let nutation = momentum.z.acos();
            let own_turn = momentum.x.atan2(momentum.y);
            let turn = |axis: Vector3<f64>, angle: f64| Rotation3::from_scaled_axis(axis * angle);
            turn(Vector3::z(), precession) * turn(Vector3::x(), nutation) * turn(Vector3::z(), own_turn)
        };
        let rotation = about_momentum(0.0, 0.0).inverse() * about_momentum(time, self.precession(time));
        UnitQuaternion::from_rotation_matrix(&rotation)
    }

    /// Angle by which the body has precessed about its angular momentum: composite Gauss-Legendre quadrature with five points.
    fn precession(&self, time: f64) -> f64 {
        const NODES: [(f64, f64); 5] = [
            (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
            (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_08),
        ];
        let panels = (20.0 * self.rate * time).ceil().max(1.0) as usize;
        let half = 0.5 * time / panels as f64;
        let rate = |time: f64| {
            let spin = self.spin(time);
            let momentum = self.inertia.component_mul(&spin);
            momentum.norm() * (spin.x * momentum.x + spin.y * momentum.y) / momentum.xy().norm_squared()
        };
        let panel = |index: usize| {
            let middle = (2 * index + 1) as f64 * half;
            NODES.iter().map(|(node, weight)| weight * rate(middle + half * node)).sum::<f64>()
        };
        half * (0..panels).map(panel).sum::<f64>()
    }
}

/// Jacobi's sn, cn and dn of an argument and parameter $m = k^2$ in [0, 1), by descending Landen transformations.
pub fn jacobi(argument: f64, parameter: f64) -> (f64, f64, f64) {
    let mut means = vec![(1.0_f64, parameter.sqrt())];
    let mut other = (1.0 - parameter).sqrt();
    while let Some(&(mean, half_difference)) = means.last() {
        if half_difference.abs() <= f64::EPSILON * mean || means.len() > 12 {
            break;
        }
        means.push((0.5 * (mean + other), 0.5 * (mean - other)));
        other = (mean * other).sqrt();
    }
    let last = means.len() - 1;
    let mut angle = means[last].0 * argument * (1_u32 << last) as f64;
    for (mean, half_difference) in means[1..].iter().rev() {
        angle = 0.5 * (angle + (half_difference / mean * angle.sin()).asin());
    }
    let (sine, cosine) = angle.sin_cos();
    (sine, cosine, (1.0 - parameter * sine * sine).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = include_str!("../../../reference-data/asymmetric_top/data.csv");

    /// Independent: the reference data (an eighth-order Runge-Kutta run and elliptic functions of another library).
    #[test]
    fn spin_and_attitude_match_the_reference_table() {
        let top = FreeTop::new(Vector3::new(1.0, 2.0, 3.0), 0.6, 1.0).expect("moments increase");
        for line in TABLE.lines().skip(1) {
            let numbers: Vec<f64> = line.split(',').map(|number| number.parse().expect("a table of numbers")).collect();
            let (time, spin) = (numbers[0], Vector3::new(numbers[1], numbers[2], numbers[3]));
            // Nine significant digits of numbers up to one.
            assert!((top.spin(time) - spin).norm() < 1e-9 * 3.0_f64.sqrt(), "spin at {time}");
            let attitude = top.attitude(time);
            let printed = nalgebra::Vector4::new(numbers[5], numbers[6], numbers[7], numbers[4]);
            let difference = (attitude.coords - printed).norm().min((attitude.coords + printed).norm());
            assert!(difference < 2e-9, "attitude at {time}: {difference}");
        }
    }

    /// Exact limits: circular and hyperbolic functions; and the quarter period, where sn is one.
    #[test]
    fn jacobi_functions_have_their_limits() {
        let (sn, cn, dn) = jacobi(0.7, 0.0);
        assert!((sn - 0.7_f64.sin()).abs() < 2e-16 && (cn - 0.7_f64.cos()).abs() < 2e-16 && dn == 1.0);
        let (sn, _, dn) = jacobi(0.7, 1.0 - 1e-12);
        assert!((sn - 0.7_f64.tanh()).abs() < 1e-11 && (dn - 1.0 / 0.7_f64.cosh()).abs() < 1e-11);
        let (sn, cn, _) = jacobi(6.485_572_551_92 / 4.0, 0.12);
        assert!((sn - 1.0).abs() < 1e-12 && cn.abs() < 1e-11);
    }
}
