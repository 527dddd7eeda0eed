//! Colours, dashes and markers that stay apart for colour-blind people, in print and in grey.

use super::drawing::{At, Drawing, Path, Shape, Stroke};

/// Red, green, blue.
pub type Colour = [u8; 3];

/// The page.
pub const PAPER: Colour = [255, 255, 255];
/// Text and axes.
pub const INK: Colour = [38, 38, 38];
/// Text that may be skipped.
pub const FAINT: Colour = [110, 110, 110];
/// Lines behind the data.
pub const GRID: Colour = [228, 228, 228];

/// The colours of Okabe and Ito (2008) that show on white, darkest contrasts first.
const COLOURS: [Colour; 6] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [230, 159, 0]];

/// A colour let down with the page's: all of it at 1, none at 0.
#[must_use]
pub fn tint(colour: Colour, strength: f64) -> Colour {
    let mixed = |i: usize| f64::from(PAPER[i]) + (f64::from(colour[i]) - f64::from(PAPER[i])) * strength;
    [0, 1, 2].map(|i| mixed(i).round() as u8)
}

const DASHES: [&[f64]; 6] = [&[], &[7.0, 4.0], &[1.5, 4.0], &[8.0, 4.0, 1.5, 4.0], &[3.0, 3.0], &[12.0, 4.0]];

/// Viridis (Smith and van der Walt 2015), from least to most: evenly spaced to the eye, also to a colour-blind one, and in grey.
const SEQUENCE: [Colour; 10] = [
    [68, 1, 84],
    [72, 40, 120],
    [62, 73, 137],
    [49, 104, 142],
    [38, 130, 142],
    [31, 158, 137],
    [53, 183, 121],
    [110, 206, 88],
    [181, 222, 43],
    [253, 231, 37],
];

/// The colour of a share from 0, least, to 1, most.
#[must_use]
pub fn sequential(share: f64) -> Colour {
    let along = share.clamp(0.0, 1.0) * (SEQUENCE.len() - 1) as f64;
    let below = (along as usize).min(SEQUENCE.len() - 2);
    let part = along - below as f64;
    std::array::from_fn(|channel| {
        let [low, high] = [below, below + 1].map(|stop| f64::from(SEQUENCE[stop][channel]));
        (low + (high - low) * part).round() as u8
    })
}

/// How one curve looks: each number has a colour, a dash and a marker of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look(pub usize);

impl Look {
    /// Its colour.
    #[must_use]
    pub fn colour(self) -> Colour {
        COLOURS[self.0 % COLOURS.len()]
    }

    /// Its line.
    #[must_use]
    pub fn stroke(self) -> Stroke {
        Stroke { colour: self.colour(), width: 2.0, dash: DASHES[self.0 % DASHES.len()].to_vec() }
    }

    /// Puts its marker on a page.
    pub fn mark(self, drawing: &mut Drawing, at: At) {
        let [x, y] = at;
        let around = |corners: &[At]| Path::polygon(corners.iter().map(|[dx, dy]| [x + dx, y + dy]));
        let path = match self.0 % 6 {
            0 => Path::circle(at, 4.2),
            1 => Path::rect([x - 3.8, y - 3.8], [x + 3.8, y + 3.8]),
            2 => around(&[[0.0, -5.2], [4.8, 3.4], [-4.8, 3.4]]),
            3 => around(&[[0.0, -5.4], [5.4, 0.0], [0.0, 5.4], [-5.4, 0.0]]),
            4 => around(&[[0.0, 5.2], [4.8, -3.4], [-4.8, -3.4]]),
            _ => around(&[[-4.6, -2.2], [4.6, -2.2], [4.6, 2.2], [-4.6, 2.2]]),
        };
        let stroke = Some(Stroke::full(PAPER, 1.2));
        drawing.shapes.push(Shape { path, fill: Some(self.colour()), stroke });
    }
}
