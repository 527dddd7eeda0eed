//! The step ends: bodies take their places, touches remember, hits are told.

use super::Contacts;
use super::rows::TURN;
use crate::advance::is_finite;
use crate::area::Vec2;
use crate::exchange::PairKind;
use crate::step::Hit;
use crate::world::{BodyId, World};

impl Contacts {
    /// Bodies take their places and motions; touches remember that share of what they pushed.
    pub(super) fn settle(&mut self, world: &mut World, share: f64) {
        if !self.solves {
            return;
        }
        for (k, &body) in self.rows.mobile.iter().enumerate() {
            let (body, row) = (body as usize, &self.rows.of_mobile()[k]);
            let bodies = &mut world.bodies;
            bodies.shift(body, row.place());
            if row.0[TURN] != 0.0 {
                bodies.turn(body, row.0[TURN]);
            }
            bodies.motion[body] = row.motion();
            if !is_finite(bodies, body) {
                world.report_fault(body);
            }
        }
        for k in 0..self.touches.len() {
            // A force goes on over a longer time; an impact does not.
            let share = if share > 1.0 && !self.is_force(k, self.dt) { 1.0 } else { share };
            let touch = &mut self.touches[k];
            let (push, grip) = self.blocks.pushes(k);
            (touch.push, touch.grip) = (push.map(|push| push * share), grip * share);
            let pressed = touch.push[0] + touch.push[1] > 0.0;
            let was_open = touch.gap[0].min(touch.gap[1]) > self.band;
            let is_new = pressed && !touch.touching && was_open && self.lonely.binary_search(&(k as u32)).is_err();
            touch.touching = pressed;
            if is_new {
                let (point, normal) = (touch.middle, self.blocks.normal(k, touch));
                if let Some(ledger) = &mut world.ledger {
                    ledger.enter_touch(k);
                }
                self.tell(world, k, (point, normal), 0.0);
            }
        }
        self.touches[self.found..].sort_unstable_by_key(|touch| touch.rects);
    }

    /// Tells of a hit of a touch, at a point from the plan's origin.
    pub(super) fn tell(&mut self, world: &mut World, k: usize, (point, normal): (Vec2, Vec2), depth: f64) {
        let touch = &self.touches[k];
        let (a, b) = (touch.a.min(touch.b), touch.a.max(touch.b));
        let kind = PairKind::of(world.bodies.role[a as usize], world.bodies.role[b as usize]);
        world.work.count_exchange(kind);
        let (iteration, point) = (world.iteration, point + world.plan.origin);
        self.untold.push(Hit { iteration, a: BodyId(a), b: BodyId(b), point, normal, depth, kind });
    }
}
