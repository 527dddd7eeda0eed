//! A sub-step begins: how fast each point is to part at least by its end.
//!
//! ```text
//!   u₀: how fast a point parts now, g its gap, h the sub-step
//!   will be reached (u₀ < −g/h):   −g/h          slowed down to just come to touch
//!   else:                          −2 g/h − u₀   so that it does not come below the face: g + h (u₀ + u)/2 ≥ 0,
//!                                                and no more below −g/h than forces change in a sub-step
//! ```

use super::arms::Arms;
use super::blocks::Block;
use super::rows::{Row, SPIN, VX, VZ};
use super::sweep::{gaps, gather, normal, of, push};
use crate::lanes::Wide;
use crate::width::Work;

/// A look at every point.
pub(super) struct Look<'a, const SLIPPED: bool> {
    pub(super) rows: &'a [Row],
    pub(super) blocks: &'a mut [Block],
    /// The sub-step \[s\], and up to what gap points touch \[m\].
    pub(super) h: f64,
    pub(super) band: f64,
    /// What gravity does in the sub-step, some times over \[m/s\].
    pub(super) pulled: f64,
}

impl<'a> Look<'a, false> {
    /// The same with the levers of the moment: bodies may have slipped past each other since the step began.
    pub(super) fn where_bodies_are(self) -> Look<'a, true> {
        let Look { rows, blocks, h, band, pulled } = self;
        Look { rows, blocks, h, band, pulled }
    }
}

impl<const SLIPPED: bool> Work for Look<'_, SLIPPED> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(self) {
        let (rate, band, pulled) = (V::all(1.0 / self.h), V::all(self.band), V::all(self.pulled));
        for block in self.blocks {
            let (a, b) = (gather::<V>(self.rows, &block.row_a), gather::<V>(self.rows, &block.row_b));
            let gap = gaps(block, &a, &b);
            let arms = if SLIPPED { Arms::of(block, &a, &b) } else { Arms::at_first(block) };
            let [nx, nz] = normal::<V>(block);
            let along_n = nx * (b[VX] - a[VX]) + nz * (b[VZ] - a[VZ]);
            #[allow(clippy::needless_range_loop)] // of several arrays
            for k in 0..2 {
                let u = along_n + arms.lever_b[k] * b[SPIN] - arms.lever_a[k] * a[SPIN];
                let reach = (band - gap[k]).pick(V::zero(), -(gap[k] * rate));
                block.asked[k] = (reach + (reach - u).min(V::zero()).max(-pulled)).eight();
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
    fn run<V: Wide>(self) {
        for block in self.blocks {
            let [first, second] = of::<V>(&block.push);
            push::<V>(block, self.rows, [first, second, V::of(&block.grip.0)]);
        }
    }
}
