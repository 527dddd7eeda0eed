//! How cost grows with the number of bodies: pile-ups from 1,000 to 100,000.

use std::error::Error;

use choque::plot::{Axis, Figure, Look, Point, Series};
use choque::report::format::significant;

use crate::engine::Engine;
use crate::scene::pileup;
use crate::speed::{self, Patience, Row};
use crate::table::Table;

/// Bodies, half a decade apart.
const COUNTS: [usize; 5] = [1_000, 3_162, 10_000, 31_623, 100_000];
/// Steps of every run: the same second of the same traffic.
const STEPS: usize = 60;

/// Measures every engine on every pile-up.
///
/// # Errors
/// A scene that an engine refuses.
pub fn measure(
    engines: &[Engine],
    threads: usize,
    patience: Patience,
    told: impl Fn(&str),
) -> Result<Vec<Row>, Box<dyn Error>> {
    let patience = Patience { steps: patience.steps.or(Some(STEPS)), ..patience };
    let scenes = COUNTS.iter().map(|count| (format!("pileup{count}"), pileup(*count)));
    speed::measure(scenes, engines, threads, patience, told)
}

/// The time of a step by the number of cars, where the engine kept them all.
fn times(rows: &[Row], engine: Engine) -> Vec<(f64, f64)> {
    let of = rows.iter().filter(|row| row.engine == engine).zip(COUNTS);
    of.filter_map(|(row, count)| Some((count as f64, row.sound_ms()?))).collect()
}

/// The exponent of the power of the number that fits times best, by least squares of the logarithms.
#[must_use]
pub fn exponent(times: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = times.iter().map(|(n, t)| (libm::log(*n), libm::log(*t))).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / logs.len() as f64;
    let (x, y) = (mean(|log| log.0), mean(|log| log.1));
    let products = |of: &dyn Fn(f64, f64) -> f64| logs.iter().map(|log| of(log.0 - x, log.1 - y)).sum::<f64>();
    products(&|dx, dy| dx * dy) / products(&|dx, _| dx * dx)
}

/// Milliseconds a step, and the exponent.
#[must_use]
pub fn table(rows: &[Row], engines: &[Engine]) -> Table {
    let counts: Vec<String> = COUNTS.iter().map(ToString::to_string).collect();
    let head = ["engine"].into_iter().chain(counts.iter().map(String::as_str)).chain(["exponent", "spread"]);
    let mut table = Table::new(&head.collect::<Vec<_>>());
    for engine in engines {
        let of: Vec<&Row> = rows.iter().filter(|row| row.engine == *engine).collect();
        let spread = of.iter().map(|row| row.spread).fold(0.0, f64::max);
        let mut cells = vec![engine.word()];
        cells.extend(of.iter().map(|row| row.sound_ms().map_or_else(|| "not finite".to_owned(), significant)));
        cells.extend([format!("{:.2}", exponent(&times(rows, *engine))), format!("{:.0} %", 100.0 * spread)]);
        table.rows.push(cells);
    }
    table
}

/// Milliseconds a step against the number of bodies.
#[must_use]
pub fn figure(rows: &[Row], engines: &[Engine]) -> Figure {
    let series = |(i, engine): (usize, &Engine)| {
        let times = times(rows, *engine);
        Series {
            name: format!("{}, exponent {:.2}", engine.word(), exponent(&times)),
            look: Look(i),
            joined: true,
            points: times.into_iter().map(|(x, y)| Point { x, y, label: None }).collect(),
        }
    };
    let steps = rows.first().map_or(STEPS, |row| row.steps);
    Figure {
        title: "How the cost of a pile-up grows".to_owned(),
        subtitle: format!(
            "cars at random between four walls, 30 % of the ground covered; {steps} steps of 1/60 s, the best of each over all runs"
        ),
        x: Axis::log("cars"),
        y: Axis::log("time of a step [ms]"),
        series: engines.iter().enumerate().map(series).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_is_found_again() {
        let times: Vec<(f64, f64)> = [1.0, 10.0, 300.0].map(|n| (n, 3.0 * n * libm::sqrt(n))).to_vec();
        assert!((exponent(&times) - 1.5).abs() < 1e-12);
    }
}
