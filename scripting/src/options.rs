//! What the caller of a scenario decides: tunable numbers, overrides, where the library is, where `print` goes.

use std::fmt;
use std::io::Write as _;
use std::path::PathBuf;
use std::rc::Rc;
use std::time::Duration;

use choque_engine::scene::{BroadPhaseChoice, Detection, ExchangeRule, MotionRule, Settings};

/// How a scenario is loaded.
#[derive(Clone, Debug)]
pub struct Options {
    /// `--set NAME=VALUE`: reaches every `param`, and `mu_l`, `mu_a`, `epsilon`, `restitution`, `friction`, over
    /// whatever the script says. Of a name given twice the last value counts.
    pub set: Vec<(String, f64)>,
    /// Settings that win over what the script or the scene says.
    pub overrides: Overrides,
    /// Where imports and models are looked up after the script's own folder; `None` takes the nearest folder
    /// above the script that is named `scenarios`.
    pub library: Option<PathBuf>,
    /// Wall-clock time that the main part of a script, and each single callback, may take.
    pub script_timeout: Duration,
    /// Where `print` and `debug` write.
    pub output: Output,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            set: Vec::new(),
            overrides: Overrides::default(),
            library: None,
            script_timeout: Duration::from_secs(10),
            output: Output::default(),
        }
    }
}

/// Settings given from outside; `None` leaves what the script or the scene says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overrides {
    /// `--steps`.
    pub steps: Option<u64>,
    /// `--time-step` \[s\], > 0.
    pub time_step: Option<f64>,
    /// `--substeps`, 1 … 1000.
    pub substeps: Option<u32>,
    /// `--exchange`.
    pub exchange: Option<ExchangeRule>,
    /// `--detection`.
    pub detection: Option<Detection>,
    /// `--motion`.
    pub motion: Option<MotionRule>,
    /// `--broad-phase`.
    pub broad_phase: Option<BroadPhaseChoice>,
}

impl Overrides {
    pub(crate) fn apply_to(&self, settings: &mut Settings) {
        settings.steps = self.steps.unwrap_or(settings.steps);
        settings.time_step = self.time_step.unwrap_or(settings.time_step);
        settings.substeps = self.substeps.or(settings.substeps);
        settings.exchange = self.exchange.unwrap_or(settings.exchange);
        settings.detection = self.detection.or(settings.detection);
        settings.motion = self.motion.unwrap_or(settings.motion);
        settings.broad_phase = self.broad_phase.unwrap_or(settings.broad_phase);
    }
}

/// Where a script's `print` and `debug` write, a line at a time; standard error by default.
#[derive(Clone)]
pub struct Output(Rc<dyn Fn(&str)>);

impl Output {
    /// Hands every line to a function.
    pub fn to(write: impl Fn(&str) + 'static) -> Self {
        Output(Rc::new(write))
    }

    pub(crate) fn write(&self, line: &str) {
        (self.0)(line);
    }
}

impl Default for Output {
    fn default() -> Self {
        // A closed standard error is no reason to stop a run.
        Output::to(|line| drop(writeln!(std::io::stderr(), "{line}")))
    }
}

impl fmt::Debug for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Output")
    }
}
