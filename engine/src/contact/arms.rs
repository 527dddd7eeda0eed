//! The levers of a block's touches on their bodies, and how velocities answer pushes there.

use super::blocks::Block;
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, X, Z};
use super::sweep::{normal, of};
use crate::lanes::{LANES, Numbers};
use core::ops::{Add, Mul, Sub};

/// A determinant below this share of its terms is none.
const SAME: f64 = 1e-12;

/// The rows of bodies, a column for each of their numbers.
pub(super) type Lanes<V> = [V; LANES];

/// The levers of a block by now: the bodies may have slipped past each other since the step began, and both levers must lead
/// to the same place, for angular momentum to be kept to the last digit.
#[derive(Clone, Copy)]
pub(super) struct Arms<V> {
    pub(super) lever_a: [V; 2],
    pub(super) lever_b: [V; 2],
    pub(super) along_a: V,
    pub(super) along_b: V,
}

impl<V: Numbers> Arms<V> {
    /// The levers as the step began.
    #[inline(always)]
    pub(super) fn at_first(block: &Block) -> Arms<V> {
        Arms {
            lever_a: of(&block.lever_a),
            lever_b: of(&block.lever_b),
            along_a: V::of(&block.along_a.0),
            along_b: V::of(&block.along_b.0),
        }
    }

    #[inline(always)]
    pub(super) fn of(block: &Block, a: &Lanes<V>, b: &Lanes<V>) -> Arms<V> {
        Arms::slipped(block, a, b, V::all(0.5))
    }

    /// The same between two mobile bodies; on a fixed one, which takes any angular momentum, those as the step began.
    #[inline(always)]
    pub(super) fn between_mobile(block: &Block, a: &Lanes<V>, b: &Lanes<V>) -> Arms<V> {
        let both = V::zero().less(a[INVERSE_MASS].min(b[INVERSE_MASS]));
        Arms::slipped(block, a, b, both.pick(V::all(0.5), V::zero()))
    }

    #[inline(always)]
    fn slipped(block: &Block, a: &Lanes<V>, b: &Lanes<V>, half: V) -> Arms<V> {
        Arms::at_first(block).moved(normal::<V>(block), [b[X] - a[X], b[Z] - a[Z]], half)
    }
}

impl Arms<f64> {
    /// The same in one lane, with the rows of its bodies.
    pub(super) fn in_lane(block: &Block, lane: usize, a: &[f64; LANES], b: &[f64; LANES]) -> Arms<f64> {
        let first = Arms {
            lever_a: block.lever_a.map(|lever| lever.0[lane]),
            lever_b: block.lever_b.map(|lever| lever.0[lane]),
            along_a: block.along_a.0[lane],
            along_b: block.along_b.0[lane],
        };
        first.moved([block.nx.0[lane], block.nz.0[lane]], [b[X] - a[X], b[Z] - a[Z]], 0.5)
    }
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Arms<T> {
    /// Where b has moved on by d from a since: both levers by half of it.
    #[inline(always)]
    fn moved(self, [nx, nz]: [T; 2], [dx, dz]: [T; 2], half: T) -> Arms<T> {
        let apart = (nx * dx + nz * dz) * half;
        let slipped = (nz * dx - nx * dz) * half;
        let Arms { lever_a, lever_b, along_a, along_b } = self;
        Arms {
            lever_a: [lever_a[0] + slipped, lever_a[1] + slipped],
            lever_b: [lever_b[0] - slipped, lever_b[1] - slipped],
            along_a: along_a - apart,
            along_b: along_b + apart,
        }
    }
}

/// How velocities at the two points answer pushes there.
pub(super) struct Response<V> {
    pub(super) k: [V; 2],
    pub(super) across: V,
    /// 1/det, 1/k.
    inverse: V,
    alone: [V; 2],
}

impl<V: Numbers> Response<V> {
    #[inline(always)]
    pub(super) fn of(arms: &Arms<V>, a: &Lanes<V>, b: &Lanes<V>) -> Response<V> {
        Response::with(arms, (a[INVERSE_MASS], a[INVERSE_MOMENT]), (b[INVERSE_MASS], b[INVERSE_MOMENT]))
    }

    /// The response of bodies with these inverse masses and moments.
    #[inline(always)]
    pub(super) fn with(arms: &Arms<V>, (mass_a, turn_a): (V, V), (mass_b, turn_b): (V, V)) -> Response<V> {
        let mass = mass_a + mass_b;
        let ([a1, a2], [b1, b2]) = (arms.lever_a, arms.lever_b);
        let (ta1, tb1) = (turn_a * a1, turn_b * b1);
        let k1 = mass + ta1 * a1 + tb1 * b1;
        let k2 = mass + turn_a * a2 * a2 + turn_b * b2 * b2;
        let across = mass + ta1 * a2 + tb1 * b2;
        // Two points with the same levers answer alike: what is then left of the determinant is rounding.
        let inverse = (k1 * k2 - across * across).max(k1 * k2 * V::all(SAME)).inverse();
        Response { k: [k1, k2], across, inverse, alone: [k1.inverse(), k2.inverse()] }
    }

    /// The least x ≥ 0 with w = q + K x ≥ 0 and x·w = 0, exactly.
    #[inline(always)]
    pub(super) fn complement(&self, [q1, q2]: [V; 2]) -> [V; 2] {
        let both1 = (self.across * q2 - self.k[1] * q1) * self.inverse;
        let both2 = (self.across * q1 - self.k[0] * q2) * self.inverse;
        let zero = V::zero();
        let only1 = (-q1 * self.alone[0]).max(zero);
        let only2 = (-q2 * self.alone[1]).max(zero);
        let left2 = q2 + self.across * only1;
        let one1 = left2.pick(only1, zero);
        let one2 = left2.pick(zero, only2);
        let both = both1.min(both2);
        [both.pick(both1, one1), both.pick(both2, one2)]
    }
}
