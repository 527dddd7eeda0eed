//! Expectations: what a script says must hold, and the numbers that show why it did not.

use rhai::{Dynamic, FnPtr, GlobalRuntimeState, ImmutableString};

use crate::error::Diagnostic;
use crate::handles;
use crate::number::must_give;
use crate::script::Script;
use crate::session::Site;

/// A judged `expect` or `always`.
#[derive(Clone, Debug, PartialEq)]
pub struct Expectation {
    /// What the script says.
    pub text: String,
    /// Whether it held.
    pub held: bool,
    /// `world.iteration` when it first did not hold; `None` when it held.
    pub first_failure: Option<u64>,
    /// When it did not hold, what it had read by then, in that order: `("car2.speed", 2.71)`.
    pub numbers: Vec<(String, f64)>,
}

impl Expectation {
    pub(crate) fn new(text: &str, failure: Option<&Failure>) -> Self {
        Expectation {
            text: text.to_owned(),
            held: failure.is_none(),
            first_failure: failure.map(|failure| failure.iteration),
            numbers: failure.map(|failure| failure.numbers.clone()).unwrap_or_default(),
        }
    }
}

/// When an expectation is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum When {
    /// `expect`: once, at the end.
    AtTheEnd,
    /// `always`: after every iteration, until it fails.
    AfterEveryIteration,
    /// `target`: once, at the end, and by whoever wants the number.
    Measured,
}

/// An expectation or a target as a script declares it.
pub(crate) struct Pending {
    pub(crate) text: ImmutableString,
    pub(crate) when: When,
    pub(crate) judge: FnPtr,
    /// What the closure may call: its own script's functions, imports and constants.
    pub(crate) surroundings: GlobalRuntimeState,
    pub(crate) site: Site,
}

impl Pending {
    /// `always "nothing explodes"`.
    pub(crate) fn title(&self) -> String {
        let word = match self.when {
            When::AtTheEnd => "expect",
            When::AfterEveryIteration => "always",
            When::Measured => "target",
        };
        format!("{word} \"{}\"", self.text)
    }
}

/// How an expectation failed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Failure {
    iteration: u64,
    numbers: Vec<(String, f64)>,
}

/// A number an expectation read. What is read is kept while it is judged, rather than judged a second time to
/// see: a closure may count, or draw random numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reading {
    /// The body it is of, by index; `None`: the world.
    pub(crate) subject: Option<u32>,
    pub(crate) property: &'static str,
    pub(crate) value: f64,
}

/// Asks an expectation about the world as it stands; gives how it failed, if it did.
pub(crate) fn judge(script: &Script, pending: &Pending) -> Result<Option<Failure>, Diagnostic> {
    script.session.borrow_mut().start_reading();
    let answer = script.ask(pending, Dynamic::from(handles::World));
    let mut session = script.session.borrow_mut();
    let readings = session.readings.take().unwrap_or_default();
    let answer = answer?;
    match answer.as_bool() {
        Ok(true) => {
            session.reuse(readings);
            Ok(None)
        }
        Ok(false) => {
            let iteration = session.running().map_or(0, |running| running.world.borrow().iteration());
            Ok(Some(Failure { iteration, numbers: session.name_readings(&readings) }))
        }
        Err(_) => {
            let complaint = must_give(&pending.title(), &answer);
            Err(script.complain_of(pending, complaint))
        }
    }
}
