//! Stepped motion with impulses: contacts that last are solved all together, in sub-steps.
//!
//! | stage | function |
//! |---|---|
//! | who may touch within the step, and where | [`Contacts::find`]; but for two that lie [`still`] |
//! | bodies and touches laid out for the solver | [`Contacts::lay_out`], [`rows`], [`blocks`] |
//! | sub-step: impacts, of fast bodies, of those that touch no other, and in crowds | [`fast`], [`pairs`], [`strike`] |
//! | what an impact or a push sets against others that were apart | [`wake`] |
//! | sub-step: what acts on bodies over it | [`Fliers::set_out`](flying::Fliers::set_out) |
//! | sub-step: few touches are taken as they are midway through it, and what lands parts it in two | [`midway`], [`landing`] |
//! | sub-step: pushes and friction at every touch | [`solve`], [`sweep`], [`hasten`], [`rest`], [`slide`] |
//! | sub-step: bodies go on | [`Fliers::arrive`](flying::Fliers::arrive) |
//! | the step ends: bodies take their places, touches remember | [`Contacts::settle`] |
//!
//! A scene that stands still is taken as one sub-step ([`stand`]). Bodies that nothing is near fly on exactly, in one go. A scene
//! without contacts has no sub-steps.

mod abreast;
mod acting;
mod ahead;
mod apart;
mod arms;
mod blocks;
mod booked;
mod fast;
mod find;
mod flying;
mod hasten;
mod kept;
mod landing;
mod links;
mod loads;
mod look;
mod meeting;
mod midway;
mod open;
mod pairs;
mod part;
#[cfg(test)]
mod plain;
mod points;
mod pulls;
mod remembered;
mod rest;
mod round;
mod rows;
mod search;
mod settle;
mod slide;
mod solve;
mod stand;
mod still;
mod strike;
mod sweep;
mod swept;
mod touch;
mod wake;
mod weights;

use crate::advance::advance_alone;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::frame::Angle;
use crate::plan::{ContactPlan, FlightPlan};
use crate::step::Hit;
use crate::threads::Threads;
use crate::width::Width;
use crate::world::World;
use apart::Apart;
use blocks::Blocks;
use fast::Fast;
use flying::Fliers;
use hasten::Hasten;
use kept::Kept;
use pairs::Pairs;
use pulls::Pulls;
use remembered::Remembered;
use rest::Rest;
use rows::{Row, Rows};
use search::Search;
use still::Still;
use touch::Touch;

pub use loads::Load;

/// Overlaps found at the start of a step are let go at this rate \[1/s\]: a fifth of them in a sixtieth of a second.
const RECOVERY: f64 = 12.0;

/// With so many pairs that are near or fewer they are found anew in every sub-step, for the sake of exactness.
const A_FEW: usize = 128;

/// Points closer than this share of the smaller rectangle touch.
const TOUCHING: f64 = 1e-9;

/// The state of the contact solver; only a world in stepped motion with impulses has one.
#[derive(Clone, Debug)]
pub(crate) struct Contacts {
    plan: ContactPlan,
    /// Whether there is gravity.
    falls: bool,
    width: Width,
    /// Gaps and depths up to this are none \[m\].
    band: f64,
    /// The touches of this step and of the last: those that were found first, in the order of their rectangles.
    touches: Vec<Touch>,
    before: Vec<Touch>,
    /// Pairs of rectangles that may meet within the step.
    search: Search,
    /// Bodies that lie still, whose pairs are not searched for again.
    still: Still,
    /// Pairs that are near and stay apart, as far as can be told when the step begins.
    apart: Apart,
    /// What threads other than the first find, kept for its room.
    shares: Vec<find::Found>,
    /// The part of the step that is being solved, and how much of it is over \[s\].
    dt: f64,
    gone: f64,
    /// What acts on each body over the step.
    pulls: Pulls,
    rows: Rows,
    of_touch: Vec<(u32, u32)>,
    blocks: Blocks,
    fliers: Fliers,
    rest: Rest,
    hasten: Hasten,
    /// How bodies are likely to move on the whole of the sub-step.
    mean: Vec<Row>,
    /// What is laid aside while bodies are moved apart.
    aside: Kept,
    /// Rounds to be spent upon what stands still: fewer where they were in vain.
    patience: u32,
    /// Touches of bodies that touch no other: those left to impacts, and those that are not.
    pairs: Pairs,
    lonely: Vec<u32>,
    /// Touches with restitution among the others; and how many rounds of impacts there have been in the part of the step.
    crowd: Vec<u32>,
    round: u32,
    /// Touches of which it is known that they do not meet within the sub-step.
    clear: Vec<u32>,
    /// How many touches there were when the part of the step began; those that join it come after them.
    found: usize,
    /// Whether any bodies are laid out for the solver; all others fly on in one go.
    solves: bool,
    /// Bodies that fly far within a sub-step; the smallest half size of a mobile body, and how far any such reaches from its centre \[m\].
    fast: Fast,
    smallest: f64,
    farthest: f64,
    /// Whether nothing moved in the step before and nothing has been done since: where sleeping is allowed, all sleeps.
    stood: bool,
    /// What is left of an overlap after a step in which it may recover.
    keep: f64,
    /// The hits of this step, the next to be told last.
    untold: Vec<Hit>,
}

impl Contacts {
    pub(crate) fn new(plan: ContactPlan, flight: FlightPlan, bodies: &Bodies) -> Self {
        let mobile = || (0..bodies.len()).filter(|body| bodies.is_mobile(*body));
        let smallest = mobile().map(|body| bodies.smallest_half(body)).fold(f64::INFINITY, f64::min);
        Contacts {
            plan,
            falls: flight.forces().0 != Vec2::zeros(),
            width: Width::best(),
            band: if smallest.is_finite() { TOUCHING * smallest } else { 0.0 },
            touches: Vec::new(),
            before: Vec::new(),
            search: Search::default(),
            still: Still::default(),
            apart: Apart::default(),
            shares: Vec::new(),
            dt: 0.0,
            gone: 0.0,
            pulls: Pulls::new(bodies),
            rows: Rows::default(),
            of_touch: Vec::new(),
            blocks: Blocks::default(),
            fliers: Fliers::default(),
            rest: Rest::default(),
            hasten: Hasten::default(),
            mean: Vec::new(),
            aside: Kept::default(),
            patience: solve::PATIENCE,
            pairs: Pairs::default(),
            lonely: Vec::new(),
            crowd: Vec::new(),
            round: 0,
            clear: Vec::new(),
            found: 0,
            solves: false,
            fast: Fast::default(),
            smallest: if smallest.is_finite() { smallest } else { 0.0 },
            farthest: mobile().map(|body| bodies.reach(body)).fold(0.0, f64::max),
            stood: false,
            keep: 0.0,
            untold: Vec::new(),
        }
    }

    /// What decides how the world goes on, for its digest.
    pub(crate) fn words(&self) -> impl Iterator<Item = u64> {
        self.remembered()
            .flat_map(Touch::words)
            .chain([u64::from(self.patience) << 1 | u64::from(self.stood && self.plan.sleeping)])
    }

    /// The touches of the last step, in the order of their rectangles.
    fn remembered(&self) -> Remembered<'_> {
        Remembered::new(&self.touches, self.found)
    }

    /// The next hit to be told.
    pub(crate) fn next_hit(&mut self) -> Option<Hit> {
        self.untold.pop()
    }
}

impl World {
    /// A whole step of all bodies: in one go, or where there are few touches in parts of a sub-step each, every one with touches
    /// found anew.
    pub(crate) fn begin_contacts(&mut self, contacts: &mut Contacts) {
        let whole = self.plan.time_step;
        contacts.untold.clear();
        if !contacts.stood {
            contacts.touches.iter_mut().for_each(|touch| touch.met = false);
        }
        contacts.pull(self);
        let parts = if self.stand(contacts) { 0 } else { contacts.parts() };
        for part in 1..=parts {
            if self.fault.is_some() {
                break;
            }
            let elapsed = f64::from(part) / f64::from(parts) * whole;
            let time = if part == parts { whole } else { elapsed } + self.advances as f64 * whole;
            self.solve_part(contacts, whole / f64::from(parts), contacts.plan.substeps / parts, time);
        }
        self.advances += 1;
        self.collisions += contacts.untold.len() as u64;
        contacts.untold.reverse();
        self.pushes.clear();
    }

    /// A part of a step, in so many sub-steps, to a time.
    fn solve_part(&mut self, contacts: &mut Contacts, dt: f64, substeps: u32, time: f64) {
        self.look_ahead(contacts, (dt, substeps), time);
        let lands = if substeps == 1 { contacts.lands(self, dt) } else { None };
        let Some(first) = lands else { return self.solve_found(contacts, (dt, substeps), time, 1.0) };
        let left = dt - first;
        self.set_out_on_courses(time - left, first);
        contacts.lay_out(self, first, 1);
        self.solve_found(contacts, (first, 1), time - left, first / dt);
        self.look_ahead(contacts, (left, 1), time);
        self.solve_found(contacts, (left, 1), time, left / dt);
    }

    /// Touches are found and laid out for a part of a step.
    fn look_ahead(&mut self, contacts: &mut Contacts, (dt, substeps): (f64, u32), time: f64) {
        self.set_out_on_courses(time, dt);
        contacts.find(self, dt);
        contacts.lay_out(self, dt, substeps);
    }

    /// The same, with the touches laid out, where sub-steps are that share of whole ones.
    fn solve_found(&mut self, contacts: &mut Contacts, (dt, substeps): (f64, u32), time: f64, share: f64) {
        contacts.open_books(self, time - dt);
        if contacts.solves {
            let h = dt / f64::from(substeps);
            contacts.begin_flights(self, h, share);
            if share != 1.0 {
                contacts.blocks.scale_pushes(share);
            }
            for k in 0..substeps {
                contacts.gone = f64::from(k) * h;
                contacts.substep(self, h);
            }
            contacts.part_overlaps(self);
        }
        contacts.settle(self, 1.0 / share);
        self.fly_alone(contacts, dt);
        contacts.close_books(self, dt);
        for prescription in &self.movers.prescribed {
            prescription.apply(&mut self.bodies, time);
        }
        self.work.prescribed += self.movers.prescribed.len() as u64;
    }

    /// Bodies on a course are given the motion that takes them where they will be.
    fn set_out_on_courses(&mut self, time: f64, dt: f64) {
        for prescription in &self.movers.prescribed {
            let body = prescription.body;
            let (frame, angle) = (self.bodies.frame[body], self.bodies.angle[body]);
            prescription.apply(&mut self.bodies, time);
            let turn = Angle::new(self.bodies.angle[body].value - angle.value).value;
            let way = self.bodies.frame[body].o - frame.o;
            self.bodies.motion[body] = Motion { v: way / dt, omega: turn / dt };
            (self.bodies.frame[body], self.bodies.angle[body]) = (frame, angle);
        }
    }

    /// Bodies that nothing is near.
    fn fly_alone(&mut self, contacts: &Contacts, dt: f64) {
        let World { plan, bodies, movers, threads, work, .. } = self;
        let touched = |body: u32| contacts.solves && contacts.rows.of(body).is_some();
        let pulls = contacts.pulls.act().then_some(|body: usize| contacts.pulls.on_mobile(body));
        let lost = advance_alone(bodies, movers, (plan.flight, dt), pulls.as_ref(), touched, (threads, work));
        if let Some(body) = lost {
            self.report_fault(body);
        }
    }
}

impl Contacts {
    /// In how many parts the step is solved.
    fn parts(&self) -> u32 {
        let few = (1..=A_FEW).contains(&(self.touches.len() + self.apart.count()));
        if few { self.plan.substeps } else { 1 }
    }

    /// Lays bodies and touches out for the solver.
    fn lay_out(&mut self, world: &World, dt: f64, substeps: u32) {
        let fast = self.find_fast(world, dt / f64::from(substeps));
        self.solves = fast || !self.touches.is_empty();
        if !self.solves {
            return;
        }
        let Contacts { rows, touches, of_touch, apart, search, fast, .. } = self;
        apart.link(search, world.bodies.len());
        rows.fill(&world.bodies, touches, fast.bodies(), of_touch);
        (self.dt, self.gone) = (dt, 0.0);
        self.keep = libm::exp(-RECOVERY * dt);
        self.lonely.clear();
        self.pairs.clear();
        self.round = 0;
        self.crowd.clear();
        for k in 0..self.found {
            if self.is_lonely(k) {
                if self.is_left_to_impacts(k) {
                    (self.touches[k].push, self.touches[k].grip) = ([0.0; 2], 0.0);
                    self.pairs.push(k);
                } else {
                    self.lonely.push(k as u32);
                }
            } else if self.touches[k].surface.restitution > 0.0 {
                self.crowd.push(k as u32);
            }
        }
        let idles = self.idles(self.touches.len() - self.pairs.left_out().len());
        let Contacts { blocks, touches, of_touch, pairs, rows, apart, keep, band, .. } = self;
        blocks.fill((touches, of_touch), pairs.left_out(), rows, (*keep, *band), idles);
        apart.begin_pushing(rows, |row| blocks.hold(row));
    }

    /// Bodies are about to fly, over times of that length; contacts push so many times as hard as they did at the end of the last.
    fn begin_flights(&mut self, world: &World, h: f64, times: f64) {
        self.fliers.pace(self.pulls.act().then(|| world.plan.flight.forces().1), h);
        self.fliers.begin(&self.rows, (&self.touches, &self.of_touch), times);
    }

    fn substep(&mut self, world: &mut World, h: f64) {
        self.strike_fast(world, h);
        self.strike_pairs(world, h);
        self.strike(world, h);
        if self.blocks.count == 0 {
            self.fliers.set_out(&mut self.rows, &self.pulls, h, &Threads::ONE);
        } else {
            self.solve(world, h);
        }
        self.book_substep(world, h);
        self.fliers.arrive(&mut self.rows, &self.pulls, h);
    }
}
