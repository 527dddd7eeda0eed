//! JSON: one object on one line, every number the shortest text that reads back to the same f64.

use crate::Error;
use crate::report::Report;

/// The report as one JSON object and a newline.
///
/// # Errors
/// None that a report can cause; the serialiser's own are passed on.
pub fn object(report: &Report) -> Result<String, Error> {
    let object = serde_json::to_string(report).map_err(|error| Error::unwritable("the report", &error))?;
    Ok(object + "\n")
}
