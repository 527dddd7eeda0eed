//! RON: the same data as JSON, and scenes; a line per body.

use ::ron::ser::{PrettyConfig, to_string_pretty};
use choque_engine::Scene;
use serde::Serialize;

use crate::Error;
use crate::outcome::Outcome;

/// Lists and structures open up so far; what lies deeper, such as a body, stays on one line.
const DEPTH: usize = 2;

/// The outcome of a run as RON and a newline.
///
/// # Errors
/// None that an outcome can cause; the serialiser's own are passed on.
pub fn outcome(outcome: &Outcome) -> Result<String, Error> {
    pretty(outcome, "the outcome")
}

/// A scene as RON and a newline; `choque run` reads it back.
///
/// # Errors
/// None that a scene can cause; the serialiser's own are passed on.
pub fn scene(scene: &Scene) -> Result<String, Error> {
    pretty(scene, "the scene")
}

/// Any data as RON and a newline.
///
/// # Errors
/// What the serialiser refuses.
pub fn pretty<T: Serialize>(value: &T, what: &str) -> Result<String, Error> {
    let text = to_string_pretty(value, layout()).map_err(|error| Error::unwritable(what, &error))?;
    Ok(text + "\n")
}

/// How all RON of this crate is laid out, the same on every platform.
#[must_use]
pub fn layout() -> PrettyConfig {
    PrettyConfig::new().depth_limit(DEPTH).new_line("\n").indentor("  ")
}
