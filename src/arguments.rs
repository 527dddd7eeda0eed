//! Flags shared by every call that loads a scenario.

use std::num::{IntErrorKind, ParseIntError};
use std::path::PathBuf;
use std::time::Duration;

use choque_engine::check;
use choque_engine::scene::{BroadPhaseChoice, Detection, ExchangeRule, MotionRule};
use choque_scripting::{Options, Overrides};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

/// Settings given from outside, and where to look for files.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Overrides")]
pub struct ScenarioArguments {
    /// How many iterations, whatever the script says
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    steps: Option<u64>,
    /// Length of one iteration [s]: 0.01 or 1/120
    #[arg(long, value_name = "DT", value_parser = number, allow_negative_numbers = true)]
    time_step: Option<f64>,
    /// In how many equal parts an iteration solves contacts, with stepped impulses
    #[arg(long, value_name = "N", value_parser = substeps, allow_negative_numbers = true)]
    substeps: Option<u32>,
    /// Where the generator of random numbers starts, whatever the main part of the script says
    #[arg(long, value_name = "N", value_parser = seed, allow_negative_numbers = true)]
    seed: Option<i64>,
    /// Value of a `param`, or of mu_l, mu_a, epsilon, restitution, friction; may be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    set: Vec<(String, f64)>,
    /// How motion is handed over
    #[arg(long, value_name = "MODEL", value_parser = choice(ExchangeRule::WORDS, ExchangeRule::from_word))]
    exchange: Option<ExchangeRule>,
    /// How overlaps are found
    #[arg(long, value_name = "MODEL", value_parser = choice(Detection::WORDS, Detection::from_word))]
    detection: Option<Detection>,
    /// When collisions are treated
    #[arg(long, value_name = "MODEL", value_parser = choice(MotionRule::WORDS, MotionRule::from_word))]
    motion: Option<MotionRule>,
    /// How pairs worth testing are found; the result never depends on it
    #[arg(long, value_name = "WAY", value_parser = choice(BroadPhaseChoice::WORDS, BroadPhaseChoice::from_word))]
    broad_phase: Option<BroadPhaseChoice>,
    #[command(flatten)]
    script: ScriptArguments,
}

/// What a script may read, and how long it may take.
#[derive(Args, Clone, Debug)]
pub struct ScriptArguments {
    /// Where imports and models are looked up after the script's own folder
    /// [default: the nearest folder above the script that is named `scenarios`]
    #[arg(long, value_name = "DIR")]
    library: Option<PathBuf>,
    /// Time a script's main part, and each single callback, may take [s]
    #[arg(long, value_name = "S", default_value = "10", value_parser = seconds)]
    script_timeout: Duration,
}

impl Default for ScriptArguments {
    fn default() -> Self {
        ScriptArguments { library: None, script_timeout: Options::default().script_timeout }
    }
}

impl ScriptArguments {
    /// The same, as the scripting crate wants it.
    #[must_use]
    pub fn options(&self) -> Options {
        Options { library: self.library.clone(), script_timeout: self.script_timeout, ..Options::default() }
    }
}

impl Default for ScenarioArguments {
    /// Nothing overridden.
    fn default() -> Self {
        ScenarioArguments {
            steps: None,
            time_step: None,
            substeps: None,
            seed: None,
            set: Vec::new(),
            exchange: None,
            detection: None,
            motion: None,
            broad_phase: None,
            script: ScriptArguments::default(),
        }
    }
}

impl ScenarioArguments {
    /// The same, as the scripting crate wants it.
    #[must_use]
    pub fn options(&self) -> Options {
        Options {
            set: self.set.clone(),
            overrides: Overrides {
                steps: self.steps,
                time_step: self.time_step,
                substeps: self.substeps,
                seed: self.seed,
                exchange: self.exchange,
                detection: self.detection,
                motion: self.motion,
                broad_phase: self.broad_phase,
            },
            ..self.script.options()
        }
    }
}

/// Takes one of a setting's words.
fn choice<T: Clone + Send + Sync + 'static>(
    words: &'static [&'static str],
    from_word: fn(&str) -> Option<T>,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(words).try_map(move |word| from_word(&word).ok_or("not one of the words above"))
}

pub(crate) fn count(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|error: ParseIntError| match error.kind() {
        IntErrorKind::PosOverflow => format!("it must be at most {}", u64::MAX),
        _ => "it must be a whole number, 0 or more".to_owned(),
    })
}

fn seed(text: &str) -> Result<i64, String> {
    text.trim().parse().map_err(|_| format!("it must be a whole number between {} and {}", i64::MIN, i64::MAX))
}

pub(crate) fn substeps(text: &str) -> Result<u32, String> {
    let count = text.trim().parse().ok().and_then(|count| check::substeps("it", count).ok());
    count.ok_or_else(|| "it must be a whole number between 1 and 1000".to_owned())
}

/// How many threads share an iteration.
pub(crate) fn threads(text: &str) -> Result<usize, String> {
    let threads = text.trim().parse().ok().filter(|threads| *threads > 0);
    threads.ok_or_else(|| "it must be a whole number, 1 or more".to_owned())
}

/// A time [s], not before the start.
pub(crate) fn time(text: &str) -> Result<f64, String> {
    check::not_negative("it", number(text)?).map_err(|bad| bad.to_string())
}

/// Every how many iterations.
pub(crate) fn every(text: &str) -> Result<u64, String> {
    let every = text.trim().parse().ok().filter(|every| *every > 0);
    every.ok_or_else(|| "it must be a whole number, 1 or more".to_owned())
}

/// A finite number, also as a quotient: `1/120`.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let read = |part: &str| part.trim().parse::<f64>().map_err(|_| format!("`{}` is not a number", part.trim()));
    let value = match text.split_once('/') {
        Some((above, below)) => read(above)? / read(below)?,
        None => read(text)?,
    };
    check::finite("it", value).map_err(|bad| bad.to_string())
}

fn assignment(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write it as NAME=VALUE, for example --set push=12")?;
    match name.trim() {
        "" => Err("the name before `=` is missing; for example --set push=12".to_owned()),
        name => Ok((name.to_owned(), number(value)?)),
    }
}

/// A time, longer than none.
pub(crate) fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = check::positive("it", number(text)?).map_err(|bad| bad.to_string())?;
    Duration::try_from_secs_f64(seconds).map_err(|_| "that is longer than any run".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_may_be_quotients() {
        assert_eq!(number("1/120"), Ok(1.0 / 120.0));
        assert_eq!(number(" -2.5e3 "), Ok(-2500.0));
        for refused in ["", "1/0", "nan", "1/2/3", "0/0", "1e999", "two"] {
            assert!(number(refused).is_err(), "{refused}");
        }
    }

    #[test]
    fn assignments_have_a_name_and_a_number() {
        assert_eq!(assignment("push=1/4"), Ok(("push".to_owned(), 0.25)));
        for refused in ["push", "=3", "push=", "push=x"] {
            assert!(assignment(refused).is_err(), "{refused}");
        }
    }

    #[test]
    fn substeps_and_threads_are_counted_from_1() {
        assert_eq!((substeps("1000"), threads(" 2 ")), (Ok(1000), Ok(2)));
        for refused in ["0", "-1", "2.5", "many", "", "99999999999999999999"] {
            assert!(substeps(refused).is_err() && threads(refused).is_err(), "{refused}");
        }
        assert!(substeps("1001").is_err());
    }

    #[test]
    fn a_timeout_is_a_positive_time() {
        assert_eq!(seconds("0.5"), Ok(Duration::from_millis(500)));
        for refused in ["0", "-1", "inf", "1e300"] {
            assert!(seconds(refused).is_err(), "{refused}");
        }
    }
}
