//! A plot: curves over two axes.

use super::axis::{Axis, Range};
use super::drawing::{At, Drawing, Path, Stroke};
use super::labels::{Box2, Room};
use super::lettering::{Anchor, Pen, width};
use super::palette::{FAINT, GRID, INK, Look, PAPER};

/// What a plot shows.
#[derive(Clone, Debug)]
pub struct Figure {
    /// In large letters.
    pub title: String,
    /// Below it, in small ones; may be empty.
    pub subtitle: String,
    /// Along the bottom.
    pub x: Axis,
    /// Along the left side.
    pub y: Axis,
    /// The curves.
    pub series: Vec<Series>,
}

/// A curve.
#[derive(Clone, Debug)]
pub struct Series {
    /// What the legend calls it.
    pub name: String,
    /// How it looks.
    pub look: Look,
    /// Whether its points are joined.
    pub joined: bool,
    /// From one end to the other; those without a place on the axes are left out.
    pub points: Vec<Point>,
}

/// A point of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Along the bottom.
    pub x: f64,
    /// Along the left side.
    pub y: f64,
    /// Written beside it where there is room.
    pub label: Option<String>,
}

pub(super) const WIDTH: f64 = 760.0;
pub(super) const HEIGHT: f64 = 520.0;
/// The plot's own rectangle: left and right …
const SIDES: [f64; 2] = [78.0, WIDTH - 24.0];
/// … and bottom; the top depends on the legend.
const BOTTOM: f64 = HEIGHT - 62.0;

/// How much of a curve the legend shows.
const PIECE: f64 = 34.0;

const TITLE: Pen = Pen { size: 11.5, weight: 1.9, colour: INK };
const SUBTITLE: Pen = Pen { size: 8.4, weight: 1.0, colour: FAINT };
pub(super) const NAME: Pen = Pen { size: 8.8, weight: 1.15, colour: INK };
pub(super) const TICK: Pen = Pen { size: 8.4, weight: 1.05, colour: INK };
const LABEL: Pen = Pen { size: 7.2, weight: 0.9, colour: FAINT };

impl Figure {
    /// The plot on a page.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let (mut drawing, below) = headed(&self.title, &self.subtitle, SIDES);
        let top = self.draw_legend(&mut drawing, below + 6.0) + 8.0;
        let plot = Plot::new(self, top);
        plot.draw_axes(&mut drawing, self);
        let mut room = Room::new([SIDES[0] + 2.0, top + 2.0], [SIDES[1] - 2.0, BOTTOM - 2.0]);
        for series in &self.series {
            plot.draw_curve(&mut drawing, series, &mut room);
        }
        self.draw_labels(&mut drawing, &plot, &mut room);
        drawing
    }

    /// Names beside a piece of each curve, in as many rows as they need; gives where the last row ends.
    fn draw_legend(&self, drawing: &mut Drawing, top: f64) -> f64 {
        let (mut x, mut y) = (SIDES[0], top + 9.0);
        for series in &self.series {
            let wide = PIECE + 6.0 + width(&series.name, NAME.size);
            if x > SIDES[0] && x + wide > SIDES[1] {
                (x, y) = (SIDES[0], y + 18.0);
            }
            if series.joined {
                drawing.stroke(Path::line([[x, y], [x + PIECE, y]]), series.look.stroke());
            }
            series.look.mark(drawing, [x + 0.5 * PIECE, y]);
            drawing.text([x + PIECE + 6.0, y + 0.5 * NAME.size], Anchor::Start, &series.name, NAME);
            x += wide + 17.0;
        }
        y + 9.0
    }

    /// The ends of every curve first, for they say most.
    fn draw_labels(&self, drawing: &mut Drawing, plot: &Plot, room: &mut Room) {
        let order = |count: usize| {
            let mut order: Vec<usize> = (0..count).collect();
            order.sort_by_key(|i| usize::from(*i != 0 && *i + 1 != count));
            order
        };
        for series in &self.series {
            for i in order(series.points.len()) {
                let point = &series.points[i];
                let Some((label, at)) = point.label.as_ref().zip(plot.place(point)) else { continue };
                if let Some(start) = room.find(at, label, LABEL.size) {
                    drawing.text(start, Anchor::Start, label, LABEL);
                }
            }
        }
    }
}

/// A page with a title and a subtitle between two places, and where the subtitle ends.
pub(super) fn headed(title: &str, subtitle: &str, sides: [f64; 2]) -> (Drawing, f64) {
    let mut drawing = Drawing::new(WIDTH, HEIGHT, title);
    drawing.fill(Path::rect([0.0, 0.0], [WIDTH, HEIGHT]), PAPER);
    drawing.text([sides[0], 28.0], Anchor::Start, title, TITLE);
    let mut below = 36.0;
    for line in wrapped(subtitle, SUBTITLE.size, sides[1] - sides[0]) {
        below += 14.0;
        drawing.text([sides[0], below - 2.0], Anchor::Start, &line, SUBTITLE);
    }
    (drawing, below)
}

/// A text in lines no wider than that, broken between words.
fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= most => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The plot's rectangle with its two axes.
struct Plot {
    x: Range,
    y: Range,
    top: f64,
}

impl Plot {
    fn new(figure: &Figure, top: f64) -> Self {
        let points = || figure.series.iter().flat_map(|series| &series.points);
        let x = Range::around(figure.x.scale, points().map(|point| point.x));
        let y = Range::around(figure.y.scale, points().map(|point| point.y));
        Plot { x, y, top }
    }

    fn across(&self, place: f64) -> f64 {
        SIDES[0] + (SIDES[1] - SIDES[0]) * place
    }

    fn up(&self, place: f64) -> f64 {
        BOTTOM - (BOTTOM - self.top) * place
    }

    fn place(&self, point: &Point) -> Option<At> {
        Some([self.across(self.x.place(point.x)?), self.up(self.y.place(point.y)?)])
    }

    fn draw_axes(&self, drawing: &mut Drawing, figure: &Figure) {
        let grid = || Stroke::full(GRID, 1.0);
        for tick in self.x.ticks() {
            let Some(x) = self.x.place(tick.value).map(|place| self.across(place)) else { continue };
            drawing.stroke(Path::line([[x, self.top], [x, BOTTOM]]), grid());
            if let Some(label) = tick.label {
                drawing.text([x, BOTTOM + 19.0], Anchor::Middle, &label, TICK);
            }
        }
        for tick in self.y.ticks() {
            let Some(y) = self.y.place(tick.value).map(|place| self.up(place)) else { continue };
            drawing.stroke(Path::line([[SIDES[0], y], [SIDES[1], y]]), grid());
            if let Some(label) = tick.label {
                drawing.text([SIDES[0] - 9.0, y + 0.5 * TICK.size], Anchor::End, &label, TICK);
            }
        }
        drawing
            .stroke(Path::line([[SIDES[0], self.top], [SIDES[0], BOTTOM], [SIDES[1], BOTTOM]]), Stroke::full(INK, 1.2));
        drawing.text([0.5 * (SIDES[0] + SIDES[1]), HEIGHT - 16.0], Anchor::Middle, &figure.x.label, NAME);
        drawing.text_upwards([24.0, 0.5 * (self.top + BOTTOM)], &figure.y.label, NAME);
    }

    /// Line and markers, and what they leave of the room.
    fn draw_curve(&self, drawing: &mut Drawing, series: &Series, room: &mut Room) {
        let places: Vec<At> = series.points.iter().filter_map(|point| self.place(point)).collect();
        if series.joined && places.len() > 1 {
            drawing.stroke(Path::line(places.iter().copied()), series.look.stroke());
            places.windows(2).for_each(|pair| room.cross([pair[0], pair[1]]));
        }
        for at in places {
            series.look.mark(drawing, at);
            room.take(Box2::around(at, 5.0));
        }
    }
}
