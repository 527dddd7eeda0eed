//! P1, P2, P3, P11: blocks that friction stops, holds, lets slide and takes along.

use choque_engine::Scene;
use choque_engine::scene::Body;

use super::kit::{DT, G, State, assert_first_order, course, floor, grounded, resting, steps, wall};

/// A symplectic Euler stepper is off by half a step of the speed it starts with, −v dt/2: this share more is allowed. Observed at 1/60 s:
/// P1 5e-6 m of 42 mm, P11 7e-6 of 17 mm, both falling at second order; P2 9e-14.
const OF_SYMPLECTIC_EULER: f64 = 1.002;

/// What a resting block may creep in 1000 s [m]. Observed: 3e-14.
const CREEP: f64 = 1e-9;

const TIME_STEPS: [f64; 3] = [1.0 / 60.0, 1.0 / 240.0, 1.0 / 1000.0];

#[test]
fn p1_a_block_slides_to_rest() {
    let (v, mu) = (5.0, 0.3);
    let errors = TIME_STEPS.map(|time_step| {
        let block = Body { velocity: Some((v, 0.0)), ..resting("block", (2.0, 0.5), (0.0, 0.25)) };
        let scene = grounded(time_step, mu, vec![floor(), block]);
        let course = course(&scene, "block", steps(2.5, time_step));
        let end = course.last().expect("a state");
        assert!(
            course.iter().all(|s| (s.z - 0.25).abs() <= 1e-6 && s.angle.abs() <= 1e-6),
            "it slides flat on the floor"
        );
        assert!(end.vx.abs() <= 1e-12, "it lies still: {end:?}");
        let stopped = course.iter().position(|s| s.vx.abs() <= 1e-12).expect("it stops") as f64 * time_step;
        assert!((stopped - 1.6989466530750934).abs() <= time_step * 1.001, "it stops after {stopped} s");
        (time_step, end.x - 4.2473666326877336)
    });
    assert_first_order(&errors, v / 2.0 * OF_SYMPLECTIC_EULER, 1e-9, "P1: where it stops");
}

/// A slope of 30° and a slab on it at the origin.
fn slope(time_step: f64, mu: f64, v: f64) -> Scene {
    let (s, c) = (0.5, libm::sqrt(0.75));
    let angle = libm::atan2(s, c);
    let slope = Body { angle, ..wall("slope", (100.0, 1.0), (0.5 * s, -0.5 * c)) };
    let slab = resting("slab", (2.0, 0.5), (-0.25 * s, 0.25 * c));
    let slab = Body { angle, velocity: Some((v * c, v * s)), ..slab };
    grounded(time_step, mu, vec![slope, slab])
}

/// How far up the slope, and how fast.
fn up(s: &State) -> (f64, f64) {
    let c = libm::sqrt(0.75);
    (s.x * c + s.z * 0.5, s.vx * c + s.vz * 0.5)
}

#[test]
fn p2_just_held_it_does_not_creep_in_a_thousand_seconds() {
    let course = course(&slope(DT, 0.5774, 0.0), "slab", 60_000);
    let farthest = course.iter().map(|s| up(s).0.abs()).fold(0.0, f64::max);
    println!("P2: crept {farthest:e} m");
    assert!(farthest <= CREEP, "{farthest:e}");
}

#[test]
fn p2_not_quite_held_it_slides() {
    // μ, a, and the way of 2 s.
    let rows = [
        (0.5773, 4.2707241733941e-4, 8.5414483467883e-4),
        (0.57, 0.062445749658554, 0.12489149931711),
        (0.5, 0.65714539443733, 1.3142907888746569),
    ];
    for (mu, a, way) in rows {
        let errors = TIME_STEPS.map(|time_step| {
            let course = course(&slope(time_step, mu, 0.0), "slab", steps(2.0, time_step));
            let (found, speed) = up(course.last().expect("a state"));
            assert!((speed + 2.0 * a).abs() <= 2.0 * a * 1e-3 + 1e-12, "μ = {mu}: {speed} m/s");
            (time_step, found + way)
        });
        // From rest, symplectic Euler is off by a T dt/2.
        assert_first_order(&errors, a * OF_SYMPLECTIC_EULER, 1e-12, "P2: how far it slides");
    }
}

#[test]
fn p3_up_and_back() {
    let (there, back) = (0.7571006376682241, 1.08664993045673);
    let (mut tops, mut speeds) = (Vec::new(), Vec::new());
    for parts in [110, 440, 1760] {
        let time_step = (there + back) / f64::from(parts);
        let course = course(&slope(time_step, 0.2, 5.0), "slab", parts);
        let top = course.iter().map(|s| up(s).0).fold(0.0, f64::max);
        let (place, speed) = up(course.last().expect("a state"));
        assert!(place.abs() <= 5.0 / 2.0 * time_step * OF_SYMPLECTIC_EULER, "it is back at {place}");
        tops.push((time_step, top - 1.8927515941705604));
        speeds.push((time_step, speed + 3.4836455442002694));
    }
    // The top is seen at whole steps only, which costs no more than a dt²/8.
    for (time_step, error) in tops {
        println!("P3: dt {time_step:.2e}: the top is off by {error:+.3e}");
        assert!(error.abs() <= 5.0 / 2.0 * time_step * OF_SYMPLECTIC_EULER, "{error:e} at {time_step:e}");
    }
    // Friction turns round within a step: its change, 2 μ g cos 30°, over at most that step.
    for (time_step, error) in speeds {
        println!("P3: dt {time_step:.2e}: it comes back off by {error:+.3e} m/s");
        assert!(error.abs() <= 2.0 * 0.2 * G * libm::sqrt(0.75) * time_step, "{error:e} at {time_step:e}");
    }
}

#[test]
fn p11_a_belt_takes_a_block_along() {
    let taken = 0.50968399592252803;
    let errors = TIME_STEPS.map(|time_step| {
        let belt = Body { velocity: Some((2.0, 0.0)), ..wall("belt", (40.0, 1.0), (0.0, -0.5)) };
        let scene = grounded(time_step, 0.4, vec![belt, resting("block", (1.0, 0.5), (0.0, 0.25))]);
        let course = course(&scene, "block", steps(1.0, time_step));
        let end = course.last().expect("a state");
        assert!((end.vx - 2.0).abs() <= 1e-12, "{end:?}");
        let slipped = 2.0 * time_step * f64::from(steps(1.0, time_step)) - end.x;
        (time_step, slipped - taken)
    });
    assert_first_order(&errors, 2.0 / 2.0 * OF_SYMPLECTIC_EULER, 1e-9, "P11: how far it slips");
}
