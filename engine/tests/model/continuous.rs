//! Continuous motion: scenes that several modules share, and prescribed bodies between steps. (Exact answers: `tests/all/exact` of the
//! whole.)

use choque_engine::scene::{Body, ExchangeRule, Kind, MotionRule, Patrol, Settings};
use choque_engine::{Scene, World};

use crate::body;

pub(crate) fn impulse(restitution: f64, time_step: f64, bodies: Vec<Body>) -> Scene {
    let settings = Settings {
        motion: MotionRule::Continuous,
        exchange: ExchangeRule::Impulse,
        restitution,
        time_step,
        ..Settings::default()
    };
    Scene { settings, bodies, ..Scene::default() }
}

pub(crate) fn block(name: &str, size: (f64, f64), at: (f64, f64), velocity: (f64, f64), mass: f64) -> Body {
    let mut block = body(name, Kind::Mobile, size.0, size.1);
    block.at = at;
    block.velocity = Some(velocity);
    block.mass = Some(mass);
    block
}

pub(crate) fn wall(name: &str, size: (f64, f64), at: (f64, f64)) -> Body {
    let mut wall = body(name, Kind::Fixed, size.0, size.1);
    wall.at = at;
    wall
}

#[test]
fn a_patrolling_wall_strikes_between_steps() {
    let mut door = body("door", Kind::Fixed, 1.0, 9.0);
    door.patrol = Some(Patrol { points: vec![(2.0, 0.0)], speed: 4.0 });
    let scene = impulse(1.0, 0.3, vec![door, block("box", (1.0, 1.0), (2.5, 0.0), (0.0, 0.0), 1.0)]);
    let mut world = World::new(&scene).expect("a valid scene");
    let mut times = Vec::new();
    for _ in 0..5 {
        world.begin();
        while world.treat_next().is_some() {
            times.push(world.time());
        }
        world.finish();
    }
    assert!(times.len() == 1 && (times[0] - 1.5 / 4.0).abs() < 1e-15, "{times:?}");
    let v = world.velocity(world.find("box").expect("it is there")).x;
    assert!((v - 8.0).abs() < 1e-14, "twice the door's speed: {v}");
}
