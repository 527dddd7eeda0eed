//! The blocks that still take touches, and in which of them a body's row stands.

/// So many blocks are open at a time.
const OPEN: u32 = 16;

/// In which blocks a row stands: a bit for each that was open when it was last put into one, from the first of them on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    first: u32,
    blocks: u32,
}

impl Standing {
    pub(super) const NOWHERE: Standing = Standing { first: 0, blocks: 0 };

    /// The same with another block as the first; a row that stands in none from that on stands in one that is closed.
    pub(super) fn from(self, first: u32) -> u32 {
        self.blocks.unbounded_shr(first - self.first)
    }

    pub(super) fn anywhere(self) -> bool {
        self.blocks != 0
    }

    /// Puts the row into one of the blocks that are open, from the first of them on.
    pub(super) fn put(&mut self, first: u32, at: u32) {
        *self = Standing { first, blocks: self.from(first) | 1 << at };
    }
}

/// The blocks that are open: the first, and a bit for each that is full.
pub(super) struct Open {
    pub(super) first: u32,
    full: u32,
}

impl Open {
    /// Nothing is open yet; the next block is the first.
    pub(super) fn from(first: u32) -> Self {
        Open { first, full: 0 }
    }

    /// Takes room beside rows that stand in those of the open blocks: in which of them. The first is closed where there is none.
    pub(super) fn take(&mut self, standing: u32) -> u32 {
        let at = (self.full | standing).trailing_ones();
        if at < OPEN {
            return at;
        }
        self.first += 1;
        self.full >>= 1;
        OPEN - 1
    }

    /// One of them is full.
    pub(super) fn fill(&mut self, at: u32) {
        self.full |= 1 << at;
        let closed = self.full.trailing_ones();
        self.first += closed;
        self.full >>= closed;
    }
}
