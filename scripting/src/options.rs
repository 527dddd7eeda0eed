//! What the caller of a scenario decides: tunable numbers, overrides, where the library is, where `print` goes, who is
//! told of files that are read, and who may stop it.

use std::fmt;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
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
    /// Who is told of the files that the scenario reads.
    pub reads: Reads,
    /// Stops the script from outside.
    pub stop: Stop,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            set: Vec::new(),
            overrides: Overrides::default(),
            library: None,
            script_timeout: Duration::from_secs(10),
            output: Output::default(),
            reads: Reads::default(),
            stop: Stop::default(),
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
    /// `--seed`.
    pub seed: Option<i64>,
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
        settings.seed = self.seed.unwrap_or(settings.seed);
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

/// Told of every file that a scenario reads or looks for, the scenario's own first, just before it does: for whoever
/// wants to know when one of them changes. Nobody by default.
#[derive(Clone)]
pub struct Reads(Rc<dyn Fn(&Path)>);

impl Reads {
    /// Hands every path to a function.
    pub fn to(tell: impl Fn(&Path) + 'static) -> Self {
        Reads(Rc::new(tell))
    }

    pub(crate) fn tell(&self, file: &Path) {
        (self.0)(file);
    }
}

impl Default for Reads {
    fn default() -> Self {
        Reads::to(|_| ())
    }
}

impl fmt::Debug for Reads {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Reads")
    }
}

/// Stops the main part or a callback of a script from another thread, once and for all; clones stop together.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Whatever runs ends as soon as it looks; whatever begins ends at once.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether that was asked for.
    #[must_use]
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
