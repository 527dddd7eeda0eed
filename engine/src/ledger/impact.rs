//! Impulses in the books, and the impacts of a world that may keep them.

use super::Ledger;
use super::amounts::{Amounts, Booked, Cause, State};
use super::wide::Sums;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::detect::manifold::Manifold;
use crate::exchange::impact::Components;
use crate::exchange::impulse::{self, Act, Arms, Given};
use crate::exchange::together::{self, Point};
use crate::frame::perp;
use crate::world::World;

/// The impulse at one point of an impact, on j and against i.
#[derive(Clone, Copy, Debug)]
struct Blow {
    i: usize,
    j: usize,
    /// From i to j; t = −perp(n).
    n: Vec2,
    arms: Arms,
    p: Components,
    /// What its normal part worked, where that is more than p_n (u_n⁻ + u_n⁺)/2: slip may have changed meanwhile.
    normal_work: Option<f64>,
}

impl Act {
    /// Its impulses: at one point, or the normal ones at both ends of a face and the tangential one between.
    fn blows(&self) -> impl Iterator<Item = Blow> {
        let blow = |arms, t, n| {
            let p = Components { t, n };
            Blow { i: self.i, j: self.j, n: self.normal, arms, p, normal_work: None }
        };
        let all = match self.given {
            Given::Point { at, p, normal_work } => {
                [Some(Blow { normal_work: Some(normal_work), ..blow(at, p.t, p.n) }), None, None]
            }
            Given::Face { ends, p } => [
                Some(blow(ends[0], 0.0, p.n[0])),
                Some(blow(ends[1], 0.0, p.n[1])),
                Some(blow(Arms::middle(&ends), p.t, 0.0)),
            ],
        };
        all.into_iter().flatten()
    }
}

impl World {
    /// One impact by the law of its one or two points; `None` when nothing approaches.
    pub(crate) fn act(&mut self, manifold: &Manifold) -> Option<Act> {
        let World { bodies, ledger, .. } = self;
        let Some(ledger) = ledger else { return impulse::act(bodies, manifold) };
        let before = [manifold.reference, manifold.owner].map(|body| (body, bodies.motion[body]));
        let act = impulse::act(bodies, manifold)?;
        ledger.book_impact(bodies, &before, act.blows(), usize::MAX);
        Some(act)
    }

    /// Impacts that act together; whether anything approached. Of the points the first so many are `told` of: their pairs have
    /// entries of their own. The others share the blow, and what they do is the first pair's.
    pub(crate) fn act_together(&mut self, points: &[Point], told: usize) -> bool {
        let World { bodies, ledger, .. } = self;
        let Some(ledger) = ledger else { return together::exchange(bodies, points).is_some() };
        let before = together::involved(bodies, points);
        let Some(impulses) = together::exchange(bodies, points) else { return false };
        let blows = points.iter().zip(impulses).map(|(point, p)| {
            let Point { i, j, n, arms, .. } = *point;
            Blow { i, j, n, arms, p: Components { t: p.t, n: p.n }, normal_work: None }
        });
        ledger.book_impact(bodies, &before, blows, told);
        true
    }

    /// Lets something change the motions of bodies in contact; what that takes is booked as if impulses between them did it.
    pub(crate) fn settle(&mut self, involved: &[usize], change: impl FnOnce(&mut Bodies)) {
        let World { bodies, ledger, .. } = self;
        let Some(ledger) = ledger else { return change(bodies) };
        let before: Vec<(usize, Motion)> = involved.iter().map(|body| (*body, bodies.motion[*body])).collect();
        change(bodies);
        ledger.book_impact(bodies, &before, core::iter::empty(), 0);
    }
}

impl Ledger {
    /// Books an impact, pair by pair, the points of a pair standing side by side: Σ p·(u⁻ + u⁺)/2 over its points is what the
    /// relative motion loses, and p·w what a fixed body works that moves at w there. What rounding leaves between that
    /// and the change of the motions is put to the first pair.
    fn book_impact(
        &mut self,
        bodies: &Bodies,
        before: &[(usize, Motion)],
        blows: impl Iterator<Item = Blow>,
        told: usize,
    ) {
        let was =
            |body: usize| before.iter().find(|(known, _)| *known == body).map_or(bodies.motion[body], |(_, m)| *m);
        let mut pairs: Vec<((usize, usize), Booked)> = Vec::with_capacity(1);
        for (k, blow) in blows.enumerate() {
            let pair = (blow.i.min(blow.j), blow.i.max(blow.j));
            if pairs.last().is_none_or(|(last, _)| *last != pair && k < told) {
                pairs.push((pair, Booked::default()));
            }
            let own = if k < told { pairs.last_mut() } else { pairs.first_mut() };
            if let Some((_, booked)) = own {
                blow.book(self, bodies, was, booked);
            }
        }
        let mut rest = Sums::default();
        for &(body, motion) in before.iter().filter(|(body, _)| bodies.is_mobile(*body)) {
            let now = self.state(bodies, body);
            rest.add_all(&Sums::of_change(bodies.inertia[body], State { motion, ..now }, now));
        }
        for (_, booked) in &pairs {
            Cause::ALL.iter().for_each(|cause| rest.take(booked[*cause]));
            self.book_all(booked);
        }
        let (energy, momenta) = rest.energy_and_momenta();
        self.book_rest(Cause::Restitution, &energy);
        self.book_rest(Cause::Exchange, &momenta);
        if let Some((_, first)) = pairs.first_mut() {
            first[Cause::Restitution] += energy.value();
            first[Cause::Exchange] += momenta.value();
        }
        for (_, booked) in pairs.into_iter().filter(|_| told > 0) {
            self.enter(booked, 0.0);
        }
    }
}

impl Blow {
    fn book(&self, ledger: &Ledger, bodies: &Bodies, was: impl Fn(usize) -> Motion, booked: &mut Booked) {
        let Blow { i, j, n, arms, p, normal_work } = *self;
        let at_point = |motion: Motion, r: Vec2| motion.v + perp(r) * motion.omega;
        let u_before = at_point(was(j), arms.r_j) - at_point(was(i), arms.r_i);
        let u = (u_before + impulse::relative_velocity(bodies, i, j, &arms)) * 0.5;
        let (along, across) = (n * p.n, -perp(n) * p.t);
        let whole = (along + across).dot(&u);
        let normal = normal_work.unwrap_or_else(|| along.dot(&u));
        booked[Cause::Restitution] += Amounts::of_energy(normal);
        if p.t != 0.0 {
            booked[Cause::Friction] += Amounts::of_energy(whole - normal);
        }
        // A fixed body takes up the momentum, and works when it moves; two mobile ones keep it between them.
        let (mobile, r, sign, fixed, r_fixed) = match (bodies.is_mobile(i), bodies.is_mobile(j)) {
            (false, true) => (j, arms.r_j, 1.0, i, arms.r_i),
            (true, false) => (i, arms.r_i, -1.0, j, arms.r_j),
            _ => return,
        };
        let at = ledger.state(bodies, mobile).o + r;
        booked[Cause::Exchange] += Amounts::of_impulse(along * sign, at);
        booked[Cause::Friction] += Amounts::of_impulse(across * sign, at);
        let w = at_point(bodies.motion[fixed], r_fixed);
        booked[Cause::FixedBodies] += Amounts::of_energy(((along + across) * sign).dot(&w));
    }
}
