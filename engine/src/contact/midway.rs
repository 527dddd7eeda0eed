//! Touches that press, as they are midway through the sub-step: bodies turn and pass each other while they push.
//!
//! A block that turns about a corner for a sub-step h, from spin ω to ω′, with its arm r from the centre to the corner:
//!
//! ```text
//!   flight         x′ = x + h (v + v′)/2,   θ′ = θ + h (ω + ω′)/2
//!   the corner     x′ + r(θ′) = x + r(θ)    needs  (v + v′) + (ω + ω′) ⟂m = 0,   m the arm midway, r turned by h ω/2
//!   so at its end  v′ + ω′ ⟂m = −(v + ω ⟂m) = h ω²/2 · r,   where it was held before: v + ω ⟂r = 0
//! ```
//!
//! A push at m does no work then, and both angle and spin are right to second order. With r in the place of m they are to first
//! order only: the push turns the block by the lever of a moment ago. So each touch gets the levers and the normal it has midway,
//! and is asked to part by as much more as its speed along them is less than along those at the start.

use super::blocks::Block;
use super::rows::{INVERSE_MASS, Row, SPIN, TURN, VX, VZ};
use super::sweep::{Lanes, gaps, gather};
use crate::lanes::Eight;
use crate::width::Work;

/// The middle of a chord lies as far within the arc, and the chord is shorter than it: by so many times the square of half its angle.
const CHORD: f64 = 2.0 / 3.0;

/// In rows of mean motions the turn's place holds half the time that is left of the sub-step \[s\].
pub(super) const HALF: usize = TURN;

/// Turns and moves the touches on by half a sub-step.
pub(super) struct Midway<'a> {
    /// As the sub-step begins.
    pub(super) rows: &'a [Row],
    /// The same as they are likely to move on the whole.
    pub(super) mean: &'a [Row],
    pub(super) blocks: &'a mut [Block],
    /// Points with gaps up to this touch \[m\].
    pub(super) band: f64,
    /// What gravity does in the sub-step, some times over \[m/s\]: more is not asked.
    pub(super) pulled: f64,
}

impl Work for Midway<'_> {
    type Out = ();

    #[inline(always)]
    fn run<const W: usize>(self) {
        let (band, pulled) = (Eight::all(self.band), Eight::all(self.pulled));
        for block in self.blocks {
            let (a, b) = (gather::<W>(self.rows, &block.row_a), gather::<W>(self.rows, &block.row_b));
            let (mean_a, mean_b) = (gather::<W>(self.mean, &block.row_a), gather::<W>(self.mean, &block.row_b));
            let [before, likely] = [(&a, &b), (&mean_a, &mean_b)].map(|(a, b)| Speeds::of(block, a, b));
            let struck = [0, 1].map(|k| block.asked[k] - before.along_n[k]);
            let lands = struck[0].max(struck[1]) - pulled;
            let gap = gaps(block, &a, &b);
            let presses = presses(block, &gap, band).map(|presses| lands.pick(Eight::ZERO, presses));
            turn(block, &mean_a, &mean_b, presses);
            let [now, then] = [(&a, &b), (&mean_a, &mean_b)].map(|(a, b)| Speeds::of(block, a, b));
            for k in 0..2 {
                let less = before.along_n[k] - now.along_n[k];
                let comes = (less - (likely.along_n[k] - then.along_n[k])) * Eight::all(-2.0);
                let back = (-before.along_n[k]).min(comes).max(Eight::ZERO);
                let back = (band - gap[k]).pick(back, Eight::ZERO);
                block.asked[k] = block.asked[k] + back + less.min(pulled).max(-pulled);
            }
            // What little it slips with friction, not against it, it slips back.
            let back = (-(before.along_t * block.grip)).pick(Eight::ZERO, before.along_t);
            block.slips = (before.along_t - now.along_t - back).min(pulled).max(-pulled);
        }
    }
}

/// How fast the owner's points move against the reference.
struct Speeds {
    along_n: [Eight; 2],
    along_t: Eight,
}

impl Speeds {
    #[inline(always)]
    fn of(block: &Block, a: &Lanes, b: &Lanes) -> Speeds {
        let (ux, uz) = (b[VX] - a[VX], b[VZ] - a[VZ]);
        let along_n = block.nx * ux + block.nz * uz;
        Speeds {
            along_n: [0, 1].map(|k| along_n + block.lever_b[k] * b[SPIN] - block.lever_a[k] * a[SPIN]),
            along_t: block.nz * ux - block.nx * uz + block.along_b * b[SPIN] - block.along_a * a[SPIN],
        }
    }
}

/// How hard each point presses, or whether it is about to: where nothing does yet, what touches.
#[inline(always)]
fn presses(block: &Block, gap: &[Eight; 2], band: Eight) -> [Eight; 2] {
    let none = -(block.push[0] + block.push[1]);
    [0, 1].map(|k| none.pick((band - gap[k]).pick(Eight::all(1.0), Eight::ZERO), block.push[k]))
}

/// The point is the owner's and turns with it, the normal turns with the reference. In the directions t and n an arm is
/// (lever, −along); both levers go on leading to the same place. Where nothing presses nothing is turned;
/// nor where the face is a mobile body's.
#[inline(always)]
fn turn(block: &mut Block, a: &Lanes, b: &Lanes, presses: [Eight; 2]) {
    let sum = presses[0] + presses[1];
    let cut = presses[0] * block.cut[0] + presses[1] * block.cut[1];
    let follows = (-cut).min(-a[INVERSE_MASS]);
    let half = (-sum).pick(Eight::ZERO, follows.pick(a[HALF].min(b[HALF]), Eight::ZERO));
    let (turn_a, turn_b) = (half * a[SPIN], half * b[SPIN]);
    // From one end of an arc to the other leads a chord.
    let keep = Eight::all(1.0) - Eight::all(CHORD) * turn_b * turn_b;
    let (x, z) = (half * (b[VX] - a[VX]), half * (b[VZ] - a[VZ]));
    let (passed, parted) = (block.nz * x - block.nx * z, block.nx * x + block.nz * z);
    let apart = block.along_b - block.along_a + parted;
    let beside = block.lever_a[0] - block.lever_b[0] + passed;
    let at =
        (presses[0] * block.lever_b[0] + presses[1] * block.lever_b[1]) * (-sum).pick(Eight::all(1.0), sum).inverse();
    let along = block.along_b;
    let arm = |lever: Eight| {
        let (on, down) = (keep * lever + turn_b * along, keep * along - turn_b * lever);
        (on - turn_a * down, turn_a * on + down)
    };
    let (_, along_b) = arm(at);
    for k in 0..2 {
        let (lever, _) = arm(block.lever_b[k]);
        block.lever_a[k] = block.lever_a[k] - block.lever_b[k] + passed + lever + turn_a * apart;
        block.lever_b[k] = lever;
    }
    (block.along_a, block.along_b) = (along_b + turn_a * beside - apart, along_b);
    (block.nx, block.nz) = (block.nx - turn_a * block.nz, block.nz + turn_a * block.nx);
}
