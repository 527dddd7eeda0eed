//! Pairs of anything linked by their ends: touches by the rows of their bodies, pairs that stay apart by their bodies.

const NONE: u32 = u32::MAX;

/// Each end's pairs, linked, the last first.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    /// By end, and by pair and side: twice a pair, plus one on the second side.
    last: Vec<u32>,
    before: Vec<[u32; 2]>,
}

impl Links {
    pub(super) fn clear(&mut self) {
        self.last.clear();
        self.before.clear();
    }

    /// Links those pairs that have come since, of so many ends.
    pub(super) fn go_on(&mut self, pairs: impl Iterator<Item = (u32, u32)>, ends: usize) {
        self.last.resize(ends, NONE);
        for (k, (a, b)) in pairs.enumerate().skip(self.before.len()) {
            let mut before = [NONE; 2];
            for (side, end) in [a, b].into_iter().enumerate() {
                before[side] = core::mem::replace(&mut self.last[end as usize], (2 * k + side) as u32);
            }
            self.before.push(before);
        }
    }

    /// The last link of an end that has any; and the one before a link. A link is twice its pair, plus one on the second side.
    pub(super) fn last(&self, end: usize) -> Option<u32> {
        self.last.get(end).copied().filter(|link| *link != NONE)
    }

    pub(super) fn before(&self, link: u32) -> Option<u32> {
        Some(self.before[(link / 2) as usize][(link % 2) as usize]).filter(|link| *link != NONE)
    }

    /// An end's pairs.
    pub(super) fn of(&self, end: usize) -> impl Iterator<Item = usize> {
        core::iter::successors(self.last(end), |link| self.before(*link)).map(|link| (link / 2) as usize)
    }
}
