//! Writing to a person or a pipe: colours only where a terminal shows them, and no panic when the reader leaves.

use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

use crate::Error;

/// A title or the head of a table.
pub const HEADING: Style = Style::new().bold();
/// What holds.
pub const GOOD: Style = AnsiColor::Green.on_default();
/// What does not.
pub const BAD: Style = AnsiColor::Red.on_default().bold();
/// What deserves a look.
pub const WARNING: Style = AnsiColor::Yellow.on_default().bold();
/// What may be skipped.
pub const FAINT: Style = Style::new().dimmed();

/// The text in a style; the codes are taken out again where the stream is no terminal or `NO_COLOR` is set.
#[must_use]
pub fn styled(style: Style, text: &str) -> String {
    format!("{style}{text}{style:#}")
}

/// Writes what was asked for to standard output. A reader who left has heard enough: that is no error.
///
/// # Errors
/// Any other failure to write, such as a full disk.
pub fn answer(text: &str) -> Result<(), Error> {
    let mut out = anstream::stdout();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(source) if source.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::File { verb: "write", path: "standard output".into(), source })
        }
        _ => Ok(()),
    }
}

/// Writes to standard error. That nobody reads there any more is no reason to stop.
pub fn tell(text: &str) {
    let _ = anstream::stderr().write_all(text.as_bytes());
}

/// Tells what ended a call, its first word in the colour of errors.
pub fn tell_error(error: &Error) {
    let text = error.to_string();
    match text.strip_prefix("error") {
        Some(rest) => tell(&format!("{}{rest}\n", styled(BAD, "error"))),
        None => tell(&format!("{text}\n")),
    }
}
