//! Eight pairs of rectangles looked at side by side: the touch of each, or that there is none, to the same bits as
//! [`Touch::find`] one after the other.
//!
//! What is rare is left to that: pairs deep in each other that did not touch a step ago, pairs at a seam, pairs whose best face is
//! passed by.

use super::find::Acting;
use super::swept::ROOM;
use super::touch::{FAR, Touch};
use crate::bodies::Bodies;
use crate::broad_phase::met::Owner;
use crate::detect::Face;
use crate::detect::complete::PREFERENCE;
use crate::detect::manifold::Placed;
use crate::detect::near::{DEEP, LOYALTY};
use crate::detect::sides::ALONG;
use crate::lanes::{Eight, LANES};
use crate::width::transpose;

/// Two numbers along x and z, in every lane.
pub(super) type Pair = [Eight; 2];

/// A yes or no in every lane: 1 or −1, for [`Eight::pick`].
pub(super) type Flag = Eight;

/// The rectangles of eight pairs on one side, their bodies and how those move.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub(super) o: Pair,
    pub(super) axis: Pair,
    /// Half sizes, and the middle in the body's frame.
    pub(super) half: Pair,
    centre: Pair,
    /// From x_min, z_min to x_max, z_max.
    pub(super) low: Pair,
    pub(super) high: Pair,
    far: Eight,
    v: Pair,
    omega: Eight,
    /// Acceleration and angular acceleration now.
    acceleration: Pair,
    angular: Eight,
}

impl Side {
    #[inline(always)]
    pub(super) fn of<const W: usize>(bodies: &Bodies, acting: Acting, placed: &[(Placed, Owner); LANES]) -> Side {
        let places = placed.map(|(Placed { frame, rect, .. }, _)| Acting::place(frame, rect));
        let motions = placed.map(|(Placed { body, .. }, owner)| acting.motion(&bodies.motion[body], owner));
        let [x, z, cos, sin, x_min, x_max, z_min, z_max] = transpose::<W>(places);
        let [vx, vz, omega, ax, az, angular, ..] = transpose::<W>(motions);
        let (o, axis, low, high) = ([x, z], [cos, sin], [x_min, z_min], [x_max, z_max]);
        let (v, acceleration) = ([vx, vz], [ax, az]);
        let middle = Eight::all(0.5);
        let half = [middle * (high[0] - low[0]), middle * (high[1] - low[1])];
        let centre = [middle * (low[0] + high[0]), middle * (low[1] + high[1])];
        let far = low[0].abs().max(high[0].abs()) + low[1].abs().max(high[1].abs());
        Side { o, axis, half, centre, low, high, far, v, omega, acceleration, angular }
    }
}

impl Side {
    /// How fast the middle of the rectangle moves.
    #[inline(always)]
    fn middle_moves(&self) -> Pair {
        let [x, z] = outward(self.axis, self.centre);
        [self.v[0] - self.omega * z, self.v[1] + self.omega * x]
    }

    /// 0 where the body stands still and nothing acts on it.
    #[inline(always)]
    fn moves(&self) -> Eight {
        let sum = |of: Pair| of[0].abs() + of[1].abs();
        sum(self.v) + sum(self.acceleration) + self.omega.abs() + self.angular.abs()
    }
}

#[inline(always)]
pub(super) fn outward([cos, sin]: Pair, [x, z]: Pair) -> Pair {
    [cos * x - sin * z, sin * x + cos * z]
}

#[inline(always)]
pub(super) fn inward([cos, sin]: Pair, [x, z]: Pair) -> Pair {
    [cos * x + sin * z, cos * z - sin * x]
}

#[inline(always)]
pub(super) fn add(a: Pair, b: Pair) -> Pair {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
pub(super) fn sub(a: Pair, b: Pair) -> Pair {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
pub(super) fn times(a: Pair, by: Eight) -> Pair {
    [a[0] * by, a[1] * by]
}

#[inline(always)]
pub(super) fn cross(a: Pair, b: Pair) -> Eight {
    a[0] * b[1] - a[1] * b[0]
}

#[inline(always)]
pub(super) fn pick(flag: Flag, yes: Pair, no: Pair) -> Pair {
    [flag.pick(yes[0], no[0]), flag.pick(yes[1], no[1])]
}

/// Whether each is less than the other, and not.
#[inline(always)]
pub(super) fn less(a: Eight, b: Eight) -> Flag {
    let mut out = Eight::all(-1.0);
    for k in 0..LANES {
        out.0[k] = if a.0[k] < b.0[k] { 1.0 } else { -1.0 };
    }
    out
}

#[inline(always)]
pub(super) fn at_least(a: Eight, b: Eight) -> Flag {
    let mut out = Eight::all(-1.0);
    for k in 0..LANES {
        out.0[k] = if a.0[k] >= b.0[k] { 1.0 } else { -1.0 };
    }
    out
}

/// One body's frame and rectangle as seen from another's.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    pub(super) o: Pair,
    pub(super) axis: Pair,
    /// The rectangle's middle from the other's, and the overlaps along the other's x and z.
    pub(super) d: Pair,
    pub(super) depth: Pair,
}

impl Seen {
    #[inline(always)]
    fn from(owner: &Side, reference: &Side) -> Seen {
        let o = inward(reference.axis, sub(owner.o, reference.o));
        let ([c, s], [cos, sin]) = (owner.axis, reference.axis);
        let axis = [c * cos + s * sin, s * cos - c * sin];
        let d = sub(add(o, outward(axis, owner.centre)), reference.centre);
        let (cos, sin) = (axis[0].abs(), axis[1].abs());
        let (half, reach) = (reference.half, owner.half);
        let x = half[0] + (cos * reach[0] + sin * reach[1]) - d[0].abs();
        let z = half[1] + (sin * reach[0] + cos * reach[1]) - d[1].abs();
        Seen { o, axis, d, depth: [x, z] }
    }

    #[inline(always)]
    pub(super) fn place(&self, point: Pair) -> Pair {
        add(self.o, outward(self.axis, point))
    }
}

/// The face touched in every pair, chosen.
#[derive(Clone, Copy)]
pub(super) struct Best {
    /// The overlap less what speaks for the face; and without that.
    favoured: Eight,
    pub(super) depth: Eight,
    pub(super) of_first: Flag,
    pub(super) across_x: Flag,
    pub(super) positive: Flag,
}

/// How eight pairs touched a step ago, 0 of those that did not.
#[derive(Clone, Copy)]
pub(super) struct Loyal {
    touched: Eight,
    /// Those that do not bounce: what came to touch goes on touching, or does so again soon.
    pub(super) stays: Flag,
    of_first: Flag,
    across_x: Flag,
    positive: Flag,
    /// From the first rectangle to the second.
    normal: Pair,
}

impl Loyal {
    #[inline(always)]
    pub(super) fn of(last: &[Option<&Touch>; LANES]) -> Loyal {
        let zero = Eight::ZERO;
        let mut loyal = Loyal { touched: zero, stays: Eight::all(-1.0), of_first: zero, across_x: zero, positive: zero, normal: [zero; 2] };
        let flag = |yes: bool| if yes { 1.0 } else { -1.0 };
        for k in 0..LANES {
            let Some(last) = last[k] else { continue };
            loyal.touched.0[k] = 1.0;
            loyal.stays.0[k] = flag(last.surface.restitution == 0.0);
            loyal.of_first.0[k] = flag(last.of_first);
            loyal.across_x.0[k] = flag(matches!(last.face, Face::XMax | Face::XMin));
            loyal.positive.0[k] = flag(last.face.is_positive());
            let normal = if last.of_first { last.n } else { -last.n };
            (loyal.normal[0].0[k], loyal.normal[1].0[k]) = (normal.x, normal.y);
        }
        loyal
    }
}

/// Eight pairs under look, the earlier created on the first side.
pub(super) struct Abreast {
    pub(super) one: Side,
    pub(super) two: Side,
    /// The first as seen from the second, and the other way round.
    pub(super) one_seen: Seen,
    pub(super) two_seen: Seen,
    pub(super) margin: Eight,
    depth: Eight,
}

impl Abreast {
    #[inline(always)]
    pub(super) fn new(one: Side, two: Side, dt: f64) -> Abreast {
        let (one_seen, two_seen) = (Seen::from(&one, &two), Seen::from(&two, &one));
        let least = |a: Eight, b: Eight| a.min(b);
        let depth = least(least(two_seen.depth[0], two_seen.depth[1]), least(one_seen.depth[0], one_seen.depth[1]));
        Abreast { margin: margin(&one, &two, dt), one, two, one_seen, two_seen, depth }
    }

    /// Which pairs may touch at all.
    #[inline(always)]
    pub(super) fn may(&self) -> Flag {
        at_least(self.depth, -self.margin)
    }

    /// Which pairs stay apart for a time unless something is done to their bodies: an axis holds them apart in spite of all that
    /// they move and turn, whether or not what pulls at them is held by others; or they touch, and stand as still as can be.
    #[inline(always)]
    pub(super) fn stay_apart(&self, dt: f64) -> Flag {
        let (one, two) = (&self.one, &self.two);
        let room = self.room(&self.two_seen, one, two, dt).max(self.room(&self.one_seen, two, one, dt));
        let still = at_least(Eight::ZERO, one.moves() + two.moves());
        let no_deeper = at_least(Eight::all(super::TOUCHING) * self.small(), self.depth);
        less(Eight::ZERO, room).max(still.min(no_deeper))
    }

    /// The least gap within a time along one of the reference's axes, as it points when the time begins, whichever is wider.
    ///
    /// Corners move along arcs: in a straight line, but for half of ω² r t². Along an axis, the deepest of straight lines is deepest
    /// at one of the ends.
    #[inline(always)]
    fn room(&self, seen: &Seen, reference: &Side, other: &Side, dt: f64) -> Eight {
        let (time, half) = (Eight::all(dt), Eight::all(0.5));
        let bent = |of: &Side| (of.omega * of.omega + of.angular.abs()) * of.far;
        let bent = half * (bent(reference) + bent(other)) * time * time;
        let u = inward(reference.axis, sub(other.middle_moves(), reference.middle_moves()));
        let pulled = |of: &Side| inward(reference.axis, of.acceleration).map(Eight::abs);
        let pulled = add(pulled(reference), pulled(other));
        let [c, s] = seen.axis;
        // The other's x and z axes along the reference's, and turned on by the end.
        let turn = other.omega * time;
        let after = [[c - turn * s, -s - turn * c], [s + turn * c, c - turn * s]];
        let spun = reference.omega.abs() * time;
        let room = |k: usize| {
            let end = seen.d[k] + u[k] * time;
            let end = seen.d[k].pick(end, -end);
            let reach = reference.half[k]
                + spun * reference.half[1 - k]
                + (other.half[0] * after[k][0].abs() + other.half[1] * after[k][1].abs());
            (end - reach).min(-seen.depth[k]) - half * pulled[k] * time * time
        };
        room(0).max(room(1)) - bent
    }

    /// Which pairs are so deep in each other that it matters how they came.
    #[inline(always)]
    pub(super) fn deep(&self) -> Flag {
        less(Eight::all(DEEP) * self.small(), self.depth)
    }

    #[inline(always)]
    pub(super) fn small(&self) -> Eight {
        let (one, two) = (self.one.half, self.two.half);
        one[0].min(one[1]).min(two[0].min(two[1]))
    }

    /// Which of the four ways lead where pairs came from, at least in part, and which lead against that and are to be turned round.
    #[inline(always)]
    fn came(&self, loyal: &Loyal) -> [(Flag, Flag); 4] {
        core::array::from_fn(|k| {
            let ([cos, sin], seen) = if k < 2 { (self.one.axis, &self.two_seen) } else { (self.two.axis, &self.one_seen) };
            let axis = if k % 2 == 0 { [cos, sin] } else { [-sin, cos] };
            let along = axis[0] * loyal.normal[0] + axis[1] * loyal.normal[1];
            let positive = at_least(seen.d[k % 2], Eight::ZERO);
            let share = if k < 2 { positive * along } else { -(positive * along) };
            (less(Eight::all(ALONG), share.abs()), less(share, Eight::ZERO))
        })
    }

    /// The way of least overlap or widest gap, the first of equals, with something in favour of the one taken before. Pairs deep
    /// in each other go apart the way they came, where any way leads there.
    #[inline(always)]
    pub(super) fn best(&self, loyal: &Loyal, deep: Flag) -> Best {
        let (one, two) = (self.one.half, self.two.half);
        let margin = Eight::all(PREFERENCE) * one[0].max(one[1]).min(two[0].max(two[1]));
        let favour = loyal.touched * (Eight::all(LOYALTY) * self.small());
        let (yes, no) = (Eight::all(1.0), Eight::all(-1.0));
        let mut came = [(yes, no); 4];
        if deep.min(loyal.touched).greatest() > 0.0 {
            came = self.came(loyal);
            let any = came.iter().fold(no, |any, (leads, _)| any.max(*leads));
            let bound = deep.min(any).min(less(Eight::ZERO, loyal.touched));
            came = came.map(|(leads, against)| (leads.max(-bound), against.min(bound)));
        }
        let mut best: Option<Best> = None;
        for (k, (leads, against)) in came.into_iter().enumerate() {
            let seen = if k < 2 { &self.two_seen } else { &self.one_seen };
            let (of_first, across_x) = (if k < 2 { yes } else { no }, if k % 2 == 0 { yes } else { no });
            let nearer = at_least(seen.d[k % 2], Eight::ZERO);
            let positive = against.pick(-nearer, nearer);
            let agrees = (loyal.of_first * of_first).min(loyal.across_x * across_x).min(loyal.positive * positive);
            let through = seen.depth[k % 2] + Eight::all(2.0) * seen.d[k % 2].abs();
            let depth = against.pick(through, seen.depth[k % 2]);
            let favoured = leads.pick(depth - agrees.pick(favour, Eight::ZERO), Eight::all(FAR));
            let this = Best { favoured, depth, of_first, across_x, positive };
            best = Some(match best {
                None => this,
                Some(best) => {
                    let better = less(favoured, best.favoured - margin);
                    Best {
                        favoured: better.pick(favoured, best.favoured),
                        depth: better.pick(depth, best.depth),
                        of_first: better.pick(of_first, best.of_first),
                        across_x: better.pick(across_x, best.across_x),
                        positive: better.pick(positive, best.positive),
                    }
                }
            });
        }
        best.expect("there are four ways")
    }
}

/// How far apart two may be and touch within the step: [`crate::flight::Path::closing`] and room.
#[inline(always)]
fn margin(one: &Side, two: &Side, dt: f64) -> Eight {
    let (time, half) = (Eight::all(dt), Eight::all(0.5));
    let u = sub(two.v, one.v);
    let speed = u[0].abs() + u[1].abs() + one.omega.abs() * one.far + two.omega.abs() * two.far;
    let sum = |of: Pair| of[0].abs() + of[1].abs();
    let pulled = sum(one.acceleration) + sum(two.acceleration);
    let spun = one.angular.abs() * one.far + two.angular.abs() * two.far;
    let room = Eight::all(ROOM) * (one.half[0].min(one.half[1]) + two.half[0].min(two.half[1]));
    (speed + half * (pulled + spun) * time) * time + room
}
