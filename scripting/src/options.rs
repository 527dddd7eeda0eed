//! What the caller of a scenario decides: tunable numbers, overrides, where the library is.

use std::path::PathBuf;
use std::time::Duration;

use choque_engine::{BroadPhaseChoice, Detection, ExchangeRule, MotionRule};

/// How a scenario is loaded.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// `--set NAME=VALUE`: reaches every `param`, and `mu_l`, `mu_a`, `epsilon`, `restitution`, `friction`.
    /// Of a name given twice the last value counts.
    pub set: Vec<(String, f64)>,
    /// Settings that win over what the script says.
    pub overrides: Overrides,
    /// Where imports and models are looked up after the script's own folder; `None` takes the nearest folder
    /// above the script that is named `scenarios`.
    pub library: Option<PathBuf>,
    /// Wall-clock time that the main part of a script, and each single callback, may take.
    pub script_timeout: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            set: Vec::new(),
            overrides: Overrides::default(),
            library: None,
            script_timeout: Duration::from_secs(10),
        }
    }
}

/// Settings given from outside; `None` leaves what the script says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overrides {
    /// `--steps`
    pub steps: Option<u64>,
    /// `--time-step` \[s\]
    pub time_step: Option<f64>,
    /// `--exchange`
    pub exchange: Option<ExchangeRule>,
    /// `--detection`
    pub detection: Option<Detection>,
    /// `--motion`
    pub motion: Option<MotionRule>,
    /// `--broad-phase`
    pub broad_phase: Option<BroadPhaseChoice>,
}
