//! Energy that constant forces have made is taken out again.
//!
//! In the frame of what it stands on, a lasting contact does no work, or takes some by friction. Forces that are constant
//! over a span while bodies turn do a little, of either sign. What they took stays taken; what they made is taken out of
//! the motion within the cluster: the part of all velocities that is not the common motion of a rigid body is scaled down. That
//! changes neither momentum nor angular momentum, and parts no contact, for at a contact it is the relative motion that
//! counts, and this scales with the rest.

use super::Continuous;
use crate::area::Vec2;
use crate::bodies::{Bodies, Inertia, Motion, Role};
use crate::flight::Change;
use crate::frame::perp;

/// More than rounding could leave of what is taken out.
const SURE: f64 = 1.0 + 1e-9;

impl Continuous {
    /// Counts the work that what holds a body does while it flies.
    #[inline]
    pub(super) fn count_held_work(&mut self, bodies: &Bodies, body: usize, change: &Change) {
        let (pull, free) = (&self.pulls[body], &self.free[body]);
        let (a, alpha) = (pull.a - free.a, pull.alpha - free.alpha);
        if a.x != 0.0 || a.y != 0.0 || alpha != 0.0 {
            let Inertia { mass, moment } = bodies.inertia[body];
            self.held_work[body] += mass * a.dot(&change.shift) + moment * alpha * change.turn;
        }
    }
}

/// Takes out what the forces that held these bodies have made of energy. What a fixed body that moves has worked is its own.
pub(super) fn energy(state: &mut Continuous, bodies: &mut Bodies, cluster: &[usize]) {
    let made: f64 = cluster.iter().map(|body| core::mem::take(&mut state.held_work[*body])).sum();
    let is_driven = cluster.iter().any(|body| bodies.role[*body] == Role::FixedWithPhysics);
    if made <= 0.0 || is_driven {
        return;
    }
    let movers: Vec<usize> = cluster.iter().copied().filter(|body| bodies.is_mobile(*body)).collect();
    let stands = movers.len() < cluster.len();
    let common = if stands { Rigid::default() } else { Rigid::of(bodies, &movers) };
    let within: Vec<Motion> = movers.iter().map(|body| common.without(bodies, *body)).collect();
    let energy = |(body, m): (&usize, &Motion)| {
        let Inertia { mass, moment } = bodies.inertia[*body];
        0.5 * (mass * m.v.dot(&m.v) + moment * m.omega * m.omega)
    };
    let all: f64 = movers.iter().zip(&within).map(energy).sum();
    if all <= 0.0 {
        return;
    }
    let keep = (1.0 - (made * SURE / all).min(1.0)).sqrt();
    for (body, m) in movers.into_iter().zip(within) {
        let motion = &mut bodies.motion[body];
        motion.v -= m.v * (1.0 - keep);
        motion.omega -= m.omega * (1.0 - keep);
    }
}

/// The motion of bodies as if they were one.
#[derive(Clone, Copy, Debug, Default)]
struct Rigid {
    centre: Vec2,
    v: Vec2,
    omega: f64,
}

impl Rigid {
    fn of(bodies: &Bodies, movers: &[usize]) -> Rigid {
        let Some(&first) = movers.first() else { return Rigid::default() };
        let from = bodies.frame[first].o; // differences first, however far out
        let (mut mass, mut centre, mut momentum) = (0.0, Vec2::zeros(), Vec2::zeros());
        for &body in movers {
            let m = bodies.inertia[body].mass;
            mass += m;
            centre += (bodies.frame[body].o - from) * m;
            momentum += bodies.motion[body].v * m;
        }
        let (centre, v) = (from + centre / mass, momentum / mass);
        let (mut angular, mut moment) = (0.0, 0.0);
        for &body in movers {
            let (Inertia { mass: m, moment: i }, r) = (bodies.inertia[body], bodies.frame[body].o - centre);
            angular += m * perp(r).dot(&(bodies.motion[body].v - v)) + i * bodies.motion[body].omega;
            moment += m * r.dot(&r) + i;
        }
        Rigid { centre, v, omega: angular / moment }
    }

    /// What a body's motion is besides.
    fn without(&self, bodies: &Bodies, body: usize) -> Motion {
        let Motion { v, omega } = bodies.motion[body];
        let r = bodies.frame[body].o - self.centre;
        Motion { v: v - self.v - perp(r) * self.omega, omega: omega - self.omega }
    }
}
