//! Speed: every scene under every engine, in turns, so that what else the machine does meets all of them alike.

use std::error::Error;

use choque::clock;
use choque::report::statistics::median;

use crate::engine::{Engine, How};
use crate::judge::{self, Verdict};
use crate::memory;
use crate::scene::Scene;

/// How long to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patience {
    /// Runs of each engine.
    pub repeats: usize,
    /// Steps of a run; `None` makes the scene's own.
    pub steps: Option<usize>,
}

/// An engine on a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The scene.
    pub scene: String,
    /// The engine.
    pub engine: Engine,
    /// Threads it used.
    pub threads: usize,
    /// Bodies of the scene.
    pub bodies: usize,
    /// Steps of a run.
    pub steps: usize,
    /// Wall-clock time of a step: each step's least over all runs, the mean of those without the first step \[ms\].
    pub best_ms: f64,
    /// The mean of a run's steps without the first, the median over all runs \[ms\].
    pub median_ms: f64,
    /// The slowest run over the fastest, less 1: the noise.
    pub spread: f64,
    /// Heap held at most while stepping, over that before the world was built, by body.
    pub bytes_per_body: f64,
    /// Pairs that touch at the end, as the engine counts them.
    pub contacts: Option<usize>,
    /// What came of it.
    pub verdict: Verdict,
}

impl Row {
    /// The best time, unless the engine lost a body among the numbers: then it may have stopped computing.
    #[must_use]
    pub fn sound_ms(&self) -> Option<f64> {
        self.verdict.deepest.map(|_| self.best_ms)
    }
}

/// What one run took and left.
struct Run {
    /// Of every step \[ms\].
    times: Vec<f64>,
    bytes: usize,
    contacts: Option<usize>,
    verdict: Verdict,
}

/// Runs each scene under each engine in turns; `told` hears what is about to run.
///
/// # Errors
/// A scene that an engine refuses.
pub fn measure(
    scenes: impl Iterator<Item = (String, Scene)>,
    engines: &[Engine],
    threads: usize,
    patience: Patience,
    told: impl Fn(&str),
) -> Result<Vec<Row>, Box<dyn Error>> {
    let mut rows = Vec::new();
    for (name, mut scene) in scenes {
        scene.steps = patience.steps.unwrap_or(scene.steps);
        let mut runs: Vec<Vec<Run>> = engines.iter().map(|_| Vec::new()).collect();
        for turn in 1..=patience.repeats {
            for (engine, runs) in engines.iter().zip(&mut runs) {
                told(&format!("{name}, {}, {turn} of {}", engine.word(), patience.repeats));
                runs.push(run(*engine, &scene, &How::usual(engine.threads(threads)))?);
            }
        }
        let row = |(engine, runs): (&Engine, &Vec<Run>)| summed_up(name.clone(), *engine, threads, &scene, runs);
        rows.extend(engines.iter().zip(&runs).map(row));
    }
    Ok(rows)
}

fn run(engine: Engine, scene: &Scene, how: &How) -> Result<Run, Box<dyn Error>> {
    let mut times = Vec::with_capacity(scene.steps);
    let before = memory::held();
    let mut world = engine.start(scene, how)?;
    let start = judge::motions(&*world, scene);
    let own = std::mem::size_of_val(start.as_slice());
    memory::watch();
    for _ in 0..scene.steps {
        let begun = clock::now();
        world.step();
        times.push(begun.elapsed().as_secs_f64() * 1e3);
    }
    let bytes = memory::most().saturating_sub(before + own);
    let verdict = judge::judge(scene, &start, &judge::motions(&*world, scene));
    Ok(Run { times, bytes, contacts: world.contacts(), verdict })
}

/// The first step, which builds what later steps use, does not count unless it is the only one.
fn later(times: &[f64]) -> &[f64] {
    if times.len() > 1 { &times[1..] } else { times }
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len().max(1) as f64
}

fn summed_up(name: String, engine: Engine, threads: usize, scene: &Scene, runs: &[Run]) -> Row {
    let least: Vec<f64> =
        (0..scene.steps).map(|step| runs.iter().map(|run| run.times[step]).fold(f64::INFINITY, f64::min)).collect();
    let means: Vec<f64> = runs.iter().map(|run| mean(later(&run.times))).collect();
    let [fastest, slowest] = [f64::min, f64::max].map(|pick| means.iter().copied().reduce(pick).unwrap_or(f64::NAN));
    // Engines are deterministic: all runs leave the same.
    let Run { bytes, contacts, verdict, .. } = runs[0];
    Row {
        scene: name,
        engine,
        threads: engine.threads(threads),
        bodies: scene.bodies.len(),
        steps: scene.steps,
        best_ms: mean(later(&least)),
        median_ms: median(&means),
        spread: slowest / fastest - 1.0,
        bytes_per_body: bytes as f64 / scene.bodies.len() as f64,
        contacts,
        verdict,
    }
}
