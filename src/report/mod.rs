//! `choque report`: speed against error.
//!
//! | question | file |
//! |---|---|
//! | which time steps, which methods, which start? | [`ladder`], [`method`], [`recipe`] |
//! | how far off is a result? | [`poses`], [`course`] |
//! | what is it measured against, and has that earned it? | [`search`], [`mod@reference`], [`convergence`], [`closed_form`] |
//! | how far ahead can the scene be foretold? | [`horizon`]; then [`copies`], [`quantities`] and [`statistics`] speak instead |
//! | what does it cost? | [`timing`], counted work |
//! | how is all that put together? | [`assemble`]: [`survey`], [`errors`], [`mod@study`] |
//! | what is said of it? | [`told`], [`advice`], [`notes`], [`picture`], [`files`] |

pub mod advice;
pub mod assemble;
pub mod closed_form;
pub mod convergence;
pub mod copies;
pub mod course;
pub mod errors;
pub mod files;
pub mod format;
pub mod horizon;
pub mod jobs;
pub mod ladder;
pub mod method;
pub mod notes;
pub mod picture;
pub mod poses;
pub mod quantities;
pub mod random;
pub mod recipe;
pub mod reference;
pub mod search;
pub mod statistics;
pub mod study;
pub mod survey;
pub mod timing;
pub mod told;

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::arguments::ScenarioArguments;
use crate::terminal::{FAINT, answer, styled, tell};
use crate::{Error, Verdict};
use assemble::{Depth, study};
use recipe::Recipe;

/// What `report` is given.
#[derive(Clone, Debug, clap::Args)]
pub struct ReportArguments {
    /// Scenarios: `.rhai` scripts or `.ron` scenes
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Folder for the plot (SVG, PNG) and the numbers (CSV, RON); made when it does not exist
    #[arg(short, long, value_name = "DIR", default_value = "report")]
    pub output: PathBuf,
    /// Known places of bodies to measure errors against, as .csv or .ron: time,body,x,z,angle
    #[arg(long, value_name = "REFERENCE")]
    pub reference: Option<PathBuf>,
    /// A first impression: six time steps, three timings, eight copies
    #[arg(long)]
    pub quick: bool,
    /// Runs made at once; timings are always made one by one [default: as many as there are cores]
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Overrides and folders.
    #[command(flatten)]
    pub scenario: ScenarioArguments,
}

/// Studies every file, prints what came of it and writes the files.
///
/// # Errors
/// A scenario that cannot be loaded or run, before anything is measured; files that cannot be written.
pub fn report(arguments: &ReportArguments) -> Result<Verdict, Error> {
    let recipes: Vec<Recipe> = arguments.files.iter().map(|file| Recipe::new(file, &arguments.scenario)).collect();
    let mut names = BTreeSet::new();
    for recipe in &recipes {
        let scenario = recipe.as_written()?;
        scenario.start()?;
        if !names.insert(scenario.name().to_owned()) {
            return Err(Error::Call {
                message: format!("two scenarios are named {}: their files would replace each other", scenario.name()),
                hint: "report them one by one, each with an -o of its own".to_owned(),
            });
        }
    }
    if arguments.reference.is_some() && recipes.len() > 1 {
        return Err(Error::Call {
            message: "one --reference cannot hold for several scenarios".to_owned(),
            hint: "report them one by one".to_owned(),
        });
    }
    let depth = if arguments.quick { Depth::QUICK } else { Depth::FULL };
    let threads = arguments.threads.unwrap_or_else(jobs::cores);
    for (i, recipe) in recipes.iter().enumerate() {
        let study = study(recipe, arguments.reference.as_deref(), depth, threads)?;
        let paths = files::write(&study, &arguments.output)?;
        answer(&format!("{}{}", if i > 0 { "\n" } else { "" }, told::text(&study)))?;
        let written: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
        tell(&format!("{}\n", styled(FAINT, &format!("written: {}", written.join(", ")))));
    }
    Ok(Verdict::Holds)
}
