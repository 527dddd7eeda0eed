//! Files that are written whole or not at all.

use std::fs::{self, File, Permissions};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};

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
    /// Refuses a name that is none for such a file, what is there already and is no file or not to be written over, and a folder that
    /// is not there or nothing may be written in.
    ///
    /// # Errors
    /// Those.
    pub fn check(&self, path: &Path) -> Result<(), Error> {
        let Kind { what, extension, flag } = self;
        let refuse_with = |why: String, hint| Err(Error::Call { message: format!("{} {why}", path.display()), hint });
        let name = what.replace(' ', "_");
        let refuse =
            |why| refuse_with(why, format!("a {what}'s file name ends in .{extension}: {flag} {name}.{extension}"));
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
        let writable = replaceable(path).and_then(|path| may_be_written_in(folder_of(&path)));
        writable.map_err(|source| Error::File { verb: "write", path: path.to_owned(), source })
    }
}

/// Writes beside the file first and renames then: whoever reads it sees the old one or the new one, never half of it. A link
/// stays a link to what is replaced, and what is replaced keeps its permissions.
///
/// # Errors
/// A file or folder that cannot be written.
pub fn replace(path: &Path, mut content: impl Read) -> Result<(), Error> {
    let mut write = || {
        let path = &replaceable(path)?;
        let mut builder = beside();
        let permissions = path.metadata().ok().map(|known| known.permissions()).or_else(usual_permissions);
        if let Some(permissions) = permissions {
            builder.permissions(permissions);
        }
        let mut beside = builder.tempfile_in(folder_of(path)).map_err(without_path)?;
        io::copy(&mut content, beside.as_file_mut())?;
        beside.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    write().map_err(|source| Error::File { verb: "write", path: path.to_owned(), source })
}

/// A file that has no name until it is whole: nothing is left of a call that is broken off.
#[derive(Debug)]
pub struct Nameless {
    file: File,
    /// Its name to be.
    path: PathBuf,
}

impl Nameless {
    /// An empty one, in the folder of the name that it shall have.
    ///
    /// # Errors
    /// A file or folder that cannot be written.
    pub fn to_become(path: &Path) -> Result<Self, Error> {
        let open = || nameless_in(folder_of(&replaceable(path)?));
        match open() {
            Ok(file) => Ok(Nameless { file, path: path.to_owned() }),
            Err(source) => Err(Error::File { verb: "write", path: path.to_owned(), source }),
        }
    }

    /// Puts it in the place of what has its name, as [`replace`] does.
    ///
    /// # Errors
    /// A file or folder that cannot be written.
    pub fn give_name(self) -> Result<(), Error> {
        let Nameless { mut file, path } = self;
        let is_named = replaceable(&path).and_then(|path| link(&file, &path)).is_ok();
        if is_named {
            return Ok(());
        }
        file.rewind().map_err(|source| Error::File { verb: "write", path: path.clone(), source })?;
        replace(&path, file)
    }
}

impl Write for Nameless {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The file itself where a path is a link to it; an error where something stands there that is not to be replaced.
fn replaceable(path: &Path) -> io::Result<PathBuf> {
    let Ok(path) = path.canonicalize() else { return Ok(path.to_owned()) };
    if !path.is_file() {
        return Err(io::Error::other("it is there already and is no file"));
    }
    if path.metadata()?.permissions().readonly() {
        return Err(io::Error::new(ErrorKind::PermissionDenied, "it is read-only"));
    }
    // Whoever may not write it may not put another in its place, though the folder would let him.
    File::options().write(true).open(&path)?;
    Ok(path)
}

#[cfg(unix)]
fn may_be_written_in(folder: &Path) -> io::Result<()> {
    use rustix::fs::{Access, access};
    Ok(access(folder, Access::WRITE_OK | Access::EXEC_OK)?)
}

/// Left to the moment of writing.
#[cfg(not(unix))]
fn may_be_written_in(_: &Path) -> io::Result<()> {
    Ok(())
}

/// The path that the error speaks of is one that nobody has heard of.
fn without_path(error: io::Error) -> io::Error {
    match error.kind() {
        kind @ (ErrorKind::PermissionDenied | ErrorKind::NotFound | ErrorKind::ReadOnlyFilesystem) => kind.into(),
        _ => error,
    }
}

/// How what is written beside a file is called.
fn beside() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".choque-").suffix(".tmp");
    builder
}

#[cfg(target_os = "linux")]
fn nameless_in(folder: &Path) -> io::Result<File> {
    use rustix::fs::{Mode, OFlags, open};
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    match open(folder, flags, Mode::from_raw_mode(0o666)) {
        Ok(file) => Ok(file.into()),
        Err(_) => tempfile::tempfile_in(folder), // not every file system has such files
    }
}

#[cfg(not(target_os = "linux"))]
fn nameless_in(folder: &Path) -> io::Result<File> {
    tempfile::tempfile_in(folder)
}

/// Gives a nameless file its name, where the system can do that.
#[cfg(target_os = "linux")]
fn link(file: &File, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    use std::os::fd::AsRawFd;
    let opened = format!("/proc/self/fd/{}", file.as_raw_fd());
    let link = |beside: &Path| Ok(linkat(CWD, &opened, CWD, beside, AtFlags::SYMLINK_FOLLOW)?);
    let beside = beside().make_in(folder_of(path), link)?;
    if let Ok(known) = path.metadata() {
        file.set_permissions(known.permissions())?;
    }
    beside.persist(path).map_err(|error| error.error)
}

#[cfg(not(target_os = "linux"))]
fn link(_: &File, _: &Path) -> io::Result<()> {
    Err(ErrorKind::Unsupported.into())
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
        return Err(io::Error::new(ErrorKind::PermissionDenied, "it is read-only"));
    }
    let mut beside = beside().tempfile_in(folder_of(&path))?;
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
    Err(ErrorKind::Unsupported.into())
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
