//! Contacts solved in sub-steps, in the books: what bodies did in one is split between what acts on them and their touches.
//!
//! ```text
//!   v' = v + a t + c   where a is gravity and pushes, c what the touches changed, over a flight of a time t
//!   a force acts all along: it works by the mean velocity, at the mean place
//!   an impact acts first:   it works by v + c/2, from where the body stood, and the body flies on from v + c
//! ```
//!
//! Either closes exactly but for drag, which has the rest then. Every touch has its own share of c, by its own impulses; what
//! rounding leaves between them and what the bodies changed is booked too.

use super::Ledger;
use super::amounts::{Amounts, Booked, Cause, State, cross};
use super::flight::{Forces, Way, fall_summed};
use super::wide::Sums;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::forces::Flight;

/// What the books know of bodies and touches while contacts are solved.
#[derive(Clone, Debug, Default)]
pub(super) struct InContact {
    /// When the bodies were where they stand \[s\], and how much of the time since then is booked.
    began: f64,
    elapsed: f64,
    /// How each body is, as far as it is booked.
    reached: Vec<Reached>,
    /// By what velocity contacts work on each body, and where they act on it, in the sub-step that is being booked.
    worked: Vec<(Motion, Vec2)>,
    /// What each touch has done.
    by_touch: Vec<Booked>,
    /// What touches changed and have not accounted for.
    rest: Sums,
}

/// How a body is, and how far it has come from where it stands.
#[derive(Clone, Copy, Debug)]
struct Reached {
    state: State,
    come: Vec2,
}

/// What a body did in a sub-step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stint {
    pub(crate) body: usize,
    /// How far it has come, by then, from where it stands: before it flew, and at the end \[m\].
    pub(crate) set_out: Vec2,
    pub(crate) arrived: Vec2,
    /// How far it turned on the way \[rad\].
    pub(crate) turn: f64,
    /// What its motion would be without contacts, and what it is.
    pub(crate) free: Motion,
    pub(crate) motion: Motion,
    /// How long it flew \[s\].
    pub(crate) time: f64,
    /// Whether contacts acted all along.
    pub(crate) by_force: bool,
}

/// The impulses of a touch in a sub-step, on its second body and against its first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pressing {
    /// Which touch it is.
    pub(crate) touch: usize,
    pub(crate) pair: [usize; 2],
    /// Along the normal and across it \[N·s\].
    pub(crate) along: Vec2,
    pub(crate) across: Vec2,
    /// Their moments about each body's centre \[N·m·s\].
    pub(crate) twists: [(f64, f64); 2],
}

/// What a touch that presses books, no more.
const PRESSED: [Cause; 4] = [Cause::Exchange, Cause::Restitution, Cause::Friction, Cause::FixedBodies];

impl Ledger {
    /// Contacts are about to be solved, from that time on.
    pub(crate) fn open_contacts(&mut self, bodies: &Bodies, touches: usize, began: f64) {
        let mut contact = core::mem::take(&mut self.contact);
        let reached = |body| Reached { state: self.state(bodies, body), come: Vec2::zeros() };
        contact.reached.clear();
        contact.reached.extend((0..bodies.len()).map(reached));
        contact.worked.clear();
        contact.worked.extend(bodies.motion.iter().map(|motion| (*motion, Vec2::zeros())));
        contact.by_touch.clear();
        contact.by_touch.resize(touches, Booked::default());
        (contact.began, contact.elapsed) = (began, 0.0);
        self.contact = contact;
    }

    /// There are so many touches by now.
    pub(crate) fn expect_touches(&mut self, touches: usize) {
        self.contact.by_touch.resize(touches, Booked::default());
    }

    /// A body has flown ahead of the others, and come so far from where it stands.
    pub(crate) fn fly_ahead(
        &mut self,
        bodies: &Bodies,
        body: usize,
        (time, forces): (f64, Forces),
        (come, motion): (Vec2, Motion),
    ) {
        let to = Reached { state: State { o: bodies.frame[body].o + come + self.origin, motion }, come };
        self.book_flight(bodies, body, time, &forces, self.contact.reached[body].state, to.state);
        self.contact.reached[body] = to;
    }

    /// An impact is about to be, so much of the sub-step on \[s\]; these bodies have been brought to where they meet.
    pub(crate) fn meet(&mut self, bodies: &Bodies, pair: impl Iterator<Item = usize>, spent: f64) {
        self.at(self.contact.began + self.contact.elapsed + spent);
        for body in pair {
            let Reached { state, .. } = self.contact.reached[body];
            let brought = Sums::of_change(bodies.inertia[body], state, self.state(bodies, body));
            self.book_rest(Cause::Exchange, &brought.energy_and_momenta().1);
        }
    }

    /// It is over; they are put back to where they were.
    pub(crate) fn part(&mut self, bodies: &Bodies, pair: impl Iterator<Item = usize>) {
        for body in pair {
            let met = self.state(bodies, body);
            let state = &mut self.contact.reached[body].state;
            state.motion = met.motion;
            let back = Sums::of_change(bodies.inertia[body], met, *state);
            self.book_rest(Cause::Exchange, &back.energy_and_momenta().1);
        }
    }

    /// Books what acts on a body in contact in a sub-step; what the touches changed is left to them.
    pub(crate) fn book_stint(&mut self, bodies: &Bodies, stint: &Stint, forces: &Forces) {
        let Stint { body, set_out, arrived, turn, free, motion, time, by_force } = *stint;
        let stands = bodies.frame[body].o + self.origin;
        let before = self.contact.reached[body].state;
        let from = self.moved_apart(bodies, body, State { o: stands + set_out, ..before }, set_out);
        let to = State { o: stands + arrived, motion };
        self.contact.reached[body] = Reached { state: to, come: arrived };
        let (inertia, Forces { gravity, pushed, drag, .. }) = (bodies.inertia[body], *forces);
        let (start, a, shift) = (from.motion, gravity + pushed.v, arrived - set_out);
        let changed = Motion { v: motion.v - free.v, omega: motion.omega - free.omega };
        let all_along = by_force && time > 0.0;
        let (mean, at) = if all_along {
            let at = from.o + start.v * (0.5 * time) + a * (time * time / 6.0);
            (Motion { v: shift / time, omega: turn / time }, at)
        } else {
            (Motion { v: start.v + changed.v * 0.5, omega: start.omega + changed.omega * 0.5 }, from.o)
        };
        self.contact.worked[body] = (mean, at);
        if changed == Motion::default() {
            return self.book_flight(bodies, body, time, forces, from, to);
        }
        let mut rest = Sums::of_change(inertia, from, to);
        let later = changed.v * (time * time / if all_along { 6.0 } else { 2.0 });
        let fallen = start.v * Flight::new(drag.0, time).fall + a * fall_summed(drag.0, time);
        let way = Way { time, shift, turn, lever: from.o * time + fallen + later };
        for (cause, a) in [(Cause::Gravity, Motion { v: gravity, omega: 0.0 }), (Cause::Commands, pushed)] {
            let given = way.given(inertia, a);
            self.book(cause, given);
            rest.take(given);
        }
        if drag != (0.0, 0.0) {
            let (p, twist) = (changed.v * inertia.mass, changed.omega * inertia.moment);
            let by_touches = Amounts::of_energy(p.dot(&mean.v) + twist * mean.omega)
                + Amounts::of_impulse(p, at)
                + Amounts::of_twist(twist);
            rest.take(by_touches);
            self.book_rest(Cause::Drag, &rest);
            rest = Sums::default();
            rest.add(by_touches);
        }
        self.contact.rest.add_all(&rest);
    }

    /// A body as it is by now: what has moved it on from where it was booked, if anything, was no motion of its own.
    fn moved_apart(&mut self, bodies: &Bodies, body: usize, to: State, come: Vec2) -> State {
        let Reached { state, come: before } = self.contact.reached[body];
        if come == before {
            return state;
        }
        self.book_rest(Cause::Relocation, &Sums::of_change(bodies.inertia[body], state, to));
        self.relocated.add((come - before).norm());
        self.relocations += 1;
        to
    }

    /// Books what a touch did in the sub-step: its work on both bodies, of which a fixed one does its own part, and the
    /// momenta that a fixed body gives; two mobile ones keep them between them, but for what they come past each other.
    pub(crate) fn book_pressing(&mut self, bodies: &Bodies, pressing: &Pressing) {
        let Pressing { touch, pair, along, across, twists } = *pressing;
        let mut booked = Booked::default();
        let mut at = [Vec2::zeros(); 2];
        for (which, sign) in [(0, -1.0), (1, 1.0)] {
            let body = pair[which];
            let (mean, place) = self.contact.worked[body];
            let (pressed, rubbed) = (twists[which].0 * sign, twists[which].1 * sign);
            let works =
                [along.dot(&mean.v) * sign + pressed * mean.omega, across.dot(&mean.v) * sign + rubbed * mean.omega];
            booked[Cause::Restitution].kinetic_energy += works[0];
            booked[Cause::Friction].kinetic_energy += works[1];
            if bodies.is_mobile(body) {
                at[which] = place;
                booked[Cause::Exchange].angular_momentum += pressed;
                booked[Cause::Friction].angular_momentum += rubbed;
            } else {
                booked[Cause::FixedBodies].kinetic_energy -= works[0] + works[1];
            }
        }
        let mobile = pair.map(|body| if bodies.is_mobile(body) { 1.0 } else { 0.0 });
        for (cause, p) in [(Cause::Exchange, along), (Cause::Friction, across)] {
            let given = p * (mobile[1] - mobile[0]);
            booked[cause].momentum_x += given.x;
            booked[cause].momentum_z += given.y;
            booked[cause].angular_momentum += cross(at[1] - at[0], p);
        }
        for cause in PRESSED {
            self.contact.rest.take(booked[cause]);
            self.book(cause, booked[cause]);
            self.contact.by_touch[touch][cause] += booked[cause];
        }
    }

    /// All bodies and touches of a sub-step of that length are booked.
    pub(crate) fn close_substep(&mut self, h: f64) {
        self.contact.elapsed += h;
        let (energy, momenta) = core::mem::take(&mut self.contact.rest).energy_and_momenta();
        self.book_rest(Cause::Restitution, &energy);
        self.book_rest(Cause::Exchange, &momenta);
    }

    /// A touch is told of as a hit: it has an entry.
    pub(crate) fn enter_touch(&mut self, touch: usize) {
        self.at(self.contact.began + self.contact.elapsed);
        self.enter(self.contact.by_touch[touch], 0.0);
    }

    /// A body in contact was put to where it has come to, but for what rounding makes of that.
    pub(crate) fn settle_in(&mut self, bodies: &Bodies, body: usize, come: Vec2) {
        let now = self.state(bodies, body);
        let booked = self.moved_apart(bodies, body, now, come);
        let rounded = Sums::of_change(bodies.inertia[body], booked, now);
        self.book_rest(Cause::Exchange, &rounded.energy_and_momenta().1);
    }

    /// A body that nothing was near has flown alone.
    pub(crate) fn flown_alone(&mut self, bodies: &Bodies, body: usize, time: f64, forces: &Forces) {
        self.book_flight(bodies, body, time, forces, self.contact.reached[body].state, self.state(bodies, body));
    }
}
