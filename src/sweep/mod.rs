//! `choque sweep` and `choque merge`: many runs of scenarios with many numbers, a row each.
//!
//! | question | file |
//! |---|---|
//! | what does a plan say? | [`plan`], [`axis`] |
//! | which points are that? | [`points`], [`sobol`] |
//! | which runs, in which order? | [`runs`] |
//! | how is one made? | [`worker`] |
//! | what does a row hold? | [`table`] |
//! | how does a sweep go on where it was stopped? | [`shard`] |
//! | how do shards become a table? | [`mod@merge`], [`files`] |
//! | what is drawn? | [`plots`] |

pub mod axis;
pub mod files;
pub mod merge;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod plan;
pub mod plots;
pub mod points;
pub mod runs;
pub mod shard;
pub mod sobol;
pub mod table;
pub mod worker;

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::arguments::{ScriptArguments, threads};
use crate::output::numbers::counted;
use crate::progress::Progress;
use crate::report::jobs::{cores, locked};
use crate::terminal::{HEADING, WARNING, styled, tell};
use crate::{Error, Verdict, written};
use files::{Format, Place};
use plan::PlanFile;
use runs::Runs;
use shard::{Identity, Rows, Shard, Writer};
use table::{Cell, Columns, Row};
use worker::Worker;

/// What `sweep` is given.
#[derive(Clone, Debug, clap::Args)]
pub struct SweepArguments {
    /// The plan
    #[arg(value_name = "PLAN.ron")]
    pub plan: PathBuf,
    /// Where to: a folder, or a table named .csv or .parquet with a folder beside it
    #[arg(short, long, value_name = "DIR|FILE", default_value = "sweep")]
    pub output: PathBuf,
    /// How the table is written [default: by the name of the file, or csv]
    #[arg(long, value_enum)]
    pub format: Option<Format>,
    /// Runs made at once; the table never depends on it [default: as many as there are cores]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub jobs: Option<usize>,
    /// Make only every N-th run, from the K-th on; `choque merge` puts the shards together
    #[arg(long, value_name = "K/N", value_parser = Shard::parse, allow_hyphen_values = true)]
    pub shard: Option<Shard>,
    /// Folders and times of the scripts.
    #[command(flatten)]
    pub scripts: ScriptArguments,
}

/// What `merge` is given.
#[derive(Clone, Debug, clap::Args)]
pub struct MergeArguments {
    /// The folder with the shards of a sweep
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// How the table is written
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// The plan's name beside its shards.
const PLAN: &str = "plan.ron";

/// Makes all runs of a plan, or those of a shard, that were not made yet; a whole sweep is then put together.
///
/// # Errors
/// A plan that cannot be carried out; rows of another one in the way; files that cannot be written.
pub fn sweep(arguments: &SweepArguments) -> Result<Verdict, Error> {
    let place = Place::of(&arguments.output, arguments.format)?;
    let file = PlanFile::read(&arguments.plan)?;
    let columns = Columns::of(&file.plan);
    let runs = Runs::of(&file, &arguments.scripts)?;
    let fingerprint = runs.check(&file, &columns)?;
    let identity = Identity { version: env!("CARGO_PKG_VERSION").to_owned(), plan: fingerprint, runs: runs.count() };
    let known = shard::read_all(&place.folder, &columns)?;
    known.iter().try_for_each(|rows| identity.check(rows))?;
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    let to_do = to_do(shard, &known, identity.runs);
    tell_begin(&file, &runs, shard, to_do.len());

    place.make()?;
    written::replace(&place.folder.join(PLAN), file.text.as_bytes())?;
    let own = known.iter().find(|rows| rows.path == place.folder.join(shard.file()));
    let writer = Writer::open(&place.folder, shard, &identity, &columns, own)?;
    carry_out(&runs, &columns, &file, &to_do, arguments.jobs.unwrap_or_else(cores), writer)?;
    if shard == Shard::WHOLE {
        return finish(&place, &file);
    }
    tell(&format!(
        "shard {} of {} is complete; choque merge {} puts them together\n",
        shard.k,
        shard.n,
        place.folder.display()
    ));
    Ok(Verdict::Holds)
}

/// Puts the shards in a folder together.
///
/// # Errors
/// Shards that are not complete, do not belong together or contradict each other.
pub fn merge(arguments: &MergeArguments) -> Result<Verdict, Error> {
    let folder = &arguments.folder;
    let plan = folder.join(PLAN);
    if !plan.is_file() {
        let message = format!("{} holds no sweep: there is no {PLAN}", folder.display());
        return Err(Error::Call { message, hint: "choque sweep PLAN.ron -o DIR makes one".to_owned() });
    }
    finish(&Place::of(folder, Some(arguments.format))?, &PlanFile::read(&plan)?)
}

/// The runs of a shard of which there is no row yet.
fn to_do(shard: Shard, known: &[Rows], runs: usize) -> Vec<usize> {
    let mut is_done = vec![false; runs];
    for row in known.iter().flat_map(|rows| &rows.rows) {
        is_done[row.run] = true;
    }
    (0..runs).filter(|run| shard.has(*run) && !is_done[*run]).collect()
}

/// Makes runs on so many threads, each with scripts of its own, and keeps every row as soon as it is there.
fn carry_out(
    runs: &Runs,
    columns: &Columns,
    file: &PlanFile,
    to_do: &[usize],
    jobs: usize,
    writer: Writer,
) -> Result<(), Error> {
    let next = AtomicUsize::new(0);
    let kept = Mutex::new((writer, Progress::of(to_do.len() as u64, "runs"), 0u64));
    let make = || {
        let mut worker = Worker::new(runs, columns, &file.plan.read);
        while let Some(run) = to_do.get(next.fetch_add(1, Ordering::Relaxed)) {
            let row = worker.row(*run);
            let (writer, progress, done) = &mut *locked(&kept);
            if let Err(error) = writer.add(&row) {
                next.store(to_do.len(), Ordering::Relaxed); // nobody need go on
                return Err(error);
            }
            *done += 1;
            progress.reached(*done);
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs.min(to_do.len())).map(|_| scope.spawn(make)).collect();
        workers
            .into_iter()
            .try_for_each(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

/// Puts the shards of a folder together, writes the table and the plots, and tells of them.
fn finish(place: &Place, file: &PlanFile) -> Result<Verdict, Error> {
    let columns = Columns::of(&file.plan);
    let shards = shard::read_all(&place.folder, &columns)?;
    let (_, rows) = merge::merged(&place.folder, &shards, &columns)?;
    let plots = plots::of(&file.plan, &columns, &rows);
    place.write_table(&columns, &rows)?;
    let mut told = format!("{} in {}\n", counted(rows.len(), "row", "rows"), place.table.display());
    for (name, svg) in plots {
        let path = place.folder.join(name);
        written::replace(&path, svg.as_bytes())?;
        told += &format!("wrote {}\n", path.display());
    }
    tell(&told);
    Ok(judge(&columns, &rows))
}

/// Says how many runs did not do what was expected of them, and what went wrong first.
fn judge(columns: &Columns, rows: &[Row]) -> Verdict {
    let cell = |row: &Row, name: &str| columns.position(name).map_or(Cell::Missing, |at| row.cells[at].clone());
    let warn = |what: &str, column: &str, is_bad: &dyn Fn(&Row) -> bool| {
        let mut bad = rows.iter().filter(|row| is_bad(row));
        let Some(first) = bad.next() else { return false };
        let runs = counted(1 + bad.count(), "run", "runs");
        let warning = styled(WARNING, "warning");
        tell(&format!("{warning}: {runs} {what}; the first is run {}: {}\n", first.run, cell(first, column).text()));
        true
    };
    let failed = warn("did not do what was expected", "first_failed", &|row| cell(row, "failed").number() > Some(0.0));
    let broken = warn("ended in an error", "error", &Row::is_error);
    if failed || broken { Verdict::ExpectationFailed } else { Verdict::Holds }
}

fn tell_begin(file: &PlanFile, runs: &Runs, shard: Shard, to_do: usize) {
    let name = file.path.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let parts = [
        counted(runs.scenarios.len(), "scenario", "scenarios"),
        counted(runs.points.len(), "point", "points"),
        counted(runs.seeds.len(), "seed", "seeds"),
    ];
    let of_shard = if shard == Shard::WHOLE { String::new() } else { format!(", shard {} of {}", shard.k, shard.n) };
    let mine = (0..runs.count()).filter(|run| shard.has(*run)).count();
    let done = if to_do == mine { String::new() } else { format!(", {} of them made before", mine - to_do) };
    let runs = counted(mine, "run", "runs");
    tell(&format!("{}: {runs} ({}{of_shard}){done}\n", styled(HEADING, &name), parts.join(" × ")));
}
