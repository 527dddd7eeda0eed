//! Accuracy: cases whose answers are known exactly, under every engine with ever smaller time steps.

mod bounces;
mod impacts;
mod lasting;
mod walls;

pub mod compare;
pub mod page;
pub mod play;

use std::error::Error;

use choque::clock;
use choque::report::statistics::median;

use crate::engine::{Engine, How};
use crate::scene::Scene;
use play::Play;

/// A case whose answer is known.
pub struct Case {
    /// Its word: names files.
    pub name: &'static str,
    /// What one sees, in a line.
    pub title: &'static str,
    /// What the error is, with its unit; 0 is exact.
    pub error: &'static str,
    /// Starts, a fraction of a step apart, so that no luck of round numbers enters.
    pub phases: Phases,
    /// The shortest time step tried is one over this \[1/s\].
    pub finest: u32,
    /// So many bodies touch that continuous motion, which holds them all at once, would take minutes: it is left out.
    pub crowded: bool,
    /// The scene at its start.
    pub scene: fn(&Start) -> Scene,
    /// Plays it to its end; gives the error.
    pub judge: fn(&mut Play) -> f64,
}

impl Case {
    /// A case of few bodies, tried with the whole ladder.
    fn new(
        [name, title, error]: [&'static str; 3],
        phases: Phases,
        scene: fn(&Start) -> Scene,
        judge: fn(&mut Play) -> f64,
    ) -> Self {
        Case { name, title, error, phases, finest: LADDER[LADDER.len() - 1], crowded: false, scene, judge }
    }
}

/// How many starts, and which of their errors counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phases {
    /// One start: many impacts, at all phases of a step.
    One,
    /// The median of so many.
    Median(usize),
    /// The mean of so many: a share, where each is 0 or 1.
    Mean(usize),
}

/// From where a run starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// How much earlier the first impact shall come \[s\]: a part of a step.
    pub earlier: f64,
}

/// Who takes part: choque in both motions, and the peers.
pub const CONTENDERS: [Engine; 5] =
    [Engine::ChoqueContinuous, Engine::Choque, Engine::Box2d, Engine::RapierF32, Engine::RapierF64];

/// Time steps, as parts of a second. All times at which anything is looked at are whole twelfths.
pub const LADDER: [u32; 5] = [12, 60, 240, 960, 3840];

/// The cases, in the order of their numbers.
#[must_use]
pub fn cases() -> Vec<Case> {
    let mut cases = impacts::cases();
    cases.extend(bounces::cases());
    cases.extend(lasting::cases());
    cases.extend(walls::cases());
    cases
}

/// A run that takes so long is not made again to measure its cost \[s\].
const LONG: f64 = 0.5;

/// What an engine makes of a case with a time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Who.
    pub engine: Engine,
    /// Steps a second.
    pub rate: u32,
    /// How far off; not finite where a body left the finite numbers.
    pub error: f64,
    /// CPU time of a run, building the world apart \[s\].
    pub seconds: f64,
}

/// Every contender with every time step, of 4 sub-steps but in continuous motion.
///
/// # Errors
/// A scene that an engine refuses.
pub fn study(case: &Case) -> Result<Vec<Outcome>, Box<dyn Error>> {
    let mut outcomes = Vec::new();
    for rate in LADDER.into_iter().filter(|rate| *rate <= case.finest) {
        for engine in CONTENDERS.into_iter().filter(|engine| !(case.crowded && *engine == Engine::ChoqueContinuous)) {
            let how = How { time_step: 1.0 / f64::from(rate), exact: true, ..How::usual(1) };
            outcomes.push(outcome(case, engine, how)?);
        }
    }
    Ok(outcomes)
}

/// An engine on a case.
///
/// # Errors
/// A scene that it refuses.
pub fn outcome(case: &Case, engine: Engine, how: How) -> Result<Outcome, Box<dyn Error>> {
    let time_step = how.time_step;
    let phases = match case.phases {
        Phases::One => 1,
        Phases::Median(phases) | Phases::Mean(phases) => phases,
    };
    let (mut errors, mut steps, mut seconds) = (Vec::new(), 0, 0.0);
    let start = |phase: usize| {
        // Beyond a step of 1/60 s other corners would come down before the case is judged.
        let earlier = time_step.min(1.0 / 60.0) * phase as f64 / phases as f64;
        (case.scene)(&Start { earlier })
    };
    for phase in 0..phases {
        let mut play = Play::new(engine, start(phase), how)?;
        let begun = clock::cpu();
        errors.push((case.judge)(&mut play));
        seconds = (clock::cpu() - begun).as_secs_f64();
        steps = play.steps();
    }
    let error = match case.phases {
        Phases::Mean(_) => errors.iter().sum::<f64>() / phases as f64,
        // Not a number sorts last: the median is one unless half the runs are.
        Phases::One | Phases::Median(_) => median(&errors),
    };
    // In a long run looking at bodies costs nothing that shows.
    if seconds < LONG {
        seconds = play::cost(engine, &start(0), &how, steps)?;
    }
    Ok(Outcome { engine, rate: (1.0 / time_step).round() as u32, error, seconds })
}
