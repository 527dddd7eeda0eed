//! Errors of a running script, in a designer's words.

use rhai::{Engine, EvalAltResult, Position};

use crate::error::Complaint;
use crate::guard::{self, MOST_NESTING};
use crate::number::{kind_named, kind_of};
use crate::sandbox::{self, MOST_CALLS, MOST_ENTRIES, MOST_MODULES, MOST_OPERATIONS, MOST_TEXT, MOST_VARIABLES};
use crate::source;
use crate::suggest::did_you_mean;
use crate::syntax::lower;
use crate::words::{self, Word};

/// What went wrong at a position of a script with that text.
pub(crate) fn complaint(error: &EvalAltResult, engine: &Engine, text: &str, position: Position) -> Complaint {
    use EvalAltResult as E;
    match error {
        E::ErrorRuntime(thrown, _) => match thrown.read_lock::<Complaint>() {
            Some(complaint) => complaint.clone(),
            None if thrown.is_string() || thrown.is_int() || thrown.is_float() => {
                Complaint::new(format!("the script threw: {thrown}"))
            }
            None => Complaint::new(format!("the script threw {}", kind_of(thrown))),
        },
        E::ErrorFunctionNotFound(call, _) => unknown_call(&Call::parse(call), engine, text, position),
        E::ErrorDotExpr(what, _) => unknown_property(what),
        E::ErrorIndexingType(what, _) => not_indexable(what),
        E::ErrorMismatchDataType(wanted, found, _) | E::ErrorMismatchOutputType(wanted, found, _) => {
            Complaint::new(format!("this must be {}, not {}", kind_named(wanted), kind_named(found)))
        }
        E::ErrorVariableNotFound(name, _) => Complaint::new(format!("there is no variable `{name}` here")),
        E::ErrorModuleNotFound(name, _) => Complaint::new(format!("no module is imported as `{name}`")),
        E::ErrorArrayBounds(length, index, _) => {
            let entries = if *length == 1 { "1 entry".to_owned() } else { format!("{length} entries") };
            Complaint::new(format!("there is no entry {index}: the array has {entries}, counted from 0"))
        }
        E::ErrorStringBounds(length, index, _) => {
            Complaint::new(format!("there is no character {index}: the text has {length}, counted from 0"))
        }
        E::ErrorIndexNotFound(index, _) => Complaint::new(format!("there is no entry {index}")),
        E::ErrorFor(_) => Complaint::new("`for` goes through a range, an array or a text, and this is none"),
        E::ErrorAssignmentToConstant(name, _) => {
            Complaint::new(format!("`{name}` is a constant: it cannot be written"))
        }
        E::ErrorNonPureMethodCallOnConstant(..) => Complaint::new("this would change a constant"),
        E::ErrorUnboundThis(_) => Complaint::new("there is no `this` here"),
        E::ErrorDataRace(..) => Complaint::new("this variable is in use by the very call that changes it"),
        E::ErrorArithmetic(what, _) => Complaint::new(lower(what)),
        E::LoopBreak(..) => Complaint::new("`break` and `continue` belong in a loop"),
        E::ErrorSystem(what, error) => Complaint::new(format!("{what}: {error}")),
        error => limit(error).unwrap_or_else(|| Complaint::new("the script cannot go on here")),
    }
}

/// A limit of the sandbox that was reached.
fn limit(error: &EvalAltResult) -> Option<Complaint> {
    use EvalAltResult as E;
    Some(match error {
        E::ErrorTooManyOperations(_) => {
            Complaint::new(format!("the script made {MOST_OPERATIONS} operations and came to no end"))
                .hint("is there an endless loop?")
        }
        E::ErrorTerminated(..) => {
            let seconds = sandbox::time_given(error)?.as_secs_f64();
            Complaint::new(format!("the script ran for more than {seconds} s and came to no end"))
                .hint("is there an endless loop? --script-timeout gives it more time")
        }
        E::ErrorStackOverflow(_) => Complaint::new(format!("functions call each other more than {MOST_CALLS} deep"))
            .hint("does a function call itself without end?"),
        E::ErrorTooManyVariables(_) => {
            Complaint::new(format!("a script may have {MOST_VARIABLES} variables in sight at most"))
        }
        E::ErrorTooManyModules(_) => Complaint::new(format!("a script may import {MOST_MODULES} modules at most")),
        E::ErrorDataTooLarge(what, _) if what.contains("string") => {
            Complaint::new(format!("a text may have {MOST_TEXT} bytes at most"))
        }
        E::ErrorDataTooLarge(what, _) if what == guard::NESTING => {
            Complaint::new(format!("arrays and maps may lie {MOST_NESTING} deep within each other at most"))
        }
        E::ErrorDataTooLarge(..) => {
            Complaint::new(format!("an array or a map may have {MOST_ENTRIES} entries at most, all within it counted"))
        }
        _ => return None,
    })
}

/// A call that found no function: `rect (Body, i64)`.
struct Call<'a> {
    name: &'a str,
    arguments: Vec<&'a str>,
}

impl<'a> Call<'a> {
    fn parse(call: &'a str) -> Self {
        let (name, arguments) = call.split_once(" (").unwrap_or((call, ""));
        let arguments = arguments.strip_suffix(')').unwrap_or(arguments);
        Call { name, arguments: arguments.split(", ").filter(|argument| !argument.is_empty()).collect() }
    }

    fn kinds(&self) -> Vec<&'static str> {
        self.arguments.iter().map(|argument| kind_named(argument)).collect()
    }
}

fn unknown_call(call: &Call, engine: &Engine, text: &str, position: Position) -> Complaint {
    let name = call.name.rsplit("::").next().unwrap_or(call.name);
    if name.starts_with("anon$") {
        return Complaint::new(format!("the closure does not take {}", count(call.arguments.len(), "argument")));
    }
    if !name.starts_with(|c: char| c.is_alphabetic() || c == '_') {
        return Complaint::new(format!("`{name}` does not work on {}", call.kinds().join(" and ")));
    }
    if let Some(why) = sandbox::why_withheld(name) {
        return Complaint::new(format!("`{name}` is not available in a scenario")).hint(why);
    }
    let is_method = is_method_call(text, position);
    let functions = source::functions(text);
    if let Some(function) = functions.iter().find(|function| function.name.text == name) {
        let given = call.arguments.len() - usize::from(is_method && !call.arguments.is_empty());
        let takes = function.parameters.join(", ");
        return Complaint::new(format!("`{name}` takes ({takes}), not {}", count(given, "argument")));
    }
    let words = words::all();
    let word: Vec<&str> = words.iter().filter(|word| word.name == name).flat_map(calls_of).collect();
    if !word.is_empty() {
        return misused_word(call, &word, is_method);
    }
    let of_packages = engine.collect_fn_metadata(None, |info| Some(info.metadata.name.to_string()), true);
    if of_packages.iter().any(|known| known == name) {
        return Complaint::new(format!("`{name}` does not work on {}", call.kinds().join(", ")));
    }
    let of_script = functions.iter().map(|function| function.name.text);
    let names = of_script.chain(words.iter().map(|word| word.name.as_str()).filter(|name| *name != "[]"));
    let packages = of_packages.iter().map(String::as_str);
    let hint = did_you_mean(name, names, str::to_owned).or_else(|| did_you_mean(name, packages, str::to_owned));
    Complaint::new(format!("there is no word or function `{}`", call.name)).maybe_hint(hint)
}

/// The ways of calling a word, properties left out.
fn calls_of(word: &Word) -> impl Iterator<Item = &str> {
    word.signatures
        .iter()
        .map(String::as_str)
        .filter(|signature| signature.ends_with(')') && !signature.starts_with("fn "))
}

fn misused_word(call: &Call, signatures: &[&str], is_method: bool) -> Complaint {
    let receiver = call.arguments.first().map(|kind| kind_named(kind));
    let fits = |signature: &&&str| match signature.split(['.', '(']).next() {
        Some("body") => receiver == Some("a body"),
        Some("world") => receiver == Some("the world"),
        _ => !is_method,
    };
    let fitting: Vec<&str> = signatures.iter().filter(fits).copied().collect();
    if fitting.is_empty() {
        let given = if is_method { receiver.unwrap_or("nothing") } else { "nothing" };
        let of = if is_method { format!("of {given}") } else { "by itself".to_owned() };
        return Complaint::new(format!("`{}` is no word {of}", call.name))
            .hint(format!("write {}", signatures.join(" or ")));
    }
    let own = usize::from(fitting[0].contains('.'));
    let given = count(call.arguments.len().saturating_sub(own), "argument");
    let takes: Vec<&str> =
        fitting.iter().filter_map(|signature| signature.find('(').map(|at| &signature[at..])).collect();
    Complaint::new(format!("{} takes {}, not {given}", call.name, takes.join(" or ")))
}

fn is_method_call(text: &str, position: Position) -> bool {
    let line = position.line().and_then(|line| text.lines().nth(line - 1)).unwrap_or("");
    let before: String = line.chars().take(position.position().unwrap_or(1).saturating_sub(1)).collect();
    before.trim_end().ends_with('.')
}

/// `Unknown property 'y' - a getter is not registered for type 'Body'`, or the same of a setter.
fn unknown_property(what: &str) -> Complaint {
    let quoted: Vec<&str> = what.split('\'').skip(1).step_by(2).collect();
    let [property, owner, ..] = quoted[..] else { return Complaint::new(lower(what)) };
    let owner_kind = kind_named(owner);
    let prefix = format!("{}.", owner.to_lowercase());
    let words = words::all();
    let of_owner = || words.iter().filter(|word| word.signatures[0].starts_with(&prefix));
    let is_call = |word: &Word| word.signatures[0].ends_with(')');
    let mut namesakes = of_owner().filter(|word| word.name == property);
    if namesakes.clone().any(|word| !is_call(word)) {
        return Complaint::new(format!("`{property}` of {owner_kind} can be read only"));
    }
    if let Some(word) = namesakes.next() {
        return Complaint::new(format!("`{property}` is no property of {owner_kind}"))
            .hint(format!("write {}", word.signatures[0]));
    }
    let near = did_you_mean(property, of_owner().map(|word| word.name.as_str()), |near| format!(".{near}"));
    Complaint::new(format!("{owner_kind} has no property `{property}`")).maybe_hint(near)
}

/// `Body [string]`, or `Body [string] = i64`.
fn not_indexable(what: &str) -> Complaint {
    let owner = what.split(" [").next().unwrap_or(what);
    let complaint = Complaint::new(format!("{} has no entries to reach with [ ]", kind_named(owner)));
    complaint.maybe_hint((owner == "Body").then(|| "its properties are reached with a dot: body.x".to_owned()))
}

fn count(number: usize, thing: &str) -> String {
    if number == 1 { format!("1 {thing}") } else { format!("{number} {thing}s") }
}
