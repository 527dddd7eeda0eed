//! How wide the processor's registers are, found once; the same code compiled for each.
//!
//! The one module with `unsafe`: a function compiled for instructions that a processor may lack must not be called where
//! it lacks them, and the compiler cannot know. [`Width::best`] asks the processor, and only it makes the wider widths.
//!
//! Arithmetic is left to the compiler. Only where it does badly, with rows that become columns, the instructions are named.

use crate::lanes::{self, Eight, LANES};

/// What to compile for. All give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// What every processor of the platform has.
    Plain,
    /// AVX2: four numbers at once.
    #[cfg(target_arch = "x86_64")]
    Four(Proof),
    /// AVX-512: eight numbers at once.
    #[cfg(target_arch = "x86_64")]
    Eight(Proof),
}

/// That the processor has been asked; only this module can make one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proof(());

impl Width {
    /// The widest the processor has.
    #[must_use]
    pub fn best() -> Width {
        Width::available().pop().unwrap_or(Width::Plain)
    }

    /// All that the processor has, the widest last.
    #[must_use]
    pub fn available() -> Vec<Width> {
        #[allow(unused_mut)]
        let mut all = vec![Width::Plain];
        #[cfg(target_arch = "x86_64")]
        {
            if std::is_x86_feature_detected!("avx2") {
                all.push(Width::Four(Proof(())));
            }
            if std::is_x86_feature_detected!("avx512f")
                && std::is_x86_feature_detected!("avx512dq")
                && std::is_x86_feature_detected!("avx512vl")
            {
                all.push(Width::Eight(Proof(())));
            }
        }
        all
    }

    /// Runs work compiled for this width. `work` must be marked `#[inline(always)]` to be compiled anew here.
    #[inline]
    pub(crate) fn run<W: Work>(self, work: W) -> W::Out {
        match self {
            Width::Plain => work.run::<1>(),
            #[cfg(target_arch = "x86_64")]
            #[allow(unsafe_code)]
            // SAFETY: a `Proof` exists only where the processor was asked and has AVX2.
            Width::Four(Proof(())) => unsafe { four(work) },
            #[cfg(target_arch = "x86_64")]
            #[allow(unsafe_code)]
            // SAFETY: a `Proof` in this variant exists only where the processor was asked and has these parts of AVX-512.
            Width::Eight(Proof(())) => unsafe { eight(work) },
        }
    }
}

/// Work that is compiled once for every width.
pub(crate) trait Work {
    /// What comes of it.
    type Out;

    /// Does it; to be marked `#[inline(always)]`.
    ///
    /// `W` numbers fit into a register; it is only ever given as what the function is compiled for.
    fn run<const W: usize>(self) -> Self::Out;
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn four<T: Work>(work: T) -> T::Out {
    work.run::<4>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn eight<T: Work>(work: T) -> T::Out {
    work.run::<8>()
}

/// Eight rows become eight columns, in work that is compiled for registers of `W` numbers.
#[inline(always)]
pub(crate) fn transpose<const W: usize>(rows: [Eight; LANES]) -> [Eight; LANES] {
    #[cfg(target_arch = "x86_64")]
    #[allow(unsafe_code)]
    if W == 8 {
        // SAFETY: only `eight` runs work with `W` = 8, and it is called only where the processor has AVX-512.
        return unsafe { transpose_at_once(&rows) };
    }
    lanes::transpose(rows.map(|row| row.0))
}

/// By pairs, then by fours, then by halves.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
#[inline]
fn transpose_at_once(rows: &[Eight; LANES]) -> [Eight; LANES] {
    use core::arch::x86_64::{__m512d, _mm512_shuffle_f64x2, _mm512_unpackhi_pd, _mm512_unpacklo_pd};
    #[allow(unsafe_code)]
    // SAFETY: both are sixty-four bytes, aligned alike, of eight numbers, of which any bits are valid.
    let (load, store) = (
        |row: &Eight| unsafe { core::mem::transmute::<Eight, __m512d>(*row) },
        |column: __m512d| unsafe { core::mem::transmute::<__m512d, Eight>(column) },
    );
    let row = |k: usize| load(&rows[k]);
    let mut columns = [Eight::ZERO; LANES];
    for odd in 0..2 {
        let pair = |k: usize| {
            let (one, two) = (row(2 * k), row(2 * k + 1));
            if odd == 0 { _mm512_unpacklo_pd(one, two) } else { _mm512_unpackhi_pd(one, two) }
        };
        let (ab, cd, ef, gh) = (pair(0), pair(1), pair(2), pair(3));
        let (low_left, low_right) = (_mm512_shuffle_f64x2(ab, cd, 0x44), _mm512_shuffle_f64x2(ef, gh, 0x44));
        let (high_left, high_right) = (_mm512_shuffle_f64x2(ab, cd, 0xEE), _mm512_shuffle_f64x2(ef, gh, 0xEE));
        columns[odd] = store(_mm512_shuffle_f64x2(low_left, low_right, 0x88));
        columns[2 + odd] = store(_mm512_shuffle_f64x2(low_left, low_right, 0xDD));
        columns[4 + odd] = store(_mm512_shuffle_f64x2(high_left, high_right, 0x88));
        columns[6 + odd] = store(_mm512_shuffle_f64x2(high_left, high_right, 0xDD));
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows that become columns, at some width.
    struct Turned([Eight; LANES]);

    impl Work for Turned {
        type Out = [Eight; LANES];

        #[inline(always)]
        fn run<const W: usize>(self) -> [Eight; LANES] {
            transpose::<W>(self.0)
        }
    }

    #[test]
    fn rows_become_columns_at_every_width() {
        let rows: [Eight; LANES] = core::array::from_fn(|i| Eight(core::array::from_fn(|j| (10 * i + j) as f64)));
        for width in Width::available() {
            let columns = width.run(Turned(rows));
            let back = Width::Plain.run(Turned(columns));
            assert_eq!(back, rows, "{width:?}");
            assert_eq!(columns[3].0[5], rows[5].0[3], "{width:?}");
        }
    }
}
