//! Which bodies touch in a frame, read off from where they stand: what continuous motion holds is not told as exchanges.

use crate::recording::{Body, Frame, Recording, State};

/// A gap that counts as touching, in sizes of the smaller rectangle: contacts that last keep within 1e-9 of it.
const TOUCHING: f64 = 1e-6;

/// The first body, in order of creation, that stands at a body with no gap between them; the pair in order of creation.
pub(super) fn touching(recording: &Recording, frame: &Frame, body: u32) -> Option<[u32; 2]> {
    let placed = |body: u32| Some((recording.bodies.get(body as usize)?, frame.states.get(body as usize)?));
    let this = placed(body)?;
    let others = (0..frame.states.len() as u32).filter(|other| *other != body);
    let found = others.into_iter().find(|other| placed(*other).is_some_and(|other| touch(this, other)))?;
    Some([body.min(found), body.max(found)])
}

type Corners = [[f64; 2]; 4];

fn touch(a: (&Body, &State), b: (&Body, &State)) -> bool {
    let (these, those) = (a.0.corners(a.1), b.0.corners(b.1));
    these.iter().any(|one| those.iter().any(|other| gap(one, other).max(gap(other, one)) <= TOUCHING))
}

/// The widest gap between two rectangles along the axes of the first, in sizes of the smaller; negative where they overlap.
fn gap(one: &Corners, other: &Corners) -> f64 {
    let side = |corners: &Corners, from: usize| {
        let [[x, z], [u, v]] = [corners[from], corners[from + 1]];
        [u - x, v - z]
    };
    let length = |[x, z]: [f64; 2]| libm::hypot(x, z);
    let least = |corners: &Corners| length(side(corners, 0)).min(length(side(corners, 1)));
    let along = |axis: [f64; 2]| {
        // From the first corner of the first, so that it is as exact far out as at home.
        let span = |corners: &Corners| {
            let from = one[0];
            let numbers = corners.map(|[x, z]| ((x - from[0]) * axis[0] + (z - from[1]) * axis[1]) / length(axis));
            (numbers.into_iter().fold(f64::INFINITY, f64::min), numbers.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        let ((low, high), (least, most)) = (span(one), span(other));
        (least - high).max(low - most)
    };
    along(side(one, 0)).max(along(side(one, 1))) / least(one).min(least(other))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_touch_face_to_face_and_corner_on_face() {
        let square = Body {
            name: "square".to_owned(),
            kind: choque_engine::scene::Kind::Mobile,
            mass: 1.0,
            inertia: 1.0,
            tags: Vec::new(),
            rects: vec![choque_engine::Rect::centred(1.0, 1.0)],
            restitution: None,
            friction: None,
        };
        let at = |x: f64, z: f64, angle: f64| State { x, z, angle, ..State::default() };
        let still = at(0.0, 0.0, 0.0);
        let half = libm::sqrt(0.5);
        let cases = [
            (at(1.0, 0.3, 0.0), true),
            (at(1.000_01, 0.3, 0.0), false),
            (at(0.5 + half, 0.0, core::f64::consts::FRAC_PI_4), true),
            (at(0.501 + half, 0.0, core::f64::consts::FRAC_PI_4), false),
        ];
        for (other, expected) in cases {
            assert_eq!(touch((&square, &still), (&square, &other)), expected, "{other:?}");
        }
    }
}
