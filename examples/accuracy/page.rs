//! A page whose prose is written by hand and whose numbers are put in by name.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use choque::plot::{Figure, svg};

/// What stands in the page for each name.
pub(crate) type Parts = BTreeMap<String, String>;

/// The page with every `{{name}}` replaced.
pub(crate) fn filled(page: &str, parts: &Parts) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    let mut pieces = page.split("{{");
    text += pieces.next().unwrap_or_default();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").ok_or("a name in the page that does not end")?;
        text += parts.get(name).ok_or_else(|| format!("nothing was measured for {name}"))?;
        text += rest;
    }
    Ok(text)
}

/// A table in Markdown; the first column leans left, the others right.
pub(crate) fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let sides = (0..head.len()).map(|i| if i == 0 { "---" } else { "---:" });
    let mut text = line(&head.iter().map(|cell| (*cell).to_owned()).collect::<Vec<_>>());
    text += &format!("| {} |\n", sides.collect::<Vec<_>>().join(" | "));
    text + rows.iter().map(|row| line(row)).collect::<String>().trim_end()
}

/// Writes a plot and gives the line that shows it.
pub(crate) fn picture(folder: &Path, name: &str, figure: &Figure) -> Result<String, Box<dyn Error>> {
    std::fs::write(folder.join(format!("{name}.svg")), svg::svg(&figure.draw()))?;
    Ok(format!("![{}](docs/accuracy/{name}.svg)", figure.title))
}
