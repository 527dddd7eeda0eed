//! The clocks of the command: for progress bars and measured costs, never for a result.

use std::time::{Duration, Instant};

/// What time it is.
#[expect(clippy::disallowed_methods, reason = "what is measured here is shown to people and enters no simulation")]
#[must_use]
pub fn now() -> Instant {
    Instant::now()
}

/// How long this thread has been at work; only differences say something.
#[cfg(unix)]
#[must_use]
pub fn cpu() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec.unsigned_abs(), u32::try_from(time.tv_nsec).unwrap_or(0))
}

/// Where the system does not tell how long a thread was at work, the time that has passed stands in for it.
#[cfg(not(unix))]
#[must_use]
pub fn cpu() -> Duration {
    use std::sync::OnceLock;
    static BEGUN: OnceLock<Instant> = OnceLock::new();
    BEGUN.get_or_init(now).elapsed()
}

/// What [`cpu`] measures, for people.
pub const CPU_IS: &str = if cfg!(unix) { "CPU time of one thread" } else { "wall-clock time" };
