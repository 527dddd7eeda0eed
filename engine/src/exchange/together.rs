//! Several points solved together, so that none comes first: impacts at one instant, and contacts that last.
//!
//! At every point the normal impulse p_n ≥ 0 lets the bodies part no more slowly than it asks, and a point that pushes
//! parts exactly so; friction opposes the slip that is left, |p_t| ≤ μ p_n. For impacts the points ask what Newton's law
//! does, u_n⁺ ≥ −e u_n⁻; contacts that last ask the same of accelerations, with forces in place of impulses. All
//! points are improved at once from the same motions (Jacobi), each by no more than its share of the bodies it pushes, so that
//! a scene that is its own mirror image stays so to the last bit, whatever the order of creation.
//!
//! Should impacts create energy (they can, with friction, as at a single point), restitution is lowered until they do not:
//! with e = 0 they never do.

use super::impact::Surface;
use super::impulse::{Arms, Inverse, apply, approaches, relative_velocity};
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::frame::perp;

/// One point of one contact.
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

/// What a point asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Demand {
    /// Along n the two are to part at least so fast, and along t to pass each other so.
    pub(crate) wanted: Impulse,
    pub(crate) grip: Grip,
}

/// What friction does at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Grip {
    /// It holds, with up to μ times the normal impulse.
    Holds(f64),
    /// It drags: p_t is this many times p_n.
    Drags(f64),
}

/// Impulses or forces at a point, or velocities or accelerations there: along n, and along t = −perp(n).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Impulse {
    pub(crate) n: f64,
    pub(crate) t: f64,
}

/// Rounds of improvement at most. Each point of two equal bodies gains a digit in about two; what a great ratio of masses
/// leaves undone is still an approach, and so the next impact at the same instant.
const MOST_ROUNDS: u32 = 4000;

/// An improvement below this share of the approach is rounding.
const SETTLED: f64 = 2e-17;

/// How often what is left of an approach is taken out again.
const REFINEMENTS: u32 = 3;

/// Halvings of e when the impacts would create energy.
const HALVINGS: u32 = 40;

/// Friction that drags leaves at least this share of the normal response: more, and pushing would draw the bodies together
/// (Painlevé's paradox).
const LEAST_RESPONSE: f64 = 0.05;

/// Exchanges motion at all points at once. `false` when nothing approaches at any of them.
pub fn exchange(bodies: &mut Bodies, points: &[Point]) -> bool {
    let before: Vec<Vec2> = points.iter().map(|p| relative_velocity(bodies, p.i, p.j, &p.arms)).collect();
    let comes = |bodies: &Bodies| points.iter().any(|p| approaches(bodies, p.i, p.j, &p.arms, p.n));
    if !comes(bodies) {
        return false;
    }
    let start = involved(bodies, points);
    let mut attempt = |restitution: f64| {
        restore(bodies, &start);
        let impulses = solve(bodies, points, &newton(points, &before, restitution));
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
    // What rounding has left of an approach would be found again at the same instant.
    for _ in 0..REFINEMENTS {
        if !comes(bodies) {
            break;
        }
        solve(bodies, points, &newton(points, &before, 0.0));
    }
    true
}

/// Newton's law at every point: to part at e times the approach, restitution counting by `share`.
fn newton(points: &[Point], before: &[Vec2], share: f64) -> Vec<Demand> {
    let demand = |(p, u): (&Point, &Vec2)| {
        let n = -u.dot(&p.n).min(0.0) * p.surface.restitution * share;
        Demand { wanted: Impulse { n, t: 0.0 }, grip: Grip::Holds(p.surface.friction) }
    };
    points.iter().zip(before).map(demand).collect()
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

/// A point with what is the same in all rounds.
struct Row<'a> {
    point: &'a Point,
    inverse: Inverse,
    wanted: Impulse,
    grip: Grip,
    /// Its share of the bodies it pushes.
    weight: f64,
    /// u_n per normal impulse (with the friction that it drags along), u_t per tangential impulse.
    k_nn: f64,
    k_tt: f64,
}

/// Lets impulses grow at all points until each has what it asks for, and applies them.
pub(crate) fn solve(bodies: &mut Bodies, points: &[Point], demands: &[Demand]) -> Vec<Impulse> {
    let rows = rows(bodies, points, demands);
    let lacks = |row: &Row| {
        let u = relative_velocity(bodies, row.point.i, row.point.j, &row.point.arms);
        (u - row.point.n * row.wanted.n).norm().max(row.wanted.t.abs())
    };
    let scale = rows.iter().map(lacks).fold(0.0, f64::max);
    let mut impulses = vec![Impulse::default(); rows.len()];
    let mut steps: Vec<(Vec2, f64)> = Vec::with_capacity(rows.len());
    for _ in 0..MOST_ROUNDS {
        steps.clear();
        steps.extend(rows.iter().zip(&mut impulses).map(|(row, so_far)| improve(bodies, row, so_far)));
        for (row, (step, _)) in rows.iter().zip(&steps) {
            apply(bodies, row.point.i, row.point.j, &row.inverse, &row.point.arms, *step);
        }
        if steps.iter().all(|(_, change)| *change <= SETTLED * scale) {
            break;
        }
    }
    impulses
}

fn rows<'a>(bodies: &Bodies, points: &'a [Point], demands: &[Demand]) -> Vec<Row<'a>> {
    let touching = |body: usize| points.iter().filter(|p| p.i == body || p.j == body).count();
    let row = |(point, demand): (&'a Point, &Demand)| {
        let Point { i, j, n, arms, .. } = point;
        let (inverse, t) = (Inverse::of(bodies, *i, *j), -perp(*n));
        let mobile = [*i, *j].into_iter().filter(|body| bodies.is_mobile(*body));
        let (k_nn, k_nt) = (inverse.response(arms, *n, arms, *n), inverse.response(arms, *n, arms, t));
        let (grip, k_nn) = match demand.grip {
            Grip::Drags(share) => {
                let bound = (LEAST_RESPONSE - 1.0) * k_nn;
                let share = if share * k_nt < bound { bound / k_nt } else { share };
                (Grip::Drags(share), k_nn + share * k_nt)
            }
            Grip::Holds(_) => (demand.grip, k_nn),
        };
        Row {
            point,
            inverse,
            wanted: demand.wanted,
            grip,
            weight: 1.0 / mobile.map(touching).max().unwrap_or(1) as f64,
            k_nn,
            k_tt: inverse.response(arms, t, arms, t),
        }
    };
    points.iter().zip(demands).map(row).collect()
}

/// What a point adds to its impulse, seeing the motions as they are; and how much velocity that is.
fn improve(bodies: &Bodies, row: &Row, so_far: &mut Impulse) -> (Vec2, f64) {
    let Row { point: p, wanted, grip, weight, k_nn, k_tt, .. } = row;
    let t = -perp(p.n);
    let u = relative_velocity(bodies, p.i, p.j, &p.arms);
    let n = (so_far.n + weight * (wanted.n - u.dot(&p.n)) / k_nn).max(0.0);
    let along = match grip {
        Grip::Holds(0.0) => 0.0,
        Grip::Holds(friction) => (so_far.t + weight * (wanted.t - u.dot(&t)) / k_tt).clamp(-friction * n, friction * n),
        Grip::Drags(share) => share * n,
    };
    let change = Impulse { n: n - so_far.n, t: along - so_far.t };
    *so_far = Impulse { n, t: along };
    (p.n * change.n + t * change.t, (k_nn * change.n.abs()).max(k_tt * change.t.abs()))
}
