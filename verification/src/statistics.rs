//! Statistics of samples and orders of sequences.

/// Median: the mean of the two middle ones for an even number. NaN sorts last. Zero samples give NaN.
pub fn median(samples: &[f64]) -> f64 {
    let sorted = sorted(samples);
    match sorted.len() {
        0 => f64::NAN,
        count if count % 2 == 1 => sorted[count / 2],
        count => 0.5 * (sorted[count / 2 - 1] + sorted[count / 2]),
    }
}

/// Interval that holds the median of the distribution with 95 % confidence, from order statistics: no assumption about its form.
/// `None` for fewer than six samples, which cannot give one.
pub fn median_interval(samples: &[f64]) -> Option<[f64; 2]> {
    let count = samples.len();
    if count < 6 {
        return None;
    }
    let sorted = sorted(samples);
    let half_width = 0.98 * (count as f64).sqrt();
    let low = ((count as f64 / 2.0 - half_width).floor().max(0.0)) as usize;
    let high = ((count as f64 / 2.0 + half_width).ceil() as usize).min(count - 1);
    Some([sorted[low], sorted[high]])
}

/// Mean, and half the width of the interval that holds the mean of the distribution with 95 % confidence if it is normal (Student). The width is infinite
/// for fewer than two samples.
pub fn mean_and_half_width(samples: &[f64]) -> (f64, f64) {
    let count = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / count;
    let variance = samples.iter().map(|sample| (sample - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let half_width = if samples.len() < 2 { f64::INFINITY } else { student(samples.len() - 1) * (variance / count).sqrt() };
    (mean, half_width)
}

/// Quantile 0.975 of Student's distribution, by degrees of freedom from one on; beyond the table by its expansion about the normal one.
fn student(degrees: usize) -> f64 {
    const TABLE: [f64; 10] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];
    const NORMAL: f64 = 1.959_964;
    let inverse = 1.0 / degrees as f64;
    let expansion = NORMAL
        + (NORMAL.powi(3) + NORMAL) / 4.0 * inverse
        + (5.0 * NORMAL.powi(5) + 16.0 * NORMAL.powi(3) + 3.0 * NORMAL) / 96.0 * inverse.powi(2);
    degrees.checked_sub(1).and_then(|place| TABLE.get(place)).copied().unwrap_or(expansion)
}

/// Index of the largest sample; NaN counts as largest, so that it cannot hide.
pub fn index_of_largest(samples: &[f64]) -> Option<usize> {
    (0..samples.len()).max_by(|left, right| samples[*left].total_cmp(&samples[*right]))
}

fn sorted(samples: &[f64]) -> Vec<f64> {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Observed order: minus the least-squares slope of log error over log resolution. `None` with fewer than two usable points.
///
/// Points whose error is not above their floor tell nothing about the order and are left out.
pub fn observed_order(points: &[OrderPoint]) -> Option<f64> {
    let usable: Vec<(f64, f64)> = points
        .iter()
        .filter(|point| point.error > point.floor && point.error.is_finite())
        .map(|point| (point.resolution.ln(), point.error.ln()))
        .collect();
    if usable.len() < 2 {
        return None;
    }
    let count = usable.len() as f64;
    let mean_x = usable.iter().map(|(x, _)| x).sum::<f64>() / count;
    let mean_y = usable.iter().map(|(_, y)| y).sum::<f64>() / count;
    let covariance: f64 = usable.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = usable.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    (variance > 0.0).then(|| -covariance / variance)
}

/// One point of a refinement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrderPoint {
    /// Resolution: larger is finer.
    pub resolution: f64,
    /// Error.
    pub error: f64,
    /// Floor of the error.
    pub floor: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_and_intervals() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median(&[]).is_nan());
        let samples: Vec<f64> = (0..100).map(f64::from).collect();
        // Binomial(100, 1/2): ranks 40 to 60 hold the median with 95 %.
        assert_eq!(median_interval(&samples), Some([40.0, 60.0]));
        assert_eq!(median_interval(&samples[..5]), None);
    }

    /// Student's quantile is 2.093 for 19 degrees of freedom and 2.023 for 39.
    #[test]
    fn intervals_of_means_widen_for_few_samples() {
        let (mean, half_width) = mean_and_half_width(&[1.0, 2.0, 3.0]);
        assert!((mean - 2.0).abs() < 1e-15 && (half_width - 4.303 / 3.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(mean_and_half_width(&[1.0]).1, f64::INFINITY);
        assert!((student(19) - 2.093).abs() < 1e-3 && (student(39) - 2.023).abs() < 1e-3 && (student(10) - 2.228).abs() < 1e-12);
    }

    #[test]
    fn a_nan_is_the_largest() {
        assert_eq!(index_of_largest(&[1.0, f64::NAN, 2.0]), Some(1));
        assert_eq!(index_of_largest(&[]), None);
    }

    #[test]
    fn order_of_a_power_law_is_its_exponent_and_the_floor_is_left_out() {
        let floor = 1e-9;
        let point = |resolution: f64| OrderPoint { resolution, error: (0.3 * resolution.powi(-3)).max(floor), floor };
        let points: Vec<OrderPoint> = [10.0, 20.0, 50.0, 1e5].map(point).to_vec();
        let order = observed_order(&points).unwrap_or(f64::NAN);
        assert!((order - 3.0).abs() < 1e-12, "{order}");
        assert_eq!(observed_order(&points[..1]), None);
    }
}
