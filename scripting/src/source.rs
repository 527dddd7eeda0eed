//! A light look at a script's text, for hints: what it declares, and where. Rhai's own parser has given up by then.

use rhai::Position;

/// A word or a sign of a script.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Token<'a> {
    pub(crate) text: &'a str,
    /// From 1.
    pub(crate) line: usize,
    /// In characters, from 1.
    pub(crate) column: usize,
}

impl Token<'_> {
    /// Where it begins, as the language counts.
    pub(crate) fn position(&self) -> Position {
        let short = |number: usize| u16::try_from(number).unwrap_or(u16::MAX);
        Position::new(short(self.line), short(self.column))
    }
}

/// A function of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Function<'a> {
    pub(crate) name: Token<'a>,
    pub(crate) parameters: Vec<&'a str>,
}

/// Words and signs; comments and texts are passed over.
pub(crate) fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let mut in_comment = false;
    for (line, row) in text.lines().enumerate() {
        let mut at = 0;
        while let Some(c) = row[at..].chars().next() {
            let rest = &row[at..];
            let length = match c {
                _ if in_comment => rest.find("*/").map_or(rest.len(), |end| end + 2),
                '/' if rest.starts_with("//") => rest.len(),
                '/' if rest.starts_with("/*") => 2,
                '"' | '`' => text_length(rest, c),
                c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
                c => c.len_utf8(),
            };
            in_comment = if in_comment { !rest[..length].ends_with("*/") } else { rest.starts_with("/*") };
            if !in_comment && (is_word(c) || c.is_ascii_punctuation()) && !rest.starts_with("//") {
                let column = row[..at].chars().count() + 1;
                tokens.push(Token { text: &rest[..length], line: line + 1, column });
            }
            at += length;
        }
    }
    tokens
}

/// Where the last comment over several lines begins.
pub(crate) fn last_comment(text: &str) -> Position {
    let before = text.rfind("/*").map_or("", |at| &text[..at]);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().map_or(0, |row| row.chars().count()) + 1;
    Position::new(u16::try_from(line).unwrap_or(u16::MAX), u16::try_from(column).unwrap_or(u16::MAX))
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Bytes of a text from its opening quote to its closing one, or to the end of the line.
fn text_length(rest: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        if c == quote && !escaped {
            return at + 1;
        }
        escaped = c == '\\' && !escaped;
    }
    rest.len()
}

/// The functions a script defines.
pub(crate) fn functions(text: &str) -> Vec<Function<'_>> {
    let tokens = tokens(text);
    let definitions = tokens.windows(3).enumerate().filter(|(_, three)| three[0].text == "fn" && three[2].text == "(");
    definitions
        .map(|(at, three)| {
            let parameters = tokens[at + 3..].iter().take_while(|token| token.text != ")");
            Function {
                name: three[1],
                parameters: parameters.map(|token| token.text).filter(|text| *text != ",").collect(),
            }
        })
        .collect()
}

/// Whether a line and column are in the body of a function, between its braces.
pub(crate) fn is_in_function(text: &str, place: (usize, usize)) -> bool {
    let (mut depth, mut is_ahead, mut outer) = (0_usize, false, None);
    for token in tokens(text).iter().take_while(|token| (token.line, token.column) < place) {
        match token.text {
            "fn" => is_ahead = true,
            "{" => {
                if is_ahead && outer.is_none() {
                    outer = Some(depth);
                }
                (is_ahead, depth) = (false, depth + 1);
            }
            "}" => {
                depth = depth.saturating_sub(1);
                outer = outer.filter(|outer| depth > *outer);
            }
            _ => {}
        }
    }
    outer.is_some()
}

/// The names a script declares as variables, constants or parameters.
pub(crate) fn variables(text: &str) -> Vec<&str> {
    let tokens = tokens(text);
    let declared =
        tokens.windows(2).filter(|two| matches!(two[0].text, "let" | "const" | "for")).map(|two| two[1].text);
    let closures = tokens.iter().enumerate().filter(|(_, token)| token.text == "|").flat_map(|(at, _)| {
        let inside = tokens[at + 1..].iter().take_while(|token| token.text != "|").take(8);
        inside.map(|token| token.text).take_while(|text| *text == "," || text.starts_with(is_word))
    });
    let parameters = functions(text).into_iter().flat_map(|function| function.parameters);
    let mut names: Vec<&str> = declared.chain(closures).chain(parameters).filter(|name| *name != ",").collect();
    names.sort_unstable();
    names.dedup();
    names
}

#[cfg(test)]
mod tests {
    use super::{functions, is_in_function, variables};

    #[test]
    fn declarations_are_seen_and_comments_and_texts_are_not() {
        let text =
            "let car = 1; // let no = 2\n/* let nor\n let this */ const BIG = \"let that\";\nfn f(a, b) { |q| q }";
        assert_eq!(variables(text), ["BIG", "a", "b", "car", "q"]);
        let found = functions(text);
        assert_eq!((found[0].name.text, found[0].name.line, found[0].name.column), ("f", 4, 4));
        assert_eq!(found[0].parameters, ["a", "b"]);
    }

    #[test]
    fn a_place_is_in_a_function_between_its_braces() {
        let text = "{ 1 }\nfn f(a) {\n if a { 2 }\n 3 }\n{ 4 }";
        let inside = [(1, 3), (2, 5), (3, 2), (3, 9), (4, 2), (5, 3)].map(|place| is_in_function(text, place));
        assert_eq!(inside, [false, false, true, true, true, false]);
    }
}
