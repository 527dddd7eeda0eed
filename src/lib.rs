//! `choque`: a command that runs, checks and explains rectangle collision scenarios, and a harness that pins them.
//!
//! | what | file |
//! |---|---|
//! | calls and flags | [`cli`], [`arguments`] |
//! | a scenario played to its end, and what is told of it | [`play`], [`outcome`], [`books`], [`readings`], [`notable`] |
//! | what each call does | [`run`], [`check`], [`explain`], [`export`], [`words`], [`init`], [`report`], [`render`], [`diff`](mod@diff) |
//! | what each call does | [`run`], [`check`], [`explain`], [`export`], [`words`], [`init`], [`report`], [`render`], [`studio`] |
//! | what each call does | [`run`], [`check`], [`explain`], [`export`], [`words`], [`init`], [`report`], [`render`], [`diff`](mod@diff), [`fit`](mod@fit) |
//! | a run kept to the last bit | [`recording`] |
//! | a run as a page that plays it | [`player`] |
//! | what each call does | [`run`], [`check`], [`explain`], [`export`], [`words`], [`init`], [`report`], [`sweep`] |
//! | how it is printed | [`output`], [`plot`], [`written`], [`terminal`], [`progress`], [`clock`] |
//! | one test per scenario, pinned by a snapshot | [`harness`] |
//!
//! The physics is `choque-engine`'s, the language `choque-scripting`'s; here are files, clocks and terminals only.

pub mod arguments;
pub mod books;
pub mod check;
pub mod cli;
pub mod clock;
pub mod diff;
pub mod error;
pub mod explain;
pub mod export;
pub mod fit;
pub mod harness;
pub mod init;
pub mod notable;
pub mod outcome;
pub mod output;
pub mod play;
pub mod player;
pub mod plot;
pub mod progress;
pub mod readings;
pub mod recording;
pub mod render;
pub mod report;
pub mod run;
pub mod studio;
pub mod sweep;
pub mod terminal;
pub mod words;
pub mod written;

pub use error::{Error, Verdict};
// For `harness::main!`, which asserts from the crate it is used in.
#[doc(hidden)]
pub use insta;
