//! Rigid contacts in sub-steps: the two points of a contact solved together and exactly (a linear complementarity problem of
//! two rows), contact after contact forth and back (symmetric Gauss–Seidel), from the impulses of the sub-step before.
//!
//! Overlaps are taken out by displacements that leave velocities alone. With a finish, what is quiet is solved all at once.

use choque_engine::area::Vec2;

use crate::contact::{Contact, Hit, Point};
use crate::finish::Finish;
use crate::method::{Method, Step};
use crate::world::{Body, World, perp};

/// A gap or an overlap below this share of the smaller body's size is closed. Without it the rounding of a gap, divided by the
/// sub-step, is a velocity to be solved for, in every sub-step anew.
const SLOP: f64 = 1e-4;

/// How much of an overlap a sub-step takes out. Much more topples a house of cards: the displacements know no friction.
const SHARE: f64 = 0.2;

/// The method.
pub(crate) struct Blocks {
    pub(crate) substeps: usize,
    /// Rest, solved to the end.
    pub(crate) finish: Option<Finish>,
}

impl Method for Blocks {
    fn name(&self) -> &'static str {
        if self.finish.is_some() { "finished blocks" } else { "blocks" }
    }

    fn step(&mut self, world: &mut World, contacts: &mut [Contact], dt: f64) -> Step {
        let h = dt / self.substeps as f64;
        let start = world.bodies.clone();
        let mut told = Step::default();
        for _ in 0..self.substeps {
            let before = world.bodies.clone();
            for contact in contacts.iter_mut() {
                contact.measure(&world.bodies, &start);
                demand(contact, world, h);
            }
            let rounds = self.finish.as_ref().map_or(0, |finish| finish.rounds(world, h));
            world.fall(h);
            if let Some(finish) = self.finish.as_ref().filter(|_| rounds > 0) {
                told.add(finish.solve(world, contacts, rounds, h));
            } else {
                contacts.iter().for_each(|contact| warm(contact, world));
                contacts.iter_mut().for_each(|contact| improve(contact, world));
                contacts.iter_mut().rev().for_each(|contact| improve(contact, world));
                told.visits += 3 * contacts.len();
            }
            advance(world, contacts, &before, h);
            told.visits += part(world, contacts, &start);
        }
        told
    }
}

fn slop(contact: &Contact, bodies: &[Body]) -> f64 {
    let size = |body: usize| bodies[body].half.x + bodies[body].half.y;
    0.5 * SLOP * size(contact.i).min(size(contact.j))
}

/// What normal velocity each point is to have at least at the end of the sub-step.
fn demand(contact: &mut Contact, world: &World, h: f64) {
    let slop = slop(contact, &world.bodies);
    let falls = |body: usize| if world.bodies[body].is_mobile() { world.gravity * contact.n.y } else { 0.0 };
    let acceleration = falls(contact.j) - falls(contact.i);
    for k in 0..contact.points.len() {
        let point = contact.points[k];
        let u = contact.velocity(&world.bodies, point.arms).dot(&contact.n);
        let gap = if point.gap < slop { 0.0 } else { point.gap };
        // What comes no faster than gravity makes it in the meantime is no blow.
        let fast = u < 2.0 * h * -world.gravity.abs();
        let hit = if fast { hit(gap, u, acceleration, h) } else { None };
        let bounce =
            hit.map_or(0.0, |after| -world.restitution * (u + acceleration * after) + acceleration * (h - after));
        contact.points[k].hit = hit.map(|after| Hit { after, bounces: bounce > 0.0 });
        contact.points[k].wanted = match hit {
            Some(_) => bounce.max(0.0),
            None if fast => -2.0 * gap / h - u,
            None => -gap / h,
        };
    }
}

/// When a gap that closes at u is closed, if within h.
fn hit(gap: f64, u: f64, acceleration: f64, h: f64) -> Option<f64> {
    if gap + u * h + 0.5 * acceleration * h * h >= 0.0 {
        return None;
    }
    // gap + u τ + a τ²/2 = 0, the first root without cancellation.
    let root = (u * u - 2.0 * acceleration * gap).max(0.0).sqrt();
    Some((2.0 * gap / (root - u)).min(h))
}

fn warm(contact: &Contact, world: &mut World) {
    for point in &contact.points {
        contact.push(&mut world.bodies, point.arms, contact.n * point.p);
    }
    contact.push(&mut world.bodies, contact.middle, perp(contact.n) * contact.p_t);
}

/// The normal block, then friction: the other way round the first sub-step would have none.
fn improve(contact: &mut Contact, world: &mut World) {
    let mut given = [contact.points[0].p, contact.points[contact.points.len() - 1].p];
    solve_normal(contact, world, &mut given, |point| point.wanted);
    for (point, p) in contact.points.iter_mut().zip(given) {
        point.p = p;
    }
    let t = perp(contact.n);
    let bound = world.friction * contact.points.iter().map(|point| point.p).sum::<f64>();
    let u = contact.velocity(&world.bodies, contact.middle).dot(&t);
    let p = (contact.p_t - u / contact.k_t).clamp(-bound, bound);
    contact.push(&mut world.bodies, contact.middle, t * (p - contact.p_t));
    contact.p_t = p;
}

/// Normal impulses of one contact so that its points have what they want with all else as it is.
fn solve_normal(contact: &Contact, world: &mut World, given: &mut [f64; 2], wanted: impl Fn(&Point) -> f64) {
    let mut lacks = [0.0; 2];
    for (lack, point) in lacks.iter_mut().zip(&contact.points) {
        *lack = contact.velocity(&world.bodies, point.arms).dot(&contact.n) - wanted(point);
    }
    let p = contact.k.improved(*given, lacks, contact.points.len());
    for (side, point) in contact.points.iter().enumerate() {
        contact.push(&mut world.bodies, point.arms, contact.n * (p[side] - given[side]));
    }
    *given = p;
}

/// Moves everything. Without a blow by the mean of both velocities, which is exact for gravity and for sliding friction; with one,
/// by the first velocity until then and by the last one from then on.
fn advance(world: &mut World, contacts: &[Contact], before: &[Body], h: f64) {
    let mut hits: Vec<Option<Hit>> = vec![None; before.len()];
    for contact in contacts {
        for hit in contact.points.iter().filter(|point| point.p > 0.0).filter_map(|point| point.hit) {
            for body in [contact.i, contact.j] {
                let first = hits[body].is_none_or(|other| hit.after < other.after);
                hits[body] = if first { Some(hit) } else { hits[body] };
            }
        }
    }
    for ((body, was), hit) in world.bodies.iter_mut().zip(before).zip(hits).filter(|((body, _), _)| body.is_mobile()) {
        let (early, late, falls) = match hit {
            None => (0.5 * h, 0.5 * h, 0.0),
            Some(Hit { after, bounces }) => {
                let late = h - after;
                (after, late, 0.5 * (after * after - if bounces { late * late } else { 0.0 }))
            }
        };
        let fall = Vec2::new(0.0, world.gravity * falls);
        body.shift(was.v * early + body.v * late + fall, was.w * early + body.w * late);
    }
    world.turn_fixed(h);
}

/// Takes overlaps out; gives how many contacts it visited.
fn part(world: &mut World, contacts: &mut [Contact], start: &[Body]) -> usize {
    let mut clean = true;
    for contact in contacts.iter_mut() {
        contact.measure(&world.bodies, start);
        let slop = slop(contact, &world.bodies);
        clean &= contact.points.iter().all(|point| point.gap >= -slop);
    }
    if clean {
        return contacts.len();
    }
    // Displacements stand where velocities do: the rows are the same.
    let kept: Vec<(Vec2, f64)> = world.bodies.iter().map(|body| (body.v, body.w)).collect();
    for body in &mut world.bodies {
        (body.v, body.w) = (Vec2::zeros(), 0.0);
    }
    for contact in contacts.iter() {
        let slop = slop(contact, &world.bodies);
        let wanted = |point: &Point| {
            if point.gap < -slop { -SHARE * point.gap } else { -point.gap.max(0.0) }
        };
        solve_normal(contact, world, &mut [0.0; 2], wanted);
    }
    for (body, (v, w)) in world.bodies.iter_mut().zip(kept) {
        body.shift(body.v, body.w);
        (body.v, body.w) = (v, w);
    }
    2 * contacts.len()
}
