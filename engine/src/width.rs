//! How wide the processor's registers are, found once; the same code compiled for each.
//!
//! The one module with `unsafe`: a function compiled for instructions that a processor may lack must not be called where
//! it lacks them, and the compiler cannot know. [`Width::best`] asks the processor, and only it makes the wider widths.

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
            Width::Plain => work.run(),
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
    fn run(self) -> Self::Out;
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn four<W: Work>(work: W) -> W::Out {
    work.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn eight<W: Work>(work: W) -> W::Out {
    work.run()
}
