//! Scenes that are the same but for where they are, or how large: they must fare the same.

use choque_engine::Scene;
use choque_engine::scene::Body;

use super::kit::{State, block, ground, pyramid, run, standing, states, wall};

/// The scene somewhere else.
fn moved(scene: &Scene, by: (f64, f64)) -> Scene {
    let mut scene = scene.clone();
    for body in &mut scene.bodies {
        body.at = (body.at.0 + by.0, body.at.1 + by.1);
    }
    scene
}

/// Greatest difference of any mobile body's place or angle, the second run's places counted from `by`.
fn differ(here: &[State], there: &[State], by: (f64, f64)) -> f64 {
    let pairs = here.iter().zip(there);
    pairs.fold(0.0, |worst, (a, b)| {
        let place = (b.x - by.0 - a.x).abs().max((b.z - by.1 - a.z).abs());
        f64::max(worst, place.max((b.angle - a.angle).abs()))
    })
}

/// How far the scene may fare otherwise than at home \[m, rad\].
///
/// All pairs are computed in differences, so what is left is the rounding of where bodies are told to be, 2e-9 m at 1e7 m, and what
/// impacts between many bodies make of it.
const FAR: f64 = 1e-6;

fn assert_fares_the_same_far_out(scene: &Scene, steps: u32) {
    let home = states(&run(scene, steps));
    for by in [(1e5, -8e4), (4e4, -2.5e4), (9e5, -8e5), (1e7, 1e7)] {
        let far = states(&run(&moved(scene, by), steps));
        let worst = differ(&home, &far, by);
        assert!(worst <= FAR, "at {by:?} it differs by {worst:e}");
    }
}

fn falling_pyramid(base: usize, side: f64) -> Scene {
    let mut bodies = vec![ground(4.0 * base as f64)];
    bodies.extend(pyramid("box", base, side, (0.0, 0.5), 1.25));
    standing(bodies)
}

#[test]
fn a_far_pyramid_falls_as_it_does_at_home() {
    assert_fares_the_same_far_out(&falling_pyramid(6, 1.0), 250);
}

#[test]
fn a_far_stack_falls_as_it_does_at_home() {
    let feet: [(&str, f64); 2] = [("left foot", -1.875), ("right foot", 1.875)];
    let mut bodies = vec![ground(10.0)];
    bodies.extend(feet.map(|(name, x)| block(name, (0.2, 0.25), (x, 0.15625))));
    bodies.push(block("plank", (4.0, 0.1), (0.0, 0.34375)));
    bodies.push(block("small", (0.5, 0.5), (-0.5, 0.90625)));
    bodies.push(block("great", (1.0, 1.0), (-0.5625, 1.6875)));
    assert_fares_the_same_far_out(&standing(bodies), 250);
}

#[test]
#[ignore = "1,275 boxes, 250 steps, five times"]
fn the_far_pyramid_of_1275_falls_as_it_does_at_home() {
    assert_fares_the_same_far_out(&falling_pyramid(50, 0.5), 250);
}

/// Everything a power of two smaller, gravity too: no rounding differs, so no bit may.
fn scaled(scene: &Scene, scale: f64) -> Scene {
    let mut scene = scene.clone();
    scene.settings.gravity.1 *= scale;
    for body in &mut scene.bodies {
        body.at = (body.at.0 * scale, body.at.1 * scale);
        body.scale = (scale, 1.0, scale);
        body.mass = body.mass.map(|mass| mass * scale * scale);
    }
    scene
}

/// Scaling by a power of two changes no rounding but that of a few constants which do not scale; a pile that lands makes more of it.
const SCALED: f64 = 2e-5;

fn assert_scales(scene: &Scene, steps: u32) {
    let home = states(&run(scene, steps));
    for scale in [1.0 / 1024.0, 1.0 / 16.0, 64.0] {
        let small = states(&run(&scaled(scene, scale), steps));
        let back: Vec<State> = small
            .iter()
            .map(|s| State { x: s.x / scale, z: s.z / scale, vx: s.vx / scale, vz: s.vz / scale, ..*s })
            .collect();
        let worst = differ(&home, &back, (0.0, 0.0));
        assert!(worst <= SCALED, "scaled by {scale} it differs by {worst:e}");
    }
}

#[test]
fn a_tiny_pyramid_fares_as_the_large_one() {
    assert_scales(&falling_pyramid(6, 1.0), 120);
}

#[test]
fn a_tiny_house_of_planks_fares_as_the_large_one() {
    let mut bodies: Vec<Body> = vec![wall("ground", (50.0, 2.0), (0.0, -1.0))];
    for storey in 0..4 {
        let z = 2.5 * f64::from(storey);
        for (side, x) in [("left", -2.0), ("right", 1.75)] {
            bodies.push(block(&format!("{side}{storey}"), (0.5, 2.0), (x, z + 1.125)));
        }
        bodies.push(block(&format!("plank{storey}"), (6.0, 0.25), (0.125, z + 2.375)));
    }
    assert_scales(&standing(bodies), 120);
}
