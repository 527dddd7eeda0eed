//! Coming to rest, and being held: what gravity or a push presses together.
//!
//! A pair that would bounce lower than [`REST_HEIGHT`] of its size lands without restitution and rests. What rests is held
//! by the accelerations that keep its points from going into each other: the same complementary problem as an impact's,
//! solved on accelerations instead of velocities, and static friction with it. It is decided where a segment begins
//! and after every impact. A scene without forces has none of this.

use super::Continuous;
use super::forecast::Pair;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::detect::manifold::{Manifold, Placed};
use crate::detect::{overlap, touch};
use crate::exchange::impact::Surface;
use crate::exchange::impulse::{self, Arms};
use crate::exchange::together;
use crate::flight::Path;
use crate::frame::perp;
use crate::plan::ExchangePlan;
use crate::world::World;

/// A bounce lower than this share of the smaller rectangle's half size is rest. No eye and no snapshot can tell; every
/// bounce above it obeys its restitution exactly.
pub(crate) const REST_HEIGHT: f64 = 1e-12;

/// A gap up to this share of the size is no gap for what rests.
const REST_GAP: f64 = 1e-9;

/// Points that part or slide faster than this do not rest \[m/s\].
pub(super) const REST_SPEED: f64 = 1e-6;

/// The points of a manifold for the common solver.
pub(super) fn points(bodies: &Bodies, manifold: &Manifold, soft: bool) -> Vec<together::Point> {
    let (i, j) = (manifold.reference, manifold.owner);
    let n = bodies.frame[i].outward(manifold.face.normal());
    let surface = Surface::of_pair(bodies.surface[i], bodies.surface[j]);
    let surface = if soft { Surface { restitution: 0.0, ..surface } } else { surface };
    let point = |p: &_| together::Point { i, j, n, arms: impulse::arms(bodies, manifold, n, p), surface };
    manifold.points().iter().map(point).collect()
}

/// Whether the impacts of an instant are to be without restitution: something presses, and the bounce would be too low.
pub(super) fn soften(state: &Continuous, world: &World, manifolds: &[Manifold]) -> bool {
    !state.pulls.is_empty()
        && manifolds.iter().all(|manifold| {
            let bodies = &world.bodies;
            let size = smallest(bodies, manifold.reference).min(smallest(bodies, manifold.owner));
            points(bodies, manifold, false).iter().all(|point| {
                let u = impulse::relative_velocity(bodies, point.i, point.j, &point.arms).dot(&point.n).min(0.0);
                let pressing = -relative_acceleration(state, bodies, point).dot(&point.n);
                let back = u * point.surface.restitution;
                pressing > 0.0 && back * back < 2.0 * pressing * REST_HEIGHT * size
            })
        })
}

/// The pairs rest from now on, and what rests is held anew.
pub(super) fn lay_down(state: &mut Continuous, world: &mut World, group: &[Pair]) {
    for pair in group {
        if let Err(at) = state.resting.binary_search(&(pair.a, pair.b)) {
            state.resting.insert(at, (pair.a, pair.b));
        }
    }
    hold(state, world);
}

/// Solves for the accelerations that hold what rests, and lets go what no longer does.
pub(super) fn hold(state: &mut Continuous, world: &mut World) {
    if state.pulls.is_empty() || world.plan.exchange != ExchangePlan::Impulse || state.resting.is_empty() {
        return;
    }
    let pairs = core::mem::take(&mut state.resting);
    let free: Vec<u32> = {
        let mut all: Vec<u32> = pairs.iter().flat_map(|(a, b)| [*a, *b]).collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    for body in &free {
        state.bring(&mut world.bodies, *body as usize);
        state.let_go(*body as usize, &world.bodies);
    }
    let mut contacts: Vec<together::Point> = Vec::new();
    for (a, b) in pairs {
        if let Some(manifold) = resting_manifold(&world.bodies, a as usize, b as usize) {
            state.resting.push((a, b));
            contacts.extend(points(&world.bodies, &manifold, true));
        }
    }
    together::exchange(&mut world.bodies, &contacts); // what rounding left of an approach
    let accelerations = held(state, &mut world.bodies, &contacts, &free);
    for (body, acceleration) in free.iter().zip(accelerations) {
        let body = *body as usize;
        if world.bodies.is_mobile(body) {
            let drag = state.pulls[body].drag;
            let motion = world.bodies.motion[body];
            state.pulls[body].a = acceleration.v + motion.v * drag.0;
            state.pulls[body].alpha = acceleration.omega + motion.omega * drag.1;
            state.changed(body);
        }
    }
}

/// The accelerations of bodies held at their contacts: an impact without restitution of accelerations.
fn held(state: &Continuous, bodies: &mut Bodies, contacts: &[together::Point], free: &[u32]) -> Vec<Motion> {
    let still: Vec<together::Point> = contacts
        .iter()
        .map(|point| {
            let u = impulse::relative_velocity(bodies, point.i, point.j, &point.arms);
            let slides = u.dot(&perp(point.n)).abs() > REST_SPEED;
            let friction = if slides { 0.0 } else { point.surface.friction };
            together::Point { surface: Surface { restitution: 0.0, friction }, ..*point }
        })
        .collect();
    // The solver sees accelerations where it looks for velocities, for as long as it takes.
    let motions: Vec<Motion> = free.iter().map(|body| bodies.motion[*body as usize]).collect();
    for body in free.iter().map(|body| *body as usize) {
        let path = Path::of(bodies, &state.pulls, body);
        let falls = Motion { v: path.acceleration(), omega: path.angular_acceleration() };
        bodies.motion[body] = if bodies.is_mobile(body) { falls } else { Motion::default() };
    }
    together::exchange(bodies, &still);
    let held = free.iter().map(|body| bodies.motion[*body as usize]).collect();
    for (body, motion) in free.iter().zip(motions) {
        bodies.motion[*body as usize] = motion;
    }
    held
}

/// The contact of a pair that still rests: at its face of least overlap, neither apart nor parting.
fn resting_manifold(bodies: &Bodies, a: usize, b: usize) -> Option<Manifold> {
    let size = smallest(bodies, a).min(smallest(bodies, b));
    let mut nearest: Option<(f64, Manifold)> = None;
    for one in Placed::all(bodies, a) {
        for two in Placed::all(bodies, b) {
            let depth = overlap::depth(one.frame, one.rect, two.frame, two.rect);
            if nearest.as_ref().is_none_or(|(best, _)| depth > *best) {
                nearest = Some((depth, touch::at_nearest_face(one, two)));
            }
        }
    }
    let (depth, manifold) = nearest?;
    let parts = points(bodies, &manifold, true)
        .iter()
        .all(|point| impulse::relative_velocity(bodies, point.i, point.j, &point.arms).dot(&point.n) > REST_SPEED);
    (depth > -REST_GAP * size && !parts).then_some(manifold)
}

/// How fast j's point accelerates away from i's.
fn relative_acceleration(state: &Continuous, bodies: &Bodies, point: &together::Point) -> Vec2 {
    let of = |body: usize, r: Vec2| {
        let path = Path::of(bodies, &state.pulls, body);
        path.acceleration() + perp(r) * path.angular_acceleration()
    };
    let Arms { r_i, r_j } = point.arms;
    of(point.j, r_j) - of(point.i, r_i)
}

fn smallest(bodies: &Bodies, body: usize) -> f64 {
    bodies.rects_of(body).iter().map(|rect| rect.half().min()).fold(f64::INFINITY, f64::min)
}

impl Continuous {
    /// What acts on a body that nothing holds.
    fn let_go(&mut self, body: usize, bodies: &Bodies) {
        if bodies.is_mobile(body) {
            self.pulls[body] = self.free[body];
        }
    }
}
