//! What a run costs in CPU time: one variant at a time, with nothing else of ours running.

use std::time::Duration;

use choque_engine::World;
use choque_scripting::{Scenario, Step};

use super::recipe::{Recipe, Variant};
use super::statistics::median;
use crate::{Error, clock};

/// A shorter stretch is repeated within one measurement, for the clock's own cost would show.
const SHORTEST: Duration = Duration::from_millis(1);
/// Copies of a world made ready for one measurement, at most.
const MOST_COPIES: usize = 512;
/// Runs of a script made ready for one measurement, at most: each compiles it anew.
const MOST_SCRIPTS: usize = 8;

/// How long to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patience {
    /// Measurements wanted.
    pub runs: usize,
    /// When this much time has gone into one variant, fewer have to do; one is always made.
    pub most: Duration,
}

/// What a run costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// CPU time of one run, the median over measurements \[s\].
    pub seconds: f64,
    /// Measurements.
    pub runs: usize,
}

/// Measures a variant; loading and compiling do not count, callbacks do.
///
/// # Errors
/// What is wrong with the scenario; a callback that fails.
pub fn measure(recipe: &Recipe, variant: &Variant, patience: Patience) -> Result<Cost, Error> {
    let scenario = recipe.load(variant)?;
    let callbacks = scenario.callbacks();
    let scripted = callbacks.on_step || callbacks.on_collision || callbacks.stop_when;
    let world = scenario.start()?.world().clone();
    let begun = clock::now();
    let first = if scripted { play(&scenario, 1)? } else { step(&world, variant.steps, 1) };
    let most = if scripted { MOST_SCRIPTS } else { MOST_COPIES };
    let copies = (SHORTEST.as_secs_f64() / first.max(1e-9)).ceil().clamp(1.0, most as f64) as usize;
    let mut times = if copies == 1 { vec![first] } else { Vec::new() };
    while times.is_empty() || times.len() < patience.runs && begun.elapsed() < patience.most {
        times.push(if scripted { play(&scenario, copies)? } else { step(&world, variant.steps, copies) });
    }
    Ok(Cost { seconds: median(&times), runs: times.len() })
}

/// CPU time of a run, the mean over a few in a row \[s\].
fn step(world: &World, steps: u64, copies: usize) -> f64 {
    let mut worlds = vec![world.clone(); copies];
    let begun = clock::cpu();
    for world in &mut worlds {
        (0..steps).for_each(|_| world.step());
    }
    (clock::cpu() - begun).as_secs_f64() / copies as f64
}

/// The same with callbacks.
fn play(scenario: &Scenario, copies: usize) -> Result<f64, Error> {
    let mut runs = (0..copies).map(|_| scenario.start()).collect::<Result<Vec<_>, _>>()?;
    let begun = clock::cpu();
    for run in &mut runs {
        while run.step()? == Step::Going {}
    }
    Ok((clock::cpu() - begun).as_secs_f64() / copies as f64)
}
