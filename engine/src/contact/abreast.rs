//! Pairs of rectangles looked at side by side, as many as a register holds: the touch of each, or that there is none, to the same
//! bits as [`Touch::find`] one after the other.
//!
//! What is rare is left to that: pairs deep in each other that did not touch a step ago, pairs at a seam, pairs whose best face is
//! passed by.

use super::acting::Moving;
use super::swept::ROOM;
use super::touch::{FAR, Touch};
use crate::bodies::Bodies;
use crate::broad_phase::met::Owner;
use crate::detect::Face;
use crate::detect::complete::PREFERENCE;
use crate::detect::near::{DEEP, LOYALTY};
use crate::detect::sides::ALONG;
use crate::lanes::{LANES, Numbers};

/// Two numbers along x and z, in every lane.
pub(super) type Pair<V> = [V; 2];

/// A yes or no in every lane: 1 or −1, for [`Numbers::pick`].
pub(super) type Flag<V> = V;

/// The rectangles of some pairs on one side, and their bodies.
#[derive(Clone, Copy)]
pub(super) struct Side<V> {
    pub(super) o: Pair<V>,
    pub(super) axis: Pair<V>,
    /// Half sizes, and the middle in the body's frame.
    pub(super) half: Pair<V>,
    pub(super) centre: Pair<V>,
    /// From x_min, z_min to x_max, z_max.
    pub(super) low: Pair<V>,
    pub(super) high: Pair<V>,
}

impl<V: Numbers> Side<V> {
    /// The rectangles of those indices.
    #[inline(always)]
    pub(super) fn of(bodies: &Bodies, owners: &[Owner], rect: impl Fn(usize) -> usize) -> Side<V> {
        let [x, z, cos, sin] = V::columns(|k| bodies.frame[owners[rect(k)].body()].row());
        let [x_min, x_max, z_min, z_max] = V::columns(|k| bodies.rects[rect(k)].row());
        let (low, high) = ([x_min, z_min], [x_max, z_max]);
        let middle = V::all(0.5);
        let half = [middle * (high[0] - low[0]), middle * (high[1] - low[1])];
        let centre = [middle * (low[0] + high[0]), middle * (low[1] + high[1])];
        Side { o: [x, z], axis: [cos, sin], half, centre, low, high }
    }
}

/// How the rectangles on one side move.
pub(super) struct Mover<V> {
    body: Moving<V>,
    /// How fast the middle of the rectangle moves.
    middle: Pair<V>,
    /// How far the rectangle reaches from its body's centre at most.
    far: V,
}

impl<V: Numbers> Mover<V> {
    #[inline(always)]
    pub(super) fn of(body: Moving<V>, side: &Side<V>) -> Mover<V> {
        let (low, high) = (side.low, side.high);
        let far = low[0].abs().max(high[0].abs()) + low[1].abs().max(high[1].abs());
        let [x, z] = outward(side.axis, side.centre);
        Mover { middle: [body.v[0] - body.omega * z, body.v[1] + body.omega * x], body, far }
    }

    /// How far its corners leave a straight line, for half of the time squared \[m/s²\].
    #[inline(always)]
    fn bent(&self) -> V {
        (self.body.omega * self.body.omega + self.body.angular.abs()) * self.far
    }

    /// 0 where the body stands still and nothing acts on it.
    #[inline(always)]
    fn moves(&self) -> V {
        sum(self.body.v) + sum(self.body.acceleration) + self.body.omega.abs() + self.body.angular.abs()
    }
}

#[inline(always)]
fn sum<V: Numbers>(of: Pair<V>) -> V {
    of[0].abs() + of[1].abs()
}

#[inline(always)]
pub(super) fn outward<V: Numbers>([cos, sin]: Pair<V>, [x, z]: Pair<V>) -> Pair<V> {
    [cos * x - sin * z, sin * x + cos * z]
}

#[inline(always)]
pub(super) fn inward<V: Numbers>([cos, sin]: Pair<V>, [x, z]: Pair<V>) -> Pair<V> {
    [cos * x + sin * z, cos * z - sin * x]
}

#[inline(always)]
pub(super) fn add<V: Numbers>(a: Pair<V>, b: Pair<V>) -> Pair<V> {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
pub(super) fn sub<V: Numbers>(a: Pair<V>, b: Pair<V>) -> Pair<V> {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
pub(super) fn times<V: Numbers>(a: Pair<V>, by: V) -> Pair<V> {
    [a[0] * by, a[1] * by]
}

#[inline(always)]
pub(super) fn cross<V: Numbers>(a: Pair<V>, b: Pair<V>) -> V {
    a[0] * b[1] - a[1] * b[0]
}

#[inline(always)]
pub(super) fn pick<V: Numbers>(flag: Flag<V>, yes: Pair<V>, no: Pair<V>) -> Pair<V> {
    [flag.pick(yes[0], no[0]), flag.pick(yes[1], no[1])]
}

/// One body's frame and rectangle as seen from another's.
#[derive(Clone, Copy)]
pub(super) struct Seen<V> {
    pub(super) o: Pair<V>,
    pub(super) axis: Pair<V>,
    /// The rectangle's middle from the other's, and the overlaps along the other's x and z.
    pub(super) d: Pair<V>,
    pub(super) depth: Pair<V>,
}

impl<V: Numbers> Seen<V> {
    #[inline(always)]
    fn from(owner: &Side<V>, reference: &Side<V>) -> Seen<V> {
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
    pub(super) fn place(&self, point: Pair<V>) -> Pair<V> {
        add(self.o, outward(self.axis, point))
    }
}

/// The face touched in every pair, chosen.
#[derive(Clone, Copy)]
pub(super) struct Best<V> {
    /// The overlap less what speaks for the face; and without that.
    favoured: V,
    pub(super) depth: V,
    pub(super) of_first: Flag<V>,
    pub(super) across_x: Flag<V>,
    pub(super) positive: Flag<V>,
}

/// How pairs touched a step ago, 0 of those that did not.
#[derive(Clone, Copy)]
pub(super) struct Loyal<V> {
    touched: V,
    of_first: Flag<V>,
    across_x: Flag<V>,
    positive: Flag<V>,
    /// From the first rectangle to the second.
    normal: Pair<V>,
}

impl<V: Numbers> Loyal<V> {
    #[inline(always)]
    pub(super) fn of<'a>(last: impl Fn(usize) -> Option<&'a Touch>) -> Loyal<V> {
        let (mut touched, mut of_first, mut across_x, mut positive) =
            ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let mut normal = [[0.0; LANES]; 2];
        let flag = |yes: bool| if yes { 1.0 } else { -1.0 };
        for k in 0..V::COUNT {
            let Some(last) = last(k) else { continue };
            touched[k] = 1.0;
            of_first[k] = flag(last.of_first);
            across_x[k] = flag(matches!(last.face, Face::XMax | Face::XMin));
            positive[k] = flag(last.face.is_positive());
            let n = if last.of_first { last.n } else { -last.n };
            (normal[0][k], normal[1][k]) = (n.x, n.y);
        }
        Loyal {
            touched: V::of(&touched),
            of_first: V::of(&of_first),
            across_x: V::of(&across_x),
            positive: V::of(&positive),
            normal: [V::of(&normal[0]), V::of(&normal[1])],
        }
    }
}

/// Pairs under look, the earlier created on the first side.
pub(super) struct Abreast<V> {
    pub(super) one: Side<V>,
    pub(super) two: Side<V>,
    /// The first as seen from the second, and the other way round.
    pub(super) one_seen: Seen<V>,
    pub(super) two_seen: Seen<V>,
    depth: V,
}

impl<V: Numbers> Abreast<V> {
    #[inline(always)]
    pub(super) fn new(one: Side<V>, two: Side<V>) -> Abreast<V> {
        let (one_seen, two_seen) = (Seen::from(&one, &two), Seen::from(&two, &one));
        let depth = two_seen.depth[0].min(two_seen.depth[1]).min(one_seen.depth[0].min(one_seen.depth[1]));
        Abreast { one, two, one_seen, two_seen, depth }
    }

    /// How far apart they may be and touch within the step: [`crate::flight::Path::closing`] and room.
    #[inline(always)]
    pub(super) fn margin(&self, [one, two]: [&Mover<V>; 2], dt: f64) -> V {
        let (time, half) = (V::all(dt), V::all(0.5));
        let u = sub(two.body.v, one.body.v);
        let speed = u[0].abs() + u[1].abs() + one.body.omega.abs() * one.far + two.body.omega.abs() * two.far;
        let pulled = sum(one.body.acceleration) + sum(two.body.acceleration);
        let spun = one.body.angular.abs() * one.far + two.body.angular.abs() * two.far;
        let (first, second) = (self.one.half, self.two.half);
        let room = V::all(ROOM) * (first[0].min(first[1]) + second[0].min(second[1]));
        (speed + half * (pulled + spun) * time) * time + room
    }

    /// Which pairs may touch at all, that far apart or less.
    #[inline(always)]
    pub(super) fn may(&self, margin: V) -> Flag<V> {
        self.depth.at_least(-margin)
    }

    /// Which pairs stay apart for a time unless something is done to their bodies: an axis holds them apart in spite of all that
    /// they move and turn, whether or not what pulls at them is held by others; or they touch, and stand as still as can be.
    #[inline(always)]
    pub(super) fn stay_apart(&self, [one, two]: [&Mover<V>; 2], dt: f64) -> Flag<V> {
        let of_first = self.room(&self.two_seen, (&self.one, one), (&self.two, two), dt);
        let of_second = self.room(&self.one_seen, (&self.two, two), (&self.one, one), dt);
        let still = V::zero().at_least(one.moves() + two.moves());
        let no_deeper = (V::all(super::TOUCHING) * self.small()).at_least(self.depth);
        V::zero().less(of_first.max(of_second)).max(still.min(no_deeper))
    }

    /// The least gap within a time along one of the reference's axes, as it points when the time begins, whichever is wider.
    ///
    /// Corners move along arcs: in a straight line, but for half of ω² r t². Along an axis, the deepest of straight lines is deepest
    /// at one of the ends.
    #[inline(always)]
    fn room(
        &self,
        seen: &Seen<V>,
        (reference, moves): (&Side<V>, &Mover<V>),
        (other, other_moves): (&Side<V>, &Mover<V>),
        dt: f64,
    ) -> V {
        let (time, half) = (V::all(dt), V::all(0.5));
        let bent = half * (moves.bent() + other_moves.bent()) * time * time;
        let u = inward(reference.axis, sub(other_moves.middle, moves.middle));
        let pulls =
            [inward(reference.axis, moves.body.acceleration), inward(reference.axis, other_moves.body.acceleration)];
        let [c, s] = seen.axis;
        // The other's x and z axes along the reference's, and turned on by the end.
        let turn = other_moves.body.omega * time;
        let after = [[c - turn * s, -s - turn * c], [s + turn * c, c - turn * s]];
        let spun = moves.body.omega.abs() * time;
        let mut room = [V::zero(); 2];
        for k in 0..2 {
            let end = seen.d[k] + u[k] * time;
            let end = seen.d[k].pick(end, -end);
            let reach = reference.half[k]
                + spun * reference.half[1 - k]
                + (other.half[0] * after[k][0].abs() + other.half[1] * after[k][1].abs());
            let pulled = pulls[0][k].abs() + pulls[1][k].abs();
            room[k] = (end - reach).min(-seen.depth[k]) - half * pulled * time * time;
        }
        room[0].max(room[1]) - bent
    }

    /// Which pairs are so deep in each other that it matters how they came.
    #[inline(always)]
    pub(super) fn deep(&self) -> Flag<V> {
        (V::all(DEEP) * self.small()).less(self.depth)
    }

    #[inline(always)]
    pub(super) fn small(&self) -> V {
        let (one, two) = (self.one.half, self.two.half);
        one[0].min(one[1]).min(two[0].min(two[1]))
    }

    /// Which of the four ways lead where pairs came from, at least in part, and which lead against that and are to be turned round.
    #[inline(always)]
    fn came(&self, loyal: &Loyal<V>) -> [(Flag<V>, Flag<V>); 4] {
        let mut came = [(V::zero(), V::zero()); 4];
        for (k, came) in came.iter_mut().enumerate() {
            let ([cos, sin], seen) =
                if k < 2 { (self.one.axis, &self.two_seen) } else { (self.two.axis, &self.one_seen) };
            let axis = if k % 2 == 0 { [cos, sin] } else { [-sin, cos] };
            let along = axis[0] * loyal.normal[0] + axis[1] * loyal.normal[1];
            let along = seen.d[k % 2].at_least(V::zero()) * along;
            let share = if k < 2 { along } else { -along };
            *came = (V::all(ALONG).less(share.abs()), share.less(V::zero()));
        }
        came
    }

    /// The way of least overlap or widest gap, the first of equals, with something in favour of the one taken before. Pairs deep
    /// in each other go apart the way they came, where any way leads there.
    #[inline(always)]
    pub(super) fn best(&self, loyal: &Loyal<V>, deep: Flag<V>) -> Best<V> {
        let (one, two) = (self.one.half, self.two.half);
        let margin = V::all(PREFERENCE) * one[0].max(one[1]).min(two[0].max(two[1]));
        let favour = loyal.touched * (V::all(LOYALTY) * self.small());
        let (yes, no) = (V::all(1.0), V::all(-1.0));
        let mut came = [(yes, no); 4];
        if deep.min(loyal.touched).any() {
            came = self.came(loyal);
            let any = came[0].0.max(came[1].0).max(came[2].0.max(came[3].0));
            let bound = deep.min(any).min(V::zero().less(loyal.touched));
            for (leads, against) in &mut came {
                (*leads, *against) = (leads.max(-bound), against.min(bound));
            }
        }
        let mut best: Option<Best<V>> = None;
        for (k, (leads, against)) in came.into_iter().enumerate() {
            let seen = if k < 2 { &self.two_seen } else { &self.one_seen };
            let (of_first, across_x) = (if k < 2 { yes } else { no }, if k % 2 == 0 { yes } else { no });
            let nearer = seen.d[k % 2].at_least(V::zero());
            let positive = against.pick(-nearer, nearer);
            let agrees = (loyal.of_first * of_first).min(loyal.across_x * across_x).min(loyal.positive * positive);
            let through = seen.depth[k % 2] + V::all(2.0) * seen.d[k % 2].abs();
            let depth = against.pick(through, seen.depth[k % 2]);
            let favoured = leads.pick(depth - agrees.pick(favour, V::zero()), V::all(FAR));
            let this = Best { favoured, depth, of_first, across_x, positive };
            best = Some(match best {
                None => this,
                Some(best) => {
                    let better = favoured.less(best.favoured - margin);
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
