//! What is wrong with a file that should be a recording, and where.

use thiserror::Error;

/// A file that is no recording, or no longer a whole one.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("byte {offset}: {what}")]
pub struct Broken {
    /// Where in the file, counted from 0.
    pub offset: u64,
    /// What is wrong there.
    pub what: Wrong,
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Wrong {
    /// It does not begin as a recording does.
    #[error("it does not begin as a recording does")]
    Beginning,
    /// A format this version does not know.
    #[error("it has format {0}, and this version of choque knows formats up to {newest}", newest = super::file::FORMAT)]
    Format(u32),
    /// It ends too early.
    #[error("it is cut off here, {0} bytes too early or more")]
    CutOff(u64),
    /// A section does not match its checksum.
    #[error("the section {0} does not match its checksum")]
    Checksum(String),
    /// A section stands where none of its kind may.
    #[error("the section {0} has no place here")]
    Place(String),
    /// A section matches its checksum and makes no sense all the same.
    #[error("the section {0} cannot be read: {1}")]
    Content(String, String),
    /// Something follows after the end.
    #[error("{0} bytes follow after the end")]
    Rest(u64),
}
