//! One run for a page: what is there to tune, then the frames as they come, then what it came to.

use std::cell::RefCell;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::{Duration, Instant};

use choque_engine::note;
use choque_scripting::{Diagnostic, Options, Output, Run, Scenario, Step, Stop};
use serde_json::{Value, json};

use super::expected::Expected;
use super::files::{Seen, digest, watching};
use super::queue::Answer;
use super::{message, sliders};
use crate::arguments::ScenarioArguments;
use crate::clock::now;
use crate::harness::snapshot_of;
use crate::outcome::{Judgement, Outcome};
use crate::play::Watch;
use crate::player::plain_film;
use crate::recording::recorder::{InMemory, Recorder, Settings};

/// The first frames are sent after that time, and again whenever as much time has passed as until then: a page shows something
/// at once, and all that is sent twice is as much as is sent once.
const FIRST_FRAMES: Duration = Duration::from_millis(12);
/// States of bodies that are kept of a run, 48 bytes each; of a longer one every second frame, or every third …
const MOST_STATES: u64 = 3_000_000;
/// Lines that a script may print to the page, and the characters of each.
const MOST_PRINTED: (usize, usize) = (200, 500);

/// Bytes of a text that is shown around an error.
const LONGEST_SHOWN: usize = 1 << 20;

/// What a page asks for.
pub(super) struct Job {
    pub(super) path: PathBuf,
    /// The values of the sliders that were moved.
    pub(super) set: Vec<(String, f64)>,
    pub(super) arguments: ScenarioArguments,
    /// How long it may take in all.
    pub(super) time: Duration,
}

/// Why a run did not come to its end.
enum Broken {
    Error(Box<Diagnostic>),
    /// Nobody wants it any more.
    Unwanted,
}

impl From<Diagnostic> for Broken {
    fn from(error: Diagnostic) -> Self {
        Broken::Error(Box::new(error))
    }
}

/// What is kept of a scenario from one run to the next: as long as none of its files changes, only its main part runs again.
struct Kept {
    path: PathBuf,
    /// Once it could be loaded.
    scenario: RefCell<Option<Rc<Scenario>>>,
    seen: Rc<RefCell<Seen>>,
    printed: Rc<RefCell<Vec<String>>>,
    expected: Option<Result<Expected, String>>,
}

impl Kept {
    fn of(path: &Path) -> Self {
        let seen = Rc::new(RefCell::new(Seen::default()));
        let expected = snapshot_of(path).and_then(|snapshot| {
            seen.borrow_mut().add(&snapshot);
            Expected::of(&snapshot)
        });
        Kept { path: path.to_owned(), scenario: RefCell::default(), seen, printed: Rc::default(), expected }
    }

    fn still_holds(&self, path: &Path) -> bool {
        let seen = self.seen.borrow();
        self.path == path && self.scenario.borrow().is_some() && seen.stamp() == seen.stamp_now()
    }
}

/// What the thread of a run keeps for the next.
#[derive(Default)]
pub(super) struct Shelf(Option<Kept>);

/// Runs a scenario and sends what comes of it; gives the files it was made of.
pub(super) fn run(job: &Job, shelf: &mut Shelf, answer: &Answer, stop: &Stop) -> Seen {
    let begun = now();
    let kept = shelf.0.take().filter(|kept| kept.still_holds(&job.path)).unwrap_or_else(|| Kept::of(&job.path));
    let desk = Desk { job, answer, stop, begun, kept: &kept };
    if let Err(Broken::Error(error)) = desk.play() {
        desk.say_printed();
        desk.say(&json!({
            "event": "error", "text": error.to_string(), "line": error.line, "source": desk.pointed_at(&error),
            "stamp": kept.seen.borrow().stamp(),
        }));
    }
    let seen = kept.seen.borrow().clone();
    shelf.0 = Some(kept);
    seen
}

/// What a run works with.
struct Desk<'a> {
    job: &'a Job,
    answer: &'a Answer,
    stop: &'a Stop,
    begun: Instant,
    kept: &'a Kept,
}

impl Desk<'_> {
    fn play(&self) -> Result<(), Broken> {
        let (scenario, dropped) = self.load()?;
        let mut run = scenario.start()?;
        self.say_scene(&scenario, &run, &dropped);
        let bodies = run.world().len() as u64;
        let states = bodies.saturating_mul(run.world().plan().steps);
        let settings = Settings { every: states / MOST_STATES + 1, ledger: true, command: Vec::new() };
        let mut recorder = Recorder::in_memory(&scenario, &mut run, &settings);
        self.iterate(&mut run, &mut recorder)?;
        let expectations = run.conclude()?;
        let world = run.world();
        let judgements: Vec<Judgement> = expectations.iter().cloned().map(Judgement::from).collect();
        let outcome = Outcome::new(&scenario, &world, expectations);
        self.say_film(&recorder.finish(&world, &judgements))?;
        self.say_printed();
        let difference = self.kept.expected.as_ref().and_then(|expected| expected.as_ref().ok());
        let difference = difference.map(|expected| expected.difference(&world));
        self.say(&json!({ "event": "done", "outcome": told(&outcome), "difference": difference }));
        Ok(())
    }

    /// The scenario with the sliders' values; those that it no longer knows, or that are out of bounds by now, are dropped and
    /// named. A script that is wrong without any is told of as it is.
    fn load(&self) -> Result<(Rc<Scenario>, Vec<String>), Broken> {
        let set = &self.job.set;
        let wrong = match self.load_with(set) {
            Ok(scenario) => return Ok((scenario, Vec::new())),
            Err(wrong) => wrong,
        };
        self.go_on()?;
        let plain = self.load_with(&[])?;
        let known = |(name, value): &&(String, f64)| {
            let control = plain.controls().iter().find(|control| control.name == *name);
            control.is_some_and(|control| control.range.is_none_or(|(min, max)| (min..=max).contains(value)))
        };
        let (kept, dropped): (Vec<_>, Vec<_>) = set.iter().partition(known);
        if dropped.is_empty() {
            return Err(wrong.into());
        }
        let kept: Vec<(String, f64)> = kept.into_iter().cloned().collect();
        let dropped = dropped.into_iter().map(|(name, _)| name.clone()).collect();
        Ok((self.load_with(&kept)?, dropped))
    }

    fn load_with(&self, set: &[(String, f64)]) -> Result<Rc<Scenario>, Diagnostic> {
        let Kept { scenario, seen, printed, .. } = self.kept;
        printed.borrow_mut().clear();
        let given = self.job.arguments.options();
        let set = [given.set.as_slice(), set].concat();
        if let Some(known) = &*scenario.borrow() {
            known.heed(self.stop);
            return known.with(&set, given.overrides).map(Rc::new);
        }
        let printed = printed.clone();
        let options = Options {
            set,
            output: Output::to(move |line| {
                let mut printed = printed.borrow_mut();
                if printed.len() < MOST_PRINTED.0 {
                    printed.push(line.chars().take(MOST_PRINTED.1).collect());
                }
            }),
            reads: watching(seen),
            stop: self.stop.clone(),
            script_timeout: given.script_timeout.min(self.job.time),
            ..given
        };
        let loaded = Rc::new(Scenario::load(&self.job.path, &options)?);
        scenario.replace(Some(loaded.clone()));
        Ok(loaded)
    }

    /// Plays to the end, or as long as it may; sends frames now and then.
    fn iterate(&self, run: &mut Run, recorder: &mut Recorder<InMemory>) -> Result<(), Broken> {
        let steps = run.world().plan().steps;
        let mut due = FIRST_FRAMES;
        while run.world().iteration() < steps {
            self.go_on()?;
            let step = run.step_told(&mut |world, moment| recorder.moment(world, moment))?;
            recorder.iteration(&run.world(), run.hits());
            if step == Step::Done {
                break;
            }
            let passed = self.begun.elapsed();
            if passed > self.job.time {
                return Err(self.out_of_time(run.world().iteration(), steps).into());
            }
            if passed > due {
                self.say_film(&recorder.so_far())?;
                self.say_printed();
                due = 2 * self.begun.elapsed();
            }
        }
        Ok(())
    }

    /// Nothing is done for a page that has gone.
    fn go_on(&self) -> Result<(), Broken> {
        if self.stop.is_asked() { Err(Broken::Unwanted) } else { Ok(()) }
    }

    fn out_of_time(&self, iteration: u64, steps: u64) -> Diagnostic {
        let seconds = self.job.time.as_secs_f64();
        Diagnostic::new(format!(
            "the run took more than {seconds} s and was stopped at iteration {iteration} of {steps}"
        ))
        .in_file(&self.job.path)
        .with_hint(Some("choque studio --run-timeout gives it more time; steps(n) makes it shorter".to_owned()))
    }

    /// The whole text that an error points into, for the page to show the line where it stands.
    fn pointed_at(&self, error: &Diagnostic) -> Option<Value> {
        let file = error.file.as_ref().filter(|file| error.line.is_some() && self.kept.seen.borrow().has(file))?;
        let text = fs::read(file).ok().filter(|bytes| bytes.len() <= LONGEST_SHOWN)?;
        Some(json!({ "name": file.display().to_string(), "text": String::from_utf8_lossy(&text) }))
    }

    fn say(&self, event: &Value) {
        self.answer.send(message::text(event));
    }

    fn say_scene(&self, scenario: &Scenario, run: &Run, dropped: &[String]) {
        let world = run.world();
        let plan = world.plan();
        let (ghosts, unreadable) = match &self.kept.expected {
            Some(Ok(expected)) => (Some(expected.ghosts()), None),
            Some(Err(why)) => (None, Some(why)),
            None => (None, None),
        };
        let notes: Vec<String> =
            note::review(scenario.scene(), &world).iter().map(std::string::ToString::to_string).collect();
        self.say(&json!({
            "event": "scene", "title": scenario.title(), "steps": plan.steps, "time_step": plan.time_step,
            "bodies": world.len(), "sliders": sliders::of(scenario.controls(), scenario.scene()), "dropped": dropped,
            "is_script": Scenario::is_script(&self.job.path), "notes": notes, "expected": ghosts, "unreadable": unreadable, "text": scenario.text(),
            "digest": digest(scenario.text()), "stamp": self.kept.seen.borrow().stamp(),
        }));
    }

    fn say_film(&self, recording: &crate::recording::Recording) -> Result<(), Broken> {
        self.go_on()?;
        let film = plain_film(recording).map_err(|error| Diagnostic::new(error.to_string()).in_file(&self.job.path))?;
        self.answer.send(message::film(&film));
        Ok(())
    }

    /// What the script printed since the last time.
    fn say_printed(&self) {
        let lines = self.kept.printed.borrow();
        if !lines.is_empty() {
            self.say(&json!({ "event": "printed", "lines": *lines }));
        }
    }
}

/// What a page shows of an outcome; bodies are in the film.
fn told(outcome: &Outcome) -> Value {
    json!({
        "steps": outcome.steps, "time": outcome.time, "collisions": outcome.collisions, "momentum": outcome.momentum,
        "kinetic_energy": outcome.kinetic_energy, "angular_momentum": outcome.angular_momentum, "deepest": outcome.deepest,
        "digest": outcome.digest, "expectations": outcome.expectations,
    })
}
