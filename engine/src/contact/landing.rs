//! Points about to land on a face without restitution: the sub-step is solved in two, up to that moment and from it on.
//!
//! What flies free is brought to its impact exactly ([`super::strike`]). What turns about another corner, or touches something else,
//! is not: were it solved in one, the impact would come at the end of the sub-step, and late. Only where there are few touches.

use super::Contacts;
use super::flying::FORCEFUL;
use super::rows::{Row, SPIN};
use crate::world::World;

/// So many touches are few.
const A_HANDFUL: usize = 32;

/// A moment nearer to an end of the sub-step than this share of it is that end.
const NEAR: f64 = 1e-3;

/// The moment is taken to be so much of the time sooner than foreseen: what is left of a gap is closed in the impact, but what has
/// landed already would push too early.
const EARLY: f64 = 1e-4;

impl Contacts {
    /// How long it is until the first point lands, if that is within the sub-step \[s\].
    pub(super) fn lands(&mut self, world: &World, h: f64) -> Option<f64> {
        let slow = FORCEFUL * world.plan.gravity().norm() * h;
        if self.touches.len() > A_HANDFUL || !(0..self.touches.len()).any(|k| self.may_land(k, h, slow)) {
            return None;
        }
        self.begin_flights(world, h, 1.0);
        self.fliers.foresee(&self.rows, &self.pulls, h, &mut self.mean);
        let touches = (0..self.touches.len()).filter(|k| self.may_land(*k, h, slow));
        let first = touches.map(|k| self.lands_in(k, h)).fold(f64::INFINITY, f64::min);
        (first > NEAR * h && first < (1.0 - NEAR) * h).then_some(first)
    }

    /// Whether a touch, held there or by something else, has a point that may land within the sub-step faster than that.
    fn may_land(&self, k: usize, h: f64, slow: f64) -> bool {
        let touch = &self.touches[k];
        let held = self.blocks.presses(k) || !self.is_lonely(k);
        if touch.surface.restitution > 0.0 || touch.met || !held {
            return false;
        }
        let (row_a, row_b) = self.of_touch[k];
        let (Row(a), Row(b)) = (&self.rows.rows[row_a as usize], &self.rows.rows[row_b as usize]);
        (0..touch.count as usize).filter(|p| touch.push[*p] == 0.0).any(|p| {
            let (gap, u) = touch.state(p, a, b);
            gap > self.band && u < -slow && gap + (u - slow) * h <= 0.0
        })
    }

    /// When the first point of a touch lands, or a little before: as its bodies turn, and are likely to change their motions.
    fn lands_in(&self, k: usize, h: f64) -> f64 {
        let touch = &self.touches[k];
        let (row_a, row_b) = self.of_touch[k];
        let [a, b] = [row_a, row_b].map(|row| &self.rows.rows[row as usize].0);
        let [mean_a, mean_b] = [row_a, row_b].map(|row| &self.mean[row as usize].0);
        let bent = b[SPIN] * b[SPIN] * touch.along_b - a[SPIN] * a[SPIN] * touch.along_a;
        let points = (0..touch.count as usize).filter(|p| touch.push[*p] == 0.0).map(|p| {
            let ((gap, u), (_, mean)) = (touch.state(p, a, b), touch.state(p, mean_a, mean_b));
            let bends = 2.0 * (mean - u) / h + bent;
            // gap + u t + bends t²/2 = 0
            let square = u * u - 2.0 * bends * gap;
            if gap > self.band && u < 0.0 && square >= 0.0 { 2.0 * gap / (square.sqrt() - u) } else { f64::INFINITY }
        });
        points.fold(f64::INFINITY, f64::min) * (1.0 - EARLY)
    }

    /// Whether what a touch pushed was a force: none of its bodies changed its motion by an impact.
    pub(super) fn is_force(&self, k: usize, h: f64) -> bool {
        let (a, b) = self.of_touch[k];
        [a, b].into_iter().filter_map(|row| self.rows.mobile_of(row)).all(|at| {
            let pull = self.pulls.on_mobile(self.rows.mobile[at] as usize);
            self.fliers.fliers[at].is_forced(&self.rows.of_mobile()[at].0, &pull, h)
        })
    }
}
