//! What is searched: from values to residuals, by running the scenario with them.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use choque_scripting::{Options, Output, Run, Scenario, Step, Target, Varied};

use super::recorded::Recorded;
use crate::Error;
use crate::arguments::ScenarioArguments;
use crate::progress::Progress;
use crate::report::jobs::spread_with;

/// What stands for the cost of values that a run cannot be made with: worse than anything, and still a number.
pub const BAD: f64 = 1e100;

/// A scenario, what may vary in it and what it should come to. Threads share it; each works at a [`Bench`] of its own.
#[derive(Debug)]
pub struct Problem {
    file: PathBuf,
    arguments: ScenarioArguments,
    /// What may vary, and between what.
    pub varied: Vec<Varied>,
    /// Which of it takes whole values only.
    pub whole: Vec<bool>,
    /// What runs are compared with.
    pub recorded: Option<Recorded>,
    tally: Mutex<Tally>,
}

/// How many runs were made, and who is told.
#[derive(Debug)]
struct Tally {
    runs: u64,
    progress: Option<Progress>,
}

/// How much of a run counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Horizon {
    /// That many frames of the recording, without the targets: what happens later is not looked at yet.
    Frames(usize),
    /// All of it.
    Whole,
}

/// What a run came to; every number should be 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Residuals {
    /// As the script tells of them, in its order.
    pub targets: Vec<Target>,
    /// Of bodies from a recording, frame by frame.
    pub poses: Vec<f64>,
}

impl Residuals {
    /// Every number, targets with their weights.
    #[must_use]
    pub fn all(&self) -> Vec<f64> {
        self.targets.iter().map(|target| target.weight * target.residual).chain(self.poses.iter().copied()).collect()
    }

    /// The root of the sum of their squares: of a recording the root of the mean square distance in body sizes, to which
    /// targets are added as they are.
    #[must_use]
    pub fn cost(&self) -> f64 {
        length(&self.all())
    }

    /// Of the recording alone.
    #[must_use]
    pub fn distance(&self) -> f64 {
        length(&self.poses)
    }
}

fn length(numbers: &[f64]) -> f64 {
    numbers.iter().map(|number| number * number).sum::<f64>().sqrt()
}

impl Problem {
    /// For a file and what may vary in it.
    #[must_use]
    pub fn new(file: &Path, arguments: &ScenarioArguments, varied: Vec<Varied>, recorded: Option<Recorded>) -> Self {
        let tally = Mutex::new(Tally { runs: 0, progress: None });
        let whole = vec![false; varied.len()];
        Problem { file: file.to_owned(), arguments: arguments.clone(), varied, whole, recorded, tally }
    }

    /// Finds out which numbers count something: of those that the script writes as whole numbers the ones with which no run
    /// can be made in between, or where what lies in between is all the same although whole numbers are not.
    pub fn find_whole(&mut self, written_whole: impl Fn(&str) -> bool) {
        for axis in 0..self.dimension() {
            self.whole[axis] = written_whole(&self.varied[axis].name) && self.counts(axis);
        }
    }

    fn counts(&self, axis: usize) -> bool {
        let (min, max) = self.varied[axis].range;
        let own = self.varied[axis].value.clamp(min, max);
        let from = if own + 1.0 <= max { own } else { own - 1.0 };
        if from < min || from.fract() != 0.0 {
            return false;
        }
        let bench = self.bench();
        let residuals = |value: f64| {
            let mut values = self.values(&self.own());
            values[axis].1 = value;
            bench.run(&values, Horizon::Whole).ok().map(|residuals| residuals.all())
        };
        let [low, third, half, high] = [0.0, 0.3, 0.55, 1.0].map(|more| residuals(from + more));
        match (third, half) {
            (Some(third), Some(half)) => third == half && low != high,
            (None, None) => low.is_some() || high.is_some(),
            _ => false,
        }
    }

    /// How many numbers vary.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.varied.len()
    }

    /// The scenario's own values, as shares of their ranges.
    #[must_use]
    pub fn own(&self) -> Vec<f64> {
        self.varied.iter().enumerate().map(|(axis, varied)| self.share(axis, varied.value)).collect()
    }

    /// The share of its range at which a number has a value.
    #[must_use]
    pub fn share(&self, axis: usize, value: f64) -> f64 {
        let (min, max) = self.varied[axis].range;
        ((value - min) / (max - min)).clamp(0.0, 1.0)
    }

    /// The values at a place, whose coordinates are shares of the ranges.
    #[must_use]
    pub fn values(&self, place: &[f64]) -> Vec<(String, f64)> {
        let value = |(axis, share): (usize, &f64)| (self.varied[axis].name.clone(), self.value(axis, *share));
        place.iter().enumerate().map(value).collect()
    }

    /// The value of one number at a share of its range.
    #[must_use]
    pub fn value(&self, axis: usize, share: f64) -> f64 {
        let (min, max) = self.varied[axis].range;
        let value = (min + share * (max - min)).clamp(min, max);
        if self.whole[axis] { value.round().clamp(min.ceil(), max.floor()) } else { value }
    }

    /// Shares of a number's range worth trying one after the other: all whole numbers where it takes no others, else so many
    /// evenly.
    #[must_use]
    pub fn shares(&self, axis: usize, even: usize) -> Vec<f64> {
        const MOST_WHOLE: f64 = 64.0;
        let (min, max) = self.varied[axis].range;
        let (first, last) = (min.ceil(), max.floor());
        if self.whole[axis] && last - first < MOST_WHOLE {
            return (0..=(last - first) as usize).map(|step| (first + step as f64 - min) / (max - min)).collect();
        }
        (0..even).map(|step| (step as f64 + 0.5) / even as f64).collect()
    }

    /// A place to make runs at, for one thread.
    #[must_use]
    pub fn bench(&self) -> Bench<'_> {
        Bench { problem: self, loaded: OnceCell::new() }
    }

    /// Does every job, on that many threads, each at a bench of its own.
    pub fn spread<J: Sync, A: Send>(
        &self,
        jobs: &[J],
        threads: usize,
        work: impl Fn(&Bench, &J) -> A + Sync,
    ) -> Vec<A> {
        spread_with(jobs, threads, || self.bench(), work)
    }

    /// How many runs were made so far.
    #[must_use]
    pub fn runs(&self) -> u64 {
        self.tally().runs
    }

    /// From now on someone is told how many of the runs that are expected have been made.
    pub fn expect(&self, more: u64) {
        let mut tally = self.tally();
        tally.progress = Some(Progress::of(tally.runs + more, "runs"));
    }

    /// Takes the bar away.
    pub fn hush(&self) {
        self.tally().progress = None;
    }

    fn count(&self) {
        let mut tally = self.tally();
        tally.runs += 1;
        let runs = tally.runs;
        if let Some(progress) = &mut tally.progress {
            progress.reached(runs);
        }
    }

    fn tally(&self) -> std::sync::MutexGuard<'_, Tally> {
        self.tally.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Where one thread makes runs of a problem: the scenario is read and compiled once, and only its main part runs again.
#[derive(Debug)]
pub struct Bench<'a> {
    /// What is searched.
    pub problem: &'a Problem,
    loaded: OnceCell<Scenario>,
}

impl Bench<'_> {
    /// The scenario with these values.
    fn scenario(&self, values: &[(String, f64)]) -> Result<Scenario, Error> {
        let Problem { file, arguments, .. } = self.problem;
        // What the script prints is not wanted a hundred times.
        let options = Options { output: Output::to(|_| {}), ..arguments.options() };
        let known = match self.loaded.get() {
            Some(known) => known,
            None => {
                let read = Scenario::load(file, &options)?;
                self.loaded.get_or_init(|| read)
            }
        };
        Ok(known.with(&[options.set.as_slice(), values].concat(), options.overrides)?)
    }

    /// Runs the scenario with these values.
    ///
    /// # Errors
    /// What is wrong with the scenario there; a target that is no finite number.
    pub fn run(&self, values: &[(String, f64)], horizon: Horizon) -> Result<Residuals, Error> {
        self.problem.count();
        let mut run = self.scenario(values)?.start()?;
        let steps = run.world().plan().steps;
        let mut poses = Vec::new();
        if let Some(recorded) = &self.problem.recorded {
            let frames = match horizon {
                Horizon::Frames(frames) => frames.min(recorded.frames()),
                Horizon::Whole => recorded.frames(),
            };
            for frame in 0..frames {
                advance(&mut run, recorded.iteration(frame))?;
                recorded.compare(frame, &run.world(), &mut poses);
            }
        }
        if horizon != Horizon::Whole {
            return Ok(Residuals { targets: Vec::new(), poses });
        }
        advance(&mut run, steps)?;
        let targets = run.measure()?;
        if let Some(which) = targets.iter().position(|target| !target.residual.is_finite()) {
            let Target { text, residual, .. } = &targets[which];
            let message = format!("target \"{text}\" came to {residual}, which is no number to bring to 0");
            let hint = "look for a division by zero in it, or for a root of what may be negative";
            return Err(run.complain_of_target(which, &message, hint).into());
        }
        Ok(Residuals { targets, poses })
    }

    /// The residuals at a place; `None` where no run can be made.
    #[must_use]
    pub fn residuals(&self, place: &[f64], horizon: Horizon) -> Option<Vec<f64>> {
        self.run(&self.problem.values(place), horizon).ok().map(|residuals| residuals.all())
    }

    /// The root of the sum of their squares; [`BAD`] where no run can be made.
    #[must_use]
    pub fn cost(&self, place: &[f64], horizon: Horizon) -> f64 {
        self.residuals(place, horizon).map_or(BAD, |residuals| length(&residuals).min(BAD))
    }
}

/// Goes on to an iteration, or to where the script stops the run: there everything stays.
fn advance(run: &mut Run, iteration: u64) -> Result<(), Error> {
    while run.world().iteration() < iteration && run.step()? == Step::Going {}
    Ok(())
}
