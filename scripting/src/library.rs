//! The files a script may read: those below its own folder and below the library, and no others.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

use crate::error::{Complaint, Diagnostic};
use crate::options::Reads;
use crate::suggest::nearest;

/// No script, scene or model is larger than that; what is, was not meant.
const MOST_BYTES: u64 = 64 * 1024 * 1024;

/// Where a script's imports and models are looked up, and the text of every script read so far.
pub(crate) struct Library {
    /// In the order of looking: the script's folder, then the library.
    roots: Vec<PathBuf>,
    /// By the name that errors show.
    texts: RefCell<BTreeMap<String, String>>,
    /// The models, for the record.
    models: RefCell<BTreeMap<String, String>>,
    reads: Reads,
}

/// A file that was found.
#[derive(Clone)]
pub(crate) struct Found {
    /// As errors show it.
    pub(crate) shown: PathBuf,
    /// Its one true path: what tells two files apart.
    pub(crate) canonical: PathBuf,
}

impl Found {
    /// A script found by whoever runs it.
    pub(crate) fn itself(script: &Path) -> Self {
        Found { shown: script.to_owned(), canonical: script.canonicalize().unwrap_or_else(|_| script.to_owned()) }
    }
}

impl Library {
    /// For a script, and the library given or, failing that, the nearest folder above the script that is
    /// named `scenarios`.
    pub(crate) fn new(script: &Path, library: Option<&Path>, reads: Reads) -> Self {
        let folder = match script.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
            _ => PathBuf::from("."),
        };
        let library = library.map(Path::to_owned).or_else(|| scenarios_above(&folder));
        let library = library.filter(|library| *library != folder);
        Library {
            roots: std::iter::once(folder).chain(library).collect(),
            texts: RefCell::default(),
            models: RefCell::default(),
            reads,
        }
    }

    /// Looks a file up; the extension may be left out of the path.
    ///
    /// # Errors
    /// A path that leads out, or to nothing; the complaint names `word`, the word that asked.
    pub(crate) fn find(&self, word: &str, path: &str, extension: &str) -> Result<Found, Complaint> {
        let mut relative = stay_below(word, path)?;
        if !path.ends_with(extension) {
            relative.as_mut_os_string().push(extension);
        }
        let roots: Vec<PathBuf> = self.roots.iter().filter_map(|root| root.canonicalize().ok()).collect();
        for root in &self.roots {
            let shown = if root == Path::new(".") { relative.clone() } else { root.join(&relative) };
            self.reads.tell(&shown);
            let Ok(canonical) = root.join(&relative).canonicalize() else { continue };
            if !roots.iter().any(|root| canonical.starts_with(root)) {
                return Err(Complaint::new(format!(
                    "{word}: \"{path}\" is a link that leads out of the script's folder"
                ))
                .hint("a script reads files below its own folder and below the library only"));
            }
            if canonical.is_file() {
                return Ok(Found { shown, canonical });
            }
        }
        Err(self.not_found(word, path, &relative))
    }

    fn not_found(&self, word: &str, path: &str, relative: &Path) -> Complaint {
        let places: Vec<String> = self.roots.iter().map(|root| root.display().to_string()).collect();
        let complaint = Complaint::new(format!("{word}: there is no file \"{path}\"")).hint(format!(
            "looked for {} below {}",
            relative.display(),
            places.join(" and below ")
        ));
        let wanted = relative.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let folder = relative.parent().unwrap_or(Path::new(""));
        let near = self.roots.iter().find_map(|root| {
            let names = names_below(root, folder);
            let near = nearest(&wanted, names.iter().map(String::as_str));
            near.filter(|near| are_alike(stem(&wanted), stem(near))).map(|name| folder.join(name))
        });
        complaint.maybe_hint(near.map(|near| format!("did you mean \"{}\"?", near.display())))
    }

    /// Keeps a script's text, for errors to show its lines.
    pub(crate) fn keep(&self, name: &str, text: &str) {
        self.texts.borrow_mut().insert(name.to_owned(), text.to_owned());
    }

    /// Keeps a model's text, for the record.
    pub(crate) fn keep_model(&self, name: &str, text: String) {
        self.models.borrow_mut().insert(name.to_owned(), text);
    }

    /// The name and text of every script and every model read so far.
    pub(crate) fn texts_read(&self) -> Vec<(String, String)> {
        let all = |texts: &RefCell<BTreeMap<String, String>>| texts.borrow().clone();
        all(&self.texts).into_iter().chain(all(&self.models)).collect()
    }

    /// The text of every script read so far, one after the other.
    pub(crate) fn all_texts(&self) -> String {
        self.texts.borrow().values().map(|text| format!("{text}\n")).collect()
    }

    /// Whether a word stands anywhere in the scripts read so far.
    pub(crate) fn speaks_of(&self, word: &str) -> bool {
        self.texts.borrow().values().any(|text| text.contains(word))
    }

    /// The text of a script read before.
    pub(crate) fn text(&self, name: &str) -> Option<String> {
        self.texts.borrow().get(name).cloned()
    }
}

/// The path, when it names something below a folder without leaving it.
fn stay_below(word: &str, path: &str) -> Result<PathBuf, Complaint> {
    let refuse = |why: &str| {
        Err(Complaint::new(format!("{word}: \"{path}\" {why}"))
            .hint("write a path below the script's folder or below the library, with `/` between folders"))
    };
    if path.is_empty() {
        return refuse("is empty");
    }
    if path.contains(['\\', ':', '\0']) {
        return refuse("has a sign that no path of a script has");
    }
    let mut relative = PathBuf::new();
    for component in Path::new(path).components() {
        match component {
            Component::Normal(name) => relative.push(name),
            Component::CurDir => {}
            Component::ParentDir => return refuse("leads upwards"),
            Component::RootDir | Component::Prefix(_) => return refuse("is an absolute path"),
        }
    }
    Ok(relative)
}

fn scenarios_above(folder: &Path) -> Option<PathBuf> {
    let named = |folder: &&Path| folder.file_name().is_some_and(|name| name == "scenarios");
    if let Some(found) = folder.ancestors().find(named) {
        return Some(found.to_owned());
    }
    folder.canonicalize().ok()?.ancestors().find(named).map(Path::to_owned)
}

/// A file's name without what follows its last point.
fn stem(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Whether one may have been meant by the other; endings that agree do not make `nope.rhai` like `bom.rhai`.
fn are_alike(one: &str, other: &str) -> bool {
    one == other || nearest(one, [other]).is_some()
}

/// The names in a folder below a root; none of a folder that a link leads out to.
fn names_below(root: &Path, folder: &Path) -> Vec<String> {
    let place = root.join(folder).canonicalize().ok().zip(root.canonicalize().ok());
    let Some((place, _)) = place.filter(|(place, root)| place.starts_with(root)) else { return Vec::new() };
    let Ok(entries) = fs::read_dir(place) else { return Vec::new() };
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort(); // folders list in any order; a hint must not
    names
}

/// Reads a text file.
///
/// # Errors
/// What cannot be read, is too large, or is not UTF-8.
pub(crate) fn read_text(file: &Path, shown: &Path) -> Result<String, Diagnostic> {
    let unreadable =
        |reason: &str| Diagnostic::new(format!("cannot read {}: {reason}", shown.display())).in_file(shown);
    let metadata = fs::metadata(file).map_err(|error| unreadable(&plain(&error)))?;
    if !metadata.is_file() {
        return Err(unreadable("it is not a file"));
    }
    if metadata.len() > MOST_BYTES {
        return Err(unreadable(&format!("it has {} bytes; {MOST_BYTES} are the most", metadata.len())));
    }
    let bytes = fs::read(file).map_err(|error| unreadable(&plain(&error)))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let read = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + read.iter().filter(|byte| **byte == b'\n').count();
        unreadable(&format!("line {line} is not UTF-8 text")).with_hint(Some("save it as UTF-8".to_owned()))
    })?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// A system's error in words that are the same on every system, where it is one of the usual ones.
fn plain(error: &std::io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_owned(),
        ErrorKind::PermissionDenied => "there is no permission".to_owned(),
        _ => error.to_string(),
    }
}
