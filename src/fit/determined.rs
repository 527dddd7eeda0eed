//! How sharply a value is determined: how far it can be moved, the others following, before the cost grows.

use super::matrix::{Square, eigen, normal};
use super::problem::{BAD, Bench, Horizon, Problem};
use super::refine::{Found, derivatives, refine};

/// A value that may be moved over more than this share of its range is not determined.
const LOOSE: f64 = 0.5;
/// Nor is one that may be moved over more than this share, where less and less tolerance does not hold it either.
const VALLEY: f64 = 0.1;
/// That less tolerance, and how much shorter the way must be with it.
const STRICTER: (f64, f64) = (0.01, 0.5);
/// Another value that goes along over more than this share of its own range is named.
const GOES_ALONG: f64 = 0.05;
/// The first move, as a share of the range; each next one is twice as long.
const FIRST_MOVE: f64 = 1e-7;
/// Halvings that find where the cost has grown enough.
const HALVINGS: usize = 7;
/// Steps by which the others follow a move.
const FOLLOWING: usize = 4;

/// What is known of one value.
#[derive(Clone, Debug, PartialEq)]
pub struct Determined {
    /// Shares of its range between which the cost grows by no more than the tolerance.
    pub low: f64,
    /// See `low`.
    pub high: f64,
    /// Whether it can be almost anything, alone or together with others.
    pub is_loose: bool,
    /// Others that moved along, by index, with their shares at the low end and at the high end.
    pub along: Vec<(usize, f64, f64)>,
}

/// Follows the valley through a minimum to both sides of every value.
#[must_use]
pub fn determine(problem: &Problem, found: &Found, tolerance: f64, jobs: usize) -> Vec<Determined> {
    let axes: Vec<usize> = (0..problem.dimension()).collect();
    let ends = |axes: &[usize], tolerance: f64| {
        let sides: Vec<(usize, f64)> = axes.iter().flat_map(|axis| [(*axis, -1.0), (*axis, 1.0)]).collect();
        problem.spread(&sides, jobs, |bench, (axis, sign)| follow(bench, found, *axis, *sign, tolerance))
    };
    let mut told: Vec<Determined> =
        axes.iter().zip(ends(&axes, tolerance).chunks(2)).map(|(axis, ends)| of(problem, *axis, ends)).collect();
    let in_doubt = |axis: &usize| !told[*axis].is_loose && told[*axis].high - told[*axis].low > VALLEY;
    let in_doubt: Vec<usize> = axes.into_iter().filter(in_doubt).collect();
    for (axis, ends) in in_doubt.iter().zip(ends(&in_doubt, STRICTER.0 * tolerance).chunks(2)) {
        let known = &mut told[*axis];
        known.is_loose = ends[1][*axis] - ends[0][*axis] > STRICTER.1 * (known.high - known.low);
    }
    told
}

/// What the two ends of a value's valley say.
fn of(problem: &Problem, axis: usize, ends: &[Vec<f64>]) -> Determined {
    let others = (0..problem.dimension()).filter(|other| *other != axis);
    let along = others.map(|other| (other, ends[0][other], ends[1][other]));
    // A number that counts stays the same over a part of its range.
    let [low, high] = [0, 1].map(|end| problem.share(axis, problem.value(axis, ends[end][axis])));
    Determined {
        low,
        high,
        is_loose: high - low > LOOSE,
        along: along.filter(|(_, low, high)| (high - low).abs() > GOES_ALONG).collect(),
    }
}

/// The furthest place along a valley to one side, the others following where the cost would grow otherwise.
fn follow(bench: &Bench, found: &Found, axis: usize, sign: f64, tolerance: f64) -> Vec<f64> {
    let enough = found.cost + tolerance;
    let to_border = if sign < 0.0 { found.place[axis] } else { 1.0 - found.place[axis] };
    let (mut good, mut length) = (found.place.clone(), 0.0);
    let mut direction: Vec<f64> = (0..good.len()).map(|i| if i == axis { sign } else { 0.0 }).collect();
    let (mut bad, mut next) = (None, FIRST_MOVE.min(to_border));
    let mut halvings = 0;
    while next > length && halvings < HALVINGS {
        match arrive(bench, &good, &direction, next - length, (axis, found.place[axis] + sign * next), enough) {
            Some(place) => {
                direction = place.iter().zip(&good).map(|(to, from)| (to - from) / (next - length)).collect();
                (good, length) = (place, next);
            }
            None => bad = Some(next),
        }
        next = match bad {
            Some(bad) => 0.5 * (length + bad),
            None => (2.0 * next).min(to_border),
        };
        halvings += usize::from(bad.is_some());
    }
    good
}

/// A place a move further on with a cost that is low enough, if there is one.
fn arrive(
    bench: &Bench,
    from: &[f64],
    direction: &[f64],
    by: f64,
    (axis, share): (usize, f64),
    enough: f64,
) -> Option<Vec<f64>> {
    let mut place: Vec<f64> =
        from.iter().zip(direction).map(|(from, along)| (from + along * by).clamp(0.0, 1.0)).collect();
    place[axis] = share.clamp(0.0, 1.0);
    let cost = bench.cost(&place, Horizon::Whole);
    let found = refine(bench, Found { place, cost }, Horizon::Whole, Some(axis), enough, FOLLOWING);
    (found.cost <= enough).then_some(found.place)
}

/// How the values go together near a minimum, from −1 to 1: the correlations that the residuals' derivatives give. `None` where
/// no run can be made beside it.
#[must_use]
pub fn correlations(bench: &Bench, place: &[f64]) -> Option<Square> {
    /// What nothing depends on goes with nothing: it is held by that share of the strongest dependence.
    const HELD: f64 = 1e-14;
    let axes = eigen(&normal(&derivatives(bench, place, Horizon::Whole, None)?));
    let greatest = axes.first().map_or(0.0, |(value, _)| *value);
    if greatest <= 0.0 {
        return None;
    }
    let n = place.len();
    let covariance = |i: usize, j: usize| {
        axes.iter().map(|(value, axis)| axis[i] * axis[j] / (value.max(0.0) + HELD * greatest)).sum::<f64>()
    };
    let correlation = |i: usize, j: usize| {
        if i == j { 1.0 } else { covariance(i, j) / (covariance(i, i) * covariance(j, j)).sqrt() }
    };
    Some((0..n).map(|i| (0..n).map(|j| correlation(i, j)).collect()).collect())
}

/// Moves every value that the residuals leave open back to what the scenario itself says, the others following: an answer is
/// no reason to change what it does not depend on.
#[must_use]
pub fn settle(bench: &Bench, found: Found, tolerance: f64, open: &[bool]) -> Found {
    let own = bench.problem.own();
    let mut settled = found;
    for axis in (0..own.len()).filter(|axis| open[*axis]) {
        let mut place = settled.place.clone();
        place[axis] = own[axis];
        let cost = bench.cost(&place, Horizon::Whole);
        if cost >= BAD {
            continue;
        }
        let most = settled.cost + 1e-3 * tolerance;
        let moved = refine(bench, Found { place, cost }, Horizon::Whole, Some(axis), settled.cost, 3 * FOLLOWING);
        if moved.cost <= most {
            settled = moved;
        }
    }
    settled
}
