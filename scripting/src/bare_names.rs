//! `vary(mu_l, 0, 1)`: a setting named without quotes, in the one place where its name is meant and not its value.
//!
//! The name becomes a string while the script is read. As a constant it would be known everywhere, and `if mu_l > 0.5`
//! would compare a name with a number instead of being told that there is no such variable.

use std::cell::Cell;

use rhai::{Engine, Token};

use crate::params::SETTINGS;

/// How much of `vary(` has been read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Seen {
    Nothing,
    Word,
    Bracket,
}

/// Has an engine read a setting's name after `vary(` as a string.
#[allow(deprecated)] // `on_parse_token` is not deprecated: Rhai marks so what may still change
pub(crate) fn let_settings_stand_bare(engine: &mut Engine) {
    let seen = Cell::new(Seen::Nothing);
    engine.on_parse_token(move |token, _, _| {
        let before = seen.replace(Seen::Nothing);
        match &token {
            Token::Identifier(name) if name.as_str() == "vary" => seen.set(Seen::Word),
            Token::LeftParen if before == Seen::Word => seen.set(Seen::Bracket),
            Token::Identifier(name) if before == Seen::Bracket && SETTINGS.contains(&name.as_str()) => {
                return Token::StringConstant(Box::new(name.as_str().into()));
            }
            _ => {}
        }
        token
    });
}
