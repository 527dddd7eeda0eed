//! Walls from the wrong side, bodies too fast to be seen, and a crowd that should not begin to turn.

use super::impacts::elastic;
use super::play::Play;
use super::{Case, Phases, Start};
use crate::judge::judge;
use crate::scene::{Body, Role, Scene, smash};

pub(super) fn cases() -> Vec<Case> {
    let case = |name, title, error, phases, scene, judge| Case::new([name, title, error], phases, scene, judge);
    let beyond = "how far it is from the side it came from [m]";
    vec![
        case("t9_spawned", "T9: spawned past the middle of a wall", beyond, Phases::One, spawned, beyond_wall),
        case("t9_swept", "T9: at 192 m/s into a thin wall", beyond, Phases::Mean(8), swept, beyond_wall),
        case(
            "t11",
            "T11: two fast thin bodies meet",
            "share that pass through each other",
            Phases::Mean(20),
            meeting,
            passed,
        ),
        Case {
            finest: 240,
            crowded: true,
            ..case(
                "smash",
                "Smash: 600 boxes, all momenta",
                "greater change of a momentum / what the striker brings",
                Phases::One,
                |_| smash([30, 20]),
                momenta_kept,
            )
        },
    ]
}

/// A wall of 0.1 m at 0 and a block of 1 m, no restitution.
fn walled(block: Body) -> Scene {
    let mut scene = elastic(vec![Body::new(Role::Fixed, [0.0, 0.0], [0.05, 5.0]), block]);
    scene.bodies.iter_mut().for_each(|body| body.restitution = 0.0);
    scene
}

/// It moves to the right, so it came from the left, and is past the middle already.
fn spawned(_: &Start) -> Scene {
    let block = Body::new(Role::Mobile, [0.2, 0.0], [0.5, 0.5]);
    walled(Body { velocity: [12.0, 0.0], bullet: true, ..block })
}

fn swept(start: &Start) -> Scene {
    let block = Body::new(Role::Mobile, [-20.0 + 192.0 * start.earlier, 0.0], [0.5, 0.5]);
    walled(Body { velocity: [192.0, 0.0], bullet: true, ..block })
}

fn beyond_wall(play: &mut Play) -> f64 {
    play.to(1.0);
    (play.motion(1).at[0] + 0.55).max(0.0)
}

/// Bars of 1 cm, one at 700 m/s, one at 900 m/s against it. Peers' bars are kept from turning.
fn meeting(start: &Start) -> Scene {
    let bar = |x, speed| {
        let bar = Body::new(Role::Mobile, [x, 0.0], [0.005, 0.5]);
        Body { velocity: [speed, 0.0], bullet: true, locked: true, ..bar }
    };
    elastic(vec![bar(-60.0 + 700.0 * start.earlier, 700.0), bar(60.0 - 900.0 * start.earlier, -900.0)])
}

/// They meet after 0.075 s at the latest.
fn passed(play: &mut Play) -> f64 {
    play.to(2.0 / 12.0);
    if play.motion(0).at[0] < play.motion(1).at[0] { 0.0 } else { 1.0 }
}

fn momenta_kept(play: &mut Play) -> f64 {
    let start = play.motions();
    play.to(3.0);
    judge(play.scene(), &start, &play.motions()).shape_error.unwrap_or(f64::NAN)
}
