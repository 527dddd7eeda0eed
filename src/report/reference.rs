//! What errors are measured against, and how it has earned that.

use serde::{Deserialize, Serialize};

use super::convergence::{self, Verdict};
use super::course::{Apart, Course, Plan};
use super::method::Method;
use super::poses::Stand;

/// How a reference has earned its name.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Earned {
    /// The caller gave it.
    Given,
    /// Stopping at impacts gives the same for every time step from one on, to rounding.
    Exact {
        /// Greatest difference of those to the smallest time step, in half diagonals.
        to_itself: f64,
        /// What rounding, grown as fast as differences grow in this scene, could make of it.
        allowed: f64,
        /// The longest of them \[s\].
        from: f64,
    },
    /// The last three halvings of the time step shrank the difference by 2^p.
    Converged {
        /// p.
        order: f64,
        /// How far it still is from the limit, if it goes on like that.
        remainder: f64,
    },
}

/// What errors are measured against.
#[derive(Clone, Debug)]
pub struct Reference {
    /// How it has earned that.
    pub earned: Earned,
    /// Which method made it; `None` for one that was given.
    pub method: Option<Method>,
    /// Its smallest time step, as a rung of the ladder …
    pub finest: usize,
    /// … and the longest that gives the same.
    pub from: usize,
    /// Where everything stands at the checkpoints.
    pub stands: Vec<Stand>,
}

impl Reference {
    /// How far it may itself be from the truth.
    #[must_use]
    pub fn doubt(&self) -> f64 {
        match self.earned {
            Earned::Given => 0.0,
            Earned::Exact { to_itself, .. } => to_itself,
            Earned::Converged { remainder, .. } => remainder,
        }
    }

    /// Whether errors with that time step mean something: against a converged reference only those whose time step is eight
    /// times its own or more, for the rest share its error.
    #[must_use]
    pub fn can_judge(&self, rung: usize) -> bool {
        !matches!(self.earned, Earned::Converged { .. }) || rung + 3 <= self.finest
    }
}

/// Rounding of one iteration and impact, in half diagonals, before the scene lets it grow.
const ROUNDING: f64 = 1e-13;
/// However much a scene lets differences grow: a reference worse than this settles nothing.
const LEAST_CERTAIN: f64 = 1e-7;

/// Time steps in a row that must give the same.
const AGREE: usize = 4;

/// Whether a method gives the same for its smallest time steps, to rounding, and from which one on; `growth` is how many times a
/// difference at the start has grown by the end.
#[must_use]
pub fn exact(plan: &Plan<'_>, courses: &[&Course], method: Method, growth: f64) -> Option<Reference> {
    let finest = courses.last()?;
    let allowed = (ROUNDING * growth.max(1.0)).min(LEAST_CERTAIN);
    let apart = |course: &&Course| Apart::between(plan.shapes, &course.stands, &finest.stands).map(|apart| apart.max);
    let (mut to_itself, mut from) = (0.0, courses.len());
    for (rung, course) in courses.iter().enumerate().rev() {
        match apart(course).filter(|apart| *apart <= allowed) {
            Some(apart) => (to_itself, from) = (f64::max(to_itself, apart), rung),
            None => break,
        }
    }
    (courses.len() - from >= AGREE).then(|| Reference {
        earned: Earned::Exact { to_itself, allowed, from: plan.ladder.time_step(from) },
        method: Some(method),
        finest: courses.len() - 1,
        from,
        stands: finest.stands.clone(),
    })
}

/// Whether the results of a method, longest time step first, converge.
#[must_use]
pub fn converged(plan: &Plan<'_>, courses: &[&Course], method: Method) -> Option<Reference> {
    let apart = |pair: &[&Course]| Apart::between(plan.shapes, &pair[0].stands, &pair[1].stands).map(|apart| apart.max);
    let differences: Vec<f64> = courses.windows(2).map(apart).collect::<Option<_>>()?;
    match convergence::judge(&differences) {
        Verdict::Wanders => None,
        Verdict::Converges { order, remainder } => Some(Reference {
            earned: Earned::Converged { order, remainder },
            method: Some(method),
            finest: courses.len() - 1,
            from: courses.len() - 1,
            stands: courses.last()?.stands.clone(),
        }),
    }
}
