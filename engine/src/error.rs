//! What is refused at the door, and the one thing that can go wrong while running.

use thiserror::Error;

use crate::check::BadNumber;

/// A scene that cannot be run as it stands.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SceneError {
    /// A setting is out of its range.
    #[error("{0}")]
    Setting(BadNumber),
    /// A number of a body is out of its range.
    #[error("body \"{body}\": {number}")]
    Number {
        /// The body's name.
        body: String,
        /// Which number, and why not.
        number: BadNumber,
    },
    /// Something about a body that is not one number's fault.
    #[error("body \"{body}\": {reason}")]
    Body {
        /// The body's name.
        body: String,
        /// What is wrong and what to do instead.
        reason: String,
    },
    /// Two bodies of one name.
    #[error("body \"{body}\": the name is taken already; names are unique")]
    DuplicateName {
        /// The name.
        body: String,
    },
    /// More bodies or rectangles than an index can count.
    #[error("the scene has {count} {what}; at most {limit} fit")]
    TooMany {
        /// Bodies or rectangles.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many may be.
        limit: usize,
    },
}

impl SceneError {
    /// The body the error is about, if it is about one.
    #[must_use]
    pub fn body(&self) -> Option<&str> {
        match self {
            SceneError::Number { body, .. } | SceneError::Body { body, .. } | SceneError::DuplicateName { body } => {
                Some(body)
            }
            SceneError::Setting(_) | SceneError::TooMany { .. } => None,
        }
    }
}

/// A command (a write of motion, a push) that cannot be obeyed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CommandError {
    /// The number given is not finite.
    #[error("body \"{body}\": {number}")]
    Number {
        /// The body's name.
        body: String,
        /// Which number, and why not.
        number: BadNumber,
    },
    /// A force or a torque on a body that forces do not move.
    #[error("body \"{body}\" is fixed: {verb} acts on mobile bodies only")]
    Fixed {
        /// The body's name.
        body: String,
        /// `push` or `twist`.
        verb: &'static str,
    },
}

/// A body's motion or place became infinite or NaN while running; the run means nothing from there on.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("body \"{body}\" became non-finite in iteration {iteration}: {what}")]
pub struct Fault {
    /// The body's name.
    pub body: String,
    /// The iteration in which it happened, the first being 0.
    pub iteration: u64,
    /// Its numbers then.
    pub what: String,
}
