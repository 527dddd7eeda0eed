//! The scenes behind the curves.

use std::error::Error;

use choque_engine::scene::{Body, Detection, Kind, MotionRule, Settings};

use crate::stage::{DOCUMENT, IMPULSE, Model, body, moving, run};

/// Turned by this, a rectangle of 4 × 3 points straight ahead with a corner, 2.5 m from its centre.
fn corner_ahead(body: Body) -> Body {
    Body { angle: -libm::atan(0.75), ..body }
}

/// Energy after a head-on hit over energy before: the scene of `document/limit_energy_gain.rhai`.
pub(crate) fn head_on(ratio: f64, mu: f64, is_document: bool) -> Result<f64, Box<dyn Error>> {
    let model = if is_document { DOCUMENT } else { IMPULSE };
    let settings = Settings { mu_l: mu, mu_a: mu, ..model.settings(1.0 / 64.0) };
    let lorry = Body { mass: Some(ratio), ..corner_ahead(moving("lorry", [4.0, 3.0], (-5.01, 0.0), (2.0, 0.0))) };
    let crate_ = body("crate", Kind::Mobile, [1.0, 2.0], (0.0, 0.0));
    let world = run(settings, vec![lorry, crate_], 640, |world| world.collisions() > 0)?;
    Ok(world.kinetic_energy() / (0.5 * ratio * 4.0))
}

/// The models that are flown against a wall.
pub(crate) const TUNNELLERS: [Model; 4] = [
    DOCUMENT,
    Model { detection: Detection::Complete, ..DOCUMENT },
    IMPULSE,
    Model { motion: MotionRule::Continuous, ..DOCUMENT },
];

/// Of boxes that fly at a wall with a corner ahead, so that the document's exchange stops them dead, the share that ends beyond
/// it; `reach` is how far they fly in an iteration, in lengths of the way on which box and wall overlap.
pub(crate) fn share_through(model: Model, reach: f64, phases: usize) -> Result<f64, Box<dyn Error>> {
    const WALL: f64 = 0.3;
    let flight = reach * (std::f64::consts::SQRT_2 + WALL);
    let mut through = 0;
    for phase in 0..phases {
        let start = -40.0 - flight * (phase as f64 + 0.5) / phases as f64;
        let flying = moving("box", [1.0, 1.0], (start, 0.0), (flight, 0.0));
        let corner_ahead = Body { angle: std::f64::consts::FRAC_PI_4, ..flying };
        let bodies = vec![body("wall", Kind::Fixed, [WALL, 40.0], (0.0, 0.0)), corner_ahead];
        let steps = (60.0 / flight) as u64 + 2;
        let world = run(model.settings(1.0), bodies, steps, |_| false)?;
        let place = world.find("box").map(|id| world.position(id).x);
        through += u64::from(place.is_some_and(|x| x > 0.5 * WALL));
    }
    Ok(through as f64 / phases as f64)
}

/// Iterations for which a wall pushes a car.
pub(crate) const PUSHED_FOR: u64 = 1000;

/// Exchanges of a wall that travels into a car at rest, corner first so that nothing goes into spin; without μ_L by
/// impulses that do not bounce.
pub(crate) fn exchanges(mu: Option<f64>, epsilon: f64) -> Result<u64, Box<dyn Error>> {
    let model = match mu {
        Some(_) => DOCUMENT,
        None => Model { restitution: 0.0, ..IMPULSE },
    };
    let settings = Settings { mu_l: mu.unwrap_or(1.0), epsilon, ..model.settings(1.0 / 128.0) };
    let wall = Body { velocity: Some((1.0, 0.0)), ..body("wall", Kind::Fixed, [1.0, 8.0], (0.0, 0.0)) };
    let car = corner_ahead(body("car", Kind::Mobile, [4.0, 3.0], (3.5, 0.0)));
    Ok(run(settings, vec![wall, car], PUSHED_FOR, |_| false)?.collisions())
}

/// The models whose flat hits are compared.
pub(crate) const FLAT: [Model; 3] = [DOCUMENT, Model { detection: Detection::Complete, ..DOCUMENT }, IMPULSE];

/// What a hit leaves, as shares of the speed before.
#[derive(Clone, Copy)]
pub(crate) struct Leaving {
    pub(crate) sideways: f64,
    pub(crate) forwards: f64,
}

/// A box of that length over its width, 1 m² large, flies straight and flat at the middle of a wall.
pub(crate) fn flat_hit(model: Model, aspect: f64) -> Result<Leaving, Box<dyn Error>> {
    let (length, width) = (aspect.sqrt(), 1.0 / aspect.sqrt());
    let bodies = vec![
        body("wall", Kind::Fixed, [1.0, 40.0], (0.0, 0.0)),
        moving("box", [length, width], (-3.0 - 0.5 * length, 0.0), (1.0, 0.0)),
    ];
    let world = run(model.settings(1.0 / 64.0), bodies, 640, |world| world.collisions() > 0)?;
    let left = world.find("box").map(|id| world.velocity(id)).ok_or("the box is gone")?;
    Ok(Leaving { sideways: left.y.abs(), forwards: left.x })
}
