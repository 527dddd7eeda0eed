//! Energy that constant forces have made is taken out again, and angular momentum.
//!
//! Angular momentum is kept over a whole span; where an impact cuts it short, the little that is amiss is put right by turning the
//! cluster as one.
//!
//! In the frame of what it stands on, a lasting contact does no work, or takes some by friction. Forces that are constant
//! over a span while bodies turn do a little, of either sign. What they took stays taken; what they made is taken out of
//! the motion within the cluster: the part of all velocities that is not the common motion of a rigid body is scaled down. That
//! changes neither momentum nor angular momentum, and parts no contact, for at a contact it is the relative motion that
//! counts, and this scales with the rest.

use super::Continuous;
use crate::area::Vec2;
use crate::bodies::{Bodies, Inertia, Motion, Role};
use crate::flight::{Change, Path};
use crate::frame::perp;

/// More than rounding could leave of what is taken out.
const SURE: f64 = 1.0 + 1e-9;

impl Continuous {
    /// Counts the work that what holds a body does while it flies.
    #[inline]
    pub(super) fn count_held_work(&mut self, bodies: &Bodies, body: usize, change: &Change, time: f64) {
        let (pull, free) = (&self.pulls[body], &self.free[body]);
        let (a, alpha) = (pull.a - free.a, pull.alpha - free.alpha);
        if a.x == 0.0 && a.y == 0.0 && alpha == 0.0 {
            return;
        }
        let Inertia { mass, moment } = bodies.inertia[body];
        let middle = Path::of(bodies, &self.pulls, body).change(0.5 * time).shift;
        let mean = bodies.frame[body].o + (change.shift + middle * 4.0) / 6.0; // Simpson: exact but for drag
        let held = &mut self.held[body];
        held.work += mass * a.dot(&change.shift) + moment * alpha * change.turn;
        held.turn += (mass * perp(mean).dot(&a) + moment * alpha) * time;
    }
}

/// What has held a body since that was last settled.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Held {
    /// Its work \[J\], and its angular momentum about the origin \[kg·m²/s\].
    work: f64,
    turn: f64,
}

/// Takes out what the forces that held these bodies have made of energy, and of angular momentum where nothing fixed is among
/// them. What a fixed body that moves has worked is its own.
pub(super) fn settle(state: &mut Continuous, bodies: &mut Bodies, cluster: &[usize]) {
    let (mut made, mut turn) = (0.0, 0.0);
    for body in cluster {
        let Held { work, turn: of_body } = core::mem::take(&mut state.held[*body]);
        (made, turn) = (made + work, turn + of_body);
    }
    let is_driven = cluster.iter().any(|body| bodies.role[*body] == Role::FixedWithPhysics);
    let movers: Vec<usize> = cluster.iter().copied().filter(|body| bodies.is_mobile(*body)).collect();
    let stands = movers.len() < cluster.len();
    if !stands && turn != 0.0 {
        made += Rigid::of(bodies, &movers).turn_back(bodies, &movers, turn);
    }
    if made <= 0.0 || is_driven {
        return;
    }
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
    /// Moment of inertia of all about their centre.
    moment: f64,
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
        Rigid { centre, v, omega: angular / moment, moment }
    }

    /// Takes angular momentum out by turning all as one; gives what that adds to the energy.
    fn turn_back(&self, bodies: &mut Bodies, movers: &[usize], turn: f64) -> f64 {
        let change = -turn / self.moment;
        for &body in movers {
            bodies.motion[body].v += perp(bodies.frame[body].o - self.centre) * change;
            bodies.motion[body].omega += change;
        }
        self.moment * change * (self.omega + 0.5 * change)
    }

    /// What a body's motion is besides.
    fn without(&self, bodies: &Bodies, body: usize) -> Motion {
        let Motion { v, omega } = bodies.motion[body];
        let r = bodies.frame[body].o - self.centre;
        Motion { v: v - self.v - perp(r) * self.omega, omega: omega - self.omega }
    }
}
