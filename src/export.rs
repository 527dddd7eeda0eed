//! `choque export`: the scene as plain data.

use std::fs::Permissions;
use std::io::{self, Write};
use std::path::Path;

use choque_scripting::{Options, Scenario};

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
            replace(path, &text).map_err(unwritten)?;
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

/// Writes beside the file first and renames then; a link stays a link to what is replaced.
fn replace(path: &Path, text: &str) -> io::Result<()> {
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    let permissions = usual_permissions();
    if let Some(permissions) = permissions {
        builder.permissions(permissions);
    }
    let mut beside = builder.prefix(".choque-").suffix(".tmp").tempfile_in(folder)?;
    beside.write_all(text.as_bytes())?;
    beside.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// Those of any new file: temporary files are otherwise closed to everyone else.
#[cfg(unix)]
fn usual_permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666)) // less what the umask takes
}

#[cfg(not(unix))]
fn usual_permissions() -> Option<Permissions> {
    None
}
