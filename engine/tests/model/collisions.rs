//! Whole collisions under complete detection and the impulse exchange, as scenes.

use choque_engine::scene::{Body, Detection, ExchangeRule, Kind, Scene, Settings};
use choque_engine::{Vec2, World};

use crate::{after, body, scene};

fn impulse(bodies: Vec<Body>, restitution: f64, friction: f64) -> Scene {
    let settings =
        Settings { exchange: ExchangeRule::Impulse, restitution, friction, time_step: 1e-3, ..Settings::default() };
    Scene { settings, ..scene(bodies) }
}

fn moving(name: &str, size: (f64, f64), at: (f64, f64), velocity: (f64, f64)) -> Body {
    let mut body = body(name, Kind::Mobile, size.0, size.1);
    body.at = at;
    body.velocity = Some(velocity);
    body
}

fn motions(world: &World) -> Vec<(Vec2, f64)> {
    world.ids().map(|id| (world.velocity(id), world.spin(id))).collect()
}

fn assert_motion(found: (Vec2, f64), vx: f64, omega: f64) {
    assert_near(found, (vx, omega), 1e-14);
}

fn assert_near(found: (Vec2, f64), (vx, omega): (f64, f64), within: f64) {
    assert!((found.0.x - vx).abs() < within && found.0.y.abs() < within, "{found:?}, not vx = {vx}");
    assert!((found.1 - omega).abs() < within, "{found:?}, not ω = {omega}");
}

/// The world right after its first collision.
fn after_first_hit(scene: &Scene) -> World {
    let mut world = World::new(scene).expect("a valid scene");
    while world.collisions() == 0 && world.iteration() < 1000 {
        world.step();
    }
    world
}

/// C2: the faces are parallel, so how deep the step finds them does not enter.
#[test]
fn c2_flat_faces_exchange_at_two_points() {
    for (e, [v_a, w, v_b]) in [(1.0, [87.0, 216.0, 192.0]), (0.5, [159.0, 162.0, 144.0]), (0.0, [231.0, 108.0, 96.0])] {
        for swap in [false, true] {
            let mut a = moving("a", (2.0, 1.0), (-2.0, 0.0), (3.0, 0.0));
            let mut b = moving("b", (1.0, 3.0), (0.0, 1.25), (0.0, 0.0));
            (a.mass, b.mass) = (Some(2.0), Some(3.0));
            let scene = impulse(if swap { vec![b, a] } else { vec![a, b] }, e, 0.0);
            let mut world = after_first_hit(&scene);
            let [of_a, of_b] = ["a", "b"].map(|name| motions(&world)[world.find(name).expect("there").index()]);
            // Without restitution they stay in touch and press on while they slide: 2 ω u_t, about 2 m/s², for what is left of
            // the iteration.
            let within = if e == 0.0 { 2.5e-3 } else { 1e-14 };
            assert_near(of_a, (v_a / 125.0, w / 125.0), within);
            assert_near(of_b, (v_b / 125.0, w / 125.0), within);
            (0..100).for_each(|_| world.step());
            assert!(e == 0.0 || world.collisions() == 1, "they part: {}", world.collisions());
        }
    }
}

#[test]
fn c1_a_vertex_meets_a_face() {
    for (e, expected) in [(1.0, [2901.0, 4320.0, 6000.0, 7560.0]), (0.5, [5151.0, 3240.0, 4500.0, 5670.0])] {
        // A is turned by atan(3/4), so its vertex is 1.1 ahead of its centre and 0.2 above it.
        let mut a = moving("a", (2.0, 1.0), (-2.0, 0.0), (3.0, 0.0));
        a.angle = libm::atan2(3.0, 4.0);
        a.mass = Some(2.0);
        let mut b = moving("b", (1.0, 3.0), (0.0, 1.25), (0.0, 0.0));
        b.mass = Some(3.0);
        let world = after_first_hit(&impulse(vec![a, b], e, 0.0));
        let [of_a, of_b] = [motions(&world)[0], motions(&world)[1]];
        assert_motion(of_a, expected[0] / 3967.0, expected[1] / 3967.0);
        assert_motion(of_b, expected[2] / 3967.0, expected[3] / 3967.0);
    }
}

/// A blade that turns at Ω = 2 meets the flat side of a block from radius 2.75 to 3.25. At e = 1 each end leaves at
/// twice the blade's velocity there, 11 and 13 m/s: v = 12, ω = 2/0.5 = 4.
#[test]
fn a_rotor_blade_drives_a_block_at_its_contact_velocity() {
    let mut blade = body("blade", Kind::Fixed, 8.0, 1e-3);
    blade.spin = Some(2.0);
    blade.mass = Some(1e-3); // no one asks a fixed body's mass
    let block = moving("block", (0.5, 0.5), (3.0, 0.25 + 0.5e-3), (0.0, 0.0));
    let mut scene = impulse(vec![blade, block], 1.0, 0.0);
    scene.settings.time_step = 1e-6;
    let (v, omega) = motions(&after_first_hit(&scene))[1];
    let turned = 1e-5; // the blade turns on for the rest of the step
    assert!((v - Vec2::new(0.0, 12.0)).norm() < 12.0 * turned && (omega - 4.0).abs() < turned, "{v:?} {omega}");
}

#[test]
fn crossed_bars_collide_when_every_overlap_is_seen() {
    for exchange in [ExchangeRule::Document, ExchangeRule::Impulse] {
        let bar = moving("bar", (4.0, 1.0), (-0.25, -3.0), (0.0, 3.0));
        let mut scene = impulse(vec![bar, body("post", Kind::Fixed, 1.0, 4.0)], 1.0, 0.0);
        scene.settings.exchange = exchange;
        scene.settings.detection = Some(Detection::Complete);
        let world = after(&scene, 400);
        assert!(world.collisions() > 0, "{exchange:?}");
    }
}

#[test]
fn a_hundred_bodies_in_one_place_stay_finite() {
    let bodies = (0..100).map(|i| moving(&format!("b{i}"), (1.0, 1.0), (0.0, 0.0), (0.0, 0.0))).collect();
    let mut scene = impulse(bodies, 0.5, 0.5);
    scene.settings.exchange = ExchangeRule::Document;
    scene.settings.detection = Some(Detection::Complete);
    let world = after(&scene, 200);
    assert_eq!(world.fault(), None);
    assert!(world.deepest() < 1.0, "they part: {}", world.deepest());
}

#[test]
fn impulses_keep_momentum_and_never_add_energy() {
    let mut bodies = Vec::new();
    for i in 0..40 {
        let (column, row) = (f64::from(i % 8), f64::from(i / 8));
        let heading = f64::from(i * i % 63) * 0.1;
        let mut car = moving(&format!("car{i}"), (2.0, 1.0), (column * 2.4, row * 2.4), (0.0, 0.0));
        car.velocity = Some((5.0 * libm::cos(heading), 5.0 * libm::sin(heading)));
        car.mass = Some(1.0 + f64::from(i % 5));
        car.angle = heading;
        bodies.push(car);
    }
    let mut world = World::new(&impulse(bodies, 0.9, 0.3)).expect("a valid scene");
    let (momentum, angular) = (world.momentum(), world.angular_momentum());
    let mut energy = world.kinetic_energy();
    for _ in 0..3000 {
        world.step();
        assert!(world.kinetic_energy() <= energy * (1.0 + 1e-13), "iteration {}", world.iteration());
        energy = world.kinetic_energy();
    }
    assert!(world.collisions() > 20, "{}", world.collisions());
    assert!((world.momentum() - momentum).norm() < 1e-11, "{:?}", world.momentum() - momentum);
    // Bodies in each other are moved apart without a change of velocity: that is not free of angular momentum.
    assert!((world.angular_momentum() - angular).abs() < 1e-5, "{}", world.angular_momentum() - angular);
    assert_eq!(world.work().relocations, 0);
}
