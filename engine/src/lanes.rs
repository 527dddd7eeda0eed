//! Eight numbers treated alike: what a processor with wide registers does at once and any other one after the other.
//!
//! [`Eight`] is how they lie in memory, and what a processor without wide registers computes with; [`Wide`] is what all that
//! computes with eight numbers is written for. Every lane sees the same operations in the same order at any width, and
//! nothing is fused or reordered, so the bits are the same everywhere.
//!
//! A yes or no in every lane is a number too: 1 or −1, for [`Wide::pick`]; `a.min(b)` is then a and b, `a.max(b)` a or b, `−a` not a.

// Lanes by their index: loops of this form become vector instructions.
#![allow(clippy::needless_range_loop)]

use core::ops::{Add, Div, Mul, Neg, Sub};

/// How many lanes there are.
pub(crate) const LANES: usize = 8;

/// Eight numbers as they lie in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Eight(pub(crate) [f64; LANES]);

impl Eight {
    pub(crate) const ZERO: Eight = Eight([0.0; LANES]);

    /// The same number in every lane.
    #[inline(always)]
    pub(crate) const fn all(value: f64) -> Eight {
        Eight([value; LANES])
    }
}

/// Eight numbers as a processor computes with them, in registers of some width. All methods are to be marked
/// `#[inline(always)]`: they are compiled for that width where they are used ([`crate::width`]).
pub(crate) trait Wide:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    fn of(numbers: &[f64; LANES]) -> Self;

    fn eight(self) -> Eight;

    /// The same number in every lane.
    fn all(value: f64) -> Self;

    /// The greater of each two; the second where they do not compare.
    fn max(self, other: Self) -> Self;

    /// The less of each two; the second where they do not compare.
    fn min(self, other: Self) -> Self;

    /// Without signs.
    fn abs(self) -> Self;

    /// The square root of each.
    fn root(self) -> Self;

    /// Lane by lane: the first where this is not negative, else the second.
    fn pick(self, where_not_negative: Self, otherwise: Self) -> Self;

    /// Whether each is less than the other.
    fn less(self, other: Self) -> Self;

    /// Whether each is at least as great as the other.
    fn at_least(self, other: Self) -> Self;

    /// Whether any is greater than 0.
    fn any(self) -> bool;

    /// Eight rows of eight become eight columns: rows of bodies become lanes, and back.
    fn transpose(rows: [Self; LANES]) -> [Self; LANES];

    #[inline(always)]
    fn zero() -> Self {
        Self::all(0.0)
    }

    /// One over each.
    #[inline(always)]
    fn inverse(self) -> Self {
        Self::all(1.0) / self
    }

    /// All lanes together, pair by pair.
    #[inline(always)]
    fn sum(self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.eight().0;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }

    /// The greatest of all lanes.
    #[inline(always)]
    fn greatest(self) -> f64 {
        self.eight().0.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }
}

macro_rules! lanewise {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl $trait for Eight {
            type Output = Eight;

            #[inline(always)]
            fn $method(self, other: Eight) -> Eight {
                let mut out = self.0;
                for k in 0..LANES {
                    out[k] = self.0[k] $operator other.0[k];
                }
                Eight(out)
            }
        }
    };
}

lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

impl Neg for Eight {
    type Output = Eight;

    #[inline(always)]
    fn neg(self) -> Eight {
        Eight::ZERO - self
    }
}

/// Plain arrays and loops of a fixed length, which the compiler turns into such vector instructions as every processor of the
/// platform has.
impl Wide for Eight {
    #[inline(always)]
    fn of(numbers: &[f64; LANES]) -> Eight {
        Eight(*numbers)
    }

    #[inline(always)]
    fn eight(self) -> Eight {
        self
    }

    #[inline(always)]
    fn all(value: f64) -> Eight {
        Eight::all(value)
    }

    #[inline(always)]
    fn max(self, other: Eight) -> Eight {
        let mut out = other.0;
        for k in 0..LANES {
            out[k] = if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] };
        }
        Eight(out)
    }

    #[inline(always)]
    fn min(self, other: Eight) -> Eight {
        let mut out = other.0;
        for k in 0..LANES {
            out[k] = if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] };
        }
        Eight(out)
    }

    #[inline(always)]
    fn abs(self) -> Eight {
        let mut out = self.0;
        for value in &mut out {
            *value = value.abs();
        }
        Eight(out)
    }

    #[inline(always)]
    fn root(self) -> Eight {
        let mut out = self.0;
        for value in &mut out {
            *value = value.sqrt();
        }
        Eight(out)
    }

    #[inline(always)]
    fn pick(self, where_not_negative: Eight, otherwise: Eight) -> Eight {
        let mut out = otherwise.0;
        for k in 0..LANES {
            out[k] = if self.0[k] >= 0.0 { where_not_negative.0[k] } else { otherwise.0[k] };
        }
        Eight(out)
    }

    #[inline(always)]
    fn less(self, other: Eight) -> Eight {
        let mut out = [-1.0; LANES];
        for k in 0..LANES {
            out[k] = if self.0[k] < other.0[k] { 1.0 } else { -1.0 };
        }
        Eight(out)
    }

    #[inline(always)]
    fn at_least(self, other: Eight) -> Eight {
        let mut out = [-1.0; LANES];
        for k in 0..LANES {
            out[k] = if self.0[k] >= other.0[k] { 1.0 } else { -1.0 };
        }
        Eight(out)
    }

    #[inline(always)]
    fn any(self) -> bool {
        let mut any = false;
        for value in self.0 {
            any |= value > 0.0;
        }
        any
    }

    /// Three rounds of exchanges between rows: by pairs, by fours, by halves.
    #[inline(always)]
    fn transpose(rows: [Eight; LANES]) -> [Eight; LANES] {
        let mut pairs = [Eight::ZERO; LANES];
        for k in 0..4 {
            for h in 0..4 {
                pairs[2 * k].0[2 * h] = rows[2 * k].0[2 * h];
                pairs[2 * k].0[2 * h + 1] = rows[2 * k + 1].0[2 * h];
                pairs[2 * k + 1].0[2 * h] = rows[2 * k].0[2 * h + 1];
                pairs[2 * k + 1].0[2 * h + 1] = rows[2 * k + 1].0[2 * h + 1];
            }
        }
        let mut fours = [Eight::ZERO; LANES];
        for k in [0, 4] {
            for h in 0..2 {
                for q in [0, 4] {
                    for e in 0..2 {
                        fours[k + h].0[q + e] = pairs[k + h].0[q + e];
                        fours[k + h].0[q + 2 + e] = pairs[k + 2 + h].0[q + e];
                        fours[k + 2 + h].0[q + e] = pairs[k + h].0[q + 2 + e];
                        fours[k + 2 + h].0[q + 2 + e] = pairs[k + 2 + h].0[q + 2 + e];
                    }
                }
            }
        }
        let mut out = [Eight::ZERO; LANES];
        for h in 0..4 {
            for e in 0..4 {
                out[h].0[e] = fours[h].0[e];
                out[h].0[4 + e] = fours[4 + h].0[e];
                out[4 + h].0[e] = fours[h].0[4 + e];
                out[4 + h].0[4 + e] = fours[4 + h].0[4 + e];
            }
        }
        out
    }
}
