//! What a game designer types: Rhai scripts turned into scenes, callbacks and expectations of the choque engine.
//!
//! | question | file |
//! |---|---|
//! | how is a scenario loaded and run? | [`Scenario`], [`Run`] |
//! | which words are there? | [`words`] |
//! | what may be tuned, and how does it get into the script? | [`Control`], [`write_back`](write_back()) |
//! | what may a script do? | `sandbox.rs`, `library.rs`, `modules.rs` |
//! | what does a person see when something is wrong? | [`Diagnostic`]; `blame.rs` finds the place, `phrase.rs`, `calls.rs` and `syntax.rs` the words |
//! | where do words keep what they build? | `session.rs`, `draft.rs`, `params.rs` |
//!
//! This is the only crate that knows Rhai. Loading a script runs its main part, which makes a
//! [`Scene`](choque_engine::Scene); a [`Run`] then calls the script's callbacks between the stages of an iteration.
//! A script without callbacks costs nothing while it runs.
//!
//! ```no_run
//! use choque_scripting::{Options, Scenario, Step};
//!
//! let scenario = Scenario::load("scenarios/blades/sweep.rhai".as_ref(), &Options::default())?;
//! let mut run = scenario.start()?;
//! while run.step()? == Step::Going {}
//! for expectation in run.conclude()? {
//!     println!("{}: {}", expectation.text, expectation.held);
//! }
//! # Ok::<(), choque_scripting::Diagnostic>(())
//! ```

mod bare_names;
mod blame;
mod callbacks;
mod calls;
mod clock;
mod control;
mod draft;
mod error;
mod expectation;
mod fit;
mod generator;
mod guard;
mod handles;
mod lexed;
mod library;
mod modules;
mod number;
mod obj;
mod options;
mod params;
mod phrase;
mod plain;
mod repairs;
mod run;
mod sandbox;
mod scenario;
mod script;
mod session;
mod source;
mod suggest;
mod syntax;
pub mod words;
mod write_back;

pub use callbacks::Callbacks;
pub use control::Control;
pub use error::Diagnostic;
pub use expectation::Expectation;
pub use fit::{Target, Varied};
pub use options::{Options, Output, Overrides, Reads, Stop};
pub use run::{Moment, Run, Step};
pub use scenario::Scenario;
pub use write_back::write_back;
