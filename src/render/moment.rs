//! One moment of a run as a drawing: areas, the ways bodies came, where they met, names and a scale.

use choque_engine::Rect;
use choque_engine::scene::Kind;

use super::view::View;
use crate::output::numbers::{rough, trimmed};
use crate::plot::axis::nice_step;
use crate::plot::drawing::{At, Drawing, Path, Shape, Stroke};
use crate::plot::labels::{Box2, Room};
use crate::plot::lettering::{Anchor, Pen, width};
use crate::plot::palette::{Colour, FAINT, INK, Look, PAPER, tint};
use crate::recording::{Body, Frame, Recording, State};

const TITLE: Pen = Pen { size: 11.5, weight: 1.5, colour: INK };
const SMALL: Pen = Pen { size: 8.4, weight: 1.05, colour: FAINT };
const NAME: Pen = Pen { size: 7.4, weight: 1.0, colour: INK };
/// What bodies that never yield are drawn in.
const STONE: Colour = [95, 95, 95];
/// Where things meet.
const CONTACT: Colour = [170, 0, 40];

/// With more bodies than that, the places they came by are not drawn …
const MOST_GHOSTS: usize = 30;
/// … nor their trails …
const MOST_TRAILS: usize = 400;
/// … and only those with a tag are named.
const MOST_NAMES: usize = 40;
/// Letters of a name at most.
const LONGEST_NAME: usize = 24;
/// Where there are few bodies each is a dot at least that can be seen [px].
const DOT: f64 = 1.6;
/// … and has an outline at least that can be seen, as a playing card on edge [px].
const THINNEST: f64 = 0.8;
/// How far paper shines around a name that stands over lines [px].
const HALO: f64 = 2.6;
/// Corners that are by so much less far right count for little where a name is to stand [px].
const BLUNT: f64 = 3.0;
/// Places that each body came by.
const GHOSTS: usize = 9;
/// Points of a trail at most.
const TRAIL: usize = 240;
/// Earlier exchanges that are shown, the last ones.
const EARLIER: usize = 80;

/// A moment of a recording, and how far back what is drawn reaches.
#[derive(Clone, Debug)]
pub struct Moment<'a> {
    recording: &'a Recording,
    /// Which frame.
    at: usize,
    /// The frame where trails begin.
    since: usize,
}

impl<'a> Moment<'a> {
    /// The frame of that number, with trails from the start.
    #[must_use]
    pub fn of(recording: &'a Recording, at: usize) -> Self {
        Moment { recording, at, since: 0 }
    }

    /// With trails from a later frame on.
    #[must_use]
    pub(super) fn since(self, since: usize) -> Self {
        Moment { since, ..self }
    }

    /// The moment on a page of that width, all in view that happened since trails began.
    #[must_use]
    pub fn draw(&self, width: f64) -> Drawing {
        let view = View::of(self.recording, self.frames(), width);
        let drawing = self.draw_in(&view);
        let mut page = Drawing::new(drawing.width, drawing.height, &drawing.title);
        page.fill(Path::rect([0.0, 0.0], [page.width, page.height]), PAPER);
        self.draw_ghosts(&mut page, &view);
        page.shapes.extend(drawing.shapes);
        page
    }

    fn frames(&self) -> &'a [Frame] {
        self.recording.frames.get(self.since..=self.at).unwrap_or_default()
    }

    /// Without the places that bodies came by.
    pub(super) fn draw_in(&self, view: &View) -> Drawing {
        let [wide, high] = view.page();
        let mut drawing = Drawing::new(wide, high, &self.title());
        let Some(frame) = self.frames().last() else { return drawing };
        self.draw_trails(&mut drawing, view);
        let bodies = || self.recording.bodies.iter().zip(&frame.states).enumerate();
        let few = self.recording.bodies.len() <= MOST_TRAILS;
        let weight = weight(self.recording, view).max(if few { THINNEST } else { 0.0 });
        for kind in [Kind::Fixed, Kind::Mobile] {
            for (i, (body, state)) in bodies().filter(|(_, (body, _))| body.kind == kind) {
                let colour = colour(body, i);
                let stroke = (weight > 0.2).then(|| Stroke::full(colour, weight));
                let fill = Some(tint(colour, if body.kind == Kind::Fixed { 0.42 } else { 0.55 }));
                draw_body(&mut drawing, view, body, state, fill, stroke.as_ref());
                if few && kind == Kind::Mobile && body.rects.iter().all(|rect| rect.radius() * view.scale < DOT) {
                    drawing.fill(Path::circle(view.place([state.x, state.z]), DOT), colour);
                }
            }
        }
        self.draw_contacts(&mut drawing, view, frame);
        self.draw_names(&mut drawing, view, frame);
        self.draw_frame(&mut drawing, view, frame);
        drawing
    }

    fn title(&self) -> String {
        let iteration = self.frames().last().map_or(0, |frame| frame.iteration);
        format!("{} at iteration {iteration}", self.recording.about.title)
    }

    /// Where bodies were at regular moments, fainter the longer ago; to be under everything else.
    fn draw_ghosts(&self, drawing: &mut Drawing, view: &View) {
        let mobile = self.recording.bodies.iter().filter(|body| body.kind == Kind::Mobile).count();
        if mobile > MOST_GHOSTS {
            return;
        }
        let frames = self.frames();
        for step in 0..GHOSTS {
            let Some(frame) = frames.get(step * frames.len().saturating_sub(1) / GHOSTS) else { continue };
            let strength = 0.05 + 0.13 * step as f64 / GHOSTS as f64;
            for (i, (body, state)) in self.recording.bodies.iter().zip(&frame.states).enumerate() {
                let moved = frames.last().is_some_and(|last| !last.states[i].is(state));
                if moved {
                    draw_body(drawing, view, body, state, Some(tint(colour(body, i), strength)), None);
                }
            }
        }
    }

    fn draw_trails(&self, drawing: &mut Drawing, view: &View) {
        let frames = self.frames();
        let bodies = &self.recording.bodies;
        if bodies.iter().filter(|body| body.kind == Kind::Mobile).count() > MOST_TRAILS {
            return;
        }
        let every = frames.len().div_ceil(TRAIL).max(1);
        for (i, body) in bodies.iter().enumerate().filter(|(_, body)| body.kind == Kind::Mobile) {
            let looked = frames.iter().step_by(every).chain(frames.last());
            let mut places: Vec<At> = looked.map(|frame| frame.states[i]).map(|s| view.place([s.x, s.z])).collect();
            places.dedup_by(|a, b| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 0.4);
            if places.len() > 1 {
                drawing.stroke(Path::line(places), Stroke::full(tint(colour(body, i), 0.6), 1.1));
            }
        }
    }

    /// What touches now with the force it carries; exchanges of now with their normals, earlier ones as rings.
    fn draw_contacts(&self, drawing: &mut Drawing, view: &View, frame: &Frame) {
        let size = (0.12 * smallest(self.recording) * view.scale).clamp(0.6, 2.4);
        let mut rings: Vec<At> = Vec::new();
        let earlier = self.frames().iter().rev().skip(1).flat_map(|frame| frame.hits.iter().rev()).take(EARLIER);
        for at in earlier.map(|hit| view.place(hit.point)) {
            if rings.iter().all(|ring| (ring[0] - at[0]).abs() + (ring[1] - at[1]).abs() > 4.0) {
                drawing.stroke(Path::circle(at, 0.9 * size), Stroke::full(tint(CONTACT, 0.5), 0.9));
                rings.push(at);
            }
        }
        let hardest = frame.touches.iter().flat_map(|touch| touch.push).fold(0.0, f32::max);
        for touch in &frame.touches {
            let Some(a) = frame.states.get(touch.a as usize) else { continue };
            for (at, push) in touch.places(a).into_iter().zip(touch.push).filter(|(_, push)| *push > 0.0) {
                let length = 4.0 * size * f64::from((push / hardest).sqrt());
                draw_normal(drawing, view.place(at), touch.normal.map(f64::from), length, size);
            }
        }
        for hit in &frame.hits {
            draw_normal(drawing, view.place(hit.point), hit.normal, 6.5 * size, 1.1 * size);
        }
    }

    fn draw_names(&self, drawing: &mut Drawing, view: &View, frame: &Frame) {
        let [low, high] = [view.from, [view.from[0] + view.size[0], view.from[1] + view.size[1]]];
        let mut room = Room::new(low, high);
        let bodies = &self.recording.bodies;
        let tagged = bodies.iter().filter(|body| !body.tags.is_empty()).count();
        let named = |body: &Body| bodies.len() <= MOST_NAMES || (tagged <= MOST_NAMES && !body.tags.is_empty());
        for state in &frame.states {
            room.take(Box2::around(view.place([state.x, state.z]), 1.0));
        }
        let named: Vec<_> = bodies.iter().zip(&frame.states).filter(|(body, _)| named(body)).collect();
        let fits = |body: &Body, name: &str| {
            let least = |rect: &Rect| rect.width().min(rect.depth()) * view.scale;
            body.rects.iter().any(|rect| least(rect) > width(name, NAME.size) + 4.0)
        };
        // Names that fit stand in their bodies; the others look for room afterwards.
        let (inside, beside): (Vec<_>, Vec<_>) = named
            .into_iter()
            .map(|(body, state)| (body, state, shortened(&body.name)))
            .partition(|(body, _, name)| fits(body, name));
        for (_, state, name) in &inside {
            let at = view.place([state.x, state.z]);
            drawing.text([at[0], at[1] + 0.5 * NAME.size], Anchor::Middle, name, NAME);
            room.take(Box2::around(at, 0.5 * width(name, NAME.size)));
        }
        for (body, state, name) in &beside {
            let centre = view.place([state.x, state.z]);
            let end = right_end(body, state, view).unwrap_or(centre);
            // Who reaches out of the picture is named at its edge.
            let [right, middle] = if end[0] < high[0] { end } else { [high[0], centre[1]] };
            if let Some(start) = room.find([right - 3.0, middle], name, NAME.size) {
                drawing.text(start, Anchor::Start, name, Pen { weight: NAME.weight + HALO, colour: PAPER, ..NAME });
                drawing.text(start, Anchor::Start, name, NAME);
            }
        }
    }

    /// What is around the plane's part: margins that hide what reaches out, title, moment, scale.
    fn draw_frame(&self, drawing: &mut Drawing, view: &View, frame: &Frame) {
        let [left, top] = view.from;
        let [right, bottom] = [left + view.size[0], top + view.size[1]];
        let [wide, high] = [drawing.width, drawing.height];
        let margins = [
            [[0.0, 0.0], [wide, top]],
            [[0.0, bottom], [wide, high]],
            [[0.0, 0.0], [left, high]],
            [[right, 0.0], [wide, high]],
        ];
        margins.into_iter().for_each(|[from, to]| drawing.fill(Path::rect(from, to), PAPER));
        drawing.stroke(Path::rect(view.from, [right, bottom]), Stroke::full(tint(INK, 0.35), 1.0));
        let title = fitting(&self.recording.about.title, TITLE.size, right - left);
        drawing.text([left, 20.0], Anchor::Start, &title, TITLE);
        let time = format!("{:.3}", frame.time);
        let moment = format!("iteration {}, {} s", frame.iteration, trimmed(&time));
        drawing.text([left, 37.0], Anchor::Start, &moment, SMALL);
        draw_scale(drawing, view, [left, bottom + 16.0]);
        let counts = match (frame.hits.len(), frame.touches.len()) {
            (0, 0) => String::new(),
            (hits, 0) => format!("exchanges now: {hits}"),
            (0, touches) => format!("contacts: {touches}"),
            (hits, touches) => format!("exchanges now: {hits}, contacts: {touches}"),
        };
        drawing.text([right, bottom + 20.0], Anchor::End, &counts, SMALL);
    }
}

/// Where a body ends on its right: in the middle of a side that is upright, at a corner that sticks out, and in between as it turns.
/// `None` where it has no rectangle.
fn right_end(body: &Body, state: &State, view: &View) -> Option<At> {
    let corners: Vec<At> = body.corners(state).into_iter().flatten().map(|corner| view.place(corner)).collect();
    let right = corners.iter().map(|corner| corner[0]).reduce(f64::max)?;
    let weights = corners.iter().map(|corner| libm::exp((corner[0] - right) / BLUNT));
    let (sum, all) = corners.iter().zip(weights).fold((0.0, 0.0), |(sum, all), (at, w)| (sum + w * at[1], all + w));
    Some([right, sum / all])
}

/// A name as long as there is room for.
fn shortened(name: &str) -> String {
    if name.chars().count() <= LONGEST_NAME {
        return name.to_owned();
    }
    let begun: String = name.chars().take(LONGEST_NAME - 1).collect();
    format!("{begun}…")
}

/// A text as long as there is room for on a line of that width.
fn fitting(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut begun = text.to_owned();
    while begun.pop().is_some() && width(&format!("{begun}…"), size) > room {}
    format!("{}…", begun.trim_end())
}

fn colour(body: &Body, index: usize) -> Colour {
    if body.kind == Kind::Fixed { STONE } else { Look(index).colour() }
}

fn draw_body(
    drawing: &mut Drawing,
    view: &View,
    body: &Body,
    state: &State,
    fill: Option<Colour>,
    stroke: Option<&Stroke>,
) {
    for corners in body.corners(state) {
        let path = Path::polygon(corners.map(|corner| view.place(corner)));
        drawing.shapes.push(Shape { path, fill, stroke: stroke.cloned() });
    }
}

fn draw_normal(drawing: &mut Drawing, at: At, normal: [f64; 2], length: f64, size: f64) {
    let [dx, dy] = View::along(normal, length);
    drawing.stroke(Path::line([at, [at[0] + dx, at[1] + dy]]), Stroke::full(CONTACT, 0.55 * size));
    drawing.fill(Path::circle(at, size), CONTACT);
}

/// A length that can be read off, near the lower left corner.
fn draw_scale(drawing: &mut Drawing, view: &View, [x, y]: At) {
    let length = nice_step(view.size[0] / view.scale);
    let end = x + length * view.scale;
    drawing.stroke(Path::line([[x, y - 4.0], [x, y], [end, y], [end, y - 4.0]]), Stroke::full(INK, 1.2));
    drawing.text([end + 7.0, y + 2.0], Anchor::Start, &length_in_words(length), SMALL);
}

/// A length in the unit that suits it.
fn length_in_words(metres: f64) -> String {
    let units = [(1e3, "km"), (1.0, "m"), (1e-3, "mm"), (1e-6, "µm")];
    // A tenth of a metre is said in metres.
    let unit = units.into_iter().find(|(size, _)| metres > 0.09 * size && (metres > 0.9 * size || *size == 1.0));
    let (size, unit) = unit.unwrap_or((1.0, "m"));
    format!("{} {unit}", rough(metres / size))
}

/// The least size of any rectangle \[m\].
fn smallest(recording: &Recording) -> f64 {
    let rects = recording.bodies.iter().filter(|body| body.kind == Kind::Mobile).flat_map(|body| &body.rects);
    rects.map(|rect| rect.width().min(rect.depth())).fold(f64::INFINITY, f64::min).min(1e9)
}

/// How thick outlines are: thin where rectangles are small.
fn weight(recording: &Recording, view: &View) -> f64 {
    (0.08 * smallest(recording) * view.scale).min(1.3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_ends_where_the_picture_does() {
        assert_eq!(fitting("kick", TITLE.size, 400.0), "kick");
        let long = fitting("Figure 12: relocation of the vertex's owner", TITLE.size, 200.0);
        assert!(long.starts_with("Figure 12") && long.ends_with('…') && width(&long, TITLE.size) <= 200.0, "{long}");
        assert_eq!(fitting("long", TITLE.size, 0.0), "…");
    }
}
