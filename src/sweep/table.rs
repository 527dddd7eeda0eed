//! The table of a sweep: its columns, and rows as text and back.

use std::collections::BTreeMap;

use choque_engine::Work;

use super::plan::Plan;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Whole numbers.
    Whole,
    /// Numbers.
    Number,
    /// Texts.
    Text,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its heading.
    pub name: String,
    /// What it holds.
    pub kind: Kind,
    /// The unit of its numbers, for plots.
    pub unit: Option<String>,
}

/// What stands in a row under a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A whole number.
    Whole(i64),
    /// A number.
    Number(f64),
    /// A text, on one line.
    Text(String),
    /// Nothing: a run that ended in an error has no totals.
    Missing,
}

/// A run's row: a cell for each column.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The run's number, counted from 0; the first cell.
    pub run: usize,
    /// All of them.
    pub cells: Vec<Cell>,
}

/// Stands before the name of a param that is named like what the table tells of a run.
const PREFIX: &str = "param.";

/// What a run ended as: the two values of the column `kind`.
pub const KINDS: [&str; 2] = ["run", "error"];

/// What is told of every run's end, each with its unit.
pub const TOTALS: [(&str, Kind, Option<&str>); 7] = [
    ("time", Kind::Number, Some("s")),
    ("collisions", Kind::Whole, None),
    ("kinetic_energy", Kind::Number, Some("J")),
    ("momentum_x", Kind::Number, Some("kg·m/s")),
    ("momentum_z", Kind::Number, Some("kg·m/s")),
    ("angular_momentum", Kind::Number, Some("kg·m²/s")),
    ("deepest", Kind::Number, Some("m")),
];

/// The columns of a plan's table, and where its parts begin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// From left to right.
    pub all: Vec<Column>,
    /// Of what varies or is set: its name, and its heading.
    names: BTreeMap<String, String>,
    /// How many of them say what a run was asked for.
    asked: usize,
}

impl Columns {
    /// The columns of a plan: what was asked for, what came of it, what it cost, what went wrong.
    #[must_use]
    pub fn of(plan: &Plan) -> Self {
        let column = |name: &str, kind, unit: Option<&str>| Column {
            name: name.to_owned(),
            kind,
            unit: unit.map(str::to_owned),
        };
        let mut all = vec![
            column("run", Kind::Whole, None),
            column("kind", Kind::Text, None),
            column("scenario", Kind::Text, None),
            column("point", Kind::Whole, None),
        ];
        let asked_for = all.len();
        all.push(column("seed", Kind::Whole, None));
        all.push(column("version", Kind::Text, None));
        let told = all.len();
        all.extend(TOTALS.map(|(name, kind, unit)| column(name, kind, unit)));
        all.push(column("digest", Kind::Text, None));
        all.extend(["held", "failed"].map(|name| column(name, Kind::Whole, None)));
        all.push(column("first_failed", Kind::Text, None));
        all.extend(plan.read.iter().map(|name| column(name, Kind::Number, unit_of(name))));
        let counts = Work::default().rows();
        all.extend(counts.iter().map(|(label, _)| column(&label.replace(['–', ' '], "_"), Kind::Whole, None)));
        all.push(column("error", Kind::Text, None));
        let numeric = |is_numeric| if is_numeric { Kind::Number } else { Kind::Text };
        let usual = |name: &str| if name == "time_step" { Some("s") } else { None };
        let varied = plan.vary.iter().map(|axis| (&axis.name, axis.is_numeric(), axis.unit.as_deref()));
        let set = plan.set.iter().map(|(name, value)| (name, matches!(value, super::axis::Value::Number(_)), None));
        let mut names = BTreeMap::new();
        let mut added = Vec::new();
        for (name, is_numeric, unit) in varied.chain(set) {
            let is_taken = all.iter().any(|column| column.name == *name);
            let heading = if is_taken { format!("{PREFIX}{name}") } else { name.clone() };
            added.push(column(&heading, numeric(is_numeric), unit.or(usual(name))));
            names.insert(name.clone(), heading);
        }
        let asked = told + added.len();
        all.splice(asked_for..asked_for, added);
        Columns { all, names, asked }
    }

    /// The heading of what varies or is set: its name, or `param.time` where the table tells of a `time` of its own.
    #[must_use]
    pub fn heading<'a>(&'a self, name: &'a str) -> &'a str {
        self.names.get(name).map_or(name, String::as_str)
    }

    /// Where a column stands.
    #[must_use]
    pub fn position(&self, name: &str) -> Option<usize> {
        self.all.iter().position(|column| column.name == name)
    }

    /// Two columns of one name: a param that is named like another's heading.
    #[must_use]
    pub fn twice(&self) -> Option<&str> {
        let (place, _) = self
            .all
            .iter()
            .enumerate()
            .find(|(place, column)| self.all[..*place].iter().any(|other| other.name == column.name))?;
        Some(&self.all[place].name)
    }

    /// The row of a run that came to an end.
    #[must_use]
    pub fn row(&self, asked: Vec<Cell>, results: Vec<Cell>) -> Row {
        self.ended(KINDS[0], asked, results, Cell::Missing)
    }

    /// The row of a run that an error ended; the error on one line.
    #[must_use]
    pub fn error(&self, asked: Vec<Cell>, error: &str) -> Row {
        let missing = vec![Cell::Missing; self.all.len() - self.asked - 1];
        self.ended(KINDS[1], asked, missing, Cell::Text(on_one_line(error)))
    }

    fn ended(&self, kind: &str, mut cells: Vec<Cell>, results: Vec<Cell>, error: Cell) -> Row {
        let run = if let Cell::Whole(run) = cells[0] { run as usize } else { 0 };
        cells.insert(1, Cell::Text(kind.to_owned()));
        cells.extend(results);
        cells.push(error);
        debug_assert_eq!(cells.len(), self.all.len());
        Row { run, cells }
    }

    /// The headings as a line of CSV.
    #[must_use]
    pub fn headings(&self) -> Vec<u8> {
        line(self.all.iter().map(|column| column.name.clone()))
    }

    /// A row from the texts of its cells; `None` when they are not such a row.
    #[must_use]
    pub fn parse(&self, texts: &[&str]) -> Option<Row> {
        if texts.len() != self.all.len() {
            return None;
        }
        let cells: Option<Vec<Cell>> =
            texts.iter().zip(&self.all).map(|(text, column)| Cell::parse(text, column.kind)).collect();
        let cells = cells?;
        match (&cells[0], &cells[1]) {
            (Cell::Whole(run), Cell::Text(kind)) if KINDS.contains(&kind.as_str()) => {
                Some(Row { run: usize::try_from(*run).ok()?, cells })
            }
            _ => None,
        }
    }
}

/// The unit of a body's quantity.
fn unit_of(read: &str) -> Option<&'static str> {
    match read.rsplit('.').next()? {
        "x" | "z" => Some("m"),
        "angle" => Some("rad"),
        "vx" | "vz" | "speed" => Some("m/s"),
        "spin" => Some("rad/s"),
        _ => None,
    }
}

impl Row {
    /// The row as a line of CSV: one line, whatever stands in it.
    #[must_use]
    pub fn csv(&self) -> Vec<u8> {
        line(self.cells.iter().map(Cell::text))
    }

    /// Whether an error ended the run.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.cells.get(1).is_some_and(|kind| *kind == Cell::Text(KINDS[1].to_owned()))
    }
}

impl Cell {
    /// The number that stands there.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Cell::Whole(number) => Some(*number as f64),
            Cell::Number(number) => Some(*number),
            Cell::Text(_) | Cell::Missing => None,
        }
    }

    /// The text of a file: numbers as the shortest that reads back to the same f64.
    #[must_use]
    pub fn text(&self) -> String {
        match self {
            Cell::Whole(number) => number.to_string(),
            Cell::Number(number) => format!("{:?}", number + 0.0),
            Cell::Text(text) => text.clone(),
            Cell::Missing => String::new(),
        }
    }

    fn parse(text: &str, kind: Kind) -> Option<Cell> {
        match kind {
            _ if text.is_empty() => Some(Cell::Missing),
            Kind::Text => Some(Cell::Text(text.to_owned())),
            Kind::Whole => text.parse().ok().map(Cell::Whole),
            Kind::Number => text.parse().ok().map(Cell::Number),
        }
    }
}

/// A text without line breaks.
#[must_use]
pub fn on_one_line(text: &str) -> String {
    text.split(char::is_control).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}

/// A line of CSV with its end.
fn line(cells: impl Iterator<Item = String>) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing into memory cannot fail.
    let _ = writer.write_record(cells);
    writer.into_inner().unwrap_or_default()
}
