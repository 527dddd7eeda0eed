//! Touches read in the order of their rectangles: those that were found when the part of the step began, and among them those
//! that joined it. The two stay where they lie, each in order; touches are large, and few join.

use super::touch::Touch;

/// The touches that have not been read yet.
#[derive(Clone, Copy)]
pub(super) struct Remembered<'a> {
    found: &'a [Touch],
    joined: &'a [Touch],
}

impl<'a> Remembered<'a> {
    /// Touches of which the first so many were found, and the others joined them.
    pub(super) fn new(touches: &'a [Touch], found: usize) -> Self {
        let (found, joined) = touches.split_at(found);
        Remembered { found, joined }
    }

    /// Those from that pair of rectangles on.
    pub(super) fn from(self, first: (u32, u32)) -> Self {
        let after = |touches: &'a [Touch]| &touches[touches.partition_point(|touch| touch.rects < first)..];
        Remembered { found: after(self.found), joined: after(self.joined) }
    }

    /// The touch of a pair, and none before it after that.
    #[inline(always)]
    pub(super) fn of_pair(&mut self, rects: (u32, u32)) -> Option<&'a Touch> {
        let found = skip_to(&mut self.found, rects);
        let joined = skip_to(&mut self.joined, rects);
        found.or(joined)
    }
}

/// Leaves out what comes before that pair; its own touch, if it is there.
#[inline(always)]
fn skip_to<'a>(touches: &mut &'a [Touch], rects: (u32, u32)) -> Option<&'a Touch> {
    while let [first, others @ ..] = *touches {
        if first.rects >= rects {
            return (first.rects == rects).then_some(first);
        }
        *touches = others;
    }
    None
}

impl<'a> Iterator for Remembered<'a> {
    type Item = &'a Touch;

    fn next(&mut self) -> Option<&'a Touch> {
        let is_joined = match (self.found.first(), self.joined.first()) {
            (Some(found), Some(joined)) => joined.rects < found.rects,
            (found, _) => found.is_none(),
        };
        let touches = if is_joined { &mut self.joined } else { &mut self.found };
        let (first, others) = touches.split_first()?;
        *touches = others;
        Some(first)
    }
}
