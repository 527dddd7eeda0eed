//! Engines behind one door: each is given a scene, makes steps, and tells how its bodies move.

mod box2d;
mod choque;
mod rapier;

use std::error::Error;

use clap::ValueEnum;

use crate::scene::Scene;

/// Which engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Engine {
    /// Choque, `motion("stepped")` and `exchange("impulse")`.
    Choque,
    /// Choque, `motion("continuous")`: only where it is asked for.
    ChoqueContinuous,
    /// Box2D 3.2, AVX2.
    #[value(name = "box2d")]
    Box2d,
    /// Rapier in single precision.
    RapierF32,
    /// Rapier in double precision.
    RapierF64,
}

/// Engines that are compared unless others are asked for.
pub const USUAL: [Engine; 4] = [Engine::Choque, Engine::Box2d, Engine::RapierF32, Engine::RapierF64];

/// How an engine is to work, the same for all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct How {
    /// Length of a step \[s\].
    pub time_step: f64,
    /// Parts into which the solver cuts a step.
    pub substeps: u32,
    /// Threads, for engines that can use several.
    pub threads: usize,
    /// Exact answers are asked for: no threshold of restitution, no cap on speed.
    pub exact: bool,
}

impl How {
    /// As in the speed table: 1/60 s, 4 sub-steps, limits as each engine sets them.
    #[must_use]
    pub fn usual(threads: usize) -> Self {
        How { time_step: 1.0 / 60.0, substeps: 4, threads, exact: false }
    }
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// \[m\].
    pub at: [f64; 2],
    /// In (−π, π] \[rad\].
    pub angle: f64,
    /// \[m/s\].
    pub velocity: [f64; 2],
    /// \[rad/s\].
    pub spin: f64,
}

/// A scene in motion.
pub trait World {
    /// Makes a step.
    fn step(&mut self);
    /// Bodies the engine itself counts.
    fn bodies(&self) -> usize;
    /// How the body with that place in the order of creation moves.
    fn motion(&self, body: usize) -> Motion;
    /// Pairs that touch, as the engine counts them; `None` where it does not tell.
    fn contacts(&self) -> Option<usize>;
}

impl Engine {
    /// The engine's word in tables and flags.
    #[must_use]
    pub fn word(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// `f32` or `f64`.
    #[must_use]
    pub fn precision(self) -> &'static str {
        match self {
            Engine::Choque | Engine::ChoqueContinuous | Engine::RapierF64 => "f64",
            Engine::Box2d | Engine::RapierF32 => "f32",
        }
    }

    /// Threads it uses of so many. Rapier's threads are a feature of the whole build that costs single-threaded runs; it is off.
    #[must_use]
    pub fn threads(self, wanted: usize) -> usize {
        match self {
            Engine::Choque | Engine::Box2d => wanted,
            Engine::ChoqueContinuous | Engine::RapierF32 | Engine::RapierF64 => 1,
        }
    }

    /// Whether it is choque in some way.
    #[must_use]
    pub fn is_choque(self) -> bool {
        matches!(self, Engine::Choque | Engine::ChoqueContinuous)
    }

    /// A scene ready to be stepped.
    ///
    /// # Errors
    /// A scene that choque refuses.
    pub fn start(self, scene: &Scene, how: &How) -> Result<Box<dyn World>, Box<dyn Error>> {
        Ok(match self {
            Engine::Choque => Box::new(choque::World::new(scene, how, choque::Motion::Stepped)?),
            Engine::ChoqueContinuous => Box::new(choque::World::new(scene, how, choque::Motion::Continuous)?),
            Engine::Box2d => Box::new(box2d::World::new(scene, how)),
            Engine::RapierF32 => Box::new(rapier::single::World::new(scene, how)),
            Engine::RapierF64 => Box::new(rapier::double::World::new(scene, how)),
        })
    }
}

/// How deep bodies overlap.
pub use choque::deepest;
