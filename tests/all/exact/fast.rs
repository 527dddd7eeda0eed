//! T11, T12, T25, T27 … T29, T32, T33, T35: fast, thin, turning, at once, without end, over and over, in any order.

use choque_engine::scene::{Body, ExchangeRule, MotionRule};
use choque_engine::{Scene, World};

use super::kit::{Ran, Random, assert_close, block, continuous, falling, mirrored, room, run, state, wall};
use super::sequences::ORDERS;

#[test]
fn t11_a_fast_block_comes_back_from_a_thin_wall() {
    for (e, x, v) in [(1.0, -0.11, -1000.0), (0.0, 4.945, 0.0)] {
        for steps in [1, 10, 3] {
            let block = block("block", (0.1, 0.1), (0.0, 0.0), (1000.0, 0.0), 1.0);
            // The wall's face stands at 4.995; at t = 0.01 the block is 4.945 − 5.055 back.
            let scene = continuous(e, 0.01 / f64::from(steps), vec![block, wall("wall", (0.01, 10.0), (5.0, 0.0))]);
            let Ran { world, hits } = run(&scene, steps);
            assert_eq!(hits.len(), 1);
            let found = state(&world, "block");
            assert_close(&[hits[0].0], &[0.004_945], 1e-17, "the hit");
            assert_close(&[found.x, found.vx, found.spin], &[x, v, 0.0], 1e-12, "the block");
        }
    }
}

/// A bar that turns by more than π a step: the angle is not aliased, and a block in its way is hit at the first pass.
#[test]
fn t12_spins_of_many_turns_a_step_are_neither_clamped_nor_aliased() {
    for motion in [MotionRule::Stepped, MotionRule::Continuous] {
        let mut bar = wall("bar", (2.0, 0.02), (0.0, 0.0));
        bar.spin = Some(400.0);
        let mut scene = continuous(1.0, 1.0 / 60.0, vec![bar, block("far", (1.0, 1.0), (9.0, 0.0), (0.0, 0.0), 1.0)]);
        scene.settings.motion = motion;
        let world = run(&scene, 60).world;
        let angle = state(&world, "bar").angle;
        let off = (angle - 400.0 + 1000.0 * std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
        assert!(off.min(std::f64::consts::TAU - off) <= 1e-9, "{motion:?}: off by {off}");
    }
    let mut bar = wall("bar", (2.0, 0.02), (0.0, 0.0));
    bar.spin = Some(400.0);
    let ran = run(&continuous(1.0, 1.0 / 60.0, vec![bar, block("block", (0.2, 0.2), (0.0, 1.0), (0.0, 0.0), 1.0)]), 1);
    // The leading face z′ = 0.01 reaches the block's corner (0.1, 0.9): θ + asin(0.01/R) = atan2(0.9, 0.1).
    let first = (libm::atan2(0.9, 0.1) - libm::asin(0.01 / libm::hypot(0.1, 0.9))) / 400.0;
    assert_close(&ran.times()[..1], &[first], 1e-16, "the first pass");
}

/// Four blocks strike a square on its four faces at one instant: nothing but four rebounds, in any order of creation.
#[test]
fn t25_four_blows_at_one_instant_are_one_impact() {
    let around = [(3.0, 0.0), (-3.0, 0.0), (0.0, 3.0), (0.0, -3.0)];
    for e in [1.0, 0.5, 0.0] {
        for turn in 0..4 {
            let mut bodies: Vec<Body> = (0..4)
                .map(|k| {
                    let (x, z) = around[(k + turn) % 4];
                    block(&format!("{x},{z}"), (0.8, 0.8), (x, z), (-x / 3.0, -z / 3.0), 1.0)
                })
                .collect();
            bodies.insert(turn, block("square", (1.0, 1.0), (0.0, 0.0), (0.0, 0.0), 3.0));
            let ran = run(&continuous(e, 0.75, bodies), 4);
            assert_eq!(ran.hits.len(), 4, "e = {e}");
            for (x, z) in around {
                let found = state(&ran.world, &format!("{x},{z}"));
                assert_close(&[found.vx, found.vz, found.spin], &[e * x / 3.0, e * z / 3.0, 0.0], 1e-14, "rebound");
            }
            let square = state(&ran.world, "square");
            assert_close(&[square.vx, square.vz, square.spin], &[0.0; 3], 1e-14, "the square stays");
        }
    }
}

/// E3 at e = 0.5 and E6 at e = 0.07, told in full in `sequences`: here that the work is finite whatever the time step.
#[test]
fn t27_infinitely_many_impacts_take_finite_work() {
    for time_step in [1e-3, 1.0 / 60.0, 10.0] {
        let floor = wall("floor", (9.0, 1.0), (0.0, -0.5));
        let box_ = block("box", (1.0, 1.0), (0.0, 1.5), (0.0, 0.0), 1.0);
        let ran = run(&falling(0.5, time_step, vec![floor, box_]), libm::ceil(3.0 / time_step) as u32);
        let found = state(&ran.world, "box");
        assert!(ran.hits.len() < 40, "{}", ran.hits.len());
        assert_close(&[found.z, found.vz], &[0.5, 0.0], 1e-12, "at rest");
    }
}

#[test]
fn t28_a_block_at_rest_on_a_floor_stays_whatever_its_restitution() {
    for (e, steps) in [(1.0, 100_000), (0.5, 5_000), (0.0, 5_000)] {
        let floor = wall("floor", (9.0, 1.0), (0.0, -0.5));
        let scene = falling(e, 1.0 / 60.0, vec![floor, block("box", (1.0, 1.0), (0.0, 0.5), (0.0, 0.0), 1.0)]);
        let mut world = World::new(&scene).expect("a valid scene");
        for step in 0..steps {
            world.step();
            if step % 1000 == 0 {
                let found = state(&world, "box");
                assert_close(&[found.x, found.z, found.angle], &[0.0, 0.5, 0.0], 1e-9, "it stays");
                assert!(world.kinetic_energy() <= 1e-18);
            }
        }
        assert!(world.collisions() <= 1, "{}", world.collisions());
    }
}

/// 22 bounces in 20 s, as high at the last as at the first. Reflecting overlaps after a step would lose 9 % at 1/1000 s.
#[test]
fn t29_an_elastic_bounce_keeps_its_height() {
    for time_step in [1e-3, 1.0 / 60.0, 0.5, 20.0] {
        let floor = wall("floor", (9.0, 1.0), (0.0, -0.5));
        let scene = falling(1.0, time_step, vec![floor, block("box", (1.0, 1.0), (0.0, 1.5), (0.0, 0.0), 1.0)]);
        let ran = run(&scene, libm::round(20.0 / time_step) as u32);
        let fall = libm::sqrt(2.0 / 9.81);
        let expected: Vec<f64> = (0..22).map(|k| fall * f64::from(2 * k + 1)).collect();
        assert_close(&ran.times(), &expected, 1e-12, "the bounces");
        let energy = ran.world.kinetic_energy() + 9.81 * (state(&ran.world, "box").z - 0.5);
        assert_close(&[energy / 9.81], &[1.0], 1e-12, "energy");
    }
}

/// A turning body that meets another and a wall: a little of everything, and few hits.
fn isolated(order: [usize; 3], exchange: ExchangeRule, time_step: f64) -> Scene {
    let all = [
        Body { spin: Some(0.4), ..block("car", (2.0, 1.0), (-6.0, 0.3), (5.0, 0.5), 2.0) },
        block("van", (2.0, 1.5), (0.0, 0.0), (-1.0, 0.0), 3.0),
        wall("wall", (1.0, 60.0), (9.0, 0.0)),
    ];
    let mut scene = continuous(0.7, time_step, order.map(|k| all[k].clone()).to_vec());
    (scene.settings.exchange, scene.settings.friction) = (exchange, 0.3);
    scene
}

#[test]
fn t32_a_great_angle_at_the_start_is_the_same_angle() {
    let with = |angle: f64| {
        let mut scene = isolated([0, 1, 2], ExchangeRule::Impulse, 1.0 / 60.0);
        scene.bodies[0].angle = angle;
        state(&run(&scene, 180).world, "car")
    };
    for angle in [1e9, -1e9, 1e6] {
        let turned = with(angle);
        let same = with(libm::atan2(libm::sin(angle), libm::cos(angle)));
        // ulp(1e9) = 1.2e-7 rad is what such an angle itself is known to.
        assert_close(&[turned.x, turned.z, turned.angle], &[same.x, same.z, same.angle], 1e-7, "the same");
    }
}

#[test]
fn t33_a_copy_made_on_the_way_runs_on_to_the_same_bits() {
    for exchange in [ExchangeRule::Impulse, ExchangeRule::Document] {
        let mut scene = isolated([0, 1, 2], exchange, 1.0 / 60.0);
        scene.settings.gravity = (0.0, -1.0);
        let mut unbroken = World::new(&scene).expect("a valid scene");
        (0..100).for_each(|_| unbroken.step());
        let mut copy = unbroken.clone();
        (0..100).for_each(|_| unbroken.step());
        (0..100).for_each(|_| copy.step());
        assert_eq!(copy.digest(), unbroken.digest());
        assert_eq!(copy.work(), unbroken.work());
    }
    // In the middle of an iteration, between two exchanges of it.
    let mut bodies = room((4.0, 4.0));
    let mut random = Random(3);
    for k in 0..9 {
        let at = (-2.5 + 2.5 * f64::from(k % 3), -2.5 + 2.5 * f64::from(k / 3));
        let v = (random.between(-9.0, 9.0), random.between(-9.0, 9.0));
        bodies.push(block(&format!("b{k}"), (1.0, 0.5), at, v, 1.0));
    }
    let mut world = World::new(&continuous(0.9, 0.5, bodies)).expect("a valid scene");
    world.step();
    world.begin();
    assert!(world.treat_next().is_some());
    let mut copy = world.clone();
    for world in [&mut world, &mut copy] {
        while world.treat_next().is_some() {}
        world.finish();
        (0..5).for_each(|_| world.step());
    }
    assert_eq!(copy.digest(), world.digest());
}

#[test]
fn t35_the_order_of_creation_does_not_change_a_bit_nor_does_a_mirror() {
    for exchange in [ExchangeRule::Impulse, ExchangeRule::Document] {
        let states = |scene: &Scene| {
            let world = run(scene, 240).world;
            (world.collisions(), ["car", "van", "wall"].map(|name| state(&world, name)))
        };
        let first = states(&isolated(ORDERS[0], exchange, 1.0 / 60.0));
        assert!(first.0 >= 2);
        for order in ORDERS {
            let scene = isolated(order, exchange, 1.0 / 60.0);
            assert_eq!(states(&scene), first, "{exchange:?}, {order:?}");
            let (collisions, mirror) = states(&mirrored(&scene));
            assert_eq!((collisions, mirror.map(|state| state.mirrored())), first, "{exchange:?}, mirrored");
        }
    }
}

/// Isolated collisions come out the same for every time step, with both exchanges; with the document's only up to a pair that goes on
/// approaching after its exchange, which is treated once an iteration (reading R11): here the van at the wall, not the car.
#[test]
fn the_time_step_does_not_change_what_isolated_collisions_do() {
    for exchange in [ExchangeRule::Impulse, ExchangeRule::Document] {
        let end = |steps: u32| {
            let world = run(&isolated([0, 1, 2], exchange, 4.0 / f64::from(steps)), steps).world;
            let (car, van) = (state(&world, "car"), state(&world, "van"));
            let all = [car.x, car.z, car.angle, car.vx, car.vz, car.spin, van.x, van.z, van.vx, van.vz, van.spin];
            all[..if exchange == ExchangeRule::Impulse { 11 } else { 6 }].to_vec()
        };
        let once = end(1);
        for steps in [2, 7, 60, 240, 4000] {
            assert_close(&end(steps), &once, 1e-12, &format!("{exchange:?}, {steps} steps"));
        }
    }
}
