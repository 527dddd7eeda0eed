//! A scenario, and what is changed in it before it runs: the method, the time step, where bodies start.

use std::path::{Path, PathBuf};

use choque_engine::Scene;
use choque_engine::scene::{Kind, MotionRule};
use choque_scripting::{Options, Output, Scenario};

use super::ladder::Ladder;
use super::method::{ALL, Method};
use super::poses::half_diagonals;
use super::random::Random;
use crate::Error;
use crate::arguments::ScenarioArguments;

/// A scenario's file and what the caller said about it. Threads share it; each loads the scenario for itself.
#[derive(Clone, Debug)]
pub struct Recipe {
    file: PathBuf,
    arguments: ScenarioArguments,
}

/// One way to run a scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variant {
    /// How.
    pub method: Method,
    /// Length of one iteration \[s\].
    pub time_step: f64,
    /// How many.
    pub steps: u64,
    /// Where bodies start.
    pub start: Start,
}

/// Where the bodies of a scene start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// Where the scene says.
    AsWritten,
    /// Where they would have been so many seconds before, flying freely: impacts then fall elsewhere within an iteration.
    Earlier(f64),
    /// Each mobile body moved along x and z by up to that share of its half diagonal.
    Jittered {
        /// The share.
        by: f64,
        /// Which of the many ways.
        seed: u64,
    },
}

impl Recipe {
    /// For a file, with these overrides.
    #[must_use]
    pub fn new(file: &Path, arguments: &ScenarioArguments) -> Self {
        Recipe { file: file.to_owned(), arguments: arguments.clone() }
    }

    /// The file.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The methods asked for: all four, but for what a flag fixes.
    #[must_use]
    pub fn methods(&self) -> Vec<Method> {
        let Options { overrides, .. } = self.arguments.options();
        let wanted = |method: &Method| {
            overrides.motion.is_none_or(|motion| motion == method.motion)
                && overrides.detection.is_none_or(|detection| detection == method.detection)
        };
        ALL.into_iter().filter(wanted).collect()
    }

    /// The scenario as it is written, with the caller's overrides.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn as_written(&self) -> Result<Scenario, Error> {
        Ok(Scenario::load(&self.file, &self.arguments.options())?)
    }

    /// The scenario run in another way. What its script prints is not wanted a hundred times.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn load(&self, variant: &Variant) -> Result<Scenario, Error> {
        let mut options = Options { output: Output::to(|_| {}), ..self.arguments.options() };
        options.overrides.steps = Some(variant.steps);
        options.overrides.time_step = Some(variant.time_step);
        options.overrides.motion = Some(variant.method.motion);
        options.overrides.detection = Some(variant.method.detection);
        let mut scenario = Scenario::load(&self.file, &options)?;
        variant.start.apply_to(scenario.scene_mut());
        Ok(scenario)
    }
}

impl Variant {
    /// A method with one of the time steps.
    #[must_use]
    pub fn of(ladder: &Ladder, method: Method, rung: usize, start: Start) -> Self {
        Variant { method, time_step: ladder.time_step(rung), steps: ladder.steps(rung), start }
    }

    /// Whether it stops at impacts.
    #[must_use]
    pub fn is_continuous(&self) -> bool {
        self.method.motion == MotionRule::Continuous
    }
}

impl Start {
    fn apply_to(self, scene: &mut Scene) {
        match self {
            Start::AsWritten => {}
            Start::Earlier(seconds) => {
                for body in scene.bodies.iter_mut().filter(|body| body.patrol.is_none() && body.swing.is_none()) {
                    let (vx, vz) = body.velocity.unwrap_or_default();
                    body.at.0 -= vx * seconds;
                    body.at.1 -= vz * seconds;
                    body.angle -= body.spin.unwrap_or_default() * seconds;
                }
            }
            Start::Jittered { by, seed } => {
                let mut random = Random::new(seed);
                let sizes = half_diagonals(scene);
                for (body, size) in scene.bodies.iter_mut().zip(sizes).filter(|(body, _)| body.kind == Kind::Mobile) {
                    body.at.0 += by * size * random.signed();
                    body.at.1 += by * size * random.signed();
                }
            }
        }
    }
}
