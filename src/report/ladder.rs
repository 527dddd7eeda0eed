//! Which time steps are tried, and at which moments their results are compared.

use std::collections::BTreeSet;

use choque_engine::Scene;

use super::format::time_step_in_words;

/// The longest time step, where the run's length is a multiple of it \[s\].
const LONGEST: f64 = 1.0 / 30.0;
/// A run is cut into so many pieces at least, or there would be nothing to compare on the way.
const FEWEST: u64 = 8;
/// Moments at which results are compared.
const CHECKPOINTS: u64 = 16;

/// Time steps, each half of the one before, that divide one length of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ladder {
    /// Time simulated \[s\]: what the scenario asks for.
    pub time: f64,
    /// Iterations with the longest time step.
    pub coarsest: u64,
    /// How many time steps are tried.
    pub rungs: usize,
}

impl Ladder {
    /// The time steps 1/30, 1/60, … of a scene. A length of time that is no multiple of 1/30 s, or a short one, gets the next
    /// smaller steps that divide it.
    #[must_use]
    pub fn of(scene: &Scene, rungs: usize) -> Self {
        let time = scene.settings.time_step * scene.settings.steps as f64;
        let pieces = time / LONGEST;
        let whole = pieces.round();
        let coarsest = if (pieces - whole).abs() <= 1e-9 * whole { whole } else { pieces.ceil() };
        Ladder { time, coarsest: (coarsest as u64).max(FEWEST), rungs }
    }

    /// Iterations with that time step.
    #[must_use]
    pub fn steps(&self, rung: usize) -> u64 {
        self.coarsest << rung
    }

    /// That time step \[s\].
    #[must_use]
    pub fn time_step(&self, rung: usize) -> f64 {
        self.time / self.steps(rung) as f64
    }

    /// The same as people write it.
    #[must_use]
    pub fn name(&self, rung: usize) -> String {
        time_step_in_words(self.time_step(rung))
    }

    /// The time step nearest to 1/60 s.
    #[must_use]
    pub fn usual(&self) -> usize {
        let off = |rung: &usize| (libm::log(60.0 * self.time_step(*rung))).abs();
        (0..self.rungs).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0)
    }

    /// Moments to compare at, in iterations of the longest time step, so that every time step meets them: some up to each of
    /// the last ones given.
    #[must_use]
    pub fn checkpoints(&self, lasts: [u64; 2]) -> Vec<u64> {
        let up_to = |last: u64| (1..=CHECKPOINTS.min(last)).map(move |i| i * last / CHECKPOINTS.min(last));
        let all: BTreeSet<u64> = lasts.into_iter().flat_map(up_to).collect();
        all.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use choque_engine::scene::Settings;

    use super::*;

    fn ladder(time_step: f64, steps: u64) -> Ladder {
        Ladder::of(&Scene { settings: Settings { time_step, steps, ..Settings::default() }, ..Scene::default() }, 10)
    }

    #[test]
    fn time_steps_are_thirtieths_of_a_second_and_their_halves() {
        let ladder = ladder(1.0 / 120.0, 600);
        assert_eq!((ladder.time, ladder.coarsest), (5.0, 150));
        assert_eq!((ladder.name(0).as_str(), ladder.name(9).as_str()), ("1/30", "1/15360"));
        assert_eq!(ladder.usual(), 1);
    }

    #[test]
    fn a_length_that_is_no_multiple_gets_the_next_smaller_steps() {
        assert_eq!(ladder(1.0, 1).coarsest, 30);
        assert_eq!(ladder(0.7, 1).coarsest, 21);
        assert_eq!(ladder(0.71, 1).coarsest, 22);
        assert_eq!(ladder(0.01, 1).coarsest, FEWEST, "a short run is cut into eight");
    }

    #[test]
    fn checkpoints_end_with_the_last_moment() {
        let ladder = ladder(1.0 / 60.0, 600);
        let checkpoints = ladder.checkpoints([300, 300]);
        assert_eq!((checkpoints.len(), checkpoints.last()), (16, Some(&300)));
        assert_eq!(ladder.checkpoints([3, 0]), [1, 2, 3]);
        let both = ladder.checkpoints([300, 30]);
        assert!(both.contains(&30) && both.iter().filter(|moment| **moment <= 30).count() >= 16);
    }
}
