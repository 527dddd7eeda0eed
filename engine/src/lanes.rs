//! Eight numbers treated alike: what a processor with wide registers does at once and any other one after the other.
//!
//! Plain arrays and loops of a fixed length, which the compiler turns into vector instructions of whatever width a function
//! is compiled for ([`crate::width`]). Every lane sees the same operations in the same order at any width, and nothing is fused
//! or reordered, so the bits are the same everywhere.

// Lanes by their index: loops of this form become vector instructions.
#![allow(clippy::needless_range_loop)]

use core::ops::{Add, Mul, Neg, Sub};

/// How many lanes there are.
pub(crate) const LANES: usize = 8;

/// Eight numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Eight(pub(crate) [f64; LANES]);

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

impl Neg for Eight {
    type Output = Eight;

    #[inline(always)]
    fn neg(self) -> Eight {
        Eight::ZERO - self
    }
}

impl Eight {
    pub(crate) const ZERO: Eight = Eight([0.0; LANES]);

    /// The same number in every lane.
    #[inline(always)]
    pub(crate) const fn all(value: f64) -> Eight {
        Eight([value; LANES])
    }

    /// One over each.
    #[inline(always)]
    pub(crate) fn inverse(self) -> Eight {
        let mut out = self.0;
        for value in &mut out {
            *value = 1.0 / *value;
        }
        Eight(out)
    }

    /// The greater of each two; the second where they do not compare.
    #[inline(always)]
    pub(crate) fn max(self, other: Eight) -> Eight {
        let mut out = other.0;
        for k in 0..LANES {
            out[k] = if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] };
        }
        Eight(out)
    }

    /// The less of each two; the second where they do not compare.
    #[inline(always)]
    pub(crate) fn min(self, other: Eight) -> Eight {
        let mut out = other.0;
        for k in 0..LANES {
            out[k] = if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] };
        }
        Eight(out)
    }

    /// Without signs.
    #[inline(always)]
    pub(crate) fn abs(self) -> Eight {
        Eight(self.0.map(f64::abs))
    }

    /// Lane by lane: the first where this is not negative, else the second.
    #[inline(always)]
    pub(crate) fn pick(self, where_not_negative: Eight, otherwise: Eight) -> Eight {
        let mut out = otherwise.0;
        for k in 0..LANES {
            out[k] = if self.0[k] >= 0.0 { where_not_negative.0[k] } else { otherwise.0[k] };
        }
        Eight(out)
    }

    /// All lanes together, pair by pair.
    #[inline(always)]
    pub(crate) fn sum(self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }

    /// The greatest of all lanes.
    #[inline(always)]
    pub(crate) fn greatest(self) -> f64 {
        self.0.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Eight rows of eight become eight columns: rows of bodies become lanes, and back.
///
/// Written as three rounds of exchanges between rows, which compile to shuffles.
#[inline(always)]
pub(crate) fn transpose(rows: [[f64; LANES]; LANES]) -> [Eight; LANES] {
    let mut pairs = [[0.0; LANES]; LANES];
    for k in 0..4 {
        for h in 0..4 {
            pairs[2 * k][2 * h] = rows[2 * k][2 * h];
            pairs[2 * k][2 * h + 1] = rows[2 * k + 1][2 * h];
            pairs[2 * k + 1][2 * h] = rows[2 * k][2 * h + 1];
            pairs[2 * k + 1][2 * h + 1] = rows[2 * k + 1][2 * h + 1];
        }
    }
    let mut fours = [[0.0; LANES]; LANES];
    for k in [0, 4] {
        for h in 0..2 {
            for q in [0, 4] {
                for e in 0..2 {
                    fours[k + h][q + e] = pairs[k + h][q + e];
                    fours[k + h][q + 2 + e] = pairs[k + 2 + h][q + e];
                    fours[k + 2 + h][q + e] = pairs[k + h][q + 2 + e];
                    fours[k + 2 + h][q + 2 + e] = pairs[k + 2 + h][q + 2 + e];
                }
            }
        }
    }
    let mut out = [[0.0; LANES]; LANES];
    for h in 0..4 {
        for e in 0..4 {
            out[h][e] = fours[h][e];
            out[h][4 + e] = fours[4 + h][e];
            out[4 + h][e] = fours[h][4 + e];
            out[4 + h][4 + e] = fours[4 + h][4 + e];
        }
    }
    out.map(Eight)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_become_columns() {
        let rows: [[f64; 8]; 8] = core::array::from_fn(|i| core::array::from_fn(|j| (10 * i + j) as f64));
        let columns = transpose(rows);
        for i in 0..8 {
            for j in 0..8 {
                assert_eq!(columns[j].0[i], rows[i][j]);
            }
        }
    }
}
