//! From near a minimum to the minimum: steps by Levenberg (1944) and Marquardt (1963), from differences of runs.

use super::matrix::{dot, eigen, normal};
use super::problem::{BAD, Bench, Horizon};

/// How far values are moved to see what follows, as a share of their ranges: far above rounding, and short enough that
/// the same bodies meet in the same iterations.
const PROBE: f64 = 1e-6;
/// Steps tried at one place, each shorter, before it is taken for the minimum.
const TRIES: usize = 6;
/// A step that gains less than this share of the cost is the last.
const LEAST_GAIN: f64 = 1e-3;

/// A place with its cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Shares of the ranges.
    pub place: Vec<f64>,
    /// The root of the sum of the squares of the residuals.
    pub cost: f64,
}

/// How residuals change with each coordinate, a row each; a coordinate that must stay has a row of zeros. `None` where a
/// run beside the place cannot be made.
#[must_use]
pub fn derivatives(bench: &Bench, place: &[f64], horizon: Horizon, held: Option<usize>) -> Option<Vec<Vec<f64>>> {
    let along = |i: usize| {
        let moved = |by: f64| {
            let mut moved = place.to_vec();
            moved[i] = (moved[i] + by).clamp(0.0, 1.0);
            moved
        };
        let (below, above) = (moved(-PROBE), moved(PROBE));
        let step = above[i] - below[i];
        let (low, high) = (bench.residuals(&below, horizon)?, bench.residuals(&above, horizon)?);
        Some(high.iter().zip(&low).map(|(high, low)| (high - low) / step).collect())
    };
    (0..place.len()).map(|i| if held == Some(i) { Some(Vec::new()) } else { along(i) }).collect()
}

/// Goes down from a place until it is good enough, no step gains much any more, or so many steps are made. A coordinate may
/// be held.
#[must_use]
pub fn refine(bench: &Bench, start: Found, horizon: Horizon, held: Option<usize>, enough: f64, steps: usize) -> Found {
    let mut found = start;
    let mut damping = 1e-6;
    for _ in 0..steps {
        if found.cost <= enough {
            break;
        }
        let before = found.cost;
        let Some(residuals) = bench.residuals(&found.place, horizon) else { break };
        let Some(rows) = derivatives(bench, &found.place, horizon, held) else { break };
        let axes = eigen(&normal(&rows));
        let slope: Vec<f64> = rows.iter().map(|row| dot(row, &residuals)).collect();
        let greatest = axes.first().map_or(0.0, |(value, _)| *value);
        if greatest <= 0.0 {
            break; // nothing depends on anything here
        }
        for _ in 0..TRIES {
            let mut place = found.place.clone();
            for (value, axis) in &axes {
                let length = -dot(axis, &slope) / (value.max(0.0) + damping * greatest);
                place.iter_mut().zip(axis).for_each(|(share, part)| *share += length * part);
            }
            place.iter_mut().for_each(|share| *share = share.clamp(0.0, 1.0));
            let cost = bench.cost(&place, horizon);
            if cost < found.cost {
                found = Found { place, cost };
                damping = (0.1 * damping).max(1e-15);
                break;
            }
            damping *= 10.0;
        }
        if found.cost > (1.0 - LEAST_GAIN) * before || found.cost >= BAD {
            break;
        }
    }
    found
}
