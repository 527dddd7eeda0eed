//! Who may touch within the step, and where.

use super::Contacts;
use super::touch::Touch;
use crate::advance::frame_before;
use crate::area::Vec2;
use crate::broad_phase::Within;
use crate::broad_phase::bounds::sweep;
use crate::detect::manifold::Placed;
use crate::flight::{Path, Pull};
use crate::plan::FlightPlan;
use crate::world::World;

/// Room left around rectangles, as a share of the smaller half size: what a body may be pushed within a step beyond where it
/// was going.
const ROOM: f64 = 0.02;

impl Contacts {
    /// What acts on each body over the step: gravity, drag, pushes. Empty when nothing acts on any.
    pub(super) fn pull(&mut self, world: &World) {
        self.pulls.clear();
        if world.plan.flight == FlightPlan::Free && world.pushes.is_empty() {
            return;
        }
        let (a, drag) = match world.plan.flight {
            FlightPlan::Free => (Vec2::zeros(), (0.0, 0.0)),
            FlightPlan::Forced { gravity, drag, .. } => (gravity, drag),
        };
        let fixed = Pull::NONE;
        let mobile = Pull { a, alpha: 0.0, drag };
        let of = |body: usize| if world.bodies.is_mobile(body) { mobile } else { fixed };
        self.pulls.extend((0..world.bodies.len()).map(of));
        for push in &world.pushes {
            let (body, inertia) = (push.body as usize, world.bodies.inertia[push.body as usize]);
            self.pulls[body].a += push.force / inertia.mass;
            self.pulls[body].alpha += push.torque / inertia.moment;
        }
    }

    /// Finds all touches of the step, and what they remember of the last.
    pub(super) fn find(&mut self, world: &mut World, dt: f64) {
        let World { plan, bodies, broad_phase, work, .. } = world;
        self.near.clear();
        let near = &mut self.near;
        self.swept.clear();
        for body in 0..bodies.len() {
            let path = Path::of(bodies, &self.pulls, body);
            self.swept.extend(bodies.rects_of(body).iter().map(|rect| {
                let (low, high) = sweep(&path, rect, dt);
                let room = Vec2::repeat(ROOM * rect.half().min());
                (low - room, high + room)
            }));
        }
        let within = Within { bounds: &self.swept };
        broad_phase.visit_within(bodies, &within, work, |i, j, _| near.push((i as u32, j as u32)));
        near.sort_unstable();
        near.dedup();
        core::mem::swap(&mut self.touches, &mut self.before);
        self.touches.clear();
        let earlier = |body: usize| frame_before(bodies, plan.flight, plan.time_step, body);
        let mut last = self.before.iter().peekable();
        for &(i, j) in &self.near {
            let (i, j) = (i as usize, j as usize);
            work.pairs_tested += 1;
            let (one, two) = (Path::of(bodies, &self.pulls, i), Path::of(bodies, &self.pulls, j));
            for rect_i in Placed::all(bodies, i) {
                for rect_j in Placed::all(bodies, j) {
                    if !may_meet(&self.swept[rect_i.index], &self.swept[rect_j.index]) {
                        continue;
                    }
                    work.axes_tested += 4;
                    let key = (rect_i.index as u32, rect_j.index as u32);
                    while last.next_if(|touch| touch.rects < key).is_some() {}
                    let before = last.peek().filter(|touch| touch.rects == key);
                    let margin = one.closing(&two, rect_i.rect.far(), rect_j.rect.far(), dt)
                        + ROOM * (rect_i.rect.half().min() + rect_j.rect.half().min());
                    let found = Touch::find(bodies, (rect_i, rect_j), margin, before.copied(), earlier);
                    self.touches.extend(found);
                }
            }
        }
        work.pairs_listed += self.touches.len() as u64;
    }
}

/// Whether what two rectangles sweep has anything in common: the same whatever finds the pairs.
fn may_meet((low, high): &(Vec2, Vec2), (other_low, other_high): &(Vec2, Vec2)) -> bool {
    low.x <= other_high.x && other_low.x <= high.x && low.y <= other_high.y && other_low.y <= high.y
}
