//! What came of a scene, by the same code for every engine, from where bodies are and how they move.

use crate::engine::{Motion, World, deepest};
use crate::scene::{Judge, Role, Scene};

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Deepest overlap at the end \[m\]; `None` where a body left the finite numbers.
    pub deepest: Option<f64>,
    /// Energy at the end less that at the start, over that at the start; `None` where something is driven.
    pub energy_drift: Option<f64>,
    /// What the scene's [`Judge`] asks; `None` where there is nothing to say.
    pub shape_error: Option<f64>,
}

/// How all bodies move.
#[must_use]
pub fn motions(world: &dyn World, scene: &Scene) -> Vec<Motion> {
    (0..scene.bodies.len()).map(|body| world.motion(body)).collect()
}

/// Judges a run by how bodies moved at its start and at its end.
#[must_use]
pub fn judge(scene: &Scene, start: &[Motion], end: &[Motion]) -> Verdict {
    let finite = |number: f64| Some(number).filter(|number| number.is_finite());
    Verdict {
        deepest: deepest(scene, end).ok(),
        energy_drift: if scene.is_driven() { None } else { finite(energy_drift(scene, start, end)) },
        shape_error: shape_error(scene, start, end).and_then(finite),
    }
}

/// Kinetic and potential energy of the mobile bodies, heights counted from the lowest of them at the start \[J\].
fn energy(scene: &Scene, motions: &[Motion], lowest: f64) -> f64 {
    let of = |(i, body): (usize, &crate::scene::Body)| {
        let Motion { at, velocity: [x, y], spin, .. } = motions[i];
        let moving = 0.5 * (body.mass() * (x * x + y * y) + body.inertia() * spin * spin);
        moving - body.mass() * (scene.gravity[0] * at[0] + scene.gravity[1] * (at[1] - lowest))
    };
    scene.mobile().map(of).sum()
}

fn energy_drift(scene: &Scene, start: &[Motion], end: &[Motion]) -> f64 {
    let lowest = scene.mobile().map(|(i, _)| start[i].at[1]).fold(f64::INFINITY, f64::min);
    let [start, end] = [start, end].map(|motions| energy(scene, motions, lowest));
    (end - start) / start
}

fn shape_error(scene: &Scene, start: &[Motion], end: &[Motion]) -> Option<f64> {
    match &scene.judge {
        Judge::Stay(bodies) => {
            let away = |i: &usize| distance(start[*i].at, end[*i].at);
            Some(bodies.iter().map(away).fold(0.0, worse))
        }
        Judge::Inside { drum, half } => {
            let outside = scene.mobile().filter(|(i, _)| !is_inside(&end[*drum], *half, end[*i].at));
            Some(outside.count() as f64)
        }
        Judge::Momenta { striker } => Some(momentum_error(scene, *striker, start, end)),
        Judge::Nothing => None,
    }
}

/// The greater of two, and not a number when one is not.
#[must_use]
pub fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// How far apart two points are.
#[must_use]
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

fn is_inside(drum: &Motion, half: f64, at: [f64; 2]) -> bool {
    let (sin, cos) = libm::sincos(drum.angle);
    let [x, y] = [at[0] - drum.at[0], at[1] - drum.at[1]];
    (cos * x + sin * y).abs() < half && (cos * y - sin * x).abs() < half
}

fn momentum_error(scene: &Scene, striker: usize, start: &[Motion], end: &[Motion]) -> f64 {
    let [before, after] = [start, end].map(|motions| momenta(scene, motions));
    let body = &scene.bodies[striker];
    let scale = body.mass() * distance(start[striker].velocity, [0.0, 0.0]);
    let linear = distance([after[0], after[1]], [before[0], before[1]]) / scale;
    let angular = (after[2] - before[2]).abs() / (scale * body.rects[0].half[1]);
    worse(linear, angular)
}

/// Linear momentum, and angular momentum about the origin, of what is not fixed.
#[must_use]
pub fn momenta(scene: &Scene, motions: &[Motion]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (motion, body) in motions.iter().zip(&scene.bodies).filter(|(_, body)| body.role == Role::Mobile) {
        let [x, y] = motion.velocity.map(|v| body.mass() * v);
        let angular = motion.at[0] * y - motion.at[1] * x + body.inertia() * motion.spin;
        sum = [sum[0] + x, sum[1] + y, sum[2] + angular];
    }
    sum
}
