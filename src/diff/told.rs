//! A comparison in words and tables.

use super::aligned::aligned;
use super::growth::{Apart, growth, told};
use super::parting::{Parting, Row, Stage, common, parting};
use super::premises::premises;
use crate::output::numbers::{counted, rough, short};
use crate::output::table::{Side, table};
use crate::recording::Recording;
use crate::terminal::{BAD, FAINT, GOOD, HEADING, styled};

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Whether both are the same to the last bit, and as long.
    pub same: bool,
    /// The iteration in which they part, where they do.
    pub iteration: Option<u64>,
    /// All of it, for people.
    pub text: String,
}

/// Compares two runs of these names.
#[must_use]
pub fn comparison(names: [&str; 2], [a, b]: [&Recording; 2]) -> Found {
    let mut text = String::new();
    for (side, name) in ["A", "B"].into_iter().zip(names) {
        text += &format!("{}  {name}\n", styled(HEADING, side));
    }
    let premises = premises(a, b);
    for line in &premises {
        text += &format!("   {line}\n");
    }
    text += "\n";
    let [ends_a, ends_b] = [a, b].map(|recording| recording.ending.steps);
    let Some(parting) = parting(a, b) else {
        let (same, line) = match ends_a == ends_b {
            true => (true, alike(a, b)),
            false => (false, format!("they agree as long as both last: {ends_a} and {ends_b} iterations")),
        };
        text += &format!("{}\n", styled(if same { GOOD } else { BAD }, &line));
        return Found { same, iteration: None, text };
    };
    text += &in_words(&parting, a);
    if premises.is_empty() {
        text += &format!(
            "all that is told of how they were made is alike, both are of choque {}: the programs differ\n\n",
            a.about.choque
        );
    }
    if parting.stage != Stage::Scene || parting.body.is_some() {
        text += &growth_table(&parting, a, b);
    }
    let mut iteration = parting.iteration;
    if parting.stage == Stage::Scene && parting.body.is_none() {
        let (said, parted) = of_those_in_both(a, b);
        text += &said;
        iteration = parted.unwrap_or(iteration);
    }
    text += &judgements(a, b);
    Found { same: false, iteration: Some(iteration), text }
}

/// Where the bodies that both have part, when each run has others too; and in which iteration.
fn of_those_in_both(a: &Recording, b: &Recording) -> (String, Option<u64>) {
    let [a, b] = aligned(a, b);
    let Some(parting) = parting(&a, &b) else {
        return ("the bodies that both have are the same to the last bit at every moment\n".to_owned(), None);
    };
    let text = format!("of the bodies that both have\n{}{}", in_words(&parting, &a), growth_table(&parting, &a, &b));
    (text, Some(parting.iteration))
}

fn alike(a: &Recording, b: &Recording) -> String {
    let moments = counted(common(a, b).len(), "moment", "moments");
    format!("the same to the last bit in every one of {moments}")
}

/// Where they part, and the numbers.
fn in_words(parting: &Parting, a: &Recording) -> String {
    let name = |body: u32| a.bodies.get(body as usize).map_or("?", |body| body.name.as_str());
    let pair = parting.pair.map(|[a, b]| format!(" of {} – {}", name(a), name(b))).unwrap_or_default();
    let body = parting.body.map(|body| format!(": {}", name(body))).unwrap_or_default();
    let iteration = parting.iteration;
    let headline = match parting.stage {
        Stage::Scene => format!("they differ from the start{body}"),
        Stage::Unknown => format!("they part {}{body}", parting.what),
        stage => format!("they part in iteration {iteration}, stage {stage}{pair}{body}"),
    };
    let mut text = format!("{}\n", styled(BAD, &headline));
    if !matches!(parting.stage, Stage::Scene) {
        let [in_a, in_b] = parting.time;
        let times = if in_a == in_b {
            format!("{} s", short(in_a))
        } else {
            format!("{} s and {} s", short(in_a), short(in_b))
        };
        text += &format!("  it ends at {times}; everything before was the same to the last bit\n");
    }
    if !parting.what.is_empty() && parting.stage != Stage::Unknown {
        text += &format!("  {}\n", parting.what);
    }
    text += "\n";
    if !parting.rows.is_empty() {
        let cells = |Row { name, values: [a, b] }: &Row| {
            vec![(*name).to_owned(), exact(*a), exact(*b), format!("{:.3e}", b - a)]
        };
        let rows: Vec<Vec<String>> = parting.rows.iter().map(cells).collect();
        let head = [("", Side::Left), ("A", Side::Right), ("B", Side::Right), ("B − A", Side::Right)];
        text += &table(&head, &rows);
        text += "\n";
    }
    text
}

/// A number to its last digit, in as few characters as that takes.
fn exact(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        size if (1e-4..1e15).contains(&size) => format!("{number}"),
        _ => format!("{number:e}"),
    }
}

/// The widest bar.
const BAR: f64 = 32.0;

/// Bars span at least so many powers of e: a decade, so that what hardly grows looks like it.
const LEAST_SPAN: f64 = core::f64::consts::LN_10;

fn growth_table(parting: &Parting, a: &Recording, b: &Recording) -> String {
    let starts = parting.stage == Stage::Scene;
    let growth = growth(a, b, parting.iteration + u64::from(!starts));
    let told = told(&growth.moments);
    let sizes = || told.iter().map(|apart| apart.distance).filter(|distance| *distance > 0.0);
    let (least, most) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    if told.iter().all(|apart| apart.bodies == 0) {
        return match growth.is_by_time {
            true => "at the times that both have, no body differs\n".to_owned(),
            false => String::new(),
        };
    }
    let bar = |distance: f64| {
        let span = libm::log(most / least).max(LEAST_SPAN);
        let share = if distance > 0.0 { 1.0 - libm::log(most / distance) / span } else { return String::new() };
        "█".repeat((1.0 + (BAR - 1.0) * share).round() as usize)
    };
    let head = [
        ("iteration", Side::Right),
        ("time [s]", Side::Right),
        ("furthest apart [m]", Side::Right),
        ("body", Side::Left),
        ("bodies", Side::Right),
        ("energy B − A [J]", Side::Right),
        ("distance, on a log scale", Side::Left),
    ];
    let name = |body: u32| a.bodies.get(body as usize).map_or("", |body| body.name.as_str());
    let row = |apart: &Apart| {
        vec![
            apart.iteration.checked_sub(1).map_or_else(|| "start".to_owned(), |iteration| iteration.to_string()),
            short(apart.time),
            if apart.distance > 0.0 { format!("{:.2e}", apart.distance) } else { "0".to_owned() },
            apart.body.map_or("–", name).to_owned(),
            apart.bodies.to_string(),
            rough(apart.energy),
            bar(apart.distance),
        ]
    };
    let rows: Vec<Vec<String>> = told.iter().map(row).collect();
    let when = if growth.is_by_time { ", at the same times" } else { "" };
    let caption = format!(
        "how it grew: how far a corner of a body is at most from where it is in the other, and how many bodies differ{when}"
    );
    format!("{}\n{}\n", styled(FAINT, &caption), table(&head, &rows))
}

/// Expectations that only one of the two met.
fn judgements(a: &Recording, b: &Recording) -> String {
    let mut text = String::new();
    for judged in &a.ending.expectations {
        let other = b.ending.expectations.iter().find(|other| other.text == judged.text);
        if let Some(other) = other.filter(|other| other.held != judged.held) {
            let holds = |held| if held { "holds" } else { "fails" };
            text += &format!("\"{}\" {} in A and {} in B\n", judged.text, holds(judged.held), holds(other.held));
        }
    }
    text
}
