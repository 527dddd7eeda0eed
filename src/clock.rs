//! The one clock of the command: for progress bars and measured shares, never for a result.

use std::time::Instant;

/// What time it is.
#[expect(clippy::disallowed_methods, reason = "what is measured here is shown to people and enters no simulation")]
#[must_use]
pub fn now() -> Instant {
    Instant::now()
}
