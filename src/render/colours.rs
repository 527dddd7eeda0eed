//! The 255 colours of a moving picture, and the nearest of them to any other.

use std::collections::BTreeMap;

/// The entry that stands for "as before".
pub(super) const UNCHANGED: u8 = 255;
/// Entries for colours.
const MOST: usize = UNCHANGED as usize;

/// A table of colours.
pub(super) struct Colours {
    table: Vec<[u8; 3]>,
    known: BTreeMap<[u8; 3], u8>,
}

impl Colours {
    /// The colours that are there most often: drawings are made of few, and the rest is the edges between them.
    pub(super) fn of<'a>(pictures: impl Iterator<Item = &'a [[u8; 3]]>) -> Self {
        let mut counts: BTreeMap<[u8; 3], u64> = BTreeMap::new();
        for colour in pictures.flatten() {
            *counts.entry(coarse(*colour)).or_default() += 1;
        }
        let mut most: Vec<([u8; 3], u64)> = counts.into_iter().collect();
        most.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let table = most.into_iter().take(MOST).map(|(colour, _)| colour).collect();
        Colours { table, known: BTreeMap::new() }
    }

    /// Red, green, blue of every entry, as files have them.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.table.concat();
        bytes.resize(3 * (MOST + 1), 0);
        bytes
    }

    /// The entry nearest to a colour.
    pub(super) fn nearest(&mut self, colour: [u8; 3]) -> u8 {
        let colour = coarse(colour);
        let table = &self.table;
        *self.known.entry(colour).or_insert_with(|| {
            let far = |other: &[u8; 3]| (0..3).map(|i| i32::from(other[i].abs_diff(colour[i])).pow(2)).sum::<i32>();
            let nearest = table.iter().enumerate().min_by_key(|(_, other)| far(other));
            nearest.map_or(0, |(index, _)| index as u8)
        })
    }
}

/// To 6 bits a part: what differs by less cannot be told apart.
fn coarse(colour: [u8; 3]) -> [u8; 3] {
    colour.map(|part| part & 0xfc | part >> 6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_there_most_often_is_kept_and_the_rest_comes_near() {
        let many: Vec<[u8; 3]> = (0..=255u8).flat_map(|grey| vec![[grey, grey, grey]; 3]).collect();
        let mut colours = Colours::of([many.as_slice(), &[[255, 255, 255], [250, 0, 0]]].into_iter());
        let white = colours.nearest([255, 255, 255]);
        assert_eq!(colours.bytes()[3 * usize::from(white)..][..3], [255, 255, 255]);
        let red = colours.nearest([255, 4, 0]);
        assert_eq!(colours.bytes()[3 * usize::from(red)..][..3], coarse([250, 0, 0]));
        assert_eq!(colours.bytes().len(), 768);
    }
}
