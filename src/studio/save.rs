//! The sliders' values written into the script: the numbers and nothing else, all of it or nothing, and never over what
//! someone else has written meanwhile.

use std::fs;
use std::io;
use std::path::Path;

use choque_scripting::{Options, Scenario, write_back};
use serde::Serialize;
use thiserror::Error;

use super::files::digest;
use crate::written;

/// What was written.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Saved {
    /// The script's digest from now on.
    pub(super) digest: String,
    /// The lines that are new.
    pub(super) lines: Vec<Line>,
}

/// A line of the script, from 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Line {
    number: usize,
    text: String,
}

/// Why nothing was written.
#[derive(Debug, Error)]
pub(super) enum Refused {
    /// What is shown is not what the file says now.
    #[error("the script has changed on disk since it was run: nothing was written; look at it again and write then")]
    Changed,
    /// Plain data, which a program has written.
    #[error("a .ron scene is written by `choque export`: set these values in its script; nothing was written")]
    Plain,
    /// A number that cannot be placed, shown where it would be.
    #[error("{0}")]
    Unclear(Box<choque_scripting::Diagnostic>),
    /// The file, or its folder.
    #[error("the script cannot be written: {0}; nothing was changed")]
    File(#[from] io::Error),
}

const BYTE_ORDER_MARK: &str = "\u{feff}";

/// Writes values into a script whose text, as it was run, has this digest.
///
/// # Errors
/// See [`Refused`]. The file is then as it was.
pub(super) fn save(path: &Path, run: &str, values: &[(String, f64)], options: &Options) -> Result<Saved, Refused> {
    if !Scenario::is_script(path) {
        return Err(Refused::Plain);
    }
    let old = fs::read_to_string(path)?;
    let (mark, text) = match old.strip_prefix(BYTE_ORDER_MARK) {
        Some(text) => (BYTE_ORDER_MARK, text),
        None => ("", old.as_str()),
    };
    if digest(text) != run {
        return Err(Refused::Changed);
    }
    let new = write_back(path, text, values, options).map_err(|error| Refused::Unclear(Box::new(error)))?;
    let saved = Saved { digest: digest(&new), lines: new_lines(text, &new) };
    if new != text {
        let is_written = written::replace_unchanged(path, &old, &format!("{mark}{new}"))?;
        return if is_written { Ok(saved) } else { Err(Refused::Changed) };
    }
    Ok(saved)
}

/// The lines of a text that its old version does not have at that place: values are replaced within lines, and settings are
/// added in one piece.
fn new_lines(old: &str, new: &str) -> Vec<Line> {
    let (old, new): (Vec<&str>, Vec<&str>) = (old.lines().collect(), new.lines().collect());
    let added = new.len().saturating_sub(old.len());
    let mut shift = 0;
    let mut lines = Vec::new();
    for (at, line) in new.iter().enumerate() {
        let before = old.get(at - shift);
        if before == Some(line) {
            continue;
        }
        // A line that is followed by what stood here has been added.
        if shift < added && new.get(at + added - shift) == before {
            shift += 1;
        }
        lines.push(Line { number: at + 1, text: (*line).to_owned() });
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn new_lines_are_those_that_changed_or_were_added() {
        let numbers = |old, new| new_lines(old, new).iter().map(|line| line.number).collect::<Vec<_>>();
        assert_eq!(numbers("a\nb\nc", "a\nB\nc"), [2]);
        assert_eq!(numbers("a\nb\nc", "a\nx\nb\nC"), [2, 4]);
        assert_eq!(numbers("a\nb", "a\nb\nx\ny"), [3, 4]);
        assert_eq!(numbers("a\nb", "x\ny\na\nb"), [1, 2]);
        assert_eq!(numbers("a\nb", "a\nb"), [0; 0]);
    }
}
