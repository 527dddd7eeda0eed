//! What the cases came to, as tables, plots and data.

use choque::output::numbers::duration;
use choque::plot::{Axis, Figure, Look, Point, Series};
use choque::report::format::{error as short, times};
use choque::report::statistics::median;

use super::compare::{Standing, standings};
use super::{CONTENDERS, Case, LADDER, Outcome};
use crate::engine::Engine;
use crate::table::Table;

/// A case and what came of it.
pub type Studied = (Case, Vec<Outcome>);

/// Errors as small as rounding are drawn here: they have no logarithm of their own.
const FLOOR: f64 = 1e-16;

/// Error and CPU time of every engine and time step.
#[must_use]
pub fn errors(studied: &[Studied]) -> Table {
    let rates: Vec<String> = LADDER.iter().map(|rate| format!("1/{rate}")).collect();
    let head = ["case", "engine"].into_iter().chain(rates.iter().map(String::as_str));
    let mut table = Table::new(&head.collect::<Vec<_>>());
    for (case, outcomes) in studied {
        for engine in CONTENDERS {
            let cell = |rate: &u32| {
                let found = outcomes.iter().find(|outcome| outcome.engine == engine && outcome.rate == *rate);
                found.map_or("–".to_owned(), |found| {
                    format!("{} · {}", short(Some(found.error)), duration(found.seconds))
                })
            };
            let name = if engine == CONTENDERS[0] { case.title } else { "" };
            table.rows.push([name.to_owned(), engine.word()].into_iter().chain(LADDER.iter().map(cell)).collect());
        }
    }
    table
}

/// Whether choque's curve lies lower than each peer's, case by case.
#[must_use]
pub fn comparison(studied: &[Studied]) -> Table {
    let mut table = Table::new(&["case", "error", "choque from", "box2d", "rapier_f32", "rapier_f64"]);
    for (case, outcomes) in studied {
        let standings = standings(outcomes);
        let mut row = vec![case.title.to_owned(), case.error.to_owned()];
        row.push(standings.first().map_or("–".to_owned(), |first| duration(first.from[0])));
        row.extend(standings.iter().map(verdict));
        table.rows.push(row);
    }
    table
}

/// A standing in words: how many times lower our curve lies, and up to when only theirs goes.
fn verdict(standing: &Standing) -> String {
    let Standing { factor, from: [ours, theirs], .. } = *standing;
    let lower = match factor {
        f if f.is_infinite() => "it loses the bodies".to_owned(),
        f if is_even(f) => "alike".to_owned(),
        f if f > 1.0 => format!("{}× lower", times(f)),
        0.0 => "**choque loses the bodies**".to_owned(),
        f => format!("**{}× higher**", times(1.0 / f)),
    };
    if theirs < ours { format!("{lower}; it alone from {}", duration(theirs)) } else { lower }
}

/// Whether errors are as good as equal; both may be rounding.
fn is_even(factor: f64) -> bool {
    (0.95..=1.05).contains(&factor)
}

/// Error against CPU time, a curve per engine.
#[must_use]
pub fn figure(case: &Case, outcomes: &[Outcome]) -> Figure {
    let point = |outcome: &Outcome| Point {
        x: outcome.seconds,
        y: outcome.error.max(FLOOR),
        label: Some(format!("1/{}", outcome.rate)),
    };
    let points = |engine| outcomes.iter().filter(|outcome| outcome.engine == engine).map(point).collect();
    drawn(case.title, case.error, "CPU time of a run [s]", points)
}

/// All cases with the whole ladder in one plot: the middle of their errors against the CPU time of all.
#[must_use]
pub fn summary(studied: &[Studied]) -> Figure {
    let whole: Vec<&Studied> = studied.iter().filter(|(case, _)| case.finest == LADDER[LADDER.len() - 1]).collect();
    let of = |engine: Engine, rate: u32| {
        let same = |outcome: &&Outcome| outcome.engine == engine && outcome.rate == rate;
        whole.iter().filter_map(|(_, outcomes)| outcomes.iter().find(same)).collect::<Vec<_>>()
    };
    let point = |engine: Engine, rate: u32| {
        let outcomes = of(engine, rate);
        let errors: Vec<f64> = outcomes.iter().map(|outcome| outcome.error).collect();
        let label = Some(format!("1/{rate}"));
        Point { x: outcomes.iter().map(|outcome| outcome.seconds).sum(), y: median(&errors).max(FLOOR), label }
    };
    let points = |engine| LADDER.iter().map(|rate| point(engine, *rate)).collect();
    let title = format!("{} exact cases: the middle of the errors", whole.len());
    drawn(&title, "median over the cases of their errors", "CPU time of all cases [s]", points)
}

fn drawn(title: &str, error: &str, time: &str, points: impl Fn(Engine) -> Vec<Point>) -> Figure {
    let series = |(i, engine): (usize, &Engine)| Series {
        name: engine.word(),
        look: Look(i),
        joined: true,
        points: points(*engine),
    };
    Figure {
        title: title.to_owned(),
        subtitle: format!(
            "{error}; what is smaller than 1e-16 is drawn there; labels: time step [s], of 4 sub-steps but in continuous motion"
        ),
        x: Axis::log(time),
        y: Axis::log("error"),
        series: CONTENDERS.iter().enumerate().map(series).filter(|series| !series.points.is_empty()).collect(),
    }
}

/// Every outcome as CSV.
///
/// # Errors
/// The writer's; none is known.
pub fn csv(studied: &[Studied]) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["case", "engine", "precision", "time_step", "error", "cpu_seconds"])?;
    for (case, outcomes) in studied {
        for Outcome { engine, rate, error, seconds } in outcomes {
            let time_step = 1.0 / f64::from(*rate);
            let numbers = [time_step, *error, *seconds].map(|number| number.to_string());
            let texts = [case.name.to_owned(), engine.word(), engine.precision().to_owned()];
            writer.write_record(texts.iter().chain(&numbers))?;
        }
    }
    Ok(writer.into_inner()?)
}

/// In how many cases our curve lies lower than every peer's, and in how many as low.
#[must_use]
pub fn in_short(studied: &[Studied]) -> String {
    let least = |outcomes: &[Outcome]| standings(outcomes).iter().map(|s| s.factor).fold(f64::INFINITY, f64::min);
    let factors: Vec<f64> = studied.iter().map(|(_, outcomes)| least(outcomes)).collect();
    let count = |is: &dyn Fn(f64) -> bool| factors.iter().filter(|factor| is(**factor)).count();
    format!(
        "Of {} cases choque's curve (continuous motion, where it took part) lies lower than every peer's in {}, at every CPU time in which both can make a run, \
         in the middle case by {} times; as low as the best peer's in {}; higher in {}.",
        factors.len(),
        count(&|factor| factor > 1.0 && !is_even(factor)),
        times(median(&factors)),
        count(&is_even),
        count(&|factor| factor < 1.0 && !is_even(factor)),
    )
}
