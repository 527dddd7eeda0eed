//! Which scenes are played, by which methods, at what expense.

use crate::avbd::Descent;
use crate::block::Blocks;
use crate::finish::Finish;
use crate::measure::{Outcome, play};
use crate::method::Method;
use crate::scenes::{self, Scene};
use crate::soft::Soft;

/// Sub-steps of a step, or iterations of descent.
pub(crate) const EFFORTS: [usize; 5] = [1, 2, 4, 8, 16];

/// The effort the tables compare at.
pub(crate) const USUAL: usize = 4;

/// A scene played by a method.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub(crate) scene: String,
    pub(crate) method: &'static str,
    pub(crate) effort: usize,
    pub(crate) outcome: Outcome,
}

fn methods(effort: usize) -> [Box<dyn Method>; 4] {
    [
        Box::new(Soft { substeps: effort }),
        Box::new(Blocks { substeps: effort, finish: None }),
        Box::new(Blocks { substeps: effort, finish: Some(Finish::USUAL) }),
        Box::new(Descent { iterations: effort }),
    ]
}

fn scenes() -> Vec<Scene> {
    let heavier = |density| scenes::stack("light on heavy 1e4", &[(0.5, density), (0.5, 1.0)], 0.6, 600);
    let doubling: Vec<(f64, f64)> = [0.5, 1.0, 2.0, 4.0, 8.0, 16.0].map(|half| (half, 1.0)).to_vec();
    vec![
        scenes::pyramid(20),
        scenes::pyramid(50),
        scenes::pyramid(100),
        scenes::dropped(20, 0.1),
        scenes::dropped(50, 0.1),
        scenes::leaning(12),
        scenes::stack("column 80", &[(0.5, 1.0); 80], 0.3, 600),
        scenes::stack("inverted 1 to 32", &doubling, 0.6, 600),
        scenes::stack("heavy on light 1e4", &[(0.5, 1.0), (0.5, 1e4)], 0.6, 600),
        heavier(1e4),
        scenes::cards(5),
        scenes::drop(0.0),
        scenes::drop(0.5),
        scenes::drop(1.0),
        scenes::slide(),
        scenes::creep(),
        scenes::tumbler(15),
    ]
}

pub(crate) fn names() -> Vec<String> {
    scenes().into_iter().map(|scene| scene.name).collect()
}

/// Plays every scene (or only that of the name) by every method at every effort, and tells each as it ends.
pub(crate) fn played(only: Option<&str>, mut tell: impl FnMut(&Run)) -> Vec<Run> {
    let mut runs = Vec::new();
    for scene in scenes().into_iter().filter(|scene| only.is_none_or(|name| name == scene.name)) {
        for effort in EFFORTS {
            for mut method in methods(effort) {
                let outcome = play(&scene, &mut *method);
                runs.push(Run { scene: scene.name.clone(), method: method.name(), effort, outcome });
                tell(&runs[runs.len() - 1]);
            }
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finished() -> Blocks {
        Blocks { substeps: USUAL, finish: Some(Finish::USUAL) }
    }

    #[test]
    fn finished_rest_does_not_move_at_all() {
        let mut scene = scenes::pyramid(10);
        scene.steps = 60;
        let exact = play(&scene, &mut finished());
        assert_eq!((exact.shape, exact.asymmetry, exact.deepest, exact.speed), (0.0, 0.0, 0.0, 0.0));
        let soft = play(&scene, &mut Soft { substeps: USUAL });
        assert!(soft.shape > 1e-4, "{soft:?}");
    }

    #[test]
    fn a_bounce_within_a_sub_step_rises_as_high_as_restitution_says() {
        for restitution in [0.5, 1.0] {
            let outcome = play(&scenes::drop(restitution), &mut finished());
            assert!(outcome.error < 1e-13, "{outcome:?}");
            assert!(outcome.shape < 1e-8, "{outcome:?}");
        }
    }

    #[test]
    fn descent_holds_ten_thousand_times_its_weight() {
        let scene = scenes::stack("heavy on light", &[(0.5, 1.0), (0.5, 1e4)], 0.6, 120);
        let outcome = play(&scene, &mut Descent { iterations: 10 });
        assert!(outcome.shape < 0.05, "{outcome:?}");
    }
}
