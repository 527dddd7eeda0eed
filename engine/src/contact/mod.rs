//! Stepped motion with impulses: contacts that last are solved all together, in sub-steps.
//!
//! | stage | function |
//! |---|---|
//! | who may touch within the step, and where | [`Contacts::find`] |
//! | bodies and touches laid out for the solver | [`Contacts::lay_out`], [`rows`], [`blocks`] |
//! | sub-step: impacts of bodies that touch no other | [`strike`] |
//! | sub-step: what acts on bodies over it | [`Fliers::set_out`](flying::Fliers::set_out) |
//! | sub-step: pushes and friction at every touch | [`sweep`] |
//! | sub-step: bodies go on | [`Fliers::arrive`](flying::Fliers::arrive) |
//! | the step ends: bodies take their places, touches remember | [`Contacts::settle`] |
//!
//! Bodies that nothing is near fly on exactly, in one go. A scene without contacts has no sub-steps.

mod abreast;
mod blocks;
mod booked;
mod find;
mod flying;
mod loads;
mod look;
mod meeting;
#[cfg(test)]
mod plain;
mod points;
mod rest;
mod rows;
mod search;
mod settle;
mod stand;
mod strike;
mod sweep;
mod swept;
mod touch;
mod weights;

use crate::advance::advance_alone;
use crate::bodies::{Bodies, Motion};
use crate::flight::Pull;
use crate::frame::Angle;
use crate::plan::ContactPlan;
use crate::step::Hit;
use crate::width::Width;
use crate::world::World;
use blocks::Blocks;
use flying::Fliers;
use look::{Look, Warm};
use rest::{Effort, Rest, Settled};
use rows::Rows;
use search::Search;
use sweep::{Part, Sweep};
use touch::Touch;

pub use loads::Load;

/// Overlaps found at the start of a step are let go at this rate \[1/s\]: a fifth of them in a sixtieth of a second.
const RECOVERY: f64 = 12.0;

/// Sweeps in a sub-step, to and fro by turns: so many that about as many touches are solved, within limits.
const SWEPT: usize = 16_000;
const LEAST_SWEEPS: usize = 2;
const MOST_SWEEPS: usize = 16;

/// Sweeps where the pushes of the sub-step before were no help and all begins at nothing.
const FRESH_SWEEPS: usize = 8;

/// A scene in which no body is faster than this many times what gravity does in a sub-step is quiet: its contacts push on from
/// where its bodies were, for they hardly move.
const QUIET: f64 = 16.0;

/// A scene in which no body is faster than this many times that stands still, or is about to: worth being settled to the end.
const STILL: f64 = 2.0;

/// Rounds to settle what stands still, in a sub-step at most; after the first few the weights are guessed.
const PATIENCE: u32 = 500;
const FIRST: u32 = 24;

/// Weights are guessed where more than this share of what gravity does is not borne yet.
const UNBALANCED: f64 = 1e-2;

/// Touches to improve in a sub-step where little is to be improved.
const BUDGET: u32 = 8_000;

/// With so many touches or fewer they are found anew in every sub-step, for the sake of exactness.
const A_FEW: usize = 128;

/// Points closer than this share of the smaller rectangle touch.
const TOUCHING: f64 = 1e-9;

/// The state of the contact solver; only a world in stepped motion with impulses has one.
#[derive(Clone, Debug)]
pub(crate) struct Contacts {
    plan: ContactPlan,
    width: Width,
    /// Gaps and depths up to this are none \[m\].
    band: f64,
    /// The touches of this step and of the last, in the order of their rectangles.
    touches: Vec<Touch>,
    before: Vec<Touch>,
    /// Pairs of rectangles that may meet within the step.
    search: Search,
    /// What acts on each body over the step.
    pulls: Vec<Pull>,
    rows: Rows,
    of_touch: Vec<(u32, u32)>,
    blocks: Blocks,
    fliers: Fliers,
    rest: Rest,
    /// Rounds to be spent upon what stands still: fewer where they were in vain.
    patience: u32,
    /// Touches of bodies that touch no other.
    lonely: Vec<u32>,
    /// Touches with restitution among the others.
    crowd: Vec<u32>,
    /// Touches of which it is known that they do not meet within the sub-step.
    clear: Vec<u32>,
    /// Whether all stands and nothing has been done since: a step changes nothing.
    asleep: bool,
    /// How far a fixed body reaches from its centre at most \[m\].
    reach: f64,
    /// What is left of an overlap after a step in which it may recover.
    keep: f64,
    /// The hits of this step, the next to be told last.
    untold: Vec<Hit>,
}

impl Contacts {
    pub(crate) fn new(plan: ContactPlan, bodies: &Bodies) -> Self {
        let mobile = (0..bodies.len()).filter(|body| bodies.is_mobile(*body));
        let smallest = mobile.map(|body| bodies.smallest_half(body)).fold(f64::INFINITY, f64::min);
        Contacts {
            plan,
            width: Width::best(),
            band: if smallest.is_finite() { TOUCHING * smallest } else { 0.0 },
            touches: Vec::new(),
            before: Vec::new(),
            search: Search::default(),
            pulls: Vec::new(),
            rows: Rows::default(),
            of_touch: Vec::new(),
            blocks: Blocks::default(),
            fliers: Fliers::default(),
            rest: Rest::default(),
            patience: PATIENCE,
            lonely: Vec::new(),
            crowd: Vec::new(),
            clear: Vec::new(),
            asleep: false,
            reach: (0..bodies.len())
                .filter(|body| !bodies.is_mobile(*body))
                .map(|body| bodies.reach(body))
                .fold(0.0, f64::max),
            keep: 0.0,
            untold: Vec::new(),
        }
    }

    /// What decides how the world goes on, for its digest.
    pub(crate) fn words(&self) -> impl Iterator<Item = u64> {
        self.touches.iter().flat_map(Touch::words).chain([u64::from(self.patience) << 1 | u64::from(self.asleep)])
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
        contacts.touches.iter_mut().for_each(|touch| touch.met = false);
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
        self.set_out_on_courses(time, dt);
        contacts.find(self, dt);
        contacts.lay_out(self, dt);
        contacts.open_books(self, time - dt);
        if !contacts.touches.is_empty() {
            let h = dt / f64::from(substeps);
            let drag = (!contacts.pulls.is_empty()).then(|| self.plan.flight.forces().1);
            contacts.fliers.pace(drag, h);
            contacts.fliers.begin(&contacts.rows, (&contacts.touches, &contacts.of_touch), 1.0);
            for _ in 0..substeps {
                contacts.substep(self, h);
            }
            contacts.part_overlaps();
        }
        contacts.settle(self, 1.0);
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
        let World { plan, bodies, movers, work, .. } = self;
        let touched = |body: u32| !contacts.touches.is_empty() && contacts.rows.has(body);
        let lost = advance_alone(bodies, movers, plan.flight, dt, &contacts.pulls, touched, work);
        if let Some(body) = lost {
            self.report_fault(body);
        }
    }
}

impl Contacts {
    /// In how many parts the step is solved.
    fn parts(&self) -> u32 {
        let few = (1..=A_FEW).contains(&self.touches.len());
        if few { self.plan.substeps } else { 1 }
    }

    /// Lays bodies and touches out for the solver.
    fn lay_out(&mut self, world: &World, dt: f64) {
        if self.touches.is_empty() {
            return;
        }
        self.rows.fill(&world.bodies, &world.movers.mobile, &self.touches, &mut self.of_touch);
        self.keep = libm::exp(-RECOVERY * dt);
        self.blocks.fill(&self.touches, &self.of_touch, &self.rows, self.keep, self.band);
        self.lonely.clear();
        self.crowd.clear();
        for (k, (a, b)) in self.of_touch.iter().enumerate() {
            let alone = |row: u32| self.rows.mobile_of(row).is_none_or(|at| self.rows.degree[at] == 1);
            if alone(*a) && alone(*b) {
                self.lonely.push(k as u32);
            } else if self.touches[k].surface.restitution > 0.0 {
                self.crowd.push(k as u32);
            }
        }
    }

    fn substep(&mut self, world: &mut World, h: f64) {
        self.strike(world, h);
        let pulled = world.plan.gravity().norm() * h;
        self.look(h, flying::FORCEFUL * pulled);
        self.leave_clear();
        self.fliers.set_out(&mut self.rows, &self.pulls, h);
        let fastest = self.fliers.fastest();
        let quiet = fastest <= QUIET * pulled;
        if quiet {
            self.fliers.renew(&mut self.rows);
        } else {
            self.width.run(Warm { rows: &mut self.rows.rows, blocks: &self.blocks.blocks });
        }
        let still = fastest <= STILL * pulled && pulled > 0.0;
        if still {
            self.settle_touches(world, h, pulled, fastest);
        } else {
            self.sweep_touches(world, (SWEPT / self.touches.len()).clamp(LEAST_SWEEPS, MOST_SWEEPS));
            let most = self.few();
            self.settle_for(world, Effort { pulled, most });
        }
        // A jam has no solution: pushes grow without end, and do harm once it gives way.
        if self.fliers.gained(&self.rows, self.reach) {
            self.blocks.forget_pushes();
            self.fliers.let_go(&mut self.rows);
            self.sweep_touches(world, FRESH_SWEEPS);
        }
        self.book_substep(world, h);
        self.fliers.arrive(&mut self.rows, &self.pulls, h);
    }

    /// Improves all touches of a scene that stands still together, for as long as it is worth it.
    fn settle_touches(&mut self, world: &mut World, h: f64, pulled: f64, fastest: f64) {
        let most = if fastest == 0.0 { PATIENCE } else { self.patience.max(self.few()) };
        let Settled { left, enough, .. } = self.settle_for(world, Effort { pulled, most: FIRST.min(most) });
        if !enough {
            if left > UNBALANCED * pulled {
                let pull = world.plan.gravity() * h;
                weights::guess(&mut self.touches, &self.of_touch, &self.rows, &world.bodies, pull, self.band);
                self.fliers.carry(&self.rows, (&self.touches, &self.of_touch), 1.0);
                self.fliers.renew(&mut self.rows);
                self.blocks.renew(&self.touches);
            }
            let more = self.settle_for(world, Effort { pulled, most });
            self.patience =
                if more.enough { (2 * self.patience).min(PATIENCE) } else { (self.patience / 2).max(FIRST) };
        }
    }

    /// How many rounds are always worth it.
    fn few(&self) -> u32 {
        (BUDGET / self.touches.len() as u32).min(PATIENCE)
    }

    fn settle_for(&mut self, world: &mut World, effort: Effort) -> Settled {
        let (rows, blocks) = (&mut self.rows, &mut self.blocks.blocks);
        let settled = self.rest.settle(rows, blocks, self.width, effort);
        world.work.touches_solved += u64::from(settled.rounds) * self.touches.len() as u64;
        settled
    }

    fn sweep_touches(&mut self, world: &mut World, sweeps: usize) {
        for sweep in 0..sweeps {
            self.sweep(sweep % 2 == 1);
        }
        world.work.touches_solved += (sweeps * self.touches.len()) as u64;
    }

    /// Bodies still deeper in each other than they may be by now are moved apart, once round.
    fn part_overlaps(&mut self) {
        let (rows, blocks) = (&mut self.rows.rows[..], &self.blocks.blocks[..]);
        self.width.run(Part { rows, blocks, band: self.band });
    }

    /// What every point asks for in the sub-step.
    fn look(&mut self, h: f64, pulled: f64) {
        let (rows, blocks) = (&self.rows.rows[..], &mut self.blocks.blocks[..]);
        self.width.run(Look { rows, blocks, h, band: self.band, pulled });
    }

    fn sweep(&mut self, back: bool) {
        let (rows, blocks, band) = (&mut self.rows.rows[..], &mut self.blocks.blocks[..], self.band);
        if self.plan.friction {
            self.width.run(Sweep::<true> { rows, blocks, band, back });
        } else {
            self.width.run(Sweep::<false> { rows, blocks, band, back });
        }
    }
}
