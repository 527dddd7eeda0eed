//! Text as strokes.

use super::drawing::{At, Drawing, Path, Stroke};
use super::glyphs::glyph;
use super::marks::{Marked, marked};
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
    scale * parts(character).0
}

/// Width of a character; its strokes, and those of its mark, with the place where each belongs.
fn parts(character: char) -> (f64, (&'static str, At), Option<(&'static str, At)>) {
    let at_once = |(width, strokes)| (width, (strokes, [0.0, 0.0]), None);
    if let Some(glyph) = glyph(character) {
        return at_once(glyph);
    }
    let of = |Marked { letter, mark, up }| {
        let (narrow, strokes) = glyph(letter)?;
        let width = f64::max(narrow, MARK);
        Some((width, (strokes, [0.5 * (width - narrow), 0.0]), Some((mark, [0.5 * width, up]))))
    };
    marked(character).and_then(of).unwrap_or(at_once(MISSING))
}

/// Room that a mark takes over a narrow letter, as in ï.
const MARK: f64 = 2.0;

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
        let (width, strokes, mark) = parts(character);
        for (strokes, [dx, dy]) in [strokes].into_iter().chain(mark) {
            for stroke in strokes.split(';').map(str::trim).filter(|stroke| !stroke.is_empty()).map(stroke) {
                path.0.extend(stroke.mapped(|[px, py]| [x + scale * (px + dx), up + scale * (py + dy)]).0);
            }
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
        let european = (' '..='~').chain('\u{a0}'..='ſ').chain('Α'..='Ρ').chain('Σ'..='ώ').chain('Ѐ'..='џ');
        for character in european.chain("≤≥−√→←≈€„“”’–—…ẞșț⁻⁹".chars()) {
            let (plain, ..) = plain(character);
            let (width, strokes, mark) = parts(plain);
            assert!(width > 0.0 && strokes.0 != MISSING.1, "{character:?} has no glyph");
            let strokes = [strokes].into_iter().chain(mark).flat_map(|(strokes, _)| strokes.split(';'));
            for text in strokes.map(str::trim).filter(|text| !text.is_empty()) {
                let words: Vec<&str> = text.split_whitespace().collect();
                let readable = words[1..].iter().all(|word| word.parse::<f64>().is_ok());
                let shape = matches!((words[0], words.len()), ("a", 7)) || (words[0] == "l" && words.len() % 2 == 1);
                assert!(readable && shape, "{character:?}: {text}");
            }
        }
    }

    #[test]
    fn a_character_that_was_never_drawn_is_a_box() {
        assert!("車🚗".chars().all(|character| parts(character).1.0 == MISSING.1));
    }
}
