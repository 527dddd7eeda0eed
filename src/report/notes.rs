//! What a reader of a report should know besides its numbers.

use std::path::Path;

use choque_scripting::{Diagnostic, Scenario};

use super::format::significant;
use super::ladder::Ladder;
use super::study::Study;
use super::survey::Runs;
use crate::Error;
use crate::clock::CPU_IS;

/// A scenario in which nothing can go wrong.
pub(super) fn nothing_to_compare(file: &Path) -> Error {
    Diagnostic::new("there is nothing to compare: no body has a rectangle, or no time passes")
        .in_file(file)
        .with_hint(Some("give a body a .rect, and steps of more than 0".to_owned()))
        .into()
}

/// Everything worth a line.
pub(super) fn of(study: &Study, scenario: &Scenario, ladder: &Ladder, all: &[Runs]) -> Vec<String> {
    let mut notes = vec![format!("cost is {CPU_IS}, median of {}", runs(study))];
    let callbacks = scenario.callbacks();
    if callbacks.on_step || callbacks.on_collision || callbacks.stop_when {
        notes.push("callbacks run once an iteration or exchange: they are part of the cost, and of how results depend on time_step".to_owned());
    }
    for runs in all {
        if let Some(ended) = &runs.ended {
            notes.push(format!("{}: runs ended early: {ended}", runs.method.name()));
        } else if runs.courses.len() < ladder.rungs {
            let finest = ladder.name(runs.courses.len().saturating_sub(1));
            notes.push(format!("{}: time steps below {finest} would take too long", runs.method.name()));
        }
        let short = runs.courses.iter().find(|course| course.time < ladder.time * (1.0 - 1e-9));
        if let Some(short) = short {
            let (asked, made) = (significant(ladder.time), significant(short.time));
            notes.push(format!("{}: the script stopped a run after {made} s of {asked} s", runs.method.name()));
        }
    }
    notes
}

fn runs(study: &Study) -> String {
    let counts = || study.rows.iter().map(|row| row.runs);
    match (counts().min(), counts().max()) {
        (Some(least), Some(most)) if least < most => format!("{most} runs, of the longest {least}"),
        (_, Some(most)) => format!("{most} runs"),
        _ => "no runs".to_owned(),
    }
}
