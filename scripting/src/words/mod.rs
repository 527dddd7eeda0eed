//! The words of a scenario: registered with the engine, and documented, from one text.

#![allow(unreachable_pub, clippy::unwrap_used)] // of the plugin macro: it takes `pub` functions only, and unwraps

use rhai::{Dynamic, Engine, Module, exported_module};

use crate::error::Complaint;
use crate::handles::{Account, Body, Hit, Ledger, World};

mod bodies;
mod expect;
mod fit;
mod ledger;
mod manual;
mod math;
mod motion;
mod operators;
mod random;
mod settings;
mod world;

pub use manual::{Word, all, write_definitions};

// Names for the reader of the documentation: any value is taken, and refused in our words if it is another.
/// A number, whole or not.
pub(crate) type Number = Dynamic;
/// A string.
pub(crate) type Text = Dynamic;
/// A string, one of a few.
pub(crate) type Choice = Dynamic;
/// True or false.
pub(crate) type Truth = Dynamic;
/// An array.
pub(crate) type List = Dynamic;
/// `|world| …`
pub(crate) type Closure = Dynamic;

/// A number with a name that every script knows.
pub(crate) struct Constant {
    pub(crate) name: &'static str,
    pub(crate) value: f64,
    docs: &'static str,
}

/// Constants every script knows.
pub(crate) const CONSTANTS: [Constant; 3] = [
    Constant { name: "PI", value: std::f64::consts::PI, docs: "π: half a turn [rad]. `PI` is 3.1416." },
    Constant { name: "TAU", value: std::f64::consts::TAU, docs: "2π: a whole turn [rad]. `TAU` is 6.2832." },
    Constant { name: "E", value: std::f64::consts::E, docs: "Euler's number: `E` is 2.7183." },
];

/// The groups of words in the order of the manual.
fn groups() -> [(&'static str, Module); 9] {
    let mut mathematics = exported_module!(math::module);
    for constant in &CONSTANTS {
        mathematics.set_var(constant.name, constant.value);
    }
    [
        ("settings", exported_module!(settings::module)),
        ("bodies", exported_module!(bodies::module)),
        ("expectations", exported_module!(expect::module)),
        ("fit", exported_module!(fit::module)),
        ("world", exported_module!(world::module)),
        ("ledger", exported_module!(ledger::module)),
        ("motion", exported_module!(motion::module)),
        ("random", exported_module!(random::module)),
        ("mathematics", mathematics),
    ]
}

/// Teaches an engine the words.
pub(crate) fn register(engine: &mut Engine) {
    register_types(engine);
    engine.register_fn("to_string", |complaint: &mut Complaint| complaint.message.clone());
    engine.register_fn("to_debug", |complaint: &mut Complaint| complaint.message.clone());
    for (_, module) in groups() {
        engine.register_global_module(module.into());
    }
    engine.register_global_module(exported_module!(operators::module).into());
    operators::register_assignments(engine);
}

fn register_types(engine: &mut Engine) {
    engine.register_type_with_name::<Body>("Body");
    engine.register_type_with_name::<World>("World");
    engine.register_type_with_name::<Hit>("Hit");
    engine.register_type_with_name::<Ledger>("Ledger");
    engine.register_type_with_name::<Account>("Account");
    // What `catch (error)` gets of a word's complaint.
    engine.register_type_with_name::<Complaint>("Error");
}
