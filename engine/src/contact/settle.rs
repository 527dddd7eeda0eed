//! The step ends: bodies take their places, touches remember, hits are told.

use super::Contacts;
use super::rows::TURN;
use crate::advance::stands;
use crate::area::Vec2;
use crate::bodies::{Bodies, Role, shift, turn};
use crate::exchange::PairKind;
use crate::step::Hit;
use crate::threads::{PER_THREAD, Threads};
use crate::world::{BodyId, World};

impl Contacts {
    /// Bodies take their places and motions; touches remember that share of what they pushed.
    pub(super) fn settle(&mut self, world: &mut World, share: f64) {
        if !self.solves {
            return;
        }
        if let Some(lost) = self.put_bodies(world) {
            world.report_fault(lost);
        }
        for k in self.remember(&world.threads, share).into_iter().flatten() {
            let touch = &self.touches[k];
            let (point, normal) = (touch.middle, self.blocks.normal(k, touch));
            if let Some(ledger) = &mut world.ledger {
                ledger.enter_touch(k);
            }
            self.tell(world, k, (point, normal), 0.0);
        }
        self.touches[self.found..].sort_unstable_by_key(|touch| touch.rects);
    }

    /// Bodies take their places and motions; gives the first that is no longer anywhere.
    fn put_bodies(&self, world: &mut World) -> Option<usize> {
        let Bodies { frame, lost, angle, motion, role, .. } = &mut world.bodies;
        let columns = ((&mut frame[..], &mut lost[..]), (&mut angle[..], &mut motion[..]));
        let lost = world.threads.each(columns, (1, PER_THREAD), |from, ((frame, lost), (angle, motion))| {
            let mut gone = None;
            for k in 0..frame.len() {
                let row = self.rows.of((from + k) as u32).filter(|_| role[from + k] == Role::Mobile);
                let Some(row) = row.map(|row| &self.rows.rows[row as usize]) else { continue };
                shift((&mut frame[k], &mut lost[k]), row.place());
                if row.0[TURN] != 0.0 {
                    turn((&mut frame[k], &mut angle[k]), row.0[TURN]);
                }
                motion[k] = row.motion();
                if !stands(&frame[k]) {
                    gone = gone.or(Some(from + k));
                }
            }
            gone
        });
        lost.into_iter().flatten().next()
    }

    /// Touches remember that share of what they pushed; gives those that press and did not touch before, in order.
    fn remember(&mut self, threads: &Threads, share: f64) -> Vec<Vec<usize>> {
        let mut touches = core::mem::take(&mut self.touches);
        let contacts = &*self;
        let new = threads.each(&mut touches[..], (1, PER_THREAD), |from, touches| {
            let mut new = Vec::new();
            for (touch, k) in touches.iter_mut().zip(from..) {
                // A force goes on over a longer time; an impact does not.
                let share = if share > 1.0 && !contacts.is_force(k, contacts.dt) { 1.0 } else { share };
                let (push, grip) = contacts.blocks.pushes(k);
                (touch.push, touch.grip) = (push.map(|push| push * share), grip * share);
                let pressed = touch.push[0] + touch.push[1] > 0.0;
                let was_open = touch.gap[0].min(touch.gap[1]) > contacts.band;
                if pressed && !touch.touching && was_open && contacts.lonely.binary_search(&(k as u32)).is_err() {
                    new.push(k);
                }
                touch.touching = pressed;
            }
            new
        });
        self.touches = touches;
        new
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
