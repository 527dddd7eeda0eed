//! `choque words`: every word of a script, with its documentation.

use std::path::Path;

use choque_scripting::words::{self, Word};

use crate::output::text::indented;
use crate::terminal::{HEADING, answer, styled, tell};
use crate::{Error, Verdict};

/// Prints every word, one word, or those with `name` in their name; or writes definitions for editors.
///
/// # Errors
/// A name that no word resembles; a folder that cannot be written.
pub fn words(name: Option<&str>, definitions: Option<&Path>) -> Result<Verdict, Error> {
    if let Some(folder) = definitions {
        return write_definitions(folder);
    }
    let all = words::all();
    let chosen = match name {
        None => all.iter().collect(),
        Some(name) => matching(&all, name)?,
    };
    answer(&page(&chosen))?;
    Ok(Verdict::Holds)
}

fn write_definitions(folder: &Path) -> Result<Verdict, Error> {
    let failed = |source| Error::File { verb: "write definitions to", path: folder.to_owned(), source };
    std::fs::create_dir_all(folder).map_err(failed)?;
    for file in words::write_definitions(folder).map_err(failed)? {
        tell(&format!("wrote {}\n", file.display()));
    }
    Ok(Verdict::Holds)
}

/// The words of that name; if there are none, those that contain it.
fn matching<'a>(all: &'a [Word], name: &str) -> Result<Vec<&'a Word>, Error> {
    let name = name.trim_start_matches('.');
    let exact: Vec<&Word> = all.iter().filter(|word| word.name == name).collect();
    if !exact.is_empty() {
        return Ok(exact);
    }
    let part: Vec<&Word> = all.iter().filter(|word| !name.is_empty() && word.name.contains(name)).collect();
    if !part.is_empty() {
        return Ok(part);
    }
    let nearest = all
        .iter()
        .map(|word| word.name.as_str())
        .max_by(|a, b| strsim::jaro_winkler(a, name).total_cmp(&strsim::jaro_winkler(b, name)));
    let hint = match nearest {
        Some(nearest) => format!("perhaps `{nearest}`; `choque words` prints them all"),
        None => "`choque words` prints them all".to_owned(),
    };
    Err(Error::Call { message: format!("there is no word `{name}`"), hint })
}

/// The words under the headings of their groups.
fn page(words: &[&Word]) -> String {
    let mut text = String::new();
    let mut group = "";
    for word in words {
        if word.group != group {
            group = word.group;
            text += &format!("{}\n\n", styled(HEADING, group));
        }
        for signature in &word.signatures {
            text += &format!("{}\n", styled(HEADING, signature));
        }
        text += &format!("{}\n", indented(word.docs.trim()));
    }
    text
}
