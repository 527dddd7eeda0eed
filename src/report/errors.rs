//! Errors of every method with every time step.
//!
//! How far off a stepped run ends depends on where within an iteration its impacts fall. In a scene made of round numbers they
//! may fall exactly on the end of one, for every time step, and the error vanishes by luck. So each run is made several
//! times with the bodies starting a fraction of an iteration earlier, each time against a reference that starts there too, and
//! what counts is the middle of the errors.

use choque_engine::scene::Detection;

use super::course::{self, Apart, Plan};
use super::jobs::share;
use super::method::Method;
use super::recipe::{Recipe, Start, Variant};
use super::reference::{Earned, Reference};
use super::statistics::median;
use super::survey::Runs;

/// Starts of a run, the scene's own among them.
const STARTS: usize = 5;
/// Fractions of an iteration are spread by the golden section, so that any number of them is even.
const GOLDEN: f64 = 0.618_033_988_749_894_8;
/// A run that costs more than this is made from the scene's own start only \[s\].
const COSTLY: f64 = 1.0;

/// How far off a method is with one time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error {
    /// The median over starts; each the greatest over bodies and moments.
    pub typical: f64,
    /// The same at the last moment.
    pub end: f64,
    /// The same, but the root of the mean square over bodies and moments.
    pub rms: f64,
    /// The greatest over starts.
    pub worst: f64,
    /// How many starts.
    pub starts: usize,
}

/// The errors of a method, by rung; `None` where there is no reference, or it is too close to judge.
pub type Errors = Vec<Option<Error>>;

/// Measures all errors: `references` has one for each way of finding collisions, or none.
#[must_use]
pub fn measure(
    recipe: &Recipe,
    plan: &Plan<'_>,
    all: &[Runs],
    reference: impl Fn(Detection) -> Option<Reference>,
    threads: usize,
) -> Vec<Errors> {
    let references: Vec<Option<Reference>> = all.iter().map(|runs| reference(runs.method.detection)).collect();
    let moved = from_moved_starts(recipe, plan, all, &references, threads);
    let of = |i: usize, rung: usize| {
        let reference = references[i].as_ref().filter(|reference| reference.can_judge(rung))?;
        let own = Apart::between(plan.shapes, &all[i].courses[rung].stands, &reference.stands);
        let others = moved.iter().filter(|((j, r), _)| (*j, *r) == (i, rung)).map(|(_, apart)| *apart);
        summed_up(&own.into_iter().chain(others).collect::<Vec<_>>())
    };
    (0..all.len()).map(|i| (0..all[i].courses.len()).map(|rung| of(i, rung)).collect()).collect()
}

fn summed_up(aparts: &[Apart]) -> Option<Error> {
    let each = |what: fn(&Apart) -> f64| aparts.iter().map(what).collect::<Vec<_>>();
    (!aparts.is_empty()).then(|| Error {
        typical: median(&each(|apart| apart.max)),
        end: median(&each(|apart| apart.end)),
        rms: median(&each(|apart| apart.rms)),
        worst: each(|apart| apart.max).into_iter().fold(0.0, f64::max),
        starts: aparts.len(),
    })
}

/// One start of one rung.
struct Job {
    of: usize,
    rung: usize,
    start: usize,
}

type Moved = Vec<((usize, usize), Apart)>;

/// The errors from starts other than the scene's own, against exact references that start there too.
fn from_moved_starts(
    recipe: &Recipe,
    plan: &Plan<'_>,
    all: &[Runs],
    references: &[Option<Reference>],
    threads: usize,
) -> Moved {
    let is_exact = |i: &usize| matches!(&references[*i], Some(Reference { earned: Earned::Exact { .. }, .. }));
    let mut jobs = Vec::new();
    for of in (0..all.len()).filter(is_exact) {
        let from = references[of].as_ref().map_or(0, |reference| reference.from);
        let affordable = |rung: &usize| all[of].expected_cost((*rung).max(from)) <= COSTLY;
        for rung in (0..all[of].courses.len()).rev().filter(affordable) {
            jobs.extend((1..STARTS).map(|start| Job { of, rung, start }));
        }
    }
    let aparts = share(&jobs, threads, "moved starts", |job| {
        let fraction = (GOLDEN * job.start as f64).fract();
        let earlier = Start::Earlier(fraction * plan.ladder.time_step(job.rung));
        from_moved_start(recipe, plan, all[job.of].method, job.rung, references[job.of].as_ref()?, earlier)
    });
    jobs.iter().zip(aparts).filter_map(|(job, apart)| Some(((job.of, job.rung), apart?))).collect()
}

/// `None` when bodies would start inside each other there, or the run is not what it was.
fn from_moved_start(
    recipe: &Recipe,
    plan: &Plan<'_>,
    method: Method,
    rung: usize,
    reference: &Reference,
    start: Start,
) -> Option<Apart> {
    let deepest = |start: Start| {
        let variant = Variant::of(plan.ladder, method, rung, start);
        Some(recipe.load(&variant).ok()?.start().ok()?.world().deepest())
    };
    if deepest(start)? > deepest(Start::AsWritten)? {
        return None;
    }
    // Any time step from that one on gives the same; the one tried would be compared to itself.
    let exact = reference.method?;
    let same = rung == reference.from && method == exact;
    let truth = course::run(recipe, plan, exact, reference.from + usize::from(same), start).ok()?;
    let tried = course::run(recipe, plan, method, rung, start).ok()?;
    Apart::between(plan.shapes, &tried.stands, &truth.stands)
}
