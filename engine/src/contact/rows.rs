//! The bodies in contact as the solver sees them: a row of eight numbers each.

use super::touch::Touch;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::flight::Change;
use crate::lanes::LANES;
use crate::threads::{PER_THREAD, Threads};

/// One body in contact: how it moves, how far it has come since the step began, and how easily it is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Row(pub(super) [f64; LANES]);

impl Row {
    /// How far the body has come since the step began \[m\].
    pub(super) fn place(&self) -> Vec2 {
        Vec2::new(self.0[X], self.0[Z])
    }

    /// The same, and how far it has turned: x, z, turn.
    pub(super) fn come_so_far(&self) -> [f64; 3] {
        [self.0[X], self.0[Z], self.0[TURN]]
    }

    pub(super) fn motion(&self) -> Motion {
        Motion { v: Vec2::new(self.0[VX], self.0[VZ]), omega: self.0[SPIN] }
    }

    /// The same a time later, if nothing changes its motion.
    pub(super) fn after(mut self, time: f64) -> Row {
        for (q, v) in [(X, VX), (Z, VZ), (TURN, SPIN)] {
            self.0[q] += self.0[v] * time;
        }
        self
    }

    /// The body has flown.
    pub(super) fn come(&mut self, change: &Change) {
        self.0[X] += change.shift.x;
        self.0[Z] += change.shift.y;
        self.0[TURN] += change.turn;
        self.set_motion(change.motion);
    }

    pub(super) fn set_motion(&mut self, Motion { v, omega }: Motion) {
        (self.0[VX], self.0[VZ], self.0[SPIN]) = (v.x, v.y, omega);
    }
}

/// The places in a row.
pub(super) const VX: usize = 0;
pub(super) const VZ: usize = 1;
pub(super) const SPIN: usize = 2;
pub(super) const X: usize = 3;
pub(super) const Z: usize = 4;
pub(super) const TURN: usize = 5;
pub(super) const INVERSE_MASS: usize = 6;
pub(super) const INVERSE_MOMENT: usize = 7;

/// Rows that belong to nobody: what stands in the lanes of a block that are not used.
pub(super) const IDLE: usize = 2 * LANES;

/// The rows of all bodies in contact: idle ones, fixed bodies, then mobile ones; each in order of creation, but for those that
/// join while the step is solved, which come last.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    pub(super) rows: Vec<Row>,
    /// The mobile bodies, in the order of their rows.
    pub(super) mobile: Vec<u32>,
    /// How many fixed bodies have a row, and which.
    fixed: usize,
    fixed_bodies: Vec<u32>,
    /// Which of them have a touch.
    is_touched: Vec<bool>,
    /// The row of each body; `NONE` of those without.
    row_of: Vec<u32>,
    /// How many touches each mobile body has, in the order of `mobile`.
    pub(super) degree: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Rows {
    /// Makes rows for the bodies of these touches, for some more, and for all fixed bodies that anything may come to; gives the rows
    /// of each touch.
    pub(super) fn fill(
        &mut self,
        bodies: &Bodies,
        touches: &[Touch],
        more: impl Iterator<Item = u32>,
        of_touch: &mut Vec<(u32, u32)>,
    ) {
        self.row_of.clear();
        self.row_of.resize(bodies.len(), NONE);
        for body in touches.iter().flat_map(|touch| [touch.a, touch.b]).chain(more) {
            self.row_of[body as usize] = 0;
        }
        self.rows.clear();
        self.rows.resize(IDLE, Row([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0]));
        self.mobile.clear();
        self.degree.clear();
        self.fixed_bodies.clear();
        for body in 0..bodies.len() {
            if !bodies.is_mobile(body) && !bodies.rects_of(body).is_empty() {
                self.fixed_bodies.push(body as u32);
                self.row_of[body] = self.rows.len() as u32;
                self.rows.push(row(bodies, body, false));
            }
        }
        self.fixed = self.rows.len() - IDLE;
        self.is_touched.clear();
        self.is_touched.resize(self.fixed, false);
        for body in 0..bodies.len() {
            if self.row_of[body] != NONE && bodies.is_mobile(body) {
                self.add(bodies, body);
            }
        }
        of_touch.clear();
        of_touch.extend(touches.iter().map(|touch| self.count_touch(touch)));
    }

    /// A row for a mobile body that has none, after all others; it has come nowhere yet.
    pub(super) fn add(&mut self, bodies: &Bodies, body: usize) -> &mut Row {
        self.row_of[body] = self.rows.len() as u32;
        self.mobile.push(body as u32);
        self.degree.push(0);
        self.rows.push(row(bodies, body, true));
        self.rows.last_mut().expect("it was pushed just now")
    }

    /// The rows of a touch, which counts from now on.
    pub(super) fn count_touch(&mut self, touch: &Touch) -> (u32, u32) {
        let rows = [touch.a, touch.b].map(|body| self.row_of[body as usize]);
        for row in rows {
            match self.mobile_of(row) {
                Some(at) => self.degree[at] += 1,
                None => self.is_touched[row as usize - IDLE] = true,
            }
        }
        (rows[0], rows[1])
    }

    /// Where the rows of mobile bodies begin.
    pub(super) fn first(&self) -> usize {
        IDLE + self.fixed
    }

    /// The rows of mobile bodies, in the order of `mobile`.
    pub(super) fn of_mobile(&self) -> &[Row] {
        &self.rows[IDLE + self.fixed..]
    }

    /// The mobile bodies, and their rows.
    pub(super) fn mobile_and_rows(&mut self) -> (&[u32], &mut [Row]) {
        let first = self.first();
        (&self.mobile, &mut self.rows[first..])
    }

    pub(super) fn of_mobile_mut(&mut self) -> &mut [Row] {
        let first = self.first();
        &mut self.rows[first..]
    }

    /// The rows of fixed bodies.
    fn of_fixed(&self) -> &[Row] {
        &self.rows[IDLE..IDLE + self.fixed]
    }

    /// The greatest square of a speed at which fixed bodies that have a touch drive what they touch, by going and by turning.
    pub(super) fn driven(&self, bodies: &Bodies) -> f64 {
        let rows = self.of_fixed().iter().zip(&self.fixed_bodies).zip(&self.is_touched);
        let touched = rows.filter_map(|(row, is_touched)| is_touched.then_some(row));
        touched.fold(0.0, |most, (Row(row), body)| {
            let turning = if row[SPIN] == 0.0 { 0.0 } else { row[SPIN] * bodies.reach(*body as usize) };
            most.max(row[VX] * row[VX] + row[VZ] * row[VZ] + turning * turning)
        })
    }

    pub(super) fn of_fixed_mut(&mut self) -> &mut [Row] {
        let first = self.first();
        &mut self.rows[IDLE..first]
    }

    /// The row of a body that has one.
    pub(super) fn of(&self, body: u32) -> Option<u32> {
        Some(self.row_of[body as usize]).filter(|row| *row != NONE)
    }

    /// The body of a row, unless it belongs to nobody.
    pub(super) fn body_of(&self, row: u32) -> Option<usize> {
        let fixed = || self.fixed_bodies.get((row as usize).checked_sub(IDLE)?);
        self.mobile_of(row).map(|at| &self.mobile[at]).or_else(fixed).map(|body| *body as usize)
    }

    /// Whether the row is a mobile body's; which of `mobile` it is.
    pub(super) fn mobile_of(&self, row: u32) -> Option<usize> {
        let k = (row as usize).wrapping_sub(self.first());
        (k < self.mobile.len()).then_some(k)
    }

    /// The greatest speed of a mobile body's centre.
    pub(super) fn fastest(&self) -> f64 {
        let squares = self.of_mobile().iter().map(|Row(row)| row[VX] * row[VX] + row[VZ] * row[VZ]);
        squares.fold(0.0, f64::max).sqrt()
    }

    /// Whether no mobile body is faster than that, at its radius of gyration either.
    pub(super) fn are_slower_than(&self, limit: f64, threads: &Threads) -> bool {
        let slow = |Row(row): &Row| {
            let turning = row[SPIN] * row[SPIN] * row[INVERSE_MASS] / row[INVERSE_MOMENT];
            row[VX] * row[VX] + row[VZ] * row[VZ] + turning <= limit * limit
        };
        let slow = threads.each(self.of_mobile(), (1, PER_THREAD), |_, rows| rows.iter().all(slow));
        slow.into_iter().all(|slow| slow)
    }
}

fn row(bodies: &Bodies, body: usize, mobile: bool) -> Row {
    let (motion, inertia) = (bodies.motion[body], bodies.inertia[body]);
    let (mass, moment) = if mobile { (1.0 / inertia.mass, 1.0 / inertia.moment) } else { (0.0, 0.0) };
    Row([motion.v.x, motion.v.y, motion.omega, 0.0, 0.0, 0.0, mass, moment])
}
