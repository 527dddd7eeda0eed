//! Scripts that do not compile, in a designer's words.

use rhai::{LexError, ParseErrorType};

use crate::blame::Place;
use crate::error::Complaint;
use crate::sandbox::{self, MOST_FUNCTIONS};
use crate::source;
use crate::suggest::did_you_mean;
use crate::words;

/// What is wrong with a script's text at a place.
pub(crate) fn complaint(error: &ParseErrorType, place: &Place) -> Complaint {
    use ParseErrorType as E;
    match error {
        E::BadInput(error) => bad_input(error),
        E::UnexpectedEOF => Complaint::new("the script ends too early").hint("is a `}` or a `)` missing?"),
        E::VariableUndefined(name) => undefined_variable(name, place),
        E::ModuleUndefined(name) => Complaint::new(format!("no module is imported as `{name}`"))
            .hint(format!("write import \"…\" as {name}; above")),
        E::MissingToken(token, why) => Complaint::new(format!("`{token}` is missing {why}")).maybe_hint(
            (token == ";" && place.before().trim().is_empty())
                .then(|| "perhaps at the end of the line before".to_owned()),
        ),
        E::MismatchedType(wanted, found) => Complaint::new(format!("this must be {wanted}, not {found}")),
        E::ExprExpected(what) => Complaint::new(format!("{what} expression is missing here")),
        E::Reserved(name) => reserved(name),
        E::PropertyExpected => match place.word().filter(|word| sandbox::why_withheld(word).is_some()) {
            Some(word) => reserved(word),
            None => Complaint::new("the name of a property or a word is missing after the dot"),
        },
        E::AssignmentToInvalidLHS(_) => not_assignable(place),
        E::AssignmentToConstant(name) => Complaint::new(format!("`{name}` is a constant: it cannot be written"))
            .hint(format!("declare it with `let {name}`")),
        E::UnknownOperator(sign) => Complaint::new(format!("`{sign}` is no operator")),
        E::ExprTooDeep => Complaint::new("this nests too deeply").hint("give parts of it names with `let`"),
        E::TooManyFunctions => Complaint::new(format!("a script may have {MOST_FUNCTIONS} functions at most")),
        E::LiteralTooLarge(what, most) => Complaint::new(format!("{} is over the limit of {most}", lower(what))),
        E::LoopBreak => Complaint::new("`break` and `continue` belong in a loop"),
        E::WrongFnDefinition => {
            Complaint::new("a function is defined at the outside, not in a block or another function")
        }
        other => Complaint::new(lower(&other.to_string())),
    }
}

fn bad_input(error: &LexError) -> Complaint {
    match error {
        LexError::UnexpectedInput(sign) if sign.starts_with(|c: char| c.is_alphabetic() && !c.is_ascii()) => {
            Complaint::new(format!("`{sign}` cannot stand in a name"))
                .hint("names have the letters a to z, digits and _")
        }
        LexError::UnexpectedInput(sign) => Complaint::new(format!("`{sign}` is not expected here")),
        LexError::UnterminatedString => {
            Complaint::new("this string is not closed").hint("end it with the sign it began with")
        }
        LexError::MalformedNumber(_) => Complaint::new("this is no number"),
        LexError::MalformedEscapeSequence(escape) => {
            Complaint::new(format!("`{escape}` stands for no character")).hint("a backslash itself is written \\\\")
        }
        LexError::MalformedChar(_) => Complaint::new("this is no single character").hint("strings are written \"…\""),
        LexError::ImproperSymbol(sign, _) if sign == sandbox::OPEN_COMMENT => {
            Complaint::new("this comment is not closed").hint("end it with */")
        }
        LexError::ImproperSymbol(sign, _) if sandbox::why_withheld(sign).is_some() => reserved(sign),
        LexError::ImproperSymbol(sign, advice) if !advice.is_empty() => {
            Complaint::new(format!("`{sign}` means nothing here")).hint(lower(advice))
        }
        other => Complaint::new(lower(&other.to_string())),
    }
}

fn undefined_variable(name: &str, place: &Place) -> Complaint {
    let complaint = Complaint::new(format!("there is no variable `{name}` here"));
    let declared = source::variables(&place.text);
    if name == "world" {
        return complaint.hint("the world is there in callbacks and expectations: fn on_step(world) { … }");
    }
    if declared.contains(&name) && !place.is_in_function() {
        return complaint
            .hint(format!("`{name}` is there from its `let` to the end of the {{ }} around it, and nowhere else"));
    }
    if declared.contains(&name) {
        return complaint.hint(format!(
            "a function does not see the variables outside it: hand `{name}` over as an argument; \
             a constant is there as global::{name}, a body as world[\"…\"]"
        ));
    }
    let words = words::all();
    if let Some(word) = words.iter().find(|word| word.name == name && word.signatures[0].contains('(')) {
        return complaint.hint(format!("write {}", word.signatures[0]));
    }
    let constants = words::CONSTANTS.iter().map(|constant| constant.name);
    let near = did_you_mean(name, declared.iter().copied().chain(constants), str::to_owned);
    let called = || did_you_mean(name, words.iter().map(|word| word.name.as_str()), |near| format!("{near}(…)"));
    complaint.maybe_hint(near.or_else(called))
}

fn reserved(name: &str) -> Complaint {
    if let Some(why) = sandbox::why_withheld(name) {
        return Complaint::new(format!("`{name}` is not available in a scenario")).hint(why);
    }
    if name.starts_with(char::is_alphabetic) {
        return Complaint::new(format!("`{name}` belongs to the language: it cannot be a name"));
    }
    Complaint::new(format!("`{name}` means nothing here"))
}

/// `world.body("a").vx = 1`, which Rhai refuses for any function call on the left.
fn not_assignable(place: &Place) -> Complaint {
    let complaint = Complaint::new("this cannot be assigned to");
    let rewritten = place.row().split_once(".body(").and_then(|(before, after)| {
        let (name, rest) = after.split_once(')')?;
        let receiver = before.rsplit(|c: char| !c.is_alphanumeric() && c != '_').next()?;
        let rest = rest.split(['}', ';']).next()?.trim_end();
        rest.contains('=').then(|| format!("write `{receiver}[{name}]{rest}`"))
    });
    complaint.hint("put it into a variable first: let body = …; body.vx = 1").maybe_hint(rewritten)
}

/// Rhai's own sentences begin with a capital; ours stand after "error:".
pub(crate) fn lower(sentence: &str) -> String {
    let mut rest = sentence.chars();
    rest.next().map_or(String::new(), |first| first.to_lowercase().chain(rest).collect())
}
