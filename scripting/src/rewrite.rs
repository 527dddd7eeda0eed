//! Tuned values put into a script: only the numbers of `mu_l(…)`, `param("name", …)` and so on are replaced, or a line is
//! added to the settings; everything else stays as it is, comments and layout included.
//!
//! Where a number cannot be found without doubt nothing is changed. What comes out has been run: it makes the very scene
//! that the old script makes with the values given from outside.

use std::path::Path;

use crate::error::Diagnostic;
use crate::lexed::{Call, Head, Lexed};
use crate::options::Options;
use crate::params::SETTINGS;
use crate::sandbox;
use crate::script::Script;

/// Words that stand at the head of a script.
const HEAD: [&str; 18] = [
    "title",
    "time_step",
    "steps",
    "mu_l",
    "mu_a",
    "epsilon",
    "plane",
    "exchange",
    "detection",
    "motion",
    "substeps",
    "sleeping",
    "broad_phase",
    "restitution",
    "friction",
    "gravity",
    "drag",
    "seed",
];

/// The text of a script with these values in it: of params, and of the settings that `--set` reaches.
///
/// # Errors
/// A script that does not run with them; a number that is computed, stands in another file, or stands nowhere or in
/// several places, shown there; a script that would make another scene.
pub fn rewrite(file: &Path, text: &str, values: &[(String, f64)], options: &Options) -> Result<String, Diagnostic> {
    let mut tuned = options.clone();
    tuned.set.extend_from_slice(values);
    let (script, wanted) = Script::prepare(file, text, &tuned)?;
    let engine = sandbox::bare_engine();
    let Some(lexed) = Lexed::of(&engine, text) else {
        return Err(Diagnostic::new("the script is too long for its numbers to be found").in_file(file));
    };
    let name = file.display().to_string();
    let imports = script.texts_read().into_iter().filter(|(other, _)| *other != name).collect();
    let page = Page { file, text, lexed: &lexed, imports };
    let mut edits = Vec::new();
    let mut lines = Vec::new();
    for (name, value) in last_of_each(values) {
        match page.edits(name, value)? {
            Found::Numbers(found) => edits.extend(found),
            Found::Missing => lines.push(format!("{name}({});", number(value, true))),
        }
    }
    if !lines.is_empty() {
        edits.push(insertion(text, &lexed, &lines));
    }
    let new = apply(text, edits);
    let mut untuned = options.clone();
    untuned.set.retain(|(name, _)| values.iter().all(|(tuned, _)| tuned != name));
    let (_, scene) = Script::prepare(file, &new, &untuned)?;
    if scene == wanted {
        return Ok(new);
    }
    Err(Diagnostic::new("with these values written into it the script would make another scene than the one shown")
        .in_file(file)
        .with_hint(Some("is a value set again further down, or only under a condition? change it by hand".to_owned())))
}

/// A script in which numbers are looked for.
struct Page<'a> {
    file: &'a Path,
    text: &'a str,
    lexed: &'a Lexed<'a>,
    imports: Vec<(String, String)>,
}

/// A piece of the text, in bytes, and what takes its place.
type Edit = (std::ops::Range<usize>, String);

enum Found {
    Numbers(Vec<Edit>),
    /// A setting that the script leaves at its default.
    Missing,
}

impl Page<'_> {
    /// What has to change for a name to have a value.
    fn edits(&self, name: &str, value: f64) -> Result<Found, Diagnostic> {
        let is_setting = SETTINGS.contains(&name);
        let calls = |lexed: &Lexed| if is_setting { lexed.calls(name) } else { lexed.param_calls(name) };
        self.refuse_imported(name, calls)?;
        let calls = calls(self.lexed);
        match calls.as_slice() {
            [] if is_setting => return Ok(Found::Missing),
            [] => {
                return Err(Diagnostic::new(format!("there is no param(\"{name}\", …) with its name written out"))
                    .in_file(self.file)
                    .with_hint(Some("change it by hand where the script makes up its name".to_owned())));
            }
            [_, second, ..] if is_setting => {
                let (line, _) = self.lexed.place(calls[0].at);
                let message =
                    format!("{name} is set more than once, first in line {line}: it is not clear which counts");
                return Err(self.shown(message, second).with_hint(Some("keep one of them".to_owned())));
            }
            _ => {}
        }
        let mut edits = Vec::new();
        for call in &calls {
            let Some(number) = &call.number else {
                let message = format!("the value of {name} is computed here: there is no number to replace");
                return Err(self.shown(message, call).with_hint(Some("change it by hand".to_owned())));
            };
            if number.value != value {
                edits.push((number.range.clone(), self::number(value, number.is_whole)));
            }
        }
        Ok(Found::Numbers(edits))
    }

    /// A value that an imported script gives is not changed from here: others import it too.
    fn refuse_imported(&self, name: &str, calls: impl Fn(&Lexed) -> Vec<Call>) -> Result<(), Diagnostic> {
        let engine = sandbox::bare_engine();
        for (file, text) in &self.imports {
            let Some(lexed) = Lexed::of(&engine, text) else { continue };
            let Some(call) = calls(&lexed).into_iter().next() else { continue };
            let (line, column) = lexed.place(call.at);
            let message = format!("{name} gets its value in a file that other scenarios may import too");
            let hint = Some("change it there by hand".to_owned());
            return Err(Diagnostic::new(message).at(file.as_ref(), text, line, column).with_hint(hint));
        }
        Ok(())
    }

    fn shown(&self, message: String, call: &Call) -> Diagnostic {
        let (line, column) = self.lexed.place(call.at);
        Diagnostic::new(message).at(self.file, self.text, line, column)
    }
}

/// Of a name given twice the last value counts.
fn last_of_each(values: &[(String, f64)]) -> impl Iterator<Item = (&str, f64)> {
    let is_last = |at: usize, name: &String| values[at + 1..].iter().all(|(later, _)| later != name);
    let last = values.iter().enumerate().filter(move |(at, (name, _))| is_last(*at, name));
    last.map(|(_, (name, value))| (name.as_str(), *value))
}

/// The shortest text that reads back as the same number; a whole one stays whole where it may.
fn number(value: f64, may_be_whole: bool) -> String {
    let text = format!("{}", value + 0.0);
    if may_be_whole || text.contains('.') { text } else { format!("{text}.0") }
}

/// New statements after the head of a script, on lines of their own wherever that tears nothing apart.
fn insertion(text: &str, lexed: &Lexed, statements: &[String]) -> Edit {
    let newline = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let (at, inserted) = match lexed.after_the_head(&HEAD) {
        Head::EndsAt(end) => {
            let rest = text[end..].split('\n').next().unwrap_or("");
            let row = rest.trim();
            if row.is_empty() || row.starts_with("//") {
                let lines: String = statements.iter().map(|line| format!("{newline}{line}")).collect();
                (end + rest.trim_end_matches('\r').len(), lines)
            } else {
                (end, statements.iter().map(|line| format!(" {line}")).collect())
            }
        }
        Head::MissingBefore(start) => (start, statements.iter().map(|line| format!("{line}{newline}")).collect()),
    };
    (at..at, inserted)
}

fn apply(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|(range, _)| range.start);
    let mut new = text.to_owned();
    for (range, replacement) in edits.into_iter().rev() {
        new.replace_range(range, &replacement);
    }
    new
}
