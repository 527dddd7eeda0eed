//! `choque explain`: what a scene needs, what is left out, and where the time goes.

use std::path::Path;
use std::time::Duration;

use choque_engine::{Plan, Work, World};
use choque_scripting::{Callbacks, Options, Scenario, Step};

use crate::output::numbers::{counted, duration};
use crate::output::table::{Side, table};
use crate::terminal::{HEADING, answer, styled};
use crate::{Error, Verdict, clock};

/// A trial run ends after so many iterations …
const MOST_ITERATIONS: u64 = 2000;
/// … or so much time: enough for shares that a second look confirms, short enough to wait for.
const MOST_TIME: Duration = Duration::from_millis(500);

/// Explains a scenario on standard output; trial runs share an iteration between so many threads.
///
/// # Errors
/// A scenario that cannot be loaded, or whose callbacks fail in the trial run.
pub fn explain(file: &Path, threads: usize, options: &Options) -> Result<Verdict, Error> {
    let scenario = Scenario::load(file, options)?;
    let mut start = scenario.start()?.world().clone();
    start.set_threads(threads);
    let with_callbacks = Trial::of_script(&scenario, threads)?;
    let alone = Trial::of_engine(start, with_callbacks.iterations);
    answer(&format!(
        "{}\n{}{}{}{}{}",
        styled(HEADING, &scenario.title()),
        section("Modelled", &with_callbacks.plan.modelled()),
        section("Left out, so nobody pays for it", &listed(&with_callbacks.plan.left_out())),
        section("Callbacks", &callbacks(scenario.callbacks())),
        work_done(&with_callbacks),
        time_spent(scenario.callbacks(), &with_callbacks, &alone),
    ))?;
    Ok(Verdict::Holds)
}

fn section(title: &str, lines: &[String]) -> String {
    let lines: String = lines.iter().map(|line| format!("  {line}\n")).collect();
    format!("\n{}\n{lines}", styled(HEADING, title))
}

fn listed(items: &[&str]) -> Vec<String> {
    vec![if items.is_empty() { "nothing".to_owned() } else { items.join(", ") }]
}

/// What of the script runs, and how often.
fn callbacks(callbacks: Callbacks) -> Vec<String> {
    let Callbacks { on_step, on_collision, stop_when, expect, always } = callbacks;
    let mut lines = Vec::new();
    let mut say = |present: bool, line: String| {
        if present {
            lines.push(line);
        }
    };
    say(on_step, "on_step: once before each iteration".to_owned());
    say(on_collision, "on_collision: once after each exchange".to_owned());
    say(stop_when, "stop_when: once after each iteration".to_owned());
    say(always > 0, format!("always: {} after each iteration", counted(always, "expectation", "expectations")));
    say(expect > 0, format!("expect: {} once at the end", counted(expect, "expectation", "expectations")));
    if lines.is_empty() {
        lines.push("none: the script is done once the scene is made".to_owned());
    }
    lines
}

/// The first iterations of a scenario, counted and timed.
struct Trial {
    /// The plan at the end: a callback may have given a fixed body physics.
    plan: Plan,
    iterations: u64,
    work: Work,
    /// From before the first iteration to after the last.
    total: Duration,
    /// Of it, advance, broad phase and detection; measured for the engine alone.
    find: Duration,
}

impl Trial {
    /// With callbacks, as `run` does it.
    fn of_script(scenario: &Scenario, threads: usize) -> Result<Self, Error> {
        let mut run = scenario.start()?;
        run.set_threads(threads);
        let most = run.world().plan().steps.min(MOST_ITERATIONS);
        let since = clock::now();
        while run.world().iteration() < most && since.elapsed() < MOST_TIME {
            if run.step()? == Step::Done {
                break;
            }
        }
        let (total, world) = (since.elapsed(), run.world());
        Ok(Trial {
            plan: world.plan().clone(),
            iterations: world.iteration(),
            work: *world.work(),
            total,
            find: Duration::ZERO,
        })
    }

    /// Without callbacks, a stopwatch between the two halves of each iteration.
    fn of_engine(mut world: World, most: u64) -> Self {
        let (mut total, mut find) = (Duration::ZERO, Duration::ZERO);
        while world.iteration() < most && total < MOST_TIME {
            let begun = clock::now();
            world.begin();
            let found = clock::now();
            while world.treat_next().is_some() {}
            world.finish();
            find += found - begun;
            total += begun.elapsed();
        }
        Trial { plan: world.plan().clone(), iterations: world.iteration(), work: *world.work(), total, find }
    }

    fn per_iteration(&self) -> f64 {
        self.total.as_secs_f64() / self.iterations.max(1) as f64
    }
}

fn work_done(trial: &Trial) -> String {
    let title = format!("Counted work of {}", counted(trial.iterations as usize, "iteration", "iterations"));
    let columns = [("", Side::Left), ("in all", Side::Right), ("per iteration", Side::Right)];
    let done = trial.work.rows().into_iter().filter(|(label, count)| *count > 0 && *label != "iterations");
    let row = |(label, count): (&str, u64)| {
        vec![label.to_owned(), count.to_string(), format!("{:.2}", count as f64 / trial.iterations.max(1) as f64)]
    };
    let rows: Vec<Vec<String>> = done.map(row).collect();
    let body = if rows.is_empty() { "  none\n".to_owned() } else { table(&columns, &rows) };
    section(&title, &[]) + body.as_str()
}

/// Shares of the measured time. What callbacks cost is the difference between the run with them and the same
/// scene without; that is exact only as far as callbacks do not change what collides.
fn time_spent(callbacks: Callbacks, with: &Trial, alone: &Trial) -> String {
    let run = alone.per_iteration().max(with.per_iteration());
    let (find, treat) = (alone.find.as_secs_f64(), (alone.total - alone.find).as_secs_f64());
    let of_engine = |part: f64| part / alone.iterations.max(1) as f64;
    let scripted = callbacks.on_step || callbacks.on_collision || callbacks.stop_when || callbacks.always > 0;
    let mut parts =
        vec![("advance, broad phase and detection", of_engine(find)), ("relocation and exchange", of_engine(treat))];
    let mut whole = alone.per_iteration();
    if scripted {
        parts.push(("callbacks: the run less the same scene without them", run - alone.per_iteration()));
        whole = run;
    }
    let share = |part: f64| if whole > 0.0 { 100.0 * part / whole } else { 0.0 };
    let row = |(what, time): &(&str, f64)| vec![(*what).to_owned(), duration(*time), format!("{:.0} %", share(*time))];
    let columns = [("", Side::Left), ("per iteration", Side::Right), ("share", Side::Right)];
    let rows: Vec<Vec<String>> = parts.iter().map(row).collect();
    section(&format!("Measured time: {} an iteration", duration(whole)), &[]) + table(&columns, &rows).as_str()
}
