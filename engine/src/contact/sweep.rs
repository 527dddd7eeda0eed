//! A sweep over all touches: each is solved exactly, with the motions its bodies have by then (block Gauss–Seidel).
//!
//! A touch has two points and one friction between them. Where points are in each other, first the bodies are moved apart, by
//! the least displacements weighted by mass, unless that is done to the end by itself ([`super::part`]); no velocity comes of it. Then friction is clamped to the cone of the pushes so far,
//! and the pushes are solved: u ≥ what the point asks ([`super::look`]), push ≥ 0, and one of the two exact. That 2×2
//! complementarity problem is solved in closed form, all cases side by side and the right one picked.

use super::blocks::Block;
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, Row, SPIN, TURN, VX, VZ, X, Z};
use crate::lanes::{Eight, LANES};
use crate::width::{self, Work};

/// A determinant below this share of its terms is none.
const SAME: f64 = 1e-12;

/// One sweep.
pub(super) struct Sweep<'a, const FRICTION: bool, const PART: bool> {
    pub(super) rows: &'a mut [Row],
    pub(super) blocks: &'a mut [Block],
    /// Gaps and depths up to this are none \[m\].
    pub(super) band: f64,
    /// From the last touch to the first: sweeps to and fro favour neither end of a pile.
    pub(super) back: bool,
}

impl<const FRICTION: bool, const PART: bool> Work for Sweep<'_, FRICTION, PART> {
    type Out = ();

    #[inline(always)]
    fn run<const W: usize>(self) {
        let count = self.blocks.len();
        for at in 0..count {
            let block = &mut self.blocks[if self.back { count - 1 - at } else { at }];
            let (mut a, mut b) = (gather::<W>(self.rows, &block.row_a), gather::<W>(self.rows, &block.row_b));
            let arms = Arms::of(block, &a, &b);
            let response = Response::of(&arms, &a, &b);
            if PART {
                let (gap, band) = (gaps(block, &a, &b), Eight::all(self.band));
                part_overlap(block, &arms, (&mut a, &mut b), &response, gap, band);
            }
            press(block, &arms, (&mut a, &mut b), &response);
            if FRICTION {
                rub(block, &arms, (&mut a, &mut b));
            }
            scatter::<W>(self.rows, &block.row_a, a);
            scatter::<W>(self.rows, &block.row_b, b);
        }
    }
}

/// Bodies that are in each other are moved apart, once round; velocities stay.
pub(super) struct Part<'a> {
    pub(super) rows: &'a mut [Row],
    pub(super) blocks: &'a [Block],
    pub(super) band: f64,
}

impl Work for Part<'_> {
    type Out = ();

    #[inline(always)]
    fn run<const W: usize>(self) {
        for block in self.blocks {
            let (mut a, mut b) = (gather::<W>(self.rows, &block.row_a), gather::<W>(self.rows, &block.row_b));
            let arms = Arms::of(block, &a, &b);
            let response = Response::of(&arms, &a, &b);
            let gap = gaps(block, &a, &b);
            part_overlap(block, &arms, (&mut a, &mut b), &response, gap, Eight::all(self.band));
            scatter::<W>(self.rows, &block.row_a, a);
            scatter::<W>(self.rows, &block.row_b, b);
        }
    }
}

pub(super) type Lanes = [Eight; LANES];

/// The levers of a block by now: the bodies may have slipped past each other since the step began, and both levers must lead
/// to the same place, for angular momentum to be kept to the last digit.
pub(super) struct Arms {
    pub(super) lever_a: [Eight; 2],
    pub(super) lever_b: [Eight; 2],
    pub(super) along_a: Eight,
    pub(super) along_b: Eight,
}

impl Arms {
    /// The levers as the step began.
    #[inline(always)]
    pub(super) fn at_first(block: &Block) -> Arms {
        let &Block { lever_a, lever_b, along_a, along_b, .. } = block;
        Arms { lever_a, lever_b, along_a, along_b }
    }

    #[inline(always)]
    pub(super) fn of(block: &Block, a: &Lanes, b: &Lanes) -> Arms {
        let (dx, dz) = (b[X] - a[X], b[Z] - a[Z]);
        let half = Eight::all(0.5);
        let apart = (block.nx * dx + block.nz * dz) * half;
        let slipped = (block.nz * dx - block.nx * dz) * half;
        Arms {
            lever_a: block.lever_a.map(|lever| lever + slipped),
            lever_b: block.lever_b.map(|lever| lever - slipped),
            along_a: block.along_a - apart,
            along_b: block.along_b + apart,
        }
    }
}

/// How velocities at the two points answer pushes there.
pub(super) struct Response {
    pub(super) k: [Eight; 2],
    pub(super) across: Eight,
    /// 1/det, 1/k.
    inverse: Eight,
    alone: [Eight; 2],
}

impl Response {
    #[inline(always)]
    fn of(arms: &Arms, a: &Lanes, b: &Lanes) -> Response {
        Response::with(arms, (a[INVERSE_MASS], a[INVERSE_MOMENT]), (b[INVERSE_MASS], b[INVERSE_MOMENT]))
    }

    /// The response of bodies with these inverse masses and moments.
    #[inline(always)]
    pub(super) fn with(arms: &Arms, (mass_a, turn_a): (Eight, Eight), (mass_b, turn_b): (Eight, Eight)) -> Response {
        let mass = mass_a + mass_b;
        let ([a1, a2], [b1, b2]) = (arms.lever_a, arms.lever_b);
        let (ta1, tb1) = (turn_a * a1, turn_b * b1);
        let k1 = mass + ta1 * a1 + tb1 * b1;
        let k2 = mass + turn_a * a2 * a2 + turn_b * b2 * b2;
        let across = mass + ta1 * a2 + tb1 * b2;
        // Two points with the same levers answer alike: what is then left of the determinant is rounding.
        let inverse = (k1 * k2 - across * across).max(k1 * k2 * Eight::all(SAME)).inverse();
        Response { k: [k1, k2], across, inverse, alone: [k1.inverse(), k2.inverse()] }
    }

    /// The least x ≥ 0 with w = q + K x ≥ 0 and x·w = 0, exactly.
    #[inline(always)]
    pub(super) fn complement(&self, [q1, q2]: [Eight; 2]) -> [Eight; 2] {
        let both1 = (self.across * q2 - self.k[1] * q1) * self.inverse;
        let both2 = (self.across * q1 - self.k[0] * q2) * self.inverse;
        let only1 = (-q1 * self.alone[0]).max(Eight::ZERO);
        let only2 = (-q2 * self.alone[1]).max(Eight::ZERO);
        let left2 = q2 + self.across * only1;
        let one1 = left2.pick(only1, Eight::ZERO);
        let one2 = left2.pick(Eight::ZERO, only2);
        let both = both1.min(both2);
        [both.pick(both1, one1), both.pick(both2, one2)]
    }
}

/// The gaps at both points by now; far where the owner has slipped off the face.
#[inline(always)]
pub(super) fn gaps(block: &Block, a: &Lanes, b: &Lanes) -> [Eight; 2] {
    let (dx, dz) = (b[X] - a[X], b[Z] - a[Z]);
    let along_n = block.nx * dx + block.nz * dz;
    let slipped = block.nz * dx - block.nx * dz;
    let on_face = (slipped - block.slip_back).min(block.slip_on - slipped);
    let gap = |k: usize| {
        let now = block.gap[k] + along_n + block.lever_b[k] * b[TURN] - block.lever_a[k] * a[TURN];
        on_face.pick(now, Eight::all(super::touch::FAR))
    };
    [gap(0), gap(1)]
}

/// Moves bodies apart where they are deeper in each other than they may be by the end of the step.
#[inline(always)]
fn part_overlap(
    block: &Block,
    arms: &Arms,
    (a, b): (&mut Lanes, &mut Lanes),
    response: &Response,
    gap: [Eight; 2],
    band: Eight,
) {
    let too_deep = [gap[0] - block.least[0] + band, gap[1] - block.least[1] + band];
    let [x1, x2] = response.complement(too_deep);
    let sum = x1 + x2;
    let turn_a = a[INVERSE_MOMENT] * (arms.lever_a[0] * x1 + arms.lever_a[1] * x2);
    let turn_b = b[INVERSE_MOMENT] * (arms.lever_b[0] * x1 + arms.lever_b[1] * x2);
    give((a, b), PLACE, [block.nx * sum, block.nz * sum], [turn_a, turn_b]);
}

/// Friction: against the slip, as far as the pushes hold it.
#[inline(always)]
fn rub(block: &mut Block, arms: &Arms, (a, b): (&mut Lanes, &mut Lanes)) {
    let mass = a[INVERSE_MASS] + b[INVERSE_MASS];
    let (turn_a, turn_b) = (a[INVERSE_MOMENT] * arms.along_a, b[INVERSE_MOMENT] * arms.along_b);
    let k = mass + turn_a * arms.along_a + turn_b * arms.along_b;
    let (ux, uz) = (b[VX] - a[VX], b[VZ] - a[VZ]);
    let slip = block.nz * ux - block.nx * uz + arms.along_b * b[SPIN] - arms.along_a * a[SPIN] - block.slips;
    let most = block.friction * (block.push[0] + block.push[1]);
    let grip = (block.grip - slip * k.inverse()).min(most).max(-most);
    let more = grip - block.grip;
    block.grip = grip;
    give((a, b), MOTION, [block.nz * more, -(block.nx * more)], [turn_a * more, turn_b * more]);
}

/// The pushes at both points.
#[inline(always)]
fn press(block: &mut Block, arms: &Arms, (a, b): (&mut Lanes, &mut Lanes), response: &Response) {
    let along_n = block.nx * (b[VX] - a[VX]) + block.nz * (b[VZ] - a[VZ]);
    let u = |k: usize| along_n + arms.lever_b[k] * b[SPIN] - arms.lever_a[k] * a[SPIN];
    let [p1, p2] = block.push;
    // Without the pushes so far.
    let q1 = u(0) - block.asked[0] - (response.k[0] * p1 + response.across * p2);
    let q2 = u(1) - block.asked[1] - (response.across * p1 + response.k[1] * p2);
    let [x1, x2] = response.complement([q1, q2]);
    let (d1, d2) = (x1 - p1, x2 - p2);
    block.push = [x1, x2];
    let sum = d1 + d2;
    let turn_a = a[INVERSE_MOMENT] * (arms.lever_a[0] * d1 + arms.lever_a[1] * d2);
    let turn_b = b[INVERSE_MOMENT] * (arms.lever_b[0] * d1 + arms.lever_b[1] * d2);
    give((a, b), MOTION, [block.nx * sum, block.nz * sum], [turn_a, turn_b]);
}

/// The places of a row that displacements change, and those that impulses do.
const PLACE: [usize; 3] = [X, Z, TURN];
const MOTION: [usize; 3] = [VX, VZ, SPIN];

/// Gives p to b and −p to a, by their masses, with what it turns them; at those places of their rows.
#[inline(always)]
fn give((a, b): (&mut Lanes, &mut Lanes), [x, z, turn]: [usize; 3], p: [Eight; 2], turned: [Eight; 2]) {
    a[x] = a[x] - a[INVERSE_MASS] * p[0];
    a[z] = a[z] - a[INVERSE_MASS] * p[1];
    a[turn] = a[turn] - turned[0];
    b[x] = b[x] + b[INVERSE_MASS] * p[0];
    b[z] = b[z] + b[INVERSE_MASS] * p[1];
    b[turn] = b[turn] + turned[1];
}

/// Gives pushes at both points and friction along the face to the bodies of a block.
#[inline(always)]
pub(super) fn push<const W: usize>(
    block: &Block,
    arms: impl Fn(&Lanes, &Lanes) -> Arms,
    rows: &mut [Row],
    [p1, p2, pt]: [Eight; 3],
) {
    let (mut a, mut b) = (gather::<W>(rows, &block.row_a), gather::<W>(rows, &block.row_b));
    let arms = arms(&a, &b);
    let sum = p1 + p2;
    let p = [block.nx * sum + block.nz * pt, block.nz * sum - block.nx * pt];
    let turn_a = a[INVERSE_MOMENT] * (arms.lever_a[0] * p1 + arms.lever_a[1] * p2 + arms.along_a * pt);
    let turn_b = b[INVERSE_MOMENT] * (arms.lever_b[0] * p1 + arms.lever_b[1] * p2 + arms.along_b * pt);
    give((&mut a, &mut b), MOTION, p, [turn_a, turn_b]);
    scatter::<W>(rows, &block.row_a, a);
    scatter::<W>(rows, &block.row_b, b);
}

/// The rows of eight bodies, a column for each of their numbers.
#[inline(always)]
pub(super) fn gather<const W: usize>(rows: &[Row], at: &[u32; LANES]) -> Lanes {
    width::transpose::<W>(core::array::from_fn(|k| Eight(rows[at[k] as usize].0)))
}

/// Puts them back.
#[inline(always)]
pub(super) fn scatter<const W: usize>(rows: &mut [Row], at: &[u32; LANES], lanes: Lanes) {
    let out = width::transpose::<W>(lanes);
    for k in 0..LANES {
        rows[at[k] as usize].0 = out[k].0;
    }
}
