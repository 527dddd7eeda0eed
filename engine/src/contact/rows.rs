//! The bodies in contact as the solver sees them: a row of eight numbers each.

use super::touch::Touch;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::lanes::LANES;

/// One body in contact: how it moves, how far it has come since the step began, and how easily it is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Row(pub(super) [f64; LANES]);

impl Row {
    /// How far the body has come since the step began \[m\].
    pub(super) fn place(&self) -> Vec2 {
        Vec2::new(self.0[X], self.0[Z])
    }

    pub(super) fn motion(&self) -> Motion {
        Motion { v: Vec2::new(self.0[VX], self.0[VZ]), omega: self.0[SPIN] }
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

/// The rows of all bodies in contact: idle ones, mobile bodies in order of creation, and for every touch with a fixed
/// body one of its own, so that no two touches of a block share a row.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    pub(super) rows: Vec<Row>,
    /// The mobile bodies, each with the row `IDLE + k`.
    pub(super) mobile: Vec<u32>,
    /// The row of each body; `NONE` of those without.
    row_of: Vec<u32>,
    /// How many touches each mobile body has, in the order of `mobile`.
    pub(super) degree: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Rows {
    /// Makes rows for the bodies of these touches; gives the rows of each touch.
    pub(super) fn fill(&mut self, bodies: &Bodies, mobile: &[u32], touches: &[Touch], of_touch: &mut Vec<(u32, u32)>) {
        self.row_of.clear();
        self.row_of.resize(bodies.len(), NONE);
        self.rows.clear();
        self.rows.resize(IDLE, Row([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0]));
        self.mobile.clear();
        for touch in touches {
            self.row_of[touch.a as usize] = 0;
            self.row_of[touch.b as usize] = 0;
        }
        for &body in mobile {
            if self.row_of[body as usize] != NONE {
                self.row_of[body as usize] = self.rows.len() as u32;
                self.mobile.push(body);
                self.rows.push(row(bodies, body as usize, true));
            }
        }
        self.degree.clear();
        self.degree.resize(self.mobile.len(), 0);
        of_touch.clear();
        for touch in touches {
            let pair = [touch.a as usize, touch.b as usize].map(|body| {
                if bodies.is_mobile(body) {
                    let at = self.row_of[body];
                    self.degree[at as usize - IDLE] += 1;
                    return at;
                }
                self.rows.push(row(bodies, body, false));
                self.rows.len() as u32 - 1
            });
            of_touch.push((pair[0], pair[1]));
        }
    }

    /// Whether the row is a mobile body's; which of `mobile` it is.
    pub(super) fn mobile_of(&self, row: u32) -> Option<usize> {
        let k = (row as usize).wrapping_sub(IDLE);
        (k < self.mobile.len()).then_some(k)
    }

    /// Whether no mobile body is faster than that, at its radius of gyration either.
    pub(super) fn are_slower_than(&self, limit: f64) -> bool {
        let mobile = &self.rows[IDLE..IDLE + self.mobile.len()];
        mobile.iter().all(|Row(row)| {
            let turning = row[SPIN] * row[SPIN] * row[INVERSE_MASS] / row[INVERSE_MOMENT];
            row[VX] * row[VX] + row[VZ] * row[VZ] + turning <= limit * limit
        })
    }

    /// All mobile bodies stop.
    pub(super) fn stop(&mut self) {
        let count = self.mobile.len();
        self.rows[IDLE..IDLE + count].iter_mut().for_each(|row| row.set_motion(Motion::default()));
    }

    /// Whether the body has a row.
    pub(super) fn has(&self, body: u32) -> bool {
        self.row_of[body as usize] != NONE
    }
}

fn row(bodies: &Bodies, body: usize, mobile: bool) -> Row {
    let (motion, inertia) = (bodies.motion[body], bodies.inertia[body]);
    let (mass, moment) = if mobile { (1.0 / inertia.mass, 1.0 / inertia.moment) } else { (0.0, 0.0) };
    Row([motion.v.x, motion.v.y, motion.omega, 0.0, 0.0, 0.0, mass, moment])
}
