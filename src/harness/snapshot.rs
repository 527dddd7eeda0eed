//! What a snapshot holds: first what people read, then what only machines compare.

use choque_engine::Work;
use ron::ser::to_string_pretty;
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::outcome::Judgement;
use crate::output::ron::layout;

/// A scenario and its outcome. Rows and totals are rounded, so that they move with the physics and not with the last
/// bit of it; the digests are over every bit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    /// Path below `scenarios` without the extension.
    pub scenario: String,
    /// What it calls itself.
    pub title: String,
    /// What is modelled and what is left out, a line each.
    pub plan: Vec<String>,
    /// Digest over the scene as plain data, its title left aside: whether the scene itself is another.
    pub scene: String,
    /// Length of one iteration \[s\].
    pub time_step: f64,
    /// Iterations made.
    pub steps: u64,
    /// Bodies at the end: all, or in a large scene those with a tag.
    pub bodies: Vec<BodyRow>,
    /// How many bodies are not among them.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub untold: usize,
    /// In a large scene: which body is the furthest, the fastest and so on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub extremes: Vec<ExtremeRow>,
    /// Sums over the scene at the end.
    pub totals: Totals,
    /// The pairs that met first.
    pub first_met: Vec<MeetingRow>,
    /// What the script expects, and whether it held.
    pub expectations: Vec<Judgement>,
    /// Counted work.
    pub work: Work,
    /// Digest of the final state.
    pub digest: String,
    /// The start and eight evenly spaced iterations: where two runs part.
    pub checkpoints: Vec<Checkpoint>,
}

/// A body at the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyRow {
    /// Its name.
    pub name: String,
    /// Centre \[m\].
    pub x: f64,
    /// Centre \[m\].
    pub z: f64,
    /// In (−π, π] \[rad\].
    pub angle: f64,
    /// Velocity \[m/s\].
    pub vx: f64,
    /// Velocity \[m/s\].
    pub vz: f64,
    /// \[rad/s\].
    pub spin: f64,
}

/// An extreme of a large scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExtremeRow {
    /// Which: `least x`, `fastest`.
    pub what: String,
    /// The body's name.
    pub body: String,
    /// The quantity \[m, m/s or rad/s\].
    pub value: f64,
}

/// Sums over the scene at the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Totals {
    /// Time \[s\].
    pub time: f64,
    /// Exchanges.
    pub collisions: u64,
    /// Of the mobile bodies \[J\].
    pub kinetic_energy: f64,
    /// Of the mobile bodies \[kg·m/s\].
    pub momentum: (f64, f64),
    /// Of the mobile bodies about the world's origin \[kg·m²/s\].
    pub angular_momentum: f64,
    /// Deepest overlap \[m\].
    pub deepest: f64,
}

/// A pair that met: their first exchange, and how many they had.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeetingRow {
    /// The first-created of the pair.
    pub a: String,
    /// The other.
    pub b: String,
    /// When they first met.
    pub iteration: u64,
    /// Where \[m\].
    pub x: f64,
    /// Where \[m\].
    pub z: f64,
    /// How deep \[m\].
    pub depth: f64,
    /// Exchanges in all.
    pub times: u64,
}

/// What the run looked like after so many iterations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checkpoint {
    /// Iterations finished.
    pub iteration: u64,
    /// Exchanges so far.
    pub collisions: u64,
    /// Of the mobile bodies \[J\].
    pub kinetic_energy: f64,
    /// Of every bit.
    pub digest: String,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// Stands above every snapshot: what its numbers are.
const UNITS: &str = "// Metres, kilograms, seconds, radians. Rows are rounded to six decimals, totals to nine digits; \
                     digests are over every bit.\n";

impl Snapshot {
    /// The snapshot's text: RON, a line per body.
    ///
    /// # Errors
    /// None that a snapshot can cause; the serialiser's own are passed on.
    pub fn to_text(&self) -> Result<String, Error> {
        let ron = to_string_pretty(self, layout()).map_err(|error| Error::unwritable("the snapshot", &error))?;
        Ok(format!("{UNITS}{ron}"))
    }

    /// Reads a snapshot's text back.
    ///
    /// # Errors
    /// What the text is not: RON, or of this version's shape.
    pub fn from_text(text: &str) -> Result<Self, ron::error::SpannedError> {
        ron::from_str(text)
    }
}

/// Rounded to a millionth: a micrometre, microradian or micrometre a second. No −0.
#[must_use]
pub(crate) fn rounded(number: f64) -> f64 {
    const PARTS: f64 = 1e6;
    let scaled = (number * PARTS).round();
    let exact = scaled.abs() < 9e15; // above, a double has no millionths left to round
    if exact { scaled / PARTS + 0.0 } else { number }
}

/// Rounded to nine significant digits, for sums whose size nobody knows beforehand. No −0.
#[must_use]
pub(super) fn significant(number: f64) -> f64 {
    format!("{number:.8e}").parse().unwrap_or(number) + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_six_decimals() {
        let expected = [(1.0 / 3.0, 0.333_333), (-1e-9, 0.0), (2e-6, 2e-6), (1e12 + 0.5, 1e12 + 0.5), (1e300, 1e300)];
        for (number, row) in expected {
            assert_eq!(rounded(number), row);
            assert!(rounded(number) != 0.0 || rounded(number).is_sign_positive());
        }
    }

    #[test]
    fn totals_keep_nine_digits() {
        let expected = [(123_456_789_012.0, 123_456_789_000.0), (-1.0 / 3.0, -0.333_333_333), (-0.0, 0.0)];
        for (number, total) in expected {
            assert_eq!(significant(number), total);
        }
    }
}
