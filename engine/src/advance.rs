//! Advance (§2.1): every body that moves goes on by one time step.

use crate::area::Vec2;
use crate::bodies::{Bodies, Motion, Role, shift, turn};
use crate::flight::{Pull, turned};
use crate::forces::Flight;
use crate::frame::Frame;
use crate::plan::FlightPlan;
use crate::prescribed::Prescription;
use crate::threads::{PER_THREAD, Threads};
use crate::work::Work;

/// Which bodies move, by the way they move; a scene without one sort has an empty list.
#[derive(Clone, Debug, Default)]
pub struct Movers {
    /// Mobile bodies: they fly, under the scene's forces.
    pub mobile: Vec<u32>,
    /// Fixed bodies with physics: they keep their motion, forces do not reach them.
    pub fixed: Vec<u32>,
    /// Fixed bodies whose motion follows from the time.
    pub prescribed: Vec<Prescription>,
}

impl Movers {
    /// Sorts the bodies by the way they move.
    #[must_use]
    pub fn new(bodies: &Bodies, prescribed: Vec<Prescription>) -> Self {
        let those = |role| {
            let with_role = bodies.role.iter().enumerate().filter(move |(_, r)| **r == role);
            with_role.map(|(i, _)| i as u32).collect()
        };
        Movers { mobile: those(Role::Mobile), fixed: those(Role::FixedWithPhysics), prescribed }
    }

    /// A fixed body that has been given a motion moves from now on.
    pub fn add_fixed(&mut self, body: u32) {
        if let Err(at) = self.fixed.binary_search(&body) {
            self.fixed.insert(at, body);
        }
    }

    /// A body whose velocity was written no longer follows its course.
    pub fn end_course(&mut self, body: usize) {
        for prescription in self.prescribed.iter_mut().filter(|p| p.body == body) {
            prescription.course = None;
        }
    }

    /// A body whose spin was written no longer follows its swing.
    pub fn end_swing(&mut self, body: usize) {
        for prescription in self.prescribed.iter_mut().filter(|p| p.body == body) {
            prescription.swing = None;
        }
    }
}

/// Moves every mover to its place at `time`, the end of the step.
///
/// Returns the first body found to have left the finite numbers, if one did.
pub fn advance(
    bodies: &mut Bodies,
    movers: &Movers,
    flight: FlightPlan,
    dt: f64,
    time: f64,
    work: &mut Work,
) -> Option<usize> {
    let lost_mobile = match flight {
        FlightPlan::Free => drift(bodies, &movers.mobile, dt),
        FlightPlan::Forced { gravity, linear, angular, .. } => {
            work.bodies_forced += movers.mobile.len() as u64;
            fly(bodies, &movers.mobile, gravity, linear, angular)
        }
    };
    let lost_fixed = drift(bodies, &movers.fixed, dt);
    for prescription in &movers.prescribed {
        prescription.apply(bodies, time);
    }
    work.bodies_advanced += (movers.mobile.len() + movers.fixed.len()) as u64;
    work.prescribed += movers.prescribed.len() as u64;
    lost_mobile.or(lost_fixed)
}

/// So many bodies for a thread are worth being brought from one processor to the other, to be moved and no more.
const MANY: usize = 8 * PER_THREAD;

/// The same for bodies that nothing touches, each under what acts on it, shared by threads; those on a course are left out.
pub(crate) fn advance_alone(
    bodies: &mut Bodies,
    movers: &Movers,
    (flight, dt): (FlightPlan, f64),
    pulls: Option<&(impl Fn(usize) -> Pull + Sync)>,
    touched: impl Fn(u32) -> bool + Sync,
    (threads, work): (&Threads, &mut Work),
) -> Option<usize> {
    let (_, drag) = flight.forces();
    let (linear, angular) = (Flight::new(drag.0, dt), Flight::new(drag.1, dt));
    let Bodies { frame, lost, angle, motion, role, .. } = &mut *bodies;
    let columns = ((&mut frame[..], &mut lost[..]), (&mut angle[..], &mut motion[..]));
    let lost = threads.each(columns, (1, MANY), |from, ((frame, lost), (angle, motion))| {
        let mut gone = None;
        for k in 0..frame.len() {
            let i = from + k;
            if role[i] != Role::Mobile || touched(i as u32) {
                continue;
            }
            let Motion { v, omega } = motion[k];
            let Pull { a, alpha, .. } = pulls.map_or(Pull::NONE, |on| on(i));
            shift((&mut frame[k], &mut lost[k]), v * linear.reach + a * linear.fall);
            if omega != 0.0 || alpha != 0.0 {
                turn((&mut frame[k], &mut angle[k]), omega * angular.reach + alpha * angular.fall);
            }
            if pulls.is_some() {
                let v = v * linear.keep + a * linear.reach;
                motion[k] = Motion { v, omega: omega * angular.keep + alpha * angular.reach };
            }
            if !stands(&frame[k]) {
                gone = gone.or(Some(i));
            }
        }
        gone
    });
    work.bodies_advanced += (movers.mobile.len() + movers.fixed.len()) as u64;
    if flight != FlightPlan::Free {
        work.bodies_forced += movers.mobile.len() as u64;
    }
    lost.into_iter().flatten().next().or(drift(bodies, &movers.fixed, dt))
}

/// `O += v·dt`, `θ += ω·dt`.
fn drift(bodies: &mut Bodies, movers: &[u32], dt: f64) -> Option<usize> {
    let mut lost = None;
    for &i in movers {
        let i = i as usize;
        let Motion { v, omega } = bodies.motion[i];
        bodies.shift(i, v * dt);
        if omega != 0.0 {
            bodies.turn(i, omega * dt);
        }
        if !is_finite(bodies, i) {
            lost = lost.or(Some(i));
        }
    }
    lost
}

/// The exact solution of `v̇ = g − k v` over the step (see [`crate::forces`]); spin decays likewise.
fn fly(bodies: &mut Bodies, movers: &[u32], gravity: Vec2, linear: Flight, angular: Flight) -> Option<usize> {
    let mut lost = None;
    for &i in movers {
        let i = i as usize;
        let Motion { v, omega } = bodies.motion[i];
        bodies.shift(i, v * linear.reach + gravity * linear.fall);
        if omega != 0.0 {
            bodies.turn(i, omega * angular.reach);
        }
        bodies.motion[i] = Motion { v: v * linear.keep + gravity * linear.reach, omega: omega * angular.keep };
        if !is_finite(bodies, i) {
            lost = lost.or(Some(i));
        }
    }
    lost
}

/// Where a body stood before the step that gave it the motion it has: exact for uniform flight and under gravity and
/// drag; pushes and the corners of a course are left aside. A motion that came out of nothing (drag took all) gives no place.
#[must_use]
pub fn frame_before(bodies: &Bodies, flight: FlightPlan, dt: f64, body: usize) -> Frame {
    let (frame, Motion { v, omega }) = (bodies.frame[body], bodies.motion[body]);
    let (shift, turn) = match flight {
        FlightPlan::Forced { gravity, linear, angular, .. } if bodies.is_mobile(body) => {
            let v_before = (v - gravity * linear.reach) / linear.keep;
            (v_before * linear.reach + gravity * linear.fall, omega / angular.keep * angular.reach)
        }
        FlightPlan::Free | FlightPlan::Forced { .. } => (v * dt, omega * dt),
    };
    let before = turned(&frame, frame.o - shift, -turn);
    if before.o.x.is_finite() & before.o.y.is_finite() & before.cos.is_finite() { before } else { frame }
}

/// Whether place and angle are still numbers; motion that is not shows up in them a step later at most.
#[inline]
pub fn is_finite(bodies: &Bodies, i: usize) -> bool {
    stands(&bodies.frame[i])
}

/// Whether a place and a direction are numbers.
#[inline]
pub(crate) fn stands(frame: &Frame) -> bool {
    frame.o.x.is_finite() & frame.o.y.is_finite() & frame.cos.is_finite()
}
