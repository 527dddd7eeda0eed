//! Pairs of bounds that have something in common, by grids: linear in the number of bounds, whatever their sizes.
//!
//! ```text
//!   z ^   ┌───┬───┬───┬───┐    Bounds are sorted into levels by their size, each with a grid of its own whose cells are as
//!     │   │   │ ▒ │ ▒ │   │    big as its biggest, and within a level by the cell of their lower left corner. Partners of
//!     │   ├───┼───┼───┼───┤    the same level that come later in this order lie in the cells shaded; each row of them is
//!     │   │   │ i │ ▒ │   │    one piece of memory. Between two levels, either looks through the other, whichever is less
//!     │   └───┴───┴───┴───┘    work.
//!     └────────────────────> x
//! ```
//!
//! A grid covers all of space by being repeated: two cells far apart that share a place cost comparisons, never a pair.

use super::level::{Class, Level, biggest_below};
use super::met::{Bounds, Entry, Met, Owner};
use core::ops::Range;

/// The grids' scratch; it allocates until it is warm and never after.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    /// From the biggest sizes to the smallest.
    classes: Vec<Class>,
    levels: Vec<Level>,
    /// The class of each of the bounds by its exponent, and then its cell.
    place: Vec<u32>,
    /// Where each cell's entries begin; one more closes the last.
    begins: Vec<u32>,
    entries: Vec<Entry>,
}

/// Classes share a level while it has no more entries for each cell than this.
const CROWD: f64 = 2.0;

/// A level whose entries have more others in their cells than this, on average, was not worth sharing.
const CROWDED: u64 = 16;

impl Grid {
    /// Sorts the bounds in.
    pub(crate) fn fill(&mut self, bounds: &[Bounds], owners: &[Owner]) {
        self.classify(bounds);
        if !self.count_into_cells(bounds, CROWD) {
            self.classify(bounds);
            self.count_into_cells(bounds, 0.0);
        }
        let nobody = Entry { bounds: Bounds([0.0; 4]), index: 0, owner: Owner::new(0, false) };
        self.entries.resize(bounds.len(), nobody);
        // From the last to the first, so that each cell's end moves down to its begin.
        for (index, (bounds, owner)) in bounds.iter().zip(owners).enumerate().rev() {
            let begin = &mut self.begins[self.place[index] as usize];
            *begin -= 1;
            self.entries[*begin as usize] = Entry { bounds: *bounds, index: index as u32, owner: *owner };
        }
    }

    /// Finds out which sizes there are.
    fn classify(&mut self, bounds: &[Bounds]) {
        self.classes.clear();
        self.place.clear();
        let mut at = usize::MAX;
        for bounds in bounds {
            let size = bounds.size();
            let exponent = size.to_bits() >> 52;
            if self.classes.get(at).is_none_or(|class| class.exponent != exponent) {
                let found = self.classes.iter().position(|class| class.exponent == exponent);
                at = found.unwrap_or(self.classes.len());
                if at == self.classes.len() {
                    self.classes.push(Class::new(exponent));
                }
            }
            self.classes[at].take_in(bounds, size);
            self.place.push(at as u32);
        }
    }

    /// Lays levels out and counts each cell's entries, as where the cell ends; `false` where classes share levels that are too
    /// crowded for it.
    fn count_into_cells(&mut self, bounds: &[Bounds], crowd: f64) -> bool {
        self.lay_out(crowd);
        let cells = self.levels.last().map_or(0, |level| level.first + level.cells());
        self.begins.clear();
        self.begins.resize(cells as usize + 1, 0);
        for (place, bounds) in self.place.iter_mut().zip(bounds) {
            let level = &self.levels[self.classes[*place as usize].level as usize];
            *place = level.cell(level.cell_of(bounds.0[0]), level.cell_of(bounds.0[1]));
            self.begins[*place as usize] += 1;
        }
        let (mut end, mut crowded) = (0, 0);
        for begin in &mut self.begins {
            crowded += u64::from(*begin) * u64::from(*begin);
            end += *begin;
            *begin = end;
        }
        self.levels.len() == self.classes.len() || crowded <= CROWDED * bounds.len() as u64
    }

    /// Makes levels of the classes, beginning with the biggest: smaller ones share a level while it is not crowded.
    fn lay_out(&mut self, crowd: f64) {
        self.levels.clear();
        let mut above = u64::MAX;
        while let Some(at) = biggest_below(&self.classes, above) {
            let class = &mut self.classes[at];
            above = class.exponent;
            let shared = self.levels.last().map(|level| level.all.joined(class));
            match shared.filter(|all| f64::from(all.count) <= crowd * all.cells()) {
                Some(all) => *self.levels.last_mut().expect("it is shared") = Level::new(all),
                None => self.levels.push(Level::new(*class)),
            }
            class.level = self.levels.len() as u32 - 1;
        }
        let mut first = 0;
        for level in &mut self.levels {
            level.first = first;
            first += level.cells();
        }
    }

    /// How many cells there are to look from.
    pub(crate) fn cells(&self) -> u32 {
        self.begins.len() as u32 - 1
    }

    /// Gathers the pairs of bounds that meet, by their indices, as seen from some of the cells: all of them taken together show
    /// every pair once, in no order. Gives how many were compared.
    #[inline(always)]
    pub(crate) fn visit(&self, from: Range<u32>, met: &mut Met) -> u64 {
        met.clear();
        let mut compared = 0;
        for (k, level) in self.levels.iter().enumerate() {
            let cells = level.first.max(from.start)..(level.first + level.cells()).min(from.end);
            for cell in cells.clone() {
                let own = self.entries_of(cell, cell + 1);
                if !own.is_empty() {
                    compared += self.gather_later(level, cell, own, met);
                }
            }
            for (other_k, other) in self.levels.iter().enumerate() {
                if other_k == k || !level.looks_through(other) || cells.is_empty() {
                    continue;
                }
                for entry in &self.entries[self.entries_of(cells.start, cells.end)] {
                    compared += self.gather_rows(other, entry, met);
                }
            }
        }
        compared
    }

    /// Gathers the pairs of one of the bounds, which may have become others, with those that they meet.
    pub(crate) fn around(&self, index: u32, owner: Owner, bounds: Bounds, met: &mut Met) -> u64 {
        met.clear();
        let entry = Entry { bounds, index, owner };
        self.levels.iter().map(|level| self.gather_rows(level, &entry, met)).sum()
    }

    #[inline(always)]
    fn entries_of(&self, first: u32, end: u32) -> Range<usize> {
        self.begins[first as usize] as usize..self.begins[end as usize] as usize
    }

    /// Partners of a cell's entries in their own level that come later than they: in the cell, right of it, and in three cells
    /// of the next row.
    #[inline(always)]
    fn gather_later(&self, level: &Level, cell: u32, own: Range<usize>, met: &mut Met) -> u64 {
        let (columns, local) = (1 << level.columns, cell - level.first);
        let (column, row) = (local & (columns - 1), local >> level.columns);
        let start = cell - column;
        let next = level.first + ((row + 1) & level.last_row as u32) * columns;
        let (mut right, mut wrapped) = (own.end, [0..0, 0..0]);
        let up = if column + 1 == columns {
            wrapped = [self.entries_of(start, start + 1), self.entries_of(next, next + 1)];
            self.entries_of(next + column - 1, next + columns)
        } else {
            right = self.begins[cell as usize + 2] as usize;
            if column == 0 {
                wrapped[0] = self.entries_of(next + columns - 1, next + columns);
            }
            self.entries_of(next + column.saturating_sub(1), next + column + 2)
        };
        let mut compared = 0;
        for at in own {
            let entry = &self.entries[at];
            compared += right - at - 1 + up.len();
            met.gather(entry, &self.entries[at + 1..right]);
            met.gather(entry, &self.entries[up.clone()]);
            for piece in &wrapped {
                compared += piece.len();
                met.gather(entry, &self.entries[piece.clone()]);
            }
        }
        compared as u64
    }

    /// Partners of an entry in another level.
    #[inline(always)]
    fn gather_rows(&self, level: &Level, entry: &Entry, met: &mut Met) -> u64 {
        let [x0, z0, x1, z1] = entry.bounds.0;
        let (column, last_column) = (level.cell_of(x0) - 1, level.cell_of(x1));
        let (row, last_row) = (level.cell_of(z0) - 1, level.cell_of(z1));
        let mut compared = 0;
        for row in row..=last_row.min(row + level.last_row) {
            let (here, there) = self.pieces(level, row, column, last_column);
            for piece in [here, there] {
                compared += piece.len();
                met.gather(entry, &self.entries[piece]);
            }
        }
        compared as u64
    }

    /// The entries of a row between two columns: one piece, or two where the grid is repeated.
    #[inline(always)]
    fn pieces(&self, level: &Level, row: i32, column: i32, last: i32) -> (Range<usize>, Range<usize>) {
        let columns = 1 << level.columns;
        let count = (last - column + 1).min(columns);
        let from = level.cell(column, row);
        let start = level.cell(0, row);
        let begin = |cell: u32| self.begins[cell as usize] as usize;
        let end = from + count as u32;
        let whole = start + columns as u32;
        if end <= whole {
            (begin(from)..begin(end), 0..0)
        } else {
            (begin(from)..begin(whole), begin(start)..begin(end - columns as u32))
        }
    }
}
