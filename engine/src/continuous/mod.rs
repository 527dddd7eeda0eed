//! Continuous motion: the other story of an iteration. Bodies fly to the earliest impact, exchange there, and go on.
//!
//! | stage | function |
//! |---|---|
//! | a segment begins: what will touch is foreseen | [`Continuous::begin_segment`] |
//! | the earliest instant: all impacts at it | [`Continuous::next_instant`] |
//! | exchange there | [`instant`] |
//! | contacts that last: which, and the forces that hold them | [`lasting`], [`hold`] |
//! | the two bodies' future is foreseen again | [`Continuous::foresee`] |
//! | the segment ends: every body flies to its end | [`Continuous::end_segment`] |
//! | pairs that overlap for good are treated as stepped motion does | [`World::treat_stuck`] |
//!
//! A segment is an iteration, or where there are many bodies one of 2ᵏ equal parts of it, so short that a body of middling
//! speed moves about half its own size: then it meets few others and what is foreseen is seldom in vain. How an iteration
//! is cut depends on speeds and sizes alone, neither on the order of creation nor on how pairs are found.
//!
//! **Finite work.** A pair that would bounce lower than [`lasting::REST_HEIGHT`] of its size is held. A vertex that comes at
//! less than [`crate::impact_time::STILL`] of the speeds involved does not come. Bodies that are hit again and again without time
//! going on are [jammed](jam).

mod books;
mod drive;
mod forecast;
mod foresight;
mod hold;
mod instant;
mod jam;
mod lasting;
mod neighbours;
mod settle;

use crate::bodies::{Bodies, Motion};
use crate::broad_phase::Sweeping;
use crate::flight::{Path, Pull};
use crate::step::Hit;
use crate::world::World;
use books::{Fliers, Holding};
use forecast::{Event, Forecast, Pair, What};
use lasting::Key;
use neighbours::Neighbours;
use settle::Held;

/// How far, in its own size, a body of middling speed goes in a segment. Shorter segments foresee less in vain and sweep
/// more often; measured on a gas (`cargo bench --bench gas`).
const REACH: f64 = 0.5;

/// For so many iterations speeds in the middle are good enough: they only decide how an iteration is cut.
const FRESH_FOR: u64 = 16;

/// Segments of an iteration at most: beyond this, memory for what is foreseen is the cheaper of the two.
const MOST_SEGMENTS: u32 = 4096;

/// The state of continuous motion; a stepped world has none.
#[derive(Clone, Debug)]
pub(crate) struct Continuous {
    /// What acts on each body; empty while nothing acts on any.
    pulls: Vec<Pull>,
    /// The same without what holds those in lasting contact, and what that has done to each since it was settled.
    free: Vec<Pull>,
    held: Vec<Held>,
    /// What holds each, as the ledger wants it; empty where none is kept.
    holding: Vec<Holding>,
    /// The time to which each body has flown, from the segment's start \[s\].
    since: Vec<f64>,
    /// Which segment of the iteration it is, of how many.
    segment: (u32, u32),
    /// How long a segment is, and the present from its start \[s\].
    length: f64,
    now: f64,
    forecast: Forecast,
    neighbours: Neighbours,
    /// Size of a middling body \[m\]; `None` where every pair is foreseen at once.
    middling: Option<f64>,
    /// Bodies whose future is to be foreseen again.
    dirty: Vec<u32>,
    /// Pairs treated once an iteration, in order.
    stuck: Vec<(u32, u32)>,
    /// Whether contacts can last: forces of contact belong to the impulse exchange.
    holds_lasting: bool,
    /// Contacts that last, in order; those that may begin to; and the bodies in them that were struck.
    lasting: Vec<Key>,
    close: Vec<Key>,
    /// Those that have bounced just now: their contact does not last.
    bounced: Vec<Key>,
    struck: Vec<u32>,
    /// Hits not told yet, the next one last.
    untold: Vec<Hit>,
    /// Of each body, when it was last hit, and how often at that instant.
    hit_at: Vec<(f64, u32)>,
    /// The bodies that were hit in this segment, and how many jams there were.
    was_hit: Vec<u32>,
    jams: u32,
    phase: Phase,
    scratch: Scratch,
}

/// Buffers, warm after the first uses.
#[derive(Clone, Debug, Default)]
struct Scratch {
    found: Vec<u32>,
    instant: Vec<Pair>,
    speeds: Vec<f64>,
}

/// Where in an iteration the world is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// Between iterations.
    Outside,
    /// Flying through a segment.
    Flying,
    /// At the end, treating stuck pairs: the next one.
    Late(usize),
}

impl Continuous {
    /// Of a world of so many bodies, of such a size in the middle.
    pub(crate) fn new(middling: Option<f64>, holds_lasting: bool, count: usize) -> Self {
        Continuous {
            pulls: Vec::new(),
            free: Vec::new(),
            held: Vec::new(),
            holding: Vec::new(),
            since: vec![0.0; count],
            segment: (0, 1),
            length: 0.0,
            now: 0.0,
            forecast: Forecast::new(count),
            neighbours: Neighbours::new(middling.unwrap_or(1.0), count),
            middling,
            dirty: Vec::new(),
            stuck: Vec::new(),
            holds_lasting,
            lasting: Vec::new(),
            close: Vec::new(),
            bounced: Vec::new(),
            struck: Vec::new(),
            untold: Vec::new(),
            hit_at: vec![(f64::NEG_INFINITY, 0); count],
            was_hit: Vec::new(),
            jams: 0,
            phase: Phase::Outside,
            scratch: Scratch::default(),
        }
    }

    /// Time since the iteration began, while it is under way \[s\].
    pub(crate) fn elapsed(&self) -> f64 {
        if self.phase == Phase::Flying { self.segment_start() + self.now } else { 0.0 }
    }

    /// When the segment began, from the iteration's start \[s\].
    fn segment_start(&self) -> f64 {
        f64::from(self.segment.0) * self.length
    }

    /// What decides how the world goes on besides its bodies, for the digest.
    pub(crate) fn words(&self) -> impl Iterator<Item = u64> {
        let word = |a: &u32, b: &u32| u64::from(*a) << 32 | u64::from(*b);
        let lasting = self.lasting.iter().flat_map(move |(a, b, k, l)| [word(a, b), word(k, l)]);
        let cut = core::iter::once(u64::from(self.segment.1));
        self.stuck.iter().map(move |(a, b)| word(a, b)).chain(lasting).chain(cut)
    }

    /// How a body flies from now on.
    fn path(&self, bodies: &Bodies, body: usize) -> Path {
        let path = Path::of(bodies, &self.pulls, body);
        let late = self.now - self.since[body];
        if late > 0.0 { path.after(late) } else { path }
    }

    /// Moves a body to where it is now.
    fn bring(&mut self, world: &mut World, body: usize) {
        let late = self.now - self.since[body];
        if late > 0.0 {
            self.set_out(world, Fliers::One(body as u32));
            self.fly(&mut world.bodies, body, late);
            self.arrive(world, Fliers::One(body as u32), self.now);
            self.since[body] = self.now;
        }
    }

    /// Moves a body on by some time.
    #[inline]
    fn fly(&mut self, bodies: &mut Bodies, body: usize, time: f64) {
        if self.pulls.is_empty() {
            let Motion { v, omega } = bodies.motion[body];
            bodies.shift(body, v * time);
            if omega != 0.0 {
                bodies.turn(body, omega * time);
            }
            return;
        }
        let change = Path::of(bodies, &self.pulls, body).change(time);
        self.count_held_work(bodies, body, &change, time);
        bodies.shift(body, change.shift);
        if change.turn != 0.0 {
            bodies.turn(body, change.turn);
        }
        bodies.motion[body] = change.motion;
    }

    /// A body flies otherwise from now on.
    fn changed(&mut self, body: usize) {
        self.forecast.changed(body);
        self.dirty.push(body as u32);
    }
}

/// The story, told by the world.
impl World {
    /// The first half: what acts in this iteration, and what will touch.
    pub(crate) fn begin_continuous(&mut self, state: &mut Continuous) {
        state.untold.clear();
        state.set_pulls(self);
        state.segment = (0, state.segments(self));
        state.length = self.plan.time_step / f64::from(state.segment.1);
        state.begin_segment(self);
    }

    /// The next exchange; `None` when the iteration is over.
    pub(crate) fn treat_next_continuous(&mut self, state: &mut Continuous) -> Option<Hit> {
        loop {
            if self.fault.is_some() {
                return None;
            }
            if let Some(hit) = state.untold.pop() {
                return Some(hit);
            }
            match state.phase {
                Phase::Outside => return None,
                Phase::Late(next) => match self.treat_stuck(state, next) {
                    Some(hit) => return Some(hit),
                    None => state.phase = Phase::Outside,
                },
                Phase::Flying => {
                    state.foresee_dirty(self);
                    if !state.next_instant(self) {
                        state.end_segment(self);
                    }
                }
            }
        }
    }

    /// Pairs that overlap for good: once an iteration, at its end, as stepped motion does.
    fn treat_stuck(&mut self, state: &mut Continuous, mut next: usize) -> Option<Hit> {
        while let Some(&(a, b)) = state.stuck.get(next) {
            next += 1;
            state.phase = Phase::Late(next);
            let (a, b) = (crate::world::BodyId(a), crate::world::BodyId(b));
            if let Some(hit) = self.treat(a, b) {
                return Some(hit);
            }
        }
        let bodies = &self.bodies;
        state.stuck.retain(|(a, b)| foresight::holds_together(bodies, *a as usize, *b as usize));
        None
    }
}

impl Continuous {
    /// Foresees what will touch from here to the segment's end.
    fn begin_segment(&mut self, world: &mut World) {
        self.now = 0.0;
        for body in self.was_hit.drain(..) {
            self.hit_at[body as usize] = (f64::NEG_INFINITY, 0);
        }
        self.jams = 0;
        self.phase = Phase::Flying;
        self.forecast.clear();
        self.neighbours.forget();
        self.begin_prescribed(world);
        self.hold_struck(world);
        self.hold_all(world);
        let World { broad_phase, bodies, work, .. } = world;
        let pulls = core::mem::take(&mut self.pulls);
        let sweeping = Sweeping { pulls: &pulls, time: self.length };
        broad_phase.visit_swept(bodies, &sweeping, work, |i, j, work| {
            self.foresee(bodies, &pulls, (i, j), work);
        });
        self.pulls = pulls;
        self.dirty.clear();
        self.take_in(world);
    }

    /// How many segments this iteration is cut into.
    fn segments(&mut self, world: &World) -> u32 {
        let Some(size) = self.middling else { return 1 };
        if !world.iteration.is_multiple_of(FRESH_FOR) {
            return self.segment.1;
        }
        let speeds = &mut self.scratch.speeds;
        speeds.clear();
        speeds.extend(world.movers.mobile.iter().map(|body| {
            let motion = world.bodies.motion[*body as usize];
            motion.v.abs().max() + motion.omega.abs() * size * 0.5
        }));
        let middle = speeds.len() / 2;
        let (_, speed, _) = speeds.select_nth_unstable_by(middle, f64::total_cmp);
        let wanted = *speed * world.plan.time_step / (REACH * size);
        let mut segments = 1;
        while f64::from(segments) < wanted && segments < MOST_SEGMENTS {
            segments *= 2;
        }
        segments
    }

    /// Takes what happens at the earliest instant of the segment; `false` when nothing more happens in it.
    fn next_instant(&mut self, world: &mut World) -> bool {
        let Some(first) = self.forecast.next_within(self.length) else { return false };
        self.now = first.time.max(self.now);
        match first.what {
            What::Touch(pair) => {
                let mut instant = core::mem::take(&mut self.scratch.instant);
                instant.clear();
                instant.push(pair);
                self.gather(&first, &mut instant);
                instant.sort_unstable_by_key(Pair::key);
                instant.dedup_by_key(|pair| pair.key()); // a sweep may show a pair more than once
                self.treat_instant(world, &mut instant);
                self.scratch.instant = instant;
            }
            What::Turn(at) => self.turn(world, at as usize),
            What::Renew(body) => self.hold_those(world, &[body], hold::After::Rest),
            What::Look(key) => self.look(world, key),
        }
        true
    }

    /// The other touches at the same instant: their gaps are closed by now, to within rounding.
    fn gather(&mut self, first: &Event, instant: &mut Vec<Pair>) {
        while let Some(event) = self.forecast.next_within(self.length) {
            match event.what {
                What::Touch(pair) if event.time - first.time <= event.blur => instant.push(pair),
                _ => {
                    self.forecast.put_back(event);
                    return;
                }
            }
        }
    }

    /// Every body flies to the segment's end.
    fn end_segment(&mut self, world: &mut World) {
        self.set_out(world, Fliers::All);
        let World { bodies, movers, work, .. } = world;
        let mut lost = None;
        for &body in movers.mobile.iter().chain(&movers.fixed) {
            let body = body as usize;
            self.fly(bodies, body, self.length - self.since[body]);
            if !crate::advance::is_finite(bodies, body) {
                lost = lost.or(Some(body));
            }
        }
        work.bodies_advanced += (movers.mobile.len() + movers.fixed.len()) as u64;
        if !self.pulls.is_empty() {
            work.bodies_forced += movers.mobile.len() as u64;
        }
        self.arrive(world, Fliers::All, self.length);
        self.segment.0 += 1;
        self.since.fill(0.0);
        self.now = 0.0;
        self.settle_all(world);
        if let Some(body) = lost {
            world.report_fault(body);
        } else if self.segment.0 < self.segment.1 {
            self.begin_segment(world);
            return;
        }
        self.phase = Phase::Late(0);
        world.advances += 1;
        self.keep_time(world);
        let time = world.advances as f64 * world.plan.time_step;
        for prescription in &world.movers.prescribed {
            prescription.apply(&mut world.bodies, time);
        }
        world.work.prescribed += world.movers.prescribed.len() as u64;
    }
}

/// What readers and commands see while an iteration is under way.
impl World {
    /// A body as it is now.
    pub(crate) fn path_now(&self, body: usize) -> Option<Path> {
        let state = self.continuous.as_ref().filter(|state| state.phase == Phase::Flying)?;
        Some(state.path(&self.bodies, body))
    }

    /// A command is about to change a body: it is brought to where it is now, and its future is foreseen anew.
    pub(crate) fn interrupt(&mut self, body: usize) {
        let Some(mut state) = self.continuous.take() else { return };
        state.struck.push(body as u32);
        if state.phase == Phase::Flying {
            state.bring(self, body);
            state.changed(body);
        }
        self.continuous = Some(state);
    }
}
