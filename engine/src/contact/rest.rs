//! Rest: all touches improved together until nothing changes any more (block Jacobi, accelerated).
//!
//! Sweeps are quick where things move, but the weight of a tall stack travels by one touch a sweep. What is at rest is worth
//! being solved to the end, once: warm starting makes it free from then on. Every round improves all touches from the same
//! motions, so that a scene that is its own mirror image stays so, and starts from beyond the last two
//! (Nesterov 1983), unless that led astray (O'Donoghue and Candès 2015): a stack of n takes about n rounds and not n².
//!
//! Each body is shared out among its touches (mass splitting, Tonge 2012): with as many times its true inverse mass in every
//! touch as it has touches, improving all at once never overshoots.

use super::arms::{Arms, Lanes, Response};
use super::blocks::{Block, Blocks, Turned};
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, Row, Rows, SPIN, TURN, VX, VZ};
use super::sweep::{gather, normal, parts, push};
use crate::lanes::{Eight, LANES, Wide};
use crate::width::{Width, Work};

/// How good is good enough: changes of velocity below this share of what gravity does in a sub-step; more where there
/// are more touches than a few, for each matters less and all take longer.
const SETTLED: f64 = 1e-11;
const A_FEW: f64 = 16.0;

/// How long rounds go on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Changes of velocity up to this do not count \[m/s\].
    pub(super) enough: f64,
    /// Rounds at most.
    pub(super) most: u32,
}

/// Changes of velocity that do not count among so many touches, where gravity changes it by `pulled` \[m/s\].
pub(super) fn settled(touches: usize, pulled: f64) -> f64 {
    let many = (touches as f64 / A_FEW).max(1.0);
    SETTLED * many * many * pulled
}

/// How far rounds have come.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settled {
    pub(super) rounds: u32,
    /// The change of velocity in the last round \[m/s\].
    pub(super) left: f64,
    /// Whether that is settled.
    pub(super) enough: bool,
}

/// How far beyond the last two rounds the next one starts (Nesterov 1983), from the beginning again where that led astray
/// (O'Donoghue and Candès 2015).
#[derive(Clone, Copy, Debug)]
pub(super) struct Momentum(f64);

impl Default for Momentum {
    fn default() -> Self {
        Momentum(1.0)
    }
}

impl Momentum {
    /// The share of the way between the last two.
    pub(super) fn share(self) -> f64 {
        (self.0 - 1.0) / self.next()
    }

    pub(super) fn go_on(&mut self, astray: bool) {
        self.0 = if astray { 1.0 } else { self.next() };
    }

    fn next(self) -> f64 {
        0.5 * (1.0 + (1.0 + 4.0 * self.0 * self.0).sqrt())
    }
}

/// The pushes and friction of a block, and what the points ask.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    x: [Eight; 3],
    last: [Eight; 3],
}

/// What the rounds need, kept for the next time.
#[derive(Clone, Debug, Default)]
pub(super) struct Rest {
    guesses: Vec<Guess>,
    /// Motions at the present guess, at the last one, and beyond both.
    now: Vec<Row>,
    last: Vec<Row>,
    beyond: Vec<Row>,
}

/// Every touch has two parts that are improved at once: its pushes, and its friction.
const PARTS: u32 = 2;

/// In rows of this solver the place of the turn holds how many times its inverse mass a body has in each of its touches.
const SHARE: usize = TURN;

impl Rest {
    /// Improves all touches until they are settled; gives how many rounds it took.
    pub(super) fn settle(&mut self, rows: &mut Rows, blocks: &mut Blocks, width: Width, effort: Effort) -> Settled {
        self.begin(rows, blocks);
        let (mut momentum, mut before) = (Momentum::default(), f64::INFINITY);
        let (mut rounds, mut left) = (0, 0.0);
        while rounds < effort.most {
            rounds += 1;
            let share = momentum.share();
            let Rest { guesses, now, last, beyond } = self;
            width.run(Beyond { rows: blocks.rows(), now, last, beyond, share });
            let Blocks { blocks, turned, .. } = &*blocks;
            let round = Round::<false> { guesses, blocks, turned, from: beyond, to: now, share };
            let (change, back) = if turned.is_empty() { width.run(round) } else { width.run(round.turned()) };
            momentum.go_on(back > 0.0 || change > before);
            (before, left) = (change, change);
            if change <= effort.enough {
                break;
            }
        }
        self.end(rows, blocks);
        Settled { rounds, left, enough: left <= effort.enough }
    }

    fn begin(&mut self, rows: &Rows, blocks: &Blocks) {
        self.guesses.clear();
        for block in &blocks.blocks {
            let x = block.pushes();
            self.guesses.push(Guess { x, last: x });
        }
        let Rest { now, last, beyond, .. } = self;
        for motions in [&mut *now, &mut *last, &mut *beyond] {
            motions.resize(rows.rows.len(), Row([0.0; LANES]));
        }
        let first = rows.first();
        let shared = |k: usize, touches: u32| {
            let mut row = rows.rows[k];
            row.0[SHARE] = f64::from(PARTS * touches);
            row
        };
        for k in 0..first {
            // Rows of nobody and of fixed bodies never move.
            now[k] = shared(k, 1);
            beyond[k] = now[k];
        }
        for row in blocks.rows() {
            let k = *row as usize;
            now[k] = shared(k, rows.degree[k - first]);
            last[k] = now[k];
        }
    }

    fn end(&mut self, rows: &mut Rows, blocks: &mut Blocks) {
        for (block, guess) in blocks.blocks.iter_mut().zip(&self.guesses) {
            block.set_pushes(guess.x);
        }
        for row in blocks.rows() {
            let now = &self.now[*row as usize];
            rows.rows[*row as usize].set_motion(now.motion());
        }
    }
}

/// The motions from which the next round starts: on beyond the last two. What does not move of a row stays.
struct Beyond<'a> {
    rows: &'a [u32],
    now: &'a mut [Row],
    last: &'a mut [Row],
    beyond: &'a mut [Row],
    share: f64,
}

impl Work for Beyond<'_> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(self) {
        let share = V::all(self.share);
        for row in self.rows {
            let row = *row as usize;
            let (now, last) = (V::of(&self.now[row].0), V::of(&self.last[row].0));
            let beyond = (now + share * (now - last)).eight().0;
            self.last[row] = self.now[row];
            (self.now[row].0, self.beyond[row].0) = (beyond, beyond);
        }
    }
}

/// One round: every touch improved from the motions `from`, the changes added to `to`.
struct Round<'a, const TURNED: bool> {
    guesses: &'a mut [Guess],
    blocks: &'a [Block],
    /// As many, where touches are turned.
    turned: &'a [Turned],
    from: &'a [Row],
    to: &'a mut [Row],
    share: f64,
}

impl<'a> Round<'a, false> {
    fn turned(self) -> Round<'a, true> {
        let Round { guesses, blocks, turned, from, to, share } = self;
        Round { guesses, blocks, turned, from, to, share }
    }
}

impl<const TURNED: bool> Work for Round<'_, TURNED> {
    /// The greatest change of a velocity, and whether (positive) the round turns back on the way it came.
    type Out = (f64, f64);

    #[inline(always)]
    fn run<V: Wide>(self) -> (f64, f64) {
        let (mut most, mut back, share) = (V::zero(), V::zero(), V::all(self.share));
        for (at, (block, guess)) in self.blocks.iter().zip(self.guesses).enumerate() {
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
            push::<V>(block, |_, _| arms, self.to, step);
        }
        (most.greatest(), back.sum())
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
