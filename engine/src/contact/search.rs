//! Which rectangles are worth a full look: pairs whose swept bounds meet and that no axis holds apart, in order.

use super::acting::Acting;
use super::still::Still;
use super::swept::SweepAll;
use crate::bodies::Bodies;
use crate::broad_phase::grid::Grid;
use crate::broad_phase::met::{Bounds, Met, Owner};
use crate::detect::manifold::Placed;
use crate::lanes::{LANES, Wide};
use crate::plan::BroadPhasePlan;
use crate::threads::{PER_THREAD, Threads};
use crate::width::{self, Width};
use crate::work::Work;
use core::ops::Range;

/// The search and its scratch; it allocates until it is warm and never after.
#[derive(Clone, Debug, Default)]
pub(super) struct Search {
    /// Whose each rectangle is.
    owners: Vec<Owner>,
    /// What each sweeps over the step.
    bounds: Vec<Bounds>,
    grid: Grid,
    /// The look at which the grid was filled; and whether that was an earlier one than this: then rectangles that move, listed, may be
    /// elsewhere by now.
    filled: u64,
    is_old: bool,
    moving: Vec<u32>,
    /// What was found, by the parts it was shared out in.
    met: Vec<Met>,
    /// The pairs found, by the indices of their rectangles, i < j, in order.
    near: Vec<(u32, u32)>,
    begins: Vec<u32>,
    /// Pairs found around one of them.
    around: Met,
}

/// Fewer pairs than one for so many rectangles are sorted by comparing them.
const SPARSE: usize = 8;

impl Search {
    /// The pairs that may touch within a time, but for those of two bodies that lie still, in the order of their rectangles: the same
    /// whatever way they are found.
    pub(super) fn pairs(
        &mut self,
        (bodies, acting, dt): (&Bodies, Acting, f64),
        still: &Still,
        plan: BroadPhasePlan,
        (width, threads): (Width, &Threads),
        work: &mut Work,
    ) {
        if self.owners.len() != bodies.rects.len() {
            self.own(bodies, still);
        }
        self.near.clear();
        self.is_old = plan != BroadPhasePlan::AllPairs && still.lay_at(self.filled) && self.few_move();
        if self.is_old {
            self.pairs_of_few((bodies, acting, dt), width, work);
            return;
        }
        self.sweep((bodies, acting, dt), (width, threads));
        work.bounds += self.bounds.len() as u64;
        let Search { owners, bounds, grid, met, near, .. } = self;
        if plan == BroadPhasePlan::AllPairs {
            all_pairs(bounds, owners, near, work);
            return;
        }
        grid.fill(bounds, owners);
        self.filled = still.looks();
        let grid = &*grid;
        let parts = threads.parts(grid.cells() as usize, 1, PER_THREAD);
        met.resize_with(parts.len(), Met::default);
        let tasks: Vec<_> = parts
            .into_iter()
            .zip(met.iter_mut())
            .map(|(part, met)| move || width.run(Visit { grid, cells: part.start as u32..part.end as u32, met }))
            .collect();
        work.bounds_compared += threads.share(tasks).into_iter().sum::<u64>();
        self.sort();
        count(work, self.near.len());
    }

    /// Lists what moves; whether it is little enough to be compared one by one.
    fn few_move(&mut self) -> bool {
        let moving = (0..self.owners.len() as u32).filter(|rect| self.owners[*rect as usize].moves());
        let most = self.owners.len().isqrt();
        self.moving.clear();
        self.moving.extend(moving.take(most + 1));
        self.moving.len() <= most
    }

    /// The pairs of what moves: with what lies where it lay when the grid was filled, and with each other.
    fn pairs_of_few(&mut self, (bodies, acting, dt): (&Bodies, Acting, f64), width: Width, work: &mut Work) {
        let Search { owners, bounds, moving, grid, around, near, .. } = self;
        for rect in moving.iter().map(|rect| *rect as usize) {
            width.run(SweepAll { bodies, acting, owners, dt, from: rect, bounds: &mut bounds[rect..=rect] });
        }
        work.bounds += moving.len() as u64;
        for (at, &rect) in moving.iter().enumerate() {
            let (owner, own) = (owners[rect as usize], bounds[rect as usize]);
            work.bounds_compared += grid.around(rect, owner, own, around);
            near.extend(around.pairs().iter().filter(|pair| !owners[other(**pair, rect) as usize].moves()));
            let later = &moving[at + 1..];
            work.bounds_compared += later.len() as u64;
            let meet = |other: u32| owner.can_meet(owners[other as usize]) & own.meet(&bounds[other as usize]);
            near.extend(later.iter().filter(|other| meet(**other)).map(|other| (rect, *other)));
        }
        near.sort_unstable();
        count(work, near.len());
    }

    /// The pairs found last.
    pub(super) fn near(&self) -> &[(u32, u32)] {
        &self.near
    }

    /// The rectangles that sweep over what a rectangle sweeps by now, if bodies fly as they set out; adds them.
    pub(super) fn around(
        &mut self,
        (rect, swept): (u32, Bounds),
        plan: BroadPhasePlan,
        near: &mut Vec<u32>,
        work: &mut Work,
    ) {
        let owner = self.owners[rect as usize].lying(false);
        let meets =
            |other: &u32| owner.can_meet(self.owners[*other as usize]) && self.bounds[*other as usize].meet(&swept);
        if plan == BroadPhasePlan::AllPairs {
            work.bounds_compared += self.bounds.len() as u64;
            near.extend((0..self.bounds.len() as u32).filter(meets));
            return;
        }
        if self.is_old {
            work.bounds_compared += self.moving.len() as u64;
            near.extend(self.moving.iter().copied().filter(meets));
        }
        work.bounds_compared += self.grid.around(rect, owner, swept, &mut self.around);
        let met = self.around.pairs().iter().map(|pair| other(*pair, rect));
        near.extend(met.filter(|other| !(self.is_old && self.owners[*other as usize].moves())));
    }

    /// Whether bounds lie within those that a rectangle was taken to sweep over.
    pub(super) fn foresaw(&self, rect: u32, bounds: Bounds) -> bool {
        self.bounds[rect as usize].contain(&bounds)
    }

    /// Whose a rectangle is.
    #[inline(always)]
    pub(super) fn body_of(&self, rect: u32) -> usize {
        self.owners[rect as usize].body()
    }

    /// Whose each rectangle is.
    pub(super) fn owners(&self) -> &[Owner] {
        &self.owners
    }

    /// A rectangle where its body stands.
    #[inline(always)]
    pub(super) fn placed<'a>(&self, bodies: &'a Bodies, rect: u32) -> Placed<'a> {
        let (index, body) = (rect as usize, self.body_of(rect));
        Placed { body, frame: &bodies.frame[body], index, rect: &bodies.rects[index] }
    }

    /// Notes whose each rectangle is, and which of them lie still.
    pub(super) fn own(&mut self, bodies: &Bodies, still: &Still) {
        self.owners.clear();
        for body in 0..bodies.len() {
            let owner = Owner::new(body, bodies.is_mobile(body)).lying(still.lies(body));
            self.owners.extend(bodies.rects_of(body).iter().map(|_| owner));
        }
        self.bounds.resize(self.owners.len(), Bounds([0.0; 4]));
    }

    fn sweep(&mut self, (bodies, acting, dt): (&Bodies, Acting, f64), (width, threads): (Width, &Threads)) {
        let Search { owners, bounds, .. } = self;
        let owners = &owners[..];
        threads.each(&mut bounds[..], (LANES, PER_THREAD), |from, bounds| {
            width.run(SweepAll { bodies, acting, owners, dt, from, bounds });
        });
    }

    /// Puts the pairs in order: counted by their first, placed, then each first's by their second.
    fn sort(&mut self) {
        let met = || self.met.iter().flat_map(|met| met.pairs());
        let count: usize = self.met.iter().map(|met| met.pairs().len()).sum();
        if SPARSE * count < self.bounds.len() {
            self.near.extend(met());
            self.near.sort_unstable();
            return;
        }
        self.begins.clear();
        self.begins.resize(self.bounds.len() + 1, 0);
        for (i, _) in met() {
            self.begins[*i as usize] += 1;
        }
        let mut end = 0;
        for begin in &mut self.begins {
            end += *begin;
            *begin = end;
        }
        self.near.resize(count, (0, 0));
        for pair in met() {
            let begin = &mut self.begins[pair.0 as usize];
            *begin -= 1;
            self.near[*begin as usize] = *pair;
        }
        for ends in self.begins.windows(2) {
            let of_one = &mut self.near[ends[0] as usize..ends[1] as usize];
            if of_one.len() > 1 {
                of_one.sort_unstable();
            }
        }
    }
}

/// The other of a pair.
fn other((one, two): (u32, u32), rect: u32) -> u32 {
    if one == rect { two } else { one }
}

/// Every pair whose bounds meet: what the grid is held to.
fn all_pairs(bounds: &[Bounds], owners: &[Owner], near: &mut Vec<(u32, u32)>, work: &mut Work) {
    for i in 0..bounds.len() {
        for j in i + 1..bounds.len() {
            if owners[i].can_meet(owners[j]) {
                work.bounds_compared += 1;
                if bounds[i].meet(&bounds[j]) {
                    count(work, 1);
                    near.push((i as u32, j as u32));
                }
            }
        }
    }
}

/// Pairs whose bounds meet are tried along four axes.
fn count(work: &mut Work, pairs: usize) {
    work.pairs_tested += pairs as u64;
    work.axes_tested += 4 * pairs as u64;
}

/// Looks through the grid.
struct Visit<'a> {
    grid: &'a Grid,
    cells: Range<u32>,
    met: &'a mut Met,
}

impl width::Work for Visit<'_> {
    type Out = u64;

    #[inline(always)]
    fn run<V: Wide>(self) -> u64 {
        self.grid.visit(self.cells, self.met)
    }
}
