//! A progress bar for runs that take a while, on a terminal only.

use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::clock;

/// A run shorter than this is over before a bar could be read.
const PATIENCE: Duration = Duration::from_secs(1);

/// Shows how far a run has come once it has taken longer than a second; draws nothing where nobody can see it.
#[derive(Debug)]
pub struct Progress {
    state: State,
    steps: u64,
    /// What is counted, in the plural.
    what: &'static str,
}

#[derive(Debug)]
enum State {
    /// Standard error is no terminal: the clock is not even looked at.
    Unseen,
    Waiting(Instant),
    Shown(ProgressBar),
}

impl Progress {
    /// For a run of that many iterations, which begins now.
    #[must_use]
    pub fn new(steps: u64) -> Self {
        Progress::of(steps, "iterations")
    }

    /// For so many of something, which begins now.
    #[must_use]
    pub fn of(steps: u64, what: &'static str) -> Self {
        let state = if stderr().is_terminal() { State::Waiting(clock::now()) } else { State::Unseen };
        Progress { state, steps, what }
    }

    /// So many are finished.
    pub fn reached(&mut self, iteration: u64) {
        match &self.state {
            State::Unseen => {}
            State::Waiting(since) if since.elapsed() < PATIENCE => {}
            State::Waiting(since) => self.state = State::Shown(bar(self.steps, self.what, since.elapsed())),
            State::Shown(bar) => bar.set_position(iteration),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let State::Shown(bar) = &self.state {
            bar.finish_and_clear();
        }
    }
}

fn bar(steps: u64, what: &'static str, elapsed: Duration) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::stderr()).with_elapsed(elapsed);
    match ProgressStyle::with_template("{bar:40} {pos} of {len} {msg}, {eta} left") {
        Ok(style) => bar.with_style(style).with_message(what),
        Err(_) => bar,
    }
}
