//! Who may be met within a segment: a grid of cells over which the swept bounds of all rectangles are spread.
//!
//! Built at the first impact of a segment (a segment without one does without it), and only added to: a body that flies
//! otherwise after an impact is entered where it goes now, its old entries stay and cost a comparison.

use crate::area::Vec2;
use crate::bodies::Bodies;

/// Swept bounds in the world \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: Vec2,
    pub(super) high: Vec2,
}

impl Bounds {
    fn overlap(&self, other: &Bounds) -> bool {
        (self.low.x <= other.high.x)
            & (other.low.x <= self.high.x)
            & (self.low.y <= other.high.y)
            & (other.low.y <= self.high.y)
    }
}

/// The grid; it allocates until it is warm and never after.
#[derive(Clone, Debug)]
pub(super) struct Neighbours {
    /// Side of a cell \[m\].
    cell: f64,
    /// The newest entry of each bucket of cells; `NONE` where there is none.
    newest: Vec<u32>,
    /// Entries: a body, and the entry before it in its bucket.
    entries: Vec<(u32, u32)>,
    /// Bodies spread over too many cells: everybody's neighbours.
    large: Vec<u32>,
    /// Where each body can be until the segment's end.
    bounds: Vec<Bounds>,
    /// In which query each body was last met.
    met: Vec<u32>,
    query: u32,
    is_built: bool,
}

const NONE: u32 = u32::MAX;

/// A body over more cells than this is everybody's neighbour.
const MANY_CELLS: f64 = 64.0;

impl Neighbours {
    pub(super) fn new(cell: f64, bodies: usize) -> Self {
        let buckets = (2 * bodies).next_power_of_two().max(64);
        let nowhere = Bounds { low: Vec2::zeros(), high: Vec2::zeros() };
        Neighbours {
            cell,
            newest: vec![NONE; buckets],
            entries: Vec::new(),
            large: Vec::new(),
            bounds: vec![nowhere; bodies],
            met: vec![0; bodies],
            query: 0,
            is_built: false,
        }
    }

    /// A new segment: nothing is known.
    pub(super) fn forget(&mut self) {
        self.is_built = false;
    }

    /// Enters every collidable body, unless that is done.
    pub(super) fn build(&mut self, bodies: &Bodies, bounds_of: impl Fn(usize) -> Bounds) {
        if self.is_built {
            return;
        }
        self.is_built = true;
        self.newest.fill(NONE);
        self.entries.clear();
        self.large.clear();
        for body in (0..bodies.len()).filter(|body| !bodies.rects_of(*body).is_empty()) {
            self.enter(body, bounds_of(body));
        }
    }

    /// Where a body can be from now to the segment's end.
    pub(super) fn enter(&mut self, body: usize, bounds: Bounds) {
        self.bounds[body] = bounds;
        let (low, high) = self.cells(&bounds);
        let cells = (high.0 - low.0 + 1.0) * (high.1 - low.1 + 1.0);
        if cells <= MANY_CELLS {
            for x in low.0 as i64..=high.0 as i64 {
                for z in low.1 as i64..=high.1 as i64 {
                    let bucket = self.bucket(x, z);
                    self.entries.push((body as u32, self.newest[bucket]));
                    self.newest[bucket] = (self.entries.len() - 1) as u32;
                }
            }
        } else if !self.large.contains(&(body as u32)) {
            self.large.push(body as u32);
        }
    }

    /// Collects the bodies that can meet one, into `found`, in order of creation; large ones are shown to all.
    pub(super) fn of(&mut self, body: usize, bodies: &Bodies, found: &mut Vec<u32>) {
        found.clear();
        self.query = self.query.wrapping_add(1);
        self.met[body] = self.query;
        let bounds = self.bounds[body];
        let (low, high) = self.cells(&bounds);
        let cells = (high.0 - low.0 + 1.0) * (high.1 - low.1 + 1.0);
        if cells > MANY_CELLS {
            let all = (0..bodies.len()).filter(|other| *other != body && !bodies.rects_of(*other).is_empty());
            found.extend(all.filter(|other| self.bounds[*other].overlap(&bounds)).map(|other| other as u32));
            return;
        }
        for x in low.0 as i64..=high.0 as i64 {
            for z in low.1 as i64..=high.1 as i64 {
                let mut at = self.newest[self.bucket(x, z)];
                while at != NONE {
                    let (other, before) = self.entries[at as usize];
                    if self.met[other as usize] != self.query {
                        self.met[other as usize] = self.query;
                        if self.bounds[other as usize].overlap(&bounds) {
                            found.push(other);
                        }
                    }
                    at = before;
                }
            }
        }
        for &other in &self.large {
            if self.met[other as usize] != self.query && self.bounds[other as usize].overlap(&bounds) {
                found.push(other);
            }
        }
        found.sort_unstable();
    }

    /// The first and last cell of bounds, along x and z.
    fn cells(&self, bounds: &Bounds) -> ((f64, f64), (f64, f64)) {
        let cell = |p: f64| libm::floor((p / self.cell).clamp(-1e15, 1e15));
        ((cell(bounds.low.x), cell(bounds.low.y)), (cell(bounds.high.x), cell(bounds.high.y)))
    }

    fn bucket(&self, x: i64, z: i64) -> usize {
        let mixed = (x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (z as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
        (mixed >> 20) as usize & (self.newest.len() - 1)
    }
}
