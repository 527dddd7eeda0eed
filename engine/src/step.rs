//! One iteration (§2.1): the story.
//!
//! | stage | function | document |
//! |---|---|---|
//! | advance | [`advance`] | §2.1 |
//! | broad phase | [`BroadPhase::visit`](crate::broad_phase::BroadPhase::visit) | §2.3 |
//! | detect | [`detect::vertices`], or [`detect::complete`] | §2.3 |
//! | relocate | [`relocate::separate`] | §2.4 |
//! | exchange | [`document::exchange`], or [`impulse::act`](crate::exchange::impulse::act) | §2.5 |

use crate::advance::{advance, frame_before, is_finite};
use crate::area::Vec2;
use crate::bodies::Motion;
use crate::check::shown;
use crate::detect;
use crate::error::Fault;
use crate::exchange::document::Losses;
use crate::exchange::{PairKind, document};
use crate::forces::Flight;
use crate::ledger::Handing;
use crate::plan::{ExchangePlan, FlightPlan};
use crate::push::apply_pushes;
use crate::relocate;
use crate::scene::Detection;
use crate::world::{BodyId, World};

/// One exchange, as it is told to whoever watches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The iteration it belongs to, the first being 0.
    pub iteration: u64,
    /// The pair, in order of creation.
    pub a: BodyId,
    /// The later-created of the two.
    pub b: BodyId,
    /// The point of collision \[m\].
    pub point: Vec2,
    /// Outward normal of the face that was hit.
    pub normal: Vec2,
    /// How deep the vertex was found \[m\].
    pub depth: f64,
    /// Which case of the exchange it was.
    pub kind: PairKind,
}

/// An exchange, before it is told.
struct Exchanged {
    point: Vec2,
    normal: Vec2,
    depth: f64,
    kind: PairKind,
}

impl World {
    /// One whole iteration.
    pub fn step(&mut self) {
        self.begin();
        while self.treat_next().is_some() {}
        self.finish();
    }

    /// The first half: every body advances, every overlapping pair is listed.
    pub fn begin(&mut self) {
        self.listed.clear();
        self.treated = 0;
        if let Some(commanded) = &mut self.commanded {
            commanded.clear();
        }
        if let Some(ledger) = &mut self.ledger {
            ledger.begin();
        }
        if self.fault.is_some() {
            return;
        }
        if let Some(mut state) = self.continuous.take() {
            self.begin_continuous(&mut state);
            self.continuous = Some(state);
            return;
        }
        if let Some(mut contacts) = self.contacts.take() {
            self.begin_contacts(&mut contacts);
            self.contacts = Some(contacts);
            return;
        }
        self.advance();
        self.detect();
    }

    /// The second half, pair by pair: the next listed pair that still overlaps is relocated and exchanges.
    /// `None` when no pair is left.
    pub fn treat_next(&mut self) -> Option<Hit> {
        if let Some(mut state) = self.continuous.take() {
            let hit = self.treat_next_continuous(&mut state);
            self.continuous = Some(state);
            return hit;
        }
        if let Some(contacts) = &mut self.contacts {
            return contacts.next_hit();
        }
        while let Some(&(i, j)) = self.listed.get(self.treated) {
            self.treated += 1;
            if let Some(hit) = self.treat(BodyId(i), BodyId(j)) {
                return Some(hit);
            }
        }
        None
    }

    /// The pairs this iteration found overlapping after its advance, in order. Only where motion is stepped and contacts do not
    /// last is there such a list.
    pub fn listed(&self) -> impl ExactSizeIterator<Item = (BodyId, BodyId)> {
        self.listed.iter().map(|&(a, b)| (BodyId(a), BodyId(b)))
    }

    /// Ends the iteration.
    pub fn finish(&mut self) {
        self.iteration += 1;
        self.work.iterations += 1;
    }

    /// Commands and advance (§2.1).
    fn advance(&mut self) {
        let World { plan, bodies, movers, pushes, work, ledger, .. } = self;
        let dt = plan.time_step;
        self.advances += 1;
        let time = self.advances as f64 * dt;
        let acts = plan.flight != FlightPlan::Free || !pushes.is_empty();
        if let Some(ledger) = ledger {
            ledger.at(time);
            if acts {
                ledger.set_out(bodies, &movers.mobile);
            }
        }
        let lost = advance(bodies, movers, plan.flight, dt, time, work);
        if !pushes.is_empty() {
            let (linear, angular) = match plan.flight {
                FlightPlan::Free => (Flight::new(0.0, dt), Flight::new(0.0, dt)),
                FlightPlan::Forced { linear, angular, .. } => (linear, angular),
            };
            apply_pushes(bodies, pushes, linear, angular);
        }
        if let Some(ledger) = ledger.as_mut().filter(|_| acts) {
            ledger.book_step(bodies, &movers.mobile, plan.flight, dt, pushes);
        }
        pushes.clear();
        if let Some(body) = lost {
            self.report_fault(body);
        }
    }

    /// Lists the pairs that overlap, in order (R3).
    fn detect(&mut self) {
        if self.fault.is_some() {
            return;
        }
        let World { plan, broad_phase, bodies, sides, listed, work, .. } = self;
        let mut list = |i, j| listed.push((i as u32, j as u32));
        match plan.detection {
            Detection::Vertices => broad_phase.visit(bodies, work, |i, j, work| {
                if detect::vertices::find(bodies, i, j, work).is_some() {
                    list(i, j);
                }
            }),
            Detection::Complete => {
                sides.begin();
                let earlier = |body| frame_before(bodies, plan.flight, plan.time_step, body);
                broad_phase.visit(bodies, work, |i, j, work| {
                    if detect::complete::list(bodies, (i, j), sides, earlier, work) {
                        list(i, j);
                    }
                });
                sides.listed();
            }
        }
        listed.sort_unstable();
        listed.dedup();
        work.pairs_listed += listed.len() as u64;
    }

    /// Detects a listed pair again, with the frames as they are by now, and treats it.
    pub(crate) fn treat(&mut self, a: BodyId, b: BodyId) -> Option<Hit> {
        let exchanged = match self.plan.exchange {
            ExchangePlan::Document { epsilon, losses } => self.relocate_and_exchange(a, b, epsilon, losses),
            ExchangePlan::Impulse => self.exchange_impulses(a, b),
        }?;
        self.work.count_exchange(exchanged.kind);
        self.collisions += 1;
        for body in [a.index(), b.index()] {
            if !self.moves_finitely(body) {
                self.report_fault(body);
            }
        }
        let Exchanged { point, normal, depth, kind } = exchanged;
        Some(Hit { iteration: self.iteration, a, b, point: point + self.plan.origin, normal, depth, kind })
    }

    /// The document's way (§2.4, §2.5).
    fn relocate_and_exchange(&mut self, a: BodyId, b: BodyId, epsilon: f64, losses: Losses) -> Option<Exchanged> {
        let World { plan, bodies, sides, work, ledger, .. } = self;
        let contact = detect::contact(plan.detection, bodies, (a.index(), b.index()), sides, work)?;
        let moved = relocate::moved(bodies, &contact);
        let stood = bodies.frame[moved].o;
        let placed = relocate::separate(bodies, &contact, epsilon);
        work.relocations += 1;
        let relocation = (moved, stood, contact.depth + epsilon);
        let handing = ledger.as_ref().map(|_| Handing::new(bodies, &placed, relocation, losses));
        let kind = document::exchange(bodies, &placed, losses);
        if let Some((ledger, handing)) = ledger.as_mut().zip(handing) {
            ledger.book_handings(bodies, &[handing]);
        }
        let kind = kind?;
        Some(Exchanged { point: placed.point, normal: placed.normal, depth: contact.depth, kind })
    }

    /// Newton and Euler's way: impulses at the points that approach; nothing is moved.
    fn exchange_impulses(&mut self, a: BodyId, b: BodyId) -> Option<Exchanged> {
        let World { plan, bodies, sides, work, .. } = self;
        let manifold = detect::manifold(plan.detection, bodies, (a.index(), b.index()), sides, work)?;
        let act = self.act(&manifold)?;
        let kind = PairKind::of(self.bodies.role[a.index()], self.bodies.role[b.index()]);
        Some(Exchanged { point: act.middle, normal: act.normal, depth: manifold.depth, kind })
    }

    pub(crate) fn moves_finitely(&self, body: usize) -> bool {
        let Motion { v, omega } = self.bodies.motion[body];
        is_finite(&self.bodies, body) & v.x.is_finite() & v.y.is_finite() & omega.is_finite()
    }

    /// Remembers the first body that left the finite numbers, and gives up the rest of the iteration.
    pub(crate) fn report_fault(&mut self, body: usize) {
        let (frame, motion) = (self.bodies.frame[body], self.bodies.motion[body]);
        self.treated = self.listed.len();
        let o = frame.o + self.plan.origin;
        let [x, z, vx, vz, spin] = [o.x, o.y, motion.v.x, motion.v.y, motion.omega].map(shown);
        let what = format!("x = {x}, z = {z}, vx = {vx}, vz = {vz}, spin = {spin}");
        let name = self.name(BodyId(body as u32)).to_owned();
        self.fault.get_or_insert(Fault { body: name, iteration: self.iteration, what });
    }
}
