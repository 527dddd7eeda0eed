//! How wide the processor's registers are, found once; the same code compiled for each.
//!
//! The one module with `unsafe`: a function compiled for instructions that a processor may lack must not be called where
//! it lacks them, and the compiler cannot know. [`Width::best`] asks the processor, and only it makes the wider widths. Numbers
//! in wide registers are of types that have no name outside of here: only what is run for a width is given them.
//!
//! On x86-64 the instructions are named: left to itself, the compiler finds them again in short functions only.

#[cfg(target_arch = "x86_64")]
mod eight;
#[cfg(target_arch = "x86_64")]
mod four;

use crate::lanes::{Eight, Wide};

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
            Width::Plain => work.run::<Eight>(),
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

    /// Does it with numbers in registers of that width; to be marked `#[inline(always)]`.
    fn run<V: Wide>(self) -> Self::Out;
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn four<T: Work>(work: T) -> T::Out {
    work.run::<four::Fours>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn eight<T: Work>(work: T) -> T::Out {
    work.run::<eight::Eights>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{LANES, Numbers};

    /// Numbers of all kinds.
    fn numbers(seed: usize) -> Eight {
        const KINDS: [f64; 11] =
            [0.0, -0.0, 1.0, -1.0, 3.7, -2.5e-9, 1e300, -1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        Eight(core::array::from_fn(|k| KINDS[(seed + k * (1 + seed / 11)) % KINDS.len()]))
    }

    /// Everything that can be done with two lots of numbers, and whether any is positive.
    struct Done(Eight, Eight);

    impl Work for Done {
        type Out = (Vec<Eight>, [bool; 2]);

        #[inline(always)]
        fn run<V: Wide>(self) -> Self::Out {
            let (a, b) = (V::of(&self.0.0), V::of(&self.1.0));
            let all = [
                a + b,
                a - b,
                a * b,
                a / b,
                -a,
                a.max(b),
                a.min(b),
                a.abs(),
                a.root(),
                a.pick(b, V::all(7.0)),
                a.less(b),
                a.at_least(b),
                V::zero(),
                b.inverse(),
            ];
            (all.map(V::eight).to_vec(), [a.any(), b.any()])
        }
    }

    #[test]
    fn every_width_does_the_same_to_the_bit() {
        let bits = |numbers: &[Eight]| -> Vec<[u64; LANES]> {
            let canonical = |x: f64| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() };
            numbers.iter().map(|eight| eight.0.map(canonical)).collect()
        };
        for seed in 0..121 {
            for other in 0..11 {
                let (a, b) = (numbers(seed), numbers(other * 13 + seed / 3));
                let (plain, any) = Width::Plain.run(Done(a, b));
                for width in Width::available() {
                    let (done, any_too) = width.run(Done(a, b));
                    assert_eq!((bits(&done), any_too), (bits(&plain), any), "{width:?}: {a:?}, {b:?}");
                }
            }
        }
    }

    /// Rows that become columns, at some width: whole ones, their first halves, and the first halves of as many as fit a register;
    /// and whole ones there and back.
    struct Turned([Eight; LANES]);

    impl Work for Turned {
        type Out = ([Eight; LANES], [Eight; 4], ([Eight; 4], usize), [Eight; LANES]);

        #[inline(always)]
        fn run<V: Wide>(self) -> Self::Out {
            let halves = self.0.map(|row| [row.0[0], row.0[1], row.0[2], row.0[3]]);
            let narrow = V::Low::columns(|k| halves[k]).map(V::Low::eight);
            let mut back = [Eight::ZERO; LANES];
            let low = V::Low::gather(|k| &self.0[V::Low::FIRST + k].0);
            V::Low::scatter(low, |k, row| back[V::Low::FIRST + k] = row);
            if V::Low::COUNT < LANES {
                let high = V::High::gather(|k| &self.0[V::High::FIRST + k].0);
                V::High::scatter(high, |k, row| back[V::High::FIRST + k] = row);
            }
            (
                V::gather(|k| &self.0[k].0).map(V::eight),
                V::columns(|k| halves[k]).map(V::eight),
                (narrow, V::Low::COUNT),
                back,
            )
        }
    }

    #[test]
    fn rows_become_columns_at_every_width() {
        let rows: [Eight; LANES] = core::array::from_fn(|i| Eight(core::array::from_fn(|j| (10 * i + j) as f64)));
        for width in Width::available() {
            let (columns, first, (narrow, count), back) = width.run(Turned(rows));
            assert_eq!(back, rows, "{width:?}");
            for (i, row) in rows.iter().enumerate() {
                for (j, column) in columns.iter().enumerate() {
                    assert_eq!(column.0[i], row.0[j], "{width:?}");
                }
                for j in 0..4 {
                    assert_eq!(first[j].0[i], row.0[j], "{width:?}");
                    assert_eq!(narrow[j].0[i], if i < count { row.0[j] } else { 0.0 }, "{width:?}");
                }
            }
        }
    }
}
