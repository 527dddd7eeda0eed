//! Broad phase: which pairs are worth the vertex test.
//!
//! Two ways to the same collisions: [`all_pairs`], as the document writes it, is the specification;
//! [`strips`] is held to it by a test over every scenario and a thousand random scenes.

pub mod all_pairs;
pub(crate) mod bounds;
pub(crate) mod grid;
mod level;
pub(crate) mod met;
mod sight;
pub mod strips;

use crate::bodies::{Bodies, Role};
use crate::plan::BroadPhasePlan;
use crate::work::Work;
pub use sight::Sweeping;
use sight::{Sight, Standing};
use strips::Strips;

/// The way pairs are found, with the scratch it needs and no other.
#[derive(Clone, Debug)]
pub enum BroadPhase {
    /// No pair can collide.
    Nothing,
    /// Every pair of collidable bodies of which one is mobile.
    AllPairs,
    /// Pairs whose bounds overlap, from a sweep in strips.
    Strips(Box<Strips>),
}

impl BroadPhase {
    /// The way the plan decided on.
    #[must_use]
    pub fn new(plan: BroadPhasePlan) -> Self {
        match plan {
            BroadPhasePlan::Nothing => BroadPhase::Nothing,
            BroadPhasePlan::AllPairs => BroadPhase::AllPairs,
            BroadPhasePlan::Strips { depth } => BroadPhase::Strips(Box::new(Strips::new(depth))),
        }
    }

    /// Shows every pair (i < j) worth testing to `visit`; in no order, and some more than once.
    pub fn visit(&mut self, bodies: &Bodies, work: &mut Work, visit: impl FnMut(usize, usize, &mut Work)) {
        self.visit_what(bodies, &Standing, work, visit);
    }

    /// The same of every pair that may meet while the bodies fly for some time.
    pub fn visit_swept(
        &mut self,
        bodies: &Bodies,
        sweeping: &Sweeping,
        work: &mut Work,
        visit: impl FnMut(usize, usize, &mut Work),
    ) {
        self.visit_what(bodies, sweeping, work, visit);
    }

    fn visit_what(
        &mut self,
        bodies: &Bodies,
        sight: &impl Sight,
        work: &mut Work,
        visit: impl FnMut(usize, usize, &mut Work),
    ) {
        match self {
            BroadPhase::Nothing => {}
            BroadPhase::AllPairs => all_pairs::visit(bodies, work, visit),
            BroadPhase::Strips(strips) => strips.visit(bodies, sight, work, visit),
        }
    }
}

/// Whether a pair can collide at all: one must be mobile (R3).
#[inline]
fn can_collide(bodies: &Bodies, i: usize, j: usize) -> bool {
    bodies.role[i] == Role::Mobile || bodies.role[j] == Role::Mobile
}
