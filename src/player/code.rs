//! Whole numbers as few bytes: seven bits each, the sign first, and differences in place of numbers that hardly change.

/// Bytes being written.
#[derive(Default)]
pub(super) struct Bytes(pub(super) Vec<u8>);

impl Bytes {
    /// A number: 0, −1, 1, −2 … become 0, 1, 2, 3 …, written seven bits at a time, lowest first; the high bit says that more
    /// follow.
    pub(super) fn put(&mut self, number: i64) {
        let mut rest = ((number << 1) ^ (number >> 63)) as u64;
        while rest >= 0x80 {
            self.0.push(rest as u8 | 0x80);
            rest >>= 7;
        }
        self.0.push(rest as u8);
    }

    /// What each number differs from the one before it, the first from 0.
    pub(super) fn put_steps(&mut self, numbers: impl IntoIterator<Item = i64>) {
        let mut last = 0;
        for number in numbers {
            self.put(number - last);
            last = number;
        }
    }

    /// What each number differs from where the two before it lead: noughts for what moves uniformly. Numbers count up to
    /// `turn`, if that is not 0, and then from its negative on: each is taken round as often as brings it nearest to where it
    /// is expected.
    pub(super) fn put_bends(&mut self, numbers: impl IntoIterator<Item = i64>, turn: i64) {
        let (mut last, mut step) = (0, 0);
        for (index, number) in numbers.into_iter().enumerate() {
            let mut bend = number - last - step;
            if turn != 0 {
                bend = (bend + turn).rem_euclid(2 * turn) - turn;
            }
            self.put(bend);
            let number = last + step + bend;
            // The first number is a place and no step.
            step = if index == 0 { 0 } else { number - last };
            last = number;
        }
    }
}
