//! The moment of impact, against closed forms and against a fine search.

use std::f64::consts::PI;

use choque_engine::bodies::Motion;
use choque_engine::detect::{Face, overlap};
use choque_engine::flight::{Path, Pull};
use choque_engine::frame::Frame;
use choque_engine::impact_time::{Flier, first_touch};
use choque_engine::{Rect, Vec2};

use crate::random_scenes::Random;

fn flier(size: (f64, f64), at: (f64, f64), angle: f64, v: (f64, f64), omega: f64) -> Flier {
    let frame = Frame::new(Vec2::new(at.0, at.1), angle);
    let motion = Motion { v: Vec2::new(v.0, v.1), omega };
    Flier { path: Path { frame, motion, pull: Pull::NONE }, rect: Rect::centred(size.0, size.1) }
}

#[test]
fn t11_a_small_fast_block_meets_a_thin_wall_on_time() {
    let block = flier((0.1, 0.1), (0.0, 0.0), 0.0, (1000.0, 0.0), 0.0);
    let wall = flier((0.01, 10.0), (5.0, 0.0), 0.0, (0.0, 0.0), 0.0);
    let touch = first_touch(&block, &wall, 1.0 / 60.0).expect("it is in the way");
    assert!((touch.time - 0.004_945).abs() < 1e-17, "{}", touch.time);
    assert!(first_touch(&block, &wall, 0.004).is_none(), "not within 4 ms");
}

#[test]
fn t11_two_thin_plates_at_700_and_900_metres_a_second_meet() {
    let one = flier((0.01, 1.0), (-1.0, 0.0), 0.0, (700.0, 0.0), 0.0);
    let two = flier((0.01, 1.0), (1.0, 0.3), 0.0, (-900.0, 0.0), 0.0);
    let touch = first_touch(&one, &two, 1.0).expect("they meet");
    assert!((touch.time - 1.99 / 1600.0).abs() < 1e-18, "{}", touch.time);
}

#[test]
fn t12_a_bar_spinning_many_turns_a_step_hits_at_the_first_pass() {
    // 2 × 0.02 m at 400 rad/s; a block's corner stands at radius 0.9, a quarter turn ahead of the bar's face.
    let bar = flier((2.0, 0.02), (0.0, 0.0), 0.0, (0.0, 0.0), 400.0);
    let block = flier((0.2, 0.2), (0.0, 1.0), 0.0, (0.0, 0.0), 0.0);
    let touch = first_touch(&bar, &block, 1.0 / 60.0).expect("it is in the way");
    // The bar's leading face z′ = 0.01 reaches the corner (0.1, 0.9): θ + asin(0.01/R) = atan2(0.9, 0.1).
    let radius = (0.01_f64 + 0.81).sqrt();
    let angle = libm::atan2(0.9, 0.1) - libm::asin(0.01 / radius);
    assert!((touch.time - angle / 400.0).abs() < 1e-16, "{} instead of {}", touch.time, angle / 400.0);
    assert!(touch.face_of_first && touch.face == Face::ZMax);
}

#[test]
fn what_flies_apart_or_past_never_touches() {
    let still = flier((1.0, 1.0), (0.0, 0.0), 0.3, (0.0, 0.0), 0.0);
    assert!(first_touch(&still, &flier((1.0, 1.0), (3.0, 0.0), 0.0, (1.0, 0.0), 5.0), 1e6).is_none());
    assert!(first_touch(&still, &flier((1.0, 1.0), (-9.0, 1.9), 0.0, (1.0, 0.0), 0.0), 1e6).is_none());
    // Face to face at rest, and parting from a touch.
    let square = flier((1.0, 1.0), (0.0, 0.0), 0.0, (0.0, 0.0), 0.0);
    assert!(first_touch(&square, &flier((1.0, 1.0), (1.0, 0.0), 0.0, (0.0, 0.0), 0.0), 1e6).is_none());
    assert!(first_touch(&square, &flier((1.0, 1.0), (1.0, 0.0), 0.0, (1e-9, 0.0), 0.0), 1e3).is_none());
}

/// No impact is stepped over: up to the touch nothing overlaps at 2,000 moments, and at the touch the gap is closed.
#[test]
fn between_now_and_the_touch_nothing_overlaps() {
    let mut random = Random(3);
    let (mut touches, mut misses) = (0, 0);
    for case in 0..900 {
        let mut one = |x: f64| {
            let size = (random.between(0.02, 2.0), random.between(0.02, 2.0));
            let v = (random.between(-9.0, 9.0), random.between(-3.0, 3.0));
            flier(size, (x, random.between(-1.0, 1.0)), random.between(-PI, PI), v, random.between(-40.0, 40.0))
        };
        let (a, b) = (one(-1.6), one(1.6));
        let gap = |time: f64| {
            let (a, b) = (a.after(time), b.after(time));
            -overlap::depth(&a.path.frame, &a.rect, &b.path.frame, &b.rect)
        };
        if gap(0.0) <= 0.0 {
            continue;
        }
        let touch = first_touch(&a, &b, 1.0);
        let until = touch.map_or(1.0, |touch| touch.time);
        for k in 0..2000 {
            let time = until * f64::from(k) / 2000.0;
            assert!(gap(time) > -1e-14, "case {case}: {} deep at {time}, before {until}", -gap(time));
        }
        if let Some(touch) = touch {
            assert!(gap(touch.time).abs() < 1e-13, "case {case}: a gap of {} at the touch", gap(touch.time));
            touches += 1;
        } else {
            misses += 1;
        }
    }
    assert!(touches > 100 && misses > 50, "{touches} touches, {misses} misses");
}
