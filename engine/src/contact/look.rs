//! A sub-step begins: how fast each point is to part at least by its end.
//!
//! ```text
//!   u₀: how fast a point parts now, g its gap, h the sub-step
//!   will be reached (u₀ < −g/h):   −g/h          slowed down to just come to touch
//!   else:                          −2 g/h − u₀   so that it does not come below the face: g + h (u₀ + u)/2 ≥ 0,
//!                                                and no more below −g/h than forces change in a sub-step
//! ```

use super::blocks::Block;
use super::rows::{Row, SPIN, VX, VZ};
use super::sweep::{Arms, gaps, gather, push};
use crate::lanes::Eight;
use crate::width::Work;

/// A look at every point.
pub(super) struct Look<'a> {
    pub(super) rows: &'a [Row],
    pub(super) blocks: &'a mut [Block],
    /// The sub-step \[s\], and up to what gap points touch \[m\].
    pub(super) h: f64,
    pub(super) band: f64,
    /// What gravity does in the sub-step, some times over \[m/s\].
    pub(super) pulled: f64,
}

impl Work for Look<'_> {
    type Out = ();

    #[inline(always)]
    fn run<const W: usize>(self) {
        let (rate, band) = (Eight::all(1.0 / self.h), Eight::all(self.band));
        let pulled = Eight::all(self.pulled);
        for block in self.blocks {
            let (a, b) = (gather::<W>(self.rows, &block.row_a), gather::<W>(self.rows, &block.row_b));
            let gap = gaps(block, &a, &b);
            let arms = if self.pulled > 0.0 { Arms::of(block, &a, &b) } else { Arms::at_first(block) };
            let along_n = block.nx * (b[VX] - a[VX]) + block.nz * (b[VZ] - a[VZ]);
            #[allow(clippy::needless_range_loop)] // of several arrays
            for k in 0..2 {
                let u = along_n + arms.lever_b[k] * b[SPIN] - arms.lever_a[k] * a[SPIN];
                let reach = (band - gap[k]).pick(Eight::ZERO, -(gap[k] * rate));
                block.asked[k] = reach + (reach - u).min(Eight::ZERO).max(-pulled);
            }
        }
    }
}

/// Contacts push as they did a sub-step ago, each from where its bodies are by now.
pub(super) struct Warm<'a> {
    pub(super) rows: &'a mut [Row],
    pub(super) blocks: &'a [Block],
}

impl Work for Warm<'_> {
    type Out = ();

    #[inline(always)]
    fn run<const W: usize>(self) {
        for block in self.blocks {
            let [first, second] = block.push;
            push::<W>(block, |a, b| Arms::of(block, a, b), self.rows, [first, second, block.grip]);
        }
    }
}
