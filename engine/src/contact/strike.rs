//! Impacts, pair by pair, by the law of one impact ([`crate::exchange::impulse`]), which never makes energy.
//!
//! A pair of which both touch no other flies to its very moment within the sub-step; so does a body that touches only one
//! other, when that one rests. In a crowd, points that will be reached within the sub-step are taken to be reached at once,
//! in the order of the touches, until none comes any more; without restitution that is left to the pushes.

use super::Contacts;
use super::flying::Fliers;
use super::meeting::{Two, meeting, meeting_now};
use super::rows::{Row, SPIN, VX, VZ};
use super::touch::Touch;
use crate::detect::manifold::Manifold;
use crate::flight::{Path, Pull};
use crate::frame::perp;
use crate::world::World;

/// Impacts of a pair in a sub-step at most, and rounds of impacts in a crowd; what comes more often is held.
pub(super) const MOST_STRIKES: u32 = 8;
const MOST_ROUNDS: u32 = 4;

/// A bounce that would last for less than this many sub-steps is none: the contact lasts.
const SHORTEST: f64 = 1.0;

/// A body rests that is no faster than this many times what gravity does in a sub-step.
const RESTS: f64 = 2.0;

/// A meeting to come: how the bodies fly to it, how long \[s\], and where they touch then.
pub(super) struct Meets {
    pub(super) paths: [Path; 2],
    pub(super) time: f64,
    pub(super) manifold: Manifold,
}

impl Contacts {
    /// Lets bodies that touch no other fly to their impacts within the sub-step, and exchange there.
    pub(super) fn strike(&mut self, world: &mut World, h: f64) {
        self.clear.clear();
        for at in 0..self.lonely.len() {
            let k = self.lonely[at] as usize;
            let mut left = h;
            let mut struck = false;
            for _ in 0..MOST_STRIKES {
                if left <= 0.0 || self.touches[k].met || !self.is_lonely(k) || !self.may_strike(k, left, h) {
                    break;
                }
                if self.is_held(k) {
                    // It does not fly: what is to land is left to the pushes.
                    if self.meets(world, k, [true; 2], left).is_none() {
                        self.clear.push(k as u32);
                    }
                    break;
                }
                match self.strike_once(world, k, [true; 2], (left, h)) {
                    Some(time) => left -= time,
                    None => break,
                }
                struck = true;
            }
            if struck {
                let touch = &self.touches[k];
                let met = touch.surface.restitution == 0.0 && self.pulled_together(touch) == 0.0;
                self.look_again(world, k);
                self.touches[k].met = met;
            }
        }
        self.join_crowd();
        for round in 0..MOST_ROUNDS {
            let mut any = false;
            self.round += 1;
            for at in 0..self.crowd.len() {
                let k = self.crowd[at] as usize;
                if round == 0 || self.is_stirred(k) {
                    any |= self.strike_in_crowd(world, k, h);
                }
            }
            if !any {
                break;
            }
            self.join_crowd();
        }
    }

    /// Whether an impact has changed the motion of one of the bodies in this round or the one before.
    fn is_stirred(&self, k: usize) -> bool {
        let (a, b) = self.of_touch[k];
        let last = |row: u32| self.fliers.stirred[row as usize];
        last(a).max(last(b)) + 1 >= self.round
    }

    /// Touches whose bodies have come to touch others since are lonely no more.
    fn join_crowd(&mut self) {
        if self.touches.len() == self.found {
            return;
        }
        self.join_pairs();
        for at in 0..self.lonely.len() {
            let k = self.lonely[at];
            if !self.is_lonely(k as usize) && self.touches[k as usize].surface.restitution > 0.0 {
                self.crowd.push(k);
            }
        }
        let mut lonely = core::mem::take(&mut self.lonely);
        lonely.retain(|k| self.is_lonely(*k as usize));
        self.lonely = lonely;
    }

    /// Whether neither body touches any other.
    pub(super) fn is_lonely(&self, k: usize) -> bool {
        let (a, b) = self.of_touch[k];
        [a, b].into_iter().all(|row| self.rows.mobile_of(row).is_none_or(|at| self.rows.degree[at] == 1))
    }

    /// Pairs of which it is known that they do not meet within the sub-step ask for nothing, unless they touch already; nor are they parted
    /// where they touch no other: a corner that turns away from a face is not where its motion as the step began says.
    pub(super) fn leave_clear(&mut self) {
        for &k in &self.clear {
            let (k, [Row(a), Row(b)]) = (k as usize, &self.rows_now(k as usize));
            let lonely = self.is_lonely(k);
            for p in (0..2).filter(|p| self.touches[k].state(*p, a, b).0 > self.band) {
                self.blocks.ask_nothing(k, p);
                if lonely {
                    self.blocks.part_nothing(k, p);
                }
            }
        }
        self.leave_fast();
        for &k in self.lonely.iter().filter(|k| self.touches[**k as usize].met) {
            (0..2).for_each(|p| self.blocks.ask_nothing(k as usize, p));
        }
    }

    /// The impact of a touch among others, if it comes within the sub-step.
    fn strike_in_crowd(&mut self, world: &mut World, k: usize, h: f64) -> bool {
        let touch = self.touches[k];
        let come = self.come(k, world.plan.gravity().dot(&touch.n).abs(), h);
        if come == [false; 2] {
            return false;
        }
        let (row_a, row_b) = self.of_touch[k];
        let alone = |row: u32| self.rows.mobile_of(row).is_some_and(|at| self.rows.degree[at] == 1);
        let rests = |row: u32| {
            let r = &self.rows.rows[row as usize].0;
            let limit = RESTS * world.plan.gravity().norm() * h;
            r[VX] * r[VX] + r[VZ] * r[VZ] <= limit * limit
        };
        let flies = [alone(row_a) && rests(row_b), alone(row_b) && rests(row_a)];
        if flies != [false; 2] && self.fliers.spent[row_a as usize] + self.fliers.spent[row_b as usize] == 0.0 {
            return self.strike_once(world, k, flies, (h, h)).is_some();
        }
        let paths = self.paths(world, k, [false; 2]);
        let Some(manifold) = meeting_now(world, &touch, [&paths[0].frame, &paths[1].frame], come) else {
            return false;
        };
        self.exchange(world, k, (&manifold, &paths), h)
    }

    /// Which points of a touch are reached within the sub-step, faster than what is no bounce. One that presses already is
    /// not reached.
    fn come(&self, k: usize, pulled: f64, h: f64) -> [bool; 2] {
        if self.blocks.presses(k) {
            return [false; 2];
        }
        let touch = &self.touches[k];
        let [Row(a), Row(b)] = &self.rows_now(k);
        let slips = touch.slips(a, b);
        [0, 1].map(|p| {
            let (gap, u) = touch.state(p, a, b);
            let reached = u < 0.0 && gap + u * h <= 0.0 && (gap <= 0.0 || !slips);
            reached && p < touch.count as usize && 2.0 * touch.surface.restitution * -u > SHORTEST * h * pulled
        })
    }

    /// After an impact the pair stands otherwise than when the step began: where it touches is found again; whether it is.
    pub(super) fn look_again(&mut self, world: &World, k: usize) -> bool {
        let touch = self.touches[k];
        let (row_a, row_b) = self.of_touch[k];
        let [path_a, path_b] = self.paths(world, k, [false; 2]);
        let two = Two::of(&world.bodies, &touch);
        let [one, other] = two.placed([&path_a.frame, &path_b.frame]);
        let pair = if touch.of_first { (one, other) } else { (other, one) };
        let margin = 2.0 * (one.rect.half().min() + other.rect.half().min());
        let Some(mut now) = Touch::find(&world.bodies, pair, margin, Some(&touch), |body| world.bodies.frame[body])
        else {
            return false;
        };
        if now.a != touch.a {
            return false;
        }
        let [Row(a), Row(b)] = &self.rows_now(k);
        now.count_from(a, b);
        self.blocks.set(k, &now, (row_a, row_b), self.keep, self.band);
        self.touches[k] = now;
        true
    }

    /// How strongly what acts on two bodies draws them together \[m/s²\].
    fn pulled_together(&self, touch: &Touch) -> f64 {
        let pull = |body: u32| self.pulls.on(body as usize);
        (pull(touch.a).a - pull(touch.b).a).dot(&touch.n).max(0.0)
    }

    /// Whether the pair may come to touch within a time at a speed worth an impact. A point that presses already is not reached: what
    /// little it has come off the face in turning is no flight.
    pub(super) fn may_strike(&self, k: usize, time: f64, h: f64) -> bool {
        let touch = &self.touches[k];
        let [Row(a), Row(b)] = &self.rows_now(k);
        let pulled = self.pulled_together(touch);
        let (pushes, _) = self.blocks.pushes(k);
        (0..touch.count as usize).filter(|p| pushes[*p] == 0.0).any(|p| {
            let (gap, u) = touch.state(p, a, b);
            // Turning bodies may come sooner than the straight line says: looked for with some room.
            let room =
                (a[SPIN] * a[SPIN] * touch.along_a.abs() + b[SPIN] * b[SPIN] * touch.along_b.abs()) * time * time;
            let closest = gap + (u - 0.5 * pulled * time).min(0.0) * time - room;
            let speed = (u * u + 2.0 * pulled * gap.max(0.0)).sqrt();
            closest <= 0.0 && (u < 0.0 || gap > 0.0) && 2.0 * speed > SHORTEST * h * pulled
        })
    }

    /// Whether a touch presses and would give nothing back.
    fn is_held(&self, k: usize) -> bool {
        self.touches[k].surface.restitution == 0.0 && self.blocks.presses(k)
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

    /// How the bodies of a touch fly on from where they are; those that do not fly only move on.
    pub(super) fn paths(&self, world: &World, k: usize, flies: [bool; 2]) -> [Path; 2] {
        let touch = &self.touches[k];
        let rows = self.rows_now(k);
        let of = |side: usize, body: u32| {
            let pull = if flies[side] { self.pulls.on(body as usize) } else { Pull::NONE };
            Fliers::path(&rows[side], &world.bodies.frame[body as usize], pull)
        };
        [of(0, touch.a), of(1, touch.b)]
    }

    /// How far into the sub-step a body of a touch has flown ahead \[s\].
    pub(super) fn ahead(&self, k: usize) -> f64 {
        let (a, b) = self.of_touch[k];
        self.fliers.spent[a as usize].max(self.fliers.spent[b as usize])
    }

    /// The rows of a touch as they are by now: a fixed body goes on as far into the sub-step as the other has flown ahead.
    pub(super) fn rows_now(&self, k: usize) -> [Row; 2] {
        let (a, b) = self.of_touch[k];
        let ahead = self.ahead(k);
        [a, b].map(|row| {
            let fixed = self.rows.mobile_of(row).is_none();
            let row = self.rows.rows[row as usize];
            if fixed { row.after(ahead) } else { row }
        })
    }

    /// One impact within a time; gives when. Those that fly are ahead of the sub-step then.
    fn strike_once(&mut self, world: &mut World, k: usize, flies: [bool; 2], (left, h): (f64, f64)) -> Option<f64> {
        let Some(meets) = self.meets(world, k, flies, left) else {
            self.clear.push(k as u32);
            return None;
        };
        self.strike_at(world, k, flies, &meets, h).then_some(meets.time)
    }

    /// When and how the pair of a touch meets within a time, as its bodies fly.
    pub(super) fn meets(&self, world: &mut World, k: usize, flies: [bool; 2], left: f64) -> Option<Meets> {
        let paths = self.paths(world, k, flies);
        let (time, manifold) = meeting(world, &self.touches[k], &paths, left)?;
        Some(Meets { paths, time, manifold })
    }

    /// The bodies that fly go on to where they meet, and exchange motion; whether anything approached.
    pub(super) fn strike_at(&mut self, world: &mut World, k: usize, flies: [bool; 2], meets: &Meets, h: f64) -> bool {
        let (row_a, row_b) = self.of_touch[k];
        for (row, (path, flies)) in [row_a, row_b].into_iter().zip(meets.paths.iter().zip(flies)) {
            if flies && self.rows.mobile_of(row).is_some() {
                self.fliers.go_on(&mut self.rows, row, path, meets.time);
                self.book_ahead(world, row, (meets.time, true));
            }
        }
        let moved = meets.paths.map(|path| path.after(meets.time));
        self.exchange(world, k, (&meets.manifold, &moved), h)
    }

    /// Exchanges motion at a manifold of two bodies that stand and move so; whether anything approached.
    pub(super) fn exchange(
        &mut self,
        world: &mut World,
        k: usize,
        (manifold, now): (&Manifold, &[Path; 2]),
        h: f64,
    ) -> bool {
        let touch = self.touches[k];
        let (row_a, row_b) = self.of_touch[k];
        let pair = [touch.a as usize, touch.b as usize];
        let stood = pair.map(|body| (world.bodies.frame[body], world.bodies.surface[body]));
        let shortly = self.bounces_shortly(&touch, now, manifold, h);
        for (body, path) in pair.into_iter().zip(now) {
            world.bodies.frame[body] = path.frame;
            world.bodies.motion[body] = path.motion;
            if shortly {
                world.bodies.surface[body].restitution = 0.0;
            }
        }
        let act = self.act(world, self.of_touch[k], manifold);
        for ((row, body), (frame, surface)) in [row_a, row_b].into_iter().zip(pair).zip(stood) {
            self.rows.rows[row as usize].set_motion(world.bodies.motion[body]);
            self.fliers.stirred[row as usize] = self.round;
            world.bodies.frame[body] = frame;
            world.bodies.surface[body] = surface;
        }
        let Some(act) = act else { return false };
        self.note_speed(world, row_a, h);
        self.note_speed(world, row_b, h);
        self.tell(world, k, (act.middle, act.normal), manifold.depth.max(0.0));
        for body in pair {
            self.wake_around(world, body, None);
        }
        true
    }
}
