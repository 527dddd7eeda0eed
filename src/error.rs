//! What a call comes to: a verdict, or an error that ended it early; and the code the command exits with.

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

use choque_scripting::Diagnostic;
use thiserror::Error;

use crate::recording::Broken;

/// What a call that was carried out found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Everything asked for holds: exit code 0.
    Holds,
    /// An expectation failed: exit code 1.
    ExpectationFailed,
    /// Two runs are not the same: exit code 1.
    Differ,
    /// An input is bad, and that has been told already: exit code 2.
    BadInput,
}

impl From<Verdict> for ExitCode {
    fn from(verdict: Verdict) -> Self {
        ExitCode::from(match verdict {
            Verdict::Holds => 0,
            Verdict::ExpectationFailed | Verdict::Differ => 1,
            Verdict::BadInput => 2,
        })
    }
}

/// What ended a call early, with exit code 2; `Display` is the whole text shown to a person.
#[derive(Debug, Error)]
pub enum Error {
    /// The scenario cannot be read, compiled or run as it stands, or left the finite numbers on the way.
    #[error("{0}")]
    Scenario(Box<Diagnostic>),
    /// A file or folder could not be read or written.
    #[error("error: cannot {verb} {}: {source}", .path.display())]
    File {
        /// What was tried: `write`, `create`.
        verb: &'static str,
        /// The file.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// A recording that is none, or no longer whole.
    #[error("error: cannot read {}: {broken}\n  = help: record the run again: choque run FILE --record {}", .path.display(), .path.display())]
    Recording {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, and where.
        broken: Broken,
    },
    /// The call itself asks for something that cannot be.
    #[error("error: {message}\n  = help: {hint}")]
    Call {
        /// What is wrong.
        message: String,
        /// What to do instead.
        hint: String,
    },
}

impl Error {
    /// Data that a serialiser refuses.
    pub(crate) fn unwritable(what: &str, why: &dyn std::fmt::Display) -> Self {
        Error::Call { message: format!("cannot write {what}: {why}"), hint: "use --format text".to_owned() }
    }
}

impl From<Diagnostic> for Error {
    fn from(diagnostic: Diagnostic) -> Self {
        Error::Scenario(Box::new(diagnostic))
    }
}
