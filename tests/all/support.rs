//! What several modules need: the command as a process, packages in temporary folders.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

/// The command under test, where neither colours nor the variables of a surrounding test run reach it.
pub(crate) fn choque() -> Command {
    isolated(Command::new(env!("CARGO_BIN_EXE_choque")))
}

/// A process that does not notice that it is started by a test, nor on which machine.
pub(crate) fn isolated(mut command: Command) -> Command {
    for variable in ["CI", "TF_BUILD", "INSTA_UPDATE", "INSTA_FORCE_PASS", "INSTA_OUTPUT", "CLICOLOR_FORCE", "NO_COLOR"]
    {
        command.env_remove(variable);
    }
    command
}

/// A temporary folder with these files in it.
pub(crate) fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().expect("a temporary folder");
    for (file, text) in files {
        write(&folder.path().join(file), text);
    }
    folder
}

/// Writes a file and the folders above it.
pub(crate) fn write(path: &Path, text: &str) {
    fs::create_dir_all(path.parent().expect("a folder above")).expect("folders can be made");
    fs::write(path, text).expect("the file can be written");
}

/// Standard output as text.
pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Standard error as text.
pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Fewer iterations than this would not let a large scene collide.
const FEWEST: u64 = 30;

/// A scene's iterations, but no more than come to so many bodies times iterations.
pub(crate) fn iterations_within(budget: u64, scene: &choque_engine::Scene) -> u64 {
    scene.settings.steps.min(FEWEST.max(budget / scene.bodies.len().max(1) as u64))
}
