//! Errors as a person sees them: what was wrong, where, the line itself, what to do instead.

use std::fmt;
use std::path::{Path, PathBuf};

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

/// An error in a script, a scene or a call. `Display` is the whole text for a person:
///
/// ```text
/// error: rect: width must be a number, not a string
///  --> car.rhai:3:13
///   |
/// 3 | mobile("a").rect("x", 2);
///   |             ^^^^
///   |
///   = help: …
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What was wrong, in a sentence.
    pub message: String,
    /// The file it was found in, written as the caller wrote it.
    pub file: Option<PathBuf>,
    /// Line in that file, from 1.
    pub line: Option<usize>,
    /// Column in that line, in characters from 1.
    pub column: Option<usize>,
    /// What to do instead.
    pub hint: Option<String>,
    details: Box<Details>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Details {
    /// The text of the line.
    text: Option<String>,
    /// How one gets there: the calls on the way, innermost first.
    notes: Vec<String>,
}

impl Diagnostic {
    /// An error with nothing known but what was wrong.
    pub fn new(message: impl Into<String>) -> Self {
        let details = Box::default();
        Diagnostic { message: message.into(), file: None, line: None, column: None, hint: None, details }
    }

    /// The same error, in that file.
    #[must_use]
    pub fn in_file(mut self, file: &Path) -> Self {
        self.file = Some(file.to_owned());
        self
    }

    /// The same error at a line and a column (both from 1) of a file with that text.
    #[must_use]
    pub fn at(mut self, file: &Path, text: &str, line: usize, column: usize) -> Self {
        let rows: Vec<&str> = text.lines().collect();
        let row = rows.get(line.saturating_sub(1)).copied();
        // What is found missing at the very end is shown where the text ends.
        let last = rows.iter().rposition(|row| !row.trim().is_empty());
        let (line, column) = match (row, last) {
            (None, Some(last)) => (last + 1, rows[last].trim_end().chars().count() + 1),
            _ => (line, column),
        };
        self.details.text = row.or(last.map(|last| rows[last])).map(str::to_owned);
        (self.line, self.column) = (Some(line), Some(column));
        self.in_file(file)
    }

    /// The same error with a hint, if there is one.
    #[must_use]
    pub fn with_hint(mut self, hint: Option<String>) -> Self {
        self.hint = hint;
        self
    }

    pub(crate) fn of(complaint: Complaint) -> Self {
        Diagnostic::new(complaint.message).with_hint(complaint.hint)
    }

    pub(crate) fn and_note(mut self, note: String) -> Self {
        self.details.notes.push(note);
        self
    }

    pub(crate) fn and_notes(mut self, notes: Vec<String>) -> Self {
        self.details.notes.extend(notes);
        self
    }
}

impl std::error::Error for Diagnostic {}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut group = Group::with_title(Level::ERROR.primary_title(&*self.message));
        let path = self.file.as_ref().map(|file| file.display().to_string());
        match (&self.details.text, self.line, self.column) {
            (Some(text), Some(line), column) => {
                let span = AnnotationKind::Primary.span(word_at(text, column.unwrap_or(1)));
                group = group.element(Snippet::source(&**text).line_start(line).path(path).annotation(span));
            }
            (None, line, column) => {
                if let Some(path) = path {
                    let origin = line.map_or(Origin::path(path.clone()), |line| Origin::path(path).line(line));
                    group = group.element(column.map_or(origin.clone(), |column| origin.char_column(column)));
                }
            }
            (Some(_), None, _) => {}
        }
        group = group.elements(self.details.notes.iter().map(|note| Level::NOTE.message(&**note)));
        group = group.elements(self.hint.iter().map(|hint| Level::HELP.message(&**hint)));
        f.write_str(&Renderer::plain().render(&[group]))
    }
}

/// The bytes of the word, the text or the sign that begins at a column: what the carets stand under.
fn word_at(line: &str, column: usize) -> std::ops::Range<usize> {
    let start = line.char_indices().nth(column.saturating_sub(1)).map_or(line.len(), |(at, _)| at);
    let rest = &line[start..];
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let length = match rest.chars().next() {
        None => 0,
        Some(c) if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
        Some('"') => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
        Some(c) => c.len_utf8(),
    };
    start..start + length
}

/// What is wrong, said where it is found; who shows it adds the place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Complaint {
    pub(crate) message: String,
    pub(crate) hint: Option<String>,
    /// Where, when that is in another file than the script that was running (a line of a `.obj`).
    pub(crate) elsewhere: Option<Box<Elsewhere>>,
}

/// A line of a file that is no script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Elsewhere {
    pub(crate) file: PathBuf,
    pub(crate) line: usize,
    /// In characters, from 1.
    pub(crate) column: usize,
    pub(crate) text: String,
}

impl Complaint {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Complaint { message: message.into(), hint: None, elsewhere: None }
    }

    /// The same complaint, said of a body; one that names it already stays as it is.
    pub(crate) fn about_body(mut self, name: &str) -> Self {
        if !self.message.contains(&format!("\"{name}\"")) {
            self.message = format!("body \"{name}\": {}", self.message);
        }
        self
    }

    pub(crate) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    pub(crate) fn maybe_hint(mut self, hint: Option<String>) -> Self {
        self.hint = hint.or(self.hint);
        self
    }
}

impl From<choque_engine::BadNumber> for Complaint {
    fn from(bad: choque_engine::BadNumber) -> Self {
        Complaint::new(bad.to_string())
    }
}

impl From<choque_engine::CommandError> for Complaint {
    fn from(error: choque_engine::CommandError) -> Self {
        Complaint::new(error.to_string())
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}
