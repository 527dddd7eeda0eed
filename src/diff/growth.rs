//! How far two runs are apart, from where they part to where the shorter one ends.

use super::parting::common;
use crate::recording::{Body, Frame, Recording, State};

/// How far apart two runs are at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Iterations finished, in A.
    pub iteration: u64,
    /// In A \[s\].
    pub time: f64,
    /// The greatest distance between the two places of a corner of a body \[m\].
    pub distance: f64,
    /// The body it is of: the first that differs where none is displaced; `None` where none differs.
    pub body: Option<u32>,
    /// How many bodies are not the same to the last bit.
    pub bodies: usize,
    /// Kinetic energy of B less that of A \[J\].
    pub energy: f64,
}

/// Rows of the table of growth at most.
const ROWS: usize = 14;

/// Moments that count as one when the time steps are not the same: relative to the time.
const SAME_TIME: f64 = 1e-9;

/// Fewer moments at the same time say nothing of growth.
const FEWEST: usize = 3;

/// How two runs went apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Every moment that both have.
    pub moments: Vec<Apart>,
    /// Whether frames of the same time were compared, as runs of several time steps allow; else those of the same iteration.
    pub is_by_time: bool,
}

/// The distance at every moment that both have, from an iteration of A on.
#[must_use]
pub fn growth(a: &Recording, b: &Recording, from: u64) -> Growth {
    let by_time = by_time(a, b);
    let is_by_time = by_time.is_some();
    let frames = by_time.unwrap_or_else(|| common(a, b)).into_iter().map(|[i, j]| (&a.frames[i], &b.frames[j]));
    let frames = frames.filter(|(frame, _)| frame.iteration >= from);
    Growth { moments: frames.map(|(one, other)| apart(&a.bodies, one, other)).collect(), is_by_time }
}

/// Of runs whose time steps are not the same, frames of the same time, if there are enough.
fn by_time(a: &Recording, b: &Recording) -> Option<Vec<[usize; 2]>> {
    if a.about.time_step == b.about.time_step {
        return None;
    }
    let mut pairs = Vec::new();
    let mut others = b.frames.iter().enumerate().peekable();
    for (at, frame) in a.frames.iter().enumerate() {
        let slack = SAME_TIME * frame.time.abs().max(a.about.time_step);
        while others.next_if(|(_, other)| other.time < frame.time - slack).is_some() {}
        if let Some((other, _)) = others.next_if(|(_, other)| other.time <= frame.time + slack) {
            pairs.push([at, other]);
        }
    }
    (pairs.len() > FEWEST).then_some(pairs)
}

fn apart(bodies: &[Body], one: &Frame, other: &Frame) -> Apart {
    let states = one.states.iter().zip(&other.states).enumerate();
    let differing: Vec<(u32, [&State; 2])> =
        states.filter(|(_, (a, b))| !a.is(b)).map(|(body, (a, b))| (body as u32, [a, b])).collect();
    let mut found = (0.0, differing.first().map(|(body, _)| *body));
    for (body, [a, b]) in &differing {
        let distance = bodies.get(*body as usize).map_or(0.0, |body| displaced(body, [a, b]));
        if distance > found.0 {
            found = (distance, Some(*body));
        }
    }
    Apart {
        iteration: one.iteration,
        time: one.time,
        distance: found.0,
        body: found.1,
        bodies: differing.len(),
        energy: other.totals.kinetic_energy - one.totals.kinetic_energy,
    }
}

/// The greatest distance between the two places of a corner; of the centre where nothing is turned, or there are no corners.
fn displaced(body: &Body, [a, b]: [&State; 2]) -> f64 {
    let apart = |[a, b]: [[f64; 2]; 2]| libm::hypot(b[0] - a[0], b[1] - a[1]);
    let centre = apart([[a.x, a.z], [b.x, b.z]]);
    if a.angle.to_bits() == b.angle.to_bits() {
        return centre;
    }
    let corners = |state: &State| body.corners(state).into_iter().flatten();
    corners(a).zip(corners(b)).map(|(a, b)| apart([a, b])).fold(centre, f64::max)
}

/// A few of them: closely at first, then ever further apart, and the last.
#[must_use]
pub fn told(all: &[Apart]) -> Vec<Apart> {
    let last = all.len().saturating_sub(1);
    let mut places: Vec<usize> = (0..ROWS)
        .map(|row| libm::pow(last as f64 + 1.0, row as f64 / (ROWS - 1) as f64).round() as usize - 1)
        .map(|place| place.min(last))
        .collect();
    places.dedup();
    places.into_iter().filter_map(|place| all.get(place)).copied().collect()
}
