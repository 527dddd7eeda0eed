//! A sweep in strips: nearly linear in the number of bodies, whatever mix of small cars and long walls.
//!
//! ```text
//!   z ^        ┌──┐   strip 3          Each rectangle is entered in every strip it reaches into, with the
//!     │──/─────│──│───────────         range of x it covers there: a long slanting wall enters many strips
//!     │ /   ┌──│──│─┐ strip 2          with a short range each. A strip's entries are sorted by where they
//!     │/────│──└──┘─│─────────         begin; those that overlap along x are neighbours in the order.
//!     /     └───────┘ strip 1
//!     └──────────────────────> x
//! ```
//!
//! Strips are numbered through all of space and kept in a fixed number of buckets, number modulo count: two
//! strips of one bucket cost a comparison, never a collision. All bounds are widened by more than the vertex
//! test can err, so no collision is missed.

use super::bounds::Range;
use super::sight::Sight;
use crate::bodies::Bodies;
use crate::work::Work;

/// The sweep's scratch; it allocates until it is warm and never after.
#[derive(Clone, Debug)]
pub struct Strips {
    /// Depth of a strip along Z \[m\], a power of two.
    depth: f64,
    /// Whose rectangle each is: the body of every rectangle of the world, and whether that is mobile.
    owner: Vec<Owner>,
    /// All rectangles, nearly in the order of their x_min: so the strips fill nearly sorted.
    order: Vec<u32>,
    /// Iterations until `order` is sorted afresh.
    fresh_for: u32,
    /// Where each rectangle is.
    bounds: Vec<Bounds>,
    /// Where each bucket's entries begin in `entries`; one more closes the last.
    begins: Vec<u32>,
    /// The buckets' entries, bucket after bucket.
    entries: Vec<Entry>,
    met: Met,
}

#[derive(Clone, Copy, Debug)]
struct Owner {
    body: u32,
    mobile: bool,
}

/// The bounds of a rectangle in the world, widened, and the strips it reaches into.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    x: Range,
    z: Range,
    first: i32,
    last: i32,
}

/// A rectangle in a strip.
#[derive(Clone, Copy, Debug)]
struct Entry {
    x: Range,
    z: Range,
    rect: u32,
    /// Whether pairs with it are to be shown in this strip whatever the partner says (see [`Strips::sweep`]).
    shows: bool,
}

/// A rectangle that reaches into this many strips is cut to the range of x it covers in each.
const LONG: i32 = 6;

/// Iterations between fresh sorts of `order`; in between, each strip mends its own order. A body passes few
/// neighbours in so many steps; the sorting's cost, shared among them, vanishes.
const FRESH_FOR: u32 = 16;

/// Rectangles per bucket, on average; fewer buckets alias more strips, more buckets cost more to walk through.
const PER_BUCKET: usize = 8;

impl Strips {
    /// An empty sweep with strips of that depth.
    #[must_use]
    pub fn new(depth: f64) -> Self {
        Strips {
            depth,
            owner: Vec::new(),
            order: Vec::new(),
            fresh_for: 0,
            bounds: Vec::new(),
            begins: Vec::new(),
            entries: Vec::new(),
            met: Met::new(),
        }
    }

    /// Shows every pair (i < j) of which two rectangles may touch; some more than once.
    pub(super) fn visit(
        &mut self,
        bodies: &Bodies,
        sight: &impl Sight,
        work: &mut Work,
        visit: impl FnMut(usize, usize, &mut Work),
    ) {
        if self.owner.len() != bodies.rects.len() {
            self.number_rectangles(bodies);
        }
        self.compute_bounds(bodies, sight);
        work.bounds += self.bounds.len() as u64;
        self.refresh_order();
        self.enter(bodies, sight);
        self.sweep(bodies, sight, work, visit);
    }

    fn number_rectangles(&mut self, bodies: &Bodies) {
        self.owner.clear();
        for body in 0..bodies.len() {
            let owner = Owner { body: body as u32, mobile: bodies.is_mobile(body) };
            self.owner.extend(bodies.rects_of(body).iter().map(|_| owner));
        }
        self.order = (0..self.owner.len() as u32).collect();
        self.fresh_for = 0;
        let buckets = (self.owner.len() / PER_BUCKET).next_power_of_two().max(64);
        self.begins = vec![0; buckets + 1];
    }

    fn compute_bounds(&mut self, bodies: &Bodies, sight: &impl Sight) {
        let per_depth = 1.0 / self.depth;
        self.bounds.clear();
        self.bounds.extend(self.owner.iter().enumerate().map(|(rect, owner)| {
            let (x, z) = sight.bounds(bodies, (owner.body as usize, rect as u32));
            let strip = |z: f32| floor(f64::from(z) * per_depth);
            Bounds { x, z, first: strip(z.min), last: strip(z.max) }
        }));
        self.cut_to_where_mobiles_are();
    }

    /// Fixed rectangles need no entry in strips without a mobile one: nothing there can collide.
    fn cut_to_where_mobiles_are(&mut self) {
        let (mut first, mut last) = (i32::MAX, i32::MIN);
        for (owner, bounds) in self.owner.iter().zip(&self.bounds) {
            if owner.mobile {
                first = first.min(bounds.first);
                last = last.max(bounds.last);
            }
        }
        for (owner, bounds) in self.owner.iter().zip(&mut self.bounds) {
            if !owner.mobile {
                bounds.first = bounds.first.max(first);
                bounds.last = bounds.last.min(last);
            }
        }
    }

    /// Sorts all rectangles by where they begin along x, once in a while.
    fn refresh_order(&mut self) {
        if self.fresh_for == 0 {
            let bounds = &self.bounds;
            let key = |rect: u32| bounds[rect as usize].x.min;
            self.order.sort_unstable_by(|a, b| key(*a).total_cmp(&key(*b)).then(a.cmp(b)));
            self.fresh_for = FRESH_FOR;
        }
        self.fresh_for -= 1;
    }

    /// Fills the buckets: counted first, then placed, then each put in order.
    fn enter(&mut self, bodies: &Bodies, sight: &impl Sight) {
        let mask = (self.begins.len() - 2) as u32;
        self.begins.fill(0);
        for bounds in &self.bounds {
            for strip in bounds.strips(mask) {
                self.begins[(strip as u32 & mask) as usize + 1] += 1;
            }
        }
        for bucket in 1..self.begins.len() {
            self.begins[bucket] += self.begins[bucket - 1];
        }
        let count = self.begins[self.begins.len() - 1] as usize;
        if count > self.entries.capacity() {
            self.entries.reserve_exact(count + count / 4 - self.entries.len()); // room to fluctuate in
        }
        self.entries.resize(count, Entry::NONE);
        for &rect in &self.order {
            let bounds = &self.bounds[rect as usize];
            for strip in bounds.strips(mask) {
                let bucket = (strip as u32 & mask) as usize;
                let slot = self.begins[bucket];
                self.begins[bucket] = slot + 1;
                self.entries[slot as usize] = self.entry(bodies, sight, rect, strip, mask);
            }
        }
        // Each bucket's begin now stands at its end, which is the next one's begin: move them up by one.
        self.begins.rotate_right(1);
        self.begins[0] = 0;
    }

    /// A rectangle's entry in one strip.
    fn entry(&self, bodies: &Bodies, sight: &impl Sight, rect: u32, strip: i32, mask: u32) -> Entry {
        let Bounds { x, z, first, last } = self.bounds[rect as usize];
        let entry = Entry { x, z, rect, shows: strip == first };
        let reach = last - first;
        if reach < LONG {
            return entry;
        }
        if reach as u32 > mask {
            return Entry { shows: true, ..entry }; // it stands in every bucket once, for many strips at a time
        }
        let of = (self.owner[rect as usize].body as usize, rect);
        let slab = (f64::from(strip) * self.depth, (f64::from(strip) + 1.0) * self.depth);
        match sight.within(bodies, of, slab) {
            Some(cut) => Entry { x: cut.common(x), shows: true, ..entry },
            None => Entry { shows: true, ..entry },
        }
    }
    /// Compares the entries of each strip that overlap along x.
    ///
    /// Two rectangles may share several strips; the pair is shown in the first that both reach into, which is
    /// the first strip of one of them. Entries cut to their strip may meet in any, and are shown in each.
    fn sweep(
        &mut self,
        bodies: &Bodies,
        sight: &impl Sight,
        work: &mut Work,
        mut visit: impl FnMut(usize, usize, &mut Work),
    ) {
        let Strips { begins, entries, owner, met, .. } = self;
        for bucket in begins.windows(2) {
            let strip = &mut entries[bucket[0] as usize..bucket[1] as usize];
            put_in_order(strip);
            for (k, a) in strip.iter().enumerate() {
                let mut rest = &strip[k + 1..];
                while !rest.is_empty() {
                    let (some, more) = rest.split_at(rest.len().min(AT_ONCE));
                    work.bounds_compared += some.len() as u64;
                    met.gather(a, some);
                    rest = if more.first().is_some_and(|b| b.x.min <= a.x.max) { more } else { &[] };
                }
                if met.is_full() {
                    show(bodies, sight, owner, met, work, &mut visit);
                }
            }
        }
        show(bodies, sight, owner, met, work, &mut visit);
    }
}

/// Neighbours compared at a time: most entries have fewer that overlap, so one look is enough.
const AT_ONCE: usize = 4;

/// Pairs gathered before they are looked at: the rectangles of many pairs are fetched at a time.
const BATCH: usize = 1024;

/// Pairs of rectangles whose bounds overlap, gathered a batch at a time.
#[derive(Clone, Debug)]
struct Met {
    pairs: Vec<(u32, u32)>,
    count: usize,
}

impl Met {
    /// Room for a batch and for one entry's neighbours beyond it.
    fn new() -> Self {
        Met { pairs: vec![(0, 0); BATCH + AT_ONCE], count: 0 }
    }

    fn is_full(&self) -> bool {
        self.count >= BATCH
    }

    /// Keeps those neighbours of an entry that overlap it, without a branch on which they are: that cannot be
    /// foreseen. Every pair is written, only those that overlap are counted.
    #[inline]
    fn gather(&mut self, a: &Entry, neighbours: &[Entry]) {
        if self.count + AT_ONCE > self.pairs.len() {
            self.pairs.resize(2 * self.pairs.len(), (0, 0));
        }
        for b in neighbours {
            let along_x = b.x.min <= a.x.max;
            let along_z = (b.z.min <= a.z.max) & (b.z.max >= a.z.min);
            self.pairs[self.count] = (a.rect, b.rect);
            self.count += usize::from(along_x & along_z & (a.shows | b.shows));
        }
    }
}

/// Shows those pairs of rectangles that may collide and are not certainly apart.
#[inline]
fn show(
    bodies: &Bodies,
    sight: &impl Sight,
    owner: &[Owner],
    met: &mut Met,
    work: &mut Work,
    visit: &mut impl FnMut(usize, usize, &mut Work),
) {
    for &(a, b) in &met.pairs[..core::mem::take(&mut met.count)] {
        let (one, two) = (owner[a as usize], owner[b as usize]);
        let (i, j) = (one.body as usize, two.body as usize);
        if i != j && (one.mobile || two.mobile) && sight.may_touch(bodies, (i, a), (j, b)) {
            visit(i.min(j), i.max(j), work);
        }
    }
}

impl Bounds {
    /// The strips it has entries in; no more than there are buckets.
    #[inline]
    fn strips(&self, mask: u32) -> core::ops::Range<i32> {
        let last = self.last.min(self.first + mask as i32);
        self.first..last + 1
    }
}

impl Entry {
    const NONE: Entry =
        Entry { x: Range { min: 0.0, max: 0.0 }, z: Range { min: 0.0, max: 0.0 }, rect: 0, shows: false };

    /// The one order of a strip: by x_min, then by rectangle.
    #[inline]
    fn comes_before(&self, other: &Entry) -> bool {
        self.x.min < other.x.min || (self.x.min == other.x.min && self.rect < other.rect)
    }
}

/// Sorts a strip that is nearly sorted already; one that is not after all is sorted from scratch.
fn put_in_order(strip: &mut [Entry]) {
    let mut patience = 8 * strip.len();
    for k in 1..strip.len() {
        let entry = strip[k];
        let mut at = k;
        while at > 0 && entry.comes_before(&strip[at - 1]) {
            strip[at] = strip[at - 1];
            at -= 1;
        }
        strip[at] = entry;
        if k - at > patience {
            strip.sort_unstable_by(|a, b| a.x.min.total_cmp(&b.x.min).then(a.rect.cmp(&b.rect)));
            return;
        }
        patience -= k - at;
    }
}

/// ⌊x⌋ as a whole number; far out it stays at the ends of a range wide enough for any number of strips.
#[inline]
fn floor(x: f64) -> i32 {
    let towards_zero = x.clamp(-1e9, 1e9) as i32;
    if f64::from(towards_zero) > x { towards_zero - 1 } else { towards_zero }
}
