//! Impact after impact: what is wrong once is wrong from then on.

use super::impacts::{elastic, greatest};
use super::play::Play;
use super::{Case, Phases, Start};
use crate::judge::worse;
use crate::scene::{Body, Role, Scene};

pub(super) fn cases() -> Vec<Case> {
    let case = |name, title, error, scene, judge| Case::new([name, title, error], Phases::One, scene, judge);
    let counted = "greatest of the final speeds' errors [m/s] and the overlap on the way [m]";
    vec![
        case("e1_k1", "E1: blocks that count pi, 31 hits", counted, |_| galperin(1), |play| counts(play, 1)),
        case("e1_k2", "E1: blocks that count pi, 314 hits", counted, |_| galperin(2), |play| counts(play, 2)),
        case("e1_k3", "E1: blocks that count pi, 3141 hits", counted, |_| galperin(3), |play| counts(play, 3)),
        Case {
            phases: Phases::Median(4),
            ..case(
                "e3",
                "E3: a square bounces, e = 0.8, three flights",
                "greatest height error / half diagonal",
                drop,
                flights,
            )
        },
        case("e4", "E4: eight rods in a tunnel after 10 s", "greatest error of a place [m]", rods, rods_off),
        case("e9_5", "E9: a turning billiard after 5 bounces", "vertex distance / half diagonal", billiard, |play| {
            turned(play, 0)
        }),
        case("e9_10", "E9: a turning billiard after 10 bounces", "vertex distance / half diagonal", billiard, |play| {
            turned(play, 1)
        }),
    ]
}

/// Speeds at the end of the big block and of the small one, and twelfths of a second until all hits are over, for a mass ratio of 100^k.
const GALPERIN: [[f64; 3]; 4] = [
    [1.0, 0.0, 42.0],
    [0.9988575955631185, 0.47786020820588593, 54.0],
    [0.9999985595629777, 0.16973131619503998, 102.0],
    [0.999999917460531, 0.40629906632325763, 50.0],
];

/// A block 1 m from a wall, another 2 m and its width away that comes at 1 m/s (Galperin 2003). Peers' blocks are kept from turning.
fn galperin(k: usize) -> Scene {
    let wall = Body::new(Role::Fixed, [-0.5, 0.0], [0.5, 4.5]);
    let small = Body { bullet: true, locked: true, ..Body::new(Role::Mobile, [1.5, 0.0], [0.5, 0.5]) };
    let mut big = Body { at: [3.5, 0.0], velocity: [-1.0, 0.0], ..small.clone() };
    big.density = (0..k).fold(1.0, |mass, _| 100.0 * mass);
    elastic(vec![wall, small, big])
}

fn counts(play: &mut Play, k: usize) -> f64 {
    let [big, small, twelfths] = GALPERIN[k];
    let mut inside = 0.0;
    play.until(twelfths / 12.0, |play| {
        let (a, b) = (play.motion(1).at[0], play.motion(2).at[0]);
        inside = worse(inside, (0.5 - a).max(1.0 - (b - a)).max(0.0));
    });
    greatest([play.motion(2).velocity[0] - big, play.motion(1).velocity[0] - small, inside])
}

const GRAVITY: f64 = 9.81;

/// A unit square dropped from 1 m.
fn drop(start: &Start) -> Scene {
    let mut scene =
        elastic(vec![Body::new(Role::Fixed, [0.0, -0.5], [5.0, 0.5]), Body::new(Role::Mobile, [0.0, 1.5], [0.5, 0.5])]);
    scene.gravity = [0.0, -GRAVITY];
    scene.bodies.iter_mut().for_each(|body| body.restitution = 0.8);
    // As if it had fallen for a while.
    let square = &mut scene.bodies[1];
    square.velocity[1] = -GRAVITY * start.earlier;
    square.at[1] -= 0.5 * GRAVITY * start.earlier * start.earlier;
    scene
}

/// How high a square bounces that many seconds after its drop.
fn bounced(mut time: f64) -> f64 {
    let fall = libm::sqrt(2.0 / GRAVITY);
    if time < fall {
        return 1.0 - 0.5 * GRAVITY * time * time;
    }
    time -= fall;
    let mut speed = 0.8 * GRAVITY * fall;
    while time > 2.0 * speed / GRAVITY {
        time -= 2.0 * speed / GRAVITY;
        speed *= 0.8;
    }
    time * (speed - 0.5 * GRAVITY * time)
}

fn flights(play: &mut Play) -> f64 {
    let earlier = -play.scene().bodies[1].velocity[1] / GRAVITY;
    let mut worst = 0.0;
    play.until(1.5, |play| {
        if play.is_at_a_twelfth() {
            worst = worse(worst, play.off(1, [0.0, 0.5 + bounced(play.time() + earlier)], 0.0));
        }
    });
    worst
}

/// Equal rods hand their velocities through (Tonks 1936). Peers' rods are kept from turning.
fn rods(_: &Start) -> Scene {
    let wall = |x| Body::new(Role::Fixed, [x, 0.0], [0.5, 4.5]);
    let rod = |(i, velocity): (usize, f64)| {
        let rod = Body::new(Role::Mobile, [0.75 + 1.5 * i as f64, 0.0], [0.25, 0.25]);
        Body { velocity: [velocity, 0.0], locked: true, ..rod }
    };
    let sevenths = [-35.0, 36.0, -26.0, 7.0, -13.0, -12.0, 7.0, -27.0].map(|v| v / 7.0);
    elastic([wall(-0.5), wall(12.5)].into_iter().chain(sevenths.into_iter().enumerate().map(rod)).collect())
}

fn rods_off(play: &mut Play) -> f64 {
    play.to(10.0);
    let places = [21.0, 47.0, 77.0, 103.0, 133.0, 151.0, 213.0, 243.0].map(|x| x / 28.0);
    greatest(places.iter().enumerate().map(|(i, x)| play.motion(2 + i).at[0] - x))
}

/// A rectangle that turns in a box of 4 m × 3 m.
fn billiard(_: &Start) -> Scene {
    let mut rectangle = Body::new(Role::Mobile, [0.0, 0.0], [0.5, 0.25]);
    (rectangle.velocity, rectangle.spin, rectangle.density) = ([1.0, 0.7], 1.3, 2.0);
    let wall = |at, half| Body::new(Role::Fixed, at, half);
    elastic(vec![
        wall([2.5, 0.0], [0.5, 4.5]),
        wall([-2.5, 0.0], [0.5, 4.5]),
        wall([0.0, 2.0], [4.5, 0.5]),
        wall([0.0, -2.0], [4.5, 0.5]),
        rectangle,
    ])
}

/// What the rectangle does from a bounce on, computed to 60 digits and rounded to what an f64 holds.
struct Bounce {
    /// Twelfths of a second when it is looked at, before the next bounce.
    seen: f64,
    time: f64,
    at: [f64; 2],
    angle: f64,
    velocity: [f64; 2],
    spin: f64,
}

const BOUNCES: [Bounce; 2] = [
    Bounce {
        seen: 70.0,
        time: 5.709850010633326,
        at: [-1.6333250122222043, 0.6564225050506042],
        angle: -4.964152972874517,
        velocity: [0.2574369209305453, 0.8331980634949853],
        spin: 2.9484350594523976,
    },
    Bounce {
        seen: 109.0,
        time: 9.069961111209965,
        at: [1.4887627762925704, -0.8329288270813354],
        angle: -3.0943994582668775,
        velocity: [-0.0663143700264981, 0.7953829582798266],
        spin: -3.1430075084952938,
    },
];

fn turned(play: &mut Play, bounce: usize) -> f64 {
    let Bounce { seen, time, at: [x, y], angle, velocity: [v_x, v_y], spin } = BOUNCES[bounce];
    play.to(seen / 12.0);
    let since = play.time() - time;
    play.off(4, [x + v_x * since, y + v_y * since], angle + spin * since)
}
