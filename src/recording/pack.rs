//! Whole numbers that are mostly small, as bytes: how many bytes each has that say something, then those bytes.
//!
//! The two kinds are kept apart: sizes repeat and deflate to almost nothing, the bytes of a surprise deflate to nothing less.

use std::ops::Range;

/// Numbers being packed.
#[derive(Default)]
pub(super) struct Pack {
    sizes: Vec<u8>,
    /// What is packed, and zeros for what may follow: of a number all eight bytes are written, and then fewer are kept. That is
    /// cheaper than to copy a number of bytes that is not known.
    bytes: Vec<u8>,
    filled: usize,
}

impl Pack {
    /// Forgets all numbers, and keeps their room.
    pub(super) fn clear(&mut self) {
        self.sizes.clear();
        self.filled = 0;
    }

    pub(super) fn put(&mut self, number: u64) {
        self.put_all([number]);
    }

    /// A number by its distance from what it was expected to be, in steps of the last bit: every bit of it can be told from that.
    pub(super) fn put_near(&mut self, expected: f64, number: f64) {
        self.put_all([distance(expected, number)]);
    }

    /// The same of several.
    pub(super) fn put_all_near<const N: usize>(&mut self, expected: [f64; N], numbers: [f64; N]) {
        self.put_all::<N>(std::array::from_fn(|i| distance(expected[i], numbers[i])));
    }

    #[inline]
    fn put_all<const N: usize>(&mut self, numbers: [u64; N]) {
        if self.bytes.len() < self.filled + 8 * N {
            self.make_room(8 * N);
        }
        let sizes = numbers.map(|number| 8 - number.leading_zeros() as u8 / 8);
        for (number, size) in numbers.into_iter().zip(sizes) {
            self.bytes[self.filled..self.filled + 8].copy_from_slice(&number.to_le_bytes());
            self.filled += usize::from(size);
        }
        self.sizes.extend_from_slice(&sizes);
    }

    #[cold]
    fn make_room(&mut self, bytes: usize) {
        self.bytes.resize((self.filled + bytes).max(2 * self.bytes.len()).max(64), 0);
    }

    fn bytes(&self) -> &[u8] {
        &self.bytes[..self.filled]
    }
}

/// Adds packs to a block as one: two lengths, then the two kinds. Gives where those stand that deflate to nothing less.
pub(super) fn append(packs: &[&Pack], block: &mut Vec<u8>) -> Range<usize> {
    let length = |of: fn(&Pack) -> usize| packs.iter().map(|pack| of(pack) as u64).sum::<u64>().to_le_bytes();
    block.extend(length(|pack| pack.sizes.len()));
    block.extend(length(|pack| pack.filled));
    packs.iter().for_each(|pack| block.extend_from_slice(&pack.sizes));
    let start = block.len();
    packs.iter().for_each(|pack| block.extend_from_slice(pack.bytes()));
    start..block.len()
}

fn distance(expected: f64, number: f64) -> u64 {
    let distance = rank(number).wrapping_sub(rank(expected)) as i64;
    ((distance << 1) ^ (distance >> 63)) as u64
}

/// Numbers being unpacked; `None` wherever the bytes are not what [`Pack`] writes.
pub(super) struct Unpack<'a> {
    sizes: &'a [u8],
    bytes: &'a [u8],
}

impl<'a> Unpack<'a> {
    /// Takes a pack from the front of a block.
    pub(super) fn take_from(block: &mut &'a [u8]) -> Option<Self> {
        let [sizes, bytes] = [length(block)?, length(block)?];
        Some(Unpack { sizes: take(block, sizes)?, bytes: take(block, bytes)? })
    }

    pub(super) fn get(&mut self) -> Option<u64> {
        let size = usize::from(take(&mut self.sizes, 1)?[0]);
        let mut number = [0; 8];
        number.get_mut(..size)?.copy_from_slice(take(&mut self.bytes, size)?);
        Some(u64::from_le_bytes(number))
    }

    pub(super) fn get_near(&mut self, expected: f64) -> Option<f64> {
        let zigzag = self.get()?;
        let distance = (zigzag >> 1) as i64 ^ -((zigzag & 1) as i64);
        Some(unrank(rank(expected).wrapping_add(distance as u64)))
    }

    /// A count of things of which each takes a number at least: never more than are left, so that nothing is made room for
    /// that is not there.
    pub(super) fn count(&mut self) -> Option<usize> {
        let count = self.get()?;
        usize::try_from(count).ok().filter(|count| self.has(*count))
    }

    /// Whether so many numbers are left.
    pub(super) fn has(&self, count: usize) -> bool {
        count <= self.sizes.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.sizes.is_empty() && self.bytes.is_empty()
    }
}

fn length(block: &mut &[u8]) -> Option<usize> {
    let bytes = take(block, 8)?;
    usize::try_from(u64::from_le_bytes(bytes.try_into().ok()?)).ok()
}

fn take<'a>(bytes: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (taken, rest) = bytes.split_at_checked(count)?;
    *bytes = rest;
    Some(taken)
}

const SIGN: u64 = 1 << 63;

/// Where a number stands among all f64 in order.
fn rank(number: f64) -> u64 {
    let bits = number.to_bits();
    if bits & SIGN == 0 { bits | SIGN } else { !bits }
}

fn unrank(rank: u64) -> f64 {
    f64::from_bits(if rank & SIGN == 0 { !rank } else { rank & !SIGN })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_comes_back_whatever_was_expected() {
        let numbers =
            [0.0, -0.0, 1.0, -1.0, 1.0 + f64::EPSILON, f64::MAX, f64::MIN_POSITIVE, f64::NEG_INFINITY, 5e-324];
        let mut pack = Pack::default();
        let pairs = || numbers.into_iter().flat_map(|a| numbers.map(|b| (a, b)));
        pairs().for_each(|(expected, number)| pack.put_near(expected, number));
        let mut block = Vec::new();
        append(&[&pack], &mut block);
        let mut rest = block.as_slice();
        let mut unpack = Unpack::take_from(&mut rest).expect("a pack");
        for (expected, number) in pairs() {
            assert_eq!(unpack.get_near(expected).map(f64::to_bits), Some(number.to_bits()));
        }
        assert!(unpack.is_empty() && rest.is_empty() && unpack.get().is_none());
    }

    #[test]
    fn what_was_foretold_takes_no_bytes_and_a_bit_more_takes_one() {
        let mut pack = Pack::default();
        pack.put_near(0.1, 0.1);
        pack.put_near(0.1, 0.1 + 1e-18);
        pack.put_near(1.0, 1.0 + f64::EPSILON);
        assert_eq!((pack.sizes.as_slice(), pack.bytes()), ([0, 0, 1].as_slice(), [2].as_slice()));
    }
}
