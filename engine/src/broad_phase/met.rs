//! Bounds of rectangles, whose they are, and pairs of them that meet.

/// Least and greatest coordinates: x from, z from, x to, z to \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds(pub(crate) [f64; 4]);

impl Bounds {
    /// Bounds of nothing: others put to them remain as they are.
    pub(crate) const NOTHING: Bounds = Bounds([f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY]);

    /// Whether they have anything in common; touching counts.
    #[inline(always)]
    pub(crate) fn meet(&self, other: &Bounds) -> bool {
        let ([x0, z0, x1, z1], [other_x0, other_z0, other_x1, other_z1]) = (self.0, other.0);
        (x0 <= other_x1) & (other_x0 <= x1) & (z0 <= other_z1) & (other_z0 <= z1)
    }

    /// Whether the others lie within them.
    pub(crate) fn contain(&self, other: &Bounds) -> bool {
        let ([x0, z0, x1, z1], [other_x0, other_z0, other_x1, other_z1]) = (self.0, other.0);
        (x0 <= other_x0) & (other_x1 <= x1) & (z0 <= other_z0) & (other_z1 <= z1)
    }

    /// Bounds of both.
    pub(crate) fn and(self, other: Bounds) -> Bounds {
        let ([x0, z0, x1, z1], [other_x0, other_z0, other_x1, other_z1]) = (self.0, other.0);
        Bounds([x0.min(other_x0), z0.min(other_z0), x1.max(other_x1), z1.max(other_z1)])
    }

    /// The greater of width and depth.
    #[inline(always)]
    pub(super) fn size(&self) -> f64 {
        let [x0, z0, x1, z1] = self.0;
        (x1 - x0).max(z1 - z0)
    }
}

/// Whose bounds they are: the body, whether it may have moved since pairs were last looked for, and whether it is mobile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Owner(u32);

/// The two highest bits: that both are set between two is one comparison.
const MOBILE: u32 = 1 << 31;
const MOVES: u32 = 1 << 30;
const BODY: u32 = MOVES - 1;

impl Owner {
    /// One that may have moved.
    pub(crate) fn new(body: usize, is_mobile: bool) -> Self {
        Owner(body as u32 | MOVES | if is_mobile { MOBILE } else { 0 })
    }

    /// The same, lying still or not.
    pub(crate) fn lying(self, lies: bool) -> Self {
        Owner(if lies { self.0 & !MOVES } else { self.0 | MOVES })
    }

    #[inline(always)]
    pub(crate) fn body(self) -> usize {
        (self.0 & BODY) as usize
    }

    #[inline(always)]
    pub(crate) fn is_mobile(self) -> bool {
        self.0 & MOBILE != 0
    }

    #[inline(always)]
    pub(crate) fn moves(self) -> bool {
        self.0 & MOVES != 0
    }

    /// Whether the two can collide, and not as they could before: different bodies, one of them mobile, and one that may have moved.
    #[inline(always)]
    pub(crate) fn can_meet(self, other: Owner) -> bool {
        ((self.0 ^ other.0) & BODY != 0) & ((self.0 | other.0) >= (MOBILE | MOVES))
    }
}

/// Bounds in their place, with what is to be known of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) bounds: Bounds,
    pub(super) index: u32,
    pub(super) owner: Owner,
}

/// Pairs of bounds that meet, by their indices.
#[derive(Clone, Debug, Default)]
pub(crate) struct Met {
    pairs: Vec<(u32, u32)>,
    count: usize,
}

impl Met {
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// The pairs gathered since they were last looked for, in no order.
    pub(crate) fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs[..self.count]
    }

    /// Keeps those of some entries that meet one, without a branch on which they are: that cannot be foreseen. Every pair is
    /// written, only those that meet are counted.
    #[inline(always)]
    pub(super) fn gather(&mut self, one: &Entry, some: &[Entry]) {
        if self.count + some.len() > self.pairs.len() {
            self.pairs.resize((self.count + some.len()).max(2 * self.pairs.len()), (0, 0));
        }
        for two in some {
            self.pairs[self.count] = (one.index.min(two.index), one.index.max(two.index));
            self.count += usize::from(one.bounds.meet(&two.bounds) & one.owner.can_meet(two.owner));
        }
    }
}
