//! P4, P5, P7, P8, P9: blocks that tip, trip, topple and slip.

use choque_engine::Scene;
use choque_engine::scene::Body;

use super::kit::{G, State, assert_first_order, course, floor, grounded, on_a_corner, resting, steps, wall};

/// How far off the tilt at a given time may be, as a share of what it turns in one time step; and the spin, as a share, at 1/240 s.
struct Off {
    turns: f64,
    spin: f64,
}

/// Observed: 0.0017 and 2.5e-5, falling at second order and better.
const HELD: Off = Off { turns: 0.004, spin: 5e-5 };

/// Observed: 0.01 and 1e-4, falling at second order and better.
const ON_ICE: Off = Off { turns: 0.02, spin: 2e-4 };

/// How far off the spin with which it lands may be: seen at whole steps.
const LANDS_OFF: f64 = 0.02;

/// Distance from corner to centre of a post of 0.2 × 1 m.
fn half_diagonal() -> f64 {
    libm::sqrt(0.26)
}

/// A post that leans 0.1 rad past its right corner.
fn post(time_step: f64, friction: f64) -> Scene {
    grounded(time_step, friction, vec![floor(), on_a_corner("post", (0.2, 1.0), -0.1 - libm::atan(0.2))])
}

/// How far the line from foot to centre is past the vertical.
fn past(s: &State) -> f64 {
    -s.angle - libm::atan(0.2)
}

/// Tilt and spin after `time`, which is `parts` steps.
fn at(time: f64, parts: u32, friction: f64) -> (f64, State) {
    let time_step = time / f64::from(parts);
    (time_step, *course(&post(time_step, friction), "post", parts).last().expect("a state"))
}

fn falls_as_it_should(friction: f64, rows: &[(f64, f64, f64)], off: &Off, what: &str) {
    for (time, angle, spin) in rows {
        let runs = [100, 400].map(|parts| at(*time, parts, friction));
        let tilts = runs.map(|(time_step, s)| (time_step, past(&s) - angle));
        assert_first_order(&tilts, off.turns * spin, 1e-7, &format!("{what}: tilt at {time:.3} s"));
        let spins = runs.map(|(time_step, s)| (time_step, -s.spin / spin - 1.0));
        assert_first_order(&spins, 240.0 * off.spin, 1e-7, &format!("{what}: spin at {time:.3} s"));
    }
}

#[test]
fn p7_a_post_topples_about_its_foot() {
    let rows = [
        (0.50695180805955, 20.0, 1.2634111025690965),
        (0.61774453303788713, 30.0, 1.9292828218357592),
        (0.72782030702377241, 45.0, 2.8824093349403938),
    ];
    let rows = rows.map(|(time, degrees, spin)| (time, f64::to_radians(degrees), spin));
    falls_as_it_should(1.0, &rows, &HELD, "P7");
}

#[test]
fn p8_on_ice_a_post_falls_straight_down() {
    let rows = [(0.41403649794750163, f64::to_radians(45.0), 3.6459914589371211)];
    falls_as_it_should(0.0, &rows, &ON_ICE, "P8");
    let flat = 0.55305090583636641;
    let time_step = flat / 200.0;
    let course = course(&post(time_step, 0.0), "post", 240);
    let from = half_diagonal() * libm::sin(0.1);
    assert!(course.iter().all(|s| (s.x - from).abs() <= 1e-9), "its centre goes straight down");
    let fastest = course.iter().map(|s| s.spin.abs()).fold(0.0, f64::max);
    assert!((fastest / 4.8723192400263873 - 1.0).abs() <= LANDS_OFF, "{fastest} rad/s when it lands");
    let landed = course.iter().position(|s| s.spin.abs() == fastest).expect("it is there") as f64 * time_step;
    assert!((landed - flat).abs() <= 2.0 * time_step, "it lands at {landed} s");
    let end = course.last().expect("a state");
    assert!((end.z - 0.1).abs() <= 1e-6 && end.spin.abs() <= 1e-6, "it lies flat: {end:?}");
}

/// A block of 0.5 × 1 on a slope of that many degrees, for two seconds: how far it turned, and how far it went down the slope.
fn stands(degrees: f64, friction: f64) -> (f64, f64) {
    let angle = degrees.to_radians();
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    let slope = Body { angle, ..wall("slope", (40.0, 1.0), (0.5 * s, -0.5 * c)) };
    let block = Body { angle, ..resting("block", (0.5, 1.0), (-0.5 * s, 0.5 * c)) };
    let course = course(&grounded(1.0 / 120.0, friction, vec![slope, block]), "block", 240);
    let end = course.last().expect("a state");
    (end.angle - angle, -(end.x * c + end.z * s))
}

#[test]
fn p4_tips_or_slides() {
    let (turned, slid) = stands(26.5, 0.8);
    assert!(turned.abs() <= 1e-6 && slid.abs() <= 1e-6, "26.5°: {turned:e} rad, {slid:e} m");
    let (turned, _) = stands(26.7, 0.8);
    assert!(turned > 0.7, "26.7°: {turned} rad");
    let (turned, slid) = stands(21.7, 0.4);
    assert!(turned.abs() <= 1e-6 && slid.abs() <= 1e-6, "21.7°: {turned:e} rad, {slid:e} m");
    let (turned, slid) = stands(22.0, 0.4);
    let angle = f64::to_radians(22.0);
    let way = 2.0 * G * (libm::sin(angle) - 0.4 * libm::cos(angle));
    assert!(turned.abs() <= 1e-6 && (slid / way - 1.0).abs() <= 1.01 / 240.0, "22°: {turned:e} rad, {slid} of {way} m");
}

/// A block of b × 1 slides into a kerb 2 mm high at that speed: whether it goes over.
fn trips(b: f64, speed: f64) -> bool {
    let kerb = wall("kerb", (1.0, 1.0), (2.5, -0.498));
    let block = resting("block", (b, 1.0), (2.0 - b / 2.0 - speed / 8.0, 0.5));
    let block = Body { velocity: Some((speed, 0.0)), ..block };
    let course = course(&grounded(1.0 / 240.0, 0.0, vec![floor(), kerb, block]), "block", 480);
    course.iter().any(|s| s.angle.abs() > 1.2)
}

/// v² = (32/3) g R² (R − h/2)/h²; the kerb's height and the time step move that by no more than this share. Observed: not yet.
const TRIP_OFF: f64 = 0.03;

#[test]
fn p5_blocks_trip_over_a_kerb() {
    for (b, speed) in [(1.0, 3.2917817047429142), (0.5, 1.3891924690483968), (0.2, 0.51903415057303707)] {
        let half_diagonal = libm::sqrt(b * b + 1.0) / 2.0;
        let squared = 32.0 / 3.0 * G * half_diagonal * half_diagonal * (half_diagonal - 0.5);
        assert!((libm::sqrt(squared) / speed - 1.0).abs() <= 1e-14, "the formula and its number");
        assert!(trips(b, speed * (1.0 + TRIP_OFF)), "{b} × 1 goes over at {speed}, and a little more");
        assert!(!trips(b, speed * (1.0 - TRIP_OFF)), "{b} × 1 falls back at {speed}, and a little less");
    }
}

/// A ladder of 2 × 0.04 m leans on a wall with friction a half for 5 s: the greatest angle it turned by.
fn ladder(degrees: f64) -> f64 {
    let angle = degrees.to_radians();
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    let ladder = Body { angle, ..resting("ladder", (2.0, 0.04), (-c - 0.02 * s, s + 0.02 * c)) };
    let scene = grounded(1.0 / 120.0, 0.5, vec![floor(), wall("wall", (1.0, 4.0), (0.5, 2.0)), ladder]);
    let course = course(&scene, "ladder", steps(5.0, 1.0 / 120.0));
    course.iter().map(|s| (s.angle - angle).abs()).fold(0.0, f64::max)
}

/// tan θ = (1 − μ²)/(2 μ + (t/L)(1 + μ²)), 36.19° here.
#[test]
fn p9_a_ladder_stands_or_slips() {
    let limit = libm::atan(0.73170731707317073).to_degrees();
    let (stood, slipped) = (ladder(limit + 0.2), ladder(limit - 0.2));
    println!("P9: {stood:e} and {slipped} rad");
    assert!(stood <= 1e-6, "{stood:e}");
    assert!(slipped > 0.3, "{slipped}");
}
