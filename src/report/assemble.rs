//! A study of one scenario, from the first run to the advice.

use std::path::Path;
use std::time::Duration;

use choque_engine::scene::{Detection, ExchangeRule, MotionRule};
use choque_scripting::Scenario;

use super::advice;
use super::closed_form::ClosedForm;
use super::convergence::{LOST, reach, slope};
use super::copies;
use super::course::{Apart, Plan};
use super::errors::{self, Errors};
use super::horizon::{self, Growth, MEASURABLE};
use super::ladder::Ladder;
use super::method::Method;
use super::poses::Shapes;
use super::recipe::{Recipe, Start, Variant};
use super::reference::{Earned, Reference};
use super::search::{References, Search, both, models_apart, referred};
use super::study::{Build, Row, Study, Summary};
use super::survey::{Runs, survey};
use super::timing::{self, Cost, Patience};
use super::{closed_form, notes};
use crate::Error;
use crate::outcome::hexadecimal;
use crate::progress::Progress;

/// How thorough a study is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Time steps tried.
    pub rungs: usize,
    /// Measurements of CPU time, for each method and time step.
    pub runs: usize,
    /// CPU time that goes into one of them at most, before fewer have to do.
    pub patience: Duration,
    /// A time step whose run is expected to take longer than this is not tried \[s\].
    pub longest: f64,
    /// Copies of a chaotic scene.
    pub copies: usize,
}

impl Depth {
    /// All of it: 1/30 … 1/15360, the median of 11.
    pub const FULL: Depth = Depth { rungs: 10, runs: 11, patience: Duration::from_secs(2), longest: 20.0, copies: 32 };
    /// A first impression: 1/30 … 1/960, the median of 3.
    pub const QUICK: Depth = Depth { rungs: 6, runs: 3, patience: Duration::from_millis(100), longest: 2.0, copies: 8 };
}

/// Studies a scenario.
///
/// # Errors
/// A scenario that cannot be loaded or has nothing to compare; a reference that does not fit it.
pub fn study(recipe: &Recipe, given: Option<&Path>, depth: Depth, threads: usize) -> Result<Study, Error> {
    let scenario = recipe.as_written()?;
    let own = own_method(&scenario)?;
    let ladder = Ladder::of(scenario.scene(), depth.rungs);
    let shapes = Shapes::of(scenario.scene());
    if shapes.is_empty() || ladder.time <= 0.0 {
        return Err(notes::nothing_to_compare(recipe.file()));
    }
    let given = given.map(|file| closed_form::read(file, scenario.scene(), &ladder)).transpose()?;
    let is_impulse = scenario.scene().settings.exchange == ExchangeRule::Impulse;
    let search = Search { recipe, growth: growth(recipe, &ladder, &shapes), is_impulse, threads };
    let compared = compare(&search, &ladder, shapes, given, depth)?;
    let Compared { shapes, checkpoints, all, references, is_chaotic } = &compared;
    let plan = Plan { ladder: &ladder, shapes, checkpoints };
    let of = |detection| references.iter().find(|(d, _)| *d == detection).and_then(|(_, reference)| reference.clone());
    let errors = errors::measure(recipe, &plan, all, of, threads);
    let costs = time(recipe, &ladder, all, depth)?;
    let rows = rows(&plan, all, &errors, &costs);
    let methods = all.iter().map(|runs| summary(runs, &ladder, &rows, of(runs.method.detection).as_ref())).collect();
    let comparisons = if *is_chaotic {
        let tried: Vec<Method> = all.iter().map(|runs| runs.method).collect();
        let detection = if is_impulse { Detection::Complete } else { own.detection };
        let best = Method { motion: MotionRule::Continuous, detection };
        copies::compare(recipe, &ladder, &tried, best, depth.copies, threads)?
    } else {
        Vec::new()
    };
    let mut study = Study {
        scenario: scenario.name().to_owned(),
        title: scenario.title(),
        exchange: scenario.scene().settings.exchange.word().to_owned(),
        laws: scenario.start()?.world().plan().modelled(),
        build: Build::here(),
        time: ladder.time,
        bodies: shapes.len(),
        own,
        growth: search.growth,
        measured_until: checkpoints.last().map_or(0.0, |last| *last as f64 * ladder.time_step(0)),
        models_apart: models_apart(shapes, references),
        references: references.iter().map(|(detection, reference)| referred(*detection, reference.as_ref())).collect(),
        rows,
        methods,
        comparisons,
        advice: String::new(),
        notes: Vec::new(),
    };
    study.advice = advice::advice(&study);
    study.notes = notes::of(&study, &scenario, &ladder, all);
    Ok(study)
}

/// All runs, and what they are measured against.
struct Compared {
    shapes: Shapes,
    checkpoints: Vec<u64>,
    all: Vec<Runs>,
    references: References,
    /// Differences grow so fast that only the beginning is measured, and statistics tell of the rest.
    is_chaotic: bool,
}

/// Makes all runs and finds what they are measured against: what is given, or a reference that earns it. Where none does to the end, only
/// the time is kept in which differences have not grown beyond measure.
fn compare(
    search: &Search<'_>,
    ladder: &Ladder,
    shapes: Shapes,
    given: Option<ClosedForm>,
    depth: Depth,
) -> Result<Compared, Error> {
    let last = search.growth.map_or(ladder.coarsest, |growth| growth.measured);
    if let Some(ClosedForm { shapes, checkpoints, stands }) = given {
        let plan = Plan { ladder, shapes: &shapes, checkpoints: &checkpoints };
        let all = survey(search.recipe, &plan, search.threads, depth.longest)?;
        let given = Reference { earned: Earned::Given, method: None, finest: 0, from: 0, stands };
        let references = both(&all).into_iter().map(|detection| (detection, Some(given.clone()))).collect();
        return Ok(Compared { shapes, checkpoints, all, references, is_chaotic: false });
    }
    let mut checkpoints = ladder.checkpoints([ladder.coarsest, last]);
    let plan = Plan { ladder, shapes: &shapes, checkpoints: &checkpoints };
    let mut all = survey(search.recipe, &plan, search.threads, depth.longest)?;
    let mut references = search.all(&plan, &all, search.growth.map_or(1.0, |growth| growth.by_end));
    let is_chaotic = last < ladder.coarsest && references.iter().any(|(_, reference)| reference.is_none());
    if is_chaotic {
        checkpoints.retain(|moment| *moment <= last);
        let courses = all.iter_mut().flat_map(|runs| &mut runs.courses);
        courses.for_each(|course| course.stands.truncate(checkpoints.len()));
        let plan = Plan { ladder, shapes: &shapes, checkpoints: &checkpoints };
        references = search.all(&plan, &all, MEASURABLE);
    }
    Ok(Compared { shapes, checkpoints, all, references, is_chaotic })
}

/// The method the scenario itself names.
fn own_method(scenario: &Scenario) -> Result<Method, Error> {
    let detection = scenario.start()?.world().plan().detection;
    Ok(Method { motion: scenario.scene().settings.motion, detection })
}

/// How differences grow: as the most thorough method that can be run tells.
fn growth(recipe: &Recipe, ladder: &Ladder, shapes: &Shapes) -> Option<Growth> {
    recipe.methods().into_iter().rev().find_map(|method| horizon::measure(recipe, ladder, shapes, method).ok())
}

/// CPU time of every run, one after the other.
fn time(recipe: &Recipe, ladder: &Ladder, all: &[Runs], depth: Depth) -> Result<Vec<Vec<Cost>>, Error> {
    let mut progress = Progress::of(all.iter().map(|runs| runs.courses.len() as u64).sum(), "timings");
    let mut done = 0;
    let patience = Patience { runs: depth.runs, most: depth.patience };
    let mut costs = Vec::new();
    for runs in all {
        let mut of_method = Vec::new();
        for rung in 0..runs.courses.len() {
            let variant = Variant::of(ladder, runs.method, rung, Start::AsWritten);
            of_method.push(timing::measure(recipe, &variant, patience)?);
            done += 1;
            progress.reached(done);
        }
        costs.push(of_method);
    }
    Ok(costs)
}

fn rows(plan: &Plan<'_>, all: &[Runs], errors: &[Errors], costs: &[Vec<Cost>]) -> Vec<Row> {
    let row = |i: usize, rung: usize| {
        let (course, error, cost) = (&all[i].courses[rung], errors[i][rung], costs[i][rung]);
        Row {
            method: all[i].method,
            time_step: plan.ladder.time_step(rung),
            steps: plan.ladder.steps(rung),
            error: error.map(|error| error.typical),
            error_at_end: error.map(|error| error.end),
            error_rms: error.map(|error| error.rms),
            error_worst: error.map(|error| error.worst),
            moved_by_halving: all[i]
                .courses
                .get(rung + 1)
                .and_then(|finer| Apart::between(plan.shapes, &course.stands, &finer.stands).map(|apart| apart.max)),
            starts: error.map_or(0, |error| error.starts),
            cpu: cost.seconds,
            runs: cost.runs,
            cpu_per_second: cost.seconds / course.time.max(f64::MIN_POSITIVE),
            collisions: course.collisions,
            digest: hexadecimal(course.digest),
            work: course.work,
        }
    };
    (0..all.len())
        .flat_map(|i| (0..all[i].courses.len()).map(move |rung| (i, rung)))
        .map(|(i, rung)| row(i, rung))
        .collect()
}

/// An error within ten times what the reference itself may be off says nothing of an order.
const DOUBT: f64 = 10.0;
/// Nor does one as small as rounding.
const ROUNDING: f64 = 1e-12;

fn summary(runs: &Runs, ladder: &Ladder, rows: &[Row], reference: Option<&Reference>) -> Summary {
    let rows: Vec<&Row> = rows.iter().filter(|row| row.method == runs.method).collect();
    let known = || rows.iter().filter_map(|row| Some((row.error?, row)));
    let curve: Vec<(f64, f64)> = known().map(|(error, row)| (error, row.cpu_per_second)).collect();
    let floor = reference.map_or(0.0, |reference| DOUBT * reference.doubt()).max(ROUNDING);
    Summary {
        method: runs.method,
        error_at_sixtieth: rows.get(ladder.usual()).and_then(|row| row.error),
        order: slope(
            known().filter(|(error, _)| *error > floor && *error < LOST).map(|(error, row)| (row.time_step, error)),
        ),
        reaches_1e_3: reach(&curve, 1e-3),
        reaches_1e_6: reach(&curve, 1e-6),
        ended: runs.ended.clone(),
    }
}
