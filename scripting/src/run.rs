//! A scenario being run, callbacks and expectations included.

use std::cell::{Ref, RefCell};
use std::fmt;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use choque_engine::{Fault, Hit, Scene, World};
use rhai::Dynamic;

use crate::callbacks::{ON_COLLISION, ON_STEP, STOP_WHEN};
use crate::error::{Complaint, Diagnostic};
use crate::expectation::{Expectation, Failure, When, judge};
use crate::fit::{self, Target};
use crate::handles;
use crate::number::must_give;
use crate::plain;
use crate::script::Script;

/// A scenario being run.
pub struct Run {
    world: Rc<RefCell<World>>,
    steps: u64,
    is_done: bool,
    /// The exchanges of the last iteration.
    hits: Vec<Hit>,
    source: Source,
}

enum Source {
    Plain { file: PathBuf, text: String },
    Script(Box<Scripted>),
}

struct Scripted {
    script: Script,
    /// Of each expectation of the script, how it failed, if it has.
    failures: Vec<Option<Failure>>,
    scene: Scene,
}

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// There are iterations left.
    Going,
    /// All iterations were made, or `stop_when` said so.
    Done,
}

/// Where an iteration stands when it is told of from within.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment<'a> {
    /// `on_step` has been called; nothing has moved yet.
    Commanded,
    /// Every body has advanced, and what overlaps is listed. Continuous motion and lasting contact do more by then.
    Begun,
    /// An exchange was made; `on_collision` has not been called yet.
    Exchanged(&'a Hit),
    /// `on_collision` has been called for it.
    Answered(&'a Hit),
}

impl Run {
    pub(crate) fn plain(world: World, steps: u64, file: &Path, text: &str) -> Self {
        let source = Source::Plain { file: file.to_owned(), text: text.to_owned() };
        Run { world: Rc::new(RefCell::new(world)), steps, is_done: steps == 0, hits: Vec::new(), source }
    }

    /// A run of a script. The ledger is kept when the script reads it: without the word no script can.
    pub(crate) fn scripted(script: Script, mut world: World, scene: &Scene) -> Self {
        if script.speaks_of("ledger") {
            world.keep_ledger();
        }
        let world = Rc::new(RefCell::new(world));
        script.enter(world.clone());
        let failures = script.pending.iter().map(|_| None).collect();
        let steps = scene.settings.steps;
        let source = Source::Script(Box::new(Scripted { script, failures, scene: scene.clone() }));
        Run { world, steps, is_done: steps == 0, hits: Vec::new(), source }
    }

    /// The world as it stands.
    #[must_use]
    pub fn world(&self) -> Ref<'_, World> {
        self.world.borrow()
    }

    /// Has the world keep a ledger from now on ([`World::keep_ledger`]).
    pub fn keep_ledger(&mut self) {
        self.world.borrow_mut().keep_ledger();
    }

    /// Has the world remember which bodies callbacks write to ([`World::remember_commands`]).
    pub fn remember_commands(&mut self) {
        self.world.borrow_mut().remember_commands();
    }

    /// Lets an iteration be shared by up to so many threads ([`World::set_threads`]).
    pub fn set_threads(&mut self, threads: usize) {
        self.world.borrow_mut().set_threads(threads);
    }

    /// The exchanges of the last iteration, in order.
    #[must_use]
    pub fn hits(&self) -> &[Hit] {
        &self.hits
    }

    /// One iteration: `on_step`, advance, an `on_collision` after each exchange, `always`, `stop_when`.
    /// Makes none once the run is done.
    ///
    /// # Errors
    /// An error in a callback; a body that left the finite numbers.
    pub fn step(&mut self) -> Result<Step, Diagnostic> {
        self.step_told(&mut |_, _| {})
    }

    /// The same, telling of every moment within the iteration and of the world as it is then.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_told(&mut self, tell: &mut impl FnMut(&World, Moment)) -> Result<Step, Diagnostic> {
        if self.is_done {
            return Ok(Step::Done);
        }
        self.hits.clear();
        let stop = match &mut self.source {
            Source::Plain { .. } => {
                iterate_alone(&self.world, &mut self.hits, tell);
                false
            }
            Source::Script(scripted) => scripted.iterate(&self.world, &mut self.hits, tell)?,
        };
        let world = self.world.borrow();
        if let Some(fault) = world.fault() {
            return Err(self.source.blame(fault));
        }
        self.is_done = stop || world.iteration() >= self.steps;
        Ok(if self.is_done { Step::Done } else { Step::Going })
    }

    /// Judges every `expect` on the world as it stands, and tells of all expectations in the script's order.
    ///
    /// # Errors
    /// An error in an expectation.
    pub fn conclude(&mut self) -> Result<Vec<Expectation>, Diagnostic> {
        let Source::Script(scripted) = &mut self.source else { return Ok(Vec::new()) };
        scripted.judge(When::AtTheEnd)?;
        let told = scripted.script.pending.iter().zip(&scripted.failures);
        Ok(told.map(|(pending, failure)| Expectation::new(&pending.text, failure.as_ref())).collect())
    }
}

impl Run {
    /// What the targets of the script come to on the world as it stands, in the script's order.
    ///
    /// # Errors
    /// An error in a target.
    pub fn measure(&self) -> Result<Vec<Target>, Diagnostic> {
        let Source::Script(scripted) = &self.source else { return Ok(Vec::new()) };
        scripted.script.aims.iter().map(|aim| fit::measure(&scripted.script, aim)).collect()
    }

    /// A complaint about the target of that number, shown where the script declares it.
    #[must_use]
    pub fn complain_of_target(&self, which: usize, message: &str, hint: &str) -> Diagnostic {
        let complaint = Complaint::new(message).hint(hint);
        match &self.source {
            Source::Script(scripted) if which < scripted.script.aims.len() => {
                scripted.script.complain_of(&scripted.script.aims[which].pending, complaint)
            }
            _ => Diagnostic::of(complaint),
        }
    }
}

impl fmt::Debug for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let world = self.world.borrow();
        f.debug_struct("Run").field("iteration", &world.iteration()).field("steps", &self.steps).finish_non_exhaustive()
    }
}

impl Scripted {
    /// One iteration; gives whether the script wants to stop after it.
    fn iterate(
        &mut self,
        world: &RefCell<World>,
        hits: &mut Vec<Hit>,
        tell: &mut impl FnMut(&World, Moment),
    ) -> Result<bool, Diagnostic> {
        let callbacks = self.script.callbacks;
        if callbacks.on_step {
            drop(self.script.call(ON_STEP, &mut [Dynamic::from(handles::World)])?);
            tell(&world.borrow(), Moment::Commanded);
        }
        if callbacks.on_collision {
            world.borrow_mut().begin();
            tell(&world.borrow(), Moment::Begun);
            while let Some(hit) = next_hit(world) {
                hits.push(hit);
                tell(&world.borrow(), Moment::Exchanged(&hit));
                let told = Dynamic::from(handles::Hit::from(hit));
                drop(self.script.call(ON_COLLISION, &mut [Dynamic::from(handles::World), told])?);
                tell(&world.borrow(), Moment::Answered(&hit));
            }
            world.borrow_mut().finish();
        } else {
            iterate_alone(world, hits, tell);
        }
        if world.borrow().fault().is_some() {
            return Ok(true);
        }
        if callbacks.always > 0 {
            self.judge(When::AfterEveryIteration)?;
        }
        Ok(callbacks.stop_when && self.wants_to_stop()?)
    }

    fn wants_to_stop(&self) -> Result<bool, Diagnostic> {
        let answer = self.script.call(STOP_WHEN, &mut [Dynamic::from(handles::World)])?;
        answer.as_bool().map_err(|_| {
            let complaint = must_give(STOP_WHEN, &answer);
            self.script.complain_of_callback(STOP_WHEN, complaint)
        })
    }

    /// Judges the expectations whose time it is; one that has failed stays so.
    fn judge(&mut self, when: When) -> Result<(), Diagnostic> {
        for (pending, failure) in self.script.pending.iter().zip(&mut self.failures) {
            let is_judged_again = when == When::AtTheEnd || failure.is_none();
            if pending.when == when && is_judged_again {
                *failure = judge(&self.script, pending)?;
            }
        }
        Ok(())
    }
}

/// The next exchange; none after a body has left the finite numbers, for there is nothing to tell of it.
fn next_hit(world: &RefCell<World>) -> Option<Hit> {
    let mut world = world.borrow_mut();
    let hit = world.treat_next()?;
    world.fault().is_none().then_some(hit)
}

/// A whole iteration that no callback interrupts.
fn iterate_alone(world: &RefCell<World>, hits: &mut Vec<Hit>, tell: &mut impl FnMut(&World, Moment)) {
    let mut world = world.borrow_mut();
    world.begin();
    tell(&world, Moment::Begun);
    while let Some(hit) = world.treat_next() {
        tell(&world, Moment::Exchanged(&hit));
        hits.push(hit);
    }
    world.finish();
}

impl Source {
    /// A body that left the finite numbers, shown where it was made.
    fn blame(&self, fault: &Fault) -> Diagnostic {
        match self {
            Source::Plain { file, text } => plain::complain_of_body(file, text, Some(&fault.body), fault.to_string()),
            Source::Script(scripted) => {
                let complaint = Complaint::new(fault.to_string());
                scripted.script.complain_of_body(&scripted.scene, Some(&fault.body), complaint)
            }
        }
        .with_hint(Some("look for a huge velocity, mass or force; `always` can tell when it begins".to_owned()))
    }
}
