//! What the broad phase looks at: bodies where they stand, or all that they sweep over some time.

use super::bounds::{Range, bounds, range_within, swept};
use crate::bodies::Bodies;
use crate::detect::overlap;
use crate::flight::{Path, Pull};

/// A rectangle of a body, by its index among all.
pub(super) type Of = (usize, u32);

/// What of a rectangle counts as the place where it can collide.
pub(super) trait Sight {
    /// Sure bounds of it, along x and z.
    fn bounds(&self, bodies: &Bodies, of: Of) -> (Range, Range);

    /// The range of x it covers between two values of z; `None` where it has none or nothing better than its bounds is known.
    fn within(&self, bodies: &Bodies, of: Of, slab: (f64, f64)) -> Option<Range>;

    /// Whether two of them may collide, as far as a quick look can tell.
    fn may_touch(&self, bodies: &Bodies, one: Of, two: Of) -> bool;
}

/// Bodies where they stand.
pub(super) struct Standing;

impl Sight for Standing {
    #[inline]
    fn bounds(&self, bodies: &Bodies, (body, rect): Of) -> (Range, Range) {
        bounds(&bodies.frame[body], &bodies.rects[rect as usize])
    }

    fn within(&self, bodies: &Bodies, (body, rect): Of, slab: (f64, f64)) -> Option<Range> {
        range_within(&bodies.frame[body], &bodies.rects[rect as usize], slab)
    }

    #[inline]
    fn may_touch(&self, bodies: &Bodies, (i, rect_i): Of, (j, rect_j): Of) -> bool {
        let (a, b) = (&bodies.rects[rect_i as usize], &bodies.rects[rect_j as usize]);
        !overlap::certainly_apart(&bodies.frame[i], a, &bodies.frame[j], b)
    }
}

/// All that bodies sweep over some time.
#[derive(Clone, Copy, Debug)]
pub struct Sweeping<'a> {
    /// What acts on each body; empty when nothing acts on any.
    pub pulls: &'a [Pull],
    /// How long \[s\].
    pub time: f64,
}

impl Sweeping<'_> {
    fn path(&self, bodies: &Bodies, body: usize) -> Path {
        Path::of(bodies, self.pulls, body)
    }
}

impl Sight for Sweeping<'_> {
    #[inline]
    fn bounds(&self, bodies: &Bodies, (body, rect): Of) -> (Range, Range) {
        swept(&self.path(bodies, body), &bodies.rects[rect as usize], self.time)
    }

    fn within(&self, bodies: &Bodies, (body, rect): Of, slab: (f64, f64)) -> Option<Range> {
        let path = self.path(bodies, body);
        let stands = path.pull.is_none() && path.motion.omega == 0.0 && path.motion.v.norm_squared() == 0.0;
        if stands { range_within(&path.frame, &bodies.rects[rect as usize], slab) } else { None }
    }

    /// Left to whoever foresees: a second look here would cost as much.
    #[inline]
    fn may_touch(&self, _: &Bodies, _: Of, _: Of) -> bool {
        true
    }
}
