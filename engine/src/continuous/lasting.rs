//! Contacts that last: which touches are no impacts any more, and which bodies they tie together.
//!
//! Two rectangles that touch are in lasting contact when they are pressed together, by gravity, a push, drag or their own
//! turning, and would not bounce as high as [`REST_HEIGHT`] of their size. From then on forces hold them apart ([`super::hold`])
//! until they part. Elastic scenes without forces have no such contact, and pay for none.

use super::Continuous;
use super::forecast::Pair;
use super::hold::{self, After};
use super::settle::Held;
use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::detect::manifold::{Manifold, Placed};
use crate::detect::touch;
use crate::exchange::impact::Surface;
use crate::exchange::impulse::{self, Arms};
use crate::exchange::together::{self, Impulse};
use crate::flight::{Path, Pull};
use crate::frame::perp;
use crate::world::World;

/// Two rectangles: bodies a < b, and which of their rectangles.
pub(super) type Key = (u32, u32, u32, u32);

/// A bounce lower than this share of the smaller rectangle's half size is rest. No eye and no snapshot can tell; every
/// bounce above it obeys its restitution exactly.
pub(crate) const REST_HEIGHT: f64 = 1e-12;

/// A contact begins at a gap of at most this share of the size.
pub(super) const BAND: f64 = 1e-9;

/// One point of a contact, as it moves now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving {
    pub(super) point: together::Point,
    /// How fast j leaves i along n, and passes it along t \[m/s\].
    pub(super) u: Impulse,
    /// What these speeds change by because the bodies turn, whatever acts on them \[m/s²\].
    pub(super) drift: Impulse,
}

impl Moving {
    /// The points of a manifold.
    pub(super) fn all(bodies: &Bodies, manifold: &Manifold) -> Vec<Moving> {
        points(bodies, manifold).into_iter().map(|point| Moving::of(bodies, point)).collect()
    }

    /// A point with the speeds the bodies have.
    pub(super) fn of(bodies: &Bodies, point: together::Point) -> Moving {
        let together::Point { i, j, n, arms: Arms { r_i, r_j }, .. } = point;
        let u = impulse::relative_velocity(bodies, i, j, &point.arms);
        let (w_i, w_j) = (bodies.motion[i].omega, bodies.motion[j].omega);
        // Centripetal at both, and Coriolis' part as seen from the turning face.
        let bent = r_i * (w_i * w_i) - r_j * (w_j * w_j) - perp(u) * (2.0 * w_i);
        Moving { point, u: split(u, n), drift: split(bent, n) }
    }

    /// How hard the two are pressed together \[m/s²\], by what acts on them as they are held or as they would be by
    /// nothing: what stands on a held body presses on it, and what is held by one body may press on the next as well.
    fn pressing(&self, state: &Continuous, bodies: &Bodies) -> f64 {
        self.pressing_by(bodies, &state.pulls).max(self.pressing_by(bodies, &state.free))
    }

    /// How hard the two are pressed together by some pulls \[m/s²\].
    pub(super) fn pressing_by(&self, bodies: &Bodies, pulls: &[Pull]) -> f64 {
        let (of_i, of_j) = self.driven(bodies, pulls);
        -((of_j - of_i).dot(&self.point.n) + self.drift.n)
    }

    /// The accelerations that are about at the point, whichever way they act \[m/s²\].
    pub(super) fn strength(&self, state: &Continuous, bodies: &Bodies) -> f64 {
        let (of_i, of_j) = self.driven(bodies, &state.free);
        of_i.norm() + of_j.norm() + self.drift.n.abs()
    }

    /// What acts accelerates the two bodies so at the point.
    fn driven(&self, bodies: &Bodies, pulls: &[Pull]) -> (Vec2, Vec2) {
        let together::Point { i, j, arms: Arms { r_i, r_j }, .. } = self.point;
        let of = |body: usize, r: Vec2| {
            let path = Path::of(bodies, pulls, body);
            path.acceleration() + perp(r) * path.angular_acceleration()
        };
        (of(i, r_i), of(j, r_j))
    }
}

/// The points of a manifold for the common solver.
pub(super) fn points(bodies: &Bodies, manifold: &Manifold) -> Vec<together::Point> {
    let (i, j) = (manifold.reference, manifold.owner);
    let n = bodies.frame[i].outward(manifold.face.normal());
    let surface = Surface::of_pair(bodies.surface[i], bodies.surface[j]);
    let point = |p: &_| together::Point { i, j, n, arms: impulse::arms(bodies, manifold, n, p), surface };
    manifold.points().iter().map(point).collect()
}

/// The same without restitution.
pub(super) fn soft_points(bodies: &Bodies, manifold: &Manifold) -> Vec<together::Point> {
    let mut points = points(bodies, manifold);
    points.iter_mut().for_each(|point| point.surface.restitution = 0.0);
    points
}

fn split(v: Vec2, n: Vec2) -> Impulse {
    Impulse { n: v.dot(&n), t: v.dot(&-perp(n)) }
}

/// Whether points that touch are pressed together so that none of them hops as high as rest; `speed` is what it hops with.
fn would_rest(
    state: &Continuous,
    bodies: &Bodies,
    points: &[Moving],
    size: f64,
    speed: impl Fn(&Moving) -> f64,
) -> bool {
    let pressing = points.iter().map(|p| p.pressing(state, bodies)).fold(0.0, f64::max);
    let low = 2.0 * pressing * REST_HEIGHT * size;
    pressing > 0.0 && points.iter().all(|p| speed(p) * speed(p) < low)
}

/// Whether a pair that touches with a speed would certainly bounce higher than rest: by a bound on what can press it.
pub(super) fn bounces(state: &Continuous, bodies: &Bodies, pair: &Pair) -> bool {
    let (a, b) = (pair.a as usize, pair.b as usize);
    let passing = (bodies.motion[a].v - bodies.motion[b].v).norm();
    let turning = |body: usize| bodies.motion[body].omega.abs();
    let (w_a, w_b, r_a, r_b) = (turning(a), turning(b), bodies.reach(a), bodies.reach(b));
    let pulled = |body: usize, r: f64| {
        let path = Path::of(bodies, &state.pulls, body);
        path.acceleration().norm() + path.angular_acceleration().abs() * r
    };
    let bent = w_a * w_a * r_a + w_b * w_b * r_b + 2.0 * (w_a + w_b) * (passing + w_a * r_a + w_b * r_b);
    let pressing = pulled(a, r_a) + pulled(b, r_b) + bent;
    let back = pair.touch.speed * Surface::of_pair(bodies.surface[a], bodies.surface[b]).restitution;
    back * back > 2.0 * pressing * REST_HEIGHT * bodies.smallest_half(a).min(bodies.smallest_half(b))
}

/// Whether the impacts of an instant are to be without restitution: none would bounce as high as rest.
pub(super) fn soften(state: &Continuous, bodies: &Bodies, manifolds: &[Manifold]) -> bool {
    manifolds.iter().all(|manifold| {
        let size = bodies.smallest_half(manifold.reference).min(bodies.smallest_half(manifold.owner));
        let back = |p: &Moving| if p.u.n < 0.0 { p.u.n * p.point.surface.restitution } else { p.u.n };
        would_rest(state, bodies, &Moving::all(bodies, manifold), size, back)
    })
}

impl Continuous {
    /// Two rectangles have been seen to touch, or nearly so: whether their contact lasts is to be looked at.
    pub(super) fn suspect(&mut self, key: Key) {
        if self.holds_lasting && !self.bounced.contains(&key) && self.lasting.binary_search(&key).is_err() {
            self.close.push(key);
        }
    }

    /// Takes in those of the suspected contacts that last, and holds them.
    pub(super) fn take_in(&mut self, world: &mut World) {
        let mut close = core::mem::take(&mut self.close);
        close.sort_unstable();
        close.dedup();
        let mut seeds = Vec::new();
        for key in close.drain(..) {
            if self.lasting.binary_search(&key).is_err() && self.begins(world, key) {
                let at = self.lasting.partition_point(|known| *known < key);
                self.lasting.insert(at, key);
                seeds.extend([key.0, key.1]);
            }
        }
        self.close = close;
        self.hold_those(world, &seeds, After::Rest);
    }

    /// Whether a lasting contact begins at two rectangles.
    fn begins(&mut self, world: &mut World, key: Key) -> bool {
        for body in [key.0, key.1] {
            self.bring(world, body as usize);
        }
        let bodies = &world.bodies;
        let Some((manifold, size)) = standing(bodies, key, BAND) else { return false };
        would_rest(self, bodies, &Moving::all(bodies, &manifold), size, |p| p.u.n)
    }

    /// The points at which what is struck is in lasting contact, directly or through others: they share the blow.
    pub(super) fn held_with(&mut self, world: &mut World, group: &[Pair]) -> Vec<together::Point> {
        if self.lasting.is_empty() {
            return Vec::new();
        }
        let struck = |body: &u32| group.iter().any(|pair| pair.a == *body || pair.b == *body);
        let in_group = |key: &Key| group.iter().any(|pair| pair.key() == *key);
        let mobile = |body: u32| world.bodies.is_mobile(body as usize);
        let is_struck = |(a, b, ..): &Key| (mobile(*a) && struck(a)) || (mobile(*b) && struck(b));
        let clusters = clusters(&self.lasting, &world.bodies);
        let keys: Vec<Key> = clusters.into_iter().filter(|c| c.iter().any(is_struck)).flatten().collect();
        let mut points = Vec::new();
        for key in keys.into_iter().filter(|key| !in_group(key)) {
            for body in [key.0, key.1] {
                self.bring(world, body as usize);
                self.struck.push(body);
            }
            if let Some((manifold, _)) = standing(&world.bodies, key, hold::STANDING) {
                points.extend(self::points(&world.bodies, &manifold));
            }
        }
        points
    }

    /// Holds all that is in lasting contact, anew.
    pub(super) fn hold_all(&mut self, world: &mut World) {
        for cluster in clusters(&self.lasting, &world.bodies) {
            hold::hold(self, world, &cluster, After::Rest);
        }
    }

    /// Holds anew what is tied to bodies that were struck.
    pub(super) fn hold_struck(&mut self, world: &mut World) {
        let mut struck = core::mem::take(&mut self.struck);
        self.hold_those(world, &struck, After::Blow);
        struck.clear();
        self.struck = struck;
    }

    /// Holds anew what is tied to some bodies.
    pub(super) fn hold_those(&mut self, world: &mut World, seeds: &[u32], after: After) {
        if seeds.is_empty() || self.lasting.is_empty() {
            return;
        }
        let of_seeds = |cluster: &Vec<Key>| cluster.iter().any(|(a, b, ..)| seeds.contains(a) || seeds.contains(b));
        for cluster in clusters(&self.lasting, &world.bodies).into_iter().filter(of_seeds) {
            hold::hold(self, world, &cluster, after);
        }
    }

    /// At the end of a segment: what spans have left undone is put right before anyone looks.
    pub(super) fn settle_all(&mut self, world: &mut World) {
        for cluster in clusters(&self.lasting, &world.bodies) {
            hold::settle(self, world, &cluster);
        }
    }

    /// A contact has ended.
    pub(super) fn let_part(&mut self, key: Key) {
        if let Ok(at) = self.lasting.binary_search(&key) {
            self.lasting.remove(at);
        }
    }

    /// Room for what acts on each body, now that something does.
    pub(super) fn allow_pulls(&mut self, bodies: usize) {
        self.pulls.resize(bodies, Pull::NONE);
        self.free.resize(bodies, Pull::NONE);
        self.held.resize(bodies, Held::default());
    }
}

/// The contact of two rectangles that stand at each other, and the size of the smaller; `None` when they are apart by more than
/// that share of the size.
pub(super) fn standing(bodies: &Bodies, key: Key, apart: f64) -> Option<(Manifold, f64)> {
    let one = Placed::of(bodies, key.0 as usize, key.2 as usize);
    let two = Placed::of(bodies, key.1 as usize, key.3 as usize);
    let size = one.rect.half().min().min(two.rect.half().min());
    Some((touch::standing(&bodies.seams, one, two, apart * size)?, size))
}

/// The contacts, gathered by the mobile bodies that tie them together; in order.
fn clusters(lasting: &[Key], bodies: &Bodies) -> Vec<Vec<Key>> {
    if lasting.is_empty() {
        return Vec::new();
    }
    let mut root: Vec<u32> = (0..bodies.len() as u32).collect();
    let find = |root: &mut Vec<u32>, mut body: u32| {
        while root[body as usize] != body {
            root[body as usize] = root[root[body as usize] as usize];
            body = root[body as usize];
        }
        body
    };
    let mobile = |body: u32| bodies.is_mobile(body as usize);
    for (a, b, ..) in lasting.iter().filter(|(a, b, ..)| mobile(*a) && mobile(*b)) {
        let (a, b) = (find(&mut root, *a), find(&mut root, *b));
        root[a.max(b) as usize] = a.min(b);
    }
    let mut rooted: Vec<(u32, Key)> =
        lasting.iter().map(|key| (find(&mut root, if mobile(key.0) { key.0 } else { key.1 }), *key)).collect();
    rooted.sort_unstable();
    rooted.chunk_by(|a, b| a.0 == b.0).map(|chunk| chunk.iter().map(|(_, key)| *key).collect()).collect()
}
