//! The step ends: bodies take their places, touches remember, hits are told.

use super::Contacts;
use super::rows::{IDLE, SPIN, TURN, VX, VZ, X, Z};
use crate::advance::is_finite;
use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::exchange::PairKind;
use crate::step::Hit;
use crate::world::{BodyId, World};

impl Contacts {
    /// Bodies take their places and motions; touches remember what they pushed.
    pub(super) fn settle(&mut self, world: &mut World) {
        if self.touches.is_empty() {
            return;
        }
        for (k, &body) in self.rows.mobile.iter().enumerate() {
            let body = body as usize;
            let row = &self.rows.rows[IDLE + k].0;
            let bodies: &mut Bodies = &mut world.bodies;
            bodies.shift(body, Vec2::new(row[X], row[Z]));
            if row[TURN] != 0.0 {
                bodies.turn(body, row[TURN]);
            }
            bodies.motion[body].v = Vec2::new(row[VX], row[VZ]);
            bodies.motion[body].omega = row[SPIN];
            if !is_finite(bodies, body) {
                world.report_fault(body);
            }
        }
        for (k, touch) in self.touches.iter_mut().enumerate() {
            let (block, lane) = self.blocks.place[k];
            let block = &self.blocks.blocks[block as usize];
            for p in 0..2 {
                touch.push[p] = block.push[p].0[lane as usize];
            }
            touch.grip = block.grip.0[lane as usize];
            let pressed = touch.push[0] + touch.push[1] > 0.0;
            let was_open = touch.gap[0].min(touch.gap[1]) > self.band;
            if pressed && !touch.touching && was_open && self.lonely.binary_search(&(k as u32)).is_err() {
                let (a, b) = (touch.a.min(touch.b), touch.a.max(touch.b));
                let kind = PairKind::of(world.bodies.role[a as usize], world.bodies.role[b as usize]);
                world.work.count_exchange(kind);
                if let Some(ledger) = &mut world.ledger {
                    ledger.enter_touch(k);
                }
                self.untold.push(Hit {
                    iteration: world.iteration,
                    a: BodyId(a),
                    b: BodyId(b),
                    point: touch.middle + world.plan.origin,
                    normal: touch.n,
                    depth: 0.0,
                    kind,
                });
            }
            touch.touching = pressed;
        }
    }
}
