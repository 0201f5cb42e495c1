//! A spheroid that turns in a creeping shear flow without bounds (Jeffery 1922), its axis in the plane of flow and gradient. Times are in inverse shear rates.

use std::f64::consts::TAU;

/// Time of a whole turn for an aspect ratio $r$ of polar over equatorial axis: $2 \pi (r + 1 / r)$.
pub fn period(aspect: f64) -> f64 {
    TAU * (aspect + 1.0 / aspect)
}

/// Angle in rad of the axis from the gradient towards the flow, if it begins along the gradient: $\tan \varphi = r \tan(t / (r + 1 / r))$.
pub fn angle(aspect: f64, time: f64) -> f64 {
    let phase = TAU * time / period(aspect);
    // The angle leads or lags the even phase by less than a right angle.
    phase + ((aspect - 1.0) * phase.sin() * phase.cos()).atan2(phase.cos().powi(2) + aspect * phase.sin().powi(2))
}

/// Rate of that angle in rad.
pub fn rate(aspect: f64, angle: f64) -> f64 {
    let square = aspect * aspect;
    (square * angle.cos().powi(2) + angle.sin().powi(2)) / (square + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = include_str!("../../../reference-data/jeffery_orbit/data.csv");

    #[test]
    fn angles_and_rates_are_those_of_the_table() {
        let rows: Vec<Vec<f64>> =
            TABLE.lines().skip(1).map(|line| line.split(',').filter_map(|word| word.parse().ok()).collect()).collect();
        assert_eq!(rows.len(), 44);
        for row in rows {
            let [aspect, whole, time, wanted, slope] = row.try_into().expect("five numbers");
            assert!((period(aspect) / whole - 1.0).abs() < 1e-8);
            // Nine digits are printed.
            assert!((angle(aspect, time) - wanted).abs() < 5e-8 && (rate(aspect, wanted) - slope).abs() < 5e-8, "{aspect} {time}");
        }
    }

    #[test]
    fn the_rate_is_the_slope_of_the_angle_through_many_turns() {
        for aspect in [0.2, 0.5, 1.0, 2.0, 7.0] {
            for time in [0.0, 1.7, 9.3, 40.0] {
                let slope = (angle(aspect, time + 1e-5) - angle(aspect, time - 1e-5)) / 2e-5;
                assert!((slope - rate(aspect, angle(aspect, time))).abs() < 1e-8, "{aspect} {time}");
            }
        }
    }
}
