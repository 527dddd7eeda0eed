//! Impacts of bodies that touch no other: at their very moment within the sub-step, by the law of one impact.

use super::Contacts;
use super::flying::Fliers;
use super::rows::{SPIN, VX, VZ};
use super::touch::Touch;
use crate::area::Rect;
use crate::bodies::Bodies;
use crate::detect::manifold::{Manifold, Placed};
use crate::detect::near::{Before, meet};
use crate::detect::touch::at_face;
use crate::detect::{overlap, seams};
use crate::exchange::PairKind;
use crate::flight::{Path, Pull};
use crate::frame::{Frame, perp};
use crate::impact_time::{Flier, Touch as Found, first_open_touch};
use crate::step::Hit;
use crate::world::{BodyId, World};

/// Impacts of a pair in a sub-step at most; what bounces more often is held.
const MOST_STRIKES: u32 = 8;

/// A bounce that would last for less than this many sub-steps is none: the contact lasts.
const SHORTEST: f64 = 1.0;

/// Rectangles deeper in each other than this share of the smaller one do not come to touch any more; they are parted.
const OVERLAPPED: f64 = 1e-9;

impl Contacts {
    /// Lets bodies that touch no other fly to their impacts within the sub-step, and exchange there.
    pub(super) fn strike(&mut self, world: &mut World, h: f64) {
        for at in 0..self.lonely.len() {
            let k = self.lonely[at] as usize;
            let mut left = h;
            let mut struck = false;
            for _ in 0..MOST_STRIKES {
                if left <= 0.0 || !self.may_strike(k, left, h) {
                    break;
                }
                match self.strike_once(world, k, (left, h)) {
                    Some(time) => left -= time,
                    None => break,
                }
                struck = true;
            }
            if struck {
                self.look_again(world, k);
            }
        }
    }

    /// After an impact the pair stands otherwise than when the step began: where it touches is found again.
    fn look_again(&mut self, world: &World, k: usize) {
        let touch = self.touches[k];
        let (row_a, row_b) = self.of_touch[k];
        let stands = [touch.a, touch.b].map(|body| world.bodies.frame[body as usize]);
        let frames = [
            Fliers::path(&self.rows, row_a, &stands[0], Pull::NONE).frame,
            Fliers::path(&self.rows, row_b, &stands[1], Pull::NONE).frame,
        ];
        let two = Two::of(&world.bodies, &touch);
        let [one, other] = two.placed([&frames[0], &frames[1]]);
        let pair = if touch.of_first { (one, other) } else { (other, one) };
        let margin = 2.0 * (one.rect.half().min() + other.rect.half().min());
        let Some(mut now) = Touch::find(&world.bodies, pair, margin, Some(&touch), |body| world.bodies.frame[body])
        else {
            return;
        };
        if now.a != touch.a {
            return;
        }
        let (a, b) = (&self.rows.rows[row_a as usize].0, &self.rows.rows[row_b as usize].0);
        now.count_from(a, b);
        self.blocks.set(k, &now, (row_a, row_b), self.keep, self.band);
        self.touches[k] = now;
    }

    /// How strongly what acts on two bodies draws them together \[m/s²\].
    fn pulled_together(&self, touch: &Touch) -> f64 {
        let pull = |body: u32| if self.pulls.is_empty() { Pull::NONE } else { self.pulls[body as usize] };
        (pull(touch.a).a - pull(touch.b).a).dot(&touch.n).max(0.0)
    }

    /// Whether the pair may come to touch within a time at a speed worth an impact.
    fn may_strike(&self, k: usize, time: f64, h: f64) -> bool {
        let touch = &self.touches[k];
        let (row_a, row_b) = self.of_touch[k];
        let (a, b) = (&self.rows.rows[row_a as usize].0, &self.rows.rows[row_b as usize].0);
        let pulled = self.pulled_together(touch);
        (0..touch.count as usize).any(|p| {
            let (gap, u) = touch.state(p, a, b);
            // Turning bodies may come sooner than the straight line says: looked for with some room.
            let room =
                (a[SPIN] * a[SPIN] * touch.along_a.abs() + b[SPIN] * b[SPIN] * touch.along_b.abs()) * time * time;
            let closest = gap + (u - 0.5 * pulled * time).min(0.0) * time - room;
            let speed = (u * u + 2.0 * pulled * gap.max(0.0)).sqrt();
            closest <= 0.0 && (u < 0.0 || gap > 0.0) && 2.0 * speed > SHORTEST * h * pulled
        })
    }

    /// Whether what an impact gives back would be taken again within a sub-step: then it is not given.
    fn bounces_shortly(&self, touch: &Touch, moved: &[Path; 2], manifold: &Manifold, h: f64) -> bool {
        let pulled = self.pulled_together(touch);
        let n = moved[usize::from(manifold.reference != touch.a as usize)].frame.outward(manifold.face.normal());
        let place = moved[usize::from(manifold.owner != touch.a as usize)].frame.place(manifold.mean().vertex);
        let at = |path: &Path| path.motion.v + perp(place - path.frame.o) * path.motion.omega;
        let u = (at(&moved[1]) - at(&moved[0])).dot(&n).abs();
        touch.surface.restitution > 0.0 && 2.0 * touch.surface.restitution * u < SHORTEST * h * pulled
    }

    /// One impact within a time; gives when.
    fn strike_once(&mut self, world: &mut World, k: usize, (left, h): (f64, f64)) -> Option<f64> {
        let touch = self.touches[k];
        let (row_a, row_b) = self.of_touch[k];
        let pull = |body: u32| if self.pulls.is_empty() { Pull::NONE } else { self.pulls[body as usize] };
        let stands = [touch.a, touch.b].map(|body| world.bodies.frame[body as usize]);
        let paths = [
            Fliers::path(&self.rows, row_a, &stands[0], pull(touch.a)),
            Fliers::path(&self.rows, row_b, &stands[1], pull(touch.b)),
        ];
        let (time, manifold) = meeting(world, &touch, &paths, left)?;
        self.fliers.go_on(&mut self.rows, row_a, &paths[0], time);
        self.fliers.go_on(&mut self.rows, row_b, &paths[1], time);
        let moved = paths.map(|path| path.after(time));
        for (body, path) in [touch.a, touch.b].into_iter().zip(&moved) {
            world.bodies.frame[body as usize] = path.frame;
            world.bodies.motion[body as usize] = path.motion;
        }
        let surfaces = [touch.a, touch.b].map(|body| world.bodies.surface[body as usize]);
        if self.bounces_shortly(&touch, &moved, &manifold, h) {
            for body in [touch.a, touch.b] {
                world.bodies.surface[body as usize].restitution = 0.0;
            }
        }
        let act = world.act(&manifold);
        for (body, surface) in [touch.a, touch.b].into_iter().zip(surfaces) {
            world.bodies.surface[body as usize] = surface;
        }
        for ((row, body), stood) in [(row_a, touch.a), (row_b, touch.b)].into_iter().zip(stands) {
            let motion = world.bodies.motion[body as usize];
            let row = &mut self.rows.rows[row as usize].0;
            (row[VX], row[VZ], row[SPIN]) = (motion.v.x, motion.v.y, motion.omega);
            world.bodies.frame[body as usize] = stood;
        }
        let act = act?;
        let (a, b) = (touch.a.min(touch.b), touch.a.max(touch.b));
        let kind = PairKind::of(world.bodies.role[a as usize], world.bodies.role[b as usize]);
        world.work.count_exchange(kind);
        let (iteration, point) = (world.iteration, act.middle + world.plan.origin);
        let depth = manifold.depth.max(0.0);
        self.untold.push(Hit { iteration, a: BodyId(a), b: BodyId(b), point, normal: act.normal, depth, kind });
        Some(time)
    }
}

/// The two rectangles of a touch, the reference first, with their bodies.
struct Two<'a> {
    bodies: &'a Bodies,
    body: [usize; 2],
    index: [usize; 2],
}

impl<'a> Two<'a> {
    fn of(bodies: &'a Bodies, touch: &Touch) -> Two<'a> {
        let (one, two) = (touch.rects.0 as usize, touch.rects.1 as usize);
        let index = if touch.of_first { [one, two] } else { [two, one] };
        Two { bodies, body: [touch.a as usize, touch.b as usize], index }
    }

    fn rect(&self, which: usize) -> &'a Rect {
        &self.bodies.rects[self.index[which]]
    }

    fn placed<'b>(&self, frames: [&'b Frame; 2]) -> [Placed<'b>; 2]
    where
        'a: 'b,
    {
        [0, 1].map(|k| Placed { body: self.body[k], frame: frames[k], index: self.index[k], rect: self.rect(k) })
    }

    /// The contact at the face that a search found.
    fn contact(&self, found: &Found, frames: [&Frame; 2]) -> (bool, Manifold) {
        let [one, two] = self.placed(frames);
        let (reference, owner) = if found.face_of_first { (one, two) } else { (two, one) };
        let manifold = at_face(reference, owner, found.face);
        (seams::hides(&self.bodies.seams, reference, owner, &manifold), manifold)
    }
}

/// When and where the two rectangles of a touch meet within a time: at once where they overlap.
fn meeting(world: &mut World, touch: &Touch, paths: &[Path; 2], left: f64) -> Option<(f64, Manifold)> {
    let two = Two::of(&world.bodies, touch);
    let small = two.rect(0).half().min().min(two.rect(1).half().min());
    let depth = overlap::depth(&paths[0].frame, two.rect(0), &paths[1].frame, two.rect(1));
    if depth > OVERLAPPED * small {
        let before = Before { of_first: true, face: touch.face, normal: touch.n };
        let [one, other] = two.placed([&paths[0].frame, &paths[1].frame]);
        let manifold = meet(&world.bodies, (one, other), 0.0, Some(&before), |body| world.bodies.frame[body])?;
        return Some((0.0, manifold));
    }
    world.work.touches_sought += 1;
    let [a, b] = [0, 1].map(|k| Flier { path: paths[k], rect: *two.rect(k) });
    let found = first_open_touch(&a, &b, left, |found, frames| two.contact(found, frames).0)?;
    let frames = paths.map(|path| path.after(found.time).frame);
    Some((found.time, two.contact(&found, [&frames[0], &frames[1]]).1))
}
