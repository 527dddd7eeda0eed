//! One round of rest, in pieces that threads may share: the way on, every touch improved, and what comes of that handed out.
//!
//! Touches are improved all from the same motions, so their order does not matter; what comes of them is added to their bodies'
//! motions block by block, so that the bits are the same whoever does it.

use super::arms::{Arms, Lanes, Response};
use super::blocks::{Block, Turned};
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, Row, SPIN, TURN, VX, VZ};
use super::sweep::{gather, given, normal, parts};
use crate::lanes::{Eight, LANES, Wide};
use crate::width::Work;

/// Blocks of which the outcome is told together: a number that depends on nothing else, for sums are rounded.
pub(super) const PIECE: usize = 64;

/// In rows of this solver the place of the turn holds how many times its inverse mass a body has in each of its touches.
pub(super) const SHARE: usize = TURN;

/// The pushes and friction of a block, and what they were before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    x: [Eight; 3],
    last: [Eight; 3],
}

/// What the improvement of a block gives to its bodies: an impulse to b, and what turns a and b.
#[derive(Clone, Copy, Debug)]
pub(super) struct Given([Eight; 4]);

impl Given {
    pub(super) const NOTHING: Given = Given([Eight::ZERO; 4]);
}

impl Guess {
    pub(super) const NONE: Guess = Guess { x: [Eight::ZERO; 3], last: [Eight::ZERO; 3] };

    /// The first guess: there is no last one.
    pub(super) fn begin(&mut self, block: &Block) {
        for (k, push) in [&block.push[0], &block.push[1], &block.grip].into_iter().enumerate() {
            (self.x[k], self.last[k]) = (*push, *push);
        }
    }

    /// The block pushes so from now on.
    pub(super) fn end(&self, block: &mut Block) {
        [block.push[0], block.push[1], block.grip] = self.x;
    }
}

/// What a round has come to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Outcome {
    /// The greatest change of a velocity \[m/s\].
    pub(super) most: f64,
    /// Whether (positive) the round turns back on the way it came.
    pub(super) back: f64,
}

impl Outcome {
    /// Adds that of a piece more.
    pub(super) fn and(&mut self, piece: Outcome) {
        self.most = self.most.max(piece.most);
        self.back += piece.back;
    }
}

/// The motions from which the next round starts: on beyond the last two. What does not move of a row stays.
pub(super) struct Beyond<'a, I> {
    pub(super) rows: I,
    pub(super) now: &'a mut [Row],
    pub(super) last: &'a mut [Row],
    pub(super) beyond: &'a mut [Row],
    pub(super) share: f64,
}

impl<I: Iterator<Item = usize>> Work for Beyond<'_, I> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(self) {
        let share = V::all(self.share);
        for row in self.rows {
            let (now, last) = (V::of(&self.now[row].0), V::of(&self.last[row].0));
            let beyond = (now + share * (now - last)).eight().0;
            self.last[row] = self.now[row];
            (self.now[row].0, self.beyond[row].0) = (beyond, beyond);
        }
    }
}

/// Every touch of some blocks improved from the same motions.
pub(super) struct Round<'a, const TURNED: bool> {
    pub(super) guesses: &'a mut [Guess],
    /// As many at least of what follows.
    pub(super) given: &'a mut [Given],
    pub(super) blocks: &'a [Block],
    /// As many as those, where touches are turned.
    pub(super) turned: &'a [Turned],
    pub(super) from: &'a [Row],
    pub(super) share: f64,
}

impl<'a> Round<'a, false> {
    pub(super) fn turned(self) -> Round<'a, true> {
        let Round { guesses, given, blocks, turned, from, share } = self;
        Round { guesses, given, blocks, turned, from, share }
    }
}

impl<const TURNED: bool> Work for Round<'_, TURNED> {
    type Out = Outcome;

    #[inline(always)]
    fn run<V: Wide>(self) -> Outcome {
        let (mut most, mut back, share) = (V::zero(), V::zero(), V::all(self.share));
        for (at, ((block, guess), given_by)) in self.blocks.iter().zip(self.guesses).zip(self.given).enumerate() {
            let (a, b) = (gather::<V>(self.from, &block.row_a), gather::<V>(self.from, &block.row_b));
            let arms = Arms::<V>::between_mobile(block, &a, &b);
            let (shared_a, shared_b) = (shared(&a), shared(&b));
            let response = Response::with(&arms, shared_a.1, shared_b.1);
            let (mut now, mut from) = ([V::zero(); 3], [V::zero(); 3]);
            for k in 0..3 {
                now[k] = V::of(&guess.x[k].0);
                from[k] = now[k] + share * (now[k] - V::of(&guess.last[k].0));
            }
            let slips = if TURNED { Some(V::of(&self.turned[at].slips.0)) } else { None };
            let (x, change) = improve(block, (&arms, &response), (shared_a, shared_b), &from, slips);
            guess.last = guess.x;
            let mut step = x;
            for k in 0..3 {
                back = back - change[k] * (x[k] - now[k]);
                most = most.max(change[k].abs());
                step[k] = x[k] - from[k];
                guess.x[k] = x[k].eight();
            }
            let given = given(block, &arms, step);
            given_by.0 = given.map(V::eight);
        }
        Outcome { most: most.greatest(), back: back.sum() }
    }
}

/// What the improvement of some blocks gives is added to the motions of a part of all rows, from `first` on.
pub(super) struct HandOut<'a> {
    pub(super) given: &'a [Given],
    /// As many at least.
    pub(super) blocks: &'a [Block],
    pub(super) first: usize,
    pub(super) rows: &'a mut [Row],
}

impl Work for HandOut<'_> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(mut self) {
        for (block, given) in self.blocks.iter().zip(self.given) {
            let [x, z, twist_a, twist_b] = &given.0;
            let ([x, z], [twist_a, twist_b]) = ([V::of(&x.0), V::of(&z.0)], [V::of(&twist_a.0), V::of(&twist_b.0)]);
            self.give(&block.row_a, [-x, -z, -twist_a]);
            self.give(&block.row_b, [x, z, twist_b]);
        }
    }
}

impl HandOut<'_> {
    /// Gives impulses to those of eight rows that are in this part.
    #[inline(always)]
    fn give<V: Wide>(&mut self, at: &[u32; LANES], given: [V; 3]) {
        let own = at.map(|row| (row as usize).wrapping_sub(self.first));
        let count = self.rows.len();
        let within = own.iter().filter(|row| **row < count).count();
        if within == LANES {
            let mut rows = V::gather(|k| &self.rows[own[k]].0);
            rows[VX] = rows[VX] + rows[INVERSE_MASS] * given[0];
            rows[VZ] = rows[VZ] + rows[INVERSE_MASS] * given[1];
            rows[SPIN] = rows[SPIN] + rows[INVERSE_MOMENT] * given[2];
            V::scatter(rows, |k, row| self.rows[own[k]].0 = row.0);
        } else if within > 0 {
            let given = given.map(V::eight);
            for k in (0..LANES).filter(|k| own[*k] < count) {
                let row = &mut self.rows[own[k]].0;
                row[VX] += row[INVERSE_MASS] * given[0].0[k];
                row[VZ] += row[INVERSE_MASS] * given[1].0[k];
                row[SPIN] += row[INVERSE_MOMENT] * given[2].0[k];
            }
        }
    }
}

/// A body of every touch, and the inverse mass and moment that it has there.
type Shared<'a, V> = (&'a Lanes<V>, (V, V));

#[inline(always)]
fn shared<V: Wide>(row: &Lanes<V>) -> Shared<'_, V> {
    (row, (row[INVERSE_MASS] * row[SHARE], row[INVERSE_MOMENT] * row[SHARE]))
}

/// Better pushes and friction, seeing the motions as they are; and the changes as velocities.
#[inline(always)]
fn improve<V: Wide>(
    block: &Block,
    (arms, shared): (&Arms<V>, &Response<V>),
    ((a, (mass_a, moment_a)), (b, (mass_b, moment_b))): (Shared<V>, Shared<V>),
    from: &[V; 3],
    slips: Option<V>,
) -> ([V; 3], [V; 3]) {
    let ((ux, uz), [nx, nz]) = ((b[VX] - a[VX], b[VZ] - a[VZ]), normal::<V>(block));
    let Arms { along_a, along_b, .. } = *arms;
    let parts = parts(block, arms, a, b);
    let q1 = parts[0] - (shared.k[0] * from[0] + shared.across * from[1]);
    let q2 = parts[1] - (shared.across * from[0] + shared.k[1] * from[1]);
    let [x1, x2] = shared.complement([q1, q2]);
    let k = mass_a + mass_b + moment_a * along_a * along_a + moment_b * along_b * along_b;
    let slip = nz * ux - nx * uz + along_b * b[SPIN] - along_a * a[SPIN];
    let slip = if let Some(slips) = slips { slip - slips } else { slip };
    let most = V::of(&block.friction.0) * (x1 + x2);
    let grip = (from[2] - slip * k.inverse()).min(most).max(-most);
    let change = [shared.k[0] * (x1 - from[0]), shared.k[1] * (x2 - from[1]), k * (grip - from[2])];
    ([x1, x2, grip], change)
}
