//! The points of eight touches and their levers, side by side: what [`Touch::find`] does with one pair.

use super::abreast::{Abreast, Best, Flag, Pair, Seen, add, cross, inward, outward, pick, sub, times};
use super::touch::{FAR, Touch};
use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::detect::Face;
use crate::detect::manifold::Placed;
use crate::detect::near::ONE;
use crate::exchange::impact::Surface;
use crate::lanes::{Eight, Numbers};

/// The reference and the owner of every pair, as far as its face and points go.
struct Roles<V> {
    o: Pair<V>,
    axis: Pair<V>,
    low: Pair<V>,
    high: Pair<V>,
    half: Pair<V>,
    owner_o: Pair<V>,
    owner_axis: Pair<V>,
    owner_low: Pair<V>,
    owner_high: Pair<V>,
    owner_half: Pair<V>,
    /// The owner as seen from the reference.
    seen: Seen<V>,
}

impl<V: Numbers> Roles<V> {
    #[inline(always)]
    fn of(pairs: &Abreast<V>, of_first: Flag<V>) -> Roles<V> {
        let (one, two) = (&pairs.one, &pairs.two);
        let (seen, other) = (&pairs.two_seen, &pairs.one_seen);
        Roles {
            o: pick(of_first, one.o, two.o),
            axis: pick(of_first, one.axis, two.axis),
            low: pick(of_first, one.low, two.low),
            high: pick(of_first, one.high, two.high),
            half: pick(of_first, one.half, two.half),
            owner_o: pick(of_first, two.o, one.o),
            owner_axis: pick(of_first, two.axis, one.axis),
            owner_low: pick(of_first, two.low, one.low),
            owner_high: pick(of_first, two.high, one.high),
            owner_half: pick(of_first, two.half, one.half),
            seen: Seen { o: pick(of_first, seen.o, other.o), axis: pick(of_first, seen.axis, other.axis), ..*seen },
        }
    }

    /// The owner's edge that looks at the face most squarely, by its ends in R4's order round.
    #[inline(always)]
    fn facing_edge(&self, normal: Pair<V>) -> [Pair<V>; 2] {
        let against = inward(self.seen.axis, normal);
        let ([x_min, z_min], [x_max, z_max]) = (self.owner_low, self.owner_high);
        let sideways = against[0].abs().at_least(against[1].abs());
        let (right, up) = (V::zero().less(against[0]), V::zero().less(against[1]));
        let x = right.pick(x_min, x_max);
        let z = up.pick(z_min, z_max);
        let one = [sideways.pick(x, up.pick(x_min, x_max)), sideways.pick(right.pick(z_max, z_min), z)];
        let two = [sideways.pick(x, up.pick(x_max, x_min)), sideways.pick(right.pick(z_min, z_max), z)];
        [one, two]
    }
}

/// A point of contact in every lane.
#[derive(Clone, Copy)]
struct Point<V> {
    vertex: Pair<V>,
    on_face: Pair<V>,
    depth: V,
    /// Whether it is near enough and not beside the face.
    counts: Flag<V>,
    /// Whether it is where the edge passes an end of the face.
    cut: Flag<V>,
}

/// Eight touches laid out.
pub(super) struct Points {
    /// Which pairs have any point, and which two.
    any: Eight,
    two: Eight,
    /// Where the only point is the edge's second end.
    swapped: Eight,
    /// Which have an overlap, though no point counts.
    passed: Eight,
    /// The face: of which rectangle, across which axis, on which side.
    of_first: Eight,
    across_x: Eight,
    positive: Eight,
    n: [Eight; 2],
    cut: [Eight; 2],
    gap: [Eight; 2],
    lever_a: [Eight; 2],
    lever_b: [Eight; 2],
    along_a: Eight,
    along_b: Eight,
    slip: [Eight; 2],
    middle: [Eight; 2],
}

impl Points {
    #[inline(always)]
    pub(super) fn of<V: Numbers>(pairs: &Abreast<V>, margin: V, best: Best<V>) -> Points {
        let roles = Roles::of(pairs, best.of_first);
        let (zero, sign) = (V::zero(), best.positive);
        let normal = [best.across_x.pick(sign, zero), best.across_x.pick(zero, sign)];
        let edge = roles.facing_edge(normal);
        let placed = [roles.seen.place(edge[0]), roles.seen.place(edge[1])];
        let face = Line::of(&roles, &best);
        let ends = [face.along(placed[0]), face.along(placed[1])];
        let first = face.cut(&roles.seen, margin, (edge[0], edge[1]), (placed[0], placed[1]));
        let second = face.cut(&roles.seen, margin, (edge[1], edge[0]), (placed[1], placed[0]));
        let between = sub(second.vertex, first.vertex);
        let length = (between[0] * between[0] + between[1] * between[1]).root();
        let apart = (V::all(ONE) * pairs.small()).less(length);
        let (any, both) = (first.counts.max(second.counts), first.counts.min(second.counts));
        let two = both.min(apart);
        let swapped = (-first.counts).min(second.counts);
        let points = [choose(swapped, &second, &first), choose(two, &second, &choose(swapped, &second, &first))];
        let n = outward(roles.axis, normal);
        let levers = Levers::of(&roles, &points, n, two);
        Points {
            any: any.eight(),
            two: two.eight(),
            swapped: swapped.eight(),
            passed: (-any).min(best.depth.at_least(zero)).eight(),
            of_first: best.of_first.eight(),
            across_x: best.across_x.eight(),
            positive: best.positive.eight(),
            n: n.map(V::eight),
            cut: [points[0].cut.eight(), points[1].cut.min(two).eight()],
            gap: [(-points[0].depth).eight(), two.pick(-points[1].depth, V::all(FAR)).eight()],
            lever_a: levers.a.map(V::eight),
            lever_b: levers.b.map(V::eight),
            along_a: levers.along_a.eight(),
            along_b: levers.along_b.eight(),
            slip: face.slip(roles.axis, n, ends).map(V::eight),
            middle: levers.middle.map(V::eight),
        }
    }

    /// Whether the pair has a touch; `None` where its next best face is to be tried.
    #[inline(always)]
    pub(super) fn touches(&self, k: usize) -> Option<bool> {
        if self.passed.0[k] > 0.0 { None } else { Some(self.any.0[k] > 0.0) }
    }

    /// The touch of a pair that has one.
    #[inline(always)]
    pub(super) fn touch(&self, k: usize, bodies: &Bodies, (one, two): (&Placed, &Placed)) -> Touch {
        let is = |flag: &Eight| flag.0[k] > 0.0;
        let of_first = is(&self.of_first);
        let (a, b) = if of_first { (one.body, two.body) } else { (two.body, one.body) };
        let (has_two, swapped) = (is(&self.two), u8::from(is(&self.swapped)));
        Touch {
            rects: (one.index as u32, two.index as u32),
            a: a as u32,
            b: b as u32,
            face: match (is(&self.across_x), is(&self.positive)) {
                (true, true) => Face::XMax,
                (true, false) => Face::XMin,
                (false, true) => Face::ZMax,
                (false, false) => Face::ZMin,
            },
            of_first,
            n: Vec2::new(self.n[0].0[k], self.n[1].0[k]),
            ends: [swapped, if has_two { 1 } else { u8::MAX }],
            count: if has_two { 2 } else { 1 },
            cut: [is(&self.cut[0]), is(&self.cut[1])],
            gap: [self.gap[0].0[k], self.gap[1].0[k]],
            lever_a: [self.lever_a[0].0[k], self.lever_a[1].0[k]],
            lever_b: [self.lever_b[0].0[k], self.lever_b[1].0[k]],
            along_a: self.along_a.0[k],
            along_b: self.along_b.0[k],
            slip: (self.slip[0].0[k], self.slip[1].0[k]),
            surface: Surface::of_pair(bodies.surface[a], bodies.surface[b]),
            middle: Vec2::new(self.middle[0].0[k], self.middle[1].0[k]),
            push: [0.0; 2],
            grip: 0.0,
            met: false,
            touching: false,
        }
    }
}

/// The levers of eight touches about both bodies, along the normal and along the face, and where the touches are.
struct Levers<V> {
    a: [V; 2],
    b: [V; 2],
    along_a: V,
    along_b: V,
    middle: Pair<V>,
}

impl<V: Numbers> Levers<V> {
    #[inline(always)]
    fn of(roles: &Roles<V>, points: &[Point<V>; 2], n: Pair<V>, two: Flag<V>) -> Levers<V> {
        let (t, middle) = ([n[1], -n[0]], V::all(0.5));
        let apart = sub(roles.owner_o, roles.o);
        let mut arms = [[[V::zero(); 2]; 2]; 2];
        for (arms, point) in arms.iter_mut().zip(points) {
            let (on_a, on_b) = (outward(roles.axis, point.on_face), outward(roles.owner_axis, point.vertex));
            let half = times(sub(add(apart, on_b), on_a), middle);
            *arms = [add(on_a, half), sub(on_b, half)];
        }
        let [first, second] = arms;
        // Friction acts at the height of the nearer point: halfway from the face to it, not to the mean of both.
        let nearer = V::all(0.25) * (points[0].depth - points[1].depth).abs();
        let mut a = [cross(first[0], n), cross(second[0], n)];
        let mut b = [cross(first[1], n), cross(second[1], n)];
        // A second point beside the first and out of reach keeps all touches alike.
        let beside = roles.half[0].min(roles.half[1]) + roles.owner_half[0].min(roles.owner_half[1]);
        a[1] = two.pick(a[1], a[1] + beside);
        b[1] = two.pick(b[1], b[1] + beside);
        Levers {
            a,
            b,
            along_a: middle * (cross(first[0], t) + cross(second[0], t)) + nearer,
            along_b: middle * (cross(first[1], t) + cross(second[1], t)) + nearer,
            middle: add(roles.o, times(add(first[0], second[0]), middle)),
        }
    }
}

#[inline(always)]
fn choose<V: Numbers>(flag: Flag<V>, yes: &Point<V>, no: &Point<V>) -> Point<V> {
    Point {
        vertex: pick(flag, yes.vertex, no.vertex),
        on_face: pick(flag, yes.on_face, no.on_face),
        depth: flag.pick(yes.depth, no.depth),
        counts: no.counts,
        cut: flag.pick(yes.cut, no.cut),
    }
}

/// The face of the reference in every lane.
struct Line<V> {
    across_x: Flag<V>,
    positive: Flag<V>,
    /// Where the face lies along its normal's axis, and from where to where it reaches along itself.
    at: V,
    least: V,
    greatest: V,
}

impl<V: Numbers> Line<V> {
    #[inline(always)]
    fn of(roles: &Roles<V>, best: &Best<V>) -> Line<V> {
        let (across_x, positive) = (best.across_x, best.positive);
        let sides = pick(positive, roles.high, roles.low);
        Line {
            across_x,
            positive,
            at: across_x.pick(sides[0], sides[1]),
            least: across_x.pick(roles.low[1], roles.low[0]),
            greatest: across_x.pick(roles.high[1], roles.high[0]),
        }
    }

    #[inline(always)]
    fn along(&self, point: Pair<V>) -> V {
        self.across_x.pick(point[1], point[0])
    }

    /// An end of an edge cut to the face, as [`crate::detect::manifold::cut_to_face`] does.
    #[inline(always)]
    fn cut(
        &self,
        seen: &Seen<V>,
        margin: V,
        (near, far): (Pair<V>, Pair<V>),
        (place, other): (Pair<V>, Pair<V>),
    ) -> Point<V> {
        let (t, until) = (self.along(place), self.along(other));
        let (before, after) = (t.less(self.least), self.greatest.less(t));
        let limit = before.pick(self.least, self.greatest);
        let share = ((limit - t) / (until - t)).max(V::zero()).min(V::all(1.0));
        let cut = before.max(after);
        let share = cut.pick(share, V::zero());
        let p = add(place, times(sub(other, place), share));
        let vertex = add(near, times(sub(far, near), share));
        let across = self.across_x.pick(p[0], p[1]);
        let depth = self.positive.pick(self.at - across, across - self.at);
        let on_face = [self.across_x.pick(self.at, p[0]), self.across_x.pick(p[1], self.at)];
        let (at, slack) = (self.along(seen.place(vertex)), V::all(1e-9) * (self.greatest - self.least));
        let within = at.at_least(self.least - slack).min((self.greatest + slack).at_least(at));
        Point { vertex, on_face, depth, counts: depth.at_least(-margin).min(within), cut }
    }

    /// How far the owner may slip along t, backward and forward, before its edge leaves the face.
    #[inline(always)]
    fn slip(&self, axis: Pair<V>, n: Pair<V>, ends: [V; 2]) -> Pair<V> {
        let (zero, one) = (V::zero(), V::all(1.0));
        let (e0, e1) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let with_t = outward(axis, [self.across_x.pick(zero, one), self.across_x.pick(one, zero)]);
        let forward = zero.less(with_t[0] * n[1] + with_t[1] * -n[0]);
        let (back, on) = ([self.least - e1, e0 - self.greatest], [self.greatest - e0, e1 - self.least]);
        [forward.pick(back[0], back[1]), forward.pick(on[0], on[1])]
    }
}
