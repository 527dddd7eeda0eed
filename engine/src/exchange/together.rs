//! Impacts at one instant that share a body: solved together, so that none comes first.
//!
//! At every point k of every impact the normal impulse p_k ≥ 0 lets the bodies part no more slowly than Newton's law
//! asks, u_k⁺ ≥ −e u_k⁻, and a point that pushes parts exactly so; friction opposes the slip that is left at the end,
//! |p_t| ≤ μ p_n. All points are improved at once from the same motions (Jacobi), each by no more than its share of the
//! bodies it pushes, so that a scene that is its own mirror image stays so to the last bit, whatever the order of creation.
//!
//! Should that create energy (it can, with friction, as at a single point), restitution is lowered until it does not:
//! with e = 0 it never does.

use super::impact::Surface;
use super::impulse::{Arms, Inverse, apply, relative_velocity};
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::frame::perp;

/// One point of one impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The body that the normal points out of.
    pub i: usize,
    /// The other.
    pub j: usize,
    /// From i to j.
    pub n: Vec2,
    /// From both centres to the point.
    pub arms: Arms,
    /// Restitution and friction of the pair.
    pub surface: Surface,
}

/// The impulses of a point: along n, and along t = −perp(n).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Impulse {
    n: f64,
    t: f64,
}

/// Rounds of improvement at most. Each point of two equal bodies gains a digit in about two; what a great ratio of masses
/// leaves undone is still an approach, and so the next impact at the same instant.
const MOST_ROUNDS: u32 = 4000;

/// An improvement below this share of the approach is rounding.
const SETTLED: f64 = 2e-17;

/// Halvings of e when the impacts would create energy.
const HALVINGS: u32 = 40;

/// Exchanges motion at all points at once. `false` when nothing approaches at any of them.
pub fn exchange(bodies: &mut Bodies, points: &[Point]) -> bool {
    let before: Vec<Vec2> = points.iter().map(|p| relative_velocity(bodies, p.i, p.j, &p.arms)).collect();
    if !points.iter().zip(&before).any(|(p, u)| u.dot(&p.n) < 0.0) {
        return false;
    }
    let start = involved(bodies, points);
    let mut attempt = |restitution: f64| {
        restore(bodies, &start);
        let impulses = solve(bodies, points, &before, restitution);
        gain(bodies, points, &before, &impulses)
    };
    if attempt(1.0) > 0.0 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if attempt(middle) <= 0.0 { &mut low } else { &mut high }) = middle;
        }
        attempt(low);
    }
    true
}

/// The mobile bodies among the points', once each, with their motions.
fn involved(bodies: &Bodies, points: &[Point]) -> Vec<(usize, Motion)> {
    let mut all: Vec<usize> = points.iter().flat_map(|p| [p.i, p.j]).filter(|body| bodies.is_mobile(*body)).collect();
    all.sort_unstable();
    all.dedup();
    all.into_iter().map(|body| (body, bodies.motion[body])).collect()
}

fn restore(bodies: &mut Bodies, start: &[(usize, Motion)]) {
    for (body, motion) in start {
        bodies.motion[*body] = *motion;
    }
}

/// What the impacts added to the kinetic energy beyond rounding, as seen from the bodies: Σ p·(u⁻ + u⁺)/2. What a moving
/// fixed body works is not part of it.
fn gain(bodies: &Bodies, points: &[Point], before: &[Vec2], impulses: &[Impulse]) -> f64 {
    let (mut work, mut scale) = (0.0, 0.0);
    for ((p, u), impulse) in points.iter().zip(before).zip(impulses) {
        let given = p.n * impulse.n - perp(p.n) * impulse.t;
        let both = u + relative_velocity(bodies, p.i, p.j, &p.arms);
        work += 0.5 * given.dot(&both);
        scale += given.norm() * u.norm();
    }
    work - 1e-14 * scale
}

/// Lets impulses grow at all points until each has what it asks for; restitution counts by `share`.
fn solve(bodies: &mut Bodies, points: &[Point], before: &[Vec2], share: f64) -> Vec<Impulse> {
    let touching = |body: usize| points.iter().filter(|p| p.i == body || p.j == body).count();
    let weights: Vec<f64> = points
        .iter()
        .map(|p| {
            let mobile = [p.i, p.j].into_iter().filter(|body| bodies.is_mobile(*body));
            1.0 / mobile.map(touching).max().unwrap_or(1) as f64
        })
        .collect();
    let scale = before.iter().map(|u| u.norm()).fold(0.0, f64::max);
    let mut impulses = vec![Impulse::default(); points.len()];
    for _ in 0..MOST_ROUNDS {
        let steps: Vec<(Vec2, f64)> = (0..points.len())
            .map(|k| improve(bodies, &points[k], before[k], share, weights[k], &mut impulses[k]))
            .collect();
        for (p, (step, _)) in points.iter().zip(&steps) {
            apply(bodies, p.i, p.j, &Inverse::of(bodies, p.i, p.j), &p.arms, *step);
        }
        if steps.iter().all(|(_, change)| *change <= SETTLED * scale) {
            break;
        }
    }
    impulses
}

/// What a point adds to its impulse, seeing the motions as they are; and how much velocity that is.
fn improve(bodies: &Bodies, p: &Point, before: Vec2, share: f64, weight: f64, so_far: &mut Impulse) -> (Vec2, f64) {
    let inverse = Inverse::of(bodies, p.i, p.j);
    let t = -perp(p.n);
    let u = relative_velocity(bodies, p.i, p.j, &p.arms);
    let k_nn = inverse.response(&p.arms, p.n, &p.arms, p.n);
    let approach = before.dot(&p.n).min(0.0);
    let wanted = -approach * p.surface.restitution * share;
    let n = (so_far.n + weight * (wanted - u.dot(&p.n)) / k_nn).max(0.0);
    let mut change = Impulse { n: n - so_far.n, t: 0.0 };
    if p.surface.friction > 0.0 {
        let k_tt = inverse.response(&p.arms, t, &p.arms, t);
        let most = p.surface.friction * n;
        let along = (so_far.t - weight * u.dot(&t) / k_tt).clamp(-most, most);
        change.t = along - so_far.t;
        so_far.t = along;
    }
    so_far.n = n;
    (p.n * change.n + t * change.t, k_nn * change.n.abs().max(change.t.abs()))
}
