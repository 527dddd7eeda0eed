//! What the contact solver tells the ledger, where one is kept.

use super::Contacts;
use super::arms::Arms;
use super::rows::{X, Z};

use crate::area::Vec2;
use crate::bodies::Motion;
use crate::detect::manifold::Manifold;
use crate::exchange::impulse::Act;
use crate::lanes::Eight;
use crate::ledger::{Forces, Pressing, Stint};
use crate::plan::Plan;
use crate::world::World;

impl Contacts {
    /// Bodies and touches are laid out for a part of a step, from that time on.
    pub(super) fn open_books(&self, world: &mut World, began: f64) {
        if let Some(ledger) = &mut world.ledger {
            ledger.open_contacts(&world.bodies, self.touches.len(), began);
        }
    }

    /// A row's body has flown ahead of the others for a time, pulled or not.
    pub(super) fn book_ahead(&self, world: &mut World, row: u32, (time, pulled): (f64, bool)) {
        let (Some(ledger), Some(at)) = (&mut world.ledger, self.rows.mobile_of(row)) else { return };
        let body = self.rows.mobile[at] as usize;
        let row = &self.rows.rows[row as usize];
        let forces = if pulled { self.forces(&world.plan, body) } else { Forces::default() };
        ledger.fly_ahead(&world.bodies, body, (time, forces), (row.place(), row.motion()));
    }

    /// An impact of the bodies of two rows, which stand where they meet for the moment.
    pub(super) fn act(&self, world: &mut World, (row_a, row_b): (u32, u32), manifold: &Manifold) -> Option<Act> {
        let mobile = || [row_a, row_b].into_iter().filter_map(|row| self.rows.mobile_of(row));
        let pair = || mobile().map(|at| self.rows.mobile[at] as usize);
        if let Some(ledger) = &mut world.ledger {
            let spent = mobile().map(|at| self.fliers.spent[self.rows.first() + at]).fold(0.0, f64::max);
            ledger.meet(&world.bodies, pair(), spent);
        }
        let act = world.act(manifold);
        if let Some(ledger) = &mut world.ledger {
            ledger.part(&world.bodies, pair());
        }
        act
    }

    /// Touches are solved, and bodies are about to go where that takes them.
    pub(super) fn book_substep(&self, world: &mut World, h: f64) {
        let World { ledger: Some(ledger), bodies, plan, .. } = world else { return };
        for (k, &body) in self.rows.mobile.iter().enumerate() {
            let stint = self.stint(k, h);
            ledger.book_stint(bodies, &stint, &self.forces(plan, body as usize));
        }
        for touch in 0..self.touches.len() {
            if let Some(pressing) = self.pressing(touch) {
                ledger.book_pressing(bodies, &pressing);
            }
        }
        ledger.close_substep(h);
    }

    /// Bodies stand where they have come to.
    pub(super) fn close_books(&self, world: &mut World, dt: f64) {
        let World { ledger: Some(ledger), bodies, movers, plan, .. } = world else { return };
        let solved = self.solves;
        for body in movers.mobile.iter().filter(|body| !(solved && self.rows.of(**body).is_some())) {
            ledger.flown_alone(bodies, *body as usize, dt, &self.forces(plan, *body as usize));
        }
        for (k, body) in self.rows.mobile.iter().enumerate().filter(|_| solved) {
            ledger.settle_in(bodies, *body as usize, self.rows.of_mobile()[k].place());
        }
    }

    /// What acts on a mobile body, by cause.
    fn forces(&self, plan: &Plan, body: usize) -> Forces {
        if !self.pulls.act() {
            return Forces::default();
        }
        let pull = self.pulls.on(body);
        let gravity = plan.gravity();
        let pushed = Motion { v: pull.a - gravity, omega: pull.alpha };
        Forces { gravity, pushed, drag: pull.drag, ..Forces::default() }
    }

    fn stint(&self, k: usize, h: f64) -> Stint {
        let (at, flier) = (&self.rows.of_mobile()[k], &self.fliers.fliers[k]);
        let row = &at.0;
        let body = self.rows.mobile[k] as usize;
        let time = h - self.fliers.spent[self.rows.first() + k];
        let by_force = flier.is_forced(row, &self.pulls.on_mobile(body), h);
        let [vx, vz, spin] = flier.free;
        let [x, z, turn] = flier.goes(row, time, by_force);
        Stint {
            body,
            set_out: at.place(),
            arrived: Vec2::new(row[X] + x, row[Z] + z),
            turn,
            free: Motion { v: Vec2::new(vx, vz), omega: spin },
            motion: at.motion(),
            time,
            by_force,
        }
    }

    /// What a touch has pushed, unless it has not.
    fn pressing(&self, touch: usize) -> Option<Pressing> {
        let (block, lane) = self.blocks.lane(touch)?;
        let of = |lanes: Eight| lanes.0[lane];
        let (push, grip) = (block.push.map(of), of(block.grip));
        if push == [0.0; 2] && grip == 0.0 {
            return None;
        }
        let [a, b] = [block.row_a[lane], block.row_b[lane]].map(|row| &self.rows.rows[row as usize].0);
        let arms = Arms::in_lane(block, lane, a, b);
        let twists = |lever: [f64; 2], along: f64| (lever[0] * push[0] + lever[1] * push[1], along * grip);
        let n = Vec2::new(of(block.nx), of(block.nz));
        let pair = [self.touches[touch].a as usize, self.touches[touch].b as usize];
        Some(Pressing {
            touch,
            pair,
            along: n * (push[0] + push[1]),
            across: Vec2::new(n.y, -n.x) * grip,
            twists: [twists(arms.lever_a, arms.along_a), twists(arms.lever_b, arms.along_b)],
        })
    }
}
