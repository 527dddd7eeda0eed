//! Where a run and its snapshot part, for a test that fails; and what is left for people to look at where `CHOQUE_ARTIFACTS` names
//! a folder: the run's recording, the one kept beside the snapshot if there is one, and a page that plays them.

use std::fs;
use std::path::{Path, PathBuf};

use choque_scripting::{Options, Scenario};

use super::discover::Case;
use crate::diff::{page, pinned};
use crate::recording::{Recording, Settings, record};
use crate::{Error, written};

/// The words, and what was left where; `None` when the run is the same to the last bit.
pub(super) fn parted(case: &Case) -> Option<String> {
    let compared = compare(case);
    compared.unwrap_or_else(|error| Some(error.to_string()))
}

fn compare(case: &Case) -> Result<Option<String>, Error> {
    let scenario = Scenario::load(&case.script, &Options::default())?;
    let run = record(&scenario, &Settings { ledger: true, ..Settings::default() })?;
    let (found, kept) = pinned::against(&case.snapshot, &case.script.display().to_string(), &run)?;
    if found.same {
        return Ok(None);
    }
    let mut text = anstream::adapter::strip_str(&found.text).to_string();
    if let Some(folder) = std::env::var_os("CHOQUE_ARTIFACTS").filter(|folder| !folder.is_empty()) {
        text += &match leave(Path::new(&folder), case, &run, kept.as_ref(), found.iteration.unwrap_or(0)) {
            Ok(left) => left.iter().map(|path| format!("left {}\n", path.display())).collect(),
            Err(error) => format!("{error}\n"),
        };
    }
    Ok(Some(text))
}

fn leave(
    folder: &Path,
    case: &Case,
    run: &Recording,
    kept: Option<&Recording>,
    iteration: u64,
) -> Result<Vec<PathBuf>, Error> {
    let base = case.path.iter().fold(folder.to_owned(), |folder, part| folder.join(part));
    let above = base.parent().unwrap_or(folder);
    fs::create_dir_all(above).map_err(|source| Error::File { verb: "create", path: above.to_owned(), source })?;
    let named = |extension: &str| {
        let mut name = base.clone().into_os_string();
        name.push(extension);
        PathBuf::from(name)
    };
    let mut left = vec![named(".choque")];
    run.write(&left[0])?;
    if let Some(kept) = kept {
        left.push(named(".pinned.choque"));
        kept.write(&left[1])?;
    }
    let page = page(["snapshot", "run"], kept, run, iteration)?;
    left.push(named(".html"));
    written::replace(&named(".html"), page.as_bytes())?;
    Ok(left)
}
