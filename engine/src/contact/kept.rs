//! What touches push and how bodies move, laid aside and taken back. It keeps its room, so that a step allocates nothing.

use super::blocks::Block;
use super::rows::Row;
use crate::bodies::Motion;
use crate::lanes::Eight;

#[derive(Clone, Debug, Default)]
pub(super) struct Kept {
    pub(super) pushes: Vec<[Eight; 3]>,
    pub(super) motions: Vec<Motion>,
}

impl Kept {
    pub(super) fn keep(&mut self, rows: &[Row], blocks: &[Block]) {
        self.motions.clear();
        self.motions.extend(rows.iter().map(Row::motion));
        self.pushes.clear();
        self.pushes.extend(blocks.iter().map(Block::pushes));
    }

    /// Gives motions back, and pushes for those that there are by now.
    pub(super) fn exchange(&mut self, rows: &mut [Row], blocks: &mut [Block]) {
        for (block, kept) in blocks.iter_mut().zip(&mut self.pushes) {
            let now = block.pushes();
            block.set_pushes(*kept);
            *kept = now;
        }
        rows.iter_mut().zip(&self.motions).for_each(|(row, kept)| row.set_motion(*kept));
    }

    pub(super) fn give_back(&self, rows: &mut [Row], blocks: &mut [Block]) {
        rows.iter_mut().zip(&self.motions).for_each(|(row, kept)| row.set_motion(*kept));
        blocks.iter_mut().zip(&self.pushes).for_each(|(block, kept)| block.set_pushes(*kept));
    }
}
