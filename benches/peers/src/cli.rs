//! The call and its flags.

use std::error::Error;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, ValueEnum};

use crate::accuracy::{self, page};
use crate::engine::{Engine, USUAL};
use crate::scene::Name;
use crate::speed::{self, Patience};
use crate::{equal, growth, table, written};

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
    /// How the speed table is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// What is measured. Other tables than `speed` have scenes of their own.
    #[arg(long, value_enum, default_value_t = Kind::Speed)]
    table: Kind,
    /// Folder for the table's part of `peers.md`, its plots (SVG, PNG) and its data (CSV).
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Time, memory and quality on the same scenes with the same steps.
    Speed,
    /// What it costs each engine to come below an error.
    EqualError,
    /// How the cost of pile-ups grows with the number of bodies.
    Growth,
    /// Cases whose answers are known: error against CPU time.
    Accuracy,
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
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("choque-peers: {error}");
            ExitCode::FAILURE
        }
    }
}

fn told(what: &str) {
    eprintln!("{what}");
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let text = match arguments.table {
        Kind::Speed => speed_table(arguments)?,
        Kind::EqualError => equal_table(arguments)?,
        Kind::Growth => growth_table(arguments)?,
        Kind::Accuracy => accuracy_table(arguments)?,
    };
    Ok(std::io::stdout().lock().write_all(text.as_bytes())?)
}

impl Arguments {
    fn engines(&self) -> &[Engine] {
        if self.engines.is_empty() { &USUAL } else { &self.engines }
    }

    fn patience(&self) -> Patience {
        Patience { repeats: self.repeats, steps: self.steps }
    }

    /// Puts a part into the page, when there is to be one.
    fn write(&self, text: impl FnOnce(&Path) -> Result<String, Box<dyn Error>>) -> Result<(), Box<dyn Error>> {
        let Some(folder) = &self.output else { return Ok(()) };
        let call = std::env::args().skip(1).collect::<Vec<_>>().join(" ");
        let word = self.table.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned());
        let command = format!("cargo run --release -p choque-peers -- {call}");
        written::part(folder, &word, command.trim_end_matches(" -- "), &text(folder)?)
    }
}

fn speed_table(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let names = if arguments.scenes.is_empty() { Name::value_variants() } else { &arguments.scenes };
    let scenes = names.iter().map(|name| (name.word(), name.scene()));
    let rows = speed::measure(scenes, arguments.engines(), arguments.threads, arguments.patience(), told)?;
    let table = table::speed(&rows);
    arguments.write(|_| Ok(format!("{SPEED}\n\n{}", table.markdown())))?;
    Ok(match arguments.format {
        Format::Text => table.text(),
        Format::Json => table::json(&rows)? + "\n",
    })
}

fn equal_table(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let table = equal::table(told)?;
    arguments.write(|_| Ok(format!("{EQUAL}\n\n{}", table.markdown())))?;
    Ok(table.text())
}

fn growth_table(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let engines = arguments.engines();
    let rows = growth::measure(engines, arguments.threads, arguments.patience(), told)?;
    let table = growth::table(&rows, engines);
    arguments.write(|folder| {
        let plot = written::plot(folder, "growth", &growth::figure(&rows, engines))?;
        Ok(format!("{GROWTH}\n\n{plot}\n{}", table.markdown()))
    })?;
    Ok(table.text())
}

fn accuracy_table(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let mut studied = Vec::new();
    for case in accuracy::cases() {
        told(case.title);
        let outcomes = accuracy::study(&case)?;
        studied.push((case, outcomes));
    }
    let (errors, comparison, in_short) = (page::errors(&studied), page::comparison(&studied), page::in_short(&studied));
    arguments.write(|folder| {
        let summary = written::plot(folder, "peers_summary", &page::summary(&studied))?;
        let mut plots = String::new();
        for (case, outcomes) in &studied {
            plots += &format!(
                "\n{}",
                written::plot(folder, &format!("peers_{}", case.name), &page::figure(case, outcomes))?
            );
        }
        written::data(folder, "peers.csv", &page::csv(&studied)?)?;
        let tables = format!("{}\n{ERRORS}\n\n{}", comparison.markdown(), errors.markdown());
        Ok(format!("{in_short}\n\n{summary}\n{COMPARED}\n\n{tables}\n{plots}"))
    })?;
    Ok(format!("{}\n{}\n{in_short}\n", errors.text(), comparison.text()))
}

const SPEED: &str = "Steps of 1/60 s, 4 sub-steps. Best: each step's shortest time over all runs, the mean of those without the first step. Median: that of the \
runs' means. Spread is the noise: how much longer the slowest run took than the fastest. `choque / it` compares best times. Deepest overlap, energy and shape are measured by the same \
code for all: shape error is the way of the top boxes [m] in pyramids, the number of boxes that left the drum, and in `smash` the greater \
change of linear and angular momentum over what the striker brings. Energy drift is what kinetic and potential energy changed by over what there was: with restitution below 1 \
and drag it falls as it should, above 0 it comes from nowhere. Contacts are pairs that touch at the end as each engine counts them.";

const EQUAL: &str = "The coarsest of fourteen settings, from 1/60 s in one part to 1/15360 s in four, whose error is below what is asked for, and the CPU time of that run. Not reached: \
none does before one takes more than 10 s of CPU time; the least error seen stands beside it.";

const GROWTH: &str = "Milliseconds of a step, best over all runs, by number of bodies; the exponent is that of the power of the number that fits best.";

const COMPARED: &str = "How many times lower choque's error is at the same CPU time, where that is least over all times at which both can make a run. `It alone from` a time: the \
peer has runs shorter than choque's shortest. Blocks of E1 and E4 and the bars of T11 are kept from turning under the peers, for a flat hit would make them spin; choque's turn freely. \
Restitution thresholds are 0 and caps on speed lifted; fast bodies are bullets.";

const ERRORS: &str = "Error · CPU time of a run, by time step.";
