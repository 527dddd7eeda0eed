//! A sub-step begins: how fast each point is to part at least by its end.
//!
//! ```text
//!   u₀: how fast a point parts now, g its gap, h the sub-step
//!   touching, coming with restitution:   e |u₀|
//!   will be reached (u₀ < −g/h):         −g/h             slowed down to just come to touch
//!   else:                                −2 g/h − u₀      so that it does not come below the face: g + h (u₀ + u)/2 ≥ 0
//! ```
//!
//! A point that is slowed down remembers its speed, and once it touches the two part at e times that. What rests comes
//! with no speed, so it does not bounce, whatever e.

use super::blocks::Block;
use super::rows::{Row, SPIN, VX, VZ};
use super::sweep::{gaps, gather};
use super::touch::Touch;
use crate::lanes::Eight;
use crate::width::Work;

/// Restitution of the touches of a block, and the speeds at which their points were last seen to come \[m/s\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounce {
    pub(super) restitution: Eight,
    pub(super) coming: [Eight; 2],
    /// At what speed each point parts after an impact in this sub-step \[m/s\].
    pub(super) parts: [Eight; 2],
}

impl Bounce {
    /// No touch bounces.
    pub(super) const NONE: Bounce =
        Bounce { restitution: Eight::ZERO, coming: [Eight::ZERO; 2], parts: [Eight::ZERO; 2] };

    pub(super) fn set(&mut self, lane: usize, touch: &Touch) {
        self.restitution.0[lane] = touch.surface.restitution;
        for k in 0..2 {
            self.coming[k].0[lane] = touch.coming[k];
        }
    }
}

/// A look at every point.
pub(super) struct Look<'a, const BOUNCE: bool> {
    pub(super) rows: &'a [Row],
    pub(super) blocks: &'a mut [Block],
    /// Restitution, where any pair has some.
    pub(super) bounces: &'a mut [Bounce],
    /// The sub-step \[s\], and up to what gap points touch \[m\].
    pub(super) h: f64,
    pub(super) band: f64,
}

impl<const BOUNCE: bool> Work for Look<'_, BOUNCE> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        let (rate, band) = (Eight::all(1.0 / self.h), Eight::all(self.band));
        for (at, block) in self.blocks.iter_mut().enumerate() {
            let (a, b) = (gather(self.rows, &block.row_a), gather(self.rows, &block.row_b));
            let gap = gaps(block, &a, &b);
            let along_n = block.nx * (b[VX] - a[VX]) + block.nz * (b[VZ] - a[VZ]);
            for k in 0..2 {
                let u = along_n + block.lever_b[k] * b[SPIN] - block.lever_a[k] * a[SPIN];
                let reach = -((gap[k] - band).max(Eight::ZERO) * rate);
                let asked = reach.min(reach + reach - u);
                if BOUNCE {
                    let bounce = &mut self.bounces[at];
                    // What an impact pushed is not what the contact pushes from then on.
                    let bounced = -bounce.parts[k];
                    block.push[k] = bounced.pick(block.push[k], Eight::ZERO);
                    block.grip = bounced.pick(block.grip, Eight::ZERO);
                    let seen = (-u).max(Eight::ZERO).max(bounce.coming[k]);
                    let (closed, reached) = (band - gap[k], reach - u);
                    bounce.parts[k] = closed.pick(bounce.restitution * seen, Eight::ZERO);
                    bounce.coming[k] = closed.pick(Eight::ZERO, reached.pick(seen, Eight::ZERO));
                    block.asked[k] = (-bounce.parts[k]).pick(asked, bounce.parts[k]);
                } else {
                    block.asked[k] = asked;
                }
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
    fn run(self) {
        for block in self.blocks {
            super::sweep::push_again(self.rows, block);
        }
    }
}
