//! Pairs that are near and stay apart, unless something is done to one of their bodies.
//!
//! They are no touches and cost nothing in the sub-steps. When an impact or a push gives one of their bodies another motion than it
//! had when the step began, its pairs are looked at again: those that may touch now join the touches, and a body that had no
//! part in any gets a row, at the place to which it has flown by then.

use super::Contacts;
use super::apart::Which;
use super::flying::Fliers;
use super::rows::TURN;
use super::swept::ROOM;
use super::touch::Touch;
use crate::area::Vec2;
use crate::detect::overlap::widest_gap;
use crate::flight::Path;
use crate::world::World;

/// What contacts change of a body's motion beyond holding it against gravity, as a share of what that does in a sub-step,
/// before it matters to those it is near.
const DEVIATES: f64 = 1e-6;

impl Contacts {
    /// Wakes pairs of bodies that contacts have given another motion than they set out with; whether there were any.
    pub(super) fn wake_pushed(&mut self, world: &mut World, h: f64) -> bool {
        let touches = self.touches.len();
        let gravity = world.plan.gravity();
        let strength = gravity.norm();
        let held = (strength > 0.0).then(|| (-gravity / strength, strength * h));
        for at in 0..self.apart.pushed.len() {
            let k = self.apart.pushed[at] as usize - self.rows.first();
            if self.deviates(world, k, held) {
                self.wake_around(world, self.rows.mobile[k] as usize, Some(h));
            }
        }
        self.touches.len() > touches
    }

    /// Whether contacts have changed a mobile row's motion in the sub-step by more than holding it against gravity: upwards, and by
    /// no more than gravity does.
    fn deviates(&self, world: &World, k: usize, held: Option<(Vec2, f64)>) -> bool {
        let [x, z, turned] = self.fliers.fliers[k].changed(&self.rows.of_mobile()[k].0);
        let mut change = Vec2::new(x, z);
        let pulled = held.map_or(0.0, |(_, most)| most);
        if let Some((up, _)) = held {
            change -= up * change.dot(&up).clamp(0.0, pulled);
        }
        let reach = || world.bodies.reach(self.rows.mobile[k] as usize);
        let limit = DEVIATES * pulled;
        change.norm() > limit || turned.abs() * reach() > limit
    }

    /// Looks again at the pairs of a body that has been given another motion.
    pub(super) fn wake_around(&mut self, world: &mut World, body: usize, under_way: Option<f64>) {
        let mut around = self.apart.around(body);
        while let Some(pair) = self.apart.next(&mut around) {
            if !self.apart.is_woken(pair) {
                self.look_once_more(world, pair, under_way);
            }
        }
    }

    /// Makes a touch of a pair that may touch by now.
    fn look_once_more(&mut self, world: &mut World, pair: Which, under_way: Option<f64>) {
        let rects: [u32; 2] = self.apart.rects(pair).into();
        let bodies = rects.map(|rect| self.search.body_of(rect));
        if !self.may_meet(world, pair, bodies) {
            return;
        }
        let paths = bodies.map(|body| self.path_of(world, body));
        let placed = [0, 1].map(|side| {
            let mut placed = self.search.placed(&world.bodies, rects[side]);
            placed.frame = &paths[side].frame;
            placed
        });
        let left = self.dt - self.gone;
        let (u, mut margin) = (paths[1].motion.v - paths[0].motion.v, 0.0);
        for (path, placed) in paths.iter().zip(&placed) {
            margin += path.motion.omega.abs() * placed.rect.far() + 0.5 * path.pull.a.norm() * left;
        }
        margin = (margin + u.norm()) * left + ROOM * (placed[0].rect.half().min() + placed[1].rect.half().min());
        let stood = |body: usize| world.bodies.frame[body];
        let Some(touch) = Touch::find(&world.bodies, (placed[0], placed[1]), margin, None, stood) else { return };
        self.apart.wake(pair);
        for body in bodies {
            self.join(world, body, under_way);
        }
        self.add_touch(world, touch);
    }

    /// Lays out a touch that has come to be, of bodies that have rows, as they stand by now.
    pub(super) fn add_touch(&mut self, world: &mut World, mut touch: Touch) -> usize {
        let rows = self.rows.count_touch(&touch);
        touch.count_from(&self.rows.rows[rows.0 as usize].0, &self.rows.rows[rows.1 as usize].0);
        self.apart.push_too(&self.rows, rows);
        self.blocks.add((self.touches.len(), &touch), &self.rows, rows, (self.keep, self.band));
        if touch.surface.restitution > 0.0 {
            self.crowd.push(self.touches.len() as u32);
        }
        touch.put_behind(&mut self.touches);
        self.of_touch.push(rows);
        if let Some(ledger) = &mut world.ledger {
            ledger.expect_touches(self.touches.len());
        }
        self.touches.len() - 1
    }

    /// Whether two rectangles may come to touch in what is left of the part, by the axis that held them apart when it began.
    fn may_meet(&mut self, world: &World, pair: Which, bodies: [usize; 2]) -> bool {
        let (one, two) = self.apart.rects(pair);
        let [a, b] = [one, two].map(|rect| self.search.placed(&world.bodies, rect));
        let (axis, gap) = *self.apart.axis(pair).get_or_insert_with(|| widest_gap(a.frame, a.rect, b.frame, b.rect));
        let left = self.dt - self.gone;
        let (mut now, mut end, mut room) = ([0.0; 2], [0.0; 2], 0.0);
        for side in 0..2 {
            let pull = self.pulls.on(bodies[side]);
            let (place, motion, turn) = match self.rows.of(bodies[side] as u32) {
                Some(row) => {
                    let row = &self.rows.rows[row as usize];
                    (row.place(), row.motion(), row.0[TURN].abs())
                }
                None => {
                    let motion = world.bodies.motion[bodies[side]];
                    (motion.v * self.gone, motion, motion.omega.abs() * self.gone)
                }
            };
            now[side] = axis.dot(&place);
            end[side] = now[side] + axis.dot(&motion.v) * left;
            let turned = turn + motion.omega.abs() * left;
            let held = pull.a.norm() + pull.drag.0 * motion.v.norm();
            room += turned * [a, b][side].rect.far() + 0.5 * held * self.dt * self.dt;
        }
        gap + (now[1] - now[0]).min(end[1] - end[0]) <= room
    }

    /// Where a body is by now in the part of the step and how it moves.
    pub(super) fn path_of(&self, world: &World, body: usize) -> Path {
        let began = self.path_from_start(world, body);
        match self.rows.of(body as u32) {
            Some(row) => Fliers::path(&self.rows.rows[row as usize], &began.frame, began.pull),
            None => began.after(self.gone),
        }
    }

    /// How a body flies from the start of the part if nothing touches it.
    fn path_from_start(&self, world: &World, body: usize) -> Path {
        Path { frame: world.bodies.frame[body], motion: world.bodies.motion[body], pull: self.pulls.on(body) }
    }

    /// Gives a body that has none a row, where it has come to by now.
    pub(super) fn join(&mut self, world: &mut World, body: usize, under_way: Option<f64>) {
        if self.rows.of(body as u32).is_some() {
            return;
        }
        let change = self.path_from_start(world, body).change(self.gone);
        let row = self.rows.add(&world.bodies, body);
        row.come(&change);
        let row = self.rows.rows.len() as u32 - 1;
        if self.gone > 0.0 {
            self.book_ahead(world, row, (self.gone, true));
        }
        self.fliers.join(&mut self.rows, under_way.map(|h| (&self.pulls, h)));
    }
}
