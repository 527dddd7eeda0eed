//! Threads share the work, not the result: the same bits at any number of them.

use choque_engine::scene::{Body, ExchangeRule, Kind, Part, Settings};
use choque_engine::{Rect, Scene, World};

/// So many bricks that finding who touches is worth sharing: thrown together, some of them in flight.
fn heap() -> Scene {
    let mut bodies = Vec::new();
    for k in 0..9_000_u32 {
        let mut body = Body::new(format!("brick{k}"), Kind::Mobile);
        body.parts.push(Part::Rect(Rect::centred(1.0, 0.5)));
        let (column, row) = (f64::from(k % 100), f64::from(k / 100));
        body.at = (1.05 * column + 0.4 * (row % 2.0), 0.55 * row);
        body.angle = 0.02 * f64::from(k % 7);
        body.velocity = Some((f64::from(k % 11) - 5.0, f64::from(k % 13) - 6.0));
        bodies.push(body);
    }
    let settings = Settings {
        exchange: ExchangeRule::Impulse,
        friction: 0.3,
        restitution: 0.5,
        time_step: 1.0 / 60.0,
        ..Settings::default()
    };
    Scene { settings, bodies, ..Scene::default() }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let digests = [1, 2, 3, 4].map(|threads| {
        let mut world = World::new(&heap()).expect("a valid scene");
        world.set_threads(threads);
        for _ in 0..4 {
            world.step();
        }
        (world.digest(), world.collisions(), *world.work())
    });
    assert!(digests[0].1 > 1_000, "{} collisions: too few to tell", digests[0].1);
    for other in &digests[1..] {
        assert_eq!(*other, digests[0]);
    }
}
