//! The touches of each body, by its row.

const NONE: u32 = u32::MAX;

/// Each row's touches, linked, the last first.
#[derive(Clone, Debug, Default)]
pub(super) struct ByRow {
    /// By row, and by touch and side: twice a touch, plus one on the second side.
    last: Vec<u32>,
    before: Vec<[u32; 2]>,
}

impl ByRow {
    pub(super) fn clear(&mut self) {
        self.last.clear();
        self.before.clear();
    }

    /// Links those touches that have come since.
    pub(super) fn go_on(&mut self, of_touch: &[(u32, u32)], rows: usize) {
        self.last.resize(rows, NONE);
        for (k, (a, b)) in of_touch.iter().enumerate().skip(self.before.len()) {
            let mut before = [NONE; 2];
            for (side, row) in [*a, *b].into_iter().enumerate() {
                before[side] = core::mem::replace(&mut self.last[row as usize], (2 * k + side) as u32);
            }
            self.before.push(before);
        }
    }

    /// A row's touches.
    pub(super) fn of(&self, row: u32) -> impl Iterator<Item = usize> {
        let known = |at: u32| (at != NONE).then_some(at);
        let first = self.last.get(row as usize).copied().and_then(known);
        let next = move |at: &u32| known(self.before[(at / 2) as usize][(at % 2) as usize]);
        core::iter::successors(first, next).map(|at| (at / 2) as usize)
    }
}
