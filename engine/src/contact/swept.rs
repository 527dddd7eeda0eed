//! What every rectangle sweeps over a step, eight at a time.

use super::find::Acting;
use super::points::root;
use crate::bodies::Bodies;
use crate::broad_phase::met::{Bounds, Owner};
use crate::lanes::{Eight, LANES};
use crate::width::{Work, transpose};

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
    fn run<const W: usize>(self) {
        let SweepAll { bodies, acting, owners, from, dt, bounds } = self;
        for first in (0..bounds.len()).step_by(LANES) {
            let lanes = Lanes::load::<W>(bodies, acting, owners, from + first);
            let count = LANES.min(bounds.len() - first);
            let [x0, z0, x1, z1] = lanes.bounds(dt);
            let zero = Eight::ZERO;
            let around = transpose::<W>([x0, z0, x1, z1, zero, zero, zero, zero]);
            for k in 0..count {
                let [x0, z0, x1, z1, ..] = around[k].0;
                bounds[first + k] = Bounds([x0, z0, x1, z1]);
            }
        }
    }
}

/// Eight rectangles and their bodies' motions.
struct Lanes {
    o: [Eight; 2],
    cos: Eight,
    sin: Eight,
    v: [Eight; 2],
    omega: Eight,
    /// x_min, x_max, z_min, z_max.
    rect: [Eight; 4],
    /// Acceleration and angular acceleration now.
    acceleration: [Eight; 2],
    angular: Eight,
    /// 1 where the flight is uniform and without spin, else −1.
    straight: Eight,
}

impl Lanes {
    #[inline(always)]
    fn load<const W: usize>(bodies: &Bodies, acting: Acting, owners: &[Owner], first: usize) -> Lanes {
        let at: [usize; LANES] = core::array::from_fn(|k| (first + k).min(owners.len() - 1));
        let places = at.map(|at| Acting::place(&bodies.frame[owners[at].body()], &bodies.rects[at]));
        let motions = at.map(|at| acting.motion(&bodies.motion[owners[at].body()], owners[at]));
        let [x, z, cos, sin, x_min, x_max, z_min, z_max] = transpose::<W>(places);
        let [vx, vz, omega, ax, az, angular, straight, _] = transpose::<W>(motions);
        Lanes {
            o: [x, z],
            cos,
            sin,
            v: [vx, vz],
            omega,
            rect: [x_min, x_max, z_min, z_max],
            acceleration: [ax, az],
            angular,
            straight,
        }
    }

    #[inline(always)]
    fn half(&self) -> [Eight; 2] {
        let half = Eight::all(0.5);
        let [x_min, x_max, z_min, z_max] = self.rect;
        [half * (x_max - x_min), half * (z_max - z_min)]
    }

    /// The middle of each rectangle, from its body's centre, along the world's axes.
    #[inline(always)]
    fn centre(&self) -> [Eight; 2] {
        let half = Eight::all(0.5);
        let [x_min, x_max, z_min, z_max] = self.rect;
        let (x, z) = (half * (x_min + x_max), half * (z_min + z_max));
        [self.cos * x - self.sin * z, self.sin * x + self.cos * z]
    }

    /// The same as [`crate::broad_phase::bounds::sweep`] with room around, to the bit.
    #[inline(always)]
    fn bounds(&self, dt: f64) -> [Eight; 4] {
        let (time, half) = (Eight::all(dt), Eight::all(0.5));
        let ([hx, hz], centre) = (self.half(), self.centre());
        let (cos, sin) = (self.cos.abs(), self.sin.abs());
        let reach = [cos * hx + sin * hz, sin * hx + cos * hz];
        let [x_min, x_max, z_min, z_max] = self.rect;
        let (x, z) = (x_min.abs().max(x_max.abs()), z_min.abs().max(z_max.abs()));
        let radius = root(x * x + z * z);
        let turned = (self.omega.abs() + half * self.angular.abs() * time) * time * radius;
        let [ax, az] = self.acceleration;
        let stray = half * root(ax * ax + az * az) * time * time;
        let room = Eight::all(ROOM) * hx.min(hz);
        let (mut least, mut greatest) = ([Eight::ZERO; 2], [Eight::ZERO; 2]);
        for k in 0..2 {
            let (low, high) = (centre[k] - reach[k], centre[k] + reach[k]);
            let low = self.straight.pick(low, (low - turned).max(-radius));
            let high = self.straight.pick(high, (high + turned).min(radius));
            let way = self.v[k] * time;
            least[k] = self.o[k] + low + way.min(Eight::ZERO) - stray - room;
            greatest[k] = self.o[k] + high + way.max(Eight::ZERO) + stray + room;
        }
        [least[0], least[1], greatest[0], greatest[1]]
    }
}
