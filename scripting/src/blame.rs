//! From an error of the script language to what a person sees: which file, which line, in which words.

use rhai::{Engine, EvalAltResult, ImmutableString, ParseError, Position};

use crate::error::{Complaint, Diagnostic};
use crate::library::Library;
use crate::phrase;
use crate::session::Site;
use crate::source;
use crate::syntax;

/// Calls told of, innermost first; of a deep recursion the rest is counted.
const MOST_NOTES: usize = 4;

/// What it takes to tell where an error comes from.
#[derive(Clone, Copy)]
pub(crate) struct Blame<'a> {
    pub(crate) engine: &'a Engine,
    pub(crate) library: &'a Library,
    /// The script's name, as errors show it.
    pub(crate) script: &'a str,
}

/// The text around an error, for whoever finds the words for it.
pub(crate) struct Place<'a> {
    pub(crate) engine: &'a Engine,
    pub(crate) library: &'a Library,
    /// Of the script the error is in.
    pub(crate) text: String,
    pub(crate) position: Position,
}

impl Place<'_> {
    /// The whole line.
    pub(crate) fn row(&self) -> &str {
        self.position.line().and_then(|line| self.text.lines().nth(line - 1)).unwrap_or("")
    }

    /// What stands on the line before the position.
    pub(crate) fn before(&self) -> &str {
        let row = self.row();
        let column = self.position.position().unwrap_or(1).saturating_sub(1);
        &row[..row.char_indices().nth(column).map_or(row.len(), |(at, _)| at)]
    }

    /// The word or sign at the position.
    pub(crate) fn word(&self) -> Option<&str> {
        let (line, column) = (self.position.line()?, self.position.position()?);
        let mut tokens = source::tokens(&self.text).into_iter();
        tokens.find(|token| (token.line, token.column) == (line, column)).map(|token| token.text)
    }

    /// Whether the position is in the body of a function.
    pub(crate) fn is_in_function(&self) -> bool {
        let place = (self.position.line().unwrap_or(1), self.position.position().unwrap_or(1));
        source::is_in_function(&self.text, place)
    }
}

/// Where an error happened, with the calls on the way there, innermost last.
struct Trail<'a> {
    error: &'a EvalAltResult,
    source: &'a str,
    calls: Vec<Call<'a>>,
}

struct Call<'a> {
    what: What<'a>,
    source: &'a str,
    position: Position,
}

enum What<'a> {
    Function(&'a str),
    Module,
}

impl Blame<'_> {
    /// An error while running; `fallback` is where it is shown if nothing is known of its place.
    pub(crate) fn error(&self, error: &EvalAltResult, fallback: Option<&Site>) -> Diagnostic {
        let trail = self.follow(error);
        let known = (trail.source, trail.error.position());
        let call = trail.calls.iter().rev().map(|call| (call.source, call.position));
        let places = std::iter::once(known).chain(call).filter(|(_, position)| !position.is_none());
        let fallback = fallback.map(|site| (site.source.as_str(), site.position));
        let place = places.chain(fallback).next().or(Some((trail.source, Position::NONE)));
        let complaint = self.complaint(trail.error, place);
        self.show(complaint, place).and_notes(notes(&trail.calls))
    }

    /// A script that does not compile.
    pub(crate) fn syntax_error(&self, error: ParseError) -> Diagnostic {
        self.error(&error.into(), None)
    }

    /// A complaint about something at a place.
    pub(crate) fn complaint_at(&self, complaint: Complaint, site: &Site) -> Diagnostic {
        self.show(complaint, Some((&site.source, site.position)))
    }

    /// A complaint about the script as a whole.
    pub(crate) fn complaint_of_script(&self, complaint: Complaint) -> Diagnostic {
        self.show(complaint, Some((self.script, Position::NONE)))
    }

    /// Where a script defines a function.
    pub(crate) fn definition(&self, function: &str) -> Site {
        let text = self.library.text(self.script).unwrap_or_default();
        let defined = source::functions(&text).into_iter().find(|known| known.name.text == function);
        let position = defined.map_or(Position::NONE, |known| known.name.position());
        Site { source: ImmutableString::from(self.script), position }
    }

    fn follow<'a>(&'a self, error: &'a EvalAltResult) -> Trail<'a> {
        let mut trail = Trail { error, source: self.script, calls: Vec::new() };
        loop {
            let (what, source, inner, position) = match trail.error {
                EvalAltResult::ErrorInFunctionCall(name, source, inner, position) => {
                    (What::Function(name), source, inner, *position)
                }
                EvalAltResult::ErrorInModule(module, inner, position) => (What::Module, module, inner, *position),
                _ => return trail,
            };
            trail.calls.push(Call { what, source: trail.source, position });
            trail.source = if source.is_empty() { trail.source } else { source };
            trail.error = inner;
        }
    }

    fn complaint(&self, error: &EvalAltResult, place: Option<(&str, Position)>) -> Complaint {
        let text = place.and_then(|(source, _)| self.library.text(source)).unwrap_or_default();
        let position = place.map_or(Position::NONE, |(_, position)| position);
        let place = Place { engine: self.engine, library: self.library, text, position };
        match error {
            EvalAltResult::ErrorParsing(error, _) => syntax::complaint(error, &place),
            error => phrase::complaint(error, &place),
        }
    }

    fn show(&self, complaint: Complaint, place: Option<(&str, Position)>) -> Diagnostic {
        let diagnostic = Diagnostic::new(complaint.message).with_hint(complaint.hint);
        if let Some(elsewhere) = complaint.elsewhere {
            let asked = place.and_then(|(source, position)| told_place(source, position));
            let diagnostic = diagnostic.at(&elsewhere.file, &elsewhere.text, elsewhere.line, elsewhere.column);
            return asked.map(|asked| format!("read at {asked}")).into_iter().fold(diagnostic, Diagnostic::and_note);
        }
        let Some((source, position)) = place else { return diagnostic };
        match (self.library.text(source), position.line()) {
            (Some(text), Some(line)) => {
                let column = position.position().unwrap_or(1);
                let is_dot = text.lines().nth(line - 1).and_then(|row| row.chars().nth(column - 1)) == Some('.');
                diagnostic.at(source.as_ref(), &text, line, column + usize::from(is_dot))
            }
            _ => diagnostic.in_file(source.as_ref()),
        }
    }
}

/// "scenario.rhai:12:5", of a place that is known.
fn told_place(source: &str, position: Position) -> Option<String> {
    position.line().zip(position.position()).map(|(line, column)| format!("{source}:{line}:{column}"))
}

/// "in `car`, called at scenario.rhai:12:5", innermost first.
fn notes(calls: &[Call]) -> Vec<String> {
    let told = |call: &Call| match (&call.what, told_place(call.source, call.position)) {
        (What::Module, Some(place)) => Some(format!("imported at {place}")),
        (What::Function(name), Some(place)) if name.starts_with("anon$") => {
            Some(format!("in a closure called at {place}"))
        }
        (What::Function(name), Some(place)) => Some(format!("in `{name}`, called at {place}")),
        (What::Function(name), None) if !name.starts_with("anon$") => Some(format!("in `{name}`")),
        _ => None,
    };
    let mut notes: Vec<String> = calls.iter().rev().filter_map(told).collect();
    let more = notes.len().saturating_sub(MOST_NOTES);
    notes.truncate(MOST_NOTES);
    if more > 0 {
        notes.push(format!("and {more} more calls"));
    }
    notes
}
