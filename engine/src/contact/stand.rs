//! A step of a scene that stands still: solved as one, not in sub-steps.
//!
//! Sub-steps follow what moves. Where nothing does, one balance of forces over the whole step says the same, for a share of the
//! cost; what is left of velocities below what balancing resolves is none, so that what stands stays where it is to the last
//! digit. A balance is accepted only where it leaves everything standing; else nothing has happened, and the step is taken in
//! sub-steps.
//!
//! Where nothing has moved through a step the next has the same touches: they are not looked for again.
//!
//! With `sleeping(true)` a scene that has stood through a step sleeps until something is done to it: its steps cost nothing.

use super::Contacts;
use super::rest::{self, Effort};
use crate::bodies::Motion;
use crate::world::World;

/// Rounds that forces may take to balance.
const ROUNDS: u32 = 8;

/// A scene is worth the try if no body is faster than so many times what balancing resolves.
const NEARLY: f64 = 4.0;

impl World {
    /// A whole step as one, if all stands still and goes on doing so; whether it does.
    pub(super) fn stand(&mut self, contacts: &mut Contacts) -> bool {
        let stood = contacts.stood && self.pushes.is_empty();
        if stood && contacts.plan.sleeping {
            return true;
        }
        contacts.stood = false;
        let dt = self.plan.time_step;
        let pulled = self.plan.gravity().norm() * dt;
        let limit = NEARLY * rest::settled(contacts.touches.len(), pulled);
        if pulled == 0.0 || !contacts.presses() {
            return false;
        }
        if !stood {
            if !self.stands_still(limit) {
                return false;
            }
            contacts.find(self, dt);
            contacts.lay_out(self, dt, contacts.plan.substeps);
            if contacts.touches.is_empty() {
                return false;
            }
            contacts.begin_standing(self, dt);
        }
        if !contacts.balance(self, dt, pulled) {
            return false;
        }
        let time = self.advances as f64 * dt;
        contacts.open_books(self, time);
        contacts.book_substep(self, dt);
        let parted = !stood && contacts.part_overlaps(self);
        contacts.settle(self, 1.0 / f64::from(contacts.plan.substeps));
        self.fly_alone(contacts, dt);
        contacts.close_books(self, dt);
        // What touches was made to stand.
        let all_touch = contacts.rows.mobile.len() == self.movers.mobile.len();
        contacts.stood = !parted && (all_touch || self.stands_still(0.0));
        true
    }

    /// Whether no body is faster than that, at its radius of gyration either, and nothing is driven.
    fn stands_still(&self, limit: f64) -> bool {
        let bodies = &self.bodies;
        let rests = |body: &u32| bodies.motion[*body as usize] == Motion::default();
        let slow = |body: &u32| {
            let (Motion { v, omega }, inertia) = (bodies.motion[*body as usize], bodies.inertia[*body as usize]);
            v.norm_squared() + omega * omega * inertia.moment / inertia.mass <= limit * limit
        };
        self.movers.prescribed.is_empty() && self.movers.fixed.iter().all(rests) && self.movers.mobile.iter().all(slow)
    }
}

impl Contacts {
    /// Something has been done to a body: nothing sleeps any more. What may part the seam of fixed bodies is not to be told by where
    /// they stand.
    pub(crate) fn wake(&mut self, is_mobile: bool) {
        self.stood = false;
        if !is_mobile {
            self.still.forget();
        }
    }

    /// Touches push as they did in the sub-steps of the step before, over the whole step.
    fn begin_standing(&mut self, world: &World, dt: f64) {
        let times = f64::from(self.plan.substeps);
        self.begin_flights(world, dt, times);
        self.blocks.scale_pushes(times);
        // What little still moves is to stop, not to come back.
        self.look(0, dt, 0.0);
    }

    /// Balances all forces over a step; whether they do and leave everything standing.
    fn balance(&mut self, world: &mut World, dt: f64, pulled: f64) -> bool {
        self.fliers.set_out(&mut self.rows, &self.pulls, dt, &world.threads);
        self.fliers.renew(&mut self.rows, &world.threads);
        let enough = rest::settled(self.touches.len(), pulled);
        let balanced = self.settle_for(world, Effort { enough, most: ROUNDS }).enough;
        let stand = balanced && self.rows.are_slower_than(enough, &world.threads);
        if stand {
            self.fliers.stand(&mut self.rows, dt, &world.threads);
        }
        stand
    }
}
