//! What a designer should do, in one sentence.

use choque_engine::scene::MotionRule;

use super::convergence::Reach;
use super::format::{significant, time_step_in_words, times};
use super::method::Method;
use super::study::{Row, Study};

/// Errors a player does not see: a thousandth of a body's half diagonal.
const GOOD_ENOUGH: f64 = 1e-3;

/// What a designer should do.
#[must_use]
pub fn advice(study: &Study) -> String {
    let mut parts = vec![time_step(study)];
    parts.extend(comparison(study));
    parts.extend(dearest(study));
    parts.join("; ") + "."
}

/// The longest time step that, with every shorter one, is good enough for the method the scene names.
fn time_step(study: &Study) -> String {
    let own = study.own.name();
    let rows: Vec<&Row> = study.rows_of(study.own).filter(|row| row.error.is_some()).collect();
    if rows.is_empty() {
        return without_reference(study);
    }
    match rows.iter().rposition(|row| row.error.is_none_or(|error| error > GOOD_ENOUGH)) {
        None => format!(
            "this scene needs time_step ≤ {} for errors below 1e-3 ({own})",
            time_step_in_words(rows[0].time_step)
        ),
        Some(last) if last + 1 < rows.len() => {
            let good = time_step_in_words(rows[last + 1].time_step);
            format!("this scene needs time_step ≤ {good} for errors below 1e-3 ({own})")
        }
        Some(last) => {
            let finest = time_step_in_words(rows[last].time_step);
            format!("no time_step down to {finest} keeps errors below 1e-3 ({own})")
        }
    }
}

/// What can be said where no error is known: how much the answer itself depends on the time step.
fn without_reference(study: &Study) -> String {
    let moved = study.rows_of(study.own).filter_map(|row| row.moved_by_halving);
    match moved.reduce(f64::min) {
        Some(least) => format!(
            "this scene has no answer to converge to ({}): halving the time step always moves a body by {} half diagonals or more",
            study.own.name(),
            significant(least)
        ),
        None => format!("nothing is known of the error of this scene ({})", study.own.name()),
    }
}

/// Continuous beside stepped at an error of 1e-6, with the scene's way to find collisions.
fn comparison(study: &Study) -> Option<String> {
    let cost = |motion: MotionRule| {
        let summary = study.summary_of(Method { motion, ..study.own })?;
        Some(summary.reaches_1e_6)
    };
    let (stepped, continuous) = (cost(MotionRule::Stepped)?, cost(MotionRule::Continuous)?);
    let ratio = stepped.cost().zip(continuous.cost()).map(|(stepped, continuous)| stepped / continuous);
    let hedge = match (stepped, continuous) {
        (Reach::Extrapolated(_), _) | (_, Reach::Extrapolated(_)) => ", extrapolated",
        _ => "",
    };
    match ratio {
        Some(ratio) if ratio >= 1.0 => Some(format!("continuous is {} × cheaper at 1e-6{hedge}", times(ratio))),
        Some(ratio) => Some(format!("stepped is {} × cheaper at 1e-6{hedge}", times(1.0 / ratio))),
        None if continuous.cost().is_some() => Some("only continuous comes within 1e-6".to_owned()),
        None if stepped.cost().is_some() => Some("only stepped comes within 1e-6".to_owned()),
        None if study.rows.iter().any(|row| row.error.is_some()) => Some("neither motion comes within 1e-6".to_owned()),
        None => None,
    }
}

/// What most of the counted work is, at 1/60.
fn dearest(study: &Study) -> Option<String> {
    let usual = |row: &&Row| (libm::log(60.0 * row.time_step)).abs();
    let row = study.rows_of(study.own).min_by(|a, b| usual(a).total_cmp(&usual(b)))?;
    let deeds = deeds(row);
    let all: u64 = deeds.iter().map(|(_, count)| count).sum();
    let (what, most) = deeds.into_iter().max_by_key(|(_, count)| *count).filter(|(_, count)| *count > 0)?;
    Some(format!("most of the work is {what} ({:.0} % of what is counted)", 100.0 * most as f64 / all as f64))
}

/// What is counted, without the iterations and what is counted in another line already.
#[must_use]
pub fn deeds(row: &Row) -> Vec<(&'static str, u64)> {
    let again = ["iterations", "with gravity or drag"];
    row.work.rows().into_iter().filter(|(what, _)| !again.contains(what)).collect()
}
