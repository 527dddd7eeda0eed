//! `choque fit`: finds the values with which a scenario does what its script wants, or what a recording shows.
//!
//! | question | file |
//! |---|---|
//! | what is searched, and what does a run come to? | [`problem`], [`recorded`] |
//! | how is it searched? | [`mod@search`], [`mod@refine`], [`matrix`] |
//! | how sharply is a value determined? | [`determined`], [`mod@solve`] |
//! | what is said of it? | [`answer`](mod@answer), [`told`], [`picture`] |

pub mod answer;
pub mod determined;
pub mod matrix;
pub mod picture;
pub mod problem;
pub mod recorded;
pub mod refine;
pub mod search;
pub mod solve;
pub mod told;

use std::fs;
use std::path::{Path, PathBuf};

use choque_scripting::{Scenario, Varied, write_back};

use crate::arguments::{ScenarioArguments, number, threads};
use crate::plot::{Drawing, raster, svg};
use crate::recording::Recording;
use crate::report::jobs::cores;
use crate::terminal::{FAINT, answer, styled, tell};
use crate::written::{self, Kind};
use crate::{Error, Verdict};
use answer::Answer;
use problem::Problem;
use recorded::Recorded;
use search::Effort;

/// What `fit` is given.
#[derive(Clone, Debug, clap::Args)]
pub struct FitArguments {
    /// A `.rhai` script with `target(…)` and `vary(…)`, or any scenario with --recording and --vary
    pub file: PathBuf,
    /// A recording that runs should be like: where its mobile bodies are, frame by frame
    #[arg(long, value_name = "FILE.choque")]
    pub recording: Option<PathBuf>,
    /// What may vary besides what the script says, or between other bounds; may be given several times
    #[arg(long, value_name = "NAME=MIN..MAX", value_parser = range)]
    pub vary: Vec<(String, f64, f64)>,
    /// What a weighted target may be off, and the distance from a recording in body sizes
    #[arg(long, value_name = "X", default_value = "0.001", value_parser = tolerance)]
    pub tolerance: f64,
    /// Places followed down; more find an answer that hides well
    #[arg(long, value_name = "N", default_value = "8", value_parser = threads)]
    pub starts: usize,
    /// Which places are tried
    #[arg(long = "search-seed", id = "search_seed", value_name = "N", default_value = "0")]
    pub seed: u64,
    /// Runs made at once; the result never depends on it [default: as many as there are cores]
    #[arg(long, value_name = "N", value_parser = threads)]
    pub jobs: Option<usize>,
    /// How the result is printed: json goes to standard output, text to standard error
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Draw how the residual grows when each value is moved, as .svg or .png
    #[arg(short, long, value_name = "FILE.svg")]
    pub output: Option<PathBuf>,
    /// Put the values into the script: the numbers in mu_l(…), param("name", …) change, and nothing else
    #[arg(long)]
    pub write: bool,
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
}

const SVG: Kind = Kind { what: "plot", extension: "svg", flag: "-o" };
const PNG: Kind = Kind { extension: "png", ..SVG };
/// Pixels of a PNG for each of the plot's.
const SCALE: f64 = 2.0;

/// Finds the values, tells of them, draws and writes what was asked for.
///
/// # Errors
/// A scenario or recording that cannot be read; nothing to find or nothing that may vary; values that no run can be made
/// with; a script that has no certain place for a value; files that cannot be written.
pub fn fit(arguments: &FitArguments) -> Result<Verdict, Error> {
    if let Some(path) = &arguments.output {
        if is_png(path) { PNG } else { SVG }.check(path)?;
    }
    let scenario = Scenario::load(&arguments.file, &arguments.scenario.options())?;
    let problem = pose(arguments, &scenario)?;
    let script = if arguments.write { Some(script(arguments)?) } else { None };
    if let Some(text) = &script {
        // What has no place must be known before the search, not after it.
        write_back(&arguments.file, text, &problem.values(&problem.own()), &arguments.scenario.options())?;
    }
    let effort = Effort { starts: arguments.starts, seed: arguments.seed, jobs: arguments.jobs.unwrap_or_else(cores) };
    let solved = solve::solve(&problem, effort, arguments.tolerance)?;
    let told = solve::answer(&scenario, &problem, &solved, effort, arguments.tolerance)?;
    if let Some(path) = &arguments.output {
        draw(path, &picture::figure(&problem, &told, &solved.best, effort.jobs).draw())?;
    }
    match arguments.format {
        Format::Text => tell(&told::text(&told)),
        Format::Json => answer(&told::json(&told)?)?,
    }
    if let Some(text) = &script {
        write(arguments, text, &told)?;
    }
    Ok(if told.met { Verdict::Holds } else { Verdict::ExpectationFailed })
}

fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == PNG.extension)
}

fn draw(path: &Path, drawing: &Drawing) -> Result<(), Error> {
    if is_png(path) {
        let png = raster::png(drawing, SCALE).ok_or_else(|| Error::unwritable("the plot", &"it is too large"))?;
        return written::replace(path, png.as_slice());
    }
    written::replace(path, svg::svg(drawing).as_bytes())
}

/// What is to be found, from the script and the call.
fn pose(arguments: &FitArguments, scenario: &Scenario) -> Result<Problem, Error> {
    let refuse = |message: String, hint: &str| Err(Error::Call { message, hint: hint.to_owned() });
    let file = arguments.file.display();
    let mut varied: Vec<Varied> = scenario.varied().to_vec();
    for (name, min, max) in &arguments.vary {
        let asked = scenario.vary(name, (*min, *max))?;
        match varied.iter_mut().find(|known| known.name == *name) {
            Some(known) => *known = asked,
            None => varied.push(asked),
        }
    }
    let held = arguments.scenario.options().set;
    varied.retain(|varied| held.iter().all(|(name, _)| *name != varied.name));
    if varied.is_empty() {
        return refuse(
            format!("{file} has nothing that may vary"),
            "write vary(mu_l, 0, 1) or vary(\"push\", 5, 20) into it, or give --vary mu_l=0..1; --set holds a value",
        );
    }
    if scenario.targets() == 0 && arguments.recording.is_none() {
        return refuse(
            format!("{file} has no target"),
            "write target(\"the car stops near the kerb\", |world| world[\"car\"].x - 12) into it, or give --recording FILE.choque",
        );
    }
    let recorded = match &arguments.recording {
        Some(path) => Some(Recorded::new(&Recording::read(path)?, scenario.scene())?),
        None => None,
    };
    let mut problem = Problem::new(&arguments.file, &arguments.scenario, varied, recorded);
    let is_whole = |name: &str| scenario.controls().iter().any(|control| control.name == name && control.is_whole);
    problem.find_whole(is_whole);
    Ok(problem)
}

/// The text of the script that values are to be written into.
fn script(arguments: &FitArguments) -> Result<String, Error> {
    let file = &arguments.file;
    if !Scenario::is_script(file) {
        return Err(Error::Call {
            message: format!("{} is no script", file.display()),
            hint: "--write puts values into .rhai scripts".to_owned(),
        });
    }
    fs::read_to_string(file).map_err(|source| failed("read", file, source))
}

fn failed(verb: &'static str, file: &Path, source: std::io::Error) -> Error {
    Error::File { verb, path: file.to_owned(), source }
}

/// Puts what was found into the script, when it is worth that and the script is still what it was.
fn write(arguments: &FitArguments, text: &str, told: &Answer) -> Result<(), Error> {
    let path = &arguments.file;
    let file = path.display();
    if !told.met {
        tell(&format!("{}\n", styled(FAINT, &format!("{file} stays as it is: the values do not meet what is wanted"))));
        return Ok(());
    }
    let changed = told.values.iter().filter(|value| value.value != value.was);
    let values: Vec<(String, f64)> = changed.map(|value| (value.name.clone(), value.value)).collect();
    if values.is_empty() {
        tell(&format!("{}\n", styled(FAINT, &format!("{file} has these values already"))));
        return Ok(());
    }
    let new = write_back(path, text, &values, &arguments.scenario.options())?;
    if !written::replace_unchanged(path, text, &new).map_err(|source| failed("write", path, source))? {
        return Err(Error::Call {
            message: format!("{file} has been changed while values were looked for: nothing was written"),
            hint: "the values are those of the script as it was; fit it again".to_owned(),
        });
    }
    let names: Vec<&str> = values.iter().map(|(name, _)| name.as_str()).collect();
    tell(&format!("{}\n", styled(FAINT, &format!("{} written into {file}", names.join(", ")))));
    Ok(())
}

/// `mu_l=0..1`.
fn range(text: &str) -> Result<(String, f64, f64), String> {
    let usage = "write it as NAME=MIN..MAX, for example --vary mu_l=0..1";
    let (name, bounds) = text.split_once('=').ok_or(usage)?;
    let (min, max) = bounds.split_once("..").ok_or(usage)?;
    match name.trim() {
        "" => Err(usage.to_owned()),
        name => Ok((name.to_owned(), number(min)?, number(max)?)),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    choque_engine::check::positive("it", number(text)?).map_err(|bad| bad.to_string())
}
