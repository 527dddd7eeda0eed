//! What a fit came to, for people and for programs.

use super::answer::{Answer, Value};
use crate::Error;
use crate::output::numbers::{counted, rough};
use crate::output::table::{Side, table};
use crate::terminal::{BAD, GOOD, HEADING, WARNING, styled};

/// Correlations as strong as that are told of.
const STRONG: f64 = 0.95;
/// As much of a range is nearly all of it.
const NEARLY_ALL: f64 = 0.9;

/// The values, the residuals, what is not determined, and whether everything is met.
#[must_use]
pub fn text(answer: &Answer) -> String {
    let mut text = format!("{}\n\n{}\n", styled(HEADING, &format!("Fit of {}", answer.title)), values(answer));
    text += &residuals(answer);
    for value in answer.values.iter().filter(|value| !value.determined) {
        text += &format!("{}: {}\n", styled(WARNING, "not determined"), open(value));
    }
    text += &strong(answer);
    for other in &answer.alternatives {
        let pairs = answer.values.iter().zip(other);
        let named: Vec<String> = pairs.map(|(value, other)| format!("{} = {}", value.name, rough(*other))).collect();
        text += &format!("{}: {} fits as well\n", styled(WARNING, "not the only answer"), named.join(", "));
    }
    let runs = counted(answer.runs as usize, "run", "runs");
    text += &if answer.met {
        format!("\n{} met within {}; {runs}\n", styled(GOOD, "✓"), answer.tolerance)
    } else {
        let why = "try wider ranges, more --starts, or ask for less: the values are the best that were found";
        format!("\n{} not met within {}; {runs}\n  {why}\n", styled(BAD, "✗"), answer.tolerance)
    };
    text
}

/// One JSON object and a newline.
///
/// # Errors
/// None that an answer can cause; the serialiser's own are passed on.
pub fn json(answer: &Answer) -> Result<String, Error> {
    let object = serde_json::to_string(answer).map_err(|error| Error::unwritable("the fit", &error))?;
    Ok(object + "\n")
}

fn values(answer: &Answer) -> String {
    let sharp = format!("the residual grows by less than {} between", answer.tolerance);
    let columns = [
        ("value", Side::Left),
        ("found", Side::Right),
        ("was", Side::Right),
        ("may be", Side::Left),
        (sharp.as_str(), Side::Left),
    ];
    let row = |value: &Value| {
        let [min, max] = value.range;
        let [low, high] = value.interval;
        let along: Vec<&str> = value.along.iter().map(|along| along.name.as_str()).collect();
        let note = match (value.determined, along.is_empty()) {
            (false, _) => ", not determined".to_owned(),
            (true, false) => format!(", with {}", along.join(", ")),
            (true, true) => String::new(),
        };
        let interval = format!("{}{note}", between(low, high));
        let found = format!("{}", value.value);
        let range = format!("{min} … {max}{}", if value.whole { ", whole" } else { "" });
        vec![value.name.clone(), found, format!("{}", value.was), range, interval]
    };
    table(&columns, &answer.values.iter().map(row).collect::<Vec<_>>())
}

/// Two numbers with as many digits as tell them apart.
fn between(low: f64, high: f64) -> String {
    let width = high - low;
    if width == 0.0 {
        return format!("{low} … {high}");
    }
    let decimals = (1.0 - libm::floor(libm::log10(width))).clamp(0.0, 15.0) as usize;
    format!("{low:.decimals$} … {high:.decimals$}")
}

fn residuals(answer: &Answer) -> String {
    let mut text = String::new();
    if let Some(recording) = &answer.recording {
        text += &format!(
            "→ the recording: {} body sizes away, over {} of {}\n",
            rough(recording.distance),
            counted(recording.frames, "frame", "frames"),
            counted(recording.bodies, "body", "bodies"),
        );
    }
    for target in &answer.targets {
        let weight = if target.weight == 1.0 { String::new() } else { format!(", weight {}", target.weight) };
        text += &format!("→ {}: {}, to be 0{weight}\n", target.text, rough(target.residual));
    }
    text
}

/// What a value that is not determined can be, and with which others it goes.
fn open(value: &Value) -> String {
    let Value { name, interval: [low, high], .. } = value;
    let moves = format!("{name} may go from {} to {}", rough(*low), rough(*high));
    let along: Vec<String> = value
        .along
        .iter()
        .map(|along| format!("{} goes along from {} to {}", along.name, rough(along.ends[0]), rough(along.ends[1])))
        .collect();
    let whole_range = value.range[1] - value.range[0];
    match along.is_empty() {
        true if high - low > NEARLY_ALL * whole_range => {
            format!("{moves} and hardly anything changes: what is wanted does not depend on it")
        }
        true => format!("{moves} before it makes a difference: what is wanted hardly depends on it"),
        false => format!("{moves} if {}: only together are they determined", along.join(" and ")),
    }
}

/// Pairs that are determined each, but go together.
fn strong(answer: &Answer) -> String {
    let Some(correlations) = &answer.correlations else { return String::new() };
    let mut text = String::new();
    for (i, row) in correlations.iter().enumerate() {
        for (j, correlation) in row.iter().enumerate().skip(i + 1) {
            let (a, b) = (&answer.values[i], &answer.values[j]);
            if correlation.abs() > STRONG && a.determined && b.determined {
                let way = if *correlation > 0.0 { "the same way" } else { "opposite ways" };
                let (a, b) = (&a.name, &b.name);
                text += &format!("{a} and {b} go together, {way}: correlation {correlation:.3}\n");
            }
        }
    }
    text
}
