//! Whether a file that a scenario was made of has changed since.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::SystemTime;

use choque_scripting::Reads;

/// What tells two versions of a file apart without reading it; nothing of one that is not there.
type Look = Option<(SystemTime, u64)>;

/// The files that a scenario reads or looks for, as they were when it did.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen(BTreeMap<PathBuf, Look>);

impl Seen {
    /// Looks at a file; what was seen first counts.
    pub(super) fn add(&mut self, file: &Path) {
        self.0.entry(file.to_owned()).or_insert_with(|| look(file));
    }

    /// Whether that file is one of them.
    pub(super) fn has(&self, file: &Path) -> bool {
        self.0.contains_key(file)
    }

    /// A few digits that differ when any of the files has changed.
    pub(super) fn stamp(&self) -> String {
        stamp(self.0.iter().map(|(file, seen)| (file.as_path(), *seen)))
    }

    /// The same of the files as they are now.
    pub(super) fn stamp_now(&self) -> String {
        stamp(self.0.keys().map(|file| (file.as_path(), look(file))))
    }
}

/// Has a scenario's files looked at just before they are read: what changes in between is noticed later, and not missed.
pub(super) fn watching(seen: &Rc<RefCell<Seen>>) -> Reads {
    let seen = seen.clone();
    Reads::to(move |file| seen.borrow_mut().add(file))
}

fn look(file: &Path) -> Look {
    let metadata = fs::metadata(file).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

fn stamp<'a>(files: impl Iterator<Item = (&'a Path, Look)>) -> String {
    let text: String = files.map(|(file, look)| format!("{}\0{look:?}\0", file.display())).collect();
    digest(&text)
}

/// FNV-1a: tells texts apart that nobody made alike on purpose.
pub(super) fn digest(text: &str) -> String {
    let digest = text.bytes().fold(0xcbf2_9ce4_8422_2325, |digest: u64, byte| {
        (digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    crate::outcome::hexadecimal(digest)
}
