//! Values put into a script's text: the numbers in `mu_l(…)` and `param("push", …)` change, and nothing else does.
//!
//! The places come from Rhai's own parser, so a comment or a string that looks like a call is none. What was written is
//! read back before it is handed out: a value that something else in the script overrules is refused, not lost.

use std::path::Path;

use rhai::{AST, ASTNode, Engine, Expr, FnCallExpr, OptimizationLevel, Position, Stmt, Token};

use crate::error::Diagnostic;
use crate::options::{Options, Output};
use crate::params::{SETTINGS, setting};
use crate::sandbox;
use crate::script::Script;

/// Words whose calls stand at the top of a script; a setting it lacks is put after the last of them.
const HEAD: [&str; 10] =
    ["title", "time_step", "steps", "mu_l", "mu_a", "epsilon", "restitution", "friction", "exchange", "motion"];

/// A script's text with other values in it: of a `param`, or of `mu_l`, `mu_a`, `epsilon`, `restitution`, `friction`.
///
/// Only number literals are replaced: comments, layout, line endings and a byte order mark stay. A setting that the
/// script does not make gets a line of its own, after the settings it does make. A whole number stays one where it can.
///
/// # Errors
/// A value whose number cannot be told for certain: an expression in its place, several calls, none, a call in an import,
/// or a script that then has another value all the same. The text is not changed in part: all values have a place, or none.
pub fn write_back(file: &Path, text: &str, values: &[(String, f64)], options: &Options) -> Result<String, Diagnostic> {
    let (mark, body) = match text.strip_prefix('\u{feff}') {
        Some(body) => ("\u{feff}", body),
        None => ("", text),
    };
    Script::prepare(file, body, &quiet(options, values))?; // a script that is wrong already says so in its own words
    let written = Text::parse(file, body)?.with(values)?;
    check(file, body, &written, values, options)?;
    Ok(format!("{mark}{written}"))
}

/// A script as text and as what Rhai makes of it.
struct Text<'a> {
    file: &'a Path,
    text: &'a str,
    engine: Engine,
    ast: AST,
}

/// Bytes to be replaced, and by what.
struct Edit {
    start: usize,
    end: usize,
    by: String,
}

/// A call of a word.
struct Call {
    /// What it is handed; `None` when that is no literal.
    number: Option<(f64, Position)>,
    position: Position,
}

impl<'a> Text<'a> {
    fn parse(file: &'a Path, text: &'a str) -> Result<Self, Diagnostic> {
        let mut engine = sandbox::bare_engine();
        // An expression must stay one, even where it could be computed beforehand.
        engine.set_optimization_level(OptimizationLevel::None);
        let ast = sandbox::compile(&engine, text).map_err(|error| Diagnostic::new(error.to_string()).in_file(file))?;
        Ok(Text { file, text, engine, ast })
    }

    /// The text with all values in it.
    fn with(&self, values: &[(String, f64)]) -> Result<String, Diagnostic> {
        let mut edits = Vec::new();
        let mut lines = Vec::new();
        for (name, value) in values {
            let calls = self.calls(name);
            if calls.is_empty() && SETTINGS.contains(&name.as_str()) {
                lines.push(format!("{name}({});", literal(*value, false)));
            } else {
                self.replace(name, *value, &calls, &mut edits)?;
            }
        }
        if !lines.is_empty() {
            edits.push(self.insert(&lines));
        }
        edits.sort_by_key(|edit| edit.start);
        let mut text = self.text.to_owned();
        for edit in edits.iter().rev() {
            text.replace_range(edit.start..edit.end, &edit.by);
        }
        Ok(text)
    }

    /// The calls that give a setting or a param its value.
    fn calls(&self, name: &str) -> Vec<Call> {
        let mut calls = Vec::new();
        self.ast.walk(&mut |path: &[ASTNode]| {
            let call = match path.last() {
                Some(ASTNode::Expr(Expr::FnCall(call, at) | Expr::MethodCall(call, at))) => Some((call, at)),
                Some(ASTNode::Stmt(Stmt::FnCall(call, at))) => Some((call, at)),
                _ => None,
            };
            if let Some((call, position)) = call.filter(|(call, _)| call.namespace.is_empty()) {
                let argument = argument_of(call, name);
                calls.extend(argument.map(|argument| Call { number: number(argument), position: *position }));
            }
            true
        });
        calls
    }

    /// A setting is made once; a param may be read again, with the same default everywhere.
    fn replace(&self, name: &str, value: f64, calls: &[Call], edits: &mut Vec<Edit>) -> Result<(), Diagnostic> {
        let is_setting = SETTINGS.contains(&name);
        let written = if is_setting { format!("{name}(…)") } else { format!("param(\"{name}\", …)") };
        let Some(first) = calls.first() else {
            return Err(Diagnostic::new(format!("{written} does not stand in the script, so its value has no place"))
                .in_file(self.file)
                .with_hint(Some("write its name and its default in the script itself, as literals".to_owned())));
        };
        if is_setting && calls.len() > 1 {
            let lines: Vec<String> = calls.iter().filter_map(|call| Some(call.position.line()?.to_string())).collect();
            let message =
                format!("{written} stands in the script {} times, so the value has no one place", calls.len());
            return Err(self.complain(
                first.position,
                message,
                &format!("lines {}: keep one of them", lines.join(", ")),
            ));
        }
        for call in calls {
            let place = call.number.and_then(|(known, position)| Some((known, self.literal_at(position, known)?)));
            let Some((known, (start, end))) = place else {
                let message = format!("{written} is handed an expression here, and only a number can be replaced");
                return Err(self.complain(call.position, message, "write the number itself in its place"));
            };
            if known != value {
                let is_whole = !self.text[start..end].contains(['.', 'e', 'E']);
                edits.push(Edit { start, end, by: literal(value, is_whole) });
            }
        }
        Ok(())
    }

    /// New lines after the settings at the top of the script, or before its first statement.
    fn insert(&self, lines: &[String]) -> Edit {
        let ending = if self.text.contains("\r\n") { "\r\n" } else { "\n" };
        let statements = self.ast.statements();
        let head =
            statements.iter().take_while(|statement| matches!(statement, Stmt::Import(..)) || is_head(statement));
        let end = head.filter(|statement| is_head(statement)).last().and_then(|last| self.end_of(last.position()));
        if let Some(end) = end {
            let rest = self.text[end..].split('\n').next().unwrap_or("").trim_end_matches('\r');
            // A comment that begins here and ends elsewhere is not to be broken into.
            let is_last = rest.trim().is_empty() || rest.trim_start().starts_with("//");
            return match is_last {
                true => Edit::at(end + rest.len(), format!("{ending}{}", lines.join(ending))),
                false => Edit::at(end, format!(" {}", lines.join(" "))),
            };
        }
        match statements.first().and_then(|first| self.offset(first.position())) {
            Some(start) => Edit::at(start, format!("{}{ending}", lines.join(ending))),
            None => Edit::at(self.text.len(), format!("{ending}{}{ending}", lines.join(ending))),
        }
    }

    /// Where the statement that begins there ends, its semicolon included.
    fn end_of(&self, position: Position) -> Option<usize> {
        let texts = [self.text];
        let (tokens, _control) = self.engine.lex(&texts);
        let mut depth = 0_i32;
        // After the end of the text the lexer says so for ever.
        let mut tokens = tokens.take_while(|(token, _)| *token != Token::EOF).skip_while(|(_, at)| *at < position);
        let (_, at) = tokens.find(|(token, _)| {
            depth += match token {
                Token::LeftParen | Token::LeftBrace => 1,
                Token::RightParen | Token::RightBrace => -1,
                _ => 0,
            };
            depth == 0 && *token == Token::SemiColon
        })?;
        Some(self.offset(at)? + 1)
    }

    /// The byte a position stands for.
    fn offset(&self, position: Position) -> Option<usize> {
        let (line, column) = (position.line()?, position.position()?);
        let mut rows = self.text.split_inclusive('\n');
        let before: usize = rows.by_ref().take(line - 1).map(str::len).sum();
        let row = rows.next()?;
        row.char_indices().nth(column.checked_sub(1)?).map(|(at, _)| before + at)
    }

    /// The bytes of the literal at a position, when it is that number.
    fn literal_at(&self, position: Position, known: f64) -> Option<(usize, usize)> {
        let start = self.offset(position)?;
        let rest = &self.text[start..];
        let unsigned = rest.strip_prefix('-').unwrap_or(rest).trim_start();
        let length = literal_length(unsigned);
        let sign = if rest.starts_with('-') { -1.0 } else { 1.0 };
        let read = read_literal(&unsigned[..length])?;
        (sign * read == known).then_some((start, start + rest.len() - unsigned.len() + length))
    }

    fn complain(&self, position: Position, message: String, hint: &str) -> Diagnostic {
        let (line, column) = (position.line().unwrap_or(1), position.position().unwrap_or(1));
        Diagnostic::new(message).at(self.file, self.text, line, column).with_hint(Some(hint.to_owned()))
    }
}

impl Edit {
    fn at(place: usize, by: String) -> Self {
        Edit { start: place, end: place, by }
    }
}

/// What a call hands over as the value of a name, when it is the call that does.
fn argument_of<'a>(call: &'a FnCallExpr, name: &str) -> Option<&'a Expr> {
    let is_param = |call: &FnCallExpr| {
        call.name == "param" && matches!(call.args.first(), Some(Expr::StringConstant(text, _)) if text == name)
    };
    match call.name == name && SETTINGS.contains(&name) {
        true => call.args.first().filter(|_| call.args.len() == 1),
        false => call.args.get(1).filter(|_| is_param(call)),
    }
}

fn number(expression: &Expr) -> Option<(f64, Position)> {
    match expression {
        Expr::IntegerConstant(whole, at) => Some((*whole as f64, *at)),
        Expr::FloatConstant(number, at) => Some((**number, *at)),
        _ => None,
    }
}

fn is_head(statement: &Stmt) -> bool {
    let call = match statement {
        Stmt::FnCall(call, _) => call,
        Stmt::Expr(expression) => match &**expression {
            Expr::FnCall(call, _) => call,
            _ => return false,
        },
        _ => return false,
    };
    call.namespace.is_empty() && HEAD.contains(&call.name.as_str())
}

/// How many bytes of a text belong to the number that it begins with.
fn literal_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is_decimal = !matches!(bytes, [b'0', b'x' | b'X' | b'o' | b'O' | b'b' | b'B', ..]);
    let is_digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut at = 0;
    while let Some(byte) = bytes.get(at) {
        let next = bytes.get(at + 1).copied().unwrap_or(b' ');
        at += match byte {
            // `5.` is a number, `5.abs()` and `0..5` are none.
            b'.' if is_decimal
                && (next.is_ascii_digit() || !(next.is_ascii_alphanumeric() || b"._".contains(&next))) =>
            {
                1
            }
            b'e' | b'E' if is_decimal && b"+-".contains(&next) && is_digit(at + 2) => 2,
            byte if byte.is_ascii_alphanumeric() || *byte == b'_' => 1,
            _ => break,
        };
    }
    at
}

fn read_literal(text: &str) -> Option<f64> {
    let plain = text.replace('_', "");
    let radix = |prefix: &str| plain.to_ascii_lowercase().strip_prefix(prefix).map(str::to_owned);
    for (prefix, base) in [("0x", 16), ("0o", 8), ("0b", 2)] {
        if let Some(digits) = radix(prefix) {
            return i64::from_str_radix(&digits, base).ok().map(|whole| whole as f64);
        }
    }
    plain.parse().ok()
}

/// The shortest literal that reads back to a value; a whole one where a whole one stood, so that it can still count.
fn literal(value: f64, is_whole: bool) -> String {
    const MOST_EXACT: f64 = 9_007_199_254_740_992.0;
    match is_whole && libm::trunc(value) == value && value.abs() <= MOST_EXACT {
        true => format!("{}", value as i64),
        false => format!("{:?}", value + 0.0),
    }
}

/// Reads the new text as a run would, and looks whether every value is there.
fn check(
    file: &Path,
    text: &str,
    written: &str,
    values: &[(String, f64)],
    options: &Options,
) -> Result<(), Diagnostic> {
    let (_, scene) = Script::prepare(file, written, &quiet(options, values))?;
    for (name, value) in values {
        let param = scene.params.iter().find(|param| param.name == *name).map(|param| param.value);
        let found = setting(&scene.settings, name).or(param);
        if found != Some(*value) {
            let found = found.map_or("nothing".to_owned(), |found| found.to_string());
            let message =
                format!("{name} would be {found} and not {value}: something else in the script, or an import, sets it");
            let hint = "set it once, in the script itself, with a number".to_owned();
            return Err(Diagnostic::new(message).at(file, text, 1, 1).with_hint(Some(hint)));
        }
    }
    Ok(())
}

/// The same options without a word printed, and without what is set from outside of the names that are written.
fn quiet(options: &Options, values: &[(String, f64)]) -> Options {
    let mut options = Options { output: Output::to(|_| {}), ..options.clone() };
    options.set.retain(|(name, _)| values.iter().all(|(written, _)| written != name));
    options
}
