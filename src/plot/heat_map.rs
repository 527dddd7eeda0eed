//! A plot: a quantity over two others, as colours.

use super::axis::Range;
use super::drawing::{Drawing, Path, Stroke};
use super::figure::{HEIGHT, NAME, TICK, WIDTH, headed};
use super::lettering::Anchor;
use super::palette::{Colour, FAINT, GRID, INK, diverging, sequential};

/// What a heat map shows.
#[derive(Clone, Debug)]
pub struct HeatMap {
    /// In large letters.
    pub title: String,
    /// Below it, in small ones; may be empty.
    pub subtitle: String,
    /// What is along the bottom, with its unit.
    pub x: String,
    /// What is along the left side.
    pub y: String,
    /// What the colours tell.
    pub value: String,
    /// Where columns of cells begin and end, rising: one more than there are columns.
    pub x_edges: Vec<f64>,
    /// The same for rows.
    pub y_edges: Vec<f64>,
    /// The cells, row by row from below; grey where there is nothing. Numbers on both sides of 0 have colours that part there.
    pub cells: Vec<Option<f64>>,
}

/// Left and right of the cells.
const SIDES: [f64; 2] = [84.0, WIDTH - 128.0];
/// Below them.
const BOTTOM: f64 = HEIGHT - 62.0;
/// Left and right of the scale.
const SCALE: [f64; 2] = [WIDTH - 104.0, WIDTH - 84.0];
/// Steps of the scale.
const STEPS: usize = 64;
/// Numbers that reach less far to one side of 0 are thought of as those of the other side, with what rounding makes of 0.
const LEAST_SIDE: f64 = 0.01;

impl HeatMap {
    /// The plot on a page.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let (mut drawing, below) = headed(&self.title, &self.subtitle, [SIDES[0], SCALE[1]]);
        let plot = self.plot(below + 14.0);
        let [x, y] = [&self.x_edges, &self.y_edges].map(|edges| span(edges));
        self.draw_cells(&mut drawing, &plot, &x, &y);
        self.draw_axes(&mut drawing, &plot, &x, &y);
        self.draw_scale(&mut drawing, &plot);
        drawing
    }

    fn plot(&self, top: f64) -> Plot {
        let numbers = || self.cells.iter().filter_map(|cell| *cell).filter(|number| number.is_finite());
        let (low, high) = numbers().fold((0.0, 0.0), |(low, high): (f64, f64), n| (low.min(n), high.max(n)));
        let (least, most) = (high.min(-low), high.max(-low));
        if least <= LEAST_SIDE * most {
            let values = Range::around(super::Scale::Linear, numbers());
            return Plot { top, values, colours: sequential, nothing: GRID };
        }
        let values = Range::around(super::Scale::Linear, [-most, most].into_iter());
        Plot { top, values, colours: diverging, nothing: FAINT }
    }

    fn draw_cells(&self, drawing: &mut Drawing, plot: &Plot, x: &Range, y: &Range) {
        let columns = self.x_edges.len().saturating_sub(1).max(1);
        for (place, cell) in self.cells.iter().enumerate() {
            let (row, column) = (place / columns, place % columns);
            // Whole pixels: no paper shines through between two cells.
            let [left, right] = [column, column + 1].map(|edge| plot.across(x.place(self.x_edges[edge])).round());
            let [low, high] = [row, row + 1].map(|edge| plot.up(y.place(self.y_edges[edge])).round());
            drawing.fill(Path::rect([left, high], [right, low]), plot.colour(*cell));
        }
    }

    fn draw_axes(&self, drawing: &mut Drawing, plot: &Plot, x: &Range, y: &Range) {
        for tick in x.ticks() {
            let at = plot.across(x.place(tick.value));
            drawing.stroke(Path::line([[at, BOTTOM], [at, BOTTOM + 5.0]]), Stroke::full(INK, 1.0));
            drawing.text([at, BOTTOM + 20.0], Anchor::Middle, &tick.label.unwrap_or_default(), TICK);
        }
        for tick in y.ticks() {
            let at = plot.up(y.place(tick.value));
            drawing.stroke(Path::line([[SIDES[0] - 5.0, at], [SIDES[0], at]]), Stroke::full(INK, 1.0));
            let label = tick.label.unwrap_or_default();
            drawing.text([SIDES[0] - 9.0, at + 0.5 * TICK.size], Anchor::End, &label, TICK);
        }
        drawing.stroke(Path::rect([SIDES[0], plot.top], [SIDES[1], BOTTOM]), Stroke::full(INK, 1.2));
        drawing.text([0.5 * (SIDES[0] + SIDES[1]), HEIGHT - 16.0], Anchor::Middle, &self.x, NAME);
        drawing.text_upwards([24.0, 0.5 * (plot.top + BOTTOM)], &self.y, NAME);
    }

    /// Which colour is which value.
    fn draw_scale(&self, drawing: &mut Drawing, plot: &Plot) {
        for step in 0..STEPS {
            let [low, high] = [step, step + 1].map(|edge| plot.up(Some(edge as f64 / STEPS as f64)).round());
            let colour = (plot.colours)((step as f64 + 0.5) / STEPS as f64);
            drawing.fill(Path::rect([SCALE[0], high], [SCALE[1], low]), colour);
        }
        for tick in plot.values.ticks() {
            let at = plot.up(plot.values.place(tick.value));
            drawing.stroke(Path::line([[SCALE[1], at], [SCALE[1] + 5.0, at]]), Stroke::full(INK, 1.0));
            let label = tick.label.unwrap_or_default();
            drawing.text([SCALE[1] + 9.0, at + 0.5 * TICK.size], Anchor::Start, &label, TICK);
        }
        drawing.stroke(Path::rect([SCALE[0], plot.top], [SCALE[1], BOTTOM]), Stroke::full(INK, 1.2));
        drawing.text_upwards([WIDTH - 12.0, 0.5 * (plot.top + BOTTOM)], &self.value, NAME);
    }
}

/// From the first edge to the last.
fn span(edges: &[f64]) -> Range {
    Range::exactly(edges.first().copied().unwrap_or(0.0), edges.last().copied().unwrap_or(1.0))
}

/// The rectangle of the cells, and what colours stand for.
struct Plot {
    top: f64,
    values: Range,
    /// The colour of a share of them, and of nothing.
    colours: fn(f64) -> Colour,
    nothing: Colour,
}

impl Plot {
    fn across(&self, place: Option<f64>) -> f64 {
        SIDES[0] + (SIDES[1] - SIDES[0]) * place.unwrap_or(0.0)
    }

    fn up(&self, place: Option<f64>) -> f64 {
        BOTTOM - (BOTTOM - self.top) * place.unwrap_or(0.0)
    }

    fn colour(&self, cell: Option<f64>) -> Colour {
        cell.and_then(|value| self.values.place(value)).map_or(self.nothing, self.colours)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The colours of the cells.
    fn colours(cells: &[f64]) -> Vec<Colour> {
        let map = HeatMap {
            title: String::new(),
            subtitle: String::new(),
            x: String::new(),
            y: String::new(),
            value: String::new(),
            x_edges: (0..=cells.len()).map(|edge| edge as f64).collect(),
            y_edges: vec![0.0, 1.0],
            cells: cells.iter().map(|cell| Some(*cell)).collect(),
        };
        let plot = map.plot(0.0);
        map.cells.iter().map(|cell| plot.colour(*cell)).collect()
    }

    #[test]
    fn numbers_of_both_signs_part_at_nought() {
        let found = colours(&[-1.0, 0.0, 4.0]);
        assert_eq!(found, [diverging(0.375), diverging(0.5), diverging(1.0)]);
        assert_eq!(colours(&[-4.0, 4.0]), [diverging(0.0), diverging(1.0)]);
        for one_sided in [[0.0, 4.0], [-1e-9, 4.0], [2.0, 4.0], [-4.0, 0.0], [-4.0, 1e-9]] {
            assert!(colours(&one_sided).iter().all(|colour| *colour != diverging(0.5)), "{one_sided:?}");
            assert!([sequential(0.0), sequential(1.0)].contains(&colours(&one_sided)[1]), "{one_sided:?}");
        }
    }
}
