//! The runs of a plan: scenarios found, points laid, each with each and with every seed, in one order.

use std::path::{Path, PathBuf};

use choque_scripting::{Options, Output, Overrides, Scenario};
use glob::MatchOptions;

use super::axis::{self, Axis, Value};
use super::plan::PlanFile;
use super::plots;
use super::table::{Cell, Columns, on_one_line};
use crate::Error;
use crate::arguments::ScriptArguments;
use crate::outcome::hexadecimal;

/// All runs of a plan. A run's number is its place: scenarios, then points, then seeds, the last fastest.
#[derive(Debug)]
pub struct Runs {
    /// The scenarios, each as the plan's folder sees it, and as this process does.
    pub scenarios: Vec<(String, PathBuf)>,
    /// Values by point and axis.
    pub points: Vec<Vec<Value>>,
    /// `None`: the scenario's own.
    pub seeds: Vec<Option<i64>>,
    /// What every run is given.
    set: Vec<(String, Value)>,
    names: Vec<String>,
    /// What scripts may read, and how long they may take.
    scripts: ScriptArguments,
}

/// What one run is asked for.
#[derive(Clone, Debug)]
pub struct Asked {
    /// Which of the scenarios.
    pub scenario: usize,
    /// The params.
    pub set: Vec<(String, f64)>,
    /// The settings.
    pub overrides: Overrides,
    point: usize,
    values: Vec<Value>,
}

/// A folder of this name holds what scenarios import.
const LIBRARY: &str = "lib";

/// Points whose scripts are run beforehand, to see what they read.
const LOOKED_AT: usize = 16;

/// How many runs a sweep may have.
const MOST_RUNS: usize = 100_000_000;

impl Runs {
    /// Finds the scenarios and lays the points.
    ///
    /// # Errors
    /// A pattern that finds nothing; more runs than can be made.
    pub fn of(file: &PlanFile, scripts: &ScriptArguments) -> Result<Runs, Error> {
        let plan = &file.plan;
        let folder = file.path.parent().unwrap_or(Path::new(""));
        let mut scenarios: Vec<(String, PathBuf)> = Vec::new();
        for pattern in &plan.scenarios {
            let found = find(file, folder, pattern)?;
            let new: Vec<_> = found.into_iter().filter(|(name, _)| scenarios.iter().all(|(n, _)| n != name)).collect();
            scenarios.extend(new);
        }
        let points = plan.points.lay(&plan.vary);
        let seeds = if plan.seeds.is_empty() { vec![None] } else { plan.seeds.iter().copied().map(Some).collect() };
        let names = plan.vary.iter().map(|axis| axis.name.clone()).collect();
        let set = plan.set.iter().map(|(name, value)| (name.clone(), value.clone())).collect();
        let runs = Runs { scenarios, points, seeds, set, names, scripts: scripts.clone() };
        match runs.points.len().checked_mul(runs.scenarios.len()).and_then(|n| n.checked_mul(runs.seeds.len())) {
            Some(count) if count <= MOST_RUNS => Ok(runs),
            _ => Err(file.complain("", format!("these are more than {MOST_RUNS} runs"), None)),
        }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.scenarios.len() * self.points.len() * self.seeds.len()
    }

    /// What the run of that number is asked for.
    #[must_use]
    pub fn asked(&self, run: usize) -> Asked {
        let (seed, rest) = (self.seeds[run % self.seeds.len()], run / self.seeds.len());
        let (point, scenario) = (rest % self.points.len(), rest / self.points.len());
        let mut overrides = Overrides { seed, ..Overrides::default() };
        let mut set = Vec::new();
        let fixed = self.set.iter().map(|(name, value)| (name, value));
        let varied = self.names.iter().zip(&self.points[point]);
        for (name, value) in fixed.chain(varied) {
            axis::apply(name, value, &mut set, &mut overrides);
        }
        let fixed = self.set.iter().map(|(_, value)| value.clone());
        let values = self.points[point].iter().cloned().chain(fixed).collect();
        Asked { scenario, set, overrides, point, values }
    }

    /// The cells that say what a run was asked for; `seed` is the scenario's own where none is given.
    #[must_use]
    pub fn cells(&self, run: usize, asked: &Asked, seed: Option<i64>) -> Vec<Cell> {
        let cell = |value: &Value| match value {
            Value::Number(number) => Cell::Number(*number),
            Value::Word(word) => Cell::Text(word.clone()),
        };
        let mut cells = vec![
            Cell::Whole(run as i64),
            Cell::Text(on_one_line(&self.scenarios[asked.scenario].0)),
            Cell::Whole(asked.point as i64),
        ];
        cells.extend(asked.values.iter().map(cell));
        cells.push(asked.overrides.seed.or(seed).map_or(Cell::Missing, Cell::Whole));
        cells.push(Cell::Text(env!("CARGO_PKG_VERSION").to_owned()));
        cells
    }

    /// How scenarios are loaded: what they print is not read by anyone.
    #[must_use]
    pub fn options(&self) -> Options {
        Options { output: Output::to(|_| {}), ..self.scripts.options() }
    }

    /// Loads every scenario and checks that what varies is there to be varied. Gives the plan's fingerprint: of what it
    /// runs, and of every script and model that is read for it.
    ///
    /// # Errors
    /// A scenario that cannot be loaded, that lacks a param or a body, or whose param may not go where the plan goes.
    pub fn check(&self, file: &PlanFile, columns: &Columns) -> Result<String, Error> {
        if let Some(name) = columns.twice() {
            let hint = "rename the param in its script".to_owned();
            return Err(file.complain(name, format!("the table has a column {name} already"), Some(hint)));
        }
        check_plots(file, columns)?;
        let plan = &file.plan;
        let what = format!("{:?}{:?}{:?}{:?}{:?}", plan.points, plan.vary, plan.set, plan.seeds, plan.read);
        let mut digest = fingerprint(0xcbf2_9ce4_8422_2325, &what);
        for (index, (name, path)) in self.scenarios.iter().enumerate() {
            let scenario = Scenario::load(path, &self.options())?;
            check_names(file, name, &scenario)?;
            digest = self
                .texts(index, &scenario)
                .iter()
                .fold(fingerprint(digest, name), |digest, text| fingerprint(digest, text));
            for read in &plan.read {
                check_read(file, name, read, &scenario)?;
            }
        }
        Ok(hexadecimal(digest))
    }

    /// Every text that a scenario is made of, also where a param decides which model is read: as many points as
    /// [`LOOKED_AT`] are looked at. Without their folders, which have other names on
    /// other machines.
    fn texts(&self, scenario: usize, loaded: &Scenario) -> Vec<String> {
        let per_scenario = self.points.len() * self.seeds.len();
        let looked_at = per_scenario.min(LOOKED_AT);
        for place in 0..looked_at {
            let run = scenario * per_scenario + place * (per_scenario - 1) / (looked_at - 1).max(1);
            let asked = self.asked(run);
            drop(loaded.with(&asked.set, asked.overrides)); // an error is a row of its own later
        }
        let named = |(path, text): (String, String)| format!("{}\n{text}", stem_of(&path));
        let mut texts: Vec<String> = loaded.sources().into_iter().map(named).collect();
        texts.sort();
        texts
    }
}

fn stem_of(path: &str) -> &str {
    Path::new(path).file_stem().and_then(|stem| stem.to_str()).unwrap_or_default()
}

/// The files of a pattern, in the order of their names.
fn find(file: &PlanFile, folder: &Path, pattern: &str) -> Result<Vec<(String, PathBuf)>, Error> {
    let complain = |message: String| file.complain(pattern, message, None);
    let is_pattern = pattern.contains(['*', '?', '[']);
    if !is_pattern {
        let path = folder.join(pattern);
        return match path.is_file() {
            true => Ok(vec![(pattern.to_owned(), path)]),
            false => Err(complain(format!("there is no file {}", path.display()))),
        };
    }
    let whole = format!("{}{pattern}", prefix(folder));
    let usual =
        MatchOptions { require_literal_separator: true, require_literal_leading_dot: true, case_sensitive: true };
    let paths =
        glob::glob_with(&whole, usual).map_err(|error| complain(format!("the pattern is wrong: {}", error.msg)))?;
    let mut found = Vec::new();
    for path in paths {
        let path =
            path.map_err(|error| Error::File { verb: "read", path: error.path().to_owned(), source: error.into() })?;
        let below = path.strip_prefix(folder).unwrap_or(&path);
        let in_library = below.parent().is_some_and(|folder| folder.iter().any(|part| part == LIBRARY));
        if Scenario::is_named(&path) && !in_library && path.is_file() {
            found.push((below.to_string_lossy().replace('\\', "/"), path));
        }
    }
    if found.is_empty() { Err(complain("no scenario is there".to_owned())) } else { Ok(found) }
}

/// A folder as the start of a pattern, its own signs taken literally.
fn prefix(folder: &Path) -> String {
    match folder.to_string_lossy().as_ref() {
        "" => String::new(),
        folder => format!("{}/", glob::Pattern::escape(folder)),
    }
}

/// Plots are drawn of columns that are there, over numbers.
fn check_plots(file: &PlanFile, columns: &Columns) -> Result<(), Error> {
    for drawn in file.plan.plots.iter().flatten() {
        for (name, as_number) in drawn.columns() {
            if columns.position(name).is_none() {
                let hint = nearest(name, columns.all.iter().map(|column| column.name.as_str()));
                return Err(file.complain(name, format!("the table has no column {name}"), hint));
            }
            if as_number && !plots::is_numeric(columns, name) {
                let hint = Some("words tell curves apart: Curves(x: …, y: […], by: …)".to_owned());
                return Err(file.complain(name, format!("{name} is a word; a plot needs numbers there"), hint));
            }
        }
    }
    Ok(())
}

fn check_names(file: &PlanFile, scenario_name: &str, scenario: &Scenario) -> Result<(), Error> {
    let params = &scenario.scene().params;
    let asked = file.plan.vary.iter().map(|axis| (&axis.name, ends(axis)));
    let fixed = file.plan.set.iter().map(|(name, value)| (name, vec![value.clone()]));
    for (name, values) in asked.chain(fixed).filter(|(name, _)| !axis::is_setting(name)) {
        let Some(param) = params.iter().find(|param| param.name == **name) else {
            let names = params.iter().map(|param| param.name.as_str()).chain(axis::settings().map(|name| name as &str));
            let message = format!("{scenario_name} has no param {name}");
            return Err(file.complain(name, message, nearest(name, names)));
        };
        let Some((min, max)) = param.range else { continue };
        for value in values {
            if let Value::Number(number) = value
                && !(min..=max).contains(&number)
            {
                let message = format!("{name}: {scenario_name} allows {min} … {max}, not {number}");
                return Err(file.complain(name, message, None));
            }
        }
    }
    Ok(())
}

/// The values between which all others of an axis lie.
fn ends(axis: &Axis) -> Vec<Value> {
    axis.range().map_or_else(|| axis.values.clone(), |(from, to)| vec![Value::Number(from), Value::Number(to)])
}

/// What can be read of a body.
pub const READABLE: [&str; 7] = ["x", "z", "angle", "vx", "vz", "spin", "speed"];

fn check_read(file: &PlanFile, scenario_name: &str, read: &str, scenario: &Scenario) -> Result<(), Error> {
    let Some((body, _)) = read.rsplit_once('.').filter(|(_, quantity)| READABLE.contains(quantity)) else {
        let hint = format!("write a body's name, a point and one of {}", READABLE.join(", "));
        return Err(file.complain(read, format!("{read} cannot be read"), Some(hint)));
    };
    let bodies = &scenario.scene().bodies;
    if bodies.iter().any(|known| known.name == body) {
        return Ok(());
    }
    let hint = nearest(body, bodies.iter().map(|body| body.name.as_str()));
    Err(file.complain(read, format!("{scenario_name} has no body {body}"), hint))
}

/// What was probably meant.
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    let near = known.map(|known| (strsim::jaro_winkler(known, name), known)).max_by(|a, b| a.0.total_cmp(&b.0));
    near.filter(|(likeness, _)| *likeness > 0.8).map(|(_, known)| format!("did you mean `{known}`?"))
}

/// FNV-1a, going on from what was read before.
fn fingerprint(digest: u64, text: &str) -> u64 {
    text.bytes().chain([0]).fold(digest, |digest, byte| (digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}
