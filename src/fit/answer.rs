//! What a fit came to, as data: the object that `fit --format json` prints.

use serde::Serialize;

use crate::outcome::Measured;

/// The order of the fields is the order in the output.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// The file's stem.
    pub scenario: String,
    /// What the script calls itself, or the file's stem.
    pub title: String,
    /// Whether every residual is within the tolerance.
    pub met: bool,
    /// What a weighted target, or the distance from a recording, may be off.
    pub tolerance: f64,
    /// The root of the sum of the squares of all residuals.
    pub residual: f64,
    /// What was found.
    pub values: Vec<Value>,
    /// Correlations of the values, in their order; left out where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub correlations: Option<Vec<Vec<f64>>>,
    /// The script's targets with those values.
    pub targets: Vec<Measured>,
    /// How far bodies are from a recording; left out when there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recording: Option<Distance>,
    /// Other values that meet everything too, far from these.
    pub alternatives: Vec<Vec<f64>>,
    /// Which places were tried.
    pub seed: u64,
    /// Runs that were made.
    pub runs: u64,
}

/// A value that was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Value {
    /// Of a param or a setting.
    pub name: String,
    /// What it should be.
    pub value: f64,
    /// What the scenario says, `--set` included.
    pub was: f64,
    /// Whether it takes whole numbers only.
    pub whole: bool,
    /// Between what it could vary.
    pub range: [f64; 2],
    /// Between what the residual grows by no more than the tolerance, the other values following.
    pub interval: [f64; 2],
    /// Whether that interval is less than half of the range, and no long way along which nothing changes.
    pub determined: bool,
    /// Values that move along with it from one end of the interval to the other.
    pub along: Vec<Along>,
}

/// A value that moves along with another.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Along {
    /// Its name.
    pub name: String,
    /// What it is where the other is lowest and highest.
    pub ends: [f64; 2],
}

/// How far bodies are from where they were recorded.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Distance {
    /// Root of the mean square, over frames and bodies; places in half diagonals, angles in radians.
    pub distance: f64,
    /// Frames compared.
    pub frames: usize,
    /// Bodies compared.
    pub bodies: usize,
}
