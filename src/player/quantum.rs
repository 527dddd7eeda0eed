//! How finely the numbers of a page are told.

use std::f64::consts::TAU;

use serde::Serialize;

use super::Error;
use crate::recording::{Recording, State};

/// An angle is told in 2²⁰ parts of a turn: 6 µm at the end of an arm of a metre.
pub(super) const HALF_TURN: i64 = 1 << 19;
/// A normal is told in 2¹² parts of a turn, with the four directions of the axes among them.
const NORMAL: f64 = TAU / 4096.0;
/// Whole numbers that a page's f64 count exactly, with room for differences.
pub(super) const MOST: f64 = (1_u64 << 50) as f64;

/// The steps in which numbers are told, and what places are counted from.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Quantum {
    /// \[m\]: a power of two, at most a millionth of the scene's size and a ten-thousandth of the least side of a rectangle,
    /// or some times that.
    pub(super) place: f64,
    /// \[rad\].
    pub(super) angle: f64,
    /// \[m/s\]: what moves a quarter of a place from frame to frame.
    pub(super) velocity: f64,
    /// \[rad/s\]: the same for angles.
    pub(super) spin: f64,
    /// \[rad\].
    pub(super) normal: f64,
    /// \[m\], of points of contact counted from a body's centre: of a middling rectangle's side a thousandth or so.
    pub(super) point: f64,
}

/// The steps that suit a recording, so many times coarser, and the middle of all places.
pub(super) fn of(recording: &Recording, coarser: f64) -> Result<(Quantum, [f64; 2]), Error> {
    let mut low = [f64::INFINITY; State::COUNT];
    let mut high = [f64::NEG_INFINITY; State::COUNT];
    for frame in &recording.frames {
        for (body, state) in frame.states.iter().enumerate() {
            let numbers = state.to_array();
            if numbers.iter().any(|number| !number.is_finite()) {
                return Err(not_finite(recording, body, frame.iteration));
            }
            for (k, number) in numbers.into_iter().enumerate() {
                (low[k], high[k]) = (low[k].min(number), high[k].max(number));
            }
        }
    }
    if recording.frames.is_empty() || recording.bodies.is_empty() {
        (low, high) = ([0.0; State::COUNT], [0.0; State::COUNT]);
    }
    let middle = [0, 1].map(|k| (0.5 * low[k] + 0.5 * high[k]).round());
    let most = |columns: [usize; 2]| columns.map(|k| low[k].abs().max(high[k].abs())).into_iter().fold(0.0, f64::max);
    let size = [0, 1].map(|k| high[k] - low[k]).into_iter().fold(0.0, f64::max);
    let sides = recording.bodies.iter().flat_map(|body| &body.rects).flat_map(|rect| [rect.width(), rect.depth()]);
    let least = sides.fold(f64::INFINITY, f64::min);
    let wanted = (1e-6 * size.max(least)).min(1e-4 * least);
    let place = step(coarser * if wanted.is_finite() { wanted } else { 1e-6 * size.max(1.0) }, size);
    let angle = TAU / (2 * HALF_TURN) as f64;
    let between = recording.about.time_step * recording.about.every.max(1) as f64;
    let velocity = step(place / between / 4.0, most([3, 4]));
    let spin = step(angle / between / 4.0, most([5, 5]));
    Ok((Quantum { place, angle, velocity, spin, normal: NORMAL, point: 16.0 * place }, middle))
}

/// The power of two at or below a size, but no finer than whole numbers can count up to `most` in.
fn step(wanted: f64, most: f64) -> f64 {
    let least = (most / MOST).max(f64::MIN_POSITIVE);
    libm::ldexp(1.0, libm::ilogb(wanted.max(least)))
}

fn not_finite(recording: &Recording, body: usize, iteration: u64) -> Error {
    let name = recording.bodies.get(body).map_or("a body", |body| body.name.as_str());
    Error::Call {
        message: format!("{name} is not at a finite place after iteration {iteration}: no page can show that"),
        hint: "record the run again; a run ends before a body leaves the finite numbers".to_owned(),
    }
}
