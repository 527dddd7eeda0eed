//! Tuned values put into a script: only the numbers of `mu_l(…)`, `param("name", …)` and so on are replaced, or a line is
//! added to the settings; everything else stays as it is, comments and layout included.
//!
//! Where a number cannot be found without doubt nothing is changed. What comes out has been run: it makes the very scene
//! that the old script makes with the values given from outside.

use std::path::Path;

use choque_engine::Scene;

use crate::error::{Complaint, Diagnostic};
use crate::lexed::{Call, Head, Lexed};
use crate::options::{Options, Output};
use crate::params::{SETTINGS, setting};
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

/// The text of a script with these values in it: of params, and of the settings that `--set` reaches. Of a name given twice
/// the last value counts. Line endings and a byte order mark stay; a whole number stays one where it can.
///
/// # Errors
/// A script that does not run with them; a number that is computed, stands in another file, or stands nowhere or in
/// several places, shown there; a script that would make another scene. All values have a place, or none is written.
pub fn write_back(file: &Path, text: &str, values: &[(String, f64)], options: &Options) -> Result<String, Diagnostic> {
    const BYTE_ORDER_MARK: char = '\u{feff}';
    let body = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
    let mark = &text[..text.len() - body.len()];
    let untuned = quiet(options, values);
    let mut tuned = untuned.clone();
    tuned.set.extend_from_slice(values);
    let (script, wanted) = Script::prepare(file, body, &tuned)?;
    let engine = sandbox::bare_engine();
    let Some(lexed) = Lexed::of(&engine, body) else {
        return Err(Diagnostic::new("the script is too long for its numbers to be found").in_file(file));
    };
    let page = Page { file, text: body, lexed: &lexed, script: &script };
    let values: Vec<(&str, f64)> = last_of_each(values).collect();
    let new = page.with(&values)?;
    match Script::prepare(file, &new, &untuned) {
        Ok((_, scene)) => page.compare(&scene, &wanted, &values)?,
        Err(error) => {
            let imported = values.iter().find_map(|(name, value)| page.imported(name, *value));
            return Err(imported.unwrap_or(error));
        }
    }
    Ok(format!("{mark}{new}"))
}

/// The same options without a word printed, and without what is set from outside of the names that are written.
fn quiet(options: &Options, values: &[(String, f64)]) -> Options {
    let mut options = Options { output: Output::to(|_| {}), ..options.clone() };
    options.set.retain(|(name, _)| values.iter().all(|(written, _)| written != name));
    options
}

/// Of a name given twice the last value counts.
fn last_of_each(values: &[(String, f64)]) -> impl Iterator<Item = (&str, f64)> {
    let is_last = |at: usize, name: &String| values[at + 1..].iter().all(|(later, _)| later != name);
    let last = values.iter().enumerate().filter(move |(at, (name, _))| is_last(*at, name));
    last.map(|(_, (name, value))| (name.as_str(), *value))
}

/// A script in which numbers are looked for.
struct Page<'a> {
    file: &'a Path,
    text: &'a str,
    lexed: &'a Lexed<'a>,
    /// The same, as it ran with the new values.
    script: &'a Script,
}

/// A piece of the text, in bytes, and what takes its place.
type Edit = (std::ops::Range<usize>, String);

impl Page<'_> {
    /// The text with all values in it.
    fn with(&self, values: &[(&str, f64)]) -> Result<String, Diagnostic> {
        let mut edits = Vec::new();
        let mut statements = Vec::new();
        for (name, value) in values {
            let calls = calls(self.lexed, name);
            if calls.is_empty() && is_setting(name) {
                statements.push(format!("{name}({});", literal(*value, false)));
            } else {
                self.replace(name, *value, &calls, &mut edits)?;
            }
        }
        if !statements.is_empty() {
            edits.push(insertion(self.text, self.lexed, &statements));
        }
        edits.sort_by_key(|(range, _)| range.start);
        let mut new = self.text.to_owned();
        for (range, replacement) in edits.into_iter().rev() {
            new.replace_range(range, &replacement);
        }
        Ok(new)
    }

    /// A setting is made once; a param may be read again, with the same default everywhere.
    fn replace(&self, name: &str, value: f64, calls: &[Call], edits: &mut Vec<Edit>) -> Result<(), Diagnostic> {
        let Some(first) = calls.first() else {
            return Err(self.imported(name, value).unwrap_or_else(|| self.made_up(name, value)));
        };
        if is_setting(name) && calls.len() > 1 {
            let mut lines: Vec<String> = calls.iter().map(|call| self.lexed.place(call.at).0.to_string()).collect();
            lines.dedup();
            let (lines, times) = (lines.join(", "), calls.len());
            let message =
                format!("{name}(…) stands in the script {times} times (line {lines}): which should be {value}?");
            return Err(self.shown(message, first).with_hint(Some("keep one of them".to_owned())));
        }
        for call in calls {
            let Some(number) = &call.number else {
                let written = written(name);
                let message =
                    format!("{written} is handed an expression here: there is no number for {value} to replace");
                let hint = "write the number itself in its place, or change it by hand".to_owned();
                return Err(self.shown(message, call).with_hint(Some(hint)));
            };
            if number.value != value {
                edits.push((number.range.clone(), literal(value, number.is_whole)));
            }
        }
        Ok(())
    }

    /// Whether the new script makes the scene that was tried; if not, what is in the way.
    fn compare(&self, scene: &Scene, wanted: &Scene, values: &[(&str, f64)]) -> Result<(), Diagnostic> {
        if scene == wanted {
            return Ok(());
        }
        for (name, value) in values {
            let param = scene.params.iter().find(|param| param.name == *name).map(|param| param.value);
            let found = setting(&scene.settings, name).or(param);
            if found == Some(*value) {
                continue;
            }
            if let Some(imported) = self.imported(name, *value) {
                return Err(imported);
            }
            let found = found.map_or("nothing".to_owned(), |found| found.to_string());
            let message = format!("{name} would be {found} and not {value}: something else in the script sets it");
            let hint = Some(format!("set it once, and under no condition: {}", written(name)));
            let shown = match calls(self.lexed, name).first() {
                Some(call) => self.shown(message, call),
                None => Diagnostic::new(message).in_file(self.file),
            };
            return Err(shown.with_hint(hint));
        }
        let list: Vec<String> = values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        let message = format!("with {} written into it the script would make another scene", list.join(", "));
        Err(Diagnostic::new(message).in_file(self.file).with_hint(Some("change it by hand".to_owned())))
    }

    /// A value that an imported script gives is not changed from here: others import it too.
    fn imported(&self, name: &str, value: f64) -> Option<Diagnostic> {
        let engine = sandbox::bare_engine();
        let own = self.file.display().to_string();
        self.script.texts_read().into_iter().filter(|(other, _)| *other != own).find_map(|(other, text)| {
            let lexed = Lexed::of(&engine, &text)?;
            let (line, column) = lexed.place(calls(&lexed, name).first()?.at);
            let message = format!(
                "{name} gets its value in a file that other scenarios may import too: {value} is not written there"
            );
            let hint = Some("change it there by hand".to_owned());
            Some(Diagnostic::new(message).at(other.as_ref(), &text, line, column).with_hint(hint))
        })
    }

    /// A param whose name does not stand anywhere.
    fn made_up(&self, name: &str, value: f64) -> Diagnostic {
        let message = format!("the name \"{name}\" is made up here: there is no number for {value} to replace");
        let hint = format!("write {} with its name and its default as they are", written(name));
        self.script.complain_of_param(name, Complaint::new(message).hint(hint))
    }

    fn shown(&self, message: String, call: &Call) -> Diagnostic {
        let (line, column) = self.lexed.place(call.at);
        Diagnostic::new(message).at(self.file, self.text, line, column)
    }
}

fn is_setting(name: &str) -> bool {
    SETTINGS.contains(&name)
}

/// The calls that give a setting or a param its value.
fn calls(lexed: &Lexed, name: &str) -> Vec<Call> {
    if is_setting(name) { lexed.calls(name) } else { lexed.param_calls(name) }
}

/// Such a call, in words.
fn written(name: &str) -> String {
    if is_setting(name) { format!("{name}(…)") } else { format!("param(\"{name}\", …)") }
}

/// The shortest text that reads back to a value; a whole one where a whole one stood, so that it can still count.
fn literal(value: f64, is_whole: bool) -> String {
    const MOST_EXACT: f64 = 9_007_199_254_740_992.0;
    match is_whole && libm::trunc(value) == value && value.abs() <= MOST_EXACT {
        true => format!("{}", value as i64),
        false => format!("{:?}", value + 0.0),
    }
}

/// New statements after the head of a script, on lines of their own wherever that tears nothing apart.
fn insertion(text: &str, lexed: &Lexed, statements: &[String]) -> Edit {
    let newline = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let (at, inserted) = match lexed.after_the_head(&HEAD) {
        Head::EndsAt(end) => {
            let rest = text[end..].split('\n').next().unwrap_or("").trim_end_matches('\r');
            let row = rest.trim();
            if row.is_empty() || row.starts_with("//") {
                (end + rest.len(), statements.iter().map(|line| format!("{newline}{line}")).collect())
            } else {
                (end, statements.iter().map(|line| format!(" {line}")).collect())
            }
        }
        Head::MissingBefore(start) => {
            // At the end of a text without code a comment may lack its end of line.
            let before = if start == text.len() && !text.is_empty() && !text.ends_with('\n') { newline } else { "" };
            let lines: String = statements.iter().map(|line| format!("{line}{newline}")).collect();
            (start, format!("{before}{lines}"))
        }
    };
    (at..at, inserted)
}
