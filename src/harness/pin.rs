//! Holds a scenario's outcome against its snapshot; what is wrong is said in words before insta shows its difference.

use std::cell::Cell;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::path::Path;
use std::sync::{Mutex, Once, PoisonError};

use super::discover::Case;
use super::snapshot::Snapshot;
use super::{Assert, artifacts, in_words};
use crate::output::numbers::{counted, duration};
use crate::output::text::failure;

/// Tests run side by side; words and difference of one must not be torn apart by another's.
static TELLING: Mutex<()> = Mutex::new(());

/// Passes when every expectation held and insta is content with the snapshot; otherwise says why not.
///
/// # Errors
/// The words for what failed.
pub(super) fn pin(case: &Case, new: &Snapshot, assert: Assert) -> Result<(), String> {
    let body = new.to_text().map_err(|error| error.to_string())?;
    let broken = broken_expectations(new);
    let moved = words(case, new).map(|words| {
        let parted = case.snapshot.is_file().then(|| artifacts::parted(case)).flatten();
        parted.map_or(words.clone(), |parted| format!("{words}\n\n{parted}"))
    });
    let _telling = TELLING.lock().unwrap_or_else(PoisonError::into_inner);
    for words in broken.iter().chain(&moved) {
        println!("\n{}: {words}", case.name());
    }
    let content = settings(case, new).bind(|| quietly(|| assert(snapshot_name(case), &body)));
    let complaints = match content {
        Ok(()) => vec![broken], // what moved has been accepted
        Err(why) => vec![broken, moved, Some(why)],
    };
    let complaints: Vec<String> = complaints.into_iter().flatten().collect();
    if complaints.is_empty() { Ok(()) } else { Err(complaints.join("\n")) }
}

thread_local! {
    static IS_ASSERTING: Cell<bool> = const { Cell::new(false) };
}

/// Calls what may panic and gives the panic's message; nothing of it is printed, for insta has said all by then.
fn quietly(assert: impl FnOnce()) -> Result<(), String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = take_hook();
        set_hook(Box::new(move |panic| {
            if !IS_ASSERTING.get() {
                usual(panic);
            }
        }));
    });
    IS_ASSERTING.set(true);
    let outcome = catch_unwind(AssertUnwindSafe(assert));
    IS_ASSERTING.set(false);
    outcome.map_err(|panic| match panic.downcast::<String>() {
        Ok(message) => *message,
        Err(other) => other.downcast_ref::<&str>().map_or("insta panicked", |message| message).to_owned(),
    })
}

fn broken_expectations(new: &Snapshot) -> Option<String> {
    let broken: Vec<String> = new.expectations.iter().filter(|judgement| !judgement.held).map(failure).collect();
    if broken.is_empty() {
        return None;
    }
    let lines: String = broken.iter().map(|text| format!("\n  ✗ {text}")).collect();
    Some(format!("{} failed{lines}", counted(broken.len(), "expectation", "expectations")))
}

/// What differs from the pinned snapshot, in words; `None` when nothing does.
fn words(case: &Case, new: &Snapshot) -> Option<String> {
    if fs::metadata(&case.snapshot).is_err() {
        return Some("it has no snapshot yet; look at the one below and accept it if it is right".to_owned());
    }
    match pinned(&case.snapshot) {
        Ok(old) => in_words(&old, new),
        Err(why) => Some(format!(
            "its snapshot cannot be read, so nothing can be said about what moved: it was edited by hand, or written by \
             another version\n  {why}"
        )),
    }
}

/// What a snapshot's file holds.
///
/// # Errors
/// Why it cannot be read.
pub fn pinned(path: &Path) -> Result<Snapshot, String> {
    let file = insta::Snapshot::from_file(path).map_err(|error| error.to_string())?;
    let text = file.as_text().ok_or("it is no text")?.to_string();
    Snapshot::from_text(&text).map_err(|error| error.to_string())
}

fn snapshot_name(case: &Case) -> &str {
    case.path.last().map_or("", String::as_str)
}

fn settings(case: &Case, new: &Snapshot) -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_snapshot_path(case.snapshot.parent().unwrap_or(Path::new("")));
    settings.set_input_file(&case.script);
    let length = counted(new.steps as usize, "iteration", "iterations");
    settings.set_description(format!("{}: {length} of {}", new.title, duration(new.time_step)));
    settings
}
