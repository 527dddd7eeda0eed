//! A sweep over all touches: each is solved exactly, with the motions its bodies have by then (block Gauss–Seidel).
//!
//! A touch has two points and one friction between them. The pushes are solved: u ≥ what the point asks ([`super::look`]), push ≥ 0, and
//! one of the two exact; that 2×2 complementarity problem has a closed form, all cases side by side and the right one picked. Then
//! friction is clamped to their cone. Last, where points are in each other, the bodies are moved apart by the least displacements
//! weighted by mass, unless that is done to the end by itself ([`super::part`]); no velocity comes of it but what keeps angular
//! momentum.

use super::arms::{Arms, Lanes, Response};
use super::blocks::{Block, Turned};
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, Row, SPIN, TURN, VX, VZ, X, Z};
use crate::lanes::{Eight, LANES, Numbers, Wide};
use crate::width::Work;

/// One sweep.
pub(super) struct Sweep<'a, const FRICTION: bool, const PART: bool, const TURNED: bool> {
    pub(super) rows: &'a mut [Row],
    pub(super) blocks: &'a mut [Block],
    /// As many, where touches are turned.
    pub(super) turned: &'a [Turned],
    pub(super) parting: Parting,
    /// Whether many touches do nothing: they are not taken further than to see that.
    pub(super) idles: bool,
    /// From the last touch to the first: sweeps to and fro favour neither end of a pile.
    pub(super) back: bool,
}

impl<const FRICTION: bool, const PART: bool, const TURNED: bool> Work for Sweep<'_, FRICTION, PART, TURNED> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(mut self) {
        let count = self.blocks.len();
        for at in 0..count {
            let at = if self.back { count - 1 - at } else { at };
            self.solve::<V::Low>(at);
            if V::Low::COUNT < LANES {
                self.solve::<V::High>(at);
            }
        }
    }
}

impl<const FRICTION: bool, const PART: bool, const TURNED: bool> Sweep<'_, FRICTION, PART, TURNED> {
    /// Solves the touches of a block, or some of its lanes.
    #[inline(always)]
    fn solve<V: Numbers>(&mut self, at: usize) {
        let block = &mut self.blocks[at];
        let (mut a, mut b) = (gather::<V>(self.rows, &block.row_a), gather::<V>(self.rows, &block.row_b));
        let arms = Arms::of(block, &a, &b);
        let parts = parts(block, &arms, &a, &b);
        if self.idles {
            let pushes = V::of(&block.push[0].0) + V::of(&block.push[1].0) + V::of(&block.grip.0).abs();
            let idle = !(-parts[0].min(parts[1])).max(pushes).any();
            if idle && !(PART && is_deep(room(block, &a, &b, self.parting.band))) {
                return;
            }
        }
        let response = Response::of(&arms, &a, &b);
        press(block, &arms, (&mut a, &mut b), &response, parts);
        if FRICTION {
            let slips = if TURNED { Some(V::of(&self.turned[at].slips.0)) } else { None };
            rub(block, &arms, (&mut a, &mut b), slips);
        }
        if PART {
            part_overlap(block, &arms, (&mut a, &mut b), &response, self.parting);
        }
        scatter(self.rows, &block.row_a, a);
        scatter(self.rows, &block.row_b, b);
    }
}

/// How bodies that are in each other are moved apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parting {
    /// Gaps and depths up to this are none \[m\].
    pub(super) band: f64,
    /// Whether two mobile ones keep their angular momentum about each other to the last digit: where gravity turns everything about
    /// everything else, what is lost is lost in that.
    pub(super) keeps_turning: bool,
}

/// Bodies that are in each other are moved apart, once round.
pub(super) struct Part<'a> {
    pub(super) rows: &'a mut [Row],
    pub(super) blocks: &'a [Block],
    pub(super) parting: Parting,
}

impl Work for Part<'_> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(self) {
        for block in self.blocks {
            let (mut a, mut b) = (gather::<V>(self.rows, &block.row_a), gather::<V>(self.rows, &block.row_b));
            let arms = Arms::of(block, &a, &b);
            let response = Response::of(&arms, &a, &b);
            part_overlap(block, &arms, (&mut a, &mut b), &response, self.parting);
            scatter(self.rows, &block.row_a, a);
            scatter(self.rows, &block.row_b, b);
        }
    }
}

/// The gaps at both points by now; far where the owner has slipped off the face.
#[inline(always)]
pub(super) fn gaps<V: Numbers>(block: &Block, a: &Lanes<V>, b: &Lanes<V>) -> [V; 2] {
    let (dx, dz) = (b[X] - a[X], b[Z] - a[Z]);
    let [nx, nz] = normal::<V>(block);
    let along_n = nx * dx + nz * dz;
    let slipped = nz * dx - nx * dz;
    let on_face = (slipped - V::of(&block.slip_back.0)).min(V::of(&block.slip_on.0) - slipped);
    let (gap, far) = (of::<V>(&block.gap), V::all(super::touch::FAR));
    let Arms { lever_a, lever_b, .. } = Arms::<V>::at_first(block);
    let first = gap[0] + along_n + lever_b[0] * b[TURN] - lever_a[0] * a[TURN];
    let second = gap[1] + along_n + lever_b[1] * b[TURN] - lever_a[1] * a[TURN];
    [on_face.pick(first, far), on_face.pick(second, far)]
}

/// How much deeper points may still be than they are.
#[inline(always)]
fn room<V: Numbers>(block: &Block, a: &Lanes<V>, b: &Lanes<V>, band: f64) -> [V; 2] {
    let (gap, least, band) = (gaps(block, a, b), of::<V>(&block.least), V::all(band));
    [gap[0] - least[0] + band, gap[1] - least[1] + band]
}

#[inline(always)]
fn is_deep<V: Numbers>(room: [V; 2]) -> bool {
    (-room[0].min(room[1])).any()
}

/// Moves bodies apart where they are deeper in each other than they may be by the end of the step.
#[inline(always)]
fn part_overlap<V: Numbers>(
    block: &Block,
    arms: &Arms<V>,
    (a, b): (&mut Lanes<V>, &mut Lanes<V>),
    response: &Response<V>,
    how: Parting,
) {
    let room = room(block, a, b, how.band);
    if !is_deep(room) {
        return;
    }
    let [x1, x2] = response.complement(room);
    let sum = x1 + x2;
    let turn_a = a[INVERSE_MOMENT] * (arms.lever_a[0] * x1 + arms.lever_a[1] * x2);
    let turn_b = b[INVERSE_MOMENT] * (arms.lever_b[0] * x1 + arms.lever_b[1] * x2);
    let [nx, nz] = normal::<V>(block);
    give((a, b), PLACE, [nx * sum, nz * sum], [turn_a, turn_b]);
    if how.keeps_turning {
        keep_turning((a, b), arms.along_b - arms.along_a, sum, [nx, nz]);
    }
}

/// Two mobile bodies that lay so far from each other have been moved apart by that impulse: their angular momentum about each other
/// stays. They slide past each other less fast by then, as a skater turns less fast with arms spread; where their centres have
/// passed each other both turn instead.
#[inline(always)]
fn keep_turning<V: Numbers>((a, b): (&mut Lanes<V>, &mut Lanes<V>), before: V, apart: V, [nx, nz]: [V; 2]) {
    let (mass_a, mass_b) = (a[INVERSE_MASS], b[INVERSE_MASS]);
    let (turns_a, turns_b, zero) = (a[INVERSE_MOMENT], b[INVERSE_MOMENT], V::zero());
    let after = before + (mass_a + mass_b) * apart;
    let passed = before.less(zero).max(zero.at_least(after));
    let by = passed.pick(turns_a + turns_b, after);
    let both = zero.less(mass_a.min(mass_b).min(by));
    let share = both.pick(apart, zero) / both.pick(by, V::all(1.0));
    let slide = nz * (b[VX] - a[VX]) - nx * (b[VZ] - a[VZ]);
    let slower = passed.pick(zero, -(share * slide));
    let turn = passed.pick(share * (turns_a * turns_b) * slide, zero);
    give((a, b), MOTION, [nz * slower, -(nx * slower)], [-turn, turn]);
}

/// Friction: against the slip, but for what it is to be, as far as the pushes hold it.
#[inline(always)]
fn rub<V: Numbers>(block: &mut Block, arms: &Arms<V>, (a, b): (&mut Lanes<V>, &mut Lanes<V>), slips: Option<V>) {
    let mass = a[INVERSE_MASS] + b[INVERSE_MASS];
    let (turn_a, turn_b) = (a[INVERSE_MOMENT] * arms.along_a, b[INVERSE_MOMENT] * arms.along_b);
    let k = mass + turn_a * arms.along_a + turn_b * arms.along_b;
    let ((ux, uz), [nx, nz]) = ((b[VX] - a[VX], b[VZ] - a[VZ]), normal::<V>(block));
    let slip = nz * ux - nx * uz + arms.along_b * b[SPIN] - arms.along_a * a[SPIN];
    let slip = if let Some(slips) = slips { slip - slips } else { slip };
    let ([p1, p2], before) = (of::<V>(&block.push), V::of(&block.grip.0));
    let most = V::of(&block.friction.0) * (p1 + p2);
    let grip = (before - slip * k.inverse()).min(most).max(-most);
    let more = grip - before;
    grip.put(&mut block.grip);
    give((a, b), MOTION, [nz * more, -(nx * more)], [turn_a * more, turn_b * more]);
}

/// How much faster each point parts than it is asked to.
#[inline(always)]
pub(super) fn parts<V: Numbers>(block: &Block, arms: &Arms<V>, a: &Lanes<V>, b: &Lanes<V>) -> [V; 2] {
    let [nx, nz] = normal::<V>(block);
    let along_n = nx * (b[VX] - a[VX]) + nz * (b[VZ] - a[VZ]);
    let u1 = along_n + arms.lever_b[0] * b[SPIN] - arms.lever_a[0] * a[SPIN];
    let u2 = along_n + arms.lever_b[1] * b[SPIN] - arms.lever_a[1] * a[SPIN];
    let asked = of::<V>(&block.asked);
    [u1 - asked[0], u2 - asked[1]]
}

/// The pushes at both points.
#[inline(always)]
fn press<V: Numbers>(
    block: &mut Block,
    arms: &Arms<V>,
    (a, b): (&mut Lanes<V>, &mut Lanes<V>),
    response: &Response<V>,
    parts: [V; 2],
) {
    let ([nx, nz], [p1, p2]) = (normal::<V>(block), of::<V>(&block.push));
    // Without the pushes so far.
    let q1 = parts[0] - (response.k[0] * p1 + response.across * p2);
    let q2 = parts[1] - (response.across * p1 + response.k[1] * p2);
    let [x1, x2] = response.complement([q1, q2]);
    let (d1, d2) = (x1 - p1, x2 - p2);
    x1.put(&mut block.push[0]);
    x2.put(&mut block.push[1]);
    let sum = d1 + d2;
    let turn_a = a[INVERSE_MOMENT] * (arms.lever_a[0] * d1 + arms.lever_a[1] * d2);
    let turn_b = b[INVERSE_MOMENT] * (arms.lever_b[0] * d1 + arms.lever_b[1] * d2);
    give((a, b), MOTION, [nx * sum, nz * sum], [turn_a, turn_b]);
}

/// The places of a row that displacements change, and those that impulses do.
const PLACE: [usize; 3] = [X, Z, TURN];
const MOTION: [usize; 3] = [VX, VZ, SPIN];

/// Gives p to b and −p to a, by their masses, with what it turns them; at those places of their rows.
#[inline(always)]
fn give<V: Numbers>((a, b): (&mut Lanes<V>, &mut Lanes<V>), [x, z, turn]: [usize; 3], p: [V; 2], turned: [V; 2]) {
    a[x] = a[x] - a[INVERSE_MASS] * p[0];
    a[z] = a[z] - a[INVERSE_MASS] * p[1];
    a[turn] = a[turn] - turned[0];
    b[x] = b[x] + b[INVERSE_MASS] * p[0];
    b[z] = b[z] + b[INVERSE_MASS] * p[1];
    b[turn] = b[turn] + turned[1];
}

/// What pushes at both points and friction along the face come to: the impulse that b is given, and how much it turns a and b.
#[inline(always)]
pub(super) fn given<V: Numbers>(block: &Block, arms: &Arms<V>, [p1, p2, pt]: [V; 3]) -> [V; 4] {
    let (sum, [nx, nz]) = (p1 + p2, normal::<V>(block));
    let twist = |lever: [V; 2], along: V| lever[0] * p1 + lever[1] * p2 + along * pt;
    let twists = [twist(arms.lever_a, arms.along_a), twist(arms.lever_b, arms.along_b)];
    [nx * sum + nz * pt, nz * sum - nx * pt, twists[0], twists[1]]
}

/// Gives pushes at both points and friction along the face to the bodies of a block.
#[inline(always)]
pub(super) fn push<V: Numbers>(block: &Block, rows: &mut [Row], pushes: [V; 3]) {
    let (mut a, mut b) = (gather::<V>(rows, &block.row_a), gather::<V>(rows, &block.row_b));
    let [x, z, twist_a, twist_b] = given(block, &Arms::of(block, &a, &b), pushes);
    let turned = [a[INVERSE_MOMENT] * twist_a, b[INVERSE_MOMENT] * twist_b];
    give((&mut a, &mut b), MOTION, [x, z], turned);
    scatter(rows, &block.row_a, a);
    scatter(rows, &block.row_b, b);
}

/// The rows of a block's bodies on one side, a column for each of their numbers.
#[inline(always)]
pub(super) fn gather<V: Numbers>(rows: &[Row], at: &[u32; LANES]) -> Lanes<V> {
    V::gather(|k| &rows[at[V::FIRST + k] as usize].0)
}

/// Puts them back.
#[inline(always)]
pub(super) fn scatter<V: Numbers>(rows: &mut [Row], at: &[u32; LANES], lanes: Lanes<V>) {
    V::scatter(lanes, |k, row| rows[at[V::FIRST + k] as usize].0 = row.0);
}

/// Two of a block's columns.
#[inline(always)]
pub(super) fn of<V: Numbers>([first, second]: &[Eight; 2]) -> [V; 2] {
    [V::of(&first.0), V::of(&second.0)]
}

/// The normals of a block's touches.
#[inline(always)]
pub(super) fn normal<V: Numbers>(block: &Block) -> [V; 2] {
    [V::of(&block.nx.0), V::of(&block.nz.0)]
}
