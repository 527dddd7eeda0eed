//! The two runs that are compared.

use std::path::{Path, PathBuf};

use choque_engine::scene::{BroadPhaseChoice, Detection, ExchangeRule, MotionRule};
use choque_scripting::{Options, Scenario};

use crate::Error;
use crate::arguments::{count, number, substeps};
use crate::recording::{Recording, Settings, about, record};
use crate::render::source::is_recording;

/// One of the two.
#[derive(Clone, Debug)]
pub struct Side {
    /// How it is called in what is told: the file, and what is set.
    pub name: String,
    file: PathBuf,
    options: Options,
    is_given: bool,
}

impl Side {
    /// A file, with what both sides are given and what only this one is.
    ///
    /// # Errors
    /// A setting that has no such value.
    pub fn new(file: &Path, both: &Options, own: &[(String, String)]) -> Result<Self, Error> {
        let mut options = both.clone();
        for (name, value) in own {
            set(&mut options, name, value).map_err(|why| Error::Call {
                message: format!("{name}={value}: {why}"),
                hint: "a param, a setting of --set, or steps, time_step, substeps, exchange, detection, motion, broad_phase"
                    .to_owned(),
            })?;
        }
        let given = both.set.iter().map(|(name, value)| format!(" {name}={value}"));
        let said: String = given.chain(own.iter().map(|(name, value)| format!(" {name}={value}"))).collect();
        let is_given = !options.set.is_empty() || options.overrides != choque_scripting::Overrides::default();
        Ok(Side { name: format!("{}{said}", file.display()), file: file.to_owned(), options, is_given })
    }

    /// What it comes to, every iteration of it.
    ///
    /// # Errors
    /// A file that cannot be read or run; a recording that something should be set in.
    pub fn recording(&self) -> Result<Recording, Error> {
        if !is_recording(&self.file) {
            let scenario = Scenario::load(&self.file, &self.options)?;
            return record(&scenario, &Settings { ledger: true, command: about::this_call(), every: 1 });
        }
        if self.is_given {
            let message = format!("{} is a recording: nothing in it can be set", self.file.display());
            return Err(Error::Call { message, hint: "give the script, or record it again".to_owned() });
        }
        Recording::read(&self.file)
    }
}

/// `NAME=VALUE`, the value still as it was written.
pub(super) fn side_setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => Ok((name.trim().to_owned(), value.trim().to_owned())),
        _ => Err("write it as NAME=VALUE, for example mu_l=0.9 or motion=continuous".to_owned()),
    }
}

fn set(options: &mut Options, name: &str, value: &str) -> Result<(), String> {
    let given = &mut options.overrides;
    match name {
        "steps" => given.steps = Some(count(value)?),
        "time_step" => given.time_step = Some(number(value)?),
        "substeps" => given.substeps = Some(substeps(value)?),
        "exchange" => given.exchange = Some(word(value, ExchangeRule::WORDS, ExchangeRule::from_word)?),
        "detection" => given.detection = Some(word(value, Detection::WORDS, Detection::from_word)?),
        "motion" => given.motion = Some(word(value, MotionRule::WORDS, MotionRule::from_word)?),
        "broad_phase" => given.broad_phase = Some(word(value, BroadPhaseChoice::WORDS, BroadPhaseChoice::from_word)?),
        _ => options.set.push((name.to_owned(), number(value)?)),
    }
    Ok(())
}

fn word<T>(value: &str, words: &[&str], from_word: fn(&str) -> Option<T>) -> Result<T, String> {
    from_word(value).ok_or_else(|| format!("it must be one of {}", words.join(", ")))
}
