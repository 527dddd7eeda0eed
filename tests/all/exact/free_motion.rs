//! M: free motion and mass properties.

use choque_engine::scene::{Body, Kind, MotionRule, Part, Settings};
use choque_engine::{Rect, Scene, World};

use super::kit::{assert_close, block, continuous, run, state, wall};

fn free(motion: MotionRule, time_step: f64, body: Body) -> World {
    let settings = Settings { motion, time_step, ..Settings::default() };
    World::new(&Scene { settings, bodies: vec![body], ..Scene::default() }).expect("a valid scene")
}

/// Gravity is solved exactly, whatever the step; symplectic Euler would be off by −g dt T/2 = −0.082 m at 1/60.
#[test]
fn m1_a_projectile_is_exact_at_any_time_step() {
    for motion in [MotionRule::Stepped, MotionRule::Continuous] {
        for steps in [1_u32, 60, 240, 10_000] {
            let settings =
                Settings { motion, gravity: (0.0, -9.81), time_step: 1.0 / f64::from(steps), ..Settings::default() };
            let body = block("ball", (1.0, 1.0), (0.0, 0.0), (3.0, 5.0), 1.0);
            let scene = Scene { settings, bodies: vec![body], ..Scene::default() };
            let found = state(&run(&scene, steps).world, "ball");
            assert_close(
                &[found.x, found.z, found.vx, found.vz],
                &[3.0, 5.0 - 0.5 * 9.81, 3.0, 5.0 - 9.81],
                1e-12,
                &format!("{motion:?}, {steps} steps"),
            );
        }
    }
}

#[test]
fn m2_free_spin_is_bit_exact_for_a_million_steps() {
    for motion in [MotionRule::Stepped, MotionRule::Continuous] {
        let mut body = block("top", (1.0, 0.5), (0.0, 0.0), (0.25, -0.5), 1.0);
        body.spin = Some(1.3);
        let mut world = free(motion, 1e-3, body);
        let id = world.find("top").expect("it is there");
        let start = (world.kinetic_energy(), world.spin(id), world.velocity(id));
        let momentum = world.angular_momentum();
        (0..1_000_000).for_each(|_| world.step());
        assert_eq!((world.kinetic_energy(), world.spin(id), world.velocity(id)), start);
        let turned = world.angle(id).rem_euclid(std::f64::consts::TAU);
        assert_close(&[turned], &[5.663_826_721_005_185_8], 1e-12, "1300 rad");
        assert_close(&[world.angular_momentum()], &[momentum], 1e-12, "angular momentum");
    }
}

fn compound(rects: &[(f64, f64, f64, f64)], mass: f64, centre: (f64, f64)) -> f64 {
    let mut body = Body::new("body", Kind::Mobile);
    body.mass = Some(mass);
    for (width, depth, x, z) in rects {
        let centred = Rect::centred(*width, *depth);
        body.parts.push(Part::Rect(Rect {
            x_min: centred.x_min + x - centre.0,
            x_max: centred.x_max + x - centre.0,
            z_min: centred.z_min + z - centre.1,
            z_max: centred.z_max + z - centre.1,
        }));
    }
    let world = free(MotionRule::Stepped, 1.0, body);
    world.inertia(world.find("body").expect("it is there"))
}

#[test]
fn m4_compound_bodies_have_the_inertia_of_their_rectangles() {
    let quarter = |x: f64, z: f64| (0.5, 0.5, x, z);
    let cases = [
        ("L", &[(3.0, 1.0, 1.5, 0.5), (1.0, 2.0, 0.5, 2.0)][..], 5.0, (1.1, 1.1), 217.0 / 30.0),
        ("plus", &[(3.0, 1.0, 0.0, 0.0), (1.0, 1.0, 0.0, 1.0), (1.0, 1.0, 0.0, -1.0)], 5.0, (0.0, 0.0), 29.0 / 6.0),
        ("T", &[(3.0, 1.0, 0.0, 2.0), (1.0, 2.0, 0.0, 0.5)], 5.0, (0.0, 1.4), 181.0 / 30.0),
        (
            "U",
            &[(3.0, 1.0, 0.0, 0.0), (1.0, 2.0, -1.0, 1.5), (1.0, 2.0, 1.0, 1.5)],
            7.0,
            (0.0, 6.0 / 7.0),
            505.0 / 42.0,
        ),
        (
            "a square of four",
            &[quarter(0.25, 0.25), quarter(-0.25, 0.25), quarter(-0.25, -0.25), quarter(0.25, -0.25)],
            1.0,
            (0.0, 0.0),
            1.0 / 6.0,
        ),
    ];
    for (name, rects, mass, centre, inertia) in cases {
        assert_close(&[compound(rects, mass, centre)], &[inertia], 4e-15, name);
    }
}

/// C1, a piece of E4 and a cradle, with 1024 m/s given to everything.
#[test]
fn m5_what_happens_does_not_depend_on_how_fast_all_of_it_goes() {
    let c1 = vec![
        Body { angle: libm::atan2(3.0, 4.0), ..block("a", (2.0, 1.0), (-2.0, 0.0), (3.0, 0.0), 2.0) },
        block("b", (1.0, 3.0), (0.0, 1.25), (0.0, 0.0), 3.0),
    ];
    let cradle = |i: u32| {
        let v = if i == 0 { 1.0 } else { 0.0 };
        block(&format!("b{i}"), (1.0, 1.0), (1.01 * f64::from(i), 0.0), (v, 0.0), 1.0 + f64::from(i))
    };
    let mut gas = vec![wall("left", (1.0, 9.0), (-0.5, 0.0)), wall("right", (1.0, 9.0), (12.5, 0.0))];
    for (i, v) in [-5.0, 5.125, -3.75, 1.0, -1.875, -1.75, 1.0, -3.875].into_iter().enumerate() {
        gas.push(block(&format!("rod{i}"), (0.5, 0.5), (0.75 + 1.5 * i as f64, 0.0), (v, 0.0), 1.0));
    }
    for (name, bodies) in [("C1", c1), ("E5", (0..4).map(cradle).collect()), ("E4", gas)] {
        let still = continuous(1.0, 1.0 / 64.0, bodies);
        let mut moving = still.clone();
        for body in &mut moving.bodies {
            let (x, z) = body.velocity.unwrap_or((0.0, 0.0));
            body.velocity = Some((x + 1024.0, z));
        }
        let steps = 128;
        let (still, moving) = (run(&still, steps), run(&moving, steps));
        assert_eq!(still.hits.len(), moving.hits.len(), "{name}");
        for id in still.world.ids() {
            let body = still.world.name(id);
            let (s, m) = (state(&still.world, body), state(&moving.world, body));
            let time = still.world.time();
            let found = [m.x - 1024.0 * time, m.z, m.angle, m.vx - 1024.0, m.vz, m.spin];
            assert_close(&found, &[s.x, s.z, s.angle, s.vx, s.vz, s.spin], 1e-11, &format!("{name}: {body}"));
        }
    }
}
