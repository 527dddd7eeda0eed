//! `choque diff A B`: where two runs part, in which stage of which iteration, by how much, and how that grew.
//!
//! | what | file |
//! |---|---|
//! | the two runs: recordings, scripts with settings of their own | [`sides`] |
//! | what was said or modelled otherwise | `premises` |
//! | the first difference, and its stage | [`parting`](mod@parting), `contacts`, `near`, `aligned` |
//! | how the difference grew | [`growth`] |
//! | a script against its snapshot | [`pinned`] |
//! | all of it in words | [`told`] |

mod aligned;
mod contacts;
pub mod growth;
mod near;
pub mod parting;
pub mod pinned;
mod premises;
pub mod sides;
pub mod told;

use std::path::{Path, PathBuf};

use crate::arguments::ScenarioArguments;
use crate::recording::Recording;
use crate::written::{self, Kind};
use crate::{Error, Verdict, player, terminal};
use sides::{Side, side_setting};

pub use parting::{Parting, Stage, parting};

/// What `diff` is given.
#[derive(Clone, Debug, clap::Args)]
pub struct DiffArguments {
    /// A `.rhai` script, a `.ron` scene, or a `.choque` recording
    pub a: PathBuf,
    /// Another; or the `.snap` of a script; the same script when nothing is said
    pub b: Option<PathBuf>,
    /// What only A is given: a param or setting as with --set, or one of steps, time_step, substeps, exchange, detection, motion,
    /// broad_phase
    #[arg(long, value_name = "NAME=VALUE", value_parser = side_setting)]
    pub set_a: Vec<(String, String)>,
    /// What only B is given
    #[arg(long, value_name = "NAME=VALUE", value_parser = side_setting)]
    pub set_b: Vec<(String, String)>,
    /// Compare with the script's own snapshot
    #[arg(long, conflicts_with_all = ["b", "set_b"])]
    pub snapshot: bool,
    /// Write a page that plays both, laid over each other, from just before they part
    #[arg(short, long, value_name = "DIFF.html")]
    pub output: Option<PathBuf>,
    /// Overrides and folders, for both.
    #[command(flatten)]
    pub scenario: ScenarioArguments,
}

const PAGE: Kind = Kind { what: "page", extension: "html", flag: "-o" };

/// Iterations that a page of two runs shows before they part.
const BEFORE: u64 = 30;

/// Compares two runs. The verdict is [`Verdict::Differ`] when they are not the same to the last bit.
///
/// # Errors
/// What cannot be read or run; a page that cannot be written.
pub fn diff(arguments: &DiffArguments) -> Result<Verdict, Error> {
    if let Some(path) = &arguments.output {
        PAGE.check(path)?;
    }
    let options = arguments.scenario.options();
    let a = Side::new(&arguments.a, &options, &arguments.set_a)?;
    let snapshot = match &arguments.b {
        Some(b) if b.extension().is_some_and(|extension| extension == "snap") => Some(b.clone()),
        _ if arguments.snapshot => Some(pinned::snapshot_of(&arguments.a)?),
        _ => None,
    };
    if let Some(snapshot) = snapshot {
        return against_snapshot(arguments, &a, &snapshot);
    }
    let b = Side::new(arguments.b.as_ref().unwrap_or(&arguments.a), &options, &arguments.set_b)?;
    let (run_a, run_b) = (a.recording()?, b.recording()?);
    let found = told::comparison([&a.name, &b.name], [&run_a, &run_b]);
    terminal::answer(&found.text)?;
    if let (Some(path), Some(iteration)) = (&arguments.output, found.iteration) {
        write(path, &page([&a.name, &b.name], Some(&run_a), &run_b, iteration)?)?;
    }
    Ok(if found.same { Verdict::Holds } else { Verdict::Differ })
}

fn against_snapshot(arguments: &DiffArguments, run: &Side, snapshot: &Path) -> Result<Verdict, Error> {
    let recording = run.recording()?;
    let (found, kept) = pinned::against(snapshot, &run.name, &recording)?;
    terminal::answer(&found.text)?;
    if let (Some(path), Some(iteration)) = (&arguments.output, found.iteration) {
        write(path, &page(["snapshot", &run.name], kept.as_ref(), &recording, iteration)?)?;
    }
    Ok(if found.same { Verdict::Holds } else { Verdict::Differ })
}

/// A page that plays a run, over the other where there is one, from just before they part.
pub(crate) fn page(
    names: [&str; 2],
    other: Option<&Recording>,
    run: &Recording,
    iteration: u64,
) -> Result<String, Error> {
    match other {
        Some(other) => player::page_of_two(other, run, names, iteration.saturating_sub(BEFORE)),
        None => player::page(run),
    }
}

fn write(path: &Path, page: &str) -> Result<(), Error> {
    written::replace(path, page.as_bytes())?;
    terminal::tell(&format!("wrote {}\n", path.display()));
    Ok(())
}
