//! [`Axis`]: from a value to a place between 0 and 1, with ticks whose labels do not collide.

use crate::number;

/// Logarithmic axes stay inside these ends: beyond them a ratio is no longer a number, and no result is there anyway.
const SMALLEST: f64 = 1e-150;
const LARGEST: f64 = 1e150;

/// Whether equal distances are equal differences or equal ratios.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    Linear,
    Logarithmic,
}

/// How the ticks of a logarithmic axis are labelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Labels {
    /// `10^{-5}`
    Powers,
    /// `100`, with powers only far from one.
    Plain,
    /// `10 µs`, `1 ms`: the values are seconds.
    Seconds,
}

/// One tick; without a label it is a minor one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub(crate) at: f64,
    pub(crate) label: Option<String>,
}

/// One axis of a plot.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    pub(crate) ticks: Vec<Tick>,
    /// Power of ten taken out of the tick labels of a linear axis.
    pub(crate) multiplier: Option<i32>,
}

impl Axis {
    /// An axis that shows `low..=high` with a margin; absent unless both are finite (and positive, if logarithmic).
    pub(crate) fn new(scale: Scale, low: f64, high: f64, labels: Labels, most_labels: usize) -> Option<Axis> {
        if !(low.is_finite() && high.is_finite() && low <= high) {
            return None;
        }
        match scale {
            Scale::Linear => Some(linear(low, high, most_labels)),
            Scale::Logarithmic if low >= SMALLEST && high <= LARGEST => Some(logarithmic(low, high, labels, most_labels)),
            Scale::Logarithmic => None,
        }
    }

    /// A linear axis whose places are told by something else than numbers.
    pub(crate) fn without_ticks(low: f64, high: f64) -> Axis {
        Axis { scale: Scale::Linear, low, high, ticks: Vec::new(), multiplier: None }
    }

    /// Place of a value: 0 at the low end, 1 at the high end; values outside stick to the ends.
    pub(crate) fn place(&self, value: f64) -> f64 {
        let fraction = match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Logarithmic => (value / self.low).ln() / (self.high / self.low).ln(),
        };
        // NaN comes from a logarithm of a number that is not positive: it belongs on the low end.
        if fraction.is_nan() { 0.0 } else { fraction.clamp(0.0, 1.0) }
    }

    /// Length of the axis: in decades if logarithmic, in its unit otherwise.
    pub(crate) fn span(&self) -> f64 {
        match self.scale {
            Scale::Linear => self.high - self.low,
            Scale::Logarithmic => (self.high / self.low).log10(),
        }
    }
}

fn logarithmic(low: f64, high: f64, labels: Labels, most_labels: usize) -> Axis {
    let margin = ((high / low).log10() * 0.05).max(0.12);
    let (low, high) = (low * 10_f64.powf(-margin), high * 10_f64.powf(margin));
    let decades = (high / low).log10();
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    // Two and five are labelled too where there is room for three labels a decade.
    let label_between = 3.0 * decades <= most_labels as f64;
    let stride = (decades / most_labels as f64).ceil().max(1.0) as i32;
    let mut ticks = Vec::new();
    for exponent in first..=last {
        for step in 1..=9 {
            let at = f64::from(step) * 10_f64.powi(exponent);
            let labelled = match step {
                1 => exponent.rem_euclid(stride) == 0,
                2 | 5 => label_between,
                _ => false,
            };
            let shown = at >= low && at <= high && (step == 1 || decades <= 7.0);
            if shown {
                ticks.push(Tick { at, label: labelled.then(|| log_label(step, exponent, labels)) });
            }
        }
    }
    Axis { scale: Scale::Logarithmic, low, high, ticks, multiplier: None }
}

fn log_label(step: i32, exponent: i32, labels: Labels) -> String {
    let power = || match step {
        1 => format!("10^{{{}}}", number::superscript(exponent)),
        _ => format!("{step}·10^{{{}}}", number::superscript(exponent)),
    };
    match labels {
        Labels::Powers => power(),
        Labels::Plain if (-3..5).contains(&exponent) => {
            let decimals = usize::try_from(-exponent).unwrap_or(0);
            format!("{:.decimals$}", f64::from(step) * 10_f64.powi(exponent))
        }
        Labels::Plain => power(),
        Labels::Seconds => match exponent {
            -9..=-7 => format!("{:.0} ns", f64::from(step) * 10_f64.powi(exponent + 9)),
            -6..=-4 => format!("{:.0} µs", f64::from(step) * 10_f64.powi(exponent + 6)),
            -3..=-1 => format!("{:.0} ms", f64::from(step) * 10_f64.powi(exponent + 3)),
            0..=4 => format!("{:.0} s", f64::from(step) * 10_f64.powi(exponent)),
            _ => format!("{} s", power()),
        },
    }
}

fn linear(low: f64, high: f64, most_labels: usize) -> Axis {
    let spread = if high > low { high - low } else { low.abs().max(1.0) };
    let margin = if high > low { 0.04 } else { 0.5 };
    let (low, high) = (low - margin * spread, high + margin * spread);
    let step = round_step((high - low) / most_labels.max(2) as f64);
    let largest = low.abs().max(high.abs());
    let multiplier = Some((largest.log10() - 1e-9).floor() as i32).filter(|power| !(-2..5).contains(power));
    let unit = 10_f64.powi(multiplier.unwrap_or(0));
    let decimals = usize::try_from(-((step / unit).log10() + 1e-9).floor() as i32).unwrap_or(0);
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    let ticks = (first..=last)
        .map(|index| {
            let at = index as f64 * step;
            Tick { at, label: Some(format!("{:.decimals$}", at / unit).replace('-', "\u{2212}")) }
        })
        .collect();
    Axis { scale: Scale::Linear, low, high, ticks, multiplier }
}

/// The next of 1, 2, 5, 10 times a power of ten.
fn round_step(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    let ratio = least / power;
    power * [1.0, 2.0, 5.0].into_iter().find(|nice| ratio <= *nice).unwrap_or(10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().filter_map(|tick| tick.label.as_deref()).collect()
    }

    #[test]
    fn logarithmic_ticks_are_decades_or_twos_and_fives() {
        let wide = Axis::new(Scale::Logarithmic, 1e-9, 1e-1, Labels::Powers, 5).expect("a positive range");
        assert_eq!(labels(&wide), ["10^{−8}", "10^{−6}", "10^{−4}", "10^{−2}"]);
        let narrow = Axis::new(Scale::Logarithmic, 10.0, 100.0, Labels::Plain, 6).expect("a positive range");
        assert_eq!(labels(&narrow), ["10", "20", "50", "100"]);
        let time = Axis::new(Scale::Logarithmic, 2e-5, 3e-2, Labels::Seconds, 6).expect("a positive range");
        assert_eq!(labels(&time), ["100 µs", "1 ms", "10 ms"]);
    }

    #[test]
    fn linear_ticks_are_round_and_large_powers_are_taken_out() {
        let axis = Axis::new(Scale::Linear, 0.0, 1.0, Labels::Plain, 5).expect("a range");
        assert_eq!(labels(&axis), ["0.0", "0.5", "1.0"]);
        let tiny = Axis::new(Scale::Linear, 0.0, 4e-6, Labels::Plain, 5).expect("a range");
        assert_eq!((tiny.multiplier, labels(&tiny)), (Some(-6), vec!["0", "1", "2", "3", "4"]));
        let single = Axis::new(Scale::Linear, 0.0, 0.0, Labels::Plain, 5).expect("a single value");
        assert!((single.place(0.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn places_stay_inside_and_bad_ranges_are_refused() {
        let axis = Axis::new(Scale::Logarithmic, 1e-3, 1.0, Labels::Powers, 5).expect("a positive range");
        assert_eq!((axis.place(0.0), axis.place(-1.0), axis.place(1e9)), (0.0, 0.0, 1.0));
        assert!(Axis::new(Scale::Logarithmic, 0.0, 1.0, Labels::Powers, 5).is_none());
        assert!(Axis::new(Scale::Logarithmic, 1e-308, 1e308, Labels::Powers, 5).is_none());
        assert!(Axis::new(Scale::Linear, f64::NAN, 1.0, Labels::Plain, 5).is_none());
    }
}
