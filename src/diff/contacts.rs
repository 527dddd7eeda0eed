//! The stage of a difference where an iteration is not seen from inside: contacts that last are solved together with finding and
//! advancing, and continuous motion holds them with forces that no exchange tells of. The stage is read off from who touched whom, and
//! from what the premises leave it to come from.

use choque_engine::scene::Kind;

use super::near;
use super::parting::{Difference, Stage, pair, strike};
use super::premises::Otherwise;
use crate::recording::{Frame, Recording};

/// An iteration of both: the frames it began with, which are alike, and those it ended with.
#[derive(Clone, Copy)]
pub(super) struct Iteration<'a> {
    pub(super) runs: [&'a Recording; 2],
    pub(super) before: [&'a Frame; 2],
    pub(super) now: [&'a Frame; 2],
    pub(super) otherwise: Otherwise,
}

impl Iteration<'_> {
    /// What differed first.
    pub(super) fn stage(&self) -> Option<Difference> {
        self.flown().or_else(|| {
            let found = if self.otherwise.finds || !self.otherwise.hands { self.found() } else { None };
            found.or_else(|| self.handed())
        })
    }

    pub(super) fn differing(&self) -> impl Iterator<Item = u32> {
        let [a, b] = self.now;
        (0..a.states.len().min(b.states.len()) as u32)
            .filter(|body| !a.states[*body as usize].is(&b.states[*body as usize]))
    }

    pub(super) fn of_body(&self, stage: Stage, body: u32) -> Difference {
        Difference::of_body(stage, body, self.now.map(|frame| &frame.states[body as usize]))
    }

    /// Nothing is ever handed to a fixed body, nor to one that touches nothing.
    pub(super) fn flown(&self) -> Option<Difference> {
        let flown = |body: &u32| self.otherwise.flies || self.is_fixed(*body) || self.met(*body).is_none();
        self.differing().find(flown).map(|body| self.of_body(Stage::Advance, body))
    }

    pub(super) fn is_fixed(&self, body: u32) -> bool {
        self.runs[0].bodies.get(body as usize).is_some_and(|body| body.kind == Kind::Fixed)
    }

    /// A pair that only one of them finds, or finds otherwise.
    fn found(&self) -> Option<Difference> {
        let [a, b] = self.now;
        let meets = |frame: &Frame, sought: [u32; 2]| {
            frame.listed.contains(&sought)
                || frame.hits.iter().any(|hit| pair(hit) == sought)
                || frame.touches.iter().any(|touch| [touch.a, touch.b] == sought)
        };
        let only = |one: &Frame, other: &Frame| {
            let touches = one.touches.iter().map(|touch| [touch.a, touch.b]);
            one.hits.iter().map(pair).chain(touches).find(|pair| !meets(other, *pair))
        };
        let only = match (only(a, b), only(b, a)) {
            (Some(a), Some(b)) if b < a => Some(("B", b)),
            (Some(a), _) => Some(("A", a)),
            (None, b) => b.map(|b| ("B", b)),
        };
        if let Some((side, pair)) = only {
            return Some(Difference::of_pair(Stage::Detect, pair, format!("only in {side} they touch")));
        }
        a.hits.iter().find_map(|one| {
            let other = b.hits.iter().find(|other| pair(other) == pair(one))?;
            strike(one, other).filter(|found| found.stage == Stage::Detect)
        })
    }

    /// All was found alike.
    pub(super) fn handed(&self) -> Option<Difference> {
        let body = self.differing().find(|body| !self.is_fixed(*body))?;
        let moves = |frame: &Frame| frame.states[body as usize].to_array()[3..].to_vec();
        let stage = if moves(self.now[0]) == moves(self.now[1]) { Stage::Relocate } else { Stage::Exchange };
        Some(Difference { pair: self.met(body), ..self.of_body(stage, body) })
    }

    /// The first pair that a body was in: of exchanges, of contacts that last, of bodies that stand at each other.
    pub(super) fn met(&self, body: u32) -> Option<[u32; 2]> {
        let hits = |frame: &Frame| frame.hits.iter().map(pair).find(|pair| pair.contains(&body));
        let touches = |frame: &Frame| {
            let mut pairs = frame.touches.iter().map(|touch| [touch.a, touch.b]);
            pairs.find(|pair| pair.contains(&body))
        };
        let [a, b] = self.now;
        let told = hits(a).or_else(|| hits(b)).or_else(|| touches(a)).or_else(|| touches(b));
        told.or_else(|| self.before.iter().find_map(|frame| touches(frame)))
            .or_else(|| near::touching(self.runs[0], self.before[0], body))
            .or_else(|| [0, 1].into_iter().find_map(|side| near::touching(self.runs[side], self.now[side], body)))
    }
}
