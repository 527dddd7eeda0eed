//! Exchanges, and contacts that last, as columns of whole numbers.

use std::collections::BTreeMap;

use super::code::Bytes;
use super::film::whole;
use super::quantum::Quantum;
use crate::recording::{Frame, State, Strike, Touch};

/// How many exchanges there are, pair after pair, and each of their numbers as a column: what a pair does again is much like
/// what it did before. Points are counted from where the earlier-created body stands in the frame.
pub(super) fn hits(frames: &[&Frame], quantum: Quantum) -> (usize, Bytes) {
    // Those of the first frame belong to what was before it.
    let told =
        frames.iter().enumerate().skip(1).flat_map(|(index, frame)| frame.hits.iter().map(move |hit| (index, hit)));
    let mut all: Vec<(usize, &Strike)> = told.collect();
    all.sort_by_key(|(_, hit)| (hit.a, hit.b)); // stable: in time within a pair
    let mut bytes = Bytes::default();
    let from = |(frame, hit): &(usize, &Strike)| -> State { frames[*frame].states[hit.a as usize] };
    bytes.put_steps(all.iter().map(|(frame, _)| *frame as i64));
    bytes.put_steps(all.iter().map(|(_, hit)| hit.iteration as i64));
    bytes.put_steps(all.iter().map(|(_, hit)| i64::from(hit.a)));
    bytes.put_steps(all.iter().map(|(_, hit)| i64::from(hit.b)));
    bytes.put_steps(all.iter().map(|at| whole(at.1.point[0] - from(at).x, quantum.point)));
    bytes.put_steps(all.iter().map(|at| whole(at.1.point[1] - from(at).z, quantum.point)));
    bytes.put_steps(all.iter().map(|(_, hit)| whole(direction(hit.normal), quantum.normal)));
    bytes.put_steps(all.iter().map(|(_, hit)| rolled(hit.depth as f32)));
    (all.len(), bytes)
}

/// How many pairs ever press on each other, and of each the frames in which it does, with a column for each of its numbers:
/// what rests is noughts.
pub(super) fn touches(frames: &[&Frame], quantum: Quantum) -> (usize, Bytes) {
    type Seen<'a> = Vec<(usize, &'a Touch)>;
    let mut pairs: BTreeMap<(u32, u32, usize), Seen> = BTreeMap::new();
    for (index, frame) in frames.iter().enumerate() {
        let (mut last, mut nth) = (None, 0);
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
        let touches = || seen.iter().map(|(_, touch)| touch);
        bytes.put_steps(seen.iter().map(|(frame, _)| *frame as i64));
        bytes.put_steps(touches().map(|touch| whole(direction(touch.normal.map(f64::from)), quantum.normal)));
        for (point, axis) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            bytes.put_steps(touches().map(|touch| whole(f64::from(touch.points[point][axis]), quantum.point)));
        }
        bytes.put_steps(touches().map(|touch| rolled(touch.push[0] + touch.push[1])));
    }
    (pairs.len(), bytes)
}

fn direction([x, z]: [f64; 2]) -> f64 {
    libm::atan2(z, x)
}

/// The first 18 bits of an f32: three digits of it.
fn rolled(number: f32) -> i64 {
    i64::from(number.to_bits() >> 14)
}
