//! A test per scenario: its expectations must hold, and its results must be those pinned by a snapshot.
//!
//! Any package may have such tests, with these three lines in `tests/scenarios.rs`
//!
//! ```no_run
//! fn main() -> std::process::ExitCode {
//!     choque::harness::main!()
//! }
//! ```
//!
//! and `[[test]] name = "scenarios" harness = false` in its manifest. Every `.rhai` below `scenarios/` is then a test
//! found at run time: `scenarios/blades/spinning_blade.rhai` is `blades::spinning_blade`, pinned by
//! `snapshots/blades/spinning_blade.snap`. Files below a folder named `lib` are libraries for `import`, not tests.
//!
//! The tests understand the flags of Rust's own (a filter, `--list`, `--exact`, `--test-threads` …), so `cargo test`,
//! `cargo nextest run` and `cargo insta test --review` all work; environment variables of insta mean what they always
//! mean, and where `CI` is set nothing is written.
//!
//! A test that fails says where the run and its snapshot part; a recording kept beside the snapshot (`run --record
//! snapshots/….choque`) lets it name the stage. Where `CHOQUE_ARTIFACTS` names a folder, recordings and a page are left there.

mod artifacts;
mod difference;
mod discover;
mod pin;
mod record;
mod snapshot;

use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};

pub use crate::harness_main as main;
pub use difference::in_words;
pub use discover::{Case, cases, unreferenced};
pub use pin::pinned;
