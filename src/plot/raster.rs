//! A drawing as PNG.

use tiny_skia::{FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, StrokeDash, Transform};

use super::drawing::{At, Drawing, Path, Segment, Shape};
use super::palette::{Colour, PAPER};

/// The drawing as a PNG file, so many pixels for each of the drawing's. `None` when it is too large for one, or has no
/// size.
#[must_use]
pub fn png(drawing: &Drawing, scale: f64) -> Option<Vec<u8>> {
    pixels(drawing, scale)?.encode_png().ok()
}

/// The drawing as pixels. `None` when it is too large, or has no size.
#[must_use]
pub(crate) fn pixels(drawing: &Drawing, scale: f64) -> Option<Pixmap> {
    let size = |length: f64| libm::ceil(length * scale) as u32;
    let mut pixmap = Pixmap::new(size(drawing.width), size(drawing.height))?;
    pixmap.fill(paint(PAPER));
    let transform = Transform::from_scale(scale as f32, scale as f32);
    for shape in &drawing.shapes {
        draw(&mut pixmap, shape, transform);
    }
    Some(pixmap)
}

fn draw(pixmap: &mut Pixmap, Shape { path, fill, stroke }: &Shape, transform: Transform) {
    let Some(path) = outline(path) else { return };
    let mut brush = Paint { anti_alias: true, ..Paint::default() };
    if let Some(fill) = fill {
        brush.set_color(paint(*fill));
        pixmap.fill_path(&path, &brush, FillRule::Winding, transform, None);
    }
    if let Some(stroke) = stroke {
        brush.set_color(paint(stroke.colour));
        let dash = StrokeDash::new(stroke.dash.iter().map(|length| *length as f32).collect(), 0.0);
        let line = tiny_skia::Stroke {
            width: stroke.width as f32,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            dash,
            ..tiny_skia::Stroke::default()
        };
        pixmap.stroke_path(&path, &brush, &line, transform, None);
    }
}

fn paint([r, g, b]: Colour) -> tiny_skia::Color {
    tiny_skia::Color::from_rgba8(r, g, b, 255)
}

fn outline(path: &Path) -> Option<tiny_skia::Path> {
    let mut builder = PathBuilder::new();
    let f = |[x, y]: At| (x as f32, y as f32);
    for segment in &path.0 {
        match *segment {
            Segment::Move(to) => builder.move_to(f(to).0, f(to).1),
            Segment::Line(to) => builder.line_to(f(to).0, f(to).1),
            Segment::Curve(a, b, to) => builder.cubic_to(f(a).0, f(a).1, f(b).0, f(b).1, f(to).0, f(to).1),
            Segment::Close => builder.close(),
        }
    }
    builder.finish()
}
