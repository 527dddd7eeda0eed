//! C: one impact, with exact fractions.

use choque_engine::Scene;
use choque_engine::scene::Body;

use super::kit::{
    State, assert_close, at_first_hit, block, continuous, mirrored, run, state, stepped, velocities, wall,
};

/// The bodies of C1 and C2: A 2 × 1 m of 2 kg at 3 m/s, B 1 × 3 m of 3 kg at rest. A hits B's left face with its corner (11/10, 1/5)
/// when it is turned by atan(3/4), and flat from z = −1/4 to 1/2 when it is not.
fn a_meets_b(restitution: f64, angle: f64) -> Scene {
    let a = Body { angle, ..block("a", (2.0, 1.0), (-2.0, 0.0), (3.0, 0.0), 2.0) };
    continuous(restitution, 0.25, vec![a, block("b", (1.0, 3.0), (0.0, 1.25), (0.0, 0.0), 3.0)])
}

/// Stopped at the impact and found a step later: where one hits the other does not depend on how deep it is found.
fn assert_c(scene: &Scene, expected: [f64; 4], energy: f64) {
    // In steps and without restitution the corner stays at the turning face until the step is over: 2.5e-8 of the speed.
    let lasts = if scene.settings.restitution == 0.0 { 1e-7 } else { 4e-15 };
    for (scene, within) in [(scene.clone(), 4e-15), (stepped(scene, 1.0 / 1024.0), lasts)] {
        let world = at_first_hit(&scene);
        let (a, b) = (state(&world, "a"), state(&world, "b"));
        assert_close(&[a.vx, a.spin, b.vx, b.spin], &expected, within, "velocities");
        assert_close(&[a.vz, b.vz], &[0.0; 2], within, "nothing along the face");
        assert_close(&[world.kinetic_energy() / 9.0], &[energy], within, "energy");
        assert_close(&[world.momentum().x], &[6.0], 1e-14, "momentum");
    }
}

/// One point or two, it is one impact. Without restitution the corner stays at the face while both turn: a lasting contact, which is told
/// of as often as it is taken up anew (9 and 5 times in the rest of the quarter second).
fn assert_hits(scene: &Scene) {
    let hits = run(scene, 1).hits.len();
    assert!(if scene.settings.restitution > 0.0 { hits == 1 } else { hits < 20 }, "{hits} hits");
}

#[test]
fn c1_a_vertex_meets_a_face_off_centre() {
    let cases = [
        (1.0, [2901.0, 4320.0, 6000.0, 7560.0], 1.0),
        (0.5, [5151.0, 3240.0, 4500.0, 5670.0], 2842.0 / 3967.0),
        (0.0, [7401.0, 2160.0, 3000.0, 3780.0], 2467.0 / 3967.0),
    ];
    for (e, expected, energy) in cases {
        let scene = a_meets_b(e, libm::atan2(3.0, 4.0));
        assert_c(&scene, expected.map(|x| x / 3967.0), energy);
        assert_close(&[at_first_hit(&scene).time()], &[0.4 / 3.0], 1e-16, "A's corner has 0.4 m to go");
        assert_hits(&scene);
    }
}

/// Not C2′, a single impulse at the corner: that leaves A at 129/163 and the other end parting too slowly.
#[test]
fn c2_parallel_faces_meet_at_two_points_at_once() {
    let cases = [
        (1.0, [87.0, 216.0, 192.0, 216.0], 1.0),
        (0.5, [159.0, 162.0, 144.0, 162.0], 89.0 / 125.0),
        (0.0, [231.0, 108.0, 96.0, 108.0], 77.0 / 125.0),
    ];
    for (e, expected, energy) in cases {
        let expected = expected.map(|x| x / 125.0);
        assert_c(&a_meets_b(e, 0.0), expected, energy);
        assert_hits(&a_meets_b(e, 0.0));
        // Newton's law at both ends, z = 1/2 and z = −1/4: they part at e times 3 m/s.
        for z in [0.5, -0.25] {
            let parting = (expected[2] - expected[3] * (z - 1.25)) - (expected[0] - expected[1] * z);
            assert_close(&[parting], &[3.0 * e], 1e-14, "parting");
        }
    }
}

#[test]
fn c1_c2_mirrored_give_mirrored_bits() {
    for angle in [0.0, 0.3, libm::atan2(3.0, 4.0)] {
        let scene = a_meets_b(0.5, angle);
        let (there, mirror) = (run(&scene, 3).world, run(&mirrored(&scene), 3).world);
        for name in ["a", "b"] {
            assert_eq!(state(&there, name).mirrored(), state(&mirror, name), "{name} at {angle}");
        }
    }
}

/// What a unit-speed fall without friction on a floor leaves: (v, |ω|), and the hits it took.
fn landed(size: (f64, f64), restitution: f64, tilt: f64) -> (f64, f64, usize) {
    let body = Body { angle: tilt, ..block("body", size, (0.0, 0.5 * size.1 + 0.5), (0.0, -1.0), 1.0) };
    let scene = continuous(restitution, 0.5625, vec![wall("floor", (99.0, 1.0), (0.0, -0.5)), body]);
    let ran = run(&scene, 1);
    let State { vz, spin, .. } = state(&ran.world, "body");
    (vz, spin, ran.hits.len())
}

/// The rule: a face tilted by 1e-10 rad or less lands flat, both corners at once; by more, corner after corner.
#[test]
fn c5_t26_a_near_flat_landing_follows_its_named_threshold() {
    for (e, flat, tilted) in [(1.0, 1.0, [23.0 / 25.0, 24.0 / 25.0]), (0.5, 0.5, [19.0 / 50.0, 27.0 / 50.0])] {
        for tilt in [0.0, 1e-15, 1e-12, 9e-11] {
            let (v, w, hits) = landed((1.0, 1.0), e, tilt);
            assert_close(&[v, w], &[flat, 0.0], 1e-9, "flat");
            assert_eq!(hits, 1);
            assert_eq!(landed((1.0, 1.0), e, -tilt), (v, -w, hits), "mirror images to the bit");
        }
        for tilt in [2e-10, 1e-9, 1e-7, 1e-6] {
            let (v, w, hits) = landed((1.0, 1.0), e, tilt);
            assert_close(&[v, w.abs()], &tilted, 4.0 * tilt, "corner by corner");
            assert_eq!(landed((1.0, 1.0), e, -tilt), (v, -w, hits), "mirror images to the bit");
        }
    }
}

#[test]
fn c5b_other_shapes_land_corner_by_corner() {
    let cases = [
        ((2.0, 1.0), 1.0, 4697.0 / 4913.0, 2232.0 / 4913.0, 3),
        ((1.0, 2.0), 1.0, 7.0 / 8.0, -3.0 / 4.0, 2),
        ((10.0, 1.0), 1.0, 0.999_916_25, 0.004_460_84, 3),
        ((1.0, 2.0), 0.0, 3.0 / 32.0, -3.0 / 16.0, 2),
    ];
    for (size, e, v, w, hits) in cases {
        let found = landed(size, e, 1e-9);
        assert_close(&[found.0, found.1], &[v, w], 1e-7, &format!("{size:?}"));
        // Two corners take turns; which of them struck last decides the sign of the spin, the source counts from the first.
        assert_eq!(found.2, hits, "{size:?}: hits");
    }
}

/// A square without restitution: infinitely many hits, each a fifth of the last, and then it lies.
#[test]
fn c5_a_plastic_landing_takes_finite_work_and_rests() {
    let (v, w, hits) = landed((1.0, 1.0), 0.0, 1e-6);
    assert_close(&[v, w], &[0.0, 0.0], 1e-6, "at rest");
    assert!(hits < 100, "{hits}");
}

/// A blade that turns about its own centre at Ω = 2 rad/s comes level when it strikes a block of 1 kg and 1/24 kg·m² at radius 3. The block
/// is turned so that the corner which is struck stands `lever` beside its centre.
fn blade_strikes(restitution: f64, side: f64, lever: f64) -> State {
    let half = 0.5 * side;
    // The corner (−h, −h) is at −h(c − s) beside and −h(c + s) below the centre.
    let difference = lever / half;
    let sum = (2.0 - difference * difference).sqrt();
    let (c, s) = (0.5 * (sum + difference), 0.5 * (sum - difference));
    let mut blade = wall("blade", (7.0, 0.1), (0.0, 0.0));
    (blade.angle, blade.spin) = (-0.5, Some(2.0));
    let at = (3.0 + lever, 0.05 + half * sum);
    let block = Body {
        angle: libm::atan2(s, c),
        inertia: Some(1.0 / 24.0),
        ..block("block", (side, side), at, (0.0, 0.0), 1.0)
    };
    let scene = continuous(restitution, 1.0, vec![blade, block]);
    let world = at_first_hit(&scene);
    assert_close(&[world.time()], &[0.25], 1e-15, "when the blade is level");
    assert_eq!(state(&world, "blade").spin, 2.0, "a fixed body is not slowed");
    state(&world, "block")
}

#[test]
fn c6_a_turning_blade_strikes_with_its_own_speed_at_the_contact() {
    // A square of 1/2 m has its corners up to 1/4 beside its centre, where its face would lie flat: the last is a larger one.
    let cases = [
        (1.0, 0.5, 0.0, 12.0, 0.0),
        (1.0, 0.5, 0.1, 300.0 / 31.0, 720.0 / 31.0),
        (1.0, 0.6, 0.25, 24.0 / 5.0, 144.0 / 5.0),
        (0.5, 0.5, 0.0, 9.0, 0.0),
        (0.5, 0.5, 0.1, 225.0 / 31.0, 540.0 / 31.0),
        (0.5, 0.6, 0.25, 18.0 / 5.0, 108.0 / 5.0),
    ];
    for (e, side, lever, v, w) in cases {
        let block = blade_strikes(e, side, lever);
        assert_close(&[block.vx, block.vz, block.spin.abs()], &[0.0, v, w], 4e-14, &format!("e = {e}, lever {lever}"));
    }
}

/// A point struck at radius 1 flies off at twice the blade's speed there; a blade that turns on meets it again where
/// tan φ = 2φ, if it is long enough.
#[test]
fn c6b_a_longer_blade_hits_a_second_time() {
    const RADIUS: f64 = 2.536_558_989_230_598_7;
    const PHI: f64 = 1.165_561_185_207_211_3;
    let side = 1e-6;
    let strike = |length: f64| {
        let mut blade = wall("blade", (2.0 * length, 1e-9), (0.0, 0.0));
        (blade.angle, blade.spin) = (-0.5, Some(1.0));
        let corner = side * libm::sqrt(0.5);
        let mut point = block("point", (side, side), (1.0, corner), (0.0, 0.0), 1.0);
        point.angle = std::f64::consts::FRAC_PI_4;
        run(&continuous(1.0, 1.0 / 64.0, vec![blade, point]), 128).times()
    };
    let short = strike(RADIUS - 1e-4);
    assert_eq!(short.len(), 1);
    assert_close(&short, &[0.5], 1e-9, "the first hit");
    let long = strike(RADIUS + 1e-4);
    assert!(long.len() >= 2);
    assert_close(&[long[1] - long[0]], &[PHI], 10.0 * side, "the second hit");
}

/// A rotor of 10 kg·m² that may turn: its mass of 1e18 kg holds its centre as a pivot would.
#[test]
fn c6c_a_free_rotor_gives_what_the_block_takes() {
    let mut rotor = block("rotor", (7.0, 0.1), (0.0, 0.0), (0.0, 0.0), 1e18);
    (rotor.angle, rotor.spin, rotor.inertia) = (-0.5, Some(2.0), Some(10.0));
    let half = 0.25;
    let at = (3.0, 0.05 + half * libm::sqrt(2.0));
    let block = Body {
        angle: std::f64::consts::FRAC_PI_4,
        inertia: Some(1.0 / 24.0),
        ..block("block", (0.5, 0.5), at, (0.0, 0.0), 1.0)
    };
    let world = at_first_hit(&continuous(1.0, 1.0, vec![rotor, block]));
    let (rotor, block) = (state(&world, "rotor"), state(&world, "block"));
    assert_close(&[block.vz, block.spin, rotor.spin], &[120.0 / 19.0, 0.0, 2.0 / 19.0], 4e-14, "after the hit");
    assert_close(&[0.5 * 10.0 * rotor.spin * rotor.spin + 0.5 * block.vz * block.vz], &[20.0], 1e-13, "energy");
}

fn head_on(masses: (f64, f64), restitution: f64, v: (f64, f64)) -> Vec<f64> {
    let one = block("one", (1.0, 1.0), (-2.0, 0.0), (v.0, 0.0), masses.0);
    let two = block("two", (1.0, 1.0), (2.0, 0.0), (v.1, 0.0), masses.1);
    velocities(&run(&continuous(restitution, 8.0, vec![one, two]), 1).world)
}

#[test]
fn c7_t16_a_ratio_of_masses_of_1e8_and_1e12() {
    let found = head_on((1e8, 1.0), 1.0, (1.0, 0.0));
    assert_close(&found, &[0.999_999_980_000_000_2, 1.999_999_980_000_000_1], 2.3e-16, "1e8");
    for ratio in [1e2, 1e6, 1e10, 1e12] {
        let found = head_on((ratio, 1.0), 1.0, (1.0, 0.0));
        let (heavy, light) = ((ratio - 1.0) / (ratio + 1.0), 2.0 * ratio / (ratio + 1.0));
        assert_close(&found, &[heavy, light], 4.5e-16, &format!("{ratio:e}"));
        let found = head_on((1.0, ratio), 1.0, (1.0, 0.0));
        assert_close(&found, &[(1.0 - ratio) / (1.0 + ratio), 2.0 / (1.0 + ratio)], 4.5e-16, "light on heavy");
    }
}

#[test]
fn c8_a_plastic_pair_goes_on_as_one() {
    for (m1, m2, v1, v2) in [(2.0, 5.0, 3.0, -1.0), (1.0, 1.0, 1.0, 0.0), (1e-3, 1e3, 7.0, 1.0)] {
        let common = (m1 * v1 + m2 * v2) / (m1 + m2);
        let found = head_on((m1, m2), 0.0, (v1, v2));
        assert_close(&found, &[common; 2], 1e-15, "velocities");
        let energy = |u: f64, w: f64| 0.5 * (m1 * u * u + m2 * w * w);
        let reduced = m1 * m2 / (m1 + m2);
        let loss = 0.5 * reduced * (v1 - v2) * (v1 - v2);
        assert_close(&[energy(v1, v2) - energy(found[0], found[1])], &[loss], 1e-14 * energy(v1, v2), "loss");
    }
}
