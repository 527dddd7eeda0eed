//! The one clock of this crate: it stops a script that does not come to an end by itself, or that is asked to.

#![allow(clippy::disallowed_methods, clippy::disallowed_types)] // no result depends on it, only whether there is one

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::{Duration, Instant};

use crate::options::Stop;

/// Operations between two looks at the clock.
const BETWEEN_LOOKS: u64 = 256;

/// A deadline that is set anew for the main part and for every callback.
#[derive(Clone)]
pub(crate) struct Clock {
    limit: Duration,
    deadline: Rc<Cell<Option<Instant>>>,
    stop: Rc<RefCell<Stop>>,
}

/// Why a script was stopped.
#[derive(Clone, Copy)]
pub(crate) enum Stopped {
    /// It was given that much time, and took more.
    OutOfTime(Duration),
    /// Someone outside wanted it so.
    Asked,
}

impl Clock {
    pub(crate) fn new(limit: Duration, stop: Stop) -> Self {
        Clock { limit, deadline: Rc::default(), stop: Rc::new(RefCell::new(stop)) }
    }

    /// From now on it is this one that stops the script.
    pub(crate) fn heed(&self, stop: &Stop) {
        self.stop.replace(stop.clone());
    }

    /// From now on the script has its full time again.
    pub(crate) fn restart(&self) {
        self.deadline.set(Instant::now().checked_add(self.limit));
    }

    /// Whether the script has to end; looks only now and then.
    pub(crate) fn look(&self, operations: u64) -> Option<Stopped> {
        if !operations.is_multiple_of(BETWEEN_LOOKS) {
            return None;
        }
        if self.stop.borrow().is_asked() {
            return Some(Stopped::Asked);
        }
        let is_over = self.deadline.get().is_some_and(|deadline| Instant::now() >= deadline);
        is_over.then_some(Stopped::OutOfTime(self.limit))
    }
}
