//! How bodies move when a step begins and what acts on them over it, some side by side.

use super::pulls::Pulls;
use crate::bodies::{Bodies, Motion};
use crate::broad_phase::met::Owner;
use crate::flight::Pull;
use crate::lanes::Numbers;

/// What acts on the bodies over a step.
#[derive(Clone, Copy)]
pub(super) struct Acting<'a> {
    pulls: &'a Pulls,
    /// The same on all mobile bodies, unless some are pushed: then nothing has to be read for each.
    on_all: Option<Pull>,
}

/// How bodies move, one in every lane.
#[derive(Clone, Copy)]
pub(super) struct Moving<V> {
    pub(super) v: [V; 2],
    pub(super) omega: V,
    /// Acceleration and angular acceleration now.
    pub(super) acceleration: [V; 2],
    pub(super) angular: V,
    /// 1 where nothing acts on it, else −1.
    pub(super) free: V,
}

impl<'a> Acting<'a> {
    pub(super) fn new(pulls: &'a Pulls) -> Self {
        Acting { pulls, on_all: pulls.on_all() }
    }

    /// How bodies move, one in every lane.
    #[inline(always)]
    pub(super) fn moving<V: Numbers>(&self, bodies: &Bodies, owner: impl Fn(usize) -> Owner) -> Moving<V> {
        let [vx, vz, omega, mobile] = V::columns(|k| {
            let Motion { v, omega } = bodies.motion[owner(k).body()];
            [v.x, v.y, omega, if owner(k).is_mobile() { 1.0 } else { -1.0 }]
        });
        let [ax, az, alpha, drag, drag_of_spin] = match self.on_all {
            Some(Pull { a, alpha, drag }) => [
                mobile.pick(V::all(a.x), V::zero()),
                mobile.pick(V::all(a.y), V::zero()),
                mobile.pick(V::all(alpha), V::zero()),
                mobile.pick(V::all(drag.0), V::zero()),
                mobile.pick(V::all(drag.1), V::zero()),
            ],
            None => {
                let on = |k| self.pulls.on(owner(k).body());
                let [ax, az, alpha, _] = V::columns(|k| [on(k).a.x, on(k).a.y, on(k).alpha, 0.0]);
                let [drag, drag_of_spin, ..] = V::columns(|k| [on(k).drag.0, on(k).drag.1, 0.0, 0.0]);
                [ax, az, alpha, drag, drag_of_spin]
            }
        };
        let on_any = ax.abs() + az.abs() + alpha.abs() + drag + drag_of_spin;
        Moving {
            v: [vx, vz],
            omega,
            acceleration: [ax - vx * drag, az - vz * drag],
            angular: alpha - omega * drag_of_spin,
            free: V::zero().at_least(on_any),
        }
    }
}
