//! The state behind the words: a scene being built, then a world that runs.
//!
//! Words are plain functions; they reach the session through the engine's tag. A script's handle on a body is
//! an index and nothing more, so `let car = mobile("car")` serves both phases.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::rc::Rc;

use choque_engine::{BodyId, World};
use rhai::{Dynamic, EvalAltResult, ImmutableString, Module, NativeCallContext, Position, Shared};

use crate::draft::Draft;
use crate::error::Complaint;
use crate::expectation::{Pending, Reading};
use crate::fit::{Aim, Variable};
use crate::generator::Generator;
use crate::library::Library;
use crate::params::Params;

/// What a word gives back to the script.
pub(crate) type RhaiResultOf<T> = Result<T, Box<EvalAltResult>>;

/// A place in a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Site {
    /// The script's name, as errors show it.
    pub(crate) source: ImmutableString,
    /// Line and column.
    pub(crate) position: Position,
}

impl Site {
    /// Where a word is being called.
    pub(crate) fn of(context: &NativeCallContext) -> Site {
        Site { source: context.call_source().unwrap_or_default().into(), position: context.call_position() }
    }

    /// Of what no script says.
    pub(crate) fn nowhere() -> Site {
        Site { source: ImmutableString::new(), position: Position::NONE }
    }

    /// "line 3", or "line 3 of lib/cars.rhai" when seen from another file.
    pub(crate) fn seen_from(&self, other: &Site) -> String {
        let line = self.position.line().unwrap_or(1);
        if self.source == other.source { format!("line {line}") } else { format!("line {line} of {}", self.source) }
    }
}

/// Everything one load of a script works on.
pub(crate) struct Session {
    pub(crate) phase: Phase,
    pub(crate) params: Params,
    pub(crate) generator: Generator,
    /// The seed given from outside, which wins over that of the main part.
    pub(crate) seed: Option<i64>,
    /// The modules imported so far, by their one true path: each runs once, however often it is imported.
    pub(crate) modules: BTreeMap<PathBuf, Shared<Module>>,
    /// What the script expects, in its order; taken out when the main part has ended.
    pub(crate) pending: Vec<Pending>,
    /// What it wants of a run, likewise.
    pub(crate) aims: Vec<Aim>,
    /// What may vary for that.
    pub(crate) variables: Vec<Variable>,
    /// What an expectation reads while it is being judged; `None` while none is.
    pub(crate) readings: Option<Vec<Reading>>,
    /// The room that readings had last time.
    spare: Vec<Reading>,
    /// Where models are looked up.
    pub(crate) library: Rc<Library>,
}

/// What a script is doing.
pub(crate) enum Phase {
    /// The main part: it makes a scene.
    Building(Box<Draft>),
    /// Callbacks and expectations: they see a world.
    Running(Running),
}

/// A world and the handles into it.
pub(crate) struct Running {
    pub(crate) world: Rc<RefCell<World>>,
    /// By index of creation, as script handles are.
    ids: Vec<BodyId>,
}

impl Running {
    pub(crate) fn new(world: Rc<RefCell<World>>) -> Self {
        let ids = world.borrow().ids().collect();
        Running { world, ids }
    }

    /// The body of a handle.
    pub(crate) fn id(&self, index: u32) -> Result<BodyId, Complaint> {
        self.ids.get(index as usize).copied().ok_or_else(|| Complaint::new("this body belongs to another scene"))
    }
}

impl Session {
    /// A session at the beginning of the main part.
    pub(crate) fn new(params: Params, seed: Option<i64>, library: Rc<Library>) -> Self {
        Session {
            phase: Phase::Building(Box::default()),
            params,
            generator: Generator::new(seed.unwrap_or(0)),
            seed,
            modules: BTreeMap::new(),
            pending: Vec::new(),
            aims: Vec::new(),
            variables: Vec::new(),
            readings: None,
            spare: Vec::new(),
            library,
        }
    }

    /// The scene being built, for a word that builds.
    pub(crate) fn draft(&mut self, word: &str) -> Result<&mut Draft, Complaint> {
        match &mut self.phase {
            Phase::Building(draft) => Ok(draft),
            Phase::Running(_) => Err(Complaint::new(format!(
                "`{word}` builds the scene: it belongs to the main part of the script, not to a callback"
            ))),
        }
    }

    /// The world, for a word that looks at it.
    pub(crate) fn running(&self) -> Result<&Running, Complaint> {
        match &self.phase {
            Phase::Running(running) => Ok(running),
            Phase::Building(_) => Err(Complaint::new("there is no world yet while the scene is being built")
                .hint("the world exists in callbacks and expectations: fn on_step(world) { … }")),
        }
    }

    /// The world, for a word that changes it: an expectation or a target only looks.
    pub(crate) fn changing(&self) -> Result<&Running, Complaint> {
        if self.readings.is_some() {
            return Err(Complaint::new("an expectation or a target only looks: it must not change the world")
                .hint("change it in `fn on_step(world)`"));
        }
        self.running()
    }
}

/// What expectations read.
impl Session {
    /// From now on what is read is kept.
    pub(crate) fn start_reading(&mut self) {
        self.readings = Some(std::mem::take(&mut self.spare));
    }

    /// Keeps what is read, while an expectation is being judged.
    pub(crate) fn read(&mut self, subject: Option<u32>, property: &'static str, value: f64) -> f64 {
        if let Some(readings) = &mut self.readings {
            readings.push(Reading { subject, property, value });
        }
        value
    }

    /// Keeps the room of readings nobody asks for.
    pub(crate) fn reuse(&mut self, mut readings: Vec<Reading>) {
        readings.clear();
        self.spare = readings;
    }

    /// Readings by name, each once.
    pub(crate) fn name_readings(&self, readings: &[Reading]) -> Vec<(String, f64)> {
        let Phase::Running(running) = &self.phase else { return Vec::new() };
        let world = running.world.borrow();
        let mut numbers: Vec<(String, f64)> = Vec::new();
        for Reading { subject, property, value } in readings {
            let id = subject.and_then(|index| running.id(index).ok());
            let name = format!("{}.{property}", id.map_or("world", |id| world.name(id)));
            if !numbers.iter().any(|(known, number)| *known == name && number.to_bits() == value.to_bits()) {
                numbers.push((name, *value));
            }
        }
        numbers
    }
}

/// The tag by which words find their session.
#[derive(Clone)]
pub(crate) struct SessionTag(pub(crate) Rc<RefCell<Session>>);

/// The session that a tag leads to.
pub(crate) fn of(tag: &Dynamic) -> Option<Rc<RefCell<Session>>> {
    tag.read_lock::<SessionTag>().map(|tag| tag.0.clone())
}

/// Has a word work on the session; its complaint becomes a script error at the place of the call.
pub(crate) fn with<T>(
    context: &NativeCallContext,
    work: impl FnOnce(&mut Session) -> Result<T, Complaint>,
) -> RhaiResultOf<T> {
    let tag = context.tag().and_then(|tag| tag.read_lock::<SessionTag>());
    let outcome = match tag.as_ref().map(|tag| tag.0.try_borrow_mut()) {
        Some(Ok(mut session)) => work(&mut session),
        _ => Err(Complaint::new("the words of a scenario work in a scenario only")),
    };
    outcome.map_err(|complaint| complain(complaint, context.call_position()))
}

/// Has a word of the main part work on the scene being built.
pub(crate) fn build<T>(
    context: &NativeCallContext,
    work: impl FnOnce(&mut Draft) -> Result<T, Complaint>,
) -> RhaiResultOf<T> {
    with(context, |session| work(session.draft(context.fn_name())?))
}

/// A complaint as a script error at a place; scripts may catch it, and rethrow it unharmed.
pub(crate) fn complain(complaint: Complaint, position: Position) -> Box<EvalAltResult> {
    EvalAltResult::ErrorRuntime(Dynamic::from(complaint), position).into()
}
