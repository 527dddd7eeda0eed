//! A fit from beginning to end: the search, what it leaves open, round numbers, and what all that comes to.

use choque_scripting::Scenario;

use super::answer::{Along, Answer, Distance, Value};
use super::determined::{Determined, correlations, determine, settle};
use super::problem::{BAD, Bench, Horizon, Problem, Residuals};
use super::refine::{Found, refine};
use super::search::{Effort, ROUNDING, most_runs, search};
use crate::Error;
use crate::outcome::Measured;

/// Steps of the last descent.
const LAST_STEPS: usize = 30;
/// Two answers are two when a value differs by more than this share of its range.
const FAR_APART: f64 = 0.02;
/// Other answers that are told of.
const MOST_ALTERNATIVES: usize = 3;
/// What rounding a value may add to the cost, in tolerances.
const FOR_ROUND_NUMBERS: f64 = 1e-3;
/// Runs that tell how sharply a value is determined, about.
const RUNS_PER_VALUE: u64 = 120;

/// What was found, and what is known of it.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The best place.
    pub best: Found,
    /// The values there, rounded where that does no harm.
    pub values: Vec<(String, f64)>,
    /// How sharply each is determined.
    pub determined: Vec<Determined>,
    /// Other places that are as good.
    pub others: Vec<Found>,
}

/// Searches, ends the search at the best place, and looks around there.
///
/// # Errors
/// Why no run could be made with any values.
pub fn solve(problem: &Problem, effort: Effort, tolerance: f64) -> Result<Solved, Error> {
    problem.expect(most_runs(problem, effort) + RUNS_PER_VALUE * problem.dimension() as u64);
    let found = search(problem, effort);
    let Some(best) = found.first().filter(|best| best.cost < BAD).cloned() else {
        problem.hush();
        return Err(nowhere(problem));
    };
    let bench = problem.bench();
    let mut best = refine(&bench, best, Horizon::Whole, None, ROUNDING, LAST_STEPS);
    let mut determined = determine(problem, &best, tolerance, effort.jobs);
    let open: Vec<bool> = determined.iter().map(|known| known.is_loose).collect();
    if open.contains(&true) {
        best = settle(&bench, best, tolerance, &open);
        determined = determine(problem, &best, tolerance, effort.jobs);
    }
    let values = rounded(&bench, &best, tolerance);
    let others = others(problem, &found, &best, &determined, tolerance);
    problem.hush();
    Ok(Solved { best, values, determined, others })
}

/// Why no run can be made: what is wrong with the scenario's own values, for it is wrong with all.
fn nowhere(problem: &Problem) -> Error {
    match problem.bench().run(&problem.values(&problem.own()), Horizon::Whole) {
        Err(error) => error,
        Ok(_) => Error::Call {
            message: "no run comes to numbers, whatever the values".to_owned(),
            hint: "look at the targets: does one divide by zero?".to_owned(),
        },
    }
}

/// Each value with as few digits as do no harm.
fn rounded(bench: &Bench, best: &Found, tolerance: f64) -> Vec<(String, f64)> {
    let Bench { problem, .. } = bench;
    let exact = problem.values(&best.place);
    let most = best.cost + FOR_ROUND_NUMBERS * tolerance;
    let round = |digits: i32| -> Vec<(String, f64)> {
        let round = |((name, value), varied): (&(String, f64), &choque_scripting::Varied)| {
            let (min, max) = varied.range;
            let magnitude = libm::floor(libm::log10((max - min).max(f64::MIN_POSITIVE))) as i32;
            let decimals = usize::try_from(digits - magnitude).unwrap_or(0);
            let short = format!("{value:.decimals$}").parse().unwrap_or(*value);
            (name.clone(), f64::clamp(short, min, max))
        };
        exact.iter().zip(&problem.varied).map(round).collect()
    };
    let does_no_harm =
        |values: &Vec<(String, f64)>| bench.run(values, Horizon::Whole).is_ok_and(|residuals| residuals.cost() <= most);
    (2..14).map(round).find(does_no_harm).unwrap_or_else(|| exact.clone())
}

/// Answers that are as good and far from the best, but not along a direction that is open anyway.
fn others(problem: &Problem, found: &[Found], best: &Found, determined: &[Determined], tolerance: f64) -> Vec<Found> {
    let is_apart = |a: &Found, b: &Found| {
        let share = |place: &Found, axis: usize| problem.share(axis, problem.value(axis, place.place[axis]));
        let mut axes = determined.iter().enumerate().filter(|(_, known)| !known.is_loose && known.along.is_empty());
        axes.any(|(axis, _)| (share(a, axis) - share(b, axis)).abs() > FAR_APART)
    };
    let mut others: Vec<Found> = Vec::new();
    for other in found.iter().filter(|other| other.cost <= best.cost + tolerance) {
        if is_apart(other, best) && others.iter().all(|known| is_apart(other, known)) {
            others.push(other.clone());
        }
    }
    others.truncate(MOST_ALTERNATIVES);
    others
}

/// All of it as data.
///
/// # Errors
/// A run that failed only now.
pub fn answer(
    scenario: &Scenario,
    problem: &Problem,
    solved: &Solved,
    effort: Effort,
    tolerance: f64,
) -> Result<Answer, Error> {
    let bench = problem.bench();
    let residuals: Residuals = bench.run(&solved.values, Horizon::Whole)?;
    let met = residuals.distance() <= tolerance
        && residuals.targets.iter().all(|target| (target.weight * target.residual).abs() <= tolerance);
    let recording = problem.recorded.as_ref().map(|recorded| Distance {
        distance: residuals.distance(),
        frames: recorded.frames(),
        bodies: recorded.bodies(),
    });
    Ok(Answer {
        scenario: scenario.name().to_owned(),
        title: scenario.title(),
        met,
        tolerance,
        residual: residuals.cost(),
        values: values(problem, solved),
        correlations: correlations(&bench, &solved.best.place).filter(|known| known.len() > 1),
        targets: residuals.targets.into_iter().map(Measured::from).collect(),
        recording,
        alternatives: solved.others.iter().map(|other| numbers(problem, &other.place)).collect(),
        seed: effort.seed,
        runs: problem.runs(),
    })
}

fn numbers(problem: &Problem, place: &[f64]) -> Vec<f64> {
    problem.values(place).into_iter().map(|(_, value)| value).collect()
}

fn values(problem: &Problem, solved: &Solved) -> Vec<Value> {
    let value = |axis: usize, share: f64| problem.value(axis, share);
    let along = |(other, low, high): &(usize, f64, f64)| Along {
        name: problem.varied[*other].name.clone(),
        ends: [value(*other, *low), value(*other, *high)],
    };
    let of = |(axis, known): (usize, &Determined)| Value {
        name: problem.varied[axis].name.clone(),
        value: solved.values[axis].1,
        was: problem.varied[axis].value,
        whole: problem.whole[axis],
        range: problem.varied[axis].range.into(),
        interval: [value(axis, known.low), value(axis, known.high)],
        determined: !known.is_loose,
        along: known.along.iter().map(along).collect(),
    };
    solved.determined.iter().enumerate().map(of).collect()
}
