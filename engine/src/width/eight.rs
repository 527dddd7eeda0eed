//! AVX-512: eight numbers in one register.

#![allow(unsafe_code)]
// SAFETY, of every call: these instructions are there, for only [`super::eight`] names this type, and it is called only where the
// processor has AVX-512. Loads and stores are of as many numbers as they are given.

use core::arch::x86_64::{
    __m512d, _CMP_GE_OQ, _CMP_GT_OQ, _CMP_LT_OQ, _mm256_loadu_pd, _mm512_abs_pd, _mm512_add_pd, _mm512_castpd256_pd512,
    _mm512_cmp_pd_mask, _mm512_div_pd, _mm512_insertf64x4, _mm512_loadu_pd, _mm512_mask_blend_pd, _mm512_max_pd,
    _mm512_min_pd, _mm512_mul_pd, _mm512_set1_pd, _mm512_setzero_pd, _mm512_shuffle_f64x2, _mm512_sqrt_pd,
    _mm512_storeu_pd, _mm512_sub_pd, _mm512_unpackhi_pd, _mm512_unpacklo_pd,
};
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::lanes::{Eight, LANES, Numbers, Wide};

#[derive(Clone, Copy)]
pub(super) struct Eights(__m512d);

macro_rules! lanewise {
    ($trait:ident, $method:ident, $instruction:ident) => {
        impl $trait for Eights {
            type Output = Eights;

            #[inline(always)]
            fn $method(self, other: Eights) -> Eights {
                Eights(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

lanewise!(Add, add, _mm512_add_pd);
lanewise!(Sub, sub, _mm512_sub_pd);
lanewise!(Mul, mul, _mm512_mul_pd);
lanewise!(Div, div, _mm512_div_pd);

impl Neg for Eights {
    type Output = Eights;

    #[inline(always)]
    fn neg(self) -> Eights {
        Eights::zero() - self
    }
}

impl Eights {
    /// 1 where a comparison holds, else −1.
    #[inline(always)]
    fn compare<const HOW: i32>(self, other: Eights) -> Eights {
        let (yes, no) = (Eights::all(1.0), Eights::all(-1.0));
        Eights(unsafe { _mm512_mask_blend_pd(_mm512_cmp_pd_mask::<HOW>(self.0, other.0), no.0, yes.0) })
    }
}

impl Numbers for Eights {
    #[inline(always)]
    fn of(numbers: &[f64; LANES]) -> Eights {
        Eights(unsafe { _mm512_loadu_pd(numbers.as_ptr()) })
    }

    #[inline(always)]
    fn eight(self) -> Eight {
        let mut eight = Eight::ZERO;
        unsafe { _mm512_storeu_pd(eight.0.as_mut_ptr(), self.0) };
        eight
    }

    #[inline(always)]
    fn all(value: f64) -> Eights {
        Eights(unsafe { _mm512_set1_pd(value) })
    }

    #[inline(always)]
    fn max(self, other: Eights) -> Eights {
        Eights(unsafe { _mm512_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Eights) -> Eights {
        Eights(unsafe { _mm512_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Eights {
        Eights(unsafe { _mm512_abs_pd(self.0) })
    }

    #[inline(always)]
    fn root(self) -> Eights {
        Eights(unsafe { _mm512_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn pick(self, where_not_negative: Eights, otherwise: Eights) -> Eights {
        Eights(unsafe {
            let mask = _mm512_cmp_pd_mask::<_CMP_GE_OQ>(self.0, _mm512_setzero_pd());
            _mm512_mask_blend_pd(mask, otherwise.0, where_not_negative.0)
        })
    }

    #[inline(always)]
    fn less(self, other: Eights) -> Eights {
        self.compare::<_CMP_LT_OQ>(other)
    }

    #[inline(always)]
    fn at_least(self, other: Eights) -> Eights {
        self.compare::<_CMP_GE_OQ>(other)
    }

    #[inline(always)]
    fn any(self) -> bool {
        unsafe { _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, _mm512_setzero_pd()) != 0 }
    }

    /// Two rows in a register, then as [`transpose`] goes on.
    #[inline(always)]
    fn columns(mut row: impl FnMut(usize) -> [f64; 4]) -> [Eights; 4] {
        let (a, b) = (beside(row(0), row(2)), beside(row(1), row(3)));
        let (c, d) = (beside(row(4), row(6)), beside(row(5), row(7)));
        unsafe {
            let (even_ab, odd_ab) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
            let (even_cd, odd_cd) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
            [
                Eights(_mm512_shuffle_f64x2::<0x88>(even_ab, even_cd)),
                Eights(_mm512_shuffle_f64x2::<0x88>(odd_ab, odd_cd)),
                Eights(_mm512_shuffle_f64x2::<0xDD>(even_ab, even_cd)),
                Eights(_mm512_shuffle_f64x2::<0xDD>(odd_ab, odd_cd)),
            ]
        }
    }

    #[inline(always)]
    fn gather<'a>(mut row: impl FnMut(usize) -> &'a [f64; LANES]) -> [Eights; LANES] {
        let low = [Eights::of(row(0)), Eights::of(row(1)), Eights::of(row(2)), Eights::of(row(3))];
        let high = [Eights::of(row(4)), Eights::of(row(5)), Eights::of(row(6)), Eights::of(row(7))];
        transpose([low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]])
    }

    #[inline(always)]
    fn scatter(columns: [Eights; LANES], mut put: impl FnMut(usize, Eight)) {
        for (k, row) in transpose(columns).into_iter().enumerate() {
            put(k, row.eight());
        }
    }
}

impl Wide for Eights {
    type Low = Eights;
    type High = Eights;
}

/// By pairs, then by fours, then by halves.
#[inline(always)]
fn transpose(rows: [Eights; LANES]) -> [Eights; LANES] {
    let [a, b, c, d, e, f, g, h] = rows;
    unsafe {
        let even = [
            _mm512_unpacklo_pd(a.0, b.0),
            _mm512_unpacklo_pd(c.0, d.0),
            _mm512_unpacklo_pd(e.0, f.0),
            _mm512_unpacklo_pd(g.0, h.0),
        ];
        let odd = [
            _mm512_unpackhi_pd(a.0, b.0),
            _mm512_unpackhi_pd(c.0, d.0),
            _mm512_unpackhi_pd(e.0, f.0),
            _mm512_unpackhi_pd(g.0, h.0),
        ];
        let ([c0, c2, c4, c6], [c1, c3, c5, c7]) = (columns(even), columns(odd));
        [c0, c1, c2, c3, c4, c5, c6, c7]
    }
}

/// Two rows in one register.
#[inline(always)]
fn beside(low: [f64; 4], high: [f64; 4]) -> __m512d {
    unsafe {
        let low = _mm512_castpd256_pd512(_mm256_loadu_pd(low.as_ptr()));
        _mm512_insertf64x4::<1>(low, _mm256_loadu_pd(high.as_ptr()))
    }
}

/// Every second column, of rows that lie in pairs.
#[inline(always)]
unsafe fn columns([ab, cd, ef, gh]: [__m512d; 4]) -> [Eights; 4] {
    unsafe {
        let (low_left, low_right) = (_mm512_shuffle_f64x2::<0x44>(ab, cd), _mm512_shuffle_f64x2::<0x44>(ef, gh));
        let (high_left, high_right) = (_mm512_shuffle_f64x2::<0xEE>(ab, cd), _mm512_shuffle_f64x2::<0xEE>(ef, gh));
        [
            Eights(_mm512_shuffle_f64x2::<0x88>(low_left, low_right)),
            Eights(_mm512_shuffle_f64x2::<0xDD>(low_left, low_right)),
            Eights(_mm512_shuffle_f64x2::<0x88>(high_left, high_right)),
            Eights(_mm512_shuffle_f64x2::<0xDD>(high_left, high_right)),
        ]
    }
}
