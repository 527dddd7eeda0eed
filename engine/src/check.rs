//! Numbers checked at the door: one place for what a mass, a time step or a μ may be.

use thiserror::Error;

/// A number that is not what it has to be.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{what} must be {must}, not {}", shown(*.value))]
pub struct BadNumber {
    /// What the number is for: `mass`, `mu_l`, `velocity: x`.
    pub what: String,
    /// What is asked of it.
    pub must: &'static str,
    /// The number given.
    pub value: f64,
}

/// A number as a person writes it: very large and very small ones with an exponent.
#[must_use]
pub fn shown(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() || (1e-6..1e15).contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

fn demand(holds: bool, what: &str, must: &'static str, value: f64) -> Result<f64, BadNumber> {
    if holds { Ok(value) } else { Err(BadNumber { what: what.to_owned(), must, value }) }
}

/// The number itself when it is neither NaN nor infinite.
pub fn finite(what: &str, value: f64) -> Result<f64, BadNumber> {
    demand(value.is_finite(), what, "a finite number", value)
}

/// The number itself when it is finite, greater than zero and has a finite reciprocal
/// (a mass of 1e-310 kg would have none).
pub fn positive(what: &str, value: f64) -> Result<f64, BadNumber> {
    finite(what, value)?;
    demand(value > 0.0, what, "greater than 0", value)?;
    demand((1.0 / value).is_finite(), what, "large enough to divide by", value)
}

/// The number itself when it is finite and not below zero.
pub fn not_negative(what: &str, value: f64) -> Result<f64, BadNumber> {
    finite(what, value)?;
    demand(value >= 0.0, what, "0 or more", value)
}

/// The count itself when an iteration may be cut into so many sub-steps: 1 … 1000.
pub fn substeps(what: &str, count: i64) -> Result<u32, BadNumber> {
    let allowed = u32::try_from(count).ok().filter(|count| (1..=1000).contains(count));
    allowed.ok_or_else(|| BadNumber { what: what.to_owned(), must: "between 1 and 1000", value: count as f64 })
}

/// The number itself when it lies in 0 … 1.
pub fn unit_range(what: &str, value: f64) -> Result<f64, BadNumber> {
    finite(what, value)?;
    demand((0.0..=1.0).contains(&value), what, "between 0 and 1", value)
}
