//! The studies of the hard suite and of the main scenarios.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use choque::arguments::ScenarioArguments;
use choque::report::assemble::study;
use choque::report::format::{error, times};
use choque::report::recipe::Recipe;
use choque::report::study::{Study, machine};
use choque::report::{jobs, method, picture, told};
use choque_engine::scene::{Detection, MotionRule};
use choque_scripting::{Options, Scenario};

use crate::Effort;
use crate::page::{self, Parts, table};

/// The scenarios a designer starts from.
const MAIN: [&str; 6] = [
    "blades/spinning_blade",
    "blades/mill",
    "vehicles/pileup_12",
    "vehicles/crossroads",
    "walls/patrol_doors",
    "walls/swing_gate",
];

/// A scene that takes longer than this is left out: with the shortest time step it would run for hours \[s\].
const LONGEST: f64 = 12.0;

/// Isolated collisions: the names of their scenarios begin so.
const ISOLATED: [&str; 3] = ["c1_", "c2_", "e"];

pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Studies everything.
pub(crate) fn parts(effort: Effort, pictures: &Path) -> Result<Parts, Box<dyn Error>> {
    let mut files = files("hard")?;
    let long = set_long_aside(&mut files)?;
    let hard = studies(&files, effort)?;
    let main: Vec<PathBuf> = MAIN.iter().map(|name| root().join(format!("scenarios/{name}.rhai"))).collect();
    let main = studies(&main, effort)?;
    let mut parts = Parts::new();
    parts.insert("machine".to_owned(), machine());
    let left_out = format!("Left out, for they take longer than {LONGEST} s: {}.", long.join(", "));
    parts.insert("hard".to_owned(), format!("{left_out}\n\n{}", told_all(&hard, pictures)?));
    parts.insert("main".to_owned(), told_all(&main, pictures)?);
    parts.insert("claim".to_owned(), claim(&hard));
    Ok(parts)
}

fn files(folder: &str) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let entries = fs::read_dir(root().join("scenarios").join(folder))?;
    let mut files = entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>, std::io::Error>>()?;
    files.retain(|file| file.extension().is_some_and(|extension| extension == "rhai"));
    files.sort();
    Ok(files)
}

/// Keeps the files of scenes that do not take too long; gives the names of the others.
fn set_long_aside(files: &mut Vec<PathBuf>) -> Result<Vec<String>, Box<dyn Error>> {
    let mut long = Vec::new();
    for file in core::mem::take(files) {
        let scenario = Scenario::load(&file, &Options::default())?;
        let settings = &scenario.scene().settings;
        match settings.time_step * settings.steps as f64 {
            time if time > LONGEST => long.push(format!("`{}`", scenario.name())),
            _ => files.push(file),
        }
    }
    Ok(long)
}

fn studies(files: &[PathBuf], effort: Effort) -> Result<Vec<Study>, Box<dyn Error>> {
    let chosen = files.iter().step_by(effort.every);
    let studied = chosen.map(|file| {
        println!("{}", file.strip_prefix(root()).unwrap_or(file).display());
        let recipe = Recipe::new(file, &ScenarioArguments::default());
        study(&recipe, None, effort.depth, jobs::cores()).map_err(|error| error.to_string().into())
    });
    studied.collect()
}

/// A section per scenario: what it is measured against, a table, a plot where there are errors, the advice.
fn told_all(studies: &[Study], pictures: &Path) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    for study in studies {
        text += &format!("### {}\n\n`{}`, {}: ", study.title, study.scenario, study.exchange);
        text += &format!("{}.\n\n", told::references(study).join("; "));
        text += &format!("{}\n\n", summary(study));
        if study.rows.iter().any(|row| row.error.is_some()) {
            text += &format!("{}\n\n", page::picture(pictures, &study.scenario, &picture::figure(study))?);
        }
        text += &format!("In one sentence: {}\n\n", study.advice);
    }
    Ok(text.trim_end().to_owned())
}

/// A line per method.
fn summary(study: &Study) -> String {
    let head = [
        "method",
        "error at 1/60",
        "order",
        "halving 1/60 moves",
        "CPU per s at 1/60",
        "CPU per s for 1e-3",
        "for 1e-6",
    ];
    let row = |summary: &choque::report::study::Summary| {
        let off = |time_step: f64| libm::log(60.0 * time_step).abs();
        let usual = study.rows_of(summary.method).min_by(|a, b| off(a.time_step).total_cmp(&off(b.time_step)));
        vec![
            summary.method.name(),
            error(summary.error_at_sixtieth),
            summary.order.map_or("–".to_owned(), |order| format!("{order:.2}")),
            error(usual.and_then(|row| row.moved_by_halving)),
            usual.map_or("–".to_owned(), |row| choque::output::numbers::duration(row.cpu_per_second)),
            told::reach(summary.reaches_1e_3),
            told::reach(summary.reaches_1e_6),
        ]
    };
    table(&head, &study.methods.iter().map(row).collect::<Vec<_>>())
}

/// Continuous beside stepped at an error of 1e-6, for scenes of isolated collisions.
fn claim(studies: &[Study]) -> String {
    let isolated = |study: &&Study| ISOLATED.iter().any(|start| study.scenario.starts_with(start));
    let reach = |study: &Study, motion| {
        let method = method::Method { motion, detection: Detection::Complete };
        study.summary_of(method).map(|summary| summary.reaches_1e_6)
    };
    let row = |study: &Study| {
        let (stepped, continuous) = (reach(study, MotionRule::Stepped)?, reach(study, MotionRule::Continuous)?);
        let ratio = match (stepped.cost(), continuous.cost()) {
            (Some(stepped), Some(continuous)) => times(stepped / continuous),
            (None, Some(_)) => "stepped never comes so close".to_owned(),
            _ => "–".to_owned(),
        };
        Some(vec![study.title.clone(), told::reach(stepped), told::reach(continuous), ratio])
    };
    let rows: Vec<Vec<String>> = studies.iter().filter(isolated).filter_map(row).collect();
    table(&["scene", "stepped, CPU per s for 1e-6", "continuous", "times cheaper"], &rows)
}
