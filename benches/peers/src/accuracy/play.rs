//! A case played under an engine: steps are counted, bodies looked at.

use std::error::Error;

use choque::clock;
use choque::report::statistics::median;

use crate::engine::{Engine, How, Motion, World};
use crate::judge::distance;
use crate::scene::{Body, Scene};

/// Shorter runs are measured several at a time, for the clock's own cost would show \[s\].
const SHORTEST: f64 = 2e-3;
/// Worlds made ready for one measurement, at most: Box2D has room for 128.
const MOST_COPIES: usize = 64;
/// Measurements, of which the median counts.
const RUNS: usize = 3;

/// A scene in motion.
pub struct Play {
    world: Box<dyn World>,
    scene: Scene,
    how: How,
    steps: usize,
}

impl Play {
    /// At the start.
    ///
    /// # Errors
    /// A scene that the engine refuses.
    pub fn new(engine: Engine, scene: Scene, how: How) -> Result<Play, Box<dyn Error>> {
        Ok(Play { world: engine.start(&scene, &how)?, scene, how, steps: 0 })
    }

    /// Steps made so far.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Time that has passed \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.how.time_step
    }

    /// Makes a step.
    pub fn step(&mut self) {
        self.world.step();
        self.steps += 1;
    }

    /// Goes on to a time; `look` sees the world after every step.
    pub fn until(&mut self, time: f64, mut look: impl FnMut(&Play)) {
        while self.time() < time - 0.5 * self.how.time_step {
            self.step();
            look(self);
        }
    }

    /// Goes on to a time.
    pub fn to(&mut self, time: f64) {
        self.until(time, |_| {});
    }

    /// Whether the time is a whole twelfth of a second.
    #[must_use]
    pub fn is_at_a_twelfth(&self) -> bool {
        let twelfths = 12.0 * self.time();
        (twelfths - twelfths.round()).abs() < 1e-6
    }

    /// How a body moves.
    #[must_use]
    pub fn motion(&self, body: usize) -> Motion {
        self.world.motion(body)
    }

    /// How all bodies move.
    #[must_use]
    pub fn motions(&self) -> Vec<Motion> {
        crate::judge::motions(&*self.world, &self.scene)
    }

    /// The scene at its start.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The greatest distance of a body's vertex from where it should be, over the body's half diagonal.
    #[must_use]
    pub fn off(&self, body: usize, at: [f64; 2], angle: f64) -> f64 {
        let found = self.motion(body);
        let is = vertices(&self.scene.bodies[body], found.at, found.angle);
        let should = vertices(&self.scene.bodies[body], at, angle);
        let [x, y] = self.scene.bodies[body].rects[0].half;
        let apart = is.iter().zip(&should).map(|(a, b)| distance(*a, *b)).fold(0.0, crate::judge::worse);
        apart / libm::hypot(x, y)
    }
}

/// The vertices of a body's first rectangle.
fn vertices(body: &Body, at: [f64; 2], angle: f64) -> [[f64; 2]; 4] {
    let (sin, cos) = libm::sincos(angle);
    let rect = body.rects[0];
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[u, v]| {
        let (x, y) = (rect.at[0] + u * rect.half[0], rect.at[1] + v * rect.half[1]);
        [at[0] + cos * x - sin * y, at[1] + sin * x + cos * y]
    })
}

/// CPU time of so many steps of a scene, building the world apart \[s\].
///
/// # Errors
/// A scene that the engine refuses.
pub fn cost(engine: Engine, scene: &Scene, how: &How, steps: usize) -> Result<f64, Box<dyn Error>> {
    let once = timed(engine, scene, how, steps, 1)?;
    let copies = (SHORTEST / once.max(1e-9)).ceil().clamp(1.0, MOST_COPIES as f64) as usize;
    let mut times = if copies == 1 { vec![once] } else { Vec::new() };
    while times.len() < RUNS {
        times.push(timed(engine, scene, how, steps, copies)?);
    }
    Ok(median(&times))
}

fn timed(engine: Engine, scene: &Scene, how: &How, steps: usize, copies: usize) -> Result<f64, Box<dyn Error>> {
    let mut worlds = (0..copies).map(|_| engine.start(scene, how)).collect::<Result<Vec<_>, _>>()?;
    let begun = clock::cpu();
    for world in &mut worlds {
        (0..steps).for_each(|_| world.step());
    }
    Ok((clock::cpu() - begun).as_secs_f64() / copies as f64)
}
