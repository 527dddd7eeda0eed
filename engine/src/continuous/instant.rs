//! One instant: the impacts that happen at it, exchanged.
//!
//! Impacts that share a mobile body act together ([`together`]), unless the order makes no difference ([`in_turn`]); those that they cause come after them, in turn. So
//! bodies that touch at rest hand a blow on one after the other (the first of a row of three equal blocks in touch stops,
//! the last flies off, as with gaps), while two blows that meet in one body at once are one impact.

use super::forecast::Pair;
use super::{Continuous, lasting};
use crate::area::Rect;
use crate::bodies::{Bodies, Motion};
use crate::detect::manifold::{Manifold, Placed, Point};
use crate::detect::{Contact, touch};
use crate::exchange::document::{self, Losses};
use crate::exchange::{PairKind, impulse, together};
use crate::ledger::Handing;
use crate::plan::ExchangePlan;
use crate::relocate::{self, moved, separate};
use crate::scene::Detection;
use crate::step::Hit;
use crate::world::{BodyId, World};

impl Continuous {
    /// Exchanges at every touch of an instant; the hits are told in the order of their pairs.
    pub(super) fn treat_instant(&mut self, world: &mut World, touches: &mut [Pair]) {
        for pair in touches.iter() {
            self.bring(world, pair.a as usize);
            self.bring(world, pair.b as usize);
        }
        self.keep_time(world);
        self.bounced.clear();
        let mut rest_of = touches;
        while !rest_of.is_empty() {
            let connected = bring_together(&world.bodies, rest_of);
            let (group, others) = rest_of.split_at_mut(connected);
            self.treat_group(world, group);
            rest_of = others;
        }
        self.hold_struck(world);
        self.untold.reverse();
    }

    /// Exchanges at touches that share bodies.
    fn treat_group(&mut self, world: &mut World, group: &[Pair]) {
        match world.plan.exchange {
            ExchangePlan::Document { epsilon, losses } => self.hand_over(world, group, epsilon, losses),
            ExchangePlan::Impulse => self.strike(world, group),
        }
        for pair in group {
            for body in [pair.a as usize, pair.b as usize] {
                if world.bodies.is_mobile(body) {
                    self.changed(body);
                    self.struck.push(body as u32);
                }
                if !world.moves_finitely(body) {
                    world.report_fault(body);
                }
            }
            self.watch_for_jams(world, pair);
        }
    }

    /// The document's exchange: every pair from the motions before the instant, what each changes is added up; the
    /// relocation is by ε alone (reading R11). A pair that goes on approaching is stuck from then on.
    fn hand_over(&mut self, world: &mut World, group: &[Pair], epsilon: f64, losses: Losses) {
        let before: Vec<Motion> =
            group.iter().flat_map(|p| [p.a, p.b]).map(|b| world.bodies.motion[b as usize]).collect();
        let mut sums: Vec<(usize, Motion, Motion)> = Vec::new();
        let mut placed_all = Vec::with_capacity(group.len());
        let mut handings = Vec::new();
        for (k, pair) in group.iter().enumerate() {
            let bodies = &mut world.bodies;
            let contact = contact_of(bodies, pair, world.plan.detection);
            let moved = moved(bodies, &contact);
            let stood = bodies.frame[moved].o;
            let placed = separate(bodies, &contact, epsilon);
            world.work.relocations += 1;
            for (which, body) in [pair.a as usize, pair.b as usize].into_iter().enumerate() {
                bodies.motion[body] = before[2 * k + which];
            }
            if world.ledger.is_some() {
                handings.push(Handing::new(bodies, &placed, (moved, stood, contact.depth + epsilon), losses));
            }
            let kind = document::exchange(bodies, &placed, losses);
            for (which, body) in [pair.a as usize, pair.b as usize].into_iter().enumerate() {
                let (was, is) = (before[2 * k + which], bodies.motion[body]);
                match sums.iter_mut().find(|(known, ..)| *known == body) {
                    Some((_, _, sum)) => {
                        *sum = Motion { v: sum.v + (is.v - was.v), omega: sum.omega + (is.omega - was.omega) };
                    }
                    None => sums.push((body, was, is)),
                }
            }
            if let Some(kind) = kind {
                self.tell(world, pair, &placed, kind);
            }
            placed_all.push(placed);
        }
        for (body, _, motion) in sums {
            world.bodies.motion[body] = motion;
        }
        if let Some(ledger) = &mut world.ledger {
            ledger.book_handings(&world.bodies, &handings);
        }
        for (pair, placed) in group.iter().zip(&placed_all) {
            if approaches(&world.bodies, placed) {
                self.hold_stuck((pair.a, pair.b));
            }
        }
    }

    /// Impulses: one impact by the law of its one or two points, several together.
    fn strike(&mut self, world: &mut World, group: &[Pair]) {
        let manifolds: Vec<Manifold> =
            group.iter().map(|pair| manifold_of(&world.bodies, pair, world.plan.detection)).collect();
        let bounces = group.iter().any(|pair| lasting::bounces(self, &world.bodies, pair));
        let softened = !bounces && lasting::soften(self, &world.bodies, &manifolds);
        if let ([pair], true) = (group, bounces) {
            self.bounced.push(pair.key());
        }
        let held = self.held_with(world, group);
        let acted = match (&manifolds[..], softened) {
            ([manifold], false) if held.is_empty() => world.act(manifold).is_some(),
            _ => {
                if !softened
                    && held.is_empty()
                    && let Some(hits) = in_turn(&mut world.bodies, &manifolds)
                {
                    for k in hits {
                        world.act(&manifolds[k]);
                        self.tell_of(world, &group[k], &manifolds[k]);
                    }
                    return;
                }
                let of = if softened { lasting::soft_points } else { lasting::points };
                let mut points: Vec<together::Point> = manifolds.iter().flat_map(|m| of(&world.bodies, m)).collect();
                let told = points.len();
                points.extend(held);
                world.act_together(&points, told)
            }
        };
        if !acted {
            return;
        }
        let mut told: Option<(u32, u32)> = None;
        for (pair, manifold) in group.iter().zip(&manifolds) {
            if told == Some((pair.a, pair.b)) {
                continue;
            }
            told = Some((pair.a, pair.b));
            self.tell_of(world, pair, manifold);
        }
    }

    /// Notes the hit of a pair at the middle of its points.
    fn tell_of(&mut self, world: &mut World, pair: &Pair, manifold: &Manifold) {
        let kind = PairKind::of(world.bodies.role[pair.a as usize], world.bodies.role[pair.b as usize]);
        let frame = world.bodies.frame[manifold.reference];
        let points = manifold.points();
        let middle = points.iter().map(|p| frame.place(p.on_face)).sum::<crate::area::Vec2>() / points.len() as f64;
        let normal = frame.outward(manifold.face.normal());
        self.note(world, pair, middle, normal, kind);
    }

    fn tell(&mut self, world: &mut World, pair: &Pair, placed: &relocate::Placed, kind: PairKind) {
        self.note(world, pair, placed.point, placed.normal, kind);
    }

    fn note(
        &mut self,
        world: &mut World,
        pair: &Pair,
        point: crate::area::Vec2,
        normal: crate::area::Vec2,
        kind: PairKind,
    ) {
        world.work.count_exchange(kind);
        world.collisions += 1;
        let (a, b) = (BodyId(pair.a), BodyId(pair.b));
        let point = point + world.plan.origin;
        self.untold.push(Hit { iteration: world.iteration, a, b, point, normal, depth: 0.0, kind });
    }
}

/// Moves the touches that share mobile bodies with the first one, directly or through others, to the front, in order; gives
/// how many they are.
fn bring_together(bodies: &Bodies, touches: &mut [Pair]) -> usize {
    let mut connected = 1;
    let mut k = 1;
    while k < touches.len() {
        let shares = |other: &Pair| {
            touches[..connected].iter().any(|pair| {
                [pair.a, pair.b].iter().any(|x| bodies.is_mobile(*x as usize) && (*x == other.a || *x == other.b))
            })
        };
        if shares(&touches[k]) {
            touches[connected..=k].rotate_right(1);
            connected += 1;
            k = connected;
        } else {
            k += 1;
        }
    }
    touches[..connected].sort_unstable_by_key(Pair::key);
    connected
}

/// Exchanges at several touches one after the other, again and again until none approaches, if first to last and last
/// to first come to the same: then there is an order in it, though not in time (equal rods that meet three at once hand their
/// motions through). Gives the touches in the order in which they are to act; `None` when the order would decide. The bodies
/// are as they were, either way.
fn in_turn(bodies: &mut Bodies, manifolds: &[Manifold]) -> Option<Vec<usize>> {
    let involved: Vec<usize> = manifolds.iter().flat_map(|m| [m.reference, m.owner]).collect();
    let before: Vec<Motion> = involved.iter().map(|body| bodies.motion[*body]).collect();
    let restore = |bodies: &mut Bodies, motions: &[Motion]| {
        for (body, motion) in involved.iter().zip(motions) {
            bodies.motion[*body] = *motion;
        }
    };
    let mut attempt = |order: &[usize]| {
        restore(bodies, &before);
        let mut acted = Vec::new();
        for _ in 0..2 * manifolds.len() {
            let so_far = acted.len();
            acted.extend(order.iter().filter(|k| impulse::act(bodies, &manifolds[**k]).is_some()));
            if acted.len() == so_far {
                let after: Vec<Motion> = involved.iter().map(|body| bodies.motion[*body]).collect();
                return Some((acted, after));
            }
        }
        None
    };
    let forwards: Vec<usize> = (0..manifolds.len()).collect();
    let backwards: Vec<usize> = forwards.iter().rev().copied().collect();
    let outcomes = attempt(&backwards).zip(attempt(&forwards));
    let alike = |a: &Motion, b: &Motion| {
        let size = 1e-12 * (a.v.norm() + b.v.norm() + a.omega.abs() + b.omega.abs());
        (a.v - b.v).norm() <= size && (a.omega - b.omega).abs() <= size
    };
    restore(bodies, &before);
    let (one, two) = outcomes?;
    one.1.iter().zip(&two.1).all(|(a, b)| alike(a, b)).then_some(two.0)
}

fn rect(bodies: &Bodies, body: u32, rect: u32) -> Rect {
    bodies.rects_of(body as usize)[rect as usize]
}

/// The contact at which a pair touches: one or two points, or its first vertex alone.
pub(super) fn manifold_of(bodies: &Bodies, pair: &Pair, detection: Detection) -> Manifold {
    match detection {
        Detection::Complete => whole(bodies, pair),
        Detection::Vertices => first_coming_vertex(bodies, pair),
    }
}

/// The first vertex that comes, of a flat landing's two: the first one may have been struck at this instant already.
fn first_coming_vertex(bodies: &Bodies, pair: &Pair) -> Manifold {
    let first = Manifold::from(first_vertex(bodies, pair));
    let comes = |manifold: &Manifold| {
        lasting::points(bodies, manifold).iter().any(|p| impulse::approaches(bodies, p.i, p.j, &p.arms, p.n))
    };
    let whole = whole(bodies, pair);
    let alone = |point: &Point| Manifold::new(whole.owner, whole.reference, whole.face, 0.0, [*point, *point], 1);
    if comes(&first) { first } else { whole.points().iter().map(alone).find(comes).unwrap_or(first) }
}

fn contact_of(bodies: &Bodies, pair: &Pair, detection: Detection) -> Contact {
    match detection {
        Detection::Complete => Contact { depth: 0.0, ..whole(bodies, pair).mean() },
        Detection::Vertices => first_vertex(bodies, pair),
    }
}

fn whole(bodies: &Bodies, pair: &Pair) -> Manifold {
    let one = Placed::of(bodies, pair.a as usize, pair.rects.0 as usize);
    let two = Placed::of(bodies, pair.b as usize, pair.rects.1 as usize);
    let (reference, owner) = if pair.touch.face_of_first { (one, two) } else { (two, one) };
    touch::at_face(reference, owner, pair.touch.face)
}

fn first_vertex(bodies: &Bodies, pair: &Pair) -> Contact {
    let (rect_a, rect_b) = (rect(bodies, pair.a, pair.rects.0), rect(bodies, pair.b, pair.rects.1));
    touch::first_vertex(&whole(bodies, pair), |body| if body == pair.a as usize { rect_a } else { rect_b })
}

/// Whether the two go on approaching at the point of an exchange, beyond rounding.
fn approaches(bodies: &Bodies, placed: &relocate::Placed) -> bool {
    let of = |body: usize, r| bodies.motion[body].v + crate::frame::perp(r) * bodies.motion[body].omega;
    let (owner, reference) = (of(placed.owner, placed.r_owner), of(placed.reference, placed.r_reference));
    (owner - reference).dot(&placed.normal) < -crate::impact_time::STILL * (owner.norm() + reference.norm())
}
