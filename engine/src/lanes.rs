//! Eight numbers treated alike: what a processor with wide registers does at once and any other one after the other.
//!
//! [`Eight`] is how they lie in memory, and what a processor without wide registers computes with; [`Numbers`] and [`Wide`] are
//! what all that computes with them is written for. Every lane sees the same operations in the same order at any width, and
//! nothing is fused or reordered, so the bits are the same everywhere.
//!
//! A yes or no in every lane is a number too: 1 or −1, for [`Numbers::pick`]; `a.min(b)` is then a and b, `a.max(b)` a or b, `−a` not a.

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

/// Numbers as a processor computes with them, in registers of some width: eight, or as many as one register has. All methods
/// are to be marked `#[inline(always)]`: they are compiled for that width where they are used ([`crate::width`]).
pub(crate) trait Numbers:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// Which of eight lanes they are: the first of them, and how many.
    const FIRST: usize = 0;
    const COUNT: usize = LANES;

    /// Their lanes of eight.
    fn of(numbers: &[f64; LANES]) -> Self;

    /// As they lie in memory; 0 in other lanes.
    fn eight(self) -> Eight;

    /// Puts them into their lanes of eight.
    #[inline(always)]
    fn put(self, eight: &mut Eight) {
        *eight = self.eight();
    }

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

    /// The columns of rows of four, one for every lane: what is told of bodies becomes lanes.
    fn columns(row: impl FnMut(usize) -> [f64; 4]) -> [Self; 4];

    /// The columns of rows of eight, and back: so many rows as there are lanes.
    fn gather<'a>(row: impl FnMut(usize) -> &'a [f64; LANES]) -> [Self; LANES];
    fn scatter(columns: [Self; LANES], put: impl FnMut(usize, Eight));

    #[inline(always)]
    fn zero() -> Self {
        Self::all(0.0)
    }

    /// One over each.
    #[inline(always)]
    fn inverse(self) -> Self {
        Self::all(1.0) / self
    }
}

/// Eight numbers.
pub(crate) trait Wide: Numbers {
    /// The lanes of one register, and the others if there are others: for what needs more numbers at a time than there are
    /// registers for eight.
    type Low: Numbers;
    type High: Numbers;

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
impl Numbers for Eight {
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

    #[inline(always)]
    fn columns(mut row: impl FnMut(usize) -> [f64; 4]) -> [Eight; 4] {
        let mut columns = [Eight::ZERO; 4];
        for k in 0..LANES {
            let row = row(k);
            for (column, number) in columns.iter_mut().zip(row) {
                column.0[k] = number;
            }
        }
        columns
    }

    #[inline(always)]
    fn gather<'a>(mut row: impl FnMut(usize) -> &'a [f64; LANES]) -> [Eight; LANES] {
        let mut rows = [Eight::ZERO; LANES];
        for k in 0..LANES {
            rows[k] = Eight(*row(k));
        }
        transpose(rows)
    }

    #[inline(always)]
    fn scatter(columns: [Eight; LANES], mut put: impl FnMut(usize, Eight)) {
        let rows = transpose(columns);
        for k in 0..LANES {
            put(k, rows[k]);
        }
    }
}

impl Wide for Eight {
    type Low = Eight;
    type High = Eight;
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
