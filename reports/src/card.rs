//! [`Card`]: what a case says about itself, written beside its rows as `<case>/card.json` so that pages need nothing else.

use serde::{Deserialize, Serialize};

/// A case's own words: question, model, picture, plots, what it leaves out. Numbers come from rows only.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Card {
    /// Identifier, same as in the rows.
    pub case: String,
    /// Title in words.
    pub title: String,
    /// The one-sentence question the case answers.
    pub question: String,
    /// What is solved: paragraphs, in order.
    pub model: Vec<String>,
    /// The equations of the model.
    pub equations: Vec<Equation>,
    /// Fixed parameters: name, value with unit, dimensionless form or remark.
    pub parameters: Vec<Parameter>,
    /// The reference and its uncertainty in words.
    pub reference: String,
    /// Still picture of the scene.
    pub picture: Picture,
    /// The plots, in page order. The first error-against-cost plot is the page's thumbnail.
    pub plots: Vec<Plot>,
    /// The claim the verdict line quotes: setup and quantity of its row.
    pub headline: Headline,
    /// What the scene uses and what it leaves out, and why.
    pub ledger: Vec<LedgerLine>,
    /// Deliberate bugs this case catches: name and what turned red.
    pub mutants: Vec<Mutant>,
    /// Where the model and the numbers come from.
    pub sources: Vec<String>,
    /// Requirements, threads and complaints the case answers.
    pub answers: Vec<String>,
    /// Remarks a reviewer should read: what surprised, what falls short.
    pub remarks: Vec<String>,
    /// CPU seconds the case may use at this tier; the run fails above it.
    pub budget_cpu_s: f64,
    /// What remakes the page, if it is not `touchstone run` with the case's identifier: a bench.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
}

impl Card {
    /// The command that remakes its numbers.
    pub fn command(&self) -> String {
        self.command.clone().unwrap_or_else(|| format!("touchstone run {}", self.case))
    }
}

/// An equation in LaTeX with what it says in words.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Equation {
    /// LaTeX, display style, no delimiters.
    pub latex: String,
    /// One line: what it is, source equation number, erratum if there is one.
    pub meaning: String,
}

/// A fixed parameter of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Name in words.
    pub name: String,
    /// Value with unit.
    pub value: String,
    /// Dimensionless form or a remark; may be empty.
    pub remark: String,
}

/// The claim that stands in a page's verdict line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Headline {
    /// Setup of the row.
    pub setup: String,
    /// Quantity of the row.
    pub quantity: String,
    /// Statistic prefix of the row ("median").
    pub statistic: String,
    /// Knob value of the row.
    pub knob: f64,
    /// Quantity of the row that holds the observed order, if the case has one.
    pub order_quantity: Option<String>,
}

/// A still picture as plain geometry, drawn by the page in two dimensions.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    /// What it shows, for readers and for screen readers.
    pub caption: String,
    /// Shapes in drawing order; lengths in the picture's own unit, y upwards.
    pub items: Vec<PictureItem>,
}

/// One thing in a picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum PictureItem {
    /// A filled disc (a sphere seen from the side).
    Disc {
        /// Centre.
        center: [f64; 2],
        /// Radius.
        radius: f64,
        /// Fainter drawing: an earlier or later position.
        ghost: bool,
    },
    /// A filled polygon (a box seen in projection).
    Polygon {
        /// Corners in order.
        points: Vec<[f64; 2]>,
        /// Fainter drawing.
        ghost: bool,
    },
    /// A solid wall: its surface as a line; `solid_side` points into the material and is hatched.
    Wall {
        /// One end.
        from: [f64; 2],
        /// Other end.
        to: [f64; 2],
        /// Unit vector into the wall.
        solid_side: [f64; 2],
    },
    /// An arrow with a label at its tip (velocity, gravity, axis).
    Arrow {
        /// Tail.
        from: [f64; 2],
        /// Tip.
        to: [f64; 2],
        /// Label; may be empty.
        label: String,
    },
    /// A dimension line or plain dashed line.
    Dashed {
        /// One end.
        from: [f64; 2],
        /// Other end.
        to: [f64; 2],
    },
    /// Text.
    Label {
        /// Where its middle is.
        at: [f64; 2],
        /// What it says.
        text: String,
    },
}

/// One plot of a page, drawn from rows or from a data file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Plot {
    /// Error against the knob, log-log: one line per setup and statistic. The convergence plot.
    Convergence {
        /// Title.
        title: String,
        /// Quantity whose error is drawn.
        quantity: String,
        /// Setups, in legend order.
        setups: Vec<String>,
        /// Statistic prefixes drawn ("median", "worst"); the first is drawn with a line, the others with markers only.
        statistics: Vec<String>,
        /// Slopes to show as triangles, given as orders (2 draws error ~ knob^-2 if `knob_is_resolution`).
        orders: Vec<f64>,
        /// True if a larger knob is finer (steps per contact), false if it is coarser (step size).
        knob_is_resolution: bool,
        /// Label of the knob axis.
        knob_label: String,
    },
    /// Error against CPU seconds per run, log-log, error up, cost to the right: one line per setup, Pareto front thick,
    /// followed by the table of cost to 10, 1 and 0.1 %.
    ErrorAgainstCost {
        /// Title.
        title: String,
        /// Quantity whose error is drawn.
        quantity: String,
        /// Setups, in legend order.
        setups: Vec<String>,
        /// Statistic prefix drawn.
        statistic: String,
        /// Relative errors of the cost table, largest first ("cost to 10, 1, 0.1 %").
        targets: Vec<f64>,
    },
    /// Curves from a CSV file: the first column is the abscissa, each further column one line.
    Curves {
        /// Title.
        title: String,
        /// File relative to the results folder.
        file: String,
        /// Label of the abscissa, with unit.
        x_label: String,
        /// Label of the ordinate, with unit.
        y_label: String,
        /// Columns drawn, by header name, with their legend text.
        columns: Vec<[String; 2]>,
        /// Logarithmic abscissa.
        log_x: bool,
        /// Logarithmic ordinate.
        log_y: bool,
        /// What to see in it.
        caption: String,
    },
    /// Ratios from a CSV file as bars that begin at one, with a table of the file under them. Its columns: a name, the ratio, both ends of its interval, and then
    /// words for the table; no cell has a comma in it.
    Bars {
        /// Title.
        title: String,
        /// File relative to the results folder.
        file: String,
        /// Label of the axis.
        x_label: String,
        /// What to see in it.
        caption: String,
    },
    /// Round bodies seen in a slice at several times, from a CSV file with the columns `time`, `across`, `height` and `speed`: a picture for each time, darker
    /// where bodies are faster.
    Slices {
        /// Title.
        title: String,
        /// File relative to the results folder.
        file: String,
        /// Radius of the bodies in the unit of their places.
        radius: f64,
        /// What to see in it.
        caption: String,
    },
}

/// One physics or stage: used or left out, why, and how often it worked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LedgerLine {
    /// Name of the stage ("tangential force").
    pub stage: String,
    /// Whether the scene needs it.
    pub used: bool,
    /// Which variant, or why it is left out.
    pub reason: String,
    /// Exact work counts; all zero if left out.
    pub work: std::collections::BTreeMap<String, u64>,
}

/// A deliberate bug and what caught it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutant {
    /// The bug, in words.
    pub name: String,
    /// The test or claim that turned red.
    pub caught_by: String,
}
