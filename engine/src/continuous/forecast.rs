//! The queue of predicted impacts: the earliest comes first, and what no longer holds is passed over.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::lasting::Key;
use crate::impact_time::Touch;

/// Something that will happen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    /// When, from the segment's start \[s\].
    pub(super) time: f64,
    /// Another event up to so much later is at the same instant: the gap is closed to within rounding by then \[s\].
    pub(super) blur: f64,
    pub(super) what: What,
    /// How often the two bodies had changed when this was foreseen.
    generations: (u32, u32),
}

/// What will happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum What {
    /// Two rectangles touch.
    Touch(Pair),
    /// A prescribed body turns a corner of its course, or back at the end of its swing.
    Turn(u32),
    /// What is in lasting contact with a body is to be held anew.
    Renew(u32),
    /// Two rectangles come together where a seam hides the face, or part from an overlap: they are to be looked at again.
    Look(Key),
}

/// Two rectangles and the face at which they touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    /// The bodies, a < b.
    pub(super) a: u32,
    pub(super) b: u32,
    /// Their rectangles, by index among those of the body.
    pub(super) rects: (u32, u32),
    pub(super) touch: Touch,
}

impl Pair {
    /// Bodies and rectangles: the order in which impacts of one instant are told.
    pub(super) fn key(&self) -> Key {
        (self.a, self.b, self.rects.0, self.rects.1)
    }
}

impl What {
    /// The one or two bodies it concerns.
    fn bodies(&self) -> (u32, u32) {
        match *self {
            What::Touch(Pair { a, b, .. }) => (a, b),
            What::Turn(body) | What::Renew(body) => (body, body),
            What::Look((a, b, ..)) => (a, b),
        }
    }

    /// What comes first of several at one time.
    fn rank(&self) -> (Key, u8) {
        match *self {
            What::Touch(pair) => (pair.key(), 0),
            What::Turn(body) => ((body, body, 0, 0), 1),
            What::Renew(body) => ((body, body, 0, 0), 2),
            What::Look(key) => (key, 3),
        }
    }
}

impl PartialEq for Event {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Event {}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Event {
    /// The greatest is the earliest, and of those at one time the first created: what the heap gives first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.time.total_cmp(&self.time).then_with(|| other.what.rank().cmp(&self.what.rank()))
    }
}

/// What is foreseen.
#[derive(Clone, Debug, Default)]
pub(super) struct Forecast {
    queue: BinaryHeap<Event>,
    /// How often each body's flight has changed.
    generation: Vec<u32>,
}

impl Forecast {
    pub(super) fn new(bodies: usize) -> Self {
        Forecast { queue: BinaryHeap::new(), generation: vec![0; bodies] }
    }

    /// Nothing is foreseen any more.
    pub(super) fn clear(&mut self) {
        self.queue.clear();
    }

    pub(super) fn expect(&mut self, time: f64, blur: f64, what: What) {
        let (a, b) = what.bodies();
        let generations = (self.generation[a as usize], self.generation[b as usize]);
        self.queue.push(Event { time, blur, what, generations });
    }

    /// A body flies otherwise from now on: what was foreseen of it no longer holds.
    pub(super) fn changed(&mut self, body: usize) {
        self.generation[body] = self.generation[body].wrapping_add(1);
    }

    /// The earliest event that still holds, if it comes within a time.
    pub(super) fn next_within(&mut self, time: f64) -> Option<Event> {
        while let Some(event) = self.queue.peek() {
            if event.time > time {
                return None;
            }
            let (a, b) = event.what.bodies();
            let holds = event.generations == (self.generation[a as usize], self.generation[b as usize]);
            let event = self.queue.pop();
            if holds {
                return event;
            }
        }
        None
    }

    /// Puts back an event that was taken too early.
    pub(super) fn put_back(&mut self, event: Event) {
        self.queue.push(event);
    }
}
