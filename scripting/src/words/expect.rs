//! The words for what must hold.

use rhai::plugin::*;
use rhai::{Dynamic, FnPtr, ImmutableString};

use super::{Closure, Text};
use crate::error::Complaint;
use crate::expectation::{Pending, When};
use crate::number;
use crate::session::{self, RhaiResultOf, Session, Site};

/// Characters the text of an expectation may have.
const LONGEST_TEXT: usize = 500;
/// Expectations a script may have.
const MOST_EXPECTATIONS: usize = 10_000;

#[export_module]
pub(crate) mod module {
    /// Something that must hold at the end of the run. The closure gets the world, looks, and says true or false.
    ///
    /// ```rhai
    /// expect("the blade throws a car out", |world| world["car2"].speed > 3);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn expect(context: NativeCallContext, text: Text, judge: Closure) -> RhaiResultOf<()> {
        declare(&context, &text, &judge, When::AtTheEnd)
    }

    /// Something that must hold after every iteration. When it does not, the first iteration and the numbers
    /// are told.
    ///
    /// ```rhai
    /// always("nothing explodes", |world| world.kinetic_energy < 1e7);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn always(context: NativeCallContext, text: Text, judge: Closure) -> RhaiResultOf<()> {
        declare(&context, &text, &judge, When::AfterEveryIteration)
    }
}

fn declare(context: &NativeCallContext, text: &Dynamic, judge: &Dynamic, when: When) -> RhaiResultOf<()> {
    session::with(context, |session| {
        let pending = pending(context, session, text, judge, when)?;
        if session.pending.len() >= MOST_EXPECTATIONS {
            return Err(Complaint::new(format!("a script may have {MOST_EXPECTATIONS} expectations at most")));
        }
        session.pending.push(pending);
        Ok(())
    })
}

/// A closure to be asked about the world later, with all that it may call.
pub(super) fn pending(
    context: &NativeCallContext,
    session: &mut Session,
    text: &Dynamic,
    judge: &Dynamic,
    when: When,
) -> Result<Pending, Complaint> {
    let word = context.fn_name();
    session.draft(word)?;
    let text: ImmutableString = number::label(&format!("{word}: text"), text, LONGEST_TEXT)?;
    let judge = judge.read_lock::<FnPtr>().map(|judge| judge.clone()).ok_or_else(|| {
        let what = if when == When::Measured { "number" } else { "condition" };
        number::must_be(&format!("{word} \"{text}\": the {what}"), "a closure", judge)
            .hint(format!("write {word}(\"{text}\", |world| …)"))
    })?;
    check_parameters(context, word, &text, &judge)?;
    let mut surroundings = context.global_runtime_state().clone();
    surroundings.level = 0;
    surroundings.num_operations = Default::default();
    Ok(Pending { text, when, judge, surroundings, site: Site::of(context) })
}

/// A closure takes the world, after what it captures.
fn check_parameters(context: &NativeCallContext, word: &str, text: &str, judge: &FnPtr) -> Result<(), Complaint> {
    let functions = context.iter_namespaces().flat_map(rhai::Module::iter_script_fn_info);
    let known =
        functions.filter(|(.., name, _, _)| *name == judge.fn_name()).map(|(.., definition)| definition.params.len());
    let wanted = judge.curry().len() + 1;
    let mut counts = known.peekable();
    if counts.peek().is_none() || counts.any(|count| count == wanted) {
        return Ok(());
    }
    Err(Complaint::new(format!("{word} \"{text}\": the closure takes the world and nothing else"))
        .hint(format!("write {word}(\"{text}\", |world| …)")))
}
