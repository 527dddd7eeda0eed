//! Which rectangles are worth a full look: pairs whose swept bounds meet and that no axis holds apart, in order.

use super::acting::Acting;
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
    /// The pairs that may touch within a time, in the order of their rectangles: the same whatever way they are found.
    pub(super) fn pairs(
        &mut self,
        (bodies, acting, dt): (&Bodies, Acting, f64),
        plan: BroadPhasePlan,
        (width, threads): (Width, &Threads),
        work: &mut Work,
    ) {
        self.sweep((bodies, acting, dt), (width, threads));
        work.bounds += self.bounds.len() as u64;
        self.near.clear();
        let Search { owners, bounds, grid, met, near, .. } = self;
        if plan == BroadPhasePlan::AllPairs {
            all_pairs(bounds, owners, near, work);
            return;
        }
        grid.fill(bounds, owners);
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
        let owner = self.owners[rect as usize];
        if plan == BroadPhasePlan::AllPairs {
            work.bounds_compared += self.bounds.len() as u64;
            let met = self.bounds.iter().zip(&self.owners).enumerate();
            near.extend(met.filter(|(_, (b, o))| owner.can_meet(**o) && b.meet(&swept)).map(|(other, _)| other as u32));
            return;
        }
        work.bounds_compared += self.grid.around(rect, owner, swept, &mut self.around);
        near.extend(self.around.pairs().iter().map(|(one, two)| if *one == rect { *two } else { *one }));
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

    fn sweep(&mut self, (bodies, acting, dt): (&Bodies, Acting, f64), (width, threads): (Width, &Threads)) {
        let count = bodies.rects.len();
        if self.owners.len() != count {
            self.owners.clear();
            for body in 0..bodies.len() {
                let owner = Owner::new(body, bodies.is_mobile(body));
                self.owners.extend(bodies.rects_of(body).iter().map(|_| owner));
            }
            self.bounds.resize(count, Bounds([0.0; 4]));
        }
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
