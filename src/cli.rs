//! The calls the command understands, and what each is handed to.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

use crate::arguments::{ScenarioArguments, threads};
use crate::diff::DiffArguments;
use crate::fit::FitArguments;
use crate::render::RenderArguments;
use crate::report::ReportArguments;
use crate::run::RunArguments;
use crate::studio::StudioArguments;
use crate::sweep::{MergeArguments, SweepArguments};
use crate::{
    Error, Verdict, check, diff, explain, export, fit, init, render, report, run, studio, sweep, terminal, words,
};

const EXAMPLES: &str = "\
Examples:
  choque init my_game                               lay out a project with a first scenario
  choque run scenarios/first.rhai                   run it and print what came of it
  choque run first.rhai --set push=12 --steps 1200  … with other numbers
  choque run first.rhai --format json | jq .digest  … for another program
  choque check scenarios/*.rhai                     what is wrong, and what will not do what it seems
  choque words rect                                 what a word means

Exit codes: 0 ran and every expectation holds, 1 an expectation failed, 2 the input or the call is wrong.";

/// Rectangle collisions for game designers: scenarios are scripts, results are the same bits everywhere.
#[derive(Debug, Parser)]
#[command(name = "choque", version, about, after_help = EXAMPLES, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    call: Call,
}

#[derive(Debug, Subcommand)]
enum Call {
    /// Run a scenario and print a summary
    #[command(after_help = "\
Examples:
  choque run scenarios/blades/spinning_blade.rhai
  choque run pile.rhai --time-step 1/240 --steps 2400 --set mu_l=0.5
  choque run pile.rhai --format json > result.json")]
    Run(RunArguments),
    /// Compile and validate scenarios; warn where the physics will not do what the script hopes
    #[command(after_help = "Examples:\n  choque check scenarios/*.rhai scenarios/*/*.rhai")]
    Check {
        /// Scenarios: `.rhai` scripts or `.ron` scenes
        #[arg(value_name = "FILE", required = true)]
        files: Vec<PathBuf>,
        #[command(flatten)]
        scenario: ScenarioArguments,
    },
    /// Say what a scene needs, what is therefore modelled, what is left out, and where the time goes
    Explain {
        /// A `.rhai` script or a `.ron` scene
        file: PathBuf,
        /// Threads that share an iteration; the result never depends on it
        #[arg(long, value_name = "N", default_value = "1", value_parser = threads, allow_negative_numbers = true)]
        threads: usize,
        #[command(flatten)]
        scenario: ScenarioArguments,
    },
    /// Measure speed against error: every method with time steps from 1/30 to 1/15360, and what the scene needs
    #[command(after_help = "\
Examples:
  choque report scenarios/hard/c1_vertex_meets_face.rhai
  choque report pile.rhai --quick -o measured
  choque report gas.rhai --reference known.csv")]
    Report(ReportArguments),
    /// Draw a run: one moment as SVG or PNG, all of it as a GIF or a page that plays it
    #[command(after_help = "\
Examples:
  choque render scenarios/blades/spinning_blade.rhai -o blade.svg
  choque render pile.rhai --set push=12 --at 1.5 -o pile.png
  choque render run.choque -o run.gif --width 640")]
    Render(RenderArguments),
    /// Say where two runs part: in which iteration, which stage, which body, by how much, and how that grew
    #[command(after_help = "\
Examples:
  choque diff pile.rhai --set-b mu_l=0.9                one script, two settings
  choque diff pile.rhai --set-b motion=continuous
  choque diff before.choque after.choque -o diff.html   two versions of the program
  choque diff scenarios/pile.rhai --snapshot            a script and what pins it

Exit codes: 0 the same to the last bit, 1 they differ, 2 the input or the call is wrong.")]
    Diff(DiffArguments),
    /// Serve a page on this machine that plays scenarios, tunes them and writes them back
    #[command(after_help = "\
Examples:
  choque studio                          the nearest folder named scenarios
  choque studio my_game --port 8000      another one, always at the same port")]
    Studio(StudioArguments),
    /// Find the values with which a scenario does what its script wants, or what a recording shows
    #[command(after_help = "\
Examples:
  choque fit kerb.rhai                                   what its target(…) wants, by what it lets vary(…)
  choque fit kerb.rhai -o fit.svg --write                … drawn, and the values put into the script
  choque fit pile.rhai --recording seen.choque --vary mu_l=0..1 --vary mu_a=0..1

Exit codes: 0 every residual is within the tolerance, 1 one is not, 2 the input or the call is wrong.")]
    Fit(FitArguments),
    /// Run scenarios with many numbers, a row for each run, as a plan says
    #[command(after_help = "\
Examples:
  choque sweep scenarios/sweeps/two_car_crash.ron
  choque sweep crash.ron -o crash.parquet --jobs 4
  choque sweep crash.ron -o crash --shard 2/8     on one machine of eight; choque merge crash when all are done")]
    Sweep(SweepArguments),
    /// Put the shards of a sweep together
    Merge(MergeArguments),
    /// Write a scenario's scene as plain data, without callbacks
    #[command(after_help = "\
Examples:
  choque export scenarios/first.rhai -o first.ron
  choque run first.ron")]
    Export {
        /// A `.rhai` script or a `.ron` scene
        file: PathBuf,
        /// Where to; `-` or nothing is standard output
        #[arg(short, long, value_name = "SCENE.ron")]
        output: Option<PathBuf>,
        #[command(flatten)]
        scenario: ScenarioArguments,
    },
    /// Print every word of a script with its documentation
    Words {
        /// One word, or a part of some
        name: Option<String>,
        /// Write `.d.rhai` files for editors into this folder instead
        #[arg(long, value_name = "DIR")]
        definitions: Option<PathBuf>,
    },
    /// Lay out a project: a first scenario, and a test that pins it
    #[command(after_help = "\
Examples:
  choque init my_game && cd my_game && cargo test")]
    Init {
        /// The project's folder; made when it does not exist
        #[arg(value_name = "DIR")]
        directory: PathBuf,
        /// Take `choque` from this folder instead of the registry
        #[arg(long, value_name = "PATH")]
        choque_path: Option<PathBuf>,
    },
    /// Print completions for a shell
    Completions {
        /// Which shell
        shell: Shell,
    },
}

/// The whole command: reads the arguments of the process, does what they ask, says what went wrong.
#[must_use]
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(usage) => {
            let _ = usage.print(); // a closed pipe is no reason for another message
            return if usage.use_stderr() { Verdict::BadInput.into() } else { ExitCode::SUCCESS };
        }
    };
    match cli.call.carry_out() {
        Ok(verdict) => verdict.into(),
        Err(error) => {
            terminal::tell_error(&error);
            Verdict::BadInput.into()
        }
    }
}

impl Call {
    fn carry_out(&self) -> Result<Verdict, Error> {
        match self {
            Call::Run(arguments) => run::run(arguments),
            Call::Check { files, scenario } => check::check(files, &scenario.options()),
            Call::Explain { file, threads, scenario } => explain::explain(file, *threads, &scenario.options()),
            Call::Report(arguments) => report::report(arguments),
            Call::Render(arguments) => render::render(arguments),
            Call::Diff(arguments) => diff::diff(arguments),
            Call::Studio(arguments) => studio::studio(arguments),
            Call::Fit(arguments) => fit::fit(arguments),
            Call::Sweep(arguments) => sweep::sweep(arguments),
            Call::Merge(arguments) => sweep::merge(arguments),
            Call::Export { file, output, scenario } => export::export(file, output.as_deref(), &scenario.options()),
            Call::Words { name, definitions } => words::words(name.as_deref(), definitions.as_deref()),
            Call::Init { directory, choque_path } => init::init(directory, choque_path.as_deref()),
            Call::Completions { shell } => completions(*shell),
        }
    }
}

fn completions(shell: Shell) -> Result<Verdict, Error> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "choque", &mut script);
    terminal::answer(&String::from_utf8_lossy(&script))?;
    Ok(Verdict::Holds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_calls_are_consistent() {
        Cli::command().debug_assert();
    }
}
