//! A study for people.

use super::advice::deeds;
use super::convergence::Reach;
use super::copies::Comparison;
use super::format::{error, significant, time_step_in_words};
use super::method::Method;
use super::reference::Earned;
use super::study::{Referred, Row, Study, Summary};
use crate::output::numbers::{counted, duration};
use crate::output::table::{Side, table};
use crate::terminal::{BAD, FAINT, GOOD, HEADING, styled};

/// Everything, as it is printed.
#[must_use]
pub fn text(study: &Study) -> String {
    let mut text = format!("{}\n", styled(HEADING, &study.title));
    let bodies = counted(study.bodies, "body", "bodies");
    text += &format!("  {} s of {bodies}, exchange {}\n", significant(study.time), study.exchange);
    for line in &study.laws {
        text += &format!("  {}\n", styled(FAINT, line));
    }
    text += &format!("\n{}\n", styled(HEADING, "What errors are measured against"));
    for line in references(study) {
        text += &format!("  {line}\n");
    }
    text += &format!("\n{}\n{}", styled(HEADING, "Speed against error"), rows(&study.rows));
    text += &format!("\n{}\n{}", styled(HEADING, "By method"), summaries(&study.methods));
    if !study.comparisons.is_empty() {
        text += &format!(
            "\n{}\n{}",
            styled(HEADING, "Copies started 1e-9 beside each other"),
            comparisons(&study.comparisons)
        );
    }
    text += &format!("\n{}\n", study.advice);
    let build = &study.build;
    let built =
        format!("{}, opt-level {}, target-cpu {}, {}", build.rustc, build.opt_level, build.target_cpu, build.target);
    for note in study.notes.iter().chain([&built]) {
        text += &format!("{}\n", styled(FAINT, note));
    }
    text
}

/// What errors are measured against and how that was earned, a line each; a scene that cannot be foretold far says so.
#[must_use]
pub fn references(study: &Study) -> Vec<String> {
    let mut lines = Vec::new();
    match study.references.as_slice() {
        [a, b] if (a.earned, a.method) == (b.earned, b.method) => lines.push(reference(a, "all methods")),
        several => lines.extend(several.iter().map(|referred| reference(referred, referred.detection.word()))),
    }
    if let Some(apart) = study.models_apart {
        let kind = if apart <= 1e-9 { "the same answer".to_owned() } else { format!("answers {apart:.1e} apart") };
        lines.push(format!("vertices and complete come to {kind}"));
    }
    lines.push(match study.growth {
        None => "how differences grow is not known: no run could be made".to_owned(),
        Some(growth) => {
            let grown = format!("a difference at the start grows {} × by the end", significant(growth.by_end));
            let lost = growth.horizon.map(|lost| format!("; 1e-12 is 1e-3 after {} s", significant(lost)));
            let until = study.measured_until;
            let cut = (until < 0.999 * study.time).then(|| format!("; errors are told up to {} s", significant(until)));
            [grown, lost.unwrap_or_default(), cut.unwrap_or_default()].concat()
        }
    });
    lines
}

fn reference(referred: &Referred, whose: &str) -> String {
    let made_by = referred.method.map(Method::name).unwrap_or_default();
    match referred.earned {
        Some(Earned::Given) => format!("{whose}: the reference given"),
        Some(Earned::Exact { to_itself, from, .. }) => {
            let from = time_step_in_words(from);
            format!("{whose}: {made_by} (exact: every time step ≤ {from} gives the same to {to_itself:.1e})")
        }
        Some(Earned::Converged { order, remainder }) => {
            format!("{whose}: {made_by} (converged with order {order:.2}, {remainder:.1e} from its limit)")
        }
        None => format!("{whose}: no reference, for no method is exact or converges: no errors are told"),
    }
}

fn rows(rows: &[Row]) -> String {
    let columns = [
        ("method", Side::Left),
        ("time step", Side::Right),
        ("error", Side::Right),
        ("at the end", Side::Right),
        ("rms", Side::Right),
        ("halving moves", Side::Right),
        ("CPU per s", Side::Right),
        ("work per s", Side::Right),
        ("exchanges", Side::Right),
        ("digest", Side::Left),
    ];
    let mut last = None;
    let row = |row: &Row| {
        let name = if last == Some(row.method) { String::new() } else { row.method.name() };
        last = Some(row.method);
        let seconds = row.cpu / row.cpu_per_second;
        let work: u64 = deeds(row).iter().map(|(_, count)| count).sum();
        vec![
            name,
            time_step_in_words(row.time_step),
            error(row.error),
            error(row.error_at_end),
            error(row.error_rms),
            error(row.moved_by_halving),
            duration(row.cpu_per_second),
            significant(work as f64 / seconds),
            row.collisions.to_string(),
            row.digest.clone(),
        ]
    };
    table(&columns, &rows.iter().map(row).collect::<Vec<_>>())
}

fn summaries(summaries: &[Summary]) -> String {
    let columns = [
        ("method", Side::Left),
        ("error at 1/60", Side::Right),
        ("order", Side::Right),
        ("CPU per s for 1e-3", Side::Right),
        ("for 1e-6", Side::Right),
    ];
    let row = |summary: &Summary| {
        vec![
            summary.method.name(),
            error(summary.error_at_sixtieth),
            summary.order.map_or("–".to_owned(), |order| format!("{order:.2}")),
            reach(summary.reaches_1e_3),
            reach(summary.reaches_1e_6),
        ]
    };
    table(&columns, &summaries.iter().map(row).collect::<Vec<_>>())
}

/// A cost, or why there is none.
#[must_use]
pub fn reach(reach: Reach) -> String {
    match reach {
        Reach::Measured(cost) => duration(cost),
        Reach::Extrapolated(cost) => format!("{} extrapolated", duration(cost)),
        Reach::NotReached => "not reached".to_owned(),
    }
}

fn comparisons(comparisons: &[Comparison]) -> String {
    let columns = [
        ("quantity", Side::Left),
        ("method", Side::Left),
        ("median", Side::Right),
        ("95 %", Side::Left),
        ("reference", Side::Right),
        ("95 %", Side::Left),
        ("off [IQR]", Side::Right),
        ("KS p", Side::Right),
        ("", Side::Left),
    ];
    let interval = |[low, high]: [f64; 2]| format!("{} … {}", significant(low), significant(high));
    let mut last = String::new();
    let row = |c: &Comparison| {
        let quantity = if last == c.quantity { String::new() } else { c.quantity.clone() };
        last.clone_from(&c.quantity);
        vec![
            quantity,
            c.method.name(),
            significant(c.median),
            interval(c.interval),
            significant(c.reference),
            interval(c.reference_interval),
            c.off.map_or("–".to_owned(), significant),
            significant(c.likelihood),
            if c.agree { styled(GOOD, "agree") } else { styled(BAD, "differ") },
        ]
    };
    table(&columns, &comparisons.iter().map(row).collect::<Vec<_>>())
}
