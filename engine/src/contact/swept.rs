//! What every rectangle sweeps over a step, eight at a time.

use super::abreast::{Side, outward};
use super::acting::{Acting, Moving};
use crate::bodies::Bodies;
use crate::broad_phase::met::{Bounds, Owner};
use crate::lanes::{LANES, Wide};
use crate::width::Work;

/// Room left around rectangles, as a share of the smaller half size: what a body may be pushed within a step beyond where it
/// was going.
pub(super) const ROOM: f64 = 0.02;

/// All rectangles over a step, to be computed.
pub(super) struct SweepAll<'a> {
    pub(super) bodies: &'a Bodies,
    pub(super) acting: Acting<'a>,
    pub(super) owners: &'a [Owner],
    pub(super) dt: f64,
    /// From which rectangle on, and what is computed of those.
    pub(super) from: usize,
    pub(super) bounds: &'a mut [Bounds],
}

impl Work for SweepAll<'_> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(self) {
        let SweepAll { bodies, acting, owners, from, dt, bounds } = self;
        for first in (0..bounds.len()).step_by(LANES) {
            let lanes = Lanes::<V>::load(bodies, acting, owners, from + first);
            let count = LANES.min(bounds.len() - first);
            let [x0, z0, x1, z1] = lanes.bounds(dt);
            let zero = V::zero();
            V::scatter([x0, z0, x1, z1, zero, zero, zero, zero], |k, around| {
                let [x0, z0, x1, z1, ..] = around.0;
                if k < count {
                    bounds[first + k] = Bounds([x0, z0, x1, z1]);
                }
            });
        }
    }
}

/// Eight rectangles and their bodies' motions.
struct Lanes<V> {
    side: Side<V>,
    moving: Moving<V>,
}

impl<V: Wide> Lanes<V> {
    #[inline(always)]
    fn load(bodies: &Bodies, acting: Acting, owners: &[Owner], first: usize) -> Lanes<V> {
        let at = |k: usize| (first + k).min(owners.len() - 1);
        Lanes { side: Side::of(bodies, owners, at), moving: acting.moving(bodies, |k| owners[at(k)]) }
    }

    /// The same as [`crate::broad_phase::bounds::sweep`] with room around, to the bit.
    #[inline(always)]
    fn bounds(&self, dt: f64) -> [V; 4] {
        let (time, half) = (V::all(dt), V::all(0.5));
        let Side { o, axis, half: [hx, hz], low, high, .. } = self.side;
        let centre = outward(axis, self.side.centre);
        let (cos, sin) = (axis[0].abs(), axis[1].abs());
        let reach = [cos * hx + sin * hz, sin * hx + cos * hz];
        let (x, z) = (low[0].abs().max(high[0].abs()), low[1].abs().max(high[1].abs()));
        let radius = (x * x + z * z).root();
        let turned = (self.moving.omega.abs() + half * self.moving.angular.abs() * time) * time * radius;
        let [ax, az] = self.moving.acceleration;
        let stray = half * (ax * ax + az * az).root() * time * time;
        let room = V::all(ROOM) * hx.min(hz);
        let straight = self.moving.free.min(V::zero().at_least(self.moving.omega.abs()));
        let (mut least, mut greatest) = ([V::zero(); 2], [V::zero(); 2]);
        for k in 0..2 {
            let (low, high) = (centre[k] - reach[k], centre[k] + reach[k]);
            let low = straight.pick(low, (low - turned).max(-radius));
            let high = straight.pick(high, (high + turned).min(radius));
            let way = self.moving.v[k] * time;
            least[k] = o[k] + low + way.min(V::zero()) - stray - room;
            greatest[k] = o[k] + high + way.max(V::zero()) + stray + room;
        }
        [least[0], least[1], greatest[0], greatest[1]]
    }
}
