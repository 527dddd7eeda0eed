//! Tables: for people, for Markdown, for programs.

use serde::Serialize;

use choque::report::format::significant;

use crate::engine::Engine;
use crate::speed::Row;

/// A table of texts; the first column leans left, the others right.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// What the columns hold.
    pub head: Vec<String>,
    /// The rows, as many cells each as the head has.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table.
    #[must_use]
    pub fn new(head: &[&str]) -> Self {
        Table { head: head.iter().map(|cell| (*cell).to_owned()).collect(), rows: Vec::new() }
    }

    /// Columns set apart by spaces.
    #[must_use]
    pub fn text(&self) -> String {
        let width = |column: usize| self.lines().map(|line| line[column].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let cell = |(column, cell): (usize, &String)| match column {
            0 => format!("{cell:<width$}", width = widths[0]),
            _ => format!("{cell:>width$}", width = widths[column]),
        };
        self.lines()
            .map(|line| line.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n")
            .collect()
    }

    /// A table of Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
        let sides: Vec<&str> = (0..self.head.len()).map(|i| if i == 0 { "---" } else { "---:" }).collect();
        let rows: String = self.rows.iter().map(line).collect();
        format!("{}| {} |\n{rows}", line(&self.head), sides.join(" | "))
    }

    fn lines(&self) -> impl Iterator<Item = &Vec<String>> {
        std::iter::once(&self.head).chain(&self.rows)
    }
}

/// A row as programs read it.
#[derive(Serialize)]
struct Record<'a> {
    scene: &'a str,
    engine: String,
    precision: &'static str,
    threads: usize,
    best_ms: f64,
    median_ms: f64,
    bytes_per_body: f64,
    deepest: Option<f64>,
    energy_drift: Option<f64>,
    shape_error: Option<f64>,
}

/// The speed table as one JSON array.
///
/// # Errors
/// None that are known; the serialiser's.
pub fn json(rows: &[Row]) -> serde_json::Result<String> {
    let records: Vec<Record<'_>> = rows.iter().map(record).collect();
    serde_json::to_string_pretty(&records)
}

fn record(row: &Row) -> Record<'_> {
    Record {
        scene: &row.scene,
        engine: row.engine.word(),
        precision: row.engine.precision(),
        threads: row.threads,
        best_ms: row.best_ms,
        median_ms: row.median_ms,
        bytes_per_body: row.bytes_per_body,
        deepest: row.verdict.deepest,
        energy_drift: row.verdict.energy_drift,
        shape_error: row.verdict.shape_error,
    }
}

/// The speed table for people.
#[must_use]
pub fn speed(rows: &[Row]) -> Table {
    let mut table = Table::new(&[
        "scene",
        "bodies",
        "steps",
        "engine",
        "precision",
        "threads",
        "best ms",
        "median ms",
        "spread",
        "choque / it",
        "bytes/body",
        "contacts",
        "deepest m",
        "energy drift",
        "shape error",
    ]);
    for row in rows {
        let ours = rows.iter().find(|other| other.scene == row.scene && other.engine == Engine::Choque);
        let ratio = ours.and_then(|ours| Some(ours.sound_ms()? / row.sound_ms()?));
        table.rows.push(vec![
            row.scene.clone(),
            row.bodies.to_string(),
            row.steps.to_string(),
            row.engine.word(),
            row.engine.precision().to_owned(),
            row.threads.to_string(),
            significant(row.best_ms),
            significant(row.median_ms),
            format!("{:.0} %", 100.0 * row.spread),
            told(ratio),
            format!("{:.0}", row.bytes_per_body),
            row.contacts.map_or_else(nothing, |count| count.to_string()),
            row.verdict.deepest.map_or_else(|| "not finite".to_owned(), significant),
            told(row.verdict.energy_drift),
            told(row.verdict.shape_error),
        ]);
    }
    table
}

/// A number, or a dash where there is none.
#[must_use]
pub fn told(number: Option<f64>) -> String {
    number.map_or_else(nothing, significant)
}

fn nothing() -> String {
    "–".to_owned()
}
