//! `choque run`: plays a scenario and tells what came of it.

use std::path::PathBuf;

use choque_engine::{Hit, World, note};
use choque_scripting::{Moment, Scenario};

use crate::arguments::{ScenarioArguments, every, threads};
use crate::outcome::Outcome;
use crate::output::rows::{self, Rows};
use crate::output::{json, ron, text};
use crate::play::{FirstMeetings, Watch, play};
use crate::progress::Progress;
use crate::recording::about;
use crate::recording::file::RECORDING;
use crate::recording::recorder::{IntoFile, Recorder, Settings};
use crate::{Error, Verdict, terminal};

/// What `run` is given.
#[derive(Clone, Debug, clap::Args)]
pub struct RunArguments {
    /// A `.rhai` script or a `.ron` scene
    pub file: PathBuf,
    /// How the result is printed: json and ron go to standard output, text to standard error
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Print the whole plan and the counted work too
    #[arg(short, long)]
    pub verbose: bool,
    /// Write what each exchange changed of energy and momenta, and by what cause: a row each, as CSV
    #[arg(long, value_name = "FILE")]
    pub ledger: Option<PathBuf>,
    /// Keep the whole run in a file, to be drawn, played and compared
    #[arg(long, value_name = "FILE.choque")]
    pub record: Option<PathBuf>,
    /// Iterations from one recorded frame to the next
    #[arg(long, value_name = "N", default_value = "1", requires = "record", value_parser = every, allow_negative_numbers = true)]
    pub record_every: u64,
    /// Threads that share an iteration; the result never depends on it
    #[arg(long, value_name = "N", default_value = "1", value_parser = threads, allow_negative_numbers = true)]
    pub threads: usize,
    /// Overrides and folders.
    #[command(flatten)]
    pub scenario: ScenarioArguments,
}

/// How a result is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// For people
    Text,
    /// One JSON object
    Json,
    /// The same data as RON
    Ron,
}

/// How many pairs that met the text tells of.
const MEETINGS: usize = 6;

/// Runs a scenario. Nothing of a result is printed unless the whole run was made.
///
/// # Errors
/// A scenario that cannot be loaded or run; output that cannot be written.
pub fn run(arguments: &RunArguments) -> Result<Verdict, Error> {
    if let Some(path) = &arguments.ledger {
        rows::LEDGER.check(path)?;
    }
    if let Some(path) = &arguments.record {
        RECORDING.check(path)?;
    }
    let scenario = Scenario::load(&arguments.file, &arguments.scenario.options())?;
    let mut run = scenario.start()?;
    run.keep_ledger();
    run.set_threads(arguments.threads);
    tell_notes(&scenario, &run.world());
    let settings = Settings { every: arguments.record_every, ledger: true, command: about::this_call() };
    let into_file = |path: &PathBuf| Recorder::into_file(&scenario, &mut run, &settings, path);
    let recorder = arguments.record.as_ref().map(into_file).transpose()?;
    let mut watcher = Watcher {
        recorder,
        meetings: FirstMeetings::new(MEETINGS),
        rows: arguments.ledger.as_ref().map(|path| Rows::begin(path)).transpose()?,
        progress: Progress::new(run.world().plan().steps),
    };
    let played = play(&mut run, &mut watcher);
    let Watcher { recorder, meetings, rows, progress } = watcher;
    drop(progress); // clears its line before anything else is printed
    let expectations = played?;
    let world = run.world();
    let outcome = Outcome::new(&scenario, &world, expectations).with_targets(run.measure()?);
    if let Some(total) = outcome.total_beyond_numbers() {
        return Err(Error::Call {
            message: format!("the {total} is beyond the range of numbers, though no single body is"),
            hint: "look for a huge mass or velocity".to_owned(),
        });
    }
    if let Some(rows) = rows {
        rows.finish()?;
    }
    if let Some((recorder, path)) = recorder.zip(arguments.record.as_ref()) {
        recorder.finish(&world, &outcome.expectations, path)?;
    }
    match arguments.format {
        Format::Text => {
            let told =
                text::Told { scene: scenario.scene(), world: &world, outcome: &outcome, meetings: &meetings.meetings };
            terminal::tell(&text::summary(&told, arguments.verbose));
        }
        Format::Json => terminal::answer(&json::object(&outcome)?)?,
        Format::Ron => terminal::answer(&ron::outcome(&outcome)?)?,
    }
    Ok(if outcome.holds() { Verdict::Holds } else { Verdict::ExpectationFailed })
}

struct Watcher {
    recorder: Option<Recorder<IntoFile>>,
    meetings: FirstMeetings,
    rows: Option<Rows>,
    progress: Progress,
}

impl Watch for Watcher {
    fn iteration(&mut self, world: &World, hits: &[Hit]) {
        self.meetings.iteration(world, hits);
        if let Some(rows) = &mut self.rows {
            rows.iteration(world, hits);
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.iteration(world, hits);
        }
        self.progress.reached(world.iteration());
    }

    fn moment(&mut self, world: &World, moment: Moment) {
        if let Some(recorder) = &mut self.recorder {
            recorder.moment(world, moment);
        }
    }
}

/// Warns where the physics will not do what the scene seems to hope.
fn tell_notes(scenario: &Scenario, world: &World) {
    for note in note::review(scenario.scene(), world) {
        terminal::tell(&format!("{}: {note}\n", terminal::styled(terminal::WARNING, "warning")));
    }
}
