//! What moved between two snapshots of a scenario, in words.

use std::f64::consts::{PI, TAU};

use super::snapshot::{BodyRow, Checkpoint, Snapshot};
use crate::output::numbers::counted;

/// How many bodies are named, those that moved most first.
const NAMED: usize = 5;
/// How many quantities of each are given.
const QUANTITIES: usize = 3;

/// Says what differs, the gravest first: the reading of the scene, its physics, its rounding, what it cost.
/// `None` when nothing does.
#[must_use]
pub fn in_words(old: &Snapshot, new: &Snapshot) -> Option<String> {
    let mut lines = vec![headline(old, new)?];
    lines.extend(list_change(&old.plan, &new.plan));
    lines.extend(parting(old, new));
    lines.extend(bodies(&old.bodies, &new.bodies));
    lines.extend(expectations(old, new));
    lines.extend(work(old, new));
    Some(lines.join("\n  "))
}

fn headline(old: &Snapshot, new: &Snapshot) -> Option<String> {
    let plan = old.plan != new.plan || old.time_step != new.time_step;
    let rows = old.bodies != new.bodies
        || old.untold != new.untold
        || old.extremes != new.extremes
        || old.totals != new.totals
        || old.first_met != new.first_met
        || old.steps != new.steps;
    let bits = old.digest != new.digest || old.checkpoints != new.checkpoints;
    let outcome = match (rows, bits) {
        (true, _) => "rows moved too",
        (false, true) => "of the outcome only the digest moved",
        (false, false) => "the outcome is the same",
    };
    let headline = if plan {
        format!("the plan moved: the scene was read otherwise; {outcome}")
    } else if old.scene != new.scene {
        format!("the scene itself is another (its script, a parameter or a model changed); {outcome}")
    } else if rows {
        "rows moved: the same scene came out otherwise, so the physics or a callback changed".to_owned()
    } else if bits {
        "only the digest moved: the rounding changed, every row is the same to six decimals".to_owned()
    } else if old.expectations != new.expectations {
        "only the expectations moved: the same run is judged otherwise".to_owned()
    } else if old.work != new.work {
        "only the counted work moved: the same outcome at another cost".to_owned()
    } else if old != new {
        format!("only the wording moved: \"{}\" was \"{}\"", new.title, old.title)
    } else {
        return None;
    };
    Some(headline)
}

/// Lines that are gone and lines that are new.
fn list_change(old: &[String], new: &[String]) -> Vec<String> {
    let gone = old.iter().filter(|line| !new.contains(line)).map(|line| format!("- {line}"));
    let come = new.iter().filter(|line| !old.contains(line)).map(|line| format!("+ {line}"));
    gone.chain(come).collect()
}

/// At which checkpoint the two runs are first seen to differ.
fn parting(old: &Snapshot, new: &Snapshot) -> Option<String> {
    let pairs = old.checkpoints.iter().zip(&new.checkpoints);
    let Some(at) = pairs.clone().position(|(a, b)| a != b) else {
        return (old.checkpoints.len() != new.checkpoints.len())
            .then(|| format!("the runs agree as long as both last: {} and {} iterations", old.steps, new.steps));
    };
    let (before, after) = pairs.clone().nth(at)?;
    let what = checkpoint_change(before, after);
    Some(match at.checked_sub(1).and_then(|last| new.checkpoints.get(last)) {
        None => format!("the runs differ from the very start: {what}"),
        Some(last) => {
            format!("the runs agree up to iteration {} and differ at {}: {what}", last.iteration, after.iteration)
        }
    })
}

fn checkpoint_change(old: &Checkpoint, new: &Checkpoint) -> String {
    if old.iteration != new.iteration {
        return format!("checkpoint {} instead of {}", new.iteration, old.iteration);
    }
    let mut changes = Vec::new();
    if old.collisions != new.collisions {
        changes.push(format!("{} collisions instead of {}", new.collisions, old.collisions));
    }
    if old.kinetic_energy != new.kinetic_energy {
        changes.push(format!("{} J of kinetic energy instead of {}", new.kinetic_energy, old.kinetic_energy));
    }
    if changes.is_empty() { "bits only".to_owned() } else { changes.join(", ") }
}

/// The bodies that ended elsewhere, those that moved most first; and those that are gone or new.
fn bodies(old: &[BodyRow], new: &[BodyRow]) -> Vec<String> {
    let names = |rows: &[BodyRow]| rows.iter().map(|row| row.name.clone()).collect::<Vec<_>>();
    let mut lines = list_change(&names(old), &names(new));
    let before = |name: &str| old.iter().find(|row| row.name == name);
    let mut moves: Vec<Move> = new.iter().filter_map(|row| Move::between(before(&row.name)?, row)).collect();
    if moves.is_empty() {
        return lines;
    }
    moves.sort_by(|a, b| b.size().total_cmp(&a.size()));
    let those = counted(moves.len(), "body", "bodies");
    lines.push(format!("{those} of {} ended otherwise, those that differ most first:", new.len()));
    lines.extend(moves.iter().take(NAMED).map(|moved| format!("  {}", moved.in_words())));
    if moves.len() > NAMED {
        lines.push(format!("  and {} more", moves.len() - NAMED));
    }
    lines
}

/// What of one body differs: quantity, before, after, difference; the largest difference first.
struct Move {
    name: String,
    changes: Vec<(&'static str, f64, f64, f64)>,
}

impl Move {
    fn between(old: &BodyRow, new: &BodyRow) -> Option<Self> {
        let turned = (new.angle - old.angle + PI).rem_euclid(TAU) - PI;
        let mut changes: Vec<_> = [
            ("x", old.x, new.x, new.x - old.x),
            ("z", old.z, new.z, new.z - old.z),
            ("angle", old.angle, new.angle, turned),
            ("vx", old.vx, new.vx, new.vx - old.vx),
            ("vz", old.vz, new.vz, new.vz - old.vz),
            ("spin", old.spin, new.spin, new.spin - old.spin),
        ]
        .into_iter()
        .filter(|(_, before, after, _)| before != after)
        .collect();
        changes.sort_by(|a, b| b.3.abs().total_cmp(&a.3.abs()));
        (!changes.is_empty()).then(|| Move { name: new.name.clone(), changes })
    }

    fn size(&self) -> f64 {
        self.changes.first().map_or(0.0, |change| change.3.abs())
    }

    fn in_words(&self) -> String {
        let change =
            |(what, before, after, by): &(&str, f64, f64, f64)| format!("{what} {before} → {after} ({by:+.6})");
        let shown: Vec<String> = self.changes.iter().take(QUANTITIES).map(change).collect();
        let rest = self.changes.len() - shown.len();
        let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
        format!("{}: {}{more}", self.name, shown.join(", "))
    }
}

fn expectations(old: &Snapshot, new: &Snapshot) -> Vec<String> {
    let said = |snapshot: &Snapshot| -> Vec<String> {
        let mark = |held| if held { "✓" } else { "✗" };
        snapshot.expectations.iter().map(|judged| format!("{} {}", mark(judged.held), judged.text)).collect()
    };
    list_change(&said(old), &said(new))
}

/// The counts that differ.
fn work(old: &Snapshot, new: &Snapshot) -> Option<String> {
    let counts = old.work.rows().into_iter().zip(new.work.rows()).filter(|(before, after)| before != after);
    let changes: Vec<String> =
        counts.map(|((label, before), (_, after))| format!("{label} {before} → {after}")).collect();
    (!changes.is_empty()).then(|| format!("counted work: {}", changes.join(", ")))
}
