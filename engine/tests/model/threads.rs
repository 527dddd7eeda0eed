//! Threads share the work, not the result: the same bits at any number of them.

use choque_engine::scene::{Body, ExchangeRule, Kind, Part, Settings};
use choque_engine::{Rect, Scene, Work, World};

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

/// So many boxes that balancing what stands is worth sharing: columns upon a floor, which settle within the first steps.
fn columns() -> Scene {
    let mut floor = Body::new("floor".to_owned(), Kind::Fixed);
    floor.parts.push(Part::Rect(Rect::centred(1000.0, 1.0)));
    floor.at = (150.0, -0.5);
    let mut bodies = vec![floor];
    for k in 0..6_000_u32 {
        let mut body = Body::new(format!("box{k}"), Kind::Mobile);
        body.parts.push(Part::Rect(Rect::centred(1.0, 1.0)));
        // No two columns touch; every third box stands a little aside, so that friction has something to do.
        let (column, row) = (f64::from(k % 200), f64::from(k / 200));
        body.at = (1.5 * column + if k % 3 == 0 { 0.1 } else { 0.0 }, 0.5 + row);
        body.mass = Some(1.0 + f64::from(k % 5));
        bodies.push(body);
    }
    let settings = Settings {
        exchange: ExchangeRule::Impulse,
        friction: 0.5,
        gravity: (0.0, -9.81),
        time_step: 1.0 / 60.0,
        ..Settings::default()
    };
    Scene { settings, bodies, ..Scene::default() }
}

/// What there is to tell of a scene after so many steps, with 1 thread and with more.
fn with_threads(scene: &Scene, steps: u32) -> [(u64, u64, Work); 4] {
    [1, 2, 3, 4].map(|threads| {
        let mut world = World::new(scene).expect("a valid scene");
        world.set_threads(threads);
        for _ in 0..steps {
            world.step();
        }
        (world.digest(), world.collisions(), *world.work())
    })
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let [one, others @ ..] = with_threads(&heap(), 4);
    assert!(one.1 > 1_000, "{} collisions: too few to tell", one.1);
    assert!(others.iter().all(|other| *other == one), "{one:?}\n{others:?}");
}

#[test]
fn what_stands_does_so_with_the_same_bits_at_any_number_of_threads() {
    let [one, others @ ..] = with_threads(&columns(), 12);
    assert!(one.2.touches_solved > 12 * 6_000, "{:?}: too little to tell", one.2);
    assert!(others.iter().all(|other| *other == one), "{one:?}\n{others:?}");
}
