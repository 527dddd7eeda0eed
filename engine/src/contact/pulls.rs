//! What acts on each body over a step: gravity, drag, pushes.

use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::flight::Pull;
use crate::plan::FlightPlan;
use crate::push::Push;

/// The same on all mobile bodies unless some are pushed: only then is there something to be kept for each.
#[derive(Clone, Debug)]
pub(super) struct Pulls {
    is_mobile: Vec<bool>,
    on_mobile: Pull,
    each: Vec<Pull>,
    acts: bool,
}

impl Pulls {
    pub(super) fn new(bodies: &Bodies) -> Pulls {
        let is_mobile = (0..bodies.len()).map(|body| bodies.is_mobile(body)).collect();
        Pulls { is_mobile, on_mobile: Pull::NONE, each: Vec::new(), acts: false }
    }

    /// A step begins.
    pub(super) fn set(&mut self, flight: FlightPlan, pushes: &[Push], bodies: &Bodies) {
        let (a, drag) = flight.forces();
        self.on_mobile = Pull { a, alpha: 0.0, drag };
        self.acts = flight != FlightPlan::Free || !pushes.is_empty();
        self.each.clear();
        if pushes.is_empty() {
            return;
        }
        let on_mobile = self.on_mobile;
        self.each.extend(self.is_mobile.iter().map(|mobile| if *mobile { on_mobile } else { Pull::NONE }));
        for push in pushes {
            let body = push.body as usize;
            let pushed = push.acceleration(bodies.inertia[body]);
            self.each[body].a += pushed.v;
            self.each[body].alpha += pushed.omega;
        }
    }

    /// Whether anything acts on any body.
    #[inline]
    pub(super) fn act(&self) -> bool {
        self.acts
    }

    /// What acts on all mobile bodies alike, unless some are pushed.
    pub(super) fn on_all(&self) -> Option<Pull> {
        self.each.is_empty().then_some(self.on_mobile)
    }

    #[inline]
    pub(super) fn on(&self, body: usize) -> Pull {
        if self.is_mobile[body] { self.on_mobile(body) } else { Pull::NONE }
    }

    /// The same, of a body that is known to be mobile.
    #[inline(always)]
    pub(super) fn on_mobile(&self, body: usize) -> Pull {
        self.each.get(body).copied().unwrap_or(self.on_mobile)
    }

    /// Whether anything moves a body that does not move.
    #[inline]
    pub(super) fn pull(&self, body: usize) -> bool {
        let Pull { a, alpha, .. } = self.on(body);
        a != Vec2::zeros() || alpha != 0.0
    }

    /// One after the other.
    #[cfg(test)]
    pub(super) fn all(&self) -> Vec<Pull> {
        (0..self.is_mobile.len()).map(|body| self.on(body)).collect()
    }
}
