//! Errors of a running script, in a designer's words.

use rhai::EvalAltResult;

use crate::blame::Place;
use crate::calls;
use crate::clock::Stopped;
use crate::error::Complaint;
use crate::guard::{self, MOST_NESTING};
use crate::number::{kind_named, kind_of};
use crate::sandbox::{self, MOST_CALLS, MOST_ENTRIES, MOST_MODULES, MOST_OPERATIONS, MOST_TEXT, MOST_VARIABLES};
use crate::suggest::did_you_mean;
use crate::syntax::lower;
use crate::words::{self, Word};

/// What went wrong at a place.
pub(crate) fn complaint(error: &EvalAltResult, place: &Place) -> Complaint {
    use EvalAltResult as E;
    match error {
        E::ErrorRuntime(thrown, _) => match thrown.read_lock::<Complaint>() {
            Some(complaint) => complaint.clone(),
            None if thrown.is_string() || thrown.is_int() || thrown.is_float() => {
                Complaint::new(format!("the script threw: {thrown}"))
            }
            None => Complaint::new(format!("the script threw {}", kind_of(thrown))),
        },
        E::ErrorFunctionNotFound(call, _) => calls::unknown(call, place),
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
            Complaint::new(format!("there is no character {index}: the string has {length}, counted from 0"))
        }
        E::ErrorIndexNotFound(index, _) => Complaint::new(format!("there is no entry {index}")),
        E::ErrorFor(_) => Complaint::new("`for` goes through a range, an array or a string, and this is none"),
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
        E::ErrorTerminated(..) => match sandbox::why_stopped(error)? {
            Stopped::OutOfTime(given) => {
                let seconds = given.as_secs_f64();
                Complaint::new(format!("the script ran for more than {seconds} s and came to no end"))
                    .hint("is there an endless loop? --script-timeout gives it more time")
            }
            Stopped::Asked => Complaint::new("the script was stopped before its end"),
        },
        E::ErrorStackOverflow(_) => Complaint::new(format!("functions call each other more than {MOST_CALLS} deep"))
            .hint("does a function call itself without end?"),
        E::ErrorTooManyVariables(_) => {
            Complaint::new(format!("a script may have {MOST_VARIABLES} variables in sight at most"))
        }
        E::ErrorTooManyModules(_) => Complaint::new(format!("a script may import {MOST_MODULES} modules at most")),
        E::ErrorDataTooLarge(what, _) if what.contains("string") => {
            Complaint::new(format!("a string may have {MOST_TEXT} bytes at most"))
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
