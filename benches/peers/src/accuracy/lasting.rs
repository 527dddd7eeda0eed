//! Contacts that last: sliding, rocking, seams.

use super::play::Play;
use super::{Case, Phases, Start};
use crate::judge::worse;
use crate::scene::{Body, Judge, Role, Scene};

const GRAVITY: f64 = 9.81;

pub(super) fn cases() -> Vec<Case> {
    let case = |name, title, error, scene, judge| Case::new([name, title, error], Phases::One, scene, judge);
    vec![
        case("p1", "P1: a block slides to rest", "error of the distance [m]", slider, slid),
        case(
            "p6",
            "P6: a block rocks past its first impact",
            "greatest vertex distance / half diagonal",
            rocker,
            rocked,
        ),
        case("t10", "T10: a block slides over forty boxes", "error of the distance [m]", seams, crossed),
    ]
}

fn heavy(bodies: Vec<Body>, friction: f64) -> Scene {
    let mut scene = Scene::new(0, Judge::Nothing);
    scene.gravity = [0.0, -GRAVITY];
    scene.bodies = bodies;
    scene.bodies.iter_mut().for_each(|body| body.friction = friction);
    scene
}

fn floor() -> Body {
    Body::new(Role::Fixed, [0.0, -0.5], [20.0, 0.5])
}

fn slider(_: &Start) -> Scene {
    let block = Body::new(Role::Mobile, [0.0, 0.25], [1.0, 0.25]);
    heavy(vec![floor(), Body { velocity: [5.0, 0.0], ..block }], 0.3)
}

fn slid(play: &mut Play) -> f64 {
    play.to(2.0);
    (play.motion(1).at[0] - 25.0 / (2.0 * 0.3 * GRAVITY)).abs()
}

/// Half width and half height of Housner's block (1963) \[m\].
const BLOCK: [f64; 2] = [0.1, 0.5];

/// The angle at which it would stand on a corner.
fn balance() -> f64 {
    libm::atan2(BLOCK[0], BLOCK[1])
}

/// Where its centre is when it leans by that angle, on its left corner when it leans to the left.
fn leaning(angle: f64) -> [f64; 2] {
    let side = if angle < 0.0 { -1.0 } else { 1.0 };
    let (sin, cos) = libm::sincos(angle.abs());
    let [x, y] = BLOCK;
    [side * (cos * x - sin * y - x), sin * x + cos * y]
}

/// Let go leaning to the left by half of that.
fn rocker(_: &Start) -> Scene {
    let angle = 0.5 * balance();
    heavy(vec![floor(), Body { angle, ..Body::new(Role::Mobile, leaning(angle), BLOCK) }], 1.0)
}

/// When it first comes down \[s\], and how fast it then turns \[rad/s\]; of that 49/52 are left.
const DOWN: [f64; 2] = [0.3470935867888813, 0.648_049_012_267_53];

/// How far it leans so long after it left an angle with a spin that turns it upright when negative.
fn swung(mut angle: f64, mut spin: f64, time: f64) -> f64 {
    const PARTS: usize = 20_000;
    let p2 = 0.75 * GRAVITY / libm::hypot(BLOCK[0], BLOCK[1]);
    let pull = |angle: f64| -p2 * libm::sin(balance() - angle);
    let h = time / PARTS as f64;
    // Runge and Kutta's fourth order: 1e-16 with so many parts.
    for _ in 0..PARTS {
        let (a1, s1) = (spin, pull(angle));
        let (a2, s2) = (spin + 0.5 * h * s1, pull(angle + 0.5 * h * a1));
        let (a3, s3) = (spin + 0.5 * h * s2, pull(angle + 0.5 * h * a2));
        let (a4, s4) = (spin + h * s3, pull(angle + h * a3));
        angle += h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
        spin += h / 6.0 * (s1 + 2.0 * (s2 + s3) + s4);
    }
    angle
}

fn rocked(play: &mut Play) -> f64 {
    let mut worst = 0.0;
    play.until(10.0 / 12.0, |play| {
        if !play.is_at_a_twelfth() {
            return;
        }
        let [down, spin] = DOWN;
        let angle = match play.time() {
            time if time < down => swung(0.5 * balance(), 0.0, time),
            time => -swung(0.0, 49.0 / 52.0 * spin, time - down),
        };
        worst = worse(worst, play.off(1, leaning(angle), angle));
    });
    worst
}

/// Forty boxes side by side, their tops level; no friction.
fn seams(_: &Start) -> Scene {
    let tile = |i: usize| Body::new(Role::Fixed, [0.5 + i as f64, -0.5], [0.5, 0.5]);
    let block = Body::new(Role::Mobile, [1.25, 0.25], [0.25, 0.25]);
    let slider = Body { velocity: [10.0, 0.0], ..block };
    heavy((0..40).map(tile).chain([slider]).collect(), 0.0)
}

fn crossed(play: &mut Play) -> f64 {
    play.to(3.0);
    (play.motion(40).at[0] - 31.25).abs()
}
