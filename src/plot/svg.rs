//! A drawing as SVG.

use std::fmt::Write as _;

use super::drawing::{At, Drawing, Path, Segment, Shape};
use super::palette::Colour;

/// The drawing as an SVG document, which needs no font and no style sheet.
#[must_use]
pub fn svg(drawing: &Drawing) -> String {
    let Drawing { width, height, title, shapes } = drawing;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         role=\"img\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>{}</title>\n",
        escaped(title)
    );
    for shape in shapes {
        text += &element(shape);
    }
    text + "</svg>\n"
}

fn element(Shape { path, fill, stroke }: &Shape) -> String {
    let mut text = "<path".to_owned();
    if let Some(fill) = fill {
        let _ = write!(text, " fill=\"{}\"", hexadecimal(*fill));
    }
    if let Some(stroke) = stroke {
        let _ = write!(text, " stroke=\"{}\" stroke-width=\"{}\"", hexadecimal(stroke.colour), short(stroke.width));
        if !stroke.dash.is_empty() {
            let dash: Vec<String> = stroke.dash.iter().map(|length| short(*length)).collect();
            let _ = write!(text, " stroke-dasharray=\"{}\"", dash.join(" "));
        }
    }
    let _ = writeln!(text, " d=\"{}\"/>", data(path));
    text
}

fn data(path: &Path) -> String {
    let mut text = String::new();
    let mut say = |letter: &str, points: &[At]| {
        text += letter;
        text += &points.iter().map(|[x, y]| format!("{} {}", short(*x), short(*y))).collect::<Vec<_>>().join(" ");
    };
    for segment in &path.0 {
        match *segment {
            Segment::Move(to) => say("M", &[to]),
            Segment::Line(to) => say("L", &[to]),
            Segment::Curve(a, b, to) => say("C", &[a, b, to]),
            Segment::Close => say("Z", &[]),
        }
    }
    text
}

/// To a tenth of a pixel.
fn short(number: f64) -> String {
    let text = format!("{number:.1}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn hexadecimal([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
