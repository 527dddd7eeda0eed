//! One run of one variant, and where everything stood at the moments that are compared.

use choque_engine::{Hit, Work, World};
use choque_scripting::{Run, Step};

use super::ladder::Ladder;
use super::method::Method;
use super::poses::{Shapes, Stand};
use super::recipe::{Recipe, Start, Variant};
use crate::Error;

/// What a run left behind.
#[derive(Clone, Debug)]
pub struct Course {
    /// At each checkpoint that the run came to.
    pub stands: Vec<Stand>,
    /// Time at the end \[s\]: less than asked for when the script stopped the run.
    pub time: f64,
    /// Exchanges.
    pub collisions: u64,
    /// Of the final state.
    pub digest: u64,
    /// Counted.
    pub work: Work,
}

/// Runs a variant to its end, or to where it is stopped, with someone looking on after every iteration.
///
/// # Errors
/// What is wrong with the scenario; a body that left the finite numbers.
pub fn watch(recipe: &Recipe, variant: &Variant, mut look: impl FnMut(&World, &[Hit])) -> Result<Run, Error> {
    let mut run = recipe.load(variant)?.start()?;
    while run.world().iteration() < variant.steps {
        let step = run.step()?;
        look(&run.world(), run.hits());
        if step == Step::Done {
            break;
        }
    }
    Ok(run)
}

/// Runs one rung of a ladder and keeps where everything stood at the checkpoints, which are counted in iterations of the
/// longest time step.
///
/// # Errors
/// What is wrong with the scenario; a body that left the finite numbers.
pub fn run(recipe: &Recipe, plan: &Plan<'_>, method: Method, rung: usize, start: Start) -> Result<Course, Error> {
    let variant = Variant::of(plan.ladder, method, rung, start);
    let every = plan.ladder.steps(rung) / plan.ladder.coarsest;
    let mut stands = Vec::with_capacity(plan.checkpoints.len());
    let run = watch(recipe, &variant, |world, _| {
        let next = plan.checkpoints.get(stands.len());
        if next.is_some_and(|next| next * every == world.iteration()) {
            stands.push(plan.shapes.stand(world));
        }
    })?;
    let world = run.world();
    Ok(Course {
        stands,
        time: world.time(),
        collisions: world.collisions(),
        digest: world.digest(),
        work: *world.work(),
    })
}

/// What all runs of a study share.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The time steps.
    pub ladder: &'a Ladder,
    /// What is compared …
    pub shapes: &'a Shapes,
    /// … and when, in iterations of the longest time step.
    pub checkpoints: &'a [u64],
}

/// How far apart two courses are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Apart {
    /// Greatest, over bodies and checkpoints.
    pub max: f64,
    /// The same at the last checkpoint.
    pub end: f64,
    /// Root of the mean square, over bodies and checkpoints.
    pub rms: f64,
}

impl Apart {
    /// Between two lists of stands at the same moments; `None` when there is nothing to compare, or one ended early.
    #[must_use]
    pub fn between(shapes: &Shapes, a: &[Stand], b: &[Stand]) -> Option<Apart> {
        if a.len() != b.len() || a.is_empty() {
            return None;
        }
        let distances: Vec<_> = a.iter().zip(b).map(|(a, b)| shapes.distance(a, b)).collect();
        let squares: f64 = distances.iter().map(|distance| distance.rms * distance.rms).sum();
        Some(Apart {
            max: distances.iter().map(|distance| distance.max).fold(0.0, f64::max),
            end: distances.last().map_or(0.0, |distance| distance.max),
            rms: (squares / distances.len() as f64).sqrt(),
        })
    }
}
