//! The search: many places tried, the best of them followed down, by what happens early first and by all of it last.
//!
//! Where bodies collide again and again, a run's end says little about its beginning: it jumps whenever a collision falls
//! into another iteration. So the first frames of a recording count alone at first, and more of them from stage to stage.
//! From each start Nelder and Mead's simplex (1965) crosses such jumps, and steps by Levenberg and Marquardt end it.

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::neldermead::NelderMead;

use super::problem::{BAD, Bench, Horizon, Problem};
use super::refine::{Found, refine};
use crate::report::random::Random;

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Places followed down in the first stage; later stages keep fewer.
    pub starts: usize,
    /// Which of the many ways to spread the places.
    pub seed: u64,
    /// Runs made at once; the result never depends on it.
    pub jobs: usize,
}

/// Places tried before any is followed, and as many again for each number that varies.
const PLACES: usize = 16;
/// Values of a number tried along its axis before a place is followed down.
const ALONG: usize = 8;
/// Steps of the simplex, and for each number that varies.
const SIMPLEX_STEPS: u64 = 15;
/// Its first size, as a share of the ranges.
const SIMPLEX_SIZE: f64 = 0.08;
/// Steps that end a descent.
const LAST_STEPS: usize = 12;
/// A residual as small as that is 0 but for rounding.
pub const ROUNDING: f64 = 1e-11;
/// Shares of the recording, counted from where runs begin to differ, that the stages before the last look at.
const STAGES: [f64; 3] = [0.125, 0.25, 0.5];
/// Frames in which squares of residuals differ by no more than that do not differ.
const SAME: f64 = 1e-20;

/// How many runs a search makes at most, about.
#[must_use]
pub fn most_runs(problem: &Problem, effort: Effort) -> u64 {
    let n = problem.dimension() as u64;
    let descent = ALONG as u64 * n + 2 * SIMPLEX_STEPS * (n + 1) + (LAST_STEPS as u64) * (2 * n + 3);
    let stages = if problem.recorded.is_some() { 2 } else { 1 };
    PLACES as u64 * (n + 1) + stages * effort.starts as u64 * descent
}

/// The best places that were found, the best first.
#[must_use]
pub fn search(problem: &Problem, effort: Effort) -> Vec<Found> {
    let samples = sample(problem, effort);
    let stages = stages(problem, &samples);
    let mut kept: Vec<Vec<f64>> = Vec::new();
    let mut starts = effort.starts.max(1);
    for horizon in stages {
        let last = horizon == Horizon::Whole;
        let mut starts_here = problem.spread(&kept, effort.jobs, |bench, place| at(bench, place, horizon));
        starts_here.extend(samples.iter().map(|sample| sample.at(horizon)));
        sort(&mut starts_here);
        starts_here.truncate(starts);
        let mut found = problem.spread(&starts_here, effort.jobs, |bench, start| descend(bench, start, horizon));
        sort(&mut found);
        if last {
            return found;
        }
        kept = found.into_iter().map(|found| found.place).collect();
        // What is right to the last digit already needs no more search.
        let mut whole = problem.spread(&kept, effort.jobs, |bench, place| at(bench, place, Horizon::Whole));
        sort(&mut whole);
        if whole.first().is_some_and(|best| best.cost <= ROUNDING) {
            return whole;
        }
        starts = (starts * 2).div_ceil(3).max(2);
    }
    Vec::new() // there is always a last stage
}

fn at(bench: &Bench, place: &[f64], horizon: Horizon) -> Found {
    Found { place: place.to_owned(), cost: bench.cost(place, horizon) }
}

/// By cost; of equal ones the earlier stays the earlier.
fn sort(found: &mut [Found]) {
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
}

/// A place that was tried, and the sum of the squares of its residuals frame by frame and over all targets.
struct Sample {
    place: Vec<f64>,
    frames: Vec<f64>,
    targets: f64,
}

impl Sample {
    fn at(&self, horizon: Horizon) -> Found {
        let sum = match horizon {
            Horizon::Frames(frames) => self.frames.iter().take(frames).sum::<f64>(),
            Horizon::Whole => self.frames.iter().sum::<f64>() + self.targets,
        };
        Found { place: self.place.clone(), cost: sum.sqrt().min(BAD) }
    }
}

/// The scenario's own values, and places spread so that each number's values fill its range evenly (a Latin hypercube).
fn sample(problem: &Problem, effort: Effort) -> Vec<Sample> {
    let n = problem.dimension();
    let count = PLACES * (n + 1);
    let mut random = Random::new(effort.seed);
    let mut places = vec![vec![0.0; n]; count];
    for axis in 0..n {
        let mut rows: Vec<usize> = (0..count).collect();
        for i in (1..count).rev() {
            rows.swap(i, random.below(i + 1));
        }
        for (place, row) in places.iter_mut().zip(rows) {
            place[axis] = (row as f64 + random.unit()) / count as f64;
        }
    }
    places.insert(0, problem.own());
    let frames = problem.recorded.as_ref().map_or(0, super::recorded::Recorded::frames);
    problem.spread(&places, effort.jobs, |bench, place| {
        let square = |numbers: &[f64]| numbers.iter().map(|number| number * number).sum::<f64>();
        let bad = || Sample { place: place.clone(), frames: vec![BAD * BAD; frames], targets: BAD * BAD };
        let Ok(residuals) = bench.run(&problem.values(place), Horizon::Whole) else { return bad() };
        let width = residuals.poses.len() / frames.max(1);
        let targets = residuals.targets.iter().map(|target| target.weight * target.residual).map(|r| r * r).sum();
        let frames = residuals.poses.chunks(width.max(1)).map(square).collect();
        Sample { place: place.clone(), frames, targets }
    })
}

/// How much of the recording each stage looks at: from where the runs that were tried begin to differ, to the end.
fn stages(problem: &Problem, samples: &[Sample]) -> Vec<Horizon> {
    let frames = problem.recorded.as_ref().map_or(0, super::recorded::Recorded::frames);
    let good: Vec<&Sample> = samples.iter().filter(|sample| sample.targets < BAD).collect();
    let differs = |frame: &usize| {
        let of = |sample: &&Sample| sample.frames.get(*frame).copied().unwrap_or(0.0);
        let low = good.iter().map(of).fold(f64::INFINITY, f64::min);
        good.iter().map(of).fold(0.0, f64::max) - low > SAME
    };
    let mut stages = Vec::new();
    if let Some(first) = (0..frames).find(differs) {
        for share in STAGES {
            let until = first + libm::ceil(share * (frames - first) as f64) as usize;
            if until > first + 1 && until < frames {
                stages.push(Horizon::Frames(until));
            }
        }
    }
    stages.push(Horizon::Whole);
    stages
}

/// Follows a place down.
fn descend(bench: &Bench, start: &Found, horizon: Horizon) -> Found {
    let mut found = start.clone();
    for axis in 0..bench.problem.dimension() {
        for share in bench.problem.shares(axis, ALONG) {
            if found.cost <= ROUNDING {
                return found;
            }
            let mut place = start.place.clone();
            place[..axis].copy_from_slice(&found.place[..axis]);
            place[axis] = share;
            let cost = bench.cost(&place, horizon);
            if cost < found.cost {
                found = Found { place, cost };
            }
        }
    }
    if found.cost >= BAD {
        return found;
    }
    let smooth = refine(bench, found.clone(), horizon, None, ROUNDING, LAST_STEPS / 3);
    if smooth.cost <= ROUNDING {
        return smooth;
    }
    let crossed = simplex(bench, &smooth, horizon);
    refine(bench, crossed, horizon, None, ROUNDING, LAST_STEPS)
}

struct Landscape<'a> {
    bench: &'a Bench<'a>,
    horizon: Horizon,
}

impl CostFunction for Landscape<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, place: &Vec<f64>) -> Result<f64, argmin::core::Error> {
        Ok(self.bench.cost(&folded(place), self.horizon))
    }
}

/// Nelder and Mead's simplex from a place.
fn simplex(bench: &Bench, start: &Found, horizon: Horizon) -> Found {
    let corner = |axis: usize| {
        let mut corner = start.place.clone();
        corner[axis] += if corner[axis] < 0.5 { SIMPLEX_SIZE } else { -SIMPLEX_SIZE };
        corner
    };
    let corners = std::iter::once(start.place.clone()).chain((0..bench.problem.dimension()).map(corner)).collect();
    let steps = SIMPLEX_STEPS * (bench.problem.dimension() as u64 + 1);
    let solver = NelderMead::new(corners);
    let run = Executor::new(Landscape { bench, horizon }, solver)
        .configure(|state| state.max_iters(steps).target_cost(ROUNDING))
        .timer(false)
        .run();
    let best = run.ok().and_then(|run| Some((run.state.get_best_param()?.clone(), run.state.get_best_cost())));
    match best {
        Some((place, cost)) if cost < start.cost => Found { place: folded(&place), cost },
        _ => start.clone(),
    }
}

/// A place outside the ranges, mirrored back into them: the landscape goes on without a jump.
fn folded(place: &[f64]) -> Vec<f64> {
    let fold = |share: &f64| {
        let turned = share - 2.0 * libm::floor(0.5 * share);
        if turned > 1.0 { 2.0 - turned } else { turned }
    };
    place.iter().map(fold).collect()
}

#[cfg(test)]
mod tests {
    use super::folded;

    #[test]
    fn places_outside_are_mirrored_into_the_ranges() {
        let mirrored = folded(&[-0.25, 1.25, 0.5, 2.25, -1.5, 1.0]);
        assert_eq!(mirrored, [0.25, 0.75, 0.5, 0.25, 0.5, 1.0]);
    }
}
