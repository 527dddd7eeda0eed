//! `choque check`: compiles and validates, runs nothing.

use std::path::{Path, PathBuf};

use choque_engine::{Note, note};
use choque_scripting::{Options, Scenario};

use crate::output::numbers::counted;
use crate::terminal::{BAD, GOOD, WARNING, styled, tell, tell_error};
use crate::{Error, Verdict};

/// Checks every file, also after a bad one; tells errors and warnings as it goes.
///
/// # Errors
/// None: what is wrong with a file is told, and makes the verdict [`Verdict::BadInput`].
pub fn check(files: &[PathBuf], options: &Options) -> Result<Verdict, Error> {
    let mut bad = 0;
    for file in files {
        match examine(file, options) {
            Ok(good) => tell_good(file, &good),
            Err(error) => {
                bad += 1;
                tell(&format!("{} {}\n", styled(BAD, "✗"), file.display()));
                tell_error(&error);
            }
        }
    }
    if files.len() > 1 {
        let checked = counted(files.len(), "scenario", "scenarios");
        tell(&format!("{checked} checked: {} good, {bad} bad\n", files.len() - bad));
    }
    Ok(if bad == 0 { Verdict::Holds } else { Verdict::BadInput })
}

struct Good {
    bodies: usize,
    notes: Vec<Note>,
}

fn examine(file: &Path, options: &Options) -> Result<Good, Error> {
    let scenario = Scenario::load(file, options)?;
    let run = scenario.start()?;
    let world = run.world();
    Ok(Good { bodies: world.len(), notes: note::review(scenario.scene(), &world) })
}

fn tell_good(file: &Path, good: &Good) {
    let mut what = counted(good.bodies, "body", "bodies");
    if !good.notes.is_empty() {
        what += &format!(", {}", counted(good.notes.len(), "warning", "warnings"));
    }
    tell(&format!("{} {}: {what}\n", styled(GOOD, "✓"), file.display()));
    for note in &good.notes {
        tell(&format!("  {}: {note}\n", styled(WARNING, "warning")));
    }
}
