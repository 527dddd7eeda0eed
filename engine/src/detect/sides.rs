//! From which side two rectangles came together, remembered for as long as they overlap.
//!
//! The least overlap is the right way apart only while it is small. A body that a step has carried past the middle of a thin
//! wall would leave on the far side; so the side is decided where it is known: from where both stood an iteration before, when
//! they were apart. While they go on overlapping they part the same way.

use crate::area::Vec2;

/// A normal at less than about 45° to the remembered one leads the same way \[cosine\].
pub(crate) const ALONG: f64 = 0.7;

/// Two rectangles, by their indices among all, and the normal from the first to the second across which they came.
type Came = (u32, u32, Vec2);

/// The sides of all overlaps of this iteration and of the last. Only the complete test in stepped motion has any.
#[derive(Clone, Debug, Default)]
pub struct Sides {
    before: Vec<Came>,
    now: Vec<Came>,
}

impl Sides {
    /// A new iteration begins.
    pub(crate) fn begin(&mut self) {
        core::mem::swap(&mut self.before, &mut self.now);
        self.now.clear();
    }

    /// The overlaps of this iteration have all been noted, in any order, some more than once.
    pub(crate) fn listed(&mut self) {
        self.now.sort_unstable_by_key(|(i, j, _)| (*i, *j));
        self.now.dedup_by_key(|(i, j, _)| (*i, *j));
    }

    /// Two rectangles overlap; from which side they came, where that is known.
    pub(super) fn note(&mut self, i: usize, j: usize, came: Option<Vec2>) {
        self.now.extend(came.map(|normal| (i as u32, j as u32, normal)));
    }

    /// How two rectangles came that overlap in this iteration.
    pub(super) fn of(&self, i: usize, j: usize) -> Option<Vec2> {
        find(&self.now, i, j)
    }

    /// How they came according to the last iteration.
    pub(super) fn before(&self, i: usize, j: usize) -> Option<Vec2> {
        find(&self.before, i, j)
    }

    /// What decides how the world goes on, for its digest.
    pub(crate) fn words(&self) -> impl Iterator<Item = u64> {
        self.now.iter().flat_map(|(i, j, n)| [u64::from(*i) << 32 | u64::from(*j), n.x.to_bits(), n.y.to_bits()])
    }
}

fn find(all: &[Came], i: usize, j: usize) -> Option<Vec2> {
    let at = all.binary_search_by_key(&(i as u32, j as u32), |(i, j, _)| (*i, *j)).ok()?;
    Some(all[at].2)
}
