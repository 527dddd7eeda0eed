//! `choque init`: lays out a project of scenarios, and the test that pins them.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::terminal::tell;
use crate::{Error, Verdict};

/// Every file of a new project, with `{name}` and `{choque}` to be filled in.
const FILES: [(&str, &str); 6] = [
    ("Cargo.toml", include_str!("project.toml.in")),
    (".gitignore", "/target\n*.snap.new\n"),
    ("README.md", include_str!("readme.md.in")),
    ("scenarios/first.rhai", include_str!("first.rhai")),
    ("snapshots/.gitkeep", ""),
    ("tests/scenarios.rs", include_str!("scenarios.rs.in")),
];

/// Lays out a project in a folder, which is made when it does not exist.
///
/// # Errors
/// A file of the project that is there already: then nothing at all is written. A folder that cannot be written; a
/// `choque_path` without a `Cargo.toml`.
pub fn init(directory: &Path, choque_path: Option<&Path>) -> Result<Verdict, Error> {
    refuse_to_overwrite(directory)?;
    let choque = dependency(choque_path)?;
    let name = package_name(directory);
    for (file, template) in FILES {
        let text = template.replace("{name}", &name).replace("{choque}", &choque);
        let path = directory.join(file);
        create(&path, &text).map_err(|source| Error::File { verb: "create", path, source })?;
    }
    let folder = directory.display();
    tell(&format!("laid out {folder}; try\n  choque run {folder}/scenarios/first.rhai\n  cd {folder} && cargo test\n"));
    Ok(Verdict::Holds)
}

fn refuse_to_overwrite(directory: &Path) -> Result<(), Error> {
    let there = FILES.iter().map(|(file, _)| directory.join(file)).find(|path| fs::symlink_metadata(path).is_ok());
    match there {
        None => Ok(()),
        Some(path) => Err(Error::Call {
            message: format!("{} is there already; nothing was written", path.display()),
            hint: "give a folder of its own to the project".to_owned(),
        }),
    }
}

fn create(path: &Path, text: &str) -> std::io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    File::create_new(path)?.write_all(text.as_bytes())
}

/// What stands behind `choque =` in the project's manifest.
fn dependency(choque_path: Option<&Path>) -> Result<String, Error> {
    let Some(path) = choque_path else {
        return Ok(format!("\"{}.{}\"", env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR")));
    };
    let absolute = path.canonicalize().unwrap_or_else(|_| PathBuf::from(path));
    if !absolute.join("Cargo.toml").is_file() {
        return Err(Error::Call {
            message: format!("{} has no Cargo.toml", path.display()),
            hint: "--choque-path is the folder of choque's own sources".to_owned(),
        });
    }
    Ok(format!("{{ path = {:?} }}", absolute.to_string_lossy()))
}

/// A name that Cargo accepts, whatever the folder is called: `My Game` gives `my-game-scenarios`.
fn package_name(directory: &Path) -> String {
    let absolute = std::path::absolute(directory).unwrap_or_else(|_| directory.to_owned());
    let folder = absolute.file_name().map_or_else(String::new, |name| name.to_string_lossy().to_lowercase());
    let words: Vec<&str> = folder.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let stem = words.join("-");
    match stem.chars().next() {
        None => "scenarios".to_owned(),
        Some(first) if first.is_ascii_digit() => format!("game-{stem}-scenarios"),
        Some(_) => format!("{stem}-scenarios"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_folder_gives_a_name_that_cargo_accepts() {
        let expected = [
            ("/a/My Game", "my-game-scenarios"),
            ("/a/choque", "choque-scenarios"),
            ("/a/2x", "game-2x-scenarios"),
            ("/", "scenarios"),
            ("/a/¡…!", "scenarios"),
        ];
        for (folder, name) in expected {
            assert_eq!(package_name(Path::new(folder)), name);
        }
    }
}
