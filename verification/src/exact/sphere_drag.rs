//! Drag of a sphere held in a stream without bounds: independently computed (`reference-data/sphere_drag_fixed`), and by correlation.

const TABLE: &str = include_str!("../../../reference-data/sphere_drag_fixed/data.csv");

/// What is known at a Reynolds number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereDrag {
    /// On the diameter.
    pub reynolds: f64,
    /// Drag over the dynamic pressure on the cross-section.
    pub coefficient: f64,
    /// Of the coefficient.
    pub uncertainty: f64,
    /// Length of the wake in diameters, where it is known.
    pub wake: Option<f64>,
}

/// The tabulated drag at a Reynolds number; `None` if it is not in the table.
pub fn tabulated(reynolds: f64) -> Option<SphereDrag> {
    TABLE.lines().skip(1).find_map(|line| {
        let words: Vec<&str> = line.split(',').collect();
        let number = |place: usize| words.get(place).and_then(|word| word.parse::<f64>().ok());
        let coefficient = number(1).filter(|_| number(0) == Some(reynolds))?;
        let uncertainty = match reynolds {
            ..=1.0 => 0.1,
            10.0..=20.0 => 0.001,
            _ => 0.005,
        };
        Some(SphereDrag { reynolds, coefficient, uncertainty, wake: number(4) })
    })
}

/// Schiller and Naumann's correlation; good to about 5 per cent up to a Reynolds number of 800.
pub fn schiller_naumann(reynolds: f64) -> SphereDrag {
    let coefficient = 24.0 / reynolds * (1.0 + 0.15 * reynolds.powf(0.687));
    SphereDrag { reynolds, coefficient, uncertainty: 0.05 * coefficient, wake: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_whole_and_the_correlation_near_it() {
        for reynolds in [1.0, 5.0, 10.0, 20.0, 40.0] {
            let (table, correlation) = (tabulated(reynolds).expect("a row"), schiller_naumann(reynolds));
            assert!((table.coefficient - correlation.coefficient).abs() < 1.1 * correlation.uncertainty, "{reynolds}");
            assert_eq!(table.wake.is_some(), reynolds == 40.0);
        }
        assert_eq!(tabulated(20.0).map(|row| row.coefficient), Some(2.7196));
        assert_eq!(tabulated(21.0), None);
    }
}
