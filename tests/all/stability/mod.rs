//! The stability suite's large scenes, and what needs two runs to be compared: what stands or falls by the field's own measures.
//!
//! The small ones are `scenarios/stability`, a scenario each. Here every large scene runs in a reduced size with the ordinary tests, and in
//! full with `cargo test --release --test all -- --ignored stability`.
//!
//! | scene | in full | where |
//! |---|---|---|
//! | large pyramid, many pyramids, far, tiny, as a mirror image | 5,050 boxes, 22,000 boxes | [`pyramids`], [`alike`] |
//! | tumbler, washer in a square drum | 2,025 boxes, 8,100 boxes | [`drums`] |
//! | smash, barrel, confined, all at one place | 9,601 boxes, 3,380, 625, 100 | [`crowds`] |
//! | the same bits again, and through a copy | 80 bodies, 500 steps | [`determinism`] |
//! | energy that nothing drives, a body that leaves the numbers | | [`laws`] |

mod alike;
mod crowds;
mod determinism;
mod drums;
mod kit;
mod laws;
mod pyramids;
