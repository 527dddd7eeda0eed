//! Soft step (TGS soft; Catto, "Solver2D", 2024): contacts are stiff damped springs during a sub-step's first pass, and what
//! velocity the springs gave is taken out again in a second one.

use choque_engine::area::Vec2;

use crate::contact::Contact;
use crate::method::{Method, Step};
use crate::world::{Body, World, perp};

/// Natural frequency of a contact, Hz; no more than a quarter of the sub-steps a second.
const HERTZ: f64 = 30.0;
/// Damping over critical damping.
const DAMPING: f64 = 10.0;
/// An overlap is left no faster, m/s.
const PUSH: f64 = 3.0;
/// What comes more slowly does not bounce, m/s.
const THRESHOLD: f64 = 1.0;

/// The method.
pub(crate) struct Soft {
    pub(crate) substeps: usize,
}

/// A damped spring, solved implicitly: velocity per overlap, and how much of the response and of the impulse so far counts.
#[derive(Clone, Copy)]
struct Spring {
    rate: f64,
    response: f64,
    decay: f64,
}

const RIGID: Spring = Spring { rate: 0.0, response: 1.0, decay: 0.0 };

impl Spring {
    fn new(h: f64, stiffer: f64) -> Spring {
        let omega = std::f64::consts::TAU * HERTZ.min(0.25 / h) * stiffer;
        let a = 2.0 * DAMPING + h * omega;
        let share = h * omega * a;
        Spring { rate: omega / a, response: share / (1.0 + share), decay: 1.0 / (1.0 + share) }
    }
}

impl Method for Soft {
    fn name(&self) -> &'static str {
        "soft step"
    }

    fn step(&mut self, world: &mut World, contacts: &mut [Contact], dt: f64) -> Step {
        let h = dt / self.substeps as f64;
        let start = world.bodies.clone();
        let mut passes = 0;
        let mut most = vec![[0.0_f64; 2]; contacts.len()];
        for _ in 0..self.substeps {
            substep(world, contacts, &start, h);
            contacts.iter().zip(&mut most).for_each(|(contact, most)| pushed(contact, most));
            passes += 3;
        }
        if world.restitution > 0.0 {
            for (contact, most) in contacts.iter_mut().zip(&most) {
                bounce(contact, world, &start, *most);
            }
            passes += 1;
        }
        Step { visits: passes * contacts.len(), ..Step::default() }
    }
}

/// Keeps the greatest impulse of each point.
pub(crate) fn pushed(contact: &Contact, most: &mut [f64; 2]) {
    contact.points.iter().zip(most).for_each(|(point, most)| *most = most.max(point.p));
}

/// Everything but restitution.
pub(crate) fn substep(world: &mut World, contacts: &mut [Contact], start: &[Body], h: f64) {
    world.fall(h);
    for contact in contacts.iter() {
        for point in &contact.points {
            let impulse = contact.n * point.p + perp(contact.n) * point.p_t;
            contact.push(&mut world.bodies, point.arms, impulse);
        }
    }
    for contact in contacts.iter_mut() {
        contact.measure(&world.bodies, start);
        normal(contact, world, h, Some(spring(contact, &world.bodies, h)));
    }
    for body in world.bodies.iter_mut().filter(|body| body.is_mobile()) {
        body.shift(body.v * h, body.w * h);
    }
    world.turn_fixed(h);
    for contact in contacts.iter_mut() {
        contact.measure(&world.bodies, start);
        friction(contact, world);
        normal(contact, world, h, None);
    }
}

fn spring(contact: &Contact, bodies: &[Body], h: f64) -> Spring {
    let both = bodies[contact.i].is_mobile() && bodies[contact.j].is_mobile();
    Spring::new(h, if both { 1.0 } else { 2.0 })
}

fn response(world: &World, contact: &Contact, arms: [Vec2; 2], a: Vec2) -> f64 {
    let of = |body: &Body, arm: Vec2| {
        let turning = crate::world::cross(arm, a);
        body.inverse_mass + turning * turning * body.inverse_inertia
    };
    of(&world.bodies[contact.i], arms[0]) + of(&world.bodies[contact.j], arms[1])
}

/// Point by point; without a spring what is in touch only stops approaching.
fn normal(contact: &mut Contact, world: &mut World, h: f64, spring: Option<Spring>) {
    for k in 0..contact.points.len() {
        let point = contact.points[k];
        let (bias, soft) = match spring {
            _ if point.gap > 0.0 => (point.gap / h, RIGID),
            Some(spring) => ((spring.rate * point.gap).max(-PUSH), spring),
            None => (0.0, RIGID),
        };
        let u = contact.velocity(&world.bodies, point.arms).dot(&contact.n);
        let effective = response(world, contact, point.arms, contact.n);
        let p = (point.p - soft.response * (u + bias) / effective - soft.decay * point.p).max(0.0);
        contact.points[k].p = p;
        contact.push(&mut world.bodies, point.arms, contact.n * (p - point.p));
    }
}

fn friction(contact: &mut Contact, world: &mut World) {
    let t = perp(contact.n);
    for k in 0..contact.points.len() {
        let point = contact.points[k];
        let u = contact.velocity(&world.bodies, point.arms).dot(&t);
        let bound = world.friction * point.p;
        let p = (point.p_t - u / response(world, contact, point.arms, t)).clamp(-bound, bound);
        contact.points[k].p_t = p;
        contact.push(&mut world.bodies, point.arms, t * (p - point.p_t));
    }
}

/// What pushed and came fast enough leaves as restitution has it.
fn bounce(contact: &mut Contact, world: &mut World, start: &[Body], most: [f64; 2]) {
    for (k, most) in most.into_iter().enumerate().take(contact.points.len()) {
        let point = contact.points[k];
        let before = contact.velocity(start, point.arms).dot(&contact.n);
        if before > -THRESHOLD || most == 0.0 {
            continue;
        }
        let u = contact.velocity(&world.bodies, point.arms).dot(&contact.n);
        let effective = response(world, contact, point.arms, contact.n);
        let p = (point.p - (u + world.restitution * before) / effective).max(0.0);
        contact.points[k].p = p;
        contact.push(&mut world.bodies, point.arms, contact.n * (p - point.p));
    }
}
