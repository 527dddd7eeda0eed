//! What a method is.

use crate::contact::Contact;
use crate::world::World;

/// What a step cost and how well it was solved.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Step {
    /// Contacts visited: a pass over all of them counts each once.
    pub(crate) visits: usize,
    /// Rounds of the accelerated finish.
    pub(crate) rounds: usize,
    /// What it left undone at most, m/s.
    pub(crate) residual: f64,
}

impl Step {
    /// Adds what a part of a step cost.
    pub(crate) fn add(&mut self, part: Step) {
        self.visits += part.visits;
        self.rounds += part.rounds;
        self.residual = self.residual.max(part.residual);
    }
}

/// A way to carry a world with its contacts through a step.
pub(crate) trait Method {
    fn name(&self) -> &'static str;

    /// Contacts come with the impulses of the last step, and keep theirs for the next.
    fn step(&mut self, world: &mut World, contacts: &mut [Contact], dt: f64) -> Step;
}
