//! Single impacts, whose outcomes are fractions.

use super::play::Play;
use super::{Case, Phases, Start};
use crate::judge::worse;
use crate::scene::{Body, Judge, Role, Scene};

pub(super) fn cases() -> Vec<Case> {
    let case = |name, title, error, scene, judge| Case::new([name, title, error], Phases::Median(8), scene, judge);
    vec![
        case(
            "c1_speed",
            "C1: a corner meets a face, the velocities",
            "greatest relative error of the velocities",
            c1,
            c1_speed,
        ),
        case("c1_place", "C1: a corner meets a face, 0.2 s after", "vertex distance / half diagonal", c1, c1_place),
        case(
            "c2_speed",
            "C2: faces meet flat, the velocities",
            "greatest relative error of the velocities",
            c2,
            c2_speed,
        ),
        case("c2_place", "C2: faces meet flat, 1/6 s after", "vertex distance / half diagonal", c2, c2_place),
        case(
            "c3",
            "C3: five corners strike with friction",
            "greatest error of the velocities [m/s, rad/s]",
            c3,
            c3_speed,
        ),
        case("c4", "C4: a corner that Newton's law gives energy", "energy gained / energy before", c4, c4_energy),
        case("c5", "C5: a square lands flat", "greatest error of the velocities [m/s, rad/s]", c5, c5_speed),
        case("c6", "C6: a blade strikes a corner", "greatest error of the velocities / theirs", c6, c6_speed),
    ]
}

/// Without gravity, no friction, restitution 1.
pub(super) fn elastic(bodies: Vec<Body>) -> Scene {
    let mut scene = Scene::new(0, Judge::Nothing);
    scene.gravity = [0.0, 0.0];
    scene.bodies = bodies;
    for body in &mut scene.bodies {
        (body.friction, body.restitution) = (0.0, 1.0);
    }
    scene
}

fn mobile(at: [f64; 2], half: [f64; 2], velocity: [f64; 2]) -> Body {
    Body { velocity, ..Body::new(Role::Mobile, at, half) }
}

/// The greatest of some errors.
pub(super) fn greatest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().map(f64::abs).fold(0.0, worse)
}

/// A of 2 kg flies at B of 3 kg; `turn` is A's angle, its corner or face is the contact.
fn two(turn: f64, start: &Start) -> Scene {
    let a = Body { angle: turn, ..mobile([-2.0 + 3.0 * start.earlier, 0.0], [1.0, 0.5], [3.0, 0.0]) };
    elastic(vec![a, mobile([0.0, 1.25], [0.5, 1.5], [0.0, 0.0])])
}

/// Relative errors of the four velocities that change: A's and B's along x, and their spins.
fn speeds(play: &Play, [v_a, w_a, v_b, w_b]: [f64; 4]) -> f64 {
    let (a, b) = (play.motion(0), play.motion(1));
    greatest([a.velocity[0] / v_a - 1.0, a.spin / w_a - 1.0, b.velocity[0] / v_b - 1.0, b.spin / w_b - 1.0])
}

/// Vertex distances a while after both left the places of contact.
fn places(play: &Play, contact: f64, turn: f64, [v_a, w_a, v_b, w_b]: [f64; 4]) -> f64 {
    // A meets B where it comes to stand at `contact`; it flew there at 3 m/s.
    let since = play.time() - (contact - play.scene().bodies[0].at[0]) / 3.0;
    let a = play.off(0, [contact + v_a * since, 0.0], turn + w_a * since);
    let b = play.off(1, [v_b * since, 1.25], w_b * since);
    worse(a, b)
}

const C1: [f64; 4] = [2901.0 / 3967.0, 4320.0 / 3967.0, 6000.0 / 3967.0, 7560.0 / 3967.0];

fn c1_turn() -> f64 {
    libm::atan2(3.0, 4.0)
}

fn c1(start: &Start) -> Scene {
    two(c1_turn(), start)
}

fn c1_speed(play: &mut Play) -> f64 {
    play.to(4.0 / 12.0);
    speeds(play, C1)
}

fn c1_place(play: &mut Play) -> f64 {
    play.to(4.0 / 12.0);
    places(play, -1.6, c1_turn(), C1)
}

const C2: [f64; 4] = [87.0 / 125.0, 216.0 / 125.0, 192.0 / 125.0, 216.0 / 125.0];

fn c2(start: &Start) -> Scene {
    two(0.0, start)
}

fn c2_speed(play: &mut Play) -> f64 {
    play.to(4.0 / 12.0);
    speeds(play, C2)
}

fn c2_place(play: &mut Play) -> f64 {
    play.to(4.0 / 12.0);
    places(play, -1.5, 0.0, C2)
}

/// Friction, velocity before, and impulses (normal, tangential) and spin after: cases where all laws of impact agree, for slip neither stops
/// nor turns.
const C3: [(f64, f64, [f64; 3]); 5] = [
    (0.0, 1.0, [75.0 / 52.0, 0.0, -135.0 / 52.0]),
    (0.2, 4.0, [375.0 / 296.0, -75.0 / 296.0, -855.0 / 296.0]),
    (0.9, 0.0, [219.0 / 100.0, 27.0 / 25.0, -27.0 / 20.0]),
    (0.4, 0.0, [375.0 / 188.0, 75.0 / 94.0, -315.0 / 188.0]),
    (0.3, -1.0, [375.0 / 206.0, 225.0 / 412.0, -405.0 / 206.0]),
];

/// A rectangle of 1 kg and half diagonal 1 that comes down a quarter of a second from now at `x`, with its corner at (−3/5, −4/5) from its centre.
fn corner(x: f64, velocity: [f64; 2], friction: f64, restitution: f64, start: &Start) -> [Body; 2] {
    let flight = 0.25 - start.earlier;
    let at = [x - velocity[0] * flight, 0.8 - velocity[1] * flight];
    let block = Body { angle: libm::atan2(7.0, 24.0), ..mobile(at, [0.8, 0.6], velocity) };
    [Body::new(Role::Fixed, [x, -0.5], [4.0, 0.5]), Body { density: 1.0 / 1.92, ..block }].map(|body| Body {
        friction,
        restitution,
        ..body
    })
}

fn c3(start: &Start) -> Scene {
    let mut scene = elastic(Vec::new());
    for (i, (friction, along, _)) in C3.iter().enumerate() {
        scene.bodies.extend(corner(10.0 * i as f64, [*along, -2.0], *friction, 0.5, start));
    }
    scene
}

fn c3_speed(play: &mut Play) -> f64 {
    play.to(4.0 / 12.0);
    greatest(C3.iter().enumerate().flat_map(|(i, (_, along, [normal, tangential, spin]))| {
        let found = play.motion(2 * i + 1);
        [found.velocity[0] - along - tangential, found.velocity[1] + 2.0 - normal, found.spin - spin]
    }))
}

fn c4(start: &Start) -> Scene {
    let mut scene = elastic(Vec::new());
    scene.bodies.extend(corner(0.0, [0.5, -1.0], 0.5, 1.0, start));
    scene
}

/// Laws of friction differ in what this block keeps, from 93 to 97 %; none may give it more than it had.
fn c4_energy(play: &mut Play) -> f64 {
    play.to(4.0 / 12.0);
    let found = play.motion(1);
    let [x, y] = found.velocity;
    // 1 kg and 1/3 kg·m²; it came with (1/4 + 1)/2.
    let energy = 0.5 * (x * x + y * y + found.spin * found.spin / 3.0);
    (energy / 0.625 - 1.0).max(0.0)
}

fn c5(start: &Start) -> Scene {
    let square = mobile([0.0, 0.7 - start.earlier], [0.5, 0.5], [0.0, -1.0]);
    elastic(vec![Body::new(Role::Fixed, [0.0, -0.5], [4.0, 0.5]), square])
}

fn c5_speed(play: &mut Play) -> f64 {
    play.to(4.0 / 12.0);
    let found = play.motion(1);
    greatest([found.velocity[0], found.velocity[1] - 1.0, found.spin])
}

/// A blade of 7 m turns at 2 rad/s and meets, level, a block's corner 1/10 m beside the block's centre, 3 m out.
fn c6(start: &Start) -> Scene {
    let aside = 0.1;
    let below = libm::sqrt(0.125 - aside * aside);
    let mut blade = Body::new(Role::Driven, [0.0, 0.0], [3.5, 0.05]);
    (blade.spin, blade.angle) = (2.0, -2.0 * (0.25 - start.earlier));
    let mut block = mobile([3.0 + aside, 0.05 + below], [0.25, 0.25], [0.0, 0.0]);
    (block.angle, block.density) = (libm::atan2(below - aside, below + aside), 4.0);
    elastic(vec![blade, block])
}

fn c6_speed(play: &mut Play) -> f64 {
    play.to(4.0 / 12.0);
    let (found, speed, spin) = (play.motion(1), 300.0 / 31.0, 720.0 / 31.0);
    greatest([found.velocity[0] / speed, found.velocity[1] / speed - 1.0, found.spin.abs() / spin - 1.0])
}
