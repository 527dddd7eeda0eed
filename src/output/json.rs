//! JSON: one object on one line, every number the shortest text that reads back to the same f64.

use crate::Error;
use crate::outcome::Outcome;

/// The outcome of a run as one JSON object and a newline.
///
/// # Errors
/// None that an outcome can cause; the serialiser's own are passed on.
pub fn object(outcome: &Outcome) -> Result<String, Error> {
    let object = serde_json::to_string(outcome).map_err(|error| Error::unwritable("the outcome", &error))?;
    Ok(object + "\n")
}
