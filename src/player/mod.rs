//! The player's place: pages of a run, and of two runs laid over each other.

use crate::Error;
use crate::recording::Recording;

/// A page that plays a run.
///
/// # Errors
/// There is no player yet.
pub fn page(_: &Recording) -> Result<String, Error> {
    Err(Error::Call { message: "pages are not there yet".to_owned(), hint: "make a .svg, .png or .gif".to_owned() })
}

/// A page that plays two runs laid over each other, from an iteration on.
///
/// # Errors
/// There is no player yet.
pub fn page_of_two(a: &Recording, _: &Recording, _: [&str; 2], _: u64) -> Result<String, Error> {
    page(a)
}
