//! Who may touch within the step, and where.

use super::Contacts;
use super::abreast::{Abreast, Loyal, Side};
use super::points::Points;
use super::pulls::Pulls;
use super::remembered::Remembered;
use super::search::Search;
use super::touch::Touch;
use crate::advance::frame_before;
use crate::area::Rect;
use crate::bodies::{Bodies, Motion};
use crate::broad_phase::met::Owner;
use crate::flight::Pull;
use crate::frame::Frame;
use crate::lanes::{Eight, LANES, Wide};
use crate::threads::{PER_THREAD, Threads};
use crate::width::Work;
use crate::world::World;

/// What acts on the bodies over a step.
#[derive(Clone, Copy)]
pub(super) struct Acting<'a> {
    pulls: &'a Pulls,
    /// The same on all mobile bodies, unless some are pushed: then nothing has to be read for each.
    on_all: Option<Pull>,
}

impl Acting<'_> {
    /// Where a rectangle of a body is: a row, to become a lane.
    #[inline(always)]
    pub(super) fn place(frame: &Frame, rect: &Rect) -> Eight {
        Eight([frame.o.x, frame.o.y, frame.cos, frame.sin, rect.x_min, rect.x_max, rect.z_min, rect.z_max])
    }

    /// How its body moves: velocity, spin, what they change by now, and 1 where nothing turns or changes, else −1.
    #[inline(always)]
    pub(super) fn motion(&self, motion: &Motion, owner: Owner) -> Eight {
        let pull = self.on(owner);
        let now = pull.a - motion.v * pull.drag.0;
        let angular = pull.alpha - motion.omega * pull.drag.1;
        let straight = if motion.omega == 0.0 && pull.is_none() { 1.0 } else { -1.0 };
        Eight([motion.v.x, motion.v.y, motion.omega, now.x, now.y, angular, straight, 0.0])
    }

    #[inline(always)]
    fn on(&self, owner: Owner) -> Pull {
        match self.on_all {
            Some(pull) if owner.is_mobile() => pull,
            Some(_) => Pull::NONE,
            None => self.pulls.on(owner.body()),
        }
    }
}

impl Contacts {
    /// What acts on each body over the step.
    pub(super) fn pull(&mut self, world: &World) {
        self.pulls.set(world.plan.flight, &world.pushes, &world.bodies);
    }

    /// Finds all touches of the step, and what they remember of the last.
    pub(super) fn find(&mut self, world: &mut World, dt: f64) {
        let World { plan, bodies, threads, work, .. } = world;
        let bodies = &*bodies;
        core::mem::swap(&mut self.touches, &mut self.before);
        self.touches.clear();
        let acting = Acting { pulls: &self.pulls, on_all: self.pulls.on_all() };
        self.search.pairs((bodies, acting, dt), plan.broad_phase, (self.width, *threads), work);
        let earlier = |body: usize| frame_before(bodies, plan.flight, plan.time_step, body);
        let Contacts { search, touches, before, apart, shares, width, found, .. } = self;
        let apart = apart.begin();
        let (search, before, width) = (&*search, Remembered::new(before, *found), *width);
        let tasks: Vec<_> = threads
            .parts(search.near().len(), LANES, PER_THREAD)
            .into_iter()
            .map(|part| {
                let near = &search.near()[part];
                let before = near.first().map_or(before, |first| before.from(*first));
                move |touches: &mut Vec<Touch>, apart: &mut Vec<(u32, u32)>| {
                    width.run(Look { bodies, acting, search, near, before, touches, apart, dt, earlier });
                }
            })
            .collect();
        share(tasks, touches, apart, shares);
        self.found = self.touches.len();
        work.pairs_listed += self.touches.len() as u64;
    }
}

/// What a task has found: touches, and pairs that stay apart.
pub(super) type Found = (Vec<Touch>, Vec<(u32, u32)>);

/// The first task finds what it finds right into the lists, the others into lists of their own, which are put behind in order.
fn share<F>(tasks: Vec<F>, touches: &mut Vec<Touch>, apart: &mut Vec<(u32, u32)>, more: &mut Vec<Found>)
where
    F: FnOnce(&mut Vec<Touch>, &mut Vec<(u32, u32)>) + Send,
{
    more.resize_with(tasks.len().saturating_sub(1), Found::default);
    let own = more.iter_mut().map(|(touches, apart)| {
        touches.clear();
        apart.clear();
        (touches, apart)
    });
    let lists = core::iter::once((&mut *touches, &mut *apart)).chain(own);
    let tasks = tasks.into_iter().zip(lists).map(|(task, (touches, apart))| move || task(touches, apart));
    Threads::share(tasks.collect());
    for (more_touches, more_apart) in more {
        touches.extend_from_slice(more_touches);
        apart.extend_from_slice(more_apart);
    }
}

/// Looks at all pairs that may touch, eight side by side.
struct Look<'a, F> {
    bodies: &'a Bodies,
    acting: Acting<'a>,
    search: &'a Search,
    near: &'a [(u32, u32)],
    before: Remembered<'a>,
    touches: &'a mut Vec<Touch>,
    /// Pairs that stay apart unless something is done to them.
    apart: &'a mut Vec<(u32, u32)>,
    dt: f64,
    /// Where a body stood a step ago.
    earlier: F,
}

impl<F: Fn(usize) -> Frame + Copy> Work for Look<'_, F> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(self) {
        let Look { bodies, acting, search, near, mut before, touches, apart, dt, earlier } = self;
        for keys in near.chunks(LANES) {
            let mut one = [search.placed(bodies, keys[0].0); LANES];
            let mut two = [search.placed(bodies, keys[0].1); LANES];
            for (k, key) in keys.iter().enumerate().skip(1) {
                (one[k], two[k]) = (search.placed(bodies, key.0), search.placed(bodies, key.1));
            }
            let pairs = Abreast::<V>::new(Side::of(bodies, acting, &one), Side::of(bodies, acting, &two), dt);
            let listed = pairs.may();
            if !listed.any() {
                continue;
            }
            let mut last = [None; LANES];
            for (last, key) in last.iter_mut().zip(keys) {
                *last = before.of_pair(*key);
            }
            let loyal = Loyal::<V>::of(&last);
            let may = listed.min(loyal.stays.max(-pairs.stay_apart(dt)));
            let left = listed.min(-may);
            if left.any() {
                let left = left.eight();
                apart.extend((0..keys.len()).filter(|k| left.0[*k] > 0.0).map(|k| keys[k]));
            }
            if !may.any() {
                continue;
            }
            let deep = pairs.deep();
            let points = Points::of(&pairs, pairs.best(&loyal, deep));
            let (may, deep, margin) = (may.eight(), deep.eight(), pairs.margin.eight());
            for k in (0..keys.len()).filter(|k| may.0[*k] > 0.0) {
                let (one, two) = (one[k].0, two[k].0);
                let seam = bodies.seams.concern(one.index) || bodies.seams.concern(two.index);
                match points.touches(k).filter(|_| (deep.0[k] < 0.0 || last[k].is_some()) && !seam) {
                    None => {
                        if let Some(touch) = Touch::find(bodies, (one, two), margin.0[k], last[k], earlier) {
                            touch.put_behind(touches);
                        }
                    }
                    Some(false) => {}
                    Some(true) => {
                        points.touch(k, bodies, (&one, &two)).put_behind(touches);
                        if let (Some(touch), Some(last)) = (touches.last_mut(), last[k]) {
                            touch.remember(last);
                        }
                    }
                }
            }
        }
    }
}

impl World {
    /// Looks once more for the touches of the step to come and counts them: finding on its own, for benchmarks. 0 where a scene
    /// has no contact solver.
    #[doc(hidden)]
    pub fn find_touches(&mut self) -> usize {
        let Some(mut contacts) = self.contacts.take() else { return 0 };
        contacts.pull(self);
        contacts.find(self, self.plan.time_step);
        let count = contacts.touches.len();
        self.contacts = Some(contacts);
        count
    }
}
