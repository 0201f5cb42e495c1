//! Curves from CSV text: columns of numbers under a header, thinned to what a plot can show.

/// Points a curve keeps at most; more would not be visible and would make the page heavy.
const MOST_POINTS: usize = 600;

/// One curve of a file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curve {
    /// `[x, y]` in file order; a value that is not a finite number ends a stretch and starts the next.
    pub(crate) stretches: Vec<Vec<[f64; 2]>>,
    /// Points in the file, before thinning.
    pub(crate) points: usize,
}

/// A file of numbers under a header.
pub(crate) struct Table<'a> {
    names: Vec<&'a str>,
    pub(crate) rows: Vec<Vec<f64>>,
}

impl Table<'_> {
    /// Place of a column in each row.
    pub(crate) fn column(&self, name: &str) -> Result<usize, String> {
        self.names.iter().position(|other| *other == name).ok_or_else(|| format!("there is no column \"{name}\""))
    }
}

/// Reads a table; a line of units after the header is passed over.
pub(crate) fn read_table(text: &str) -> Result<Table<'_>, String> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let (_, header) = lines.next().ok_or("the file is empty")?;
    let names: Vec<&str> = header.split(',').map(str::trim).collect();
    let mut numbers: Vec<Vec<f64>> = Vec::new();
    for (order, (index, line)) in lines.enumerate() {
        match line.split(',').map(|cell| read_cell(cell.trim())).collect::<Option<Vec<f64>>>() {
            Some(row) if row.len() == names.len() => numbers.push(row),
            // The second line of a probe file names units.
            _ if order == 0 => {}
            _ => return Err(format!("line {} is not {} numbers", index + 1, names.len())),
        }
    }
    Ok(Table { names, rows: numbers })
}

/// Reads the first column against each of the named columns.
pub(crate) fn read_curves(text: &str, columns: &[[String; 2]]) -> Result<Vec<Curve>, String> {
    let table = read_table(text)?;
    columns.iter().map(|[name, _]| column(&table, name)).collect()
}

/// An empty cell is a gap in the curve.
fn read_cell(cell: &str) -> Option<f64> {
    if cell.is_empty() { Some(f64::NAN) } else { cell.parse().ok() }
}

fn column(table: &Table, name: &str) -> Result<Curve, String> {
    let index = table.column(name)?;
    let points: Vec<[f64; 2]> = table.rows.iter().map(|row| [row[0], row[index]]).collect();
    let stretches = points
        .split(|point| !point.iter().all(|number| number.is_finite()))
        .filter(|stretch| !stretch.is_empty())
        .map(|stretch| thinned(stretch, MOST_POINTS * stretch.len() / points.len()))
        .collect();
    Ok(Curve { stretches, points: points.len() })
}

/// Keeps the lowest and the highest point of each of `most / 2` equal pieces, so that no peak is lost.
fn thinned(points: &[[f64; 2]], most: usize) -> Vec<[f64; 2]> {
    if points.len() <= most.max(4) {
        return points.to_vec();
    }
    let piece = points.len().div_ceil((most / 2).max(2));
    let mut kept = Vec::new();
    for chunk in points.chunks(piece) {
        let by_height = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let mut extremes: Vec<[f64; 2]> =
            chunk.iter().min_by(by_height).into_iter().chain(chunk.iter().max_by(by_height)).copied().collect();
        extremes.sort_by(|a, b| a[0].total_cmp(&b[0]));
        extremes.dedup();
        kept.extend(extremes);
    }
    // A curve ends where its data ends.
    kept.insert(0, points[0]);
    kept.push(points[points.len() - 1]);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(name: &str) -> Vec<[String; 2]> {
        vec![[name.to_string(), name.to_string()]]
    }

    #[test]
    fn a_units_line_and_gaps_are_understood() {
        let curves = read_curves("t,y\ns,m\n0,1\n1,\n2,3\n", &columns("y"));
        assert_eq!(curves.map(|c| c[0].stretches.clone()), Ok(vec![vec![[0.0, 1.0]], vec![[2.0, 3.0]]]));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        assert_eq!(read_curves("", &columns("y")), Err("the file is empty".into()));
        assert_eq!(read_curves("t,y\n0,1\n", &columns("z")), Err("there is no column \"z\"".into()));
        assert_eq!(read_curves("t,y\n0,1\n1,x\n", &columns("y")), Err("line 3 is not 2 numbers".into()));
    }

    #[test]
    fn thinning_keeps_the_peak_and_the_ends() {
        let text: String = (0..100_000).map(|i| format!("{i},{}\n", if i == 54_321 { 9.0 } else { 0.0 })).collect();
        let curve = &read_curves(&format!("t,y\n{text}"), &columns("y")).expect("a well-formed file")[0];
        let kept = &curve.stretches[0];
        assert_eq!((curve.points, kept[0][0], kept[kept.len() - 1][0]), (100_000, 0.0, 99_999.0));
        assert!(kept.len() <= MOST_POINTS + 2 && kept.iter().any(|point| point[1] == 9.0));
    }
}
