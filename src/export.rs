//! `choque export`: the scene as plain data.

use std::path::Path;

use choque_scripting::{Options, Scenario};

use crate::files::replace;
use crate::output::ron;
use crate::play::callbacks_in_words;
use crate::terminal::{WARNING, styled, tell};
use crate::{Error, Verdict, terminal};

/// Writes a scenario's scene to a file, or to standard output when none or `-` is given.
///
/// A file is replaced in one go: whoever reads it sees the old scene or the new one, never half of it.
///
/// # Errors
/// A scenario that cannot be loaded or would not run; a file that cannot be written.
pub fn export(file: &Path, output: Option<&Path>, options: &Options) -> Result<Verdict, Error> {
    let output = output.filter(|path| *path != Path::new("-"));
    if let Some(path) = output {
        check_target(path)?;
    }
    let scenario = Scenario::load(file, options)?;
    scenario.start()?; // a scene that would not run is not worth keeping
    let text = ron::scene(scenario.scene())?;
    match output {
        None => terminal::answer(&text)?,
        Some(path) => {
            let unwritten = |source| Error::File { verb: "write", path: path.to_owned(), source };
            replace(path, text.as_bytes()).map_err(unwritten)?;
        }
    }
    if let Some(callbacks) = callbacks_in_words(&scenario) {
        let warning = styled(WARNING, "warning");
        tell(&format!("{warning}: a scene is plain data, without {callbacks} of the script\n"));
    }
    Ok(Verdict::Holds)
}

/// Refuses to write a scene over a script, or over anything that is no file.
fn check_target(path: &Path) -> Result<(), Error> {
    let refuse = |what: &str| {
        let message = format!("{} {what}", path.display());
        Err(Error::Call { message, hint: "a scene's file name ends in .ron: -o scene.ron".to_owned() })
    };
    match path.extension() {
        Some(extension) if extension == "ron" => {}
        _ => return refuse("is no name for a scene"),
    }
    if path.exists() && !path.is_file() { refuse("is there already and is no file") } else { Ok(()) }
}
