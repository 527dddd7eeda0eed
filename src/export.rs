//! `choque export`: the scene as plain data.

use std::path::Path;

use choque_scripting::{Options, Scenario};

use crate::output::ron;
use crate::play::callbacks_in_words;
use crate::terminal::{WARNING, styled, tell};
use crate::written::{self, Kind};
use crate::{Error, Verdict, terminal};

const SCENE: Kind = Kind { what: "scene", extension: "ron", flag: "-o" };

/// Writes a scenario's scene to a file, or to standard output when none or `-` is given.
///
/// A file is replaced in one go: whoever reads it sees the old scene or the new one, never half of it.
///
/// # Errors
/// A scenario that cannot be loaded or would not run; a file that cannot be written.
pub fn export(file: &Path, output: Option<&Path>, options: &Options) -> Result<Verdict, Error> {
    let output = output.filter(|path| *path != Path::new("-"));
    if let Some(path) = output {
        SCENE.check(path)?;
    }
    let scenario = Scenario::load(file, options)?;
    scenario.start()?; // a scene that would not run is not worth keeping
    let text = ron::scene(scenario.scene())?;
    match output {
        None => terminal::answer(&text)?,
        Some(path) => written::replace(path, text.as_bytes())?,
    }
    if let Some(callbacks) = callbacks_in_words(&scenario) {
        let warning = styled(WARNING, "warning");
        tell(&format!("{warning}: a scene is plain data, without {callbacks} of the script\n"));
    }
    Ok(Verdict::Holds)
}
