//! Files that are written whole or not at all.

use std::fs::{self, Permissions};
use std::io::{self, Read, Write};
use std::path::Path;

use crate::Error;

/// What a call writes to a file, and how such a file is named.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// What it is called: `scene`.
    pub what: &'static str,
    /// The only extension it may have, so that nothing is written over a script.
    pub extension: &'static str,
    /// The flag that names the file.
    pub flag: &'static str,
}

impl Kind {
    /// Refuses a name that is none for such a file, what is there already and is no file, and a folder that is not there.
    ///
    /// # Errors
    /// Those.
    pub fn check(&self, path: &Path) -> Result<(), Error> {
        let Kind { what, extension, flag } = self;
        let refuse_with = |why: String, hint| Err(Error::Call { message: format!("{} {why}", path.display()), hint });
        let refuse =
            |why| refuse_with(why, format!("a {what}'s file name ends in .{extension}: {flag} {what}.{extension}"));
        if path.extension().is_none_or(|found| found != *extension) {
            return refuse(format!("is no name for a {what}"));
        }
        if path.exists() && !path.is_file() {
            return refuse("is there already and is no file".to_owned());
        }
        if !folder_of(path).is_dir() {
            let hint = format!("make the folder {} first", folder_of(path).display());
            return refuse_with("is in a folder that is not there".to_owned(), hint);
        }
        Ok(())
    }
}

/// Writes beside the file first and renames then: whoever reads it sees the old one or the new one, never half of it. A link
/// stays a link to what is replaced, and what is replaced keeps its permissions.
///
/// # Errors
/// A file or folder that cannot be written.
pub fn replace(path: &Path, mut content: impl Read) -> Result<(), Error> {
    let mut write = || {
        let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let mut builder = tempfile::Builder::new();
        let permissions = path.metadata().ok().map(|known| known.permissions()).or_else(usual_permissions);
        if let Some(permissions) = permissions {
            builder.permissions(permissions);
        }
        let mut beside = builder.prefix(".choque-").suffix(".tmp").tempfile_in(folder_of(path))?;
        io::copy(&mut content, &mut beside)?;
        beside.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    write().map_err(|source| Error::File { verb: "write", path: path.to_owned(), source })
}

/// Writes beside a file and puts it in its place in one go, if the file is still what it was; tells whether it was. A link
/// stays a link, and the file keeps its permissions.
///
/// # Errors
/// A file or folder that cannot be read or written.
pub fn replace_unchanged(path: &Path, old: &str, new: &str) -> io::Result<bool> {
    let path = path.canonicalize()?;
    let permissions = fs::metadata(&path)?.permissions();
    if permissions.readonly() {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only"));
    }
    let mut beside = tempfile::Builder::new().prefix(".choque-").suffix(".tmp").tempfile_in(folder_of(&path))?;
    beside.write_all(new.as_bytes())?;
    beside.as_file().set_permissions(permissions)?;
    beside.as_file().sync_all()?;
    if fs::read(&path)? != old.as_bytes() {
        return Ok(false);
    }
    match exchange(beside.path(), &path) {
        // What was in its place is now beside it, and can still be looked at: someone may have saved in that very moment.
        Ok(()) if fs::read(beside.path())? == old.as_bytes() => Ok(true),
        Ok(()) => {
            exchange(beside.path(), &path)?;
            if fs::read(beside.path())? != new.as_bytes() {
                exchange(beside.path(), &path)?; // saved once more: the last one stays
            }
            Ok(false)
        }
        Err(_) => {
            beside.persist(&path).map_err(|error| error.error)?;
            Ok(true)
        }
    }
}

/// Has two files change places, where the system can do that.
#[cfg(target_os = "linux")]
fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE)?)
}

#[cfg(not(target_os = "linux"))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_was_saved_meanwhile_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.rhai");
        fs::write(&path, "mine").expect("a file");
        assert!(!replace_unchanged(&path, "old", "new").expect("it can be read"));
        assert_eq!(fs::read_to_string(&path).expect("a text"), "mine");
        assert!(replace_unchanged(&path, "mine", "new").expect("it can be written"));
        assert_eq!(fs::read_to_string(&path).expect("a text"), "new");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "nothing is left beside it");
    }
}
