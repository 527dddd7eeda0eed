//! Flights in the books: what gravity, pushes and drag do on the way.

use super::Ledger;
use super::amounts::{Amounts, Cause, State, cross};
use super::wide::Sums;
use crate::area::Vec2;
use crate::bodies::{Bodies, Inertia, Motion};
use crate::flight::Path;
use crate::forces::Flight;
use crate::plan::FlightPlan;
use crate::push::Push;

/// What acts on a body while it flies, by cause, as accelerations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Forces {
    /// Of gravity \[m/s²\].
    pub(crate) gravity: Vec2,
    /// Of pushes and twists \[m/s², rad/s²\].
    pub(crate) pushed: Motion,
    /// Of lasting contacts, along their normals and along their tangents \[m/s², rad/s²\].
    pub(crate) pressed: Motion,
    /// The latter.
    pub(crate) rubbed: Motion,
    /// What fixed bodies work by either \[W\].
    pub(crate) worked: (f64, f64),
    /// Decay rates of velocity and of spin \[1/s\].
    pub(crate) drag: (f64, f64),
}

/// A flight under forces constant in time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// How long it took \[s\].
    pub(super) time: f64,
    /// How far it led \[m\], and how far round \[rad\].
    pub(super) shift: Vec2,
    pub(super) turn: f64,
    /// The place, summed over the time \[m·s\].
    pub(super) lever: Vec2,
}

impl Way {
    /// What a force and a torque did on the way, given as accelerations.
    pub(super) fn given(&self, Inertia { mass, moment }: Inertia, acceleration: Motion) -> Amounts {
        let (force, torque) = (acceleration.v * mass, acceleration.omega * moment);
        Amounts {
            kinetic_energy: force.dot(&self.shift) + torque * self.turn,
            momentum_x: force.x * self.time,
            momentum_z: force.y * self.time,
            angular_momentum: cross(self.lever, force) + torque * self.time,
        }
    }
}

impl Ledger {
    /// Remembers how bodies are before they fly.
    pub(crate) fn set_out(&mut self, bodies: &Bodies, movers: &[u32]) {
        let mut set_out = core::mem::take(&mut self.set_out);
        set_out.clear();
        set_out.extend(movers.iter().map(|body| self.state(bodies, *body as usize)));
        self.set_out = set_out;
    }

    /// Books the flights of the mobile ones of these bodies since they set out.
    pub(crate) fn arrive(&mut self, bodies: &Bodies, movers: &[u32], flown: impl Fn(usize) -> (f64, Forces)) {
        let set_out = core::mem::take(&mut self.set_out);
        let bodies_and_states = movers.iter().map(|body| *body as usize).zip(&set_out);
        for (body, from) in bodies_and_states.filter(|(body, _)| bodies.is_mobile(*body)) {
            let (time, forces) = flown(body);
            self.book_flight(bodies, body, time, &forces, *from, self.state(bodies, body));
        }
        self.set_out = set_out;
    }

    /// Books the flight that a body has behind it by now, though it has not been moved yet.
    pub(crate) fn fly_on(&mut self, bodies: &Bodies, body: usize, (time, forces): (f64, Forces), to: &Path) {
        let from = self.state(bodies, body);
        self.book_flight(bodies, body, time, &forces, from, State { o: to.frame.o + self.origin, motion: to.motion });
    }

    /// Books what stepped motion did in an iteration's advance.
    pub(crate) fn book_step(&mut self, bodies: &Bodies, movers: &[u32], flight: FlightPlan, dt: f64, pushes: &[Push]) {
        let (gravity, drag) = flight.forces();
        self.arrive(bodies, movers, |body| {
            let push = pushes.binary_search_by_key(&(body as u32), |push| push.body);
            let pushed = push.map_or(Motion::default(), |at| pushes[at].acceleration(bodies.inertia[body]));
            (dt, Forces { gravity, pushed, drag, ..Forces::default() })
        });
    }

    /// Books one flight. Forces constant in time have their work and their torque in closed form; drag is the rest, and
    /// without drag the rest is rounding.
    pub(super) fn book_flight(
        &mut self,
        bodies: &Bodies,
        body: usize,
        time: f64,
        forces: &Forces,
        from: State,
        to: State,
    ) {
        let Forces { gravity, pushed, pressed, rubbed, worked, drag } = *forces;
        let inertia = bodies.inertia[body];
        let falls = Motion { v: gravity, omega: 0.0 };
        let acting = [
            (Cause::Gravity, falls, 0.0),
            (Cause::Commands, pushed, 0.0),
            (Cause::Exchange, pressed, worked.0),
            (Cause::Friction, rubbed, worked.1),
        ];
        let rest_cause = match acting.iter().find(|(_, a, _)| *a != Motion::default()) {
            _ if drag != (0.0, 0.0) => Cause::Drag,
            Some((cause, ..)) => *cause,
            None => return, // free flight changes nothing
        };
        let (linear, angular) = (Flight::new(drag.0, time), Flight::new(drag.1, time));
        let a = gravity + pushed.v + pressed.v + rubbed.v;
        let alpha = pushed.omega + pressed.omega + rubbed.omega;
        let shift = from.motion.v * linear.reach + a * linear.fall;
        let turn = from.motion.omega * angular.reach + alpha * angular.fall;
        let lever = from.o * time + from.motion.v * linear.fall + a * fall_summed(drag.0, time);
        let way = Way { time, shift, turn, lever };
        let mut rest = Sums::of_change(inertia, from, to);
        for (cause, acceleration, power) in acting.into_iter().filter(|(_, a, _)| *a != Motion::default()) {
            let by_fixed = Amounts::of_energy(power * time);
            let all = way.given(inertia, acceleration);
            let work = Amounts::of_energy(all.kinetic_energy) - by_fixed;
            let given = Amounts { kinetic_energy: 0.0, ..all };
            // As at an impact: the work of what presses is restitution's, its momentum the exchange's.
            let worker = if cause == Cause::Exchange { Cause::Restitution } else { cause };
            for (cause, amounts) in [(Cause::FixedBodies, by_fixed), (worker, work), (cause, given)] {
                self.book(cause, amounts);
                rest.take(amounts);
            }
        }
        self.book_rest(rest_cause, &rest);
    }
}

/// ∫C dt: the place summed over the time of a flight, per acceleration \[s³\], for a decay rate k.
pub(super) fn fall_summed(k: f64, time: f64) -> f64 {
    let y = k * time;
    if y > 0.5 {
        return (0.5 * time * time - Flight::new(k, time).fall) / k;
    }
    // t³ (1/3! − y/4! + y²/5! − …): 14 terms reach rounding for y ≤ 1/2.
    let mut term = 1.0 / 6.0;
    let mut sum = term;
    for n in 4..18 {
        term *= -y / f64::from(n);
        sum += term;
    }
    sum * time * time * time
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_of_the_fall_is_that_of_many_short_ones() {
        for k in [0.0, 0.3, 0.49, 0.51, 3.0] {
            let (steps, time) = (1_000, 1.0);
            let dt = time / f64::from(steps);
            // Simpson's rule
            let weight = |i: i32| {
                if i == 0 || i == steps {
                    1.0
                } else if i % 2 == 1 {
                    4.0
                } else {
                    2.0
                }
            };
            let sum: f64 = (0..=steps).map(|i| weight(i) * Flight::new(k, f64::from(i) * dt).fall).sum();
            assert!((fall_summed(k, time) - sum * dt / 3.0).abs() < 1e-13, "k = {k}");
        }
    }
}
