//! Holding what is in lasting contact: constant forces over a span of time, such that nothing goes into anything.
//!
//! Every point of contact asks for an acceleration that leads it to its face and to rest there, and forces f push it no more than
//! that takes:
//!
//! ```text
//! a_n + drift ≥ ask,   f ≥ 0,   f > 0 only where it is just so;       g(T) ≥ 0,   g the gap, T the span
//! ```
//!
//! linear in the forces f, so that it is the problem that simultaneous impacts pose, for accelerations in place of
//! velocities ([`together`]). What the straight formula leaves out, because bodies turn, is made up for by shooting: g(T) is
//! computed from the flight, and where it comes out negative the point asks for that much more. The forces act where the
//! contact is in the middle of the span (the midpoint rule), which keeps angular momentum to rounding. Between a contact held so
//! and the face there opens a gap of at most [`HOP`]; where it would be more the span is halved. Friction holds within its cone
//! or drags against the slip, and a span ends where slip does. At its end the little approach that is left is taken out, without
//! restitution, and energy that was made ([`settle`]). So energy never grows, flat rest is exact, and the search for the next impact
//! watches all the while.

use super::Continuous;
use super::forecast::What;
use super::lasting::{BAND, Key, Moving, REST_HEIGHT, standing};
use super::settle;
use crate::area::{Rect, Vec2};
use crate::bodies::{Bodies, Motion};
use crate::detect::Face;
use crate::exchange::impact::Surface;
use crate::exchange::impulse::Arms;
use crate::exchange::together::{self, Demand, Grip, Impulse};
use crate::flight::{Path, turned};
use crate::impact_time::TOUCHING;
use crate::world::World;

/// A gap that opens under a held contact, as a share of the smaller rectangle's half size.
const HOP: f64 = 1e-7;

/// A gap up to this share of the size, which a hop can be met in, is none for a contact that lasts already.
pub(super) const STANDING: f64 = 4.0 * HOP;

/// A contact that would close again with a speed before the end of its span is to be off by this share of the size by then: so
/// that what is left of it is taken out there and does not strike.
const MARGIN: f64 = 0.1 * BAND;

/// Halvings of a span at most.
const SHORTENINGS: u32 = 12;

/// Shots at the end of a span: each leaves about the square of what the last one did.
const SHOTS: u32 = 8;

/// Where in a span a gap is looked at for having closed at once [share of the span].
const EARLY: f64 = 0.25;

/// A point at its face sinks when it accelerates inwards by more than this share of what acts there.
const SINKING: f64 = 1e-13;

/// Arms that differ by less are the same [share of their length].
const SAME: f64 = 1e-15;

/// Slip that friction would end within this share of the span has ended.
const ENDED: f64 = 1e-5;

/// What came before contacts are held anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum After {
    /// A span in which they were held: what approach there is comes from that.
    Rest,
    /// A blow, or a command: what approaches will be an impact.
    Blow,
}

/// A point of contact that is to be held.
struct Support {
    moving: Moving,
    /// Where and along which normal its force acts, over the span.
    acts: together::Point,
    /// The point of the owner, in its frame, and the face of the reference.
    vertex: Vec2,
    face: Face,
    rect: Rect,
    /// The gap now, and half the size of the smaller rectangle \[m\].
    gap: f64,
    size: f64,
    /// A gap this small is none \[m\].
    tolerance: f64,
    /// The normal acceleration it asks for \[m/s²\].
    ask: f64,
    /// Whether slip counts as ended.
    sticks: bool,
    /// The force that came out \[N\], and the acceleration there \[m/s²\].
    force: Impulse,
    acceleration: Impulse,
}

impl Support {
    /// Whether nothing that could be told is between it and its face.
    fn is_at_face(&self) -> bool {
        self.gap <= 4.0 * self.tolerance
    }

    /// Whether it is off its face and on its way there: it will strike, and needs no force before.
    fn comes(&self) -> bool {
        self.gap > HOP * self.size && self.moving.u.n < 0.0
    }

    /// How much more acceleration it takes for it not to be too near early in a span, nor at its end \[m/s²\].
    fn lacks(&self, state: &Continuous, bodies: &Bodies, span: f64) -> f64 {
        let at = |share: f64| self.gap_after(state, bodies, share * span);
        let (early, before, gap) = (at(EARLY), at(0.75), at(1.0));
        let closes = self.is_at_face() && before > gap + 0.01 * MARGIN * self.size && self.force.n > 0.0;
        let least = if closes { MARGIN * self.size } else { 0.0 };
        let lack = |gap: f64, least: f64, time: f64| {
            let missing = if gap < 0.5 * least - self.tolerance { least.max(2.0 * self.tolerance) - gap } else { 0.0 };
            2.0 * missing / (time * time)
        };
        let sinks = if self.is_at_face() { self.moving.pressing_by(bodies, &state.pulls) } else { 0.0 };
        lack(gap, least, span)
            .max(lack(early - self.gap.min(0.0), 0.0, EARLY * span))
            .max(if sinks > SINKING * self.moving.strength(state, bodies) { sinks } else { 0.0 })
    }

    /// Lets the force act where the contact is in the middle of the span, along the normal there, its arms counted from where the
    /// bodies' centres are on average: then what one body gains of angular momentum the other loses, to rounding. Gives by how
    /// much that differs from before, as a share of the lengths involved.
    fn act_midway(&mut self, state: &Continuous, bodies: &Bodies, span: f64) -> f64 {
        let together::Point { i, j, arms: before, .. } = self.acts;
        let half = |body: usize| Path::of(bodies, &state.pulls, body).change(0.5 * span);
        let (half_i, half_j) = (half(i), half(j));
        let turned = |body: usize, turn: f64| turned(&bodies.frame[body], Vec2::zeros(), turn);
        let vertex = half_j.shift + turned(j, half_j.turn).outward(self.vertex);
        // The mean of a quadratic is a third of the way from the mean of its ends to its middle, twice (Simpson).
        let mean =
            |body: usize, middle: Vec2| (Path::of(bodies, &state.pulls, body).change(span).shift + middle * 4.0) / 6.0;
        let d = bodies.frame[j].o - bodies.frame[i].o;
        let arms = Arms { r_i: (d + vertex) - mean(i, half_i.shift), r_j: vertex - mean(j, half_j.shift) };
        let n = turned(i, half_i.turn).outward(self.face.normal());
        let moved = (arms.r_i - before.r_i).norm() + (arms.r_j - before.r_j).norm();
        self.acts = together::Point { n, arms, ..self.acts };
        moved / (arms.r_i.norm() + arms.r_j.norm())
    }

    /// The gap after some time, as the bodies will fly \[m\].
    fn gap_after(&self, state: &Continuous, bodies: &Bodies, time: f64) -> f64 {
        let (i, j) = (self.moving.point.i, self.moving.point.j);
        let after = |body: usize| Path::of(bodies, &state.pulls, body).change(time);
        let (one, two) = (after(i), after(j));
        let frame_i = turned(&bodies.frame[i], Vec2::zeros(), one.turn);
        let frame_j = turned(&bodies.frame[j], Vec2::zeros(), two.turn);
        let d = (bodies.frame[j].o - bodies.frame[i].o) + (two.shift - one.shift);
        -self.face.depth_of(&self.rect, frame_i.inward(d + frame_j.outward(self.vertex)))
    }

    /// How far it is off the face at most over a span, beyond what it is now \[m\]: a cubic that begins and ends at nothing is
    /// greatest at two thirds, any other at its end.
    fn hop(&self, state: &Continuous, bodies: &Bodies, span: f64) -> f64 {
        let at = |share: f64| self.gap_after(state, bodies, share * span);
        at(2.0 / 3.0).max(at(1.0)) - self.gap.max(0.0)
    }

    /// The acceleration that leads it to its face in two spans, and to rest there: g and u T turn into g/2 + u T/4 and −g − u T/2, and
    /// those into nothing.
    fn approach_rest(&self, span: f64) -> f64 {
        -(1.5 * self.moving.u.n * span + self.gap.max(0.0)) / (span * span)
    }

    /// What it asks of the forces over a span: the acceleration it wants along the normal, and that slip cease.
    fn demand(&self, span: f64) -> Demand {
        let Moving { point, u, drift } = self.moving;
        let friction = point.surface.friction;
        let grip = match u.t {
            t if self.sticks || friction == 0.0 || t == 0.0 => Grip::Holds(friction),
            t => Grip::Drags(if t > 0.0 { -friction } else { friction }),
        };
        Demand { wanted: Impulse { n: self.ask - drift.n, t: -u.t / span - drift.t }, grip }
    }

    /// When the slip that friction drags against will have ended \[s\].
    fn slip_end(&self) -> Option<f64> {
        let (u, a) = (self.moving.u.t, self.acceleration.t);
        let drags = !self.sticks && self.moving.point.surface.friction > 0.0 && self.force.n > 0.0;
        (drags && u * a < 0.0).then(|| -u / a)
    }
}

/// Holds the contacts of a cluster from now on.
pub(super) fn hold(state: &mut Continuous, world: &mut World, cluster: &[Key], after: After) {
    let bodies_of = bodies_of(cluster);
    for body in &bodies_of {
        state.bring(world, *body);
    }
    let movers: Vec<usize> = bodies_of.iter().copied().filter(|body| world.bodies.is_mobile(*body)).collect();
    state.allow_pulls(world.bodies.len());
    world.settle(&bodies_of, |bodies| settle::settle(state, bodies, &bodies_of));
    for body in &movers {
        state.pulls[*body] = state.free[*body];
    }
    let mut supports = supports(state, world, cluster, after);
    let left = state.length - state.now;
    let span = if supports.is_empty() || left <= 0.0 {
        left
    } else {
        plan(state, &mut world.bodies, &mut supports, &movers, left)
    };
    state.keep_forces(world, &movers, supports.iter().map(|support| (support.acts, support.force)));
    for body in &movers {
        state.changed(*body);
    }
    if let (true, Some(first)) = (span < left, movers.first()) {
        state.forecast.expect(state.now + span, 0.0, What::Renew(*first as u32));
    }
}

/// Puts right at the end of a span what its forces have left undone: energy that they made, approach at the points.
pub(super) fn settle(state: &mut Continuous, world: &mut World, cluster: &[Key]) {
    let bodies_of = bodies_of(cluster);
    world.settle(&bodies_of, |bodies| settle::settle(state, bodies, &bodies_of));
    supports(state, world, cluster, After::Rest);
}

fn bodies_of(cluster: &[Key]) -> Vec<usize> {
    let mut bodies: Vec<usize> = cluster.iter().flat_map(|key| [key.0 as usize, key.1 as usize]).collect();
    bodies.sort_unstable();
    bodies.dedup();
    bodies
}

/// The points of those contacts of a cluster that still touch. What approaches after a span is stopped there; what approaches
/// after a blow is left to strike.
fn supports(state: &mut Continuous, world: &mut World, cluster: &[Key], after: After) -> Vec<Support> {
    let mut supports: Vec<Support> = Vec::with_capacity(2 * cluster.len());
    for key in cluster {
        let bodies = &world.bodies;
        let Some((manifold, size)) = standing(bodies, *key, STANDING) else {
            state.let_part(*key);
            continue;
        };
        let all = Moving::all(bodies, &manifold);
        let moves = |m: &Moving| m.u.n * m.u.n > 2.0 * REST_HEIGHT * size * m.strength(state, bodies);
        if after == After::Blow && all.iter().any(moves) {
            state.let_part(*key);
            continue;
        }
        let of_first = manifold.reference == key.0 as usize;
        let rect = bodies.rects_of(manifold.reference)[if of_first { key.2 } else { key.3 } as usize];
        let d = bodies.frame[manifold.owner].o - bodies.frame[manifold.reference].o;
        supports.extend(all.into_iter().zip(manifold.points()).map(|(moving, point)| Support {
            moving,
            acts: moving.point,
            vertex: point.vertex,
            face: manifold.face,
            rect,
            gap: -point.depth,
            size,
            tolerance: TOUCHING * (d.abs().max() + moving.point.arms.r_i.norm() + moving.point.arms.r_j.norm()),
            ask: 0.0,
            sticks: false,
            force: Impulse::default(),
            acceleration: Impulse::default(),
        }));
    }
    supports.retain(|s| !s.comes());
    if after == After::Rest {
        stop(world, &mut supports);
    }
    supports
}

/// Takes out what approach is left at the points that are at their face, without restitution or friction; one that is off it
/// by a hair is slowed down on its way.
fn stop(world: &mut World, supports: &mut [Support]) {
    let surface = Surface { restitution: 0.0, friction: 0.0 };
    let there = supports.iter().filter(|s| s.is_at_face());
    let points: Vec<together::Point> = there.map(|s| together::Point { surface, ..s.moving.point }).collect();
    world.act_together(&points, 0);
    for support in supports {
        support.moving = Moving::of(&world.bodies, support.moving.point);
    }
}

/// Finds forces, and the span of time for which they are good, at most what is left; sets what acts on the movers.
fn plan(state: &mut Continuous, bodies: &mut Bodies, supports: &mut [Support], movers: &[usize], left: f64) -> f64 {
    let mut span = left;
    for _ in 0..SHORTENINGS {
        for support in supports.iter_mut() {
            support.ask = support.approach_rest(span);
        }
        push(state, bodies, supports, movers, span);
        if supports.iter().any(|s| s.slip_end().is_some_and(|end| end < ENDED * left)) {
            supports.iter_mut().for_each(|s| s.sticks |= s.slip_end().is_some_and(|end| end < ENDED * left));
            continue;
        }
        let ends = supports.iter().filter_map(Support::slip_end).fold(f64::INFINITY, f64::min);
        if ends < span * (1.0 - ENDED) {
            span = ends;
            continue;
        }
        for _ in 0..SHOTS {
            let moved = supports.iter_mut().map(|s| s.act_midway(state, bodies, span)).fold(0.0, f64::max);
            if !shoot(state, bodies, supports, span) && moved <= SAME {
                break;
            }
            push(state, bodies, supports, movers, span);
        }
        let off = |s: &Support| s.force.n > 0.0 && s.hop(state, bodies, span) > HOP * s.size;
        if !supports.iter().any(off) {
            break;
        }
        span *= 0.5;
    }
    span
}

/// Lets points that would go in by the end of the span ask for more; whether there was one.
fn shoot(state: &Continuous, bodies: &Bodies, supports: &mut [Support], span: f64) -> bool {
    let mut any = false;
    for support in supports {
        let lacks = support.lacks(state, bodies, span);
        support.ask += lacks;
        any |= lacks > 0.0;
    }
    any
}

/// Solves for the forces that give every point what it asks for, and lets them act.
fn push(state: &mut Continuous, bodies: &mut Bodies, supports: &mut [Support], movers: &[usize], span: f64) {
    let points: Vec<together::Point> = supports.iter().map(|s| s.acts).collect();
    let demands: Vec<Demand> = supports.iter().map(|s| s.demand(span)).collect();
    // The solver sees accelerations where it looks for velocities, for as long as it takes.
    let mut involved: Vec<usize> = points.iter().flat_map(|p| [p.i, p.j]).chain(movers.iter().copied()).collect();
    involved.sort_unstable();
    involved.dedup();
    let motions: Vec<Motion> = involved.iter().map(|body| bodies.motion[*body]).collect();
    for &body in &involved {
        let path = Path::of(bodies, &state.free, body);
        let falls = Motion { v: path.acceleration(), omega: path.angular_acceleration() };
        bodies.motion[body] = if bodies.is_mobile(body) { falls } else { Motion::default() };
    }
    let forces = together::solve(bodies, &points, &demands);
    for (support, force) in supports.iter_mut().zip(forces) {
        let (now, drift) = (Moving::of(bodies, support.acts).u, support.moving.drift);
        support.force = force;
        support.acceleration = Impulse { n: now.n + drift.n, t: now.t + drift.t };
    }
    let accelerations: Vec<Motion> = movers.iter().map(|body| bodies.motion[*body]).collect();
    for (body, motion) in involved.into_iter().zip(motions) {
        bodies.motion[body] = motion;
    }
    for (&body, acceleration) in movers.iter().zip(accelerations) {
        let (drag, motion) = (state.free[body].drag, bodies.motion[body]);
        state.pulls[body].a = acceleration.v + motion.v * drag.0;
        state.pulls[body].alpha = acceleration.omega + motion.omega * drag.1;
    }
}
