//! Bars from CSV text: a name, a ratio, both ends of its interval, and words.

/// The rows of a file and the headers of the columns of words.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BarFile {
    pub(crate) headers: Vec<String>,
    pub(crate) bars: Vec<Bar>,
}

/// One bar.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bar {
    pub(crate) name: String,
    /// Above zero.
    pub(crate) ratio: f64,
    pub(crate) interval: [f64; 2],
    pub(crate) words: Vec<String>,
}

/// Columns before the words.
const NUMBERS_END: usize = 4;

/// Reads a file of bars.
pub(crate) fn read_bars(text: &str) -> Result<BarFile, String> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let (_, header) = lines.next().ok_or("the file is empty")?;
    let headers: Vec<String> = header.split(',').map(str::to_string).collect();
    let bars = lines.map(|(index, line)| read_bar(line, headers.len()).ok_or(format!("line {} is not a bar", index + 1)));
    Ok(BarFile { bars: bars.collect::<Result<_, _>>()?, headers: headers.into_iter().skip(NUMBERS_END).collect() })
}

fn read_bar(line: &str, columns: usize) -> Option<Bar> {
    let cells: Vec<&str> = line.split(',').collect();
    let number = |cell: &str| cell.parse::<f64>().ok().filter(|number| number.is_finite() && *number > 0.0);
    let [name, ratio, low, high, words @ ..] = cells.as_slice() else { return None };
    let bar = Bar {
        name: (*name).to_string(),
        ratio: number(ratio)?,
        interval: [number(low)?, number(high)?],
        words: words.iter().map(ToString::to_string).collect(),
    };
    (cells.len() == columns).then_some(bar)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_read_with_their_words() {
        let file = read_bars("what,ratio,low,high,answer\nwall as plate,2.5,2.25,2.75,yes\n").expect("a well-formed file");
        assert_eq!(file.headers, ["answer"]);
        let expected = Bar { name: "wall as plate".into(), ratio: 2.5, interval: [2.25, 2.75], words: vec!["yes".into()] };
        assert_eq!(file.bars, [expected]);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        assert_eq!(read_bars(""), Err("the file is empty".into()));
        for line in ["wall,0,1,2", "wall,1,nan,2", "wall,1,1", "wall,1,1,2,yes"] {
            assert_eq!(read_bars(&format!("what,ratio,low,high\n{line}\n")), Err("line 2 is not a bar".into()), "{line}");
        }
    }
}
