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
pub struct Impulse {
    /// Along n.
    pub n: f64,
    /// Along t.
    pub t: f64,
}

/// Rounds of improvement at most. Each point of two equal bodies gains a digit in about two; what a great ratio of masses
/// leaves undone is still an approach, and so the next impact at the same instant.
const MOST_ROUNDS: u32 = 400;

/// An improvement below this share of the approach is rounding.
const SETTLED: f64 = 2e-17;

/// How often what is left of an approach is taken out again.
const REFINEMENTS: u32 = 3;

/// Halvings of e when the impacts would create energy.
const HALVINGS: u32 = 12;

/// Friction that drags leaves at least this share of the normal response: more, and pushing would draw the bodies together
/// (Painlevé's paradox).
const LEAST_RESPONSE: f64 = 0.05;

/// Exchanges motion at all points at once; gives the impulse at each. `None` when nothing approaches at any of them.
pub fn exchange(bodies: &mut Bodies, points: &[Point]) -> Option<Vec<Impulse>> {
    let before: Vec<Vec2> = points.iter().map(|p| relative_velocity(bodies, p.i, p.j, &p.arms)).collect();
    let comes = |bodies: &Bodies| points.iter().any(|p| approaches(bodies, p.i, p.j, &p.arms, p.n));
    if !comes(bodies) {
        return None;
    }
    let start = involved(bodies, points);
    let mut attempt = |restitution: f64| {
        restore(bodies, &start);
        let impulses = solve(bodies, points, &newton(points, &before, restitution));
        (gain(bodies, points, &before, &impulses), impulses)
    };
    let (gained, mut impulses) = attempt(1.0);
    if gained > 0.0 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if attempt(middle).0 <= 0.0 { &mut low } else { &mut high }) = middle;
        }
        impulses = attempt(low).1;
    }
    // What rounding has left of an approach would be found again at the same instant.
    for _ in 0..REFINEMENTS {
        if !comes(bodies) {
            break;
        }
        let more = solve(bodies, points, &newton(points, &before, 0.0));
        impulses.iter_mut().zip(more).for_each(|(p, more)| *p = Impulse { n: p.n + more.n, t: p.t + more.t });
    }
    Some(impulses)
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
pub(crate) fn involved(bodies: &Bodies, points: &[Point]) -> Vec<(usize, Motion)> {
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
///
/// Every round improves upon an extrapolation of the last two (Nesterov 1983), unless that led astray (O'Donoghue and Candès
/// 2015): a stack of n then takes about n rounds and not n².
pub(crate) fn solve(bodies: &mut Bodies, points: &[Point], demands: &[Demand]) -> Vec<Impulse> {
    let rows = rows(bodies, points, demands);
    let lacks = |row: &Row| {
        let u = relative_velocity(bodies, row.point.i, row.point.j, &row.point.arms);
        (u - row.point.n * row.wanted.n).norm().max(row.wanted.t.abs())
    };
    let speed = |row: &Row| {
        let of = |body: usize, r: Vec2| bodies.motion[body].v.norm() + bodies.motion[body].omega.abs() * r.norm();
        of(row.point.i, row.point.arms.r_i) + of(row.point.j, row.point.arms.r_j)
    };
    // Speeds are known to their own rounding only: to improve on that is to follow noise.
    let lacking = rows.iter().map(lacks).fold(0.0, f64::max);
    let settled = rows.iter().map(speed).fold(SETTLED * lacking, |most, speed| most.max(f64::EPSILON * speed));
    let start = involved(bodies, points);
    let mut now = Guess { impulses: vec![Impulse::default(); rows.len()], motions: start.clone() };
    let mut last = now.clone();
    let (mut momentum, mut before) = (1.0, f64::INFINITY);
    for _ in 0..MOST_ROUNDS {
        let next = 0.5 * (1.0 + (1.0_f64 + 4.0 * momentum * momentum).sqrt());
        let from = now.beyond(&last, (momentum - 1.0) / next);
        let (better, change, turned) = from.improved(bodies, &rows, &now);
        let astray = turned || change > before;
        before = change;
        momentum = if astray { 1.0 } else { next };
        last = if astray { better.clone() } else { now };
        now = better;
        if change <= settled {
            break;
        }
    }
    restore(bodies, &start);
    for (row, p) in rows.iter().zip(&now.impulses) {
        apply(bodies, row.point.i, row.point.j, &row.inverse, &row.point.arms, row.given(*p));
    }
    now.impulses
}

/// Impulses, and the motions they give.
#[derive(Clone)]
struct Guess {
    impulses: Vec<Impulse>,
    motions: Vec<(usize, Motion)>,
}

impl Guess {
    /// The guess to which another leads, and so much beyond.
    fn beyond(&self, other: &Guess, share: f64) -> Guess {
        let on = |now: f64, last: f64| now + share * (now - last);
        let impulses = self.impulses.iter().zip(&other.impulses);
        let motions = self.motions.iter().zip(&other.motions);
        Guess {
            impulses: impulses.map(|(p, q)| Impulse { n: on(p.n, q.n), t: on(p.t, q.t) }).collect(),
            motions: motions
                .map(|((body, m), (_, l))| {
                    let v = Vec2::new(on(m.v.x, l.v.x), on(m.v.y, l.v.y));
                    (*body, Motion { v, omega: on(m.omega, l.omega) })
                })
                .collect(),
        }
    }

    /// The guess with every point improved at once; by how much velocity at most; and whether that turns back on the way
    /// from `before`.
    fn improved(&self, bodies: &mut Bodies, rows: &[Row], before: &Guess) -> (Guess, f64, bool) {
        restore(bodies, &self.motions);
        let impulses: Vec<Impulse> = rows.iter().zip(&self.impulses).map(|(row, p)| improve(bodies, row, *p)).collect();
        let (mut most, mut back) = (0.0_f64, 0.0);
        for (k, row) in rows.iter().enumerate() {
            let (from, to, was) = (self.impulses[k], impulses[k], before.impulses[k]);
            let change = Impulse { n: to.n - from.n, t: to.t - from.t };
            most = most.max((row.k_nn * change.n.abs()).max(row.k_tt * change.t.abs()));
            back -= row.k_nn * change.n * (to.n - was.n) + row.k_tt * change.t * (to.t - was.t);
            apply(bodies, row.point.i, row.point.j, &row.inverse, &row.point.arms, row.given(change));
        }
        let motions = self.motions.iter().map(|(body, _)| (*body, bodies.motion[*body])).collect();
        (Guess { impulses, motions }, most, back > 0.0)
    }
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

impl Row<'_> {
    /// An impulse in world directions.
    fn given(&self, p: Impulse) -> Vec2 {
        self.point.n * p.n - perp(self.point.n) * p.t
    }
}

/// A point's better impulse, seeing the motions as they are.
fn improve(bodies: &Bodies, row: &Row, so_far: Impulse) -> Impulse {
    let Row { point: p, wanted, grip, weight, k_nn, k_tt, .. } = row;
    let t = -perp(p.n);
    let u = relative_velocity(bodies, p.i, p.j, &p.arms);
    let n = (so_far.n + weight * (wanted.n - u.dot(&p.n)) / k_nn).max(0.0);
    let along = match grip {
        Grip::Holds(0.0) => 0.0,
        Grip::Holds(friction) => (so_far.t + weight * (wanted.t - u.dot(&t)) / k_tt).clamp(-friction * n, friction * n),
        Grip::Drags(share) => share * n,
    };
    Impulse { n, t: along }
}
