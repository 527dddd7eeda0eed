//! Pushes: forces and torques that act over one step.

use crate::area::Vec2;
use crate::bodies::{Bodies, Inertia, Motion};
use crate::forces::Flight;

/// Forces on one body, gathered until the next advance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// The body.
    pub body: u32,
    /// Sum of forces \[N\].
    pub force: Vec2,
    /// Sum of torques \[N·m\].
    pub torque: f64,
}

impl Push {
    /// What it does to a body \[m/s², rad/s²\].
    #[must_use]
    pub fn acceleration(&self, inertia: Inertia) -> Motion {
        Motion { v: self.force / inertia.mass, omega: self.torque / inertia.moment }
    }
}

/// What a constant force over the step adds to the free flight: `C·a` of way, `B·a` of velocity.
/// Free flight is linear, so it adds to gravity and drag without disturbing them.
pub fn apply_pushes(bodies: &mut Bodies, pushes: &[Push], linear: Flight, angular: Flight) {
    for push in pushes {
        let i = push.body as usize;
        let Motion { v: a, omega: alpha } = push.acceleration(bodies.inertia[i]);
        bodies.shift(i, a * linear.fall);
        if alpha != 0.0 {
            bodies.turn(i, alpha * angular.fall);
        }
        let Motion { v, omega } = bodies.motion[i];
        bodies.motion[i] = Motion { v: v + a * linear.reach, omega: omega + alpha * angular.reach };
    }
}
