//! Exchanges, and contacts that last, as columns of whole numbers.

use std::collections::BTreeMap;

use super::code::Bytes;
use super::quantum::Quantum;
use crate::recording::{Frame, Strike, Touch};

/// How many exchanges there are, and each of their numbers as a column.
pub(super) fn hits(frames: &[&Frame], quantum: Quantum, middle: [f64; 2]) -> (usize, Bytes) {
    // Those of the first frame belong to what was before it.
    let all: Vec<&Strike> = frames.iter().skip(1).flat_map(|frame| &frame.hits).collect();
    let mut bytes = Bytes::default();
    let whole = |number: f64, step: f64| (number / step).round() as i64;
    bytes.put_steps(all.iter().map(|hit| hit.iteration as i64));
    bytes.put_steps(all.iter().map(|hit| i64::from(hit.a)));
    bytes.put_steps(all.iter().map(|hit| i64::from(hit.b)));
    bytes.put_steps(all.iter().map(|hit| whole(hit.point[0] - middle[0], quantum.place)));
    bytes.put_steps(all.iter().map(|hit| whole(hit.point[1] - middle[1], quantum.place)));
    bytes.put_steps(all.iter().map(|hit| whole(direction(hit.normal), quantum.normal)));
    bytes.put_steps(all.iter().map(|hit| rolled(hit.depth as f32)));
    (all.len(), bytes)
}

/// How many pairs ever press on each other, and of each the frames in which it does, with a column for each of its numbers:
/// what rests is noughts.
pub(super) fn touches(frames: &[&Frame], quantum: Quantum) -> (usize, Bytes) {
    let mut pairs: BTreeMap<(u32, u32, usize), Vec<(usize, &Touch)>> = BTreeMap::new();
    for (index, frame) in frames.iter().enumerate() {
        let mut last = None;
        let mut nth = 0;
        for touch in &frame.touches {
            // Bodies of several rectangles may touch more than once.
            nth = if last == Some((touch.a, touch.b)) { nth + 1 } else { 0 };
            last = Some((touch.a, touch.b));
            pairs.entry((touch.a, touch.b, nth)).or_default().push((index, touch));
        }
    }
    let mut bytes = Bytes::default();
    for ((a, b, _), seen) in &pairs {
        [i64::from(*a), i64::from(*b), seen.len() as i64].into_iter().for_each(|number| bytes.put(number));
        let whole = |number: f32, step: f64| (f64::from(number) / step).round() as i64;
        let touches = || seen.iter().map(|(_, touch)| touch);
        bytes.put_steps(seen.iter().map(|(frame, _)| *frame as i64));
        bytes.put_steps(touches().map(|touch| {
            let normal = direction(touch.normal.map(f64::from));
            (normal / quantum.normal).round() as i64
        }));
        for (point, axis) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            bytes.put_steps(touches().map(|touch| whole(touch.points[point][axis], quantum.touch)));
        }
        bytes.put_steps(touches().map(|touch| rolled(touch.push[0] + touch.push[1])));
    }
    (pairs.len(), bytes)
}

fn direction([x, z]: [f64; 2]) -> f64 {
    libm::atan2(z, x)
}

/// The first 26 bits of an f32: five digits of it.
fn rolled(number: f32) -> i64 {
    i64::from(number.to_bits() >> 6)
}
