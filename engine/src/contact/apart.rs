//! Pairs that are near and stay apart, in two lists: those found for the part of the step, and those of bodies that lie still
//! ([`super::still`]), which were found once and hold on.
//!
//! Both are in the order of their rectangles, and a body's pairs are gone over in that order whichever list they are in.

use super::links::Links;
use super::rows::Rows;
use super::search::Search;
use super::still::Still;
use crate::area::Vec2;

const FOUND: usize = 0;
const KEPT: usize = 1;

/// The pairs of a part of a step that stay apart.
#[derive(Clone, Debug, Default)]
pub(super) struct Apart {
    /// Found for this part; and kept from before.
    lists: [Linked; 2],
    /// For its room.
    merged: Vec<(u32, u32)>,
    /// Rows of bodies that have pairs and that touches laid out may push, each once; and by row, whether it is among them.
    pub(super) pushed: Vec<u32>,
    is_pushed: Vec<bool>,
}

/// Pairs, and those of each body.
#[derive(Clone, Debug, Default)]
struct Linked {
    /// By the indices of their rectangles, in order; and whether each has been woken.
    pairs: Vec<(u32, u32)>,
    woken: Vec<bool>,
    /// The axis that held each apart most when the part began, from the first to the second, and by how much \[m\]; once it was asked for.
    axes: Vec<Axis>,
    /// The pairs of each body.
    links: Links,
}

pub(super) type Axis = Option<(Vec2, f64)>;

/// A pair, by its list and its place there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Which(usize, usize);

/// The pairs of a body yet to be gone over, by the next link of each list.
pub(super) struct Around([Option<u32>; 2]);

impl Linked {
    fn link(&mut self, search: &Search, bodies: usize) {
        self.woken.clear();
        self.woken.resize(self.pairs.len(), false);
        self.axes.clear();
        self.axes.resize(self.pairs.len(), None);
        self.links.clear();
        let body_of = |rect: u32| search.body_of(rect) as u32;
        self.links.go_on(self.pairs.iter().map(|(one, two)| (body_of(*one), body_of(*two))), bodies);
    }

    /// The rectangles of a link.
    fn of(&self, link: u32) -> (u32, u32) {
        self.pairs[(link / 2) as usize]
    }
}

impl Apart {
    /// Other bodies lie still than before. Pairs of two that do are kept, of those found for the last part and of those kept then; none
    /// has been woken, for a touch counts against it.
    pub(super) fn keep(&mut self, search: &Search, still: &Still, bodies: usize) {
        let Apart { lists: [found, kept], merged, .. } = self;
        let lies = |rect: u32| still.lies(search.body_of(rect));
        let lie = |pair: &(u32, u32)| lies(pair.0) && lies(pair.1);
        let mut known = kept.pairs.iter().copied().filter(lie).peekable();
        merged.clear();
        for pair in found.pairs.iter().copied().filter(lie) {
            while let Some(before) = known.next_if(|known| *known < pair) {
                merged.push(before);
            }
            merged.push(pair);
        }
        merged.extend(known);
        core::mem::swap(&mut kept.pairs, merged);
        kept.link(search, bodies);
    }

    /// No pairs found yet.
    pub(super) fn begin(&mut self) -> &mut Vec<(u32, u32)> {
        self.lists[FOUND].pairs.clear();
        &mut self.lists[FOUND].pairs
    }

    /// How many pairs there are.
    pub(super) fn count(&self) -> usize {
        self.lists.iter().map(|list| list.pairs.len()).sum()
    }

    /// All of them, in order.
    #[cfg(test)]
    pub(super) fn pairs(&self) -> Vec<(u32, u32)> {
        let mut pairs = self.lists.each_ref().map(|list| &list.pairs[..]).concat();
        pairs.sort_unstable();
        pairs
    }

    pub(super) fn rects(&self, Which(list, at): Which) -> (u32, u32) {
        self.lists[list].pairs[at]
    }

    pub(super) fn axis(&mut self, Which(list, at): Which) -> &mut Axis {
        &mut self.lists[list].axes[at]
    }

    pub(super) fn is_woken(&self, Which(list, at): Which) -> bool {
        self.lists[list].woken[at]
    }

    /// It has become a touch.
    pub(super) fn wake(&mut self, Which(list, at): Which) {
        self.lists[list].woken[at] = true;
    }

    /// The pair of two rectangles, if it is one of these, has become a touch.
    pub(super) fn join(&mut self, rects: (u32, u32)) {
        for list in &mut self.lists {
            if let Ok(at) = list.pairs.binary_search(&rects) {
                list.woken[at] = true;
            }
        }
    }

    /// The pairs of a body, the last first.
    pub(super) fn around(&self, body: usize) -> Around {
        Around([FOUND, KEPT].map(|list| self.lists[list].links.last(body)))
    }

    pub(super) fn next(&self, Around(links): &mut Around) -> Option<Which> {
        let list = match *links {
            [Some(found), Some(kept)] if self.lists[FOUND].of(found) < self.lists[KEPT].of(kept) => KEPT,
            [None, Some(_)] => KEPT,
            _ => FOUND,
        };
        let link = links[list]?;
        links[list] = self.lists[list].links.before(link);
        Some(Which(list, (link / 2) as usize))
    }

    fn has(&self, body: u32) -> bool {
        self.lists.iter().any(|list| list.links.last(body as usize).is_some())
    }

    /// Links every body to the pairs found.
    pub(super) fn link(&mut self, search: &Search, bodies: usize) {
        self.lists[FOUND].link(search, bodies);
    }

    /// Remembers the rows that touches laid out may push and whose bodies have pairs.
    pub(super) fn begin_pushing(&mut self, rows: &Rows, is_laid_out: impl Fn(usize) -> bool) {
        self.pushed.clear();
        self.is_pushed.clear();
        self.is_pushed.resize(rows.rows.len(), false);
        for (k, body) in rows.mobile.iter().enumerate() {
            let row = rows.first() + k;
            if self.has(*body) && is_laid_out(row) {
                self.is_pushed[row] = true;
                self.pushed.push(row as u32);
            }
        }
    }

    /// The rows of a touch that is laid out from now on.
    pub(super) fn push_too(&mut self, rows: &Rows, (a, b): (u32, u32)) {
        self.is_pushed.resize(rows.rows.len(), false);
        for row in [a, b] {
            let Some(k) = rows.mobile_of(row) else { continue };
            if self.has(rows.mobile[k]) && !core::mem::replace(&mut self.is_pushed[row as usize], true) {
                self.pushed.push(row);
            }
        }
    }
}
