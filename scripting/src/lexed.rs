//! A script's text cut into tokens by Rhai itself, each with its place in bytes: for changing a number and nothing else.

use std::ops::Range;

use rhai::{Engine, Position, Token};

/// Rhai counts lines and columns to 65,535; what lies beyond would be looked for in the wrong place.
const MOST_LINES_AND_COLUMNS: usize = 65_000;

/// A script in tokens; comments are not among them.
pub(crate) struct Lexed<'a> {
    text: &'a str,
    tokens: Vec<(Token, usize)>,
}

/// Where a function is called, and the number it is given, when it is given a plain one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Call {
    /// Byte at which the function's name begins.
    pub(crate) at: usize,
    pub(crate) number: Option<Number>,
}

/// A number as it is written, its sign included.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Number {
    pub(crate) range: Range<usize>,
    pub(crate) value: f64,
    pub(crate) is_whole: bool,
}

impl<'a> Lexed<'a> {
    /// The tokens of a text; none of one that is no script, or too long for its places to be counted.
    pub(crate) fn of(engine: &Engine, text: &'a str) -> Option<Self> {
        let lines: Vec<&str> = text.split('\n').collect();
        let is_long = |line: &&str| line.len() > MOST_LINES_AND_COLUMNS;
        if lines.len() > MOST_LINES_AND_COLUMNS || lines.iter().any(is_long) {
            return None;
        }
        let starts: Vec<usize> = lines.iter().map(|line| line.as_ptr() as usize - text.as_ptr() as usize).collect();
        let offset = |position: Position| {
            let line = position.line()? - 1;
            let column = position.position().unwrap_or(1).saturating_sub(1);
            let within = lines[line].char_indices().nth(column).map_or(lines[line].len(), |(at, _)| at);
            Some(starts[line] + within)
        };
        let (stream, control) = engine.lex([&text]);
        // The braces around code within a text, `${…}`: how deep the code outside it is.
        let (mut depth, mut texts, mut tokens) = (0_usize, Vec::new(), Vec::new());
        for (token, position) in stream {
            match &token {
                Token::EOF => break,
                Token::LexError(_) => return None,
                Token::InterpolatedString(_) => texts.push(depth),
                Token::LeftBrace | Token::MapStart => depth += 1,
                Token::RightBrace => {
                    depth = depth.checked_sub(1)?;
                    if texts.last() == Some(&depth) {
                        texts.pop();
                        control.borrow_mut().is_within_text = true;
                    }
                }
                _ => {}
            }
            // The empty text after code within a text has no place of its own.
            let at = offset(position).or(tokens.last().map(|(_, at)| *at)).unwrap_or(0);
            tokens.push((token, at));
        }
        Some(Lexed { text, tokens })
    }

    /// The calls `word(NUMBER)` in the order of the text.
    pub(crate) fn calls(&self, word: &str) -> Vec<Call> {
        self.openings(word).map(|open| self.call(open, open + 2)).collect()
    }

    /// The calls `param("name", NUMBER …)` of that name.
    pub(crate) fn param_calls(&self, name: &str) -> Vec<Call> {
        let names =
            |open: &usize| matches!(self.token(open + 2), Some(Token::StringConstant(text)) if text.as_str() == name);
        let given = |open: &usize| self.token(open + 3) == Some(&Token::Comma);
        self.openings("param").filter(names).filter(given).map(|open| self.call(open, open + 4)).collect()
    }

    /// Line and column of a byte, both from 1.
    pub(crate) fn place(&self, at: usize) -> (usize, usize) {
        let before = &self.text[..at];
        let column = before.rsplit('\n').next().map_or(0, |row| row.chars().count());
        (before.matches('\n').count() + 1, column + 1)
    }

    /// Where a statement of its own may be put among the settings at the head of the script: the byte after the last of the
    /// leading statements that begin with one of these words or `import`; without one, where the script's code begins.
    pub(crate) fn after_the_head(&self, words: &[&str]) -> Head {
        let (mut at, mut end) = (0, None);
        while let Some((token, _)) = self.tokens.get(at) {
            let is_head = match token {
                Token::Import => true,
                Token::Identifier(word) => {
                    words.contains(&word.as_str()) && self.token(at + 1) == Some(&Token::LeftParen)
                }
                _ => false,
            };
            let Some(semicolon) = self.end_of_statement(at).filter(|_| is_head) else { break };
            end = Some(self.tokens[semicolon].1 + 1);
            at = semicolon + 1;
        }
        match (end, self.tokens.first()) {
            (Some(end), _) => Head::EndsAt(end),
            (None, Some((_, start))) => Head::MissingBefore(*start),
            (None, None) => Head::MissingBefore(self.text.len()),
        }
    }

    /// The `;` that ends a statement, when it has one of its own.
    fn end_of_statement(&self, start: usize) -> Option<usize> {
        let mut depth = 0_usize;
        for (at, (token, _)) in self.tokens.iter().enumerate().skip(start) {
            match token {
                Token::LeftParen | Token::LeftBracket | Token::LeftBrace | Token::MapStart => depth += 1,
                Token::RightParen | Token::RightBracket | Token::RightBrace => depth = depth.checked_sub(1)?,
                Token::SemiColon if depth == 0 => return Some(at),
                _ => {}
            }
        }
        None
    }

    /// Where a function of that name is called: not defined, not a method, not of a module.
    fn openings(&self, word: &str) -> impl Iterator<Item = usize> {
        let is_call = move |at: &usize| {
            let is_named = matches!(self.token(*at), Some(Token::Identifier(name)) if name.as_str() == word);
            let before = at.checked_sub(1).and_then(|before| self.token(before));
            let is_other = matches!(before, Some(Token::Period | Token::Elvis | Token::DoubleColon | Token::Fn));
            is_named && !is_other && self.token(at + 1) == Some(&Token::LeftParen)
        };
        (0..self.tokens.len()).filter(is_call)
    }

    /// The call that begins at a token, its number at another.
    fn call(&self, opening: usize, number: usize) -> Call {
        Call { at: self.tokens[opening].1, number: self.number(number) }
    }

    /// A plain number that is the whole of an argument, in brackets or not.
    fn number(&self, token: usize) -> Option<Number> {
        let brackets = (token..).take_while(|at| self.token(*at) == Some(&Token::LeftParen)).count();
        let token = token + brackets;
        let start = self.tokens.get(token)?.1;
        let is_minus = matches!(self.token(token), Some(Token::Minus | Token::UnaryMinus));
        let digits = token + usize::from(is_minus);
        let (value, is_whole) = match self.token(digits)? {
            Token::IntegerConstant(whole) => (*whole as f64, true),
            Token::FloatConstant(number) => (*number.0, false),
            _ => return None,
        };
        let after = digits + 1 + brackets;
        let is_closed = (digits + 1..after).all(|at| self.token(at) == Some(&Token::RightParen));
        if !is_closed || !matches!(self.token(after), Some(Token::Comma | Token::RightParen)) {
            return None;
        }
        let range = start..start + written_number(&self.text[start..])?.len();
        Some(Number { range, value: if is_minus { -value } else { value }, is_whole })
    }

    fn token(&self, at: usize) -> Option<&Token> {
        self.tokens.get(at).map(|(token, _)| token)
    }
}

/// Where the settings at the head of a script end, or where they would stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Head {
    /// The byte after its last `;`.
    EndsAt(usize),
    /// There is none; the code begins at this byte.
    MissingBefore(usize),
}

/// The number that a text begins with, its sign included.
fn written_number(text: &str) -> Option<&str> {
    let unsigned = text.strip_prefix('-').unwrap_or(text).trim_start();
    let mut before = ' ';
    let end = unsigned.find(|c: char| {
        let is_exponent_sign = matches!(c, '+' | '-') && matches!(before, 'e' | 'E');
        before = c;
        !(c.is_ascii_alphanumeric() || matches!(c, '_' | '.') || is_exponent_sign)
    });
    let length = end.unwrap_or(unsigned.len());
    (length > 0).then(|| &text[..text.len() - unsigned.len() + length])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sandbox::bare_engine;

    fn numbers(text: &str, word: &str) -> Vec<Option<String>> {
        let engine = bare_engine();
        let lexed = Lexed::of(&engine, text).expect("a script");
        let written = |call: Call| call.number.map(|number| text[number.range].to_owned());
        lexed.calls(word).into_iter().map(written).collect()
    }

    #[test]
    fn a_number_is_found_as_it_is_written() {
        for written in ["0.5", "1", "-3", "- 3", "1_000", "2.5e-3", "1e+2", "0.", "0x1e", "0b11", "0o17"] {
            assert_eq!(numbers(&format!("mu_l({written});"), "mu_l"), [Some(written.to_owned())], "{written}");
            assert_eq!(numbers(&format!("mu_l( /* ü */ {written} )"), "mu_l"), [Some(written.to_owned())], "{written}");
            assert_eq!(numbers(&format!("mu_l((({written})))"), "mu_l"), [Some(written.to_owned())], "{written}");
        }
    }

    #[test]
    fn what_is_no_plain_number_is_none() {
        for written in ["x", "1 - 0.5", "1 / 3", "(1) + 2", "(1", "\"1\"", "-x", "f(1)", "0..5", "1.abs()", "--1"] {
            assert_eq!(numbers(&format!("mu_l({written});"), "mu_l"), [None], "{written}");
        }
    }

    #[test]
    fn comments_texts_methods_and_definitions_are_no_calls() {
        let text = "// mu_l(1)\n/* mu_l(2) /* mu_l(3) */ */ \"mu_l(4)\"; `mu_l(5) ${mu_l(6)} mu_l(7)`; b.mu_l(8); \
                    fn mu_l(x) { } m::mu_l(9); #\"mu_l(10)\"#; mu_l(11);";
        assert_eq!(numbers(text, "mu_l"), [Some("6".to_owned()), Some("11".to_owned())]);
    }

    #[test]
    fn a_param_is_known_by_its_name() {
        let engine = bare_engine();
        let text = "param(\"a\", 1); param(\"b\", 2, 0, 3); param(name, 4); param(\"a\" + i, 5);";
        let lexed = Lexed::of(&engine, text).expect("a script");
        let values = |name| lexed.param_calls(name).iter().map(|call| call.number.clone().unwrap().value).collect();
        let (a, b, c): (Vec<f64>, Vec<f64>, Vec<f64>) = (values("a"), values("b"), values("c"));
        assert_eq!((a, b, c), (vec![1.0], vec![2.0], vec![]));
    }
}
