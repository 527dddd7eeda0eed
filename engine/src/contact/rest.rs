//! Rest: all touches improved together until nothing changes any more (block Jacobi, accelerated).
//!
//! Sweeps are quick where things move, but the weight of a tall stack travels by one touch a sweep. What is at rest is worth
//! being solved to the end, once: warm starting makes it free from then on. Every round improves all touches from the same
//! motions, so that a scene that is its own mirror image stays so, and starts from beyond the last two
//! (Nesterov 1983), unless that led astray (O'Donoghue and Candès 2015): a stack of n takes about n rounds and not n².
//!
//! Each body is shared out among its touches (mass splitting, Tonge 2012): with as many times its true inverse mass in every
//! touch as it has touches, improving all at once never overshoots.

use super::blocks::Blocks;
use super::round::{Beyond, Given, Guess, HandOut, Outcome, PIECE, Round, SHARE};
use super::rows::{Row, Rows};
use crate::lanes::LANES;
use crate::threads::{PER_THREAD, Threads};
use crate::width::Width;

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

/// What the rounds need, kept for the next time.
#[derive(Clone, Debug, Default)]
pub(super) struct Rest {
    guesses: Vec<Guess>,
    given: Vec<Given>,
    /// Motions at the present guess, at the last one, and beyond both.
    now: Vec<Row>,
    last: Vec<Row>,
    beyond: Vec<Row>,
}

/// Every touch has two parts that are improved at once: its pushes, and its friction.
const PARTS: u32 = 2;

/// Fewer blocks than so many for a thread are not worth being shared out.
const BLOCKS_PER_THREAD: usize = 4 * PIECE;

impl Rest {
    /// Improves all touches until they are settled; gives how many rounds it took.
    pub(super) fn settle(
        &mut self,
        rows: &mut Rows,
        blocks: &mut Blocks,
        (width, threads): (Width, &Threads),
        effort: Effort,
    ) -> Settled {
        self.begin(rows, blocks, threads);
        let (mut momentum, mut before) = (Momentum::default(), f64::INFINITY);
        let (mut rounds, mut left) = (0, 0.0);
        while rounds < effort.most {
            rounds += 1;
            let share = momentum.share();
            self.go_beyond(blocks.rows(), (width, threads), share);
            let Outcome { most, back } = self.round(blocks, (width, threads), share);
            momentum.go_on(back > 0.0 || most > before);
            (before, left) = (most, most);
            if most <= effort.enough {
                break;
            }
        }
        self.end(rows, blocks, threads);
        Settled { rounds, left, enough: left <= effort.enough }
    }

    fn begin(&mut self, rows: &Rows, blocks: &Blocks, threads: &Threads) {
        let Rest { guesses, now, last, beyond, .. } = self;
        guesses.resize(blocks.blocks.len(), Guess::NONE);
        threads.each(&mut guesses[..], (PIECE, BLOCKS_PER_THREAD), |from, guesses| {
            for (guess, block) in guesses.iter_mut().zip(&blocks.blocks[from..]) {
                guess.begin(block);
            }
        });
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
        threads.each((&mut now[..], &mut last[..]), (1, PER_THREAD), |from, (now, last)| {
            for k in own_rows(blocks.rows(), from, now.len()) {
                now[k] = shared(from + k, rows.degree[from + k - first]);
                last[k] = now[k];
            }
        });
    }

    /// Goes on beyond the last two guesses by that share of the way between them.
    fn go_beyond(&mut self, rows: &[u32], (width, threads): (Width, &Threads), share: f64) {
        let Rest { now, last, beyond, .. } = self;
        let motions = ((&mut now[..], &mut last[..]), &mut beyond[..]);
        threads.each(motions, (1, PER_THREAD), |from, ((now, last), beyond)| {
            width.run(Beyond { rows: own_rows(rows, from, now.len()), now, last, beyond, share });
        });
    }

    /// Improves every touch once from there; a piece after the other, or where threads share the round all of them before what
    /// comes of any is handed out.
    fn round(&mut self, blocks: &Blocks, (width, threads): (Width, &Threads), share: f64) -> Outcome {
        let Rest { guesses, given, now, beyond, .. } = self;
        let Blocks { blocks, turned, .. } = blocks;
        let improve = |from: usize, guesses: &mut [Guess], given: &mut [Given]| {
            let (blocks, turned) = (&blocks[from..], turned.get(from..).unwrap_or_default());
            let round = Round::<false> { guesses, given, blocks, turned, from: beyond, share };
            if turned.is_empty() { width.run(round) } else { width.run(round.turned()) }
        };
        let hand_out = |from: usize, given: &[Given], (first, rows): (usize, &mut [Row])| {
            width.run(HandOut { given, blocks: &blocks[from..], first, rows });
        };
        let mut whole = Outcome::default();
        if threads.parts(guesses.len(), PIECE, BLOCKS_PER_THREAD).len() == 1 {
            given.resize(PIECE, Given::NOTHING);
            for (at, piece) in guesses.chunks_mut(PIECE).enumerate() {
                whole.and(improve(at * PIECE, piece, given));
                hand_out(at * PIECE, &given[..piece.len()], (0, now));
            }
            return whole;
        }
        given.resize(guesses.len(), Given::NOTHING);
        let parts = (&mut guesses[..], &mut given[..]);
        let outcomes = threads.each(parts, (PIECE, BLOCKS_PER_THREAD), |from, (guesses, given)| {
            let pieces = guesses.chunks_mut(PIECE).zip(given.chunks_mut(PIECE)).zip((from..).step_by(PIECE));
            pieces.map(|((guesses, given), from)| improve(from, guesses, given)).collect::<Vec<_>>()
        });
        outcomes.into_iter().flatten().for_each(|piece| whole.and(piece));
        threads.each(&mut now[..], (1, PER_THREAD), |first, rows| hand_out(0, given, (first, rows)));
        whole
    }

    fn end(&mut self, rows: &mut Rows, blocks: &mut Blocks, threads: &Threads) {
        let Rest { guesses, now, .. } = self;
        threads.each(&mut blocks.blocks[..], (PIECE, BLOCKS_PER_THREAD), |from, blocks| {
            for (block, guess) in blocks.iter_mut().zip(&guesses[from..]) {
                guess.end(block);
            }
        });
        threads.each((&mut rows.rows[..], &now[..]), (1, PER_THREAD), |from, (rows, now)| {
            for k in own_rows(blocks.rows(), from, now.len()) {
                rows[k].set_motion(now[k].motion());
            }
        });
    }
}

/// Those of some rows that lie in a part of all, counted from its beginning.
fn own_rows(rows: &[u32], first: usize, count: usize) -> impl Iterator<Item = usize> {
    rows.iter().map(move |row| (*row as usize).wrapping_sub(first)).filter(move |row| *row < count)
}
