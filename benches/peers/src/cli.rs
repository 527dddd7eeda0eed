//! The call and its flags.

use std::error::Error;
use std::io::Write as _;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};

use crate::engine::{Engine, USUAL};
use crate::scene::Name;
use crate::speed::{self, Patience};
use crate::table;

/// Choque beside Box2D and Rapier: the same scenes in one process, engine after engine.
///
/// Every engine makes the same steps: 1/60 s, 4 sub-steps. `best` is the mean over steps of each step's shortest time over
/// all runs, `median` that of the runs' means, neither with the first step; `spread` is how much longer the slowest run took than the fastest.
/// Overlap, energy and shape are measured by the same code for all.
#[derive(Debug, Parser)]
#[command(name = "choque-peers", version)]
struct Arguments {
    /// Scene to run, any number of times; all of them when none is given.
    #[arg(long = "scene", value_name = "SCENE", value_enum)]
    scenes: Vec<Name>,
    /// Engine to run, any number of times; the four usual ones when none is given.
    #[arg(long = "engine", value_name = "ENGINE", value_enum)]
    engines: Vec<Engine>,
    /// Threads, for engines that can use several.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = at_least_one)]
    threads: usize,
    /// Runs of each engine on each scene.
    #[arg(long, value_name = "R", default_value_t = 5, value_parser = at_least_one)]
    repeats: usize,
    /// Steps of a run, instead of the scene's own number.
    #[arg(long, value_name = "N", value_parser = at_least_one)]
    steps: Option<usize>,
    /// How the table is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// How a table is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people.
    Text,
    /// For programs: one array.
    Json,
}

fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) | Err(_) => Err("a whole number from 1".to_owned()),
        Ok(number) => Ok(number),
    }
}

/// Runs the command.
pub fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("choque-peers: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: Arguments) -> Result<(), Box<dyn Error>> {
    let Arguments { scenes, engines, threads, repeats, steps, format } = arguments;
    let scenes = if scenes.is_empty() { Name::value_variants().to_vec() } else { scenes };
    let engines = if engines.is_empty() { USUAL.to_vec() } else { engines };
    let rows = speed::measure(&scenes, &engines, threads, Patience { repeats, steps }, |what| eprintln!("{what}"))?;
    let text = match format {
        Format::Text => table::speed(&rows).text(),
        Format::Json => table::json(&rows)? + "\n",
    };
    Ok(std::io::stdout().lock().write_all(text.as_bytes())?)
}
