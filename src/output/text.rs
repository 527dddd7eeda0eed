//! The summary of a run for people.

use choque_engine::scene::{Kind, Scene};
use choque_engine::{BodyId, World};

use crate::notable::{Notable, notable};
use crate::outcome::{Judgement, Measured, Outcome};
use crate::output::ledger;
use crate::output::numbers::{counted, duration, short, trimmed};
use crate::output::table::{Side, table};
use crate::play::Meeting;
use crate::terminal::{BAD, FAINT, GOOD, HEADING, styled};

/// Everything a summary tells of.
#[derive(Clone, Copy, Debug)]
pub struct Told<'a> {
    /// What was run.
    pub scene: &'a Scene,
    /// The world at the end.
    pub world: &'a World,
    /// The same as data.
    pub outcome: &'a Outcome,
    /// The pairs that met first.
    pub meetings: &'a [Meeting],
}

/// Lines of the plan that the short summary keeps.
const SHORT_PLAN: [&str; 2] = ["bodies:", "exchange:"];

/// Title, plan, bodies, totals, who met first, expectations; with `verbose` also the rest of the plan and the
/// counted work.
#[must_use]
pub fn summary(told: &Told<'_>, verbose: bool) -> String {
    let Told { scene, world, outcome, meetings } = *told;
    let mut text = format!("{}\n", styled(HEADING, &outcome.title));
    for line in world.plan().modelled() {
        if verbose || SHORT_PLAN.iter().any(|start| line.starts_with(start)) {
            text += &format!("  {}\n", styled(FAINT, &line));
        }
    }
    if verbose {
        text += &format!("  {}\n", styled(FAINT, &format!("left out: {}", world.plan().left_out().join(", "))));
    }
    text += &format!("\n{}\n{}", length(world, outcome), bodies(scene, world));
    text += &format!("\n{}{}", totals(outcome, world), first_meetings(world, meetings, outcome.collisions));
    text += &expectations(&outcome.expectations);
    text += &targets(&outcome.targets);
    if let Some(books) = outcome.ledger.as_ref().filter(|_| verbose) {
        text += &format!("\n{}", ledger::whole(books, world));
    }
    if verbose {
        text += &format!("\n{}\n{}", styled(HEADING, "Counted work"), indented(&world.work().to_string()));
    }
    text += &format!("\ndigest {}\n", outcome.digest);
    text
}

fn length(world: &World, outcome: &Outcome) -> String {
    let made = counted(outcome.steps as usize, "iteration", "iterations");
    let early = if outcome.steps < world.plan().steps {
        format!(", stopped before the {} asked for", world.plan().steps)
    } else {
        String::new()
    };
    format!("{made} of {}: {} in all{early}", duration(outcome.time_step), duration(outcome.time))
}

const COLUMNS: [(&str, Side); 9] = [
    ("body", Side::Left),
    ("kind", Side::Left),
    ("x [m]", Side::Right),
    ("z [m]", Side::Right),
    ("angle [rad]", Side::Right),
    ("vx [m/s]", Side::Right),
    ("vz [m/s]", Side::Right),
    ("spin [rad/s]", Side::Right),
    ("mass [kg]", Side::Right),
];

fn bodies(scene: &Scene, world: &World) -> String {
    let Notable { bodies, extremes, untold } = notable(scene, world);
    let mut text = String::new();
    if !bodies.is_empty() {
        text += &table(&COLUMNS, &bodies.iter().map(|id| row(world, *id)).collect::<Vec<_>>());
    }
    if !extremes.is_empty() {
        let columns = [("extreme", Side::Left), ("body", Side::Left), ("value", Side::Right)];
        let rows = extremes.iter().map(|e| vec![e.what.to_owned(), world.name(e.body).to_owned(), short(e.value)]);
        text += &table(&columns, &rows.collect::<Vec<_>>());
    }
    if untold > 0 {
        let untold = counted(untold, "more body is", "more bodies are");
        text += &format!("  {}\n", styled(FAINT, &format!("{untold} not shown; tag those of interest")));
    }
    text
}

fn row(world: &World, id: BodyId) -> Vec<String> {
    let (position, velocity) = (world.position(id), world.velocity(id));
    let numbers = [position.x, position.y, world.angle(id), velocity.x, velocity.y, world.spin(id)].map(short);
    let mut row = vec![world.name(id).to_owned(), world.kind(id).word().to_owned()];
    row.extend(numbers);
    row.push(match world.kind(id) {
        Kind::Mobile => trimmed(&short(world.mass(id))).to_owned(),
        Kind::Fixed => "–".to_owned(), // nobody asks a fixed body's
    });
    row
}

fn totals(outcome: &Outcome, world: &World) -> String {
    let [px, pz] = outcome.momentum.map(short);
    format!(
        "{}\nkinetic energy {} J, momentum ({px}, {pz}) kg·m/s, angular momentum {} kg·m²/s\n{}deepest overlap {} m\n",
        counted(outcome.collisions as usize, "collision", "collisions"),
        short(outcome.kinetic_energy),
        short(outcome.angular_momentum),
        outcome.ledger.as_ref().map_or_else(String::new, |books| ledger::sentences(books, world)),
        short(outcome.deepest),
    )
}

fn first_meetings(world: &World, meetings: &[Meeting], collisions: u64) -> String {
    if meetings.is_empty() {
        return String::new();
    }
    let columns = [
        ("first met", Side::Left),
        ("iteration", Side::Right),
        ("x [m]", Side::Right),
        ("z [m]", Side::Right),
        ("depth [m]", Side::Right),
        ("times", Side::Right),
    ];
    let row = |Meeting { first, times }: &Meeting| {
        let pair = format!("{} – {}", world.name(first.a), world.name(first.b));
        let numbers = [first.point.x, first.point.y, first.depth].map(short);
        [vec![pair, first.iteration.to_string()], numbers.to_vec(), vec![times.to_string()]].concat()
    };
    let mut text = format!("\n{}", table(&columns, &meetings.iter().map(row).collect::<Vec<_>>()));
    let others = collisions - meetings.iter().map(|meeting| meeting.times).sum::<u64>();
    if others > 0 {
        text += &format!("  {}\n", styled(FAINT, &format!("and {others} collisions of others")));
    }
    text
}

/// A line per expectation, with the numbers of those that failed.
#[must_use]
pub fn expectations(judgements: &[Judgement]) -> String {
    let mut text = if judgements.is_empty() { String::new() } else { "\n".to_owned() };
    for judgement in judgements {
        text += &if judgement.held {
            format!("{} {}\n", styled(GOOD, "✓"), judgement.text)
        } else {
            format!("{} {}\n", styled(BAD, "✗"), failure(judgement))
        };
    }
    text
}

/// A line per target, with what it came to.
fn targets(targets: &[Measured]) -> String {
    let mut text = if targets.is_empty() { String::new() } else { "\n".to_owned() };
    for Measured { text: what, weight, residual } in targets {
        let weight = if *weight == 1.0 { String::new() } else { format!(", weight {weight}") };
        text += &format!("→ {what}: {}, to be 0{weight}\n", short(*residual));
    }
    text
}

/// How many numbers of a failed expectation are shown: the last, for they decided it.
const LAST_READ: usize = 8;

/// What a failed expectation says, when it first failed and what was read.
#[must_use]
pub fn failure(judgement: &Judgement) -> String {
    let mut text = judgement.text.clone();
    if let Some(iteration) = judgement.first_failure {
        text += &format!(": first failed after {}", counted(iteration as usize, "iteration", "iterations"));
    }
    let numbers = judgement.numbers.as_slice();
    let (earlier, last) = numbers.split_at(numbers.len().saturating_sub(LAST_READ));
    if !earlier.is_empty() {
        text += &format!("\n    after {}:", counted(earlier.len(), "other number", "other numbers"));
    }
    for (name, value) in last {
        text += &format!("\n    {name} = {value}");
    }
    text
}

/// The lines, each moved in by two but for empty ones.
#[must_use]
pub fn indented(lines: &str) -> String {
    lines.lines().map(|line| if line.is_empty() { "\n".to_owned() } else { format!("  {line}\n") }).collect()
}
