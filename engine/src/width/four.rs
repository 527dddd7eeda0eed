//! AVX2: eight numbers in two registers of four.

#![allow(unsafe_code)]
// SAFETY, of every call: these instructions are there, for only [`super::four`] names this type, and it is called only where the
// processor has AVX2. Loads and stores are of as many numbers as they are given.

use core::arch::x86_64::{
    __m256d, _CMP_GE_OQ, _CMP_GT_OQ, _CMP_LT_OQ, _mm256_add_pd, _mm256_andnot_pd, _mm256_blendv_pd, _mm256_cmp_pd,
    _mm256_div_pd, _mm256_loadu_pd, _mm256_max_pd, _mm256_min_pd, _mm256_movemask_pd, _mm256_mul_pd, _mm256_or_pd,
    _mm256_permute2f128_pd, _mm256_set1_pd, _mm256_sqrt_pd, _mm256_storeu_pd, _mm256_sub_pd, _mm256_unpackhi_pd,
    _mm256_unpacklo_pd,
};
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::lanes::{Eight, LANES, Wide};

#[derive(Clone, Copy)]
pub(super) struct Fours(__m256d, __m256d);

macro_rules! lanewise {
    ($trait:ident, $method:ident, $instruction:ident) => {
        impl $trait for Fours {
            type Output = Fours;

            #[inline(always)]
            fn $method(self, other: Fours) -> Fours {
                unsafe { Fours($instruction(self.0, other.0), $instruction(self.1, other.1)) }
            }
        }
    };
}

lanewise!(Add, add, _mm256_add_pd);
lanewise!(Sub, sub, _mm256_sub_pd);
lanewise!(Mul, mul, _mm256_mul_pd);
lanewise!(Div, div, _mm256_div_pd);

impl Neg for Fours {
    type Output = Fours;

    #[inline(always)]
    fn neg(self) -> Fours {
        Fours::zero() - self
    }
}

impl Fours {
    /// All bits set where a comparison holds.
    #[inline(always)]
    fn mask<const HOW: i32>(self, other: Fours) -> Fours {
        unsafe { Fours(_mm256_cmp_pd::<HOW>(self.0, other.0), _mm256_cmp_pd::<HOW>(self.1, other.1)) }
    }

    /// The first where this mask is set, else the second.
    #[inline(always)]
    fn blend(self, yes: Fours, no: Fours) -> Fours {
        unsafe { Fours(_mm256_blendv_pd(no.0, yes.0, self.0), _mm256_blendv_pd(no.1, yes.1, self.1)) }
    }
}

impl Wide for Fours {
    #[inline(always)]
    fn of(numbers: &[f64; LANES]) -> Fours {
        let [low, high] = [&numbers[..4], &numbers[4..]];
        unsafe { Fours(_mm256_loadu_pd(low.as_ptr()), _mm256_loadu_pd(high.as_ptr())) }
    }

    #[inline(always)]
    fn eight(self) -> Eight {
        let mut eight = Eight::ZERO;
        let (low, high) = eight.0.split_at_mut(4);
        unsafe {
            _mm256_storeu_pd(low.as_mut_ptr(), self.0);
            _mm256_storeu_pd(high.as_mut_ptr(), self.1);
        }
        eight
    }

    #[inline(always)]
    fn all(value: f64) -> Fours {
        let four = unsafe { _mm256_set1_pd(value) };
        Fours(four, four)
    }

    #[inline(always)]
    fn max(self, other: Fours) -> Fours {
        unsafe { Fours(_mm256_max_pd(self.0, other.0), _mm256_max_pd(self.1, other.1)) }
    }

    #[inline(always)]
    fn min(self, other: Fours) -> Fours {
        unsafe { Fours(_mm256_min_pd(self.0, other.0), _mm256_min_pd(self.1, other.1)) }
    }

    #[inline(always)]
    fn abs(self) -> Fours {
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            Fours(_mm256_andnot_pd(sign, self.0), _mm256_andnot_pd(sign, self.1))
        }
    }

    #[inline(always)]
    fn root(self) -> Fours {
        unsafe { Fours(_mm256_sqrt_pd(self.0), _mm256_sqrt_pd(self.1)) }
    }

    #[inline(always)]
    fn pick(self, where_not_negative: Fours, otherwise: Fours) -> Fours {
        self.mask::<_CMP_GE_OQ>(Fours::zero()).blend(where_not_negative, otherwise)
    }

    #[inline(always)]
    fn less(self, other: Fours) -> Fours {
        self.mask::<_CMP_LT_OQ>(other).blend(Fours::all(1.0), Fours::all(-1.0))
    }

    #[inline(always)]
    fn at_least(self, other: Fours) -> Fours {
        self.mask::<_CMP_GE_OQ>(other).blend(Fours::all(1.0), Fours::all(-1.0))
    }

    #[inline(always)]
    fn any(self) -> bool {
        let Fours(low, high) = self.mask::<_CMP_GT_OQ>(Fours::zero());
        unsafe { _mm256_movemask_pd(_mm256_or_pd(low, high)) != 0 }
    }

    /// The four quarters, each by pairs and then by halves; two of them change places.
    #[inline(always)]
    fn transpose(rows: [Fours; LANES]) -> [Fours; LANES] {
        let [a, b, c, d, e, f, g, h] = rows;
        unsafe {
            let (top_left, top_right) = (quarter([a.0, b.0, c.0, d.0]), quarter([a.1, b.1, c.1, d.1]));
            let (low_left, low_right) = (quarter([e.0, f.0, g.0, h.0]), quarter([e.1, f.1, g.1, h.1]));
            [
                Fours(top_left[0], low_left[0]),
                Fours(top_left[1], low_left[1]),
                Fours(top_left[2], low_left[2]),
                Fours(top_left[3], low_left[3]),
                Fours(top_right[0], low_right[0]),
                Fours(top_right[1], low_right[1]),
                Fours(top_right[2], low_right[2]),
                Fours(top_right[3], low_right[3]),
            ]
        }
    }
}

/// Four rows of four become four columns.
#[inline(always)]
unsafe fn quarter([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    unsafe {
        let (even_ab, odd_ab) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (even_cd, odd_cd) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(even_ab, even_cd),
            _mm256_permute2f128_pd::<0x20>(odd_ab, odd_cd),
            _mm256_permute2f128_pd::<0x31>(even_ab, even_cd),
            _mm256_permute2f128_pd::<0x31>(odd_ab, odd_cd),
        ]
    }
}
