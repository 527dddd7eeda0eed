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

/// A path to a tenth of a pixel, each point counted from the last, which halves the file.
fn data(path: &Path) -> String {
    let (mut text, mut at, mut start) = (String::new(), [0i64; 2], [0i64; 2]);
    for segment in &path.0 {
        let (letter, points): (char, &[At]) = match segment {
            Segment::Move(to) => ('m', &[*to]),
            Segment::Line(to) => ('l', &[*to]),
            Segment::Curve(a, b, to) => ('c', &[*a, *b, *to]),
            Segment::Close => ('z', &[]),
        };
        text.push(letter);
        let points: Vec<[i64; 2]> =
            points.iter().map(|point| point.map(|place| (10.0 * place).round() as i64)).collect();
        for (i, number) in points.iter().flat_map(|point| [point[0] - at[0], point[1] - at[1]]).enumerate() {
            let separator = if i > 0 && number >= 0 { " " } else { "" };
            text += &format!("{separator}{}", tenths(number));
        }
        match (segment, points.last()) {
            (Segment::Close, _) => at = start,
            (Segment::Move(_), Some(to)) => (at, start) = (*to, *to),
            (_, Some(to)) => at = *to,
            (_, None) => {}
        }
    }
    text
}

/// A number of tenths, as short as it can be written: `-.5`, `12`, `3.1`.
fn tenths(number: i64) -> String {
    let (sign, whole, tenth) = (if number < 0 { "-" } else { "" }, number.abs() / 10, number.abs() % 10);
    match (whole, tenth) {
        (_, 0) => format!("{sign}{whole}"),
        (0, _) => format!("{sign}.{tenth}"),
        _ => format!("{sign}{whole}.{tenth}"),
    }
}

/// To a hundredth.
fn short(number: f64) -> String {
    crate::output::numbers::trimmed(&format!("{number:.2}")).to_owned()
}

fn hexadecimal([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_counted_from_the_last_and_a_closed_path_from_its_start() {
        let mut path = Path::polygon([[10.0, 10.0], [20.04, 10.0], [20.04, 9.52]]);
        path.add_line([[10.0, 11.0], [9.96, 11.0]]);
        assert_eq!(data(&path), "m10 10l10 0l0-.5zm0 1l0 0");
        let curve = Path(vec![Segment::Move([1.0, 1.0]), Segment::Curve([2.0, 1.0], [3.0, 0.0], [4.0, 1.5])]);
        assert_eq!(data(&curve), "m1 1c1 0 2-1 3 .5");
    }
}
