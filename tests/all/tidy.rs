//! The tree itself: what the documents name exists, what exists is named, and files stay of a size to be read.

use std::fs;
use std::path::{Path, PathBuf};

/// Where the crates' sources lie, each with the heading of its table in ARCHITECTURE.md.
const SOURCES: [&str; 3] = ["engine/src", "scripting/src", "src"];

/// A file longer than this is two files.
const MOST_LINES: usize = 400;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(file: &str) -> String {
    fs::read_to_string(root().join(file)).expect("the file is there")
}

/// The Rust files below a folder, in order.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    entries.sort();
    let below = |path: PathBuf| if path.is_dir() { rust_files(&path) } else { vec![path] };
    entries.into_iter().flat_map(below).filter(|path| path.extension().is_some_and(|e| e == "rs")).collect()
}

/// What stands between backticks in a part of ARCHITECTURE.md and names a Rust file.
fn named_files(part: &str) -> Vec<&str> {
    part.split('`').skip(1).step_by(2).filter(|word| word.ends_with(".rs")).collect()
}

/// The part of ARCHITECTURE.md under the line that begins with the folder's name.
fn table_of<'a>(architecture: &'a str, folder: &str) -> &'a str {
    let start = architecture.find(&format!("\n`{folder}/`")).expect("a table for the folder");
    let rest = &architecture[start + 1..];
    let end = rest.find("\n\n`").or_else(|| rest.find("\n## ")).unwrap_or(rest.len());
    &rest[..end]
}

#[test]
fn the_architecture_names_every_source_file_and_no_other() {
    let architecture = read("ARCHITECTURE.md");
    for folder in SOURCES {
        let mut named: Vec<String> =
            named_files(table_of(&architecture, folder)).into_iter().map(String::from).collect();
        named.sort();
        let base = root().join(folder);
        let relative = |path: PathBuf| path.strip_prefix(&base).expect("below it").to_string_lossy().replace('\\', "/");
        let mut present: Vec<String> = rust_files(&base).into_iter().map(relative).collect();
        present.sort();
        assert_eq!(named, present, "{folder}: what ARCHITECTURE.md names, and what is there");
    }
}

#[test]
fn the_architecture_can_be_read_in_one_sitting() {
    assert!(read("ARCHITECTURE.md").lines().count() <= 150);
}

#[test]
fn files_are_of_a_size_to_be_read() {
    for file in SOURCES.iter().flat_map(|folder| rust_files(&root().join(folder))) {
        let lines = fs::read_to_string(&file).expect("a text").lines().count();
        assert!(lines <= MOST_LINES, "{} has {lines} lines; which two files is it?", file.display());
    }
}

#[test]
fn every_link_in_the_readme_leads_somewhere() {
    let readme = read("README.md");
    let targets = readme.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let pictures = readme.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let local: Vec<&str> = targets.chain(pictures).filter(|target| !target.contains("://")).collect();
    assert!(local.len() > 8, "{local:?}");
    for target in local {
        assert!(root().join(target).exists(), "{target}");
    }
}

#[test]
fn the_scenario_in_the_readme_runs_and_holds() {
    let readme = read("README.md");
    let script = readme.split("```rhai\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a script");
    let folder = crate::support::folder(&[("gate.rhai", script)]);
    let output = crate::support::choque().arg("run").arg(folder.path().join("gate.rhai")).output().expect("it runs");
    assert!(output.status.success(), "{}", crate::support::stderr(&output));
}
