//! The functions a script may define for the run to call.

use rhai::AST;

use crate::error::Complaint;
use crate::expectation::{Pending, When};
use crate::suggest::nearest;

/// A function of that name and with those parameters is called by the run.
pub(crate) struct Callback {
    pub(crate) name: &'static str,
    pub(crate) parameters: &'static [&'static str],
    /// Markdown.
    pub(crate) docs: &'static str,
}

pub(crate) const ON_STEP: &str = "on_step";
pub(crate) const ON_COLLISION: &str = "on_collision";
pub(crate) const STOP_WHEN: &str = "stop_when";

/// All of them, in the order of an iteration.
pub(crate) const CALLBACKS: [Callback; 3] = [
    Callback {
        name: ON_STEP,
        parameters: &["world"],
        docs: "Called before each iteration: the user commands of the document.\n\n\
               ```rhai\nfn on_step(world) {\n    if world.time > 2 { world[\"blade\"].spin = 0; }\n}\n```",
    },
    Callback {
        name: ON_COLLISION,
        parameters: &["world", "hit"],
        docs: "Called after each exchange, with the pair and the point in `hit`.\n\n\
               ```rhai\nfn on_collision(world, hit) {\n    print(`${hit.a.name} meets ${hit.b.name} at ${hit.x}, ${hit.z}`);\n}\n```",
    },
    Callback {
        name: STOP_WHEN,
        parameters: &["world"],
        docs: "Called after each iteration; when it gives true, the run ends there.\n\n\
               ```rhai\nfn stop_when(world) { world[\"car\"].speed < 0.1 }\n```",
    },
];

/// Which callbacks and expectations a scenario has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Callbacks {
    /// `fn on_step(world)`.
    pub on_step: bool,
    /// `fn on_collision(world, hit)`.
    pub on_collision: bool,
    /// `fn stop_when(world)`.
    pub stop_when: bool,
    /// How many `expect(…)`.
    pub expect: usize,
    /// How many `always(…)`.
    pub always: usize,
}

impl Callbacks {
    /// The callbacks a script defines.
    ///
    /// # Errors
    /// A callback that could never be called, as it takes something else, is private, or is a misspelt one; with
    /// the name of the function.
    pub(crate) fn of(ast: &AST) -> Result<Callbacks, (String, Complaint)> {
        for function in ast.iter_functions() {
            let known = CALLBACKS.iter().any(|callback| callback.name == function.name);
            let callback = nearest(function.name, CALLBACKS.iter().map(|callback| callback.name)).filter(|_| !known);
            if let Some(meant) = callback.filter(|meant| takes(ast, function.name, meant)) {
                let complaint = Complaint::new(format!("nothing calls `{}` by itself", function.name));
                let hint = format!("did you mean `{meant}`? If not, give it a name less like it");
                return Err((function.name.to_owned(), complaint.hint(hint)));
            }
        }
        Ok(Callbacks {
            on_step: defines(ast, &CALLBACKS[0])?,
            on_collision: defines(ast, &CALLBACKS[1])?,
            stop_when: defines(ast, &CALLBACKS[2])?,
            ..Callbacks::default()
        })
    }
}

impl Callbacks {
    /// With the expectations counted.
    pub(crate) fn counting(self, pending: &[Pending]) -> Self {
        let count = |when| pending.iter().filter(|pending| pending.when == when).count();
        Callbacks { expect: count(When::AtTheEnd), always: count(When::AfterEveryIteration), ..self }
    }
}

/// Whether a function takes as many arguments as a callback does.
fn takes(ast: &AST, function: &str, callback: &str) -> bool {
    let wanted = CALLBACKS.iter().find(|known| known.name == callback).map(|known| known.parameters.len());
    ast.iter_functions().any(|known| known.name == function && Some(known.params.len()) == wanted)
}

fn defines(ast: &AST, callback: &Callback) -> Result<bool, (String, Complaint)> {
    let signature = format!("({})", callback.parameters.join(", "));
    let written = format!("write fn {}{signature} {{ … }}", callback.name);
    let fail = |message: String| Err((callback.name.to_owned(), Complaint::new(message).hint(&written)));
    let named = || ast.iter_functions().filter(|function| function.name == callback.name);
    match named().find(|function| function.params.len() == callback.parameters.len()) {
        Some(function) if function.access.is_private() => fail(format!("{} must not be private", callback.name)),
        Some(_) => Ok(true),
        None => match named().next() {
            Some(other) => fail(format!("{} takes {signature}, not ({})", callback.name, other.params.join(", "))),
            None => Ok(false),
        },
    }
}
