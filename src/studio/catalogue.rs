//! The scenarios below a folder, and the way from the name a page gives to a file: never out of that folder.

use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use choque_scripting::Scenario;
use serde::Serialize;

/// A folder of this name holds what scenarios import, not scenarios.
const LIBRARY: &str = "lib";
/// Folders that tools fill, and nobody writes scenarios in.
const PASSED_OVER: [&str; 2] = ["target", "node_modules"];
/// More scenarios than anyone looks through; a page with all of a disk would help nobody.
const MOST: usize = 5_000;
/// Bytes of a file in which its first sentence is looked for, and what kind of file it is.
const BEGINNING: u64 = 4096;

/// The folder that the studio shows.
#[derive(Clone, Debug)]
pub(super) struct Catalogue {
    root: PathBuf,
}

/// A scenario in the list.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub(super) struct Entry {
    /// Path below the folder, with `/` between its parts: what a page calls it by.
    pub(super) id: String,
    /// The first line of its leading comment: what one should see.
    pub(super) about: String,
}

impl Catalogue {
    pub(super) fn new(root: PathBuf) -> Self {
        Catalogue { root }
    }

    /// The folder, as it was named.
    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// The scenarios, in the order of their paths. Folders that cannot be read have none.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        let mut folders = vec![String::new()];
        while let Some(below) = folders.pop() {
            let Ok(listed) = fs::read_dir(self.root.join(&below)) else { continue };
            for entry in listed.flatten() {
                let Ok(name) = entry.file_name().into_string() else { continue };
                let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
                if name.starts_with('.') || (is_folder && (name == LIBRARY || PASSED_OVER.contains(&name.as_str()))) {
                    continue;
                }
                let id = if below.is_empty() { name } else { format!("{below}/{name}") };
                if is_folder {
                    folders.push(id);
                } else if let Some(about) = self.find(&id).and_then(|path| about(&path)) {
                    entries.push(Entry { about, id });
                }
                if entries.len() >= MOST {
                    folders.clear();
                    break;
                }
            }
        }
        entries.sort();
        entries
    }

    /// The scenario of that name, if there is one below the folder: no way up, nothing hidden, no link that leads out.
    pub(super) fn find(&self, id: &str) -> Option<PathBuf> {
        let is_plain =
            |part: Component| matches!(part, Component::Normal(name) if !name.as_encoded_bytes().starts_with(b"."));
        let relative = Path::new(id);
        let is_scenario =
            !id.contains(['\\', ':', '\0']) && Scenario::is_named(relative) && relative.components().all(is_plain);
        if !is_scenario {
            return None;
        }
        let path = if self.root == Path::new(".") { relative.to_owned() } else { self.root.join(relative) };
        let (root, file) = (self.root.canonicalize().ok()?, path.canonicalize().ok()?);
        (file.starts_with(root) && file.is_file()).then_some(path)
    }
}

/// The first line of the comment that a scenario begins with; nothing of a plan for sweeps, which is no scenario.
fn about(path: &Path) -> Option<String> {
    let text = beginning(path).unwrap_or_default(); // who opens it is told why it cannot be read
    let text = text.trim_start_matches('\u{feff}');
    let says_something = |line: &&str| !line.is_empty() && !line.starts_with("//") && !line.starts_with("#!");
    if !Scenario::is_script(path)
        && text.lines().map(str::trim).find(says_something).is_some_and(|line| line.starts_with("Sweep"))
    {
        return None;
    }
    let first = text.lines().next().unwrap_or_default();
    Some(first.strip_prefix("//").unwrap_or_default().trim().to_owned())
}

fn beginning(path: &Path) -> io::Result<String> {
    let mut beginning = Vec::new();
    fs::File::open(path)?.take(BEGINNING).read_to_end(&mut beginning)?;
    Ok(String::from_utf8_lossy(&beginning).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_elsewhere_find_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path().join("scenarios");
        fs::create_dir_all(root.join("a/.hidden")).expect("folders");
        for file in ["scenarios/a/b.rhai", "scenarios/a/.hidden/c.rhai", "scenarios/a/d.txt", "out.rhai"] {
            fs::write(folder.path().join(file), "// It moves.\n").expect("a file");
        }
        #[cfg(unix)]
        std::os::unix::fs::symlink(folder.path().join("out.rhai"), root.join("link.rhai")).expect("a link");
        let catalogue = Catalogue::new(root.clone());
        let wrong =
            ["", ".", "..", "../out.rhai", "a/../../out.rhai", "/etc/passwd", "a/.hidden/c.rhai", "a/d.txt", "a"];
        let wrong = wrong.into_iter().map(str::to_owned);
        let absolute = root.join("a/b.rhai").display().to_string();
        for id in wrong.chain([absolute, "link.rhai".into(), "a\\b.rhai".into(), "a/b.rhai\0".into()]) {
            assert_eq!(catalogue.find(&id), None, "{id}");
        }
        assert_eq!(catalogue.find("a/b.rhai"), Some(root.join("a/b.rhai")));
        assert_eq!(catalogue.entries(), [Entry { id: "a/b.rhai".into(), about: "It moves.".into() }]);
    }

    #[test]
    fn plain_scenes_are_listed_and_plans_for_sweeps_are_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = [
            ("scene.ron", "(title: \"Sweep(\")"),
            ("told.ron", "// It stands.\n()"),
            ("plan.ron", "Sweep(scenarios: [])"),
            ("told_plan.ron", "// What it does.\n//\n\n  Sweep(\n)"),
        ];
        for (name, text) in files {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        let listed = Catalogue::new(folder.path().to_owned()).entries();
        let listed: Vec<(&str, &str)> = listed.iter().map(|entry| (&*entry.id, &*entry.about)).collect();
        assert_eq!(listed, [("scene.ron", ""), ("told.ron", "It stands.")]);
    }
}
