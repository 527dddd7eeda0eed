//! The sliders' values written into the script: the numbers and nothing else, all of it or nothing, and never over what
//! someone else has written meanwhile.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use choque_scripting::{Options, rewrite};
use serde::Serialize;
use thiserror::Error;

use super::files::digest;

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
    let old = fs::read_to_string(path)?;
    let (mark, text) = match old.strip_prefix(BYTE_ORDER_MARK) {
        Some(text) => (BYTE_ORDER_MARK, text),
        None => ("", old.as_str()),
    };
    if digest(text) != run {
        return Err(Refused::Changed);
    }
    let new = rewrite(path, text, values, options).map_err(|error| Refused::Unclear(Box::new(error)))?;
    let saved = Saved { digest: digest(&new), lines: new_lines(text, &new) };
    if new != text {
        replace_unchanged(path, &old, &format!("{mark}{new}"))?;
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

/// Writes beside the file and puts it in its place in one go, if the file is still what it was. A link stays a link, and the
/// file keeps its permissions.
fn replace_unchanged(path: &Path, old: &str, new: &str) -> Result<(), Refused> {
    let path = path.canonicalize()?;
    let permissions = fs::metadata(&path)?.permissions();
    if permissions.readonly() {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only").into());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut beside = tempfile::Builder::new().prefix(".choque-").suffix(".tmp").tempfile_in(folder)?;
    beside.write_all(new.as_bytes())?;
    beside.as_file().set_permissions(permissions)?;
    beside.as_file().sync_all()?;
    if fs::read(&path)? != old.as_bytes() {
        return Err(Refused::Changed);
    }
    match exchange(beside.path(), &path) {
        // What was in its place is now beside it, and can still be looked at: someone may have saved in that very moment.
        Ok(()) if fs::read(beside.path())? == old.as_bytes() => Ok(()),
        Ok(()) => {
            exchange(beside.path(), &path)?;
            if fs::read(beside.path())? != new.as_bytes() {
                exchange(beside.path(), &path)?; // saved once more: the last one stays
            }
            Err(Refused::Changed)
        }
        Err(_) => {
            beside.persist(&path).map_err(|error| error.error)?;
            Ok(())
        }
    }
}

/// Has two files change places, where the system can do that.
#[cfg(target_os = "linux")]
fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE)?)
}

#[cfg(not(target_os = "linux"))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
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

    #[test]
    fn a_file_that_was_saved_meanwhile_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.rhai");
        fs::write(&path, "mine").expect("a file");
        assert!(matches!(replace_unchanged(&path, "old", "new"), Err(Refused::Changed)));
        assert_eq!(fs::read_to_string(&path).expect("a text"), "mine");
        replace_unchanged(&path, "mine", "new").expect("it is as it was");
        assert_eq!(fs::read_to_string(&path).expect("a text"), "new");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "nothing is left beside it");
    }
}
