//! A study as a plot.

use super::format::time_step_in_words;
use super::method::Method;
use super::study::{Row, Study};
use super::told::references;
use crate::plot::{Axis, Figure, Look, Point, Series};

/// An error as small as rounding is drawn here at least: it has no logarithm of its own.
const FLOOR: f64 = 1e-16;

/// CPU time against error, a curve per method.
#[must_use]
pub fn figure(study: &Study) -> Figure {
    let point = |row: &Row| {
        Some(Point { x: row.error?.max(FLOOR), y: row.cpu_per_second, label: Some(time_step_in_words(row.time_step)) })
    };
    let series = |method: Method| Series {
        name: method.name(),
        look: Look(method.number()),
        joined: true,
        points: study.rows_of(method).filter_map(point).collect(),
    };
    let subtitle = match study.references.iter().find(|referred| referred.earned.is_some()) {
        Some(_) => format!("exchange {}; {}", study.exchange, references(study).join("; ")),
        None => "no reference has earned its name: there are no errors to plot".to_owned(),
    };
    Figure {
        title: format!("{}: speed against error", study.title),
        subtitle,
        x: Axis::log("error: greatest vertex displacement / half diagonal"),
        y: Axis::log("CPU time per simulated second [s]"),
        series: study.methods.iter().map(|summary| series(summary.method)).collect(),
    }
}
