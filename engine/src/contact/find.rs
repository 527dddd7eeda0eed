//! Who may touch within the step, and where.

use super::Contacts;
use super::abreast::{Abreast, Loyal, Mover, Side};
use super::acting::Acting;
use super::points::Points;
use super::remembered::Remembered;
use super::search::Search;
use super::touch::Touch;
use crate::advance::frame_before;
use crate::bodies::Bodies;
use crate::frame::Frame;
use crate::lanes::{Eight, LANES, Numbers, Wide};
use crate::threads::{PER_THREAD, Threads};
use crate::width::Work;
use crate::world::World;

impl Contacts {
    /// What acts on each body over the step.
    pub(super) fn pull(&mut self, world: &World) {
        self.pulls.set(world.plan.flight, &world.pushes, &world.bodies);
    }

    /// Finds all touches of the step, and what they remember of the last.
    pub(super) fn find(&mut self, world: &mut World, dt: f64) {
        let World { plan, bodies, movers, threads, work, .. } = world;
        let bodies = &*bodies;
        core::mem::swap(&mut self.touches, &mut self.before);
        self.touches.clear();
        let acting = Acting::new(&self.pulls);
        if self.still.find(bodies, movers, &self.pulls, &self.before) {
            self.search.own(bodies, &self.still);
            self.apart.keep(&self.search, &self.still, bodies.len());
        }
        self.search.pairs((bodies, acting, dt), &self.still, plan.broad_phase, (self.width, threads), work);
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
        share(threads, tasks, touches, apart, shares);
        self.found = self.touches.len();
        work.pairs_listed += self.touches.len() as u64;
    }
}

/// What a task has found: touches, and pairs that stay apart.
pub(super) type Found = (Vec<Touch>, Vec<(u32, u32)>);

/// The first task finds what it finds right into the lists, the others into lists of their own, which are put behind in order.
fn share<F>(
    threads: &Threads,
    tasks: Vec<F>,
    touches: &mut Vec<Touch>,
    apart: &mut Vec<(u32, u32)>,
    more: &mut Vec<Found>,
) where
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
    threads.share(tasks.collect());
    for (more_touches, more_apart) in more {
        touches.extend_from_slice(more_touches);
        apart.extend_from_slice(more_apart);
    }
}

/// Looks at all pairs that may touch, some side by side: first whether they do, then where.
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

/// A pair that comes to touch: its rectangles, how far they may be from each other, and its touch of the last step.
type Coming<'a> = ((u32, u32), f64, Option<&'a Touch>);

impl<F: Fn(usize) -> Frame + Copy> Work for Look<'_, F> {
    type Out = ();

    /// Pairs are many and few of them come to touch: those are gathered until there are as many as fit side by side.
    #[inline(always)]
    fn run<V: Wide>(mut self) {
        let count = V::Low::COUNT;
        let mut coming: [Coming; 2 * LANES] = [((0, 0), 0.0, None); 2 * LANES];
        let mut waiting = 0;
        let mut chunks = self.near.chunks(count);
        loop {
            let more = chunks.next();
            if let Some(keys) = more {
                waiting = self.come::<V::Low>(keys, &mut coming, waiting);
                if waiting < count {
                    continue;
                }
            }
            let come = waiting.min(count);
            if come > 0 {
                self.meet::<V::Low>(&coming[..come]);
                coming.copy_within(count..2 * count, 0);
                waiting -= come;
            }
            if more.is_none() {
                break;
            }
        }
    }
}

impl<'a, F: Fn(usize) -> Frame + Copy> Look<'a, F> {
    /// Puts pairs that come to touch behind those that wait, and others that are near among those that stay apart.
    #[inline(always)]
    fn come<V: Numbers>(
        &mut self,
        keys: &[(u32, u32)],
        coming: &mut [Coming<'a>; 2 * LANES],
        mut waiting: usize,
    ) -> usize {
        let (bodies, owners, dt) = (self.bodies, self.search.owners(), self.dt);
        let key = |k: usize| keys[k.min(keys.len() - 1)];
        let (one, two) = (|k: usize| key(k).0 as usize, |k: usize| key(k).1 as usize);
        let pairs = Abreast::<V>::new(Side::of(bodies, owners, one), Side::of(bodies, owners, two));
        let moving = [
            &Mover::of(self.acting.moving(bodies, |k| owners[one(k)]), &pairs.one),
            &Mover::of(self.acting.moving(bodies, |k| owners[two(k)]), &pairs.two),
        ];
        let margin = pairs.margin(moving, dt);
        let listed = pairs.may(margin);
        if !listed.any() {
            return waiting;
        }
        let (listed, margin) = (listed.eight(), margin.eight());
        let apart = pairs.stay_apart(moving, dt).eight();
        for k in (0..keys.len()).filter(|k| listed.0[*k] > 0.0) {
            let last = self.before.of_pair(keys[k]);
            // What came to touch and does not bounce goes on touching, or does so again soon.
            let stays = last.is_some_and(|last| last.surface.restitution == 0.0);
            if apart.0[k] > 0.0 && !stays {
                self.apart.push(keys[k]);
            } else {
                coming[waiting] = (keys[k], margin.0[k], last);
                waiting += 1;
            }
        }
        waiting
    }

    /// Finds the touches of pairs.
    #[inline(always)]
    fn meet<V: Numbers>(&mut self, coming: &[Coming]) {
        let (bodies, owners) = (self.bodies, self.search.owners());
        let pair = |k: usize| coming[k.min(coming.len() - 1)];
        let (one, two) = (|k: usize| pair(k).0.0 as usize, |k: usize| pair(k).0.1 as usize);
        let pairs = Abreast::<V>::new(Side::of(bodies, owners, one), Side::of(bodies, owners, two));
        let margin = Eight(core::array::from_fn(|k| pair(k).1));
        let (deep, loyal) = (pairs.deep(), Loyal::of(|k| pair(k).2));
        let points = Points::of(&pairs, V::of(&margin.0), pairs.best(&loyal, deep));
        let deep = deep.eight();
        for (k, (key, margin, last)) in coming.iter().enumerate() {
            let (one, two) = (self.search.placed(bodies, key.0), self.search.placed(bodies, key.1));
            let seam = bodies.seams.concern(one.index) || bodies.seams.concern(two.index);
            match points.touches(k).filter(|_| (deep.0[k] < 0.0 || last.is_some()) && !seam) {
                None => {
                    if let Some(touch) = Touch::find(bodies, (one, two), *margin, *last, self.earlier) {
                        touch.put_behind(self.touches);
                    }
                }
                Some(false) => {}
                Some(true) => {
                    points.touch(k, bodies, (&one, &two)).put_behind(self.touches);
                    if let (Some(touch), Some(last)) = (self.touches.last_mut(), last) {
                        touch.remember(last);
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
