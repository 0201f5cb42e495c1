//! Drag of a sphere held in a stream without bounds: independently computed (`reference-data/sphere_drag_fixed`).

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
            100.0.. => 0.002,
            _ => 0.005,
        };
        Some(SphereDrag { reynolds, coefficient, uncertainty })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_whole_and_near_schiller_and_naumann() {
        for reynolds in [1.0, 5.0, 10.0, 20.0, 40.0, 100.0, 150.0_f64] {
            let correlation = 24.0 / reynolds * (1.0 + 0.15 * reynolds.powf(0.687));
            let table = tabulated(reynolds).expect("a row");
            assert!((table.coefficient / correlation - 1.0).abs() < 0.055, "{reynolds}");
        }
        assert_eq!(tabulated(20.0).map(|row| row.coefficient), Some(2.7196));
        assert_eq!(tabulated(21.0), None);
    }
}
