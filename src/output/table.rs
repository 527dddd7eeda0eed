//! A table with aligned columns.

use crate::terminal::{HEADING, styled};

/// Which side a column's cells lean to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// The rows under their headings, two spaces between columns, indented by two.
#[must_use]
pub fn table(columns: &[(&str, Side)], rows: &[Vec<String>]) -> String {
    let width = |i: usize| {
        let cells = rows.iter().filter_map(|row| row.get(i)).map(|cell| cell.chars().count());
        cells.chain([columns[i].0.chars().count()]).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    let line = |cells: &mut dyn Iterator<Item = &str>| {
        let padded = cells.zip(columns).zip(&widths).map(|((cell, (_, side)), width)| match side {
            Side::Left => format!("{cell:<width$}"),
            Side::Right => format!("{cell:>width$}"),
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    let head = line(&mut columns.iter().map(|(name, _)| *name));
    let mut text = format!("  {}\n", styled(HEADING, &head));
    for row in rows {
        text += &format!("  {}\n", line(&mut row.iter().map(String::as_str)));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let rows = [["aé", "1"], ["b", "-10.5"]].map(|row| row.map(str::to_owned).to_vec());
        let text = table(&[("name", Side::Left), ("x", Side::Right)], &rows);
        let plain = anstream::adapter::strip_str(&text).to_string();
        assert_eq!(plain, "  name      x\n  aé        1\n  b     -10.5\n");
    }
}
