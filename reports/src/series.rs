//! [`Series`]: the rows of one line in a plot, in the order of its knob.

use crate::{CaseResults, Row};

/// One measured point: where its row stands and the numbers a plot needs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point<'a> {
    /// Line of the row in the case's result file.
    pub(crate) line: usize,
    pub(crate) row: &'a Row,
    pub(crate) knob: f64,
    pub(crate) error: f64,
}

/// All rows of one setup, quantity and statistic.
#[derive(Debug, Clone)]
pub(crate) struct Series<'a> {
    /// Name of the code if it is another code's.
    pub(crate) code: Option<&'a str>,
    pub(crate) setup: &'a str,
    /// Index of the setup in the plot's list, which fixes its colour and marker in every plot of a page.
    pub(crate) index: usize,
    /// Points with an error, by rising knob.
    pub(crate) points: Vec<Point<'a>>,
    /// Rows without an error, by rising knob.
    pub(crate) failed: Vec<(usize, &'a Row)>,
}

impl<'a> Series<'a> {
    fn collect(setup: &'a str, index: usize, code: Option<&'a str>, rows: impl Iterator<Item = (usize, &'a Row)>) -> Series<'a> {
        let mut points = Vec::new();
        let mut failed = Vec::new();
        for (line, row) in rows {
            let knob = row.knob.as_ref().map_or(f64::NAN, |knob| knob.value);
            match row.error {
                Some(error) if row.failed.is_none() && error.is_finite() => {
                    points.push(Point { line, row, knob, error });
                }
                _ => failed.push((line, row)),
            }
        }
        points.sort_by(|a, b| a.knob.total_cmp(&b.knob));
        Series { code, setup, index, points, failed }
    }

    /// Points whose cost was measured, from the coarse (cheap) end of the knob to the fine end, with the cost of one run.
    pub(crate) fn costed(&self) -> Vec<(f64, Point<'a>)> {
        let mut costed: Vec<_> = self
            .points
            .iter()
            .filter_map(|point| point.row.cpu_s_per_run().filter(|cost| *cost > 0.0).map(|cost| (cost, *point)))
            .collect();
        let fine_end_first = matches!((costed.first(), costed.last()), (Some(a), Some(b)) if a.0 > b.0);
        if fine_end_first {
            costed.reverse();
        }
        costed
    }

    /// The largest floor of its rows, if any states one.
    pub(crate) fn floor(&self) -> Option<f64> {
        self.points.iter().filter_map(|point| point.row.floor).max_by(f64::total_cmp)
    }
}

/// The series of this project's own rows, one for each setup in order; a setup without rows makes an empty series.
pub(crate) fn own_series<'a>(case: &'a CaseResults, quantity: &str, setups: &'a [String], statistic: &str) -> Vec<Series<'a>> {
    setups
        .iter()
        .enumerate()
        .map(|(index, setup)| {
            let rows =
                case.own_rows().filter(|(_, row)| row.setup == *setup && row.quantity == quantity && row.statistic.starts_with(statistic));
            Series::collect(setup, index, None, rows)
        })
        .collect()
}

/// The series of other codes for a quantity at some setups, one for each code and setup, whatever their statistic is. The index is that of the code among all
/// of the case, so that it looks the same in every plot.
pub(crate) fn foreign_series<'a>(case: &'a CaseResults, quantity: &str, setups: &[String]) -> Vec<Series<'a>> {
    let mut codes: Vec<&str> = case.foreign_rows().map(|(_, row)| row.code.as_str()).collect();
    codes.sort_unstable();
    codes.dedup();
    let wanted = case.foreign_rows().filter(|(_, row)| row.quantity == quantity && setups.contains(&row.setup));
    let mut lines: Vec<(&str, &str)> = wanted.map(|(_, row)| (row.code.as_str(), row.setup.as_str())).collect();
    lines.sort_unstable();
    lines.dedup();
    lines
        .into_iter()
        .map(|(code, setup)| {
            let index = codes.iter().position(|known| *known == code).unwrap_or_default();
            let rows = case.foreign_rows().filter(|(_, row)| row.code == code && row.setup == setup && row.quantity == quantity);
            Series::collect(setup, index, Some(code), rows)
        })
        .collect()
}

/// Splits setups such as `"e=0.5, Verlet"` into what all share and what tells each one apart.
pub(crate) fn distinguish(setups: &[&str]) -> (Vec<String>, String) {
    let parts: Vec<Vec<&str>> = setups.iter().map(|setup| setup.split(", ").collect()).collect();
    let shared: Vec<&str> = match parts.first() {
        Some(first) if parts.len() > 1 => first.iter().copied().filter(|part| parts.iter().all(|other| other.contains(part))).collect(),
        _ => Vec::new(),
    };
    let names = parts
        .iter()
        .zip(setups)
        .map(|(own, whole)| {
            let rest: Vec<&str> = own.iter().copied().filter(|part| !shared.contains(part)).collect();
            if rest.is_empty() { (*whole).to_string() } else { rest.join(", ") }
        })
        .collect();
    (names, shared.join(", "))
}

#[cfg(test)]
mod tests {
    use super::distinguish;

    #[test]
    fn legends_name_only_what_differs() {
        let (names, shared) = distinguish(&["e=0.5, until zero overlap, Verlet", "e=0.9, until zero overlap, Verlet"]);
        assert_eq!(names, ["e=0.5", "e=0.9"]);
        assert_eq!(shared, "until zero overlap, Verlet");
        assert_eq!(distinguish(&["only one"]), (vec!["only one".to_string()], String::new()));
    }
}
