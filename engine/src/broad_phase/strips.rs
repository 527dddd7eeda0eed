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

use super::can_collide;
use crate::area::{Rect, Vec2};
use crate::bodies::Bodies;
use crate::detect::overlap;
use crate::frame::Frame;
use crate::work::Work;

/// The sweep's scratch; it allocates until it is warm and never after.
#[derive(Clone, Debug)]
pub struct Strips {
    /// Depth of a strip along Z \[m\], a power of two.
    depth: f64,
    /// Whose rectangle each is: the body of every rectangle of the world.
    body_of: Vec<u32>,
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
}

/// The bounds of a rectangle in the world, widened, and the strips it reaches into.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    x: (f64, f64),
    z: (f64, f64),
    first: i64,
    last: i64,
}

/// A rectangle in a strip.
#[derive(Clone, Copy, Debug)]
struct Entry {
    x_min: f64,
    x_max: f64,
    z_min: f64,
    z_max: f64,
    rect: u32,
    /// Whether pairs with it are to be shown in this strip whatever the partner says (see [`Strips::sweep`]).
    shows: bool,
}

/// How far bounds are widened, relative to the coordinates they come from: the vertex test errs by a few
/// roundings (1e-16 each), never by this much.
const WIDENING: f64 = 1e-13;

/// A rectangle that reaches into this many strips is cut to the range of x it covers in each.
const LONG: i64 = 6;

/// Iterations between fresh sorts of `order`; in between, each strip mends its own order. A body passes few
/// neighbours in so many steps; the sorting's cost, shared among them, vanishes.
const FRESH_FOR: u32 = 16;

impl Strips {
    /// An empty sweep with strips of that depth.
    #[must_use]
    pub fn new(depth: f64) -> Self {
        Strips {
            depth,
            body_of: Vec::new(),
            order: Vec::new(),
            fresh_for: 0,
            bounds: Vec::new(),
            begins: Vec::new(),
            entries: Vec::new(),
        }
    }

    /// Shows every pair (i < j) of which two rectangles are not certainly apart; some more than once.
    pub fn visit(&mut self, bodies: &Bodies, work: &mut Work, visit: impl FnMut(usize, usize, &mut Work)) {
        if self.body_of.len() != bodies.rects.len() {
            self.number_rectangles(bodies);
        }
        self.compute_bounds(bodies);
        work.bounds += self.bounds.len() as u64;
        self.refresh_order();
        self.enter(bodies);
        self.sweep(bodies, work, visit);
    }

    fn number_rectangles(&mut self, bodies: &Bodies) {
        self.body_of.clear();
        for body in 0..bodies.len() {
            self.body_of.extend(bodies.rects_of(body).iter().map(|_| body as u32));
        }
        self.order = (0..self.body_of.len() as u32).collect();
        self.fresh_for = 0;
        let buckets = self.body_of.len().next_power_of_two().max(64);
        self.begins = vec![0; buckets + 1];
    }

    fn compute_bounds(&mut self, bodies: &Bodies) {
        let per_depth = 1.0 / self.depth;
        self.bounds.clear();
        self.bounds.extend(self.body_of.iter().zip(&bodies.rects).map(|(&body, rect)| {
            let (x, z) = bounds(&bodies.frame[body as usize], rect);
            Bounds { x, z, first: floor(z.0 * per_depth), last: floor(z.1 * per_depth) }
        }));
        self.cut_to_where_mobiles_are(bodies);
    }

    /// Fixed rectangles need no entry in strips without a mobile one: nothing there can collide.
    fn cut_to_where_mobiles_are(&mut self, bodies: &Bodies) {
        let is_mobile = |body: &u32| bodies.is_mobile(*body as usize);
        let mobile = self.body_of.iter().zip(&self.bounds).filter(|(body, _)| is_mobile(body));
        let (first, last) =
            mobile.fold((i64::MAX, i64::MIN), |(first, last), (_, b)| (first.min(b.first), last.max(b.last)));
        for (body, bounds) in self.body_of.iter().zip(&mut self.bounds) {
            if !is_mobile(body) {
                bounds.first = bounds.first.max(first);
                bounds.last = bounds.last.min(last);
            }
        }
    }

    /// Sorts all rectangles by where they begin along x, once in a while.
    fn refresh_order(&mut self) {
        if self.fresh_for == 0 {
            let bounds = &self.bounds;
            let key = |rect: u32| bounds[rect as usize].x.0;
            self.order.sort_unstable_by(|a, b| key(*a).total_cmp(&key(*b)).then(a.cmp(b)));
            self.fresh_for = FRESH_FOR;
        }
        self.fresh_for -= 1;
    }

    /// Fills the buckets: counted first, then placed, then each put in order.
    fn enter(&mut self, bodies: &Bodies) {
        let mask = (self.begins.len() - 2) as u64;
        self.begins.fill(0);
        for bounds in &self.bounds {
            for strip in bounds.strips(mask) {
                self.begins[(strip as u64 & mask) as usize + 1] += 1;
            }
        }
        for bucket in 1..self.begins.len() {
            self.begins[bucket] += self.begins[bucket - 1];
        }
        let count = self.begins[self.begins.len() - 1] as usize;
        self.entries.resize(count, Entry::NONE);
        for &rect in &self.order {
            let bounds = &self.bounds[rect as usize];
            for strip in bounds.strips(mask) {
                let bucket = (strip as u64 & mask) as usize;
                let slot = self.begins[bucket];
                self.begins[bucket] = slot + 1;
                self.entries[slot as usize] = self.entry(bodies, rect, strip, mask);
            }
        }
        // Each bucket's begin now stands at its end, which is the next one's begin: move them up by one.
        self.begins.rotate_right(1);
        self.begins[0] = 0;
    }

    /// A rectangle's entry in one strip.
    fn entry(&self, bodies: &Bodies, rect: u32, strip: i64, mask: u64) -> Entry {
        let Bounds { x, z, first, last } = self.bounds[rect as usize];
        let entry = Entry { x_min: x.0, x_max: x.1, z_min: z.0, z_max: z.1, rect, shows: strip == first };
        let reach = last.saturating_sub(first);
        if reach < LONG {
            return entry;
        }
        if reach as u64 > mask {
            return Entry { shows: true, ..entry }; // it stands in every bucket once, for many strips at a time
        }
        let frame = &bodies.frame[self.body_of[rect as usize] as usize];
        let slab = (strip as f64 * self.depth, (strip as f64 + 1.0) * self.depth);
        match range_within(frame, &bodies.rects[rect as usize], slab) {
            Some((x_min, x_max)) => Entry { x_min: x_min.max(x.0), x_max: x_max.min(x.1), shows: true, ..entry },
            None => Entry { shows: true, ..entry },
        }
    }
    /// Compares the entries of each strip that overlap along x.
    ///
    /// Two rectangles may share several strips; the pair is shown in the first that both reach into, which is
    /// the first strip of one of them. Entries cut to their strip may meet in any, and are shown in each.
    fn sweep(&mut self, bodies: &Bodies, work: &mut Work, mut visit: impl FnMut(usize, usize, &mut Work)) {
        let Strips { begins, entries, body_of, .. } = self;
        let mut compared = 0;
        for bucket in begins.windows(2) {
            let strip = &mut entries[bucket[0] as usize..bucket[1] as usize];
            put_in_order(strip);
            for (k, a) in strip.iter().enumerate() {
                for b in strip[k + 1..].iter().take_while(|b| b.x_min <= a.x_max) {
                    compared += 1;
                    let beside = b.z_min > a.z_max || b.z_max < a.z_min;
                    if beside || !(a.shows || b.shows) {
                        continue;
                    }
                    let (i, j) = (body_of[a.rect as usize] as usize, body_of[b.rect as usize] as usize);
                    if i != j && can_collide(bodies, i, j) && may_touch(bodies, (i, a.rect), (j, b.rect)) {
                        visit(i.min(j), i.max(j), work);
                    }
                }
            }
        }
        work.bounds_compared += compared;
    }
}

impl Bounds {
    /// The strips it has entries in; no more than there are buckets.
    #[inline]
    fn strips(&self, mask: u64) -> impl Iterator<Item = i64> + use<> {
        let first = self.first;
        let more = self.last.saturating_sub(first).min(mask as i64);
        (0..=more).map(move |k| first + k)
    }
}

impl Entry {
    const NONE: Entry = Entry { x_min: 0.0, x_max: 0.0, z_min: 0.0, z_max: 0.0, rect: 0, shows: false };

    /// The one order of a strip: by x_min, then by rectangle.
    #[inline]
    fn comes_before(&self, other: &Entry) -> bool {
        self.x_min < other.x_min || (self.x_min == other.x_min && self.rect < other.rect)
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
            strip.sort_unstable_by(|a, b| a.x_min.total_cmp(&b.x_min).then(a.rect.cmp(&b.rect)));
            return;
        }
        patience -= k - at;
    }
}

#[inline]
fn may_touch(bodies: &Bodies, (i, rect_i): (usize, u32), (j, rect_j): (usize, u32)) -> bool {
    let (a, b) = (&bodies.rects[rect_i as usize], &bodies.rects[rect_j as usize]);
    !overlap::certainly_apart(&bodies.frame[i], a, &bodies.frame[j], b)
}

/// The widened bounds of a rectangle in the world: its ranges of x and of z.
#[inline]
fn bounds(frame: &Frame, rect: &Rect) -> ((f64, f64), (f64, f64)) {
    let (centre, half) = (frame.place(rect.centre()), rect.half());
    let (cos, sin) = (frame.cos.abs(), frame.sin.abs());
    let widening = widening(frame, rect);
    let reach_x = cos * half.x + sin * half.y + widening;
    let reach_z = sin * half.x + cos * half.y + widening;
    ((centre.x - reach_x, centre.x + reach_x), (centre.y - reach_z, centre.y + reach_z))
}

/// By how much bounds may be wrong, many times over.
#[inline]
fn widening(frame: &Frame, rect: &Rect) -> f64 {
    let sizes = rect.x_min.abs() + rect.x_max.abs() + rect.z_min.abs() + rect.z_max.abs();
    WIDENING * (frame.o.x.abs() + frame.o.y.abs() + sizes)
}

/// The range of x that a rectangle covers between two values of z, widened; `None` where it has none.
fn range_within(frame: &Frame, rect: &Rect, slab: (f64, f64)) -> Option<(f64, f64)> {
    let widening = widening(frame, rect);
    let (low, high) = (slab.0 - widening, slab.1 + widening);
    let corners = rect.vertices().map(|vertex| frame.place(vertex));
    let mut range: Option<(f64, f64)> = None;
    for k in 0..4 {
        if let Some((p, q)) = cut(corners[k], corners[(k + 1) % 4], low, high) {
            let (least, greatest) = range.unwrap_or((p, p));
            range = Some((least.min(p).min(q), greatest.max(p).max(q)));
        }
    }
    // An edge cut at a shallow angle errs by more than a rounding; a thousandth of the depth is ample and cheap.
    let slack = widening + 1e-3 * (slab.1 - slab.0);
    range.map(|(least, greatest)| (least - slack, greatest + slack))
}

/// The x at both ends of what an edge has between two values of z.
fn cut(from: Vec2, to: Vec2, low: f64, high: f64) -> Option<(f64, f64)> {
    let (from, to) = if from.y <= to.y { (from, to) } else { (to, from) };
    if to.y < low || from.y > high {
        return None;
    }
    let rise = to.y - from.y;
    let x_at = |z: f64| if rise > 0.0 { from.x + (to.x - from.x) * ((z - from.y) / rise) } else { from.x };
    let start = if from.y < low { x_at(low) } else { from.x };
    let end = if to.y > high { x_at(high) } else { to.x };
    Some((start, end))
}

/// ⌊x⌋ as a whole number; far out it stays at the ends of the range.
#[inline]
fn floor(x: f64) -> i64 {
    let towards_zero = x as i64;
    if (towards_zero as f64) > x { towards_zero.saturating_sub(1) } else { towards_zero }
}
