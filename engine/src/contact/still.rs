//! Bodies that lie still: what was found of any two of them goes on to hold, so such pairs are not searched for again.
//!
//! A body lies still if it did not move when touches were last looked for, stands where it stood then, does not move and nothing acts
//! on it. Of two such bodies nothing changes: neither what they sweep over nor what an axis says. A pair that touches is another
//! matter, for it remembers what it pushed: a mobile body that had a touch in the last two looks counts as one that moves. So every
//! touch is found by the side of its mobile body, and pairs of bodies that lie still stay apart as they did
//! ([`Apart::keep`](super::apart::Apart::keep)).
//!
//! Nothing of this changes a result: a look at everything finds the same.

use super::pulls::Pulls;
use super::touch::Touch;
use crate::advance::Movers;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::frame::Frame;

/// A body that moves has not lain still since any look.
const NEVER: u64 = u64::MAX;

/// A touch says something of the look after it and of the one after that.
const LOOKS: u64 = 2;

/// Which bodies lie still.
#[derive(Clone, Debug, Default)]
pub(super) struct Still {
    /// How many looks there have been.
    looks: u64,
    /// By body: since which look it has not moved, and where it stands.
    since: Vec<u64>,
    frame: Vec<Frame>,
    /// By body: from which look on no touch speaks against it.
    free: Vec<u64>,
    /// By body: whether it lies still; whether any does.
    lies: Vec<bool>,
    any: bool,
    /// The look at which the last of those that lie still came to rest.
    latest: u64,
}

impl Still {
    /// Nothing that was found holds on: the next look is at everything.
    pub(super) fn forget(&mut self) {
        self.since.clear();
    }

    /// Another look is about to be taken, with the touches of the last; whether other bodies lie still than at that.
    pub(super) fn find(&mut self, bodies: &Bodies, movers: &Movers, pulls: &Pulls, before: &[Touch]) -> bool {
        self.looks += 1;
        let falls = pulls.on_all().is_some_and(|pull| pull.a != Vec2::zeros());
        let few = movers.mobile.len().pow(2) <= bodies.len();
        let rests = |body: &u32| bodies.motion[*body as usize] == Motion::default();
        if !few && (falls || !movers.mobile.iter().any(rests)) {
            self.forget();
            return self.none_lies();
        }
        self.find_at_rest(bodies, pulls);
        for body in before.iter().flat_map(|touch| [touch.a as usize, touch.b as usize]) {
            if bodies.is_mobile(body) {
                self.free[body] = self.looks + LOOKS;
            }
        }
        let (mut changed, looks) = (false, self.looks);
        (self.any, self.latest) = (false, 0);
        for ((lay, since), free) in self.lies.iter_mut().zip(&self.since).zip(&self.free) {
            let lies = (*since < looks) & (*free <= looks);
            changed |= core::mem::replace(lay, lies) != lies;
            self.any |= lies;
            self.latest = self.latest.max(if lies { *since } else { 0 });
        }
        changed
    }

    /// Finds the bodies that do not move.
    fn find_at_rest(&mut self, bodies: &Bodies, pulls: &Pulls) {
        self.since.resize(bodies.len(), NEVER);
        self.frame.resize(bodies.len(), Frame::new(Vec2::zeros(), 0.0));
        self.free.resize(bodies.len(), 0);
        self.lies.resize(bodies.len(), false);
        let lay = self.since.iter_mut().zip(&mut self.frame);
        for (body, ((motion, frame), (since, lay))) in bodies.motion.iter().zip(&bodies.frame).zip(lay).enumerate() {
            if *motion != Motion::default() || pulls.pull(body) {
                *since = NEVER;
                continue;
            }
            if *since == NEVER || *lay != *frame {
                (*since, *lay) = (self.looks, *frame);
            }
        }
    }

    fn none_lies(&mut self) -> bool {
        self.lies.fill(false);
        core::mem::take(&mut self.any)
    }

    /// How many looks there have been, this one among them.
    pub(super) fn looks(&self) -> u64 {
        self.looks
    }

    /// Whether any body lies still, and all that do lay where they lie at that look already.
    pub(super) fn lay_at(&self, look: u64) -> bool {
        self.any && self.latest <= look
    }

    #[inline]
    pub(super) fn lies(&self, body: usize) -> bool {
        self.lies.get(body).is_some_and(|lies| *lies)
    }
}
