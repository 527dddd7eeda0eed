//! Prescribed motion of fixed bodies: where a patrol or a swing stands at a given time, in closed form.
//!
//! Evaluated from the time, never summed up, so a door is as punctual after a million iterations as after one.

use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::scene;

/// One body's prescription: a course for its place, a swing for its angle, or both.
#[derive(Clone, Debug)]
pub struct Prescription {
    /// The body.
    pub body: usize,
    /// Where it travels; its spin, if any, goes on beside.
    pub course: Option<Course>,
    /// How it swings; its velocity, if any, goes on beside.
    pub swing: Option<Swing>,
}

impl Prescription {
    /// The first time after this one at which the body turns a corner or swings back; infinite if never.
    #[must_use]
    pub fn next_turn(&self, time: f64) -> f64 {
        let corner = self.course.as_ref().map_or(f64::INFINITY, |course| course.next_turn(time));
        let end = self.swing.as_ref().map_or(f64::INFINITY, |swing| swing.next_turn(time));
        corner.min(end)
    }

    /// Sets the body's place and angle to those prescribed for the time, and its motion to that which it has from then
    /// until the next turn: read halfway, so that no rounding at a corner can give that of the leg before.
    pub fn apply_until(&self, bodies: &mut Bodies, time: f64, next: f64) {
        let halfway = if next.is_finite() { time + 0.5 * (next - time) } else { time };
        if let Some(course) = &self.course {
            bodies.place(self.body, course.at(time).0);
            bodies.motion[self.body].v = course.at(halfway).1;
        }
        if let Some(swing) = &self.swing {
            bodies.set_angle(self.body, swing.at(time).0);
            bodies.motion[self.body].omega = swing.at(halfway).1;
        }
    }

    /// Sets the body's place, angle and motion to those prescribed for the time.
    pub fn apply(&self, bodies: &mut Bodies, time: f64) {
        if let Some(course) = &self.course {
            let (place, velocity) = course.at(time);
            bodies.place(self.body, place);
            bodies.motion[self.body].v = velocity;
        }
        if let Some(swing) = &self.swing {
            let (angle, omega) = swing.at(time);
            bodies.set_angle(self.body, angle);
            bodies.motion[self.body] = Motion { omega, ..bodies.motion[self.body] };
        }
    }
}

/// A closed polygon travelled at uniform speed.
#[derive(Clone, Debug)]
pub struct Course {
    legs: Vec<Leg>,
    length: f64,
    speed: f64,
}

/// One side of the polygon: where it begins, which way it runs, and how far along the trip that is.
#[derive(Clone, Copy, Debug)]
struct Leg {
    from: Vec2,
    direction: Vec2,
    begins: f64,
}

impl Course {
    /// The trip from `start` through the points and back; `None` when it goes nowhere.
    #[must_use]
    pub fn new(start: Vec2, points: &[Vec2], speed: f64) -> Option<Self> {
        let mut legs = Vec::with_capacity(points.len() + 1);
        let (mut from, mut length) = (start, 0.0);
        for to in points.iter().copied().chain([start]) {
            let way = to - from;
            let distance = (way.x * way.x + way.y * way.y).sqrt();
            if distance > 0.0 {
                legs.push(Leg { from, direction: way / distance, begins: length });
                length += distance;
            }
            from = to;
        }
        (length > 0.0).then_some(Course { legs, length, speed })
    }

    /// The first time after this one at which a leg ends.
    fn next_turn(&self, time: f64) -> f64 {
        let round = self.length / self.speed;
        let begun = libm::floor(time / round);
        let ends = |lap: f64| {
            let corners = self.legs.iter().skip(1).map(|leg| leg.begins).chain([self.length]);
            corners.map(move |corner| lap * round + corner / self.speed)
        };
        first_after(time, ends(begun - 1.0).chain(ends(begun)).chain(ends(begun + 1.0)))
    }

    /// Place and velocity at a time; at a corner already the velocity of the leg that begins there.
    #[must_use]
    pub fn at(&self, time: f64) -> (Vec2, Vec2) {
        let along = libm::fmod(self.speed * time, self.length);
        let leg = self.legs[self.legs.partition_point(|leg| leg.begins <= along) - 1];
        (leg.from + leg.direction * (along - leg.begins), leg.direction * self.speed)
    }
}

/// A triangle wave about a middle angle.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    middle: f64,
    amplitude: f64,
    period: f64,
}

impl Swing {
    /// The swing of a body that starts at the middle.
    #[must_use]
    pub fn new(middle: f64, swing: scene::Swing) -> Self {
        Swing { middle, amplitude: swing.angle, period: swing.period }
    }

    /// The first time after this one at which it swings back.
    fn next_turn(&self, time: f64) -> f64 {
        let begun = libm::floor(time / self.period);
        let turns =
            [-1.0, 0.0, 1.0].into_iter().flat_map(|k| [0.25, 0.75].map(|part| (begun + k + part) * self.period));
        first_after(time, turns)
    }

    /// Angle and spin at a time; at a turning point already the spin of the way back.
    #[must_use]
    pub fn at(&self, time: f64) -> (f64, f64) {
        let quarter = 4.0 * (libm::fmod(time, self.period) / self.period); // 0 … 4
        let rate = 4.0 * self.amplitude / self.period;
        let (wave, spin) = match quarter {
            q if q < 1.0 => (q, rate),
            q if q < 3.0 => (2.0 - q, -rate),
            q => (q - 4.0, rate),
        };
        (self.middle + self.amplitude * wave, spin)
    }
}

/// The first of some times, in order, that is after another by more than rounding: the turn that it is already at is past.
fn first_after(time: f64, mut times: impl Iterator<Item = f64>) -> f64 {
    times.find(|turn| *turn > time + 4.0 * f64::EPSILON * time.abs()).unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_patrol_comes_round_and_turns_its_corners() {
        let course = Course::new(Vec2::new(0.0, 0.0), &[Vec2::new(3.0, 0.0), Vec2::new(3.0, 4.0)], 2.0)
            .expect("it has a length");
        assert_eq!(course.length, 12.0); // 3 + 4 + 5
        assert_eq!(course.at(1.0), (Vec2::new(2.0, 0.0), Vec2::new(2.0, 0.0)));
        assert_eq!(course.at(1.5), (Vec2::new(3.0, 0.0), Vec2::new(0.0, 2.0)));
        let (place, velocity) = course.at(6.0 + 4.75); // 2.5 m into the way back, a round later
        assert!((place - Vec2::new(1.5, 2.0)).norm() < 1e-15);
        assert!((velocity - Vec2::new(-1.2, -1.6)).norm() < 1e-15);
    }

    #[test]
    fn a_swing_turns_at_its_ends() {
        let swing = Swing::new(1.0, scene::Swing { angle: 0.5, period: 4.0 });
        let expected = [(0.0, 1.0, 0.5), (0.5, 1.25, 0.5), (1.0, 1.5, -0.5), (3.0, 0.5, 0.5), (4.0, 1.0, 0.5)];
        for (time, angle, spin) in expected {
            assert_eq!(swing.at(time), (angle, spin), "at {time} s");
        }
    }
}
