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

    /// What each number differs from what is expected of it after the one before. Where `turn` is not 0 numbers are angles, of
    /// which so many are half a turn, and each is taken round as often as brings it nearest to where it is expected.
    pub(super) fn put_expected(
        &mut self,
        numbers: impl IntoIterator<Item = i64>,
        turn: i64,
        expected: impl Fn(usize, i64) -> i64,
    ) {
        let mut last = 0;
        for (index, number) in numbers.into_iter().enumerate() {
            let expected = expected(index, last);
            let mut surprise = number - expected;
            if turn != 0 {
                surprise = (surprise + turn).rem_euclid(2 * turn) - turn;
            }
            self.put(surprise);
            last = expected + surprise;
        }
    }
}
