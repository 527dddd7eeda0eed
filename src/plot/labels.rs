//! Labels beside points: where there is room, and nowhere else.

use super::drawing::At;
use super::lettering::width;

/// A box along the page's sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Box2 {
    low: At,
    high: At,
}

impl Box2 {
    pub(crate) fn around(centre: At, half: f64) -> Self {
        Box2 { low: [centre[0] - half, centre[1] - half], high: [centre[0] + half, centre[1] + half] }
    }

    fn meets(&self, other: &Box2) -> bool {
        (0..2).all(|axis| self.low[axis] < other.high[axis] && other.low[axis] < self.high[axis])
    }

    fn within(&self, low: At, high: At) -> bool {
        (0..2).all(|axis| low[axis] <= self.low[axis] && self.high[axis] <= high[axis])
    }

    /// Whether a straight line between two places crosses it, by clipping.
    fn meets_line(&self, [from, to]: [At; 2]) -> bool {
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for axis in 0..2 {
            let way = to[axis] - from[axis];
            let (near, far) = (self.low[axis] - from[axis], self.high[axis] - from[axis]);
            if way == 0.0 {
                if near > 0.0 || far < 0.0 {
                    return false;
                }
                continue;
            }
            let (a, b) = (near / way, far / way);
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        }
        enter <= leave
    }
}

/// What is on the plot already.
pub(crate) struct Room {
    low: At,
    high: At,
    taken: Vec<Box2>,
    lines: Vec<[At; 2]>,
}

/// Between a marker's middle and its label [px].
const OFFSET: f64 = 8.0;

impl Room {
    pub(crate) fn new(low: At, high: At) -> Self {
        Room { low, high, taken: Vec::new(), lines: Vec::new() }
    }

    pub(crate) fn take(&mut self, taken: Box2) {
        self.taken.push(taken);
    }

    pub(crate) fn cross(&mut self, line: [At; 2]) {
        self.lines.push(line);
    }

    /// The left end of a label beside a point, on its line; `None` when there is no room for it.
    pub(crate) fn find(&mut self, point: At, text: &str, size: f64) -> Option<At> {
        let (wide, high) = (width(text, size), size);
        let ways =
            [[1.0, 0.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [-1.0, 1.0], [0.0, -1.0], [0.0, 1.0]];
        for [right, down] in ways {
            let reach = if right != 0.0 && down != 0.0 { 0.6 * OFFSET } else { OFFSET };
            let middle = [point[0] + right * (reach + 0.5 * wide), point[1] + down * (reach + 0.5 * high)];
            let low = [middle[0] - 0.5 * wide - 1.0, middle[1] - 0.5 * high - 1.5];
            let found = Box2 { low, high: [low[0] + wide + 2.0, low[1] + high + 3.0] };
            let is_free = found.within(self.low, self.high)
                && !self.taken.iter().any(|taken| taken.meets(&found))
                && !self.lines.iter().any(|line| found.meets_line(*line));
            if is_free {
                self.taken.push(found);
                return Some([middle[0] - 0.5 * wide, middle[1] + 0.5 * high]);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_label_finds_another_side_and_the_last_none() {
        let mut room = Room::new([0.0, 0.0], [100.0, 100.0]);
        let places: Vec<Option<At>> = (0..12).map(|_| room.find([50.0, 50.0], "1/60", 8.0)).collect();
        assert!(places[0].is_some() && places[1].is_some() && places[0] != places[1]);
        assert_eq!(places[11], None);
    }

    #[test]
    fn a_label_keeps_clear_of_lines_and_of_the_edge() {
        let mut room = Room::new([0.0, 0.0], [100.0, 100.0]);
        room.cross([[0.0, 40.0], [100.0, 40.0]]);
        let [x, _] = room.find([98.0, 40.0], "1/60", 8.0).map(|at| [at[0], at[1]]).expect("there is room to the left");
        assert!(x < 90.0);
    }
}
