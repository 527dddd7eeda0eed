//! Levels of a grid: bounds of about one size, and how their cells are numbered.

use super::met::Bounds;

/// Bounds whose sizes have the same binary exponent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Class {
    pub(super) exponent: u64,
    pub(super) count: u32,
    /// The size of the biggest \[m\].
    pub(super) size: f64,
    /// From where to where lower left corners lie \[m\].
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
    /// Which level they are in.
    pub(super) level: u32,
}

/// One class of sizes or several, and their grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    pub(super) all: Class,
    /// One over the size of a cell.
    pub(super) per_cell: f64,
    /// Columns, as a power of two, and rows less one: a grid is repeated beyond them.
    pub(super) columns: u32,
    pub(super) last_row: i32,
    /// The first of its cells among all.
    pub(super) first: u32,
}

/// Columns and rows are at least so many, as a power of two: neighbouring cells are never the same one.
const FEWEST: u32 = 3;

/// There are at most about this many cells for each of the bounds.
const CELLS: u32 = 4;

/// The class of the biggest sizes with an exponent below that.
pub(super) fn biggest_below(classes: &[Class], above: u64) -> Option<usize> {
    let below = classes.iter().enumerate().filter(|(_, class)| class.exponent < above);
    below.max_by_key(|(_, class)| class.exponent).map(|(at, _)| at)
}

impl Class {
    pub(super) fn new(exponent: u64) -> Self {
        let (low, high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        Class { exponent, count: 0, size: 0.0, low, high, level: 0 }
    }

    #[inline(always)]
    pub(super) fn take_in(&mut self, bounds: &Bounds, size: f64) {
        self.count += 1;
        self.size = self.size.max(size);
        for k in 0..2 {
            self.low[k] = self.low[k].min(bounds.0[k]);
            self.high[k] = self.high[k].max(bounds.0[k]);
        }
    }

    /// These and smaller ones.
    pub(super) fn joined(&self, smaller: &Class) -> Class {
        let mut all = Class { count: self.count + smaller.count, ..*self };
        for k in 0..2 {
            all.low[k] = all.low[k].min(smaller.low[k]);
            all.high[k] = all.high[k].max(smaller.high[k]);
        }
        all
    }

    /// Columns or rows of cells as big as the biggest that cover all corners.
    fn across(&self, k: usize) -> f64 {
        if self.size > 0.0 { (self.high[k] - self.low[k]) / self.size + 1.0 } else { 1.0 }
    }

    /// How many cells as big as the biggest cover all corners.
    pub(super) fn cells(&self) -> f64 {
        self.across(0) * self.across(1)
    }
}

/// Cells are so much bigger than the biggest entry that it reaches into no more than the next, however its place is rounded.
const SLACK: f64 = 1e-6;

impl Level {
    /// Chooses columns and rows: enough to cover all corners, but not many more cells than entries.
    pub(super) fn new(all: Class) -> Self {
        let per_cell = if all.size > 0.0 { 1.0 / (all.size * (1.0 + SLACK)) } else { 0.0 };
        let most = (CELLS * all.count).ilog2().max(2 * FEWEST);
        let bits = |k: usize| {
            (all.across(k) as u32)
                .saturating_add(1)
                .checked_next_power_of_two()
                .map_or(31, u32::ilog2)
                .clamp(FEWEST, most)
        };
        let (mut columns, mut rows) = (bits(0), bits(1));
        while columns + rows > most {
            *(if columns > rows { &mut columns } else { &mut rows }) -= 1;
        }
        Level { all, per_cell, columns, last_row: (1 << rows) - 1, first: 0 }
    }

    pub(super) fn cells(&self) -> u32 {
        (self.last_row as u32 + 1) << self.columns
    }

    /// The column of an x, or the row of a z.
    #[inline(always)]
    pub(super) fn cell_of(&self, x: f64) -> i32 {
        floor(x * self.per_cell)
    }

    #[inline(always)]
    pub(super) fn cell(&self, column: i32, row: i32) -> u32 {
        let column = column & ((1 << self.columns) - 1);
        self.first + (((row & self.last_row) << self.columns) | column) as u32
    }

    /// Of two levels one looks through the other: the few big ones through many small ones, else the small ones through the big.
    pub(super) fn looks_through(&self, other: &Level) -> bool {
        if self.all.exponent > other.all.exponent { self.is_few_beside(other) } else { !other.is_few_beside(self) }
    }

    /// Whether these few entries look through a level of smaller ones with less work than those through this one.
    fn is_few_beside(&self, smaller: &Level) -> bool {
        let rows = f64::from(smaller.last_row + 1).min(2.0 * self.all.size * smaller.per_cell + 2.0);
        f64::from(self.all.count) * rows < f64::from(smaller.all.count)
    }
}

/// ⌊x⌋ as a whole number; far out it stays at the ends of a range wide enough for any number of cells.
#[inline(always)]
fn floor(x: f64) -> i32 {
    let towards_zero = x.clamp(-1e9, 1e9) as i32;
    towards_zero - i32::from(f64::from(towards_zero) > x)
}
