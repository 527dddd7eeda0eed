//! Touches in blocks of eight that share no body, ready to be solved side by side.
//!
//! Touches are laid out in their own order, each in the first of the blocks that are still open which has room and none of its
//! bodies. So it makes no difference which touch of a block is solved first, nor how many at once; and what lies close together
//! in a heap, its touches mostly close in the list, is solved soon after each other: in one sweep pushes come far. Blocks of one
//! colour after the other, each colour from all over the heap, left a tumbling heap a quarter deeper in itself.

use super::open::{Open, Standing};
use super::rows::{IDLE, Rows, TURN, X, Z};
use super::touch::{FAR, Touch};
use crate::area::Vec2;
use crate::lanes::{Eight, LANES};

/// Eight touches, a lane each.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Block {
    pub(super) row_a: [u32; LANES],
    pub(super) row_b: [u32; LANES],
    pub(super) nx: Eight,
    pub(super) nz: Eight,
    pub(super) lever_a: [Eight; 2],
    pub(super) lever_b: [Eight; 2],
    pub(super) along_a: Eight,
    pub(super) along_b: Eight,
    pub(super) friction: Eight,
    pub(super) gap: [Eight; 2],
    /// How deep the points may still be in each other at the end of the step, as −depth \[m\].
    pub(super) least: [Eight; 2],
    pub(super) slip_back: Eight,
    pub(super) slip_on: Eight,
    pub(super) push: [Eight; 2],
    pub(super) grip: Eight,
    /// How fast each point is to part at least by the end of the sub-step \[m/s\].
    pub(super) asked: [Eight; 2],
}

/// What more there is to a block of which the touches are taken as they are midway through the sub-step ([`super::midway`]).
#[derive(Clone, Copy, Debug)]
pub(super) struct Turned {
    /// How fast the owner slips along t by its end where friction holds it, for its point turns with it \[m/s\].
    pub(super) slips: Eight,
    /// 1 where a point is no corner of the owner's, else 0.
    pub(super) cut: [Eight; 2],
}

impl Turned {
    const NOT: Turned = Turned { slips: Eight::ZERO, cut: [Eight::ZERO; 2] };
}

/// All blocks of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    pub(super) blocks: Vec<Block>,
    /// As many, or none where nothing is turned.
    pub(super) turned: Vec<Turned>,
    /// The block and lane of each touch; `NOWHERE` of those that are left to impacts.
    pub(super) place: Vec<(u32, u8)>,
    /// How many touches are laid out.
    pub(super) count: usize,
    /// How many lanes of each are used, of those laid out at first.
    used: Vec<u8>,
    /// In which of the open blocks each row stands; and the rows of mobile bodies that stand in any block, each once.
    standing: Vec<Standing>,
    rows: Vec<u32>,
    /// How far the bodies of those rows had come, in their order, when the sub-step began: x, z, turn.
    stood: Vec<[f64; 3]>,
    /// How many lanes of the last block are used, if it is one of those that came later.
    more: Option<usize>,
}

/// The place of a touch that is not laid out.
pub(super) const NOWHERE: (u32, u8) = (u32::MAX, 0);

impl Blocks {
    /// Lays the touches out, with the rows of their bodies; but for those that are `left` out, which are in order. Those that did not
    /// press a step ago may have blocks of their own, before the others: most of them do nothing, and blocks of such are soon done.
    pub(super) fn fill(
        &mut self,
        (touches, of_touch): (&[Touch], &[(u32, u32)]),
        left: &[u32],
        rows: &Rows,
        (keep, band): (f64, f64),
        sorts: bool,
    ) {
        self.count = touches.len() - left.len();
        self.more = None;
        self.blocks.clear();
        self.turned.clear();
        self.place.clear();
        self.used.clear();
        self.standing.clear();
        self.standing.resize(rows.rows.len(), Standing::NOWHERE);
        self.rows.clear();
        self.stood.clear();
        self.place.resize(touches.len(), NOWHERE);
        let passes: &[bool] = if sorts { &[false, true] } else { &[true] };
        for &presses in passes {
            let mut open = Open::from(self.blocks.len() as u32);
            let mut left = left.iter().peekable();
            for (k, (touch, &(a, b))) in touches.iter().zip(of_touch).enumerate() {
                let is_left = left.next_if(|next| **next as usize == k).is_some();
                if is_left || presses != (!sorts || touch.push[0] + touch.push[1] > 0.0) {
                    continue;
                }
                let (block, lane) = self.take_lane(&mut open, rows, [a, b]);
                self.blocks[block as usize].set(lane as usize, touch, (a, b), keep, band);
                self.place[k] = (block, lane);
            }
        }
    }

    /// The block and lane for a touch of those rows.
    fn take_lane(&mut self, open: &mut Open, rows: &Rows, pair: [u32; 2]) -> (u32, u8) {
        let mobile = pair.map(|row| rows.mobile_of(row).map(|_| row as usize));
        let standing = mobile.iter().flatten().fold(0, |all, row| all | self.standing[*row].from(open.first));
        let at = open.take(standing);
        for row in mobile.into_iter().flatten() {
            let standing = &mut self.standing[row];
            if !standing.anywhere() {
                self.rows.push(row as u32);
            }
            standing.put(open.first, at);
        }
        let block = open.first + at;
        if self.blocks.len() <= block as usize {
            self.blocks.push(Block::idle());
            self.used.push(0);
        }
        let used = &mut self.used[block as usize];
        let lane = *used;
        *used += 1;
        if usize::from(*used) == LANES {
            open.fill(at);
        }
        (block, lane)
    }

    /// Lays out one touch more, after all others: in the last block that has room and none of its bodies, if that is one of these.
    pub(super) fn add(
        &mut self,
        (k, touch): (usize, &Touch),
        rows: &Rows,
        (a, b): (u32, u32),
        (keep, band): (f64, f64),
    ) {
        self.standing.resize(rows.rows.len(), Standing::NOWHERE);
        for row in [a, b].into_iter().filter(|row| rows.mobile_of(*row).is_some()) {
            if !self.hold(row as usize) {
                self.standing[row as usize].put(0, 0);
                self.rows.push(row);
                self.stood.push(rows.rows[row as usize].come_so_far());
            }
        }
        let open = self.more.filter(|lane| *lane < LANES && !self.blocks.last().is_some_and(|block| block.has(a, b)));
        let lane = open.unwrap_or_else(|| {
            self.blocks.push(Block::idle());
            if !self.turned.is_empty() {
                self.turned.push(Turned::NOT);
            }
            0
        });
        self.more = Some(lane + 1);
        self.count += 1;
        let block = self.blocks.len() - 1;
        self.blocks[block].set(lane, touch, (a, b), keep, band);
        self.place.resize(self.place.len().max(k + 1), NOWHERE);
        self.place[k] = (block as u32, lane as u8);
    }

    /// The rows of mobile bodies that stand in any block.
    pub(super) fn rows(&self) -> &[u32] {
        &self.rows
    }

    /// Remembers where the bodies are: pushes are about to be found, and some to be moved apart.
    pub(super) fn note_places(&mut self, rows: &Rows) {
        self.stood.clear();
        self.stood.reserve_exact(self.rows.len());
        self.stood.extend(self.rows.iter().map(|row| rows.rows[*row as usize].come_so_far()));
    }

    /// Puts them back where they were.
    pub(super) fn put_back(&self, rows: &mut Rows) {
        for (row, stood) in self.rows.iter().zip(&self.stood) {
            let row = &mut rows.rows[*row as usize].0;
            [row[X], row[Z], row[TURN]] = *stood;
        }
    }

    /// Whether a mobile body's row stands in any block.
    pub(super) fn hold(&self, row: usize) -> bool {
        self.standing[row].anywhere()
    }

    /// The block and lane of a touch that is laid out.
    pub(super) fn lane(&self, k: usize) -> Option<(&Block, usize)> {
        let (block, lane) = self.place[k];
        Some((self.blocks.get(block as usize)?, lane as usize))
    }

    fn lane_mut(&mut self, k: usize) -> Option<(&mut Block, usize)> {
        let (block, lane) = self.place[k];
        Some((self.blocks.get_mut(block as usize)?, lane as usize))
    }

    /// From which block on those lie that come later.
    pub(super) fn later(&self) -> usize {
        self.blocks.len() - usize::from(self.more.is_some())
    }

    /// Lays a touch out anew.
    pub(super) fn set(&mut self, k: usize, touch: &Touch, rows: (u32, u32), keep: f64, band: f64) {
        if let Some((block, lane)) = self.lane_mut(k) {
            block.set(lane, touch, rows, keep, band);
        }
    }

    /// The touches are about to be turned: none is yet.
    pub(super) fn begin_turning(&mut self, touches: &[Touch]) {
        self.turned.clear();
        self.turned.resize(self.blocks.len(), Turned::NOT);
        for (touch, (block, lane)) in touches.iter().zip(&self.place) {
            let Some(turned) = self.turned.get_mut(*block as usize) else { continue };
            for p in (0..2).filter(|p| touch.cut[*p]) {
                turned.cut[p].0[*lane as usize] = 1.0;
            }
        }
    }

    /// Nothing is pushed any more.
    pub(super) fn forget_pushes(&mut self) {
        for block in &mut self.blocks {
            block.push = [Eight::ZERO; 2];
            block.grip = Eight::ZERO;
        }
    }

    /// All push so many times as hard.
    pub(super) fn scale_pushes(&mut self, times: f64) {
        let times = Eight::all(times);
        for block in &mut self.blocks {
            block.push = block.push.map(|push| push * times);
            block.grip = block.grip * times;
        }
    }

    /// The pushes and friction of a touch.
    pub(super) fn pushes(&self, k: usize) -> ([f64; 2], f64) {
        self.lane(k)
            .map_or_else(Default::default, |(block, lane)| (block.push.map(|push| push.0[lane]), block.grip.0[lane]))
    }

    /// A touch pushes so at that point alone, and holds with so much friction.
    pub(super) fn set_pushes(&mut self, k: usize, p: usize, push: f64, grip: f64) {
        if let Some((block, lane)) = self.lane_mut(k) {
            block.push[p].0[lane] = push;
            block.grip.0[lane] = grip;
        }
    }

    /// Along what a touch has pushed: its normal, or what that has turned to midway through the sub-step.
    pub(super) fn normal(&self, k: usize, touch: &Touch) -> Vec2 {
        let now = self.lane(k).map_or(touch.n, |(block, lane)| Vec2::new(block.nx.0[lane], block.nz.0[lane]));
        if now == touch.n { now } else { now.normalize() }
    }

    /// Whether a touch presses: it has done so in the sub-step before.
    pub(super) fn presses(&self, k: usize) -> bool {
        let ([one, two], _) = self.pushes(k);
        one + two > 0.0
    }

    /// A point of a touch asks for nothing in this sub-step.
    pub(super) fn ask_nothing(&mut self, k: usize, p: usize) {
        if let Some((block, lane)) = self.lane_mut(k) {
            block.asked[p].0[lane] = -FAR;
        }
    }

    /// A point of a touch is not moved apart in this part of the step.
    pub(super) fn part_nothing(&mut self, k: usize, p: usize) {
        if let Some((block, lane)) = self.lane_mut(k) {
            block.least[p].0[lane] = -FAR;
        }
    }

    /// Takes over the pushes of the touches.
    pub(super) fn renew(&mut self, touches: &[Touch]) {
        for (k, touch) in touches.iter().enumerate() {
            let Some((block, lane)) = self.lane_mut(k) else { continue };
            for k in 0..2 {
                block.push[k].0[lane] = touch.push[k];
            }
            block.grip.0[lane] = touch.grip;
        }
    }
}

impl Block {
    /// Its pushes at both points and friction.
    pub(super) fn pushes(&self) -> [Eight; 3] {
        [self.push[0], self.push[1], self.grip]
    }

    pub(super) fn set_pushes(&mut self, pushes: [Eight; 3]) {
        [self.push[0], self.push[1], self.grip] = pushes;
    }

    /// A block whose lanes all belong to nobody.
    fn idle() -> Block {
        let (zero, one) = (Eight::ZERO, Eight::all(1.0));
        Block {
            row_a: core::array::from_fn(|k| k as u32),
            row_b: core::array::from_fn(|k| (IDLE / 2 + k) as u32),
            nx: one,
            nz: zero,
            lever_a: [zero, one],
            lever_b: [zero, one],
            along_a: zero,
            along_b: zero,
            friction: zero,
            gap: [Eight::all(FAR); 2],
            least: [zero; 2],
            slip_back: zero,
            slip_on: zero,
            push: [zero; 2],
            grip: zero,
            asked: [zero; 2],
        }
    }

    /// Whether a row stands in one of its lanes.
    fn has(&self, a: u32, b: u32) -> bool {
        self.row_a.iter().chain(&self.row_b).any(|row| *row == a || *row == b)
    }

    fn set(&mut self, lane: usize, touch: &Touch, (row_a, row_b): (u32, u32), keep: f64, band: f64) {
        self.row_a[lane] = row_a;
        self.row_b[lane] = row_b;
        self.nx.0[lane] = touch.n.x;
        self.nz.0[lane] = touch.n.y;
        self.along_a.0[lane] = touch.along_a;
        self.along_b.0[lane] = touch.along_b;
        self.friction.0[lane] = touch.surface.friction;
        self.slip_back.0[lane] = touch.slip.0;
        self.slip_on.0[lane] = touch.slip.1;
        self.grip.0[lane] = touch.grip;
        for k in 0..2 {
            self.lever_a[k].0[lane] = touch.lever_a[k];
            self.lever_b[k].0[lane] = touch.lever_b[k];
            let gap = if touch.gap[k].abs() <= band { 0.0 } else { touch.gap[k] };
            self.gap[k].0[lane] = gap;
            self.least[k].0[lane] = (gap * keep).min(0.0);
            self.push[k].0[lane] = touch.push[k];
        }
    }
}
