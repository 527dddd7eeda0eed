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

/// Blue over white to red (Brewer 2003), for what has a sign: colour-blind eyes see blue and a brownish yellow.
const SIDES: [Colour; 11] = [
    [5, 48, 97],
    [33, 102, 172],
    [67, 147, 195],
    [146, 197, 222],
    [209, 229, 240],
    [247, 247, 247],
    [253, 219, 199],
    [244, 165, 130],
    [214, 96, 77],
    [178, 24, 43],
    [103, 0, 31],
];

/// The colour of a share from 0, least, to 1, most.
#[must_use]
pub fn sequential(share: f64) -> Colour {
    between(&SEQUENCE, share)
}

/// The same where ½ is 0: blue below, white there, red above.
#[must_use]
pub fn diverging(share: f64) -> Colour {
    between(&SIDES, share)
}

fn between(stops: &[Colour], share: f64) -> Colour {
    let along = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let below = (along as usize).min(stops.len() - 2);
    let part = along - below as f64;
    std::array::from_fn(|channel| {
        let [low, high] = [below, below + 1].map(|stop| f64::from(stops[stop][channel]));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What eyes without one kind of cone make of a colour (Viénot, Brettel and Mollon 1999), in linear light.
    fn seen(colour: Colour, rows: [[f64; 3]; 3]) -> [f64; 3] {
        let linear = colour.map(|channel| libm::pow(f64::from(channel) / 255.0, 2.2));
        rows.map(|row| row.iter().zip(linear).map(|(share, channel)| share * channel).sum::<f64>().clamp(0.0, 1.0))
    }

    #[test]
    fn the_two_sides_stay_apart_for_colour_blind_eyes() {
        let usual = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let no_red = [[0.112, 0.888, 0.0], [0.112, 0.888, 0.0], [0.004, -0.004, 1.0]];
        let no_green = [[0.293, 0.707, 0.0], [0.293, 0.707, 0.0], [-0.022, 0.022, 1.0]];
        for eyes in [usual, no_red, no_green] {
            for side in [0.1, 0.2, 0.3, 0.4] {
                // What tells sides apart, whatever the light: the share of blue in it.
                let blue = |share| {
                    let [red, green, blue] = seen(diverging(share), eyes);
                    blue / (red + green + blue)
                };
                assert!(blue(0.5 - side) > 1.0 / 3.0 + 0.02 && blue(0.5 + side) < 1.0 / 3.0 - 0.02, "{side} {eyes:?}");
            }
        }
        assert_eq!(diverging(0.5), [247, 247, 247]);
    }
}
