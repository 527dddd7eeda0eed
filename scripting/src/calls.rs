//! Calls that found no function: misspelt, or given what the word does not take. Functions that would be called in a word's place.

use crate::blame::Place;
use crate::error::Complaint;
use crate::number::kind_named;
use crate::sandbox;
use crate::source::{self, Token};
use crate::suggest::did_you_mean;
use crate::words::{self, Word};

/// A call as Rhai reports it: `rect (Body, i64)`.
struct Call<'a> {
    /// With the module's name before it: `cars::row`.
    path: &'a str,
    name: &'a str,
    /// What was given, in words; the body first in `body.rect(…)`.
    given: Vec<&'static str>,
    is_method: bool,
}

impl<'a> Call<'a> {
    fn parse(call: &'a str, place: &Place) -> Self {
        let (path, arguments) = call.split_once(" (").unwrap_or((call, ""));
        let arguments = arguments.strip_suffix(')').unwrap_or(arguments).split(", ");
        Call {
            path,
            name: path.rsplit("::").next().unwrap_or(path),
            given: arguments.filter(|argument| !argument.is_empty()).map(kind_named).collect(),
            is_method: place.before().trim_end().ends_with('.'),
        }
    }

    /// "2 arguments", the receiver left out.
    fn count(&self, receivers: usize) -> String {
        match self.given.len().saturating_sub(receivers) {
            1 => "1 argument".to_owned(),
            count => format!("{count} arguments"),
        }
    }
}

/// What is wrong with a call that found no function.
pub(crate) fn unknown(call: &str, place: &Place) -> Complaint {
    let call = Call::parse(call, place);
    let name = call.name;
    if name.starts_with("anon$") {
        return Complaint::new("the closure takes another number of arguments than it is given");
    }
    if !name.starts_with(|c: char| c.is_alphabetic() || c == '_') {
        return Complaint::new(format!("`{name}` does not work on {}", call.given.join(" and ")));
    }
    if let Some(why) = sandbox::why_withheld(name) {
        return Complaint::new(format!("`{name}` is not available in a scenario")).hint(why);
    }
    // A function of a module may stand in any file read so far.
    let text = if call.path == name { place.text.clone() } else { place.library.all_texts() };
    let functions = source::functions(&text);
    if let Some(function) = functions.iter().find(|function| function.name.text == name) {
        let takes = function.parameters.join(", ");
        let given = call.count(usize::from(call.is_method));
        return Complaint::new(format!("`{}` takes ({takes}), not {given}", call.path));
    }
    let words = words::all();
    let signatures: Vec<&str> = words.iter().filter(|word| word.name == name).flat_map(calls_of).collect();
    if !signatures.is_empty() {
        return misused(&call, &signatures);
    }
    let of_packages = place.engine.collect_fn_metadata(None, |info| Some(info.metadata.name.to_string()), true);
    if of_packages.iter().any(|known| known == name) {
        return Complaint::new(format!("`{name}` does not work on {}", call.given.join(", ")));
    }
    let near = |names: &[&str]| did_you_mean(name, names.iter().copied(), str::to_owned);
    let own: Vec<&str> = functions.iter().map(|function| function.name.text).collect();
    let known: Vec<&str> = words.iter().map(|word| word.name.as_str()).filter(|name| *name != "[]").collect();
    let packages: Vec<&str> = of_packages.iter().map(String::as_str).collect();
    let hint = near(&own).or_else(|| near(&known)).or_else(|| near(&packages));
    Complaint::new(format!("there is no word or function `{}`", call.path)).maybe_hint(hint)
}

/// The ways of calling a word, properties left out.
fn calls_of(word: &Word) -> impl Iterator<Item = &str> {
    let signatures = word.signatures.iter().map(String::as_str);
    signatures.filter(|signature| signature.ends_with(')') && !signature.starts_with("fn "))
}

/// A word that exists, called as none of its signatures says.
fn misused(call: &Call, signatures: &[&str]) -> Complaint {
    let receiver = call.given.first().copied();
    let owner = |signature: &str| match signature.split_once('.') {
        Some(("body", _)) => Some("a body"),
        Some(("world", _)) => Some("the world"),
        _ => None,
    };
    let fitting: Vec<&str> = signatures
        .iter()
        .copied()
        .filter(|signature| owner(signature).is_none_or(|owner| receiver == Some(owner)))
        .collect();
    let Some(first) = fitting.first() else {
        let owner = owner(signatures[0]).unwrap_or("another value");
        let not = if call.is_method {
            format!("not of {}", receiver.unwrap_or("nothing"))
        } else {
            "and needs one".to_owned()
        };
        return Complaint::new(format!("`{}` is a word of {owner}, {not}", call.name))
            .hint(format!("write {}", signatures.join(" or ")));
    };
    let given = call.count(usize::from(owner(first).is_some()));
    let takes: Vec<&str> =
        fitting.iter().filter_map(|signature| signature.find('(').map(|at| &signature[at..])).collect();
    Complaint::new(format!("{} takes {}, not {given}", call.name, takes.join(" or ")))
}

/// The name of a function that would be called in a word's place without anyone noticing: with `fn at(a, b)` in a script,
/// its `.at(1, 2)` would place no body.
pub(crate) fn hidden_word(text: &str) -> Option<(Token<'_>, Complaint)> {
    let tokens = source::tokens(text);
    let is_called = |name: &str| {
        let texts = tokens.windows(3).map(|three| [three[0].text, three[1].text, three[2].text]);
        texts.into_iter().any(|call| call == [".", name, "("])
    };
    let mut own = source::functions(text);
    own.retain(|function| is_called(function.name.text));
    if own.is_empty() {
        return None;
    }
    let words = words::all();
    own.into_iter().find_map(|function| {
        let arguments = function.parameters.join(", ");
        let hides = |word: &&Word| {
            let mut calls = calls_of(word).filter(|call| call.contains('.'));
            word.name == function.name.text && calls.any(|call| arguments_of(call) == function.parameters.len())
        };
        let word = words.iter().find(hides)?;
        let name = &word.name;
        let complaint = Complaint::new(format!("fn {name}({arguments}) would be called where `.{name}` is written"))
            .hint(format!("`{name}` is a word: give the function another name"));
        Some((function.name, complaint))
    })
}

/// How many arguments a call takes that is written as the manual does.
fn arguments_of(signature: &str) -> usize {
    let inside = signature.split_once('(').map_or("", |(_, rest)| rest.trim_end_matches(')'));
    if inside.is_empty() { 0 } else { inside.split(", ").count() }
}
