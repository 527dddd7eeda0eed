//! What a body's next frame is expected to be, from its last ones: what comes out as expected need not be written.
//!
//! The expectations are part of the format: whoever reads a file must expect what its writer did, to the last bit. They use
//! `+ − × ÷` only, and are written down here even where the engine has the same, so that the engine may change.

use std::f64::consts::{PI, TAU};

use super::frame::State;

/// The columns of a state in the order in which they are written: places are expected from velocities of the same frame.
pub(super) const ORDER: [usize; State::COUNT] = [3, 4, 5, 0, 1, 2];

const ANGLE: usize = 2;

/// One number of one body, frame after frame.
#[derive(Clone, Copy, Default)]
pub(super) struct Column {
    last: f64,
    /// Of a velocity the two changes before; of a place what its running sum has rounded away, and nothing.
    memory: [f64; 2],
}

impl Column {
    /// A velocity stays, or goes on changing as it did.
    pub(super) fn velocity(&self) -> f64 {
        let [change, earlier] = self.memory;
        let bend = change - earlier;
        if change != 0.0 && bend.abs() <= 0.25 * change.abs() { self.last + (change + bend) } else { self.last }
    }

    pub(super) fn see_velocity(&mut self, value: f64) {
        self.memory = [value - self.last, self.memory[0]];
        self.last = value;
    }

    /// A place goes on with the mean of the velocities before and after, and keeps what the sum rounds away.
    pub(super) fn place(&self, column: usize, mean_velocity: f64, time: f64) -> Expected {
        let wanted = mean_velocity * time + self.memory[0];
        let value = self.last + wanted;
        let lost = wanted - (value - self.last);
        match column {
            ANGLE if value > PI => Expected { value: value - TAU, lost },
            ANGLE if value <= -PI => Expected { value: value + TAU, lost },
            _ => Expected { value, lost },
        }
    }

    pub(super) fn see_place(&mut self, expected: Expected, value: f64) {
        let lost = if value.to_bits() == expected.value.to_bits() { expected.lost } else { 0.0 };
        *self = Column { last: value, memory: [lost, 0.0] };
    }
}

/// A place, and what its sum has rounded away.
#[derive(Clone, Copy)]
pub(super) struct Expected {
    pub(super) value: f64,
    pub(super) lost: f64,
}

/// All numbers of one body.
#[derive(Clone, Copy, Default)]
pub(super) struct Course {
    pub(super) columns: [Column; State::COUNT],
}
