//! Shapes on a page, in pixels from the top left corner, before they become a file.

use super::palette::Colour;

/// A page with shapes on it, the first drawn at the bottom.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// Pixels across.
    pub width: f64,
    /// Pixels down.
    pub height: f64,
    /// What the picture shows, for those who cannot see it.
    pub title: String,
    /// In the order in which they are drawn.
    pub shapes: Vec<Shape>,
}

/// A path with its paint.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Where the pen goes.
    pub path: Path,
    /// What fills it.
    pub fill: Option<Colour>,
    /// What draws its line.
    pub stroke: Option<Stroke>,
}

/// A line's paint; ends and joints are round.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width \[px\].
    pub width: f64,
    /// Lengths on and off \[px\]; empty: a full line.
    pub dash: Vec<f64>,
}

impl Stroke {
    /// A full line.
    #[must_use]
    pub fn full(colour: Colour, width: f64) -> Self {
        Stroke { colour, width, dash: Vec::new() }
    }
}

/// A place on the page.
pub type At = [f64; 2];

/// A step of the pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Lifted, and put down there.
    Move(At),
    /// Straight.
    Line(At),
    /// A cubic Bézier curve: two control points, and the end.
    Curve(At, At, At),
    /// Straight back to where it was put down.
    Close,
}

/// Where a pen goes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path(pub Vec<Segment>);

impl Path {
    /// Straight lines from point to point.
    pub fn line(points: impl IntoIterator<Item = At>) -> Self {
        let mut path = Path::default();
        path.add_line(points);
        path
    }

    /// The same, closed.
    pub fn polygon(points: impl IntoIterator<Item = At>) -> Self {
        let mut path = Path::line(points);
        path.0.push(Segment::Close);
        path
    }

    /// A rectangle with sides along the page's.
    #[must_use]
    pub fn rect(low: At, high: At) -> Self {
        Path::polygon([low, [high[0], low[1]], high, [low[0], high[1]]])
    }

    /// A circle.
    #[must_use]
    pub fn circle(centre: At, radius: f64) -> Self {
        let mut path = Path::default();
        path.add_arc(centre, [radius, radius], [0.0, 360.0]);
        path.0.push(Segment::Close);
        path
    }

    /// Straight lines from point to point, the pen lifted before.
    pub fn add_line(&mut self, points: impl IntoIterator<Item = At>) {
        for (i, point) in points.into_iter().enumerate() {
            self.0.push(if i == 0 { Segment::Move(point) } else { Segment::Line(point) });
        }
    }

    /// An arc of an ellipse between two angles in degrees, the pen lifted before. A Bézier curve per quarter at most: it
    /// strays from the ellipse by 3e-4 of its radius.
    pub fn add_arc(&mut self, centre: At, radii: At, angles: [f64; 2]) {
        let [from, to] = angles.map(f64::to_radians);
        let pieces = libm::ceil((to - from).abs() / std::f64::consts::FRAC_PI_2).max(1.0);
        let turn = (to - from) / pieces;
        let reach = 4.0 / 3.0 * libm::tan(turn / 4.0);
        let point = |angle: f64, along: f64| {
            let (sin, cos) = libm::sincos(angle);
            [centre[0] + radii[0] * (cos - along * sin), centre[1] + radii[1] * (sin + along * cos)]
        };
        self.0.push(Segment::Move(point(from, 0.0)));
        for piece in 0..pieces as usize {
            let (start, end) = (from + turn * piece as f64, from + turn * (piece + 1) as f64);
            self.0.push(Segment::Curve(point(start, reach), point(end, -reach), point(end, 0.0)));
        }
    }

    /// The same path with every point moved.
    #[must_use]
    pub fn mapped(&self, map: impl Fn(At) -> At) -> Self {
        let segment = |segment: &Segment| match *segment {
            Segment::Move(to) => Segment::Move(map(to)),
            Segment::Line(to) => Segment::Line(map(to)),
            Segment::Curve(a, b, to) => Segment::Curve(map(a), map(b), map(to)),
            Segment::Close => Segment::Close,
        };
        Path(self.0.iter().map(segment).collect())
    }
}

impl Drawing {
    /// An empty page.
    #[must_use]
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        Drawing { width, height, title: title.to_owned(), shapes: Vec::new() }
    }

    /// Draws a line.
    pub fn stroke(&mut self, path: Path, stroke: Stroke) {
        self.shapes.push(Shape { path, fill: None, stroke: Some(stroke) });
    }

    /// Fills an area.
    pub fn fill(&mut self, path: Path, colour: Colour) {
        self.shapes.push(Shape { path, fill: Some(colour), stroke: None });
    }
}
