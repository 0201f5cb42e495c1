//! Published power laws of run-out and final height, and the bands that they span.

/// A quantity over the length of the column, as a power of the aspect ratio in a range.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
struct Power {
    quantity: String,
    source: String,
    coefficient: f64,
    exponent: f64,
    least_a: f64,
    largest_a: f64,
}

const TABLE: &str = include_str!("../../../../reference-data/column_collapse/data.csv");

/// What a law speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scaled {
    RunOut,
    FinalHeight,
}

impl Scaled {
    fn key(self) -> &'static str {
        match self {
            Scaled::RunOut => "run_out",
            Scaled::FinalHeight => "final_height",
        }
    }
}

/// What a source says of a column; `None` outside of its range.
pub(super) fn law(scaled: Scaled, source: &str, aspect_ratio: f64) -> Option<f64> {
    powers()
        .find(|power| power.quantity == scaled.key() && power.source == source && power.holds_at(aspect_ratio))
        .map(|power| power.at(aspect_ratio))
}

/// Least and largest value that all sources give together.
pub(super) fn band(scaled: Scaled, aspect_ratio: f64) -> [f64; 2] {
    let of_column = powers().filter(|power| power.quantity == scaled.key() && power.holds_at(aspect_ratio));
    of_column.map(|power| power.at(aspect_ratio)).fold([f64::INFINITY, 0.0], |[least, most], value| [least.min(value), most.max(value)])
}

impl Power {
    fn holds_at(&self, aspect_ratio: f64) -> bool {
        self.least_a <= aspect_ratio && aspect_ratio < self.largest_a
    }

    fn at(&self, aspect_ratio: f64) -> f64 {
        self.coefficient * aspect_ratio.powf(self.exponent)
    }
}

/// All rows; the table is part of the program, and a test reads all of it.
fn powers() -> impl Iterator<Item = Power> {
    csv::Reader::from_reader(TABLE.as_bytes()).into_deserialize().filter_map(Result::ok)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_read() {
        assert_eq!(powers().count(), TABLE.lines().count() - 1);
    }

    /// R computes 7.15 from Lube's law at 7.3, and reads 7 to 13 from the experiments of Balmforth and Kerswell.
    #[test]
    fn the_band_at_seven_is_that_of_the_experiments() {
        let lube = law(Scaled::RunOut, "lube", 7.3);
        assert!(lube.is_some_and(|lube| (lube - 7.15).abs() < 0.005), "{lube:?}");
        let [least, most] = band(Scaled::RunOut, 7.3);
        assert!((least - 7.0).abs() < 0.2 && (most - 13.0).abs() < 0.2, "{least} {most}");
    }

    #[test]
    fn a_low_column_keeps_its_height_and_there_is_no_law_beyond_the_range() {
        assert_eq!(law(Scaled::FinalHeight, "lube", 0.5), Some(0.5));
        assert_eq!(law(Scaled::RunOut, "lube", 30.0), None);
        assert!((band(Scaled::RunOut, 1.0)[0] - 1.2).abs() < 1e-12 && (band(Scaled::RunOut, 1.0)[1] - 2.5).abs() < 1e-12);
    }
}
