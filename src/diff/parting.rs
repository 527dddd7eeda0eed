//! The first difference between two runs, and the stage of an iteration it arose in.
//!
//! A stage is blamed when all before it came out alike: commands, then what every body is after the advance, the pairs that
//! overlap, and for each of them in turn where it touches, who is moved, what is handed over, what a callback makes of it.

use std::collections::BTreeSet;
use std::fmt;

use super::aligned::renamed;
use super::contacts::Iteration;
use super::premises::{Otherwise, lists};
use crate::recording::{Command, Frame, Recording, State, Strike};

/// Where two runs part.
#[derive(Clone, Debug, PartialEq)]
pub struct Parting {
    /// The iteration, the first being 0; of [`Stage::Scene`] it says nothing.
    pub iteration: u64,
    /// Its time in both at its end \[s\].
    pub time: [f64; 2],
    /// What it arose in.
    pub stage: Stage,
    /// The body that differs first, by its place in the recordings.
    pub body: Option<u32>,
    /// The pair that was being treated.
    pub pair: Option<[u32; 2]>,
    /// What happened, in words; empty where the numbers say all.
    pub what: String,
    /// The numbers that differ.
    pub rows: Vec<Row>,
}

/// A number in both runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its name.
    pub name: &'static str,
    /// In A and in B.
    pub values: [f64; 2],
}

/// What a difference arises in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Not in an iteration: the scenes begin otherwise.
    Scene,
    /// What a callback did.
    Command,
    /// Free motion, pushes, prescribed motion (§2.1).
    Advance,
    /// Which pairs overlap, and where (§2.3).
    Detect,
    /// Who is moved apart and how far (§2.4).
    Relocate,
    /// What is handed over (§2.5).
    Exchange,
    /// Between two frames that are several iterations apart.
    Unknown,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Stage::Scene => "scene",
            Stage::Command => "command",
            Stage::Advance => "advance",
            Stage::Detect => "detect",
            Stage::Relocate => "relocate",
            Stage::Exchange => "exchange",
            Stage::Unknown => "unknown",
        })
    }
}

/// Bodies that are named of those only one run has.
const NAMED: usize = 6;

/// A difference before it is known when it was.
#[derive(Debug)]
pub(super) struct Difference {
    pub(super) stage: Stage,
    pub(super) body: Option<u32>,
    pub(super) pair: Option<[u32; 2]>,
    pub(super) what: String,
    pub(super) rows: Vec<Row>,
}

impl Difference {
    pub(super) fn of_body(stage: Stage, body: u32, [a, b]: [&State; 2]) -> Self {
        Difference { stage, body: Some(body), pair: None, what: String::new(), rows: rows(a, b) }
    }

    pub(super) fn of_pair(stage: Stage, pair: [u32; 2], what: impl Into<String>) -> Self {
        Difference { stage, body: None, pair: Some(pair), what: what.into(), rows: Vec::new() }
    }

    fn in_pair(self, pair: [u32; 2]) -> Self {
        Difference { pair: Some(pair), ..self }
    }

    fn with(self, rows: Vec<Row>) -> Self {
        Difference { rows, ..self }
    }
}

/// Frames of the same iteration in both, by their places.
#[must_use]
pub fn common(a: &Recording, b: &Recording) -> Vec<[usize; 2]> {
    let iteration = |(at, frame): (usize, &Frame)| (frame.iteration, at);
    let mut others = b.frames.iter().enumerate().map(iteration).peekable();
    let mut pairs = Vec::new();
    for (iteration, at) in a.frames.iter().enumerate().map(iteration) {
        while others.next_if(|other| other.0 < iteration).is_some() {}
        if let Some((_, other)) = others.next_if(|other| other.0 == iteration) {
            pairs.push([at, other]);
        }
    }
    pairs
}

/// Where two runs part; `None` when all that both recorded of the same moments is the same to the last bit.
#[must_use]
pub fn parting(a: &Recording, b: &Recording) -> Option<Parting> {
    if let Some(what) = other_bodies(a, b) {
        let rows = Vec::new();
        return Some(Parting { iteration: 0, time: [0.0; 2], stage: Stage::Scene, body: None, pair: None, what, rows });
    }
    let common = common(a, b);
    let frames = |at: usize| common.get(at).map(|[i, j]| [&a.frames[*i], &b.frames[*j]]);
    let first = (0..common.len()).find(|at| frames(*at).is_some_and(|[a, b]| differ(a, b)))?;
    let [now_a, now_b] = frames(first)?;
    let at = |iteration: u64, found: Difference| {
        let Difference { stage, body, pair, what, rows } = found;
        Parting { iteration, time: [now_a.time, now_b.time], stage, body, pair, what, rows }
    };
    let of_states = |stage| {
        let body = first_differing(&now_a.states, &now_b.states);
        let found = body
            .map(|body| Difference::of_body(stage, body, [&now_a.states[body as usize], &now_b.states[body as usize]]));
        found.unwrap_or(Difference { stage, body, pair: None, what: String::new(), rows: Vec::new() })
    };
    let Some(before) = first.checked_sub(1).and_then(frames) else {
        let others = now_a.states.iter().zip(&now_b.states).filter(|(a, b)| !a.is(b)).count().saturating_sub(1);
        let what = match others {
            0 => String::new(),
            1 => "and so does 1 other body".to_owned(),
            _ => format!("and so do {others} other bodies"),
        };
        return Some(at(0, Difference { what, ..of_states(Stage::Scene) }));
    };
    let began = before[0].iteration;
    if now_a.iteration - began > 1 {
        let what = format!("at some iteration from {began} to {}{}", now_a.iteration - 1, between([now_a, now_b], a));
        return Some(at(began, Difference { what, ..of_states(Stage::Unknown) }));
    }
    let iteration = Iteration { runs: [a, b], before, now: [now_a, now_b], otherwise: Otherwise::of(a, b) };
    let found = stage_of(&iteration).unwrap_or_else(|| of_states(Stage::Exchange));
    Some(at(began, with_body(found, &iteration)))
}

/// Of a pair that is all there is to tell: the body of it that comes out otherwise, and its numbers.
fn with_body(found: Difference, iteration: &Iteration<'_>) -> Difference {
    let Some(pair) = found.pair.filter(|_| found.body.is_none()) else { return found };
    let Some(body) = iteration.differing().find(|body| pair.contains(body)) else { return found };
    let rows = if found.rows.is_empty() { iteration.of_body(found.stage, body).rows } else { found.rows };
    Difference { body: Some(body), rows, ..found }
}

/// The first exchange that differs between two frames several iterations apart.
fn between(frames: [&Frame; 2], run: &Recording) -> String {
    let [a, b] = frames.map(|frame| frame.hits.as_slice());
    let same = |a: &Strike, b: &Strike| a.iteration == b.iteration && same_contact(a, b) && same_after(a, b);
    let at = (0..a.len().max(b.len())).find(|at| !a.get(*at).zip(b.get(*at)).is_some_and(|(a, b)| same(a, b)));
    let known = at.and_then(|at| [a.get(at), b.get(at)].into_iter().flatten().min_by_key(|hit| hit.iteration));
    let name = |body: u32| run.bodies.get(body as usize).map_or("?", |body| body.name.as_str());
    known.map_or_else(String::new, |hit| {
        format!(", no later than the exchange of {} – {} in iteration {}", name(hit.a), name(hit.b), hit.iteration)
    })
}

/// Bodies that only one of the two has, or that are made in another order.
fn other_bodies(a: &Recording, b: &Recording) -> Option<String> {
    let names = |run: &Recording| -> Vec<String> { run.bodies.iter().map(|body| body.name.clone()).collect() };
    let (a_names, mut b_names) = (names(a), names(b));
    if a_names == b_names {
        return None;
    }
    let called = renamed(a, b);
    let mut said: Vec<String> = called.iter().map(|[a, b]| format!("\"{a}\" of A is called \"{b}\" in B")).collect();
    said.truncate(NAMED);
    for name in &mut b_names {
        if let Some([known, _]) = called.iter().find(|[_, new]| new == name) {
            name.clone_from(known);
        }
    }
    let lacking = |side: &str, names: &[String], others: &[String]| {
        let known: BTreeSet<&String> = others.iter().collect();
        let own: Vec<String> =
            names.iter().filter(|name| !known.contains(name)).map(|name| format!("\"{name}\"")).collect();
        let said = match own.len() {
            0 => return None,
            1..=NAMED => own.join(", "),
            more => format!("{} and {} more", own[..NAMED].join(", "), more - NAMED),
        };
        Some(format!("only {side} has {} {said}", if own.len() == 1 { "a body" } else { "bodies" }))
    };
    let lacks = [lacking("A", &a_names, &b_names), lacking("B", &b_names, &a_names)];
    said.extend(lacks.into_iter().flatten());
    Some(if said.is_empty() { "the bodies were made in another order".to_owned() } else { said.join("; ") })
}

fn differ(a: &Frame, b: &Frame) -> bool {
    first_differing(&a.states, &b.states).is_some()
        || a.pushes != b.pushes
        || !alike(&a.commands, &b.commands, same_command)
        || !alike(&a.hits, &b.hits, |a, b| same_contact(a, b) && same_after(a, b))
}

fn alike<T>(a: &[T], b: &[T], same: impl Fn(&T, &T) -> bool) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
}

pub(super) fn first_differing(a: &[State], b: &[State]) -> Option<u32> {
    a.iter().zip(b).position(|(a, b)| !a.is(b)).map(|body| body as u32)
}

/// What differed first within an iteration.
fn stage_of(iteration: &Iteration<'_>) -> Option<Difference> {
    let Iteration { runs: [a, b], now, otherwise, .. } = *iteration;
    commands(now, 0).or_else(|| pushes(now)).or_else(|| {
        if a.about.settings.solves_contacts() || b.about.settings.solves_contacts() {
            return iteration.stage();
        }
        if lists(a) && lists(b) {
            return advance(now, |body| !struck(now, body)).or_else(|| listed(now)).or_else(|| treated(now));
        }
        // Where motion is continuous nothing is listed: what was struck or held tells of the advance only when bodies fly otherwise.
        let flown =
            |body| otherwise.flies || iteration.is_fixed(body) || !struck(now, body) && iteration.met(body).is_none();
        let found = advance(now, flown).or_else(|| treated(now));
        // What holds bodies in lasting contact acts before anything is struck.
        let is_held =
            otherwise.hands && !otherwise.finds && found.as_ref().is_none_or(|found| found.stage == Stage::Detect);
        if is_held { iteration.handed().or(found) } else { found }
    })
}

/// Whether what a body is at the end of an iteration tells of more than its advance.
fn struck(frames: [&Frame; 2], body: u32) -> bool {
    frames.into_iter().any(|frame| {
        let is_advanced = frame.advanced.binary_search_by_key(&body, |(body, _)| *body).is_ok();
        let is_struck = frame.hits.iter().any(|hit| hit.a == body || hit.b == body);
        !is_advanced
            && (is_struck || frame.commands.iter().any(|command| command.body == body && command.exchanges > 0))
    })
}

/// Commands after so many exchanges of the iteration.
fn commands([a, b]: [&Frame; 2], exchanges: u64) -> Option<Difference> {
    let of = |frame: &Frame| -> Vec<Command> {
        frame.commands.iter().filter(|command| command.exchanges == exchanges).copied().collect()
    };
    let (a, b) = (of(a), of(b));
    let at = (0..a.len().max(b.len())).find(|at| match (a.get(*at), b.get(*at)) {
        (Some(a), Some(b)) => !same_command(a, b),
        _ => true,
    })?;
    Some(match (a.get(at), b.get(at)) {
        (Some(a), Some(b)) if a.body == b.body => Difference::of_body(Stage::Command, a.body, [&a.after, &b.after]),
        (Some(only), other) | (other, Some(only)) => {
            let side = if a.get(at).is_some() { "A" } else { "B" };
            let what = match other {
                Some(_) => "a callback writes to another body".to_owned(),
                None => format!("only in {side} a callback writes to it"),
            };
            Difference { what, ..Difference::of_body(Stage::Command, only.body, [&only.after, &only.after]) }
        }
        (None, None) => return None,
    })
}

fn pushes([a, b]: [&Frame; 2]) -> Option<Difference> {
    if a.pushes == b.pushes {
        return None;
    }
    let of = |frame: &Frame, body: u32| {
        let push = frame.pushes.iter().find(|push| push.body == body);
        push.map_or([0.0; 3], |push| [push.force[0], push.force[1], push.torque])
    };
    let mut bodies: Vec<u32> = a.pushes.iter().chain(&b.pushes).map(|push| push.body).collect();
    bodies.sort_unstable();
    let body = bodies.into_iter().find(|body| of(a, *body) != of(b, *body))?;
    let rows = numbers(["push fx", "push fz", "twist"], of(a, body), of(b, body));
    let what = "a callback pushes it otherwise".to_owned();
    Some(Difference { stage: Stage::Command, body: Some(body), pair: None, what, rows })
}

/// Bodies as they stood before anything was treated: those of listed pairs as recorded then, others as they stand now.
fn advance([a, b]: [&Frame; 2], is_told: impl Fn(u32) -> bool) -> Option<Difference> {
    let after = |frame: &Frame, body: u32| {
        let found = frame.advanced.binary_search_by_key(&body, |(body, _)| *body);
        found.map_or(frame.states[body as usize], |at| frame.advanced[at].1)
    };
    (0..a.states.len() as u32)
        .map(|body| (body, after(a, body), after(b, body)))
        .find(|(body, a, b)| !a.is(b) && is_told(*body))
        .map(|(body, a, b)| Difference::of_body(Stage::Advance, body, [&a, &b]))
}

fn listed([a, b]: [&Frame; 2]) -> Option<Difference> {
    if a.listed == b.listed {
        return None;
    }
    let only = |a: &Frame, b: &Frame| a.listed.iter().find(|pair| !b.listed.contains(pair)).copied();
    let found = match (only(a, b), only(b, a)) {
        (Some(a), Some(b)) if b < a => ("B", b),
        (Some(a), _) => ("A", a),
        (None, b) => ("B", b?),
    };
    Some(Difference::of_pair(Stage::Detect, found.1, format!("only {} finds them overlapping", found.0)))
}

/// Exchange by exchange.
fn treated(frames: [&Frame; 2]) -> Option<Difference> {
    let [a, b] = frames.map(|frame| frame.hits.as_slice());
    (0..a.len().max(b.len())).find_map(|at| {
        let found = match (a.get(at), b.get(at)) {
            (Some(a), Some(b)) => strike(a, b),
            (Some(only), None) => {
                Some(Difference::of_pair(Stage::Detect, pair(only), "only A still finds them overlapping"))
            }
            (None, Some(only)) => {
                Some(Difference::of_pair(Stage::Detect, pair(only), "only B still finds them overlapping"))
            }
            (None, None) => None,
        };
        found.or_else(|| commands(frames, at as u64 + 1))
    })
}

/// What differs first of two exchanges that come at the same turn.
pub(super) fn strike(a: &Strike, b: &Strike) -> Option<Difference> {
    if pair(a) != pair(b) {
        let (side, first) = if pair(a) < pair(b) { ("A", a) } else { ("B", b) };
        return Some(Difference::of_pair(Stage::Detect, pair(first), format!("at this turn only {side} treats them")));
    }
    let found = numbers(
        ["time", "depth", "normal x", "normal z"],
        [a.time, a.depth, a.normal[0], a.normal[1]],
        [b.time, b.depth, b.normal[0], b.normal[1]],
    );
    if !found.is_empty() {
        return Some(Difference::of_pair(Stage::Detect, pair(a), "they are found to touch otherwise").with(found));
    }
    let bodies = || pair(a).into_iter().zip(a.after.iter().zip(&b.after));
    let moved = |places: std::ops::Range<usize>| {
        bodies().find(|(_, (a, b))| !numbers_alike(&a.to_array()[places.clone()], &b.to_array()[places.clone()]))
    };
    if let Some((body, (one, other))) = moved(0..3) {
        return Some(Difference::of_body(Stage::Relocate, body, [one, other]).in_pair(pair(a)));
    }
    let found = numbers(["point x", "point z"], a.point, b.point);
    if !found.is_empty() {
        return Some(Difference::of_pair(Stage::Detect, pair(a), "they are found to touch otherwise").with(found));
    }
    let (body, (one, other)) = moved(3..6)?;
    Some(Difference::of_body(Stage::Exchange, body, [one, other]).in_pair(pair(a)))
}

pub(super) fn pair(hit: &Strike) -> [u32; 2] {
    [hit.a, hit.b]
}

fn same_command(a: &Command, b: &Command) -> bool {
    (a.exchanges, a.body) == (b.exchanges, b.body) && a.after.is(&b.after)
}

fn same_contact(a: &Strike, b: &Strike) -> bool {
    let of = |hit: &Strike| [hit.time, hit.depth, hit.normal[0], hit.normal[1], hit.point[0], hit.point[1]];
    pair(a) == pair(b) && numbers_alike(&of(a), &of(b))
}

fn same_after(a: &Strike, b: &Strike) -> bool {
    a.after.iter().zip(&b.after).all(|(a, b)| a.is(b))
}

fn numbers_alike(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a + 0.0).to_bits() == (b + 0.0).to_bits())
}

/// Of a state what differs.
fn rows(a: &State, b: &State) -> Vec<Row> {
    numbers(State::NAMES, a.to_array(), b.to_array())
}

fn numbers<const N: usize>(names: [&'static str; N], a: [f64; N], b: [f64; N]) -> Vec<Row> {
    let all = names.into_iter().zip(a.into_iter().zip(b));
    all.filter(|(_, (a, b))| !numbers_alike(&[*a], &[*b])).map(|(name, (a, b))| Row { name, values: [a, b] }).collect()
}
