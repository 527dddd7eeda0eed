//! A comparison in words and tables.

use super::growth::{growth, told};
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
    for line in premises(a, b) {
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
    if parting.stage != Stage::Scene || parting.body.is_some() {
        text += &growth_table(&parting, a, b);
    }
    text += &judgements(a, b);
    Found { same: false, iteration: Some(parting.iteration), text }
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
            vec![(*name).to_owned(), format!("{a}"), format!("{b}"), format!("{:.3e}", b - a)]
        };
        let rows: Vec<Vec<String>> = parting.rows.iter().map(cells).collect();
        let head = [("", Side::Left), ("A", Side::Right), ("B", Side::Right), ("B − A", Side::Right)];
        text += &table(&head, &rows);
        text += "\n";
    }
    text
}

/// The widest bar, for 10 decades each a tenth of it.
const BAR: f64 = 32.0;

fn growth_table(parting: &Parting, a: &Recording, b: &Recording) -> String {
    let all = growth(a, b, parting.iteration + u64::from(parting.stage != Stage::Scene));
    let told = told(&all);
    let sizes = || told.iter().map(|apart| apart.distance).filter(|distance| *distance > 0.0);
    let (least, most) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    if told.is_empty() || most == 0.0 {
        return String::new();
    }
    let bar = |distance: f64| {
        let share = if least < most { libm::log(distance / least) / libm::log(most / least) } else { 1.0 };
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
    let mut rows = Vec::new();
    for apart in &told {
        let distance = if apart.distance > 0.0 { format!("{:.2e}", apart.distance) } else { "0".to_owned() };
        rows.push(vec![
            (apart.iteration.saturating_sub(1)).to_string(),
            short(apart.time),
            distance,
            a.bodies.get(apart.body as usize).map_or_else(String::new, |body| body.name.clone()),
            apart.bodies.to_string(),
            rough(apart.energy),
            if apart.distance > 0.0 { bar(apart.distance) } else { String::new() },
        ]);
    }
    format!(
        "{}\n{}\n",
        styled(FAINT, "how it grew: bodies that differ, and the one furthest from itself"),
        table(&head, &rows)
    )
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
