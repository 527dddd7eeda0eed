//! The run that is looked at: read from a recording, or played.

use std::path::Path;

use choque_scripting::{Options, Scenario};

use crate::Error;
use crate::recording::{Recording, Settings, about, record};

/// Bodies times frames that are kept of a run that is played to be looked at: 400 MB.
const MOST_STATES: u64 = 8_000_000;

/// The recording, or what a script or scene comes to with these options.
///
/// # Errors
/// A recording that cannot be read, or that something should be overridden in; a scenario that cannot be run.
pub fn recording(file: &Path, options: &Options) -> Result<Recording, Error> {
    if !is_recording(file) {
        let scenario = Scenario::load(file, options)?;
        let states = scenario.scene().settings.steps.saturating_mul(scenario.scene().bodies.len() as u64);
        let every = states.div_ceil(MOST_STATES).max(1);
        return record(&scenario, &Settings { every, ledger: true, command: about::this_call() });
    }
    if !options.set.is_empty() || options.overrides != choque_scripting::Overrides::default() {
        let message = format!("{} is a recording: nothing in it can be set", file.display());
        return Err(Error::Call {
            message,
            hint: "give the script, or record it again with other settings".to_owned(),
        });
    }
    Recording::read(file)
}

/// Whether a file's name says that it is a recording.
#[must_use]
pub fn is_recording(file: &Path) -> bool {
    file.extension().is_some_and(|extension| extension == "choque")
}
