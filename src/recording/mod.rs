//! A run kept to the last bit: `choque run --record FILE.choque`, and what draws, plays and compares it.
//!
//! | what | file |
//! |---|---|
//! | what a recording holds: of the run, of a moment | [`about`], [`frame`] |
//! | how it is made while a run goes on | [`recorder`] |
//! | the file: sections with lengths and checksums | [`file`](mod@file), [`error`] |
//! | frames as bytes: foretold, and what is left packed | `block`, `foretold`, `pack` |
//!
//! ```no_run
//! use choque::recording::{Recording, Settings, record};
//! use choque_scripting::{Options, Scenario};
//!
//! let scenario = Scenario::load("scenarios/blades/spinning_blade.rhai".as_ref(), &Options::default())?;
//! let recording = record(&scenario, &Settings::default())?;
//! recording.write("blade.choque".as_ref())?;
//! let again = Recording::read("blade.choque".as_ref())?;
//! assert_eq!(again.frames.last().map(|frame| frame.digest), recording.frames.last().map(|frame| frame.digest));
//! # Ok::<(), choque::Error>(())
//! ```

pub mod about;
mod block;
mod deflated;
pub mod error;
pub mod file;
mod foretold;
pub mod frame;
mod pack;
pub mod recorder;

pub use about::{About, Body, Build, Ending, Given, Source};
pub use error::Broken;
pub use frame::{Books, Command, Frame, Push, State, Strike, Totals, Touch};
pub use recorder::{Recorder, Settings, record};

/// A run: what made it, its bodies, what they did moment by moment, and what it came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// What made it.
    pub about: About,
    /// In order of creation: frames and events name a body by its place here.
    pub bodies: Vec<Body>,
    /// The start, then every iteration or every so many; the end is always among them.
    pub frames: Vec<Frame>,
    /// How it ended.
    pub ending: Ending,
}
