//! A run against its snapshot: where they part as nearly as a snapshot tells; to the stage where a recording is kept beside it.

use std::path::{Path, PathBuf};

use super::told::{Found, comparison};
use crate::Error;
use crate::harness::{self, MeetingRow, Snapshot, pinned, rounded};
use crate::outcome::hexadecimal;
use crate::output::table::{Side, table};
use crate::recording::{Frame, Recording, Strike};
use crate::terminal::{BAD, GOOD, HEADING, styled};

/// Bodies of which it is told how they ended.
const NAMED: usize = 8;

/// The snapshot of a script below `scenarios`.
///
/// # Errors
/// A script that is in no such folder.
pub fn snapshot_of(script: &Path) -> Result<PathBuf, Error> {
    harness::snapshot_of(script).ok_or_else(|| Error::Call {
        message: format!("{} is in no folder named scenarios, so its snapshot cannot be found", script.display()),
        hint: "name the snapshot: choque diff FILE.rhai FILE.snap".to_owned(),
    })
}

/// Reads a snapshot.
///
/// # Errors
/// A file that cannot be read, or is none.
pub fn read(path: &Path) -> Result<Snapshot, Error> {
    pinned(path).map_err(|why| Error::Call {
        message: format!("cannot read the snapshot {}: {why}", path.display()),
        hint: "cargo insta test --review writes it anew".to_owned(),
    })
}

/// The recording that is kept beside a snapshot, under the same name, if there is one.
///
/// # Errors
/// One that cannot be read.
pub fn recording_beside(snapshot: &Path) -> Result<Option<Recording>, Error> {
    let path = snapshot.with_extension("choque");
    if path.is_file() { Recording::read(&path).map(Some) } else { Ok(None) }
}

/// A run of that name against its snapshot, the recording beside the snapshot if there is one, and all that can be said.
///
/// # Errors
/// What cannot be read.
pub fn against(snapshot: &Path, name: &str, run: &Recording) -> Result<(Found, Option<Recording>), Error> {
    let names = [&snapshot.display().to_string(), name];
    let Some(kept) = recording_beside(snapshot)? else {
        return Ok((compare(&read(snapshot)?, run, names), None));
    };
    match read(snapshot) {
        Ok(pinned) if !ends_as(&pinned, &kept) => {
            let mut found = compare(&pinned, run, names);
            found.text += &format!(
                "{} is passed over: it is of another run than the snapshot; record it again\n",
                snapshot.with_extension("choque").display()
            );
            Ok((found, None))
        }
        _ => Ok((comparison([&format!("{} (recorded)", snapshot.display()), name], [&kept, run]), Some(kept))),
    }
}

/// Whether a run ended as the snapshot says, to the last bit.
fn ends_as(snapshot: &Snapshot, run: &Recording) -> bool {
    let is_end = |frame: &Frame| hexadecimal(frame.digest) == snapshot.digest;
    snapshot.steps == run.ending.steps && run.frames.last().is_some_and(is_end)
}

/// What a snapshot alone tells: A is the snapshot, B the run.
#[must_use]
pub fn compare(snapshot: &Snapshot, run: &Recording, names: [&str; 2]) -> Found {
    let mut text = String::new();
    for (side, name) in ["A", "B"].into_iter().zip(names) {
        text += &format!("{}  {name}\n", styled(HEADING, side));
    }
    text += "\n";
    let last = run.frames.last();
    if ends_as(snapshot, run) {
        text += &format!("{}\n", styled(GOOD, "the same to the last bit at the end"));
        return Found { same: true, iteration: None, text };
    }
    let [agreed, differs] = parted(snapshot, run);
    let meeting = meeting(snapshot, run);
    let iteration = meeting.as_ref().map_or(agreed.unwrap_or(0), |(iteration, _)| *iteration);
    let between = match (agreed, differs) {
        (None, _) => "they differ from the start".to_owned(),
        (Some(agreed), Some(differs)) => format!("they part after iteration {agreed} and before {differs}"),
        (Some(agreed), None) => format!("they part after iteration {agreed}"),
    };
    text += &format!("{}\n", styled(BAD, &between));
    if let Some((_, what)) = meeting {
        text += &format!("  {what}\n");
    }
    text += &ends(snapshot, last);
    text += "a snapshot does not tell the stage: a recording kept beside it does, made by the version that wrote it\n";
    Found { same: false, iteration: Some(iteration), text }
}

/// The last checkpoint that agrees, and the first that does not.
fn parted(snapshot: &Snapshot, run: &Recording) -> [Option<u64>; 2] {
    let mut agreed = None;
    for checkpoint in &snapshot.checkpoints {
        let frame = run.frames.iter().find(|frame| frame.iteration == checkpoint.iteration);
        match frame {
            Some(frame) if hexadecimal(frame.digest) == checkpoint.digest => agreed = Some(checkpoint.iteration),
            _ => return [agreed, Some(checkpoint.iteration)],
        }
    }
    [agreed, None]
}

/// The first of the pairs that met first which met otherwise, and when.
fn meeting(snapshot: &Snapshot, run: &Recording) -> Option<(u64, String)> {
    let mut met: Vec<&Strike> = Vec::new();
    for hit in run.frames.iter().flat_map(|frame| &frame.hits) {
        if met.len() < snapshot.first_met.len() && !met.iter().any(|known| (known.a, known.b) == (hit.a, hit.b)) {
            met.push(hit);
        }
    }
    let name = |body: u32| run.bodies.get(body as usize).map_or("?", |body| body.name.as_str());
    let same = |old: &MeetingRow, new: &&Strike| {
        (old.a.as_str(), old.b.as_str(), old.iteration) == (name(new.a), name(new.b), new.iteration)
            && [old.x, old.z, old.depth] == [new.point[0], new.point[1], new.depth].map(rounded)
    };
    let at = (0..snapshot.first_met.len())
        .find(|at| !met.get(*at).is_some_and(|new| same(&snapshot.first_met[*at], new)))?;
    let old = &snapshot.first_met[at];
    let now = met.get(at).map_or("nothing meets".to_owned(), |new| {
        format!(
            "{} – {} meet in iteration {} at ({}, {}), {} m deep",
            name(new.a),
            name(new.b),
            new.iteration,
            rounded(new.point[0]),
            rounded(new.point[1]),
            rounded(new.depth)
        )
    });
    let then =
        format!("{} – {} in iteration {} at ({}, {}), {} m deep", old.a, old.b, old.iteration, old.x, old.z, old.depth);
    let iteration = met.get(at).map_or(old.iteration, |new| new.iteration.min(old.iteration));
    Some((iteration, format!("meeting {}: in A {then}; in B {now}", at + 1)))
}

/// The bodies that ended most otherwise.
fn ends(snapshot: &Snapshot, last: Option<&Frame>) -> String {
    let Some(last) = last.filter(|last| snapshot.untold == 0 && last.states.len() == snapshot.bodies.len()) else {
        return String::new();
    };
    let mut apart: Vec<(f64, Vec<String>)> = snapshot
        .bodies
        .iter()
        .zip(&last.states)
        .map(|(old, new)| {
            let [x, z] = [new.x, new.z].map(rounded);
            let cells = [old.x, x, old.z, z].map(|number| number.to_string());
            (libm::hypot(x - old.x, z - old.z), [vec![old.name.clone()], cells.to_vec()].concat())
        })
        .filter(|(distance, _)| *distance > 0.0)
        .collect();
    if apart.is_empty() {
        return String::new();
    }
    apart.sort_by(|a, b| b.0.total_cmp(&a.0));
    let rows: Vec<Vec<String>> = apart
        .into_iter()
        .take(NAMED)
        .map(|(distance, mut cells)| {
            cells.push(format!("{distance:.2e}"));
            cells
        })
        .collect();
    let right = Side::Right;
    let head = [
        ("at the end", Side::Left),
        ("x of A", right),
        ("x of B", right),
        ("z of A", right),
        ("z of B", right),
        ("apart [m]", right),
    ];
    format!("\n{}\n", table(&head, &rows))
}
