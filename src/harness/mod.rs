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
pub use discover::{Case, cases, snapshot_of, unreferenced};
pub use pin::pinned;
pub use record::record;
pub(crate) use snapshot::rounded;
pub use snapshot::{BodyRow, Checkpoint, ExtremeRow, MeetingRow, Snapshot, Totals};

/// Asserts a snapshot of that name and body. The macro makes one in the test's own crate, because insta takes the
/// workspace, its settings and the source of a snapshot from where its macro stands.
pub type Assert = fn(name: &str, body: &str);

/// The body of `main` in `tests/scenarios.rs`: a test per scenario of the package it stands in.
#[doc(hidden)]
#[macro_export]
macro_rules! harness_main {
    () => {
        $crate::harness::run(env!("CARGO_MANIFEST_DIR"), |name, body| $crate::insta::assert_snapshot!(name, body))
    };
}

/// Runs the tests of a package as the process's arguments ask; `directory` holds its `scenarios` and `snapshots`.
///
/// Exit code 0: all passed; 101: some failed, as with Rust's own tests; 2: there is no folder of scenarios to read.
#[must_use]
pub fn run(directory: &str, assert: Assert) -> ExitCode {
    run_with(std::env::args_os(), directory, assert)
}

/// The same with arguments given, the first of which is the program's name.
#[must_use]
pub fn run_with(arguments: impl IntoIterator<Item = OsString>, directory: &str, assert: Assert) -> ExitCode {
    let arguments = Arguments::from_iter(arguments);
    match cases(Path::new(directory)) {
        Ok(cases) => {
            let trials = cases.into_iter().map(|case| Trial::test(case.name(), move || test(&case, assert)));
            libtest_mimic::run(&arguments, trials.collect()).exit_code()
        }
        Err(error) => {
            crate::terminal::tell_error(&error);
            ExitCode::from(2)
        }
    }
}

fn test(case: &Case, assert: Assert) -> Result<(), Failed> {
    let snapshot = record(case).map_err(|error| error.to_string())?;
    pin::pin(case, &snapshot, assert).map_err(Failed::from)
}
