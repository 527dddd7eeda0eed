//! Which scenarios a package has, and which snapshots have lost theirs.

use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::Error;

/// A folder of this name holds what scenarios import, not scenarios.
const LIBRARY: &str = "lib";

/// One scenario to test.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Case {
    /// The script.
    pub script: PathBuf,
    /// Where it is pinned: `snapshots/blades/spinning_blade.snap`.
    pub snapshot: PathBuf,
    /// Its path below `scenarios` without the extension: `["blades", "spinning_blade"]`.
    pub path: Vec<String>,
}

impl Case {
    /// The test's name: `blades::spinning_blade`.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.join("::")
    }
}

/// Where a script is pinned: beside the nearest folder named `scenarios` that it is in, at the same path below `snapshots`; a relative
/// path where the script's own tells. `None` of a script that is in no such folder.
#[must_use]
pub fn snapshot_of(script: &Path) -> Option<PathBuf> {
    let beside = |script: &Path| {
        let is_named = |folder: &&Path| folder.file_name().is_some_and(|name| name == "scenarios");
        let scenarios = script.ancestors().skip(1).find(is_named)?;
        let below = script.strip_prefix(scenarios).ok()?;
        let is_plain = below.components().all(|part| matches!(part, Component::Normal(_)));
        is_plain.then(|| scenarios.with_file_name("snapshots").join(below).with_extension("snap"))
    };
    beside(script).or_else(|| beside(&script.canonicalize().ok()?))
}

/// The scenarios of a package, in the order of their paths.
///
/// # Errors
/// A folder `scenarios` that is not there or cannot be read.
pub fn cases(package: &Path) -> Result<Vec<Case>, Error> {
    let scenarios = package.join("scenarios");
    let scripts = files(&scenarios, "rhai").map_err(|source| Error::File { verb: "read", path: scenarios, source })?;
    Ok(scripts.into_iter().map(|path| case(package, path)).filter(|case| !is_library(case)).collect())
}

/// The snapshots of a package that no scenario is pinned by any more.
///
/// # Errors
/// A folder that cannot be read.
pub fn unreferenced(package: &Path) -> Result<Vec<PathBuf>, Error> {
    let pinned: Vec<PathBuf> = cases(package)?.into_iter().map(|case| case.snapshot).collect();
    let snapshots = package.join("snapshots");
    let there = match files(&snapshots, "snap") {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            return Err(Error::File { verb: "read", path: snapshots, source });
        }
        there => there.unwrap_or_default(),
    };
    Ok(there.into_iter().map(|path| snapshots.join(path)).filter(|path| !pinned.contains(path)).collect())
}

fn case(package: &Path, below: PathBuf) -> Case {
    let bare = below.with_extension("");
    Case {
        snapshot: package.join("snapshots").join(&bare).with_extension("snap"),
        path: bare.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect(),
        script: package.join("scenarios").join(below),
    }
}

fn is_library(case: &Case) -> bool {
    case.path.iter().rev().skip(1).any(|folder| folder == LIBRARY)
}

/// All files with that extension below a folder, relative to it, sorted; hidden ones and links to folders left out.
fn files(folder: &Path, extension: &str) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(below) = folders.pop() {
        for entry in fs::read_dir(folder.join(&below))? {
            let entry = entry?;
            let path = below.join(entry.file_name());
            if entry.file_name().to_string_lossy().starts_with('.') {
                continue;
            }
            if entry.file_type()?.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == extension) {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}
