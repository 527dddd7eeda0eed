//! How a body flies between impacts: one exact solution, good for any time.

use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::forces::Flight;
use crate::frame::Frame;
use crate::trig::sin_cos;

/// What acts on a body while it flies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// Acceleration of its centre, without drag \[m/s²\].
    pub a: Vec2,
    /// Angular acceleration, without drag \[rad/s²\].
    pub alpha: f64,
    /// Decay rates of velocity and of spin, ≥ 0 \[1/s\].
    pub drag: (f64, f64),
}

impl Pull {
    /// Nothing: uniform flight.
    pub const NONE: Pull = Pull { a: Vec2::new(0.0, 0.0), alpha: 0.0, drag: (0.0, 0.0) };

    /// What acts on a body; `pulls` may be empty when nothing acts on any.
    #[inline]
    #[must_use]
    pub fn on(pulls: &[Pull], body: usize) -> Pull {
        if pulls.is_empty() { Pull::NONE } else { pulls[body] }
    }

    /// What a time comes to for the centre, and for turning.
    #[inline]
    #[must_use]
    pub fn flights(&self, time: f64) -> (Flight, Flight) {
        let of = |drag, pulled: bool| if pulled { Flight::new(drag, time) } else { Flight::slowed(drag, time) };
        (of(self.drag.0, self.a.x != 0.0 || self.a.y != 0.0), of(self.drag.1, self.alpha != 0.0))
    }

    /// Whether flight is uniform.
    #[inline]
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.a.x == 0.0 && self.a.y == 0.0 && self.alpha == 0.0 && self.drag.0 == 0.0 && self.drag.1 == 0.0
    }
}

/// Where a body is at one moment, how it moves, and what acts on it from then on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Where it stands at time 0.
    pub frame: Frame,
    /// How it moves at time 0.
    pub motion: Motion,
    /// What acts on it.
    pub pull: Pull,
}

/// What a flight over some time changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Displacement of the centre \[m\].
    pub shift: Vec2,
    /// Angle turned \[rad\].
    pub turn: f64,
    /// The motion at its end.
    pub motion: Motion,
}

impl Path {
    /// A body as it flies from where it stands; `pulls` may be empty when nothing acts on any.
    #[inline]
    #[must_use]
    pub fn of(bodies: &Bodies, pulls: &[Pull], body: usize) -> Path {
        Path { frame: bodies.frame[body], motion: bodies.motion[body], pull: Pull::on(pulls, body) }
    }

    /// A bound on how far points of two bodies come towards each other within a time \[m\]: sure and quick, not sharp. The
    /// bodies' points are no further from their centres than the radii.
    #[inline]
    #[must_use]
    pub fn closing(&self, other: &Path, radius: f64, other_radius: f64, time: f64) -> f64 {
        let u = other.motion.v - self.motion.v;
        let speed = u.x.abs() + u.y.abs() + self.motion.omega.abs() * radius + other.motion.omega.abs() * other_radius;
        if self.pull.is_none() && other.pull.is_none() {
            return speed * time;
        }
        let pulled = self.acceleration().abs().sum() + other.acceleration().abs().sum();
        let spun = self.angular_acceleration().abs() * radius + other.angular_acceleration().abs() * other_radius;
        (speed + 0.5 * (pulled + spun) * time) * time
    }

    /// The acceleration of its centre now; drag only makes it smaller later, in the same direction \[m/s²\].
    #[inline]
    #[must_use]
    pub fn acceleration(&self) -> Vec2 {
        self.pull.a - self.motion.v * self.pull.drag.0
    }

    /// Its angular acceleration now; drag only makes it smaller later \[rad/s²\].
    #[inline]
    #[must_use]
    pub fn angular_acceleration(&self) -> f64 {
        self.pull.alpha - self.motion.omega * self.pull.drag.1
    }

    /// What a flight of that length changes.
    #[inline]
    #[must_use]
    pub fn change(&self, time: f64) -> Change {
        let Motion { v, omega } = self.motion;
        if self.pull.is_none() {
            return Change { shift: v * time, turn: omega * time, motion: self.motion };
        }
        self.change_by(self.pull.flights(time))
    }

    /// The same with what the time comes to worked out already ([`Pull::flights`]).
    #[inline]
    #[must_use]
    pub fn change_by(&self, (linear, angular): (Flight, Flight)) -> Change {
        let (Motion { v, omega }, Pull { a, alpha, .. }) = (self.motion, self.pull);
        Change {
            shift: v * linear.reach + a * linear.fall,
            turn: omega * angular.reach + alpha * angular.fall,
            motion: Motion {
                v: v * linear.keep + a * linear.reach,
                omega: omega * angular.keep + alpha * angular.reach,
            },
        }
    }

    /// The same body later. The rotation is composed with the whole angle turned since time 0, so that nothing depends
    /// on how often it is asked.
    #[inline]
    #[must_use]
    pub fn after(&self, time: f64) -> Path {
        let Change { shift, turn, motion } = self.change(time);
        Path { frame: turned(&self.frame, self.frame.o + shift, turn), motion, pull: self.pull }
    }
}

/// The frame at another place, turned on by an angle.
#[inline]
#[must_use]
pub fn turned(frame: &Frame, o: Vec2, turn: f64) -> Frame {
    if turn == 0.0 {
        return Frame { o, ..*frame };
    }
    let (sin, cos) = if turn.abs() <= core::f64::consts::PI { sin_cos(turn) } else { libm::sincos(turn) };
    let Frame { cos: c, sin: s, .. } = *frame;
    Frame { o, cos: c * cos - s * sin, sin: s * cos + c * sin }
}
