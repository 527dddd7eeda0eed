//! What a report says of one scenario, as data: what the RON file holds.

use choque_engine::Work;
use choque_engine::scene::Detection;
use serde::{Deserialize, Serialize};

use super::convergence::Reach;
use super::copies::Comparison;
use super::horizon::Growth;
use super::method::Method;
use super::reference::Earned;

/// Everything measured of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// The file's stem.
    pub scenario: String,
    /// What the script calls itself.
    pub title: String,
    /// How motion is handed over: document or impulse.
    pub exchange: String,
    /// What is modelled, a line each, laws among them.
    pub laws: Vec<String>,
    /// What the program was built with.
    pub build: Build,
    /// Time simulated \[s\].
    pub time: f64,
    /// Bodies whose errors count.
    pub bodies: usize,
    /// The method of the scenario as it is written.
    pub own: Method,
    /// How differences grow; nothing when no run could be made.
    pub growth: Option<Growth>,
    /// Up to when errors are measured \[s\].
    pub measured_until: f64,
    /// What errors are measured against, for each way of finding collisions.
    pub references: Vec<Referred>,
    /// How far the references of the two ways of finding collisions are apart, in half diagonals, where they are two.
    pub models_apart: Option<f64>,
    /// A line per method and time step.
    pub rows: Vec<Row>,
    /// A line per method.
    pub methods: Vec<Summary>,
    /// Of a chaotic scene: statistics of many copies with each method.
    pub comparisons: Vec<Comparison>,
    /// What a designer should do.
    pub advice: String,
    /// What else should be known.
    pub notes: Vec<String>,
}

/// What the program was built with.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Build {
    /// Of the compiler.
    pub rustc: String,
    /// 0 … 3, s or z.
    pub opt_level: String,
    /// `baseline` or what was asked for.
    pub target_cpu: String,
    /// Where it runs.
    pub target: String,
}

impl Build {
    /// This program's.
    #[must_use]
    pub fn here() -> Self {
        Build {
            rustc: env!("CHOQUE_RUSTC").to_owned(),
            opt_level: env!("CHOQUE_OPT_LEVEL").to_owned(),
            target_cpu: env!("CHOQUE_TARGET_CPU").to_owned(),
            target: env!("CHOQUE_TARGET").to_owned(),
        }
    }
}

/// What measurements are made on: processor, cores and compiler.
#[must_use]
pub fn machine() -> String {
    let Build { rustc, opt_level, target_cpu, target } = Build::here();
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split(':').nth(1));
    let model = model.map_or("a processor that does not tell its name", str::trim);
    format!(
        "{model}, {} cores; {rustc}, opt-level {opt_level}, target-cpu {target_cpu}, {target}",
        super::jobs::cores()
    )
}

/// What errors with one way of finding collisions are measured against.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Referred {
    /// The way.
    pub detection: Detection,
    /// How the reference has earned its name; nothing when none has, and then there are no errors.
    pub earned: Option<Earned>,
    /// What made it; nothing when it was given, or there is none.
    pub method: Option<Method>,
}

/// A method with one time step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The method.
    pub method: Method,
    /// Length of one iteration \[s\].
    pub time_step: f64,
    /// How many.
    pub steps: u64,
    /// Greatest vertex displacement over half diagonal, over bodies and moments; the median over starts.
    pub error: Option<f64>,
    /// The same at the last moment measured.
    pub error_at_end: Option<f64>,
    /// The same, root of the mean square over bodies and moments.
    pub error_rms: Option<f64>,
    /// The same as `error`, but the greatest over starts.
    pub error_worst: Option<f64>,
    /// How far the run with half the time step is from this one; nothing for the shortest.
    pub moved_by_halving: Option<f64>,
    /// Starts, each a fraction of an iteration from the next.
    pub starts: usize,
    /// CPU time of a run \[s\], median.
    pub cpu: f64,
    /// Runs it is the median of.
    pub runs: usize,
    /// CPU time for a second of simulated time \[s\].
    pub cpu_per_second: f64,
    /// Exchanges.
    pub collisions: u64,
    /// Of the final state.
    pub digest: String,
    /// Counted.
    pub work: Work,
}

/// What is said of a method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The method.
    pub method: Method,
    /// Error with a time step of 1/60 s, or the nearest to it.
    pub error_at_sixtieth: Option<f64>,
    /// Fitted order p: the error falls as the time step to the p. Nothing where errors are no more than rounding.
    pub order: Option<f64>,
    /// CPU time for a simulated second within an error of 1e-3 …
    pub reaches_1e_3: Reach,
    /// … and of 1e-6.
    pub reaches_1e_6: Reach,
    /// What ended its runs, if something did.
    pub ended: Option<String>,
}

impl Study {
    /// The rows of a method, longest time step first.
    pub fn rows_of(&self, method: Method) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| row.method == method)
    }

    /// What is said of a method.
    #[must_use]
    pub fn summary_of(&self, method: Method) -> Option<&Summary> {
        self.methods.iter().find(|summary| summary.method == method)
    }
}
