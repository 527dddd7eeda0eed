//! The one clock of this crate: it stops a script that does not come to an end by itself.

#![allow(clippy::disallowed_methods, clippy::disallowed_types)] // no result depends on it, only whether there is one

use std::cell::Cell;
use std::rc::Rc;
use std::time::{Duration, Instant};

/// Operations between two looks at the clock.
const BETWEEN_LOOKS: u64 = 256;

/// A deadline that is set anew for the main part and for every callback.
#[derive(Clone)]
pub(crate) struct Clock {
    limit: Duration,
    deadline: Rc<Cell<Option<Instant>>>,
}

impl Clock {
    pub(crate) fn new(limit: Duration) -> Self {
        Clock { limit, deadline: Rc::default() }
    }

    /// The time a script is given.
    pub(crate) fn limit(&self) -> Duration {
        self.limit
    }

    /// From now on the script has its full time again.
    pub(crate) fn restart(&self) {
        self.deadline.set(Instant::now().checked_add(self.limit));
    }

    /// Whether the time is up; looks only now and then.
    pub(crate) fn has_run_out(&self, operations: u64) -> bool {
        operations.is_multiple_of(BETWEEN_LOOKS)
            && self.deadline.get().is_some_and(|deadline| Instant::now() >= deadline)
    }
}
