//! What continuous motion tells the ledger, where one is kept: flights, by what acted on the way.

use core::slice;

use super::{Continuous, Phase};
use crate::advance::Movers;
use crate::area::Vec2;
use crate::bodies::{Inertia, Motion};
use crate::exchange::together::{Impulse, Point};
use crate::frame::perp;
use crate::ledger::{Forces, Ledger};
use crate::plan::Plan;
use crate::world::World;

/// The bodies that fly: all mobile ones, or one.
#[derive(Clone, Copy, Debug)]
pub(super) enum Fliers {
    All,
    One(u32),
}

impl Fliers {
    fn of<'a>(&'a self, movers: &'a Movers) -> &'a [u32] {
        match self {
            Fliers::All => &movers.mobile,
            Fliers::One(body) => slice::from_ref(body),
        }
    }
}

/// The forces of lasting contacts on a body, as accelerations, and what fixed bodies work by them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Holding {
    pressed: Motion,
    rubbed: Motion,
    /// \[W\].
    worked: (f64, f64),
}

impl Continuous {
    /// Remembers which forces hold the movers of a cluster from now on.
    pub(super) fn keep_forces(
        &mut self,
        world: &World,
        movers: &[usize],
        forces: impl Iterator<Item = (Point, Impulse)>,
    ) {
        if world.ledger.is_none() {
            return;
        }
        let bodies = &world.bodies;
        self.holding.resize(bodies.len(), Holding::default());
        movers.iter().for_each(|body| self.holding[*body] = Holding::default());
        for (Point { i, j, n, arms, .. }, force) in forces {
            let (normal, tangential) = (n * force.n, -perp(n) * force.t);
            for (body, r, other, r_other, sign) in [(j, arms.r_j, i, arms.r_i, 1.0), (i, arms.r_i, j, arms.r_j, -1.0)] {
                if !bodies.is_mobile(body) {
                    continue;
                }
                let Inertia { mass, moment } = bodies.inertia[body];
                let add = |to: &mut Motion, force: Vec2| {
                    to.v += force * (sign / mass);
                    to.omega += (r.x * force.y - r.y * force.x) * (sign / moment);
                };
                let held = &mut self.holding[body];
                add(&mut held.pressed, normal);
                add(&mut held.rubbed, tangential);
                if !bodies.is_mobile(other) {
                    let Motion { v, omega } = bodies.motion[other];
                    let w = (v + perp(r_other) * omega) * sign;
                    held.worked.0 += normal.dot(&w);
                    held.worked.1 += tangential.dot(&w);
                }
            }
        }
    }

    /// Whether bodies are on their way, each moved up to another moment.
    pub(crate) fn is_flying(&self) -> bool {
        self.phase == Phase::Flying
    }

    /// What is booked from now on happens now.
    pub(super) fn keep_time(&self, world: &mut World) {
        let time = world.advances as f64 * world.plan.time_step + self.elapsed();
        if let Some(ledger) = &mut world.ledger {
            ledger.at(time);
        }
    }

    /// Bodies are about to be moved.
    pub(super) fn set_out(&self, world: &mut World, fliers: Fliers) {
        let World { ledger, bodies, movers, .. } = world;
        if let Some(ledger) = ledger.as_mut().filter(|_| !self.pulls.is_empty()) {
            ledger.set_out(bodies, fliers.of(movers));
        }
    }

    /// They were moved to where they are at that moment of the segment.
    pub(super) fn arrive(&self, world: &mut World, fliers: Fliers, until: f64) {
        let World { ledger, bodies, movers, plan, .. } = world;
        if let Some(ledger) = ledger.as_mut().filter(|_| !self.pulls.is_empty()) {
            let flown = |body: usize| (until - self.since[body], self.forces(plan, body));
            ledger.arrive(bodies, fliers.of(movers), flown);
        }
    }

    /// The ledger with all flights up to now, while bodies are flying.
    pub(crate) fn ledger_now(&self, world: &World, mut ledger: Ledger) -> Ledger {
        if self.pulls.is_empty() {
            return ledger;
        }
        for body in world.movers.mobile.iter().map(|body| *body as usize) {
            let flown = (self.now - self.since[body], self.forces(&world.plan, body));
            ledger.fly_on(&world.bodies, body, flown, &self.path(&world.bodies, body));
        }
        ledger
    }

    /// What acts on a mobile body, by cause.
    fn forces(&self, plan: &Plan, body: usize) -> Forces {
        let free = self.free[body];
        let Holding { pressed, rubbed, worked } = self.holding.get(body).copied().unwrap_or_default();
        let gravity = plan.gravity();
        Forces {
            gravity,
            pushed: Motion { v: free.a - gravity, omega: free.alpha },
            pressed,
            rubbed,
            worked,
            drag: free.drag,
        }
    }
}
