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

use super::arms::{Arms, Lanes};
use super::blocks::{Block, Turned};
use super::rows::{INVERSE_MASS, Row, SPIN, TURN, VX, VZ, X, Z};
use super::sweep::{gaps, gather, normal, of};
use crate::lanes::Wide;
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
    pub(super) turned: &'a mut [Turned],
    /// Points with gaps up to this touch \[m\].
    pub(super) band: f64,
    /// What gravity does in the sub-step, some times over \[m/s\]: more is not asked.
    pub(super) pulled: f64,
}

impl Work for Midway<'_> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(self) {
        let (band, pulled) = (V::all(self.band), V::all(self.pulled));
        for (block, turned) in self.blocks.iter_mut().zip(self.turned) {
            let (a, b) = (gather::<V>(self.rows, &block.row_a), gather::<V>(self.rows, &block.row_b));
            let (mean_a, mean_b) = (gather::<V>(self.mean, &block.row_a), gather::<V>(self.mean, &block.row_b));
            let (before, likely) = (Speeds::of(block, &a, &b), Speeds::of(block, &mean_a, &mean_b));
            let asked = of::<V>(&block.asked);
            let lands = (asked[0] - before.along_n[0]).max(asked[1] - before.along_n[1]) - pulled;
            let gap = gaps(block, &a, &b);
            let [first, second] = presses(block, &gap, band);
            let presses = [lands.pick(V::zero(), first), lands.pick(V::zero(), second)];
            turn(block, &mean_a, &mean_b, presses, of(&turned.cut));
            let less = ahead(block, (&a, &b), (&mean_a, &mean_b));
            let (counted, from) = (gaps(block, &a, &b), of::<V>(&block.gap));
            block.gap =
                [(from[0] + (gap[0] - counted[0] - less)).eight(), (from[1] + (gap[1] - counted[1] - less)).eight()];
            let (now, then) = (Speeds::of(block, &a, &b), Speeds::of(block, &mean_a, &mean_b));
            for k in 0..2 {
                let less = before.along_n[k] - now.along_n[k];
                let comes = (less - (likely.along_n[k] - then.along_n[k])) * V::all(-2.0);
                let back = (-before.along_n[k]).min(comes).max(V::zero());
                let back = (band - gap[k]).pick(back, V::zero());
                block.asked[k] = (asked[k] + back + less.min(pulled).max(-pulled)).eight();
            }
            // What little it slips with friction, not against it, it slips back.
            let back = (-(before.along_t * V::of(&block.grip.0))).pick(V::zero(), before.along_t);
            turned.slips = (before.along_t - now.along_t - back).min(pulled).max(-pulled).eight();
        }
    }
}

/// A body that has flown ahead to an impact keeps the gaps it has there. The levers count from where it stood as the step began; what
/// they have that way too much makes so much of the gaps in what is left of the sub-step.
#[inline(always)]
fn ahead<V: Wide>(block: &Block, (a, b): (&Lanes<V>, &Lanes<V>), (mean_a, mean_b): (&Lanes<V>, &Lanes<V>)) -> V {
    let ((dx, dz), [nx, nz]) = ((b[X] - a[X], b[Z] - a[Z]), normal::<V>(block));
    (nz * dx - nx * dz) * (mean_a[SPIN] * mean_a[HALF] + mean_b[SPIN] * mean_b[HALF])
}

/// How fast the owner's points move against the reference.
struct Speeds<V> {
    along_n: [V; 2],
    along_t: V,
}

impl<V: Wide> Speeds<V> {
    #[inline(always)]
    fn of(block: &Block, a: &Lanes<V>, b: &Lanes<V>) -> Speeds<V> {
        let ((ux, uz), [nx, nz]) = ((b[VX] - a[VX], b[VZ] - a[VZ]), normal::<V>(block));
        let Arms { lever_a, lever_b, along_a, along_b } = Arms::of(block, a, b);
        let along_n = nx * ux + nz * uz;
        Speeds {
            along_n: [
                along_n + lever_b[0] * b[SPIN] - lever_a[0] * a[SPIN],
                along_n + lever_b[1] * b[SPIN] - lever_a[1] * a[SPIN],
            ],
            along_t: nz * ux - nx * uz + along_b * b[SPIN] - along_a * a[SPIN],
        }
    }
}

/// How hard each point presses, or whether it is about to: where nothing does yet, what touches.
#[inline(always)]
fn presses<V: Wide>(block: &Block, gap: &[V; 2], band: V) -> [V; 2] {
    let [first, second] = of::<V>(&block.push);
    let (none, one, zero) = (-(first + second), V::all(1.0), V::zero());
    [none.pick((band - gap[0]).pick(one, zero), first), none.pick((band - gap[1]).pick(one, zero), second)]
}

/// The point is the owner's and turns with it, the normal turns with the reference. In the directions t and n an arm is
/// (lever, −along); both levers go on leading to the same place. Where nothing presses nothing is turned;
/// nor where the face is a mobile body's.
#[inline(always)]
fn turn<V: Wide>(block: &mut Block, a: &Lanes<V>, b: &Lanes<V>, presses: [V; 2], cut: [V; 2]) {
    let (one, zero, [nx, nz]) = (V::all(1.0), V::zero(), normal::<V>(block));
    let Arms { lever_a, lever_b, along_a, along_b } = Arms::of(block, a, b);
    let sum = presses[0] + presses[1];
    let cut = presses[0] * cut[0] + presses[1] * cut[1];
    let follows = (-cut).min(-a[INVERSE_MASS]);
    let half = (-sum).pick(zero, follows.pick(a[HALF].min(b[HALF]), zero));
    let (turn_a, turn_b) = (half * a[SPIN], half * b[SPIN]);
    // From one end of an arc to the other leads a chord.
    let keep = one - V::all(CHORD) * turn_b * turn_b;
    let (x, z) = (half * (b[VX] - a[VX]), half * (b[VZ] - a[VZ]));
    let (passed, parted) = (nz * x - nx * z, nx * x + nz * z);
    let apart = along_b - along_a + parted;
    let beside = lever_a[0] - lever_b[0] + passed;
    let at = (presses[0] * lever_b[0] + presses[1] * lever_b[1]) * (-sum).pick(one, sum).inverse();
    let down = keep * along_b - turn_b * at;
    let along = turn_a * (keep * at + turn_b * along_b) + down;
    let [nx, nz] = [nx - turn_a * nz, nz + turn_a * nx];
    // They count from where the bodies stood as the step began.
    let (dx, dz) = (b[X] - a[X], b[Z] - a[Z]);
    let (ahead, slipped) = ((nx * dx + nz * dz) * V::all(0.5), (nz * dx - nx * dz) * V::all(0.5));
    for k in 0..2 {
        let (on, down) = (keep * lever_b[k] + turn_b * along_b, keep * along_b - turn_b * lever_b[k]);
        let lever = on - turn_a * down;
        block.lever_a[k] = (lever_a[k] - lever_b[k] + passed + lever + turn_a * apart - slipped).eight();
        block.lever_b[k] = (lever + slipped).eight();
    }
    block.along_a = (along + turn_a * beside - apart + ahead).eight();
    block.along_b = (along - ahead).eight();
    (block.nx, block.nz) = (nx.eight(), nz.eight());
}
