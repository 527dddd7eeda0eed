//! How far ahead a scene can be foretold: a twin that starts a hair's breadth beside it, and how fast the two part.

use serde::{Deserialize, Serialize};

use super::course::watch;
use super::ladder::Ladder;
use super::method::Method;
use super::poses::{Shapes, Stand};
use super::recipe::{Recipe, Start, Variant};
use crate::Error;

/// How far beside the scene its twin starts, in half diagonals.
const BESIDE: f64 = 1e-12;
/// Where the difference has come to this, in half diagonals, nothing is foretold any more.
const LOST: f64 = 1e-3;
/// Where no reference holds to the end, errors are measured as long as differences have not grown more than this; beyond, an
/// error says more about the scene than about the method.
pub const MEASURABLE: f64 = 1e3;

/// How differences grow. A scene whose differences grow a billionfold is called chaotic.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Growth {
    /// When a difference of 1e-12 half diagonals has become 1e-3 \[s\]; `None` when it never does.
    pub horizon: Option<f64>,
    /// By how much differences grow in a second, on average up to there.
    pub per_second: f64,
    /// How many times a difference has grown by the end.
    pub by_end: f64,
    /// The last moment at which an error still says more about the method than about the scene, in iterations of the longest
    /// time step: a difference has not grown more than a thousandfold.
    pub measured: u64,
}

/// Follows a scene and its twin.
///
/// # Errors
/// What is wrong with the scenario; a body that left the finite numbers.
pub fn measure(recipe: &Recipe, ladder: &Ladder, shapes: &Shapes, method: Method) -> Result<Growth, Error> {
    let rung = ladder.usual();
    let every = ladder.steps(rung) / ladder.coarsest;
    let stands = |start: Start| -> Result<Vec<Stand>, Error> {
        let variant = Variant::of(ladder, method, rung, start);
        let mut stands = vec![shapes.stand(&recipe.load(&variant)?.start()?.world())];
        watch(recipe, &variant, |world, _| {
            if world.iteration().is_multiple_of(every) {
                stands.push(shapes.stand(world));
            }
        })?;
        Ok(stands)
    };
    let (one, other) = (stands(Start::AsWritten)?, stands(Start::Jittered { by: BESIDE, seed: 1 })?);
    let apart: Vec<f64> = one.iter().zip(&other).map(|(a, b)| shapes.distance(a, b).max).collect();
    Ok(judge(&apart, ladder))
}

/// From the differences after each iteration of the longest time step, the start's first.
fn judge(apart: &[f64], ladder: &Ladder) -> Growth {
    let beside = apart.first().copied().unwrap_or(BESIDE).max(f64::MIN_POSITIVE);
    let mut worst = 0.0;
    let grown: Vec<f64> = apart
        .iter()
        .map(|apart| {
            worst = f64::max(worst, apart / beside);
            worst
        })
        .collect();
    let lost = grown.iter().position(|grown| *grown >= LOST / BESIDE);
    let last = grown.len().saturating_sub(1);
    let measured = grown.iter().rposition(|grown| *grown <= MEASURABLE).unwrap_or(0);
    let second = |index: usize| ladder.time * index as f64 / ladder.coarsest as f64;
    let until = lost.unwrap_or(last);
    let per_second = libm::pow(grown.get(until).copied().unwrap_or(1.0).max(1.0), 1.0 / second(until.max(1)));
    Growth {
        horizon: lost.map(second),
        per_second,
        by_end: grown.last().copied().unwrap_or(1.0).max(1.0),
        measured: measured as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LADDER: Ladder = Ladder { time: 10.0, coarsest: 300, rungs: 10 };

    #[test]
    fn a_scene_whose_differences_grow_tenfold_a_second_is_lost_after_nine() {
        let apart: Vec<f64> = (0..=300).map(|i| BESIDE * libm::pow(10.0, f64::from(i) / 30.0)).collect();
        let growth = judge(&apart, &LADDER);
        assert!((growth.horizon.expect("lost") - 9.0).abs() < 0.05, "{growth:?}");
        assert!((growth.per_second - 10.0).abs() < 0.3, "{growth:?}");
        assert!((89..=90).contains(&growth.measured), "a thousandfold after 3 s: {growth:?}");
    }

    #[test]
    fn a_scene_whose_differences_grow_in_proportion_to_time_is_not_lost() {
        let apart: Vec<f64> = (0..=300).map(|i| BESIDE * (1.0 + f64::from(i))).collect();
        let growth = judge(&apart, &LADDER);
        assert_eq!((growth.horizon, growth.measured), (None, 300));
        assert!((growth.by_end - 301.0).abs() < 1e-9);
    }
}
