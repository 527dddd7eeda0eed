//! Files that appear whole or not at all.

use std::fs::Permissions;
use std::io::{self, Write};
use std::path::Path;

/// Writes a file so that whoever reads it sees the old one or the new one, never half of it: beside it first, renamed then. A link
/// stays a link to what is replaced.
///
/// # Errors
/// What the system says.
pub fn replace(path: &Path, content: &[u8]) -> io::Result<()> {
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    let permissions = usual_permissions();
    if let Some(permissions) = permissions {
        builder.permissions(permissions);
    }
    let mut beside = builder.prefix(".choque-").suffix(".tmp").tempfile_in(folder)?;
    beside.write_all(content)?;
    beside.persist(path).map_err(|error| error.error)?;
    Ok(())
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
