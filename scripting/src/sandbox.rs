//! What a script may do, and how much of it: the engine it runs in.
//!
//! No clock, no sleep, no `eval`, no file but those of the [`Library`](crate::library::Library); a limit on
//! operations, depths and sizes, the same on every machine; and, last, a stop on wall-clock time.

use rhai::packages::{
    BasicArrayPackage, BasicFnPackage, BasicIteratorPackage, BasicMapPackage, BasicStringPackage, MoreStringPackage,
    Package,
};
use rhai::{AST, Dynamic, Engine, EvalAltResult, LexError, ParseError, ParseErrorType, Scope, exported_module};

use crate::bare_names;
use crate::clock::{Clock, Stopped};
use crate::guard;
use crate::modules::Resolver;
use crate::options::Output;
use crate::repairs;
use crate::source;
use crate::words;

/// Operations of the main part, and of each single callback: some seconds' worth, and the same number
/// everywhere, so that a runaway loop ends alike on a fast machine and on a slow one.
pub(crate) const MOST_OPERATIONS: u64 = 100_000_000;
/// Calls within calls.
pub(crate) const MOST_CALLS: usize = 32;
/// How deep an expression may nest, outside functions and within. Together with [`MOST_CALLS`] this keeps the
/// deepest script inside the 2 MiB stack of a thread (measured with nested sums, which need most).
pub(crate) const MOST_DEPTH: (usize, usize) = (64, 48);
/// Bytes of a string, alone or summed over an array or a map.
pub(crate) const MOST_TEXT: usize = 50_000;
/// Entries of an array or a map, those within its entries included.
pub(crate) const MOST_ENTRIES: usize = 100_000;
/// Variables in sight at once.
pub(crate) const MOST_VARIABLES: usize = 500;
/// Functions of one script, closures included.
pub(crate) const MOST_FUNCTIONS: usize = 1_000;
/// Modules imported.
pub(crate) const MOST_MODULES: usize = 1_000;

/// Words of Rhai that a scenario does without, and why.
pub(crate) const WITHHELD: [(&str, &str); 5] = [
    ("eval", "a script is checked before it runs; text made while it runs could not be"),
    ("curry", "write a closure that hands the values over: |x| f(1, x)"),
    ("this", "hand the value over as an argument"),
    ("sleep", "simulated time does not wait; let the world step, and read `world.time`"),
    ("timestamp", "a scenario must run alike every time, and a clock never does; read `world.time`"),
];

/// Why a word of Rhai is not one of ours, if it was left out on purpose.
pub(crate) fn why_withheld(name: &str) -> Option<&'static str> {
    WITHHELD.iter().find(|(withheld, _)| *withheld == name).map(|(_, why)| *why)
}

/// An engine for a script. Words find their session by the tag of whatever runs.
pub(crate) fn engine(resolver: Resolver, clock: &Clock, output: &Output) -> Engine {
    let mut engine = bare_engine();
    engine.set_module_resolver(resolver);
    let (print, debug) = (output.clone(), output.clone());
    engine.on_print(move |text| print.write(text));
    engine.on_debug(move |text, _, position| debug.write(&format!("line {}: {text}", position.line().unwrap_or(0))));
    let clock = clock.clone();
    engine.on_progress(move |operations| clock.look(operations).map(Dynamic::from));
    engine
}

/// The language and the words, with no session behind them: for compiling, and for documentation.
pub(crate) fn bare_engine() -> Engine {
    let mut engine = Engine::new_raw();
    engine
        .register_global_module(BasicArrayPackage::new().as_shared_module())
        .register_global_module(BasicFnPackage::new().as_shared_module())
        .register_global_module(BasicIteratorPackage::new().as_shared_module())
        .register_global_module(BasicMapPackage::new().as_shared_module())
        .register_global_module(BasicStringPackage::new().as_shared_module())
        .register_global_module(MoreStringPackage::new().as_shared_module());
    engine.register_global_module(exported_module!(repairs::module).into());
    words::register(&mut engine);
    guard::watch_variables(&mut engine);
    bare_names::let_settings_stand_bare(&mut engine);
    engine
        .disable_symbol("eval")
        // `f = f.curry(f)` would double what nobody weighs, and so would what a function makes of `this`.
        .disable_symbol("curry")
        .disable_symbol("this")
        .set_strict_variables(true)
        // Else `1/120` would be Rhai's own 0 before our `/` is ever asked.
        .set_fast_operators(false)
        .set_max_operations(MOST_OPERATIONS)
        .set_max_call_levels(MOST_CALLS)
        .set_max_expr_depths(MOST_DEPTH.0, MOST_DEPTH.1)
        .set_max_string_size(MOST_TEXT)
        .set_max_array_size(MOST_ENTRIES)
        .set_max_map_size(MOST_ENTRIES)
        .set_max_variables(MOST_VARIABLES)
        .set_max_functions(MOST_FUNCTIONS)
        .set_max_modules(MOST_MODULES);
    engine
}

/// Compiles a script or a module; constants such as `PI` are known to it.
pub(crate) fn compile(engine: &Engine, text: &str) -> Result<AST, ParseError> {
    let mut constants = Scope::new();
    for constant in &words::CONSTANTS {
        constants.push_constant(constant.name, constant.value);
    }
    let ast = engine.compile_with_scope(&constants, text)?;
    // Rhai takes a comment that is never closed for the end of the script. In such a script, and in no other, a `*/`
    // added at the end does not disturb.
    if engine.compile_with_scope(&constants, format!("{text}\n*/")).is_ok() {
        let unclosed = LexError::ImproperSymbol(OPEN_COMMENT.to_owned(), String::new());
        return Err(ParseError(ParseErrorType::BadInput(unclosed).into(), source::last_comment(text)));
    }
    Ok(ast)
}

/// What opens a comment over several lines.
pub(crate) const OPEN_COMMENT: &str = "/*";

/// Why a script was stopped, if it was.
pub(crate) fn why_stopped(error: &EvalAltResult) -> Option<Stopped> {
    let EvalAltResult::ErrorTerminated(token, _) = error else { return None };
    token.read_lock::<Stopped>().map(|stopped| *stopped)
}
