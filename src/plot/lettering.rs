//! Text as strokes.

use super::drawing::{At, Drawing, Path, Stroke};
use super::glyphs::glyph;
use super::palette::Colour;

/// Height of a capital in a glyph's units.
const CAPITAL: f64 = 7.0;
/// Between two glyphs, in the same units.
const GAP: f64 = 1.35;
/// What stands high, as an exponent, is this much smaller …
const RAISED_SIZE: f64 = 0.68;
/// … and stands so high.
const RAISED_BY: f64 = 3.6;
/// What stands high, and what it is of ordinary size.
const RAISED: [(char, char); 12] = [
    ('⁰', '0'),
    ('¹', '1'),
    ('²', '2'),
    ('³', '3'),
    ('⁴', '4'),
    ('⁵', '5'),
    ('⁶', '6'),
    ('⁷', '7'),
    ('⁸', '8'),
    ('⁹', '9'),
    ('⁻', '-'),
    ('ⁿ', 'n'),
];

/// Size, weight and colour of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// Height of a capital \[px\].
    pub size: f64,
    /// Width of a stroke \[px\].
    pub weight: f64,
    /// Its colour.
    pub colour: Colour,
}

/// Which point of a text stands at the place given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

/// How wide a text is \[px\].
#[must_use]
pub fn width(text: &str, size: f64) -> f64 {
    let advances = text.chars().map(|character| advance(character) + GAP).sum::<f64>();
    (advances - GAP).max(0.0) * size / CAPITAL
}

/// The character of ordinary size, and its scale and height in glyph units.
fn plain(character: char) -> (char, f64, f64) {
    match RAISED.iter().find(|(raised, _)| *raised == character) {
        Some((_, plain)) => (*plain, RAISED_SIZE, RAISED_BY),
        None => (character, 1.0, 0.0),
    }
}

fn advance(character: char) -> f64 {
    let (character, scale, _) = plain(character);
    scale * glyph(character).map_or(MISSING.0, |(width, _)| width)
}

/// Stands for a character that has no glyph: an empty box.
const MISSING: (f64, &str) = (3.6, "l 0 0 3.6 0 3.6 7 0 7 0 0");

impl Drawing {
    /// Writes a text on the line through a place.
    pub fn text(&mut self, at: At, anchor: Anchor, text: &str, pen: Pen) {
        let path = outline(text).mapped(|p| place(p, at, anchor, text, pen.size));
        self.stroke(path, Stroke::full(pen.colour, pen.weight));
    }

    /// Writes a text upwards, its middle at a place.
    pub fn text_upwards(&mut self, at: At, text: &str, pen: Pen) {
        let path = outline(text).mapped(|p| {
            let [x, y] = place(p, [0.0, 0.0], Anchor::Middle, text, pen.size);
            [at[0] + y, at[1] - x]
        });
        self.stroke(path, Stroke::full(pen.colour, pen.weight));
    }
}

/// From glyph units to pixels.
fn place([x, y]: At, at: At, anchor: Anchor, text: &str, size: f64) -> At {
    let before = match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5,
        Anchor::End => 1.0,
    };
    let scale = size / CAPITAL;
    [at[0] - before * width(text, size) + scale * x, at[1] - scale * y]
}

/// A text's strokes in glyph units, y upwards.
fn outline(text: &str) -> Path {
    let (mut path, mut x) = (Path::default(), 0.0);
    for character in text.chars() {
        let (character, scale, up) = plain(character);
        let (width, strokes) = glyph(character).unwrap_or(MISSING);
        let drawn = strokes.split(';').map(str::trim).filter(|stroke| !stroke.is_empty()).map(stroke);
        for stroke in drawn {
            path.0.extend(stroke.mapped(|[px, py]| [x + scale * px, up + scale * py]).0);
        }
        x += scale * width + GAP;
    }
    path
}

/// One stroke of a glyph.
fn stroke(text: &str) -> Path {
    let mut words = text.split_whitespace();
    let kind = words.next();
    let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
    let mut path = Path::default();
    match (kind, numbers.as_slice()) {
        (Some("a"), [x, y, rx, ry, from, to]) => path.add_arc([*x, *y], [*rx, *ry], [*from, *to]),
        _ => path.add_line(numbers.chunks_exact(2).map(|point| [point[0], point[1]])),
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_as_wide_as_its_glyphs_and_the_gaps_between() {
        assert_eq!(width("", 7.0), 0.0);
        assert_eq!(width("0", 7.0), 4.4);
        assert_eq!(width("00", 7.0), 4.4 + GAP + 4.4);
        assert!(width("10⁻⁶", 7.0) < width("10-6", 7.0), "exponents are smaller");
    }

    #[test]
    fn every_glyph_is_made_of_strokes_that_can_be_read() {
        for character in (' '..='~').chain("×≤≥µμεωθΛ°±–−·√²³".chars()) {
            if "#$&@\\^`{}~".contains(character) {
                continue; // never drawn: an empty box stands for them
            }
            let (character, ..) = plain(character);
            let (width, strokes) = glyph(character).unwrap_or_else(|| panic!("{character:?} has no glyph"));
            assert!(width > 0.0);
            for text in strokes.split(';').map(str::trim).filter(|text| !text.is_empty()) {
                let words: Vec<&str> = text.split_whitespace().collect();
                let readable = words[1..].iter().all(|word| word.parse::<f64>().is_ok());
                let shape = matches!((words[0], words.len()), ("a", 7)) || (words[0] == "l" && words.len() % 2 == 1);
                assert!(readable && shape, "{character:?}: {text}");
            }
        }
    }
}
