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

use crate::lanes::{Eight, LANES, Numbers, Wide};

/// The first or the second four of eight numbers, in one register.
#[derive(Clone, Copy)]
pub(super) struct Four<const HALF: usize>(__m256d);

/// Eight numbers in two.
#[derive(Clone, Copy)]
pub(super) struct Fours(Four<0>, Four<1>);

macro_rules! lanewise {
    ($trait:ident, $method:ident, $instruction:ident) => {
        impl<const HALF: usize> $trait for Four<HALF> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Four(unsafe { $instruction(self.0, other.0) })
            }
        }

        impl $trait for Fours {
            type Output = Fours;

            #[inline(always)]
            fn $method(self, other: Fours) -> Fours {
                Fours(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    };
}

lanewise!(Add, add, _mm256_add_pd);
lanewise!(Sub, sub, _mm256_sub_pd);
lanewise!(Mul, mul, _mm256_mul_pd);
lanewise!(Div, div, _mm256_div_pd);

impl<const HALF: usize> Neg for Four<HALF> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::zero() - self
    }
}

impl Neg for Fours {
    type Output = Fours;

    #[inline(always)]
    fn neg(self) -> Fours {
        Fours(-self.0, -self.1)
    }
}

impl<const HALF: usize> Four<HALF> {
    /// All bits set where a comparison holds.
    #[inline(always)]
    fn mask<const HOW: i32>(self, other: Self) -> Self {
        Four(unsafe { _mm256_cmp_pd::<HOW>(self.0, other.0) })
    }

    /// The first where this mask is set, else the second.
    #[inline(always)]
    fn blend(self, yes: Self, no: Self) -> Self {
        Four(unsafe { _mm256_blendv_pd(no.0, yes.0, self.0) })
    }

    #[inline(always)]
    fn load(numbers: &[f64; 4]) -> Self {
        Four(unsafe { _mm256_loadu_pd(numbers.as_ptr()) })
    }

    #[inline(always)]
    fn store(self, numbers: &mut [f64; 4]) {
        unsafe { _mm256_storeu_pd(numbers.as_mut_ptr(), self.0) }
    }
}

/// Eight numbers in memory are two times four.
#[inline(always)]
fn halves(numbers: &[f64; LANES]) -> [&[f64; 4]; 2] {
    let (halves, _) = numbers.as_chunks();
    [&halves[0], &halves[1]]
}

impl<const HALF: usize> Numbers for Four<HALF> {
    const FIRST: usize = 4 * HALF;
    const COUNT: usize = 4;

    #[inline(always)]
    fn of(numbers: &[f64; LANES]) -> Self {
        Self::load(halves(numbers)[HALF])
    }

    #[inline(always)]
    fn eight(self) -> Eight {
        let mut eight = Eight::ZERO;
        self.put(&mut eight);
        eight
    }

    #[inline(always)]
    fn put(self, eight: &mut Eight) {
        self.store(&mut eight.0.as_chunks_mut().0[HALF]);
    }

    #[inline(always)]
    fn all(value: f64) -> Self {
        Four(unsafe { _mm256_set1_pd(value) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Four(unsafe { _mm256_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Four(unsafe { _mm256_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Four(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }

    #[inline(always)]
    fn root(self) -> Self {
        Four(unsafe { _mm256_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn pick(self, where_not_negative: Self, otherwise: Self) -> Self {
        self.mask::<_CMP_GE_OQ>(Self::zero()).blend(where_not_negative, otherwise)
    }

    #[inline(always)]
    fn less(self, other: Self) -> Self {
        self.mask::<_CMP_LT_OQ>(other).blend(Self::all(1.0), Self::all(-1.0))
    }

    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        self.mask::<_CMP_GE_OQ>(other).blend(Self::all(1.0), Self::all(-1.0))
    }

    #[inline(always)]
    fn any(self) -> bool {
        unsafe { _mm256_movemask_pd(self.mask::<_CMP_GT_OQ>(Self::zero()).0) != 0 }
    }

    #[inline(always)]
    fn columns(mut row: impl FnMut(usize) -> [f64; 4]) -> [Self; 4] {
        quarter([Self::load(&row(0)), Self::load(&row(1)), Self::load(&row(2)), Self::load(&row(3))])
    }

    #[inline(always)]
    fn gather<'a>(mut row: impl FnMut(usize) -> &'a [f64; LANES]) -> [Self; LANES] {
        let [a, b, c, d] = [halves(row(0)), halves(row(1)), halves(row(2)), halves(row(3))];
        let [x, y, z, w] = quarter([Self::load(a[0]), Self::load(b[0]), Self::load(c[0]), Self::load(d[0])]);
        let [p, q, r, s] = quarter([Self::load(a[1]), Self::load(b[1]), Self::load(c[1]), Self::load(d[1])]);
        [x, y, z, w, p, q, r, s]
    }

    #[inline(always)]
    fn scatter([a, b, c, d, e, f, g, h]: [Self; LANES], mut put: impl FnMut(usize, Eight)) {
        let (low, high) = (quarter([a, b, c, d]), quarter([e, f, g, h]));
        for k in 0..4 {
            put(k, Fours(Four(low[k].0), Four(high[k].0)).eight());
        }
    }
}

impl Numbers for Fours {
    #[inline(always)]
    fn of(numbers: &[f64; LANES]) -> Fours {
        let [low, high] = halves(numbers);
        Fours(Four::load(low), Four::load(high))
    }

    #[inline(always)]
    fn eight(self) -> Eight {
        let mut eight = Eight::ZERO;
        let (halves, _) = eight.0.as_chunks_mut();
        self.0.store(&mut halves[0]);
        self.1.store(&mut halves[1]);
        eight
    }

    #[inline(always)]
    fn all(value: f64) -> Fours {
        Fours(Four::all(value), Four::all(value))
    }

    #[inline(always)]
    fn max(self, other: Fours) -> Fours {
        Fours(self.0.max(other.0), self.1.max(other.1))
    }

    #[inline(always)]
    fn min(self, other: Fours) -> Fours {
        Fours(self.0.min(other.0), self.1.min(other.1))
    }

    #[inline(always)]
    fn abs(self) -> Fours {
        Fours(self.0.abs(), self.1.abs())
    }

    #[inline(always)]
    fn root(self) -> Fours {
        Fours(self.0.root(), self.1.root())
    }

    #[inline(always)]
    fn pick(self, where_not_negative: Fours, otherwise: Fours) -> Fours {
        Fours(self.0.pick(where_not_negative.0, otherwise.0), self.1.pick(where_not_negative.1, otherwise.1))
    }

    #[inline(always)]
    fn less(self, other: Fours) -> Fours {
        Fours(self.0.less(other.0), self.1.less(other.1))
    }

    #[inline(always)]
    fn at_least(self, other: Fours) -> Fours {
        Fours(self.0.at_least(other.0), self.1.at_least(other.1))
    }

    #[inline(always)]
    fn any(self) -> bool {
        let (low, high) = (self.0.mask::<_CMP_GT_OQ>(Four::zero()), self.1.mask::<_CMP_GT_OQ>(Four::zero()));
        unsafe { _mm256_movemask_pd(_mm256_or_pd(low.0, high.0)) != 0 }
    }

    #[inline(always)]
    fn columns(mut row: impl FnMut(usize) -> [f64; 4]) -> [Fours; 4] {
        let low = Four::columns(&mut row);
        let high = Four::columns(|k| row(4 + k));
        [Fours(low[0], high[0]), Fours(low[1], high[1]), Fours(low[2], high[2]), Fours(low[3], high[3])]
    }

    #[inline(always)]
    fn gather<'a>(mut row: impl FnMut(usize) -> &'a [f64; LANES]) -> [Fours; LANES] {
        let [a, b, c, d, e, f, g, h] = Four::gather(&mut row);
        let [i, j, k, l, m, n, o, p] = Four::gather(|k| row(4 + k));
        [Fours(a, i), Fours(b, j), Fours(c, k), Fours(d, l), Fours(e, m), Fours(f, n), Fours(g, o), Fours(h, p)]
    }

    #[inline(always)]
    fn scatter([a, b, c, d, e, f, g, h]: [Fours; LANES], mut put: impl FnMut(usize, Eight)) {
        Four::scatter([a.0, b.0, c.0, d.0, e.0, f.0, g.0, h.0], &mut put);
        Four::scatter([a.1, b.1, c.1, d.1, e.1, f.1, g.1, h.1], |k, row| put(4 + k, row));
    }
}

impl Wide for Fours {
    type Low = Four<0>;
    type High = Four<1>;
}

/// Four rows of four become four columns.
#[inline(always)]
fn quarter<const HALF: usize>([a, b, c, d]: [Four<HALF>; 4]) -> [Four<HALF>; 4] {
    unsafe {
        let (even_ab, odd_ab) = (_mm256_unpacklo_pd(a.0, b.0), _mm256_unpackhi_pd(a.0, b.0));
        let (even_cd, odd_cd) = (_mm256_unpacklo_pd(c.0, d.0), _mm256_unpackhi_pd(c.0, d.0));
        [
            Four(_mm256_permute2f128_pd::<0x20>(even_ab, even_cd)),
            Four(_mm256_permute2f128_pd::<0x20>(odd_ab, odd_cd)),
            Four(_mm256_permute2f128_pd::<0x31>(even_ab, even_cd)),
            Four(_mm256_permute2f128_pd::<0x31>(odd_ab, odd_cd)),
        ]
    }
}
