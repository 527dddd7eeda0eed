//! The stage of a difference where contacts last: an iteration advances, finds and solves together, so the stage is read off from
//! who touched whom.

use choque_engine::scene::{Detection, ExchangeRule, MotionRule};

use super::parting::{Difference, Stage, first_differing, pair, strike};
use crate::recording::{Frame, Recording};

/// Whether contacts last in this run: stepped impulses.
pub(super) fn lasts(recording: &Recording) -> bool {
    let settings = &recording.about.settings;
    settings.exchange == ExchangeRule::Impulse
        && settings.motion == MotionRule::Stepped
        && settings.detection != Some(Detection::Vertices)
}

/// Whether bodies that nothing touches move otherwise.
pub(super) fn flies_otherwise(a: &Recording, b: &Recording) -> bool {
    let flight = |recording: &Recording| {
        let settings = &recording.about.settings;
        (recording.about.time_step, settings.gravity, settings.drag)
    };
    flight(a) != flight(b)
}

pub(super) fn stage_of([a, b]: [&Frame; 2], flies_otherwise: bool) -> Option<Difference> {
    let differing = |body: &u32| !a.states[*body as usize].is(&b.states[*body as usize]);
    let first = first_differing(&a.states, &b.states)?;
    let of = |stage, body: u32| Difference::of_body(stage, body, [&a.states[body as usize], &b.states[body as usize]]);
    let mut bodies = (first..a.states.len() as u32).filter(differing);
    let alone = |body: &u32| met(a, *body).is_none() && met(b, *body).is_none();
    if let Some(body) = bodies.find(|body| flies_otherwise || alone(body)) {
        return Some(of(Stage::Advance, body));
    }
    if let Some(found) = struck([a, b]) {
        return Some(found);
    }
    let meeting = met(a, first).or(met(b, first));
    if let Some([one, other]) = met(a, first).zip(met(b, first)).map(|(a, b)| [a, b]).filter(|[a, b]| a != b) {
        let what = format!("{} touches it first only in {}", "another body", if one < other { "A" } else { "B" });
        return Some(Difference::of_pair(Stage::Detect, one.min(other), what));
    }
    if met(a, first).is_none() != met(b, first).is_none() {
        let side = if met(a, first).is_some() { "A" } else { "B" };
        return Some(Difference::of_pair(Stage::Detect, meeting?, format!("only in {side} they touch")));
    }
    let moves = |frame: &Frame| frame.states[first as usize].to_array()[3..].to_vec();
    let stage = if moves(a) == moves(b) { Stage::Relocate } else { Stage::Exchange };
    Some(Difference { pair: meeting, ..of(stage, first) })
}

/// The exchanges: the first pair that only one has, or that is found otherwise. What they came to is told at the end only.
fn struck([a, b]: [&Frame; 2]) -> Option<Difference> {
    let at = |i: usize| (a.hits.get(i), b.hits.get(i));
    (0..a.hits.len().max(b.hits.len())).find_map(|i| match at(i) {
        (Some(one), Some(other)) => strike(one, other).filter(|found| found.stage == Stage::Detect),
        (Some(only), None) => Some(Difference::of_pair(Stage::Detect, pair(only), "only in A they meet")),
        (None, Some(only)) => Some(Difference::of_pair(Stage::Detect, pair(only), "only in B they meet")),
        (None, None) => None,
    })
}

/// The first pair of an iteration that a body was in.
fn met(frame: &Frame, body: u32) -> Option<[u32; 2]> {
    let hits = frame.hits.iter().map(pair);
    let touches = frame.touches.iter().map(|touch| [touch.a, touch.b]);
    hits.chain(touches).find(|pair| pair.contains(&body))
}
