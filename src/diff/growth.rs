//! How far two runs are apart, from where they part to where the shorter one ends.

use super::parting::common;
use crate::recording::Recording;

/// How far apart two runs are at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Iterations finished.
    pub iteration: u64,
    /// In A \[s\].
    pub time: f64,
    /// The greatest distance between a body's two places \[m\].
    pub distance: f64,
    /// The body it is of.
    pub body: u32,
    /// How many bodies are not the same to the last bit.
    pub bodies: usize,
    /// Kinetic energy of B less that of A \[J\].
    pub energy: f64,
}

/// Rows of the table of growth at most.
const ROWS: usize = 14;

/// The distance at every moment that both have, from an iteration on.
#[must_use]
pub fn growth(a: &Recording, b: &Recording, from: u64) -> Vec<Apart> {
    let moments = common(a, b).into_iter().map(|[i, j]| (&a.frames[i], &b.frames[j]));
    let apart = |(one, other): (&crate::recording::Frame, &crate::recording::Frame)| {
        let places = one.states.iter().zip(&other.states).enumerate();
        let distances = places.map(|(body, (a, b))| (body, libm::hypot(a.x - b.x, a.z - b.z)));
        let (body, distance) = distances.fold((0, 0.0), |most, next| if next.1 > most.1 { next } else { most });
        Apart {
            iteration: one.iteration,
            time: one.time,
            distance,
            body: body as u32,
            bodies: one.states.iter().zip(&other.states).filter(|(a, b)| !a.is(b)).count(),
            energy: other.totals.kinetic_energy - one.totals.kinetic_energy,
        }
    };
    moments.filter(|(frame, _)| frame.iteration >= from).map(apart).collect()
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
