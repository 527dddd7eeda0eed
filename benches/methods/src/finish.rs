//! Rest, solved to the end: all contacts improved at once from the same velocities (Jacobi), each with its share of the bodies it
//! pushes (mass splitting: Tonge, Benevolenski and Voroshilov 2012), every round from an extrapolation of the last two
//! (Nesterov 1983) that starts anew where it led astray (O'Donoghue and Candès 2015).
//!
//! Solved once, rest is free: the next sub-step begins with the right impulses, and one round sees that nothing is left to do.

use choque_engine::area::Vec2;

use crate::contact::{Block, Contact};
use crate::method::Step;
use crate::world::{World, cross, perp};

/// When and how far; speeds are shares of what gravity does in a sub-step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Finish {
    /// A round that changes less is the last.
    tolerance: f64,
    /// What is pushed and slower at the end is at rest. Without it what the tolerance leaves goes on for ever and opens contacts by and by.
    rest: f64,
    /// All slower: quiet.
    quiet: f64,
    /// Rounds in a sub-step at most when nothing moves at all, and when all is quiet.
    most: [usize; 2],
}

impl Finish {
    pub(crate) const USUAL: Finish = Finish { tolerance: 1e-6, rest: 1e-3, quiet: 4.0, most: [10_000, 20] };
}

/// Impulses of a contact: normal at both points, tangential.
type Impulses = [f64; 3];
/// Velocity and spin.
type Motion = (Vec2, f64);

/// Impulses of all contacts, and the motions they give.
#[derive(Clone)]
struct Guess {
    impulses: Vec<Impulses>,
    motions: Vec<Motion>,
}

/// A contact whose bodies count by their share of it.
struct Row {
    shares: [f64; 2],
    k: Block,
    k_t: f64,
}

impl Finish {
    /// How many rounds the scene is worth as it is: none unless all is quiet.
    pub(crate) fn rounds(&self, world: &World, h: f64) -> usize {
        let fastest = world.bodies.iter().map(|body| body.fastest()).fold(0.0, f64::max);
        if fastest == 0.0 {
            self.most[0]
        } else if fastest <= self.quiet * h * world.gravity.abs() {
            self.most[1]
        } else {
            0
        }
    }

    /// Improves the contacts' impulses until they are right, and gives the bodies the motions that follow.
    pub(crate) fn solve(&self, world: &mut World, contacts: &mut [Contact], most: usize, h: f64) -> Step {
        let speed = h * world.gravity.abs();
        let rows = rows(world, contacts);
        let mut now = Guess::of(world, contacts.iter().map(impulses).collect(), contacts);
        let mut last = now.clone();
        let mut momentum = 1.0_f64;
        let mut told = Step { visits: contacts.len(), ..Step::default() };
        while told.rounds < most {
            let next = 0.5 * (1.0 + (1.0 + 4.0 * momentum * momentum).sqrt());
            let from = now.beyond(&last, (momentum - 1.0) / next);
            let (better, change, astray) = from.improved(world, contacts, &rows, &now);
            momentum = if astray { 1.0 } else { next };
            last = if astray { better.clone() } else { now };
            now = better;
            told.rounds += 1;
            told.visits += contacts.len();
            told.residual = change;
            if change <= self.tolerance * speed {
                break;
            }
        }
        // Sums anew, without what the rounds have rounded away.
        let now = Guess::of(world, now.impulses, contacts);
        for (contact, p) in contacts.iter_mut().zip(&now.impulses) {
            contact.points.iter_mut().zip(p).for_each(|(point, p)| point.p = *p);
            contact.p_t = p[2];
        }
        let pushed = pushed_bodies(world, contacts);
        for ((body, (v, w)), pushed) in world.bodies.iter_mut().zip(now.motions).zip(pushed) {
            (body.v, body.w) = (v, w);
            if body.is_mobile() && pushed && body.fastest() <= self.rest * speed {
                (body.v, body.w) = (Vec2::zeros(), 0.0);
            }
        }
        told
    }
}

impl Guess {
    fn of(world: &World, impulses: Vec<Impulses>, contacts: &[Contact]) -> Guess {
        let mut motions: Vec<Motion> = world.bodies.iter().map(|body| (body.v, body.w)).collect();
        contacts.iter().zip(&impulses).for_each(|(contact, p)| give(contact, world, &mut motions, *p));
        Guess { impulses, motions }
    }

    /// The guess to which another leads, and so much beyond.
    fn beyond(&self, other: &Guess, share: f64) -> Guess {
        let impulses = self.impulses.iter().zip(&other.impulses);
        let motions = self.motions.iter().zip(&other.motions);
        Guess {
            impulses: impulses.map(|(a, b)| [0, 1, 2].map(|k| a[k] + share * (a[k] - b[k]))).collect(),
            motions: motions.map(|(a, b)| (a.0 + (a.0 - b.0) * share, a.1 + share * (a.1 - b.1))).collect(),
        }
    }

    /// The guess with every contact improved at once; by how much velocity at most; whether that turns back on the way from `was`.
    fn improved(&self, world: &World, contacts: &[Contact], rows: &[Row], was: &Guess) -> (Guess, f64, bool) {
        let mut better = self.clone();
        let (mut most, mut back) = (0.0_f64, 0.0);
        for (c, (contact, row)) in contacts.iter().zip(rows).enumerate() {
            let to = improved(world, contact, row, &self.motions, self.impulses[c]);
            let change = [0, 1, 2].map(|k| to[k] - self.impulses[c][k]);
            for (k, size) in [row.k.a, row.k.c, row.k_t].into_iter().enumerate() {
                most = most.max(size * change[k].abs());
                back -= size * change[k] * (to[k] - was.impulses[c][k]);
            }
            give(contact, world, &mut better.motions, change);
            better.impulses[c] = to;
        }
        (better, most, back > 0.0)
    }
}

fn pushed_bodies(world: &World, contacts: &[Contact]) -> Vec<bool> {
    let mut pushed = vec![false; world.bodies.len()];
    for contact in contacts.iter().filter(|contact| contact.points.iter().any(|point| point.p > 0.0)) {
        (pushed[contact.i], pushed[contact.j]) = (true, true);
    }
    pushed
}

/// Every contact of a body counts, also one that does not push: with fewer the rounds diverge.
fn rows(world: &World, contacts: &[Contact]) -> Vec<Row> {
    let mut degree = vec![0.0_f64; world.bodies.len()];
    for contact in contacts {
        degree[contact.i] += 1.0;
        degree[contact.j] += 1.0;
    }
    let row = |contact: &Contact| {
        let shares = [degree[contact.i], degree[contact.j]];
        let (k, k_t) = contact.responses(world, shares);
        Row { shares, k, k_t }
    };
    contacts.iter().map(row).collect()
}

fn impulses(contact: &Contact) -> Impulses {
    let second = contact.points.get(1).map_or(0.0, |point| point.p);
    [contact.points[0].p, second, contact.p_t]
}

/// Pushes both bodies of a contact.
fn give(contact: &Contact, world: &World, motions: &mut [Motion], p: Impulses) {
    for (side, body) in [contact.i, contact.j].into_iter().enumerate() {
        let (v, w) = pushed(contact, world, side, p);
        motions[body].0 += v;
        motions[body].1 += w;
    }
}

/// By how much impulses change the motion of one of the two bodies.
fn pushed(contact: &Contact, world: &World, side: usize, p: Impulses) -> Motion {
    let (body, sign) = [(contact.i, -1.0), (contact.j, 1.0)][side];
    let (n, t) = (contact.n, perp(contact.n));
    let mut turning = cross(contact.middle[side], t) * p[2];
    for (point, p) in contact.points.iter().zip(p) {
        turning += cross(point.arms[side], n) * p;
    }
    let linear = n * (p[0] + p[1]) + t * p[2];
    let body = &world.bodies[body];
    (linear * (sign * body.inverse_mass), sign * turning * body.inverse_inertia)
}

/// Better impulses of a contact that has its share of its bodies to itself.
fn improved(world: &World, contact: &Contact, row: &Row, motions: &[Motion], from: Impulses) -> Impulses {
    let mut own = [motions[contact.i], motions[contact.j]];
    let velocity =
        |own: &[Motion; 2], arms: [Vec2; 2]| own[1].0 + perp(arms[1]) * own[1].1 - own[0].0 - perp(arms[0]) * own[0].1;
    let mut lacks = [0.0; 2];
    for (lack, point) in lacks.iter_mut().zip(&contact.points) {
        *lack = velocity(&own, point.arms).dot(&contact.n) - point.wanted;
    }
    let p = row.k.improved([from[0], from[1]], lacks, contact.points.len());
    for (side, own) in own.iter_mut().enumerate() {
        let (v, w) = pushed(contact, world, side, [p[0] - from[0], p[1] - from[1], 0.0]);
        own.0 += v * row.shares[side];
        own.1 += w * row.shares[side];
    }
    let bound = world.friction * (p[0] + p[1]);
    let slip = velocity(&own, contact.middle).dot(&perp(contact.n));
    [p[0], p[1], (from[2] - slip / row.k_t).clamp(-bound, bound)]
}
